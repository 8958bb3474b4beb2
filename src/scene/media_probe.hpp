// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/math.hpp>

namespace fastrt {

// Which ways a point looks to find out which media it is in (docs/numerics.md, "Where rays start"). All
// point up, whichever axis that is, so that a sheet of water without a bottom is a surface to be under or
// above; and none lies in a plane or along an edge that a model is likely to have.
inline constexpr int media_probes = 3;
inline const Vec3 media_probe[media_probes] = {
    {0.2735F, 0.8942F, 0.3541F}, {0.5139F, 0.7231F, 0.4617F}, {0.3313F, 0.6241F, 0.7077F}};

} // namespace fastrt
