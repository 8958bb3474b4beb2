// SPDX-License-Identifier: Apache-2.0
#include "src/film/sampling.hpp"
#include "src/kernels/kernel_table.hpp"

#include <fastrt/column.hpp>

#include <benchmark/benchmark.h>

#include <array>
#include <functional>
#include <memory>

#include "bench/benchmarks.hpp"
#include "bench/tracers.hpp"

namespace fastrt::bench {
namespace {

constexpr std::size_t pair_count = 1024; // with all columns in the second cache level at most

// Pairs of a primitive near the origin and a ray towards it. Rays meet 19 % of the triangles, 65 % of the
// spheres and 70 % of the boxes.
struct Pairs {
  std::array<Column<float>, 9> primitive;
  std::array<Column<float>, 3> origin, dir;
  Column<float> t_min = Column<float>(pair_count, 0.0F); // braces would list two values
  std::array<Column<float>, 4> out{Column<float>(pair_count), Column<float>(pair_count),
                                   Column<float>(pair_count), Column<float>(pair_count)};
  std::vector<std::uint8_t> hit = std::vector<std::uint8_t>(pair_count);
  PairColumns columns{};
};

float random_unit(std::uint32_t& state) {
  state = hash32(state + 0x9E3779B9U);
  return static_cast<float>(state >> 8U) * 0x1p-23F - 1.0F; // -1..1
}

void finish(Pairs& pairs, std::uint32_t state) {
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < pair_count; ++i) {
      pairs.origin[c].push_back(random_unit(state) + (c == 2 ? 5.0F : 0.0F));
      pairs.dir[c].push_back(random_unit(state) * 0.6F - pairs.origin[c][i]);
    }
  for (std::size_t c = 0; c < 9; ++c) pairs.columns.primitive[c] = pairs.primitive[c].data();
  for (std::size_t c = 0; c < 3; ++c) {
    pairs.columns.origin[c] = pairs.origin[c].data();
    pairs.columns.dir[c] = pairs.dir[c].data();
  }
  pairs.columns.t_min = pairs.t_min.data();
  pairs.columns.count = pair_count;
}

std::shared_ptr<Pairs> triangle_pairs() {
  auto pairs = std::make_shared<Pairs>();
  std::uint32_t state = 1;
  for (Column<float>& column : pairs->primitive)
    for (std::size_t i = 0; i < pair_count; ++i) column.push_back(1.5F * random_unit(state));
  finish(*pairs, state);
  return pairs;
}

std::shared_ptr<Pairs> sphere_pairs() {
  auto pairs = std::make_shared<Pairs>();
  std::uint32_t state = 2;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < pair_count; ++i)
      pairs->primitive[c].push_back(c == 3 ? 0.7F + 0.2F * random_unit(state) : 0.5F * random_unit(state));
  finish(*pairs, state);
  return pairs;
}

std::shared_ptr<Pairs> box_pairs() {
  auto pairs = std::make_shared<Pairs>();
  std::uint32_t state = 3;
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t i = 0; i < pair_count; ++i)
      pairs->primitive[c].push_back((c < 3 ? -0.5F : 0.5F) + 0.3F * random_unit(state));
  finish(*pairs, state);
  return pairs;
}

// Runs `step` over all pairs until the time is up.
void add(const std::string& name, const std::function<void()>& step) {
  benchmark::RegisterBenchmark(name.c_str(), [step](benchmark::State& state) {
    for (auto _ : state) {
      step();
      benchmark::ClobberMemory();
    }
    constexpr auto count = static_cast<double>(pair_count);
    using benchmark::Counter;
    state.counters["rays/s"] = Counter(count, Counter::kIsIterationInvariantRate);
    state.counters["s/pair"] = Counter(count, Counter::kIsIterationInvariantRate | Counter::kInvert);
  });
}

void register_isa(const std::string& isa, const KernelTable& table) {
  const auto triangles = triangle_pairs(), spheres = sphere_pairs(), boxes = box_pairs();
  add("slab/" + isa, [&table, boxes] { table.meet_boxes(boxes->columns, boxes->hit.data()); });
  add("triangle/" + isa, [&table, p = triangles] {
    table.meet_triangles(p->columns, p->hit.data(), p->out[0].data(), nullptr, nullptr);
  });
  add("triangle with weights/" + isa, [&table, p = triangles] {
    table.meet_triangles(p->columns, p->hit.data(), p->out[0].data(), p->out[1].data(), p->out[2].data());
  });
  add("sphere/" + isa,
      [&table, p = spheres] { table.meet_spheres(p->columns, p->hit.data(), p->out[0].data()); });
  add("pow/" + isa, [&table, p = spheres] {
    table.powers(p->primitive[3].data(), p->origin[2].data(), p->out[0].data(), pair_count);
  });
  add("exp/" + isa,
      [&table, p = spheres] { table.exponentials(p->primitive[0].data(), p->out[0].data(), pair_count); });
}

} // namespace

void register_kernels() {
  for (const Isa isa : available_isas())
    if (isa != Isa::scalar) register_isa(isa_name(isa), kernel_table_of(isa));
}

} // namespace fastrt::bench
