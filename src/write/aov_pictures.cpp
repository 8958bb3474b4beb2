// SPDX-License-Identifier: Apache-2.0
// AOVs as pictures.
#include "src/film/srgb.hpp"
#include "src/write/codes.hpp"
#include "src/write/ranges.hpp"
#include "src/write/stored_ids.hpp"

#include <fastrt/write.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace fastrt {
namespace {

std::size_t pixel_count(const AovPlane& plane) {
  return std::max(plane.ids.size(), plane.values.size()) /
         static_cast<std::size_t>(aov_info(plane.aov).channels);
}

// Of shown(value), for all values of a plane with one channel.
template <class Shown>
Range range_of(const AovPlane& plane, int threads, const Shown& shown) {
  return ranges_of_pixels(pixel_count(plane), threads, [&](std::size_t pixel, Ranges& ranges) {
    ranges[0].add(shown(plane.values.empty() ? static_cast<float>(plane.ids[pixel]) : plane.values[pixel]));
  })[0];
}

// A share of 255 as a code; 0 for NaN.
unsigned char code_of_share(float share) {
  const float code = std::floor(255.0F * share + 0.5F);
  return static_cast<unsigned char>(code >= 0.0F ? std::min(code, 255.0F) : 0.0F);
}

using Codes = std::vector<unsigned char>;

// share(value, channel) of all three values, or black where they are 0: there nothing is seen.
template <class Share>
Codes codes_of_vectors(const AovPlane& plane, int threads, const Share& share) {
  return codes_of_pixels(pixel_count(plane), threads, [&](std::size_t pixel, unsigned char* codes) {
    const float* const v = &plane.values[3 * pixel];
    if (is_zero(v)) return;
    for (std::size_t c = 0; c < 3; ++c) codes[c] = code_of_share(share(v[c], c));
  });
}

// Greys: share(pixel).
template <class Share>
Codes greys(const AovPlane& plane, int threads, const Share& share) {
  return codes_of_pixels(pixel_count(plane), threads, [&](std::size_t pixel, unsigned char* codes) {
    std::fill_n(codes, 3, code_of_share(share(pixel)));
  });
}

Codes packed_ids(const AovPlane& plane, int threads) {
  return codes_of_pixels(plane.ids.size(), threads, [&](std::size_t pixel, unsigned char* codes) {
    const std::uint32_t id = stored_id(plane.aov, plane.ids[pixel]);
    for (unsigned c = 0; c < 3; ++c) codes[c] = static_cast<unsigned char>(id >> (8 * c));
  });
}

Codes counts(const AovPlane& plane, int threads) {
  Range range = range_of(plane, threads, [](float count) { return count; });
  range.add(0.0F);
  return greys(plane, threads,
               [&](std::size_t pixel) { return range.place(static_cast<float>(plane.ids[pixel])); });
}

// Near is bright; what is seen is never black. By 1 / depth, or a plane's horizon would leave nothing for the
// rest.
Codes depths(const AovPlane& plane, int threads) {
  const auto nearness = [](float depth) { return std::isfinite(depth) ? 1.0F / depth : infinity; };
  const Range range = range_of(plane, threads, nearness);
  return greys(plane, threads, [&](std::size_t pixel) {
    const float depth = plane.values[pixel];
    if (!std::isfinite(depth)) return 0.0F;
    return range.high > range.low ? 0.1F + 0.9F * range.place(nearness(depth)) : 1.0F;
  });
}

Codes fractions(const AovPlane& plane, int threads) {
  return codes_of_pixels(pixel_count(plane), threads, [&](std::size_t pixel, unsigned char* codes) {
    for (std::size_t c = 0; c < 2; ++c) {
      const float value = plane.values[2 * pixel + c];
      codes[c] = code_of_share(value - std::floor(value));
    }
  });
}

// Light already.
Codes colors(const AovPlane& plane, int threads) {
  Codes codes(plane.values.size());
  for_pieces(pixel_count(plane), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    to_srgb8(&plane.values[3 * first], 3 * (last - first), &codes[3 * first]);
  });
  return codes;
}

} // namespace

std::vector<unsigned char> aov_picture(const AovPlane& plane, int threads) {
  switch (plane.aov) {
  case Aov::id:
  case Aov::primitive:
  case Aov::material:
    return packed_ids(plane, threads);
  case Aov::depth:
    return depths(plane, threads);
  case Aov::normal:
    return codes_of_vectors(plane, threads, [](float x, std::size_t) { return 0.5F * x + 0.5F; });
  case Aov::position:
    return codes_of_vectors(plane, threads,
                            [ranges = ranges_of_positions(plane.values, threads)](float x, std::size_t c) {
                              return ranges[c].place(x);
                            });
  case Aov::uv:
    return fractions(plane, threads);
  case Aov::albedo:
    return colors(plane, threads);
  case Aov::shadow:
    return codes_of_vectors(plane, threads, [](float x, std::size_t) { return x; });
  case Aov::recursion:
  case Aov::cost:
    break;
  }
  return counts(plane, threads);
}

} // namespace fastrt
