// SPDX-License-Identifier: Apache-2.0
#include "src/reference/secondary.hpp"
#include "src/reference/shading.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fastrt::test {
namespace {

using reference::Media;
using reference::Secondary;
using reference::Surface;

Scene scene_of(const std::vector<Material>& materials) {
  SceneBuilder builder;
  for (const Material& material : materials) builder.add_material(material);
  return builder.build();
}

Material glass(float ior) {
  Material material;
  material.opacity = 0.25F;
  material.transmission = {1, 0.5F, 0.25F};
  material.mirror = {0.5F, 0.25F, 1};
  material.ior = ior;
  return material;
}

// Seen from above at an angle to the normal, which is +y.
Surface surface_at_angle(float degrees, std::uint32_t material) {
  const float angle = degrees * 3.14159265F / 180;
  Surface surface;
  surface.geometric_normal = surface.shading_normal = {0, 1, 0};
  surface.incident = {std::sin(angle), -std::cos(angle), 0};
  surface.to_viewer = -surface.incident;
  surface.material = material;
  return surface;
}

TEST(ReferenceMedia, EnterAndLeave) {
  const Media outside;
  EXPECT_TRUE(outside.empty());
  const Media in_water = outside.crossed(1);
  EXPECT_EQ(in_water.innermost(), 1U);
  const Media in_bubble = in_water.crossed(2);
  EXPECT_EQ(in_bubble.innermost(), 2U);
  EXPECT_EQ(in_bubble.crossed(2).innermost(), 1U);
  // Overlapping bodies may be left in any order.
  EXPECT_EQ(in_bubble.crossed(1).innermost(), 2U);
  EXPECT_TRUE(in_bubble.crossed(1).crossed(2).empty());
}

TEST(ReferenceMedia, AFifthPushesTheOutermostOut) {
  Media media;
  for (std::uint32_t material = 1; material <= 5; ++material) media = media.crossed(material);
  for (std::uint32_t material = 5; material >= 2; --material) {
    EXPECT_EQ(media.innermost(), material);
    media = media.crossed(material);
  }
  EXPECT_TRUE(media.empty());
}

TEST(ReferenceSecondary, MirrorDirectionHasTheSameAngle) {
  const Scene scene = scene_of({glass(1.5F)});
  for (float degrees = 0; degrees < 90; degrees += 7) {
    const Surface surface = surface_at_angle(degrees, 0);
    const Secondary next = secondary_rays(scene, surface, {});
    EXPECT_NEAR(next.mirror.x, surface.incident.x, 1e-6F);
    EXPECT_NEAR(next.mirror.y, -surface.incident.y, 1e-6F);
    EXPECT_EQ(next.mirror_weight, Vec3(0.5F, 0.25F, 1));
    EXPECT_EQ(next.transmitted_weight, 0.75F * Vec3(1, 0.5F, 0.25F));
  }
}

TEST(ReferenceSecondary, MirrorDirectionNeverGoesIntoTheSurface) {
  const Scene scene = scene_of({glass(1.5F)});
  Surface surface = surface_at_angle(85, 0);
  surface.shading_normal = glm::normalize(Vec3(0.3F, 1, 0));
  const Secondary next = secondary_rays(scene, surface, {});
  EXPECT_GT(glm::dot(next.mirror, surface.geometric_normal), 0.0F);
}

TEST(ReferenceSecondary, TransmittedDirectionFollowsSnell) {
  const Scene scene = scene_of({glass(1.5F), glass(1.33F)});
  for (float degrees = 0; degrees < 90; degrees += 7) {
    const Surface surface = surface_at_angle(degrees, 0);
    const Secondary in = secondary_rays(scene, surface, {});
    EXPECT_NEAR(1.5F * in.transmitted.x, surface.incident.x, 2e-6F);
    EXPECT_NEAR(glm::length(in.transmitted), 1, 2e-6F);
    EXPECT_EQ(in.transmitted_media.innermost(), 0U);
    // Glass in water: only the ratio counts.
    const Secondary from_water = secondary_rays(scene, surface, Media().crossed(1));
    EXPECT_NEAR(1.5F * from_water.transmitted.x, 1.33F * surface.incident.x, 2e-6F);
    // Out of the glass, back into water.
    const Media in_both = Media().crossed(1).crossed(0);
    const Secondary out = secondary_rays(scene, surface, in_both);
    if (degrees < 60) {
      EXPECT_NEAR(1.33F * out.transmitted.x, 1.5F * surface.incident.x, 2e-6F);
    }
    EXPECT_EQ(out.transmitted_media.innermost(), 1U);
  }
}

TEST(ReferenceSecondary, TotalReflectionMovesTheWeight) {
  const Scene scene = scene_of({glass(1.5F)});
  const Media inside = Media().crossed(0);
  const Vec3 through = 0.75F * Vec3(1, 0.5F, 0.25F);
  EXPECT_EQ(secondary_rays(scene, surface_at_angle(41, 0), inside).transmitted_weight, through);
  const Secondary beyond = secondary_rays(scene, surface_at_angle(42, 0), inside);
  EXPECT_EQ(beyond.transmitted_weight, Vec3(0.0F));
  EXPECT_EQ(beyond.mirror_weight, Vec3(0.5F, 0.25F, 1) + through);
}

TEST(ReferenceSecondary, SchlickGoesFromKrToOne) {
  Material material = glass(1.5F);
  material.fresnel = Fresnel::schlick;
  const Scene scene = scene_of({material});
  EXPECT_EQ(secondary_rays(scene, surface_at_angle(0, 0), {}).mirror_weight, Vec3(0.5F, 0.25F, 1));
  const Vec3 grazing = secondary_rays(scene, surface_at_angle(90, 0), {}).mirror_weight;
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(grazing[i], 1, 1e-5F);
  const Vec3 at_60 = secondary_rays(scene, surface_at_angle(60, 0), {}).mirror_weight;
  EXPECT_NEAR(at_60.y, 0.25F + 0.75F * std::pow(0.5F, 5.0F), 1e-6F);
}

TEST(ReferenceSecondary, DielectricSharesTheLight) {
  Material material = glass(1.5F);
  material.fresnel = Fresnel::dielectric;
  material.mirror = material.transmission = Vec3(1.0F);
  material.opacity = 0;
  const Scene scene = scene_of({material});
  for (float degrees = 0; degrees < 90; degrees += 7) {
    const double angle_i = degrees * 3.14159265358979 / 180;
    const double angle_t = std::asin(std::sin(angle_i) / 1.5);
    const double rs = degrees == 0 ? 0.2 : std::sin(angle_i - angle_t) / std::sin(angle_i + angle_t);
    const double rp = degrees == 0 ? 0.2 : std::tan(angle_i - angle_t) / std::tan(angle_i + angle_t);
    const Secondary next = secondary_rays(scene, surface_at_angle(degrees, 0), {});
    EXPECT_NEAR(next.mirror_weight.x, 0.5 * (rs * rs + rp * rp), 2e-6);
    EXPECT_NEAR(next.mirror_weight.x + next.transmitted_weight.x, 1, 1e-6);
  }
  const Secondary total = secondary_rays(scene, surface_at_angle(60, 0), Media().crossed(0));
  EXPECT_EQ(total.mirror_weight, Vec3(1.0F));
  EXPECT_EQ(total.transmitted_weight, Vec3(0.0F));
}

TEST(ReferenceSecondary, ThinSurfacesAreNoMedium) {
  Material material = glass(1.5F);
  material.thin = true;
  const Scene scene = scene_of({material});
  const Surface surface = surface_at_angle(50, 0);
  const Secondary next = secondary_rays(scene, surface, {});
  EXPECT_EQ(next.transmitted, surface.incident);
  EXPECT_TRUE(next.transmitted_media.empty());
}

TEST(ReferenceSecondary, OpaqueSurfacesLetNothingThrough) {
  Material material = glass(1.5F);
  material.opacity = 1;
  const Secondary next = secondary_rays(scene_of({material}), surface_at_angle(50, 0), {});
  EXPECT_EQ(next.transmitted_weight, Vec3(0.0F));
  EXPECT_EQ(next.mirror_weight, material.mirror);
}

TEST(ReferenceSharedMath, IsCloseToTheLibrarys) {
  for (float x = 0.001F; x < 1; x += 0.0137F)
    for (const float exponent : {1.0F, 2.5F, 40.0F, 300.0F}) {
      const double truth = std::pow(static_cast<double>(x), static_cast<double>(exponent));
      if (truth < 1e-37) continue;
      EXPECT_NEAR(reference::shared_pow(x, exponent) / truth, 1, 4e-4) << x << " " << exponent;
    }
  for (float x = 0; x < 80; x += 0.37F)
    EXPECT_NEAR(reference::shared_exp(-x) / std::exp(-static_cast<double>(x)), 1, 4e-4) << x;
}

} // namespace
} // namespace fastrt::test
