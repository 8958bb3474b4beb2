// SPDX-License-Identifier: Apache-2.0
#include "src/cli/stats.hpp"

#include "src/scene/printable.hpp"

#include <sys/resource.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace fastrt::cli {
namespace {

// A number with as many digits as a reader wants: 0.0312, 0.31, 3.1, 41.
std::string short_number(double value) {
  char text[48];
  const double size = std::fabs(value);
  const char* format = size >= 10 || size == 0 ? "%.0f" : size >= 1 ? "%.1f" : size >= 0.1 ? "%.2f" : "%.2g";
  if (size != 0 && size < 0.001) format = "%.4f";
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string seconds(double value) {
  char text[48];
  std::snprintf(text, sizeof text, value >= 100 ? "%.0f s" : value >= 0.1 ? "%.2f s" : "%.4f s", value);
  return text;
}

std::string count(std::size_t number, const char* noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

double mega(double value) { return value * 1e-6; }

// A file name as a JSON string. Bytes that are no UTF-8 become U+FFFD.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text, i);
    if (length == 0) {
      result += "\\ufffd";
    } else if (byte < 0x20 || byte == 0x7F) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(byte));
      result += escape;
    } else {
      if (byte == '"' || byte == '\\') result += '\\';
      result += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return result + "\"";
}

// Puts together an object of name and value pairs.
class JsonObject {
public:
  void raw(const char* name, const std::string& value) {
    text_ += (text_.empty() ? "\"" : ", \"") + std::string(name) + "\": " + value;
  }
  void add(const char* name, const std::string& value) { raw(name, quoted(value)); }
  void add(const char* name, double value) {
    char number[48];
    std::snprintf(number, sizeof number, "%.9g", std::isfinite(value) ? value : 0.0);
    raw(name, number);
  }
  void add(const char* name, std::uint64_t value) { raw(name, std::to_string(value)); }
  void add(const char* name, int value) { raw(name, std::to_string(value)); }
  std::string text() const { return "{" + text_ + "}"; }

private:
  std::string text_;
};

std::string rays_json(const RayCounts& rays) {
  JsonObject object;
  object.add("primary", rays.primary);
  object.add("shadow", rays.shadow);
  object.add("reflected", rays.reflected);
  object.add("refracted", rays.refracted);
  object.add("total", rays.total());
  return object.text();
}

// A kind of rays and what it took to trace them.
struct TestedRays {
  const char* name;
  std::uint64_t rays;
  TestCounts tests;
  double boxes_per_ray() const { return per_ray(tests.boxes); }
  double primitives_per_ray() const { return per_ray(tests.primitives); }

private:
  double per_ray(std::uint64_t count) const {
    return rays == 0 ? 0.0 : static_cast<double>(count) / static_cast<double>(rays);
  }
};

std::array<TestedRays, 3> tested_rays(const RunStats& stats) {
  const RayCounts& rays = stats.rays;
  return {{{"primary", rays.primary, stats.tests.primary},
           {"shadow", rays.shadow, stats.tests.shadow},
           {"secondary", rays.reflected + rays.refracted, stats.tests.secondary}}};
}

std::string tests_json(const RunStats& stats) {
  JsonObject object;
  for (const TestedRays& kind : tested_rays(stats)) {
    JsonObject counts;
    counts.add("boxes", kind.tests.boxes);
    counts.add("primitives", kind.tests.primitives);
    counts.add("boxes_per_ray", kind.boxes_per_ray());
    counts.add("primitives_per_ray", kind.primitives_per_ray());
    object.raw(kind.name, counts.text());
  }
  return object.text();
}

// "tests    per primary ray 0.9 boxes and 2.3 primitives, per shadow ray ..."; nothing where none are
// counted.
std::string tests_text(const RunStats& stats) {
  std::string text;
  for (const TestedRays& kind : tested_rays(stats)) {
    if (kind.tests.boxes + kind.tests.primitives == 0) continue;
    text += std::string(text.empty() ? "tests    per " : ", per ") + kind.name + " ray " +
            short_number(kind.boxes_per_ray()) + " boxes and " + short_number(kind.primitives_per_ray()) +
            " primitives";
  }
  return text.empty() ? text : text + "\n";
}

std::string seconds_json(const RunStats& stats) {
  JsonObject object;
  object.add("read", stats.read_seconds);
  object.add("build", stats.build_seconds);
  object.add("render", stats.render_seconds);
  object.add("write", stats.write_seconds);
  if (stats.verify) object.add("verify", stats.verify_seconds);
  object.add("total", stats.total_seconds);
  return object.text();
}

std::string quality_word(BvhQuality quality) { return quality == BvhQuality::high ? "high" : "standard"; }

std::string bvh_json(const BvhStats& bvh, BvhQuality quality) {
  JsonObject object;
  object.add("quality", quality_word(quality));
  object.add("sah_cost", bvh.sah_cost);
  object.add("nodes", std::uint64_t{bvh.node_count});
  object.add("leaves", std::uint64_t{bvh.leaf_count});
  object.add("blocks", std::uint64_t{bvh.block_count});
  object.add("depth", bvh.depth);
  object.add("bytes", std::uint64_t{bvh.bytes});
  object.add("bytes_per_primitive", bvh.bytes_per_primitive);
  return object.text();
}

std::string verify_json(const FrameDifference& difference) {
  JsonObject object;
  object.add("pixels", std::uint64_t{difference.pixels});
  object.add("primitives", std::uint64_t{difference.primitives});
  object.add("aovs", std::uint64_t{difference.aovs});
  object.add("largest", difference.largest);
  return object.text();
}

} // namespace

