// SPDX-License-Identifier: Apache-2.0
#include "src/trace/tracer_parts.hpp"

#include <algorithm>

#include "bench/tracers.hpp"

namespace fastrt::bench {
namespace {

class KernelWorker final : public Worker {
public:
  KernelWorker(const GeometryView& scene, const KernelTable& table, Question question)
      : scene_(&scene), trace_(question == Question::any ? table.any_hits : table.closest_hits),
        question_(question), rays_(chunk_batches), hits_(chunk_batches) {}

  void load(const RayBatch* batches, std::size_t count) override {
    count_ = count;
    std::copy_n(batches, count, rays_.begin());
  }
  void trace() override {
    for (std::size_t i = 0; i < count_; ++i) trace_(*scene_, rays_[i], hits_[i]);
  }
  void answers(std::vector<std::int32_t>& out) const override {
    out.clear();
    for (std::size_t b = 0; b < count_; ++b)
      for (int i = 0; i < rays_[b].count; ++i) {
        if (!is_ray(rays_[b], i)) continue;
        const std::int32_t hit = hits_[b].primitive[i];
        out.push_back(question_ == Question::any ? std::min(hit, 0) : hit);
      }
  }

private:
  const GeometryView* scene_;
  void (*trace_)(const GeometryView&, const RayBatch&, HitBatch&) noexcept;
  Question question_;
  std::size_t count_ = 0;
  std::vector<RayBatch> rays_;
  std::vector<HitBatch> hits_;
};

class ScalarWorker final : public Worker {
public:
  ScalarWorker(std::shared_ptr<const ScalarBvh> bvh, Question question)
      : bvh_(std::move(bvh)), question_(question) {}

  void load(const RayBatch* batches, std::size_t count) override {
    rays_.clear();
    for (std::size_t b = 0; b < count; ++b)
      for (int i = 0; i < batches[b].count; ++i) {
        const RayBatch& r = batches[b];
        if (!is_ray(r, i)) continue;
        rays_.push_back({{r.origin_x[i], r.origin_y[i], r.origin_z[i]},
                         {r.dir_x[i], r.dir_y[i], r.dir_z[i]},
                         r.t_min[i],
                         r.t_max[i],
                         r.exclude[i]});
      }
    hits_.resize(rays_.size());
  }
  void trace() override {
    for (std::size_t i = 0; i < rays_.size(); ++i)
      hits_[i] = question_ == Question::any ? (bvh_->any(rays_[i]) ? 0 : no_primitive)
                                            : bvh_->closest(rays_[i]).primitive;
  }
  void answers(std::vector<std::int32_t>& out) const override { out = hits_; }

private:
  std::shared_ptr<const ScalarBvh> bvh_;
  Question question_;
  std::vector<reference::Ray> rays_;
  std::vector<std::int32_t> hits_;
};

} // namespace

const KernelTable& kernel_table_of(Isa isa) {
  if (isa == Isa::avx512) return avx512::kernel_table();
  return isa == Isa::avx2 ? avx2::kernel_table() : sse42::kernel_table();
}

Contender fastrt_contender(const Tracer& tracer, Isa isa) {
  if (isa == Isa::scalar) {
    const auto bvh = std::make_shared<const ScalarBvh>(tracer.scene());
    return {"scalar", [bvh](Question question) { return std::make_unique<ScalarWorker>(bvh, question); }};
  }
  const GeometryView& scene = tracer.parts().view.geometry;
  return {isa_name(isa), [&scene, isa](Question question) {
            return std::make_unique<KernelWorker>(scene, kernel_table_of(isa), question);
          }};
}

} // namespace fastrt::bench
