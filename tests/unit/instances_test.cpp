// SPDX-License-Identifier: Apache-2.0
// Prototypes and instances: the builder, the checks, bounds, ids, and what a tracer says of them.
#include "src/scene/shapes.hpp"
#include "tests/unit/instance_scenes.hpp"

#include <fastrt/error.hpp>
#include <fastrt/load.hpp>
#include <fastrt/tracer.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace fastrt::test {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();

std::string message_of(const SceneDesc& desc) {
  try {
    const Scene scene{SceneDesc(desc)};
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

// A sphere of radius 1 as prototype 0, nothing as prototype 1, one instance of the first at x = 5.
SceneDesc one_sphere() {
  SceneDesc desc;
  desc.materials.resize(2);
  desc.object_names = {"ball", "copy"};
  desc.spheres = {{0}, {0}, {0}, {1}, {0}, {0}};
  desc.prototypes = {Prototype{{0, 0, 0, 0, 0}, {0, 1, 0, 0, 0}}, Prototype{}};
  desc.instances.prototype.push_back(0);
  desc.instances.to_world.push_back(scaled(Vec3(2.0F), {5, 0, 0}));
  desc.instances.material.push_back(1);
  desc.instances.object.push_back(1);
  return desc;
}

struct Found {
  float t = 0, u = 0, v = 0;
  std::int32_t primitive = 7, instance = 7;
};
Found look(const Tracer& tracer, const Vec3& from, const Vec3& direction) {
  RayArrays rays{&from.x, &from.y, &from.z, &direction.x, &direction.y, &direction.z};
  rays.count = 1;
  Found found;
  tracer.closest_hit(rays, {&found.t, &found.u, &found.v, &found.primitive, &found.instance});
  return found;
}

std::vector<Tracer> every_tracer(const Scene& scene) {
  std::vector<Tracer> tracers;
  for (const Isa isa : available_isas()) {
    TracerSettings settings;
    settings.isa = isa;
    settings.threads = 1;
    tracers.emplace_back(Scene(scene), settings);
  }
  return tracers;
}

TEST(Instances, AreWhereTheirMapPutsThem) {
  const Scene scene(one_sphere());
  EXPECT_EQ(scene.instance_count(), 1U);
  EXPECT_EQ(scene.primitive_count(), 1U);
  for (const Tracer& tracer : every_tracer(scene)) {
    const Found front = look(tracer, {5, 0, 10}, {0, 0, -1});
    EXPECT_FLOAT_EQ(front.t, 8);
    EXPECT_EQ(front.primitive, 0);
    EXPECT_EQ(front.instance, 0);
    const Found prototype = look(tracer, {0, 0, 10}, {0, 0, -1});
    EXPECT_EQ(prototype.primitive, no_primitive);
    EXPECT_EQ(prototype.instance, no_instance);
    EXPECT_EQ(prototype.t, inf);
  }
}

TEST(Instances, GiveWhatTheyShowTheirMaterialAndObject) {
  SceneDesc desc = one_sphere();
  desc.instances.prototype.push_back(0);
  desc.instances.to_world.push_back({});
  desc.instances.material.push_back(no_index);
  desc.instances.object.push_back(no_index);
  const Scene scene(std::move(desc));
  EXPECT_EQ(scene.material_of(0, 0), 1U);
  EXPECT_EQ(scene.object_of(0, 0), 1U);
  EXPECT_EQ(scene.material_of(0, 1), 0U);
  EXPECT_EQ(scene.object_of(0, 1), 0U);
  EXPECT_EQ(scene.material_of(0), 0U);
}

TEST(Instances, WorldPrimitivesComeFirstAtEqualDistance) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  builder.begin_prototype();
  builder.add_sphere({0, 0, 0}, 1, material);
  const std::uint32_t ball = builder.end_prototype();
  builder.add_instance(ball, {});
  builder.add_instance(ball, {});
  const Scene copies = Scene(SceneBuilder(builder).build());
  builder.add_sphere({0, 0, 0}, 1, material);
  const Scene with_one_more = builder.build();
  for (const Tracer& tracer : every_tracer(copies))
    EXPECT_EQ(look(tracer, {0, 0, 5}, {0, 0, -1}).instance, 0);
  for (const Tracer& tracer : every_tracer(with_one_more)) {
    EXPECT_EQ(look(tracer, {0, 0, 5}, {0, 0, -1}).instance, no_instance);
    EXPECT_EQ(look(tracer, {0, 0, 5}, {0, 0, -1}).primitive, 1);
  }
}

TEST(Instances, BoundsAreThoseOfWhatIsSeen) {
  const SceneDesc desc = one_sphere();
  const Aabb bounds = bounds_of(desc);
  for (int axis = 0; axis < 3; ++axis) {
    const float middle = axis == 0 ? 5.0F : 0.0F;
    EXPECT_NEAR(bounds.lower[axis], middle - 2, 1e-4);
    EXPECT_NEAR(bounds.upper[axis], middle + 2, 1e-4);
    EXPECT_LE(bounds.lower[axis], middle - 2);
    EXPECT_GE(bounds.upper[axis], middle + 2);
  }
  const Scene scene{SceneDesc(desc)};
  EXPECT_EQ(scene.bounds().lower, bounds.lower);
  SceneDesc hidden = desc;
  hidden.instances = {};
  EXPECT_TRUE(bounds_of(hidden).empty());
}

TEST(Instances, OfNothingShowNothing) {
  SceneDesc desc = one_sphere();
  desc.instances.prototype[0] = 1;
  const Scene scene(std::move(desc));
  EXPECT_TRUE(scene.bounds().empty());
  for (const Tracer& tracer : every_tracer(scene))
    EXPECT_EQ(look(tracer, {5, 0, 10}, {0, 0, -1}).primitive, no_primitive);
}

TEST(Instances, BoundsOfAnUncheckedSceneDoNoHarm) {
  SceneDesc desc = one_sphere();
  desc.instances.prototype[0] = 9;
  desc.prototypes.push_back(Prototype{{5, 7, 3, 1, 2}, {9, 99, 1, 8, 77}});
  desc.polygons.contour_end = {7, 3};
  EXPECT_TRUE(bounds_of(desc).empty());
}

TEST(InstanceChecks, NameWhatIsWrong) {
  EXPECT_EQ(message_of(one_sphere()), "none");
  SceneDesc desc = one_sphere();
  desc.prototypes[1] = Prototype{{0, 1, 0, 0, 0}, {0, 2, 0, 0, 0}};
  EXPECT_EQ(message_of(desc), "prototype 1: has the spheres from 1 to 2, but there are 1");
  desc.prototypes[1] = Prototype{{0, 1, 0, 0, 0}, {0, 0, 0, 0, 0}};
  EXPECT_EQ(message_of(desc), "prototype 1: has the spheres from 1 to 0, but there are 1");
  desc.prototypes[1] = desc.prototypes[0];
  EXPECT_EQ(message_of(desc), "prototype 1: shares spheres with prototype 0");
  desc = one_sphere();
  desc.instances.prototype[0] = 2;
  EXPECT_EQ(message_of(desc), "instance 0: refers to prototype 2, but there are 2");
  desc = one_sphere();
  desc.instances.material[0] = 2;
  EXPECT_EQ(message_of(desc), "instance 0: refers to material 2, but there are 2");
  desc = one_sphere();
  desc.instances.object[0] = 5;
  EXPECT_EQ(message_of(desc), "instance 0: refers to object 5, but there are 2");
  desc = one_sphere();
  desc.instances.object.clear();
  EXPECT_EQ(message_of(desc), "the instances' columns differ in length");
}

TEST(InstanceChecks, RefuseMapsWithoutInverse) {
  const auto message = [](const Affine& map) {
    SceneDesc desc = one_sphere();
    desc.instances.to_world[0] = map;
    return message_of(desc);
  };
  EXPECT_EQ(message({{inf, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}}),
            "instance 0: a number of its map is not finite");
  EXPECT_EQ(message({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Vec3(std::nanf(""))}),
            "instance 0: a number of its map is not finite");
  const std::string flat = "instance 0: its map can't be inverted: it makes things flat";
  EXPECT_EQ(message(scaled({1, 0, 1})), flat);
  EXPECT_EQ(message({{1, 2, 3}, {2, 4, 6}, {0, 0, 1}, {}}), flat);
  EXPECT_EQ(message(scaled({1, 1e-9F, 1})), flat);
  EXPECT_EQ(message(scaled(Vec3(1e-40F))), flat);
  EXPECT_EQ(message(scaled(Vec3(1e-6F))), "none");
  EXPECT_EQ(message(scaled({-1, 1e3F, 1})), "none");
}

TEST(InstanceBuilder, PutsPrototypesAsideAndShowsThem) {
  SceneBuilder builder;
  const std::uint32_t material = builder.add_material({});
  builder.add_sphere({0, 0, 0}, 1, material, "first");
  builder.begin_prototype();
  builder.add_sphere({1, 0, 0}, 1, material, "inside");
  builder.add_disk({0, 0, 0}, {0, 0, 1}, 1, material, "plate");
  const std::uint32_t prototype = builder.end_prototype();
  builder.add_sphere({2, 0, 0}, 1, material, "second");
  EXPECT_EQ(builder.add_instance(prototype, scaled({1, 2, 3}), no_index, "copy"), 4U);
  const Scene scene = builder.build();
  EXPECT_EQ(scene.desc().object_names[scene.object_of(1, 0)], "copy");
  const KindRanges& world = scene.shapes().world;
  ASSERT_EQ(world[1].size(), 2U);
  EXPECT_EQ(world[1][1].begin, 2U);
  EXPECT_TRUE(world[3].empty());
  SceneDesc fewer = scene.desc();
  fewer.instances = {};
  EXPECT_GT(scene.bytes(), Scene(std::move(fewer)).bytes());
}

TEST(InstanceBuilder, RefusesWhatPrototypesCannotHold) {
  SceneBuilder builder;
  EXPECT_THROW(builder.end_prototype(), InputError);
  builder.begin_prototype();
  EXPECT_THROW(builder.begin_prototype(), InputError);
  EXPECT_THROW(builder.add_plane({0, 0, 0}, {0, 1, 0}, 0), InputError);
  EXPECT_THROW(builder.add_instance(0, {}), InputError);
  EXPECT_THROW(builder.build(), InputError);
  EXPECT_EQ(builder.end_prototype(), 0U);
  builder.add_instance(0, {});
  EXPECT_EQ(builder.build().instance_count(), 1U);
}

// The trees of the prototypes count, but not once more for each instance.
TEST(InstanceTrees, AreSharedByAllInstances) {
  const auto stats = [](int count) {
    SceneBuilder builder;
    const std::uint32_t material = builder.add_material({});
    builder.begin_prototype();
    add(builder, icosphere(3), material);
    const std::uint32_t ball = builder.end_prototype();
    for (int i = 0; i < count; ++i)
      builder.add_instance(ball, scaled(Vec3(0.4F), {static_cast<float>(i), 0, 0}));
    return Tracer(builder.build()).bvh_stats();
  };
  const BvhStats one = stats(1), many = stats(101);
  EXPECT_GT(one.block_count, 320U);
  EXPECT_LT(many.bytes - one.bytes, 100U * 400U);
  EXPECT_GT(many.bytes - one.bytes, 100U * 140U);
  EXPECT_GT(one.depth, 3);
  EXPECT_GT(one.sah_cost, 5);
  EXPECT_GT(many.leaf_count, one.leaf_count);
}

} // namespace
} // namespace fastrt::test
