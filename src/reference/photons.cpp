// SPDX-License-Identifier: Apache-2.0
#include "src/reference/photons.hpp"

#include "src/film/photon_sampling.hpp"
#include "src/reference/arithmetic.hpp"
#include "src/reference/media.hpp"
#include "src/reference/shading.hpp"
#include "src/scene/light_meshes.hpp"
#include "src/scene/light_numbers.hpp"
#include "src/scene/threads.hpp"

#include <cmath>
#include <exception>

namespace fastrt::reference {
namespace {

// A direction of a frame around the unit vector n, which is its z axis.
Vec3 turned_to(const Vec3& n, const LightPlace& d) {
  const float sign = std::copysign(1.0F, n.z);
  const float a = -(1.0F / (sign + n.z));
  const float b = (n.x * n.y) * a;
  const Vec3 u{1.0F + (sign * (n.x * n.x)) * a, sign * b, -(sign * n.x)};
  const Vec3 v{b, sign + (n.y * n.y) * a, -n.y};
  return (d.x * u + d.y * v) + d.z * n;
}

// A ray off one of the mesh's triangles, to either side.
Ray start_on_mesh(const LightMesh& mesh, const PhotonLight& row, const SampleOffset& place,
                  std::uint32_t index, std::uint32_t seed) {
  const MeshPlace start = photon_mesh_start(shares_of(mesh), index, row.light, seed);
  const EmitterTriangle& triangle = mesh.triangles[start.triangle];
  const LightPlace way = matt_direction(place);
  const Vec3 towards = std::copysign(1.0F, way.z) * triangle.normal;
  const Vec3 point = (start.a * triangle.a + start.b * triangle.b) + start.c * triangle.c;
  Ray ray;
  ray.origin = point + offset_for(mesh.magnitude) * towards;
  ray.direction = turned_to(triangle.normal, way);
  return ray;
}

PhotonNode emit(const Light& light, const LightMesh& mesh, const PhotonLight& row, std::uint32_t index,
                std::uint32_t seed) {
  PhotonNode photon;
  photon.index = index;
  photon.key = photon_key(index, row.light, seed);
  const SampleOffset place = photon_place(index, row.count, row.cells.data(),
                                          static_cast<std::uint32_t>(row.cells.size()), photon.key);
  if (light.kind == LightKind::directional) {
    photon.ray.origin = (row.middle + (place.x * row.half_side) * row.u) + (place.y * row.half_side) * row.v;
    photon.ray.direction = row.w;
    return photon;
  }
  if (light.kind == LightKind::mesh) {
    photon.ray = start_on_mesh(mesh, row, place, index, seed);
    return photon;
  }
  photon.ray.origin = light.position;
  if (shape_of(light) != LightShape::none) {
    const LightAxes axes = light_axes(light);
    const LightPlace start = photon_start(shape_of(light), index, row.light, seed);
    photon.ray.origin = ((light.position + start.x * axes.u) + start.y * axes.v) + start.z * axes.w;
  }
  const LightPlace way = cap_direction(place, row.cap_height);
  photon.ray.direction = (way.x * row.u + way.y * row.v) + way.z * row.w;
  if (light.kind == LightKind::spot) photon.strength = spot_share(light, photon.ray.direction);
  return photon;
}

// Light that comes from a point fades as the light does, and not by spreading. That of meshes spreads as
// light does.
float faded_strength(const Light& light, const PhotonNode& photon) {
  const bool of_points = light.kind != LightKind::directional && light.kind != LightKind::mesh;
  if (photon.scattered || !of_points) return photon.strength;
  const float d = photon.length;
  const float f = 1.0F / (light.constant + d * (light.linear + light.quadratic * d));
  return photon.strength * (f * (d * d));
}

// The next photon of the way into `direction`, on the side of the surface that `offset` points to.
PhotonNode child_of(const PhotonNode& parent, const Surface& surface, const Vec3& weight,
                    const Vec3& direction, float offset, PhotonTurn turn) {
  PhotonNode child = parent;
  child.ray.origin = surface.point + offset * surface.geometric_normal;
  child.ray.direction = direction;
  child.ray.excluded = surface.planar;
  child.ray.excluded_instance = surface.instance;
  child.weight = weight;
  child.key = next_photon_key(parent.key, turn);
  child.depth = parent.depth + 1;
  return child;
}

// Follows photons of one light.
class Follower {
public:
  Follower(const Scene& scene, const HitFinder& finder, const Surroundings& around,
           const RenderSettings& settings, bool scatter, const Arrive& arrive, RayCounts& rays)
      : scene_(scene), finder_(finder), around_(around), settings_(settings), scatter_(scatter),
        arrive_(arrive), rays_(rays) {}

