// SPDX-License-Identifier: Apache-2.0
// Where light from photons is collected, for both paths.
#pragma once

#include <fastrt/render.hpp>

#include <cstdint>
#include <vector>

namespace fastrt {

// A frame's worth of sums, in the whole numbers of src/film/photon_sampling.hpp.
class LightFilm {
public:
  explicit LightFilm(const Frame& frame) : sums_(frame.rgb.size(), 0) {}
  // As Frame::rgb.
  std::int64_t* sums() noexcept { return sums_.data(); }
  // Adds what `photons` photons brought to the frame.
  void develop(std::uint64_t photons, Frame& frame) const;

private:
  std::vector<std::int64_t> sums_;
};

// What the pixels' centres see, which a forward picture needs besides its photons: the settings for it.
RenderSettings center_settings(const RenderSettings& forward);
// Leaves of such a picture only the background.
void keep_background(const Vec3& background, Frame& frame);

} // namespace fastrt
