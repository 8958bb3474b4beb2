// SPDX-License-Identifier: Apache-2.0
// fastrt_runs: the whole run (read, build, render, write) of fastrt beside that of other renderers, as far as
// they are installed: Embree's pathtracer, tachyon, POV-Ray.
#include <fastrt/fastrt.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "bench/arguments.hpp"
#include "bench/measure.hpp"
#include "bench/nff_scenes.hpp"
#include "bench/peer_commands.hpp"
#include "bench/peer_scenes.hpp"
#include "bench/processes.hpp"

namespace fastrt::bench {
namespace {

struct Options {
  std::string fastrt; // the program
  std::vector<std::string> models;
  std::vector<int> threads{1, 2};
  int size = 1024, rounds = 7;
  double patience = 10; // seconds after which a program that ran three times does not run again
  std::string json;
  std::string keep; // folder for scenes and pictures; empty: a temporary one
};

struct Run {
  PeerCommand command;
  std::vector<double> seconds, cpu_seconds;
  std::size_t peak_bytes = 0;
  std::string fault; // empty if it wrote its picture
};

const char* const usage = "usage: fastrt_runs [options] MODEL...\n"
                          "Times whole runs of fastrt and of what is installed of pathtracer (embree-tools), "
                          "tachyon and povray, in turn. Models are OBJ and NFF files.\n"
                          "  --fastrt FILE   the program (fastrt of PATH)\n"
                          "  --threads LIST  1,2\n"
                          "  --size N        pixels a side (1024)\n"
                          "  --rounds N      (7)\n"
                          "  --patience S    after this many seconds three rounds of a program will do (10)\n"
                          "  --keep FOLDER   leave the scenes and pictures there\n"
                          "  --json FILE     write all numbers\n";

Options parse(int count, char** arguments) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string name = arguments[i];
    if (!name.starts_with("-")) {
      options.models.push_back(name);
      continue;
    }
    if (i + 1 == count) throw UsageError("unknown option or missing value: " + name);
    const std::string value = arguments[++i];
    if (name == "--fastrt") {
      options.fastrt = value;
    } else if (name == "--threads") {
      options.threads.clear();
      for (const std::string& part : split(value)) options.threads.push_back(whole_number(part));
    } else if (name == "--size") {
      options.size = whole_number(value);
    } else if (name == "--rounds") {
      options.rounds = whole_number(value);
    } else if (name == "--patience") {
      options.patience = number(value, 0);
    } else if (name == "--json") {
      options.json = value;
    } else if (name == "--keep") {
      options.keep = value;
    } else {
      throw UsageError("unknown option: " + name);
    }
  }
  if (options.fastrt.empty()) options.fastrt = find_program("fastrt").value_or("");
  if (options.fastrt.empty()) throw UsageError("no fastrt in PATH; give --fastrt FILE");
  return options;
}

