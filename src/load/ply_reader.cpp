// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_reader.hpp"

#include "src/load/ply_cursor.hpp"
#include "src/load/ply_material.hpp"
#include "src/load/ply_vertices.hpp"
#include "src/load/polygon.hpp"
#include "src/load/text.hpp"
#include "src/load/triangle_fault.hpp"
#include "src/load/warn.hpp"

#include <fastrt/error.hpp>

#include <limits>
#include <map>
#include <utility>

namespace fastrt {

namespace {

constexpr std::uint64_t most_rows = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t strip_end = -1;

class PlyReader {
public:
  PlyReader(const Source& source, const PlyReaderSettings& settings, Diagnostics& diagnostics)
      : settings_(settings), diagnostics_(diagnostics), bytes_(source.size() + PlyCursor::padding),
        text_(bytes_.data(), source.size()), name_(source.name()) {
    source.read(0, bytes_.data(), source.size());
    std::memset(bytes_.data() + source.size(), 0, PlyCursor::padding);
  }

  SceneDesc run() {
    header_ = parse_ply_header(text_, name_);
    PlyCursor cursor(text_, header_.size, header_.format, name_);
    for (const PlyElement& element : header_.elements) {
      check_count(element, cursor);
      if (element.name == "vertex")
        has_vertices_ = true, read_ply_vertices(element, cursor, name_, desc_);
      else if (element.name == "face")
        read_faces(element, cursor);
      else if (element.name == "tristrips")
        read_strips(element, cursor);
      else
        skip(element, cursor);
    }
    warn_without_primitives(desc_, name_, settings_.strict, diagnostics_);
    finish();
    return std::move(desc_);
  }

private:
  void warn(const char* kind, const std::string& message) {
    fastrt::warn(kind, message, settings_.strict, diagnostics_);
  }

  PlyWarning placed_warning() {
    return [this](const char* kind, const Place& place, const std::string& message) {
      warn(kind, InputError(name_, place.line, place.column, message).what());
    };
  }

  // Finding a line takes time: only for warnings that are shown.
  void warn_at(const char* kind, const char* place, const PlyCursor& cursor, const std::string& message) {
    const bool shown = ++counts_[kind] <= Diagnostics::kept_per_kind;
    warn(kind, shown ? cursor.place_of(place) + message : message);
  }

  // Before memory is taken for it: every value takes a byte at least.
  void check_count(const PlyElement& element, PlyCursor& cursor) const {
    if (element.count > most_rows)
      throw LimitError(name_ + ": more than 2^31 - 1 elements " + in_quotes(element.name));
    std::uint64_t row = 0;
    for (const PlyProperty& property : element.properties)
      row += header_.format == PlyFormat::ascii
                 ? 1
                 : size_of(property.is_list ? property.count_type : property.type);
    if (element.count * row > cursor.left())
      throw InputError(name_ + ": the file ends early: " + std::to_string(element.count) + " elements " +
                       in_quotes(element.name) + " can't be in it");
  }

  void skip(const PlyElement& element, PlyCursor& cursor) {
    if (element.properties.empty()) return; // billions of such rows may be in a file of no size
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const PlyProperty& property : element.properties) cursor.skip(property);
  }
  const PlyProperty* find_list(const PlyElement& element);
  void read_faces(const PlyElement& element, PlyCursor& cursor);
  std::uint64_t read_plain_triangles(const PlyProperty& property, std::uint64_t most, PlyCursor& cursor);
  void read_strips(const PlyElement& element, PlyCursor& cursor);
  std::uint32_t vertex_of(std::int64_t index, const char* place, const PlyCursor& cursor) const;
  void add_polygon(const char* place, const PlyCursor& cursor);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const char* place,
                    const PlyCursor& cursor);
  void finish();

  const PlyReaderSettings& settings_;
  Diagnostics& diagnostics_;
  Column<char> bytes_;
  std::string_view text_;
  const std::string& name_;
  PlyHeader header_;
  SceneDesc desc_;
  bool has_vertices_ = false;
  std::map<std::string, std::size_t> counts_; // of warnings, by kind
  PolygonTriangulator triangulator_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> points_;
  std::vector<PolygonTriangulator::Triangle> triangles_;
};

const PlyProperty* PlyReader::find_list(const PlyElement& element) {
  if (!has_vertices_)
    throw InputError(name_ + ": element " + in_quotes(element.name) + " comes before 'vertex'");
  for (const PlyProperty& property : element.properties)
    if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index"))
      return &property;
  warn("no indices",
       name_ + ": element " + in_quotes(element.name) + " has no 'vertex_indices' and is skipped");
  return nullptr;
}

std::uint32_t PlyReader::vertex_of(std::int64_t index, const char* place, const PlyCursor& cursor) const {
  if (index < 0 || static_cast<std::uint64_t>(index) >= desc_.positions.size())
    cursor.fail_at(place, "index " + std::to_string(index) + " refers to no vertex; there are " +
                              std::to_string(desc_.positions.size()));
  return static_cast<std::uint32_t>(index);
}

