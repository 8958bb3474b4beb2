// SPDX-License-Identifier: Apache-2.0
// Textures whose every pixel is known beforehand.
#include "tests/golden/pictures.hpp"

namespace fastrt::test {
namespace {

class Textures : public Picture {};

std::shared_ptr<const Image> grey_image(int width, int height, const std::vector<float>& greys) {
  std::vector<float> rgba;
  for (const float grey : greys) rgba.insert(rgba.end(), {grey, grey, grey, 1.0F});
  return std::make_shared<const Image>(width, height, std::span<const float>(rgba));
}

Texture image_texture(int width, int height, const std::vector<float>& greys) {
  Texture texture;
  texture.image = grey_image(width, height, greys);
  return texture;
}

// The square 0..1 of the plane z = 0, u along x and v along y.
void add_unit_square(SceneBuilder& builder, std::uint32_t material, float z = 0) {
  const std::vector<Vec3> positions{{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
  const std::vector<Vec2> uvs{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  builder.add_mesh(positions, indices, material, {}, "square", uvs);
}

Material shown(std::uint32_t texture) {
  Material material = glowing(Vec3(1.0F));
  material.emission_texture = texture;
  return material;
}

const Camera before_square{{0.5F, 0.5F, 2}, {0.5F, 0.5F, 0}, {0, 1, 0}, 25}; // sees the square alone

// Where the direction meets the plane z = 0.
DVec3 on_plane(const Pinhole& pinhole, const DVec3& direction) {
  return pinhole.eye() - direction * (pinhole.eye().z / direction.z);
}

TEST_P(Textures, CheckerAndGradient) {
  for (const TextureSpace space : {TextureSpace::surface, TextureSpace::plane}) {
    SceneBuilder builder;
    Texture checker;
    checker.kind = TextureKind::checker;
    checker.space = space;
    checker.plane_v = {0, 1, 0};
    checker.scale = Vec2(5.0F);
    checker.color_a = {0.25F, 0, 0, 1};
    checker.color_b = {0, 0.5F, 0, 1};
    add_unit_square(builder, builder.add_material(shown(builder.add_texture(checker))));
    const RenderSettings settings = settings_of(60, 60);
    const Pinhole pinhole(before_square, settings);
    expect_pixels(render(builder, before_square, settings), pinhole, 0,
                  [&](const DVec3& direction) -> std::optional<Vec3> {
                    const DVec3 p = 5.0 * on_plane(pinhole, direction);
                    if (std::fabs(p.x - std::round(p.x)) < 1e-4 || std::fabs(p.y - std::round(p.y)) < 1e-4)
                      return std::nullopt;
                    const int square = static_cast<int>(std::floor(p.x) + std::floor(p.y));
                    return square % 2 == 0 ? Vec3(0.25F, 0, 0) : Vec3(0, 0.5F, 0);
                  });
    Texture gradient = checker;
    gradient.kind = TextureKind::gradient;
    gradient.scale = Vec2(1.0F);
    add_unit_square(builder, builder.add_material(shown(builder.add_texture(gradient))));
    expect_pixels(render(builder, before_square, settings), pinhole, 1e-5, [&](const DVec3& direction) {
      const auto t = static_cast<float>(on_plane(pinhole, direction).y);
      return std::optional(Vec3(0.25F * (1 - t), 0.5F * t, 0));
    });
  }
}

// Four large pixels, upper left first: between their centres the value changes linearly; beyond them it goes
// on at the other side, or stays.
TEST_P(Textures, BilinearWithBothWraps) {
  const double greys[2][2] = {{0.25, 1}, {0.5, 0}}; // [row from the top][column]
  for (const bool clamp : {false, true}) {
    SceneBuilder builder;
    Texture texture = image_texture(2, 2, {0.25F, 1, 0.5F, 0});
    texture.clamp = clamp;
    add_unit_square(builder, builder.add_material(shown(builder.add_texture(texture))));
    const RenderSettings settings = settings_of(64, 64);
    const Pinhole pinhole(before_square, settings);
    expect_pixels(render(builder, before_square, settings), pinhole, 1e-5, [&](const DVec3& direction) {
      const DVec3 p = on_plane(pinhole, direction);
      // A triangle wave of the distance to the second column's centre: both wraps of two pixels have it.
      const auto share = [&](double x) {
        const double from_first = 2 * x - 0.5;
        if (clamp) return std::clamp(from_first, 0.0, 1.0);
        return from_first < 0 ? -from_first : from_first > 1 ? 2 - from_first : from_first;
      };
      const double x = share(p.x), y = share(1 - p.y);
      const double upper = greys[0][0] * (1 - x) + greys[0][1] * x;
      const double lower = greys[1][0] * (1 - x) + greys[1][1] * x;
      return std::optional(Vec3(static_cast<float>(upper * (1 - y) + lower * y)));
    });
  }
}

// Seen from far away a fine checker is the mean of its squares, without noise.
TEST_P(Textures, FarAwayIsTheMean) {
  std::vector<float> greys;
  for (int i = 0; i < 256 * 256; ++i) greys.push_back(((i + i / 256) & 1) != 0 ? 1.0F : 0.0F);
  SceneBuilder builder;
  add_unit_square(builder, builder.add_material(shown(builder.add_texture(image_texture(256, 256, greys)))));
  const RenderSettings settings = settings_of(40, 40);
  expect_pixels(render(builder, before_square, settings), Pinhole(before_square, settings), 1e-6,
                [](const DVec3&) { return std::optional(Vec3(0.5F)); });
}

// The level grows by one for each doubling of the distance: from where 64 pixels of the image meet one of
// the picture.
TEST_P(Textures, LevelFollowsTheDistance) {
  std::vector<float> greys(64 * 64, 0.0F);
  std::fill_n(greys.begin(), 64 * 32, 1.0F); // the upper half: its edge blurs as levels go up
  SceneBuilder builder;
  add_unit_square(builder, builder.add_material(shown(builder.add_texture(image_texture(64, 64, greys)))));
  for (const double level : {1.0, 2.0, 3.0}) {
    // One pixel of the picture, exactly two to the level of the image wide.
    const double width = std::exp2(level) / 64;
    const float distance = 4;
    const auto fov = static_cast<float>(2 * std::atan(0.5 * 16 * width / distance) * 180 / std::numbers::pi);
    // Pixels' centres lie a quarter of a pixel of the level above the edge, and three quarters below: within
    // its blur and without. On a level less that is without too, on a level more both are within.
    const auto y = static_cast<float>(0.5 - 0.25 * width);
    const Camera camera{{0.5F, y, distance}, {0.5F, y, 0}, {0, 1, 0}, fov};
    const RenderSettings settings = settings_of(16, 16);
    const Frame frame = render(builder, camera, settings);
    builder = SceneBuilder();
    add_unit_square(builder, builder.add_material(shown(builder.add_texture(image_texture(64, 64, greys)))));
    EXPECT_NEAR(color_at(frame, 8, 7).x, 0.75F, 2e-2) << level;
    EXPECT_NEAR(color_at(frame, 8, 8).x, 0.0F, 2e-2) << level;
  }
}

// Each of four samples stands for half a pixel's width, each of 16 for a quarter.
TEST_P(Textures, LevelFollowsTheSamples) {
  std::vector<float> greys(64 * 64, 0.0F);
  std::fill_n(greys.begin(), 64 * 32, 1.0F);
  for (const int samples : {4, 16}) {
    SceneBuilder builder;
    add_unit_square(builder, builder.add_material(shown(builder.add_texture(image_texture(64, 64, greys)))));
    // One pixel of the picture is four of the image wide, and row 8 begins one of the image below the edge:
    // as far as its blur on level 1 reaches, and half of what it reaches on level 2.
    const double width = 4.0 / 64;
    const float distance = 4;
    const auto fov = static_cast<float>(2 * std::atan(0.5 * 16 * width / distance) * 180 / std::numbers::pi);
    const auto y = static_cast<float>(0.5 - 0.25 * width);
    RenderSettings settings = settings_of(16, 16);
    settings.samples_per_pixel = samples;
    settings.filter = PixelFilter::box;
    const Frame frame = render(builder, Camera{{0.5F, y, distance}, {0.5F, y, 0}, {0, 1, 0}, fov}, settings);
    float sum = 0;
    for (int x = 0; x < 16; ++x) sum += color_at(frame, x, 8).x;
    EXPECT_LT(sum / 16, 4e-3F) << samples;
  }
}

TEST_P(Textures, CutOutsLetLightThrough) {
  SceneBuilder builder;
  Light sun;
  sun.kind = LightKind::directional;
  sun.direction = {0, 0, -1};
  builder.add_light(sun);
  Material floor = black();
  floor.diffuse = Vec3(1.0F);
  add_quad(builder, {-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, builder.add_material(floor));
  Texture holes;
  holes.kind = TextureKind::checker;
  holes.scale = Vec2(4.0F);
  holes.color_a = glm::vec4(0.0F);
  holes.color_b = glm::vec4(1.0F);
  Material screen = black();
  screen.thin = true;
  screen.opacity_texture = builder.add_texture(holes);
  add_unit_square(builder, builder.add_material(screen));
  const Camera camera{{0.5F, 0.5F, -0.25F}, {0.5F, 0.5F, -1}, {0, 1, 0}, 80}; // behind the screen
  const RenderSettings settings = settings_of(50, 50);
  const Pinhole pinhole(camera, settings);
  expect_pixels(render(builder, camera, settings), pinhole, 1e-6,
                [&](const DVec3& direction) -> std::optional<Vec3> {
                  const DVec3 p = 4.0 * (pinhole.eye() - direction * (0.75 / direction.z));
                  if (std::fabs(p.x - std::round(p.x)) < 1e-4 || std::fabs(p.y - std::round(p.y)) < 1e-4)
                    return std::nullopt;
                  if (p.x < 0 || p.x > 4 || p.y < 0 || p.y > 4) return Vec3(1.0F);
                  const int square = static_cast<int>(std::floor(p.x) + std::floor(p.y));
                  return Vec3(square % 2 == 0 ? 1.0F : 0.0F);
                });
}

// A height that rises by slope s along u turns the normal to (-s, 0, 1).
TEST_P(Textures, BumpsTurnTheNormal) {
  std::vector<float> ramp;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 64; ++x) ramp.push_back(static_cast<float>(x) / 64);
  const double slope = 0.5;
  for (const bool normal_map : {false, true}) {
    SceneBuilder builder;
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = {1, 0, -1};
    builder.add_light(sun);
    Material material = black();
    material.diffuse = Vec3(1.0F);
    material.bump_is_normal_map = normal_map;
    const float x = static_cast<float>(-slope / std::sqrt(1 + slope * slope));
    const float z = static_cast<float>(1 / std::sqrt(1 + slope * slope));
    Texture texture = image_texture(64, 4, ramp);
    if (normal_map) {
      const std::vector<float> rgba{0.5F * x + 0.5F, 0.5F, 0.5F * z + 0.5F, 1};
      texture.image = std::make_shared<const Image>(1, 1, std::span<const float>(rgba));
    } else {
      material.bump_scale = static_cast<float>(slope * 64); // per pixel of the image the ramp rises by 1/64
    }
    material.bump_texture = builder.add_texture(texture);
    add_unit_square(builder, builder.add_material(material));
    const RenderSettings settings = settings_of(40, 40);
    const Pinhole pinhole(before_square, settings);
    const float cosine = glm::dot(Vec3(x, 0, z), glm::normalize(Vec3(-1, 0, 1)));
    expect_pixels(render(builder, before_square, settings), pinhole, 1e-4,
                  [&](const DVec3& direction) -> std::optional<Vec3> {
                    const DVec3 p = on_plane(pinhole, direction);
                    if (p.x < 0.04 || p.x > 0.96) return std::nullopt; // where the ramp starts again
                    return Vec3(cosine);
                  });
  }
}

TEST_P(Textures, VertexColoursAreInterpolated) {
  SceneBuilder builder;
  builder.set_ambient(Vec3(1.0F));
  Material material = black();
  material.ambient = Vec3(0.5F);
  material.vertex_colors = true;
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> colors{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  builder.add_mesh(positions, indices, builder.add_material(material), {}, "square", {}, colors);
  const RenderSettings settings = settings_of(40, 40);
  const Pinhole pinhole(before_square, settings);
  expect_pixels(render(builder, before_square, settings), pinhole, 1e-5, [&](const DVec3& direction) {
    const DVec3 p = on_plane(pinhole, direction);
    return std::optional(0.5F * Vec3(p.x, p.y, 1));
  });
}

FASTRT_PICTURES(Textures);

} // namespace
} // namespace fastrt::test
