// SPDX-License-Identifier: Apache-2.0
// What Scene refuses and what it says of itself.
#include <fastrt/error.hpp>
#include <fastrt/load.hpp>
#include <fastrt/scene.hpp>
#include <fastrt/version.hpp>

#include <gtest/gtest.h>
#include <omp.h>

#include <functional>
#include <limits>
#include <string>

namespace fastrt {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// Two triangles, the second one without a normal at a corner; one sphere; one light of each kind.
SceneDesc small_scene() {
  SceneDesc desc;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)})
    desc.positions.push_back(p);
  desc.normals.push_back({0, 0, 1});
  desc.uvs.x.push_back(0.5F), desc.uvs.y.push_back(0.25F);
  desc.triangles.v0 = {0, 0};
  desc.triangles.v1 = {1, 1};
  desc.triangles.v2 = {2, 3};
  desc.triangles.n0 = {0, 0};
  desc.triangles.n1 = {0, no_index};
  desc.triangles.n2 = {0, 0};
  desc.triangles.t0 = desc.triangles.t1 = desc.triangles.t2 = {0, no_index};
  desc.triangles.material = {0, 1};
  desc.triangles.object = {0, 0};
  desc.spheres.x = {-5.0F};
  desc.spheres.y = {0.0F};
  desc.spheres.z = {0.0F};
  desc.spheres.radius = {0.5F};
  desc.spheres.material = {1};
  desc.spheres.object = {1};
  desc.materials.resize(2);
  desc.object_names = {"mesh", "ball"};
  desc.lights.resize(2);
  desc.lights[1].kind = LightKind::directional;
  return desc;
}

