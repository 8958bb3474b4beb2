// SPDX-License-Identifier: Apache-2.0
// Photons on their way from a light: batch by batch, depth first. What goes on from several batches joins in
// new ones, by depth, so that these are full; photons may be followed in any order, for what they leave is
// put in order or added up exactly.
#pragma once

#include "src/trace/forward.hpp"
#include "src/trace/photon_emission.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

FASTRT_INLINE PhotonBatch& open_batch(PhotonScratch& scratch, int depth, bool scattered) {
  PhotonBatch*& open = scratch.open[scattered ? 1 : 0][depth];
  if (open == nullptr) {
    open = scratch.unused[--scratch.unused_count];
    open->count = 0;
    open->depth = depth;
    open->scattered = scattered;
    open->shape = scattered ? BatchShape::any : BatchShape::coherent;
  }
  return *open;
}

FASTRT_INLINE void close_batch(PhotonScratch& scratch, int depth, bool scattered) {
  PhotonBatch*& open = scratch.open[scattered ? 1 : 0][depth];
  scratch.waiting[scratch.waiting_count++] = open;
  open = nullptr;
}

FASTRT_INLINE void copy_ray(const PathBatch& from, int i, const KeptColumns& keep, int k, PathBatch& to) {
  to.origin_x[k] = from.origin_x[i];
  to.origin_y[k] = from.origin_y[i];
  to.origin_z[k] = from.origin_z[i];
  to.dir_x[k] = from.dir_x[i];
  to.dir_y[k] = from.dir_y[i];
  to.dir_z[k] = from.dir_z[i];
  to.weight_r[k] = from.weight_r[i];
  to.weight_g[k] = from.weight_g[i];
  to.weight_b[k] = from.weight_b[i];
  to.t_min[k] = 0.0F;
  to.t_max[k] = __builtin_inff();
  to.exclude[k] = from.exclude[i];
  if (keep.inner) to.exclude_inner[k] = from.exclude_inner[i];
  if (keep.width) to.width[k] = 0.0F;
  if (!keep.media) return;
  for (int m = 0; m < max_media; ++m) to.media[m][k] = from.media[m][i];
}

// Whether a photon that takes this turn at the surface of `parent` is, or becomes, part of a caustic.
FASTRT_INLINE bool bends(const PhotonJob& job, const SurfaceBatch& s, int parent, PhotonTurn turn) {
  if (turn == PhotonTurn::reflected) return true;
  return turn == PhotonTurn::refracted && job.scene->shading.materials[s.material[parent]].thin == 0;
}

// Rays that leave the batch's surfaces join others of their depth.
static void go_on(const PhotonJob& job, const PhotonBatch& parents, const PathBatch& children,
                  PhotonTurn turn, const ArrivalBatch& arrival, PhotonScratch& scratch) noexcept {
  const KeptColumns keep = kept_columns(job.scene->shading);
  const bool scattered = parents.scattered || turn == PhotonTurn::scattered;
  for (int i = 0; i < children.count; ++i) {
    PhotonBatch& to = open_batch(scratch, parents.depth + 1, scattered);
    const int parent = children.pixel[i], k = to.count++;
    copy_ray(children, i, keep, k, to);
    to.pixel[k] = k;
    to.length[k] = parents.length[parent];
    to.strength[k] = turn == PhotonTurn::scattered ? arrival.strength[parent] : parents.strength[parent];
    to.key[k] = next_photon_key(parents.key[parent], turn);
    to.index[k] = parents.index[parent];
    to.bent[k] = bends(job, scratch.tile.surface, parent, turn) ? 1 : parents.bent[parent];
    if (to.count == batch_size) close_batch(scratch, parents.depth + 1, scattered);
  }
}

static void follow_further(const PhotonJob& job, const PhotonBatch& rays, const ArrivalBatch& arrival,
                           PhotonScratch& scratch, TileRayCounts& counts) noexcept {
  TileJob surfaces{};
  surfaces.scene = job.scene;
  surfaces.min_contribution = job.min_contribution;
  scratch.reflected.count = scratch.refracted.count = scratch.diffuse.count = 0;
  make_secondary_rays(surfaces, rays, scratch.tile, scratch.reflected, scratch.refracted);
  if (job.film != nullptr) scatter_photons(job, rays, arrival, scratch.tile.surface, scratch.diffuse);
  counts.reflected += static_cast<std::uint64_t>(scratch.reflected.count + scratch.diffuse.count);
  counts.refracted += static_cast<std::uint64_t>(scratch.refracted.count);
  go_on(job, rays, scratch.reflected, PhotonTurn::reflected, arrival, scratch);
  go_on(job, rays, scratch.refracted, PhotonTurn::refracted, arrival, scratch);
  go_on(job, rays, scratch.diffuse, PhotonTurn::scattered, arrival, scratch);
}

static void follow_photons(const PhotonJob& job, PhotonBatch& rays, PhotonScratch& scratch,
                           TileRayCounts& counts) noexcept {
  for (int i = 0; i < rays.count; ++i) rays.pixel[i] = i; // so that those who go on know where from
  ArrivalBatch arrival;
  find_closest_hits(job.scene->geometry, rays, scratch.tile.hits);
  meet_surfaces(job, rays, scratch.tile, arrival);
  if (job.film != nullptr)
    counts.shadow += connect_to_eye(job, rays, arrival, scratch.tile);
  else
    store_photons(job, rays, scratch.tile.surface, arrival, scratch.store);
  take_tests(rays.depth, scratch.tile, counts);
  if (rays.depth < job.max_depth) follow_further(job, rays, arrival, scratch, counts);
}

// The next batch to be followed; null when none is left. Open batches come last.
FASTRT_INLINE PhotonBatch* next_batch(const PhotonJob& job, PhotonScratch& scratch, TileRayCounts& counts) {
  if (scratch.waiting_count != 0) return scratch.waiting[--scratch.waiting_count];
  if (scratch.next < job.last) {
    PhotonBatch* const batch = scratch.unused[--scratch.unused_count];
    const std::uint32_t left = job.last - scratch.next;
    const int count = left < static_cast<std::uint32_t>(batch_size) ? static_cast<int>(left) : batch_size;
    emit_photons(job, scratch.next, count, *batch);
    scratch.next += static_cast<std::uint32_t>(count);
    counts.primary += static_cast<std::uint64_t>(count);
    return batch;
  }
  for (int depth = 0; depth <= job.max_depth; ++depth)
    for (auto& open : scratch.open) {
      if (open[depth] == nullptr) continue;
      PhotonBatch* const batch = open[depth];
      open[depth] = nullptr;
      return batch;
    }
  return nullptr;
}

static bool trace_photons(const PhotonJob& job, PhotonScratch& scratch, TileRayCounts& counts) noexcept {
  while (scratch.store.count + batch_size <= photon_store_size) {
    PhotonBatch* const batch = next_batch(job, scratch, counts);
    if (batch == nullptr) return false;
    follow_photons(job, *batch, scratch, counts);
    scratch.unused[scratch.unused_count++] = batch;
  }
  return true;
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
