// SPDX-License-Identifier: Apache-2.0
// From hits to surfaces: point, normals turned to the viewer, size of the numbers (docs/numerics.md, "The
// surface at a hit").
#pragma once

#include "src/kernels/triangle.hpp"
#include "src/trace/instance_lanes.hpp"
#include "src/trace/shape_surface.hpp"
#include "src/trace/tile_job.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// A triangle per lane.
struct Corners {
  PathV a, b, c;
};

FASTRT_INLINE Corners gather_corners(const ShadingView& scene, const PathI& triangles, std::uint32_t bits) {
  const auto corner = [&](const std::uint32_t* column) {
    return gather3(scene.position_x, scene.position_y, scene.position_z, gather(column, triangles, bits),
                   bits);
  };
  return {corner(scene.v0), corner(scene.v1), corner(scene.v2)};
}

// Leaves the lanes in `bits` whose three corners all have normals.
FASTRT_INLINE Corners gather_normals(const ShadingView& scene, const PathI& triangles, std::uint32_t& bits) {
  const PathI a = gather(scene.n0, triangles, bits), b = gather(scene.n1, triangles, bits),
              c = gather(scene.n2, triangles, bits), none(-1);
  bits &= ~to_bits(simd::bool_cast((a == none) | (b == none) | (c == none)));
  const auto normal = [&](const PathI& places) {
    return gather3(scene.normal_x, scene.normal_y, scene.normal_z, places, bits);
  };
  return {normal(a), normal(b), normal(c)};
}

FASTRT_INLINE Surface triangle_surface(const ShadingView& scene, const PathI& triangles, std::uint32_t bits,
                                       const PathV& origin, const PathV& dir) {
  const auto [a, b, c] = gather_corners(scene, triangles, bits);
  const auto [u, v] = triangle_weights(set_up_triangle(a - origin, b - origin, c - origin), dir);
  const PathF w = (PathF(1.0F) - u) - v;
  Surface s;
  s.point = (a * w + b * u) + c * v;
  const PathV normal = cross(b - a, c - a);
  s.geometric = normalize(normal / largest(normal));
  s.magnitude = max(max(largest(a), largest(b)), largest(c));
  s.shading = s.geometric;
  if (scene.normal_x == nullptr) return s;
  std::uint32_t smooth = bits;
  const Corners normals = gather_normals(scene, triangles, smooth);
  if (smooth == 0) return s;
  const PathV sum = (normals.a * w + normals.b * u) + normals.c * v;
  const PathF length2 = dot(sum, sum);
  const PathM usable =
      from_bits<widest>(smooth) & (length2 > PathF(0.0F)) & (length2 < PathF(__builtin_inff()));
  s.shading = select(usable, sum * (PathF(1.0F) / sqrt(length2)), s.geometric);
  return s;
}