// The first faces of a file, as far as they are what most binary files hold: triangles, of a byte and three
// words each, and nothing to say about them. Returns how many they were.
std::uint64_t PlyReader::read_plain_triangles(const PlyProperty& property, std::uint64_t most,
                                              PlyCursor& cursor) {
  if (header_.format == PlyFormat::ascii || size_of(property.count_type) != 1 ||
      (property.type != PlyType::int32 && property.type != PlyType::uint32))
    return 0;
  constexpr std::size_t size = 13;
  const bool swap = header_.format == PlyFormat::big_endian;
  const std::size_t vertices = desc_.positions.size();
  std::uint64_t done = 0;
  for (; done < most && cursor.left() >= size; ++done) {
    const char* const at = cursor.place();
    const auto a = PlyCursor::load<std::uint32_t>(at + 1, swap);
    const auto b = PlyCursor::load<std::uint32_t>(at + 5, swap);
    const auto c = PlyCursor::load<std::uint32_t>(at + 9, swap);
    if (*at != 3 || a >= vertices || b >= vertices || c >= vertices) break;
    add_triangle(a, b, c, at, cursor);
    cursor.take(size);
  }
  return done;
}

void PlyReader::read_faces(const PlyElement& element, PlyCursor& cursor) {
  const PlyProperty* const indices = find_list(element);
  if (indices == nullptr) return skip(element, cursor);
  warn_about_face_properties(element, placed_warning());
  for (auto* column : {&desc_.triangles.v0, &desc_.triangles.v1, &desc_.triangles.v2})
    column->reserve(column->size() + element.count);
  std::uint64_t first = 0;
  if (element.properties.size() == 1) first = read_plain_triangles(*indices, element.count, cursor);
  for (std::uint64_t i = first; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      if (&property != indices) {
        cursor.skip(property);
        continue;
      }
      const char* place = cursor.place();
      const std::int64_t count = cursor.list_length(property);
      if (count > static_cast<std::int64_t>(max_face_corners))
        cursor.fail_at(place, "a face has at most 65535 vertices");
      corners_.clear();
      for (std::int64_t k = 0; k < count; ++k) {
        const char* at = cursor.place();
        corners_.push_back(vertex_of(cursor.integer(property.type), at, cursor));
      }
      add_polygon(place, cursor);
    }
}

// A strip of triangles: each vertex makes one with the two before it, turning alternately; -1 starts anew.
void PlyReader::read_strips(const PlyElement& element, PlyCursor& cursor) {
  const PlyProperty* const indices = find_list(element);
  if (indices == nullptr) return skip(element, cursor);
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      if (&property != indices) {
        cursor.skip(property);
        continue;
      }
      std::uint32_t before[2] = {};
      std::int64_t length = 0;
      for (std::int64_t count = cursor.list_length(property); count > 0; --count) {
        const char* at = cursor.place();
        const std::int64_t index = cursor.integer(property.type);
        if (index == strip_end) {
          length = 0;
          continue;
        }
        const std::uint32_t vertex = vertex_of(index, at, cursor);
        const bool odd = (length & 1) != 0;
        // Strips repeat vertices to turn: triangles of two points are none.
        if (length >= 2 && before[0] != before[1] && before[0] != vertex && before[1] != vertex)
          add_triangle(before[odd ? 1 : 0], before[odd ? 0 : 1], vertex, at, cursor);
        before[0] = before[1];
        before[1] = vertex;
        ++length;
      }
    }
}

void PlyReader::add_polygon(const char* place, const PlyCursor& cursor) {
  if (corners_.size() == 3) return add_triangle(corners_[0], corners_[1], corners_[2], place, cursor);
  if (corners_.size() < 3)
    return warn_at("degenerate face", place, cursor,
                   "face of " + std::to_string(corners_.size()) + " vertices skipped");
  points_.clear();
  for (const std::uint32_t corner : corners_) points_.push_back(desc_.positions[corner]);
  const auto result = triangulator_.run(points_, triangles_);
  if (result.tangled)
    warn_at("tangled polygon", place, cursor,
            "the polygon crosses itself or has no area; it is split into a fan");
  for (const auto& [a, b, c] : triangles_) add_triangle(corners_[a], corners_[b], corners_[c], place, cursor);
}

void PlyReader::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const char* place,
                             const PlyCursor& cursor) {
  const TriangleFault fault = fault_of_triangle(desc_.positions[a], desc_.positions[b], desc_.positions[c]);
  if (fault != TriangleFault::none) return warn_at(kind_of(fault), place, cursor, message_of(fault));
  if (desc_.triangles.size() == most_rows) throw LimitError(name_ + ": more than 2^31 - 1 triangles");
  desc_.triangles.v0.push_back(a);
  desc_.triangles.v1.push_back(b);
  desc_.triangles.v2.push_back(c);
}

void PlyReader::finish() {
  TriangleColumns& t = desc_.triangles;
  if (desc_.normals.size() != 0) t.n0 = t.v0, t.n1 = t.v1, t.n2 = t.v2;
  if (desc_.uvs.size() != 0) t.t0 = t.v0, t.t1 = t.v1, t.t2 = t.v2;
  t.material.resize(t.size(), 0);
  t.object.resize(t.size(), 0);
  desc_.object_names = {settings_.object_name};
  add_ply_material(header_, settings_, placed_warning(), desc_);
}

} // namespace

SceneDesc read_ply(const Source& source, const PlyReaderSettings& settings, Diagnostics& diagnostics) {
  return PlyReader(source, settings, diagnostics).run();
}

} // namespace fastrt
