// SPDX-License-Identifier: Apache-2.0
// The texture files that the maps of an MTL file name.
#include "src/load/mtl.hpp"
#include "src/load/text.hpp"
#include "src/load/texture_file.hpp"

#include <map>
#include <set>

namespace fastrt {

namespace {

struct Use {
  MtlMap* map;
  TextureCode code;
};

std::vector<Use> uses_in(std::vector<MtlRecord>& records) {
  std::vector<Use> uses;
  for (MtlRecord& record : records) {
    for (MtlMap* map : {&record.map_ka, &record.map_kd, &record.map_ks, &record.map_ke})
      uses.push_back({map, map->is_linear ? TextureCode::data : TextureCode::color});
    uses.push_back({&record.map_d, TextureCode::data});
    uses.push_back({&record.bump, TextureCode::data});
  }
  std::erase_if(uses, [](const Use& use) { return use.map->path.empty() || use.map->failed; });
  return uses;
}

} // namespace

void read_maps(std::vector<MtlRecord>& records, int threads, EventLog& log) {
  const std::vector<Use> uses = uses_in(records);
  std::set<TextureKey> keys;
  for (const Use& use : uses) keys.emplace(use.map->path, use.code);
  const std::map<TextureKey, TextureFile> files = read_textures(keys, threads);
  for (const Use& use : uses) {
    const TextureFile& file = files.at({use.map->path, use.code});
    use.map->image = file.image;
    use.map->failed = file.image == nullptr;
    // Once for each file: many materials may share it.
    if (!file.fault.empty())
      log.warn_once(use.map->offset, "texture", use.map->path.native(),
                    "texture " + in_quotes(use.map->name) + ' ' + file.fault);
  }
}

} // namespace fastrt
