// SPDX-License-Identifier: Apache-2.0
// The careful half of ObjFiller.
#include "src/load/number.hpp"
#include "src/load/obj_fill.hpp"
#include "src/load/polygon.hpp"
#include "src/load/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace fastrt {

bool ObjFiller::read_line(char*& p, char* limit) {
  const Line line = take_line(p, limit);
  line_offset_ = offset_of(line.begin);
  p = line.next;
  const std::string_view text = line.text();
  if (text.size() > max_line_bytes) {
    result_->log.fail(line_offset_, "line too long: more than 1 MiB with its continuations");
    return false;
  }
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    result_->log.fail(line_offset_ + nul, "NUL byte: this is no text file");
    return false;
  }
  if (line.ends_in_backslash)
    result_->log.warn(line_offset_ + text.size() - 1, "backslash at the end",
                      "the file ends after a line that is to be continued");
  return read_statement(text);
}

bool ObjFiller::read_statement(std::string_view line) {
  Words words(line);
  const std::string_view keyword = words.next();
  if (keyword.empty()) return true;
  line_offset_ += words.position();
  line.remove_prefix(words.position());
  const std::string_view rest = line.substr(keyword.size());
  if (keyword == "v" || keyword == "vn" || keyword == "vt") return read_vertex(keyword, line);
  if (keyword == "f") return read_face(line);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (std::any_of(keyword.begin(), keyword.end(), is_control)) {
    result_->log.fail(line_offset_, "unknown keyword " + in_quotes(keyword) + ": this is no text file");
    return false;
  }
  read_state(keyword, rest);
  return true;
}

bool ObjFiller::read_vertex(std::string_view keyword, std::string_view line) {
  // Behind a position may stand a weight or a colour or both; behind two texture coordinates a third.
  const bool is_position = keyword == "v", is_uv = keyword == "vt";
  const std::size_t least = is_uv ? 1 : 3;
  const std::size_t most = is_position ? 8 : 3;
  std::array<float, 8> numbers{};
  std::size_t count = 0;
  Words words(line);
  words.next();
  for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
    const std::uint64_t offset = line_offset_ + words.position();
    if (count == most) {
      result_->log.fail(offset, "more than " + std::to_string(most) + " numbers after " + in_quotes(keyword));
      return false;
    }
    const Number number = parse_number(word);
    if (number.fault != NumberFault::none) {
      result_->log.fail(offset, std::string(describe(number.fault)) + ' ' + in_quotes(word));
      return false;
    }
    if (number.underflow)
      result_->log.warn(offset, "tiny number", in_quotes(word) + " is too small for single precision");
    numbers[count] = number.value;
  }
  if (count < least) {
    result_->log.fail(line_offset_, in_quotes(keyword) + " needs " + std::to_string(least) +
                                        " numbers, but has " + std::to_string(count));
    return false;
  }
  if (is_position) {
    put_position(numbers);
    read_color(numbers, count);
  } else if (is_uv) {
    put_uv(numbers);
  } else {
    if (numbers[0] == 0 && numbers[1] == 0 && numbers[2] == 0) {
      result_->has_zero_normal = true;
      result_->log.warn(line_offset_, "zero normal", "the normal is 0; its faces use their own");
    }
    put_normal(numbers);
  }
  return true;
}

bool ObjFiller::read_face(std::string_view line) {
  corners_.clear();
  Words words(line);
  words.next();
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (corners_.size() == max_face_corners) {
      result_->log.fail(line_offset_ + words.position(), "a face may have " +
                                                             std::to_string(max_face_corners) +
                                                             " vertices, this one has more");
      return false;
    }
    Corner corner{};
    if (!read_corner(line, word, corner)) return false;
    corners_.push_back(corner);
    result_->uses_normals |= corner.n != no_index;
    result_->uses_uvs |= corner.t != no_index;
  }
  if (corners_.size() < 3) {
    result_->log.warn(line_offset_, "face of fewer than 3 vertices",
                      "face of " + std::to_string(corners_.size()) + " vertices skipped");
    return true;
  }
  if (!match(corners_))
    result_->log.warn(line_offset_, "mixed face",
                      "not all corners of the face have texture coordinates or normals");
  put_face(corners_);
  return true;
}

bool ObjFiller::read_corner(std::string_view line, std::string_view word, Corner& corner) {
  const std::uint64_t offset = line_offset_ + static_cast<std::uint64_t>(word.data() - line.data());
  corner.t = corner.n = no_index;
  std::array<std::uint32_t*, 3> indices = {&corner.v, &corner.t, &corner.n};
  std::size_t begin = 0;
  for (int which = 0;; ++which) {
    const std::size_t end = std::min(word.find('/', begin), word.size());
    const std::string_view part = word.substr(begin, end - begin);
    const bool left_out = part.empty() && which > 0; // v//n, and v/ and v// of some exporters
    if (which == 3 || (part.empty() && !left_out)) {
      result_->log.fail(offset + begin, "expected v, v/vt, v//vn or v/vt/vn, found " + in_quotes(word));
      return false;
    }
    const auto slot = static_cast<std::size_t>(which);
    if (!left_out && !read_reference(part, offset + begin, which, *indices[slot])) return false;
    if (end == word.size()) return true;
    begin = end + 1;
  }
}

