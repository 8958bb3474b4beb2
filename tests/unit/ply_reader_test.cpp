// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_reader.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace fastrt {
namespace {

struct Read {
  SceneDesc desc;
  std::vector<std::string> warnings;
};

Read read(const std::string& text, bool strict = false) {
  PlyReaderSettings settings;
  settings.strict = strict;
  settings.object_name = "mesh";
  Diagnostics diagnostics;
  Read result;
  result.desc = read_ply(Source::memory(text, "t.ply"), settings, diagnostics);
  result.warnings = diagnostics.lines();
  return result;
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

const std::string plain_header = "ply\nformat ascii 1.0\ncomment any\nelement vertex 4\nproperty float x\n"
                                 "property float y\nproperty float z\nelement face 1\n"
                                 "property list uchar int vertex_indices\nend_header\n";
const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

// Numbers as bytes, first to last or turned round.
class Bytes {
public:
  explicit Bytes(bool big_endian) : big_endian_(big_endian) {}
  template <class T>
  Bytes& add(T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big_endian_) std::reverse(bytes, bytes + sizeof value);
    text_.append(bytes, sizeof value);
    return *this;
  }
  const std::string& text() const { return text_; }

private:
  bool big_endian_;
  std::string text_;
};

TEST(PlyReader, TextWithAPolygon) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : plain_header + square + "4 0 1 2 3")
      if (c == '\n')
        text += end;
      else
        text += c;
    const Read found = read(text);
    EXPECT_TRUE(found.warnings.empty());
    ASSERT_EQ(found.desc.positions.size(), 4U);
    EXPECT_EQ(found.desc.positions[2], Vec3(1, 1, 0));
    ASSERT_EQ(found.desc.triangles.size(), 2U);
    EXPECT_EQ(found.desc.triangles.v2[1], 3U);
    EXPECT_EQ(found.desc.object_names, std::vector<std::string>{"mesh"});
    EXPECT_NO_THROW(Scene(found.desc));
  }
}

TEST(PlyReader, AByteOrderMarkIsPassedOver) {
  const Read found = read("\xEF\xBB\xBF" + plain_header + square + "4 0 1 2 3");
  EXPECT_EQ(found.desc.triangles.size(), 2U);
  EXPECT_TRUE(found.warnings.empty());
}

