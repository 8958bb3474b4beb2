// SPDX-License-Identifier: Apache-2.0
#include "src/cli/parse.hpp"

#include "src/cli/read_numbers.hpp"
#include "src/scene/picture_limits.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <system_error>

namespace fastrt::cli {
namespace {

[[noreturn]] void refuse(std::string_view option, std::string_view text, const std::string& expected) {
  throw UsageError(std::string(option) + ": '" + std::string(text) + "' is not " + expected);
}

std::string known_aovs() {
  std::string known = "all";
  for (std::size_t i = 0; i < aov_count; ++i) known += std::string(", ") + aov_info(static_cast<Aov>(i)).name;
  return known;
}

} // namespace

std::int64_t parse_integer(std::string_view option, std::string_view text, std::int64_t lowest,
                           std::int64_t highest) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < lowest || value > highest) {
    refuse(option, text, "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return value;
}

float parse_number(std::string_view option, std::string_view text) {
  float value = 0;
  if (!read_number(text, value)) refuse(option, text, "a finite number");
  return value;
}

Vec3 parse_vector(std::string_view option, std::string_view text) {
  Vec3 value{0.0F};
  if (!read_vector(text, value)) refuse(option, text, "three numbers x,y,z");
  return value;
}

Vec3 parse_color(std::string_view option, std::string_view text) {
  Vec3 value{0.0F};
  if (!read_color(text, value)) refuse(option, text, "a colour r,g,b of three numbers that are at least 0");
  return value;
}

Resolution parse_resolution(std::string_view option, std::string_view text) {
  const std::size_t cross = text.find_first_of("xX,");
  if (cross == std::string_view::npos) refuse(option, text, "a resolution such as 640x480");
  const auto side = [&](std::string_view digits) {
    return static_cast<int>(parse_integer(option, digits, 1, most_pixels_a_side));
  };
  return {side(text.substr(0, cross)), side(text.substr(cross + 1))};
}

float parse_length(std::string_view option, std::string_view text) {
  float value = 0;
  if (!read_number(text, value) || value <= 0) refuse(option, text, "a number greater than 0");
  return value;
}

Crop parse_crop(std::string_view option, std::string_view text) {
  std::array<int, 4> sides{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i == 3)) refuse(option, text, "four whole numbers x0,y0,x1,y1");
    sides[i] = static_cast<int>(parse_integer(option, rest.substr(0, comma), 0, most_pixels_a_side));
    rest = i == 3 ? std::string_view() : rest.substr(comma + 1);
  }
  const Crop crop{sides[0], sides[1], sides[2], sides[3]};
  if (crop.x0 >= crop.x1 || crop.y0 >= crop.y1)
    refuse(option, text, "a part of the picture: x0 < x1 and y0 < y1");
  return crop;
}

Window parse_window(std::string_view option, std::string_view text) {
  std::array<float, 4> sides{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i == 3) || !read_number(rest.substr(0, comma), sides[i]))
      refuse(option, text, "four numbers left,right,bottom,top");
    rest = i == 3 ? std::string_view() : rest.substr(comma + 1);
  }
  const Window window{sides[0], sides[1], sides[2], sides[3]};
  if (window.left == window.right || window.bottom == window.top)
    refuse(option, text, "a window with an area");
  return window;
}

PixelFilter parse_filter(std::string_view option, std::string_view text) {
  if (text == "box") return PixelFilter::box;
  if (text == "tent") return PixelFilter::tent;
  if (text == "gaussian") return PixelFilter::gaussian;
  if (text == "mitchell") return PixelFilter::mitchell;
  refuse(option, text, "box, tent, gaussian or mitchell");
}

BvhQuality parse_bvh_quality(std::string_view option, std::string_view text) {
  if (text == "standard") return BvhQuality::standard;
  if (text == "high") return BvhQuality::high;
  refuse(option, text, "standard or high");
}

Integrator parse_integrator(std::string_view option, std::string_view text) {
  if (text == "whitted") return Integrator::whitted;
  if (text == "forward") return Integrator::forward;
  refuse(option, text, "whitted or forward");
}

std::vector<Aov> parse_aovs(std::string_view option, std::string_view text) {
  std::vector<Aov> aovs;
  const auto add = [&](Aov aov) {
    if (std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) aovs.push_back(aov);
  };
  for (bool more = true; more;) {
    const std::size_t comma = text.find(',');
    more = comma != std::string_view::npos;
    const std::string_view name = text.substr(0, comma);
    const std::optional<Aov> aov = aov_named(name);
    if (!aov && name != "all") refuse(option, name, "one of " + known_aovs());
    if (aov)
      add(*aov);
    else
      for (std::size_t i = 0; i < aov_count; ++i) add(static_cast<Aov>(i));
    if (more) text.remove_prefix(comma + 1);
  }
  return aovs;
}

} // namespace fastrt::cli
