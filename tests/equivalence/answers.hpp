// SPDX-License-Identifier: Apache-2.0
// The same question put to brute force, to the kernels and to a tracer.
#pragma once

#include "src/reference/hit_finder.hpp"
#include "src/trace/tracer_parts.hpp"
#include "tests/equivalence/isas.hpp"
#include "tests/equivalence/rays.hpp"

#include <fastrt/tracer.hpp>

#include <cstdio>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fastrt::test {

using reference::Hit;

inline std::vector<Hit> answers_of(const reference::HitFinder& finder, std::span<const Ray> rays) {
  std::vector<Hit> answers;
  answers.reserve(rays.size());
  for (const Ray& ray : rays) answers.push_back(finder.closest(ray));
  return answers;
}

// Rows that hold no ray are full of numbers that would show.
// first_instance: the id of the scene's first instance.
inline void fill_batch(std::span<const Ray> rays, BatchShape shape, std::int32_t first_instance,
                       RayBatch& batch) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < batch_size; ++i) {
    Ray ray;
    ray.origin = ray.direction = Vec3(i % 2 == 0 ? nan : 1.0F);
    const auto row = static_cast<std::size_t>(i);
    if (row < rays.size()) ray = rays[row];
    batch.origin_x[i] = ray.origin.x;
    batch.origin_y[i] = ray.origin.y;
    batch.origin_z[i] = ray.origin.z;
    batch.dir_x[i] = ray.direction.x;
    batch.dir_y[i] = ray.direction.y;
    batch.dir_z[i] = ray.direction.z;
    batch.t_min[i] = ray.t_min;
    batch.t_max[i] = ray.t_max;
    const bool inside = ray.excluded_instance != no_instance;
    batch.exclude[i] = inside ? first_instance + ray.excluded_instance : ray.excluded;
    batch.exclude_inner[i] = inside ? ray.excluded : 7;
  }
  batch.count = static_cast<int>(rays.size());
  batch.shape = shape;
}

// Straight to the kernels; one batch.
class KernelQuery {
public:
  KernelQuery() : rays_(std::make_unique<RayBatch>()), hits_(std::make_unique<HitBatch>()) {}

  std::vector<Hit> closest(const Tracer& tracer, std::span<const Ray> rays, BatchShape shape) {
    const KernelTable& kernels = *tracer.parts().kernels;
    const SceneView& view = tracer.parts().view;
    const std::int32_t first_instance = view.geometry.shapes.first_instance;
    fill_batch(rays, shape, first_instance, *rays_);
    kernels.closest_hits(view.geometry, *rays_, *hits_);
    kernels.hit_weights(view.shading, *rays_, *hits_, u_, v_);
    std::vector<Hit> found(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      found[i] = {hits_->t[i], u_[i], v_[i], hits_->primitive[i]};
      if (found[i].primitive < first_instance) continue;
      found[i].instance = found[i].primitive - first_instance;
      found[i].primitive = hits_->inner[i];
    }
    return found;
  }
  std::vector<bool> any(const Tracer& tracer, std::span<const Ray> rays, BatchShape shape) {
    const GeometryView& view = tracer.parts().view.geometry;
    fill_batch(rays, shape, view.shapes.first_instance, *rays_);
    tracer.parts().kernels->any_hits(view, *rays_, *hits_);
    std::vector<bool> found(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) found[i] = hits_->primitive[i] >= 0;
    return found;
  }

private:
  std::unique_ptr<RayBatch> rays_;
  std::unique_ptr<HitBatch> hits_;
  alignas(64) float u_[batch_size] = {};
  alignas(64) float v_[batch_size] = {};
};

inline TracerSettings with_isa(Isa isa) {
  TracerSettings settings;
  settings.isa = isa;
  settings.threads = 1;
  return settings;
}

// One for each ISA with kernels, so that these go through the tree that is made for them.
inline std::vector<Tracer> simd_tracers(const Scene& scene) {
  std::vector<Tracer> tracers;
  for (const Isa isa : simd_isas()) tracers.emplace_back(scene, with_isa(isa));
  return tracers;
}

inline std::string words(const Ray& ray, const Hit& expected, const Hit& found) {
  char text[512];
  std::snprintf(text, sizeof text,
                "o (%a, %a, %a) d (%a, %a, %a) t_min %a t_max %a excluded %d in %d: expected primitive %d in "
                "%d t %a u %a v %a, found primitive %d in %d t %a u %a v %a",
                static_cast<double>(ray.origin.x), static_cast<double>(ray.origin.y),
                static_cast<double>(ray.origin.z), static_cast<double>(ray.direction.x),
                static_cast<double>(ray.direction.y), static_cast<double>(ray.direction.z),
                static_cast<double>(ray.t_min), static_cast<double>(ray.t_max), ray.excluded,
                ray.excluded_instance, expected.primitive, expected.instance, static_cast<double>(expected.t),
                static_cast<double>(expected.u), static_cast<double>(expected.v), found.primitive,
                found.instance, static_cast<double>(found.t), static_cast<double>(found.u),
                static_cast<double>(found.v));
  return text;
}

} // namespace fastrt::test
