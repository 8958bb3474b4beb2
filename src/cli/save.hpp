// SPDX-License-Identifier: Apache-2.0
// Bytes into their place, and what signals mean for it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fastrt::cli {

// The format that the name asks for; a device without an extension gets PNG.
std::string format_of(const std::filesystem::path& output);

// Encoding may take long, and a signal may end it; putting the bytes into their place is done to the end.
// Throws OutputError. After it, signal_received() tells whether to go on.
void save(const std::filesystem::path& output, const std::vector<unsigned char>& bytes);

} // namespace fastrt::cli
