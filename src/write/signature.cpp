// SPDX-License-Identifier: Apache-2.0
// The scene signature: one colour per object.
#include "src/write/codes.hpp"

#include <fastrt/write.hpp>

#include <algorithm>
#include <cstddef>

namespace fastrt {
namespace {

using Color = std::array<int, 3>;

constexpr int levels = 8;
constexpr int least_brightness = 120; // of the brightest channel: colours stand out from black
constexpr std::size_t palette_size = 448;

// How different two colours look: squared, the weights of the channels following the mean red.
int distance(const Color& a, const Color& b) {
  const int red = (a[0] + b[0]) / 2;
  const int dr = a[0] - b[0], dg = a[1] - b[1], db = a[2] - b[2];
  return ((512 + red) * dr * dr) / 256 + 4 * dg * dg + ((767 - red) * db * db) / 256;
}

std::vector<Color> bright_colors() {
  std::vector<Color> colors;
  for (int r = 0; r < levels; ++r)
    for (int g = 0; g < levels; ++g)
      for (int b = 0; b < levels; ++b) {
        const Color color{255 * r / (levels - 1), 255 * g / (levels - 1), 255 * b / (levels - 1)};
        if (*std::max_element(color.begin(), color.end()) >= least_brightness) colors.push_back(color);
      }
  return colors;
}

// The colours of a lattice, each as far as can be from black and from all before it. Integers alone, so the
// same everywhere.
std::array<Color, palette_size> make_palette() {
  const std::vector<Color> colors = bright_colors();
  std::vector<int> gap;
  for (const Color& color : colors) gap.push_back(distance(color, {0, 0, 0}));
  std::array<Color, palette_size> palette{};
  for (Color& next : palette) {
    const auto farthest = static_cast<std::size_t>(std::max_element(gap.begin(), gap.end()) - gap.begin());
    next = colors[farthest];
    for (std::size_t i = 0; i < colors.size(); ++i) gap[i] = std::min(gap[i], distance(colors[i], next));
    gap[farthest] = -1;
  }
  return palette;
}

} // namespace

std::array<std::uint8_t, 3> signature_color(std::uint32_t object) noexcept {
  static const std::array<Color, palette_size> palette = make_palette();
  const Color& color = palette[object % palette_size];
  // Later rounds stay within half a step of the lattice, so that no colour comes twice.
  std::uint32_t round = object / palette_size;
  std::array<std::uint8_t, 3> codes{};
  for (std::size_t c = 0; c < 3; ++c, round /= 16) {
    const int shift = static_cast<int>(round % 16);
    codes[c] = static_cast<std::uint8_t>(color[c] < 128 ? color[c] + shift : color[c] - shift);
  }
  return codes;
}

std::vector<unsigned char> signature_picture(const AovPlane& ids, int threads) {
  return codes_of_pixels(ids.ids.size(), threads, [&](std::size_t pixel, unsigned char* codes) {
    const std::int32_t id = ids.ids[pixel];
    if (id < 0) return;
    const std::array<std::uint8_t, 3> color = signature_color(static_cast<std::uint32_t>(id));
    std::copy(color.begin(), color.end(), codes);
  });
}

} // namespace fastrt
