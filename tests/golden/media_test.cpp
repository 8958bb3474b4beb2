// SPDX-License-Identifier: Apache-2.0
// Light on its way through media, and views from within them, against Beer-Lambert's and Snell's laws.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class MediaPictures : public Picture {};

// Not bent, but dimmed.
Material fog(const Vec3& absorption) {
  Material material = clear(1);
  material.absorption = absorption;
  return material;
}
const DVec3 sigma{0.25, 0.5, 0};

Material white() {
  Material material = black();
  material.diffuse = Vec3(1.0F);
  return material;
}

std::optional<Vec3> dimmed(double light, double way) {
  return Vec3(DVec3(light * std::exp(-sigma.x * way), light * std::exp(-sigma.y * way), light));
}

// The floor y = 0, and fog between two heights.
SceneBuilder foggy_floor(float low, float high, const Light& light) {
  SceneBuilder builder;
  builder.add_light(light);
  add_quad(builder, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, builder.add_material(white()));
  add_box(builder, {-60, low, -60}, {60, high, 60}, builder.add_material(fog(Vec3(sigma))));
  return builder;
}

// The floor from half a unit above it.
const Camera low_camera{{0, 0.5F, 0}, {0, 0, 0}, {0, 0, -1}, 80};
DVec3 on_floor(const DVec3& direction) { return DVec3(0, 0.5, 0) - direction * (0.5 / direction.y); }

Light light_at(LightKind kind, const Vec3& position) {
  Light light;
  light.kind = kind;
  light.position = position;
  light.direction = {1, -2, 2};
  light.radius = 1e-3F;
  return light;
}

// Above the fog, in it, and so close to the floor that the fog is behind it.
TEST_P(MediaPictures, ShadowRaysFadeInWhatTheyCross) {
  const RenderSettings settings = settings_of(24, 24);
  for (const LightKind kind : {LightKind::point, LightKind::sphere})
    for (const float height : {4.0F, 1.75F, 0.75F}) {
      SceneBuilder builder = foggy_floor(1, 2, light_at(kind, {0.5F, height, 0}));
      expect_pixels(render(builder, low_camera, settings), Pinhole(low_camera, settings),
                    kind == LightKind::point ? 1e-5 : 2e-3, [&](const DVec3& direction) {
                      const DVec3 way = DVec3(0.5, height, 0) - on_floor(direction);
                      const double cosine = way.y / glm::length(way);
                      const double in_fog = std::clamp(way.y, 1.0, 2.0) - 1;
                      return dimmed(cosine, in_fog / cosine);
                    });
    }
}

TEST_P(MediaPictures, DirectionalLightFadesInWhatItCrosses) {
  const RenderSettings settings = settings_of(24, 24);
  SceneBuilder builder = foggy_floor(1, 2, light_at(LightKind::directional, {}));
  expect_pixels(render(builder, low_camera, settings), Pinhole(low_camera, settings), 1e-5,
                [&](const DVec3&) { return dimmed(2.0 / 3, 1.5); });
}

// Camera, floor and lights are all in the fog.
TEST_P(MediaPictures, InTheMiddleOfAMedium) {
  const RenderSettings settings = settings_of(24, 24);
  for (const LightKind kind : {LightKind::point, LightKind::directional}) {
    SceneBuilder builder = foggy_floor(-1, 3, light_at(kind, {0.5F, 2, 0}));
    expect_pixels(render(builder, low_camera, settings), Pinhole(low_camera, settings), 1e-5,
                  [&](const DVec3& direction) {
                    const double view = 0.5 / -direction.y;
                    if (kind == LightKind::directional) return dimmed(2.0 / 3, view + 3 * 1.5);
                    const DVec3 way = DVec3(0.5, 2, 0) - on_floor(direction);
                    return dimmed(way.y / glm::length(way), view + glm::length(way));
                  });
  }
}

// A parallel view starts where its plane is.
TEST_P(MediaPictures, ParallelRaysStartInAMedium) {
  const RenderSettings settings = settings_of(16, 16);
  Camera camera{{0, 2, 0}, {0, 0, 0}, {0, 0, -1}, 40};
  camera.projection = Projection::orthographic;
  camera.view_height = 4;
  SceneBuilder builder = foggy_floor(-1, 3, light_at(LightKind::directional, {}));
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 1e-5,
                [&](const DVec3&) { return dimmed(2.0 / 3, 2 + 3 * 1.5); });
}

