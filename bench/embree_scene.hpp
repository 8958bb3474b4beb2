// SPDX-License-Identifier: Apache-2.0
// Embree 3 over the same scene. Where it is not installed nothing can be built and all else still runs.
#pragma once

#include <fastrt/scene.hpp>

#include <cstddef>
#include <memory>
#include <string>

#include "bench/tracers.hpp"

namespace fastrt::bench {

struct EmbreeMode {
  int width;     // rays a call: 1, 4, 8, 16
  bool coherent; // the context's flag
};
std::vector<EmbreeMode> embree_modes();
std::string name_of(const EmbreeMode& mode); // "16 coherent"

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

// Medium quality, threads for the build. Null without Embree.
std::unique_ptr<EmbreeScene> build_embree_scene(const Scene& scene, bool robust, int threads);

// "3.13.5"; empty without Embree.
std::string embree_version();

} // namespace fastrt::bench
