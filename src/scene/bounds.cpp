// SPDX-License-Identifier: Apache-2.0
#include "src/scene/shapes.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/load.hpp>

#include <algorithm>

namespace fastrt {

namespace {

// Below this many primitives, starting threads takes longer.
constexpr std::ptrdiff_t parallel_from = 1 << 15;

// Vertices that no triangle uses don't count, nor do indices that point nowhere: the scene is not checked
// yet.
Aabb triangle_bounds(const SceneDesc& desc) {
  const std::size_t vertices =
      std::min({desc.positions.x.size(), desc.positions.y.size(), desc.positions.z.size()});
  const TriangleColumns& t = desc.triangles;
  const auto count = static_cast<std::ptrdiff_t>(std::min({t.v0.size(), t.v1.size(), t.v2.size()}));
  Aabb bounds;
#pragma omp parallel num_threads(thread_count(0)) if (count >= parallel_from)
  {
    Aabb part;
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      for (const std::uint32_t v : {t.v0[k], t.v1[k], t.v2[k]})
        if (v < vertices) part.extend(desc.positions[v]);
    }
#pragma omp critical(fastrt_triangle_bounds)
    bounds.extend(part);
  }
  return bounds;
}

Aabb sphere_bounds(const SceneDesc& desc) {
  const SphereColumns& s = desc.spheres;
  const auto count =
      static_cast<std::ptrdiff_t>(std::min({s.x.size(), s.y.size(), s.z.size(), s.radius.size()}));
  Aabb bounds;
#pragma omp parallel num_threads(thread_count(0)) if (count >= parallel_from)
  {
    Aabb part;
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vec3 center{s.x[k], s.y[k], s.z[k]};
      part.extend(center - s.radius[k]);
      part.extend(center + s.radius[k]);
    }
#pragma omp critical(fastrt_sphere_bounds)
    bounds.extend(part);
  }
  return bounds;
}

// Planes have no bounds.
Aabb shape_bounds(const SceneDesc& desc) {
  Aabb bounds;
  const ConeColumns& c = desc.cones;
  const std::size_t cones =
      std::min({c.base.x.size(), c.base.y.size(), c.base.z.size(), c.apex.x.size(), c.apex.y.size(),
                c.apex.z.size(), c.base_radius.size(), c.apex_radius.size()});
  for (std::size_t i = 0; i < cones; ++i) bounds.extend(cone_box(c, i));
  const DiskColumns& d = desc.disks;
  const std::size_t disks =
      std::min({d.center.x.size(), d.center.y.size(), d.center.z.size(), d.normal.x.size(), d.normal.y.size(),
                d.normal.z.size(), d.radius.size()});
  for (std::size_t i = 0; i < disks; ++i) bounds.extend(disk_box(d, i));
  for (const std::uint32_t v : desc.polygons.vertex)
    if (v < std::min({desc.positions.x.size(), desc.positions.y.size(), desc.positions.z.size()}))
      bounds.extend(desc.positions[v]);
  return bounds;
}

} // namespace

Aabb bounds_of(const SceneDesc& desc) {
  Aabb bounds = triangle_bounds(desc);
  bounds.extend(sphere_bounds(desc));
  bounds.extend(shape_bounds(desc));
  // Threads finish in any order, and -0 equals 0: adding 0 leaves only one of them.
  bounds.lower += 0.0F;
  bounds.upper += 0.0F;
  return bounds;
}

} // namespace fastrt
