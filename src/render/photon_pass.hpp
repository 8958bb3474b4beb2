// SPDX-License-Identifier: Apache-2.0
// Photons by all threads, with the tracer's kernels.
#pragma once

#include "src/film/frame.hpp"
#include "src/film/photon_map.hpp"
#include "src/scene/photon_chunks.hpp"
#include "src/trace/tracer_parts.hpp"

#include <fastrt/render.hpp>

#include <vector>

namespace fastrt {

// The scene where photons carry what bodies bend: those let no light straight through, thin surfaces do.
class PhotonScene {
public:
  explicit PhotonScene(const Tracer::Parts& parts);
  PhotonScene(const PhotonScene&) = delete; // the view points into it
  PhotonScene& operator=(const PhotonScene&) = delete;
  const SceneView& view() const noexcept { return view_; }

private:
  std::vector<MaterialRow> materials_;
  SceneView view_;
};

// The photons of one rendering.
struct PhotonPass {
  const KernelTable* kernels;
  const PhotonPlan* plan;
  const std::vector<PhotonChunk>* chunks;
  PhotonJob job; // all but its light and its photons
  int threads;
};

// A pass of the settings; `job.film` and the eye are yet to be set.
PhotonPass make_photon_pass(const Tracer::Parts& parts, const PhotonScene& scene, const PhotonPlan& plan,
                            const std::vector<PhotonChunk>& chunks, const RenderSettings& settings);

// Follows all photons. Returns those that caustics are made of, in no order; none if they go to a film.
std::vector<Photon> trace_photons(const PhotonPass& pass, FrameProgress& progress);

} // namespace fastrt
