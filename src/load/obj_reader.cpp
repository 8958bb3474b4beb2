// SPDX-License-Identifier: Apache-2.0
#include "src/load/obj_reader.hpp"

#include "src/load/chunks.hpp"
#include "src/load/mtl.hpp"
#include "src/load/obj_fill.hpp"
#include "src/load/parallel_for.hpp"
#include "src/load/smoothing.hpp"
#include "src/load/triangle_check.hpp"
#include "src/load/warn.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>
#include <vector>

namespace fastrt {

namespace {

class ObjReader {
public:
  ObjReader(const Source& source, const ObjReaderSettings& settings)
      : source_(source), settings_(settings), buffers_(static_cast<std::size_t>(settings.threads)) {}

  SceneDesc run(Diagnostics& diagnostics) {
    chunks_ = cut_into_chunks(source_, settings_.chunk_bytes, settings_.threads);
    scan();
    read_libraries();
    plan();
    allocate();
    fill();
    if (!failed_) check_triangles();
    report(diagnostics);
    if (plan_.has_smoothing) smooth_normals(desc_, smoothing_, settings_.threads);
    finish_materials();
    source_.check_unchanged();
    return std::move(desc_);
  }

private:
  void scan();
  void read_libraries();
  void plan();
  void allocate();
  void fill();
  void whiten_the_rest();
  void check_triangles();
  void report(Diagnostics& diagnostics);
  void finish_materials();

