// SPDX-License-Identifier: Apache-2.0
#include "src/scene/light_meshes.hpp"

#include "src/scene/printable.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fastrt {
namespace {

using Vec3d = glm::dvec3;

// A prototype's triangles are in the scene where instances show them.
bool in_prototype(const SceneDesc& desc, std::size_t triangle) {
  return std::any_of(desc.prototypes.begin(), desc.prototypes.end(), [=](const Prototype& prototype) {
    return triangle >= prototype.begin[0] && triangle < prototype.end[0];
  });
}

float largest_magnitude(const Vec3& v) {
  return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

// What becomes of the triangles of a light: its emitters and their areas.
struct Emitters {
  LightMesh& mesh;
  std::vector<double> areas;

  // Unless it has no area.
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3d across = glm::cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
    const double size = glm::length(across);
    if (!(size > 0.0)) return;
    mesh.triangles.push_back({a, b, c, Vec3(across / size)});
    for (const Vec3& corner : {a, b, c}) mesh.magnitude = std::max(mesh.magnitude, largest_magnitude(corner));
    areas.push_back(0.5 * size);
  }
};

Vec3 placed(const Affine& map, const Vec3& point) {
  return Vec3(Vec3d(map.x) * Vec3d(point).x + Vec3d(map.y) * Vec3d(point).y + Vec3d(map.z) * Vec3d(point).z +
              Vec3d(map.origin));
}

// A scene's triangles, which need not have been checked: without those that have no three vertices.
class Corners {
public:
  explicit Corners(const SceneDesc& desc)
      : desc_(desc),
        vertices_(std::min({desc.positions.x.size(), desc.positions.y.size(), desc.positions.z.size()})) {
    const TriangleColumns& t = desc.triangles;
    count_ = std::min({t.v0.size(), t.v1.size(), t.v2.size(), t.material.size()});
  }

  std::size_t triangle_count() const { return count_; }

  bool find(std::size_t triangle, Vec3 (&corners)[3]) const {
    const TriangleColumns& t = desc_.triangles;
    const std::uint32_t vertices[] = {t.v0[triangle], t.v1[triangle], t.v2[triangle]};
    for (std::size_t i = 0; i < 3; ++i) {
      if (vertices[i] >= vertices_) return false;
      corners[i] = desc_.positions[vertices[i]];
    }
    return true;
  }

private:
  const SceneDesc& desc_;
  std::size_t vertices_, count_ = 0;
};

void gather_shown_triangles(const SceneDesc& desc, const Corners& corners, std::uint32_t material,
                            Emitters& emitters) {
  const InstanceColumns& instances = desc.instances;
  const std::size_t count =
      std::min({instances.size(), instances.material.size(), instances.to_world.size()});
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t own = instances.material[k];
    if (instances.prototype[k] >= desc.prototypes.size() || (own != no_index && own != material)) continue;
    const Prototype& prototype = desc.prototypes[instances.prototype[k]];
    const Affine& map = instances.to_world[k];
    const std::size_t end = std::min<std::size_t>(prototype.end[0], corners.triangle_count());
    Vec3 at[3];
    for (std::size_t i = prototype.begin[0]; i < end; ++i)
      if ((own == material || desc.triangles.material[i] == material) && corners.find(i, at))
        emitters.add(placed(map, at[0]), placed(map, at[1]), placed(map, at[2]));
  }
}

// The triangles of a material that have an area, and their areas.
std::vector<double> gather_triangles(const SceneDesc& desc, std::uint32_t material, LightMesh& mesh) {
  Emitters emitters{mesh, {}};
  const Corners corners(desc);
  Vec3 at[3];
  for (std::size_t i = 0; i < corners.triangle_count(); ++i)
    if (desc.triangles.material[i] == material && !in_prototype(desc, i) && corners.find(i, at))
      emitters.add(at[0], at[1], at[2]);
  gather_shown_triangles(desc, corners, material, emitters);
  return emitters.areas;
}

// Two zeros after each of the ten lowest bits.
std::uint32_t spread_bits(std::uint32_t x) {
  x = (x | x << 16U) & 0x030000FFU;
  x = (x | x << 8U) & 0x0300F00FU;
  x = (x | x << 4U) & 0x030C30C3U;
  return (x | x << 2U) & 0x09249249U;
}

