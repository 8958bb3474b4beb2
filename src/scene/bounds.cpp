// SPDX-License-Identifier: Apache-2.0
#include "src/scene/shapes.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/load.hpp>

#include <emmintrin.h>

#include <algorithm>
#include <array>

namespace fastrt {

namespace {

// Below this many primitives, starting threads takes longer.
constexpr std::ptrdiff_t parallel_from = 1 << 15;

std::size_t length_of(const Columns3& columns) {
  return std::min({columns.x.size(), columns.y.size(), columns.z.size()});
}

// The rows of a range that are among the first `count`.
RowRange among(const RowRange& rows, std::size_t count) {
  const auto most = static_cast<std::uint32_t>(count);
  return {std::min(rows.begin, most), std::min(rows.end, most)};
}

// An Aabb in SSE2 registers, which every x86-64 has; what it makes of NaN and -0 is the same.
struct BoundsLanes {
  __m128 lower = _mm_set1_ps(infinity);
  __m128 upper = _mm_set1_ps(-infinity);

  void extend(__m128 point) {
    lower = _mm_min_ps(point, lower);
    upper = _mm_max_ps(point, upper);
  }
  Aabb bounds() const {
    alignas(16) std::array<float, 4> low, high;
    _mm_store_ps(low.data(), lower);
    _mm_store_ps(high.data(), upper);
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  }
};

// Vertices that no triangle uses don't count, nor do indices that point nowhere: the scene is not checked
// yet.
Aabb triangle_bounds(const SceneDesc& desc, const RowRange& range) {
  const std::size_t vertices = length_of(desc.positions);
  const TriangleColumns& t = desc.triangles;
  const RowRange rows = among(range, std::min({t.v0.size(), t.v1.size(), t.v2.size()}));
  const std::ptrdiff_t begin = rows.begin, end = rows.end;
  const std::uint32_t *const v0 = t.v0.data(), *const v1 = t.v1.data(), *const v2 = t.v2.data();
  const float *const x = desc.positions.x.data(), *const y = desc.positions.y.data(),
                     *const z = desc.positions.z.data();
  Aabb bounds;
#pragma omp parallel num_threads(thread_count(0)) if (end - begin >= parallel_from)
  {
    BoundsLanes part;
    const auto extend = [&part, vertices, x, y, z](std::uint32_t v) {
      if (v < vertices) part.extend(_mm_setr_ps(x[v], y[v], z[v], 0.0F));
    };
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = begin; i < end; ++i) {
      extend(v0[i]);
      extend(v1[i]);
      extend(v2[i]);
    }
#pragma omp critical(fastrt_triangle_bounds)
    bounds.extend(part.bounds());
  }
  return bounds;
}

Aabb sphere_bounds(const SceneDesc& desc, const RowRange& range) {
  const SphereColumns& s = desc.spheres;
  const RowRange rows = among(range, std::min({s.x.size(), s.y.size(), s.z.size(), s.radius.size()}));
  const std::ptrdiff_t begin = rows.begin, end = rows.end;
  Aabb bounds;
#pragma omp parallel num_threads(thread_count(0)) if (end - begin >= parallel_from)
  {
    Aabb part;
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = begin; i < end; ++i) {
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

Aabb cone_bounds(const SceneDesc& desc, const RowRange& range) {
  const ConeColumns& c = desc.cones;
  const RowRange rows = among(
      range, std::min({length_of(c.base), length_of(c.apex), c.base_radius.size(), c.apex_radius.size()}));
  Aabb bounds;
  for (std::size_t i = rows.begin; i < rows.end; ++i) bounds.extend(cone_box(c, i));
  return bounds;
}

Aabb disk_bounds(const SceneDesc& desc, const RowRange& range) {
  const DiskColumns& d = desc.disks;
  const RowRange rows = among(range, std::min({length_of(d.center), length_of(d.normal), d.radius.size()}));
  Aabb bounds;
  for (std::size_t i = rows.begin; i < rows.end; ++i) bounds.extend(disk_box(d, i));
  return bounds;
}

Aabb polygon_bounds(const SceneDesc& desc, const RowRange& range) {
  const PolygonColumns& p = desc.polygons;
  const std::size_t vertices = length_of(desc.positions);
  const auto end_of = [](const Column<std::uint32_t>& ends, std::size_t row) {
    return row == 0 ? 0U : ends[row - 1];
  };
  const RowRange rows = among(range, p.contour_end.size());
  Aabb bounds;
  if (rows.begin == rows.end) return bounds;
  const RowRange contours =
      among({end_of(p.contour_end, rows.begin), end_of(p.contour_end, rows.end)}, p.vertex_end.size());
  const RowRange corners =
      among({end_of(p.vertex_end, contours.begin), end_of(p.vertex_end, contours.end)}, p.vertex.size());
  for (std::size_t i = corners.begin; i < corners.end; ++i)
    if (p.vertex[i] < vertices) bounds.extend(desc.positions[p.vertex[i]]);
  return bounds;
}

Aabb bounds_of_rows(const SceneDesc& desc, std::size_t kind, const RowRange& rows) {
  constexpr Aabb (*of_kind[])(const SceneDesc&, const RowRange&) = {triangle_bounds, sphere_bounds,
                                                                    cone_bounds, disk_bounds, polygon_bounds};
  return of_kind[kind](desc, rows);
}

Aabb instance_bounds(const SceneDesc& desc) {
  std::vector<Aabb> prototypes;
  prototypes.reserve(desc.prototypes.size());
  for (const Prototype& prototype : desc.prototypes) prototypes.push_back(bounds_of(desc, prototype));
  const InstanceColumns& instances = desc.instances;
  const std::size_t count = std::min(instances.prototype.size(), instances.to_world.size());
  Aabb bounds;
  for (std::size_t i = 0; i < count; ++i)
    if (instances.prototype[i] < prototypes.size())
      bounds.extend(image_of(instances.to_world[i], prototypes[instances.prototype[i]]));
  return bounds;
}

} // namespace

Aabb bounds_of(const SceneDesc& desc, const Prototype& prototype) {
  Aabb bounds;
  for (std::size_t kind = 0; kind < prototype.begin.size(); ++kind)
    bounds.extend(bounds_of_rows(desc, kind, {prototype.begin[kind], prototype.end[kind]}));
  return bounds;
}

Aabb bounds_of(const SceneDesc& desc) {
  Aabb bounds = instance_bounds(desc);
  const KindRanges world = world_rows(desc);
  for (std::size_t kind = 0; kind < world.size(); ++kind)
    for (const RowRange& rows : world[kind]) bounds.extend(bounds_of_rows(desc, kind, rows));
  // Threads finish in any order, and -0 equals 0: adding 0 leaves only one of them.
  bounds.lower += 0.0F;
  bounds.upper += 0.0F;
  return bounds;
}

} // namespace fastrt
