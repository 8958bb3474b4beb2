// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/render/photon_pass.hpp"

namespace fastrt {

// The photons of RenderSettings::caustic_photons, for the kernels. Must outlive the jobs that look at it.
class Caustics {
public:
  Caustics(const Tracer::Parts& parts, const RenderSettings& settings);
  Caustics(const Caustics&) = delete; // its parts point to each other
  Caustics& operator=(const Caustics&) = delete;

  // How many parts of the frame's progress the photons are.
  int parts() const noexcept { return static_cast<int>(chunks_.size()); }
  void trace(FrameProgress& progress);

  const SceneView& scene() const noexcept { return scene_.view(); }
  const PhotonMapView& map() const noexcept { return view_; }

private:
  PhotonScene scene_;
  PhotonPlan plan_;
  std::vector<PhotonChunk> chunks_;
  PhotonPass pass_;
  float radius_;
  Aabb reach_;
  PhotonMap map_;
  std::vector<PhotonLevelView> levels_;
  PhotonMapView view_{};
};

} // namespace fastrt
