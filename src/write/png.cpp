// SPDX-License-Identifier: Apache-2.0
// PNG, 8 bits a channel. Stripes of rows are converted, filtered and compressed by themselves, in parallel;
// each becomes an IDAT chunk.
#include "src/write/checksum.hpp"
#include "src/write/deflate.hpp"
#include "src/write/formats.hpp"
#include "src/write/png_filter.hpp"
#include "src/write/stripes.hpp"

#include <cstdint>
#include <memory>
#include <utility>

namespace fastrt {

namespace {

constexpr std::size_t pixel = stripe_pixel_bytes;

void put_word(Bytes& out, std::uint32_t word) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) out.push_back(static_cast<unsigned char>(word >> shift));
}

// A chunk is its length, its name, its bytes, and the checksum of name and bytes.
std::size_t begin_chunk(Bytes& out, const char* name) {
  const std::size_t begin = out.size();
  put_word(out, 0);
  out.insert(out.end(), name, name + 4);
  return begin;
}

void end_chunk(Bytes& out, std::size_t begin) {
  const std::size_t size = out.size() - begin - 8;
  for (unsigned i = 0; i < 4; ++i) out[begin + i] = static_cast<unsigned char>(size >> (24 - 8 * i));
  put_word(out, crc32(out.data() + begin + 4, size + 4));
}

void begin_file(Bytes& out, const Picture& picture) {
  out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  std::size_t chunk = begin_chunk(out, "IHDR");
  put_word(out, static_cast<std::uint32_t>(picture.width));
  put_word(out, static_cast<std::uint32_t>(picture.height));
  out.insert(out.end(), {8, 2, 0, 0, 0}); // 8 bits, RGB, not interlaced
  end_chunk(out, chunk);
  chunk = begin_chunk(out, "sRGB");
  out.push_back(0); // perceptual
  end_chunk(out, chunk);
}

struct Stripe {
  Bytes chunk;
  std::uint32_t adler = 1;
  std::size_t byte_count = 0; // before compression
};

// Rows first..last, the last one not included.
Stripe encode_stripe(const Picture& picture, std::size_t first, std::size_t last) {
  const std::size_t row_bytes = pixel * static_cast<std::size_t>(picture.width);
  // Two rows by turns, each after the three zero bytes that the filters want.
  Bytes rows(2 * (row_bytes + pixel)), scratch(row_bytes);
  const std::size_t filtered_bytes = (row_bytes + 1) * (last - first);
  const auto filtered = std::make_unique_for_overwrite<unsigned char[]>(filtered_bytes);
  unsigned char *above = rows.data() + pixel, *row = above + row_bytes + pixel;
  if (first != 0) put_codes(picture, (first - 1) * row_bytes, row_bytes, above);
  for (std::size_t y = first; y < last; ++y) {
    put_codes(picture, y * row_bytes, row_bytes, row);
    filter_row(row, above, row_bytes, scratch.data(), filtered.get() + (y - first) * (row_bytes + 1));
    std::swap(row, above);
  }

  Stripe stripe;
  stripe.byte_count = filtered_bytes;
  stripe.adler = adler32(filtered.get(), filtered_bytes);
  const std::size_t chunk = begin_chunk(stripe.chunk, "IDAT");
  if (first == 0) stripe.chunk.insert(stripe.chunk.end(), {0x78, 0x01}); // zlib's header (RFC 1950)
  deflate_piece(filtered.get(), filtered_bytes, stripe.chunk);
  end_chunk(stripe.chunk, chunk);
  return stripe;
}

} // namespace

Bytes encode_png(const Picture& picture) {
  const auto stripes = encode_stripes<Stripe>(
      picture, [&](std::size_t first, std::size_t last) { return encode_stripe(picture, first, last); });
  Bytes out;
  std::size_t size = 256;
  for (const Stripe& stripe : stripes) size += stripe.chunk.size();
  out.reserve(size);
  begin_file(out, picture);
  std::uint32_t adler = 1;
  for (const Stripe& stripe : stripes) {
    out.insert(out.end(), stripe.chunk.begin(), stripe.chunk.end());
    adler = adler32_combine(adler, stripe.adler, stripe.byte_count);
  }
  const std::size_t last = begin_chunk(out, "IDAT");
  deflate_end(out);
  put_word(out, adler);
  end_chunk(out, last);
  end_chunk(out, begin_chunk(out, "IEND"));
  return out;
}

} // namespace fastrt
