// SPDX-License-Identifier: Apache-2.0
// Images and their mip levels. Each level is the one below it, every pixel the mean of the area it covers.
#include <fastrt/error.hpp>
#include <fastrt/texture.hpp>

#include <algorithm>
#include <cmath>

namespace fastrt {

namespace {

double linear_of(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

std::vector<float> decoding(bool srgb) {
  std::vector<float> table(512);
  for (std::size_t code = 0; code < 256; ++code) {
    const double share = static_cast<double>(code) / 255.0;
    table[code] = static_cast<float>(srgb ? linear_of(share) : share);
    table[256 + code] = static_cast<float>(share);
  }
  return table;
}

// Finds codes by their values, of which there are 256, from 0 up to 1. From where a value's place among
// `places` begins there are few steps to it.
class CodeFinder {
public:
  explicit CodeFinder(const float* values) : values_(values) {
    for (int i = 0; i <= places; ++i)
      first_[i] = static_cast<std::uint8_t>(
          std::lower_bound(values, values + 255, static_cast<float>(i) / places) - values);
  }
  // The code whose value is nearest to x; of two the greater one. x: at least 0, and little more than 1 at
  // most.
  std::uint8_t nearest(float x) const {
    const float* above = values_ + first_[std::min(static_cast<int>(x * places), places)];
    while (above != values_ + 255 && *above < x) ++above;
    if (above != values_ && x - above[-1] < above[0] - x) --above;
    return static_cast<std::uint8_t>(above - values_);
  }

private:
  static constexpr int places = 1024;
  const float* values_;
  std::uint8_t first_[places + 1];
};

// The mean of four pixels, of two in each of two rows; `quarters` of what their codes stand for.
glm::vec4 mean_of(const std::uint8_t* upper, const std::uint8_t* lower, const float* quarters) {
  glm::vec4 mean;
  for (int c = 0; c < 4; ++c) {
    const float* const quarter = quarters + (c == 3 ? 256 : 0);
    mean[c] = ((quarter[upper[c]] + quarter[upper[4 + c]]) + quarter[lower[c]]) + quarter[lower[4 + c]];
  }
  return mean;
}

// The pixels of one side of the level below that one pixel covers: two, or where the side is odd up to three,
// the outer ones in part.
struct Span {
  int first;
  int count;
  float share[3];
};

std::vector<Span> spans(int below, int size) {
  std::vector<Span> result;
  const double step = static_cast<double>(below) / size;
  for (int i = 0; i < size; ++i) {
    const double begin = i * step, end = std::min((i + 1) * step, static_cast<double>(below));
    Span span{static_cast<int>(begin), 0, {}};
    for (int k = span.first; k < below && span.count < 3 && k < end; ++k)
      span.share[span.count++] =
          static_cast<float>((std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k))) / step);
    result.push_back(span);
  }
  return result;
}

} // namespace

void Image::plan_levels(int width, int height, std::size_t given) {
  if (width < 1 || height < 1 || width > max_image_side || height > max_image_side)
    throw InputError("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels is not within 1.." + std::to_string(max_image_side));
  std::size_t pixels = 0;
  for (;;) {
    levels_.push_back({width, height, pixels});
    pixels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (levels_.size() == 1 && given != 4 * pixels)
      throw InputError("an image takes four values for each pixel");
    if (width == 1 && height == 1) return;
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
}

glm::vec4 Image::pixel(std::size_t level, int x, int y) const {
  const Level& l = levels_[level];
  const std::size_t at = 4 * (l.first + static_cast<std::size_t>(y) * static_cast<std::size_t>(l.width) +
                              static_cast<std::size_t>(x));
  if (bytes_.empty()) return {floats_[at], floats_[at + 1], floats_[at + 2], floats_[at + 3]};
  return {decoded_[bytes_[at]], decoded_[bytes_[at + 1]], decoded_[bytes_[at + 2]],
          decoded_[256U + bytes_[at + 3]]};
}

template <class Store>
void Image::make_level(std::size_t i, const Store& store) {
  const Level& below = levels_[i - 1];
  const Level& level = levels_[i];
  const std::vector<Span> columns = spans(below.width, level.width);
  const std::vector<Span> rows = spans(below.height, level.height);
  std::size_t at = 4 * level.first;
  for (const Span& row : rows)
    for (const Span& column : columns) {
      glm::vec4 mean(0.0F);
      for (int y = 0; y < row.count; ++y)
        for (int x = 0; x < column.count; ++x)
          mean += (row.share[y] * column.share[x]) * pixel(i - 1, column.first + x, row.first + y);
      for (int c = 0; c < 4; ++c) store(at++, c, mean[c]);
    }
}

// Most levels have half the sides of the one below: the same numbers, from shares that are all a quarter.
template <class Store>
void Image::make_half_level(std::size_t i, const float* quarters, const Store& store) {
  const Level& below = levels_[i - 1];
  const Level& level = levels_[i];
  const std::size_t stride = 4 * static_cast<std::size_t>(below.width);
  const std::uint8_t* row = bytes_.data() + 4 * below.first;
  std::size_t at = 4 * level.first;
  for (int y = 0; y < level.height; ++y, row += 2 * stride)
    for (int x = 0; x < level.width; ++x) {
      const std::uint8_t* const pixels = row + 8 * static_cast<std::size_t>(x);
      const glm::vec4 mean = mean_of(pixels, pixels + stride, quarters);
      for (int c = 0; c < 4; ++c) store(at++, c, mean[c]);
    }
}

Image::Image(int width, int height, std::span<const std::uint8_t> rgba, bool srgb)
    : decoded_(decoding(srgb)) {
  plan_levels(width, height, rgba.size());
  const Level& last = levels_.back();
  bytes_.resize(4 * (last.first + 1));
  std::copy(rgba.begin(), rgba.end(), bytes_.begin());
  for (std::size_t i = 3; i < rgba.size() && !has_alpha_; i += 4) has_alpha_ = rgba[i] != 255;
  const CodeFinder colors(decoded_.data()), alphas(decoded_.data() + 256);
  const auto store = [&](std::size_t at, int c, float value) {
    bytes_[at] = (c == 3 ? alphas : colors).nearest(value);
  };
  std::vector<float> quarters(decoded_);
  for (float& value : quarters) value *= 0.25F;
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level &below = levels_[i - 1], &level = levels_[i];
    if (below.width == 2 * level.width && below.height == 2 * level.height)
      make_half_level(i, quarters.data(), store);
    else
      make_level(i, store);
  }
}

Image::Image(int width, int height, std::span<const float> rgba) {
  plan_levels(width, height, rgba.size());
  floats_.resize(4 * (levels_.back().first + 1));
  std::transform(rgba.begin(), rgba.end(), floats_.begin(),
                 [](float x) { return x > 0.0F && x < infinity ? x : 0.0F; });
  for (std::size_t i = 3; i < rgba.size() && !has_alpha_; i += 4) has_alpha_ = floats_[i] != 1.0F;
  for (std::size_t i = 1; i < levels_.size(); ++i)
    make_level(i, [this](std::size_t at, int, float value) { floats_[at] = value; });
}

} // namespace fastrt
