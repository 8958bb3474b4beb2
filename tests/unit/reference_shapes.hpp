// SPDX-License-Identifier: Apache-2.0
// Meshes and rays that tests make up: no model files, and the same numbers on every machine.
#pragma once

#include "src/film/sampling.hpp"
#include "src/reference/ray.hpp"

#include <fastrt/scene.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace fastrt::test {

// A counter-based generator: number i depends on the seed and i alone.
class Random {
public:
  explicit Random(std::uint32_t seed) : state_(hash32(seed)) {}
  std::uint32_t word() { return hash32(state_ += 0x9E3779B9U); }
  std::uint32_t below(std::uint32_t limit) { return word() % limit; }
  float uniform() { return static_cast<float>(word() >> 8U) * 0x1p-24F; } // [0, 1)
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  Vec3 in_cube() {
    const float x = uniform(-1, 1);
    const float y = uniform(-1, 1);
    return {x, y, uniform(-1, 1)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube();
      const float square = glm::dot(v, v);
      if (square > 0.01F && square < 1.0F) return v / std::sqrt(square);
    }
  }

private:
  std::uint32_t state_;
};

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;

  std::size_t triangle_count() const { return indices.size() / 3; }
  Vec3 corner(std::size_t triangle, std::size_t i) const { return positions[indices[3 * triangle + i]]; }
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    indices.insert(indices.end(), {a, b, c});
  }
};

// The icosahedron, each triangle split in four `levels` times, every vertex at distance 1 from the centre.
inline Mesh icosphere(int levels) {
  const float g = (1.0F + std::sqrt(5.0F)) / 2;
  Mesh mesh;
  mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                  4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                  6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = middles.try_emplace(std::pair(std::min(a, b), std::max(a, b)),
                                                       static_cast<std::uint32_t>(mesh.positions.size()));
      if (is_new) mesh.positions.push_back(0.5F * (mesh.positions[a] + mesh.positions[b]));
      return entry->second;
    };
    const std::vector<std::uint32_t> old = std::move(mesh.indices);
    mesh.indices.clear();
    for (std::size_t i = 0; i < old.size(); i += 3) {
      const std::uint32_t ab = middle(old[i], old[i + 1]);
      const std::uint32_t bc = middle(old[i + 1], old[i + 2]);
      const std::uint32_t ca = middle(old[i + 2], old[i]);
      mesh.add_triangle(old[i], ab, ca);
      mesh.add_triangle(old[i + 1], bc, ab);
      mesh.add_triangle(old[i + 2], ca, bc);
      mesh.add_triangle(ab, bc, ca);
    }
  }
  for (Vec3& position : mesh.positions) position = glm::normalize(position);
  return mesh;
}

// Every vertex moved by up to `amount` along each axis.
inline Mesh jittered(Mesh mesh, float amount, Random& random) {
  for (Vec3& position : mesh.positions) position += amount * random.in_cube();
  return mesh;
}

inline Mesh placed(Mesh mesh, float scale, const Vec3& offset) {
  for (Vec3& position : mesh.positions) position = scale * position + offset;
  return mesh;
}

// `cells` x `cells` squares of two triangles each over origin + a * right + b * up, 0 <= a, b <= 1.
inline Mesh grid(std::uint32_t cells, const Vec3& origin, const Vec3& right, const Vec3& up) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      mesh.positions.push_back(origin + (static_cast<float>(i) / static_cast<float>(cells)) * right +
                               (static_cast<float>(j) / static_cast<float>(cells)) * up);
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t corner = j * (cells + 1) + i;
      mesh.add_triangle(corner, corner + 1, corner + cells + 2);
      mesh.add_triangle(corner, corner + cells + 2, corner + cells + 1);
    }
  return mesh;
}

// Triangles without any connection, in the cube -1..1, about `size` large.
inline Mesh soup(std::uint32_t count, float size, Random& random) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 center = random.in_cube();
    for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(center + size * random.in_cube());
    mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

inline std::uint32_t add(SceneBuilder& builder, const Mesh& mesh, std::uint32_t material) {
  return builder.add_mesh(mesh.positions, mesh.indices, material);
}

// A point of the edge that starts at corner i, 0 <= share <= 1 along it.
inline Vec3 point_on_edge(const Mesh& mesh, std::size_t triangle, std::size_t i, float share) {
  const Vec3 a = mesh.corner(triangle, i);
  return a + share * (mesh.corner(triangle, (i + 1) % 3) - a);
}

} // namespace fastrt::test
