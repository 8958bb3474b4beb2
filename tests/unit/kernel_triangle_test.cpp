// SPDX-License-Identifier: Apache-2.0
// The triangle kernel of every ISA against the scalar twin: equal bits, lane by lane.
#include "tests/equivalence/isas.hpp"
#include "tests/equivalence/triangle_pairs.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

using reference::intersect_triangle;
using reference::Intersection;

constexpr std::size_t table_size = 16384;

struct Found {
  std::vector<std::uint8_t> hit = std::vector<std::uint8_t>(table_size);
  std::vector<float> t = std::vector<float>(table_size);
  std::vector<float> u = std::vector<float>(table_size);
  std::vector<float> v = std::vector<float>(table_size);
};

class TriangleKernel : public testing::TestWithParam<Isa> {
protected:
  // Compares the whole table; returns the number of hits.
  std::size_t expect_same(PairTable& table, TriangleKind kind) {
    const PairColumns columns = table.columns();
    kernels_of(GetParam())
        .meet_triangles(columns, found_.hit.data(), found_.t.data(), found_.u.data(), found_.v.data());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < table.size(); ++i) {
      const Intersection expected = intersect_triangle(table[i].ray, triangle_of(table[i]));
      hits += expected.hit ? 1 : 0;
      const float t = expected.hit ? expected.t : 0.0F;
      const bool equal =
          (found_.hit[i] != 0) == expected.hit && same(found_.t[i], t) &&
          (!expected.hit || (same_weight(found_.u[i], expected.u) && same_weight(found_.v[i], expected.v)));
      if (equal) continue;
      ADD_FAILURE() << "kind " << static_cast<int>(kind) << ", lane " << i << ": hit " << int(found_.hit[i])
                    << " t " << found_.t[i] << ", expected " << expected.hit << " " << expected.t;
      break;
    }
    return hits;
  }
  Found found_;
};

TEST_P(TriangleKernel, EqualsTheTwinOnEveryKindOfPair) {
  Random random(11);
  PairTable table(table_size);
  for (int k = 0; k < static_cast<int>(TriangleKind::count); ++k) {
    const auto kind = static_cast<TriangleKind>(k);
    std::size_t hits = 0;
    for (int pass = 0; pass < effort(20); ++pass) {
      for (Pair& pair : table.pairs()) pair = triangle_pair(kind, random);
      hits += expect_same(table, kind);
    }
    // Triangles without area are hit so rarely that a short run may see no hit at all.
    if (kind != TriangleKind::degenerate || !slow_build) {
      EXPECT_GT(hits, 0U) << k;
    }
    if (kind == TriangleKind::inside) {
      EXPECT_GT(hits, table_size * 9 / 10 * effort(20));
    }
  }
}

// The ends of the interval do not count: a ray that starts exactly at its own hit has none there.
TEST_P(TriangleKernel, LeavesOutTheRaysStart) {
  Random random(12);
  PairTable table(table_size);
  for (Pair& pair : table.pairs()) {
    pair = triangle_pair(TriangleKind::inside, random);
    const Intersection found = intersect_triangle(pair.ray, triangle_of(pair));
    if (!found.hit) continue;
    pair.ray.t_min = random.below(2) == 0 ? found.t : std::nextafter(found.t, 0.0F);
  }
  const std::size_t hits = expect_same(table, TriangleKind::inside);
  EXPECT_GT(hits, table_size / 3);
  EXPECT_LT(hits, table_size * 2 / 3);
}

// Whether a lane is a hit must not depend on its neighbours: hits alone among misses, in every lane.
TEST_P(TriangleKernel, EveryLaneIsOnItsOwn) {
  Random random(13);
  PairTable table(table_size);
  for (std::size_t i = 0; i < table_size; ++i) {
    Pair& pair = table.pairs()[i];
    pair = triangle_pair(TriangleKind::inside, random);
    if (i % 17 != 0) pair.ray.direction = -pair.ray.direction;
  }
  EXPECT_LT(expect_same(table, TriangleKind::inside), table_size / 16);
}

TEST_P(TriangleKernel, WorksWithoutWeights) {
  Random random(14);
  PairTable table(64);
  for (Pair& pair : table.pairs()) pair = triangle_pair(TriangleKind::inside, random);
  const PairColumns columns = table.columns();
  kernels_of(GetParam()).meet_triangles(columns, found_.hit.data(), found_.t.data(), nullptr, nullptr);
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(found_.hit[i] != 0, intersect_triangle(table[i].ray, triangle_of(table[i])).hit);
}

INSTANTIATE_TEST_SUITE_P(Isas, TriangleKernel, testing::ValuesIn(simd_isas()), IsaWord());

} // namespace
} // namespace fastrt::test
