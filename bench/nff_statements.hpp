// SPDX-License-Identifier: Apache-2.0
// NFF scenes (Haines' Standard Procedural Databases) statement by statement, for those who write them in the
// words of other renderers.
#pragma once

#include <fastrt/math.hpp>

#include <array>
#include <filesystem>

namespace fastrt::bench {

struct NffView {
  Vec3 from{0.0F}, at{0.0F}, up{0.0F};
  float angle = 0; // degrees, of the whole picture
};

struct NffFill {
  Vec3 color{0.0F};
  float diffuse = 0, specular = 0, shine = 0, transmittance = 0, ior = 0;
};

// A cylinder where both radii are equal.
struct NffCone {
  Vec3 base{0.0F}, apex{0.0F};
  float base_radius = 0, apex_radius = 0;
};

struct NffTriangle {
  std::array<Vec3, 3> corners, normals;
  bool smooth; // else its normals mean nothing
};

// Takes the statements in their order, but lights only before the first fill.
class NffWriter {
public:
  NffWriter() = default;
  NffWriter(const NffWriter&) = delete;
  NffWriter& operator=(const NffWriter&) = delete;
  virtual ~NffWriter() = default;

  virtual void view(const NffView& view) = 0;
  virtual void background(const Vec3& color) = 0;
  // Lights without a colour share 1 / sqrt(count), as in fastrt.
  virtual void light(const Vec3& position, float intensity) = 0;
  virtual void fill(const NffFill& fill) = 0; // of what follows
  virtual void cone(const NffCone& cone) = 0;
  virtual void sphere(const Vec3& center, float radius) = 0;
  virtual void triangle(const NffTriangle& triangle) = 0; // polygons and patches come as these
  virtual void end() = 0;
};

// Throws InputError for what is not NFF.
void read_nff_statements(const std::filesystem::path& nff, NffWriter& writer);

} // namespace fastrt::bench
