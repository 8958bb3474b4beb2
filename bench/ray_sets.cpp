// SPDX-License-Identifier: Apache-2.0
#include "bench/ray_sets.hpp"

#include "src/film/sampling.hpp"
#include "src/reference/surface.hpp"
#include "src/trace/tile_order.hpp"

#include <fastrt/load.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fastrt::bench {
namespace {

using reference::Surface;

enum Kind { primary, point_shadow, directional_shadow, mirror, refracted, random_rays, kind_count };
constexpr std::array<const char*, kind_count> kind_names{"primary", "point shadow", "directional shadow",
                                                         "mirror",  "refracted",    "random"};
constexpr std::array<BatchShape, kind_count> kind_shapes{BatchShape::common_origin, BatchShape::common_origin,
                                                         BatchShape::parallel,      BatchShape::coherent,
                                                         BatchShape::coherent,      BatchShape::any};

using TileBatches = std::array<RayBatch, kind_count>;

void put(RayBatch& batch, int i, const Vec3& origin, const Vec3& dir, float t_max, std::int32_t exclude) {
  batch.origin_x[i] = origin.x;
  batch.origin_y[i] = origin.y;
  batch.origin_z[i] = origin.z;
  batch.dir_x[i] = dir.x;
  batch.dir_y[i] = dir.y;
  batch.dir_z[i] = dir.z;
  batch.t_min[i] = 0.0F;
  batch.t_max[i] = t_max;
  batch.exclude[i] = exclude;
}
void push(RayBatch& batch, const Vec3& origin, const Vec3& dir, float t_max, std::int32_t exclude) {
  put(batch, batch.count++, origin, dir, t_max, exclude);
}

// A cosine-weighted direction about the normal; the same for the same pixel.
Vec3 random_direction(const Vec3& normal, std::uint32_t pixel) {
  const std::uint32_t h = hash32(pixel + 0x9E3779B9U), g = hash32(h);
  const float u = static_cast<float>(h >> 8U) * 0x1p-24F, v = static_cast<float>(g >> 8U) * 0x1p-24F;
  const float z = 1.0F - 2.0F * u, r = std::sqrt(std::max(0.0F, 1.0F - z * z));
  const float angle = 2.0F * std::numbers::pi_v<float> * v;
  const Vec3 sum = normal + Vec3(r * std::cos(angle), r * std::sin(angle), z);
  return glm::dot(sum, sum) > 1e-6F ? glm::normalize(sum) : normal;
}

// The rays that leave one surface point towards the lights and into the scene.
void push_secondary(const Surface& s, const View& view, std::uint32_t tile, int i, TileBatches& batches) {
  const Vec3& ng = s.geometric_normal;
  const float h = reference::offset_for(s.magnitude);
  const Vec3 outside = s.point + h * ng, inside = s.point - h * ng;
  const Vec3 to_point_light = view.light - s.point;
  if (glm::dot(ng, to_point_light) > 0.0F) {
    const Vec3 light = glm::abs(view.light);
    const float largest = std::max({s.magnitude, light.x, light.y, light.z});
    const Vec3 end = s.point + reference::offset_for(largest) * ng;
    put(batches[point_shadow], i, view.light, end - view.light, 1.0F, s.planar);
  }
  if (glm::dot(ng, view.to_light) > 0.0F)
    put(batches[directional_shadow], i, outside, view.to_light, infinity, s.planar);
  const float cos_i = glm::dot(s.to_viewer, ng);
  push(batches[mirror], outside, s.incident + 2.0F * cos_i * ng, infinity, s.planar);
  constexpr float eta = 1.0F / 1.5F;
  const float cos_t = std::sqrt(1.0F - eta * eta * (1.0F - cos_i * cos_i));
  push(batches[refracted], inside, eta * s.incident + (eta * cos_i - cos_t) * ng, infinity, s.planar);
  push(batches[random_rays], outside, random_direction(ng, tile * 256U + static_cast<std::uint32_t>(i)),
       infinity, s.planar);
}

void make_camera_rays(const CameraFrame& frame, int tile_x, int tile_y, RayBatch& batch) {
  for (int i = 0; i < batch_size; ++i) {
    const float px = static_cast<float>(tile_x + tile_pixel_x(i)) + 0.5F;
    const float py = static_cast<float>(tile_y + tile_pixel_y(i)) + 0.5F;
    push(batch, frame.eye, (frame.corner + px * frame.du) + py * frame.dv, infinity, no_primitive);
  }
}

// All rays of one tile of 16 x 16 pixels.
void make_tile(const Tracer& tracer, const View& view, const CameraFrame& frame, int tile_x, int tile_y,
               TileBatches& batches) {
  for (int kind = 0; kind < kind_count; ++kind) {
    batches[static_cast<std::size_t>(kind)] = {};
    batches[static_cast<std::size_t>(kind)].shape = kind_shapes[static_cast<std::size_t>(kind)];
  }
  batches[point_shadow].count = batches[directional_shadow].count = batch_size;
  RayBatch& rays = batches[primary];
  make_camera_rays(frame, tile_x, tile_y, rays);
  std::array<float, batch_size> t, u, v;
  std::array<std::int32_t, batch_size> primitive;
  const RayArrays arrays{rays.origin_x, rays.origin_y, rays.origin_z, rays.dir_x, rays.dir_y,
                         rays.dir_z,    nullptr,       nullptr,       batch_size};
  tracer.closest_hit(arrays, {t.data(), u.data(), v.data(), primitive.data()}, Coherence::tile);
  for (std::size_t i = 0; i < batch_size; ++i) {
    if (primitive[i] == no_primitive) continue;
    const reference::Ray ray{{rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]},
                             {rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]}};
    const Surface surface = reference::surface_at(tracer.scene(), ray, {t[i], u[i], v[i], primitive[i]});
    const auto x = static_cast<std::uint32_t>(tile_x), y = static_cast<std::uint32_t>(tile_y);
    push_secondary(surface, view, y * 65536U + x, static_cast<int>(i), batches);
  }
}

} // namespace

