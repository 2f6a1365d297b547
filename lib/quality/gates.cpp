// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/gates.h>

#include "base/require.h"
#include "quality/parts.h"
#include "quality/room.h"
#include "voronoi/spacing_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace calotte {
namespace quality_detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The worst of some values, the first of equal ones, and how many are beyond a limit.
struct Worst {
  double value = -infinity; ///< as large as it is bad
  std::int32_t cell = -1;
  std::int64_t beyond = 0;

  void add(double bad, double limit, std::int32_t at) {
    beyond += bad > limit;
    if (bad > value)
      value = bad, cell = at;
  }
  void join(const Worst& other) {
    beyond += other.beyond;
    if (other.value > value)
      value = other.value, cell = other.cell;
  }
};

using Value = std::pair<double, std::int32_t>;
using Limit = std::optional<double>;

/// A demand that is 0 is none.
Limit limit_of(double demand) { return demand > 0 ? Limit(demand) : std::nullopt; }

/// The demand of the name on values of n cells or edges.
/// \param value_of(i) gives a Value: the number, NaN where there is none, and its cell.
template <class ValueOf>
Gate gate(const char* name, Limit limit, bool at_least, std::int64_t n, const ValueOf& value_of) {
  const double sign = at_least ? -1 : 1, most = limit ? sign * *limit : infinity;
  const Worst worst = join_blocks<Worst>(n, [&](Worst& part, std::int64_t i) {
    const auto [value, cell] = value_of(i);
    if (!std::isnan(value))
      part.add(sign * value, most, cell);
  });
  return {name, worst.cell < 0 ? 0 : sign * worst.value, limit, at_least, worst.beyond, worst.cell};
}

/// The number of cells that are one of the two cells of an edge, or a neighbour of these.
double advecting_cells(const Voronoi& voronoi, std::int64_t e) {
  std::vector<std::int32_t> cells;
  for (int k = 0; k < 2; ++k) {
    const std::int32_t cell = voronoi.cells_on_edge(k, e);
    cells.push_back(cell);
    if (cell < 0)
      continue;
    const auto others = voronoi.cells_on_cell[cell];
    cells.insert(cells.end(), others.begin(), others.end());
  }
  std::sort(cells.begin(), cells.end());
  const auto first = std::upper_bound(cells.begin(), cells.end(), -1);
  return static_cast<double>(std::unique(first, cells.end()) - first);
}

/// By how much the cell's mask is out of order: 1 if a neighbour's differs by more than 1, if a
/// ring has no cell of the ring before it beside it, and if a cell lacks a neighbour that is not of
/// the outermost ring.
double ring_fault(const Voronoi& voronoi, const Ids& mask, std::int64_t i, std::int32_t outermost) {
  bool touches = mask[i] == 0;
  for (const std::int32_t j : voronoi.cells_on_cell[i]) {
    if (j < 0 ? mask[i] < outermost : std::abs(mask[i] - mask[j]) > 1)
      return 1;
    touches = touches || (j >= 0 && mask[j] < mask[i]);
  }
  return touches ? 0 : 1;
}

/// Whether a cell lacks a neighbour. Of a cell that a coast clips, sides tell no dislocation.
bool is_at_boundary(const Voronoi& voronoi, std::int64_t i) {
  return std::ranges::any_of(voronoi.cells_on_cell[i], [](std::int32_t id) { return id < 0; });
}

/// The greatest eigenvalue of the negative Laplacian at cells is at most the greatest sum over the
/// sides of a cell of twice dv / dc, over its area (Gershgorin 1931).
double eigenvalue_bound(const Voronoi& voronoi, std::int64_t i) {
  double sum = 0;
  for (const std::int32_t e : voronoi.edges_on_cell[i])
    if (voronoi.cells_on_edge(1, e) >= 0)
      sum += voronoi.dv[e] / voronoi.dc[e];
  return voronoi.cell_area[i] > 0 ? 2 * sum / voronoi.cell_area[i] : 0;
}

} // namespace
} // namespace quality_detail

std::vector<Gate> gates(const Voronoi& voronoi, const GridDemands& demands, double radius,
                        const Ids& mask) {
  using namespace quality_detail;
  require(voronoi.surface.is_sphere(), "a model's demands are on grids of the sphere");
  require(radius > 0 && std::isfinite(radius), "the radius {} is not positive and finite", radius);
  const std::int64_t cells = voronoi.cells.cols(), edges = voronoi.dc.size();
  require(mask.size() == 0 || mask.size() == cells, "{} masks for {} cells", mask.size(), cells);
  const auto on_edges = [&](const char* name, Limit limit, bool at_least, const auto& value) {
    return gate(name, limit, at_least, edges, [&](std::int64_t e) {
      return Value(voronoi.cells_on_edge(1, e) < 0 ? no_value : value(e),
                   voronoi.cells_on_edge(0, e));
    });
  };
  const auto on_cells = [&](const char* name, Limit limit, bool at_least, const auto& value) {
    return gate(name, limit, at_least, cells,
                [&](std::int64_t i) { return Value(value(i), static_cast<std::int32_t>(i)); });
  };
  const auto sides = [&](std::int64_t i) {
    return static_cast<double>(voronoi.edges_on_cell.count(i));
  };
  const auto dc = [&](std::int64_t e) { return radius * voronoi.dc[e]; };
  constexpr int passes = 4; // so that a change keeps nine tenths and more of what is demanded
  const DoubleVector widths = voronoi_detail::smoothed_log_spacings(voronoi, passes);

  std::vector<Gate> found;
  found.push_back(
      on_cells("sides of a cell, least", limit_of(static_cast<double>(demands.least_sides)), true,
               [&](std::int64_t i) { return is_at_boundary(voronoi, i) ? no_value : sides(i); }));
  found.push_back(on_cells("sides of a cell, most", {}, false, sides));
  found.push_back(on_edges("dv / dc, least", limit_of(demands.least_dv_over_dc), true,
                           [&](std::int64_t e) { return voronoi.dv[e] / voronoi.dc[e]; }));
  found.push_back(on_edges("change of width, most", limit_of(demands.largest_change), false,
                           [&](std::int64_t e) {
                             return std::expm1(std::abs(widths[voronoi.cells_on_edge(0, e)] -
                                                        widths[voronoi.cells_on_edge(1, e)]));
                           }));
  if (demands.most_advecting_cells > 0)
    found.push_back(on_edges("cells that advect, most",
                             static_cast<double>(demands.most_advecting_cells), false,
                             [&](std::int64_t e) { return advecting_cells(voronoi, e); }));
  if (demands.least_dv_in_float32 > 0) {
    const double unit =
        std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::max()) -
        static_cast<float>(radius);
    found.push_back(on_edges("dv / unit of float32, least", demands.least_dv_in_float32, true,
                             [&](std::int64_t e) { return radius * voronoi.dv[e] / unit; }));
  }
  if (mask.size() > 0) {
    const std::int32_t outermost = mask.maxCoeff();
    found.push_back(on_cells("rings out of order", 0, false, [&](std::int64_t i) {
      return ring_fault(voronoi, mask, i, outermost);
    }));
  }
  if (demands.wind > 0)
    found.push_back(on_edges("longest step, s, of flow", {}, true,
                             [&](std::int64_t e) { return longest_step(demands, dc(e)); }));
  if (demands.waves > 0)
    found.push_back(on_cells("longest step, s, of waves", {}, true, [&](std::int64_t i) {
      return radius * std::sqrt(8 / eigenvalue_bound(voronoi, i)) / demands.waves;
    }));
  return found;
}

} // namespace calotte
