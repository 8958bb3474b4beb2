// SPDX-License-Identifier: Apache-2.0
#include "src/load/smoothing.hpp"

#include "src/load/parallel_for.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace fastrt {

namespace {

class Smoothing {
public:
  Smoothing(SceneDesc& desc, const Column<std::uint32_t>& groups, int threads)
      : desc_(desc), rows_(desc.triangles), groups_(groups), threads_(threads) {}

  void run() {
    if (rows_.n0.empty())
      for (auto* column : {&rows_.n0, &rows_.n1, &rows_.n2}) column->resize(rows_.size(), no_index);
    list_triangles();
    number_normals();
    in_blocks(desc_.positions.size(), [this](std::size_t p) { make_normals(p); });
  }

private:
  template <class Task>
  void in_blocks(std::size_t count, Task&& task) {
    constexpr std::size_t block = 8192;
    parallel_for((count + block - 1) / block, threads_, [&](std::size_t b, std::size_t) {
      const std::size_t end = std::min(count, (b + 1) * block);
      for (std::size_t i = b * block; i < end; ++i) task(i);
    });
  }

  // Asked before any normal is given: while they are, the columns of other threads' triangles change.
  bool wants_normals(std::size_t i) const {
    return groups_[i] != 0 && rows_.n0[i] == no_index && rows_.n1[i] == no_index && rows_.n2[i] == no_index;
  }
  std::array<std::uint32_t, 3> vertices_of(std::size_t i) const {
    return {rows_.v0[i], rows_.v1[i], rows_.v2[i]};
  }

  // The triangles around each position, by group and then by number: however the threads come along.
  void list_triangles() {
    const std::size_t count = desc_.positions.size();
    first_.resize(count + 1, 0);
    const auto next_of = [this](std::size_t p) { return std::atomic_ref<std::uint64_t>(first_[p]); };
    in_blocks(rows_.size(), [&](std::size_t i) {
      if (!wants_normals(i)) return;
      for (const std::uint32_t p : vertices_of(i)) next_of(p).fetch_add(1, std::memory_order_relaxed);
    });
    std::uint64_t total = 0;
    for (std::uint64_t& first : first_) first = total += first;
    around_.resize(total);
    // first_ holds where each list ends; filling it from the back leaves where it begins.
    in_blocks(rows_.size(), [&](std::size_t i) {
      if (!wants_normals(i)) return;
      for (const std::uint32_t p : vertices_of(i))
        around_[next_of(p).fetch_sub(1, std::memory_order_relaxed) - 1] = static_cast<std::uint32_t>(i);
    });
    in_blocks(count, [&](std::size_t p) {
      const auto by_group = [this](std::uint32_t a, std::uint32_t b) {
        return groups_[a] != groups_[b] ? groups_[a] < groups_[b] : a < b;
      };
      std::sort(around_.begin() + first_[p], around_.begin() + first_[p + 1], by_group);
    });
  }

  // Calls run(begin, end) for the runs of one group around a position.
  template <class Run>
  void for_each_group(std::size_t p, Run&& run) const {
    for (std::uint64_t begin = first_[p]; begin != first_[p + 1];) {
      std::uint64_t end = begin;
      while (end != first_[p + 1] && groups_[around_[end]] == groups_[around_[begin]]) ++end;
      run(begin, end);
      begin = end;
    }
  }

  void number_normals() {
    const std::size_t count = desc_.positions.size();
    first_normal_.resize(count);
    in_blocks(count, [&](std::size_t p) {
      std::uint64_t groups = 0;
      for_each_group(p, [&](std::uint64_t, std::uint64_t) { ++groups; });
      first_normal_[p] = groups;
    });
    std::uint64_t total = desc_.normals.size();
    for (std::uint64_t& first : first_normal_) {
      const std::uint64_t groups = first;
      first = total;
      total += groups;
    }
    desc_.normals.resize(total);
  }

  void make_normals(std::size_t p) {
    std::uint64_t normal = first_normal_[p];
    for_each_group(p, [&](std::uint64_t begin, std::uint64_t end) {
      glm::dvec3 sum(0.0);
      for (std::uint64_t k = begin; k != end; ++k) sum += weighted_normal(around_[k], p);
      const double length = glm::length(sum);
      const bool usable = length > 0 && std::isfinite(length);
      const Vec3 unit = usable ? Vec3(sum / length) : Vec3(0.0F, 0.0F, 1.0F);
      desc_.normals.x[normal] = unit.x, desc_.normals.y[normal] = unit.y, desc_.normals.z[normal] = unit.z;
      // Faces that cancel each other out leave the corner without a normal: they are shown flat.
      const std::uint32_t index = usable ? static_cast<std::uint32_t>(normal) : no_index;
      for (std::uint64_t k = begin; k != end; ++k) set_normal(around_[k], p, index);
      ++normal;
    });
  }

  glm::dvec3 weighted_normal(std::size_t i, std::size_t p) const {
    const auto vertices = vertices_of(i);
    const std::size_t at = vertices[0] == p ? 0 : vertices[1] == p ? 1 : 2;
    const glm::dvec3 corner(desc_.positions[p]);
    const glm::dvec3 a = glm::dvec3(desc_.positions[vertices[(at + 1) % 3]]) - corner;
    const glm::dvec3 b = glm::dvec3(desc_.positions[vertices[(at + 2) % 3]]) - corner;
    const glm::dvec3 normal = glm::cross(a, b);
    const double length = glm::length(normal);
    if (!(length > 0)) return glm::dvec3(0.0);
    return normal * (std::atan2(length, glm::dot(a, b)) / length);
  }

  void set_normal(std::size_t i, std::size_t p, std::uint32_t normal) {
    if (rows_.v0[i] == p) rows_.n0[i] = normal;
    if (rows_.v1[i] == p) rows_.n1[i] = normal;
    if (rows_.v2[i] == p) rows_.n2[i] = normal;
  }

  SceneDesc& desc_;
  TriangleColumns& rows_;
  const Column<std::uint32_t>& groups_;
  int threads_;
  Column<std::uint64_t> first_;  // where the list of each position begins in around_
  Column<std::uint32_t> around_; // triangles
  Column<std::uint64_t> first_normal_;
};

} // namespace

void smooth_normals(SceneDesc& desc, const Column<std::uint32_t>& groups, int threads) {
  Smoothing(desc, groups, threads).run();
}

} // namespace fastrt
