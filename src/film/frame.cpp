// SPDX-License-Identifier: Apache-2.0
#include "src/film/frame.hpp"

#include "src/film/parallel_fill.hpp"
#include "src/film/srgb.hpp"
#include "src/scene/picture_limits.hpp"
#include "src/scene/threads.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace fastrt {

namespace {

void check_photons(const RenderSettings& settings) {
  if (settings.photons < 1 || settings.photons > most_photons)
    throw UsageError("the photons must be from 1 to 2^30, not " + std::to_string(settings.photons));
  if (settings.caustic_photons < 0 || settings.caustic_photons > most_caustic_photons)
    throw UsageError("the photons of caustics must be from 0 to " + std::to_string(most_caustic_photons) +
                     ", not " + std::to_string(settings.caustic_photons));
  if (!(settings.caustic_radius >= 0.0F && std::isfinite(settings.caustic_radius)))
    throw UsageError("the radius of caustics must not be negative");
  if (settings.integrator != Integrator::forward) return;
  if (settings.caustic_photons != 0)
    throw UsageError("the forward integrator makes caustics by itself: there are none to add");
  if (settings.adaptive > 0.0F)
    throw UsageError("the forward integrator takes no samples of pixels: there is nothing to adapt");
}

void check_bounces(const RenderSettings& settings) {
  if (settings.max_depth < 0 || settings.max_depth > most_bounces)
    throw UsageError("the depth must be from 0 to " + std::to_string(most_bounces) + " bounces, not " +
                     std::to_string(settings.max_depth));
  if (!(settings.min_contribution >= 0.0F && settings.min_contribution <= 1.0F))
    throw UsageError("the least contribution must be from 0 to 1");
}

} // namespace

void check(const RenderSettings& settings) {
  if (settings.width < 1 || settings.width > most_pixels_a_side || settings.height < 1 ||
      settings.height > most_pixels_a_side)
    throw UsageError("picture size " + std::to_string(settings.width) + "x" +
                     std::to_string(settings.height) + " is not within 1.." +
                     std::to_string(most_pixels_a_side));
  if (settings.samples_per_pixel < 1)
    throw UsageError("samples per pixel must be at least 1, not " +
                     std::to_string(settings.samples_per_pixel));
  const Crop part = part_of(settings);
  if (part.x0 < 0 || part.y0 < 0 || part.x0 >= part.x1 || part.y0 >= part.y1 || part.x1 > settings.width ||
      part.y1 > settings.height)
    throw UsageError("the crop " + std::to_string(part.x0) + "," + std::to_string(part.y0) + "," +
                     std::to_string(part.x1) + "," + std::to_string(part.y1) +
                     " is no part of a picture of " + std::to_string(settings.width) + "x" +
                     std::to_string(settings.height));
  if (!(settings.adaptive >= 0.0F && settings.adaptive <= 1.0F))
    throw UsageError("the threshold of adaptive sampling must be from 0 to 1");
  if (settings.most_samples != 0 && settings.most_samples < settings.samples_per_pixel)
    throw UsageError("at most " + std::to_string(settings.most_samples) + " samples are less than the " +
                     std::to_string(settings.samples_per_pixel) + " of each pixel");
  if (settings.light_samples < 1 || settings.light_samples > most_light_samples)
    throw UsageError("light samples must be from 1 to " + std::to_string(most_light_samples) + ", not " +
                     std::to_string(settings.light_samples));
  check_bounces(settings);
  check_photons(settings);
  for (const Aov aov : settings.aovs)
    if (static_cast<std::size_t>(aov) >= aov_count) throw UsageError("unknown AOV");
}

Crop part_of(const RenderSettings& settings) {
  return settings.crop.value_or(Crop{0, 0, settings.width, settings.height});
}

namespace {

// An AOV of which nothing is seen.
AovPlane empty_plane(Aov aov, std::size_t pixels, int threads) {
  const AovInfo& info = aov_info(aov);
  const std::size_t count = pixels * static_cast<std::size_t>(info.channels);
  AovPlane plane{aov, {}, {}};
  if (info.integer)
    fill(plane.ids, count, aov == Aov::recursion || aov == Aov::cost ? 0 : no_primitive, threads);
  else
    fill(plane.values, count, aov == Aov::depth ? infinity : 0.0F, threads);
  return plane;
}

// Zeros are equal whatever their sign, as in docs/numerics.md.
bool differs(float a, float b) { return a != b && !(std::isnan(a) && std::isnan(b)); }

bool differs(const AovPlane& a, const AovPlane& b, std::size_t pixel) {
  const auto channels = static_cast<std::size_t>(aov_info(a.aov).channels);
  for (std::size_t i = channels * pixel; i < channels * (pixel + 1); ++i)
    if (a.ids.empty() ? differs(a.values[i], b.values[i]) : a.ids[i] != b.ids[i]) return true;
  return false;
}

void compare_linear(const Frame& a, const Frame& b, std::size_t pixel, FrameDifference& difference) {
  if (std::memcmp(&a.rgb[3 * pixel], &b.rgb[3 * pixel], 3 * sizeof(float)) != 0) ++difference.pixels;
  for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
    const double channel = std::fabs(static_cast<double>(a.rgb[c]) - static_cast<double>(b.rgb[c]));
    if (channel > difference.largest) difference.largest = channel;
  }
  if (a.primitive[pixel] != b.primitive[pixel]) ++difference.primitives;
}

