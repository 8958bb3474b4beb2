// SPDX-License-Identifier: Apache-2.0
// What is not TOML, not known, or not of the right kind: where it is and what is said of it.
#include "src/load/spelling.hpp"
#include "src/load/toml_key_depth.hpp"
#include "src/load/toml_node.hpp"
#include "tests/unit/toml_test_support.hpp"

#include <string>

namespace fastrt {
namespace {

using test::contains;
using test::TomlTexts;

TEST(TomlValues, TablesKeepTheOrderOfTheFile) {
  const TomlTable root = parse_toml("zebra = 1\n[b]\nx = true\n[a]\n", "t");
  ASSERT_EQ(root.size(), 3U);
  EXPECT_EQ(root[0].key, "zebra");
  EXPECT_EQ(root[1].key, "b");
  EXPECT_EQ(root[2].key, "a");
  EXPECT_EQ(root[1].node.table()->front().place, (TomlPlace{3, 1}));
  EXPECT_EQ(root[0].node.place, (TomlPlace{1, 9}));
}

TEST(TomlValues, UnknownKeysHaveAPlaceAndASuggestion) {
  TomlTexts texts;
  EXPECT_EQ(texts.error("\n[[light]]\ntype = 'point'\n  colour = [1, 1, 1]\nposition = [0, 0, 0]"),
            "t.toml:4:3: unknown key 'colour' in [[light]]; did you mean 'color'?");
  EXPECT_EQ(texts.error("[[sphre]]"), "t.toml:1:3: unknown key 'sphre' in the scene; did you mean 'sphere'?");
  EXPECT_EQ(texts.error("xyzzy = 1"), "t.toml:1:1: unknown key 'xyzzy' in the scene");
  EXPECT_EQ(texts.error("[material.red]\nKd = 1"), "t.toml:2:1: unknown key 'Kd' in [material.red]");
}

TEST(TomlValues, WrongKindsAreNamed) {
  TomlTexts texts;
  const std::string sphere = "[[sphere]]\n";
  EXPECT_EQ(texts.error(sphere + "radius = 'big'"), "t.toml:2:10: radius: expected a number, found a text");
  EXPECT_EQ(texts.error(sphere + "radius = 0"), "t.toml:2:10: radius: must be greater than 0");
  EXPECT_EQ(texts.error(sphere + "radius = nan"), "t.toml:2:10: radius: must be finite, and below 3.4e38");
  EXPECT_EQ(texts.error(sphere + "radius = 1e39"), "t.toml:2:10: radius: must be finite, and below 3.4e38");
  EXPECT_EQ(texts.error(sphere + "radius = 1e-60"), "t.toml:2:10: radius: must be greater than 0");
  EXPECT_EQ(texts.error(sphere + "center = [1, 2]"),
            "t.toml:2:10: center: expected 3 numbers, found an array of 2");
  EXPECT_EQ(texts.error(sphere + "center = [1, 2, inf]"),
            "t.toml:2:17: center: must be finite, and below 3.4e38");
  EXPECT_EQ(texts.error(sphere + "center = 1979-05-27"),
            "t.toml:2:10: center: expected 3 numbers, found a date or time");
  EXPECT_EQ(texts.error("background = [1, 1, -1]"), "t.toml:1:14: background: a colour must not be negative");
  EXPECT_EQ(texts.error("background = true"),
            "t.toml:1:14: background: expected 3 numbers, found true or false");
  EXPECT_EQ(texts.error("[[cylinder]]\ncapped = 1"),
            "t.toml:2:10: capped: expected true or false, found a number");
  EXPECT_EQ(texts.error("[sphere]"), "t.toml:1:2: 'sphere' is a list: write [[sphere]]");
  EXPECT_EQ(texts.error("sphere = [1]"), "t.toml:1:11: [[sphere]]: expected a table, found a number");
  EXPECT_EQ(texts.error("camera = 3"), "t.toml:1:10: [camera]: expected a table, found a number");
  EXPECT_EQ(texts.error("material = []"),
            "t.toml:1:12: material: expected tables [material.NAME], found an array of 0");
}

TEST(TomlValues, WhatIsNoTomlHasAPlace) {
  TomlTexts texts;
  EXPECT_TRUE(contains(texts.error("a = 1\nb = [1, 2"), "t.toml:2:"));
  EXPECT_TRUE(contains(texts.error("a = 1\na = 2\n"), "t.toml:2:"));
  EXPECT_TRUE(contains(texts.error("\xff\xfe = 1"), "t.toml:1:"));
  EXPECT_TRUE(contains(texts.error(std::string("a = \0", 5)), "t.toml:1:"));
  EXPECT_EQ(texts.error("# nothing\n"), "");
}

// What toml++ took for impossible, only UBSan sees.
TEST(TomlValues, LettersBeyondAsciiAreNoSpacesAndNoKeys) {
  for (const char* text : {"é = 1", "a é= 1", "[é]", "é"})
    EXPECT_TRUE(contains(TomlTexts().error(text), "t.toml:1:")) << text;
  for (const char* text : {"a = \"\"\"b \\\n  é\"\"\"", "a = 'b é'", "a = \"\"\"\nb é\"\"\" # é"}) {
    const TomlTable root = parse_toml(text, "t");
    ASSERT_EQ(root.size(), 1U) << text;
    EXPECT_EQ(*root[0].node.text(), "b é") << text;
  }
}

TEST(TomlValues, DeepNestingEnds) {
  TomlTexts texts;
  EXPECT_NE(texts.error("a = " + std::string(100000, '[')), "");
  std::string points = "a";
  for (int i = 0; i < 100000; ++i) points += ".a";
  EXPECT_EQ(texts.error(points + " = 1"), "t.toml:1:64: a key has more than 32 parts");
  EXPECT_EQ(texts.error("\n[" + points + "]"), "t.toml:2:65: a key has more than 32 parts");
  EXPECT_EQ(texts.error("\n[ 'x'" + points.substr(1) + "]"), "t.toml:2:68: a key has more than 32 parts");
  EXPECT_EQ(texts.error("# ...." + std::string(100, '.')), "");
  std::string numbers = "background = [0.5, 0.5, 0.5]\n[[polygon]]\npoints = [";
  for (int i = 0; i < 100; ++i) numbers += "[0.5, 1.5, 2.5], ";
  EXPECT_EQ(texts.error(numbers + "]"), "t.toml:2:1: [[polygon]]: its points lie on a line");
}

TEST(TomlValues, QuotesDontHideDeepKeys) {
  const auto is_deep = [](const std::string& text) { return find_deep_key(text, 4) != std::string::npos; };
  EXPECT_TRUE(is_deep("a.b.c.d.e = 1"));
  EXPECT_FALSE(is_deep("a.b.c.d = 1\ne.f.g.h = 2"));
  EXPECT_TRUE(is_deep("'='.a.'='.a.'=' = 1"));
  EXPECT_TRUE(is_deep("\"\\\"=\".a.\"=\".a.\"=\" = 1"));
  EXPECT_TRUE(is_deep("a . b . \"#\" . d . e = 1"));
  EXPECT_TRUE(is_deep("x = { y = \"\"\"\n\"\"\", a.b.c.d.e = 1 }"));
  EXPECT_TRUE(is_deep("x = { y = \"\"\"=\\\"\"\"\"\"\", a.b.c.d.e = 1 }"));
  EXPECT_TRUE(is_deep("x = { y = '''\\''', a.b.c.d.e = 1 }"));
  EXPECT_FALSE(is_deep("x = 'a.b.c.d.e.f' # a.b.c.d.e.f"));
  EXPECT_FALSE(is_deep("x = \"\"\"\na.b.c.d.e.f\n\"\"\""));
  EXPECT_FALSE(is_deep("x = [0.1, 0.2, 0.3, 0.4, 0.5]"));
  for (const char* text : {"'", "\"", "\"\\", "\"\"\"", "'''", "''''", "#", "\"\"\"\\"})
    EXPECT_FALSE(is_deep(text));
}

TEST(TomlValues, LargeFilesAreRefused) {
  TomlTexts texts;
  EXPECT_THROW(texts.desc(std::string((16U << 20U) + 1, ' ')), LimitError);
}

TEST(TomlValues, SuggestionsAreWordsThatAreLikeIt) {
  constexpr std::string_view names[] = {"radius", "center", "color", "look_at"};
  EXPECT_EQ(did_you_mean("radis", names), "; did you mean 'radius'?");
  EXPECT_EQ(did_you_mean("COLOR", names), "; did you mean 'color'?");
  EXPECT_EQ(did_you_mean("centre", names), "; did you mean 'center'?");
  EXPECT_EQ(did_you_mean("lookat", names), "; did you mean 'look_at'?");
  EXPECT_EQ(did_you_mean("colro", names), "; did you mean 'color'?");
  EXPECT_EQ(did_you_mean("x", names), "");
  EXPECT_EQ(did_you_mean("diffuse", names), "");
  EXPECT_EQ(did_you_mean(std::string(1000, 'a'), names), "");
}

} // namespace
} // namespace fastrt
