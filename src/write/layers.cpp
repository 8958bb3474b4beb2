// SPDX-License-Identifier: Apache-2.0
// The picture and its AOVs as channels of one file.
#include "src/scene/threads.hpp"
#include "src/write/formats.hpp"
#include "src/write/stored_ids.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <algorithm>
#include <cstddef>

namespace fastrt {
namespace {

// A line each: what would end a line, or the text, becomes a blank.
std::string lines_of(std::span<const std::string> names) {
  std::string lines;
  for (const std::string& name : names) {
    for (const char c : name) lines += c == '\n' || c == '\0' ? ' ' : c;
    lines += '\n';
  }
  return lines;
}

// Throws UsageError for a frame that has not all its pixels: those of codes alone hold no linear picture.
void check_sizes(const Frame& frame) {
  const auto pixels = static_cast<std::size_t>(std::max(frame.width, 0)) *
                      static_cast<std::size_t>(std::max(frame.height, 0));
  bool fits = pixels != 0 && frame.rgb.size() == 3 * pixels;
  for (const AovPlane& plane : frame.aovs) {
    if (static_cast<std::size_t>(plane.aov) >= aov_count) throw UsageError("unknown AOV");
    const AovInfo& info = aov_info(plane.aov);
    const std::size_t size = info.integer ? plane.ids.size() : plane.values.size();
    fits = fits && size == static_cast<std::size_t>(info.channels) * pixels;
  }
  if (!fits) throw UsageError("layers need a linear picture and whole AOVs");
}

std::vector<std::uint32_t> stored_ids(const AovPlane& plane) {
  std::vector<std::uint32_t> stored(plane.ids.size());
  std::transform(plane.ids.begin(), plane.ids.end(), stored.begin(),
                 [&](std::int32_t id) { return stored_id(plane.aov, id); });
  return stored;
}

} // namespace

std::vector<unsigned char> encode_layers(const Frame& frame, std::span<const std::string> objects,
                                         int threads) {
  check_sizes(frame);
  std::vector<LayerChannel> channels = {
      {"R", frame.rgb.data(), 3, 0}, {"G", frame.rgb.data() + 1, 3, 0}, {"B", frame.rgb.data() + 2, 3, 0}};
  std::vector<std::vector<std::uint32_t>> ids; // they own what channels point to
  ids.reserve(frame.aovs.size());
  for (const AovPlane& plane : frame.aovs) {
    const AovInfo& info = aov_info(plane.aov);
    const auto count = static_cast<std::size_t>(info.channels);
    if (info.integer) ids.push_back(stored_ids(plane));
    for (std::size_t c = 0; c < count; ++c)
      channels.push_back({info.channel_names[c],
                          info.integer ? static_cast<const void*>(ids.back().data() + c) : &plane.values[c],
                          count, info.integer ? 1 : 0});
  }
  const std::string names = lines_of(objects);
  const auto count = static_cast<int>(channels.size());
  return encode_exr({channels.data(), count, frame.width, frame.height, frame.x, frame.y,
                     std::max(frame.x + frame.width, frame.whole_width),
                     std::max(frame.y + frame.height, frame.whole_height), thread_count(threads),
                     names.empty() ? nullptr : names.c_str()});
}

} // namespace fastrt
