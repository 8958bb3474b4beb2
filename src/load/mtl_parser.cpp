// SPDX-License-Identifier: Apache-2.0
#include "src/load/mtl_parser.hpp"

#include "src/load/number.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace fastrt {

namespace {

constexpr float largest_shininess = 10000;
constexpr float smallest_ior = 0.001F; // the specification's range is 0.001 to 10
constexpr float largest_ior = 100;

} // namespace

std::vector<MtlRecord> parse_mtl(std::string_view text, const MtlOptions& options, EventLog& log) {
  return MtlParser(options, log).run(text);
}

std::vector<MtlRecord> MtlParser::run(std::string_view text) {
  std::vector<char> bytes(text.begin(), text.end());
  bytes.push_back('\n');
  char* const begin = bytes.data();
  char* const end = begin + text.size();
  for (char* p = begin + text_begin(text); p != end;) {
    const Line line = take_line(p, end);
    line_offset_ = static_cast<std::uint64_t>(line.begin - begin);
    p = line.next;
    if (line.ends_in_backslash)
      log_.warn(line_offset_, "backslash at the end", "the file ends after a line that is to be continued");
    if (!read_line(line.text())) break;
  }
  return std::move(records_);
}

bool MtlParser::fail(std::uint64_t offset, std::string message) {
  log_.fail(offset, std::move(message));
  return false;
}

bool MtlParser::read_line(std::string_view line) {
  if (line.size() > max_line_bytes) return fail(line_offset_, "line too long: more than 1 MiB");
  if (const std::size_t nul = line.find('\0'); nul != std::string_view::npos)
    return fail(line_offset_ + nul, "NUL byte: this is no text file");
  Words words(line);
  const std::string_view keyword = words.next();
  if (keyword.empty()) return true;
  const std::string lower = lower_case(keyword);
  if (lower == "newmtl") {
    records_.emplace_back();
    records_.back().name = std::string(name_in(words.rest()));
    records_.back().offset = here(words);
    if (records_.back().name.empty()) log_.warn(here(words), "newmtl", "'newmtl' without a name");
    return true;
  }
  const std::uint64_t start = here(words);
  static constexpr std::array<std::string_view, 10> maps = {
      "map_ka", "map_kd", "map_ks", "map_ke", "map_d", "map_bump", "bump", "norm", "map_norm", "map_opacity"};
  const auto map = std::find(maps.begin(), maps.end(), lower);
  if (records_.empty()) return fail(start, in_quotes(keyword) + " before the first 'newmtl'");
  if (map == maps.end()) return read_statement(lower, words);
  MtlRecord& record = records_.back();
  const std::array<MtlMap*, 10> targets = {&record.map_ka, &record.map_kd, &record.map_ks, &record.map_ke,
                                           &record.map_d,  &record.bump,   &record.bump,   &record.bump,
                                           &record.bump,   &record.map_d};
  MtlMap& target = *targets[static_cast<std::size_t>(map - maps.begin())];
  target = {};
  target.is_normal_map = lower == "norm" || lower == "map_norm";
  return read_map(line, words, target);
}

bool MtlParser::read_statement(std::string_view keyword, Words& words) {
  MtlRecord& record = records_.back();
  if (keyword == "ka") return read_colour(words, record.ka);
  if (keyword == "kd") return read_colour(words, record.kd);
  if (keyword == "ks") return read_colour(words, record.ks);
  if (keyword == "ke") return read_colour(words, record.ke);
  if (keyword == "tf" || keyword == "kt") return read_colour(words, record.tf);
  if (keyword == "d") return read_share("d", words, record.d);
  if (keyword == "tr") return read_share("Tr", words, record.tr);
  if (keyword == "ns") return read_shininess(words);
  if (keyword == "ni") return read_ior(words);
  if (keyword == "illum") return read_illum(words);
  if (keyword != "sharpness") skip(keyword);
  return true;
}

