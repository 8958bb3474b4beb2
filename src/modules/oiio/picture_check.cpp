// SPDX-License-Identifier: Apache-2.0
#include "src/modules/oiio/picture_check.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace fastrt {

namespace {

constexpr const char* ends_early = "the file ends early";

// The number of `size` bytes at `at`, the lowest first; 0 behind the end.
std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t number = 0;
  for (std::size_t i = size; i-- > 0;)
    number = number << 8U | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U);
  return number;
}

// Its palette's size is not looked at when colours are taken from it; and a file of a few bytes must not ask
// for a gigabyte: a packet of at least two bytes holds 128 pixels at most.
const char* fault_of_tga(std::string_view bytes) {
  constexpr std::size_t header = 18;
  constexpr std::uint32_t palette = 1, packed_palette = 9;
  if (bytes.size() < header) return ends_early;
  const std::uint32_t type = number_at(bytes, 2, 1);
  if (type == palette || type == packed_palette) return "TGA pictures with palettes are not supported";
  const std::size_t pixels = std::size_t{number_at(bytes, 12, 2)} * number_at(bytes, 14, 2);
  return pixels / 128 > bytes.size() ? ends_early : "";
}

// The headers and packings that it knows, and those of them that go together.
const char* fault_of_bmp(std::string_view bytes) {
  constexpr std::size_t file_header = 14;
  constexpr std::array<std::uint32_t, 6> header_sizes{12, 40, 52, 56, 108, 124};
  constexpr std::array<std::uint32_t, 6> depths{1, 4, 8, 16, 24, 32};
  enum : std::uint32_t { plain, packed_bytes, packed_halves, bit_fields };
  const std::uint32_t size = number_at(bytes, file_header, 4);
  if (bytes.size() < file_header + size) return ends_early;
  const bool is_old = size == header_sizes.front();
  const std::uint32_t depth = number_at(bytes, file_header + (is_old ? 10 : 14), 2);
  const std::uint32_t packing = is_old ? plain : number_at(bytes, file_header + 16, 4);
  const bool fits = packing == plain || (packing == packed_bytes && depth == 8) ||
                    (packing == packed_halves && depth == 4) ||
                    (packing == bit_fields && (depth == 16 || depth == 32));
  const auto knows = [](const auto& list, std::uint32_t value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  return knows(header_sizes, size) && knows(depths, depth) && fits
             ? ""
             : "BMP pictures of this kind are not supported";
}

} // namespace

const char* fault_of_picture(std::string_view format, std::string_view bytes) {
  if (format == "targa") return fault_of_tga(bytes);
  return format == "bmp" ? fault_of_bmp(bytes) : "";
}

} // namespace fastrt
