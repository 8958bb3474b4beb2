// SPDX-License-Identifier: Apache-2.0
#include "src/film/adaptive.hpp"

#include "src/film/frame.hpp"
#include "src/film/parallel_fill.hpp"
#include "src/scene/threads.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace fastrt {
namespace {

int most_samples(const RenderSettings& settings) {
  if (settings.most_samples != 0) return settings.most_samples;
  constexpr int highest = 1 << 30;
  return settings.samples_per_pixel > highest / 16 ? highest : 16 * settings.samples_per_pixel;
}

// How bright a channel looks: 0 to 1.
float look(float channel) { return std::sqrt(std::min(std::max(channel, 0.0F), 1.0F)); }

template <class Values>
void cut_rows(Values& values, std::size_t channels, const Crop& outer, const Crop& inner) {
  const auto outer_width = static_cast<std::size_t>(outer.x1 - outer.x0);
  const auto width = static_cast<std::size_t>(inner.x1 - inner.x0);
  const auto x0 = static_cast<std::size_t>(inner.x0 - outer.x0);
  const auto y0 = static_cast<std::size_t>(inner.y0 - outer.y0);
  const auto height = static_cast<std::size_t>(inner.y1 - inner.y0);
  if (values.empty()) return;
  for (std::size_t y = 0; y < height; ++y) {
    const auto* const from = values.data() + channels * ((y0 + y) * outer_width + x0);
    std::copy(from, from + channels * width, values.data() + channels * y * width);
  }
  values.resize(channels * width * height);
}

} // namespace

int most_rounds(const RenderSettings& settings) {
  if (settings.adaptive == 0.0F) return 0;
  int rounds = 0;
  for (std::int64_t count = settings.samples_per_pixel; count < most_samples(settings); count *= 2) ++rounds;
  return rounds;
}

Crop part_with_margin(const RenderSettings& settings) {
  const Crop part = part_of(settings);
  const int margin = most_rounds(settings);
  return {std::max(part.x0 - margin, 0), std::max(part.y0 - margin, 0),
          std::min(part.x1 + margin, settings.width), std::min(part.y1 + margin, settings.height)};
}

AdaptiveFilm::AdaptiveFilm(const RenderSettings& settings, const Filter& filter, Frame& frame)
    : settings_(&settings), filter_(filter), frame_(&frame), most_(most_samples(settings)),
      last_(settings.samples_per_pixel) {
  const std::size_t pixels = frame.primitive.size();
  fill(active_, pixels, std::uint8_t{1}, settings.threads);
  fill(sum_, 3 * pixels, 0.0F, settings.threads);
  fill(look_, 3 * pixels, 0.0F, settings.threads);
  if (filter.negative != 0.0F) fill(lobe_sum_, 3 * pixels, 0.0F, settings.threads);
  fill(frame.samples, pixels, 0, settings.threads);
}

void AdaptiveFilm::resolve() {
  const SampleWeights weights = sample_weights(filter_, static_cast<std::uint32_t>(last_));
  const auto pixels = static_cast<std::ptrdiff_t>(active_.size());
#pragma omp parallel for schedule(static) num_threads(thread_count(settings_->threads))
  for (std::ptrdiff_t i = 0; i < pixels; ++i) {
    const auto pixel = static_cast<std::size_t>(i);
    if (active_[pixel] == 0) continue;
    frame_->samples[pixel] = last_;
    for (std::size_t c = 3 * pixel; c < 3 * pixel + 3; ++c) {
      frame_->rgb[c] = resolve_channel(weights, sum_[c], lobe_sum_.empty() ? 0.0F : lobe_sum_[c]);
      look_[c] = look(frame_->rgb[c]);
    }
  }
}

bool AdaptiveFilm::differs(int x, int y) const {
  const auto at = [&](int column, int row) {
    return 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(frame_->width) +
                static_cast<std::size_t>(column));
  };
  const float* const own = &look_[at(x, y)];
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, frame_->height - 1); ++row)
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, frame_->width - 1); ++column) {
      const float* const other = &look_[at(column, row)];
      for (int c = 0; c < 3; ++c)
        if (std::fabs(other[c] - own[c]) > settings_->adaptive) return true;
    }
  return false;
}

// Who has once been left out stays so: the samples that a pixel has are always the first ones.
bool AdaptiveFilm::mark_row(int y, Column<std::uint8_t>& next) const {
  bool any = false;
  for (int x = 0; x < frame_->width; ++x) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_->width) + static_cast<std::size_t>(x);
    if (active_[pixel] == 0 || !differs(x, y)) continue;
    next[pixel] = 1;
    any = true;
  }
  return any;
}

bool AdaptiveFilm::next_round() {
  resolve();
  first_ = last_;
  last_ = first_ > most_ / 2 ? most_ : 2 * first_;
  if (first_ == last_) return false;
  bool any = false;
  Column<std::uint8_t> next(active_.size(), 0);
#pragma omp parallel for schedule(static) num_threads(thread_count(settings_->threads)) reduction(|| : any)
  for (int y = 0; y < frame_->height; ++y) any = mark_row(y, next) || any;
  active_ = std::move(next);
  return any;
}

Frame cut_out(Frame frame, const Crop& outer, const Crop& inner) {
  cut_rows(frame.rgb, 3, outer, inner);
  cut_rows(frame.primitive, 1, outer, inner);
  cut_rows(frame.samples, 1, outer, inner);
  for (AovPlane& plane : frame.aovs) {
    const auto channels = static_cast<std::size_t>(aov_info(plane.aov).channels);
    cut_rows(plane.values, channels, outer, inner);
    cut_rows(plane.ids, channels, outer, inner);
  }
  frame.width = inner.x1 - inner.x0;
  frame.height = inner.y1 - inner.y0;
  return frame;
}

} // namespace fastrt
