// SPDX-License-Identifier: Apache-2.0
// The pixel filters as tables.
#pragma once

#include "src/film/sampling.hpp"

#include <fastrt/render.hpp>

namespace fastrt {

// Its tables live as long as the program.
Filter filter_of(PixelFilter filter);

} // namespace fastrt
