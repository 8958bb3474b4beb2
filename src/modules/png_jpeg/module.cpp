// SPDX-License-Identifier: Apache-2.0
#include "src/modules/png_jpeg/codecs.hpp"

#include <string_view>

extern "C" __attribute__((visibility("default"))) int
fastrt_png_jpeg_decode_2(const fastrt::PictureFile* file, fastrt::DecodedPicture* picture) {
  const std::string_view format = file->format;
  if (format == "png") return fastrt::decode_png(*file, *picture) ? 1 : 0;
  return format == "jpeg" && fastrt::decode_jpeg(*file, *picture) ? 1 : 0;
}

extern "C" __attribute__((visibility("default"))) int
fastrt_png_jpeg_encode_3(const fastrt::PictureToEncode* picture, fastrt::EncodedPicture* result) {
  return fastrt::encode_jpeg(*picture, *result) ? 1 : 0;
}
