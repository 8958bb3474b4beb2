// SPDX-License-Identifier: Apache-2.0
// What every way of making a frame shares: its settings' ranges, its memory, its progress.
#pragma once

#include <fastrt/render.hpp>

#include <atomic>
#include <exception>
#include <mutex>

namespace fastrt {

// Throws UsageError for settings out of their ranges.
void check(const RenderSettings& settings);

// The part of the picture that is made, all of it without a crop.
Crop part_of(const RenderSettings& settings);

// A frame's memory; its colours and primitives are for the threads to fill, who so touch it first.
Frame make_frame(int width, int height, const std::vector<Aov>& aovs, int threads);

// One that keeps codes alone.
Frame make_srgb8_frame(int width, int height);

// Makes codes of a frame's linear pixels, which are let go, if that is what the settings ask for and there
// are none yet.
void keep_pixels(const RenderSettings& settings, Frame& frame);

// A black frame that sees nothing, with the AOVs that are asked for.
Frame black_frame(int width, int height, const std::vector<Aov>& aovs = {}, int threads = 1);

// How far a frame is, shared by the threads that make it in `parts` parts (rows or tiles).
class FrameProgress {
public:
  FrameProgress(const RenderSettings& settings, int parts) : settings_(&settings), parts_(parts) {}

  // Whether to leave the remaining parts out: cancelled, or a part failed.
  bool stopped();
  void part_done(const RayCounts& rays, const RayTests& tests = {});
  // Keeps the first exception; finish() throws it.
  void failed(std::exception_ptr error);
  // The parts that are left turned out to be needless.
  void rest_is_done();
  // Fills in the frame's counts, whether it is complete, and where it lies in the whole picture.
  void finish(Frame& frame);

private:
  const RenderSettings* settings_;
  int parts_;
  std::mutex mutex_;
  RayCounts rays_;
  RayTests tests_;
  int parts_done_ = 0;
  std::atomic<bool> stopped_{false};
  std::exception_ptr error_;
};

} // namespace fastrt
