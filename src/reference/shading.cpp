// SPDX-License-Identifier: Apache-2.0
#include "src/reference/shading.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/photons.hpp"
#include "src/reference/textures.hpp"
#include "src/scene/light_meshes.hpp"
#include "src/scene/light_numbers.hpp"
#include "src/simd/shared_math.hpp"

namespace fastrt::reference {

float shared_exp(float x) { return baseline::shared_exp<baseline::ScalarOps>(x); }
float shared_pow(float x, float y) { return baseline::shared_pow<baseline::ScalarOps>(x, y); }

Vec3 transmittance(const Material& material, float opacity) {
  return (1.0F - opacity) * material.transmission;
}

bool is_transmissive(const Material& material) {
  const Vec3 most = material.opacity_texture != no_texture ? material.transmission
                                                           : transmittance(material, material.opacity);
  return most.x > 0.0F || most.y > 0.0F || most.z > 0.0F;
}

Vec3 phong_model(const Material& material, const Finish& finish, const Surface& surface, const Vec3& to_light,
                 float cos_n) {
  const Vec3& n = surface.shading_normal;
  const Vec3& c = surface.to_viewer;
  float highlight = 0;
  if (material.specular != Vec3(0.0F)) {
    const float x = material.specular_model == SpecularModel::phong
                        ? glm::dot(c, (2.0F * cos_n) * n - to_light)
                        : glm::dot(n, glm::normalize(to_light + c));
    if (x > 0.0F) highlight = shared_pow(x, material.shininess);
  }
  return finish.diffuse * cos_n + finish.specular * highlight;
}

float spot_share(const Light& light, const Vec3& direction) {
  const SpotCone cone = spot_cone(light);
  const float x = glm::dot(direction, cone.axis);
  if (!(x > cone.rim)) return 0.0F;
  const float y = min((x - cone.rim) * cone.inverse_width, 1.0F);
  const float soft = (y * y) * (3.0F - 2.0F * y);
  if (light.exponent == 0.0F) return soft;
  return soft * (x > 0.0F ? shared_pow(x, light.exponent) : 0.0F);
}

namespace {

// A light, or one of the points of a light with a size.
struct LightPoint {
  Vec3 position{0.0F};
  float share = 0; // of the light's points; 0 of a light without a size
  const LightMesh* mesh = nullptr;
  Vec3 normal{0.0F}; // of a mesh, on either side
};

// A point light's shadow ray comes from the light: rays from one origin share work elsewhere, and 0 < t < 1
// is the way to the surface. That of a mesh starts off the mesh, on the surface's side. A directional light's
// goes towards it, without end.
Ray shadow_ray(const Light& light, const LightPoint& point, const Surface& surface, const Vec3& to_light) {
  Ray ray;
  ray.excluded = surface.planar;
  ray.excluded_instance = surface.instance;
  if (light.kind != LightKind::directional) {
    const float magnitude = point.mesh != nullptr ? point.mesh->magnitude : light_magnitude(light);
    const float offset = offset_for(max(surface.magnitude, magnitude * surface.growth));
    const Vec3 end = surface.point + offset * surface.geometric_normal;
    ray.origin = point.position;
    if (point.mesh != nullptr) {
      const Vec3 towards = glm::dot(point.normal, to_light) > 0.0F ? -point.normal : point.normal;
      ray.origin = point.position + offset_for(magnitude) * towards;
    }
    ray.direction = end - ray.origin;
    ray.t_max = 1.0F;
  } else {
    ray.origin = surface.point + offset_for(surface.magnitude) * surface.geometric_normal;
    ray.direction = to_light;
  }
  return ray;
}

} // namespace

// Every stretch through a medium takes its part. An endless stretch takes none: whatever surface should have
// ended it is missing.
Vec3 let_through(const Scene& scene, const HitFinder& finder, Ray ray, Media media, bool bodies_block) {
  if (!scene.has_transmission()) return finder.any(ray) ? Vec3(0.0F) : Vec3(1.0F);
  const float length = std::sqrt(glm::dot(ray.direction, ray.direction));
  Vec3 left{1.0F};
  for (Hit hit = finder.closest(ray); hit.found(); hit = finder.closest(ray)) {
    const std::uint32_t index = scene.material_of(static_cast<std::uint32_t>(hit.primitive), hit.instance);
    const Material& material = scene.materials()[index];
    left = faded(left, scene.materials(), media, (hit.t - ray.t_min) * length);
    if (!is_transmissive(material) || (bodies_block && !material.thin)) return Vec3(0.0F);
    left = left * transmittance(material, opacity_at(scene, ray, hit));
    if (left == Vec3(0.0F)) return left;
    if (!material.thin) media = media.crossed(index);
    ray.t_min = hit.t;
  }
  if (ray.t_max < infinity) left = faded(left, scene.materials(), media, (ray.t_max - ray.t_min) * length);
  return left;
}

namespace {

// A point of a light with a size. mesh: of a light that is one.
LightPoint point_of(const Light& light, const LightMesh& mesh, const LightQuestion& question,
                    std::uint32_t index, std::uint32_t count) {
  LightPoint point;
  point.share = 1.0F / static_cast<float>(count);
  const LightBits bits = light_bits(question, index, count);
  if (light.kind == LightKind::mesh) {
    const MeshPlace place = mesh_place(shares_of(mesh), bits);
    const EmitterTriangle& triangle = mesh.triangles[place.triangle];
    point.mesh = &mesh;
    point.normal = triangle.normal;
    point.position = (place.a * triangle.a + place.b * triangle.b) + place.c * triangle.c;
  } else {
    const LightAxes axes = light_axes(light);
    const LightPlace place = light_place(shape_of(light), bits);
    point.position = ((light.position + place.x * axes.u) + place.y * axes.v) + place.z * axes.w;
  }
  return point;
}

// What every light has to say of one surface.
class Lighting {
public:
  Lighting(const Scene& scene, const HitFinder& finder, const Surface& surface, bool bodies_block)
      : scene_(scene), finder_(finder), surface_(surface), bodies_block_(bodies_block),
        material_(scene.materials()[surface.material]), finish_(finish_of(material_, surface)) {}

