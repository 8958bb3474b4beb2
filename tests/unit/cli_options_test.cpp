// SPDX-License-Identifier: Apache-2.0
#include "src/cli/option_warnings.hpp"
#include "src/cli/options.hpp"
#include "src/cli/scene_defaults.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace fastrt::cli {
namespace {

Options parse(std::vector<const char*> words) {
  words.insert(words.begin(), "fastrt");
  return parse_options(static_cast<int>(words.size()), words.data());
}

TEST(CliOptions, DefaultsOfASceneAlone) {
  const Options options = parse({"a.obj"});
  EXPECT_EQ(options.scene, "a.obj");
  EXPECT_EQ(options.output, "");
  EXPECT_EQ(options.width, 1024);
  EXPECT_EQ(options.height, 768);
  EXPECT_EQ(options.samples_per_pixel, 1);
  EXPECT_EQ(options.stats, StatsFormat::none);
  EXPECT_FALSE(options.eye.has_value());
  EXPECT_FALSE(options.isa.has_value());
  EXPECT_FALSE(options.answer.has_value());
  EXPECT_TRUE(options.show_progress);
}

TEST(CliOptions, Photons) {
  const Options forward = parse({"a.obj", "--integrator", "forward", "--photons", "1073741824", "-s", "4"});
  EXPECT_EQ(forward.integrator, Integrator::forward);
  EXPECT_EQ(forward.photons, std::int64_t{1} << 30);
  EXPECT_EQ(forward.warnings.size(), 1U); // of --spp
  const Options caustics = parse({"--caustics", "a.obj", "--caustic-radius", "0.5"});
  EXPECT_EQ(caustics.scene, "a.obj");
  EXPECT_EQ(caustics.integrator, Integrator::whitted);
  EXPECT_EQ(caustics.caustic_photons, 200000);
  EXPECT_EQ(caustics.caustic_radius, 0.5F);
  EXPECT_EQ(parse({"a.obj", "--caustics=17"}).caustic_photons, 17);
  EXPECT_EQ(parse({"a.obj"}).caustic_photons, 0);
  EXPECT_EQ(parse({"a.obj", "--photons", "5", "--caustic-radius", "1"}).warnings.size(), 2U);
}

TEST(CliOptions, EveryValue) {
  const Options options = parse({"-o",
                                 "b.png",
                                 "-r",
                                 "64x32",
                                 "-s",
                                 "4",
                                 "--filter",
                                 "box",
                                 "--seed=4294967295",
                                 "--max-depth",
                                 "0",
                                 "--min-contribution",
                                 "0.25",
                                 "--eye",
                                 "-1,2,3",
                                 "--look-at=0,0,-1",
                                 "--up",
                                 "0,0,1",
                                 "--fov",
                                 "60",
                                 "--ambient",
                                 "0.1,0.2,0.3",
                                 "--background",
                                 "1,1,1",
                                 "-t",
                                 "3",
                                 "--isa",
                                 "scalar",
                                 "--max-image-mb",
                                 "9",
                                 "a.obj"});
  EXPECT_EQ(options.output, "b.png");
  EXPECT_EQ(options.width, 64);
  EXPECT_EQ(options.height, 32);
  EXPECT_EQ(options.samples_per_pixel, 4);
  EXPECT_EQ(options.filter, PixelFilter::box);
  EXPECT_EQ(options.seed, 4294967295U);
  EXPECT_EQ(options.max_depth, 0);
  EXPECT_EQ(options.min_contribution, 0.25F);
  EXPECT_EQ(options.eye, Vec3(-1, 2, 3));
  EXPECT_EQ(options.look_at, Vec3(0, 0, -1));
  EXPECT_EQ(options.up, Vec3(0, 0, 1));
  EXPECT_EQ(options.fov_degrees, 60.0F);
  EXPECT_EQ(options.ambient, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(options.background, Vec3(1));
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.isa, "scalar");
  EXPECT_EQ(options.max_image_mb, 9);
  EXPECT_EQ(options.scene, "a.obj");
}

TEST(CliOptions, EveryFlag) {
  const Options options = parse(
      {"--verify", "--strict", "--allow-external-files", "--tr-is-opacity", "-q", "--no-progress", "a.obj"});
  EXPECT_TRUE(options.verify);
  EXPECT_TRUE(options.strict);
  EXPECT_TRUE(options.allow_external_files);
  EXPECT_TRUE(options.tr_is_opacity);
  EXPECT_TRUE(options.quiet);
  EXPECT_FALSE(options.show_progress);
}

TEST(CliOptions, StatsTakesItsValueOnlyAfterEquals) {
  EXPECT_EQ(parse({"--stats", "a.obj"}).stats, StatsFormat::text);
  EXPECT_EQ(parse({"--stats=text", "a.obj"}).stats, StatsFormat::text);
  EXPECT_EQ(parse({"a.obj", "--stats=json"}).stats, StatsFormat::json);
  EXPECT_THROW(parse({"--stats=xml", "a.obj"}), UsageError);
}

TEST(CliOptions, SignatureTakesItsValueOnlyAfterEquals) {
  EXPECT_FALSE(parse({"a.obj"}).signature.has_value());
  EXPECT_EQ(parse({"--signature", "a.obj"}).signature, "");
  EXPECT_EQ(parse({"--signature=b.png", "a.obj"}).signature, "b.png");
}

TEST(CliOptions, QualityOfTheTree) {
  EXPECT_EQ(parse({"a.obj"}).bvh_quality, BvhQuality::standard);
  EXPECT_EQ(parse({"a.obj", "--bvh-quality", "standard"}).bvh_quality, BvhQuality::standard);
  EXPECT_EQ(parse({"--bvh-quality=high", "a.obj"}).bvh_quality, BvhQuality::high);
}

TEST(CliOptions, Views) {
  const Options options = parse({"--crop", "1,2,30,40", "--window", "-1,2,-3,4", "--focal", "2.5",
                                 "--aperture", "0.1", "--focus=7", "-s", "4", "--filter", "mitchell",
                                 "--adaptive", "0.05", "--max-spp", "32", "a.obj"});
  ASSERT_TRUE(options.crop.has_value());
  EXPECT_EQ(options.crop->x1, 30);
  EXPECT_EQ(options.crop->y1, 40);
  ASSERT_TRUE(options.window.has_value());
  EXPECT_EQ(options.window->left, -1.0F);
  EXPECT_EQ(options.window->top, 4.0F);
  EXPECT_EQ(options.focal_distance, 2.5F);
  EXPECT_EQ(options.aperture_radius, 0.1F);
  EXPECT_EQ(options.focus_distance, 7.0F);
  EXPECT_EQ(options.filter, PixelFilter::mitchell);
  EXPECT_EQ(options.adaptive, 0.05F);
  EXPECT_EQ(options.most_samples, 32);
  EXPECT_TRUE(options.warnings.empty());
  EXPECT_FALSE(options.orthographic);
  EXPECT_TRUE(parse({"--ortho", "auto", "a.obj"}).orthographic);
  EXPECT_FALSE(parse({"--ortho", "auto", "a.obj"}).view_height.has_value());
  EXPECT_EQ(parse({"--ortho=3", "a.obj"}).view_height, 3.0F);
}

TEST(CliOptions, WhatDoesNothingIsAWarning) {
  EXPECT_EQ(sampling_warnings(parse({"--aperture", "0.1", "a.obj"})).size(), 1U);
  EXPECT_EQ(sampling_warnings(parse({"--max-spp", "9", "a.obj"})).size(), 1U);
  EXPECT_TRUE(sampling_warnings(parse({"--max-spp", "9", "--adaptive", "0.1", "a.obj"})).empty());
}

TEST(CliOptions, WhatSaysNothingOfTheCameraIsAWarning) {
  SceneDesc desc;
  const auto warnings = [&](std::initializer_list<const char*> arguments) {
    const Options options = parse(arguments);
    return camera_warnings(options, choose_camera(options, Aabb{}, desc));
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings({"a.obj", "--ortho", "1", "--fov", "20"}), Lines{"--fov says nothing beside --ortho"});
  EXPECT_EQ(warnings({"a.obj", "--window=-1,1,-1,1", "--fov", "30"}),
            Lines{"--fov says nothing beside --window"});
  EXPECT_EQ(warnings({"a.obj", "--window=-1,1,-1,1", "--ortho", "3"}),
            Lines{"--ortho: a height says nothing beside --window"});
  EXPECT_EQ(warnings({"a.obj", "--focal", "2"}), Lines{"--focal says nothing without --window"});
  EXPECT_EQ(warnings({"a.obj", "--window=-1,1,-1,1", "--ortho", "auto", "--focal", "2"}),
            Lines{"--focal says nothing of parallel rays"});
  EXPECT_EQ(warnings({"a.obj", "--focus", "3"}), Lines{"--focus says nothing without --aperture"});
  EXPECT_EQ(warnings({"a.obj", "--focus", "3", "--aperture", "0"}).size(), 1U);
  EXPECT_TRUE(warnings({"a.obj", "--fov", "20"}).empty());
  EXPECT_TRUE(warnings({"a.obj", "--ortho", "3"}).empty());
  EXPECT_TRUE(warnings({"a.obj", "--window=-1,1,-1,1", "--ortho", "auto"}).empty());
  EXPECT_TRUE(warnings({"a.obj", "--window=-1,1,-1,1", "--focal", "2"}).empty());
  EXPECT_TRUE(warnings({"a.obj", "--focus", "3", "--aperture", "0.1"}).empty());
  // Of the scene's window and lens they say something.
  desc.camera = Camera{};
  desc.camera->window = Window{};
  desc.camera->aperture_radius = 0.5F;
  EXPECT_TRUE(warnings({"a.toml", "--focal", "2", "--focus", "3"}).empty());
  EXPECT_TRUE(warnings({"a.toml", "--fov", "20"}).empty());
  EXPECT_EQ(warnings({"a.toml", "--fov", "20", "--focal", "2"}).size(), 1U);
}

TEST(CliOptions, FovSaysNothingBesideAWindow) {
  const Aabb bounds{Vec3(-1), Vec3(1)};
  const auto eye = [&](std::initializer_list<const char*> arguments) {
    return choose_camera(parse(arguments), bounds, SceneDesc{}).eye;
  };
  EXPECT_NE(eye({"a.obj", "--fov", "20"}), eye({"a.obj"}));
  EXPECT_EQ(eye({"a.obj", "--fov", "20", "--window=-1,1,-1,1"}), eye({"a.obj"}));
  EXPECT_EQ(eye({"a.obj", "--fov", "20", "--ortho", "3"}), eye({"a.obj"}));
}

TEST(CliOptions, TheScenesValuesCountWhereNoneAreGiven) {
  SceneDesc desc;
  desc.width = 30, desc.height = 20;
  desc.picture.samples_per_pixel = 4;
  desc.picture.most_samples = 8;
  desc.picture.adaptive = 0.5F;
  desc.picture.seed = 3;
  Options scene = parse({"a.toml"});
  take_picture_settings(desc, scene);
  EXPECT_EQ(scene.width, 30);
  EXPECT_EQ(scene.samples_per_pixel, 4);
  EXPECT_EQ(scene.most_samples, 8);
  EXPECT_EQ(scene.adaptive, 0.5F);
  EXPECT_EQ(scene.seed, 3U);
  EXPECT_EQ(scene.max_depth, 8);
  Options own = parse({"a.toml", "-r", "64x32", "-s", "16", "--adaptive", "0", "--seed=0"});
  take_picture_settings(desc, own);
  EXPECT_EQ(own.width, 64);
  EXPECT_EQ(own.samples_per_pixel, 16);
  EXPECT_EQ(own.most_samples, 0); // fewer than 16 make no sense
  EXPECT_EQ(own.adaptive, 0);
  EXPECT_EQ(own.seed, 0U);
}

TEST(CliOptions, WhatTheScenesCameraLeavesOpenFollowsThePicture) {
  const Aabb bounds{Vec3(-4, -1, -1), Vec3(4, 1, 1)};
  SceneDesc desc;
  desc.camera = Camera{};
  desc.camera->fov_degrees = 60;
  desc.camera_place_is_chosen = true;
  const auto camera = [&](std::initializer_list<const char*> arguments) {
    return choose_camera(parse(arguments), bounds, desc);
  };
  EXPECT_EQ(camera({"a.toml", "-r", "40x160"}).eye, frame_scene(bounds, 60, 0.25F).eye);
  EXPECT_EQ(camera({"a.toml", "-r", "160x40", "--fov", "20"}).eye, frame_scene(bounds, 20, 4).eye);
  EXPECT_EQ(camera({"a.toml", "-r", "160x40", "--up", "0,0,1"}).eye,
            frame_scene(bounds, 60, 4, {0, 0, 1}).eye);
  EXPECT_EQ(camera({"a.toml", "--eye", "9,9,9"}).eye, Vec3(9));
  desc.camera->projection = Projection::orthographic;
  desc.camera_height_is_chosen = true;
  const Camera tall = camera({"a.toml", "-r", "40x160"});
  EXPECT_EQ(tall.view_height, orthographic_height(bounds, tall, 0.25F));
  EXPECT_EQ(camera({"a.toml", "-r", "40x160", "--ortho", "3"}).view_height, 3);
}

TEST(CliOptions, TheScenesCameraIsChangedByOptions) {
  SceneDesc desc;
  desc.camera = Camera{};
  desc.camera->window = Window{};
  desc.camera->aperture_radius = 0.5F;
  const auto camera = [&](std::initializer_list<const char*> arguments) {
    return choose_camera(parse(arguments), Aabb{}, desc);
  };
  EXPECT_TRUE(camera({"a.toml"}).window);
  EXPECT_EQ(camera({"a.toml"}).aperture_radius, 0.5F);
  EXPECT_EQ(camera({"a.toml", "--aperture", "0"}).aperture_radius, 0);
  EXPECT_FALSE(camera({"a.toml", "--fov", "20"}).window);
  EXPECT_EQ(camera({"a.toml", "--ortho", "3"}).view_height, 3);
  EXPECT_EQ(camera({"a.toml", "--ortho", "3"}).aperture_radius, 0);
  desc.camera->aperture_radius = 0;
  desc.camera->projection = Projection::orthographic;
  EXPECT_EQ(camera({"a.toml"}).projection, Projection::orthographic);
  EXPECT_EQ(camera({"a.toml", "--fov", "20"}).projection, Projection::perspective);
}

TEST(CliOptions, AovsAreNamesOrAll) {
  EXPECT_TRUE(parse({"a.obj"}).aovs.empty());
  EXPECT_EQ(parse({"--aov", "uv,depth-of-recursion,uv", "a.obj"}).aovs,
            (std::vector<Aov>{Aov::uv, Aov::recursion}));
  EXPECT_EQ(parse({"--aov=all", "a.obj"}).aovs.size(), aov_count);
  EXPECT_EQ(parse({"--aov=all,id", "a.obj"}).aovs, parse({"--aov=all", "a.obj"}).aovs);
  EXPECT_EQ(parse({"--aov=id,all", "a.obj"}).aovs.size(), aov_count);
}

TEST(CliOptions, LightsAddUpAndDoNotSwallowTheScene) {
  const Options options = parse({"--light", "point:1,2,3", "--light", "dir:0,-1,0", "a.obj"});
  ASSERT_EQ(options.lights.size(), 2U);
  EXPECT_EQ(options.lights[0].light.kind, LightKind::point);
  EXPECT_EQ(options.lights[1].light.kind, LightKind::directional);
  EXPECT_EQ(options.scene, "a.obj");
}

TEST(CliOptions, TheLastOfSeveralWins) {
  EXPECT_EQ(parse({"-s", "2", "a.obj", "--spp", "3"}).samples_per_pixel, 3);
}

TEST(CliOptions, SceneNamesWithADash) {
  EXPECT_EQ(parse({"--", "-x.obj"}).scene, "-x.obj");
  EXPECT_EQ(parse({"-s", "2", "--", "--spp"}).scene, "--spp");
}

TEST(CliOptions, AbsurdDepthIsCutWithAWarning) {
  const Options options = parse({"--max-depth", "1000000000", "a.obj"});
  EXPECT_EQ(options.max_depth, 64);
  EXPECT_EQ(options.warnings.size(), 1U);
  EXPECT_TRUE(parse({"--max-depth", "64", "a.obj"}).warnings.empty());
}

TEST(CliOptions, UsageErrors) {
  const std::vector<std::vector<const char*>> bad = {
      {},
      {"a.obj", "b.obj"},
      {"a.obj", "--bogus"},
      {"a.obj", "-z"},
      {"a.obj", "--spp"},
      {"a.obj", "--spp", "0"},
      {"a.obj", "--spp", "-1"},
      {"a.obj", "--spp", "1000000000"},
      {"a.obj", "--spp", "1.5"},
      {"a.obj", "-r", "0x9"},
      {"a.obj", "-o", ""},
      {"a.obj", "-t", "0"},
      {"a.obj", "--filter", "cone"},
      {"a.obj", "--bvh-quality", "best"},
      {"a.obj", "--seed", "-1"},
      {"a.obj", "--seed", "4294967296"},
      {"a.obj", "--max-depth", "-1"},
      {"a.obj", "--min-contribution", "1.5"},
      {"a.obj", "--min-contribution", "nan"},
      {"a.obj", "--fov", "0"},
      {"a.obj", "--fov", "180"},
      {"a.obj", "--fov", "nan"},
      {"a.obj", "--light", "lamp"},
      {"a.obj", "--max-image-mb", "0"},
      {"a.obj", "--verify=perhaps"},
      {"a.obj", "--aov", "colour"},
      {"a.obj", "--aov", "id,,depth"},
      {"a.obj", "--aov", ""},
      {"a.obj", "--crop", "0,0,1"},
      {"a.obj", "--crop", "0,0,0,5"},
      {"a.obj", "--crop", "5,0,4,5"},
      {"a.obj", "--crop", "-1,0,4,5"},
      {"a.obj", "--crop", "0,0,1025,5", "-r", "1024x768"},
      {"a.obj", "--window", "1,1,0,1"},
      {"a.obj", "--window", "0,1,0"},
      {"a.obj", "--focal", "0"},
      {"a.obj", "--ortho", "0"},
      {"a.obj", "--ortho", "all"},
      {"a.obj", "--aperture", "-1"},
      {"a.obj", "--aperture", "1", "--ortho", "auto"},
      {"a.obj", "--focus", "nan"},
      {"a.obj", "--adaptive", "2"},
      {"a.obj", "--max-spp", "0"},
      {"a.obj", "-s", "4", "--adaptive", "0.1", "--max-spp", "3"},
  };
  for (const auto& words : bad) {
    EXPECT_THROW(parse(words), UsageError) << (words.empty() ? "" : words.back());
  }
}

std::string error_of(const std::vector<const char*>& words) {
  try {
    parse(words);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(CliOptions, UnknownOptionsAreNamedAlone) {
  constexpr const char* spp = "unknown option '--sppp'; did you mean '--spp'?";
  EXPECT_EQ(error_of({"a.obj", "--sppp", "4"}), spp);
  EXPECT_EQ(error_of({"--sppp", "4", "a.obj"}), spp);
  EXPECT_EQ(error_of({"--sppp=4", "a.obj"}), spp);
  EXPECT_EQ(error_of({"--sppp"}), spp);
  EXPECT_EQ(error_of({"a.obj", "--signatur"}), "unknown option '--signatur'; did you mean '--signature'?");
  EXPECT_EQ(error_of({"a.obj", "--verfy"}), "unknown option '--verfy'; did you mean '--verify'?");
  EXPECT_EQ(error_of({"a.obj", "--something-else"}), "unknown option '--something-else'");
  EXPECT_EQ(error_of({"a.obj", "-z"}), "unknown option '-z'");
  EXPECT_EQ(error_of({"a.obj", "b.obj"}), "one scene at a time: 'b.obj' is one too many");
  EXPECT_EQ(error_of({"--", "a.obj", "--spp"}), "one scene at a time: '--spp' is one too many");
}

TEST(CliOptions, HelpAndVersionNeedNoScene) {
  const Options help = parse({"--help"});
  ASSERT_TRUE(help.answer.has_value());
  for (const char* part :
       {"Image:", "Sampling", "Camera", "Engine:", "Examples:", "--spp", "--light", "Exit codes",
        "rect:X,Y,Z:UX,UY,UZ:VX,VY,VZ ", "mesh:MATERIAL[:SCALE]", "[:shadows=off]"}) {
    EXPECT_NE(help.answer->find(part), std::string::npos) << part;
  }
  const Options version = parse({"--version"});
  ASSERT_TRUE(version.answer.has_value());
  EXPECT_EQ(version.answer->rfind("fastrt 0.", 0), 0U);
  EXPECT_NE(version.answer->find("scalar"), std::string::npos);
}

} // namespace
} // namespace fastrt::cli
