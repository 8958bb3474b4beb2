// SPDX-License-Identifier: Apache-2.0
#include "bench/compare_options.hpp"

#include <fastrt/error.hpp>

#include <cstdio>

#include "bench/arguments.hpp"
#include "bench/ray_sets.hpp"

namespace fastrt::bench {
namespace {

Vec3 vector(const std::string& text) {
  Vec3 v;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%f,%f,%f%c", &v.x, &v.y, &v.z, &rest) != 3)
    throw UsageError("'" + text + "' is not x,y,z");
  return v;
}

void set_size(const std::string& text, CompareOptions& options) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &options.width, &options.height, &rest) != 2 ||
      options.width < 16 || options.height < 16)
    throw UsageError("'" + text + "' is not a size such as 1024x1024");
  options.width -= options.width % 16;
  options.height -= options.height % 16;
}

// "mirror,point shadow": each must start the name of exactly the sets that it takes.
std::vector<std::string> ray_sets(const std::string& text) {
  std::vector<std::string> chosen;
  for (const std::string& part : split(text)) {
    const std::size_t before = chosen.size();
    for (const std::string& name : ray_set_names())
      if (name.starts_with(part)) chosen.push_back(name);
    if (chosen.size() == before) throw UsageError("no rays are called '" + part + "'");
  }
  return chosen;
}

// An option that takes a value; false if there is none of that name.
bool set_value(const std::string& name, const std::string& value, CompareOptions& options) {
  if (name == "--isa") {
    options.isas.clear();
    for (const std::string& isa : split(value)) options.isas.push_back(select_isa(isa));
  } else if (name == "--threads") {
    options.threads.clear();
    for (const std::string& count : split(value)) options.threads.push_back(whole_number(count));
  } else if (name == "--rays") {
    options.rays = ray_sets(value);
  } else if (name == "--rounds") {
    options.rounds = whole_number(value);
  } else if (name == "--seconds") {
    options.seconds = number(value, 1e-3);
  } else if (name == "--size") {
    set_size(value, options);
  } else if (name == "--eye") {
    options.eye = vector(value);
  } else if (name == "--look-at") {
    options.look_at = vector(value);
  } else if (name == "--json") {
    options.json = value;
  } else {
    return false;
  }
  return true;
}

bool set_flag(const std::string& name, CompareOptions& options) {
  if (name == "--quick") {
    options.rounds = 7;
    options.seconds = 0.02;
  } else if (name == "--inside") {
    options.inside = true;
  } else if (name == "--outside") {
    options.inside = false;
  } else if (name == "--no-scalar") {
    std::erase(options.isas, Isa::scalar);
  } else if (name == "--no-build") {
    options.build = false;
  } else if (name == "--help" || name == "-h") {
    options.help = true;
  } else {
    return false;
  }
  return true;
}

} // namespace

CompareOptions parse_compare_options(int count, char** arguments) {
  CompareOptions options;
  options.isas = available_isas();
  options.rays = ray_set_names();
  for (int i = 1; i < count; ++i) {
    const std::string name = arguments[i];
    if (!name.starts_with("-")) {
      options.models.push_back(name);
      continue;
    }
    if (set_flag(name, options)) continue;
    if (i + 1 == count) throw UsageError("unknown option or missing value: " + name);
    if (!set_value(name, arguments[++i], options)) throw UsageError("unknown option: " + name);
  }
  return options;
}

std::string compare_usage() {
  return "usage: fastrt_compare [options] MODEL...\n"
         "Times fastrt's kernels and Embree 3 on the same rays, in turn, in one process.\n"
         "MODEL: an OBJ file or a generated scene (balls, terrain, tree).\n"
         "  --isa LIST      scalar,sse4.2,avx2,avx512 (all that run here)\n"
         "  --threads LIST  1,2\n"
         "  --rays LIST     primary, point shadow, directional shadow, mirror, refracted, random;\n"
         "                  beginnings of names will do (all)\n"
         "  --rounds N      rounds of each comparison (9)\n"
         "  --seconds S     that a contender's part of a round takes each thread, about (0.08)\n"
         "  --size WxH      pixels of the picture that the rays are taken from (1024x1024)\n"
         "  --eye X,Y,Z     camera; --look-at X,Y,Z its target\n"
         "  --inside        view from inside the model (names with 'sponza'); --outside\n"
         "  --no-scalar     leave out one ray at a time through the binary tree, which is slow\n"
         "  --no-build      do not time building\n"
         "  --quick         7 rounds of 0.02 s\n"
         "  --json FILE     write all numbers\n";
}

} // namespace fastrt::bench
