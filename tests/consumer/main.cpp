// SPDX-License-Identifier: Apache-2.0
// A red triangle before a grey background, built, asked and rendered through the installed library.
#include <fastrt/fastrt.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace {

fastrt::Scene make_scene() {
  fastrt::SceneBuilder builder;
  fastrt::Material red;
  red.diffuse = {0.8F, 0.1F, 0.1F};
  const std::array<fastrt::Vec3, 3> corners{fastrt::Vec3(-1, -1, 0), fastrt::Vec3(1, -1, 0),
                                            fastrt::Vec3(0, 1, 0)};
  const std::array<std::uint32_t, 3> indices{0, 1, 2};
  builder.add_mesh(corners, indices, builder.add_material(std::move(red)));
  fastrt::Light light;
  light.position = {0, 0, 5};
  builder.add_light(light);
  builder.set_background(fastrt::Vec3(0.5F));
  return builder.build();
}

// One ray that hits the triangle from 5 away, and one that passes it.
bool hits_as_expected(const fastrt::Tracer& tracer) {
  const std::array<float, 2> origin_x{0, 3}, origin_y{0, 0}, origin_z{5, 5};
  const std::array<float, 2> dir_x{0, 0}, dir_y{0, 0}, dir_z{-1, -1};
  std::array<float, 2> t{};
  std::array<std::int32_t, 2> primitive{};
  fastrt::RayArrays rays{origin_x.data(), origin_y.data(), origin_z.data(),
                         dir_x.data(),    dir_y.data(),    dir_z.data()};
  rays.count = 2;
  fastrt::HitArrays hits{};
  hits.t = t.data();
  hits.primitive = primitive.data();
  tracer.closest_hit(rays, hits);
  return primitive[0] == 0 && t[0] == 5.0F && primitive[1] == fastrt::no_primitive;
}

bool renders_as_expected(const fastrt::Tracer& tracer) {
  fastrt::RenderSettings settings;
  settings.width = settings.height = 16;
  const fastrt::Frame frame = fastrt::render(tracer, fastrt::Camera{}, settings);
  const std::size_t center = 8 * 16 + 8;
  return frame.complete && frame.rgb.size() == 3 * 16 * 16 && frame.rgb[0] == 0.5F &&
         frame.primitive[0] == fastrt::no_primitive && frame.primitive[center] == 0 &&
         frame.rgb[3 * center] > frame.rgb[3 * center + 1];
}

// EXR, HDR and JPEG are written by modules.
bool writes_as_expected() {
  const std::array<float, 3> pixel{0.25F, 0.5F, 1};
  for (const char* format : {"png", "exr", "hdr", "jpg"})
    if (fastrt::encode_image(format, pixel, 1, 1).empty()) return false;
  return true;
}

} // namespace

int main() {
  const fastrt::Tracer tracer(make_scene());
  if (!hits_as_expected(tracer) || !renders_as_expected(tracer) || !writes_as_expected()) {
    std::puts("the installed library gives wrong answers");
    return 1;
  }
  std::printf("fastrt %s works\n", fastrt::version());
  return 0;
}
