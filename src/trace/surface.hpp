// SPDX-License-Identifier: Apache-2.0
// From hits to surfaces: point, normals turned to the viewer, size of the numbers (docs/numerics.md, "The
// surface at a hit").
#pragma once

#include "src/kernels/triangle.hpp"
#include "src/trace/instance_lanes.hpp"
#include "src/trace/shape_surface.hpp"
#include "src/trace/tile_job.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// The corners of a triangle per lane, gathered from the scene's columns.
struct Corners {
  alignas(64) float x[3][widest], y[3][widest], z[3][widest];
};

FASTRT_INLINE PathV corner(const Corners& c, int v) {
  return {PathF::load_aligned(c.x[v]), PathF::load_aligned(c.y[v]), PathF::load_aligned(c.z[v])};
}

FASTRT_INLINE void gather_corners(const ShadingView& scene, const std::int32_t* primitives,
                                  std::uint32_t bits, Corners& c) {
  const std::uint32_t* const columns[3] = {scene.v0, scene.v1, scene.v2};
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    for (int v = 0; v < 3; ++v) {
      const std::uint32_t index = columns[v][primitives[lane]];
      c.x[v][lane] = scene.position_x[index];
      c.y[v][lane] = scene.position_y[index];
      c.z[v][lane] = scene.position_z[index];
    }
  }
}

// Returns the lanes whose three corners all have normals.
FASTRT_INLINE std::uint32_t gather_normals(const ShadingView& scene, const std::int32_t* primitives,
                                           std::uint32_t bits, Corners& c) {
  const std::uint32_t* const columns[3] = {scene.n0, scene.n1, scene.n2};
  std::uint32_t complete = bits;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    for (int v = 0; v < 3; ++v) {
      const std::uint32_t index = columns[v][primitives[lane]];
      if (index == 0xFFFFFFFFU) {
        complete &= ~(1U << lane);
        break;
      }
      c.x[v][lane] = scene.normal_x[index];
      c.y[v][lane] = scene.normal_y[index];
      c.z[v][lane] = scene.normal_z[index];
    }
  }
  return complete;
}

FASTRT_INLINE Surface triangle_surface(const ShadingView& scene, const std::int32_t* primitives,
                                       std::uint32_t bits, const PathV& origin, const PathV& dir) {
  Corners corners{};
  gather_corners(scene, primitives, bits, corners);
  const PathV a = corner(corners, 0), b = corner(corners, 1), c = corner(corners, 2);
  const auto [u, v] = triangle_weights(set_up_triangle(a - origin, b - origin, c - origin), dir);
  const PathF w = (PathF(1.0F) - u) - v;
  Surface s;
  s.point = (a * w + b * u) + c * v;
  const PathV normal = cross(b - a, c - a);
  s.geometric = normalize(normal / largest(normal));
  s.magnitude = max(max(largest(a), largest(b)), largest(c));
  s.shading = s.geometric;
  if (scene.normal_x == nullptr) return s;
  const std::uint32_t smooth = gather_normals(scene, primitives, bits, corners);
  if (smooth == 0) return s;
  const PathV sum = (corner(corners, 0) * w + corner(corners, 1) * u) + corner(corners, 2) * v;
  const PathF length2 = dot(sum, sum);
  const PathM usable =
      from_bits<widest>(smooth) & (length2 > PathF(0.0F)) & (length2 < PathF(__builtin_inff()));
  s.shading = select(usable, sum * (PathF(1.0F) / sqrt(length2)), s.geometric);
  return s;
}

FASTRT_INLINE Surface sphere_surface(const ShadingView& scene, const std::int32_t* primitives,
                                     std::uint32_t bits, const PathV& origin, const PathV& dir,
                                     const PathF& t) {
  Corners c{};
  alignas(64) float radius[widest] = {};
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const std::uint32_t sphere = static_cast<std::uint32_t>(primitives[lane]) - scene.triangle_count;
    c.x[0][lane] = scene.sphere_x[sphere];
    c.y[0][lane] = scene.sphere_y[sphere];
    c.z[0][lane] = scene.sphere_z[sphere];
    radius[lane] = scene.sphere_radius[sphere];
  }
  const PathV center = corner(c, 0);
  const PathF r = PathF::load_aligned(radius);
  Surface s;
  s.geometric = normalize((origin - center) + dir * t);
  s.point = center + s.geometric * r;
  s.shading = s.geometric;
  s.magnitude = largest(center) + r;
  return s;
}

// Both normals to the viewer's side, whichever way the surface is wound.
FASTRT_INLINE void face_viewer(Surface& s, const PathV& dir) {
  const PathM away = dot(s.geometric, dir) > PathF(0.0F);
  s.geometric = select(away, negate(s.geometric), s.geometric);
  const PathM opposed = dot(s.shading, s.geometric) < PathF(0.0F);
  s.shading = select(opposed, negate(s.shading), s.shading);
}

FASTRT_INLINE void store_surface(const Surface& s, const PathV& dir, int i, SurfaceBatch& batch) {
  const PathF inverse_length = PathF(1.0F) / sqrt(dot(dir, dir));
  store3(s.point, batch.point_x + i, batch.point_y + i, batch.point_z + i);
  store3(s.geometric, batch.geometric_x + i, batch.geometric_y + i, batch.geometric_z + i);
  store3(s.shading, batch.shading_x + i, batch.shading_y + i, batch.shading_z + i);
  store3(negate(dir * inverse_length), batch.viewer_x + i, batch.viewer_y + i, batch.viewer_z + i);
  s.magnitude.store_aligned(batch.magnitude + i);
}

