// SPDX-License-Identifier: Apache-2.0
#include <fastrt/aov.hpp>

#include <cstddef>

namespace fastrt {
namespace {

constexpr std::array<AovInfo, aov_count> infos{{
    {"id", 1, true, {"id"}},
    {"primitive", 1, true, {"primitive"}},
    {"material", 1, true, {"material"}},
    {"depth", 1, false, {"depth"}},
    {"normal", 3, false, {"normal.X", "normal.Y", "normal.Z"}},
    {"position", 3, false, {"position.X", "position.Y", "position.Z"}},
    {"uv", 2, false, {"uv.U", "uv.V"}},
    {"albedo", 3, false, {"albedo.R", "albedo.G", "albedo.B"}},
    {"shadow", 3, false, {"shadow.R", "shadow.G", "shadow.B"}},
    {"depth-of-recursion", 1, true, {"depth-of-recursion"}},
    {"cost", 1, true, {"cost"}},
}};

} // namespace

const AovInfo& aov_info(Aov aov) noexcept { return infos[static_cast<std::size_t>(aov)]; }

std::optional<Aov> aov_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < infos.size(); ++i)
    if (name == infos[i].name) return static_cast<Aov>(i);
  return {};
}

} // namespace fastrt
