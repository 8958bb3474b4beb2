// SPDX-License-Identifier: Apache-2.0
// The sphere kernel of every ISA against the scalar twin: equal bits, lane by lane.
#include "tests/equivalence/isas.hpp"
#include "tests/equivalence/sphere_pairs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using reference::intersect_sphere;
using reference::Intersection;

constexpr std::size_t table_size = 16384;

class SphereKernel : public testing::TestWithParam<Isa> {
protected:
  // Compares the whole table; returns the number of hits.
  std::size_t expect_same(PairTable& table, SphereKind kind) {
    const PairColumns columns = table.columns();
    kernels_of(GetParam()).meet_spheres(columns, hit_.data(), t_.data());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
      const Intersection expected = intersect_sphere(table[i].ray, sphere_of(table[i]));
      hits += expected.hit ? 1 : 0;
      const float t = expected.hit ? expected.t : 0.0F;
      if ((hit_[i] != 0) == expected.hit && same(t_[i], t)) continue;
      ADD_FAILURE() << "kind " << static_cast<int>(kind) << ", lane " << i << ": hit " << int(hit_[i])
                    << " t " << t_[i] << ", expected " << expected.hit << " " << expected.t;
      break;
    }
    return hits;
  }
  std::vector<std::uint8_t> hit_ = std::vector<std::uint8_t>(table_size);
  std::vector<float> t_ = std::vector<float>(table_size);
};

TEST_P(SphereKernel, EqualsTheTwinOnEveryKindOfPair) {
  Random random(21);
  PairTable table(table_size);
  for (int k = 0; k < static_cast<int>(SphereKind::count); ++k) {
    const auto kind = static_cast<SphereKind>(k);
    std::size_t hits = 0;
    for (int pass = 0; pass < effort(25); ++pass) {
      for (Pair& pair : table.pairs()) pair = sphere_pair(kind, random);
      hits += expect_same(table, kind);
    }
    EXPECT_GT(hits, 0U) << k;
    if (kind == SphereKind::from_inside) {
      EXPECT_EQ(hits, table_size * effort(25));
    }
  }
}

// From outside with t_min at the near hit, the far one is left; with t_min at the far one, none.
TEST_P(SphereKernel, GoesOnToTheFarSide) {
  Random random(22);
  PairTable table(table_size);
  for (Pair& pair : table.pairs()) {
    pair = sphere_pair(SphereKind::random, random);
    for (std::uint32_t skip = random.below(3); skip != 0; --skip) {
      const Intersection found = intersect_sphere(pair.ray, sphere_of(pair));
      if (found.hit) pair.ray.t_min = found.t;
    }
  }
  EXPECT_GT(expect_same(table, SphereKind::random), table_size / 100);
}

TEST_P(SphereKernel, EveryLaneIsOnItsOwn) {
  Random random(23);
  PairTable table(table_size);
  for (std::size_t i = 0; i < table_size; ++i) {
    Pair& pair = table.pairs()[i];
    pair = sphere_pair(SphereKind::from_inside, random);
    if (i % 17 != 0) pair.ray.t_min = infinity;
  }
  EXPECT_EQ(expect_same(table, SphereKind::from_inside), (table_size + 16) / 17);
}

INSTANTIATE_TEST_SUITE_P(Isas, SphereKernel, testing::ValuesIn(simd_isas()), IsaWord());

} // namespace
} // namespace fastrt::test
