// SPDX-License-Identifier: Apache-2.0
// The same picture every time, and the same picture of the same thing in other units.
#include "tests/equivalence/designed_shots.hpp"
#include "tests/equivalence/random_shots.hpp"

#include <gtest/gtest.h>

namespace fastrt::test {
namespace {

TEST(Determinism, TwentyRenderingsAreOne) {
  for (const Shot& shot : {mirrors("mirrors", 8, 0), coloured_shadows()}) {
    for (const Isa isa : simd_isas()) {
      const Tracer tracer = make_tracer(shot.scene, isa);
      RenderSettings settings = shot.settings;
      settings.samples_per_pixel = 3;
      const Frame first = render(tracer, shot.camera, settings);
      for (int i = 1; i < (slow_build ? 4 : 20); ++i) {
        settings.threads = 1 + i % 8;
        expect_equal(render(tracer, shot.camera, settings), first, shot.name + ", " + isa_word(isa));
      }
    }
  }
}

TEST(Determinism, ATracerIsTheSameForAnyNumberOfThreads) {
  const Shot shot = coloured_shadows();
  TracerSettings settings;
  settings.threads = 1;
  const Frame first = render(Tracer(shot.scene, settings), shot.camera, shot.settings);
  for (const int threads : {2, 3, 8}) {
    settings.threads = threads;
    expect_equal(render(Tracer(shot.scene, settings), shot.camera, shot.settings), first, "threads");
  }
}

TEST(Determinism, ABetterTreeMakesTheSamePicture) {
  for (const Shot& shot : {mirrors("mirrors", 8, 0), coloured_shadows()}) {
    TracerSettings settings;
    settings.isa = Isa::scalar;
    const Frame expected = render(Tracer(shot.scene, settings), shot.camera, shot.settings);
    settings.quality = BvhQuality::high;
    for (const Isa isa : available_isas()) {
      settings.isa = isa;
      expect_equal(render(Tracer(shot.scene, settings), shot.camera, shot.settings), expected,
                   shot.name + ", " + isa_word(isa) + ", high");
    }
  }
}

// Everything that is a length times `factor`, a power of two; absorption is per length.
Shot in_other_units(const Shot& shot, float factor) {
  SceneDesc desc = shot.scene.desc();
  ConeColumns& cones = desc.cones;
  for (Columns3* columns :
       {&desc.positions, &cones.base, &cones.apex, &desc.disks.center, &desc.planes.point})
    for (Column<float>* column : {&columns->x, &columns->y, &columns->z})
      for (float& value : *column) value *= factor;
  for (Column<float>* column : {&desc.spheres.x, &desc.spheres.y, &desc.spheres.z, &desc.spheres.radius,
                                &cones.base_radius, &cones.apex_radius, &desc.disks.radius})
    for (float& value : *column) value *= factor;
  for (Light& light : desc.lights) light.position *= factor;
  for (Material& material : desc.materials) material.absorption /= factor;
  Shot scaled{shot.name, Scene(std::move(desc)), shot.camera, shot.settings};
  scaled.camera.eye *= factor;
  scaled.camera.look_at *= factor;
  scaled.camera.view_height *= factor;
  scaled.camera.aperture_radius *= factor;
  scaled.camera.focus_distance *= factor;
  scaled.camera.focal_distance *= factor;
  if (Window* window = scaled.camera.window ? &*scaled.camera.window : nullptr)
    for (float* side : {&window->left, &window->right, &window->bottom, &window->top}) *side *= factor;
  return scaled;
}

// (u, v) of polygons and planes are lengths.
void scale_flat_coordinates(const Scene& scene, float factor, Frame& frame) {
  const AovPlane* const primitives = frame.find(Aov::primitive);
  for (AovPlane& plane : frame.aovs) {
    if (plane.aov != Aov::uv || primitives == nullptr) continue;
    for (std::size_t pixel = 0; pixel < frame.primitive.size(); ++pixel) {
      const std::int32_t id = primitives->ids[pixel];
      if (id < 0 || scene.kind(static_cast<std::uint32_t>(id)) < PrimitiveKind::polygon) continue;
      plane.values[2 * pixel] *= factor;
      plane.values[2 * pixel + 1] *= factor;
    }
  }
}

void expect_same_in_other_units(const Shot& shot) {
  const Frame in_units_of_1 =
      render(make_tracer(shot.scene, available_isas().front()), shot.camera, shot.settings);
  for (const float factor : {1.0F / 1024, 8192.0F}) {
    const Shot scaled = in_other_units(shot, factor);
    Frame expected = in_units_of_1;
    scale_flat_coordinates(shot.scene, factor, expected);
    for (AovPlane& plane : expected.aovs)
      if (plane.aov == Aov::depth || plane.aov == Aov::position)
        for (float& length : plane.values) length *= factor;
    for (const Isa isa : simd_isas())
      expect_equal(render(make_tracer(scaled.scene, isa), scaled.camera, scaled.settings), expected,
                   shot.name + ", " + isa_word(isa) + ", times " + std::to_string(factor));
  }
}

TEST(Units, DoNotChangeADesignedPicture) {
  for (const Shot& shot : designed_shots()) expect_same_in_other_units(shot);
}

TEST(Units, DoNotChangeARandomPicture) {
  for (std::uint32_t seed = 5000; seed < 5000 + static_cast<std::uint32_t>(effort(25)); ++seed)
    expect_same_in_other_units(any_shot(seed));
}

} // namespace
} // namespace fastrt::test