void compare_codes(const Frame& a, const Frame& b, std::size_t pixel, FrameDifference& difference) {
  if (std::memcmp(&a.srgb8[3 * pixel], &b.srgb8[3 * pixel], 3) != 0) ++difference.pixels;
  for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c)
    difference.largest = std::max(difference.largest, std::abs(a.srgb8[c] - b.srgb8[c]) / 255.0);
}

void add(const TestCounts& tests, TestCounts& to) {
  to.boxes += tests.boxes;
  to.primitives += tests.primitives;
}

} // namespace

const AovPlane* Frame::find(Aov aov) const noexcept {
  for (const AovPlane& plane : aovs)
    if (plane.aov == aov) return &plane;
  return nullptr;
}

Frame make_frame(int width, int height, const std::vector<Aov>& aovs, int threads) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  frame.rgb.resize(3 * pixels);
  frame.primitive.resize(pixels);
  for (const Aov aov : aovs)
    if (frame.find(aov) == nullptr) frame.aovs.push_back(empty_plane(aov, pixels, threads));
  return frame;
}

Frame make_srgb8_frame(int width, int height) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  frame.srgb8.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return frame;
}

void keep_pixels(const RenderSettings& settings, Frame& frame) {
  if (settings.pixel_format != PixelFormat::srgb8 || !frame.srgb8.empty()) return;
  const std::size_t row = 3 * static_cast<std::size_t>(frame.width);
  frame.srgb8.resize(frame.rgb.size());
#pragma omp parallel for schedule(static) num_threads(thread_count(settings.threads))
  for (int y = 0; y < frame.height; ++y) {
    const std::size_t begin = static_cast<std::size_t>(y) * row;
    to_srgb8(frame.rgb.data() + begin, row, frame.srgb8.data() + begin);
  }
  frame.rgb = {};
  frame.primitive = {};
}

Frame black_frame(int width, int height, const std::vector<Aov>& aovs, int threads) {
  Frame frame = make_frame(width, height, aovs, threads);
  fill(frame.rgb, frame.rgb.size(), 0.0F, threads);
  fill(frame.primitive, frame.primitive.size(), no_primitive, threads);
  return frame;
}

bool FrameProgress::stopped() {
  if (settings_->cancelled != nullptr && settings_->cancelled->load(std::memory_order_relaxed))
    stopped_ = true;
  return stopped_;
}

void FrameProgress::part_done(const RayCounts& rays, const RayTests& tests) {
  const std::lock_guard lock(mutex_);
  rays_ += rays;
  add(tests.primary, tests_.primary);
  add(tests.shadow, tests_.shadow);
  add(tests.secondary, tests_.secondary);
  ++parts_done_;
  if (settings_->progress) settings_->progress(static_cast<double>(parts_done_) / parts_);
}

void FrameProgress::rest_is_done() {
  const std::lock_guard lock(mutex_);
  if (!stopped_) parts_done_ = parts_;
}

void FrameProgress::failed(std::exception_ptr error) {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  if (!error_) error_ = std::move(error);
}

void FrameProgress::finish(Frame& frame) {
  if (error_) std::rethrow_exception(error_);
  frame.rays = rays_;
  frame.tests = tests_;
  frame.complete = parts_done_ == parts_;
  const Crop part = part_of(*settings_);
  frame.x = part.x0;
  frame.y = part.y0;
  frame.whole_width = settings_->width;
  frame.whole_height = settings_->height;
}

FrameDifference compare(const Frame& a, const Frame& b) {
  if (a.width != b.width || a.height != b.height || a.rgb.size() != b.rgb.size() ||
      a.srgb8.size() != b.srgb8.size())
    throw UsageError("frames of different sizes or pixel formats can't be compared");
  FrameDifference difference;
  const std::size_t pixels = static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    if (a.rgb.empty())
      compare_codes(a, b, pixel, difference);
    else
      compare_linear(a, b, pixel, difference);
    for (const AovPlane& plane : a.aovs) {
      const AovPlane* other = b.find(plane.aov);
      if (other != nullptr && !differs(plane, *other, pixel)) continue;
      ++difference.aovs;
      break;
    }
  }
  return difference;
}

} // namespace fastrt
