// SPDX-License-Identifier: Apache-2.0
// Names of files that are open already.
#pragma once

#include <filesystem>

namespace fastrt {

// The descriptor that a name such as /dev/stdout or /dev/fd/63 stands for; -1 for names of other kinds. To
// open such a name anew fails for sockets and for files of another user, and would cut off what a file holds.
int descriptor_named(const std::filesystem::path& path);

// 0, or the error of writing to it.
int check_descriptor(int descriptor) noexcept;

} // namespace fastrt