// The same file in all three formats, with normals, colours, coordinates and things to skip.
TEST(PlyReader, BinaryOfBothEndiansEqualsText) {
  const std::string rest =
      "element vertex 3\nproperty double x\nproperty float y\nproperty float z\nproperty short w\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty uchar alpha\nproperty float s\nproperty float t\n"
      "element odd 2\nproperty list ushort double numbers\nproperty char c\n"
      "element face 1\nproperty uchar flag\nproperty list int uint vertex_index\nend_header\n";
  const float values[3][3] = {{0, 0, 0}, {1.5F, 0, 0.25F}, {0, 2, -1}};
  std::string texts[3];
  texts[0] = "ply\nformat ascii 1.0\n" + rest;
  for (const auto& v : values)
    texts[0] += std::to_string(v[0]) + ' ' + std::to_string(v[1]) + ' ' + std::to_string(v[2]) +
                " -7 0 0 1 255 0 128 9 0.5 0.75\n";
  texts[0] += "2 1 2.5 -1\n0 3\n7 3 0 1 2\n";
  for (const bool big : {false, true}) {
    Bytes bytes(big);
    for (const auto& v : values) {
      bytes.add(static_cast<double>(v[0])).add(v[1]).add(v[2]).add(std::int16_t{-7});
      bytes.add(0.0F).add(0.0F).add(1.0F);
      for (const int code : {255, 0, 128, 9}) bytes.add(static_cast<std::uint8_t>(code));
      bytes.add(0.5F).add(0.75F);
    }
    bytes.add(std::uint16_t{2}).add(1.0).add(2.5).add(std::int8_t{-1});
    bytes.add(std::uint16_t{0}).add(std::int8_t{3});
    bytes.add(std::uint8_t{7}).add(std::int32_t{3}).add(0U).add(1U).add(2U);
    texts[big ? 2 : 1] =
        std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + rest + bytes.text();
  }
  for (const std::string& text : texts) {
    const SceneDesc desc = read(text).desc;
    ASSERT_EQ(desc.positions.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(desc.positions[i], Vec3(values[i][0], values[i][1], values[i][2]));
    EXPECT_EQ(desc.normals[1], Vec3(0, 0, 1));
    EXPECT_EQ(desc.uvs.y[2], 0.75F);
    EXPECT_EQ(desc.colors[0].x, 1.0F);
    EXPECT_EQ(desc.colors[0].y, 0.0F);
    EXPECT_NEAR(desc.colors[0].z, 0.2158605, 1e-6);
    EXPECT_TRUE(desc.materials.at(0).vertex_colors);
    ASSERT_EQ(desc.triangles.size(), 1U);
    EXPECT_EQ(desc.triangles.n0[0], 0U);
    EXPECT_EQ(desc.triangles.t2[0], 2U);
    EXPECT_NO_THROW(Scene(SceneDesc(desc)));
  }
}

// Codes are decoded once, whatever names they go by.
TEST(PlyReader, TheLastOfSeveralNamesCounts) {
  std::string header = plain_header;
  header.insert(header.find("element face"), "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                             "property float r\nproperty uchar diffuse_green\n");
  const Read found =
      read(header + "0 0 0 9 9 255 0.25 128\n1 0 0 9 9 9 0 0\n1 1 0 9 9 9 0 0\n0 1 0 9 9 9 0 0\n"
                    "4 0 1 2 3\n");
  ASSERT_EQ(found.desc.colors.size(), 4U);
  EXPECT_EQ(found.desc.colors[0].x, 0.25F);
  EXPECT_NEAR(found.desc.colors[0].y, 0.2158605, 1e-6);
  EXPECT_EQ(found.desc.colors[0].z, 1.0F);
}

// Codes are a share of the most that their type holds, and gamma encoded; floats are linear light.
TEST(PlyReader, ColoursOfOtherTypes) {
  std::string header = plain_header;
  header.insert(header.find("element face"),
                "property ushort red\nproperty float green\nproperty double blue\n");
  const Read found = read(header + "0 0 0 32896 0.5 1.5\n1 0 0 65535 -1 -0.5\n1 1 0 0 0 1\n0 1 0 1 1 1\n"
                                   "4 0 1 2 3\n");
  ASSERT_EQ(found.desc.colors.size(), 4U);
  EXPECT_NEAR(found.desc.colors[0].x, 0.2158605, 1e-6); // of code 128 in 8 bits
  EXPECT_EQ(found.desc.colors[0].y, 0.5F);
  EXPECT_EQ(found.desc.colors[0].z, 1.5F);
  EXPECT_EQ(found.desc.colors[1], Vec3(1, 0, 0));
}

TEST(PlyReader, Strips) {
  std::string header = plain_header;
  header.replace(header.find("element face 1"), 14, "element tristrips 1");
  const Read found = read(header + square + "9 0 1 3 2 -1 0 1 1 2\n");
  ASSERT_EQ(found.desc.triangles.size(), 2U);
  EXPECT_EQ(found.desc.triangles.v0[1], 3U); // turned as the first one
  EXPECT_EQ(found.desc.triangles.v1[1], 1U);
  EXPECT_EQ(found.desc.triangles.v2[1], 2U);
}

TEST(PlyReader, WhatCantBeReadNamesItsPlace) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = plain_header + square + "4 0 1 2 3\n";
  const std::pair<std::string, const char*> cases[] = {
      {"", "t.ply:1:1: this is no PLY file"},
      {"ply\n", "t.ply:1:1: the header has no 'end_header'"},
      {"ply\nend_header\n", "t.ply:2:1: the header has no 'format'"},
      {with(good, "ascii", "binary"), "t.ply:2:8: 'binary' is not ascii"},
      {with(good, "1.0", "2.0"), "t.ply:2:14: version '2.0' is not 1.0"},
      {with(good, "vertex 4", "vertex -4"), "t.ply:4:16: '-4' is no number of elements"},
      {with(good, "property float y", "property real y"), "t.ply:6:10: 'real' is no type"},
      {with(good, "comment", "command"), "t.ply:3:1: unknown keyword 'command'"},
      {with(good, "float y", "float q"), "t.ply: the vertices have no property 'y'"},
      {with(good, "vertex 4", "vertex 4000000000"), "t.ply: more than 2^31 - 1 elements 'vertex'"},
      {with(good, "vertex 4", "vertex 400000000"), "t.ply: the file ends early"},
      {with(good, "1 1 0", "1 x 0"), "t.ply:13:3: not a number: 'x'"},
      {with(good, "1 1 0", "1 nan 0"), "t.ply:13:3: non-finite"},
      {with(good, "4 0 1 2 3", "4 0 1 2 4"), "t.ply:15:8: index 4 refers to no vertex; there are 4"},
      {with(good, "4 0 1 2 3", "4 0 1 2 -1"), "t.ply:15:8: index -1"},
      {with(good, "4 0 1 2 3", "4 0 1 2.5"), "t.ply:15:7: '2.5' is no integer"},
      {with(good, "4 0 1 2 3", "-1 0 1"), "t.ply:14:6: a list of -1 items"},
      {with(good, "4 0 1 2 3", "4 0 1"), "t.ply:16:1: the file ends early"},
      {with(good, "4 0 1 2 3", "65536 0 1"), "t.ply:14:6: a face has at most 65535 vertices"}};
  for (const auto& [text, message] : cases)
    EXPECT_EQ(error_of(text).rfind(message, 0), 0U) << message << ", but: " << error_of(text);
  std::string many;
  for (int i = 0; i < 1023; ++i) many += "element e" + std::to_string(i) + " 0\n";
  EXPECT_EQ(error_of(with(good, "element face", many + "element face")),
            "t.ply:1031:1: the header has more than 1024 elements");
  const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 1\n"
                             "property list uchar int vertex_indices\nend_header\n";
  const std::string start = std::to_string(binary.size()), face = std::to_string(binary.size() + 13);
  EXPECT_EQ(error_of(binary + Bytes(false).add(0.0F).add(infinity).add(0.0F).add(std::uint8_t{0}).text()),
            "t.ply: byte " + start + ": vertex 0 holds a number that is not finite");
  EXPECT_EQ(
      error_of(binary +
               Bytes(false).add(0.0F).add(0.0F).add(0.0F).add(std::uint8_t{1}).add(std::int32_t{9}).text()),
      "t.ply: byte " + face + ": index 9 refers to no vertex; there are 1");
}

TEST(PlyReader, RowsWithoutPropertiesTakeNoTime) {
  std::string header = plain_header;
  for (int i = 0; i < 1000; ++i)
    header.insert(header.find("element face"), "element e" + std::to_string(i) + " 2147483647\n");
  EXPECT_EQ(read(header + square + "4 0 1 2 3").desc.triangles.size(), 2U);
}

TEST(PlyReader, OddFacesAreWarnedAbout) {
  std::string header = plain_header;
  header.replace(header.find("face 1"), 6, "face 3");
  const std::string text = header + square + "3 0 1 2\n2 0 1\n3 1 1 2\n";
  const Read found = read(text);
  EXPECT_EQ(found.desc.triangles.size(), 1U);
  ASSERT_EQ(found.warnings.size(), 2U);
  EXPECT_EQ(found.warnings[0], "t.ply:15:8: face of 2 vertices skipped");
  EXPECT_EQ(found.warnings[1], "t.ply:16:6: triangle without area skipped");
  const Read large = read(plain_header + "0 0 0\n1e13 0 0\n0 1e13 0\n0 0 1\n3 0 1 2\n");
  ASSERT_EQ(large.warnings.size(), 2U);
  EXPECT_EQ(large.warnings[0], "t.ply:14:6: triangle too large for single precision skipped");
  EXPECT_EQ(large.warnings[1], "t.ply: no primitives");
  EXPECT_THROW(read(text, true), InputError);
}

const std::string textured_header =
    "ply\nformat ascii 1.0\ncomment TextureFile  my wood.png \nelement vertex 3\nproperty float x\n"
    "property float y\nproperty float z\nproperty float texture_u\nproperty float texture_v\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n";
const std::string textured_rows = "0 0 0 0 0 9 9 9\n1 0 0 1 0 9 9 9\n0 1 0 0 1 9 9 9\n3 0 1 2\n";

TEST(PlyReader, TakesTheTextureThatItsHeaderNames) {
  const test::TemporaryFolder folder;
  folder.write("my wood.png", "P3 1 1 255 255 0 0\n"); // told apart by its contents
  Diagnostics diagnostics;
  const SceneDesc desc = load_ply(folder.write("t.ply", textured_header + textured_rows), {}, diagnostics);
  EXPECT_EQ(diagnostics.lines(), std::vector<std::string>{});
  ASSERT_EQ(desc.materials.size(), 1U);
  const Material& material = desc.materials[0];
  ASSERT_EQ(material.diffuse_texture, 0U);
  EXPECT_EQ(material.ambient_texture, 0U);
  EXPECT_EQ(material.diffuse, Vec3(1.0F));
  EXPECT_FALSE(material.vertex_colors); // the picture says which colour there is
  ASSERT_EQ(desc.textures.size(), 1U);
  EXPECT_EQ(desc.textures[0].name, "my wood.png");
  EXPECT_EQ(desc.textures[0].kind, TextureKind::image);
  EXPECT_NE(desc.textures[0].image, nullptr);
  EXPECT_NO_THROW(Scene(SceneDesc(desc)));
}

TEST(PlyReader, TexturesThatCantBeUsedAreWarnedAbout) {
  const test::TemporaryFolder folder;
  folder.write("outside.png", "");
  const auto lines_of = [&](const std::string& header, const std::string& rows, SceneDesc& desc) {
    Diagnostics diagnostics;
    desc = load_ply(folder.write("scene/t.ply", header + rows), {}, diagnostics);
    return diagnostics.lines();
  };
  const std::string start = (folder.path() / "scene/t.ply").string();
  SceneDesc desc;
  auto lines = lines_of(textured_header, textured_rows, desc);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], start + ":3:22: texture 'my wood.png' does not exist");
  EXPECT_EQ(desc.textures.at(desc.materials.at(0).diffuse_texture).kind, TextureKind::checker);
  std::string header = textured_header;
  header.replace(header.find(" my wood.png "), 13, "../outside.png\ncomment TextureFile b.png");
  lines = lines_of(header, textured_rows, desc);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], start + ":4:21: several textures are not supported: the first one is used");
  EXPECT_EQ(lines[1], start + ":3:21: texture '../outside.png' lies outside the scene directory, and "
                              "external files are not allowed; it is not used");
  header = plain_header;
  header.replace(header.find("any"), 3, "TextureFile a.png");
  lines = lines_of(header, square + "4 0 1 2 3\n", desc);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], start + ":3:21: texture 'a.png' is not used: the vertices have no texture coordinates");
  EXPECT_EQ(desc.materials.at(0).diffuse_texture, no_texture);
}

