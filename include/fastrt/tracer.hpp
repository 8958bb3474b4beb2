// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fastrt/bvh_quality.hpp>
#include <fastrt/isa.hpp>
#include <fastrt/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace fastrt {

// The primitive of a ray that hits nothing.
inline constexpr std::int32_t no_primitive = -1;

// What the caller knows about rays that are handed over together. It never changes an answer, only the time.
enum class Coherence {
  unknown,  // any rays
  coherent, // neighbours in the arrays are similar: same region, similar direction
  tile,     // coherent, and each run of 256 rays has one common origin
};

// Rays as structure of arrays, `count` of each. Directions need not be normalised; t is measured in their
// length. A hit counts when t_min < t < t_max. t_min and t_max may be null: 0 and infinity. A ray with a
// number that is not finite (t_max excepted) hits nothing or anything, but does no harm.
struct RayArrays {
  const float *origin_x, *origin_y, *origin_z;
  const float *dir_x, *dir_y, *dir_z;
  const float* t_min = nullptr;
  const float* t_max = nullptr;
  std::size_t count = 0;
};

// Where closest_hit writes, `count` of each. On a miss: t = t_max, primitive = no_primitive, u = v = 0.
// (u, v) of a triangle weigh its second and third vertex. Around and up: u of spheres and cones goes once
// around the axis (a sphere's is y), v from the lower end to the upper one; a disk's v from its middle to its
// rim. On polygons and planes they are lengths along two directions of the plane, in a prototype's own space.
// instance: which one shows the primitive; no_instance where none does.
// u, v and instance may be null.
struct HitArrays {
  float* t;
  float* u = nullptr;
  float* v = nullptr;
  std::int32_t* primitive;
  std::int32_t* instance = nullptr;
};

// Of all trees together: the scene's, and those of the prototypes. Isa::scalar has trees of its own, whose
// leaves hold primitives, not blocks.
struct BvhStats {
  double sah_cost = 0; // expected node visits + tests of a leaf's primitives of a ray that meets the root
  std::size_t node_count = 0;
  std::size_t leaf_count = 0;
  std::size_t block_count = 0;
  int depth = 0;
  std::size_t bytes = 0;
  double bytes_per_primitive = 0;
  double build_seconds = 0;
};

struct TracerSettings {
  BvhQuality quality = BvhQuality::standard;
  Isa isa;         // which kernels
  int threads = 0; // for the build; as RenderSettings::threads
  // false: no bounding volume keeps a ray from a primitive, to show what they buy. The answers are the same.
  bool culling = true;
  TracerSettings() : isa(select_isa("auto")) {}
};

// A scene with its bounding volume hierarchy, ready to be asked. Const calls may come from several threads at
// once, whose stacks have 1 MiB or more.
class Tracer {
public:
  // Builds the hierarchy. Throws UsageError for an ISA that this machine lacks, and LimitError.
  explicit Tracer(Scene scene, const TracerSettings& settings = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;
  Tracer& operator=(Tracer&&) noexcept;

  const Scene& scene() const noexcept;
  Isa isa() const noexcept;
  const BvhStats& bvh_stats() const noexcept;

  // The hit with the smallest t per ray; at equal t what no instance shows before what one shows, then the
  // smallest instance, then the smallest primitive id.
  void closest_hit(const RayArrays& rays, const HitArrays& hits,
                   Coherence coherence = Coherence::unknown) const;
  // hit[i] = 1 if anything lies in (t_min, t_max) of ray i, else 0.
  void any_hit(const RayArrays& rays, std::uint8_t* hit, Coherence coherence = Coherence::unknown) const;

  struct Parts; // of the library alone
  const Parts& parts() const noexcept { return *parts_; }

private:
  std::unique_ptr<Parts> parts_;
};

} // namespace fastrt
