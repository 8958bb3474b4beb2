// SPDX-License-Identifier: Apache-2.0
// Batches of rays with one origin or one direction, as cameras, lights and careless callers make them.
#pragma once

#include "src/trace/ray_batch.hpp"
#include "src/trace/tile_order.hpp"
#include "tests/equivalence/rays.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace fastrt::test {

using RayRun = std::vector<Ray>; // batch_size rays

struct Axes {
  Vec3 right, up, forward;
};
inline Axes axes_along(const Vec3& forward, Random& random) {
  const Vec3 right = glm::normalize(glm::cross(forward, random.direction()));
  return {right, glm::normalize(glm::cross(right, forward)), forward};
}

inline void shuffle(RayRun& run, Random& random) {
  for (std::size_t i = run.size(); i > 1; --i)
    std::swap(run[i - 1], run[random.below(static_cast<std::uint32_t>(i))]);
}

// From -1 to 1 over the tile, in the tile's order.
inline Vec2 tile_point(int i) {
  return {(static_cast<float>(tile_pixel_x(i)) - 7.5F) / 7.5F,
          (static_cast<float>(tile_pixel_y(i)) - 7.5F) / 7.5F};
}

// A camera's tile. tangent: of half the angle that it sees.
inline RayRun camera_fan(const Vec3& origin, const Axes& axes, float tangent) {
  RayRun run(batch_size);
  for (int i = 0; i < batch_size; ++i) {
    const Vec2 at = tangent * tile_point(i);
    Ray& ray = run[static_cast<std::size_t>(i)];
    ray.origin = origin;
    ray.direction = (axes.forward + at.x * axes.right) + at.y * axes.up;
  }
  return run;
}

// A fisheye's tile: up to `angle` away from the middle, in every direction.
inline RayRun fisheye(const Vec3& origin, const Axes& axes, float angle) {
  RayRun run(batch_size);
  for (int i = 0; i < batch_size; ++i) {
    const Vec2 at = tile_point(i);
    const float away = angle * std::max(std::fabs(at.x), std::fabs(at.y));
    const Vec2 side = at / std::sqrt(at.x * at.x + at.y * at.y);
    Ray& ray = run[static_cast<std::size_t>(i)];
    ray.origin = origin;
    ray.direction = std::cos(away) * axes.forward + std::sin(away) * (side.x * axes.right + side.y * axes.up);
  }
  return run;
}

// A point light's shadow rays: from the light to surfaces, which they must not hit themselves. spread: from
// how many primitives in a row.
inline RayRun shadow_fan(const Scene& scene, const Vec3& light, std::uint32_t spread, Random& random) {
  RayRun run(batch_size);
  const std::uint32_t count = scene.primitive_count();
  const std::uint32_t first = count == 0 ? 0 : random.below(count);
  for (Ray& ray : run) {
    const std::uint32_t primitive = count == 0 ? 0 : (first + random.below(spread)) % count;
    const Vec3 target = count == 0 ? random.in_cube() : target_on(scene, primitive, random);
    ray.origin = light;
    ray.direction = target - light;
    ray.t_max = random.below(4) == 0 ? infinity : 1.0F;
    if (primitive < scene.triangle_count() || primitive >= scene.first_of(PrimitiveKind::disk))
      ray.excluded = static_cast<std::int32_t>(primitive);
  }
  return run;
}

// Tile with exact zeros: looks along an axis, its sides along the other two.
inline RayRun axis_fan(const Vec3& origin, float tangent, Random& random) {
  const auto axis = static_cast<int>(random.below(3));
  Axes axes{Vec3(0.0F), Vec3(0.0F), Vec3(0.0F)};
  axes.forward[axis] = random.below(2) == 0 ? 1.0F : -1.0F;
  axes.right[(axis + 1) % 3] = 1;
  axes.up[(axis + 2) % 3] = 1;
  RayRun run = camera_fan(origin, axes, tangent);
  // In the middle, -1/15 becomes 0: rays in the planes of the axes.
  for (Ray& ray : run)
    for (int i = 0; i < 3; ++i)
      if (std::fabs(ray.direction[i]) < 0.08F * tangent)
        ray.direction[i] = std::copysign(0.0F, ray.direction[i]);
  return run;
}

// Sixteen groups, each a narrow fan into a direction of its own.
inline RayRun scattered_groups(const Vec3& origin, Random& random) {
  RayRun run(batch_size);
  Axes axes{};
  const float tangent = any_size(random, -8, -1);
  for (int i = 0; i < batch_size; ++i) {
    if (i % group_size == 0) axes = axes_along(random.direction(), random);
    const Vec2 at = tangent * tile_point(i % group_size);
    Ray& ray = run[static_cast<std::size_t>(i)];
    ray.origin = origin;
    ray.direction = axes.forward + at.x * axes.right + at.y * axes.up;
  }
  return run;
}

