// SPDX-License-Identifier: Apache-2.0
// Puts bytes into a file so that there is either the old file or the whole new one.
#pragma once

#include <cstddef>
#include <filesystem>

namespace fastrt {

// Throws OutputError for the reasons that can be seen before there is anything to write.
void check_writable(const std::filesystem::path& path);

// The file that replace_file puts in place: links are followed, in folders too, so that two names of one
// place give one answer. Throws OutputError as check_writable does.
std::filesystem::path place_of(const std::filesystem::path& path);

// Writes beside the place, syncs, and renames. A link is followed. What exists and is no regular file (a
// device, a pipe), or is mounted alone, is written to directly. Names of open files (/dev/stdout, /dev/fd/63)
// stand for these, wherever they are. Throws OutputError with the system's reason.
void replace_file(const std::filesystem::path& path, const unsigned char* bytes, std::size_t count);

} // namespace fastrt
