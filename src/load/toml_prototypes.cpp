// SPDX-License-Identifier: Apache-2.0
// What is shown once, and what is shown again and again.
#include "src/load/text.hpp"
#include "src/load/toml_scene.hpp"
#include "src/scene/row_counts.hpp"

#include <iterator>
#include <utility>

namespace fastrt {
namespace {

constexpr std::size_t most_parts = most_toml_copies;

std::vector<std::string_view> shape_keys(const TomlShape& shape) {
  std::vector<std::string_view> keys = shape.keys;
  keys.insert(keys.end(), {"material", "name"});
  keys.insert(keys.end(), std::begin(placement_keys), std::end(placement_keys));
  return keys;
}

TomlFields shape_fields(const TomlFile& file, const TomlShape& shape, const TomlNode& node) {
  return {file.name, node, "[[" + std::string(shape.name) + "]]", shape_keys(shape)};
}

TomlFields instance_fields(const TomlFile& file, const TomlNode& node) {
  static constexpr std::string_view keys[] = {"of", "material", "name", "transform", "transforms", "repeat"};
  return {file.name, node, "[[instance]]", keys};
}

std::vector<TomlMap> placements_or_one(const TomlFields& fields) {
  std::vector<TomlMap> placements = read_placements(fields);
  if (placements.empty()) placements.emplace_back();
  return placements;
}

// A prototype's primitives that lie where they are share one set of rows; each of the others has its own and
// is a part that is moved.
class PrototypeReader {
public:
  PrototypeReader(const TomlFile& file, TomlScene& scene) : file_(file), scene_(scene) {}

  std::vector<TomlPart> run(const TomlEntry& entry) {
    if (entry.node.table() == nullptr)
      toml_fail(file_.name, entry.node.place, "prototype: expected tables [prototype.NAME]");
    const auto begin = checked_row_counts(scene_.desc);
    read_lists(entry, false);
    if (checked_row_counts(scene_.desc) != begin) push({scene_.add_prototype(begin), TomlMap{}});
    read_lists(entry, true);
    if (parts_.empty())
      toml_fail(file_.name, entry.node.place, "prototype " + in_quotes(entry.key) + " holds nothing");
    return std::move(parts_);
  }

private:
  void read_lists(const TomlEntry& entry, bool placed) {
    for (const TomlEntry& list : *entry.node.table()) {
      const TomlShape* shape = find_toml_shape(list.key);
      if (shape == nullptr && list.key != "instance")
        toml_fail(file_.name, list.place,
                  "unknown key " + in_quotes(list.key) + " in [prototype." + entry.key +
                      "]; it holds spheres, cylinders, cones, disks, polygons, cubes, meshes and instances");
      for (const TomlNode& node : toml_list(file_, list)) {
        if (shape == nullptr && placed) read_instance(node);
        if (shape != nullptr) read_shape(*shape, node, placed);
      }
    }
  }

  void read_shape(const TomlShape& shape, const TomlNode& node, bool placed) {
    const TomlFields fields = shape_fields(file_, shape, node);
    const bool is_placed = is_placed_by(fields);
    if (is_placed != placed) return;
    const auto begin = checked_row_counts(scene_.desc);
    shape.add(file_, fields, scene_);
    if (!placed || checked_row_counts(scene_.desc) == begin) return;
    const TomlPart part{scene_.add_prototype(begin), TomlMap{}};
    const std::vector<TomlMap> placements = read_placements(fields);
    check_room(fields, placements.size());
    // One copy is the object that the primitive is anyway.
    const auto name = placements.size() > 1 ? fields.find("name") : std::nullopt;
    std::size_t copy = 0;
    for (const TomlMap& map : placements)
      push(part, map, no_index, name ? scene_.add_copy(name->text(), ++copy, placements.size()) : no_index);
  }

  void read_instance(const TomlNode& node) {
    const TomlFields fields = instance_fields(file_, node);
    const std::vector<TomlPart>& of = scene_.prototype(fields.need("of"));
    const auto material = fields.find("material");
    const auto name = fields.find("name");
    const std::uint32_t own = material ? scene_.material(*material) : no_index;
    const std::vector<TomlMap> placements = placements_or_one(fields);
    check_room(fields, placements.size() * of.size());
    std::size_t copy = 0;
    for (const TomlMap& map : placements) {
      const std::uint32_t object = name ? scene_.add_copy(name->text(), ++copy, placements.size()) : no_index;
      for (const TomlPart& part : of) push(part, map, own, object);
    }
  }

