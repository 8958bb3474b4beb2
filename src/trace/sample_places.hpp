// SPDX-License-Identifier: Apache-2.0
// Where samples lie on the image and on the lens (src/film/sampling.hpp), a batch at a time: in loops that
// compilers make SIMD of.
#pragma once

#include "src/film/sampling.hpp"
#include "src/kernels/vec3.hpp"
#include "src/trace/tile_places.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

using CameraF = Floats<widest>;
using CameraV = V3<CameraF>;

// Where rays go through the image and the lens.
struct alignas(64) SamplePlaces {
  float px[batch_size], py[batch_size];
  float lens_a[batch_size], lens_b[batch_size];
};

// Where the pixels of a group of 4 x 4 lie in it.
struct alignas(64) GroupPixels {
  std::int32_t x[group_size], y[group_size];
};
inline constexpr GroupPixels group_pixels = [] {
  GroupPixels pixels{};
  for (int i = 0; i < group_size; ++i) {
    pixels.x[i] = tile_pixel_x(i);
    pixels.y[i] = tile_pixel_y(i);
  }
  return pixels;
}();

FASTRT_INLINE void place_all_centers(const TileJob& job, SamplePlaces& to) {
  const CameraF half(0.5F);
  for (int i = 0; i < batch_size; i += widest) {
    const int group = i / group_size * group_size, k = i % group_size;
    const Ints<widest> x =
        Ints<widest>::load_aligned(group_pixels.x + k) + Ints<widest>(picture_x(job, group));
    const Ints<widest> y =
        Ints<widest>::load_aligned(group_pixels.y + k) + Ints<widest>(picture_y(job, group));
    (simd::to_float(x) + half).store_aligned(to.px + i);
    (simd::to_float(y) + half).store_aligned(to.py + i);
  }
}

FASTRT_INLINE void place_centers(const TileJob& job, const TileScratch& scratch, SamplePlaces& to) {
  if (scratch.place_count == batch_size) return place_all_centers(job, to);
  for (int i = 0; i < scratch.place_count; ++i) {
    to.px[i] = static_cast<float>(picture_x(job, scratch.places[i])) + 0.5F;
    to.py[i] = static_cast<float>(picture_y(job, scratch.places[i])) + 0.5F;
  }
}

// Samples of pixels row by row: the pixels, and what each takes of its sample's set. The sets follow each
// other again and again.
struct alignas(64) PixelSamples {
  std::uint32_t x[batch_size], y[batch_size];
  std::uint32_t u[batch_size], v[batch_size], shift[batch_size], index[batch_size];
  SampleSet sets[batch_size];
  int set_count, count;
};

// Samples first .. first + samples - 1 in turn, of the pixels in these places of the tile.
FASTRT_INLINE void make_pixel_samples(const TileJob& job, const std::int32_t* places, int count, int first,
                                      int samples, PixelSamples& rows) {
  const auto left = static_cast<std::uint32_t>(job.x), top = static_cast<std::uint32_t>(job.y);
  for (int i = 0; i < count; ++i) {
    rows.x[i] = left + static_cast<std::uint32_t>(tile_pixel_x(places[i]));
    rows.y[i] = top + static_cast<std::uint32_t>(tile_pixel_y(places[i]));
  }
  for (int k = 0; k < samples; ++k) {
    const SampleSet set = sample_set(static_cast<std::uint32_t>(first + k), job.filter, job.seed);
    rows.sets[k] = set;
    rows.u[k] = set.point.u;
    rows.v[k] = set.point.v;
    rows.shift[k] = set.lobe ? lobe_shift : 0U;
    rows.index[k] = set.index;
  }
  for (int i = samples; i < count; ++i) {
    rows.u[i] = rows.u[i - samples];
    rows.v[i] = rows.v[i - samples];
    rows.shift[i] = rows.shift[i - samples];
    rows.index[i] = rows.index[i - samples];
  }
  rows.set_count = samples;
  rows.count = count;
}

// Points of the unit square.
struct alignas(64) UnitPlaces {
  float u[batch_size], v[batch_size];
};

FASTRT_INLINE void find_unit_places(const PixelSamples& rows, std::uint32_t seed, UnitPlaces& out) {
  for (int i = 0; i < rows.count; ++i) {
    const std::uint32_t key = pixel_key(rows.x[i], rows.y[i], seed) + rows.shift[i];
    const UnitPlace place = unit_place({rows.u[i], rows.v[i]}, key);
    out.u[i] = place.u;
    out.v[i] = place.v;
  }
}

// offset_of(row): from the pixel's centre.
template <class OffsetOf>
FASTRT_INLINE void place_by(const PixelSamples& rows, SamplePlaces& to, const OffsetOf& offset_of) {
  for (int i = 0; i < rows.count; ++i) {
    const SampleOffset offset = offset_of(i);
    to.px[i] = (static_cast<float>(static_cast<std::int32_t>(rows.x[i])) + 0.5F) + offset.x;
    to.py[i] = (static_cast<float>(static_cast<std::int32_t>(rows.y[i])) + 0.5F) + offset.y;
  }
}

static void place_on_image(const PixelSamples& rows, const Filter& filter, std::uint32_t seed,
                           SamplePlaces& to) noexcept {
  UnitPlaces units;
  find_unit_places(rows, seed, units);
  const auto unit = [&](int i) { return UnitPlace{units.u[i], units.v[i]}; };
  if (filter.shape == FilterShape::tent)
    place_by(rows, to, [&](int i) { return filtered<FilterShape::tent>(unit(i)); });
  else if (filter.shape == FilterShape::box)
    place_by(rows, to, [&](int i) { return filtered<FilterShape::box>(unit(i)); });
  else
    place_by(rows, to, [&](int i) { return filtered_by_table(rows.sets[i % rows.set_count], unit(i)); });
}

static void place_on_lens(const PixelSamples& rows, std::uint32_t seed, SamplePlaces& to) noexcept {
  alignas(64) std::uint32_t key[batch_size], u[batch_size], v[batch_size], bits[batch_size];
  for (int i = 0; i < rows.count; ++i) {
    key[i] = lens_key(rows.x[i], rows.y[i], seed);
    bits[i] = u[i] = lens_index(rows.index[i], key[i]);
    v[i] = 0;
  }
  // sequence_point(), bit by bit for all rows. (Shifts by one: not all registers shift by a number that is
  // found out as it runs.)
  std::uint32_t column = 1;
  for (int bit = 0; bit < 32; ++bit, column ^= column << 1U)
    for (int i = 0; i < rows.count; ++i) {
      v[i] ^= (0U - (bits[i] & 1U)) & column;
      bits[i] >>= 1U;
    }
  for (int i = 0; i < rows.count; ++i) {
    const SampleOffset place = lens_place({u[i], v[i]}, key[i]);
    to.lens_a[i] = place.x;
    to.lens_b[i] = place.y;
  }
}

// Row i is of the pixel in place places[i]; its samples first .. first + samples - 1 follow each other in
// rows.
FASTRT_INLINE void place_samples(const TileJob& job, const std::int32_t* places, int count, int first,
                                 int samples, SamplePlaces& to) {
  PixelSamples rows;
  make_pixel_samples(job, places, count, first, samples, rows);
  place_on_image(rows, job.filter, job.seed, to);
  if (job.camera.kind == CameraKind::lens) place_on_lens(rows, job.seed, to);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