  const Finish& finish() const { return finish_; }
  // Adds what a light, or a point of it, gives to `lit`. media: what its shadow ray starts in.
  void add(const Light& light, const LightPoint& point, const Media& media, Vec3& lit, RayCounts& rays,
           Vec3& light_left) const;

private:
  const Scene& scene_;
  const HitFinder& finder_;
  const Surface& surface_;
  bool bodies_block_;
  const Material& material_;
  Finish finish_;
};

// How much of a light's intensity comes from the point `way` away, in the unit direction `to_light`.
float strength_of(const Light& light, const LightPoint& point, const Vec3& way, const Vec3& to_light) {
  if (point.mesh != nullptr) {
    const float cosine = std::fabs(glm::dot(point.normal, to_light));
    return ((cosine * point.mesh->area_over_pi) / glm::dot(way, way)) * point.share;
  }
  const float d = std::sqrt(glm::dot(way, way));
  float strength = 1.0F / (light.constant + d * (light.linear + light.quadratic * d));
  if (light.kind == LightKind::spot) strength = strength * spot_share(light, -to_light);
  if (point.share != 0.0F) strength = strength * point.share;
  return strength;
}

void Lighting::add(const Light& light, const LightPoint& point, const Media& media, Vec3& lit,
                   RayCounts& rays, Vec3& light_left) const {
  const bool is_spot = light.kind == LightKind::spot;
  const Vec3 way = light.kind == LightKind::directional ? -light.direction : point.position - surface_.point;
  const Vec3 to_light = glm::normalize(way);
  const float cos_g = glm::dot(surface_.geometric_normal, to_light);
  const float cos_n = glm::dot(surface_.shading_normal, to_light);
  if (!(cos_g > 0.0F && cos_n > 0.0F)) return;
  if (is_spot && !(glm::dot(-to_light, spot_cone(light).axis) > spot_cone(light).rim)) return;
  Vec3 intensity = point.mesh != nullptr ? point.mesh->radiance : light.intensity;
  if (is_spot || point.share != 0.0F || fades(light))
    intensity = intensity * strength_of(light, point, way, to_light);
  Vec3 shadow{1.0F};
  if (light.casts_shadows) {
    ++rays.shadow;
    shadow = let_through(scene_, finder_, shadow_ray(light, point, surface_, to_light), media, bodies_block_);
    light_left = light_left + (point.share != 0.0F ? shadow * point.share : shadow);
  }
  lit = lit + (phong_model(material_, finish_, surface_, to_light, cos_n) * intensity) * shadow;
}

} // namespace

Vec3 shade(const Scene& scene, const HitFinder& finder, const Surface& surface, const LightSampling& sampling,
           const PhotonMap* caustics, RayCounts& rays, Vec3& light_left) {
  const Lighting lighting(scene, finder, surface, caustics != nullptr);
  const Finish& finish = lighting.finish();
  if (scene.materials()[surface.material].unlit) return finish.emission + finish.diffuse;

  Vec3 lit = finish.ambient * scene.ambient();
  LightQuestion question = sampling.question;
  for (const Light& light : scene.lights()) {
    const Media& media =
        light.kind == LightKind::directional ? sampling.surface_media : sampling.light_media[question.light];
    if (shape_of(light) == LightShape::none) {
      LightPoint point;
      point.position = light.position;
      lighting.add(light, point, media, lit, rays, light_left);
    } else {
      const auto count = static_cast<std::uint32_t>(sampling.count);
      const LightMesh& mesh = scene.light_meshes().lights[question.light];
      for (std::uint32_t i = 0; i < count; ++i)
        lighting.add(light, point_of(light, mesh, question, i, count), media, lit, rays, light_left);
    }
    ++question.light;
  }
  if (caustics != nullptr) lit = lit + finish.diffuse * caustic_light(*caustics, surface);
  return finish.emission + finish.opacity * lit;
}

} // namespace fastrt::reference
