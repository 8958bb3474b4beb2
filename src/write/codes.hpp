// SPDX-License-Identifier: Apache-2.0
// Pictures of sRGB codes that are made piece by piece, in parallel.
#pragma once

#include "src/scene/threads.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fastrt {

inline constexpr std::size_t pixels_in_piece = 4096;

inline std::size_t piece_count(std::size_t pixels) {
  return (pixels + pixels_in_piece - 1) / pixels_in_piece;
}

// Calls act(piece, first, last) for all pieces: pixels first .. last - 1. It must not throw.
template <class Act>
void for_pieces(std::size_t pixels, int threads, const Act& act) {
  const std::size_t count = piece_count(pixels);
#pragma omp parallel for schedule(static) num_threads(thread_count(threads)) if (count > 1)
  for (std::size_t piece = 0; piece < count; ++piece)
    act(piece, piece * pixels_in_piece, std::min(pixels, (piece + 1) * pixels_in_piece));
}

// Three codes a pixel: write(pixel, codes) says which.
template <class Write>
std::vector<unsigned char> codes_of_pixels(std::size_t pixels, int threads, const Write& write) {
  std::vector<unsigned char> codes(3 * pixels);
  for_pieces(pixels, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t pixel = first; pixel < last; ++pixel) write(pixel, codes.data() + 3 * pixel);
  });
  return codes;
}

} // namespace fastrt
