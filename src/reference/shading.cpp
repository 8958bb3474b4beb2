// SPDX-License-Identifier: Apache-2.0
#include "src/reference/shading.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/photons.hpp"
#include "src/reference/textures.hpp"
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

namespace {

// A point light's shadow ray comes from the light: rays from one origin share work elsewhere, and 0 < t < 1
// is the way to the surface. A directional light's goes towards it, without end.
// position: of the light, or of the point of it that is asked.
Ray shadow_ray(const Light& light, const Vec3& position, const Surface& surface, const Vec3& to_light) {
  Ray ray;
  ray.excluded = surface.planar;
  if (light.kind != LightKind::directional) {
    const float offset = offset_for(max(surface.magnitude, light_magnitude(light)));
    const Vec3 end = surface.point + offset * surface.geometric_normal;
    ray.origin = position;
    ray.direction = end - position;
    ray.t_max = 1.0F;
  } else {
    ray.origin = surface.point + offset_for(surface.magnitude) * surface.geometric_normal;
    ray.direction = to_light;
  }
  return ray;
}

} // namespace

Vec3 let_through(const Scene& scene, const HitFinder& finder, Ray ray, bool bodies_block) {
  if (!scene.has_transmission()) return finder.any(ray) ? Vec3(0.0F) : Vec3(1.0F);
  Vec3 left{1.0F};
  for (Hit hit = finder.closest(ray); hit.found(); hit = finder.closest(ray)) {
    const auto primitive = static_cast<std::uint32_t>(hit.primitive);
    const Material& material = scene.materials()[scene.material_of(primitive)];
    if (!is_transmissive(material) || (bodies_block && !material.thin)) return Vec3(0.0F);
    left = left * transmittance(material, opacity_at(scene, ray, hit));
    if (left == Vec3(0.0F)) return left;
    ray.t_min = hit.t;
  }
  return left;
}

namespace {

// A point of a light with a size.
Vec3 point_of(const Light& light, const LightQuestion& question, int index, int count) {
  const LightAxes axes = light_axes(light);
  const LightPlace place = light_place(shape_of(light), question, static_cast<std::uint32_t>(index),
                                       static_cast<std::uint32_t>(count));
  return ((light.position + place.x * axes.u) + place.y * axes.v) + place.z * axes.w;
}

// How much of a spot light's intensity goes into a direction; 0 outside of its cone.
float spot_share(const Light& light, const Vec3& to_light) {
  const SpotCone cone = spot_cone(light);
  const float x = glm::dot(-to_light, cone.axis);
  if (!(x > cone.rim)) return 0.0F;
  const float y = min((x - cone.rim) * cone.inverse_width, 1.0F);
  const float soft = (y * y) * (3.0F - 2.0F * y);
  if (light.exponent == 0.0F) return soft;
  return soft * (x > 0.0F ? shared_pow(x, light.exponent) : 0.0F);
}

// What every light has to say of one surface.
class Lighting {
public:
  Lighting(const Scene& scene, const HitFinder& finder, const Surface& surface, bool bodies_block)
      : scene_(scene), finder_(finder), surface_(surface), bodies_block_(bodies_block),
        material_(scene.materials()[surface.material]), finish_(finish_of(material_, surface)) {}

  const Finish& finish() const { return finish_; }
  // Adds what the light at `position` gives to `lit`. share: of one of a light's points; 0 of a light
  // without a size.
  void add(const Light& light, const Vec3& position, float share, Vec3& lit, RayCounts& rays,
           Vec3& light_left) const;

private:
  const Scene& scene_;
  const HitFinder& finder_;
  const Surface& surface_;
  bool bodies_block_;
  const Material& material_;
  Finish finish_;
};

void Lighting::add(const Light& light, const Vec3& position, float share, Vec3& lit, RayCounts& rays,
                   Vec3& light_left) const {
  const bool is_directional = light.kind == LightKind::directional;
  const bool is_spot = light.kind == LightKind::spot;
  const Vec3 way = is_directional ? -light.direction : position - surface_.point;
  const Vec3 to_light = glm::normalize(way);
  const float cos_g = glm::dot(surface_.geometric_normal, to_light);
  const float cos_n = glm::dot(surface_.shading_normal, to_light);
  if (!(cos_g > 0.0F && cos_n > 0.0F)) return;
  Vec3 intensity = light.intensity;
  if (is_spot || share != 0.0F || fades(light)) {
    const float d = std::sqrt(glm::dot(way, way));
    float strength = 1.0F / (light.constant + d * (light.linear + light.quadratic * d));
    if (is_spot && !(glm::dot(-to_light, spot_cone(light).axis) > spot_cone(light).rim)) return;
    if (is_spot) strength = strength * spot_share(light, to_light);
    if (share != 0.0F) strength = strength * share;
    intensity = intensity * strength;
  }
  Vec3 shadow{1.0F};
  if (light.casts_shadows) {
    ++rays.shadow;
    shadow = let_through(scene_, finder_, shadow_ray(light, position, surface_, to_light), bodies_block_);
    light_left = light_left + (share != 0.0F ? shadow * share : shadow);
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
    if (shape_of(light) == LightShape::none) {
      lighting.add(light, light.position, 0.0F, lit, rays, light_left);
    } else {
      const float share = 1.0F / static_cast<float>(sampling.count);
      for (int i = 0; i < sampling.count; ++i)
        lighting.add(light, point_of(light, question, i, sampling.count), share, lit, rays, light_left);
    }
    ++question.light;
  }
  if (caustics != nullptr) lit = lit + finish.diffuse * caustic_light(*caustics, surface);
  return finish.emission + finish.opacity * lit;
}

} // namespace fastrt::reference
