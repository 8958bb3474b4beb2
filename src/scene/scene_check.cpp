// SPDX-License-Identifier: Apache-2.0
#include "src/scene/scene_check.hpp"

#include "src/scene/threads.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastrt {

namespace {

constexpr std::size_t block_size = 4096;
constexpr std::size_t parallel_from = std::size_t{1} << 16U;
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

// The smallest i < count with bad(i), or `nowhere`. A block is first tested as a whole, without branches, so
// that the loop is as fast as memory.
template <class Bad>
std::size_t first_bad(std::size_t count, Bad bad) {
  const auto blocks = static_cast<std::ptrdiff_t>((count + block_size - 1) / block_size);
  std::size_t first = nowhere;
#pragma omp parallel for schedule(static) reduction(min                                                      \
                                                    : first)                                                 \
    num_threads(thread_count(0)) if (count >= parallel_from)
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    const std::size_t begin = static_cast<std::size_t>(block) * block_size;
    const std::size_t end = std::min(count, begin + block_size);
    unsigned any = 0;
    for (std::size_t i = begin; i < end; ++i) any |= static_cast<unsigned>(bad(i));
    if (any == 0) continue;
    for (std::size_t i = begin; i < end; ++i)
      if (bad(i)) {
        first = std::min(first, i);
        break;
      }
  }
  return first;
}

[[noreturn]] void refuse(const std::string& what, std::size_t i, const std::string& why) {
  throw InputError(what + " " + std::to_string(i) + ": " + why);
}

void check_finite(const Column<float>& column, const char* what, const char* axis) {
  const float* values = column.data();
  const std::size_t i = first_bad(column.size(), [values](std::size_t k) {
    return !(std::fabs(values[k]) <= std::numeric_limits<float>::max());
  });
  if (i != nowhere) refuse(what, i, std::string(axis) + " is not a finite number");
}

void check_finite(const Columns3& columns, const char* what) {
  if (columns.y.size() != columns.size() || columns.z.size() != columns.size())
    throw InputError(std::string("the ") + what + " columns differ in length");
  check_finite(columns.x, what, "x");
  check_finite(columns.y, what, "y");
  check_finite(columns.z, what, "z");
}

// optional: no_index is fine too.
void check_indices(const Column<std::uint32_t>& column, std::size_t limit, bool optional, const char* what,
                   const char* target) {
  const std::uint32_t* values = column.data();
  const std::size_t i = first_bad(column.size(), [=](std::size_t k) {
    const bool none = optional && values[k] == no_index;
    return static_cast<unsigned>(values[k] >= limit) & static_cast<unsigned>(!none);
  });
  if (i == nowhere) return;
  refuse(what, i,
         std::string("refers to ") + target + " " + std::to_string(values[i]) + ", but there are " +
             std::to_string(limit));
}

// Three columns that are either all empty or all as long as the triangles.
bool check_optional_lengths(const Column<std::uint32_t>& c0, const Column<std::uint32_t>& c1,
                            const Column<std::uint32_t>& c2, std::size_t count, const char* what) {
  const bool none = c0.empty() && c1.empty() && c2.empty();
  if (!none && (c0.size() != count || c1.size() != count || c2.size() != count))
    throw InputError(std::string("the triangles' ") + what +
                     " columns differ in length from the vertex columns");
  return !none;
}

void check_triangles(const SceneDesc& desc) {
  const TriangleColumns& t = desc.triangles;
  const std::size_t count = t.size();
  if (t.v1.size() != count || t.v2.size() != count || t.material.size() != count || t.object.size() != count)
    throw InputError("the triangles' columns differ in length");
  const bool has_normals = check_optional_lengths(t.n0, t.n1, t.n2, count, "normal");
  const bool has_uvs = check_optional_lengths(t.t0, t.t1, t.t2, count, "texture coordinate");
  for (const auto* column : {&t.v0, &t.v1, &t.v2})
    check_indices(*column, desc.positions.size(), false, "triangle", "vertex");
  if (has_normals)
    for (const auto* column : {&t.n0, &t.n1, &t.n2})
      check_indices(*column, desc.normals.size(), true, "triangle", "normal");
  if (has_uvs)
    for (const auto* column : {&t.t0, &t.t1, &t.t2})
      check_indices(*column, desc.uvs.size(), true, "triangle", "texture coordinate");
  check_indices(t.material, desc.materials.size(), false, "triangle", "material");
  check_indices(t.object, desc.object_names.size(), false, "triangle", "object");
}

void check_spheres(const SceneDesc& desc) {
  const SphereColumns& s = desc.spheres;
  const std::size_t count = s.size();
  if (s.y.size() != count || s.z.size() != count || s.radius.size() != count || s.material.size() != count ||
      s.object.size() != count)
    throw InputError("the spheres' columns differ in length");
  check_finite(s.x, "sphere", "x");
  check_finite(s.y, "sphere", "y");
  check_finite(s.z, "sphere", "z");
  check_finite(s.radius, "sphere", "the radius");
  const float* radius = s.radius.data();
  const std::size_t i = first_bad(count, [radius](std::size_t k) { return !(radius[k] > 0.0F); });
  if (i != nowhere) refuse("sphere", i, "the radius must be greater than 0");
  check_indices(s.material, desc.materials.size(), false, "sphere", "material");
  check_indices(s.object, desc.object_names.size(), false, "sphere", "object");
}

} // namespace

void check_scene(const SceneDesc& desc) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
  std::size_t left = most;
  for (const std::size_t count :
       {desc.triangles.size(), desc.spheres.size(), desc.cones.size(), desc.disks.size(),
        desc.polygons.size(), desc.planes.size(), desc.instances.size()}) {
    if (count > left) throw LimitError("the scene has more than " + std::to_string(most) + " primitives");
    left -= count;
  }
  for (const std::size_t count : {desc.positions.size(), desc.normals.size()})
    if (count > most)
      throw LimitError("the scene has more than " + std::to_string(most) + " vertices or normals");
  check_finite(desc.positions, "vertex");
  check_finite(desc.normals, "normal");
  if (desc.uvs.y.size() != desc.uvs.size())
    throw InputError("the texture coordinate columns differ in length");
  check_finite(desc.uvs.x, "texture coordinate", "u");
  check_finite(desc.uvs.y, "texture coordinate", "v");
  check_finite(desc.colors, "vertex colour");
  if (desc.colors.size() != 0 && desc.colors.size() != desc.positions.size())
    throw InputError("there are " + std::to_string(desc.colors.size()) + " vertex colours for " +
                     std::to_string(desc.positions.size()) + " vertices");
  check_triangles(desc);
  check_spheres(desc);
  check_shapes(desc);
  check_instances(desc);
  check_textures(desc);
  check_materials(desc);
  check_lights(desc);
}

} // namespace fastrt
