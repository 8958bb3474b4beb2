// SPDX-License-Identifier: Apache-2.0
// What is wrong in an OBJ file is said with its place; what can be tolerated is a warning.
#include "src/load/text.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <random>

namespace fastrt {
namespace {

using namespace test;

constexpr const char* three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"; // lines 1 to 3

struct Case {
  const char* text;
  const char* message;
};

TEST(ObjErrors, NumbersAreChecked) {
  for (const auto& [text, message] : {Case{"v 1 2\n", "t.obj:4:1: 'v' needs 3 numbers, but has 2"},
                                      {"v\n", "t.obj:4:1: 'v' needs 3 numbers"},
                                      {"v a b c\n", "t.obj:4:3: not a number: 'a'"},
                                      {"v 0 0 1x\n", "t.obj:4:7: not a number: '1x'"},
                                      {"v nan 0 0\n", "t.obj:4:3: non-finite number 'nan'"},
                                      {"v 0 inf 0\n", "t.obj:4:5: non-finite number"},
                                      {"v 0 0 -inf\n", "t.obj:4:7: non-finite number"},
                                      {"v 1e999 0 0\n", "t.obj:4:3: number out of range"},
                                      {"v 1,5 0 0\n", "t.obj:4:3: not a number: '1,5'"},
                                      {"v 0x1p3 0 0\n", "t.obj:4:3: not a number: '0x1p3'"},
                                      {"v 1e 2 3\n", "t.obj:4:3: not a number: '1e'"},
                                      {"v 0 0 1.#INF\n", "t.obj:4:7: not a number: '1.#INF'"},
                                      {"v 1 2 3 4 5 6 7 8 9\n", "t.obj:4:19: more than 8 numbers"},
                                      {"v 1 2 3 x\n", "t.obj:4:9: not a number"},
                                      {"vn 0 0\n", "t.obj:4:1: 'vn' needs 3 numbers, but has 2"},
                                      {"vn nan 0 0\n", "t.obj:4:4: non-finite"},
                                      {"vn 0 0 1 1\n", "t.obj:4:10: more than 3 numbers"},
                                      {"vt nan 0\n", "t.obj:4:4: non-finite"},
                                      {"vt\n", "t.obj:4:1: 'vt' needs 1 numbers"},
                                      {"   v 1 2\n", "t.obj:4:4: 'v' needs"}})
    EXPECT_TRUE(contains(error_of(three + std::string(text)), message)) << text;
}

TEST(ObjErrors, IndicesAreChecked) {
  for (const auto& [text, message] :
       {Case{"f 0 1 2\n", "t.obj:4:3: index 0: vertex indices count from 1"},
        {"f 1 2 99\n", "t.obj:4:7: face refers to vertex 99, but only 3 are defined"},
        {"f -4 -3 -2\n", "t.obj:4:3: face refers to vertex -4, but only 3 are defined so far"},
        {"f 99999999999 2 3\n", "t.obj:4:3: face refers to vertex 99999999999, but only 3 are defined"},
        {"f 4294967297 2 3\n", "t.obj:4:3: face refers to vertex 4294967297"},
        {"f 1 2 99999999999999999999999\n", "t.obj:4:7: face refers to vertex 9999"},
        {"f -9223372036854775808 1 2\n", "t.obj:4:3: face refers to vertex -9223372036854775808"},
        {"f -9223372036854775809 1 2\n", "t.obj:4:3: face refers to vertex -9223372036854775809"},
        {"f 1/9 2/9 3/9\n", "t.obj:4:5: face refers to texture coordinate 9, but only 0 are defined"},
        {"f 1//9 2//9 3//9\n", "t.obj:4:6: face refers to normal 9, but only 0 are defined"},
        {"f 1/// 2 3\n", "t.obj:4:7: expected v, v/vt, v//vn or v/vt/vn, found '1///'"},
        {"f / 2 3\n", "t.obj:4:3: expected v"},
        {"f 1/# 2 3\n", "t.obj:4:5: not an index: '#'"},
        {"f 1/a/2 2 3\n", "t.obj:4:5: not an index: 'a'"},
        {"f /1 2 3\n", "t.obj:4:3: expected v"},
        {"vt 0 0\nvn 0 0 1\nf 1/1/1/4 2 3\n", "t.obj:6:9: expected v"},
        {"f 1.5 2 3\n", "t.obj:4:3: not an index: '1.5'"},
        {"f 1 2 3#\n", "t.obj:4:7: not an index: '3#'"},
        {"f -0 1 2\n", "t.obj:4:3: index 0"},
        {"f 1 2 -\n", "t.obj:4:7: not an index: '-'"},
        {"vt 0 0\nf 1/0 2 3\n", "t.obj:5:5: index 0: texture"}})
    EXPECT_TRUE(contains(error_of(three + std::string(text)), message)) << text;
  EXPECT_TRUE(contains(error_of("f -1 -2 -3\n" + std::string(three)), "t.obj:1:3: "));
}

TEST(ObjErrors, LinesAreCountedWithEveryKindOfLineEnd) {
  for (const std::string text :
       {"v 0 0 0\n\n# c\nf 1 1 9\n", "v 0 0 0\r\n\r\n# c\r\nf 1 1 9\r\n", "v 0 0 0\r\r# c\rf 1 1 9",
        "\xEF\xBB\xBFv 0 0 0\n\n# c\nf 1 1 9\n", "v 0 \\\n 0 \\\r\n 0\nf 1 1 9\n"})
    EXPECT_TRUE(contains(error_of(text), "t.obj:4:7: face refers to vertex 9")) << text;
  EXPECT_TRUE(contains(error_of("v 0 0 0\nf 1 \\\n 1 9\n"), "t.obj:3:4: face refers"));
  EXPECT_TRUE(contains(error_of("\xEF\xBB\xBFv 0 0\n"), "t.obj:1:1: "));
}

TEST(ObjErrors, WhatIsNoTextIsRefused) {
  EXPECT_TRUE(contains(error_of(std::string("v 0 0 0\n# a\0b\n", 14)), "t.obj:2:4: NUL byte"));
  EXPECT_TRUE(contains(error_of(std::string("v 0 \0 0\n", 8)), "t.obj:1:5: NUL byte"));
  EXPECT_TRUE(contains(error_of("\xFF\xFEv\0 \0", settings_for_tests()), "looks like UTF-16"));
  EXPECT_TRUE(contains(error_of(std::string("v\0 \0000\0", 6)), "t.obj:1:1: looks like UTF-16"));
  EXPECT_TRUE(contains(error_of(std::string("\0v\0 ", 4)), "looks like UTF-16"));
  EXPECT_TRUE(contains(error_of("v 0 0 0\n\x01\x02 5\n"), "t.obj:2:1: unknown keyword '\\x01\\x02'"));
  std::mt19937 random(4);
  std::string junk(1U << 16U, ' ');
  for (char& c : junk) c = static_cast<char>(random());
  EXPECT_TRUE(contains(error_of(junk), "t.obj:"));
}

TEST(ObjErrors, ControlCharactersDoNotReachTheTerminal) {
  const Loaded loaded = parse(std::string(three) + "usemtl a\x1b[31mb\no \x1b[31m\nf 1 2 3\n");
  ASSERT_EQ(loaded.warnings().size(), 1U);
  EXPECT_TRUE(contains(loaded.warnings()[0], "'a\\x1b[31mb'"));
  EXPECT_TRUE(contains(error_of("v \x1b[31m 0 0\n"), "'\\x1b[31m'"));
  EXPECT_TRUE(contains(error_of("v \xc2\x9b"
                                "31m 0 0\n"),
                       "'\\xc2\\x9b31m'"));
  EXPECT_TRUE(contains(error_of("v \xff\xc3 0 0\n"), "'\\xff\\xc3'"));
  EXPECT_TRUE(contains(error_of("v \xc3\xa4 0 0\n"), "'\xc3\xa4'"));
  const std::string cut(79, 'x');
  EXPECT_TRUE(contains(error_of("v " + cut + "\xc3\xa4 0 0\n"), "'" + cut + "...'"));
  const std::string long_name(1U << 19U, 'x');
  EXPECT_LT(parse(three + ("usemtl " + long_name) + "\nf 1 2 3\n").warnings()[0].size(), 300U);
  EXPECT_EQ(parse(three + ("o " + long_name) + "\nf 1 2 3\n").desc.object_names[0], long_name);
}

TEST(ObjErrors, LongLinesAreRefusedAtTheLimit) {
  const std::string start = std::string(three) + "#";
  const std::string at_limit = start + std::string(max_line_bytes - 1, 'x');
  EXPECT_EQ(error_of(at_limit + "\nf 1 2 3\n"), "");
  EXPECT_TRUE(contains(error_of(at_limit + "x\nf 1 2 3\n"), "t.obj:4:1: line too long"));
  EXPECT_TRUE(contains(error_of(start + std::string(2 * max_line_bytes, 'x')), "t.obj:4:1: line too long"));
  EXPECT_TRUE(contains(error_of(start + std::string(9 * max_line_bytes, 'x') + "\nv a\n"),
                       "t.obj:4:1: line too long"));
  EXPECT_TRUE(
      contains(error_of("v 1" + std::string(max_line_bytes, ' ') + "2 3\n"), "t.obj:1:1: line too long"));
  EXPECT_TRUE(contains(error_of("v a\n" + std::string(3 * max_line_bytes, 'x')), "t.obj:1:3: not a number"));
  std::string joined = three;
  for (std::size_t i = 0; i < max_line_bytes / 2; ++i) joined += " \\\n";
  EXPECT_TRUE(contains(error_of(joined + "f 1 2 3\n"), "t.obj:4:1: line too long"));
}

TEST(ObjErrors, FacesAreLimited) {
  const auto face = [](std::size_t corners) {
    std::string text = std::string(three) + "f";
    for (std::size_t i = 0; i < corners; ++i) text += ' ' + std::to_string(i % 3 + 1);
    return text + '\n';
  };
  EXPECT_EQ(error_of(face(65535)), "");
  EXPECT_TRUE(contains(error_of(face(65536)), "t.obj:4:131073: a face may have 65535 vertices"));
  EXPECT_TRUE(contains(error_of(face(70000)), "a face may have 65535 vertices"));
}

struct Warning {
  const char* text;
  const char* message;
  std::size_t triangles;
};

TEST(ObjErrors, WhatCanBeToleratedIsAWarningAndAnErrorWhenStrict) {
  for (const auto& [text, message, triangles] :
       {Warning{"f 1 2\nf 1 2 3\n", "t.obj:4:1: face of 2 vertices skipped", 1},
        {"f 1\nf 1 2 3\n", "t.obj:4:1: face of 1 vertices skipped", 1},
        {"f\nf 1 2 3\n", "t.obj:4:1: face of 0 vertices skipped", 1},
        {"f 1 2 3\n f 1 1 2\n", "t.obj:5:2: triangle without area skipped", 1},
        {"v 2 0 0\nf 1 2 4\nf 1 2 3\n", "t.obj:5:1: triangle without area skipped", 1},
        {"v 1e-50 0 0\nf 1 2 3\n", "t.obj:4:3: '1e-50' is too small", 1},
        {"vn 0 0 0\nf 1 2 3\n", "t.obj:4:1: the normal is 0", 1},
        {"v 1e30 0 0\nv 0 1e30 0\nf 1 2 3\nf 1 4 5\n", "t.obj:7:1: triangle too large", 1},
        {"f 1 2 3\nmtllib\n", "t.obj:5:1: 'mtllib' without a name", 1},
        {"v 1e13 0 0\nv 0 1e13 0\nf 1 2 3\nf 1 4 5\n", "t.obj:7:1: triangle too large", 1},
        {"s x\nf 1 2 3\n", "t.obj:4:1: not a smoothing group: 'x'", 1},
        {"usemtl missing\nf 1 2 3\n", "t.obj:4:1: material 'missing' is not defined", 1},
        {"f 1 2 3\nfoo\n", "t.obj:5:1: unknown keyword 'foo'", 1},
        {"v 0 0 0\nv 0 0 0\nf 1 4 5\nf 1 2 3\n", "t.obj:6:1: triangle without area", 1},
        {"f 1 2 3\n# x\nf 1 2 3 \\", "t.obj:6:9: the file ends after a line", 2}}) {
    const Loaded loaded = parse(three + std::string(text));
    ASSERT_EQ(loaded.warnings().size(), 1U) << text;
    EXPECT_TRUE(contains(loaded.warnings()[0], message));
    EXPECT_EQ(loaded.desc.triangles.size(), triangles) << text;
    EXPECT_TRUE(is_sound(loaded.desc));
    ObjReaderSettings strict = settings_for_tests();
    strict.strict = true;
    EXPECT_EQ(error_of(three + std::string(text), strict), loaded.warnings()[0]) << text;
  }
  ObjReaderSettings strict = settings_for_tests();
  strict.strict = true;
  EXPECT_EQ(error_of("", strict), "t.obj: no primitives");
}

TEST(ObjErrors, HugeTextureCoordinatesAreKept) {
  const Loaded loaded = parse(std::string(three) + "vt 1e30 -1e30\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(loaded.desc.uvs.x[0], 1e30F);
  EXPECT_EQ(loaded.diagnostics.count(), 0U);
}

TEST(ObjErrors, ManyWarningsAreCounted) {
  std::string text = three;
  for (int i = 0; i < 1000; ++i) text += "f 1 2\nf 1 1 2\n";
  ObjReaderSettings settings = settings_for_tests();
  settings.chunk_bytes = 100;
  const Loaded loaded = parse(text, settings);
  EXPECT_EQ(loaded.diagnostics.count(), 2001U); // "no primitives" too
  const auto lines = loaded.warnings();
  ASSERT_EQ(lines.size(), 23U);
  EXPECT_TRUE(contains(lines[0], "t.obj:4:1: "));
  EXPECT_TRUE(contains(lines[1], "t.obj:5:1: "));
  EXPECT_TRUE(contains(lines[19], "t.obj:23:1: "));
  EXPECT_EQ(lines[21], "990 more: degenerate face");
}

} // namespace
} // namespace fastrt