// A folder for scenes and pictures; a temporary one is removed at the end.
class WorkFolder {
public:
  explicit WorkFolder(const std::string& keep)
      : path_(keep.empty()
                  ? std::filesystem::temp_directory_path() / ("fastrt_runs_" + std::to_string(getpid()))
                  : std::filesystem::path(keep)),
        temporary_(keep.empty()) {
    std::filesystem::create_directories(path_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  ~WorkFolder() {
    std::error_code ignored;
    if (temporary_) std::filesystem::remove_all(path_, ignored);
  }
  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
  bool temporary_;
};

// Whether a program has run long enough to be known, so that slow ones do not take minutes.
bool known(const Run& run, double patience) {
  constexpr std::size_t enough = 3;
  return !run.fault.empty() || (run.seconds.size() >= enough &&
                                std::accumulate(run.seconds.begin(), run.seconds.end(), 0.0) > patience);
}

// (Some end well although they could not read their scene.)
ProcessResult run_once(const PeerCommand& command, std::string& fault) {
  std::error_code error;
  std::filesystem::remove(command.picture, error);
  const ProcessResult result = run_process(command.words);
  if (result.exit_code != 0)
    fault = "exit code " + std::to_string(result.exit_code);
  else if (std::filesystem::file_size(command.picture, error) == 0 || error)
    fault = "no picture";
  return result;
}

void measure(std::vector<Run>& runs, const Options& options) {
  for (int round = 0; round < options.rounds; ++round)
    for (Run& run : runs) {
      if (known(run, options.patience)) continue;
      const ProcessResult result = run_once(run.command, run.fault);
      run.seconds.push_back(result.seconds);
      run.cpu_seconds.push_back(result.cpu_seconds);
      run.peak_bytes = std::max(run.peak_bytes, result.peak_bytes);
    }
}

Spread ratio_to_first(const std::vector<Run>& runs, const Run& run) {
  std::vector<double> ratios;
  if (!runs[0].fault.empty() || !run.fault.empty()) return {};
  for (std::size_t i = 0; i < run.seconds.size() && i < runs[0].seconds.size(); ++i)
    ratios.push_back(run.seconds[i] / runs[0].seconds[i]);
  return spread_of(ratios);
}

void print(const std::string& model, int threads, const std::vector<Run>& runs) {
  std::printf("%s, %d thread%s\n", model.c_str(), threads, threads == 1 ? "" : "s");
  std::printf("  %-20s %9s %9s %9s   %s\n", "", "s", "CPU s", "peak MB", "times fastrt's");
  for (const Run& run : runs) {
    if (!run.fault.empty()) {
      std::printf("  %-20s failed: %s\n", run.command.name.c_str(), run.fault.c_str());
      continue;
    }
    const Spread ratio = ratio_to_first(runs, run);
    std::printf("  %-20s %9.3f %9.3f %9.1f   %.2f (%.2f-%.2f)\n", run.command.name.c_str(),
                spread_of(run.seconds).median, spread_of(run.cpu_seconds).median,
                1e-6 * static_cast<double>(run.peak_bytes), ratio.median, ratio.smallest, ratio.largest);
  }
  std::fflush(stdout);
}

std::string json_of(const std::string& model, int threads, const std::vector<Run>& runs) {
  std::ostringstream out;
  for (const Run& run : runs) {
    const Spread ratio = ratio_to_first(runs, run), seconds = spread_of(run.seconds);
    out << (&run == runs.data() ? "" : ",\n") << "  {\"model\": \"" << model << "\", \"threads\": " << threads
        << ", \"program\": \"" << run.command.name << "\", \"fault\": \"" << run.fault
        << "\", \"seconds\": {\"median\": " << seconds.median << ", \"min\": " << seconds.smallest
        << ", \"max\": " << seconds.largest << "}, \"cpu_seconds\": " << spread_of(run.cpu_seconds).median
        << ", \"peak_bytes\": " << run.peak_bytes << ", \"times_fastrt\": {\"median\": " << ratio.median
        << ", \"min\": " << ratio.smallest << ", \"max\": " << ratio.largest << "}}";
  }
  return out.str();
}

std::string stem(const std::string& model) { return std::filesystem::path(model).stem().string(); }

// Measures what `commands` returns for each number of threads.
template <class Commands>
void run_commands(const Options& options, const std::string& model, const WorkFolder& folder,
                  const Commands& commands, std::vector<std::string>& json) {
  for (const int threads : options.threads) {
    std::vector<Run> runs;
    for (PeerCommand& command : commands(RunSettings{options.fastrt, folder.path(), threads, options.size}))
      runs.emplace_back().command = std::move(command);
    measure(runs, options);
    print(stem(model), threads, runs);
    json.push_back(json_of(stem(model), threads, runs));
  }
}

void run_obj(const Options& options, const std::string& model, std::vector<std::string>& json) {
  Diagnostics diagnostics;
  SceneDesc desc = load_scene(model, {}, diagnostics);
  const Camera camera = frame_scene(bounds_of(desc), 40.0F, 1.0F);
  add_default_lights(desc, bounds_of(desc), camera);
  const Picture picture{desc, camera, desc.lights[0].direction, options.size};
  const WorkFolder folder(options.keep);
  write_plain_obj(desc, plain_obj(folder.path()));
  write_povray(picture, povray_scene(folder.path()));
  write_tachyon(picture, tachyon_scene(folder.path()));
  const auto commands = [&](const RunSettings& settings) { return obj_commands(settings, picture); };
  run_commands(options, model, folder, commands, json);
}

void run_nff(const Options& options, const std::string& model, std::vector<std::string>& json) {
  const WorkFolder folder(options.keep);
  const int depth = RunSettings{}.depth;
  write_povray_of_nff(model, povray_scene(folder.path()), depth);
  write_tachyon_of_nff(model, tachyon_scene(folder.path()), options.size, depth);
  run_commands(
      options, model, folder, [&](const RunSettings& settings) { return nff_commands(settings, model); },
      json);
}

int run(int count, char** arguments) {
  const Options options = parse(count, arguments);
  if (options.models.empty()) throw UsageError(std::string("no model given\n") + usage);
  std::vector<std::string> json;
  for (const std::string& model : options.models)
    (model.ends_with(".nff") ? run_nff : run_obj)(options, model, json);
  if (options.json.empty()) return 0;
  std::ofstream file(options.json);
  file << "{\"runs\": [\n";
  for (std::size_t i = 0; i < json.size(); ++i) file << json[i] << (i + 1 == json.size() ? "\n" : ",\n");
  file << "]}\n";
  file.close();
  if (!file) throw OutputError("cannot write " + options.json);
  return 0;
}

} // namespace
} // namespace fastrt::bench

int main(int count, char** arguments) {
  if (count > 2 && std::string(arguments[1]) == fastrt::bench::measure_option)
    return fastrt::bench::measure_process(arguments + 2);
  return fastrt::bench::guarded_main("fastrt_runs", fastrt::bench::run, count, arguments);
}
