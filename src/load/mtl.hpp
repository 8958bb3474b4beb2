// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/event_log.hpp"
#include "src/load/material_set.hpp"

#include <fastrt/material.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

// A material as an MTL file states it: what is not stated has no value.
struct MtlRecord {
  std::string name;
  std::uint64_t offset = 0; // of its newmtl
  std::optional<Vec3> ka, kd, ks, ke, tf;
  std::optional<float> ns, ni, d, tr;
  int illum = 2;
  std::string map_ka, map_kd, map_ks, map_ke, map_d, bump;
};

struct MtlOptions {
  bool tr_is_opacity = false;
  // "" if the texture file may be used, else what is wrong with it; `refused` if it must not be opened.
  struct TextureVerdict {
    std::string fault;
    bool refused = false;
  };
  std::function<TextureVerdict(const std::string& name)> check_texture;
};

// Reads the text of an MTL file. Stops at the first error, which goes to the log.
std::vector<MtlRecord> parse_mtl(std::string_view text, const MtlOptions& options, EventLog& log);

// What the renderer makes of the materials of one file (docs/numerics.md has the shading).
void map_materials(const std::vector<MtlRecord>& records, bool tr_is_opacity, MaterialSet& materials,
                   EventLog& log);

// For faces without a material, and where a material is not defined.
Material default_material();

} // namespace fastrt
