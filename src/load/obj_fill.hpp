// SPDX-License-Identifier: Apache-2.0
// The second pass over an OBJ file: a chunk's statements into the scene's columns.
#pragma once

#include "src/load/digit_marks.hpp"
#include "src/load/obj_colors.hpp"
#include "src/load/obj_plan.hpp"

#include <fastrt/scene.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace fastrt {

struct MarkedText;

struct Corner {
  std::uint32_t v, t, n;
  bool operator==(const Corner&) const = default;
};

// Whether all corners have, or have not, texture coordinates and normals.
inline bool match(std::span<const Corner> corners) {
  bool same = true;
  for (const Corner& corner : corners)
    same &= (corner.t == no_index) == (corners[0].t == no_index) &&
            (corner.n == no_index) == (corners[0].n == no_index);
  return same;
}

// Fills the rows that belong to one chunk. Stops at the first error, which goes to the result's log.
class ObjFiller {
public:
  // `smoothing`: a column for the triangles' smoothing groups, or null.
  ObjFiller(const Source& source, const ObjPlan& plan, SceneDesc& desc, ObjColors& colors,
            Column<std::uint32_t>* smoothing)
      : source_(source), plan_(plan), desc_(desc), colors_(colors), smoothing_(smoothing) {}

  void fill(ChunkBuffer& buffer, const Chunk& chunk, const ObjState& start, const ObjCounts& counts,
            bool with_care, ObjChunkResult& result);

private:
  bool take_lines(char*& p, char* limit);

  // The fast way: false, and nothing done, for everything that is not plain. Else p is at the line end.
  bool take_plain(const char* line, MarkedText& p);
  bool take_bare_face(MarkedText& next);
  bool take_any_face(MarkedText& p);
  bool take_face(MarkedText& p);
  bool take_polygon(MarkedText& p, std::span<const Corner> first);

  // The careful way: knows everything and says what is wrong. False after an error.
  bool read_line(char*& p, char* limit);
  bool read_statement(std::string_view line);
  bool read_vertex(std::string_view keyword, std::string_view line);
  void read_color(std::span<const float> numbers, std::size_t count);
  bool read_face(std::string_view line);
  bool read_corner(std::string_view line, std::string_view word, Corner& corner);
  bool read_reference(std::string_view text, std::uint64_t offset, int which, std::uint32_t& index);
  void read_state(std::string_view keyword, std::string_view rest);
  void use_material(std::string_view name);
  void start_object(std::string_view name);
  void warn_about_keyword(std::string_view keyword);

  void put_position(std::span<const float> numbers);
  bool put_colored(std::span<const float> numbers, std::size_t count);
  void put_color(std::span<const float, 3> color);
  void put_normal(std::span<const float> numbers);
  void put_uv(std::span<const float> numbers);
  void put_face(std::span<const Corner> corners);
  void put_state();
  std::uint64_t offset_of(const char* p) const {
    return chunk_begin_ + static_cast<std::uint64_t>(p - text_);
  }

  const Source& source_;
  const ObjPlan& plan_;
  SceneDesc& desc_;
  ObjColors& colors_;
  Column<std::uint32_t>* smoothing_;

  // The chunk being read.
  const char* text_ = nullptr;
  std::uint64_t chunk_begin_ = 0;
  std::uint64_t line_offset_ = 0;
  std::uint64_t first_position_ = 0;
  ObjState now_; // `before` counts what has been read so far
  ObjCounts totals_;
  bool bare_faces_ = false;       // no face has texture coordinates or normals
  ObjCounts last_;                // what `before` will be at the chunk's end
  std::uint64_t state_since_ = 0; // the first triangle whose material, object and smoothing are not put yet
  ObjChunkResult* result_ = nullptr;
  std::vector<Corner> corners_;
  DigitMarks marks_;
};

inline void ObjFiller::put_position(std::span<const float> numbers) {
  const std::uint64_t i = now_.before.positions;
  if (i == last_.positions) source_.fail_changed();
  desc_.positions.x[i] = numbers[0];
  desc_.positions.y[i] = numbers[1];
  desc_.positions.z[i] = numbers[2];
  now_.before.positions = i + 1;
}

inline void ObjFiller::put_normal(std::span<const float> numbers) {
  const std::uint64_t i = now_.before.normals;
  if (i == last_.normals) source_.fail_changed();
  desc_.normals.x[i] = numbers[0];
  desc_.normals.y[i] = numbers[1];
  desc_.normals.z[i] = numbers[2];
  now_.before.normals = i + 1;
}

inline void ObjFiller::put_uv(std::span<const float> numbers) {
  const std::uint64_t i = now_.before.uvs;
  if (i == last_.uvs) source_.fail_changed();
  desc_.uvs.x[i] = numbers[0];
  desc_.uvs.y[i] = numbers[1];
  now_.before.uvs = i + 1;
}

} // namespace fastrt