TEST(PlyReader, WhatFacesHaveBesideVerticesIsWarnedAbout) {
  std::string header = plain_header;
  header.insert(header.find("end_header"), "property list uchar float texcoord\nproperty int texnumber\n"
                                           "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  const Read found = read(header + square + "4 0 1 2 3 8 0 0 1 0 1 1 0 1 0 255 0 0\n");
  EXPECT_EQ(found.desc.triangles.size(), 2U);
  ASSERT_EQ(found.warnings.size(), 2U);
  EXPECT_EQ(found.warnings[0],
            "t.ply:10:27: texture coordinates of faces are not supported and skipped; those of vertices are");
  EXPECT_EQ(found.warnings[1], "t.ply:12:16: colours of faces are not supported and skipped");
}

TEST(PlyReader, TruncationAnywhereDoesNoHarm) {
  for (const bool big : {false, true}) {
    Bytes bytes(big);
    for (int i = 0; i < 12; ++i) bytes.add(static_cast<float>(i * i % 5));
    bytes.add(std::uint8_t{4});
    for (const int i : {0, 1, 2, 3}) bytes.add(i);
    std::string text = plain_header;
    text.replace(text.find("ascii"), 5, big ? "binary_big_endian" : "binary_little_endian");
    text += bytes.text();
    for (std::size_t size = 0; size < text.size(); ++size)
      EXPECT_NE(error_of(text.substr(0, size)), "") << size;
    EXPECT_EQ(error_of(text), "");
  }
  const std::string text = plain_header + square + "4 0 1 2 3";
  for (std::size_t size = 0; size + 1 < text.size(); ++size)
    EXPECT_NE(error_of(text.substr(0, size)), "") << size;
}

} // namespace
} // namespace fastrt
