// SPDX-License-Identifier: Apache-2.0
// A tile on its way into a frame of 8-bit codes: it is rendered as a frame of its own, which stays in the
// cache, so that no linear colour of the picture ever goes to memory.
#pragma once

#include "src/film/srgb.hpp"
#include "src/trace/tile_job.hpp"

#include <algorithm>
#include <cstddef>

namespace fastrt {

class Srgb8Tile {
public:
  // The same tile as all of a frame.
  TileJob alone(const TileJob& tile) {
    TileJob job = tile;
    job.x_begin = tile.x;
    job.y_begin = tile.y;
    job.x_end = std::min(tile.x + tile_side, tile.x_end);
    job.y_end = std::min(tile.y + tile_side, tile.y_end);
    job.rgb = rgb_;
    job.primitive = primitive_;
    return job;
  }

  // Puts what became of alone(tile) to its place among the codes of tile's frame.
  void put(const TileJob& tile, unsigned char* codes) const {
    const int width = std::min(tile_side, tile.x_end - tile.x),
              height = std::min(tile_side, tile.y_end - tile.y);
    const auto row = static_cast<std::size_t>(3 * width);
    for (int y = 0; y < height; ++y) {
      const std::ptrdiff_t pixel =
          std::ptrdiff_t{tile.y - tile.y_begin + y} * (tile.x_end - tile.x_begin) + (tile.x - tile.x_begin);
      to_srgb8(rgb_ + static_cast<std::size_t>(y) * row, row, codes + 3 * pixel);
    }
  }

private:
  float rgb_[3 * batch_size];
  std::int32_t primitive_[batch_size];
};

} // namespace fastrt
