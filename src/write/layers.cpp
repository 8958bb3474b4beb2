// SPDX-License-Identifier: Apache-2.0
// The picture and its AOVs as channels of one file.
#include "src/scene/threads.hpp"
#include "src/write/formats.hpp"
#include "src/write/stored_ids.hpp"

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

std::vector<std::uint32_t> stored_ids(const AovPlane& plane) {
  std::vector<std::uint32_t> stored(plane.ids.size());
  std::transform(plane.ids.begin(), plane.ids.end(), stored.begin(),
                 [&](std::int32_t id) { return stored_id(plane.aov, id); });
  return stored;
}

} // namespace

std::vector<unsigned char> encode_layers(const Frame& frame, std::span<const std::string> objects,
                                         int threads) {
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
  return encode_exr({channels.data(), static_cast<int>(channels.size()), frame.width, frame.height,
                     thread_count(threads), names.empty() ? nullptr : names.c_str()});
}

} // namespace fastrt
