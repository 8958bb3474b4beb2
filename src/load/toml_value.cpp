// SPDX-License-Identifier: Apache-2.0
#include "src/load/spelling.hpp"
#include "src/load/text.hpp"
#include "src/load/toml_fields.hpp"

#include <fastrt/error.hpp>

#include <cmath>
#include <locale>
#include <sstream>

namespace fastrt {
namespace {

std::string as_text(double x) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << x;
  return text.str();
}

} // namespace

bool TomlRange::holds(double x) const {
  return (excludes_least ? x > least : x >= least) && (excludes_most ? x < most : x <= most);
}

std::string TomlRange::text() const {
  std::string text;
  if (std::isfinite(least)) text = (excludes_least ? "greater than " : "at least ") + as_text(least);
  if (std::isfinite(least) && std::isfinite(most)) text += " and ";
  if (std::isfinite(most)) text += (excludes_most ? "less than " : "at most ") + as_text(most);
  return text;
}

void toml_fail(const std::string& file, TomlPlace place, const std::string& message) {
  throw InputError(file, place.line, place.column, message);
}

void TomlValue::fail(const std::string& message) const {
  toml_fail(*file_, node_->place, std::string(name_) + ": " + message);
}

bool TomlValue::is_number() const {
  return std::holds_alternative<double>(node_->value) || std::holds_alternative<std::int64_t>(node_->value);
}

double TomlValue::precise_number(const TomlRange& range) const {
  if (!is_number()) fail("expected a number, found " + describe(*node_));
  const auto* whole = std::get_if<std::int64_t>(&node_->value);
  const double x = whole != nullptr ? static_cast<double>(*whole) : std::get<double>(node_->value);
  if (!std::isfinite(static_cast<float>(x))) fail("must be finite, and below 3.4e38");
  if (!range.holds(x)) fail("must be " + range.text());
  return x;
}

// What is greater than 0 as written is so as a float too.
float TomlValue::number(const TomlRange& range) const {
  const auto x = static_cast<float>(precise_number(range));
  if (!range.holds(static_cast<double>(x))) fail("must be " + range.text());
  return x;
}

std::int64_t TomlValue::integer(std::int64_t least, std::int64_t most) const {
  const auto* whole = std::get_if<std::int64_t>(&node_->value);
  if (whole == nullptr || *whole < least || *whole > most)
    fail("must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return *whole;
}

bool TomlValue::boolean() const {
  if (const auto* is = std::get_if<bool>(&node_->value)) return *is;
  fail("expected true or false, found " + describe(*node_));
}

const std::string& TomlValue::text() const {
  if (const std::string* text = node_->text()) return *text;
  fail("expected a text, found " + describe(*node_));
}

void TomlValue::numbers(std::span<float> values) const {
  const TomlArray* array = node_->array();
  if (array == nullptr || array->size() != values.size())
    fail("expected " + std::to_string(values.size()) + " numbers, found " + describe(*node_));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = TomlValue(*file_, (*array)[i], name_).number();
}

Vec3 TomlValue::vector() const {
  float v[3];
  numbers(v);
  return {v[0], v[1], v[2]};
}

Vec3 TomlValue::direction() const {
  const Vec3 v = vector();
  if (v == Vec3(0.0F)) fail("must not be 0");
  return v;
}

Vec3 TomlValue::color() const {
  const Vec3 v = is_number() ? Vec3(number()) : vector();
  if (v.x < 0.0F || v.y < 0.0F || v.z < 0.0F) fail("a colour must not be negative");
  return v;
}

Vec2 TomlValue::pair() const {
  if (is_number()) return Vec2(number());
  float v[2];
  numbers(v);
  return {v[0], v[1]};
}

std::size_t TomlValue::choice(std::span<const std::string_view> words) const {
  const std::string& given = text();
  std::string known;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == given) return i;
    known += (i == 0 ? "" : ", ") + std::string(words[i]);
  }
  const std::string meant = did_you_mean(given, words);
  fail("unknown " + in_quotes(given) + (meant.empty() ? "; known: " + known : meant));
}

std::vector<TomlValue> TomlValue::elements() const {
  const TomlArray* array = node_->array();
  if (array == nullptr) fail("expected an array, found " + describe(*node_));
  std::vector<TomlValue> values;
  values.reserve(array->size());
  for (const TomlNode& element : *array) values.emplace_back(*file_, element, name_);
  return values;
}

std::vector<Vec3> TomlValue::vectors(std::size_t at_least) const {
  std::vector<Vec3> vectors;
  for (const TomlValue& element : elements()) vectors.push_back(element.vector());
  if (vectors.size() < at_least)
    fail("expected at least " + std::to_string(at_least) + " points, found " +
         std::to_string(vectors.size()));
  return vectors;
}

} // namespace fastrt
