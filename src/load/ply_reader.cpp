// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_reader.hpp"

#include "src/load/mtl.hpp"
#include "src/load/ply_cursor.hpp"
#include "src/load/polygon.hpp"
#include "src/load/text.hpp"

#include <fastrt/error.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace fastrt {

namespace {

constexpr std::uint64_t most_rows = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t most_corners = 65535;
constexpr std::int64_t strip_end = -1;

// What a vertex property fills, and the other names that it goes by.
enum Slot { x, y, z, nx, ny, nz, u, v, red, green, blue, slot_count };

struct SlotName {
  std::string_view name;
  Slot slot;
};
constexpr SlotName slot_names[] = {{"x", x},
                                   {"y", y},
                                   {"z", z},
                                   {"nx", nx},
                                   {"ny", ny},
                                   {"nz", nz},
                                   {"u", u},
                                   {"s", u},
                                   {"texture_u", u},
                                   {"v", v},
                                   {"t", v},
                                   {"texture_v", v},
                                   {"red", red},
                                   {"green", green},
                                   {"blue", blue},
                                   {"r", red},
                                   {"g", green},
                                   {"b", blue},
                                   {"diffuse_red", red},
                                   {"diffuse_green", green},
                                   {"diffuse_blue", blue}};

// Integer colours are codes of the sRGB curve.
float linear_of(float code, float most) {
  const double share = static_cast<double>(code) / static_cast<double>(most);
  return static_cast<float>(share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4));
}

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
        read_vertices(element, cursor);
      else if (element.name == "face")
        read_faces(element, cursor);
      else if (element.name == "tristrips")
        read_strips(element, cursor);
      else
        skip(element, cursor);
    }
    if (desc_.triangles.size() == 0) warn("no primitives", name_ + ": no primitives");
    finish();
    return std::move(desc_);
  }

private:
  void warn(const char* kind, const std::string& message) {
    if (settings_.strict) throw InputError(message);
    diagnostics_.warn(kind, message);
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
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (const PlyProperty& property : element.properties) skip(property, cursor);
  }
  void skip(const PlyProperty& property, PlyCursor& cursor) {
    std::int64_t count = property.is_list ? length_of(property, cursor) : 1;
    for (; count > 0; --count) cursor.skip(property.type);
  }

  std::int64_t length_of(const PlyProperty& property, PlyCursor& cursor) {
    const char* place = cursor.place();
    const std::int64_t count = cursor.integer(property.count_type);
    if (count < 0) cursor.fail_at(place, "a list of " + std::to_string(count) + " items");
    return count;
  }

  void read_vertices(const PlyElement& element, PlyCursor& cursor);
  template <class T>
  void read_column(const char* from, std::size_t stride, std::size_t count, Column<float>& to);
  void read_rows(const PlyElement& element, const std::vector<int>& slots, PlyCursor& cursor);
  void keep_columns(const PlyElement& element, const std::vector<int>& slots);
  void check_finite(Slot first, Slot last, const char* place, std::size_t stride, const PlyCursor& cursor);

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
  std::array<Column<float>, slot_count> columns_;
  bool has_vertices_ = false;
  std::map<std::string, std::size_t> counts_; // of warnings, by kind
  PolygonTriangulator triangulator_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> points_;
  std::vector<PolygonTriangulator::Triangle> triangles_;
};

// Which slot each property fills; -1: none.
std::vector<int> slots_of(const PlyElement& element) {
  std::vector<int> slots;
  for (const PlyProperty& property : element.properties) {
    int found = -1;
    for (const SlotName& known : slot_names)
      if (!property.is_list && known.name == lower_case(property.name)) found = known.slot;
    slots.push_back(found);
  }
  return slots;
}

template <class T>
void PlyReader::read_column(const char* from, std::size_t stride, std::size_t count, Column<float>& to) {
  float* const values = to.data();
  if (header_.format == PlyFormat::big_endian)
    for (std::size_t i = 0; i < count; ++i, from += stride)
      values[i] = static_cast<float>(PlyCursor::load<T>(from, true));
  else
    for (std::size_t i = 0; i < count; ++i, from += stride)
      values[i] = static_cast<float>(PlyCursor::load<T>(from, false));
}

void PlyReader::read_rows(const PlyElement& element, const std::vector<int>& slots, PlyCursor& cursor) {
  const std::size_t width = slots.size();
  for (std::size_t i = 0; i < element.count; ++i)
    for (std::size_t k = 0; k < width; ++k) {
      const PlyProperty& property = element.properties[k];
      if (slots[k] < 0)
        skip(property, cursor);
      else
        columns_[static_cast<std::size_t>(slots[k])][i] = cursor.number(property.type);
    }
}

