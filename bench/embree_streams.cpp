// SPDX-License-Identifier: Apache-2.0
#include "bench/embree_rays.hpp"

namespace fastrt::bench {
namespace {

// Each batch is a stream of single rays: rtcIntersect1M.
class RayStreamWorker : public EmbreeWorker<RTCRayHit, 1> {
public:
  using EmbreeWorker::EmbreeWorker;

protected:
  // Calls call(first ray, how many) for each batch.
  template <class Call>
  void each_batch(const Call& call) const {
    std::size_t first = 0;
    for (const std::size_t end : batch_ends_) {
      if (end != first) call(first, static_cast<unsigned>(end - first));
      first = end;
    }
  }

private:
  void intersect() override {
    each_batch([&](std::size_t first, unsigned count) {
      rtcIntersect1M(scene_, &context_, &packets_[first], count, sizeof(RTCRayHit));
    });
  }
  void occlude() override {
    each_batch([&](std::size_t first, unsigned count) {
      rtcOccluded1M(scene_, &context_, &packets_[first].ray, count, sizeof(RTCRayHit));
    });
  }
};

// The same by pointers: rtcIntersect1Mp.
class RayPointerWorker final : public RayStreamWorker {
public:
  using RayStreamWorker::RayStreamWorker;

  void load(const RayBatch* batches, std::size_t count) override {
    RayStreamWorker::load(batches, count);
    ray_hits_.clear();
    rays_.clear();
    for (RTCRayHit& packet : packets_) {
      ray_hits_.push_back(&packet);
      rays_.push_back(&packet.ray);
    }
  }

private:
  void intersect() override {
    each_batch([&](std::size_t first, unsigned count) {
      rtcIntersect1Mp(scene_, &context_, &ray_hits_[first], count);
    });
  }
  void occlude() override {
    each_batch(
        [&](std::size_t first, unsigned count) { rtcOccluded1Mp(scene_, &context_, &rays_[first], count); });
  }

  std::vector<RTCRayHit*> ray_hits_;
  std::vector<RTCRay*> rays_;
};

struct alignas(64) BatchColumns : RTCRayHitNt<batch_size> {};

// Each batch is one packet of 256 rays, some of which may be none: rtcIntersectNM.
class ColumnWorker : public EmbreeWorker<BatchColumns, batch_size> {
public:
  using EmbreeWorker::EmbreeWorker;

private:
  void intersect() override {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      rtcIntersectNM(scene_, &context_, reinterpret_cast<RTCRayHitN*>(&packets_[i]), batch_size, 1,
                     sizeof(BatchColumns));
  }
  void occlude() override {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      rtcOccludedNM(scene_, &context_, reinterpret_cast<RTCRayN*>(&packets_[i].ray), batch_size, 1,
                    sizeof(BatchColumns));
  }
};

RTCRayHitNp pointers_to(BatchColumns& columns) {
  auto& [ray, hit] = static_cast<RTCRayHitNt<batch_size>&>(columns);
  return {{ray.org_x, ray.org_y, ray.org_z, ray.tnear, ray.dir_x, ray.dir_y, ray.dir_z, ray.time, ray.tfar,
           ray.mask, ray.id, ray.flags},
          {hit.Ng_x, hit.Ng_y, hit.Ng_z, hit.u, hit.v, hit.primID, hit.geomID, {hit.instID[0]}}};
}

// As many rays as the batch has, by pointers to the columns: rtcIntersectNp.
class ColumnPointerWorker final : public ColumnWorker {
public:
  using ColumnWorker::ColumnWorker;

  void load(const RayBatch* batches, std::size_t count) override {
    ColumnWorker::load(batches, count);
    pointers_.clear();
    for (BatchColumns& columns : packets_) pointers_.push_back(pointers_to(columns));
  }

private:
  void intersect() override {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      rtcIntersectNp(scene_, &context_, &pointers_[i], static_cast<unsigned>(lanes_[i]));
  }
  void occlude() override {
    for (std::size_t i = 0; i < lanes_.size(); ++i)
      rtcOccludedNp(scene_, &context_, &pointers_[i].ray, static_cast<unsigned>(lanes_[i]));
  }

  std::vector<RTCRayHitNp> pointers_;
};

} // namespace

std::unique_ptr<Worker> make_stream_worker(EmbreeCall call, const EmbreeQuery& query) {
  switch (call) {
  case EmbreeCall::stream_1m:
    return std::make_unique<RayStreamWorker>(query);
  case EmbreeCall::stream_1mp:
    return std::make_unique<RayPointerWorker>(query);
  case EmbreeCall::stream_nm:
    return std::make_unique<ColumnWorker>(query);
  case EmbreeCall::stream_np:
    return std::make_unique<ColumnPointerWorker>(query);
  default:
    return nullptr;
  }
}

} // namespace fastrt::bench
