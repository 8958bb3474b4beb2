// SPDX-License-Identifier: Apache-2.0
// Stands in for embree_scene.cpp where Embree is not installed.
#include "bench/embree_scene.hpp"

namespace fastrt::bench {

std::vector<EmbreeMode> embree_modes() { return {}; }
std::vector<EmbreeMode> packet_modes(int) { return {}; }
std::string name_of(const EmbreeMode&) { return {}; }
std::unique_ptr<EmbreeScene> build_embree_scene(const Scene&, const EmbreeSettings&) { return nullptr; }
std::string embree_version() { return {}; }

} // namespace fastrt::bench