// A pane without a back is nothing to be in where only one of the ways out of the eye passes it.
TEST_P(MediaPictures, MostWaysOutSayWhereTheEyeIs) {
  const DVec3 ways[] = {{0.2735, 0.8942, 0.3541}, {0.5139, 0.7231, 0.4617}, {0.3313, 0.6241, 0.7077}};
  for (const DVec3& way : ways) {
    SceneBuilder builder;
    add_quad(builder, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, builder.add_material(glowing(Vec3(1.0F))));
    Material fog = clear(1.5F);
    fog.absorption = Vec3(1.0F);
    add_quad(builder, Vec3(DVec3(0, 0, 5) + 2.0 * way) - Vec3(0.1F, 0, 0.1F), {0.2F, 0, 0}, {0, 0, 0.2F},
             builder.add_material(fog));
    const Frame frame = render(builder, Camera{}, settings_of(4, 4));
    EXPECT_EQ(color_at(frame, 2, 2), Vec3(1.0F));
  }
}

// A slab 0 > z > -2 with a ball in it, traced in double precision. A ray that leaves downwards shows on which
// side of x = 0 it meets the plane z = -10.
class BallInASlab {
public:
  double slab_ior, ball_ior;
  DVec3 slab_sigma, ball_sigma;
  DSphere ball{{0.2, 0.1, -1}, 0.6};

  std::optional<Vec3> look(DVec3 origin, DVec3 direction) const {
    DVec3 light{1};
    bool in_slab = origin.z < 0 && origin.z > -2;
    bool in_ball = glm::length(origin - ball.center) < ball.radius;
    for (int bounce = 0; bounce <= 8; ++bounce) {
      const DVec3 v = origin - ball.center;
      const double b = glm::dot(v, direction), c = glm::dot(v, v) - ball.radius * ball.radius;
      if (!in_ball && b < 0 && std::fabs(gap(origin, direction, ball)) < 2e-3) return std::nullopt;
      const double root = std::sqrt(std::max(b * b - c, 0.0));
      const bool meets = in_ball || (b < 0 && b * b > c && c > 1e-9);
      const double to_ball = meets ? (in_ball ? -b + root : -b - root) : 1e9;
      const double face = in_slab && direction.z < 0 ? -2 : 0;
      const bool leaves = !in_slab && (origin.z < -1 || direction.z > 0);
      const double to_face = leaves ? 1e9 : (face - origin.z) / direction.z;
      const double way = std::min(to_ball, to_face);
      if (way > 1e8) return left(origin, direction, light);
      light *= glm::exp(-way * (in_ball ? ball_sigma : in_slab ? slab_sigma : DVec3(0)));
      origin += way * direction;
      if (std::fabs(origin.x) > 39 || std::fabs(origin.y) > 39) return std::nullopt; // the slab's rim
      const bool at_ball = to_ball < to_face;
      DVec3 normal = at_ball ? (origin - ball.center) / ball.radius : DVec3(0, 0, 1);
      if (glm::dot(normal, direction) > 0) normal = -normal;
      const double before = in_ball ? ball_ior : in_slab ? slab_ior : 1;
      const double after = at_ball ? (in_ball ? slab_ior : ball_ior) : in_slab ? 1 : slab_ior;
      const double cosine = -glm::dot(normal, direction), eta = before / after;
      const double k = 1 - eta * eta * (1 - cosine * cosine);
      if (std::fabs(k) < 1e-3) return std::nullopt;
      if (k < 0) {
        direction += 2 * cosine * normal;
        continue;
      }
      direction = glm::normalize(eta * direction + (eta * cosine - std::sqrt(k)) * normal);
      (at_ball ? in_ball : in_slab) ^= true;
    }
    return Vec3(0.0F); // the depth ends here
  }

private:
  static std::optional<Vec3> left(const DVec3& origin, const DVec3& direction, const DVec3& light) {
    if (direction.z > 0) return Vec3(0.5 * light);
    const double x = origin.x - direction.x * (origin.z + 10) / direction.z;
    if (std::fabs(x) < 5e-3) return std::nullopt;
    return Vec3(x < 0 ? light * DVec3(1, 0, 0) : light * DVec3(0, 0.75, 1));
  }
};

