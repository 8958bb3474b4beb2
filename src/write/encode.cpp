// SPDX-License-Identifier: Apache-2.0
#include "src/write/formats.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <algorithm>

namespace fastrt {

namespace {

void check_picture(std::span<const float> rgb, int width, int height) {
  if (width < 1 || height < 1) throw UsageError("a picture needs a width and a height of at least 1");
  if (rgb.size() != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw UsageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels needs three values for each, not " + std::to_string(rgb.size()) + " in all");
}

} // namespace

std::vector<std::string> image_extensions() {
  return {"png", "ppm", "pfm", "exr", "jpg", "jpeg", "tif", "tiff", "hdr"};
}

std::vector<unsigned char> encode_image(const std::string& format, std::span<const float> rgb, int width,
                                        int height, int threads) {
  check_picture(rgb, width, height);
  const Picture picture{rgb.data(), width, height, threads};
  if (format == "png") return encode_png(picture);
  if (format == "ppm") return encode_ppm(picture);
  if (format == "pfm") return encode_pfm(picture);
  if (format == "tif" || format == "tiff") return encode_tiff(picture);
  const std::vector<std::string> known = image_extensions();
  if (std::find(known.begin(), known.end(), format) == known.end())
    throw UsageError("the image format '" + format + "' is not known");
  return encode_with_module(format, picture);
}

} // namespace fastrt
