// SPDX-License-Identifier: Apache-2.0
// The only file that includes CLI11, which is slow to compile.
#include "src/cli/options.hpp"

#include "src/cli/help.hpp"
#include "src/cli/parse.hpp"
#include "src/load/spelling.hpp"
#include "src/scene/picture_limits.hpp"

#include <fastrt/error.hpp>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

namespace fastrt::cli {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

std::string help_text(const CLI::App& app) {
  std::string text = app.help();
  replace_all(text, "\n\n\n", "\n\n");
  replace_all(text, "--stats{text} [=text|json]  ", "--stats[=text|json]         ");
  replace_all(text, "--signature{/} [=FILE]  ", "--signature[=FILE]      ");
  replace_all(text, "--caustics{/} [=N]  ", "--caustics[=N]      ");
  replace_all(text, "\nUsage:", "\n\nUsage:");
  return text;
}

constexpr std::int64_t usual_caustic_photons = 200000;

std::int64_t caustic_photons(const std::string& text) {
  if (text.empty()) return 0;
  return text == "/" ? usual_caustic_photons : parse_integer("--caustics", text, 1, most_caustic_photons);
}

StatsFormat stats_format(const std::string& text) {
  if (text.empty()) return StatsFormat::none;
  if (text == "text") return StatsFormat::text;
  if (text == "json") return StatsFormat::json;
  throw UsageError("--stats: '" + text + "' is not text or json");
}

// Adds options whose values are read by the functions of parse.hpp; the last of several wins.
class OptionAdder {
public:
  OptionAdder(CLI::App& app, Options& options) : app_(app), given_(options.given) {}

  void group(std::string name) { group_ = std::move(name); }

  template <class Read>
  void value(const std::string& names, const char* placeholder, const char* help, Read read) {
    const std::string long_name = names.substr(names.find("--"));
    const auto call = [this, long_name, read](const std::string& text) {
      read(long_name, text);
      given_.insert(long_name);
    };
    app_.add_option_function<std::string>(names, call, help)
        ->option_text(placeholder)
        ->type_name("value")
        ->take_last()
        ->group(group_);
  }