int rays_in(const RayBatch& batch) {
  int rays = 0;
  for (int i = 0; i < batch.count; ++i) rays += is_ray(batch, i);
  return rays;
}

View outside_view(const Aabb& bounds) {
  View view;
  view.camera = frame_scene(bounds, 40.0F, 1.0F);
  const Vec3 center = 0.5F * (bounds.lower + bounds.upper);
  const float radius = 0.5F * glm::length(bounds.upper - bounds.lower);
  const Vec3 forward = glm::normalize(view.camera.look_at - view.camera.eye);
  const Vec3 right = glm::normalize(glm::cross(forward, view.camera.up));
  view.light = center + radius * (1.6F * view.camera.up - 1.2F * forward - 0.9F * right);
  view.to_light = glm::normalize(0.75F * view.camera.up - 0.7F * forward - 0.55F * right);
  return view;
}

View inside_view(const Aabb& bounds) {
  View view;
  const Vec3 size = bounds.upper - bounds.lower, center = 0.5F * (bounds.lower + bounds.upper);
  const Vec3 along = size.x >= size.z ? Vec3(size.x, 0.0F, 0.0F) : Vec3(0.0F, 0.0F, size.z);
  view.camera.eye = center + 0.36F * along - Vec3(0.0F, 0.2F * size.y, 0.0F);
  view.camera.look_at = center - 0.3F * along - Vec3(0.0F, 0.15F * size.y, 0.0F);
  view.camera.fov_degrees = 60.0F;
  view.light = center + Vec3(0.0F, 0.2F * size.y, 0.0F);
  view.to_light = glm::normalize(Vec3(0.2F, 1.0F, 0.1F));
  return view;
}

std::vector<std::string> ray_set_names() { return {kind_names.begin(), kind_names.end()}; }

std::vector<RaySet> make_ray_sets(const Tracer& tracer, const View& view, int width, int height,
                                  const std::vector<std::string>& names) {
  const CameraFrame frame = make_camera_frame(view.camera, width, height);
  std::vector<RaySet> all(kind_count);
  TileBatches batches;
  for (int y = 0; y < height; y += tile_side)
    for (int x = 0; x < width; x += tile_side) {
      make_tile(tracer, view, frame, x, y, batches);
      for (std::size_t kind = 0; kind < kind_count; ++kind) {
        const int rays = rays_in(batches[kind]);
        if (rays == 0) continue;
        all[kind].ray_count += static_cast<std::size_t>(rays);
        all[kind].batches.push_back(batches[kind]);
      }
    }
  std::vector<RaySet> sets;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    all[kind].name = kind_names[kind];
    const bool asks_any = kind == point_shadow || kind == directional_shadow;
    all[kind].question = asks_any ? Question::any : Question::closest;
    if (std::find(names.begin(), names.end(), all[kind].name) != names.end())
      sets.push_back(std::move(all[kind]));
  }
  return sets;
}

} // namespace fastrt::bench