double RunStats::mrays_per_second() const {
  return render_seconds > 0 ? mega(static_cast<double>(rays.total())) / render_seconds : 0;
}

std::string summary_line(const RunStats& stats) {
  std::string line = stats.output.empty() ? "no picture kept" : printable(stats.output);
  line += ": " + std::to_string(stats.width) + "x" + std::to_string(stats.height);
  if (stats.triangles != 0 || stats.spheres + stats.shapes == 0)
    line += ", " + count(stats.triangles, "triangle");
  if (stats.spheres != 0) line += ", " + count(stats.spheres, "sphere");
  if (stats.shapes != 0) line += ", " + count(stats.shapes, "shape");
  if (stats.instances != 0) line += ", " + count(stats.instances, "instance");
  line += ", " + std::to_string(stats.samples_per_pixel);
  if (stats.most_samples != 0) line += " to " + std::to_string(stats.most_samples);
  line += " spp, ";
  if (stats.most_samples != 0) line += short_number(stats.mean_samples) + " on average, ";
  line += short_number(mega(static_cast<double>(stats.rays.total()))) + " Mrays in " +
          seconds(stats.render_seconds) + " (" + short_number(stats.mrays_per_second()) +
          " Mrays/s), total " + seconds(stats.total_seconds);
  return line + "\n";
}

std::string stats_text(const RunStats& stats) {
  const RayCounts& rays = stats.rays;
  const BvhStats& bvh = stats.bvh;
  std::string text = "scene    " + count(stats.triangles, "triangle") + ", " +
                     count(stats.spheres, "sphere") + ", " + count(stats.shapes, "shape") + ", " +
                     (stats.instances != 0 ? count(stats.instances, "instance") + ", " : "") +
                     count(stats.lights, "light") + ", " +
                     short_number(mega(static_cast<double>(stats.scene_bytes))) + " MB\n";
  text += "engine   " + std::string(isa_name(stats.isa)) + ", " +
          count(std::size_t(stats.threads), "thread") + "\n";
  text += "seconds  read " + seconds(stats.read_seconds) + ", build " + seconds(stats.build_seconds) +
          ", render " + seconds(stats.render_seconds) + ", write " + seconds(stats.write_seconds) +
          (stats.verify ? ", verify " + seconds(stats.verify_seconds) : "") + ", total " +
          seconds(stats.total_seconds) + "\n";
  text += "rays     " + std::to_string(rays.total()) + ": primary " + std::to_string(rays.primary) +
          ", shadow " + std::to_string(rays.shadow) + ", reflected " + std::to_string(rays.reflected) +
          ", refracted " + std::to_string(rays.refracted) + "; " + short_number(stats.mrays_per_second()) +
          " Mrays/s\n";
  text += tests_text(stats);
  text += "tree     " + quality_word(stats.bvh_quality) + " quality, SAH cost " + short_number(bvh.sah_cost) +
          ", " + count(bvh.node_count, "node") + ", " + std::to_string(bvh.leaf_count) + " leaves, " +
          count(bvh.block_count, "block") + ", depth " + std::to_string(bvh.depth) + ", " +
          short_number(mega(static_cast<double>(bvh.bytes))) + " MB (" +
          short_number(bvh.bytes_per_primitive) + " bytes a primitive)\n";
  text += "memory   " + short_number(mega(static_cast<double>(stats.peak_rss_bytes))) + " MB at most\n";
  return text;
}

std::string stats_json(const RunStats& stats) {
  JsonObject object;
  object.add("scene", stats.scene);
  object.raw("output", stats.output.empty() ? "null" : quoted(stats.output));
  object.add("width", stats.width);
  object.add("height", stats.height);
  object.add("spp", stats.samples_per_pixel);
  if (stats.most_samples != 0) {
    object.add("most_spp", stats.most_samples);
    object.add("mean_spp", stats.mean_samples);
  }
  object.add("isa", std::string(isa_name(stats.isa)));
  object.add("threads", stats.threads);
  object.add("triangles", std::uint64_t{stats.triangles});
  object.add("spheres", std::uint64_t{stats.spheres});
  object.add("shapes", std::uint64_t{stats.shapes});
  object.add("instances", std::uint64_t{stats.instances});
  object.add("lights", std::uint64_t{stats.lights});
  object.raw("seconds", seconds_json(stats));
  object.raw("rays", rays_json(stats.rays));
  object.raw("tests", tests_json(stats));
  object.add("mrays_per_second", stats.mrays_per_second());
  object.raw("bvh", bvh_json(stats.bvh, stats.bvh_quality));
  object.add("scene_bytes", std::uint64_t{stats.scene_bytes});
  object.add("peak_rss_bytes", std::uint64_t{stats.peak_rss_bytes});
  if (stats.verify) object.raw("verify", verify_json(*stats.verify));
  return object.text() + "\n";
}

std::string verify_text(const RunStats& stats) {
  if (!stats.verify) return {};
  const std::string all =
      " of " + std::to_string(std::uint64_t(stats.width) * std::uint64_t(stats.height)) + " ";
  char largest[48];
  std::snprintf(largest, sizeof largest, "%.9g", stats.verify->largest);
  return "verify: " + std::to_string(stats.verify->pixels) + all + "pixels differ\n" +
         "verify: " + std::to_string(stats.verify->primitives) + all + "primitive ids differ\n" +
         (stats.aovs == 0 ? "" : "verify: " + std::to_string(stats.verify->aovs) + all + "AOVs differ\n") +
         "verify: the largest difference is " + largest + "\n";
}

std::size_t peak_rss_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

} // namespace fastrt::cli
