// SPDX-License-Identifier: Apache-2.0
// OpenEXR's library compresses with zlib; libdeflate makes streams of the same kind and size in less than
// half the time (docs/architecture.md, "The file").
#include "src/modules/openexr/zip.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>

namespace fastrt {

namespace {

constexpr int level = 1; // higher ones take longer and gain nothing on rendered floats

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

// What a thread needs to make chunks.
struct Workshop {
  explicit Workshop(std::size_t bytes)
      : compressor(libdeflate_alloc_compressor(level)), rows(bytes), halves(bytes), differences(bytes),
        compressed(bytes) {
    if (compressor == nullptr) throw std::bad_alloc();
  }
  std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor;
  std::vector<unsigned char> rows, halves, differences, compressed;
};

// Rows first .. last - 1, each channel after the other in every row. Returns the number of bytes.
std::size_t gather_rows(const LayersToEncode& layers, const std::vector<LayerChannel>& channels, int first,
                        int last, unsigned char* out) {
  const auto width = static_cast<std::size_t>(layers.width);
  unsigned char* const begin = out;
  for (int y = first; y < last; ++y)
    for (const LayerChannel& channel : channels) {
      const auto* values = static_cast<const unsigned char*>(channel.values) +
                           4 * channel.stride * width * static_cast<std::size_t>(y);
      for (std::size_t x = 0; x < width; ++x) std::memcpy(out + 4 * x, values + 4 * channel.stride * x, 4);
      out += 4 * width;
    }
  return static_cast<std::size_t>(out - begin);
}

// The bytes at even places and then those at odd ones: of numbers that are alike, equal bytes come together.
void split_halves(const unsigned char* bytes, std::size_t count, unsigned char* out) {
  unsigned char* const odd = out + count / 2;
  for (std::size_t i = 0; i < count / 2; ++i) {
    out[i] = bytes[2 * i];
    odd[i] = bytes[2 * i + 1];
  }
}

// Each byte as its difference to the one before, 128 if it is the same.
void differ(const unsigned char* bytes, std::size_t count, unsigned char* out) {
  out[0] = bytes[0];
  for (std::size_t i = 1; i < count; ++i) out[i] = static_cast<unsigned char>(bytes[i] - bytes[i - 1] + 128);
}

// Rows that don't become smaller stay as they are.
std::vector<unsigned char> make_chunk(const LayersToEncode& layers, const std::vector<LayerChannel>& channels,
                                      int first, Workshop& shop) {
  const int last = std::min(layers.height, first + rows_in_chunk);
  const std::size_t count = gather_rows(layers, channels, first, last, shop.rows.data());
  split_halves(shop.rows.data(), count, shop.halves.data());
  differ(shop.halves.data(), count, shop.differences.data());
  const std::size_t size = libdeflate_zlib_compress(shop.compressor.get(), shop.differences.data(), count,
                                                    shop.compressed.data(), count - 1);
  const std::vector<unsigned char>& best = size != 0 ? shop.compressed : shop.rows;
  return {best.data(), best.data() + (size != 0 ? size : count)};
}

} // namespace

std::vector<std::vector<unsigned char>> zip_chunks(const LayersToEncode& layers,
                                                   const std::vector<LayerChannel>& channels) {
  const std::size_t most_bytes =
      4 * channels.size() * static_cast<std::size_t>(layers.width) * std::size_t{rows_in_chunk};
  const int count = (layers.height + rows_in_chunk - 1) / rows_in_chunk;
  std::vector<std::vector<unsigned char>> chunks(static_cast<std::size_t>(count));
  bool enough_memory = true;
#pragma omp parallel num_threads(std::min(layers.threads, count))
  {
    std::unique_ptr<Workshop> shop;
    try {
      shop = std::make_unique<Workshop>(most_bytes);
    } catch (const std::bad_alloc&) {
    }
#pragma omp for schedule(dynamic) reduction(&& : enough_memory)
    for (int i = 0; i < count; ++i) {
      try {
        if (!shop) throw std::bad_alloc();
        chunks[static_cast<std::size_t>(i)] = make_chunk(layers, channels, i * rows_in_chunk, *shop);
      } catch (const std::bad_alloc&) {
        enough_memory = false;
      }
    }
  }
  if (!enough_memory) throw std::bad_alloc();
  return chunks;
}

} // namespace fastrt