FASTRT_INLINE Surface sphere_surface(const ShadingView& scene, const PathI& primitives, std::uint32_t bits,
                                     const PathV& origin, const PathV& dir, const PathF& t) {
  const PathI spheres = primitives - PathI(static_cast<std::int32_t>(scene.triangle_count));
  const PathV center = gather3(scene.sphere_x, scene.sphere_y, scene.sphere_z, spheres, bits);
  const PathF r = gather(scene.sphere_radius, spheres, bits);
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

// Lanes by the kind of primitive that they hit; and those where that is flat.
struct HitKinds {
  std::uint32_t triangles, spheres, shapes, flat;
};

// bits: lanes that hit something.
FASTRT_INLINE HitKinds kinds_of(const ShadingView& scene, const PathI& primitives, std::uint32_t bits) {
  const auto before = [&](std::int32_t end) {
    return to_bits(simd::bool_cast(primitives < PathI(end))) & bits;
  };
  const std::uint32_t triangles = before(static_cast<std::int32_t>(scene.triangle_count)),
                      not_shapes = before(scene.shapes.first_cone), round = before(scene.shapes.first_disk);
  return {triangles, not_shapes & ~triangles, bits & ~not_shapes, triangles | (bits & ~round)};
}

FASTRT_INLINE PathI materials_of(const ShadingView& scene, const PathI& primitives, const HitKinds& kinds) {
  PathI materials(0);
  const auto add = [&](const std::uint32_t* column, std::int32_t first, std::uint32_t bits) {
    if (bits != 0) materials = materials | gather(column, primitives - PathI(first), bits);
  };
  add(scene.triangle_material, 0, kinds.triangles);
  add(scene.sphere_material, static_cast<std::int32_t>(scene.triangle_count), kinds.spheres);
  add(scene.shape_material, scene.shapes.first_cone, kinds.shapes);
  return materials;
}

// From one row of materials to the next.
inline constexpr std::int32_t material_words = sizeof(MaterialRow) / sizeof(float);

// The primitives of the lanes in `flat`, elsewhere -1.
FASTRT_INLINE PathI flat_ones(const PathI& primitives, std::uint32_t flat) {
  return select_ints<PathF>(from_bits<widest>(flat), primitives, PathI(-1));
}

// The surfaces of primitives where rays hit them at t.
FASTRT_INLINE Surface surfaces_of(const ShadingView& scene, const std::int32_t* primitives,
                                  const HitKinds& kinds, const PathV& origin, const PathV& dir,
                                  const float* t) {
  const PathI ids = load<PathI>(primitives);
  Surface s;
  if (kinds.triangles != 0) s = triangle_surface(scene, ids, kinds.triangles, origin, dir);
  if (kinds.spheres != 0) {
    const Surface on_sphere = sphere_surface(scene, ids, kinds.spheres, origin, dir, PathF::load_aligned(t));
    s = kinds.triangles != 0 ? select(from_bits<widest>(kinds.spheres), on_sphere, s) : on_sphere;
  }
  if (kinds.shapes != 0) {
    const Surface on_shape =
        shape_surface(scene.shapes, ids, kinds.shapes, origin, dir, PathF::load_aligned(t));
    s = (kinds.triangles | kinds.spheres) != 0 ? select(from_bits<widest>(kinds.shapes), on_shape, s)
                                               : on_shape;
  }
  return s;
}

// The materials of what is shown, or of the instances that have their own.
FASTRT_INLINE PathI with_overrides(const ShapeView& shapes, const InstanceLanes& lanes,
                                   const PathI& materials) {
  if (lanes.bits == 0) return materials;
  const PathI own = gather(&shapes.instances->material, lanes.rows, lanes.bits);
  const std::uint32_t overrides =
      to_bits(simd::bool_cast(own != PathI(static_cast<std::int32_t>(no_override)))) & lanes.bits;
  return select_ints<PathF>(from_bits<widest>(overrides), own, materials);
}

// find_surfaces of a scene with instances.
[[gnu::noinline]] static void find_instance_surfaces(const ShadingView& scene, const PathBatch& rays,
                                                     const HitBatch& hits, std::uint32_t bits, int i,
                                                     SurfaceBatch& batch) noexcept {
  const int count = rays.count - i < widest ? rays.count - i : widest;
  InstanceLanes lanes;
  gather_instances(scene.shapes, hits, i, count, lanes);
  const PathI shown = PathI::load_aligned(lanes.primitive);
  const HitKinds kinds = kinds_of(scene, shown, bits);
  with_overrides(scene.shapes, lanes, materials_of(scene, shown, kinds)).store_aligned(batch.material + i);
  flat_ones(PathI::load_aligned(hits.primitive + i), kinds.flat).store_aligned(batch.planar + i);
  flat_ones(shown, kinds.flat).store_aligned(batch.planar_inner + i);
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  PathV origin_there = load3<PathF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
  PathV dir_there = dir;
  if (lanes.bits != 0) rays_to_objects(lanes, origin_there, dir_there);
  Surface s = surfaces_of(scene, lanes.primitive, kinds, origin_there, dir_there, hits.t + i);
  if (lanes.bits != 0) surfaces_to_world(lanes, s);
  face_viewer(s, dir);
  store_surface(s, dir, i, batch);
  lanes.growth.store_aligned(batch.growth + i);
}

// The surfaces that rays i .. hit, of the lanes in `bits`; other rows hold no meaning.
FASTRT_INLINE void find_surfaces(const ShadingView& scene, const PathBatch& rays, const HitBatch& hits,
                                 std::uint32_t bits, int i, SurfaceBatch& batch) {
  if (scene.shapes.instance_count != 0) return find_instance_surfaces(scene, rays, hits, bits, i, batch);
  const std::int32_t* primitives = hits.primitive + i;
  const PathI ids = PathI::load_aligned(primitives);
  const HitKinds kinds = kinds_of(scene, ids, bits);
  materials_of(scene, ids, kinds).store_aligned(batch.material + i);
  flat_ones(ids, kinds.flat).store_aligned(batch.planar + i);
  const PathV origin = load3<PathF>(rays.origin_x + i, rays.origin_y + i, rays.origin_z + i);
  const PathV dir = load3<PathF>(rays.dir_x + i, rays.dir_y + i, rays.dir_z + i);
  Surface s = surfaces_of(scene, primitives, kinds, origin, dir, hits.t + i);
  face_viewer(s, dir);
  store_surface(s, dir, i, batch);
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
