// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/modules/pictures.hpp"

namespace fastrt {

// 8-bit codes of whole, undamaged files into `picture`; false, and nothing kept, of others, of larger ones
// than the file's limits, and of kinds that are left to OpenImageIO. Nothing here prints.

// Greys, colours and palettes of up to eight bits, without transparent colours; interlaced too.
bool decode_png(const PictureFile& file, DecodedPicture& picture) noexcept;
// Greys and YCbCr or RGB colours.
bool decode_jpeg(const PictureFile& file, DecodedPicture& picture) noexcept;

// Red, green and blue, a byte each, as JPEG; false, result.error set and nothing kept if that fails.
bool encode_jpeg(const PictureToEncode& picture, EncodedPicture& result) noexcept;

// Whether a picture of this size may be read.
inline bool within_limits(const PictureFile& file, std::size_t width, std::size_t height) noexcept {
  const auto most_side = static_cast<std::size_t>(file.most_side);
  return width >= 1 && height >= 1 && width <= most_side && height <= most_side &&
         width * height <= file.most_bytes / 4;
}

} // namespace fastrt
