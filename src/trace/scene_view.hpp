// SPDX-License-Identifier: Apache-2.0
// The scene as the kernels see it: plain pointers and plain rows, no containers. Made once per tracer; it
// owns nothing.
#pragma once

#include "src/accel/wide_node.hpp"
#include "src/trace/texture_view.hpp"

#include <cstdint>

namespace fastrt {

inline constexpr int max_media = 4; // media that a ray can be in at once

// Values of the public interface, which kernels don't see; scene_rows.cpp holds them equal.
inline constexpr std::uint32_t no_row = 0xFFFFFFFFU; // no_index: a corner has no normal or texture coordinate
inline constexpr std::uint32_t fresnel_schlick = 1, fresnel_dielectric = 2; // MaterialRow::fresnel

// Four triangles, their vertices as columns: x of vertex v of triangle i is x[v][i]. Rows that are not used
// hold NaN, which no comparison lets through, and the id -1.
struct alignas(32) TriangleBlock {
  float x[3][block_size], y[3][block_size], z[3][block_size];
  std::int32_t primitive[block_size];
};

struct alignas(32) SphereBlock {
  float x[block_size], y[block_size], z[block_size], radius[block_size];
  std::int32_t primitive[block_size];
};

// Four primitives of the other kinds, or instances: their boxes and ids; what a ray needs to meet one is in
// ShapeView.
struct alignas(32) ShapeBlock {
  float low_x[block_size], low_y[block_size], low_z[block_size];
  float high_x[block_size], high_y[block_size], high_z[block_size];
  std::int32_t primitive[block_size];
};

// The names are those of src/scene/shapes.hpp; low and high are the box.
struct ConeRow {
  float center[3], axis[3], side[3];
  float half_height, radius, slope;
  float low[3], high[3];
  std::uint32_t capped;
};
struct DiskRow {
  float center[3], normal[3], side[3];
  float radius;
  float low[3], high[3];
};
struct PolygonRow {
  float point[3], normal[3], side[3];
  float low[3], high[3];
  std::uint32_t axis_x, axis_y, first_edge, edge_count;
  std::uint32_t first_band, band_count; // 0 bands: few edges, which are looked at one by one
  float band_low, band_scale;           // the height y lies in the band (y - band_low) * band_scale
};
// Heights of a polygon with many edges, and the edges (a list of their own) that reach into them.
struct BandRow {
  std::uint32_t first_edge, edge_count;
};
struct EdgeRow {
  float low, high, x, slope;
};
struct PlaneRow {
  float point[3], normal[3], side[3];
};

// A prototype as the scene shows it in one place; src/scene/shapes.hpp says what the numbers are. Maps are
// columns: what becomes of the three axes and of the origin.
struct InstanceRow {
  float to_object[4][3], to_world[4][3];
  float low[3], high[3]; // the box in world space
  float growth;
  float largest_coordinate;       // of any box in the prototype's tree
  std::uint32_t root;             // of that tree
  std::uint32_t material, object; // of all that it shows; no_row: the primitives' own
};

// The primitives that are neither triangles nor spheres, by kind. Their ids follow one another, and those of
// instances come after them: what a leaf of the scene's tree holds from first_plane on is an instance.
struct ShapeView {
  const ConeRow* cones;
  const DiskRow* disks;
  const PolygonRow* polygons;
  const EdgeRow* edges;
  const BandRow* bands;
  const PlaneRow* planes; // in no tree: every ray is held against every plane
  const InstanceRow* instances;
  std::int32_t first_cone, first_disk, first_polygon, first_plane, first_instance; // ids
  std::uint32_t plane_count, instance_count;
};

// Group numbers of the tree's leaves.
inline constexpr std::uint32_t triangle_group = 0;
inline constexpr std::uint32_t sphere_group = 1;
inline constexpr std::uint32_t shape_group = 2; // cones, disks, polygons and instances, mixed

// What a ray must know to meet the scene's primitives.
struct GeometryView {
  const WideNode* nodes;
  const TriangleBlock* triangles;
  const SphereBlock* spheres;
  const ShapeBlock* shape_blocks;
  ShapeView shapes;
  std::uint32_t root;            // a child reference; no_child for an empty scene
  float largest_coordinate;      // of any box in the tree
  std::uint32_t culls;           // 0: the boxes are boundless, and every ray is to meet every primitive
  std::uint32_t has_triangles;   // some leaf holds triangles
  std::uint32_t only_triangles;  // no leaf holds anything else
  std::uint32_t few_shapes;      // hardly any leaf holds cones, disks, polygons or instances
  std::uint32_t primitive_count; // in leaves; whole blocks are counted
};

// A material as the shading reads it; the names are those of docs/numerics.md.
struct MaterialRow {
  float ambient[3], diffuse[3], specular[3], emission[3];
  float mirror[3], transmit[3], absorption[3];
  float shininess, opacity, ior;
  std::uint32_t blinn, fresnel, thin, unlit;
  std::uint32_t has_specular, has_mirror, has_transmit, has_absorption;
  const SurfaceTextures* textures; // null: the same everywhere
  float transmission[3];           // Kt
  std::uint32_t passes_light;      // straight through, to what it would shadow
};

// A triangle of a light that is a mesh. The fourth numbers are 0.
struct alignas(16) EmitterRow {
  float corners[3][4]; // xyz of each
  float normal[4];     // unit, on either side
};

struct LightRow {
  float position[3]; // of lights that have one; of a mesh some point of it
  float to_light[3]; // directional lights: normalised
  float intensity[3];
  float largest_coordinate; // of the position
  std::uint32_t directional;
  std::uint32_t casts_shadows;
  // Of the lights that not every scene has.
  std::uint32_t shape; // a LightShape
  std::uint32_t spot;
  std::uint32_t varies;                        // its strength: fades, is a spot, or has a size
  float constant, linear, quadratic;           // how it fades
  float axis[3], rim, inverse_width, exponent; // spots
  float half_axes[3][3];                       // of lights with a size
  const EmitterRow* emitters;                  // meshes
  const std::uint32_t* emitter_begin;          // LightMesh::begin
  const float* emitter_scale;                  // LightMesh::scale
  std::uint32_t emitter_count;
  float area_over_pi;
  std::int32_t media[max_media]; // that its place is in, innermost first; -1: none. Of scenes that absorb.
};

// What shading needs beyond the geometry. Columns as in TriangleColumns and SphereColumns; the normal columns
// are null when no triangle has normals.
struct ShadingView {
  const float *position_x, *position_y, *position_z;
  const float *normal_x, *normal_y, *normal_z;
  const float *uv_x, *uv_y;                 // null when no triangle has any, with t0..t2
  const float *color_x, *color_y, *color_z; // null when there are none
  const std::uint32_t *v0, *v1, *v2;
  const std::uint32_t *n0, *n1, *n2;
  const std::uint32_t *t0, *t1, *t2;
  const float *sphere_x, *sphere_y, *sphere_z, *sphere_radius;
  const std::uint32_t *triangle_material, *sphere_material;
  const std::uint32_t *triangle_object, *sphere_object;
  const std::uint32_t *shape_material,
      *shape_object; // of cones, disks, polygons and planes, one after the other
  ShapeView shapes;
  const MaterialRow* materials;
  const LightRow* lights;
  std::uint32_t triangle_count, sphere_count, light_count;
  std::uint32_t sends_on;         // some material reflects, or lets light through ..
  std::uint32_t has_transmission; // .. the latter
  std::uint32_t has_absorption;
  std::uint32_t has_textures; // some material has
  float ambient[3], background[3];
};

struct SceneView {
  GeometryView geometry;
  ShadingView shading;
};

} // namespace fastrt
