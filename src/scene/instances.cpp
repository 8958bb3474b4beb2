// SPDX-License-Identifier: Apache-2.0
// Prototypes and instances as rays meet them.
#include "src/scene/finite.hpp"
#include "src/scene/row_counts.hpp"
#include "src/scene/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fastrt {
namespace {

using Vec3d = glm::dvec3;

// What the box of an instance is larger by, as a share of the numbers that it is computed from.
constexpr double box_margin = 0x1p-18;
// A map with a greater growth leaves nothing of a float's digits.
constexpr double most_growth = 0x1p20;

double largest(const Vec3d& v) { return std::max({v.x, v.y, v.z}); }

// The sum of v's parts, each by the magnitude of the map's column for it: what a map adds up at most.
Vec3d weighed(const Affine& map, const Vec3d& v) {
  return (glm::abs(Vec3d(map.x)) * v.x + glm::abs(Vec3d(map.y)) * v.y) + glm::abs(Vec3d(map.z)) * v.z;
}

// How much rounding grows on the way to object space and back: by what the maps there and back add up at
// most; and by how differently the map stretches along its axes, for a triangle's test mixes all coordinates
// of a space in which they differ by that much. The 4 leaves about 1 shadow ray in 10^5 that meets its own
// mesh where that is stretched 100 to 1.
double growth_of(const Affine& map, const Vec3d (&rows)[3]) {
  const auto grown = [&](int axis) {
    return weighed(map, glm::abs(Vec3d(rows[0][axis], rows[1][axis], rows[2][axis])));
  };
  const auto most = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return largest(glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))));
  };
  const double stretch = most(Vec3d(map.x), Vec3d(map.y), Vec3d(map.z)) * most(rows[0], rows[1], rows[2]);
  return std::max(largest(grown(0) + grown(1) + grown(2)), 4 * stretch);
}

} // namespace

KindRanges world_rows(const SceneDesc& desc) {
  KindRanges world;
  const std::array<std::size_t, 5> counts = row_counts(desc);
  for (std::size_t kind = 0; kind < world.size(); ++kind) {
    const auto count = static_cast<std::uint32_t>(counts[kind]);
    std::vector<RowRange> taken;
    for (const Prototype& prototype : desc.prototypes)
      if (prototype.begin[kind] < std::min(prototype.end[kind], count))
        taken.push_back({prototype.begin[kind], std::min(prototype.end[kind], count)});
    std::sort(taken.begin(), taken.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
    std::uint32_t next = 0;
    for (const RowRange& range : taken) {
      if (next < range.begin) world[kind].push_back({next, range.begin});
      next = std::max(next, range.end);
    }
    if (next < count) world[kind].push_back({next, count});
  }
  return world;
}

bool invert(const Affine& map, Affine& inverse, float& growth) {
  const Vec3d x(map.x), y(map.y), z(map.z);
  const double determinant = glm::dot(x, glm::cross(y, z));
  if (!(determinant != 0.0 && std::isfinite(determinant))) return false;
  const Vec3d rows[3] = {glm::cross(y, z) / determinant, glm::cross(z, x) / determinant,
                         glm::cross(x, y) / determinant};
  const Vec3d back(map.origin);
  for (int i = 0; i < 3; ++i) {
    inverse.x[i] = static_cast<float>(rows[i].x);
    inverse.y[i] = static_cast<float>(rows[i].y);
    inverse.z[i] = static_cast<float>(rows[i].z);
    inverse.origin[i] = static_cast<float>(-glm::dot(rows[i], back));
  }
  const double most = growth_of(map, rows);
  growth = static_cast<float>(most);
  return is_finite(inverse.x) && is_finite(inverse.y) && is_finite(inverse.z) && is_finite(inverse.origin) &&
         most <= most_growth;
}

Aabb image_of(const Affine& map, const Aabb& box) {
  if (box.empty()) return {};
  constexpr double most = std::numeric_limits<float>::max();
  const Vec3d lower(box.lower), upper(box.upper), origin(map.origin);
  Vec3d low(std::numeric_limits<double>::infinity()), high(-low);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d p((corner & 1) != 0 ? upper.x : lower.x, (corner & 2) != 0 ? upper.y : lower.y,
                  (corner & 4) != 0 ? upper.z : lower.z);
    const Vec3d q = ((Vec3d(map.x) * p.x + Vec3d(map.y) * p.y) + Vec3d(map.z) * p.z) + origin;
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const double numbers = largest(weighed(map, glm::max(glm::abs(lower), glm::abs(upper))) + glm::abs(origin));
  const Vec3d margin(box_margin * numbers);
  return {Vec3(glm::clamp(low - margin, Vec3d(-most), Vec3d(most))),
          Vec3(glm::clamp(high + margin, Vec3d(-most), Vec3d(most)))};
}

std::vector<InstanceShape> make_instances(const SceneDesc& desc) {
  std::vector<Aabb> bounds;
  bounds.reserve(desc.prototypes.size());
  for (const Prototype& prototype : desc.prototypes) bounds.push_back(bounds_of(desc, prototype));
  std::vector<InstanceShape> shapes(desc.instances.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Affine& map = desc.instances.to_world[i];
    invert(map, shapes[i].to_object, shapes[i].growth);
    shapes[i].box = image_of(map, bounds[desc.instances.prototype[i]]);
  }
  return shapes;
}

} // namespace fastrt
