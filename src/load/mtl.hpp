// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/event_log.hpp"
#include "src/load/material_set.hpp"

#include <fastrt/material.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

// A map statement: a texture file and how it is laid on.
struct MtlMap {
  std::string name; // as written; "" if there is no map
  std::uint64_t offset = 0;
  bool failed = false; // missing, refused or broken, and warned about
  std::filesystem::path path;
  std::shared_ptr<const Image> image; // once it is read
  Vec2 scale{1.0F}, offset_uv{0.0F};
  float base = 0, gain = 1;
  float bump = 1;
  bool clamp = false;
  bool is_normal_map = false;
  bool is_linear = false; // -colorspace: no sRGB codes
  char channel = 0;       // of -imfchan; 0 if it is not given
  bool empty() const { return name.empty(); }
};

// A material as an MTL file states it: what is not stated has no value.
struct MtlRecord {
  std::string name;
  std::uint64_t offset = 0; // of its newmtl
  std::optional<Vec3> ka, kd, ks, ke, tf;
  std::optional<float> ns, ni, d, tr;
  int illum = 2;
  MtlMap map_ka, map_kd, map_ks, map_ke, map_d, bump;
};

struct MtlOptions {
  bool tr_is_opacity = false;
  // What is wrong with a texture file, or where it is.
  struct TextureVerdict {
    std::string fault;
    std::filesystem::path path; // of a file that may be opened
  };
  std::function<TextureVerdict(const std::string& name)> check_texture;
};

// Reads the text of an MTL file. Stops at the first error, which goes to the log.
std::vector<MtlRecord> parse_mtl(std::string_view text, const MtlOptions& options, EventLog& log);

// Reads the files of all maps, each once, and warns about those that can't be used.
void read_maps(std::vector<MtlRecord>& records, int threads, EventLog& log);

// What the renderer makes of the materials of one file (docs/numerics.md has the shading).
void map_materials(const std::vector<MtlRecord>& records, bool tr_is_opacity, MaterialSet& materials,
                   EventLog& log);

// For faces without a material, and where a material is not defined.
Material default_material();

} // namespace fastrt