std::string error_of(const SceneDesc& desc) {
  try {
    const Scene scene(desc);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Scene, ConstructsAndCounts) {
  const Scene scene(small_scene());
  EXPECT_EQ(scene.triangle_count(), 2U);
  EXPECT_EQ(scene.sphere_count(), 1U);
  EXPECT_EQ(scene.primitive_count(), 3U);
  EXPECT_EQ(scene.kind(1), PrimitiveKind::triangle);
  EXPECT_EQ(scene.kind(2), PrimitiveKind::sphere);
  EXPECT_EQ(scene.material_of(0), 0U);
  EXPECT_EQ(scene.material_of(1), 1U);
  EXPECT_EQ(scene.material_of(2), 1U);
  EXPECT_EQ(scene.object_of(1), 0U);
  EXPECT_EQ(scene.object_of(2), 1U);
  EXPECT_EQ(scene.bounds().lower, Vec3(-5.5F, -0.5F, -0.5F));
  EXPECT_EQ(scene.bounds().upper, Vec3(1.0F, 2.0F, 3.0F));
  EXPECT_GE(scene.bytes(), 21 * sizeof(float));
}

TEST(Scene, AnEmptyOneIsFine) {
  const Scene scene{SceneDesc{}};
  EXPECT_EQ(scene.primitive_count(), 0U);
  EXPECT_TRUE(scene.bounds().empty());
  EXPECT_EQ(scene.bytes(), 0U);
}

TEST(Scene, KnowsWhetherLightPassesThrough) {
  SceneDesc desc = small_scene();
  EXPECT_FALSE(Scene(desc).has_transmission());
  desc.materials[1].opacity = 0.5F;
  EXPECT_TRUE(Scene(desc).has_transmission());
  desc.materials[1].transmission = Vec3(0.0F);
  EXPECT_FALSE(Scene(desc).has_transmission());
}

struct Fault {
  const char* name;
  std::function<void(SceneDesc&)> make;
  const char* message; // part of what() that must be there
};

class SceneFaults : public testing::TestWithParam<Fault> {};

TEST_P(SceneFaults, AreRefused) {
  SceneDesc desc = small_scene();
  ASSERT_EQ(error_of(desc), "");
  GetParam().make(desc);
  const std::string error = error_of(desc);
  EXPECT_NE(error.find(GetParam().message), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
}

const Fault geometry_faults[] = {
    {"PositionNan", [](SceneDesc& d) { d.positions.y[3] = nan; }, "vertex 3: y is not a finite"},
    {"PositionInfinite", [](SceneDesc& d) { d.positions.x[0] = -infinity; }, "vertex 0: x"},
    {"PositionColumns", [](SceneDesc& d) { d.positions.z.push_back(0); }, "vertex columns"},
    {"NormalNan", [](SceneDesc& d) { d.normals.z[0] = nan; }, "normal 0: z"},
    {"NormalColumns", [](SceneDesc& d) { d.normals.y.clear(); }, "normal columns"},
    {"UvInfinite", [](SceneDesc& d) { d.uvs.y[0] = infinity; }, "texture coordinate 0: v"},
    {"UvColumns", [](SceneDesc& d) { d.uvs.x.push_back(0); }, "texture coordinate columns"},
    {"VertexIndex", [](SceneDesc& d) { d.triangles.v1[1] = 4; },
     "triangle 1: refers to vertex 4, but there are 4"},
    {"VertexNoIndex", [](SceneDesc& d) { d.triangles.v2[0] = no_index; }, "triangle 0: refers to vertex"},
    {"NormalIndex", [](SceneDesc& d) { d.triangles.n2[0] = 1; }, "triangle 0: refers to normal 1"},
    {"UvIndex", [](SceneDesc& d) { d.triangles.t0[1] = 7; }, "triangle 1: refers to texture coordinate 7"},
    {"TriangleMaterial", [](SceneDesc& d) { d.triangles.material[0] = 2; },
     "triangle 0: refers to material 2"},
    {"MaterialNoIndex", [](SceneDesc& d) { d.triangles.material[0] = no_index; }, "refers to material"},
    {"TriangleObject", [](SceneDesc& d) { d.triangles.object[1] = 2; }, "triangle 1: refers to object 2"},
    {"TriangleColumns", [](SceneDesc& d) { d.triangles.v2.push_back(0); }, "triangles' columns"},
    {"MissingMaterials", [](SceneDesc& d) { d.triangles.material.clear(); }, "triangles' columns"},
    {"HalfNormals", [](SceneDesc& d) { d.triangles.n1.clear(); }, "triangles' normal columns"},
    {"ShortUvs", [](SceneDesc& d) { d.triangles.t2.resize(1); }, "triangles' texture coordinate columns"},
    {"SphereColumns", [](SceneDesc& d) { d.spheres.radius.push_back(1); }, "spheres' columns"},
    {"SphereCenter", [](SceneDesc& d) { d.spheres.z[0] = nan; }, "sphere 0: z"},
    {"RadiusZero", [](SceneDesc& d) { d.spheres.radius[0] = 0; }, "sphere 0: the radius must be"},
    {"RadiusNegative", [](SceneDesc& d) { d.spheres.radius[0] = -1; }, "sphere 0: the radius must be"},
    {"RadiusNan", [](SceneDesc& d) { d.spheres.radius[0] = nan; }, "sphere 0: the radius is not"},
    {"RadiusInfinite", [](SceneDesc& d) { d.spheres.radius[0] = infinity; }, "sphere 0: the radius is not"},
    {"SphereMaterial", [](SceneDesc& d) { d.spheres.material[0] = 2; }, "sphere 0: refers to material 2"},
    {"SphereObject", [](SceneDesc& d) { d.spheres.object[0] = 9; }, "sphere 0: refers to object 9"},
};

const Fault look_faults[] = {
    {"Ambient", [](SceneDesc& d) { d.materials[1].ambient.x = nan; }, "material 1: the ambient (Ka)"},
    {"Diffuse", [](SceneDesc& d) { d.materials[0].diffuse.y = -1; }, "material 0: the diffuse (Kd)"},
    {"Specular", [](SceneDesc& d) { d.materials[0].specular.z = infinity; }, "the specular (Ks)"},
    {"Emission", [](SceneDesc& d) { d.materials[0].emission.z = nan; }, "the emission (Ke)"},
    {"Mirror", [](SceneDesc& d) { d.materials[0].mirror.z = -0.1F; }, "the mirror (Kr)"},
    {"Transmission", [](SceneDesc& d) { d.materials[0].transmission.x = nan; }, "the transmission (Kt)"},
    {"Absorption", [](SceneDesc& d) { d.materials[0].absorption.x = -1; }, "the absorption (sigma)"},
    {"ShininessLow", [](SceneDesc& d) { d.materials[0].shininess = 0.5F; }, "the shininess"},
    {"ShininessInfinite", [](SceneDesc& d) { d.materials[0].shininess = infinity; }, "the shininess"},
    {"OpacityHigh", [](SceneDesc& d) { d.materials[0].opacity = 1.01F; }, "the opacity"},
    {"OpacityNan", [](SceneDesc& d) { d.materials[0].opacity = nan; }, "the opacity"},
    {"IorZero", [](SceneDesc& d) { d.materials[0].ior = 0; }, "the index of refraction"},
    {"IorInfinite", [](SceneDesc& d) { d.materials[0].ior = infinity; }, "the index of refraction"},
    {"Name", [](SceneDesc& d) { d.materials[0].name = "a\n\x1b[31m", d.materials[0].ior = 0; },
     R"(material 0 ('a\x0a\x1b[31m'))"},
    {"LightPosition", [](SceneDesc& d) { d.lights[0].position.x = nan; }, "light 0: the position"},
    {"LightIntensity", [](SceneDesc& d) { d.lights[0].intensity.x = nan; }, "light 0: the intensity"},
    {"LightDirection", [](SceneDesc& d) { d.lights[1].direction.y = infinity; },
     "light 1: the direction must be"},
    {"LightNoDirection", [](SceneDesc& d) { d.lights[1].direction = Vec3(0); },
     "light 1: the direction must not"},
    {"LightMaterial", [](SceneDesc& d) { d.lights[0].kind = LightKind::mesh, d.lights[0].material = 99; },
     "light 0: it refers to material 99"},
    {"LightOfNoEmission", [](SceneDesc& d) { d.lights[0].kind = LightKind::mesh; }, "emits nothing (Ke)"},
    {"LightOnNoTriangle",
     [](SceneDesc& d) {
       d.lights[0].kind = LightKind::mesh;
       d.lights[0].material = static_cast<std::uint32_t>(d.materials.size());
       d.materials.emplace_back();
       d.materials.back().emission = Vec3(1.0F);
     },
     "light 0: no triangle has the material"},
    {"LightWithoutArea",
     [](SceneDesc& d) {
       d.lights[0].kind = LightKind::rectangle;
       d.lights[0].half_v = -2.0F * d.lights[0].half_u;
     },
     "light 0: the sides span no area"},
    {"AmbientLight", [](SceneDesc& d) { d.ambient = Vec3(nan, 0, 0); }, "the ambient light"},
    {"Background", [](SceneDesc& d) { d.background = Vec3(-1, 0, 0); }, "the background"},
};

std::string fault_name(const testing::TestParamInfo<Fault>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Geometry, SceneFaults, testing::ValuesIn(geometry_faults), fault_name);
INSTANTIATE_TEST_SUITE_P(Looks, SceneFaults, testing::ValuesIn(look_faults), fault_name);

TEST(Scene, OnlyTheFieldsInUseOfALightCount) {
  SceneDesc desc = small_scene();
  desc.lights[0].direction = Vec3(0.0F);
  desc.lights[1].position = Vec3(nan);
  EXPECT_EQ(error_of(desc), "");
}

TEST(Scene, ADirectionOfAnyLengthCanBeNormalised) {
  SceneDesc desc = small_scene();
  for (const float size : {1e-38F, 1e-20F, 1.0F, 1e20F, 3e38F}) {
    desc.lights[1].direction = Vec3(0.0F, -size, 0.0F);
    const Scene scene(desc);
    EXPECT_EQ(glm::normalize(scene.lights()[1].direction), Vec3(0.0F, -1.0F, 0.0F)) << size;
  }
}

// A long column, checked by several threads: the smallest bad index is named all the same.
TEST(Scene, TheFirstFaultIsNamedWhateverTheThreads) {
  SceneDesc desc;
  desc.positions.resize(300000);
  for (auto* column : {&desc.positions.x, &desc.positions.y, &desc.positions.z})
    for (float& value : *column) value = 1.0F;
  desc.positions.y[299999] = nan;
  desc.positions.y[150001] = nan;
  const int threads = omp_get_max_threads();
  for (const int n : {1, 2, 5}) {
    omp_set_num_threads(n);
    EXPECT_EQ(error_of(desc), "vertex 150001: y is not a finite number");
  }
  omp_set_num_threads(threads);
}

TEST(Scene, BoundsDoNotDependOnTheThreads) {
  constexpr std::uint32_t count = 100000;
  SceneDesc desc;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float sign = i % 2 == 0 ? 0.0F : -0.0F;
    desc.positions.push_back({static_cast<float>((i * 7919) % count), sign, -static_cast<float>(i)});
  }
  desc.positions.push_back({1e9F, 1e9F, 1e9F}); // used by no triangle
  for (std::uint32_t i = 0; i + 2 < count; ++i) {
    desc.triangles.v0.push_back(i);
    desc.triangles.v1.push_back(i + 1);
    desc.triangles.v2.push_back(i + 2);
  }
  const int threads = omp_get_max_threads();
  for (const int n : {1, 3}) {
    omp_set_num_threads(n);
    const Aabb bounds = bounds_of(desc);
    EXPECT_EQ(bounds.lower, Vec3(0.0F, 0.0F, -static_cast<float>(count - 1)));
    EXPECT_EQ(bounds.upper, Vec3(static_cast<float>(count - 1), 0.0F, 0.0F));
    EXPECT_FALSE(std::signbit(bounds.lower.y));
    EXPECT_FALSE(std::signbit(bounds.upper.y));
  }
  omp_set_num_threads(threads);
}

TEST(Scene, BoundsOfAnUncheckedDescriptionIgnoreBadIndices) {
  SceneDesc desc = small_scene();
  desc.triangles.v0[0] = 77;
  desc.spheres = {};
  const Aabb bounds = bounds_of(desc);
  EXPECT_EQ(bounds.upper, Vec3(1.0F, 2.0F, 3.0F));
}

TEST(Scene, LightsOfAnUncheckedDescriptionIgnoreBadIndices) {
  SceneDesc desc = small_scene();
  const std::uint32_t material = desc.triangles.material[0];
  desc.materials[material].emission = Vec3(2.0F);
  EXPECT_EQ(emissive_lights(desc).size(), 1U);
  desc.instances.prototype.push_back(5); // there are no prototypes
  desc.instances.to_world.push_back(Affine{});
  desc.instances.material.push_back(material);
  desc.instances.object.push_back(0);
  EXPECT_EQ(emissive_lights(desc).size(), 1U);
  for (std::size_t i = 0; i < desc.triangles.size(); ++i) desc.triangles.v2[i] = 500000000;
  EXPECT_TRUE(emissive_lights(desc).empty());
}

TEST(InputErrorText, NamesThePlaceThatIsKnown) {
  EXPECT_STREQ(InputError("a.obj", 17, 5, "bad").what(), "a.obj:17:5: bad");
  EXPECT_STREQ(InputError("a.obj", 17, 0, "bad").what(), "a.obj:17: bad");
  EXPECT_STREQ(InputError("a.obj", 0, 0, "bad").what(), "a.obj: bad");
  EXPECT_STREQ(InputError("", 0, 0, "bad").what(), "bad");
  EXPECT_STREQ(InputError("bad").what(), "bad");
  EXPECT_STREQ(InputError("\xC3\xA4\n.obj", 1, 1, "x\ty\x7F").what(), "\xC3\xA4\\x0a.obj:1:1: x\\x09y\\x7f");
}

TEST(Version, IsTheProjects) { EXPECT_STREQ(version(), "0.1.0"); }

} // namespace
} // namespace fastrt