  const Source& source_;
  const ObjReaderSettings& settings_;
  std::vector<ChunkBuffer> buffers_; // of each thread
  std::vector<Chunk> chunks_;
  std::vector<ObjSummary> summaries_; // of each chunk, like the next two
  std::vector<ObjState> states_;
  std::vector<ObjChunkResult> results_;
  ObjPlan plan_;
  EventLog shared_log_; // of what belongs to no chunk
  SceneDesc desc_;
  ObjColors colors_{desc_};
  Column<std::uint32_t> smoothing_;
  bool failed_ = false;
};

void ObjReader::scan() {
  summaries_.resize(chunks_.size());
  parallel_for(chunks_.size(), settings_.threads, [&](std::size_t i, std::size_t thread) {
    buffers_[thread].read(source_, chunks_[i]);
    summaries_[i] = scan_obj(buffers_[thread], chunks_[i].begin);
  });
}

void ObjReader::read_libraries() {
  MaterialSet materials;
  for (const ObjSummary& summary : summaries_)
    for (const auto& [offset, names] : summary.libraries)
      if (settings_.read_library && !shared_log_.failed())
        settings_.read_library(names, offset, materials, shared_log_);
  desc_.materials = std::move(materials.materials);
  desc_.textures = std::move(materials.textures);
  plan_.materials = std::move(materials.ids);
  plan_.default_material = static_cast<std::uint32_t>(desc_.materials.size());
}

// Adds up what lies before each chunk, and hands on what is current at its start.
void ObjReader::plan() {
  bool has_slash = false;
  for (const ObjSummary& summary : summaries_) {
    const ObjCounts& before = plan_.totals;
    plan_.has_unnamed_object =
        plan_.has_unnamed_object || (summary.face_before_object && before.objects == 0);
    plan_.totals += summary.counts;
    has_slash = has_slash || summary.has_slash;
    plan_.has_smoothing = plan_.has_smoothing || summary.has_smoothing;
  }
  plan_.objects_are_groups = plan_.totals.objects == 0;
  if (plan_.objects_are_groups) {
    std::uint64_t groups = 0;
    plan_.has_unnamed_object = false;
    for (const ObjSummary& summary : summaries_) {
      plan_.has_unnamed_object = plan_.has_unnamed_object || (summary.face_before_group && groups == 0);
      groups += summary.counts.groups;
    }
  }
  plan_.has_normals = has_slash && plan_.totals.normals != 0;
  plan_.has_uvs = has_slash && plan_.totals.uvs != 0;

  ObjState state;
  state.material = plan_.default_material;
  for (const ObjSummary& summary : summaries_) {
    const std::uint64_t started = plan_.objects_are_groups ? state.before.groups : state.before.objects;
    state.object =
        static_cast<std::uint32_t>(started == 0 ? 0 : started - 1 + (plan_.has_unnamed_object ? 1 : 0));
    states_.push_back(state);
    state.before += summary.counts;
    if (summary.material) {
      const auto found = plan_.materials.find(*summary.material);
      state.material = found == plan_.materials.end() ? plan_.default_material : found->second;
    }
    if (summary.smoothing) state.smoothing = *summary.smoothing;
  }
}

void ObjReader::allocate() {
  constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  const ObjCounts& totals = plan_.totals;
  if (totals.triangles > most) throw LimitError(source_.name() + ": more than 2^31 - 1 triangles");
  if (std::max({totals.positions, totals.normals, totals.uvs}) > most)
    throw LimitError(source_.name() + ": more than 2^31 - 1 vertices, normals or texture coordinates");
  desc_.positions.resize(totals.positions);
  desc_.normals.resize(totals.normals);
  desc_.uvs.x.resize(totals.uvs);
  desc_.uvs.y.resize(totals.uvs);
  TriangleColumns& rows = desc_.triangles;
  for (auto* column : {&rows.v0, &rows.v1, &rows.v2, &rows.material, &rows.object})
    column->resize(totals.triangles);
  if (plan_.has_normals)
    for (auto* column : {&rows.n0, &rows.n1, &rows.n2}) column->resize(totals.triangles);
  if (plan_.has_uvs)
    for (auto* column : {&rows.t0, &rows.t1, &rows.t2}) column->resize(totals.triangles);
  if (plan_.has_smoothing) smoothing_.resize(totals.triangles);
  const std::uint64_t objects = plan_.objects_are_groups ? totals.groups : totals.objects;
  const bool only_unnamed = plan_.has_unnamed_object || objects == 0;
  desc_.object_names.resize(objects + (only_unnamed ? 1 : 0));
  if (only_unnamed) desc_.object_names.front() = settings_.object_name;
}

void ObjReader::fill() {
  results_.resize(chunks_.size());
  std::atomic<std::size_t> first_failed{chunks_.size()};
  parallel_for(chunks_.size(), settings_.threads, [&](std::size_t i, std::size_t thread) {
    if (i > first_failed.load(std::memory_order_relaxed)) return;
    buffers_[thread].read(source_, chunks_[i]);
    const bool with_care = summaries_[i].needs_care || chunks_[i].torn;
    ObjFiller(source_, plan_, desc_, colors_, plan_.has_smoothing ? &smoothing_ : nullptr)
        .fill(buffers_[thread], chunks_[i], states_[i], summaries_[i].counts, with_care, results_[i]);
    if (!results_[i].log.failed()) return;
    std::size_t known = first_failed.load();
    while (i < known && !first_failed.compare_exchange_weak(known, i)) {
    }
  });
  failed_ = first_failed.load() != chunks_.size();
  whiten_the_rest();
  bool uses_normals = false, uses_uvs = false;
  for (const ObjChunkResult& result : results_) {
    uses_normals = uses_normals || result.uses_normals;
    uses_uvs = uses_uvs || result.uses_uvs;
  }
  TriangleColumns& rows = desc_.triangles;
  if (!uses_normals) rows.n0 = rows.n1 = rows.n2 = {};
  if (!uses_uvs) rows.t0 = rows.t1 = rows.t2 = {};
}

// If there are colours: the positions of chunks without.
void ObjReader::whiten_the_rest() {
  if (desc_.colors.size() == 0) return;
  parallel_for(chunks_.size(), settings_.threads, [&](std::size_t i, std::size_t) {
    const std::uint64_t first = states_[i].before.positions;
    if (!results_[i].has_colors) colors_.start(first, first + summaries_[i].counts.positions);
  });
}

void ObjReader::check_triangles() {
  bool drop_zero_normals = false;
  for (const ObjChunkResult& result : results_)
    drop_zero_normals = drop_zero_normals || result.has_zero_normal;
  std::vector<TriangleCheck> checks(static_cast<std::size_t>(settings_.threads), TriangleCheck(desc_));
  parallel_for(chunks_.size(), settings_.threads, [&](std::size_t i, std::size_t thread) {
    const std::uint64_t first = states_[i].before.triangles;
    checks[thread].run(first, first + summaries_[i].counts.triangles, drop_zero_normals, results_[i]);
  });
  std::vector<std::uint32_t> dropped;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const ObjChunkResult& result = results_[i];
    report_findings(source_, chunks_[i], states_[i].before.triangles, result.findings, shared_log_);
    dropped.insert(dropped.end(), result.dropped.begin(), result.dropped.end());
  }
  TriangleColumns& rows = desc_.triangles;
  const std::array columns = {&rows.v0, &rows.v1, &rows.v2, &rows.n0,       &rows.n1,     &rows.n2,
                              &rows.t0, &rows.t1, &rows.t2, &rows.material, &rows.object, &smoothing_};
  parallel_for(columns.size(), settings_.threads,
               [&](std::size_t i, std::size_t) { drop_rows(*columns[i], dropped); });
}

void ObjReader::report(Diagnostics& diagnostics) {
  EventReport report;
  report.take(std::move(shared_log_));
  for (ObjChunkResult& result : results_) report.take(std::move(result.log));
  std::vector<LineAnchor> anchors;
  std::uint64_t lines = 0;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    anchors.push_back({chunks_[i].begin, lines});
    lines += summaries_[i].lines;
  }
  report.deliver(source_, anchors, settings_.strict, diagnostics);
  warn_without_primitives(desc_, source_.name(), settings_.strict, diagnostics);
}

// The default material lies behind all others, so it can be left out when nothing uses it.
void ObjReader::finish_materials() {
  bool used = desc_.materials.empty();
  for (const ObjChunkResult& result : results_) used = used || result.uses_default_material;
  if (used) desc_.materials.push_back(default_material());
  if (desc_.colors.size() != 0) show_vertex_colors(desc_, plan_.default_material);
}

} // namespace

SceneDesc read_obj(const Source& source, const ObjReaderSettings& settings, Diagnostics& diagnostics) {
  return ObjReader(source, settings).run(diagnostics);
}

} // namespace fastrt
