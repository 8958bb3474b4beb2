// SPDX-License-Identifier: Apache-2.0
// Things that absorb light, at random.
#pragma once

#include "tests/equivalence/random_shots.hpp"

namespace fastrt::test {

inline Material any_medium(Random& random) {
  Material medium = any_material(random);
  medium.opacity = random.below(3) == 0 ? random.uniform(0, 0.6F) : 0.0F;
  medium.transmission = Vec3(random.uniform(0.7F, 1));
  medium.absorption = any_colour(random, 0.5F);
  medium.unlit = false;
  return medium;
}

// A box around the middle; of some a side is missing.
inline void add_tank(SceneBuilder& builder, std::uint32_t material, Random& random) {
  const Vec3 half{random.uniform(0.5F, 4), random.uniform(0.5F, 4), random.uniform(0.5F, 4)};
  const Vec3 middle = 0.3F * random.in_cube();
  std::vector<Vec3> positions;
  for (unsigned i = 0; i < 8; ++i)
    positions.push_back(middle +
                        half * Vec3((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1));
  std::vector<std::uint32_t> indices{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  if (random.below(3) == 0) indices.resize(30);
  builder.add_mesh(positions, indices, material);
}

} // namespace fastrt::test
