// SPDX-License-Identifier: Apache-2.0
// Surfaces that light others, against form factors.
#include "tests/golden/pictures.hpp"
#include "tests/unit/reference_shapes.hpp"

namespace fastrt::test {
namespace {

class MeshLights : public Picture {};

const Vec3 radiance{4, 2, 1};

Light lamp(std::uint32_t material) {
  Light light;
  light.kind = LightKind::mesh;
  light.material = material;
  return light;
}

// What of the half space over a small level piece of surface the rectangle 0..a x 0..b straight above it
// fills, weighed by the cosine; odd in a and in b.
double corner_factor(double a, double b, double height) {
  const double x = a / height, y = b / height;
  const double sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * std::numbers::pi);
}
double rectangle_factor(const DVec3& p, double x0, double x1, double z0, double z1, double height) {
  const auto from = [&](double x, double z) { return corner_factor(x - p.x, z - p.z, height); };
  return from(x1, z1) - from(x0, z1) - from(x1, z0) + from(x0, z0);
}

// The floor y = 0, seen from below the lamps.
const Camera below{{0, 0.9F, 0}, {0, 0, 0}, {0, 0, -1}, 90};
DVec3 on_floor(const DVec3& direction) { return DVec3(0, 0.9, 0) - direction * (0.9 / direction.y); }

class UnderALamp : public MeshLights {
protected:
  UnderALamp() {
    Material white = black();
    white.diffuse = {1, 0.5F, 1};
    add_quad(builder_, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, builder_.add_material(white));
    Material shining = black();
    shining.emission = radiance;
    shining_ = builder_.add_material(shining);
    settings_.light_samples = 1024;
  }

  // factor(point of the floor): what of its half space shines.
  template <class Factor>
  void expect(double tolerance, const Factor& factor) {
    builder_.add_light(lamp(shining_));
    expect_pixels(render(builder_, below, settings_), Pinhole(below, settings_), tolerance,
                  [&](const DVec3& direction) -> std::optional<Vec3> {
                    const double share = factor(on_floor(direction));
                    return Vec3(share * DVec3(radiance) * DVec3(1, 0.5, 1));
                  });
  }

  SceneBuilder builder_;
  std::uint32_t shining_ = 0;
  RenderSettings settings_ = settings_of(16, 16);
};

TEST_P(UnderALamp, SquareFacingDown) {
  add_quad(builder_, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, shining_);
  expect(6e-3, [](const DVec3& p) { return rectangle_factor(p, -1, 1, -1, 1, 2); });
}

TEST_P(UnderALamp, BothSidesShine) {
  add_quad(builder_, {-1, 2, -1}, {0, 0, 2}, {2, 0, 0}, shining_);
  expect(6e-3, [](const DVec3& p) { return rectangle_factor(p, -1, 1, -1, 1, 2); });
}

// One half of the square is shown by an instance with the lamp's material, the other keeps its own; the
// prototype itself is nowhere.
TEST_P(UnderALamp, InstancesShineWhereTheyAreShown) {
  builder_.begin_prototype();
  add_quad(builder_, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, builder_.add_material(black()));
  const std::uint32_t dark = builder_.end_prototype();
  builder_.begin_prototype();
  add_quad(builder_, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, shining_);
  const std::uint32_t bright = builder_.end_prototype();
  builder_.add_instance(dark, {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {-1, 2, -1}}, shining_);
  builder_.add_instance(bright, {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {0, 2, -1}});
  expect(6e-3, [](const DVec3& p) { return rectangle_factor(p, -1, 1, -1, 1, 2); });
}

// The same square of triangles from large to tiny, and a needle without an area.
TEST_P(UnderALamp, AreasCountAndNotTriangles) {
  std::vector<Vec3> positions{{-1, 2, -1}, {-1, 2, 1}};
  std::vector<std::uint32_t> indices{0, 0, 1};
  float left = -1;
  for (const float width : {1.0F, 0.03125F, 0.03125F, 0.4375F, 0.5F}) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    left += width;
    positions.insert(positions.end(), {{left, 2, -1}, {left, 2, 1}});
    for (const std::uint32_t i : {base - 2, base - 1, base, base, base - 1, base + 1}) indices.push_back(i);
  }
  builder_.add_mesh(positions, indices, shining_);
  expect(6e-3, [](const DVec3& p) { return rectangle_factor(p, -1, 1, -1, 1, 2); });
}

// Triangles are put in an order of their own: that of the file has no say.
TEST_P(UnderALamp, OrderOfTrianglesDoesNotMatter) {
  const auto picture = [&](bool backwards) {
    SceneBuilder builder = builder_;
    const Mesh ball = placed(icosphere(2), 0.5F, {0, 2, 0});
    std::vector<std::uint32_t> indices = ball.indices;
    for (std::size_t i = 0; backwards && i < indices.size(); ++i)
      indices[i] = ball.indices[ball.indices.size() - 3 - i / 3 * 3 + i % 3];
    builder.add_mesh(ball.positions, indices, shining_);
    builder.add_light(lamp(shining_));
    settings_.light_samples = 4;
    return render(builder, below, settings_);
  };
  EXPECT_TRUE(picture(false).rgb == picture(true).rgb);
}

// A half plane half way up hides what lies beyond the line that it draws on the square.
TEST_P(UnderALamp, SoftShadow) {
  add_quad(builder_, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, shining_);
  add_quad(builder_, {0, 1, -50}, {50, 0, 0}, {0, 0, 100}, builder_.add_material(black()));
  expect(2e-2, [](const DVec3& p) {
    const double cut = std::clamp(-p.x, -1.0, 1.0);
    return rectangle_factor(p, -1, cut, -1, 1, 2);
  });
}

// A ball hides its own far side. At height h over p's plane it fills h r^2 / d^3 of the half space.
TEST_P(UnderALamp, BallShinesOnOneSideAtATime) {
  const Mesh ball = placed(icosphere(2), 0.5F, {0, 2, 0});
  builder_.add_mesh(ball.positions, ball.indices, shining_);
  double area = 0; // of the mesh, which is a little less than the ball's
  for (std::size_t i = 0; i < ball.indices.size(); i += 3) {
    const DVec3 a = ball.positions[ball.indices[i]], b = ball.positions[ball.indices[i + 1]],
                c = ball.positions[ball.indices[i + 2]];
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  settings_ = settings_of(6, 6);
  settings_.light_samples = 1024;
  const double r2 = area / (4 * std::numbers::pi);
  expect(8e-3, [&](const DVec3& p) {
    const double d2 = 4 + p.x * p.x + p.z * p.z;
    return 2 * r2 / (d2 * std::sqrt(d2));
  });
}

TEST_P(UnderALamp, ThroughAFilter) {
  add_quad(builder_, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, shining_);
  Material filter = clear(1, Vec3(0.5F));
  filter.thin = true;
  add_quad(builder_, {-50, 1, -50}, {100, 0, 0}, {0, 0, 100}, builder_.add_material(filter));
  expect(6e-3, [](const DVec3& p) { return 0.5 * rectangle_factor(p, -1, 1, -1, 1, 2); });
}

FASTRT_PICTURES(UnderALamp);

} // namespace
} // namespace fastrt::test
