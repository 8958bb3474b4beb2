// SPDX-License-Identifier: Apache-2.0
// The command lines that render one scene with fastrt and with what is installed of other renderers.
#pragma once

#include <string>
#include <vector>

#include "bench/peer_scenes.hpp"

namespace fastrt::bench {

struct PeerCommand {
  std::string name;
  std::vector<std::string> words; // the program's full path first
  std::string picture;            // the file that it writes
};

struct RunSettings {
  std::string fastrt; // the program
  std::string folder; // for scenes and pictures
  int threads = 1;
  int size = 1024; // pixels a side
  int depth = 5;   // levels of rays of an NFF scene
};

// Where the commands expect the scene of another renderer, and the OBJ file: write them there before they
// run.
std::string povray_scene(const std::string& folder);
std::string tachyon_scene(const std::string& folder);
std::string plain_obj(const std::string& folder);

// fastrt's command writing PNG comes first. An OBJ file: plain surfaces, the picture's one light; Embree's
// pathtracer, too.
std::vector<PeerCommand> obj_commands(const RunSettings& settings, const Picture& picture);
// An NFF file: as it says.
std::vector<PeerCommand> nff_commands(const RunSettings& settings, const std::string& model);

} // namespace fastrt::bench
