// SPDX-License-Identifier: Apache-2.0
// [[mesh]]: what a file of another format shows, or triangles written out.
#include "src/load/polygon.hpp"
#include "src/load/scene_append.hpp"
#include "src/load/text.hpp"
#include "src/load/toml_scene.hpp"
#include "src/load/triangle_fault.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace fastrt {
namespace {

constexpr std::size_t most_files = 65536;

// Where the rows of a mesh begin.
struct Rows {
  std::size_t triangles, spheres, cones, disks, polygons, materials, objects;
  explicit Rows(const SceneDesc& desc)
      : triangles(desc.triangles.size()), spheres(desc.spheres.size()), cones(desc.cones.size()),
        disks(desc.disks.size()), polygons(desc.polygons.size()), materials(desc.materials.size()),
        objects(desc.object_names.size()) {}
};

// Calls change(material column, object column, first row) for each kind of primitive.
template <class Change>
void for_each_kind(SceneDesc& desc, const Rows& from, Change change) {
  change(desc.triangles.material, desc.triangles.object, from.triangles);
  change(desc.spheres.material, desc.spheres.object, from.spheres);
  change(desc.cones.material, desc.cones.object, from.cones);
  change(desc.disks.material, desc.disks.object, from.disks);
  change(desc.polygons.material, desc.polygons.object, from.polygons);
}

// `materials = { NAME = "OTHER" }`: what the file calls NAME is the scene's OTHER.
void replace_materials(const TomlValue& value, const Rows& rows, TomlScene& scene) {
  const TomlTable* table = value.node().table();
  if (table == nullptr) value.fail("expected a table, found " + describe(value.node()));
  const std::vector<Material>& materials = scene.desc.materials;
  std::map<std::string_view, std::size_t> own; // the last of a name
  for (std::size_t i = rows.materials; i < materials.size(); ++i) own.insert_or_assign(materials[i].name, i);
  std::vector<std::uint32_t> now(materials.size() - rows.materials);
  std::iota(now.begin(), now.end(), static_cast<std::uint32_t>(rows.materials));
  for (const TomlEntry& entry : *table) {
    const std::uint32_t other = scene.material(TomlValue(value.file(), entry.node, entry.key));
    const auto found = own.find(entry.key);
    if (found == own.end())
      toml_fail(value.file(), entry.place, "materials: the mesh has no material " + in_quotes(entry.key));
    now[found->second - rows.materials] = other;
  }
  for_each_kind(scene.desc, rows, [&](auto& material, auto&, std::size_t first) {
    for (std::size_t i = first; i < material.size(); ++i) material[i] = now[material[i] - rows.materials];
  });
}

void override_owners(const TomlFields& fields, const Rows& rows, TomlScene& scene) {
  if (const auto materials = fields.find("materials")) replace_materials(*materials, rows, scene);
  if (const auto name = fields.find("material")) {
    const std::uint32_t own = scene.material(*name);
    for_each_kind(scene.desc, rows, [&](auto& material, auto&, std::size_t first) {
      std::fill(material.begin() + first, material.end(), own);
    });
  }
  if (const auto name = fields.find("name")) {
    scene.desc.object_names.resize(rows.objects);
    const std::uint32_t own = scene.add_object(name->text());
    for_each_kind(scene.desc, rows, [&](auto&, auto& object, std::size_t first) {
      std::fill(object.begin() + first, object.end(), own);
    });
  }
}

void add_file(const TomlFile& file, const TomlFields& fields, TomlScene& scene) {
  const TomlValue name = fields.need("file");
  for (const std::string_view key : {"points", "faces", "normals", "uvs", "colors"})
    if (fields.has(key))
      fields.fail(fields.place(key), "[[mesh]] has both 'file' and '" + std::string(key) + '\'');
  const auto [path, real_path] = scene.find_file(file, name, "mesh file");
  const std::string extension = lower_case(path.extension().string());
  if (extension != ".obj" && extension != ".ply" && extension != ".nff")
    name.fail("cannot tell the format of " + in_quotes(name.text()) + "; known: .obj .ply .nff");
  if (real_path == scene.base) return; // its side-car: the mesh is there already
  if (++scene.files > most_files) name.fail("more than " + std::to_string(most_files) + " mesh files");
  LoadOptions options = scene.options;
  options.sidecar = false;
  SceneDesc mesh = load_scene(path, options, scene.diagnostics);
  const Rows rows(scene.desc);
  append_scene(scene.desc, std::move(mesh));
  override_owners(fields, rows, scene);
}

// Points, and what belongs to each of them.
void read_vertices(const TomlFields& fields, SceneDesc& mesh) {
  for (const Vec3& point : fields.need("points").vectors(3)) mesh.positions.push_back(point);
  const auto check_length = [&](const TomlValue& value, std::size_t size) {
    if (size != mesh.positions.size())
      value.fail("expected one for each of the " + std::to_string(mesh.positions.size()) + " points, found " +
                 std::to_string(size));
  };
  if (const auto normals = fields.find("normals")) {
    for (const TomlValue& normal : normals->elements()) mesh.normals.push_back(normal.direction());
    check_length(*normals, mesh.normals.size());
  }
  if (const auto uvs = fields.find("uvs")) {
    for (const TomlValue& element : uvs->elements()) {
      const Vec2 uv = element.pair();
      mesh.uvs.x.push_back(uv.x), mesh.uvs.y.push_back(uv.y);
    }
    check_length(*uvs, mesh.uvs.size());
  }
  if (const auto colors = fields.find("colors")) {
    for (const TomlValue& color : colors->elements()) mesh.colors.push_back(color.color());
    check_length(*colors, mesh.colors.size());
  }
}

class FaceReader {
public:
  FaceReader(SceneDesc& mesh, TomlScene& scene) : mesh_(mesh), scene_(scene) {}