bool ObjFiller::read_reference(std::string_view text, std::uint64_t offset, int which, std::uint32_t& index) {
  static constexpr std::array<const char*, 3> names = {"vertex", "texture coordinate", "normal"};
  const std::array<std::uint64_t, 3> totals = {plan_.totals.positions, plan_.totals.uvs,
                                               plan_.totals.normals};
  const std::array<std::uint64_t, 3> so_far = {now_.before.positions, now_.before.uvs, now_.before.normals};
  const auto kind = static_cast<std::size_t>(which);
  const std::string name = names[kind];
  std::int64_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = parsed.ptr == text.data() + text.size() && parsed.ec != std::errc::invalid_argument;
  if (!whole) {
    result_->log.fail(offset, "not an index: " + in_quotes(text));
    return false;
  }
  if (value == 0 && parsed.ec == std::errc{}) {
    result_->log.fail(offset, "index 0: " + name + " indices count from 1");
    return false;
  }
  const auto total = static_cast<std::int64_t>(totals[kind]),
             before = static_cast<std::int64_t>(so_far[kind]);
  if (parsed.ec != std::errc{} || value > total || value < -before) {
    const bool negative = text.starts_with('-');
    result_->log.fail(offset, "face refers to " + name + ' ' + std::string(text.substr(0, 40)) +
                                  ", but only " + std::to_string(negative ? before : total) +
                                  (negative ? " are defined so far" : " are defined"));
    return false;
  }
  index = static_cast<std::uint32_t>(value > 0 ? value - 1 : before + value);
  return true;
}

void ObjFiller::read_state(std::string_view keyword, std::string_view rest) {
  put_state();
  if (keyword == "usemtl") {
    use_material(name_in(rest));
  } else if (keyword == "o" || keyword == "g") {
    if ((keyword == "g") == plan_.objects_are_groups) start_object(name_in(rest));
  } else if (keyword == "s") {
    const auto group = smoothing_group_in(rest);
    if (!group)
      result_->log.warn(line_offset_, "smoothing group",
                        "not a smoothing group: " + in_quotes(trimmed(rest)));
    now_.smoothing = group.value_or(0);
  } else if (keyword == "mtllib") {
    if (name_in(rest).empty()) result_->log.warn(line_offset_, "mtllib", "'mtllib' without a name");
  } else {
    warn_about_keyword(keyword);
  }
}

// What is current holds for the triangles since the last change. To be called before the next one, and at the
// end.
void ObjFiller::put_state() {
  const std::uint64_t first = state_since_, last = now_.before.triangles;
  if (first == last) return;
  TriangleColumns& rows = desc_.triangles;
  std::fill(rows.material.begin() + first, rows.material.begin() + last, now_.material);
  std::fill(rows.object.begin() + first, rows.object.begin() + last, now_.object);
  if (smoothing_ != nullptr)
    std::fill(smoothing_->begin() + first, smoothing_->begin() + last, now_.smoothing);
  result_->uses_default_material |= now_.material == plan_.default_material;
  state_since_ = last;
}

void ObjFiller::use_material(std::string_view name) {
  const auto found = plan_.materials.find(name);
  now_.material = found == plan_.materials.end() ? plan_.default_material : found->second;
  if (found != plan_.materials.end()) return;
  result_->log.warn_once(line_offset_, "unknown material", name,
                         name.empty() ? "'usemtl' without a name: the default material is used"
                                      : "material " + in_quotes(name) +
                                            " is not defined: the default material is used");
}

void ObjFiller::start_object(std::string_view name) {
  ObjCounts& counts = now_.before;
  std::uint64_t& started = plan_.objects_are_groups ? counts.groups : counts.objects;
  const std::uint64_t end = plan_.objects_are_groups ? last_.groups : last_.objects;
  if (started == end) source_.fail_changed();
  now_.object = static_cast<std::uint32_t>(started + (plan_.has_unnamed_object ? 1 : 0));
  ++started;
  desc_.object_names[now_.object] = name.empty() ? "default" : std::string(name);
}

void ObjFiller::warn_about_keyword(std::string_view keyword) {
  static constexpr std::array<std::string_view, 32> known = {
      "l",      "p",      "curv",       "curv2",     "surf",     "vp",    "cstype", "deg",
      "bmat",   "step",   "parm",       "trim",      "hole",     "scrv",  "sp",     "end",
      "con",    "mg",     "bevel",      "c_interp",  "d_interp", "lod",   "call",   "csh",
      "usemap", "maplib", "shadow_obj", "trace_obj", "ctech",    "stech", "bzp",    "bsp"};
  const bool is_known = std::find(known.begin(), known.end(), keyword) != known.end();
  result_->log.warn_once(line_offset_, is_known ? "unsupported statement" : "unknown keyword", keyword,
                         is_known ? "statements " + in_quotes(keyword) + " are not supported and skipped"
                                  : "unknown keyword " + in_quotes(keyword) + " skipped");
}

} // namespace fastrt
