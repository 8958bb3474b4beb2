// SPDX-License-Identifier: Apache-2.0
// Feeds the OBJ reader, and the MTL reader, whatever libFuzzer makes up. Build and run:
//   clang++ -std=c++20 -O1 -g -fopenmp -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I.
//     -Iinclude tests/fuzz/obj_fuzzer.cpp src/load/*.cpp src/modules/open.cpp src/scene/*.cpp -o obj_fuzzer
//     && OMP_NUM_THREADS=1 ./obj_fuzzer -max_len=4096 corpus/
#include "src/load/mtl.hpp"
#include "src/load/obj_reader.hpp"

#include <fastrt/error.hpp>
#include <fastrt/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

using namespace fastrt;

// Both ways to cut the text must give the same scene or the same error.
struct Outcome {
  SceneDesc desc;
  std::string error;
  std::size_t warnings = 0;
};

Outcome read(std::string_view text, std::size_t chunk_bytes) {
  Outcome outcome;
  Diagnostics diagnostics;
  ObjReaderSettings settings;
  settings.chunk_bytes = chunk_bytes;
  try {
    outcome.desc = read_obj(Source::memory(text, "fuzz.obj"), settings, diagnostics);
  } catch (const Error& error) {
    outcome.error = error.what();
  }
  outcome.warnings = diagnostics.count();
  return outcome;
}

void require(bool claim) {
  if (!claim) std::abort();
}

void read_materials(std::string_view text) {
  EventLog log;
  MaterialSet materials;
  map_materials(parse_mtl(text, {}, log), false, materials, log);
  SceneDesc desc;
  const bool failed = log.failed();
  desc.materials = std::move(materials.materials);
  if (!failed) Scene{std::move(desc)};
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Outcome whole = read(text, std::size_t{1} << 20U);
  const Outcome cut = read(text, 256);
  require(whole.error == cut.error && whole.warnings == cut.warnings);
  require(whole.desc.positions.x.size() == cut.desc.positions.x.size());
  require(whole.desc.triangles.v0 == cut.desc.triangles.v0 &&
          whole.desc.triangles.v2 == cut.desc.triangles.v2);
  require(whole.desc.triangles.n1 == cut.desc.triangles.n1 &&
          whole.desc.triangles.t1 == cut.desc.triangles.t1);
  require(whole.desc.triangles.object == cut.desc.triangles.object);
  require(whole.desc.object_names == cut.desc.object_names);
  if (whole.error.empty()) Scene{std::move(whole.desc)}; // throws if an index or a number is out of range
  read_materials(text);
  return 0;
}