  void flag(const std::string& names, bool& target, bool meaning, const char* help) {
    app_.add_flag_callback(
            names, [&target, meaning] { target = meaning; }, help)
        ->group(group_);
  }

private:
  CLI::App& app_;
  std::set<std::string>& given_;
  std::string group_;
};

void add_image_options(CLI::App& app, OptionAdder& add, Options& options, std::string& signature) {
  add.group("Image");
  add.value("-o,--output", "FILE",
            "Where the picture goes [SCENE.png in this folder]; 'none': nowhere; '-': stdout",
            [&](const std::string& name, const std::string& text) {
              if (text.empty()) throw UsageError(name + ": a file name is missing");
              options.output = text;
            });
  add.value("--aov", "NAME,...", "More values a pixel: all, or some of those below",
            [&](const std::string& name, const std::string& text) { options.aovs = parse_aovs(name, text); });
  // A flag with a value: only what follows it after '=' is its.
  app.add_flag("--signature{/}", signature, "A picture of the objects, each in a colour of its own")
      ->option_text("[=FILE]")
      ->group("Image");
  add.value("-r,--resolution", "WxH", "Size in pixels [the scene's, or 1024x768]",
            [&](const std::string& name, const std::string& text) {
              const Resolution size = parse_resolution(name, text);
              options.width = size.width;
              options.height = size.height;
            });
  add.value("--crop", "X0,Y0,X1,Y1", "Columns X0 to X1 - 1 and rows Y0 to Y1 - 1 of the picture alone",
            [&](const std::string& name, const std::string& text) { options.crop = parse_crop(name, text); });
  add.value("--max-image-mb", "N", "Refuse pictures that take more memory than this [1024]",
            [&](const std::string& name, const std::string& text) {
              options.max_image_mb = parse_integer(name, text, 1, std::int64_t{1} << 30);
            });
}

void add_sampling_options(OptionAdder& add, Options& options) {
  add.group("Sampling (what is not given is the scene's, or as in brackets)");
  add.value("-s,--spp", "N", "Samples per pixel [1: the pixel's centre]",
            [&](const std::string& name, const std::string& text) {
              options.samples_per_pixel =
                  static_cast<int>(parse_integer(name, text, 1, most_samples_a_pixel));
            });
  add.value(
      "--filter", "NAME", "How samples make a pixel: box, tent, gaussian or mitchell [tent]",
      [&](const std::string& name, const std::string& text) { options.filter = parse_filter(name, text); });
  add.value("--adaptive", "T", "More samples where neighbours differ by more than T, 0 to 1 [0: off]",
            [&](const std::string& name, const std::string& text) {
              options.adaptive = text == "0" ? 0 : parse_length(name, text);
              if (options.adaptive > 1) throw UsageError(name + ": '" + text + "' is greater than 1");
            });
  add.value("--max-spp", "N", "How many those may get [16 times --spp]",
            [&](const std::string& name, const std::string& text) {
              options.most_samples = static_cast<int>(parse_integer(name, text, 1, most_adaptive_samples));
            });
  add.value("--seed", "N", "Another set of samples [0]",
            [&](const std::string& name, const std::string& text) {
              options.seed = static_cast<std::uint32_t>(
                  parse_integer(name, text, 0, std::numeric_limits<std::uint32_t>::max()));
            });
  add.value("--max-depth", "N", "Bounces after the camera ray, at most 64 [8]",
            [&](const std::string& name, const std::string& text) {
              const auto depth = parse_integer(name, text, 0, std::numeric_limits<int>::max());
              if (depth > most_bounces)
                options.warnings.push_back(name + ": 64 bounces are the most, 64 taken");
              options.max_depth = static_cast<int>(depth > most_bounces ? most_bounces : depth);
            });
  add.value("--min-contribution", "X", "Drop rays that weigh less, 0 to 1 [0.00390625]",
            [&](const std::string& name, const std::string& text) {
              options.min_contribution = parse_number(name, text);
              if (options.min_contribution < 0 || options.min_contribution > 1) {
                throw UsageError(name + ": '" + text + "' is not a number from 0 to 1");
              }
            });
}

void add_view_options(OptionAdder& add, Options& options) {
  add.group("Camera (what is not given is the scene's, or chosen to show all of it)");
  add.value("--eye", "X,Y,Z", "Where the camera is", [&](const std::string& name, const std::string& text) {
    options.eye = parse_vector(name, text);
  });
  add.value("--look-at", "X,Y,Z", "What it looks at", [&](const std::string& name, const std::string& text) {
    options.look_at = parse_vector(name, text);
  });
  add.value("--up", "X,Y,Z", "Which way is up [0,1,0]",
            [&](const std::string& name, const std::string& text) { options.up = parse_vector(name, text); });
  add.value("--fov", "DEG", "Vertical field of view in degrees [40]",
            [&](const std::string& name, const std::string& text) {
              options.fov_degrees = parse_number(name, text);
              if (options.fov_degrees <= 0 || options.fov_degrees >= 180) {
                throw UsageError(name + ": '" + text + "' is not an angle between 0 and 180");
              }
            });
  add.value("--ortho", "HEIGHT|auto", "Parallel rays; the picture shows HEIGHT, auto: the whole scene",
            [&](const std::string& name, const std::string& text) {
              options.orthographic = true;
              options.view_height.reset();
              if (text != "auto") options.view_height = parse_length(name, text);
            });
  add.value(
      "--window", "WL,WR,WB,WT", "What the picture shows of the view plane, to the outer pixels' centres",
      [&](const std::string& name, const std::string& text) { options.window = parse_window(name, text); });
  add.value("--focal", "F", "How far from the eye the window is [1]",
            [&](const std::string& name, const std::string& text) {
              options.focal_distance = parse_length(name, text);
            });
  add.value("--aperture", "R", "Radius of a thin lens [0: a pinhole]; takes several samples a pixel",
            [&](const std::string& name, const std::string& text) {
              options.aperture_radius = text == "0" ? 0 : parse_length(name, text);
            });
  add.value("--focus", "D", "How far from the eye the lens is sharp [the look-at point]",
            [&](const std::string& name, const std::string& text) {
              options.focus_distance = parse_length(name, text);
            });
}

void add_photon_options(CLI::App& app, OptionAdder& add, Options& options, std::string& caustics) {
  add.group("Photons");
  add.value("--integrator", "NAME", "whitted, or forward: rays from the lights to the eye [whitted]",
            [&](const std::string& name, const std::string& text) {
              options.integrator = parse_integrator(name, text);
            });
  add.value("--photons", "N", "How many rays forward casts from the lights [1000000]",
            [&](const std::string& name, const std::string& text) {
              options.photons = parse_integer(name, text, 1, most_photons);
            });
  // A flag with a value: only what follows it after '=' is its.
  app.add_flag("--caustics{/}", caustics, "Light by mirrors and glass, from N photons [200000]")
      ->option_text("[=N]")
      ->group("Photons");
  add.value("--caustic-radius", "R", "What it is averaged over [chosen by the photons' density]",
            [&](const std::string& name, const std::string& text) {
              options.caustic_radius = parse_length(name, text);
            });
}

// What options ask for together.
void check_together(Options& options) {
  check_photons_together(options);
  if (options.given.contains("--resolution")) check_crop(options);
  if (options.orthographic && options.aperture_radius > 0)
    throw UsageError("--aperture: parallel rays go through no lens");
  if (options.most_samples != 0 && options.most_samples < options.samples_per_pixel)
    throw UsageError("--max-spp: less than --spp");
}

constexpr const char* light_group =
    "Light (without --light: the scene's, or its lamps, or a key light and a fill light)";

void add_light_options(CLI::App& app, OptionAdder& add, Options& options) {
  add.group(light_group);
  app.add_option_function<std::vector<std::string>>(
         "--light",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts)
             options.lights.push_back(parse_light_option("--light", text));
         },
         "A light, in one of the forms below; may be repeated")
      ->option_text("LIGHT")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(light_group);
  add.value("--light-samples", "N", "Shadow rays to each light with a size [16]",
            [&](const std::string& name, const std::string& text) {
              options.light_samples = static_cast<int>(parse_integer(name, text, 1, most_light_samples));
            });
  add.value(
      "--ambient", "R,G,B", "Light that is everywhere",
      [&](const std::string& name, const std::string& text) { options.ambient = parse_color(name, text); });
  add.value("--background", "R,G,B", "What is seen where nothing is",
            [&](const std::string& name, const std::string& text) {
              options.background = parse_color(name, text);
            });
}

