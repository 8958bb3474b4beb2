// SPDX-License-Identifier: Apache-2.0
#include "src/reference/secondary.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/shading.hpp"

namespace fastrt::reference {

namespace {

// A ray that crosses from index eta_i to eta_t; cos_i of the angle on its own side.
struct Snell {
  float eta_i, eta_t, eta, cos_i;
  float cos_t = 0;
  bool total_reflection = false;

  Snell(float index_i, float index_t, float cos) : eta_i(index_i), eta_t(index_t), cos_i(cos) {
    eta = eta_i / eta_t;
    const float k = 1.0F - (eta * eta) * (1.0F - cos_i * cos_i);
    total_reflection = k < 0.0F;
    if (!total_reflection) cos_t = std::sqrt(k);
  }

  // The share that a dielectric reflects, of unpolarised light.
  float fresnel() const {
    if (total_reflection) return 1.0F;
    const float rs = (eta_i * cos_i - eta_t * cos_t) / (eta_i * cos_i + eta_t * cos_t);
    const float rp = (eta_t * cos_i - eta_i * cos_t) / (eta_t * cos_i + eta_i * cos_t);
    return 0.5F * (rs * rs + rp * rp);
  }
};

// The lecture's m_s. A shading normal may send it below the surface; then the geometric normal decides.
Vec3 mirror_direction(const Surface& surface, const Vec3& normal, float cos_i) {
  const Vec3& dn = surface.incident;
  const Vec3& ng = surface.geometric_normal;
  const Vec3 mirrored = dn + (2.0F * cos_i) * normal;
  if (!(glm::dot(mirrored, ng) <= 0.0F)) return mirrored;
  return dn + (2.0F * glm::dot(surface.to_viewer, ng)) * ng;
}

// The lecture's d_t. A shading normal may send it back above the surface; then it goes straight on.
Vec3 refracted_direction(const Surface& surface, const Vec3& normal, const Snell& snell) {
  const Vec3 bent = snell.eta * surface.incident + (snell.eta * snell.cos_i - snell.cos_t) * normal;
  return glm::dot(bent, surface.geometric_normal) >= 0.0F ? surface.incident : bent;
}

} // namespace

Secondary secondary_rays(const Scene& scene, const Surface& surface, const Media& media) {
  const std::vector<Material>& materials = scene.materials();
  const Material& material = materials[surface.material];
  const Vec3 normal = glm::dot(surface.to_viewer, surface.shading_normal) <= 0.0F ? surface.geometric_normal
                                                                                  : surface.shading_normal;
  const float cos_i = glm::dot(surface.to_viewer, normal);

  Secondary result;
  result.mirror = mirror_direction(surface, normal, cos_i);
  result.mirror_weight = material.mirror;
  result.transmitted_media = media;
  result.transmitted = surface.incident;
  const bool transmissive = is_transmissive(material);
  if (transmissive) result.transmitted_weight = transmittance(material, finish_of(material, surface).opacity);

  // Light that goes straight through, or nowhere, still meets the material's index for its Fresnel share.
  const bool bends = transmissive && !material.thin;
  if (bends) result.transmitted_media = media.crossed(surface.material);
  const Snell snell =
      bends ? Snell(ior_of(materials, media), ior_of(materials, result.transmitted_media), cos_i)
            : Snell(1.0F, material.ior, cos_i);
  if (bends && !snell.total_reflection) result.transmitted = refracted_direction(surface, normal, snell);

  if (material.fresnel == Fresnel::schlick) {
    const float x = max(1.0F - cos_i, 0.0F);
    const float x2 = x * x;
    const float x5 = (x2 * x2) * x;
    result.mirror_weight = material.mirror + (1.0F - material.mirror) * x5;
  } else if (material.fresnel == Fresnel::dielectric) {
    const float reflected = snell.fresnel();
    result.mirror_weight = material.mirror * reflected;
    result.transmitted_weight = result.transmitted_weight * (1.0F - reflected);
  }
  if (bends && snell.total_reflection) {
    result.mirror_weight = result.mirror_weight + result.transmitted_weight;
    result.transmitted_weight = Vec3(0.0F);
  }
  return result;
}

} // namespace fastrt::reference
