// SPDX-License-Identifier: Apache-2.0
// What a scene must fulfil before anything is traced in it.
#pragma once

#include <fastrt/scene.hpp>

#include <string>

namespace fastrt {

// Throws LimitError for too many primitives, and InputError for the first column of a wrong length, number
// that is not finite, index out of range, or material or light that can't be used. The message does not
// depend on the number of threads.
void check_scene(const SceneDesc& desc);

// The parts of it. Shapes: cones, disks, polygons and planes; positions must have been checked.
void check_shapes(const SceneDesc& desc);
// Prototypes and instances.
void check_instances(const SceneDesc& desc);
void check_textures(const SceneDesc& desc);
void check_materials(const SceneDesc& desc);
void check_lights(const SceneDesc& desc);

// What is wrong with a light of this scene; "" if it can be used.
std::string light_fault(const SceneDesc& desc, const Light& light);

} // namespace fastrt
