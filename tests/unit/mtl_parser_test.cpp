// SPDX-License-Identifier: Apache-2.0
#include "src/load/mtl.hpp"
#include "src/load/source.hpp"

#include <fastrt/diagnostics.hpp>
#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace fastrt {
namespace {

struct Parsed {
  std::vector<MtlRecord> records;
  std::vector<std::string> warnings;
  std::string error;
};

Parsed parse(std::string_view text, const MtlOptions& options = {}) {
  EventLog log;
  Parsed parsed;
  parsed.records = parse_mtl(text, options, log);
  EventReport report;
  report.take(std::move(log));
  Diagnostics diagnostics;
  try {
    report.deliver(Source::memory(text, "t.mtl"), {}, false, diagnostics);
  } catch (const InputError& error) {
    parsed.error = error.what();
  }
  parsed.warnings = diagnostics.lines();
  return parsed;
}

MtlRecord only(std::string_view statements) {
  const Parsed parsed = parse("newmtl a\n" + std::string(statements) + "\n");
  EXPECT_EQ(parsed.error, "") << statements;
  EXPECT_TRUE(parsed.warnings.empty()) << statements;
  return parsed.records.at(0);
}

TEST(MtlParser, ReadsWhatIsStated) {
  const Parsed parsed =
      parse("\xEF\xBB\xBF# head\r\nnewmtl first one \r\n\tKa .1 .2 .3\r\n  Kd 0.4 # grey\r\nKs 1 1 1\n"
            "Ke 17 12 4\nTf .5 .6 .7\nNs 200\nNi 1.5\nd 0.5\nTr 0.25\nillum 7\nsharpness 60\n"
            "newmtl Material #25\nnewmtl red # the wall\n");
  EXPECT_EQ(parsed.error, "");
  EXPECT_TRUE(parsed.warnings.empty());
  ASSERT_EQ(parsed.records.size(), 3U);
  const MtlRecord& m = parsed.records[0];
  EXPECT_EQ(m.name, "first one");
  EXPECT_EQ(m.ka, Vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(m.kd, Vec3(0.4F));
  EXPECT_EQ(m.ks, Vec3(1));
  EXPECT_EQ(m.ke, Vec3(17, 12, 4));
  EXPECT_EQ(m.tf, Vec3(0.5F, 0.6F, 0.7F));
  EXPECT_EQ(m.ns, 200.0F);
  EXPECT_EQ(m.ni, 1.5F);
  EXPECT_EQ(m.d, 0.5F);
  EXPECT_EQ(m.tr, 0.25F);
  EXPECT_EQ(m.illum, 7);
  EXPECT_EQ(parsed.records[1].name, "Material #25");
  EXPECT_EQ(parsed.records[2].name, "red");
  EXPECT_FALSE(parsed.records[1].kd || parsed.records[1].ns || parsed.records[1].d);
  EXPECT_EQ(parsed.records[1].illum, 2);
}

TEST(MtlParser, ErrorsNameTheirPlace) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {{"Kd 1 0", "t.mtl:2:1: a colour takes 1 or 3 numbers, not 2"},
               {"Kd", "t.mtl:2:1: a colour takes 1 or 3 numbers, not 0"},
               {"Kd 1 1 1 1", "t.mtl:2:10: a colour takes 1 or 3 numbers, not more"},
               {"Kd a b c", "t.mtl:2:4: not a number: 'a'"},
               {"Kd 1 nan 0", "t.mtl:2:6: non-finite number 'nan'"},
               {"Ns nan", "t.mtl:2:4: non-finite"},
               {"Ns", "t.mtl:2:1: a number is missing"},
               {"Ni 0", "t.mtl:2:4: Ni must be at least 0.001"},
               {"Ni -1", "t.mtl:2:4: Ni must be at least 0.001"},
               {"Ni 1e-30", "t.mtl:2:4: Ni must be at least 0.001"},
               {"d x", "t.mtl:2:3: not a number"},
               {"d", "t.mtl:2:1: a number is missing"},
               {"d -halo", "t.mtl:2:1: a number is missing"},
               {"illum two", "t.mtl:2:7: not a number"},
               {"map_Kd -s x t.png", "t.mtl:2:11: not a number: 'x'"},
               {"map_Kd -bm nan t.png", "t.mtl:2:12: non-finite"}};
  for (const auto& [text, message] : cases) {
    const Parsed parsed = parse("newmtl a\n" + std::string(text) + "\nKd 2 x\n");
    EXPECT_EQ(parsed.error.rfind(message, 0), 0U) << text << " gave " << parsed.error;
  }
  EXPECT_EQ(parse("# x\n  Kd 1 1 1\nnewmtl a\n").error, "t.mtl:2:3: 'Kd' before the first 'newmtl'");
  EXPECT_EQ(parse("map_Kd a.png\n").error, "t.mtl:1:1: 'map_Kd' before the first 'newmtl'");
  EXPECT_EQ(parse(std::string_view("newmtl a\nKd \0 1\n", 16)).error,
            "t.mtl:2:4: NUL byte: this is no text file");
}

TEST(MtlParser, OddValuesAreWarnedAboutAndBroughtIntoRange) {
  const Parsed parsed =
      parse("newmtl a\nKd -1 2 3\nNs 1e9\nd 2\nTr -1\nillum 99\nNi 1e9\nKs xyz 1 1 1\n"
            "Ka spectral x.rfl 1\nfoo\nfoo\nPr 1\nmap_Ns x\nd -halo .5\nillum 2.5\nnewmtl\nNs -1\n");
  EXPECT_EQ(parsed.error, "");
  ASSERT_EQ(parsed.records.size(), 2U);
  const MtlRecord& m = parsed.records[0];
  EXPECT_EQ(m.kd, Vec3(0, 2, 3));
  EXPECT_EQ(m.ns, 10000.0F);
  EXPECT_EQ(m.d, 0.5F);
  EXPECT_EQ(m.tr, 0.0F);
  EXPECT_EQ(m.ni, 100.0F);
  EXPECT_EQ(m.illum, 2);
  EXPECT_FALSE(m.ks || m.ka);
  EXPECT_EQ(parsed.records[1].ns, 1.0F);
  ASSERT_EQ(parsed.warnings.size(), 15U);
  EXPECT_EQ(parsed.warnings[0], "t.mtl:2:4: negative colour '-1' taken as 0");
  EXPECT_EQ(parsed.warnings[1], "t.mtl:3:4: Ns lies outside 0 .. 10000");
  EXPECT_EQ(parsed.warnings[4], "t.mtl:6:7: illum is not one of 0 .. 10 and taken as 2");
  EXPECT_EQ(parsed.warnings[8], "t.mtl:10:1: unknown keyword 'foo' skipped");
}

TEST(MtlParser, ShininessIsAtLeastOne) {
  EXPECT_EQ(only("Ns 0").ns, 1.0F);
  EXPECT_EQ(only("Ns 1e4").ns, 10000.0F);
}

TEST(MtlParser, MapsHaveOptionsAndNamesWithBlanks) {
  const struct {
    const char* text;
    const char* name;
  } cases[] = {{"map_Kd my map.png", "my map.png"},
               {"map_Kd dir\\my map.png  # here", "dir\\my map.png"},
               {"map_Kd \"my map.png\"", "my map.png"},
               {"map_Kd -s 2 2 1 -clamp on tex dir/my map.png", "tex dir/my map.png"},
               {"map_Kd -o 1 a.png", "a.png"},
               {"map_Kd -o 1 2 a.png", "a.png"},
               {"map_Kd -mm 0 1 -blendu off -texres 512 -imfchan l a.png", "a.png"},
               {"map_Kd -bm 0.5 -boost 2 -cc on -texres 1 -type sphere a.png", "a.png"},
               {"map_kd a.png", "a.png"},
               {"MAP_KD -S 1 1 1 2.png", "2.png"}};
  for (const auto& [text, name] : cases) EXPECT_EQ(only(text).map_kd.name, name) << text;
  const MtlRecord m = only("map_Ka a\nmap_Ks s\nmap_Ke e\nmap_d d\nbump -bm 1 b");
  EXPECT_EQ(m.map_ka.name + m.map_ks.name + m.map_ke.name + m.map_d.name + m.bump.name, "asedb");
  EXPECT_EQ(only("bump a\nmap_Bump b").bump.name, "b");
  EXPECT_EQ(only("norm n").bump.name, "n");
}

TEST(MtlParser, MapOptionsAreKept) {
  const MtlMap map =
      only("map_d -s 2 -o 0.5 0.25 -clamp on -mm 0.125 3 -imfchan b -bm 4 -colorspace linear a.png").map_d;
  EXPECT_EQ(map.scale, Vec2(2, 1));
  EXPECT_EQ(map.offset_uv, Vec2(0.5F, 0.25F));
  EXPECT_TRUE(map.clamp);
  EXPECT_EQ(map.base, 0.125F);
  EXPECT_EQ(map.gain, 3.0F);
  EXPECT_EQ(map.channel, 'b');
  EXPECT_EQ(map.bump, 4.0F);
  EXPECT_TRUE(map.is_linear);
  EXPECT_TRUE(only("norm n").bump.is_normal_map);
  EXPECT_FALSE(only("norm n\nbump b").bump.is_normal_map);
  const MtlMap again = only("map_Kd -s 2 2 -clamp on a.png\nmap_Kd b.png").map_kd;
  EXPECT_EQ(again.scale, Vec2(1, 1));
  EXPECT_FALSE(again.clamp);
}

TEST(MtlParser, OddMapsAreWarnedAbout) {
  const Parsed parsed =
      parse("newmtl a\nmap_Kd -s 1e30 1 1 t.png\nmap_Ks -what x.png\nmap_Ka -s 1 1 1\nmap_Ke\n");
  EXPECT_EQ(parsed.records[0].map_kd.name, "t.png");
  EXPECT_EQ(parsed.records[0].map_ks.name, "x.png");
  ASSERT_EQ(parsed.warnings.size(), 4U);
  EXPECT_EQ(parsed.warnings[0], "t.mtl:2:11: texture option '1e30' is out of range");
  EXPECT_EQ(parsed.warnings[1], "t.mtl:3:8: unknown texture option '-what' skipped");
  EXPECT_EQ(parsed.warnings[2], "t.mtl:4:1: a texture without a file name");
}

TEST(MtlParser, TruncationAnywhereDoesNoHarm) {
  const std::string text =
      "newmtl a\nKd 1 .5 1e-1\nmap_Kd -s 1 1 1 -mm 0 1 a b.png\nd -halo 0.5\nNs 10 \\\n\nillum 7\nNi 1.5\n";
  for (std::size_t size = 0; size <= text.size(); ++size)
    EXPECT_LE(parse(text.substr(0, size)).records.size(), 1U);
}

} // namespace
} // namespace fastrt
