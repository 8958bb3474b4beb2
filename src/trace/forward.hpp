// SPDX-License-Identifier: Apache-2.0
// The forward tracer's own part: from surfaces that photons met to the eye, and on as diffuse surfaces
// scatter them (docs/numerics.md, "Forward ray tracing").
#pragma once

#include "src/film/photon_sampling.hpp"
#include "src/trace/photon_arrival.hpp"

namespace fastrt::FASTRT_ISA_NAMESPACE {

// Where the eye sees surfaces, and by how much of it a unit of their light lights a pixel up.
struct SeenLanes {
  PathF x, y, z; // in the image; distance in the eye's ray
  PathF pixels;  // that a unit of area takes
  std::uint32_t bits;
};

FASTRT_INLINE SeenLanes see_from_eye(const EyeView& eye, const SurfaceBatch& s, std::uint32_t bits, int i) {
  const PathF zero(0.0F);
  const PathV q = load_point(s, i) - broadcast3<PathF>(eye.origin);
  const PathV normal = load_geometric(s, i);
  SeenLanes out;
  out.x = dot(q, broadcast3<PathF>(eye.u));
  out.y = dot(q, broadcast3<PathF>(eye.v));
  out.z = dot(q, broadcast3<PathF>(eye.w));
  PathF facing;
  if (eye.orthographic) {
    facing = negate(dot(normal, broadcast3<PathF>(eye.direction)));
    out.pixels = facing * PathF(eye.inverse_area);
  } else {
    const PathF inverse = PathF(1.0F) / out.z;
    out.x = out.x * inverse;
    out.y = out.y * inverse;
    facing = negate(dot(normal, q));
    out.pixels = (facing / ((out.z * out.z) * out.z)) * PathF(eye.inverse_area);
  }
  const auto number = [](int x) { return PathF(static_cast<float>(x)); };
  const PathM inside = (out.x >= number(eye.x_begin)) & (out.x < number(eye.x_end)) &
                       (out.y >= number(eye.y_begin)) & (out.y < number(eye.y_end));
  out.bits = to_bits(inside & (out.z > zero) & (facing > zero)) & bits;
  return out;
}

// Light on its way to the eye, a row for each ray of TileScratch::shadow.
struct SightBatch {
  float r[batch_size], g[batch_size], b[batch_size];
  long sum[batch_size]; // of the film
};

// A ray between the eye and surface i, as the eye's own rays go; parallel ones the other way round.
// instances: whether the scene has any.
FASTRT_INLINE void add_sight_ray(const EyeView& eye, const SurfaceBatch& s, bool instances, int i, float z,
                                 RayBatch& rays) {
  const float magnitude = s.magnitude[i];
  const float reached = instances ? eye.largest_coordinate * s.growth[i] : eye.largest_coordinate;
  const float size = eye.orthographic || magnitude > reached ? magnitude : reached;
  const float offset = size * offset_share;
  const float end[3] = {s.point_x[i] + s.geometric_x[i] * offset, s.point_y[i] + s.geometric_y[i] * offset,
                        s.point_z[i] + s.geometric_z[i] * offset};
  float* const origin[3] = {rays.origin_x, rays.origin_y, rays.origin_z};
  float* const dir[3] = {rays.dir_x, rays.dir_y, rays.dir_z};
  for (int axis = 0; axis < 3; ++axis) {
    origin[axis][rays.count] = eye.orthographic ? end[axis] : eye.origin[axis];
    dir[axis][rays.count] = eye.orthographic ? -eye.direction[axis] : end[axis] - eye.origin[axis];
  }
  rays.t_min[rays.count] = 0.0F;
  rays.t_max[rays.count] = eye.orthographic ? z : 1.0F;
  rays.exclude[rays.count] = s.planar[i];
  if (instances) rays.exclude_inner[rays.count] = s.planar_inner[i];
  ++rays.count;
}

static void aim_at_eye(const PhotonJob& job, const PhotonBatch& rays, const ArrivalBatch& arrival,
                       TileScratch& scratch, SightBatch& sight) noexcept {
  const EyeView& eye = job.eye;
  const SurfaceBatch& s = scratch.surface;
  const bool instances = job.scene->shading.shapes.instance_count != 0;
  scratch.shadow.count = 0;
  for (int i = 0; i < rays.count; i += widest) {
    if (arrival.lit[i / widest] == 0) continue;
    const SeenLanes seen = see_from_eye(eye, s, arrival.lit[i / widest], i);
    if (seen.bits == 0) continue;
    alignas(64) float light[3][widest], x[widest], y[widest], z[widest];
    const PathV scattered =
        (arrived_light(rays, arrival, i) * load_albedo(s, i)) * broadcast3<PathF>(job.emission.flux);
    store_lanes(scattered * seen.pixels, light);
    seen.x.store_aligned(x);
    seen.y.store_aligned(y);
    seen.z.store_aligned(z);
    for (std::uint32_t bits = seen.bits; bits != 0; bits &= bits - 1) {
      const int lane = __builtin_ctz(bits), k = scratch.shadow.count;
      sight.r[k] = light[0][lane];
      sight.g[k] = light[1][lane];
      sight.b[k] = light[2][lane];
      const long column = static_cast<int>(x[lane]) - eye.x_begin,
                 row = static_cast<int>(y[lane]) - eye.y_begin;
      sight.sum[k] = 3 * (row * (eye.x_end - eye.x_begin) + column);
      add_sight_ray(eye, s, instances, i + lane, z[lane], scratch.shadow);
    }
  }
}

FASTRT_INLINE void expose(std::int64_t* sum, float light) {
  if (!(light > 0.0F)) return;
  const float most = light < film_most ? light : film_most;
  __atomic_fetch_add(sum, static_cast<std::int64_t>(most * film_scale), __ATOMIC_RELAXED);
}

// In scenes that absorb: what is left of the light where the eye is in a medium. Bodies block the way, so
// that the medium stays the same.
FASTRT_INLINE void fade_towards_eye(const PhotonJob& job, TileScratch& scratch) {
  const int count = scratch.shadow.count;
  std::uint32_t alive[batch_size / widest];
  for (int i = 0; i < count; i += widest) {
    alive[i / widest] = lanes_in(count - i);
    for (int k = 0; k < max_media; ++k) PathI(job.eye.media[k]).store_aligned(scratch.shadow_media[k] + i);
  }
  trace_fading_shadows(*job.scene, false, alive, scratch);
}

// Collects what the eye sees of the batch's surfaces. Returns the number of rays to the eye.
static std::uint64_t connect_to_eye(const PhotonJob& job, const PhotonBatch& rays,
                                    const ArrivalBatch& arrival, TileScratch& scratch) noexcept {
  alignas(64) SightBatch sight;
  aim_at_eye(job, rays, arrival, scratch, sight);
  RayBatch& shadow = scratch.shadow;
  if (shadow.count == 0) return 0;
  shadow.shape = rays.depth != 0        ? BatchShape::coherent
                 : job.eye.orthographic ? BatchShape::parallel
                                        : BatchShape::common_origin;
  LightBatch& left = scratch.light;
  if (job.scene->shading.has_absorption != 0)
    fade_towards_eye(job, scratch);
  else if (job.scene->shading.has_transmission != 0)
    trace_coloured_shadows(*job.scene, shadow, scratch.shadow_hits, left);
  else
    trace_opaque_shadows(job.scene->geometry, shadow, scratch.shadow_hits, left);
  for (int i = 0; i < shadow.count; ++i) {
    std::int64_t* const sum = job.film + sight.sum[i];
    expose(sum, sight.r[i] * left.visible_r[i]);
    expose(sum + 1, sight.g[i] * left.visible_g[i]);
    expose(sum + 2, sight.b[i] * left.visible_b[i]);
  }
  return static_cast<std::uint64_t>(shadow.count);
}

// Directions around the normals, as likely as their cosine (the frame: Duff et al., JCGT 6(1), 2017).
FASTRT_INLINE PathV scattered_direction(const PhotonBatch& rays, const PathV& n, std::uint32_t bits, int i) {
  alignas(64) float local[3][widest] = {};
  for (; bits != 0; bits &= bits - 1) {
    const int lane = __builtin_ctz(bits);
    const LightPlace d = cosine_direction(rays.key[i + lane]);
    local[0][lane] = d.x;
    local[1][lane] = d.y;
    local[2][lane] = d.z;
  }
  const PathF one(1.0F);
  const PathF sign = flip(one, sign_bit(n.z));
  const PathF a = negate(one / (sign + n.z));
  const PathF b = (n.x * n.y) * a;
  const PathV u{one + (sign * (n.x * n.x)) * a, sign * b, negate(sign * n.x)};
  const PathV v{b, sign + (n.y * n.y) * a, negate(n.y)};
  return (u * PathF::load_aligned(local[0]) + v * PathF::load_aligned(local[1])) +
         n * PathF::load_aligned(local[2]);
}

// Photons that diffuse surfaces scatter, worth following, into `out`.
static void scatter_photons(const PhotonJob& job, const PhotonBatch& rays, const ArrivalBatch& arrival,
                            const SurfaceBatch& s, PathBatch& out) noexcept {
  const KeptColumns keep = kept_columns(job.scene->shading);
  for (int i = 0; i < rays.count; i += widest) {
    const PathV weight = load_weight(rays, i) * load_albedo(s, i);
    if (arrival.lit[i / widest] == 0) continue;
    const std::uint32_t bits = worth_tracing(weight, job.min_contribution) & arrival.lit[i / widest];
    if (bits == 0) continue;
    const PathV normal = load_geometric(s, i);
    const PathF offset = PathF::load_aligned(s.magnitude + i) * PathF(offset_share);
    const std::int32_t* media[max_media];
    for (int k = 0; k < max_media; ++k) media[k] = rays.media[k] + i;
    append_rays(
        {load_point(s, i) + normal * offset, scattered_direction(rays, normal, bits, i), weight, bits}, rays,
        s, keep, media, i, out);
  }
}

} // namespace fastrt::FASTRT_ISA_NAMESPACE
