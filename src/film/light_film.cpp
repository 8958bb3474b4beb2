// SPDX-License-Identifier: Apache-2.0
#include "src/film/light_film.hpp"

#include "src/film/photon_sampling.hpp"

namespace fastrt {

void LightFilm::develop(std::uint64_t photons, Frame& frame) const {
  if (photons == 0) return;
  const double unit = 1.0 / (static_cast<double>(film_scale) * static_cast<double>(photons));
  for (std::size_t i = 0; i < sums_.size(); ++i)
    frame.rgb[i] = frame.rgb[i] + static_cast<float>(static_cast<double>(sums_[i]) * unit);
}

RenderSettings center_settings(const RenderSettings& forward) {
  RenderSettings settings = forward;
  settings.integrator = Integrator::whitted;
  settings.pixel_format = PixelFormat::linear;
  settings.samples_per_pixel = 1;
  settings.most_samples = 0;
  settings.max_depth = 0;
  settings.progress = nullptr;
  if (settings.aovs.empty()) settings.light_samples = 1;
  return settings;
}

void keep_background(const Vec3& background, Frame& frame) {
  for (std::size_t pixel = 0; pixel < frame.primitive.size(); ++pixel)
    for (int c = 0; c < 3; ++c)
      frame.rgb[3 * pixel + static_cast<std::size_t>(c)] =
          frame.primitive[pixel] == no_primitive ? background[c] : 0.0F;
}

} // namespace fastrt
