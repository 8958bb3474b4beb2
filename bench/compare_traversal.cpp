// SPDX-License-Identifier: Apache-2.0
#include "bench/compare_traversal.hpp"

#include <algorithm>

namespace fastrt::bench {
namespace {

// Which rays are traced, and how often.
struct Task {
  const RaySet& set;
  RoundSettings settings;
  Share share;
};

// All that trace in turn, and where each is among them.
struct Field {
  std::vector<Contender> contenders;  // first fastrt's, one per ISA
  std::vector<std::size_t> peers;     // of each ISA: Embree's fastest packets of its width; 0 for none
  std::size_t embree = 0, robust = 0; // Embree's fastest modes; 0 for none
};

Spread scaled(Spread spread, double factor) {
  return {spread.median * factor, spread.smallest * factor, spread.largest * factor};
}

Spread ratio_of(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return spread_of(ratios);
}

// Tries the modes a few times, adds the fastest to the field and says which it is.
std::string add_fastest(const EmbreeScene& scene, const std::vector<EmbreeMode>& modes,
                        const std::string& prefix, const Task& task, Field& field, TraversalResult& result) {
  std::vector<Contender> candidates;
  for (const EmbreeMode& mode : modes) candidates.push_back(scene.contender(mode));
  RoundSettings settings = task.settings;
  settings.rounds = 3;
  const Share trial{task.share.step, (task.share.passes + 3) / 4};
  const std::vector<double> rates = medians(run_rounds(candidates, task.set, settings, trial));
  for (std::size_t i = 0; i < modes.size(); ++i)
    result.embree_modes.emplace_back(prefix + name_of(modes[i]), 1e-6 * rates[i]);
  const std::size_t best = fastest(rates);
  field.contenders.push_back(candidates[best]);
  return name_of(modes[best]);
}

Field make_field(const Course& course, const Task& task, TraversalResult& result) {
  Field field;
  for (const IsaCourse& part : course.isas)
    field.contenders.push_back(fastrt_contender(part.tracer, part.isa));
  field.peers.resize(course.isas.size());
  result.fastrt.resize(course.isas.size());
  if (course.fast == nullptr) return field;
  field.embree = field.contenders.size();
  result.best_mode = add_fastest(*course.fast, embree_modes(), "", task, field, result);
  field.robust = field.contenders.size();
  result.best_robust_mode = add_fastest(*course.robust, embree_modes(), "robust ", task, field, result);
  for (std::size_t i = 0; i < course.isas.size(); ++i) {
    const IsaCourse& part = course.isas[i];
    if (part.embree == nullptr) continue;
    field.peers[i] = field.contenders.size();
    result.fastrt[i].peer_mode = add_fastest(*part.embree, packet_modes(isa_width(part.isa)),
                                             std::string(isa_name(part.isa)) + ' ', task, field, result);
  }
  return field;
}

void fill_rows(const Course& course, const Field& field, const std::vector<std::vector<double>>& rates,
               TraversalResult& result) {
  const auto scalar = std::find_if(course.isas.begin(), course.isas.end(),
                                   [](const IsaCourse& part) { return part.isa == Isa::scalar; });
  for (std::size_t i = 0; i < course.isas.size(); ++i) {
    FastrtRow& row = result.fastrt[i];
    row.isa = field.contenders[i].name;
    row.mrays = scaled(spread_of(rates[i]), 1e-6);
    if (field.embree != 0) row.ratio = ratio_of(rates[i], rates[field.embree]);
    if (field.robust != 0) row.robust_ratio = ratio_of(rates[i], rates[field.robust]);
    if (field.peers[i] != 0) {
      row.peer = scaled(spread_of(rates[field.peers[i]]), 1e-6);
      row.peer_ratio = ratio_of(rates[i], rates[field.peers[i]]);
    }
    if (scalar != course.isas.end())
      row.scalar_ratio = ratio_of(rates[i], rates[static_cast<std::size_t>(scalar - course.isas.begin())]);
  }
  if (field.embree != 0) result.embree = scaled(spread_of(rates[field.embree]), 1e-6);
  if (field.robust != 0) result.embree_robust = scaled(spread_of(rates[field.robust]), 1e-6);
}

TraversalResult measure(const Course& course, const Task& task) {
  TraversalResult result;
  result.rays = task.set.name;
  result.threads = task.settings.threads;
  result.ray_count = task.set.ray_count;
  result.traced_share = 1.0 / static_cast<double>(task.share.step);
  const Field field = make_field(course, task, result);
  const std::vector<Contender>& all = field.contenders;
  if (field.embree != 0) result.with_embree = compare_answers(all[0], all[field.embree], task.set);
  if (field.robust != 0) result.with_robust = compare_answers(all[0], all[field.robust], task.set);
  fill_rows(course, field, run_rounds(all, task.set, task.settings, task.share), result);
  return result;
}

} // namespace

Course make_course(const SceneDesc& desc, const std::vector<Isa>& isas, int threads) {
  Course course;
  for (const Isa isa : isas) {
    TracerSettings settings;
    settings.isa = isa;
    course.isas.push_back({isa, Tracer(Scene(desc), settings), nullptr});
    if (isa == Isa::scalar) continue;
    course.isas.back().embree =
        build_embree_scene(course.isas.back().tracer.scene(), {.threads = threads, .isa = isa});
  }
  const Scene& scene = course.isas.front().tracer.scene();
  course.fast = build_embree_scene(scene, {.threads = threads, .isa = {}});
  course.robust = build_embree_scene(scene, {.robust = true, .threads = threads, .isa = {}});
  return course;
}

std::vector<TraversalResult> measure_traversal(const Course& course, const RaySet& set,
                                               const CompareOptions& options) {
  const Contender first = fastrt_contender(course.isas.front().tracer, course.isas.front().isa);
  const Share share = share_for(first, set, options.seconds);
  std::vector<TraversalResult> results;
  for (const int threads : options.threads)
    results.push_back(measure(course, {set, {threads, options.rounds, options.seconds}, share}));
  return results;
}

} // namespace fastrt::bench
