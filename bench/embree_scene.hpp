// SPDX-License-Identifier: Apache-2.0
// Embree 3 over the same scene. Where it is not installed nothing can be built and all else still runs.
#pragma once

#include <fastrt/scene.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "bench/tracers.hpp"

namespace fastrt::bench {

// Packets of so many rays a call, and a batch a call: as single rays, pointers to them, columns, pointers to
// these.
enum class EmbreeCall {
  packet_1,
  packet_4,
  packet_8,
  packet_16,
  stream_1m,
  stream_1mp,
  stream_nm,
  stream_np
};

struct EmbreeMode {
  EmbreeCall call;
  bool coherent; // the context's flag
};
std::vector<EmbreeMode> embree_modes();          // all
std::vector<EmbreeMode> packet_modes(int width); // of packets of 4, 8 or 16 rays
std::string name_of(const EmbreeMode& mode);     // "16 coherent", "1M"

class EmbreeScene {
public:
  EmbreeScene() = default;
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;
  virtual ~EmbreeScene() = default;

  virtual Contender contender(const EmbreeMode& mode) const = 0;
  virtual double build_seconds() const = 0;   // of rtcCommitScene
  virtual std::size_t bytes() const = 0;      // held after the build, without the vertices and indices
  virtual std::size_t peak_bytes() const = 0; // held at most during the build
};

struct EmbreeSettings {
  bool robust = false;
  int threads = 1;        // of the build
  std::optional<Isa> isa; // that Embree's code keeps to, not scalar; unset: all that runs here
};

// Medium quality, Embree's default. Null without Embree.
std::unique_ptr<EmbreeScene> build_embree_scene(const Scene& scene, const EmbreeSettings& settings);

// "3.13.5"; empty without Embree.
std::string embree_version();

} // namespace fastrt::bench
