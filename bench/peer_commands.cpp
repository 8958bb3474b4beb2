// SPDX-License-Identifier: Apache-2.0
#include "bench/peer_commands.hpp"

#include "bench/processes.hpp"

namespace fastrt::bench {
namespace {

using Words = std::vector<std::string>;

std::string in(const std::string& folder, const char* name) { return folder + '/' + name; }

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

void append(Words& words, const char* option, const Vec3& v) {
  words.emplace_back(option);
  for (int c = 0; c < 3; ++c) words.push_back(std::to_string(v[c]));
}

void add_fastrt(std::vector<PeerCommand>& commands, const RunSettings& settings, const std::string& model,
                const Words& more) {
  const std::string size = std::to_string(settings.size);
  for (const std::string format : {"png", "ppm"}) {
    const std::string picture = settings.folder + "/fastrt." + format;
    Words words{settings.fastrt,   model,       "--quiet",
                "--spp",           "1",         "--resolution",
                size + 'x' + size, "--threads", std::to_string(settings.threads),
                "--output",        picture};
    append(words, more);
    commands.push_back({"fastrt (" + format + ")", std::move(words), picture});
  }
}

void add_pathtracer(std::vector<PeerCommand>& commands, const RunSettings& settings, const std::string& model,
                    const Picture& picture) {
  const auto program = find_program("pathtracer");
  if (!program) return;
  const std::string size = std::to_string(settings.size), file = in(settings.folder, "embree.ppm");
  Words words{*program, "-i", model, "-o", file, "--size", size, size};
  append(words, "--vp", picture.camera.eye);
  append(words, "--vi", picture.camera.look_at);
  append(words, "--vu", picture.camera.up);
  append(words, "--directionallight", picture.light_travel);
  append(words, {"2.8", "2.8", "2.8", "--spp", "1", "--max-path-length", "1"});
  append(words, {"--fov", std::to_string(picture.camera.fov_degrees), "--threads",
                 std::to_string(settings.threads)});
  commands.push_back({"embree pathtracer", std::move(words), file});
}

void add_tachyon(std::vector<PeerCommand>& commands, const RunSettings& settings) {
  for (const char* name : {"tachyon-nox", "tachyon"}) {
    const auto program = find_program(name);
    if (!program) continue;
    const std::string file = in(settings.folder, "tachyon.ppm");
    commands.push_back({"tachyon",
                        {*program, tachyon_scene(settings.folder), "-numthreads",
                         std::to_string(settings.threads), "-format", "PPM", "-o", file},
                        file});
    return;
  }
}

void add_povray(std::vector<PeerCommand>& commands, const RunSettings& settings) {
  const auto program = find_program("povray");
  if (!program) return;
  const std::string size = std::to_string(settings.size), file = in(settings.folder, "povray.ppm");
  commands.push_back({"povray",
                      {*program, "+I" + povray_scene(settings.folder), "+O" + file, "+FP", "+W" + size,
                       "+H" + size, "+WT" + std::to_string(settings.threads), "-D", "-A", "-V"},
                      file});
}

} // namespace

std::string povray_scene(const std::string& folder) { return in(folder, "scene.pov"); }
std::string tachyon_scene(const std::string& folder) { return in(folder, "scene.dat"); }

std::string plain_obj(const std::string& folder) { return in(folder, "plain.obj"); }

std::vector<PeerCommand> obj_commands(const RunSettings& settings, const Picture& picture) {
  const std::string model = plain_obj(settings.folder);
  const Vec3& travel = picture.light_travel;
  const std::string light =
      "dir:" + std::to_string(travel.x) + ',' + std::to_string(travel.y) + ',' + std::to_string(travel.z);
  std::vector<PeerCommand> commands;
  add_fastrt(commands, settings, model, {"--light", light});
  add_pathtracer(commands, settings, model, picture);
  add_tachyon(commands, settings);
  add_povray(commands, settings);
  return commands;
}

std::vector<PeerCommand> nff_commands(const RunSettings& settings, const std::string& model) {
  std::vector<PeerCommand> commands;
  add_fastrt(commands, settings, model, {"--max-depth", std::to_string(settings.depth)});
  add_tachyon(commands, settings);
  add_povray(commands, settings);
  return commands;
}

} // namespace fastrt::bench
