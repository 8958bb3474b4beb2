// SPDX-License-Identifier: Apache-2.0
#include "src/load/ply_vertices.hpp"

#include "src/load/text.hpp"
#include "src/scene/srgb_curve.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace fastrt {

namespace {

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
  return static_cast<float>(linear_of_srgb(static_cast<double>(code) / static_cast<double>(most)));
}

using VertexColumns = std::array<Column<float>, slot_count>;

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
void read_column(const char* from, std::size_t stride, std::size_t count, bool swap, Column<float>& to) {
  float* const values = to.data();
  if (swap)
    for (std::size_t i = 0; i < count; ++i, from += stride)
      values[i] = static_cast<float>(PlyCursor::load<T>(from, true));
  else
    for (std::size_t i = 0; i < count; ++i, from += stride)
      values[i] = static_cast<float>(PlyCursor::load<T>(from, false));
}

void read_rows(const PlyElement& element, const std::vector<int>& slots, PlyCursor& cursor,
               VertexColumns& columns) {
  const std::size_t width = slots.size();
  for (std::size_t i = 0; i < element.count; ++i)
    for (std::size_t k = 0; k < width; ++k) {
      const PlyProperty& property = element.properties[k];
      if (slots[k] < 0)
        cursor.skip(property);
      else
        columns[static_cast<std::size_t>(slots[k])][i] = cursor.number(property.type);
    }
}

// Binary floats may be anything; text has been looked at.
void check_finite(const VertexColumns& columns, Slot first, Slot last, const char* place, std::size_t stride,
                  const PlyCursor& cursor) {
  if (cursor.format() == PlyFormat::ascii) return;
  for (int slot = first; slot <= last; ++slot) {
    const Column<float>& column = columns[static_cast<std::size_t>(slot)];
    for (std::size_t i = 0; i < column.size(); ++i)
      if (!std::isfinite(column[i]))
        cursor.fail_at(place + i * stride,
                       "vertex " + std::to_string(i) + " holds a number that is not finite");
  }
}

// Of several names for one thing the last one's values count.
bool is_overwritten(const std::vector<int>& slots, std::size_t property) {
  return std::find(slots.begin() + static_cast<std::ptrdiff_t>(property) + 1, slots.end(), slots[property]) !=
         slots.end();
}

// Three of a kind, or none.
void keep_columns(const PlyElement& element, const std::vector<int>& slots, VertexColumns& columns,
                  SceneDesc& desc) {
  desc.positions = {std::move(columns[x]), std::move(columns[y]), std::move(columns[z])};
  if (!columns[nx].empty() && !columns[ny].empty() && !columns[nz].empty())
    desc.normals = {std::move(columns[nx]), std::move(columns[ny]), std::move(columns[nz])};
  if (!columns[u].empty() && !columns[v].empty()) desc.uvs = {std::move(columns[u]), std::move(columns[v])};
  if (columns[red].empty() || columns[green].empty() || columns[blue].empty()) return;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const PlyType type = element.properties[k].type;
    if (slots[k] < red || is_overwritten(slots, k)) continue;
    Column<float>& column = columns[static_cast<std::size_t>(slots[k])];
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
  desc.colors = {std::move(columns[red]), std::move(columns[green]), std::move(columns[blue])};
}

} // namespace

void read_ply_vertices(const PlyElement& element, PlyCursor& cursor, const std::string& name,
                       SceneDesc& desc) {
  VertexColumns columns;
  const std::vector<int> slots = slots_of(element);
  std::size_t stride = 0;
  bool has_list = false;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    stride += size_of(element.properties[k].type);
    has_list = has_list || element.properties[k].is_list;
    if (slots[k] >= 0) columns[static_cast<std::size_t>(slots[k])].resize(element.count);
  }
  const char* place = cursor.place();
  if (cursor.format() == PlyFormat::ascii || has_list) {
    read_rows(element, slots, cursor, columns);
  } else {
    const char* from = cursor.take(element.count * stride);
    for (std::size_t k = 0; k < slots.size(); ++k) {
      const PlyType type = element.properties[k].type;
      if (slots[k] >= 0)
        PlyCursor::with_type(type, [&]<class T>(T) {
          read_column<T>(from, stride, element.count, cursor.format() == PlyFormat::big_endian,
                         columns[static_cast<std::size_t>(slots[k])]);
        });
      from += size_of(type);
    }
  }
  for (const Slot axis : {x, y, z})
    if (columns[axis].size() != element.count)
      throw InputError(name + ": the vertices have no property '" + "xyz"[axis] + "'");
  check_finite(columns, x, v, place, has_list ? 0 : stride, cursor);
  keep_columns(element, slots, columns, desc);
}

} // namespace fastrt
