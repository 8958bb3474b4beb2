// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fastrt::cli {

// What --help says after the options: the kinds of lights, examples, formats, AOVs and exit codes.
std::string help_footer();

// The answer to --version.
std::string version_text();

} // namespace fastrt::cli
