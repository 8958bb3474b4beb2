// SPDX-License-Identifier: Apache-2.0
// TIFF 6.0, 8 bits a channel: strips with horizontal prediction, each a zlib stream. By hand, because
// OpenImageIO 2.4's writer fails on the Exif directory that it adds by itself.
#include "src/write/checksum.hpp"
#include "src/write/deflate.hpp"
#include "src/write/formats.hpp"
#include "src/write/stripes.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace fastrt {

namespace {

constexpr std::size_t pixel = stripe_pixel_bytes;

// Little endian, as the file's first two bytes say.
void put(Bytes& out, std::uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) out.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

std::uint32_t offset_of(const Bytes& out) {
  if (out.size() > std::numeric_limits<std::uint32_t>::max())
    throw OutputError("the picture is too large for TIFF; write png, exr or pfm");
  return static_cast<std::uint32_t>(out.size());
}

Bytes encode_strip(const Picture& picture, std::size_t first, std::size_t last) {
  const std::size_t row_bytes = pixel * static_cast<std::size_t>(picture.width);
  Bytes row(row_bytes), differences(row_bytes * (last - first));
  for (std::size_t y = first; y < last; ++y) {
    put_codes(picture, y * row_bytes, row_bytes, row.data());
    unsigned char* out = differences.data() + (y - first) * row_bytes;
    std::copy_n(row.begin(), pixel, out);
    for (std::size_t i = pixel; i < row_bytes; ++i)
      out[i] = static_cast<unsigned char>(row[i] - row[i - pixel]);
  }
  Bytes strip = {0x78, 0x01}; // zlib's header (RFC 1950)
  deflate_piece(differences.data(), differences.size(), strip);
  deflate_end(strip);
  const std::uint32_t adler = adler32(differences.data(), differences.size());
  for (const unsigned shift : {24U, 16U, 8U, 0U}) strip.push_back(static_cast<unsigned char>(adler >> shift));
  return strip;
}

enum Type : std::uint16_t { short_type = 3, long_type = 4, rational_type = 5 };

struct Field {
  std::uint16_t tag;
  Type type;
  std::uint32_t count, value; // value: or where the values are
};

// Puts the words into the file; returns what a field of them holds.
std::uint32_t put_words(Bytes& out, const std::vector<std::uint32_t>& words) {
  if (words.size() == 1) return words[0];
  const std::uint32_t offset = offset_of(out);
  for (const std::uint32_t word : words) put(out, word, 4);
  return offset;
}

} // namespace

Bytes encode_tiff(const Picture& picture) {
  const auto rows = static_cast<std::uint32_t>(rows_per_stripe(picture));
  const auto strips = encode_stripes<Bytes>(
      picture, [&](std::size_t first, std::size_t last) { return encode_strip(picture, first, last); });
  Bytes out = {'I', 'I', 42, 0, 0, 0, 0, 0};
  std::vector<std::uint32_t> offsets, sizes;
  for (const Bytes& strip : strips) {
    offsets.push_back(offset_of(out));
    sizes.push_back(static_cast<std::uint32_t>(strip.size()));
    out.insert(out.end(), strip.begin(), strip.end());
  }
  if (out.size() % 2 != 0) out.push_back(0); // what follows starts at even places

  const std::uint32_t depths = offset_of(out);
  for (int channel = 0; channel < 3; ++channel) put(out, 8, 2);
  const std::uint32_t resolution = offset_of(out);
  put(out, 1, 4), put(out, 1, 4);
  const auto strip_count = static_cast<std::uint32_t>(strips.size());
  const std::uint32_t offset_field = put_words(out, offsets), size_field = put_words(out, sizes);
  const Field fields[] = {{256, long_type, 1, static_cast<std::uint32_t>(picture.width)},
                          {257, long_type, 1, static_cast<std::uint32_t>(picture.height)},
                          {258, short_type, 3, depths},
                          {259, short_type, 1, 8}, // deflate
                          {262, short_type, 1, 2}, // RGB
                          {273, long_type, strip_count, offset_field},
                          {277, short_type, 1, 3},
                          {278, long_type, 1, rows},
                          {279, long_type, strip_count, size_field},
                          {282, rational_type, 1, resolution},
                          {283, rational_type, 1, resolution},
                          {284, short_type, 1, 1},  // the channels of a pixel together
                          {296, short_type, 1, 1},  // resolution without a unit
                          {317, short_type, 1, 2}}; // horizontal prediction
  const std::uint32_t directory = offset_of(out);
  put(out, std::size(fields), 2);
  for (const Field& field : fields)
    put(out, field.tag, 2), put(out, field.type, 2), put(out, field.count, 4), put(out, field.value, 4);
  put(out, 0, 4); // no other picture
  for (unsigned i = 0; i < 4; ++i) out[4 + i] = static_cast<unsigned char>(directory >> (8 * i));
  return out;
}

} // namespace fastrt
