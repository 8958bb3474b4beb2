// SPDX-License-Identifier: Apache-2.0
#include "src/film/frame.hpp"

#include <fastrt/error.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace fastrt {
namespace {

RenderSettings sized(int width, int height, int samples = 1) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.samples_per_pixel = samples;
  return settings;
}

TEST(RenderSettings, HaveRanges) {
  EXPECT_NO_THROW(check(sized(1, 1)));
  EXPECT_NO_THROW(check(sized(65536, 65536)));
  EXPECT_THROW(check(sized(0, 1)), UsageError);
  EXPECT_THROW(check(sized(1, 0)), UsageError);
  EXPECT_THROW(check(sized(-5, 10)), UsageError);
  EXPECT_THROW(check(sized(65537, 1)), UsageError);
  EXPECT_THROW(check(sized(1, 65537)), UsageError);
  EXPECT_THROW(check(sized(1, 1, 0)), UsageError);
  for (const int depth : {-1, 65}) {
    RenderSettings settings = sized(1, 1);
    settings.max_depth = depth;
    EXPECT_THROW(check(settings), UsageError);
  }
  for (const float contribution : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN()}) {
    RenderSettings settings = sized(1, 1);
    settings.min_contribution = contribution;
    EXPECT_THROW(check(settings), UsageError);
  }
  RenderSettings unknown = sized(1, 1);
  unknown.aovs = {Aov::depth, static_cast<Aov>(aov_count)};
  EXPECT_THROW(check(unknown), UsageError);
}

TEST(BlackFrame, SeesNothing) {
  const Frame frame = black_frame(3, 2);
  EXPECT_EQ(frame.width, 3);
  EXPECT_EQ(frame.height, 2);
  EXPECT_EQ(frame.rgb, Column<float>(18, 0.0F));
  EXPECT_EQ(frame.primitive, Column<std::int32_t>(6, no_primitive));
  EXPECT_EQ(frame.rays.total(), 0U);
}

TEST(FrameProgress, CountsPartsAndRays) {
  std::vector<double> shares;
  RenderSettings settings;
  settings.progress = [&](double share) { shares.push_back(share); };
  FrameProgress progress(settings, 4);
  for (std::uint64_t i = 1; i <= 4; ++i) progress.part_done({i, 10 * i, 100 * i, 1000 * i});
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
  Frame frame = black_frame(1, 1);
  progress.finish(frame);
  EXPECT_TRUE(frame.complete);
  EXPECT_EQ(frame.rays.primary, 10U);
  EXPECT_EQ(frame.rays.shadow, 100U);
  EXPECT_EQ(frame.rays.reflected, 1000U);
  EXPECT_EQ(frame.rays.refracted, 10000U);
  EXPECT_EQ(frame.rays.total(), 11110U);
}

TEST(FrameProgress, StopsWhenCancelled) {
  std::atomic<bool> cancelled{false};
  RenderSettings settings;
  settings.cancelled = &cancelled;
  FrameProgress progress(settings, 2);
  EXPECT_FALSE(progress.stopped());
  progress.part_done({});
  cancelled = true;
  EXPECT_TRUE(progress.stopped());
  cancelled = false;
  EXPECT_TRUE(progress.stopped()); // for good
  Frame frame = black_frame(1, 1);
  progress.finish(frame);
  EXPECT_FALSE(frame.complete);
}

TEST(FrameProgress, ThrowsTheFirstFailure) {
  const RenderSettings settings;
  FrameProgress progress(settings, 3);
  progress.failed(std::make_exception_ptr(std::runtime_error("first")));
  progress.failed(std::make_exception_ptr(std::runtime_error("second")));
  EXPECT_TRUE(progress.stopped());
  Frame frame = black_frame(1, 1);
  try {
    progress.finish(frame);
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "first");
  }
}

TEST(CompareFrames, FindsNothingInEqualOnes) {
  const FrameDifference none = compare(black_frame(4, 4), black_frame(4, 4));
  EXPECT_EQ(none.pixels, 0U);
  EXPECT_EQ(none.primitives, 0U);
  EXPECT_EQ(none.largest, 0.0);
}

TEST(CompareFrames, CountsPixelsNotChannels) {
  const Frame a = black_frame(4, 4);
  Frame b = a;
  b.rgb[0] = 0.5F;
  b.rgb[2] = 0.25F;
  b.rgb[47] = std::nextafter(0.0F, 1.0F);
  b.primitive[7] = 3;
  const FrameDifference difference = compare(a, b);
  EXPECT_EQ(difference.pixels, 2U);
  EXPECT_EQ(difference.primitives, 1U);
  EXPECT_EQ(difference.largest, 0.5);
}

TEST(CompareFrames, CountsPixelsWithOtherAovs) {
  const Frame a = black_frame(3, 1, {Aov::normal, Aov::id, Aov::normal});
  ASSERT_EQ(a.aovs.size(), 2U); // each once
  Frame b = a;
  b.aovs[0].values[0] = 1;
  b.aovs[0].values[1] = 1;
  b.aovs[0].values[3] = -0.0F; // equal
  b.aovs[1].ids[0] = 5;
  b.aovs[1].ids[2] = 7;
  EXPECT_EQ(compare(a, b).aovs, 2U);
  EXPECT_FALSE(compare(a, b).equal());
  EXPECT_TRUE(compare(a, a).equal());
  EXPECT_EQ(compare(a, black_frame(3, 1)).aovs, 3U);
}

TEST(CompareFrames, TheSignOfZeroIsADifference) {
  const Frame a = black_frame(1, 1);
  Frame b = a;
  b.rgb[1] = -0.0F;
  EXPECT_EQ(compare(a, b).pixels, 1U);
}

TEST(CompareFrames, RefusesOtherSizesAndFormats) {
  EXPECT_THROW(compare(black_frame(4, 4), black_frame(2, 8)), UsageError);
  EXPECT_THROW(compare(black_frame(4, 4), black_frame(4, 5)), UsageError);
  EXPECT_THROW(compare(black_frame(4, 4), make_srgb8_frame(4, 4)), UsageError);
  EXPECT_THROW(compare(make_srgb8_frame(4, 4), black_frame(4, 4)), UsageError);
}

} // namespace
} // namespace fastrt
