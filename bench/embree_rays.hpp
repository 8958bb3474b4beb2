// SPDX-License-Identifier: Apache-2.0
// Rays in Embree's layouts. Part of the files that call Embree.
#pragma once

#include <embree3/rtcore.h>
#include <xmmintrin.h>

#include <algorithm>
#include <limits>

#include "bench/embree_workers.hpp"

namespace fastrt::bench {

// Field `lane` of a packet's column; a single ray has plain fields.
inline float& at(float& field, int) { return field; }
inline unsigned& at(unsigned& field, int) { return field; }
template <class T, int width>
T& at(T (&column)[width], int lane) {
  return column[lane];
}

// As Embree's manual recommends for threads that call it; fastrt's kernels run without.
class DenormalsAreZero {
public:
  DenormalsAreZero() noexcept { _mm_setcsr(before_ | flush_to_zero | denormals_are_zero); }
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;
  ~DenormalsAreZero() { _mm_setcsr(before_); }

private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040; // bits of MXCSR
  unsigned before_ = _mm_getcsr();
};

// Holds the rays in packets. Those who derive from it call Embree.
template <class RayHit, int width>
class EmbreeWorker : public Worker {
public:
  explicit EmbreeWorker(const EmbreeQuery& query)
      : scene_(query.scene), question_(query.question), triangle_count_(query.triangle_count) {
    rtcInitIntersectContext(&context_);
    context_.flags =
        query.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  void load(const RayBatch* batches, std::size_t count) override {
    packets_.resize(count * batch_size / width);
    lanes_.clear();
    batch_ends_.clear();
    for (std::size_t b = 0; b < count; ++b) {
      load(batches[b]);
      batch_ends_.push_back(lanes_.size());
    }
  }

  void trace() final {
    const DenormalsAreZero zero;
    if (question_ == Question::any)
      occlude();
    else
      intersect();
  }

  void answers(std::vector<std::int32_t>& out) const override {
    out.clear();
    for (std::size_t p = 0; p < lanes_.size(); ++p) {
      RayHit packet = packets_[p];
      for (int lane = 0; lane < lanes_[p]; ++lane) out.push_back(answer(packet, lane));
    }
  }

protected:
  virtual void intersect() = 0;
  virtual void occlude() = 0;

  RTCScene scene_;
  RTCIntersectContext context_{};
  std::vector<RayHit> packets_;
  std::vector<int> lanes_;              // used, of each packet
  std::vector<std::size_t> batch_ends_; // in packets

private:
  // Packets are full, whatever places the batch leaves empty.
  void load(const RayBatch& batch) {
    int rows[batch_size];
    int rays = 0;
    for (int i = 0; i < batch.count; ++i)
      if (is_ray(batch, i)) rows[rays++] = i;
    for (int first = 0; first < rays; first += width) {
      const int used = std::min(width, rays - first);
      fill(packets_[lanes_.size()], batch, rows + first, used);
      lanes_.push_back(used);
    }
  }

  static void fill(RayHit& packet, const RayBatch& batch, const int* rows, int used) {
    for (int lane = 0; lane < width; ++lane) {
      const int i = rows[std::min(lane, used - 1)];
      at(packet.ray.org_x, lane) = batch.origin_x[i];
      at(packet.ray.org_y, lane) = batch.origin_y[i];
      at(packet.ray.org_z, lane) = batch.origin_z[i];
      at(packet.ray.dir_x, lane) = batch.dir_x[i];
      at(packet.ray.dir_y, lane) = batch.dir_y[i];
      at(packet.ray.dir_z, lane) = batch.dir_z[i];
      at(packet.ray.tnear, lane) = batch.t_min[i];
      // Streams have no mask: what has no room between tnear and tfar is no ray.
      at(packet.ray.tfar, lane) = lane < used ? batch.t_max[i] : -std::numeric_limits<float>::infinity();
      at(packet.ray.time, lane) = 0.0F;
      at(packet.ray.mask, lane) = 0xFFFFFFFFU;
      at(packet.ray.id, lane) = 0;
      at(packet.ray.flags, lane) = 0;
      at(packet.hit.geomID, lane) = RTC_INVALID_GEOMETRY_ID;
    }
  }

  std::int32_t answer(RayHit& packet, int lane) const {
    if (question_ == Question::any) return at(packet.ray.tfar, lane) < 0.0F ? 0 : no_primitive;
    const unsigned geometry = at(packet.hit.geomID, lane), primitive = at(packet.hit.primID, lane);
    if (geometry == RTC_INVALID_GEOMETRY_ID) return no_primitive;
    return static_cast<std::int32_t>(geometry == 0 ? primitive : triangle_count_ + primitive);
  }

  Question question_;
  std::uint32_t triangle_count_;
};

} // namespace fastrt::bench