  // Before memory is taken for them. All prototypes count, for all are kept.
  void check_room(const TomlFields& fields, std::size_t count) const {
    if (scene_.prototype_parts + count > most_parts)
      fields.fail(fields.place(),
                  "the prototypes have more than " + std::to_string(most_parts) + " parts in all");
  }

  void push(const TomlPart& part) {
    parts_.push_back(part);
    ++scene_.prototype_parts;
  }

  void push(TomlPart part, const TomlMap& map, std::uint32_t material, std::uint32_t object) {
    part.to_whole = after(map, part.to_whole);
    if (material != no_index) part.material = material;
    if (object != no_index) part.object = object;
    push(part);
  }

  const TomlFile& file_;
  TomlScene& scene_;
  std::vector<TomlPart> parts_;
};

} // namespace

bool is_placed_by(const TomlFields& fields) {
  for (const std::string_view key : placement_keys)
    if (fields.has(key)) return true;
  return false;
}

const TomlArray& toml_list(const TomlFile& file, const TomlEntry& entry) {
  const TomlArray* array = entry.node.array();
  if (array == nullptr)
    toml_fail(file.name, entry.place, in_quotes(entry.key) + " is a list: write [[" + entry.key + "]]");
  return *array;
}

void read_toml_prototype(const TomlFile& file, const TomlEntry& entry, TomlScene& scene) {
  if (scene.prototypes.contains(entry.key))
    toml_fail(file.name, entry.place, "prototype " + in_quotes(entry.key) + " is there already");
  scene.prototypes.emplace(entry.key, PrototypeReader(file, scene).run(entry));
}

void read_toml_instance(const TomlFile& file, const TomlNode& node, TomlScene& scene) {
  const TomlFields fields = instance_fields(file, node);
  const auto material = fields.find("material");
  scene.add_instances(fields, scene.prototype(fields.need("of")), placements_or_one(fields),
                      fields.find("name"), material ? scene.material(*material) : no_index);
}

void read_toml_shape(const TomlFile& file, const TomlShape& shape, const TomlNode& node, TomlScene& scene) {
  const TomlFields fields = shape_fields(file, shape, node);
  const std::vector<TomlMap> placements = read_placements(fields);
  const auto begin = checked_row_counts(scene.desc);
  shape.add(file, fields, scene);
  if (placements.empty() || checked_row_counts(scene.desc) == begin) return;
  // One copy is the object that the primitive is anyway.
  scene.add_instances(fields, {{scene.add_prototype(begin), TomlMap{}}}, placements,
                      placements.size() > 1 ? fields.find("name") : std::nullopt, no_index);
}

// Planes are in no prototype: they are moved themselves.
void read_toml_plane(const TomlFile& file, const TomlNode& node, TomlScene& scene) {
  static const TomlShape plane{"plane", {"point", "normal"}, nullptr};
  const TomlFields fields = shape_fields(file, plane, node);
  Vec3 point(0.0F), normal(0.0F, 1.0F, 0.0F);
  fields.read_vector("point", point);
  fields.read_direction("normal", normal);
  const auto name = fields.find("name");
  const std::uint32_t material = scene.material_of(fields);
  const std::vector<TomlMap> placements = placements_or_one(fields);
  std::uint32_t object = name ? 0 : scene.add_object(scene.next_name("plane"));
  std::size_t copy = 0;
  PlaneColumns& planes = scene.desc.planes;
  for (const TomlMap& map : placements) {
    if (name) object = scene.add_copy(name->text(), ++copy, placements.size());
    planes.point.push_back(Vec3(map.linear * glm::dvec3(point) + map.origin));
    planes.normal.push_back(
        Vec3(glm::normalize(glm::transpose(glm::inverse(map.linear)) * glm::normalize(glm::dvec3(normal)))));
    planes.material.push_back(material);
    planes.object.push_back(object);
  }
}

} // namespace fastrt
