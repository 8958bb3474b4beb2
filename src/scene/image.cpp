// SPDX-License-Identifier: Apache-2.0
// Images and their mip levels. Each level is the one below it, every pixel the mean of the area it covers.
#include "src/scene/srgb_curve.hpp"

#include <fastrt/error.hpp>
#include <fastrt/texture.hpp>

#include <algorithm>

namespace fastrt {

namespace {

std::vector<float> decoding(bool srgb) {
  std::vector<float> table(512);
  for (std::size_t code = 0; code < 256; ++code) {
    const double share = static_cast<double>(code) / 255.0;
    table[code] = static_cast<float>(srgb ? linear_of_srgb(share) : share);
    table[256 + code] = static_cast<float>(share);
  }
  return table;
}

// Finds codes by their values, of which there are 256, from 0 up to 1. From where a value's place among
// `places` begins there is hardly ever a step to it: places are narrower than codes are apart.
class CodeFinder {
public:
  explicit CodeFinder(const float* values) {
    ends_[0] = -infinity;
    std::copy_n(values, 256, ends_ + 1);
    ends_[257] = infinity;
    int code = 0;
    for (int i = 0; i <= places; ++i) {
      while (code < 255 && values[code] < static_cast<float>(i) / places) ++code;
      first_[i] = static_cast<std::uint8_t>(code);
    }
  }
  // The code whose value is nearest to x; of two the greater one. x: at least 0, and little more than 1 at
  // most.
  std::uint8_t nearest(float x) const {
    const float* above = ends_ + 1 + first_[std::min(static_cast<int>(x * places), places)];
    while (*above < x) ++above;
    const bool below_is_nearer = x - above[-1] < above[0] - x;
    return static_cast<std::uint8_t>((above - ends_) - 1 - (below_is_nearer ? 1 : 0));
  }

private:
  static constexpr int places = 4096;
  float ends_[258]; // the values between one below all and one above
  std::uint8_t first_[places + 1];
};

// The mean of a channel of four pixels, of two in each of two rows; `quarter` of what its codes stand for.
float mean_of(const std::uint8_t* upper, const std::uint8_t* lower, int c, const float* quarter) {
  return ((quarter[upper[c]] + quarter[upper[4 + c]]) + quarter[lower[c]]) + quarter[lower[4 + c]];
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

// decode(at, c): the value of channel c that lies there, of the level below. The first `channels` of each
// pixel.
template <int channels, class Decode, class Store>
void Image::make_level(std::size_t i, const Decode& decode, const Store& store) {
  const Level& below = levels_[i - 1];
  const Level& level = levels_[i];
  const std::vector<Span> columns = spans(below.width, level.width);
  const std::vector<Span> rows = spans(below.height, level.height);
  std::size_t to = 4 * level.first;
  for (const Span& row : rows)
    for (const Span& column : columns) {
      float mean[channels] = {};
      for (int y = 0; y < row.count; ++y) {
        const auto pixels = static_cast<std::size_t>(row.first + y) * static_cast<std::size_t>(below.width) +
                            static_cast<std::size_t>(column.first);
        std::size_t from = 4 * (below.first + pixels);
        for (int x = 0; x < column.count; ++x, from += 4) {
          const float share = row.share[y] * column.share[x];
          for (int c = 0; c < channels; ++c) mean[c] += share * decode(from + static_cast<std::size_t>(c), c);
        }
      }
      for (int c = 0; c < channels; ++c) store(to + static_cast<std::size_t>(c), c, mean[c]);
      to += 4;
    }
}

// Most levels have half the sides of the one below: the same numbers, from shares that are all a quarter. The
// first `channels` of each pixel.
template <int channels, class Store>
void Image::make_half_level(std::size_t i, const float* quarters, const Store& store) {
  const Level& below = levels_[i - 1];
  const Level& level = levels_[i];
  const std::size_t stride = 4 * static_cast<std::size_t>(below.width);
  const std::uint8_t* row = bytes_.data() + 4 * below.first;
  std::size_t at = 4 * level.first;
  for (int y = 0; y < level.height; ++y, row += 2 * stride)
    for (int x = 0; x < level.width; ++x) {
      const std::uint8_t* const pixels = row + 8 * static_cast<std::size_t>(x);
      for (int c = 0; c < channels; ++c)
        store(at + static_cast<std::size_t>(c), c,
              mean_of(pixels, pixels + stride, c, quarters + (c == 3 ? 256 : 0)));
      at += 4;
    }
}

// All levels of bytes; what is not among the first `channels` stays.
template <int channels, class Store>
void Image::make_byte_levels(const Store& store) {
  std::vector<float> quarters(decoded_);
  for (float& value : quarters) value *= 0.25F;
  const auto decode = [&](std::size_t at, int c) { return decoded_[(c == 3 ? 256U : 0U) + bytes_[at]]; };
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level &below = levels_[i - 1], &level = levels_[i];
    if (below.width == 2 * level.width && below.height == 2 * level.height)
      make_half_level<channels>(i, quarters.data(), store);
    else
      make_level<channels>(i, decode, store);
  }
}

Image::Image(int width, int height, std::span<const std::uint8_t> rgba, bool srgb)
    : decoded_(decoding(srgb)) {
  plan_levels(width, height, rgba.size());
  const Level& last = levels_.back();
  bytes_.resize(4 * (last.first + 1), 255);
  std::copy(rgba.begin(), rgba.end(), bytes_.begin());
  for (std::size_t i = 3; i < rgba.size() && !has_alpha_; i += 4) has_alpha_ = rgba[i] != 255;
  const CodeFinder colors(decoded_.data()), alphas(decoded_.data() + 256);
  const auto store = [&](std::size_t at, int c, float value) {
    bytes_[at] = (c == 3 ? alphas : colors).nearest(value);
  };
  if (has_alpha_)
    make_byte_levels<4>(store);
  else
    make_byte_levels<3>(store);
}

Image::Image(int width, int height, std::span<const float> rgba) {
  plan_levels(width, height, rgba.size());
  floats_.resize(4 * (levels_.back().first + 1));
  std::transform(rgba.begin(), rgba.end(), floats_.begin(),
                 [](float x) { return x > 0.0F && x < infinity ? x : 0.0F; });
  for (std::size_t i = 3; i < rgba.size() && !has_alpha_; i += 4) has_alpha_ = floats_[i] != 1.0F;
  for (std::size_t i = 1; i < levels_.size(); ++i)
    make_level<4>(
        i, [this](std::size_t at, int) { return floats_[at]; },
        [this](std::size_t at, int, float value) { floats_[at] = value; });
}

} // namespace fastrt