void PlyReader::read_vertices(const PlyElement& element, PlyCursor& cursor) {
  has_vertices_ = true;
  const std::vector<int> slots = slots_of(element);
  std::size_t stride = 0;
  bool has_list = false;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    stride += size_of(element.properties[k].type);
    has_list = has_list || element.properties[k].is_list;
    if (slots[k] >= 0) columns_[static_cast<std::size_t>(slots[k])].resize(element.count);
  }
  const char* place = cursor.place();
  if (header_.format == PlyFormat::ascii || has_list) {
    read_rows(element, slots, cursor);
  } else {
    const char* from = cursor.take(element.count * stride);
    for (std::size_t k = 0; k < slots.size(); ++k) {
      const PlyType type = element.properties[k].type;
      if (slots[k] >= 0)
        PlyCursor::with_type(type, [&]<class T>(T) {
          read_column<T>(from, stride, element.count, columns_[static_cast<std::size_t>(slots[k])]);
        });
      from += size_of(type);
    }
  }
  for (const Slot axis : {x, y, z})
    if (columns_[axis].size() != element.count)
      throw InputError(name_ + ": the vertices have no property '" + "xyz"[axis] + "'");
  check_finite(x, v, place, has_list ? 0 : stride, cursor);
  keep_columns(element, slots);
}

// Binary floats may be anything; text has been looked at.
void PlyReader::check_finite(Slot first, Slot last, const char* place, std::size_t stride,
                             const PlyCursor& cursor) {
  if (header_.format == PlyFormat::ascii) return;
  for (int slot = first; slot <= last; ++slot) {
    const Column<float>& column = columns_[static_cast<std::size_t>(slot)];
    for (std::size_t i = 0; i < column.size(); ++i)
      if (!std::isfinite(column[i]))
        cursor.fail_at(place + i * stride,
                       "vertex " + std::to_string(i) + " holds a number that is not finite");
  }
}

// Three of a kind, or none.
void PlyReader::keep_columns(const PlyElement& element, const std::vector<int>& slots) {
  desc_.positions = {std::move(columns_[x]), std::move(columns_[y]), std::move(columns_[z])};
  if (!columns_[nx].empty() && !columns_[ny].empty() && !columns_[nz].empty())
    desc_.normals = {std::move(columns_[nx]), std::move(columns_[ny]), std::move(columns_[nz])};
  if (!columns_[u].empty() && !columns_[v].empty())
    desc_.uvs = {std::move(columns_[u]), std::move(columns_[v])};
  if (columns_[red].empty() || columns_[green].empty() || columns_[blue].empty()) return;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const PlyType type = element.properties[k].type;
    if (slots[k] < red) continue;
    Column<float>& column = columns_[static_cast<std::size_t>(slots[k])];
    if (type == PlyType::uint8) {
      std::array<float, 256> decoded{};
      for (std::size_t code = 0; code < 256; ++code) decoded[code] = linear_of(static_cast<float>(code), 255);
      for (float& value : column)
        value = value >= 0 && value <= 255 ? decoded[static_cast<std::size_t>(value)] : 1;
    } else {
      const float most = type == PlyType::uint16 ? 65535.0F : 255.0F;
      for (float& value : column) {
        if (!(value >= 0 && value < infinity)) value = 0;
        if (is_integer(type)) value = linear_of(std::fmin(value, most), most);
      }
    }
  }
  desc_.colors = {std::move(columns_[red]), std::move(columns_[green]), std::move(columns_[blue])};
}

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
  for (auto* column : {&desc_.triangles.v0, &desc_.triangles.v1, &desc_.triangles.v2})
    column->reserve(column->size() + element.count);
  std::uint64_t first = 0;
  if (element.properties.size() == 1) first = read_plain_triangles(*indices, element.count, cursor);
  for (std::uint64_t i = first; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      if (&property != indices) {
        skip(property, cursor);
        continue;
      }
      const char* place = cursor.place();
      const std::int64_t count = length_of(property, cursor);
      if (count > most_corners) cursor.fail_at(place, "a face has at most 65535 vertices");
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
        skip(property, cursor);
        continue;
      }
      std::uint32_t before[2] = {};
      std::int64_t length = 0;
      for (std::int64_t count = length_of(property, cursor); count > 0; --count) {
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

// Tested with the very cross product that shading normalises later: 0 and overflow have no normal.
void PlyReader::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const char* place,
                             const PlyCursor& cursor) {
  const Vec3 origin = desc_.positions[a];
  const Vec3 normal = glm::cross(desc_.positions[b] - origin, desc_.positions[c] - origin);
  const float size = std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z);
  if (!(size > 0 && size < infinity))
    return warn_at("degenerate face", place, cursor, "triangle without area skipped");
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
  Material material = default_material();
  if (desc_.colors.size() != 0) {
    material.ambient = material.diffuse = Vec3(1.0F);
    material.vertex_colors = true;
  }
  desc_.materials = {material};
}

} // namespace

SceneDesc read_ply(const Source& source, const PlyReaderSettings& settings, Diagnostics& diagnostics) {
  return PlyReader(source, settings, diagnostics).run();
}

} // namespace fastrt