  void follow(const PhotonLight& row, std::uint32_t row_index, std::uint32_t index) {
    ++rays_.primary;
    stack_.push_back(emit(scene_.lights()[row.light], scene_.light_meshes().lights[row.light], row, index,
                          settings_.seed));
    stack_.back().media = around_.lights[row.light];
    while (!stack_.empty()) {
      PhotonNode photon = stack_.back();
      stack_.pop_back();
      const Hit hit = finder_.closest(photon.ray);
      if (!hit.found()) continue;
      const Surface surface = surface_at(scene_, photon.ray, hit);
      photon.weight = faded(photon.weight, scene_.materials(), photon.media, surface.distance);
      photon.length = photon.length + surface.distance;
      const Arrival arrival = arrive(row, row_index, photon, surface);
      if (photon.depth < settings_.max_depth) go_on(arrival);
    }
  }

private:
  // Its strength is 0 where the surface scatters none of the light.
  Arrival arrive(const PhotonLight& row, std::uint32_t row_index, const PhotonNode& photon,
                 const Surface& surface) {
    Arrival arrival{&row, row_index, photon, surface, Vec3(0.0F), 0.0F};
    const Material& material = scene_.materials()[surface.material];
    if (material.unlit) return arrival;
    const Finish finish = finish_of(material, surface);
    arrival.albedo = finish.diffuse * finish.opacity;
    const float cos_g = glm::dot(surface.geometric_normal, surface.to_viewer);
    const float cos_n = glm::dot(surface.shading_normal, surface.to_viewer);
    if (!(cos_g > 0.0F && cos_n > 0.0F && largest(arrival.albedo) > 0.0F)) {
      arrival.albedo = Vec3(0.0F);
      return arrival;
    }
    arrival.strength = faded_strength(scene_.lights()[row.light], photon) * (cos_n / cos_g);
    arrive_(arrival, rays_);
    return arrival;
  }

  bool worth_following(const Vec3& weight) const {
    return largest(weight) > 0.0F && largest(weight) >= settings_.min_contribution;
  }

  void go_on(const Arrival& arrival) {
    const PhotonNode& photon = arrival.photon;
    const Surface& surface = arrival.surface;
    const Material& material = scene_.materials()[surface.material];
    const float offset = offset_for(surface.magnitude);
    const Vec3 scattered_weight = photon.weight * arrival.albedo;
    if (scatter_ && worth_following(scattered_weight)) {
      const Vec3 direction = turned_to(surface.geometric_normal, cosine_direction(photon.key));
      PhotonNode child =
          child_of(photon, surface, scattered_weight, direction, offset, PhotonTurn::scattered);
      child.strength = arrival.strength;
      child.scattered = true;
      ++rays_.reflected;
      stack_.push_back(child);
    }
    if (material.unlit) return;
    const Secondary next = secondary_rays(scene_, surface, photon.media);
    const Vec3 refracted_weight = photon.weight * next.transmitted_weight;
    if (worth_following(refracted_weight)) {
      PhotonNode child =
          child_of(photon, surface, refracted_weight, next.transmitted, -offset, PhotonTurn::refracted);
      child.media = next.transmitted_media;
      if (!material.thin) child.bent = true;
      ++rays_.refracted;
      stack_.push_back(child);
    }
    const Vec3 reflected_weight = photon.weight * next.mirror_weight;
    if (worth_following(reflected_weight)) {
      PhotonNode child =
          child_of(photon, surface, reflected_weight, next.mirror, offset, PhotonTurn::reflected);
      child.bent = true;
      ++rays_.reflected;
      stack_.push_back(child);
    }
  }

  const Scene& scene_;
  const HitFinder& finder_;
  const Surroundings& around_;
  const RenderSettings& settings_;
  bool scatter_;
  const Arrive& arrive_;
  RayCounts& rays_;
  std::vector<PhotonNode> stack_;
};

} // namespace

void trace_photons(const Scene& scene, const HitFinder& finder, const Surroundings& around,
                   const PhotonPlan& plan, const std::vector<PhotonChunk>& chunks,
                   const RenderSettings& settings, bool scatter, const Arrive& arrive,
                   FrameProgress& progress) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(thread_count(settings.threads))
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    try {
      if (progress.stopped()) continue;
      RayCounts rays;
      Follower follower(scene, finder, around, settings, scatter, arrive, rays);
      for (std::uint32_t index = chunks[i].first; index < chunks[i].last; ++index)
        follower.follow(plan.lights[chunks[i].row], chunks[i].row, index);
      progress.part_done(rays);
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
}

} // namespace fastrt::reference
