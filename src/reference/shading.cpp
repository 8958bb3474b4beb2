// SPDX-License-Identifier: Apache-2.0
#include "src/reference/shading.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/textures.hpp"
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

namespace {

// A point light's shadow ray comes from the light: rays from one origin share work elsewhere, and 0 < t < 1
// is the way to the surface. A directional light's goes towards it, without end.
Ray shadow_ray(const Light& light, const Surface& surface, const Vec3& to_light) {
  Ray ray;
  ray.excluded = surface.planar;
  if (light.kind == LightKind::point) {
    const float offset = offset_for(max(surface.magnitude, largest_magnitude(light.position)));
    const Vec3 end = surface.point + offset * surface.geometric_normal;
    ray.origin = light.position;
    ray.direction = end - light.position;
    ray.t_max = 1.0F;
  } else {
    ray.origin = surface.point + offset_for(surface.magnitude) * surface.geometric_normal;
    ray.direction = to_light;
  }
  return ray;
}

// What is left of the light along a shadow ray: starts as 1, and every surface on the way takes its part.
Vec3 let_through(const Scene& scene, const HitFinder& finder, Ray ray) {
  if (!scene.has_transmission()) return finder.any(ray) ? Vec3(0.0F) : Vec3(1.0F);
  Vec3 left{1.0F};
  for (Hit hit = finder.closest(ray); hit.found(); hit = finder.closest(ray)) {
    const auto primitive = static_cast<std::uint32_t>(hit.primitive);
    const Material& material = scene.materials()[scene.material_of(primitive)];
    if (!is_transmissive(material)) return Vec3(0.0F);
    left = left * transmittance(material, opacity_at(scene, ray, hit));
    if (left == Vec3(0.0F)) return left;
    ray.t_min = hit.t;
  }
  return left;
}

} // namespace

Vec3 shade(const Scene& scene, const HitFinder& finder, const Surface& surface, RayCounts& rays,
           Vec3& light_left) {
  const Material& material = scene.materials()[surface.material];
  const Finish finish = finish_of(material, surface);
  if (material.unlit) return finish.emission + finish.diffuse;

  Vec3 lit = finish.ambient * scene.desc().ambient;
  for (const Light& light : scene.lights()) {
    const Vec3 to_light =
        glm::normalize(light.kind == LightKind::point ? light.position - surface.point : -light.direction);
    const float cos_g = glm::dot(surface.geometric_normal, to_light);
    const float cos_n = glm::dot(surface.shading_normal, to_light);
    if (!(cos_g > 0.0F && cos_n > 0.0F)) continue;
    Vec3 shadow{1.0F};
    if (light.casts_shadows) {
      ++rays.shadow;
      shadow = let_through(scene, finder, shadow_ray(light, surface, to_light));
      light_left = light_left + shadow;
    }
    lit = lit + (phong_model(material, finish, surface, to_light, cos_n) * light.intensity) * shadow;
  }
  return finish.emission + finish.opacity * lit;
}

} // namespace fastrt::reference
