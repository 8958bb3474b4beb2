// SPDX-License-Identifier: Apache-2.0
#include "src/render/photon_pass.hpp"

#include "src/render/part_done.hpp"
#include "src/scene/threads.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>

namespace fastrt {
namespace {

EmissionView view_of(const PhotonLight& light) {
  EmissionView view{};
  view.light = light.light;
  view.count = light.count;
  copy(light.u, view.u);
  copy(light.v, view.v);
  copy(light.w, view.w);
  view.cap_height = light.cap_height;
  copy(light.middle, view.middle);
  view.half_side = light.half_side;
  copy(light.flux, view.flux);
  view.cells = light.cells.data();
  view.cell_count = static_cast<std::uint32_t>(light.cells.size());
  return view;
}

// A thread's memory.
class PhotonMemory {
public:
  explicit PhotonMemory(int max_depth)
      : scratch_(std::make_unique<PhotonScratch>()),
        batches_(std::make_unique<PhotonBatch[]>(static_cast<std::size_t>(photon_batches(max_depth)))) {
    for (int i = 0; i < photon_batches(max_depth); ++i)
      scratch_->unused[scratch_->unused_count++] = &batches_[static_cast<std::size_t>(i)];
  }
  PhotonScratch& scratch() { return *scratch_; }

private:
  std::unique_ptr<PhotonScratch> scratch_;
  std::unique_ptr<PhotonBatch[]> batches_;
};

void take_stored(PhotonStore& store, std::uint32_t row, std::vector<Photon>& photons) {
  const auto vector_at = [](const float(&columns)[3][photon_store_size], int i) {
    return Vec3(columns[0][i], columns[1][i], columns[2][i]);
  };
  for (int i = 0; i < store.count; ++i)
    photons.push_back({vector_at(store.point, i), vector_at(store.normal, i), vector_at(store.flux, i), row,
                       store.index[i], store.key[i]});
  store.count = 0;
}

// One thread's share, until none is left.
void trace_chunks(const PhotonPass& pass, std::atomic<std::size_t>& next_chunk, FrameProgress& progress,
                  std::vector<Photon>& photons) {
  PhotonMemory memory(pass.job.max_depth);
  PhotonScratch& scratch = memory.scratch();
  while (!progress.stopped()) {
    const std::size_t index = next_chunk.fetch_add(1, std::memory_order_relaxed);
    if (index >= pass.chunks->size()) return;
    const PhotonChunk& chunk = (*pass.chunks)[index];
    PhotonJob job = pass.job;
    job.emission = view_of(pass.plan->lights[chunk.row]);
    job.last = chunk.last;
    scratch.next = chunk.first;
    TileRayCounts rays{};
    bool going_on = true;
    while (going_on) {
      going_on = pass.kernels->trace_photons(job, scratch, rays);
      take_stored(scratch.store, chunk.row, photons);
    }
    part_done(rays, progress);
  }
}

} // namespace

PhotonScene::PhotonScene(const Tracer::Parts& parts) : materials_(parts.materials), view_(parts.view) {
  for (MaterialRow& row : materials_)
    if (row.thin == 0) row.passes_light = 0;
  view_.shading.materials = materials_.data();
}

PhotonPass make_photon_pass(const Tracer::Parts& parts, const PhotonScene& scene, const PhotonPlan& plan,
                            const std::vector<PhotonChunk>& chunks, const RenderSettings& settings) {
  PhotonPass pass{parts.kernels, &plan, &chunks, {}, settings.threads};
  pass.job.scene = &scene.view();
  pass.job.seed = settings.seed;
  pass.job.max_depth = settings.max_depth;
  pass.job.min_contribution = settings.min_contribution;
  return pass;
}

std::vector<Photon> trace_photons(const PhotonPass& pass, FrameProgress& progress) {
  std::vector<Photon> all;
  std::mutex mutex;
  std::atomic<std::size_t> next_chunk{0};
#pragma omp parallel num_threads(thread_count(pass.threads))
  {
    // Exceptions must not leave a parallel region.
    try {
      std::vector<Photon> photons;
      trace_chunks(pass, next_chunk, progress, photons);
      const std::lock_guard lock(mutex);
      all.insert(all.end(), photons.begin(), photons.end());
    } catch (...) {
      progress.failed(std::current_exception());
    }
  }
  return all;
}

} // namespace fastrt
