// SPDX-License-Identifier: Apache-2.0
#include "src/film/srgb.hpp"
#include "src/write/formats.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace fastrt {

namespace {

void check_picture(std::size_t values, int width, int height) {
  if (width < 1 || height < 1) throw UsageError("a picture needs a width and a height of at least 1");
  if (values != 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw UsageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels needs three values for each, not " + std::to_string(values) + " in all");
}

void check_format(const std::string& format) {
  const std::vector<std::string> known = image_extensions();
  if (std::find(known.begin(), known.end(), format) == known.end())
    throw UsageError("the image format '" + format + "' is not known");
}

Bytes encode(const std::string& format, const Picture& picture) {
  check_picture_size(format, picture.width, picture.height);
  if (format == "png") return encode_png(picture);
  if (format == "ppm") return encode_ppm(picture);
  if (format == "pfm") return encode_pfm(picture);
  if (is_tiff(format)) return encode_tiff(picture);
  if (format == "exr") return encode_exr(picture);
  return encode_with_module(format, picture);
}

} // namespace

std::vector<std::string> image_extensions() {
  return {"png", "ppm", "pfm", "exr", "jpg", "jpeg", "tif", "tiff", "hdr"};
}

void check_picture_size(const std::string& format, int width, int height) {
  constexpr int most_of_jpeg = 65500; // JPEG_MAX_DIMENSION of libjpeg
  if (is_jpeg(format) && (width > most_of_jpeg || height > most_of_jpeg))
    throw OutputError("a JPEG picture has at most 65500 pixels on a side");
  // Places in the file are 32-bit numbers. Noise gets no smaller by compression, but larger by less than 2 %:
  // a strip has 64 KiB or more, half a KiB before it, and a code of its own.
  constexpr std::int64_t most_of_tiff = 1'400'000'000;
  if (is_tiff(format) && std::int64_t{width} * height > most_of_tiff)
    throw OutputError("a TIFF picture has at most 1400 million pixels; write png, exr or pfm");
}

bool is_8bit_format(const std::string& format) {
  constexpr const char* formats[] = {"png", "ppm", "jpg", "jpeg", "tif", "tiff"};
  return std::find(std::begin(formats), std::end(formats), format) != std::end(formats);
}

std::vector<unsigned char> encode_image(const std::string& format, std::span<const float> rgb, int width,
                                        int height, int threads) {
  check_picture(rgb.size(), width, height);
  check_format(format);
  return encode(format, {rgb.data(), nullptr, width, height, threads});
}

std::vector<unsigned char> encode_image(const std::string& format, std::span<const unsigned char> srgb8,
                                        int width, int height, int threads) {
  check_picture(srgb8.size(), width, height);
  check_format(format);
  if (!is_8bit_format(format))
    throw UsageError("the image format '" + format + "' holds linear values, not 8-bit codes");
  return encode(format, {nullptr, srgb8.data(), width, height, threads});
}

void put_codes(const Picture& picture, std::size_t first, std::size_t count, unsigned char* codes) {
  if (picture.linear != nullptr)
    to_srgb8(picture.linear + first, count, codes);
  else
    std::memcpy(codes, picture.srgb8 + first, count);
}

} // namespace fastrt
