// SPDX-License-Identifier: Apache-2.0
#include "src/scene/photon_lights.hpp"

#include "src/film/photon_sampling.hpp"
#include "src/scene/light_meshes.hpp"
#include "src/scene/light_numbers.hpp"
#include "src/scene/photon_targets.hpp"
#include "src/scene/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fastrt {
namespace {

using DVec3 = glm::dvec3;

constexpr std::uint32_t all_cells = emission_side * emission_side;

struct Frame3 {
  DVec3 u, v, w;
};

Frame3 frame_around(const DVec3& axis) {
  const DVec3 w = glm::normalize(axis);
  const DVec3 other = std::fabs(w.x) < 0.5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
  const DVec3 u = glm::normalize(glm::cross(w, other));
  return {u, glm::cross(w, u), w};
}

// The point (x, y), each -1, 0 or 1, of a cell: its corners, the middles of its sides and its own.
SampleOffset cell_point(std::uint32_t code, int x, int y) {
  const auto place = [](std::uint32_t i, int step) {
    return (2.0F * static_cast<float>(i) + 1.0F + static_cast<float>(step)) /
               static_cast<float>(emission_side) -
           1.0F;
  };
  return {place(even_bits(code), x), place(even_bits(code >> 1U), y)};
}

// The cells of `light` for which touches(code) holds.
template <class Touches>
std::vector<std::uint16_t> cells_where(const Touches& touches) {
  std::vector<std::uint16_t> cells;
  for (std::uint32_t code = 0; code < all_cells; ++code)
    if (touches(code)) cells.push_back(static_cast<std::uint16_t>(code));
  return cells;
}

DVec3 direction_of(const PhotonLight& row, const SampleOffset& place) {
  const LightPlace d = cap_direction(place, row.cap_height);
  return glm::normalize(DVec3(row.u) * double(d.x) + DVec3(row.v) * double(d.y) + DVec3(row.w) * double(d.z));
}

double angle_between(const DVec3& a, const DVec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

// The angle between a cell's middle and the farthest of its directions.
double cell_radius(const PhotonLight& row, std::uint32_t code, const DVec3& middle) {
  double radius = 0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x)
      radius = std::max(radius, angle_between(middle, direction_of(row, cell_point(code, x, y))));
  return 1.05 * radius + 1e-3;
}

// Whether a ball is seen from anywhere within `reach` of the point in a direction of the cone.
bool sees(const DVec3& point, double reach, const DVec3& axis, double half_angle,
          const PhotonTargets::Ball& ball) {
  const DVec3 way = ball.center - point;
  const double distance = glm::length(way), radius = ball.radius + reach;
  if (distance <= radius) return true;
  return angle_between(way / distance, axis) <= std::asin(radius / distance) + half_angle;
}

// How far the points of a light are from its middle, at most.
double reach_of(const Light& light) {
  const LightAxes axes = light_axes(light);
  return glm::length(DVec3(axes.u)) + glm::length(DVec3(axes.v)) + glm::length(DVec3(axes.w));
}

void aim_cells(const Light& light, const PhotonTargets& targets, PhotonLight& row) {
  const double reach = reach_of(light);
  row.cells = cells_where([&](std::uint32_t code) {
    if (targets.everywhere) return true;
    const DVec3 middle = direction_of(row, cell_point(code, 0, 0));
    const double radius = cell_radius(row, code, middle);
    return std::any_of(targets.balls.begin(), targets.balls.end(), [&](const PhotonTargets::Ball& ball) {
      return sees(light.position, reach, middle, radius, ball);
    });
  });
}

void aim_parallel_cells(const PhotonTargets& targets, PhotonLight& row) {
  const double side = static_cast<double>(row.half_side);
  row.cells = cells_where([&](std::uint32_t code) {
    if (targets.everywhere) return true;
    const SampleOffset place = cell_point(code, 0, 0);
    return std::any_of(targets.balls.begin(), targets.balls.end(), [&](const PhotonTargets::Ball& ball) {
      const DVec3 way = ball.center - DVec3(row.middle);
      const double x = std::fabs(glm::dot(way, DVec3(row.u)) - side * double(place.x));
      const double y = std::fabs(glm::dot(way, DVec3(row.v)) - side * double(place.y));
      const double half = 1.001 * side / emission_side;
      return std::hypot(std::max(x - half, 0.0), std::max(y - half, 0.0)) <= ball.radius;
    });
  });
}

void set_frame(const Frame3& frame, PhotonLight& row) {
  row.u = frame.u;
  row.v = frame.v;
  row.w = frame.w;
}

// How far before the point that is the middle of the beam light starts: `least`, or before all planes, which
// have no bounds, that a corner of the beam comes through within `most`.
double before_planes(const Scene& scene, const DVec3& middle, const PhotonLight& row, double least,
                     double most) {
  const double side = static_cast<double>(row.half_side);
  double ahead = least;
  for (const PlaneShape& plane : scene.shapes().planes)
    for (const double x : {-side, side})
      for (const double y : {-side, side}) {
        const DVec3 corner = middle + x * DVec3(row.u) + y * DVec3(row.v);
        const DVec3 normal(plane.normal);
        const double way = glm::dot(corner - DVec3(plane.point), normal) / glm::dot(DVec3(row.w), normal);
        if (way < most) ahead = std::max(ahead, 1.01 * way);
      }
  return ahead;
}

// Parallel light starts outside of the ball around the scene's bounds, on a square before all targets.
double plan_parallel(const Scene& scene, const Light& light, const PhotonTargets& targets, PhotonLight& row) {
  constexpr double farthest = 1000; // times the scene's radius: floats have digits for no more
  if (scene.bounds().empty() || (targets.balls.empty() && !targets.everywhere)) return 0;
  const PhotonTargets::Ball whole = ball_around(scene.bounds());
  const PhotonTargets::Ball target = targets.everywhere ? whole : ball_around(targets);
  set_frame(frame_around(DVec3(light.direction)), row);
  const DVec3 w(row.w);
  const double side = std::max(std::min(target.radius, whole.radius), 1e-6 * glm::length(whole.center));
  row.half_side = static_cast<float>(1.005 * side);
  const double ahead = 1.01 * whole.radius + glm::dot(target.center - whole.center, w);
  row.middle = target.center - before_planes(scene, target.center, row, ahead, farthest * whole.radius) * w;
  aim_parallel_cells(targets, row);
  return 4 * double(row.half_side) * double(row.half_side);
}

// The cap of the sphere of directions that a light sends photons to: a spot's own, or that around the
// targets where it is smaller. Returns its solid angle.
double plan_point(const Light& light, const PhotonTargets& targets, PhotonLight& row) {
  const bool spot = light.kind == LightKind::spot;
  set_frame(frame_around(spot ? DVec3(light.direction) : DVec3(0, 1, 0)), row);
  row.cap_height = spot ? 1.0F - spot_cone(light).rim : 2.0F;
  if (!targets.everywhere && !targets.balls.empty()) {
    const PhotonTargets::Ball target = ball_around(targets);
    const DVec3 way = target.center - DVec3(light.position);
    const double sine = 1.001 * (target.radius + reach_of(light)) / glm::length(way);
    const double half_sine = std::sin(0.5 * std::asin(std::min(sine, 1.0)));
    const auto height = static_cast<float>(2.002 * half_sine * half_sine);
    if (sine < 1 && height < row.cap_height) {
      set_frame(frame_around(way), row);
      row.cap_height = height;
    }
  }
  aim_cells(light, targets, row);
  return 2 * std::numbers::pi * double(row.cap_height);
}

// A mesh sends photons all around, to both sides. Its points shine as a matt surface does: pi of the
// radiance leaves a unit of area, of which the Whitted picture shows 1 / pi.
double plan_mesh(const LightMesh& mesh, const PhotonTargets& targets, PhotonLight& row) {
  if (targets.balls.empty() && !targets.everywhere) return 0;
  row.cells = cells_where([](std::uint32_t) { return true; });
  return 2 * std::numbers::pi * double(mesh.area_over_pi);
}

// What photons of a light become as its light fades on the way to the middle of the scene.
double fade_factor(const Scene& scene, const Light& light) {
  if (light.kind == LightKind::directional || light.kind == LightKind::mesh) return 1;
  double d = 1;
  if (!scene.bounds().empty()) {
    const PhotonTargets::Ball whole = ball_around(scene.bounds());
    d = std::max(glm::length(DVec3(light.position) - whole.center), 0.5 * whole.radius);
  }
  const double strength = double(light.constant) + d * (double(light.linear) + d * double(light.quadratic));
  return strength > 0 ? d * d / strength : 1;
}

// Deals the photons out by the light that the lights bring; each that brings some gets one at least.
void deal(const std::vector<double>& power, std::int64_t photons, PhotonPlan& plan) {
  double sum = 0;
  for (const double p : power) sum += p;
  for (std::size_t i = 0; i < power.size(); ++i) {
    const double share = std::floor(static_cast<double>(photons) * power[i] / sum + 0.5);
    plan.lights[i].count = static_cast<std::uint32_t>(std::max(share, 1.0));
    plan.count += plan.lights[i].count;
  }
  for (PhotonLight& row : plan.lights)
    row.flux *= static_cast<float>(static_cast<double>(plan.count) / static_cast<double>(row.count));
}

PhotonPlan plan_photons(const Scene& scene, const PhotonTargets& targets, std::int64_t photons,
                        bool with_shadows_only) {
  PhotonPlan plan;
  std::vector<double> power;
  for (std::size_t i = 0; i < scene.lights().size(); ++i) {
    const Light& light = scene.lights()[i];
    if (with_shadows_only && !light.casts_shadows) continue;
    PhotonLight row{};
    row.light = static_cast<std::uint32_t>(i);
    const LightMesh& mesh = scene.light_meshes().lights[i];
    const bool is_mesh = light.kind == LightKind::mesh;
    const double measure = is_mesh                                ? plan_mesh(mesh, targets, row)
                           : light.kind == LightKind::directional ? plan_parallel(scene, light, targets, row)
                                                                  : plan_point(light, targets, row);
    const double sent = measure * static_cast<double>(row.cells.size()) / all_cells;
    const Vec3 intensity = is_mesh ? mesh.radiance : light.intensity;
    row.flux = intensity * static_cast<float>(sent);
    const float most = std::max(intensity.x, std::max(intensity.y, intensity.z));
    if (!(most > 0.0F) || !(sent > 0.0)) continue;
    power.push_back(double(most) * sent * fade_factor(scene, light));
    plan.lights.push_back(std::move(row));
  }
  if (!plan.lights.empty()) deal(power, photons, plan);
  return plan;
}

} // namespace

PhotonPlan plan_forward_photons(const Scene& scene, std::int64_t photons) {
  return plan_photons(scene, whole_scene(scene), photons, false);
}

PhotonPlan plan_caustic_photons(const Scene& scene, std::int64_t photons) {
  return plan_photons(scene, specular_objects(scene), photons, true);
}

} // namespace fastrt
