// SPDX-License-Identifier: Apache-2.0
// What photons that met mirrors or glass bring to the surfaces of a batch (docs/numerics.md, "Caustics"). A
// surface looks into the nine rows of three cells around it, in the order in which the photons lie.
#pragma once

#include "src/film/photon_sampling.hpp"
#include "src/trace/lighting.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The light of the photons around one point: photon i of a level is added to sum i modulo photon_sums.
struct PhotonSums {
  PathV parts[photon_sums / widest];
};

// The cell that a coordinate lies in, or the one before the first or after the last.
FASTRT_INLINE int photon_cell(const PhotonLevelView& level, float x, int axis) {
  const float at = (x - level.low[axis]) * level.inverse_side + 1.0F;
  const auto size = static_cast<float>(level.size[axis]);
  return static_cast<int>(at > 0.0F ? (at < size + 1.0F ? at : size + 1.0F) : 0.0F) - 1;
}

// The first photon of begin .. end - 1 whose cell is not before `cell`.
FASTRT_INLINE std::uint32_t first_from_cell(const PhotonLevelView& level, std::uint32_t begin,
                                            std::uint32_t end, int cell) {
  while (begin < end) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    if (level.cell_x[middle] < cell)
      begin = middle + 1;
    else
      end = middle;
  }
  return begin;
}

FASTRT_INLINE PathV load_columns(const float* const (&columns)[3], std::uint32_t i) {
  return load3<PathF>(columns[0] + i, columns[1] + i, columns[2] + i);
}

// Adds those of photons i .. in `bits` that are near the point and on its surface.
FASTRT_INLINE void add_photons(const PhotonLevelView& level, std::uint32_t i, std::uint32_t bits,
                               const PathV& point, const PathV& normal, PathV& sum) {
  const PathV way = load_columns(level.point, i) - point;
  const PathF d2 = dot(way, way);
  bits &= to_bits(d2 < PathF(level.radius2));
  if (bits == 0) return;
  const PathV other = load_columns(level.normal, i);
  const PathF height = dot(way, other);
  const PathM near = from_bits<widest>(bits) & (height * height < PathF(level.height2)) &
                     (dot(other, normal) > PathF(same_surface));
  const PathF share = PathF(1.0F) - d2 * PathF(level.inverse_radius2);
  sum = select(near, sum + load_columns(level.flux, i) * share, sum);
}

// Photons begin .. end - 1.
FASTRT_INLINE void add_run(const PhotonLevelView& level, std::uint32_t begin, std::uint32_t end,
                           const PathV& point, const PathV& normal, PhotonSums& sums) {
  for (std::uint32_t i = begin & ~(photon_sums - 1U); i < end; i += photon_sums) {
    std::uint32_t bits = (1U << photon_sums) - 1U;
    if (i < begin) bits &= ~0U << (begin - i);
    if (end - i < photon_sums) bits &= ~(~0U << (end - i));
    for (std::uint32_t part = 0; part < photon_sums / widest; ++part)
      add_photons(level, i + part * widest, bits >> (part * widest) & register_bits, point, normal,
                  sums.parts[part]);
  }
}

inline constexpr int no_cell = -2;

// The photons of a level around a cell: runs of those in the rows of cells next to it. Neighbouring surfaces
// often lie in one cell.
struct PhotonRuns {
  int x, y, z; // the cell; x: no_cell before the first
  int count;
  std::uint32_t begin[9], end[9];
};

[[gnu::noinline]] static void find_runs(const PhotonLevelView& level, PhotonRuns& runs) noexcept {
  const int x = runs.x, y = runs.y, z = runs.z;
  runs.count = 0;
  for (int row_z = z > 0 ? z - 1 : 0; row_z <= z + 1 && row_z < level.size[2]; ++row_z)
    for (int row_y = y > 0 ? y - 1 : 0; row_y <= y + 1 && row_y < level.size[1]; ++row_y) {
      const std::uint32_t* const row = level.row_begin + static_cast<long>(row_z) * level.size[1] + row_y;
      const std::uint32_t begin = first_from_cell(level, row[0], row[1], x - 1);
      const std::uint32_t end = first_from_cell(level, begin, row[1], x + 2);
      if (begin == end) continue;
      runs.begin[runs.count] = begin;
      runs.end[runs.count++] = end;
    }
}

