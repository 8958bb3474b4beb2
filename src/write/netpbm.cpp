// SPDX-License-Identifier: Apache-2.0
// PPM (8 bits a channel, sRGB) and PFM (linear floats).
#include "src/scene/threads.hpp"
#include "src/write/formats.hpp"

#include <bit>
#include <cstring>

namespace fastrt {

namespace {

static_assert(std::endian::native == std::endian::little, "PFM is written in this machine's byte order");

Bytes with_header(const std::string& header, std::size_t body_bytes) {
  Bytes out(header.size() + body_bytes);
  std::memcpy(out.data(), header.data(), header.size());
  return out;
}

std::string size_line(const Picture& picture) {
  return std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n";
}

} // namespace

Bytes encode_ppm(const Picture& picture) {
  const std::string header = "P6\n" + size_line(picture) + "255\n";
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  const std::ptrdiff_t height = picture.height;
  Bytes out = with_header(header, row * static_cast<std::size_t>(height));
  unsigned char* body = out.data() + header.size();
#pragma omp parallel for schedule(static) num_threads(thread_count(picture.threads))
  for (std::ptrdiff_t y = 0; y < height; ++y) {
    const std::size_t begin = static_cast<std::size_t>(y) * row;
    put_codes(picture, begin, row, body + begin);
  }
  return out;
}

Bytes encode_pfm(const Picture& picture) {
  const std::string header = "PF\n" + size_line(picture) + "-1.0\n"; // negative: little endian
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  const auto height = static_cast<std::size_t>(picture.height);
  Bytes out = with_header(header, row * height * sizeof(float));
  unsigned char* body = out.data() + header.size();
  for (std::size_t y = 0; y < height; ++y) // the bottom row first
    std::memcpy(body + y * row * sizeof(float), picture.linear + (height - 1 - y) * row, row * sizeof(float));
  return out;
}

} // namespace fastrt
