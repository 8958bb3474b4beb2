// SPDX-License-Identifier: Apache-2.0
// AOVs as channels of one file, and as pictures.
#include "src/film/srgb.hpp"
#include "src/write/formats.hpp"

#include <fastrt/write.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace fastrt {
namespace {

bool counts_from_0(Aov aov) { return aov == Aov::id || aov == Aov::primitive || aov == Aov::material; }

// What files hold for an integer: ids from 1, so that 0 is the background.
std::uint32_t stored_id(Aov aov, std::int32_t id) {
  return static_cast<std::uint32_t>(id) + (counts_from_0(aov) ? 1U : 0U);
}

std::size_t pixel_count(const AovPlane& plane) {
  return std::max(plane.ids.size(), plane.values.size()) /
         static_cast<std::size_t>(aov_info(plane.aov).channels);
}

// The finite numbers of a plane lie within these; 0 and 1 if there are none.
struct Range {
  float low = infinity, high = -infinity;
  void add(float x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  // 0 at the low end, 1 at the high one.
  float place(float x) const { return high > low ? (x - low) / (high - low) : 0.0F; }
};

// A number from 0 to 1 as the linear light whose sRGB code is 255 times it.
float light_of_share(float share) {
  static const std::array<float, 256> lights = [] {
    std::array<float, 256> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = linear_of_srgb8(static_cast<unsigned char>(i));
    return all;
  }();
  const float code = std::floor(255.0F * share + 0.5F);
  return lights[static_cast<std::size_t>(code >= 0.0F ? std::min(code, 255.0F) : 0.0F)];
}

using Pixel = std::array<float, 3>; // shares of 255

Pixel packed(std::uint32_t id) {
  Pixel codes{};
  for (float& code : codes) {
    code = static_cast<float>(id & 255U) / 255.0F;
    id >>= 8U;
  }
  return codes;
}

// Near is bright; what is seen is never black.
Pixel of_depth(const Range& range, float depth) {
  const float share = std::isfinite(depth) ? 1.0F - 0.9F * range.place(depth) : 0.0F;
  return {share, share, share};
}

bool is_zero(const float* v) { return v[0] == 0.0F && v[1] == 0.0F && v[2] == 0.0F; }

Pixel of_normal(const float* n) {
  if (is_zero(n)) return {}; // nothing is seen
  return {0.5F * n[0] + 0.5F, 0.5F * n[1] + 0.5F, 0.5F * n[2] + 0.5F};
}

// A line each: what would end a line, or the text, becomes a blank.
std::string lines_of(std::span<const std::string> names) {
  std::string lines;
  for (const std::string& name : names) {
    for (const char c : name) lines += c == '\n' || c == '\0' ? ' ' : c;
    lines += '\n';
  }
  return lines;
}

} // namespace

std::vector<unsigned char> encode_layers(const Frame& frame, std::span<const std::string> objects,
                                         int threads) {
  Channels channels{{"R", "G", "B"}, {0, 0, 0}, {}, frame.width, frame.height, threads, lines_of(objects)};
  for (const AovPlane& plane : frame.aovs) {
    const AovInfo& info = aov_info(plane.aov);
    for (std::size_t c = 0; c < static_cast<std::size_t>(info.channels); ++c) {
      channels.names.emplace_back(info.channel_names[c]);
      channels.is_integer.push_back(info.integer ? 1 : 0);
    }
  }
  const std::size_t pixels = frame.rgb.size() / 3;
  channels.values.reserve(pixels * channels.names.size());
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c)
      channels.values.push_back(std::bit_cast<std::uint32_t>(frame.rgb[3 * pixel + c]));
    for (const AovPlane& plane : frame.aovs) {
      const auto count = static_cast<std::size_t>(aov_info(plane.aov).channels);
      for (std::size_t i = count * pixel; i < count * (pixel + 1); ++i)
        channels.values.push_back(plane.ids.empty() ? std::bit_cast<std::uint32_t>(plane.values[i])
                                                    : stored_id(plane.aov, plane.ids[i]));
    }
  }
  return encode_exr(channels);
}

std::vector<float> aov_picture(const AovPlane& plane) {
  const std::size_t pixels = pixel_count(plane);
  const auto channels = static_cast<std::size_t>(aov_info(plane.aov).channels);
  std::array<Range, 3> ranges;
  for (std::size_t i = 0; i < plane.values.size(); ++i) ranges[i % channels].add(plane.values[i]);
  for (const std::int32_t id : plane.ids) ranges[0].add(static_cast<float>(id));
  if (plane.aov == Aov::cost || plane.aov == Aov::recursion) ranges[0].add(0.0F);

  std::vector<float> rgb;
  rgb.reserve(3 * pixels);
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const float* const values = plane.values.data() + channels * pixel;
    if (plane.aov == Aov::albedo) { // light already
      rgb.insert(rgb.end(), values, values + 3);
      continue;
    }
    Pixel shares{};
    if (counts_from_0(plane.aov))
      shares = packed(stored_id(plane.aov, plane.ids[pixel]));
    else if (aov_info(plane.aov).integer)
      shares.fill(ranges[0].place(static_cast<float>(plane.ids[pixel])));
    else if (plane.aov == Aov::depth)
      shares = of_depth(ranges[0], *values);
    else if (plane.aov == Aov::normal)
      shares = of_normal(values);
    else if (plane.aov != Aov::position || !is_zero(values))
      for (std::size_t c = 0; c < channels; ++c)
        shares[c] = plane.aov == Aov::position ? ranges[c].place(values[c])
                    : plane.aov == Aov::uv     ? values[c] - std::floor(values[c])
                                               : values[c];
    for (const float share : shares) rgb.push_back(light_of_share(share));
  }
  return rgb;
}

} // namespace fastrt
