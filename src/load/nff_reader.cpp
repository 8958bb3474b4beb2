// SPDX-License-Identifier: Apache-2.0
#include "src/load/nff_reader.hpp"

#include "src/load/event_log.hpp"
#include "src/load/nff_scene.hpp"
#include "src/load/nff_tokens.hpp"
#include "src/load/text.hpp"
#include "src/load/warn.hpp"
#include "src/scene/picture_limits.hpp"

#include <fastrt/error.hpp>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 30U;
constexpr std::size_t most_vertices = std::size_t{1} << 24U;

// The file's angle lies between the middles of the outermost pixels, a camera's between their edges.
float field_of_view(float angle, int rows) {
  if (rows < 2) return angle;
  const double half = std::tan(static_cast<double>(angle) * std::numbers::pi / 360.0);
  const double edges = half * rows / (rows - 1);
  return static_cast<float>(std::atan(edges) * 360.0 / std::numbers::pi);
}

class NffReader {
public:
  NffReader(std::string_view text, EventLog& log) : tokens_(text, log), log_(log) {}

  SceneDesc run() {
    for (std::string_view word = tokens_.word(); !word.empty(); word = tokens_.word()) {
      begin_ = tokens_.offset();
      read_statement(word);
    }
    return scene_.finish();
  }

private:
  void read_statement(std::string_view word);
  void read_view();
  void read_light();
  void read_fill();
  void read_sphere();
  void read_cone();
  void read_polygon(bool is_patch);
  Vec3 read_color(const char* what);
  void need_fill();
  void warn(const char* kind, std::string message) { log_.warn(begin_, kind, std::move(message)); }

  NffTokens tokens_;
  EventLog& log_;
  NffScene scene_;
  std::uint64_t begin_ = 0; // of the statement
  std::vector<Vec3> vertices_, normals_;
};

void NffReader::read_statement(std::string_view word) {
  if (word == "v") return read_view();
  if (word == "b") return scene_.set_background(read_color("b"));
  if (word == "l") return read_light();
  if (word == "f") return read_fill();
  if (word == "s") return read_sphere();
  if (word == "c") return read_cone();
  if (word == "p") return read_polygon(false);
  if (word == "pp") return read_polygon(true);
  const char first = word.front();
  if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.')
    tokens_.fail("expected a statement (v b l f s c p pp), found " + in_quotes(word));
  warn("unknown statement", "unknown statement " + in_quotes(word) + ": its line is skipped");
  tokens_.skip_line();
}

Vec3 NffReader::read_color(const char* what) {
  const Vec3 color = tokens_.vector(what);
  if (color.x < 0.0F || color.y < 0.0F || color.z < 0.0F)
    tokens_.fail(std::string(what) + ": a colour must not be negative");
  return color;
}

void NffReader::read_view() {
  Camera camera;
  std::optional<Vec3> from, at, up;
  std::optional<float> angle;
  std::size_t width = 0, height = 0;
  for (std::string_view part = tokens_.peek();; part = tokens_.peek()) {
    if (part == "from") {
      tokens_.word();
      from = tokens_.vector("from");
    } else if (part == "at") {
      tokens_.word();
      at = tokens_.vector("at");
    } else if (part == "up") {
      tokens_.word();
      up = tokens_.vector("up");
    } else if (part == "angle") {
      tokens_.word();
      angle = tokens_.number("angle");
      if (!(*angle > 0.0F && *angle < 180.0F)) tokens_.fail("angle: must be between 0 and 180 degrees");
    } else if (part == "hither") { // nothing is cut off before the eye
      tokens_.word();
      tokens_.number("hither");
    } else if (part == "resolution") {
      tokens_.word();
      width = tokens_.count("resolution", 1, most_pixels_a_side);
      height = tokens_.count("resolution", 1, most_pixels_a_side);
    } else {
      break;
    }
  }
  for (const auto& [name, given] : {std::pair{"from", from.has_value()},
                                    {"at", at.has_value()},
                                    {"up", up.has_value()},
                                    {"angle", angle.has_value()}})
    if (!given) {
      log_.fail(begin_, std::string("v: '") + name + "' is missing");
      throw NffFailure{};
    }
  camera.eye = *from;
  camera.look_at = *at;
  camera.up = *up;
  camera.fov_degrees = field_of_view(*angle, static_cast<int>(height));
  scene_.set_view(camera, static_cast<int>(width), static_cast<int>(height));
}

