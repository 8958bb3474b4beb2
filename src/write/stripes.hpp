// SPDX-License-Identifier: Apache-2.0
// Pictures in stripes of rows that are encoded by themselves, in parallel.
#pragma once

#include "src/scene/threads.hpp"
#include "src/write/formats.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace fastrt {

inline constexpr std::size_t stripe_pixel_bytes = 3; // 8 bits a channel

// How many rows make about 128 KB; the picture alone decides, so that the file does not depend on the
// threads.
inline std::size_t rows_per_stripe(const Picture& picture) {
  const std::size_t row_bytes = stripe_pixel_bytes * static_cast<std::size_t>(picture.width);
  return std::max<std::size_t>(1, (std::size_t{128} << 10U) / row_bytes);
}

// What encode(first, last) makes of the rows first .. last - 1 of each stripe, from the top.
template <class Stripe, class Encode>
std::vector<Stripe> encode_stripes(const Picture& picture, const Encode& encode) {
  const std::size_t rows = rows_per_stripe(picture), height = static_cast<std::size_t>(picture.height);
  std::vector<Stripe> stripes((height + rows - 1) / rows);
  const auto count = static_cast<std::ptrdiff_t>(stripes.size());
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) num_threads(thread_count(picture.threads)) if (count > 1)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    try {
      const std::size_t first = static_cast<std::size_t>(i) * rows;
      stripes[static_cast<std::size_t>(i)] = encode(first, std::min(height, first + rows));
    } catch (...) {
#pragma omp critical(fastrt_encode_stripes)
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  return stripes;
}

} // namespace fastrt
