// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/diagnostics.hpp>
#include <fastrt/scene.hpp>

#include <string>

namespace fastrt {

// A warning, or with `strict` an InputError.
void warn(const char* kind, const std::string& message, bool strict, Diagnostics& diagnostics);

// The warning about a scene that shows nothing. name: of its file.
void warn_without_primitives(const SceneDesc& desc, const std::string& name, bool strict,
                             Diagnostics& diagnostics);

} // namespace fastrt
