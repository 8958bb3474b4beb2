// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/source.hpp"

#include <fastrt/diagnostics.hpp>
#include <fastrt/scene.hpp>

namespace fastrt {

// Reads an NFF file. docs/nff.md says what becomes of its statements. strict: warnings are errors.
SceneDesc read_nff(const Source& source, bool strict, Diagnostics& diagnostics);

} // namespace fastrt