// Rays of one origin.
inline RayRun origin_run(const Scene& scene, Random& random) {
  const Vec3 origin = origin_at(scene, random);
  Vec3 forward = target_on(scene, random) - origin;
  if (!(glm::dot(forward, forward) > 0.0F)) forward = random.direction();
  forward = glm::normalize(forward / reference::largest_magnitude(forward));
  const Axes axes = axes_along(forward, random);
  RayRun run;
  switch (random.below(12)) {
  case 0:
  case 1:
  case 2: // from far below a pixel to 166 degrees
    run = camera_fan(origin, axes, any_size(random, -12, 2));
    break;
  case 3:
    run = fisheye(origin, axes, random.uniform(0.7F, 3.14159F));
    break;
  case 4:
  case 5:
    run = shadow_fan(scene, origin, 1 + random.below(8), random);
    break;
  case 6:
    run = shadow_fan(scene, origin, 100000, random);
    break;
  case 7:
    run = axis_fan(origin, any_size(random, -8, 2), random);
    break;
  case 8:
    run = scattered_groups(origin, random);
    break;
  case 9: // all the same, or all in one plane
    run = camera_fan(origin, {random.below(2) == 0 ? Vec3(0.0F) : axes.right, Vec3(0.0F), forward}, 0.1F);
    break;
  case 10: // every direction at random
    run = camera_fan(origin, axes, 1);
    for (Ray& ray : run) ray.direction = random.direction();
    break;
  default: // forwards and backwards
    run = camera_fan(origin, axes, any_size(random, -8, 0));
    for (Ray& ray : run)
      if (random.below(2) == 0) ray.direction = -ray.direction;
  }
  return run;
}

// Rays of one direction.
inline RayRun parallel_run(const Scene& scene, Random& random) {
  const auto [center, radius] = extent_of(scene);
  Vec3 direction = random.below(4) == 0 ? axis_direction(random) : random.direction();
  if (random.below(6) == 0) {
    const Ray along = along_triangle(scene, 0, random);
    if (glm::dot(along.direction, along.direction) > 0.0F) direction = along.direction;
  }
  direction *= any_size(random, -5, 5);
  const Axes axes = axes_along(glm::normalize(direction), random);
  const Vec3 middle = target_on(scene, random) - radius * random.uniform(-0.5F, 3) * axes.forward;
  const float size = radius * any_size(random, -12, 1);
  const std::uint32_t kind = random.below(5);
  RayRun run(batch_size);
  for (int i = 0; i < batch_size; ++i) {
    Ray& ray = run[static_cast<std::size_t>(i)];
    ray.direction = direction;
    const Vec2 at = size * tile_point(i);
    ray.origin = middle + at.x * axes.right + at.y * axes.up;
    const Vec3 target = target_on(scene, random);
    if (kind == 0) ray.origin = target; // leaves a surface
    if (kind == 1) ray.origin = target - any_size(random, -5, 8) * radius * axes.forward;
    if (kind == 2) ray.origin = center + 3.0F * radius * random.in_cube();
  }
  return run;
}

// Some primitive, by itself or in an instance.
inline void exclude_any(const Scene& scene, Random& random, Ray& ray) {
  ray.excluded = static_cast<std::int32_t>(random.below(300));
  if (scene.instance_count() == 0) return;
  ray.excluded = static_cast<std::int32_t>(random.below(scene.primitive_count()));
  if (random.below(4) == 0) return;
  const std::uint32_t instance = random.below(scene.instance_count());
  if (scene.shapes().instances[instance].box.empty()) return;
  ray.excluded_instance = static_cast<std::int32_t>(instance);
  ray.excluded = static_cast<std::int32_t>(primitive_of(scene, prototype_of(scene, instance), random));
}

// What may be mixed into any run without a change for the rest: intervals, excluded primitives, lengths (not
// of parallel rays), dead rays with any numbers in them.
inline void vary(RayRun& run, const Scene& scene, bool one_origin, Random& random) {
  const std::uint32_t kind = random.below(6);
  for (Ray& ray : run) {
    const float reach = extent_of(scene).radius / (glm::length(ray.direction) + 1e-30F);
    if (kind == 1) ray.t_min = random.uniform(-1, 2) * reach;
    if (kind == 2) ray.t_max = random.uniform(0, 4) * reach;
    if (kind == 3) exclude_any(scene, random, ray);
    if (kind == 4 && one_origin) ray.direction *= any_size(random, -10, 10);
    if (kind != 5 || random.below(3) == 0) continue;
    ray.t_max = ray.t_min - (random.below(2) == 0 ? 0.0F : 1.0F);
    if (random.below(2) == 0) (one_origin ? ray.direction : ray.origin) = odd_vector(random);
  }
  if (random.below(4) == 0) shuffle(run, random);
}

} // namespace fastrt::test