void NffReader::read_light() {
  const Vec3 position = tokens_.vector("l");
  if (tokens_.is_number_next())
    scene_.add_light(position, read_color("l"));
  else
    scene_.add_light(position);
}

void NffReader::read_fill() {
  NffFill fill;
  fill.color = read_color("f");
  for (float* share : {&fill.diffuse, &fill.specular, &fill.shine, &fill.transmittance}) {
    *share = tokens_.number("f");
    if (*share < 0.0F) tokens_.fail("f: Kd, Ks, shine and T must not be negative");
  }
  fill.ior = tokens_.number("f");
  if (fill.transmittance > 0.0F && !(fill.ior > 0.0F))
    warn("index of refraction", "f: the index of refraction must be greater than 0: 1 is taken");
  scene_.set_fill(fill);
}

void NffReader::need_fill() {
  if (scene_.has_fill()) return;
  warn("no fill", "no 'f' before the first object: a plain white is taken");
  scene_.set_fill({});
}

void NffReader::read_sphere() {
  need_fill();
  const Vec3 center = tokens_.vector("s");
  if (!scene_.add_sphere(center, tokens_.number("s")))
    warn("empty sphere", "a sphere of radius 0 is left out");
}

void NffReader::read_cone() {
  need_fill();
  const Vec3 base = tokens_.vector("c");
  const float base_radius = tokens_.number("c");
  const Vec3 apex = tokens_.vector("c");
  if (!scene_.add_cone(base, base_radius, apex, tokens_.number("c")))
    warn("empty cone", "a cone without length or radius is left out");
}

void NffReader::read_polygon(bool is_patch) {
  need_fill();
  const char* const what = is_patch ? "pp" : "p";
  const std::size_t count = tokens_.count(what, 3, is_patch ? max_face_corners : most_vertices);
  // Two bytes a number at least: a count that can't be true must not take memory.
  if (count > tokens_.left() / (is_patch ? 12 : 6) + 1)
    tokens_.fail("the file ends within " + in_quotes(what));
  vertices_.clear();
  normals_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    vertices_.push_back(tokens_.vector(what));
    if (is_patch) normals_.push_back(tokens_.vector(what));
  }
  switch (is_patch ? scene_.add_patch(vertices_, normals_) : scene_.add_polygon(vertices_)) {
  case NffScene::Found::good:
    break;
  case NffScene::Found::bent:
    warn("bent polygon", "a polygon is not flat: it is cut into triangles");
    break;
  case NffScene::Found::empty:
    warn("empty polygon", "a polygon without area is left out");
    break;
  case NffScene::Found::too_long:
    log_.fail(begin_, "a polygon of more than 65535 vertices is not flat");
    throw NffFailure{};
  }
  for (const TriangleFault fault : scene_.faults()) warn(kind_of(fault), message_of(fault));
}

} // namespace

SceneDesc read_nff(const Source& source, bool strict, Diagnostics& diagnostics) {
  if (source.size() > most_bytes) throw LimitError(in_quotes(source.name()) + " is larger than 1 GiB");
  std::string text(source.size() + nff_padding, '\0');
  source.read(0, text.data(), source.size());
  EventLog log;
  SceneDesc desc;
  try {
    desc = NffReader(std::string_view(text).substr(0, source.size()), log).run();
  } catch (const NffFailure&) {
    // It is in the log.
  }
  EventReport report;
  report.take(std::move(log));
  report.deliver(source, {{text_begin(text), 0}}, strict, diagnostics);
  warn_without_primitives(desc, source.name(), strict, diagnostics);
  source.check_unchanged();
  return desc;
}

} // namespace fastrt
