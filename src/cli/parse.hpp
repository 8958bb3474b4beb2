// SPDX-License-Identifier: Apache-2.0
// The values of options, read from text. Numbers don't depend on the locale. All throw UsageError, whose text
// begins with the option's name.
#pragma once

#include <fastrt/aov.hpp>
#include <fastrt/camera.hpp>
#include <fastrt/math.hpp>
#include <fastrt/render.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace fastrt::cli {

struct Resolution {
  int width, height;
};

// A whole number in [lowest, highest].
std::int64_t parse_integer(std::string_view option, std::string_view text, std::int64_t lowest,
                           std::int64_t highest);

// A finite number.
float parse_number(std::string_view option, std::string_view text);

// "x,y,z", each finite.
Vec3 parse_vector(std::string_view option, std::string_view text);

// "r,g,b", each finite and at least 0.
Vec3 parse_color(std::string_view option, std::string_view text);

// "640x480" or "640,480", each side in 1..65536.
Resolution parse_resolution(std::string_view option, std::string_view text);

// A finite number above 0.
float parse_length(std::string_view option, std::string_view text);

// "x0,y0,x1,y1": whole numbers, 0 <= x0 < x1 <= 65536, likewise y.
Crop parse_crop(std::string_view option, std::string_view text);

// "wl,wr,wb,wt", with an area.
Window parse_window(std::string_view option, std::string_view text);

// "box", "tent", "gaussian" or "mitchell".
PixelFilter parse_filter(std::string_view option, std::string_view text);

// "standard" or "high".
BvhQuality parse_bvh_quality(std::string_view option, std::string_view text);

// "whitted" or "forward".
Integrator parse_integrator(std::string_view option, std::string_view text);

// "id,depth,normal", where "all" stands for all of them; each kept once.
std::vector<Aov> parse_aovs(std::string_view option, std::string_view text);

} // namespace fastrt::cli