void add_engine_options(OptionAdder& add, Options& options) {
  add.group("Engine");
  add.value("-t,--threads", "N", "Threads [all cores, or OMP_NUM_THREADS]",
            [&](const std::string& name, const std::string& text) {
              options.threads =
                  static_cast<int>(parse_integer(name, text, 1, std::numeric_limits<int>::max()));
            });
  add.value("--isa", "NAME", "auto, avx512, avx2, sse4.2 or scalar [FASTRT_ISA, or auto: the widest]",
            [&](const std::string&, const std::string& text) { options.isa = text; });
  add.value("--bvh-quality", "NAME", "standard, or high: takes longer to build, and less to trace [standard]",
            [&](const std::string& name, const std::string& text) {
              options.bvh_quality = parse_bvh_quality(name, text);
            });
  add.flag("--no-culling", options.culling, false,
           "Hold every ray against every primitive, to see what bounding volumes buy");
  add.flag("--verify", options.verify, true,
           "Render by plain scalar code too and compare; exit 1 if different");
}

void add_input_options(OptionAdder& add, Options& options) {
  add.group("Input");
  add.flag("--strict", options.strict, true, "Take warnings about the scene for errors");
  add.flag("--allow-external-files", options.allow_external_files, true,
           "Read files that the scene names outside its folder");
  add.flag("--tr-is-opacity", options.tr_is_opacity, true, "In MTL files, Tr 1 means opaque");
  add.flag("--no-sidecar", options.sidecar, false, "Leave a MODEL.toml or scene.toml beside MODEL.obj alone");
}

