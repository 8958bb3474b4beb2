// SPDX-License-Identifier: Apache-2.0
// The encoders behind encode_image. Each takes 3 * width * height values and returns the whole file.
#pragma once

#include "src/modules/pictures.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

using Bytes = std::vector<unsigned char>;

// Rows from the top, linear or, where those are null, 8-bit sRGB.
struct Picture {
  const float* linear;
  const unsigned char* srgb8;
  int width, height;
  int threads;
};

// Of a format in lower case.
inline bool is_jpeg(std::string_view format) { return format == "jpg" || format == "jpeg"; }
inline bool is_tiff(std::string_view format) { return format == "tif" || format == "tiff"; }

// The codes of values first .. first + count - 1.
void put_codes(const Picture& picture, std::size_t first, std::size_t count, unsigned char* codes);

// 8 bits a channel, of either kind of picture; pfm of linear ones.
Bytes encode_png(const Picture& picture);
Bytes encode_ppm(const Picture& picture);
Bytes encode_pfm(const Picture& picture);
Bytes encode_tiff(const Picture& picture);
// hdr (linear pictures), jpg and jpeg, by modules.
Bytes encode_with_module(const std::string& format, const Picture& picture);
// exr: a linear picture, or any channels; by a module.
Bytes encode_exr(const Picture& picture);
Bytes encode_exr(const LayersToEncode& layers);
// Loads the module of a format that has one. Throws OutputError if that can't be done, before a picture is
// made in vain.
void require_module(std::string_view format);

} // namespace fastrt