FASTRT_INLINE std::uint32_t material_index(const ShadingView& scene, std::int32_t primitive) {
  const auto index = static_cast<std::uint32_t>(primitive);
  if (index < scene.triangle_count) return scene.triangle_material[index];
  if (primitive < scene.shapes.first_cone) return scene.sphere_material[index - scene.triangle_count];
  return scene.shape_material[primitive - scene.shapes.first_cone];
}

FASTRT_INLINE std::uint32_t object_index(const ShadingView& scene, std::int32_t primitive) {
  const auto index = static_cast<std::uint32_t>(primitive);
  if (index < scene.triangle_count) return scene.triangle_object[index];
  if (primitive < scene.shapes.first_cone) return scene.sphere_object[index - scene.triangle_count];
  return scene.shape_object[primitive - scene.shapes.first_cone];
}

FASTRT_INLINE std::uint32_t material_of_hit(const ShadingView& scene, const HitBatch& hits, int i) {
  const InstanceRow* row = instance_of(scene.shapes, hits.primitive[i]);
  if (row == nullptr) return material_index(scene, hits.primitive[i]);
  return row->material != no_override ? row->material : material_index(scene, hits.inner[i]);
}

FASTRT_INLINE std::uint32_t object_of_hit(const ShadingView& scene, const HitBatch& hits, int i) {
  const InstanceRow* row = instance_of(scene.shapes, hits.primitive[i]);
  if (row == nullptr) return object_index(scene, hits.primitive[i]);
  return row->object != no_override ? row->object : object_index(scene, hits.inner[i]);
}

// Lanes by the kind of primitive that they hit.
struct HitKinds {
  std::uint32_t triangles, spheres, shapes;
};

// Adds a lane to the kind of its primitive. Returns whether that is flat.
FASTRT_INLINE bool sort_hit(const ShadingView& scene, std::int32_t id, int lane, HitKinds& kinds) {
  if (static_cast<std::uint32_t>(id) < scene.triangle_count) {
    kinds.triangles |= 1U << lane;
    return true;
  }
  if (id < scene.shapes.first_cone) {
    kinds.spheres |= 1U << lane;
    return false;
  }
  kinds.shapes |= 1U << lane;
  return id >= scene.shapes.first_disk;
}

// The surfaces of primitives where rays hit them at t.
FASTRT_INLINE Surface surfaces_of(const ShadingView& scene, const std::int32_t* primitives,
                                  const HitKinds& kinds, const PathV& origin, const PathV& dir,
                                  const float* t) {
  Surface s;
  if (kinds.triangles != 0) s = triangle_surface(scene, primitives, kinds.triangles, origin, dir);
  if (kinds.spheres != 0) {
    const Surface on_sphere =
        sphere_surface(scene, primitives, kinds.spheres, origin, dir, PathF::load_aligned(t));
    s = kinds.triangles != 0 ? select(from_bits<widest>(kinds.spheres), on_sphere, s) : on_sphere;
  }
  if (kinds.shapes != 0) {
    const Surface on_shape =
        shape_surface(scene.shapes, primitives, kinds.shapes, origin, dir, PathF::load_aligned(t));
    s = (kinds.triangles | kinds.spheres) != 0 ? select(from_bits<widest>(kinds.shapes), on_shape, s)
                                               : on_shape;
  }
  return s;
}

// find_surfaces of a scene with instances.
[[gnu::noinline]] static void find_instance_surfaces(const ShadingView& scene, const PathBatch& rays,
                                                     const HitBatch& hits, int i,
                                                     SurfaceBatch& batch) noexcept {
  const int count = rays.count - i < widest ? rays.count - i : widest;
  InstanceLanes lanes{};
  gather_instances(scene.shapes, hits, i, count, lanes);
  HitKinds kinds{};
  for (int lane = 0; lane < count; ++lane) {
    const std::int32_t id = lanes.primitive[lane];
    batch.planar[i + lane] = batch.planar_inner[i + lane] = -1;
    if (id < 0) continue;
    batch.material[i + lane] = static_cast<std::int32_t>(material_of_hit(scene, hits, i + lane));
    if (!sort_hit(scene, id, lane, kinds)) continue;
    batch.planar[i + lane] = hits.primitive[i + lane];
    batch.planar_inner[i + lane] = id;
  }
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  PathV origin_there = load3<PathF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
  PathV dir_there = dir;
  if (lanes.bits != 0) rays_to_objects(lanes, origin_there, dir_there);
  Surface s = surfaces_of(scene, lanes.primitive, kinds, origin_there, dir_there, hits.t + i);
  if (lanes.bits != 0) surfaces_to_world(lanes, s);
  face_viewer(s, dir);
  store_surface(s, dir, i, batch);
  PathF::load_aligned(lanes.growth).store_aligned(batch.growth + i);
}

// The surfaces that rays i .. i + widest - 1 hit; rows of rays that missed hold no meaning.
FASTRT_INLINE void find_surfaces(const ShadingView& scene, const PathBatch& rays, const HitBatch& hits, int i,
                                 SurfaceBatch& batch) {
  if (scene.shapes.instance_count != 0) return find_instance_surfaces(scene, rays, hits, i, batch);
  const std::int32_t* primitives = hits.primitive + i;
  HitKinds kinds{};
  for (int lane = 0; lane < widest && i + lane < rays.count; ++lane) {
    const std::int32_t id = primitives[lane];
    batch.planar[i + lane] = -1;
    if (id < 0) continue;
    batch.material[i + lane] = static_cast<std::int32_t>(material_index(scene, id));
    if (sort_hit(scene, id, lane, kinds)) batch.planar[i + lane] = id;
  }
  const PathV origin = load3<PathF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  Surface s = surfaces_of(scene, primitives, kinds, origin, dir, hits.t + i);
  face_viewer(s, dir);
  store_surface(s, dir, i, batch);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