void MtlParser::skip(std::string_view keyword) {
  static constexpr std::array<std::string_view, 22> known = {
      "pr",     "pm",     "ps",      "pc",       "pcr",      "aniso",  "anisor", "map_ns",
      "map_tr", "map_tf", "map_aat", "map_pr",   "map_pm",   "map_ps", "map_pc", "map_ra",
      "decal",  "disp",   "refl",    "map_refl", "map_disp", "rfl"};
  const bool is_known = std::find(known.begin(), known.end(), keyword) != known.end();
  log_.warn_once(line_offset_, is_known ? "unsupported statement" : "unknown keyword", keyword,
                 is_known ? "statements " + in_quotes(keyword) + " are not supported and skipped"
                          : "unknown keyword " + in_quotes(keyword) + " skipped");
}

bool MtlParser::take_number(std::string_view word, std::uint64_t offset, float& value) {
  const Number number = parse_number(word);
  if (number.fault != NumberFault::none)
    return fail(offset, std::string(describe(number.fault)) + ' ' + in_quotes(word));
  value = number.value;
  return true;
}

// One number is a grey.
bool MtlParser::read_colour(Words& words, std::optional<Vec3>& colour) {
  std::array<float, 3> numbers{};
  std::size_t count = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (count == 0 && (word == "spectral" || word == "xyz")) {
      log_.warn(here(words), "colour",
                "colours given as " + in_quotes(word) + " are not supported and skipped");
      return true;
    }
    if (count == numbers.size()) return fail(here(words), "a colour takes 1 or 3 numbers, not more");
    if (!take_number(word, here(words), numbers[count])) return false;
    if (numbers[count] < 0) {
      log_.warn(here(words), "negative colour", "negative colour " + in_quotes(word) + " taken as 0");
      numbers[count] = 0;
    }
    ++count;
  }
  if (count != 1 && count != 3)
    return fail(line_offset_, "a colour takes 1 or 3 numbers, not " + std::to_string(count));
  colour = count == 1 ? Vec3(numbers[0]) : Vec3(numbers[0], numbers[1], numbers[2]);
  return true;
}

bool MtlParser::read_scalar(Words& words, float& value) {
  const std::string_view word = words.next();
  if (word.empty()) return fail(line_offset_, "a number is missing");
  return take_number(word, here(words), value);
}

bool MtlParser::read_share(const char* name, Words& words, std::optional<float>& share) {
  std::string_view word = words.next();
  if (word == "-halo") {
    log_.warn_once(here(words), "unsupported statement", word,
                   "'-halo' is not supported; the value is used as it is");
    word = words.next();
  }
  if (word.empty()) return fail(line_offset_, "a number is missing");
  float value = 0;
  if (!take_number(word, here(words), value)) return false;
  share = std::clamp(value, 0.0F, 1.0F);
  if (*share != value) log_.warn(here(words), "clamped", std::string(name) + " lies outside 0 .. 1");
  return true;
}

bool MtlParser::read_shininess(Words& words) {
  float value = 0;
  if (!read_scalar(words, value)) return false;
  if (value < 0 || value > largest_shininess) log_.warn(here(words), "clamped", "Ns lies outside 0 .. 10000");
  records_.back().ns = std::clamp(value, 1.0F, largest_shininess);
  return true;
}

bool MtlParser::read_ior(Words& words) {
  float value = 0;
  if (!read_scalar(words, value)) return false;
  if (value < smallest_ior) return fail(here(words), "Ni must be at least 0.001");
  if (value > largest_ior) log_.warn(here(words), "clamped", "Ni lies outside 0.001 .. 100");
  records_.back().ni = std::min(value, largest_ior);
  return true;
}

bool MtlParser::read_illum(Words& words) {
  float value = 0;
  if (!read_scalar(words, value)) return false;
  const bool known = value >= 0 && value <= 10 && value == std::floor(value);
  if (!known) log_.warn(here(words), "illum", "illum is not one of 0 .. 10 and taken as 2");
  records_.back().illum = known ? static_cast<int>(value) : 2;
  return true;
}

} // namespace fastrt
