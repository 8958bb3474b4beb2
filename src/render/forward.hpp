// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/render.hpp>

namespace fastrt {

// render() for Integrator::forward, with the kernels of a tracer that has some.
Frame render_forward(const Tracer& tracer, const Camera& camera, const RenderSettings& settings);

} // namespace fastrt
