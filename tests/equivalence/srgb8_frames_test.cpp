// SPDX-License-Identifier: Apache-2.0
// Frames of 8-bit codes: what becomes of the linear frame, whichever way they are made.
#include "src/film/srgb.hpp"
#include "tests/equivalence/designed_shots.hpp"
#include "tests/equivalence/random_shots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace fastrt::test {
namespace {

RenderSettings as_codes(RenderSettings settings) {
  settings.pixel_format = PixelFormat::srgb8;
  return settings;
}

void expect_codes_of(const Frame& linear, const Frame& found, const std::string& what) {
  Column<unsigned char> codes(linear.rgb.size());
  to_srgb8(linear.rgb.data(), codes.size(), codes.data());
  EXPECT_EQ(found.srgb8, codes) << what;
  EXPECT_TRUE(found.rgb.empty() && found.primitive.empty()) << what;
  EXPECT_TRUE(linear.srgb8.empty()) << what;
  EXPECT_EQ(found.width, linear.width) << what;
  EXPECT_EQ(found.height, linear.height) << what;
  EXPECT_EQ(found.rays.total(), linear.rays.total()) << what;
  EXPECT_EQ(found.samples, linear.samples) << what;
  EXPECT_EQ(found.aovs.size(), linear.aovs.size()) << what;
  EXPECT_TRUE(found.complete) << what;
}

void expect_codes(const Shot& shot) {
  for (const Isa isa : available_isas()) {
    const Tracer tracer = make_tracer(shot.scene, isa);
    expect_codes_of(render(tracer, shot.camera, shot.settings),
                    render(tracer, shot.camera, as_codes(shot.settings)), shot.name + ", " + isa_word(isa));
  }
}

Shot changed(Shot shot, const char* how, void (*change)(RenderSettings& settings)) {
  shot.name += std::string(", ") + how;
  change(shot.settings);
  return shot;
}

TEST(Srgb8Frames, AreTheCodesOfLinearOnes) {
  for (const Shot& shot : {mirrors("mirrors", 4, 0), coloured_shadows()}) {
    expect_codes(shot);
    expect_codes(changed(shot, "small", [](RenderSettings& s) { s.width = s.height = 3; }));
    expect_codes(changed(shot, "odd", [](RenderSettings& s) { s.width = 45, s.height = 33; }));
    expect_codes(changed(shot, "samples", [](RenderSettings& s) { s.samples_per_pixel = 3; }));
    expect_codes(changed(shot, "crop", [](RenderSettings& s) {
      s.width = 61, s.height = 47, s.crop = Crop{5, 3, 41, 30};
    }));
  }
}

TEST(Srgb8Frames, AreMadeOfFramesThatNeedMore) {
  const Shot shot = mirrors("mirrors", 4, 0);
  expect_codes(changed(shot, "adaptive", [](RenderSettings& s) {
    s.samples_per_pixel = 2, s.adaptive = 0.05F, s.crop = Crop{1, 2, 20, 17};
  }));
  expect_codes(changed(shot, "AOVs", [](RenderSettings& s) { s.aovs = {Aov::depth, Aov::id}; }));
  expect_codes(changed(shot, "forward",
                       [](RenderSettings& s) { s.integrator = Integrator::forward, s.photons = 3000; }));
  expect_codes_of(render_reference(shot.scene, shot.camera, shot.settings),
                  render_reference(shot.scene, shot.camera, as_codes(shot.settings)), "reference");
}

TEST(Srgb8Frames, DifferByTheirCodes) {
  const Shot shot = mirrors("mirrors", 4, 0);
  const Frame frame = render_reference(shot.scene, shot.camera, as_codes(shot.settings));
  EXPECT_TRUE(compare(frame, frame).equal());
  Frame other = frame;
  other.srgb8[4] = static_cast<unsigned char>(other.srgb8[4] ^ 1U);
  const FrameDifference difference = compare(frame, other);
  EXPECT_EQ(difference.pixels, 1U);
  EXPECT_DOUBLE_EQ(difference.largest, 1.0 / 255);
}

TEST(Srgb8Frames, AreBlackWhereNothingWasDone) {
  const Shot shot = mirrors("mirrors", 4, 0);
  RenderSettings settings = as_codes(shot.settings);
  settings.width = settings.height = 70;
  settings.threads = 1;
  std::atomic<bool> cancelled{false};
  settings.cancelled = &cancelled;
  settings.progress = [&](double) { cancelled = true; };
  const Frame frame = render(make_tracer(shot.scene, Isa::sse42), shot.camera, settings);
  EXPECT_FALSE(frame.complete);
  ASSERT_EQ(frame.srgb8.size(), 3U * 70 * 70);
  for (std::size_t row = 0; row < 70; ++row) {
    const auto begin = frame.srgb8.begin() + 3 * (70 * row + (row < 16 ? 16 : 0)),
               end = frame.srgb8.begin() + 3 * 70 * (row + 1);
    EXPECT_TRUE(std::all_of(begin, end, [](unsigned char code) { return code == 0; })) << row;
  }
}

} // namespace
} // namespace fastrt::test
