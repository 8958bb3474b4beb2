// SPDX-License-Identifier: Apache-2.0
#include "src/write/ranges.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fastrt {
namespace {

// How many times as far from the middle as half of the positions one may be.
constexpr float most_times = 4;

// Half of them are lower, half higher. Changes their order.
float median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Some of the positions, all if they are not many: from all over the picture, as the odd step does not stay
// in few columns.
std::vector<Vec3> some_of(std::span<const float> positions) {
  constexpr std::size_t enough = std::size_t{1} << 16U;
  const std::size_t step = positions.size() / 3 / enough | 1U;
  std::vector<Vec3> some;
  for (std::size_t i = 0; i + 2 < positions.size(); i += 3 * step) {
    const float* const v = &positions[i];
    if (!is_zero(v) && std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]))
      some.emplace_back(v[0], v[1], v[2]);
  }
  return some;
}

// Around the middle of the positions: its sides are as far from it as a coordinate may be.
struct Surroundings {
  Vec3 middle;
  float reach;
  bool hold(const float* v) const {
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::fabs(v[axis] - middle[axis]) <= reach)) return false;
    return true;
  }
};

Surroundings surroundings_of(const std::vector<Vec3>& positions) {
  Surroundings made{};
  std::vector<float> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const Vec3& p : positions) values.push_back(p[axis]);
    made.middle[axis] = median(values);
  }
  values.clear();
  for (const Vec3& p : positions) {
    const Vec3 away = glm::abs(p - made.middle);
    values.push_back(std::max({away.x, away.y, away.z}));
  }
  const float usual = median(values);
  made.reach = usual > 0 ? most_times * usual : infinity;
  return made;
}

} // namespace

Ranges ranges_of_positions(std::span<const float> positions, int threads) {
  const Surroundings near = surroundings_of(some_of(positions));
  return ranges_of_pixels(positions.size() / 3, threads, [&](std::size_t pixel, Ranges& ranges) {
    const float* const v = &positions[3 * pixel];
    if (is_zero(v) || !near.hold(v)) return;
    for (std::size_t c = 0; c < 3; ++c) ranges[c].add(v[c]);
  });
}

} // namespace fastrt
