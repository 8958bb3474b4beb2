// SPDX-License-Identifier: Apache-2.0
#include "src/film/filter_table.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace fastrt {
namespace {

using Table = std::array<float, filter_steps + 2>;

// Where the first lobe of Mitchell & Netravali's filter begins and where it ends.
constexpr double lobe_begin = 8.0 / 7.0, lobe_end = 2.0;
constexpr double gaussian_radius = 1.5, gaussian_deviation = 0.5;

double gaussian(double x) { return std::exp(-0.5 * x * x / (gaussian_deviation * gaussian_deviation)); }

// B = C = 1/3 (Mitchell & Netravali 1988).
double mitchell(double x) {
  if (x < 1) return ((7 * x - 12) * x * x + 16.0 / 3.0) / 6;
  return (((-7.0 / 3.0 * x + 12) * x - 20) * x + 32.0 / 3.0) / 6;
}

// The areas under |f| from `begin` to the ends of many equal steps up to `end`.
template <class Function>
std::vector<double> areas_of(Function f, double begin, double end) {
  constexpr int steps = 1 << 15;
  const double width = (end - begin) / steps;
  std::vector<double> areas{0.0};
  for (int i = 0; i < steps; ++i)
    areas.push_back(areas.back() + width * std::fabs(f(begin + (i + 0.5) * width)));
  return areas;
}

// Where f's area from `begin` on reaches 0, 1 / filter_steps, .. 1 of the area up to `end`; the last twice.
template <class Function>
Table inverse_of(Function f, double begin, double end) {
  const std::vector<double> areas = areas_of(f, begin, end);
  Table table{};
  std::size_t at = 0;
  for (int i = 0; i <= filter_steps; ++i) {
    const double area = areas.back() * i / filter_steps;
    while (at + 2 < areas.size() && areas[at + 1] < area) ++at;
    const double step = areas[at + 1] - areas[at];
    const double place = static_cast<double>(at) + (step > 0 ? (area - areas[at]) / step : 0.0);
    table[static_cast<std::size_t>(i)] =
        static_cast<float>(begin + (end - begin) * place / static_cast<double>(areas.size() - 1));
  }
  table.back() = table[filter_steps];
  return table;
}

Filter gaussian_filter() {
  static const Table table = inverse_of(gaussian, 0.0, gaussian_radius);
  return {FilterShape::table, 0.0F, table.data(), nullptr};
}

Filter mitchell_filter() {
  static const Table core = inverse_of(mitchell, 0.0, lobe_begin);
  static const Table lobes = inverse_of(mitchell, lobe_begin, lobe_end);
  // The corners, where two lobes make a positive weight of 0.1 %, are left out.
  static const double core_area = areas_of(mitchell, 0.0, lobe_begin).back();
  static const double lobe_area = areas_of(mitchell, lobe_begin, lobe_end).back();
  const double negative = 2 * lobe_area / (core_area - 2 * lobe_area);
  return {FilterShape::table, static_cast<float>(negative), core.data(), lobes.data()};
}

} // namespace

Filter filter_of(PixelFilter filter) {
  switch (filter) {
  case PixelFilter::box:
    return {FilterShape::box, 0.0F, nullptr, nullptr};
  case PixelFilter::tent:
    return {FilterShape::tent, 0.0F, nullptr, nullptr};
  case PixelFilter::gaussian:
    return gaussian_filter();
  case PixelFilter::mitchell:
    break;
  }
  return mitchell_filter();
}

} // namespace fastrt
