// SPDX-License-Identifier: Apache-2.0
#include "bench/report.hpp"

#include <fastrt/error.hpp>

#include <fstream>
#include <sstream>

namespace fastrt::bench {
namespace {

constexpr double mega = 1e6;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string json(const Spread& s) {
  std::ostringstream out;
  out << "{\"median\": " << s.median << ", \"min\": " << s.smallest << ", \"max\": " << s.largest << '}';
  return out.str();
}

std::string json(const Disagreement& d) {
  std::ostringstream out;
  out << "{\"rays\": " << d.rays << ", \"hits\": " << d.hits << ", \"hit_or_miss\": " << d.hit_or_miss
      << ", \"primitive\": " << d.primitive << '}';
  return out.str();
}

std::string json(const FastrtRow& row) {
  return "{\"isa\": " + quoted(row.isa) + ", \"mrays\": " + json(row.mrays) +
         ", \"ratio\": " + json(row.ratio) + ", \"robust_ratio\": " + json(row.robust_ratio) +
         ", \"scalar_ratio\": " + json(row.scalar_ratio) + ", \"peer\": {\"mode\": " + quoted(row.peer_mode) +
         ", \"mrays\": " + json(row.peer) + ", \"ratio\": " + json(row.peer_ratio) + "}}";
}

template <class T, class ToText>
std::string list(const std::vector<T>& values, const char* separator, const ToText& to_text) {
  std::string out;
  for (const T& value : values) out += (out.empty() ? "" : separator) + to_text(value);
  return out;
}

std::string json(const TraversalResult& r) {
  std::ostringstream out;
  out << "{\"model\": " << quoted(r.model) << ", \"rays\": " << quoted(r.rays)
      << ", \"threads\": " << r.threads << ", \"ray_count\": " << r.ray_count
      << ", \"traced_share\": " << r.traced_share << ",\n   \"fastrt\": ["
      << list(r.fastrt, ",\n    ", [](const FastrtRow& row) { return json(row); })
      << "],\n   \"embree_modes\": {"
      << list(r.embree_modes, ", ",
              [](const auto& mode) { return quoted(mode.first) + ": " + std::to_string(mode.second); })
      << "},\n   \"embree_best\": {\"mode\": " << quoted(r.best_mode) << ", \"mrays\": " << json(r.embree)
      << "}, \"embree_robust_best\": {\"mode\": " << quoted(r.best_robust_mode)
      << ", \"mrays\": " << json(r.embree_robust)
      << "},\n   \"differences\": {\"embree\": " << json(r.with_embree)
      << ", \"embree_robust\": " << json(r.with_robust) << "}}";
  return out.str();
}

std::string json(const BuildResult& r) {
  std::ostringstream out;
  out << "{\"model\": " << quoted(r.model) << ", \"threads\": " << r.threads
      << ", \"primitives\": " << r.primitives << ", \"fastrt_seconds\": " << json(r.fastrt_seconds)
      << ", \"embree_seconds\": " << json(r.embree_seconds) << ", \"ratio\": " << json(r.ratio)
      << ", \"fastrt_bytes\": " << r.fastrt_bytes << ", \"fastrt_peak_bytes\": " << r.fastrt_peak_bytes
      << ", \"embree_bytes\": " << r.embree_bytes << ", \"embree_peak_bytes\": " << r.embree_peak_bytes
      << '}';
  return out.str();
}

std::string ratio_text(const Spread& ratio) {
  if (ratio.median == 0) return "-";
  char text[48];
  std::snprintf(text, sizeof text, "%.2f (%.2f-%.2f)", ratio.median, ratio.smallest, ratio.largest);
  return text;
}

} // namespace

void print_build_heading() {
  std::printf("%-20s %7s %10s | %8s %7s %7s | %8s %7s %7s | %s\n", "build", "threads", "primitives",
              "fastrt s", "MB", "peak MB", "embree s", "MB", "peak MB", "embree s / fastrt s");
}

void print(const BuildResult& r) {
  const auto megabytes = [](std::size_t bytes) { return static_cast<double>(bytes) / mega; };
  std::printf("%-20s %7d %10zu | %8.3f %7.1f %7.1f | %8.3f %7.1f %7.1f | %s\n", r.model.c_str(), r.threads,
              r.primitives, r.fastrt_seconds.median, megabytes(r.fastrt_bytes),
              megabytes(r.fastrt_peak_bytes), r.embree_seconds.median, megabytes(r.embree_bytes),
              megabytes(r.embree_peak_bytes), ratio_text(r.ratio).c_str());
  std::fflush(stdout);
}

void print(const TraversalResult& r) {
  std::printf("\n%s, %s rays, %d thread%s: %zu rays", r.model.c_str(), r.rays.c_str(), r.threads,
              r.threads == 1 ? "" : "s", r.ray_count);
  if (const Disagreement& d = r.with_embree; d.rays != 0)
    std::printf(", %.1f %% hit", 100.0 * static_cast<double>(d.hits) / static_cast<double>(d.rays));
  std::printf("\n");
  std::printf("  %-22s %9s   %-19s %-19s %-19s %s\n", "", "Mrays/s", "/ Embree", "/ Embree robust",
              "/ Embree's ISA", "/ scalar");
  for (const FastrtRow& row : r.fastrt)
    std::printf("  %-22s %9.2f   %-19s %-19s %-19s %s\n", ("fastrt " + row.isa).c_str(), row.mrays.median,
                ratio_text(row.ratio).c_str(), ratio_text(row.robust_ratio).c_str(),
                ratio_text(row.peer_ratio).c_str(), ratio_text(row.scalar_ratio).c_str());
  if (r.best_mode.empty()) return;
  std::printf("  %-22s %9.2f\n", ("embree " + r.best_mode).c_str(), r.embree.median);
  std::printf("  %-22s %9.2f\n", ("robust " + r.best_robust_mode).c_str(), r.embree_robust.median);
  std::printf("  modes: %s\n", list(r.embree_modes, ", ", [](const auto& mode) {
                                 char text[64];
                                 std::snprintf(text, sizeof text, "%s %.1f", mode.first.c_str(), mode.second);
                                 return std::string(text);
                               }).c_str());
  std::printf("  other answers: %zu hit or miss, %zu primitive (robust: %zu, %zu)\n",
              r.with_embree.hit_or_miss, r.with_embree.primitive, r.with_robust.hit_or_miss,
              r.with_robust.primitive);
  std::fflush(stdout);
}

void write_json(const Report& report, const std::string& path) {
  std::ofstream file(path);
  file << "{\"fastrt\": " << quoted(report.fastrt) << ", \"cpu\": " << quoted(report.cpu)
       << ", \"embree\": " << quoted(report.embree) << ",\n \"builds\": [\n  "
       << list(report.builds, ",\n  ", [](const BuildResult& r) { return json(r); })
       << "],\n \"traversals\": [\n  "
       << list(report.traversals, ",\n  ", [](const TraversalResult& r) { return json(r); }) << "]}\n";
  file.close();
  if (!file) throw OutputError("cannot write " + path);
}

} // namespace fastrt::bench
