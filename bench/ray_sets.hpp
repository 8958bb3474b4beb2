// SPDX-License-Identifier: Apache-2.0
// The rays of a Whitted picture, sorted by kind and cut into batches as the Whitted loop would hand them
// over.
#pragma once

#include "src/trace/ray_batch.hpp"

#include <fastrt/camera.hpp>
#include <fastrt/tracer.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace fastrt::bench {

enum class Question { closest, any };

// Shadow rays keep the places of their pixels in the tile, as in the Whitted loop, so batches of them have
// rows that are no rays: those have no room between t_min and t_max, and count nowhere.
struct RaySet {
  std::string name;
  Question question = Question::closest;
  std::vector<RayBatch> batches;
  std::size_t ray_count = 0;
};
inline bool is_ray(const RayBatch& batch, int i) { return batch.t_min[i] < batch.t_max[i]; }
int rays_in(const RayBatch& batch);

// Where the rays come from.
struct View {
  Camera camera;
  Vec3 light{0.0F};    // of the point light
  Vec3 to_light{0.0F}; // of the directional one
};

// A view of the whole scene from outside, or, inside, along the longest side of its box.
View outside_view(const Aabb& bounds);
View inside_view(const Aabb& bounds);

// "primary", "point shadow", "directional shadow", "mirror", "refracted", "random".
std::vector<std::string> ray_set_names();

// The sets named, of one picture. width and height are multiples of 16.
std::vector<RaySet> make_ray_sets(const Tracer& tracer, const View& view, int width, int height,
                                  const std::vector<std::string>& names);

} // namespace fastrt::bench
