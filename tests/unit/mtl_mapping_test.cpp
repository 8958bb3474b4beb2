// SPDX-License-Identifier: Apache-2.0
#include "src/load/mtl.hpp"
#include "src/load/source.hpp"

#include <fastrt/diagnostics.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace fastrt {
namespace {

struct Mapped {
  std::vector<Material> materials;
  std::vector<std::string> warnings;
};

Mapped map_all(const std::string& text, bool tr_is_opacity = false) {
  EventLog log;
  const auto records = parse_mtl(text, {}, log);
  MaterialSet set;
  map_materials(records, tr_is_opacity, set, log);
  EventReport report;
  report.take(std::move(log));
  Diagnostics diagnostics;
  report.deliver(Source::memory(text, "t.mtl"), {}, false, diagnostics);
  return {set.materials, diagnostics.lines()};
}

Material map_one(const std::string& statements) {
  const Mapped mapped = map_all("newmtl a\n" + statements);
  EXPECT_TRUE(mapped.warnings.empty()) << mapped.warnings.front();
  return mapped.materials.at(0);
}

TEST(MtlMapping, DefaultsOfWhatIsNotStated) {
  const Material plain = map_one("");
  EXPECT_EQ(plain.diffuse, Vec3(0.8F));
  EXPECT_EQ(plain.ambient, Vec3(0.8F));
  EXPECT_EQ(plain.specular, Vec3(0));
  EXPECT_EQ(plain.shininess, 10);
  EXPECT_EQ(plain.opacity, 1);
  EXPECT_EQ(plain.mirror, Vec3(0));
  EXPECT_EQ(plain.fresnel, Fresnel::none);
  EXPECT_EQ(plain.specular_model, SpecularModel::blinn);
  EXPECT_FALSE(plain.thin || plain.unlit);
  EXPECT_EQ(map_one("map_Kd x.png").diffuse, Vec3(1));
  EXPECT_EQ(map_one("Kd .3 .2 .1").ambient, Vec3(0.3F, 0.2F, 0.1F));
  EXPECT_EQ(map_one("Kd .3 .2 .1\nKa 0 0 0").ambient, Vec3(0));
  EXPECT_EQ(map_one("Ke 5 6 7").emission, Vec3(5, 6, 7));
  EXPECT_EQ(default_material().diffuse, Vec3(0.8F));
}

TEST(MtlMapping, IlluminationModels) {
  const std::string base = "Kd .1\nKs .5\nNs 50\nNi 1.5\nTf .2 .4 .6\n";
  const auto with = [&base](int illum) { return map_one(base + "illum " + std::to_string(illum)); };
  EXPECT_TRUE(with(0).unlit);
  EXPECT_EQ(with(1).specular, Vec3(0));
  EXPECT_EQ(with(2).specular, Vec3(0.5F));
  for (const int illum : {1, 2, 8, 9}) {
    EXPECT_EQ(with(illum).mirror, Vec3(0)) << illum;
    EXPECT_EQ(with(illum).opacity, 1) << illum;
  }
  for (const int illum : {3, 4}) {
    EXPECT_EQ(with(illum).mirror, Vec3(0.5F)) << illum;
    EXPECT_EQ(with(illum).fresnel, Fresnel::none) << illum;
    EXPECT_EQ(with(illum).opacity, 1) << illum;
  }
  EXPECT_EQ(with(5).mirror, Vec3(0.5F));
  EXPECT_EQ(with(5).fresnel, Fresnel::schlick);

  const Material six = with(6);
  EXPECT_EQ(six.mirror, Vec3(0.5F));
  EXPECT_EQ(six.fresnel, Fresnel::none);
  EXPECT_EQ(six.opacity, 0);
  EXPECT_EQ(six.transmission, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(six.ior, 1.5F);
  EXPECT_FALSE(six.thin);

  const Material seven = with(7);
  EXPECT_EQ(seven.mirror, Vec3(1));
  EXPECT_EQ(seven.fresnel, Fresnel::dielectric);
  EXPECT_EQ(seven.opacity, 0);
  EXPECT_EQ(seven.transmission, Vec3(0.2F, 0.4F, 0.6F));
  EXPECT_FALSE(seven.thin);
}

TEST(MtlMapping, RefractionWithoutTfIsClear) {
  EXPECT_EQ(map_one("illum 7\nNi 1.5").transmission, Vec3(1));
  EXPECT_EQ(map_one("illum 6\nNi 1.5\nKs .25").transmission, Vec3(0.75F));
  EXPECT_EQ(map_one("illum 7\nNi 1.5\nd .3").opacity, 0.3F);
}

TEST(MtlMapping, DissolveLetsLightStraightThrough) {
  for (const int illum : {1, 2, 3, 4, 5, 8, 9}) {
    const Material m = map_one("Kd .1\nTf .5\nd .25\nillum " + std::to_string(illum));
    EXPECT_TRUE(m.thin) << illum;
    EXPECT_EQ(m.opacity, 0.25F) << illum;
    EXPECT_EQ(m.transmission, Vec3(illum == 4 || illum == 9 ? 0.5F : 1.0F)) << illum;
  }
}

TEST(MtlMapping, TrIsOneMinusDUnlessThatHidesEverything) {
  EXPECT_EQ(map_one("Kd .1\nTr .25").opacity, 0.75F);
  EXPECT_EQ(map_one("Kd .1\nd .5\nTr .25").opacity, 0.5F);
  EXPECT_EQ(map_all("newmtl a\nTr .25", true).materials[0].opacity, 0.25F);
  EXPECT_EQ(map_all("newmtl a\nTr 1\nnewmtl b\nTr 0").materials[0].opacity, 0);

  const Mapped hidden = map_all("newmtl a\nKd .1\nTr 1\nnewmtl b\nKd .1\nTr 1\n");
  EXPECT_EQ(hidden.materials[0].opacity, 1);
  EXPECT_EQ(hidden.materials[1].opacity, 1);
  ASSERT_EQ(hidden.warnings.size(), 1U);
  EXPECT_EQ(hidden.warnings[0].rfind("t.mtl:1:1: Tr as transparency", 0), 0U);
  // d itself is taken at its word.
  EXPECT_EQ(map_all("newmtl a\nd 0").materials[0].opacity, 0);
}

TEST(MtlMapping, OddMaterialsAreWarnedAbout) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {{"newmtl a\nKd 1\nKs 1", "t.mtl:1:1: material 'a' returns more light than it gets"},
               {"newmtl a\nillum 7\nKd 0", "t.mtl:1:1: material 'a' refracts, but its Ni is 1 or missing"},
               {"newmtl a\nillum 6\nNi 1\nKd 0", "t.mtl:1:1: material 'a' refracts"},
               {"newmtl a\nillum 10\n", "t.mtl:1:1: material 'a': illum 10"},
               {"newmtl a\nnewmtl b\nnewmtl a\nKd .1\n", "t.mtl:3:1: material 'a' is defined again"}};
  for (const auto& [text, message] : cases) {
    const Mapped mapped = map_all(text);
    ASSERT_EQ(mapped.warnings.size(), 1U) << text;
    EXPECT_EQ(mapped.warnings[0].rfind(message, 0), 0U) << mapped.warnings[0];
  }
  const Mapped twice = map_all("newmtl a\nnewmtl b\nnewmtl a\nKd .1\n");
  ASSERT_EQ(twice.materials.size(), 2U);
  EXPECT_EQ(twice.materials[0].diffuse, Vec3(0.1F));
}

// The material of one record whose maps have been read.
struct Textured {
  Material material;
  std::vector<Texture> textures;
};

Textured map_textured(const std::string& statements, bool alpha = false) {
  EventLog log;
  auto records = parse_mtl("newmtl a\n" + statements, {}, log);
  const std::vector<std::uint8_t> pixel{1, 2, 3, static_cast<std::uint8_t>(alpha ? 4 : 255)};
  const auto image = std::make_shared<const Image>(1, 1, std::span(pixel), false);
  MtlRecord& r = records.at(0);
  for (MtlMap* map : {&r.map_ka, &r.map_kd, &r.map_ks, &r.map_ke, &r.map_d, &r.bump})
    if (!map->empty() && map->name != "broken")
      map->image = image;
    else
      map->failed = !map->empty();
  MaterialSet set;
  map_materials(records, false, set, log);
  return {set.materials.at(0), set.textures};
}

TEST(MtlMapping, MapsBecomeTextures) {
  const auto [m, textures] = map_textured("map_Kd -s 2 3 -o 4 5 a\nmap_Ka -clamp on b\nmap_Ks -mm 0.5 2 "
                                          "c\nmap_Ke d\nmap_d -imfchan g e\nnorm -bm 3 f");
  EXPECT_EQ(m.diffuse, Vec3(1.0F));
  EXPECT_EQ(m.specular, Vec3(1.0F));
  EXPECT_EQ(m.emission, Vec3(1.0F));
  ASSERT_EQ(textures.size(), 6U);
  const Texture& diffuse = textures[m.diffuse_texture];
  EXPECT_EQ(diffuse.name, "a");
  EXPECT_EQ(diffuse.scale, Vec2(2, 3));
  EXPECT_EQ(diffuse.offset, Vec2(4, 5));
  EXPECT_TRUE(textures[m.ambient_texture].clamp);
  EXPECT_EQ(textures[m.specular_texture].base, 0.5F);
  EXPECT_EQ(textures[m.specular_texture].gain, 2.0F);
  EXPECT_EQ(textures[m.emission_texture].name, "d");
  EXPECT_EQ(textures[m.opacity_texture].channel, glm::vec4(0, 1, 0, 0));
  EXPECT_TRUE(m.thin);
  EXPECT_EQ(textures[m.bump_texture].name, "f");
  EXPECT_TRUE(m.bump_is_normal_map);
  EXPECT_EQ(m.bump_scale, 3.0F);
}

TEST(MtlMapping, OneColourMapIsForAmbientLightToo) {
  const Material m = map_textured("map_Kd a").material;
  EXPECT_EQ(m.ambient_texture, m.diffuse_texture);
  EXPECT_EQ(m.opacity_texture, no_texture);
  EXPECT_FALSE(m.thin);
}

TEST(MtlMapping, CutOutsTakeTheAlphaWhereThereIsOne) {
  const auto grey = map_textured("map_d a"), alpha = map_textured("map_d a", true);
  EXPECT_EQ(grey.textures[0].channel.w, 0.0F);
  EXPECT_EQ(alpha.textures[0].channel, glm::vec4(0, 0, 0, 1));
}

TEST(MtlMapping, BrokenMapsShow) {
  const auto [m, textures] = map_textured("map_Kd broken\nmap_Ks broken\nmap_d broken");
  EXPECT_EQ(textures[m.diffuse_texture].kind, TextureKind::checker);
  EXPECT_EQ(m.specular_texture, no_texture);
  EXPECT_EQ(m.opacity_texture, no_texture);
}

} // namespace
} // namespace fastrt
