// SPDX-License-Identifier: Apache-2.0
#include "src/load/toml_transform.hpp"

#include <cmath>
#include <numbers>

namespace fastrt {
namespace {

// What the columns' lengths and the volume between them say: below this share it is a plane or a line.
constexpr double least_volume = 1e-10;

TomlMap translation(const Vec3& by) { return {glm::dmat3(1.0), glm::dvec3(by)}; }

TomlMap matrix(const TomlValue& value) {
  const std::vector<TomlValue> rows = value.elements();
  double m[16] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  for (std::size_t i = 0; i < rows.size(); ++i) m[i] = rows[i].precise_number();
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1)
    value.fail("the last row of a matrix must be 0, 0, 0, 1");
  return {glm::dmat3(m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]), {m[3], m[7], m[11]}};
}

// Rodrigues' formula; angles that are multiples of 90 degrees are exact.
TomlMap rotation(const glm::dvec3& axis, double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarters = turn / 90.0;
  double sine = std::sin(turn * std::numbers::pi / 180.0), cosine = std::cos(turn * std::numbers::pi / 180.0);
  if (quarters == std::floor(quarters)) sine = std::round(sine), cosine = std::round(cosine);
  const glm::dvec3 n = glm::normalize(axis);
  TomlMap map;
  for (int i = 0; i < 3; ++i) {
    glm::dvec3 unit(0.0);
    unit[i] = 1.0;
    map.linear[i] = cosine * unit + sine * glm::cross(n, unit) + (1.0 - cosine) * n[i] * n;
  }
  return map;
}

TomlMap read_rotation(const TomlValue& value) {
  static constexpr std::string_view keys[] = {"axis", "angle"};
  const TomlFields fields(value.file(), value.node(), "rotate", keys);
  return rotation(glm::dvec3(fields.need("axis").direction()), fields.need("angle").precise_number());
}

TomlMap read_scale(const TomlValue& value) {
  const Vec3 s = value.is_number() ? Vec3(value.number()) : value.vector();
  if (s.x == 0.0F || s.y == 0.0F || s.z == 0.0F) value.fail("must not be 0");
  TomlMap map;
  for (int i = 0; i < 3; ++i) map.linear[i][i] = static_cast<double>(s[i]);
  return map;
}

TomlMap read_shear(const TomlValue& value) {
  static constexpr std::string_view keys[] = {"xy", "xz", "yx", "yz", "zx", "zy"};
  const TomlFields fields(value.file(), value.node(), "shear", keys);
  TomlMap map;
  for (const std::string_view key : keys)
    if (const auto share = fields.find(key)) map.linear[key[1] - 'x'][key[0] - 'x'] = share->precise_number();
  return map;
}

TomlMap read_steps(const TomlValue& value) {
  static constexpr std::string_view keys[] = {"matrix", "scale", "shear", "rotate", "translate"};
  const TomlFields fields(value.file(), value.node(), "transform", keys);
  TomlMap map;
  if (const auto rows = fields.find("matrix")) {
    if (const std::size_t n = rows->elements().size(); n != 12 && n != 16)
      rows->fail("expected 12 or 16 numbers, found " + describe(rows->node()));
    map = matrix(*rows);
  }
  if (const auto scale = fields.find("scale")) map = after(read_scale(*scale), map);
  if (const auto shear = fields.find("shear")) map = after(read_shear(*shear), map);
  if (const auto rotate = fields.find("rotate")) map = after(read_rotation(*rotate), map);
  if (const auto by = fields.find("translate")) map = after(translation(by->vector()), map);
  return map;
}

} // namespace

TomlMap after(const TomlMap& outer, const TomlMap& inner) {
  return {outer.linear * inner.linear, outer.linear * inner.origin + outer.origin};
}

Affine rounded(const TomlMap& map) {
  return {Vec3(map.linear[0]), Vec3(map.linear[1]), Vec3(map.linear[2]), Vec3(map.origin)};
}

bool can_be_undone(const TomlMap& map) {
  const Affine affine = rounded(map);
  for (const Vec3& column : {affine.x, affine.y, affine.z, affine.origin})
    if (!(std::isfinite(column.x) && std::isfinite(column.y) && std::isfinite(column.z))) return false;
  const glm::dvec3 x(affine.x), y(affine.y), z(affine.z);
  const double volume = std::fabs(glm::dot(glm::cross(x, y), z));
  return volume > least_volume * glm::length(x) * glm::length(y) * glm::length(z);
}

TomlMap read_transform(const TomlValue& value) {
  if (value.node().table() != nullptr) return read_steps(value);
  const std::vector<TomlValue> elements = value.elements();
  const bool numbers = !elements.empty() && elements.front().is_number();
  if (numbers && elements.size() == 3) return translation(value.vector());
  if (numbers && (elements.size() == 12 || elements.size() == 16)) return matrix(value);
  if (numbers) value.fail("expected 3, 12 or 16 numbers, found " + describe(value.node()));
  TomlMap map;
  for (const TomlValue& step : elements) map = after(read_transform(step), map);
  return map;
}

} // namespace fastrt