// Along Morton's curve: so that points that are chosen by numbers near each other lie near each other, and
// the shadow rays to them have much in common.
void put_in_order(LightMesh& mesh, std::vector<double>& areas) {
  const auto centroid = [](const EmitterTriangle& t) {
    return Vec3((Vec3d(t.a) + Vec3d(t.b) + Vec3d(t.c)) / 3.0);
  };
  Aabb bounds;
  for (const EmitterTriangle& triangle : mesh.triangles) bounds.extend(centroid(triangle));
  const Vec3 extent = bounds.extent();
  const float side = std::max(extent.x, std::max(extent.y, extent.z));
  const float scale = side > 0.0F ? 1023.0F / side : 0.0F;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> places; // on the curve, and in the mesh
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vec3 at = (centroid(mesh.triangles[i]) - bounds.lower) * scale;
    const auto bits = [](float x) {
      return spread_bits(static_cast<std::uint32_t>(x > 0.0F ? std::min(x, 1023.0F) : 0.0F));
    };
    places.emplace_back(bits(at.x) | bits(at.y) << 1U | bits(at.z) << 2U, static_cast<std::uint32_t>(i));
  }
  std::sort(places.begin(), places.end());
  const std::vector<EmitterTriangle> triangles = std::move(mesh.triangles);
  const std::vector<double> old_areas = std::move(areas);
  mesh.triangles.clear();
  areas.clear();
  for (const auto& [code, i] : places) {
    mesh.triangles.push_back(triangles[i]);
    areas.push_back(old_areas[i]);
  }
}

LightMesh mesh_of(const SceneDesc& desc, std::size_t light_index) {
  const Light& light = desc.lights[light_index];
  LightMesh mesh;
  if (light.kind != LightKind::mesh) return mesh;
  const Material& material = desc.materials[light.material];
  std::vector<double> areas = gather_triangles(desc, light.material, mesh);
  if (areas.empty())
    throw InputError("light " + std::to_string(light_index) + ": no triangle has the material '" +
                     printable(material.name) + "'");
  const EmitterTriangle first = mesh.triangles.front();
  put_in_order(mesh, areas);
  double total = 0.0;
  for (const double area : areas) total += area;
  double before = 0.0;
  for (const double area : areas) {
    mesh.begin.push_back(static_cast<std::uint32_t>(std::min(before / total * 0x1p32, 4294967295.0)));
    before += area;
  }
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double end = i + 1 < areas.size() ? mesh.begin[i + 1] : 0x1p32;
    mesh.scale.push_back(
        static_cast<float>(2.0 / std::max(end - mesh.begin[i], 1.0))); // none chooses it: any
  }
  mesh.radiance = material.emission * light.intensity;
  mesh.area_over_pi = static_cast<float>(total / std::numbers::pi);
  mesh.middle = Vec3((Vec3d(first.a) + Vec3d(first.b) + Vec3d(first.c)) / 3.0);
  return mesh;
}

} // namespace

std::size_t LightMeshes::bytes() const noexcept {
  std::size_t sum = 0;
  for (const LightMesh& mesh : lights)
    sum += mesh.triangles.size() * sizeof(EmitterTriangle) +
           mesh.begin.size() * (sizeof(std::uint32_t) + sizeof(float));
  return sum;
}

std::vector<Light> emissive_lights(const SceneDesc& desc, float brighter_than) {
  const auto shines = [&](const Material& material) {
    const Vec3& e = material.emission;
    return material.emission_texture == no_texture && std::max(e.x, std::max(e.y, e.z)) > brighter_than;
  };
  std::vector<Light> lights;
  for (std::uint32_t i = 0; i < desc.materials.size(); ++i) {
    LightMesh mesh;
    if (!shines(desc.materials[i]) || gather_triangles(desc, i, mesh).empty()) continue;
    lights.emplace_back();
    lights.back().kind = LightKind::mesh;
    lights.back().material = i;
  }
  return lights;
}

LightMeshes make_light_meshes(const SceneDesc& desc) {
  LightMeshes meshes;
  for (std::size_t i = 0; i < desc.lights.size(); ++i) meshes.lights.push_back(mesh_of(desc, i));
  return meshes;
}

} // namespace fastrt
