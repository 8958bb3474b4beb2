// SPDX-License-Identifier: Apache-2.0
// Values of a TOML file as a scene wants them; whatever is not as wanted is an InputError with its place.
#pragma once

#include "src/load/toml_node.hpp"

#include <fastrt/math.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

// Which numbers may stand in a place.
struct TomlRange {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool excludes_least = false, excludes_most = false;
  bool holds(double x) const;
  std::string text() const; // "greater than 0"
};
inline constexpr TomlRange any_number{};
inline constexpr TomlRange positive{0, std::numeric_limits<double>::infinity(), true};
inline constexpr TomlRange not_negative{0};

[[noreturn]] void toml_fail(const std::string& file, TomlPlace place, const std::string& message);

// A value, and what messages call it.
class TomlValue {
public:
  TomlValue(const std::string& file, const TomlNode& node, std::string_view name)
      : file_(&file), node_(&node), name_(name) {}

  const TomlNode& node() const { return *node_; }
  const std::string& file() const { return *file_; }
  std::string name() const { return std::string(name_); }
  TomlPlace place() const { return node_->place; }
  // Throws InputError: "scene.toml:3:9: NAME: MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;

  double precise_number(const TomlRange& range = any_number) const;
  float number(const TomlRange& range = any_number) const; // finite
  std::int64_t integer(std::int64_t least, std::int64_t most) const;
  bool boolean() const;
  const std::string& text() const;
  Vec3 vector() const;
  Vec3 direction() const; // any length but 0
  Vec3 color() const;     // three numbers, or one for a grey; none negative
  Vec2 pair() const;      // two numbers, or one for both
  // As many numbers as `values` has places.
  void numbers(std::span<float> values) const;
  // Which of these words it is.
  std::size_t choice(std::span<const std::string_view> words) const;
  // Its elements; it must be an array.
  std::vector<TomlValue> elements() const;
  std::vector<Vec3> vectors(std::size_t at_least = 0) const;
  bool is_number() const;

private:
  const std::string* file_;
  const TomlNode* node_;
  std::string_view name_;
};

// A table whose keys are known: a key that is none of them is an error from the start.
class TomlFields {
public:
  // what: as messages call the table, "[[light]]".
  TomlFields(const std::string& file, const TomlNode& node, std::string what,
             std::span<const std::string_view> keys);

  std::optional<TomlValue> find(std::string_view key) const;
  TomlValue need(std::string_view key) const;
  bool has(std::string_view key) const { return find(key).has_value(); }
  // The place of a key that is there, else of the table.
  TomlPlace place(std::string_view key) const;
  TomlPlace place() const { return node_->place; }
  const std::string& file() const { return *file_; }
  const std::string& what() const { return what_; }
  const TomlTable& entries() const { return *node_->table(); }
  [[noreturn]] void fail(TomlPlace place, const std::string& message) const;

  // Leave the target as it is where the key is not there.
  void read(std::string_view key, float& target, const TomlRange& range = any_number) const;
  void read(std::string_view key, bool& target) const;
  void read_vector(std::string_view key, Vec3& target) const;
  void read_direction(std::string_view key, Vec3& target) const;
  void read_color(std::string_view key, Vec3& target) const;

private:
  const std::string* file_;
  const TomlNode* node_;
  std::string what_;
};

} // namespace fastrt
