// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace fastrt::bench {
namespace {

// What reading the clock itself adds between two readings.
double clock_cost() {
  static const double cost = [] {
    std::vector<double> values(1001);
    for (double& value : values) {
      const double start = thread_seconds();
      value = thread_seconds() - start;
    }
    return spread_of(values).median;
  }();
  return cost;
}

std::size_t chunk_count(const RaySet& set) {
  return (set.batches.size() + chunk_batches - 1) / chunk_batches;
}

std::size_t batches_in_chunk(const RaySet& set, std::size_t chunk) {
  return std::min(chunk_batches, set.batches.size() - chunk * chunk_batches);
}

std::size_t rays_in_chunk(const RaySet& set, std::size_t chunk) {
  std::size_t rays = 0;
  for (std::size_t i = 0; i < batches_in_chunk(set, chunk); ++i)
    rays += static_cast<std::size_t>(rays_in(set.batches[chunk * chunk_batches + i]));
  return rays;
}

// One of `step` chunks, spread over the whole set by the golden ratio: chunks at equal distances could all
// lie at the same side of the picture.
std::vector<std::size_t> traced_chunks(const RaySet& set, std::size_t step) {
  const std::size_t count = chunk_count(set);
  auto stride = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(count)) + 1;
  while (std::gcd(stride, count) != 1) ++stride; // so that no chunk comes twice
  std::vector<std::size_t> chunks((count + step - 1) / step);
  for (std::size_t i = 0; i < chunks.size(); ++i) chunks[i] = i * stride % count;
  std::sort(chunks.begin(), chunks.end());
  return chunks;
}

} // namespace

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 != 0 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {median, values.front(), values.back()};
}

double rays_per_second(const Contender& contender, const RaySet& set, int threads, const Share& share) {
  const std::vector<std::size_t> chunks = traced_chunks(set, share.step);
  const std::size_t turns = chunks.size() * share.passes * static_cast<std::size_t>(threads);
  const double cost = clock_cost();
  double rate = 0;
#pragma omp parallel num_threads(threads) reduction(+ : rate)
  {
    const std::unique_ptr<Worker> worker = contender.make_worker(set.question);
    double busy = 0;
    std::size_t rays = 0;
#pragma omp for schedule(dynamic)
    for (std::size_t turn = 0; turn < turns; ++turn) {
      const std::size_t chunk = chunks[turn % chunks.size()];
      worker->load(&set.batches[chunk * chunk_batches], batches_in_chunk(set, chunk));
      const double start = thread_seconds();
      worker->trace();
      busy += thread_seconds() - start - cost;
      rays += rays_in_chunk(set, chunk);
    }
    if (busy > 0) rate += static_cast<double>(rays) / busy;
  }
  return rate;
}

Share share_for(const Contender& contender, const RaySet& set, double seconds) {
  const std::size_t chunks = chunk_count(set);
  const std::size_t coarse = std::max<std::size_t>(1, chunks / 16);
  const double rate = rays_per_second(contender, set, 1, {.step = coarse});
  // How many times too long the whole set takes.
  const double excess = static_cast<double>(set.ray_count) / (rate * seconds);
  return {.step = std::clamp<std::size_t>(static_cast<std::size_t>(excess), 1, coarse),
          .passes = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(1.0 / excess)))};
}

std::vector<std::vector<double>> run_rounds(std::span<const Contender> contenders, const RaySet& set,
                                            const RoundSettings& settings, const Share& share) {
  std::vector<std::vector<double>> rates(contenders.size());
  for (int round = 0; round < settings.rounds; ++round)
    for (std::size_t i = 0; i < contenders.size(); ++i)
      rates[i].push_back(rays_per_second(contenders[i], set, settings.threads, share));
  return rates;
}

std::vector<double> medians(const std::vector<std::vector<double>>& rates) {
  std::vector<double> result;
  for (const std::vector<double>& rounds : rates) result.push_back(spread_of(rounds).median);
  return result;
}

std::size_t fastest(const std::vector<double>& rates) {
  return static_cast<std::size_t>(std::max_element(rates.begin(), rates.end()) - rates.begin());
}

Disagreement compare_answers(const Contender& a, const Contender& b, const RaySet& set) {
  Disagreement result;
  const auto worker_a = a.make_worker(set.question), worker_b = b.make_worker(set.question);
  std::vector<std::int32_t> answers_a, answers_b;
  for (std::size_t chunk = 0; chunk < chunk_count(set); ++chunk) {
    for (Worker* worker : {worker_a.get(), worker_b.get()}) {
      worker->load(&set.batches[chunk * chunk_batches], batches_in_chunk(set, chunk));
      worker->trace();
    }
    worker_a->answers(answers_a);
    worker_b->answers(answers_b);
    for (std::size_t i = 0; i < answers_a.size(); ++i) {
      const bool hit_a = answers_a[i] >= 0, hit_b = answers_b[i] >= 0;
      result.hits += hit_a;
      result.hit_or_miss += hit_a != hit_b;
      result.primitive += hit_a && hit_b && answers_a[i] != answers_b[i];
    }
    result.rays += answers_a.size();
  }
  return result;
}

} // namespace fastrt::bench
