// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/light.hpp>
#include <fastrt/load.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace fastrt::cli {

// What --light asks for: a light that is described, or one that the scene's own surfaces are, or those that
// scenes get which have none.
struct LightOption {
  enum class Source { described, material, all_emissive, defaults };
  Source source = Source::described;
  Light light; // where the scene need not be known: all but `material`
  // A material's name and fields. Names may hold colons, so only the scene says where one ends.
  std::string material;
};

// A light of parse_light, or
//   mesh:material[:scale or r,g,b][:ambient=r,g,b][:shadows=on|off]   emissive, with the same   default
// Throws UsageError, whose text begins with the option's name.
LightOption parse_light_option(std::string_view option, std::string_view text);

// Gives the scene the lights that are asked for; without any its own, or else its lamps (materials that emit
// more than 1), or else a key and a fill light. A scene without lights also gets ambient light and a
// background. Throws UsageError for materials that the scene has not or that are no light, and for what is
// wrong in the fields behind their names.
void choose_lights(const std::vector<LightOption>& options, const Aabb& bounds, const Camera& camera,
                   SceneDesc& desc);

} // namespace fastrt::cli