  void read(const TomlValue& value) {
    const std::vector<TomlValue> corners = value.elements();
    if (corners.size() < 3)
      value.fail("expected the numbers of three points or more, found " + std::to_string(corners.size()));
    if (corners.size() > max_face_corners) value.fail("a face has at most 65535 points");
    vertices_.clear();
    corners_.clear();
    const auto last = static_cast<std::int64_t>(mesh_.positions.size()) - 1;
    for (const TomlValue& corner : corners) {
      vertices_.push_back(static_cast<std::uint32_t>(corner.integer(0, last)));
      corners_.push_back(mesh_.positions[vertices_.back()]);
    }
    if (triangulator_.run(corners_, triangles_).tangled && corners.size() > 3)
      warn(value, "tangled polygon", "the polygon crosses itself or has no area; it is split into a fan");
    for (const auto& [a, b, c] : triangles_) {
      const TriangleFault fault = fault_of_triangle(corners_[a], corners_[b], corners_[c]);
      if (fault == TriangleFault::none)
        push(vertices_[a], vertices_[b], vertices_[c]);
      else
        warn(value, kind_of(fault), message_of(fault));
    }
  }

private:
  void warn(const TomlValue& face, const char* kind, const char* message) {
    scene_.warn(face.file(), face.place(), kind, message);
  }

  void push(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    TriangleColumns& t = mesh_.triangles;
    t.v0.push_back(a), t.v1.push_back(b), t.v2.push_back(c);
    if (mesh_.normals.size() != 0) t.n0.push_back(a), t.n1.push_back(b), t.n2.push_back(c);
    if (mesh_.uvs.size() != 0) t.t0.push_back(a), t.t1.push_back(b), t.t2.push_back(c);
    t.material.push_back(0);
    t.object.push_back(0);
  }

  SceneDesc& mesh_;
  TomlScene& scene_;
  std::vector<std::uint32_t> vertices_;
  std::vector<Vec3> corners_;
  PolygonTriangulator triangulator_;
  std::vector<PolygonTriangulator::Triangle> triangles_;
};

void add_written(const TomlFields& fields, TomlScene& scene) {
  if (fields.has("materials"))
    fields.fail(fields.place("materials"), "[[mesh]]: 'materials' are those of a 'file'");
  SceneDesc mesh;
  read_vertices(fields, mesh);
  const std::vector<TomlValue> faces = fields.need("faces").elements();
  if (faces.empty()) fields.need("faces").fail("expected at least one face");
  FaceReader reader(mesh, scene);
  for (const TomlValue& face : faces) reader.read(face);
  const auto name = fields.find("name");
  mesh.object_names.push_back(name ? name->text() : scene.next_name("mesh"));
  const std::uint32_t material = scene.material_of(fields);
  const Rows rows(scene.desc);
  append_scene(scene.desc, std::move(mesh));
  Column<std::uint32_t>& materials = scene.desc.triangles.material;
  std::fill(materials.begin() + rows.triangles, materials.end(), material);
}

} // namespace

void add_toml_mesh(const TomlFile& file, const TomlFields& fields, TomlScene& scene) {
  if (fields.has("file"))
    add_file(file, fields, scene);
  else
    add_written(fields, scene);
}

} // namespace fastrt
