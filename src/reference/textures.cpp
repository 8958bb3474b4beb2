// SPDX-License-Identifier: Apache-2.0
// docs/numerics.md, "Textures", operation by operation.
#include "src/reference/textures.hpp"

#include "src/reference/arithmetic.hpp"
#include "src/reference/instances.hpp"
#include "src/scene/texture_numbers.hpp"
#include "src/simd/shared_math.hpp"

namespace fastrt::reference {
namespace {

using Vec4 = glm::vec4;

// A point of a surface as textures see it.
struct Site {
  Vec3 point{0.0F};
  Vec2 uv{0.0F};
  float density = 0;                 // area of (u, v) per area of the surface
  Vec3 weights{0.0F};                // of a triangle's corners
  Vec3 along_u{0.0F}, along_v{0.0F}; // which way u and v grow
  bool has_uv = false;
};

// The area that two edges span, with a sign.
float area(const Vec2& a, const Vec2& b) { return a.x * b.y - b.x * a.y; }

void place_on_triangle(Site& site, const Scene& scene, std::uint32_t triangle, const Hit& hit) {
  site.weights = {(1.0F - hit.u) - hit.v, hit.u, hit.v};
  const TriangleColumns& triangles = scene.triangles();
  if (triangles.t0.empty()) return;
  const std::uint32_t t0 = triangles.t0[triangle];
  const std::uint32_t t1 = triangles.t1[triangle];
  const std::uint32_t t2 = triangles.t2[triangle];
  if (t0 == no_index || t1 == no_index || t2 == no_index) return;
  const Columns2& uvs = scene.desc().uvs;
  const Vec2 a{uvs.x[t0], uvs.y[t0]};
  const Vec2 b{uvs.x[t1], uvs.y[t1]};
  const Vec2 c{uvs.x[t2], uvs.y[t2]};
  site.has_uv = true;
  site.uv = (site.weights.x * a + site.weights.y * b) + site.weights.z * c;

  const auto [va, vb, vc] = triangle_vertices(scene, triangle);
  Vec3 edge1 = vb - va;
  Vec3 edge2 = vc - va;
  if (hit.instance != no_instance) {
    const Affine& map = scene.desc().instances.to_world[static_cast<std::size_t>(hit.instance)];
    edge1 = map_vector(map, edge1);
    edge2 = map_vector(map, edge2);
  }
  const Vec2 step1 = b - a;
  const Vec2 step2 = c - a;
  const float uv_area = area(step1, step2);
  const Vec3 normal = glm::cross(edge1, edge2);
  site.density = std::fabs(uv_area) / std::sqrt(glm::dot(normal, normal));
  const float sign = uv_area < 0.0F ? -1.0F : 1.0F;
  site.along_u = sign * (step2.y * edge1 - step1.y * edge2);
  site.along_v = sign * (step1.x * edge2 - step2.x * edge1);
}

Site site_of(const Scene& scene, const Hit& hit, const Vec3& point) {
  Site site;
  site.point = point;
  const auto primitive = static_cast<std::uint32_t>(hit.primitive);
  if (scene.kind(primitive) == PrimitiveKind::triangle)
    place_on_triangle(site, scene, primitive, hit);
  else
    site.uv = {hit.u, hit.v};
  return site;
}

// A point of a texture, and the mip level there.
struct Place {
  Vec2 st{0.0F};
  float level = 0;
};

Place place_of(const Texture& texture, const Site& site, float footprint) {
  const bool planar = texture.space == TextureSpace::plane;
  const Vec2 uv =
      planar ? Vec2(glm::dot(site.point, texture.plane_u), glm::dot(site.point, texture.plane_v)) : site.uv;
  Place place;
  place.st = uv * texture.scale + texture.offset;
  if (texture.kind != TextureKind::image) return place;
  const float density = planar ? glm::length(glm::cross(texture.plane_u, texture.plane_v)) : site.density;
  const float pixels = (footprint * density) * texture_pixels(texture);
  const auto last = static_cast<float>(texture.image->levels().size() - 1);
  if (pixels > 1.0F) place.level = min(0.5F * baseline::shared_log2<baseline::ScalarOps>(pixels), last);
  return place;
}

float into_unit(float x, bool clamp) {
  if (clamp) return x > 0.0F ? min(x, 1.0F) : 0.0F;
  const float fraction = x - std::floor(x);
  return fraction >= 0.0F && fraction <= 1.0F ? fraction : 0.0F;
}

// A pixel's index that may be one outside.
int inside(int i, int size, bool clamp) {
  if (clamp) return i < 0 ? 0 : i >= size ? size - 1 : i;
  return (i + size) % size;
}

Vec4 mix(const Vec4& a, const Vec4& b, float share) { return a * (1.0F - share) + b * share; }

Vec4 bilinear(const Texture& texture, std::size_t level, const Vec2& st) {
  const Image& image = *texture.image;
  const Image::Level& size = image.levels()[level];
  const float x = st.x * static_cast<float>(size.width) - 0.5F;
  const float y = (1.0F - st.y) * static_cast<float>(size.height) - 0.5F;
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  const auto pixel = [&](int column, int row) {
    return image.pixel(level, inside(column, size.width, texture.clamp),
                       inside(row, size.height, texture.clamp));
  };
  const float right_share = x - std::floor(x);
  const Vec4 upper = mix(pixel(left, top), pixel(left + 1, top), right_share);
  const Vec4 lower = mix(pixel(left, top + 1), pixel(left + 1, top + 1), right_share);
  return mix(upper, lower, y - std::floor(y));
}

Vec4 value_of(const Texture& texture, const Place& place) {
  if (texture.kind == TextureKind::gradient)
    return mix(texture.color_a, texture.color_b, into_unit(place.st.y, texture.clamp));
  if (texture.kind == TextureKind::checker) {
    const float square = std::floor(place.st.x) + std::floor(place.st.y);
    return square - 2.0F * std::floor(square * 0.5F) == 1.0F ? texture.color_b : texture.color_a;
  }
  const Vec2 st{into_unit(place.st.x, texture.clamp), into_unit(place.st.y, texture.clamp)};
  const auto level = static_cast<std::size_t>(place.level);
  const float share = place.level - std::floor(place.level);
  const Vec4 value = bilinear(texture, level, st);
  return share > 0.0F ? mix(value, bilinear(texture, level + 1, st), share) : value;
}

Vec4 look_up(const Texture& texture, const Place& place) {
  const Vec4 value = value_of(texture, place) * texture.gain + texture.base;
  return {max(value.x, 0.0F), max(value.y, 0.0F), max(value.z, 0.0F), max(value.w, 0.0F)};
}

float number_of(const Texture& texture, const Place& place) {
  const Vec4 value = look_up(texture, place) * texture.channel;
  return ((value.x + value.y) + value.z) + value.w;
}

Vec3 color_of(const Scene& scene, std::uint32_t texture, const Site& site, float footprint) {
  if (texture == no_texture) return Vec3(1.0F);
  const Texture& found = scene.textures()[texture];
  return Vec3(look_up(found, place_of(found, site, footprint)));
}

float opacity_of(const Scene& scene, const Material& material, const Site& site, float footprint) {
  if (material.opacity_texture == no_texture) return material.opacity;
  const Texture& texture = scene.textures()[material.opacity_texture];
  return min(material.opacity * number_of(texture, place_of(texture, site, footprint)), 1.0F);
}

Vec3 vertex_color(const Scene& scene, std::uint32_t triangle, const Vec3& weights) {
  const TriangleColumns& triangles = scene.triangles();
  const Columns3& colors = scene.desc().colors;
  return (weights.x * colors[triangles.v0[triangle]] + weights.y * colors[triangles.v1[triangle]]) +
         weights.z * colors[triangles.v2[triangle]];
}

// The bump map's normal in the frame of u, v and the surface's normal.
Vec3 bump_of(const Material& material, const Texture& texture, const Place& place) {
  const Vec2 slope = bump_slope(material, texture);
  if (material.bump_is_normal_map) {
    const Vec3 n = Vec3(look_up(texture, place)) * 2.0F - Vec3(1.0F);
    return {n.x * slope.x, n.y * slope.y, n.z};
  }
  const Image::Level& level = texture.image->levels()[static_cast<std::size_t>(place.level)];
  const auto width = static_cast<float>(level.width);
  const auto height = static_cast<float>(level.height);
  Place right = place;
  Place above = place;
  right.st.x += 1.0F / width;
  above.st.y += 1.0F / height;
  const float here = number_of(texture, place);
  const float rise_u = number_of(texture, right) - here;
  const float rise_v = number_of(texture, above) - here;
  return {-((rise_u * width) * slope.x), -((rise_v * height) * slope.y), 1.0F};
}

// The shading normal turned by the bump map, or as it is where the bump makes no sense.
Vec3 bumped(const Scene& scene, const Material& material, const Site& site, float footprint,
            const Surface& surface) {
  const Vec3& n = surface.shading_normal;
  const Texture& texture = scene.textures()[material.bump_texture];
  const bool planar = texture.space == TextureSpace::plane;
  if (!planar && !site.has_uv) return n;
  const Vec3& along_u = planar ? texture.plane_u : site.along_u;
  const Vec3& along_v = planar ? texture.plane_v : site.along_v;
  const Vec3 flat = along_u - glm::dot(n, along_u) * n;
  const float flat_squared = glm::dot(flat, flat);
  if (!(0.0F < flat_squared && flat_squared < infinity)) return n;
  const Vec3 x = flat * (1.0F / std::sqrt(flat_squared));
  Vec3 y = glm::cross(n, x);
  if (glm::dot(y, along_v) < 0.0F) y = -y;
  const Vec3 bump = bump_of(material, texture, place_of(texture, site, footprint));
  const Vec3 turned = (bump.x * x + bump.y * y) + bump.z * n;
  const float length_squared = glm::dot(turned, turned);
  if (!(0.0F < length_squared && length_squared < infinity)) return n;
  const Vec3 unit = turned * (1.0F / std::sqrt(length_squared));
  return glm::dot(unit, surface.geometric_normal) > 0.0F ? unit : n;
}

} // namespace

bool has_textures(const Material& m) {
  for (const std::uint32_t texture : {m.ambient_texture, m.diffuse_texture, m.specular_texture,
                                      m.emission_texture, m.opacity_texture, m.bump_texture})
    if (texture != no_texture) return true;
  return m.vertex_colors;
}

void apply_textures(const Scene& scene, const Hit& hit, Surface& surface) {
  const Material& material = scene.materials()[surface.material];
  const Site site = site_of(scene, hit, surface.point);
  const float footprint =
      (surface.width * surface.width) / glm::dot(surface.geometric_normal, surface.to_viewer);
  Finish finish{material.ambient * color_of(scene, material.ambient_texture, site, footprint),
                material.diffuse * color_of(scene, material.diffuse_texture, site, footprint),
                material.specular * color_of(scene, material.specular_texture, site, footprint),
                material.emission * color_of(scene, material.emission_texture, site, footprint),
                opacity_of(scene, material, site, footprint)};
  const auto primitive = static_cast<std::uint32_t>(hit.primitive);
  if (material.vertex_colors && scene.kind(primitive) == PrimitiveKind::triangle) {
    const Vec3 color = vertex_color(scene, primitive, site.weights);
    finish.ambient = finish.ambient * color;
    finish.diffuse = finish.diffuse * color;
  }
  surface.finish = finish;
  if (material.bump_texture != no_texture)
    surface.shading_normal = bumped(scene, material, site, footprint, surface);
}

float opacity_at(const Scene& scene, const Ray& ray, const Hit& hit) {
  const Material& material =
      scene.materials()[scene.material_of(static_cast<std::uint32_t>(hit.primitive), hit.instance)];
  if (material.opacity_texture == no_texture) return material.opacity;
  return opacity_of(scene, material, site_of(scene, hit, ray.origin + hit.t * ray.direction), 0.0F);
}

} // namespace fastrt::reference
