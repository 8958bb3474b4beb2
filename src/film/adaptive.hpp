// SPDX-License-Identifier: Apache-2.0
// Adaptive sampling: which pixels get more samples (docs/numerics.md, "Adaptive sampling"). All pixels of a
// round are done before the next begins, so neither threads nor tiles have a say.
#pragma once

#include "src/film/sampling.hpp"

#include <fastrt/column.hpp>
#include <fastrt/render.hpp>

#include <cstdint>

namespace fastrt {

// The rounds that there may be after the first.
int most_rounds(const RenderSettings& settings);

// The part of the picture to render so that `part_of(settings)` comes out as in the whole picture: what a
// pixel gets depends on as many pixels around it as there are rounds.
Crop part_with_margin(const RenderSettings& settings);

// The sums of samples that a frame grows from.
class AdaptiveFilm {
public:
  // frame: of the size of part_with_margin().
  AdaptiveFilm(const RenderSettings& settings, const Filter& filter, Frame& frame);

  // To be added now: samples first() .. last() - 1 of the pixels that are active (1).
  int first() const noexcept { return first_; }
  int last() const noexcept { return last_; }
  const Column<std::uint8_t>& active() const noexcept { return active_; }
  // Three floats a pixel: of the samples, and of those in lobes.
  Column<float>& sum() noexcept { return sum_; }
  Column<float>& lobe_sum() noexcept { return lobe_sum_; }

  // After a round: puts the pixels' colours and counts into the frame and picks those of the next round.
  // False if there are none.
  bool next_round();

private:
  void resolve();
  bool differs(int x, int y) const;
  bool mark_row(int y, Column<std::uint8_t>& next) const;

  const RenderSettings* settings_;
  Filter filter_;
  Frame* frame_;
  int most_, first_ = 0, last_;
  Column<std::uint8_t> active_;
  Column<float> sum_, lobe_sum_;
  Column<float> look_; // the colours as the eye sees them
};

// The part `inner` of a frame that shows `outer`.
Frame cut_out(Frame frame, const Crop& outer, const Crop& inner);

} // namespace fastrt
