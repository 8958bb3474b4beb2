// SPDX-License-Identifier: Apache-2.0
// Polygons with many edges in bands of equal height, so that a point is held against the edges around its own
// height alone.
#include "src/trace/tracer_parts.hpp"

#include <algorithm>

namespace fastrt {
namespace {

constexpr std::uint32_t least_edges = 12; // fewer are looked at one by one
constexpr std::uint32_t most_bands = 256;
constexpr std::size_t most_copies = 4; // of an edge, on the average

// The same operations as in the kernels, each of which rises with y: an edge that holds y is in y's band.
std::uint32_t band_of(const PolygonRow& polygon, float y) {
  const float band = (y - polygon.band_low) * polygon.band_scale;
  return static_cast<std::uint32_t>(
      std::max(std::min(band, static_cast<float>(polygon.band_count - 1)), 0.0F));
}

std::size_t count_copies(const PolygonRow& polygon, const EdgeRow* edges) {
  std::size_t copies = 0;
  for (const EdgeRow* edge = edges; edge != edges + polygon.edge_count; ++edge)
    copies += band_of(polygon, edge->high) - band_of(polygon, edge->low) + 1;
  return copies;
}

// Into as many bands as the edges' lengths allow; none if that is fewer than two.
void choose_bands(const EdgeRow* edges, PolygonRow& polygon) {
  float low = edges->low, high = edges->high;
  for (const EdgeRow* edge = edges; edge != edges + polygon.edge_count; ++edge) {
    low = std::min(low, edge->low);
    high = std::max(high, edge->high);
  }
  polygon.band_low = low;
  for (std::uint32_t count = std::min(polygon.edge_count / 2, most_bands); count > 1; count /= 2) {
    polygon.band_count = count;
    polygon.band_scale = static_cast<float>(count) / (high - low);
    if (!(polygon.band_scale > 0.0F && polygon.band_scale < infinity)) break;
    if (count_copies(polygon, edges) <= most_copies * polygon.edge_count) return;
  }
  polygon.band_count = 0;
}

void fill_bands(const PolygonRow& polygon, ShapeRows& rows) {
  const std::size_t first_edge = rows.edges.size();
  const std::size_t copies = count_copies(polygon, rows.edges.data() + polygon.first_edge);
  rows.edges.resize(first_edge + copies);
  const EdgeRow* const edges = rows.edges.data() + polygon.first_edge;
  auto next = static_cast<std::uint32_t>(first_edge);
  for (std::uint32_t band = 0; band < polygon.band_count; ++band) {
    const std::uint32_t begin = next;
    for (std::uint32_t i = 0; i < polygon.edge_count; ++i)
      if (band_of(polygon, edges[i].low) <= band && band <= band_of(polygon, edges[i].high))
        rows.edges[next++] = edges[i];
    rows.bands.push_back({begin, next - begin});
  }
}

} // namespace

void add_bands(ShapeRows& rows) {
  for (PolygonRow& polygon : rows.polygons) {
    if (polygon.edge_count < least_edges) continue;
    choose_bands(rows.edges.data() + polygon.first_edge, polygon);
    if (polygon.band_count == 0) continue;
    polygon.first_band = static_cast<std::uint32_t>(rows.bands.size());
    fill_bands(polygon, rows);
  }
}

} // namespace fastrt
