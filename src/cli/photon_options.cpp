// SPDX-License-Identifier: Apache-2.0
#include "src/cli/options.hpp"

#include <fastrt/error.hpp>

namespace fastrt::cli {

void check_photons_together(Options& options) {
  const bool forward = options.integrator == Integrator::forward;
  if (forward && options.caustic_photons != 0)
    throw UsageError("--caustics: the forward integrator makes them by itself");
  if (forward && options.adaptive > 0)
    throw UsageError("--adaptive: the forward integrator takes no samples of pixels");
  if (forward && options.aperture_radius > 0)
    throw UsageError("--aperture: the forward integrator needs a pinhole or parallel rays");
  if (forward && options.samples_per_pixel != 1)
    options.warnings.emplace_back(
        "--spp: the forward integrator collects light all over a pixel; give --photons");
  if (!forward && options.photons)
    options.warnings.emplace_back("--photons says nothing without --integrator forward");
  if (options.caustic_photons == 0 && options.caustic_radius)
    options.warnings.emplace_back("--caustic-radius says nothing without --caustics");
}

} // namespace fastrt::cli
