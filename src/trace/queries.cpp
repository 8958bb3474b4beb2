// SPDX-License-Identifier: Apache-2.0
// Tracer's questions about arrays of any length: cut into batches, and each batch handed to the kernels.
#include "src/trace/tracer_parts.hpp"

#include <algorithm>
#include <limits>

namespace fastrt {
namespace {

constexpr float no_limit = std::numeric_limits<float>::infinity();

void copy(const float* from, std::size_t first, int count, float* to) {
  std::copy_n(from + first, count, to);
}

bool one_origin(const RayBatch& rays) {
  for (int i = 1; i < rays.count; ++i)
    if (rays.origin_x[i] != rays.origin_x[0] || rays.origin_y[i] != rays.origin_y[0] ||
        rays.origin_z[i] != rays.origin_z[0])
      return false;
  return true;
}

BatchShape shape_of(Coherence coherence, const RayBatch& rays) {
  if (coherence == Coherence::unknown) return BatchShape::any;
  // A promise that does not hold must not change the answer, so it is looked at.
  return coherence == Coherence::tile && one_origin(rays) ? BatchShape::common_origin : BatchShape::coherent;
}

void load_batch(const RayArrays& rays, std::size_t first, Coherence coherence, RayBatch& batch) {
  batch.count = static_cast<int>(std::min<std::size_t>(batch_size, rays.count - first));
  copy(rays.origin_x, first, batch.count, batch.origin_x);
  copy(rays.origin_y, first, batch.count, batch.origin_y);
  copy(rays.origin_z, first, batch.count, batch.origin_z);
  copy(rays.dir_x, first, batch.count, batch.dir_x);
  copy(rays.dir_y, first, batch.count, batch.dir_y);
  copy(rays.dir_z, first, batch.count, batch.dir_z);
  if (rays.t_min != nullptr)
    copy(rays.t_min, first, batch.count, batch.t_min);
  else
    std::fill_n(batch.t_min, batch.count, 0.0F);
  if (rays.t_max != nullptr)
    copy(rays.t_max, first, batch.count, batch.t_max);
  else
    std::fill_n(batch.t_max, batch.count, no_limit);
  std::fill_n(batch.exclude, batch.count, no_primitive);
  batch.shape = shape_of(coherence, batch);
}

reference::Ray ray_of(const RayArrays& rays, std::size_t i) {
  reference::Ray ray;
  ray.origin = {rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]};
  ray.direction = {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]};
  if (rays.t_min != nullptr) ray.t_min = rays.t_min[i];
  ray.t_max = rays.t_max != nullptr ? rays.t_max[i] : no_limit;
  return ray;
}

// The primitives of `count` hits to where the caller wants them, and the instances that show them.
void put_primitives(const ShapeView& shapes, const HitBatch& found, std::size_t first, int count,
                    const HitArrays& hits) {
  std::copy_n(found.primitive, count, hits.primitive + first);
  if (hits.instance != nullptr) std::fill_n(hits.instance + first, count, no_instance);
  if (shapes.instance_count == 0) return;
  for (int i = 0; i < count; ++i) {
    if (found.primitive[i] < shapes.first_instance) continue;
    const std::size_t at = first + static_cast<std::size_t>(i);
    hits.primitive[at] = found.inner[i];
    if (hits.instance != nullptr) hits.instance[at] = found.primitive[i] - shapes.first_instance;
  }
}

void closest_hit_scalar(const ScalarBvh& bvh, const RayArrays& rays, const HitArrays& hits) {
  for (std::size_t i = 0; i < rays.count; ++i) {
    const reference::Hit hit = bvh.closest(ray_of(rays, i));
    hits.t[i] = hit.t;
    hits.primitive[i] = hit.primitive;
    if (hits.instance != nullptr) hits.instance[i] = hit.instance;
    if (hits.u != nullptr) hits.u[i] = hit.u;
    if (hits.v != nullptr) hits.v[i] = hit.v;
  }
}

} // namespace

void Tracer::closest_hit(const RayArrays& rays, const HitArrays& hits, Coherence coherence) const {
  const Parts& parts = *parts_;
  if (parts.scalar_bvh) return closest_hit_scalar(*parts.scalar_bvh, rays, hits);
  RayBatch batch{};
  HitBatch found{};
  alignas(64) float u[batch_size];
  alignas(64) float v[batch_size];
  for (std::size_t first = 0; first < rays.count; first += batch_size) {
    load_batch(rays, first, coherence, batch);
    parts.kernels->closest_hits(parts.view.geometry, batch, found);
    std::copy_n(found.t, batch.count, hits.t + first);
    put_primitives(parts.view.geometry.shapes, found, first, batch.count, hits);
    if (hits.u == nullptr && hits.v == nullptr) continue;
    parts.kernels->hit_weights(parts.view.shading, batch, found, u, v);
    if (hits.u != nullptr) std::copy_n(u, batch.count, hits.u + first);
    if (hits.v != nullptr) std::copy_n(v, batch.count, hits.v + first);
  }
}

void Tracer::any_hit(const RayArrays& rays, std::uint8_t* hit, Coherence coherence) const {
  const Parts& parts = *parts_;
  if (parts.scalar_bvh) {
    for (std::size_t i = 0; i < rays.count; ++i) hit[i] = parts.scalar_bvh->any(ray_of(rays, i)) ? 1 : 0;
    return;
  }
  RayBatch batch{};
  HitBatch found{};
  for (std::size_t first = 0; first < rays.count; first += batch_size) {
    load_batch(rays, first, coherence, batch);
    parts.kernels->any_hits(parts.view.geometry, batch, found);
    for (int i = 0; i < batch.count; ++i)
      hit[first + static_cast<std::size_t>(i)] = found.primitive[i] >= 0 ? 1 : 0;
  }
}

} // namespace fastrt
