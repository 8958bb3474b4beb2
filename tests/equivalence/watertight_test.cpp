// SPDX-License-Identifier: Apache-2.0
// A closed mesh has no cracks for the kernels either: of each ISA 8.6 million rays from its inside, all aimed
// exactly at a vertex or at a point of an edge, and each hits it.
#include "tests/equivalence/answers.hpp"
#include "tests/equivalence/geometry_scenes.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

struct Place {
  float scale;
  float offset;
};
void PrintTo(const Place& place, std::ostream* out) { *out << place.scale << " at " << place.offset; }

class Leaks : public testing::TestWithParam<Place> {
protected:
  // Of each aim; with both of them each ISA gets 0.72 million rays a place.
  static constexpr int batches = slow_build ? 40 : 1400;

  Leaks() : mesh_(make_mesh()), scene_(scene_of(mesh_)), tracers_(simd_tracers(scene_)) {}

  static Mesh make_mesh() {
    Random random(91);
    return placed(jittered(icosphere(2), 0.05F, random), GetParam().scale, Vec3(GetParam().offset));
  }

  // From somewhere around the middle.
  void aim(bool at_vertex, bool one_origin, Random& random, std::vector<Ray>& rays) const {
    const auto triangles = static_cast<std::uint32_t>(mesh_.triangle_count());
    Vec3 origin{0.0F};
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (i == 0 || !one_origin)
        origin = Vec3(GetParam().offset) + 0.3F * GetParam().scale * random.in_cube();
      const Vec3 target =
          point_on_edge(mesh_, random.below(triangles), random.below(3), at_vertex ? 0.0F : random.uniform());
      rays[i].origin = origin;
      rays[i].direction = (0.1F + 20.0F * random.uniform()) * (target - origin);
    }
  }

  // The number of rays that hit nothing, over all batches of one ISA's tracer.
  int count_leaks(const Tracer& tracer, bool at_vertex) const {
    int leaks = 0;
#pragma omp parallel for num_threads(2) reduction(+ : leaks)
    for (int batch = 0; batch < batches; ++batch) {
      Random random(static_cast<std::uint32_t>(batch) * 7919U + (at_vertex ? 1U : 0U));
      const bool one_origin = batch % 4 != 0;
      std::vector<Ray> rays(batch_size);
      aim(at_vertex, one_origin, random, rays);
      const BatchShape shape = one_origin       ? BatchShape::common_origin
                               : batch % 8 == 0 ? BatchShape::any
                                                : BatchShape::coherent;
      KernelQuery query;
      if (batch % 2 == 0) {
        for (const bool hit : query.any(tracer, rays, shape)) leaks += hit ? 0 : 1;
      } else {
        for (const Hit& hit : query.closest(tracer, rays, shape)) leaks += hit.found() ? 0 : 1;
      }
    }
    return leaks;
  }

  const std::vector<Tracer>& tracers() const { return tracers_; }

private:
  Mesh mesh_;
  Scene scene_;
  std::vector<Tracer> tracers_;
};

TEST_P(Leaks, AreThereNone) {
  for (const Tracer& tracer : tracers()) {
    EXPECT_EQ(count_leaks(tracer, true), 0) << isa_word(tracer.isa()) << ", vertices";
    EXPECT_EQ(count_leaks(tracer, false), 0) << isa_word(tracer.isa()) << ", edges";
  }
}

// Where the numbers have no digits left for the mesh, there is no mesh: 1e-3 and 1e-1 large at 1e5 are left
// out.
INSTANTIATE_TEST_SUITE_P(Places, Leaks,
                         testing::Values(Place{1e-3F, 0}, Place{1e-3F, 1e2F}, Place{1e-1F, 0},
                                         Place{1e-1F, 1e2F}, Place{1, 0}, Place{1, 1e2F}, Place{1, 1e5F},
                                         Place{1e2F, 0}, Place{1e2F, 1e5F}, Place{1e4F, 0}, Place{1e4F, 1e2F},
                                         Place{1e4F, 1e5F}));

} // namespace
} // namespace fastrt::test
