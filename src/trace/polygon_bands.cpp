// SPDX-License-Identifier: Apache-2.0
// Polygons with many edges in bands of equal height, so that a point is held against the edges around its own
// height alone.
#include "src/trace/tracer_parts.hpp"

#include <algorithm>
#include <utility>

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

// Into as many bands as the edges' lengths allow; none if that is fewer than two. Returns how many copies of
// edges the bands hold.
std::size_t choose_bands(const EdgeRow* edges, PolygonRow& polygon) {
  if (polygon.edge_count < least_edges) return 0;
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
    const std::size_t copies = count_copies(polygon, edges);
    if (copies <= most_copies * polygon.edge_count) return copies;
  }
  polygon.band_count = 0;
  return 0;
}

// The polygon's bands, which are empty yet, with edges from rows.edges[next] on. Returns where these end.
std::uint32_t fill_bands(const PolygonRow& polygon, std::uint32_t next, ShapeRows& rows) {
  const EdgeRow* const edges = rows.edges.data() + polygon.first_edge;
  BandRow* const bands = rows.bands.data() + polygon.first_band;
  const auto for_each_copy = [&](const auto& use) {
    for (const EdgeRow* edge = edges; edge != edges + polygon.edge_count; ++edge)
      for (std::uint32_t band = band_of(polygon, edge->low); band <= band_of(polygon, edge->high); ++band)
        use(bands[band], *edge);
  };
  for_each_copy([](BandRow& band, const EdgeRow&) { ++band.edge_count; });
  for (BandRow* band = bands; band != bands + polygon.band_count; ++band) {
    band->first_edge = next;
    next += std::exchange(band->edge_count, 0);
  }
  for_each_copy(
      [&](BandRow& band, const EdgeRow& edge) { rows.edges[band.first_edge + band.edge_count++] = edge; });
  return next;
}

} // namespace

void add_bands(ShapeRows& rows) {
  auto next = static_cast<std::uint32_t>(rows.edges.size());
  std::size_t copies = 0;
  std::uint32_t bands = 0;
  for (PolygonRow& polygon : rows.polygons) {
    copies += choose_bands(rows.edges.data() + polygon.first_edge, polygon);
    polygon.first_band = std::exchange(bands, bands + polygon.band_count);
  }
  rows.edges.resize(rows.edges.size() + copies);
  rows.bands.resize(bands, BandRow{0, 0});
  for (const PolygonRow& polygon : rows.polygons)
    if (polygon.band_count != 0) next = fill_bands(polygon, next, rows);
}

} // namespace fastrt
