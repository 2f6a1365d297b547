// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/openings.h"

#include "density/hexagons.h"
#include "oceans/level_rings.h"
#include "oceans/parts.h"

#include <calotte/delaunay.h>

#include <algorithm>

namespace calotte::oceans_detail {

namespace {

/// The rings that bound a part of the sphere, closed.
std::vector<Points3> border_lines(const Surface& within) {
  std::vector<Points3> lines;
  for (const DoubleMatrix& ring : within.rings()) {
    Points3& line = lines.emplace_back(3, ring.cols() + 1);
    line.leftCols(ring.cols()) = ring;
    line.col(ring.cols()) = ring.col(0);
  }
  return lines;
}

std::vector<Points3> shores_and_border(const Coast& coast, const Surface& within) {
  std::vector<Points3> lines = shores(coast);
  for (Points3& line : border_lines(within))
    lines.push_back(std::move(line));
  return lines;
}

} // namespace

ShoreMesh::ShoreMesh(const Coast& from, const Widths& widths, const std::vector<Points3>& lines,
                     const Surface& within)
    : seas{CoastSides(coast_arcs(from)), within, std::nullopt},
      coast(shores_and_border(from, within), {}) {
  if (within.is_bounded())
    seas.border.emplace(border_lines(within), Surface());
  if (!lines.empty())
    passages.emplace(lines, Surface());
  at = shore_points(coast, seas, passages, widths);
  mesh = delaunay(at.points);
  neighbours = calotte::neighbours(mesh);
}

namespace {

/// The lines of rings, each closed.
std::vector<Points3> closed(const std::vector<std::vector<LevelPoint>>& rings,
                            const Points3& sites) {
  std::vector<Points3> lines;
  for (const std::vector<LevelPoint>& ring : rings) {
    Points3& line = lines.emplace_back(3, std::ssize(ring) + 1);
    for (std::size_t k = 0; k <= ring.size(); ++k)
      set_column(line, static_cast<Eigen::Index>(k), ring[k < ring.size() ? k : 0].position(sites));
  }
  return lines;
}

/// Distances of all sites, up to one and a half widths, from the rings where a function is 0,
/// negative where the function is. None without such rings.
std::vector<double> from_level(const ShoreMesh& shore, const std::vector<double>& values) {
  const std::vector<std::vector<LevelPoint>> rings = level_rings(shore.mesh, values);
  if (rings.empty())
    return {};
  std::vector<double> distances =
      near_distances_at(LineDistance(closed(rings, shore.at.points), {}), shore.at);
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k] < 0)
      distances[k] *= -1;
  return distances;
}

} // namespace

std::vector<double> from_core(const ShoreMesh& shore, const SiteTest& is_core) {
  std::vector<double> core(static_cast<std::size_t>(shore.size()));
  for (std::int64_t site = 0; site < shore.size(); ++site) {
    const double own = shore.core(site);
    core[static_cast<std::size_t>(site)] = own < 0 || is_core(site) ? own : -own;
  }
  std::vector<double> distances = from_level(shore, core);
  require(!distances.empty(), "no part of the sea is as wide as a cell; give smaller widths");
  return distances;
}

std::vector<double> sea_values(const ShoreMesh& shore, const std::vector<double>& inside,
                               const std::vector<double>& from_passage) {
  std::vector<double> values(inside.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double width = shore.at.widths[k];
    values[k] = std::max((0.5 - margin) * width + inside[k], 0.5 * width - from_passage[k]);
  }
  return values;
}

void remove_capes(const ShoreMesh& shore, std::vector<double>& values) {
  constexpr double reach = 0.5 + margin, slack = 0.05; // of widths
  std::vector<double> core = from_level(shore, values);
  for (std::size_t k = 0; k < core.size(); ++k)
    core[k] = -core[k] - reach * shore.at.widths[k];
  const std::vector<double> inside = from_level(shore, core);
  if (inside.empty())
    return;
  const auto is_land = [&](std::int64_t site) {
    return values[static_cast<std::size_t>(site)] < 0;
  };
  const auto is_far = [&](std::int64_t site) {
    return inside[static_cast<std::size_t>(site)] < -(reach + slack) * shore.width(site);
  };
  const Narrows narrows = find_narrows(
      shore.neighbours, [&](std::int32_t site) { return is_land(site) && is_far(site); },
      [&](std::int32_t site) { return is_land(site) && !is_far(site); });
  std::vector<char> stays(values.size());
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (const std::int32_t part = narrows.parts.of_cell[site];
        part >= 0 && narrows.sides[static_cast<std::size_t>(part)] != 1)
      stays[static_cast<std::size_t>(site)] = 1;
  for (int row = 0; row < 2; ++row) { // up to the land that stays
    const std::vector<char> before = stays;
    for (std::int64_t site = 0; site < shore.size(); ++site)
      for (const std::int32_t other : shore.neighbours[site])
        if (before[static_cast<std::size_t>(other)] != 0)
          stays[static_cast<std::size_t>(site)] = 1;
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double opened = -inside[k] - reach * shore.at.widths[k];
    values[k] = stays[k] != 0 ? std::min(opened, values[k]) : opened;
  }
}

void remove_pieces(const ShoreMesh& shore, const SiteTest& is_kept, double least_cells,
                   std::vector<double>& values) {
  const auto value = [&](std::int64_t site) -> double& {
    return values[static_cast<std::size_t>(site)];
  };
  const Parts sea =
      find_parts(shore.neighbours, [&](std::int32_t site) { return value(site) >= 0; });
  std::vector<bool> kept(sea.sizes.size());
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (sea.of_cell[site] >= 0 && is_kept(site))
      kept[static_cast<std::size_t>(sea.of_cell[site])] = true;
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (sea.of_cell[site] >= 0 && !kept[static_cast<std::size_t>(sea.of_cell[site])])
      value(site) = -std::max(value(site), margin * shore.width(site));
  const Parts land =
      find_parts(shore.neighbours, [&](std::int32_t site) { return value(site) < 0; });
  std::vector<double> cells(land.sizes.size());
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (land.of_cell[site] >= 0)
      cells[static_cast<std::size_t>(land.of_cell[site])] +=
          shore.area(site) / density_detail::hexagon_area(shore.width(site));
  for (std::int64_t site = 0; site < shore.size(); ++site)
    if (land.of_cell[site] >= 0 &&
        cells[static_cast<std::size_t>(land.of_cell[site])] < least_cells)
      value(site) *= -1;
}

} // namespace calotte::oceans_detail
