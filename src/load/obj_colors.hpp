// SPDX-License-Identifier: Apache-2.0
// Colours that stand behind the positions of an OBJ file.
#pragma once

#include <fastrt/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>

namespace fastrt {

// Whether a position of so many numbers has a colour: x y z r g b, or x y z w r g b.
inline bool has_color(std::size_t numbers) { return numbers == 6 || numbers == 7; }

// The colour among the numbers of such a position.
inline std::span<const float, 3> color_in(std::span<const float> numbers, std::size_t count) {
  return numbers.subspan(count - 3).first<3>();
}

inline bool is_srgb(std::span<const float, 3> color) {
  bool within = true;
  for (const float code : color) within &= code >= 0 && code <= 1;
  return within;
}

// Fills SceneDesc::colors from several threads, each some rows of its own. Takes memory when the first colour
// comes: most files have none.
class ObjColors {
public:
  explicit ObjColors(SceneDesc& desc) : desc_(desc) {}

  // Makes the rows first .. last - 1 white. To be called before the first put() into them.
  void start(std::uint64_t first, std::uint64_t last);
  // A colour of sRGB codes from 0 to 1; others count as the nearest.
  void put(std::uint64_t row, std::span<const float, 3> color);

private:
  SceneDesc& desc_;
  std::mutex mutex_;
};

// Lets the materials show the colours: the default one nothing else, the others as a factor of their own
// where no texture says what colour they have. There are colours.
void show_vertex_colors(SceneDesc& desc, std::size_t default_material);

} // namespace fastrt