// runs: of the level's last surface.
FASTRT_INLINE void add_level(const PhotonLevelView& level, const SurfaceBatch& s, int i, PhotonRuns& runs,
                             PhotonSums& sums) {
  const float p[3] = {s.point_x[i], s.point_y[i], s.point_z[i]};
  for (int axis = 0; axis < 3; ++axis)
    if (!(p[axis] >= level.low[axis] - level.radius && p[axis] <= level.high[axis] + level.radius)) return;
  const int x = photon_cell(level, p[0], 0), y = photon_cell(level, p[1], 1), z = photon_cell(level, p[2], 2);
  if (x != runs.x || y != runs.y || z != runs.z) {
    runs.x = x;
    runs.y = y;
    runs.z = z;
    find_runs(level, runs);
  }
  if (runs.count == 0) return;
  const PathV point = broadcast3<PathF>(p);
  const PathV normal = broadcast3<PathF>(s.geometric_x[i], s.geometric_y[i], s.geometric_z[i]);
  for (int k = 0; k < runs.count; ++k) add_run(level, runs.begin[k], runs.end[k], point, normal, sums);
}

// The sums of all levels, added up from the first to the last.
FASTRT_INLINE void add_up(const PhotonMapView& map, const SurfaceBatch& s, int i, int lane, PhotonRuns* runs,
                          float (&light)[3][widest]) {
  PhotonSums sums;
  for (PathV& part : sums.parts) part = broadcast3<PathF>(0.0F, 0.0F, 0.0F);
  for (int k = 0; k < map.level_count; ++k) add_level(map.levels[k], s, i + lane, runs[k], sums);
  alignas(64) float columns[3][photon_sums];
  for (std::uint32_t part = 0; part < photon_sums / widest; ++part)
    store3(sums.parts[part], columns[0] + part * widest, columns[1] + part * widest,
           columns[2] + part * widest);
  for (int c = 0; c < 3; ++c) {
    light[c][lane] = columns[c][0];
    for (std::uint32_t k = 1; k < photon_sums; ++k) light[c][lane] = light[c][lane] + columns[c][k];
  }
}

// L = L + Kd * sum, for the surfaces that answer light.
static void gather_caustics(const TileJob& job, const PathBatch& rays, TileScratch& scratch) noexcept {
  const PhotonMapView& map = *job.caustics;
  SurfaceBatch& s = scratch.surface;
  PhotonRuns runs[photon_radii];
  for (int k = 0; k < map.level_count; ++k) runs[k].x = no_cell;
  for (int i = 0; i < rays.count; i += widest) {
    const std::uint32_t bits = s.shaded[i / widest];
    if (bits == 0) continue;
    alignas(64) float sums[3][widest] = {};
    for (std::uint32_t b = bits; b != 0; b &= b - 1) add_up(map, s, i, __builtin_ctz(b), runs, sums);
    const PathV light = load3<PathF>(sums[0], sums[1], sums[2]);
    for_each_material(job.scene->shading, s.material + i, bits,
                      [&](const MaterialRow& row, const PathM& mask, std::uint32_t) {
                        const PathV kd = row.textures != nullptr
                                             ? load3<PathF>(s.diffuse_r + i, s.diffuse_g + i, s.diffuse_b + i)
                                             : broadcast3<PathF>(row.diffuse);
                        const PathV local = load3<PathF>(s.local_r + i, s.local_g + i, s.local_b + i);
                        store3(select(mask, local + kd * light, local), s.local_r + i, s.local_g + i,
                               s.local_b + i);
                      });
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
