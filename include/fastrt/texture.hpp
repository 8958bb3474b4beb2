// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fastrt {

// The most pixels on a side of an image.
inline constexpr int max_image_side = 16384;

// A picture for textures: red, green, blue and alpha, with mip levels of half the size each down to 1 x 1.
// Immutable. Values are linear, finite and not negative.
class Image {
public:
  // One level; its pixels begin at `first` (in pixels) of bytes() or floats(), rows from the top.
  struct Level {
    int width, height;
    std::size_t first;
  };

  // Four bytes a pixel, rows from the top. srgb: colours are decoded from the sRGB curve, otherwise code /
  // 255; alpha is always code / 255. Throws InputError for sizes outside 1..max_image_side or that don't fit
  // `rgba`.
  Image(int width, int height, std::span<const std::uint8_t> rgba, bool srgb);
  // Four linear floats a pixel. Numbers that are negative or not finite become 0.
  Image(int width, int height, std::span<const float> rgba);

  int width() const noexcept { return levels_[0].width; }
  int height() const noexcept { return levels_[0].height; }
  const std::vector<Level>& levels() const noexcept { return levels_; }
  // Of one of these four values a pixel, of all levels; the other is empty.
  const std::vector<std::uint8_t>& bytes() const noexcept { return bytes_; }
  const std::vector<float>& floats() const noexcept { return floats_; }
  // What the codes of bytes() stand for: 256 values of colours, then 256 of alpha.
  const std::vector<float>& decoded() const noexcept { return decoded_; }
  // Whether some pixel's alpha is not 1.
  bool has_alpha() const noexcept { return has_alpha_; }
  // x from the left, y from the top, inside the level.
  glm::vec4 pixel(std::size_t level, int x, int y) const;

private:
  void plan_levels(int width, int height, std::size_t given);
  template <int channels, class Store>
  void make_byte_levels(const Store& store);
  template <int channels, class Decode, class Store>
  void make_level(std::size_t i, const Decode& decode, const Store& store);
  template <int channels, class Store>
  void make_half_level(std::size_t i, const float* quarters, const Store& store);

  std::vector<Level> levels_;
  std::vector<std::uint8_t> bytes_;
  std::vector<float> floats_;
  std::vector<float> decoded_;
  bool has_alpha_ = false;
};

enum class TextureKind : std::uint32_t {
  image,    // a picture over the unit square of (s, t): t = 0 is its bottom
  checker,  // unit squares of color_a and color_b in turn
  gradient, // from color_a at t = 0 to color_b at t = 1
};

// What a texture varies over: the surface's own (u, v), or a plane of the world: u = x . plane_u, v = x .
// plane_v, for surfaces without coordinates.
enum class TextureSpace : std::uint32_t { surface, plane };

// A colour (or number) that varies over a surface; docs/numerics.md says how it is looked up.
struct Texture {
  std::string name; // for messages
  TextureKind kind = TextureKind::image;
  std::shared_ptr<const Image> image; // of kind image
  glm::vec4 color_a{1.0F}, color_b{0.0F, 0.0F, 0.0F, 1.0F};
  TextureSpace space = TextureSpace::surface;
  Vec3 plane_u{1.0F, 0.0F, 0.0F}, plane_v{0.0F, 0.0F, 1.0F};
  Vec2 scale{1.0F}, offset{0.0F}; // s = u * scale.x + offset.x, likewise t
  bool clamp = false;             // s and t are held to 0..1; otherwise the texture repeats
  float gain = 1, base = 0;       // a value becomes value * gain + base, at least 0
  // Where one number is wanted: the weights of red, green, blue and alpha.
  glm::vec4 channel{0.2126F, 0.7152F, 0.0722F, 0.0F};
};

// A material's "no texture".
inline constexpr std::uint32_t no_texture = 0xFFFFFFFFU;

} // namespace fastrt
