// SPDX-License-Identifier: Apache-2.0
#include "src/cli/option_warnings.hpp"

#include "src/scene/photon_targets.hpp"

namespace fastrt::cli {

std::vector<std::string> sampling_warnings(const Options& options) {
  std::vector<std::string> warnings;
  if (options.given.contains("--max-spp") && options.adaptive == 0)
    warnings.emplace_back("--max-spp says nothing without --adaptive");
  if (options.given.contains("--filter") && options.samples_per_pixel == 1 && options.adaptive == 0)
    warnings.emplace_back("--filter says nothing of one sample a pixel");
  if (options.given.contains("--aov") && options.output == "none" && !options.verify)
    warnings.emplace_back("--aov says nothing without a picture: '-o none' writes no values either");
  if (options.aperture_radius > 0 && options.samples_per_pixel == 1 && options.adaptive == 0)
    warnings.emplace_back("--aperture: one sample a pixel goes through the middle of the lens; give --spp");
  return warnings;
}

std::vector<std::string> camera_warnings(const Options& options, const Camera& camera) {
  const auto given = [&](const char* name) { return options.given.contains(name); };
  const bool is_parallel = camera.projection == Projection::orthographic;
  std::vector<std::string> warnings;
  if (given("--fov") && is_parallel)
    warnings.emplace_back("--fov says nothing beside --ortho");
  else if (given("--fov") && camera.window)
    warnings.emplace_back("--fov says nothing beside --window");
  if (options.view_height && camera.window)
    warnings.emplace_back("--ortho: a height says nothing beside --window");
  if (given("--focal") && is_parallel)
    warnings.emplace_back("--focal says nothing of parallel rays");
  else if (given("--focal") && !camera.window)
    warnings.emplace_back("--focal says nothing without --window");
  if (given("--focus") && camera.aperture_radius == 0)
    warnings.emplace_back("--focus says nothing without --aperture");
  return warnings;
}

std::vector<std::string> caustic_warnings(const Options& options, const Scene& scene) {
  if (options.caustic_photons == 0) return {};
  const PhotonTargets targets = specular_objects(scene);
  if (targets.everywhere || !targets.balls.empty()) return {};
  return {"--caustics says nothing without a mirror or glass in the scene"};
}

} // namespace fastrt::cli
