// SPDX-License-Identifier: Apache-2.0
// What a run says of itself when it is done.
#pragma once

#include "src/cli/options.hpp"
#include "src/cli/stats.hpp"

#include <filesystem>

namespace fastrt::cli {

// Puts into `stats` what scene, tree and frame say.
void describe(const Options& options, const Tracer& tracer, const Frame& frame, RunStats& stats);

// Prints as --stats and --quiet ask for. Where the picture itself went to stdout, all goes to stderr. Throws
// OutputError.
void report(const Options& options, const RunStats& stats, const std::filesystem::path& picture);

} // namespace fastrt::cli
