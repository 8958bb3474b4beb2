// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/modules/pictures.hpp"

#include <cstdio>
#include <cstring>

namespace fastrt {

// Nothing here prints.

// Every kind of PNG: eight bits as bytes, sixteen as floats from 0 to 1. What can't be read of a damaged one
// is black. False, picture.error set and nothing kept where there is nothing to keep.
bool decode_png(const PictureFile& file, DecodedPicture& picture) noexcept;
// The same of JPEG files, which are read here if they hold greys or YCbCr or RGB colours of eight bits. Of
// others picture.error stays empty: they are left to OpenImageIO.
bool decode_jpeg(const PictureFile& file, DecodedPicture& picture) noexcept;

// Red, green and blue, a byte each, as JPEG; false, result.error set and nothing kept if that fails.
bool encode_jpeg(const PictureToEncode& picture, EncodedPicture& result) noexcept;

// Whether a picture of this size may be read; otherwise `why` says so.
template <std::size_t length>
bool check_size(const PictureFile& file, std::size_t width, std::size_t height, std::size_t bytes_of_pixel,
                char (&why)[length]) noexcept {
  const auto most_side = static_cast<std::size_t>(file.most_side);
  if (width >= 1 && height >= 1 && width <= most_side && height <= most_side &&
      width * height <= file.most_bytes / bytes_of_pixel)
    return true;
  std::snprintf(why, length, "%zu x %zu pixels are too many", width, height);
  return false;
}

// Makes pixels of four codes, of one byte each or two, black and opaque: those that an error leaves unread.
inline void blacken(unsigned char* codes, std::size_t pixels, std::size_t code_size) noexcept {
  for (std::size_t i = 0; i < pixels; ++i, codes += 4 * code_size) {
    std::memset(codes, 0, 3 * code_size);
    std::memset(codes + 3 * code_size, 0xFF, code_size);
  }
}

} // namespace fastrt
