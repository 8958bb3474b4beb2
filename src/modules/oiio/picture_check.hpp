// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace fastrt {

// What OpenImageIO must not be given, for it would read or write where it may not: "" if the file may be
// read, else why not. format: OpenImageIO's name of it; files of other formats than TGA and BMP may be read.
const char* fault_of_picture(std::string_view format, std::string_view bytes);

} // namespace fastrt
