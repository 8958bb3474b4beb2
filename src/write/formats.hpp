// SPDX-License-Identifier: Apache-2.0
// The encoders behind encode_image. Each takes 3 * width * height values and returns the whole file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
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

// The codes of values first .. first + count - 1.
void put_codes(const Picture& picture, std::size_t first, std::size_t count, unsigned char* codes);

// 8 bits a channel, of either kind of picture; pfm of linear ones.
Bytes encode_png(const Picture& picture);
Bytes encode_ppm(const Picture& picture);
Bytes encode_pfm(const Picture& picture);
Bytes encode_tiff(const Picture& picture);
// Columns of 32 bits under names of their own, of one size; floats or unsigned integers.
struct Channels {
  std::vector<std::string> names;
  std::vector<unsigned char> is_integer;
  std::vector<std::uint32_t> values; // names.size() values a pixel, floats by their bits
  int width, height;
  int threads;
  std::string objects; // attribute "fastrt:objects"; empty: none
};

// exr and hdr (linear pictures), jpg and jpeg, by modules.
Bytes encode_with_module(const std::string& format, const Picture& picture);
Bytes encode_exr(const Channels& channels);

} // namespace fastrt
