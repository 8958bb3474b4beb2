// SPDX-License-Identifier: Apache-2.0
// Boxes as the trees' builder wants them, with the groups of scene_view.hpp. Within run_tasks all threads
// make them.
#pragma once

#include "src/accel/tree.hpp"

#include <fastrt/scene.hpp>

namespace fastrt {

// What the scene's own tree holds: the primitives that have a box (planes have none) and are in no prototype,
// then the instances that show something. The id of an instance is its number after those of all primitives.
Column<PrimitiveBox> world_boxes(const Scene& scene);

// What the tree of a prototype holds.
Column<PrimitiveBox> prototype_boxes(const Scene& scene, const Prototype& prototype);

} // namespace fastrt
