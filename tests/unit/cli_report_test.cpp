// SPDX-License-Identifier: Apache-2.0
#include "src/cli/progress.hpp"
#include "src/cli/stats.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace fastrt::cli {
namespace {

RunStats some_stats() {
  RunStats stats;
  stats.scene = "dragon.obj";
  stats.output = "dragon.png";
  stats.width = 1024;
  stats.height = 768;
  stats.samples_per_pixel = 1;
  stats.threads = 2;
  stats.isa = Isa::avx2;
  stats.triangles = 871414;
  stats.rays = {786432, 400000, 10000, 3568};
  stats.render_seconds = 0.03;
  stats.total_seconds = 0.314;
  return stats;
}

TEST(CliReport, SummarySaysWhatHowFastAndWhere) {
  EXPECT_EQ(
      summary_line(some_stats()),
      "dragon.png: 1024x768, 871414 triangles, 1 spp, 1.2 Mrays in 0.0300 s (40 Mrays/s), total 0.31 s\n");
}

TEST(CliReport, SummaryWithSpheresAndWithoutAFile) {
  RunStats stats = some_stats();
  stats.output.clear();
  stats.triangles = 0;
  stats.spheres = 1;
  EXPECT_EQ(summary_line(stats).rfind("no picture kept: 1024x768, 1 sphere, 1 spp", 0), 0U);
}

TEST(CliReport, SummaryOfAdaptiveSampling) {
  RunStats stats = some_stats();
  stats.samples_per_pixel = 4;
  stats.most_samples = 64;
  stats.mean_samples = 9.25;
  EXPECT_NE(summary_line(stats).find(", 4 to 64 spp, 9.2 on average, "), std::string::npos);
  EXPECT_NE(stats_json(stats).find("\"mean_spp\": 9.25"), std::string::npos);
}

TEST(CliReport, TestsPerRay) {
  RunStats stats = some_stats();
  EXPECT_EQ(stats_text(stats).find("tests"), std::string::npos);
  stats.tests.primary = {786432 * 2, 786432 * 12};
  stats.tests.secondary = {6784, 0};
  EXPECT_NE(
      stats_text(stats).find("\ntests    per primary ray 2.0 boxes and 12 primitives, per secondary ray "
                             "0.50 boxes and 0 primitives\n"),
      std::string::npos);
  const std::string json = stats_json(stats);
  EXPECT_NE(json.find("\"tests\": {\"primary\": {\"boxes\": 1572864, \"primitives\": 9437184, "
                      "\"boxes_per_ray\": 2, \"primitives_per_ray\": 12}, \"shadow\": {\"boxes\": 0"),
            std::string::npos)
      << json;
}

TEST(CliReport, JsonHoldsTheNumbers) {
  const std::string json = stats_json(some_stats());
  EXPECT_EQ(json.front(), '{');
  EXPECT_EQ(json.substr(json.size() - 2), "}\n");
  EXPECT_EQ(std::count(json.begin(), json.end(), '\n'), 1);
  for (const char* part :
       {"\"width\": 1024", "\"isa\": \"avx2\"", "\"total\": 1200000", "\"primary\": 786432",
        "\"mrays_per_second\": 40", "\"scene\": \"dragon.obj\"", "\"output\": \"dragon.png\""}) {
    EXPECT_NE(json.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(json.find("verify"), std::string::npos);
}

TEST(CliReport, JsonEscapesNames) {
  RunStats stats = some_stats();
  stats.output.clear();
  stats.scene = "a\"b\\c\n\xC3\xA4\xFF\xC0\x80\xED\xA0\x80.obj";
  const std::string json = stats_json(stats);
  EXPECT_NE(json.find("\"a\\\"b\\\\c\\u000a\xC3\xA4\\ufffd\\ufffd\\ufffd\\ufffd\\ufffd\\ufffd.obj\""),
            std::string::npos)
      << json;
  EXPECT_NE(json.find("\"output\": null"), std::string::npos);
}

TEST(CliReport, VerifyHasThreeLines) {
  RunStats stats = some_stats();
  EXPECT_EQ(verify_text(stats), "");
  stats.verify = FrameDifference{3, 1, 0.25};
  EXPECT_EQ(verify_text(stats), "verify: 3 of 786432 pixels differ\n"
                                "verify: 1 of 786432 primitive ids differ\n"
                                "verify: the largest difference is 0.25\n");
  EXPECT_NE(stats_json(stats).find("\"pixels\": 3"), std::string::npos);
  stats.aovs = 2;
  stats.verify->aovs = 9;
  EXPECT_NE(verify_text(stats).find("verify: 9 of 786432 AOVs differ\n"), std::string::npos);
}

TEST(CliReport, ProgressTellsShareAndTimeLeft) {
  EXPECT_EQ(progress_line("rendering", 0.25, 10, 80),
            "rendering  25 % [==========                              ] 0:30 left");
  EXPECT_EQ(progress_line("rendering", 0.5, 3700, 30), "rendering  50 %  1:01:40 left");
  EXPECT_EQ(progress_line("rendering", 0, 1, 40), "rendering   0 % [                     ]");
}

TEST(CliReport, ProgressFitsTheTerminal) {
  for (int columns = 32; columns < 200; ++columns)
    EXPECT_LT(progress_line("rendering", 0.5, 100, columns).size(), static_cast<std::size_t>(columns));
}

TEST(CliReport, MemoryIsMeasured) { EXPECT_GT(peak_rss_bytes(), std::size_t{1} << 20U); }

} // namespace
} // namespace fastrt::cli
