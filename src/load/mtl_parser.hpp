// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/load/mtl.hpp"
#include "src/load/text.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastrt {

// Reads an MTL file line by line; parse_mtl is its only user.
class MtlParser {
public:
  MtlParser(const MtlOptions& options, EventLog& log) : options_(options), log_(log) {}
  std::vector<MtlRecord> run(std::string_view text);

private:
  bool read_line(std::string_view line);
  bool read_statement(std::string_view keyword, Words& words);
  bool read_colour(Words& words, std::optional<Vec3>& colour);
  bool read_scalar(Words& words, float& value);
  bool read_share(const char* name, Words& words, std::optional<float>& share);
  bool read_shininess(Words& words);
  bool read_ior(Words& words);
  bool read_illum(Words& words);
  bool read_map(std::string_view line, Words& words, MtlMap& map);
  bool read_option(std::string_view option, Words& words, std::size_t& end, MtlMap& map);
  bool take_number(std::string_view word, std::uint64_t offset, float& value);
  bool fail(std::uint64_t offset, std::string message);
  void skip(std::string_view keyword);
  std::uint64_t here(const Words& words) const { return line_offset_ + words.position(); }

  const MtlOptions& options_;
  EventLog& log_;
  std::vector<MtlRecord> records_;
  std::uint64_t line_offset_ = 0;
};

} // namespace fastrt