void add_report_options(CLI::App& app, OptionAdder& add, Options& options, std::string& stats) {
  add.group("Report");
  add.flag("-q,--quiet", options.quiet, true, "Print errors only");
  // A flag with a value: only what follows it after '=' is its.
  app.add_flag("--stats{text}", stats, "Times, rays and tree: text to stderr or json to stdout [text]")
      ->option_text("[=text|json]")
      ->group("Report");
  add.flag("--no-progress", options.show_progress, false, "No progress bar");
}

// "; did you mean '--spp'?"
std::string suggestion(const CLI::App& app, const std::string& unknown) {
  if (!unknown.starts_with("--")) return {};
  std::vector<std::string_view> known;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.emplace_back(name);
  const std::string_view nearest = nearest_name(unknown.substr(2), known);
  return nearest.empty() ? std::string() : "; did you mean '--" + std::string(nearest) + "'?";
}

// Of what is neither an option nor a value of one: the first unknown option, or else a second scene.
[[noreturn]] void refuse_extras(const CLI::App& app) {
  const std::vector<std::string> extras = app.remaining();
  for (const std::string& extra : extras) {
    const std::string name = extra.starts_with("--") ? extra.substr(0, extra.find('=')) : extra;
    const bool is_option = extra.size() > 1 && extra[0] == '-' && extra != "--";
    if (is_option && app.get_option_no_throw(name) == nullptr) // a known one stands behind "--"
      throw UsageError("unknown option '" + name + "'" + suggestion(app, name));
  }
  throw UsageError("one scene at a time: '" + extras.back() + "' is one too many");
}

} // namespace

Resolution frame_size(const Options& options) {
  if (!options.crop) return {options.width, options.height};
  return {options.crop->x1 - options.crop->x0, options.crop->y1 - options.crop->y0};
}

void check_crop(const Options& options) {
  if (options.crop && (options.crop->x1 > options.width || options.crop->y1 > options.height))
    throw UsageError("--crop: it reaches beyond the picture of " + std::to_string(options.width) + "x" +
                     std::to_string(options.height));
}

Options parse_options(int argc, const char* const* argv) {
  Options options;
  CLI::App app("Ray traces a 3D model (Wavefront OBJ, NFF, PLY, scene.toml) and writes the picture.",
               "fastrt");
  app.get_formatter()->column_width(34);
  app.get_formatter()->label("OPTIONS", "options");
  app.get_formatter()->label("Positionals", "Scene");
  app.footer(help_footer());
  app.add_option("scene", options.scene,
                 "The scene: an .obj, .nff, .ply or .toml file; after '--' its name may begin with '-'")
      ->option_text("FILE")
      ->required();
  app.set_help_flag();
  OptionAdder add(app, options);
  std::string signature;
  add_image_options(app, add, options, signature);
  add_sampling_options(add, options);
  std::string caustics;
  add_photon_options(app, add, options, caustics);
  add_view_options(add, options);
  add_light_options(app, add, options);
  add_engine_options(add, options);
  add_input_options(add, options);
  std::string stats;
  add_report_options(app, add, options, stats);
  app.set_help_flag("-h,--help", "This text")->group("Help");
  app.set_version_flag("--version", version_text, "Version and instruction sets")->group("Help");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    options.answer = help_text(app);
  } catch (const CLI::CallForVersion&) {
    options.answer = version_text();
  } catch (const CLI::ParseError& error) {
    if (app.remaining_size() != 0) refuse_extras(app);
    throw UsageError(std::string(error.what()));
  }
  options.stats = stats_format(stats);
  options.caustic_photons = caustic_photons(caustics);
  check_together(options);
  if (!signature.empty()) options.signature = signature == "/" ? "" : signature;
  return options;
}

} // namespace fastrt::cli
