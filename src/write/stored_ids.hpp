// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/aov.hpp>

namespace fastrt {

inline bool counts_from_0(Aov aov) { return aov == Aov::id || aov == Aov::primitive || aov == Aov::material; }

// What files hold for an integer: ids from 1, so that 0 is the background.
inline std::uint32_t stored_id(Aov aov, std::int32_t id) {
  return static_cast<std::uint32_t>(id) + (counts_from_0(aov) ? 1U : 0U);
}

} // namespace fastrt