class NestedMedia : public MediaPictures {
protected:
  void check(const BallInASlab& truth, const Camera& camera) const {
    const auto material = [](double ior, const DVec3& absorption) {
      Material medium = clear(static_cast<float>(ior));
      medium.absorption = Vec3(absorption);
      return medium;
    };
    SceneBuilder builder;
    builder.set_background(Vec3(0.5F));
    add_box(builder, {-40, -40, -2}, {40, 40, 0},
            builder.add_material(material(truth.slab_ior, truth.slab_sigma)));
    builder.add_sphere(Vec3(truth.ball.center), 0.6F,
                       builder.add_material(material(truth.ball_ior, truth.ball_sigma)));
    add_quad(builder, {-900, -900, -10}, {900, 0, 0}, {0, 1800, 0}, builder.add_material(glowing({1, 0, 0})));
    add_quad(builder, {0, -900, -10}, {900, 0, 0}, {0, 1800, 0},
             builder.add_material(glowing({0, 0.75F, 1})));
    const RenderSettings settings = settings_of(60, 60);
    const Pinhole pinhole(camera, settings);
    expect_pixels(render(builder, camera, settings), pinhole, 2e-4,
                  [&](const DVec3& direction) { return truth.look(pinhole.eye(), direction); });
  }

  const BallInASlab bubble_in_glass{1.5, 1, {0.125, 0.5, 0}, {0, 0, 0}};
  const BallInASlab glass_in_water{1.333, 1.6, {0.25, 0, 0.125}, {0, 0.5, 0.25}};
};

TEST_P(NestedMedia, FromOutside) {
  const Camera camera{{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 50};
  check(bubble_in_glass, camera);
  check(glass_in_water, camera);
}

TEST_P(NestedMedia, FromWithinTheOuterOne) {
  const Camera camera{{0.3F, 0.2F, -0.1F}, {0.3F, 0.2F, -1}, {0, 1, 0}, 30};
  check(bubble_in_glass, camera);
  check(glass_in_water, camera);
}

TEST_P(NestedMedia, FromWithinBoth) {
  const Camera camera{{0.3F, 0.1F, -0.9F}, {0.3F, 0.2F, -2}, {0, 1, 0}, 50};
  check(bubble_in_glass, camera);
  check(glass_in_water, camera);
}

// Under a sheet of water that has no bottom: the sky in a round window, and around it the floor's image.
TEST_P(MediaPictures, SnellsWindow) {
  const double ior = 1.333;
  Material water = clear(1.333F);
  water.absorption = Vec3(sigma);
  SceneBuilder builder;
  builder.set_background(Vec3(1.0F));
  add_quad(builder, {-900, 0, -900}, {1800, 0, 0}, {0, 0, 1800}, builder.add_material(water));
  add_quad(builder, {-900, -1, -900}, {1800, 0, 0}, {0, 0, 1800}, builder.add_material(glowing(Vec3(0.25F))));
  const Camera camera{{0, -0.5F, 0}, {0, 0, 0}, {0, 0, -1}, 110};
  const RenderSettings settings = settings_of(64, 64);
  expect_pixels(render(builder, camera, settings), Pinhole(camera, settings), 2e-4,
                [&](const DVec3& direction) -> std::optional<Vec3> {
                  const double sine = std::hypot(direction.x, direction.z);
                  if (std::fabs(sine - 1 / ior) < 1e-3) return std::nullopt;
                  return sine < 1 / ior ? dimmed(1, 0.5 / direction.y) : dimmed(0.25, 1.5 / direction.y);
                });
}

// A camera and a light above the sheet are not in the water.
TEST_P(MediaPictures, AboveAnOpenSheet) {
  SceneBuilder builder;
  builder.add_light(light_at(LightKind::point, {0.5F, 3, 0}));
  add_quad(builder, {-50, 0, -50}, {100, 0, 0}, {0, 0, 100}, builder.add_material(white()));
  add_quad(builder, {-60, 0.25F, -60}, {120, 0, 0}, {0, 0, 120}, builder.add_material(fog(Vec3(sigma))));
  const RenderSettings settings = settings_of(16, 16);
  expect_pixels(render(builder, low_camera, settings), Pinhole(low_camera, settings), 1e-4,
                [&](const DVec3& direction) {
                  const DVec3 way = DVec3(0.5, 3, 0) - on_floor(direction);
                  const double cosine = way.y / glm::length(way);
                  return dimmed(cosine, 0.25 / cosine + 0.25 / -direction.y);
                });
}

FASTRT_PICTURES(MediaPictures);
FASTRT_PICTURES(NestedMedia);

} // namespace
} // namespace fastrt::test
