// SPDX-License-Identifier: Apache-2.0
#include "src/cli/frame_settings.hpp"

#include "src/cli/output_files.hpp"
#include "src/cli/save.hpp"
#include "src/cli/signals.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <cstdint>
#include <string>

namespace fastrt::cli {
namespace {

namespace fs = std::filesystem;

// Codes alone, unless more is asked of a pixel: to be compared, or written as linear values, or to go on
// with; or it is made one by one (`scalar`).
PixelFormat choose_pixel_format(const Options& options, const fs::path& picture, Isa isa) {
  const bool is_8bit = picture.empty() || is_8bit_format(format_of(picture));
  const bool needs_more = options.verify || options.adaptive > 0 || !aovs_to_render(options).empty() ||
                          options.integrator == Integrator::forward || isa == Isa::scalar;
  return is_8bit && !needs_more ? PixelFormat::srgb8 : PixelFormat::linear;
}

// What rendering keeps of a pixel: its codes; or its colour and primitive id, AOVs, and twice all of it if
// there are two renderings.
std::uint64_t bytes_per_pixel(const Options& options, PixelFormat format) {
  if (format == PixelFormat::srgb8) return 3;
  std::uint64_t values = 4;
  if (options.adaptive > 0) values += 11;                     // sums, counts, what the eye sees
  if (options.integrator == Integrator::forward) values += 6; // sums of 64 bits
  for (const Aov aov : aovs_to_render(options)) values += static_cast<std::uint64_t>(aov_info(aov).channels);
  return values * sizeof(float) * (options.verify ? 2 : 1);
}

} // namespace

void check_image_size(const Options& options, const fs::path& picture, Isa isa) {
  const std::uint64_t pixel_bytes = bytes_per_pixel(options, choose_pixel_format(options, picture, isa));
  const auto [width, height] = frame_size(options);
  const std::uint64_t bytes =
      static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * pixel_bytes;
  if (bytes > static_cast<std::uint64_t>(options.max_image_mb) << 20U) {
    throw LimitError("a picture of " + std::to_string(width) + "x" + std::to_string(height) + " takes " +
                     std::to_string((bytes + (1U << 20U) - 1) >> 20U) + " MB, more than --max-image-mb " +
                     std::to_string(options.max_image_mb));
  }
}

RenderSettings render_settings(const Options& options, const fs::path& picture, Isa isa, int threads) {
  RenderSettings settings;
  settings.pixel_format = choose_pixel_format(options, picture, isa);
  settings.width = options.width;
  settings.height = options.height;
  settings.samples_per_pixel = options.samples_per_pixel;
  settings.filter = options.filter;
  settings.crop = options.crop;
  settings.seed = options.seed;
  settings.adaptive = options.adaptive;
  settings.most_samples = options.most_samples;
  settings.light_samples = options.light_samples;
  settings.integrator = options.integrator;
  settings.photons = options.photons.value_or(settings.photons);
  settings.caustic_photons = options.caustic_photons;
  settings.caustic_radius = options.caustic_radius.value_or(0.0F);
  settings.max_depth = options.max_depth;
  settings.min_contribution = options.min_contribution;
  settings.aovs = aovs_to_render(options);
  settings.threads = threads;
  settings.cancelled = &cancelled();
  return settings;
}

} // namespace fastrt::cli
