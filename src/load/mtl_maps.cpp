// SPDX-License-Identifier: Apache-2.0
// The map statements of MTL: options, then a file name that may hold blanks.
#include "src/load/mtl_parser.hpp"
#include "src/load/number.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace fastrt {

namespace {

struct MapOption {
  std::string_view name;
  std::size_t words;   // that follow
  std::size_t numbers; // that follow, at least one of them
};

constexpr std::array<MapOption, 14> map_options = {{{"-blendu", 1, 0},
                                                    {"-blendv", 1, 0},
                                                    {"-cc", 1, 0},
                                                    {"-clamp", 1, 0},
                                                    {"-imfchan", 1, 0},
                                                    {"-type", 1, 0},
                                                    {"-colorspace", 1, 0},
                                                    {"-mm", 0, 2},
                                                    {"-o", 0, 3},
                                                    {"-s", 0, 3},
                                                    {"-t", 0, 3},
                                                    {"-texres", 0, 1},
                                                    {"-bm", 0, 1},
                                                    {"-boost", 0, 1}}};

constexpr float largest_option = 1e6F;

std::string_view without_quotes(std::string_view name) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"') return name.substr(1, name.size() - 2);
  return name;
}

// What the words and numbers behind an option say; numbers that were left out are not set.
void apply_option(std::string_view option, const std::string& word,
                  const std::array<std::optional<float>, 3>& n, MtlMap& map) {
  if (option == "-clamp") map.clamp = word == "on";
  if (option == "-colorspace") map.is_linear = word == "linear" || word == "raw";
  if (option == "-imfchan" && word.size() == 1 &&
      std::string_view("rgbml").find(word[0]) != std::string_view::npos)
    map.channel = word[0];
  if (option == "-s") map.scale = {n[0].value_or(1.0F), n[1].value_or(1.0F)};
  if (option == "-o") map.offset_uv = {n[0].value_or(0.0F), n[1].value_or(0.0F)};
  if (option == "-bm") map.bump = n[0].value_or(1.0F);
  if (option == "-mm") map.base = n[0].value_or(0.0F), map.gain = n[1].value_or(1.0F);
}

} // namespace

// Takes what belongs to an option; `end` becomes where the line goes on after it.
bool MtlParser::read_option(std::string_view option, Words& words, std::size_t& end, MtlMap& map) {
  const MapOption* found = nullptr;
  for (const MapOption& known : map_options)
    if (known.name == option) found = &known;
  end = words.position() + option.size();
  if (found == nullptr) {
    log_.warn(here(words), "texture option", "unknown texture option " + in_quotes(option) + " skipped");
    return true;
  }
  std::string last_word;
  std::array<std::optional<float>, 3> numbers;
  for (std::size_t i = 0; i < found->words; ++i) {
    const std::string_view word = words.next();
    end = words.position() + word.size();
    last_word = lower_case(word);
  }
  for (std::size_t i = 0; i < found->numbers; ++i) {
    Words ahead = words;
    const std::string_view word = ahead.next();
    const bool optional = i != 0;
    if (optional && parse_number(word).fault == NumberFault::not_a_number) break;
    float value = 0;
    if (!take_number(word, here(ahead), value)) return false;
    if (std::abs(value) > largest_option)
      log_.warn(here(ahead), "texture option", "texture option " + in_quotes(word) + " is out of range");
    numbers[i] = value;
    end = ahead.position() + word.size();
    words = ahead;
  }
  if (option == "-t" || last_word == "z")
    log_.warn_once(here(words), "unsupported statement", option,
                   "texture option " + in_quotes(option) + " is not supported");
  apply_option(option, last_word, numbers, map);
  return true;
}

bool MtlParser::read_map(std::string_view line, Words& words, MtlMap& map) {
  std::size_t end = words.position();
  while (end != line.size() && !is_blank(line[end])) ++end;
  for (Words ahead = words;;) {
    const std::string_view word = ahead.next();
    if (word.size() < 2 || word.front() != '-') break;
    if (!read_option(lower_case(word), ahead, end, map)) return false;
  }
  const std::string_view name = without_quotes(name_in(line.substr(end)));
  if (name.empty()) {
    log_.warn(line_offset_, "texture", "a texture without a file name");
    return true;
  }
  map.name = std::string(name);
  map.offset = line_offset_ + static_cast<std::uint64_t>(name.data() - line.data());
  if (!options_.check_texture) return true;
  const auto verdict = options_.check_texture(map.name);
  map.path = verdict.path;
  map.failed = !verdict.fault.empty();
  if (map.failed) log_.warn(map.offset, "texture", "texture " + in_quotes(map.name) + ' ' + verdict.fault);
  return true;
}

} // namespace fastrt
