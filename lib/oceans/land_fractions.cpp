// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/spherical_triangle.h"
#include "curve/hilbert.h"
#include "oceans/room.h"
#include "voronoi/cell_walk.h"
#include "voronoi/connectivity.h"
#include "voronoi/groups.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <vector>

// The land in a cell is bounded by parts of the coast and parts of the cell's edges. Its area is
// the sum of the signed triangles from the generator to these parts. A triangle of an edge counts
// as often as polygons of land cover the edge there; that number changes by one at each crossing of
// the coast.

namespace calotte {
namespace oceans_detail {
namespace {

using base_detail::for_each_task, base_detail::triangle_area;
using curve_detail::curve_key, curve_detail::to_cube;
using voronoi_detail::CellWalk, voronoi_detail::sort_in_groups, voronoi_detail::start_of;

constexpr double whole_sphere = 4 * std::numbers::pi;

// ---- Arcs

/// The direction rotated by 1e-12 radians around an axis that is no axis of any lattice.
Vec3 turned(const Vec3& x) {
  const Vec3 way = cross(Vec3{4.1e-13, -7.3e-13, 5.5e-13}, x);
  return normalised(x + way);
}

/// The arcs of all rings; rings near each other are consecutive. `starts` is true for the first arc
/// of a ring.
struct Arcs {
  std::vector<Arc> arcs;
  std::vector<bool> starts;
};

Arcs make_arcs(const Coast& coast) {
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t r = 0; r < coast.rings.size(); ++r)
    if (coast.rings[r].cols() > 2)
      order.emplace_back(curve_key(to_cube(column(coast.rings[r], 0))), r);
  std::sort(order.begin(), order.end());
  Arcs all;
  for (const auto& [key, r] : order) {
    const Points3& ring = coast.rings[r];
    const std::size_t first = all.arcs.size();
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const Vec3 from = turned(column(ring, i)),
                 to = turned(column(ring, i + 1 < ring.cols() ? i + 1 : 0));
      if (from.x == to.x && from.y == to.y && from.z == to.z)
        continue;
      all.starts.push_back(all.arcs.size() == first);
      all.arcs.push_back({from, to});
    }
  }
  return all;
}

// ---- Crossings of edges by arcs, and pieces of arcs in cells

/// A point where the coast crosses an edge, which runs from its lower to its higher vertex.
struct Crossing {
  std::int32_t edge;
  std::int32_t change; ///< of the number of areas of land, along the edge
  double along;        ///< increases along the edge
  Vec3 point;
};

/// The area of the triangles of a generator with arcs of the coast.
struct Piece {
  std::int32_t cell;
  double area;
};

struct Traces {
  std::vector<Crossing> crossings;
  std::vector<Piece> pieces;
};

class Tracer {
public:
  Tracer(const Voronoi& cells, Traces& out) : cells_(cells), walk_(cells), out_(out) {}

  void begin(const Vec3& point) { cell_ = walk_.locate(cell_, point); }

  void trace(const Arc& arc) {
    Vec3 from = arc.from;
    cell_ = walk_.walk(cell_, arc, [&](std::int32_t cell, std::size_t k) {
      const Vec3 point = cross_edge(cell, k, arc);
      add_piece(cell, from, point);
      from = point;
    });
    add_piece(cell_, from, arc.to);
  }

private:
  void add_piece(std::int32_t cell, const Vec3& from, const Vec3& to) {
    if (out_.pieces.empty() || out_.pieces.back().cell != cell)
      out_.pieces.push_back({cell, 0});
    out_.pieces.back().area += triangle_area(column(cells_.cells, cell), from, to);
  }

  /// Records the crossing where the arc leaves the cell: the edge, counter-clockwise, passes to the
  /// arc's left. Returns the point.
  Vec3 cross_edge(std::int32_t cell, std::size_t k, const Arc& arc) {
    const std::int32_t a = start_of(cells_, cell, k), b = cells_.vertices_on_cell[cell][k];
    const Vec3 &low = column(cells_.vertices, std::min(a, b)),
               &high = column(cells_.vertices, std::max(a, b));
    const Vec3 normal = cross(low, high - low);
    const double before = dot(normal, arc.from), after = dot(normal, arc.to);
    const double ratio = before / (before - after);
    const double part = ratio >= 0 && ratio <= 1 ? ratio : ratio > 1 ? 1 : 0;
    const Vec3 point = normalised(arc.from + part * (arc.to - arc.from));
    out_.crossings.push_back(
        {cells_.edges_on_cell[cell][k], a < b ? 1 : -1, dot(point - low, high - low), point});
    return point;
  }

  const Voronoi& cells_;
  const CellWalk walk_;
  Traces& out_;
  std::int32_t cell_ = 0;
};

Traces trace_coast(const Voronoi& cells, const Arcs& arcs) {
  constexpr std::int64_t at_once = 4096;
  const auto count = std::ssize(arcs.arcs);
  std::vector<Traces> parts(static_cast<std::size_t>((count + at_once - 1) / at_once));
  for_each_task(std::ssize(parts), [&](std::int64_t part) {
    Tracer tracer(cells, parts[static_cast<std::size_t>(part)]);
    const std::int64_t first = part * at_once, last = std::min(count, first + at_once);
    for (std::int64_t i = first; i < last; ++i) {
      const Arc& arc = arcs.arcs[static_cast<std::size_t>(i)];
      if (i == first || arcs.starts[static_cast<std::size_t>(i)])
        tracer.begin(arc.from);
      tracer.trace(arc);
    }
  });
  Traces all;
  for (const Traces& part : parts) {
    all.crossings.insert(all.crossings.end(), part.crossings.begin(), part.crossings.end());
    all.pieces.insert(all.pieces.end(), part.pieces.begin(), part.pieces.end());
  }
  return all;
}

// ---- Numbers of polygons of land

/// The crossings of each edge, along it.
using EdgeCrossings = Lists<std::vector<Crossing>, std::vector<std::int64_t>>;

EdgeCrossings by_edge(std::vector<Crossing> crossings, std::int64_t edges) {
  EdgeCrossings out;
  out.items = std::move(crossings);
  out.begin = sort_in_groups(
      edges, [](const Crossing& c) { return c.edge; },
      [](const Crossing& a, const Crossing& b) {
        return std::tie(a.along, a.change, a.point.x, a.point.y, a.point.z) <
               std::tie(b.along, b.change, b.point.x, b.point.y, b.point.z);
      },
      out.items);
  return out;
}

/// The change of the number of polygons of land along a whole edge.
std::int32_t change_along(std::span<const Crossing> edge) {
  std::int32_t sum = 0;
  for (const Crossing& crossing : edge)
    sum += crossing.change;
  return sum;
}

constexpr std::int32_t unknown = INT32_MIN;

/// By vertex, the number of polygons of land that cover it, minus that at one vertex.
std::vector<std::int32_t> counts_at_vertices(const Voronoi& cells, const EdgeCrossings& crossings) {
  std::vector<std::int32_t> counts(static_cast<std::size_t>(cells.vertices.cols()), unknown);
  const auto at = [&](std::int32_t v) -> std::int32_t& {
    return counts[static_cast<std::size_t>(v)];
  };
  std::vector<bool> seen(static_cast<std::size_t>(cells.cells.cols()));
  std::vector<std::int32_t> queue{0};
  at(cells.vertices_on_cell[0].back()) = 0;
  seen[0] = true;
  while (!queue.empty()) {
    const std::int32_t cell = queue.back();
    queue.pop_back();
    const std::span<const std::int32_t> vertices = cells.vertices_on_cell[cell];
    std::size_t known = 0;
    while (at(vertices[known]) == unknown)
      ++known;
    for (std::size_t step = 1; step < vertices.size(); ++step) {
      const std::size_t k = (known + step) % vertices.size();
      const std::int32_t a = start_of(cells, cell, k), b = vertices[k],
                         change = change_along(crossings[cells.edges_on_cell[cell][k]]);
      at(b) = at(a) + (a < b ? change : -change);
    }
    for (const std::int32_t other : cells.cells_on_cell[cell])
      if (other >= 0 && !seen[static_cast<std::size_t>(other)]) {
        seen[static_cast<std::size_t>(other)] = true;
        queue.push_back(other);
      }
  }
  return counts;
}

// ---- Areas

/// The area of the triangles from a cell's generator to the parts of an edge, times the numbers of
/// polygons of land there.
double land_along(const Voronoi& cells, const EdgeCrossings& crossings,
                  const std::vector<std::int32_t>& counts, std::int32_t cell, std::size_t k) {
  const std::int32_t a = start_of(cells, cell, k), b = cells.vertices_on_cell[cell][k],
                     low = std::min(a, b);
  const Vec3& generator = column(cells.cells, cell);
  std::int32_t count = counts[static_cast<std::size_t>(low)];
  const Vec3* from = &column(cells.vertices, low);
  double area = 0;
  const auto add = [&](const Vec3& to) {
    if (count != 0)
      area += count * triangle_area(generator, *from, to);
    from = &to;
  };
  for (const Crossing& crossing : crossings[cells.edges_on_cell[cell][k]]) {
    add(crossing.point);
    count += crossing.change;
  }
  add(column(cells.vertices, std::max(a, b)));
  return a < b ? area : -area;
}

struct CellAreas {
  DoubleVector land, whole; ///< the land minus as many spheres as counts are too low
};

CellAreas sum_areas(const Voronoi& cells, const EdgeCrossings& crossings,
                    std::vector<Piece> pieces) {
  const std::vector<std::int32_t> counts = counts_at_vertices(cells, crossings);
  const std::int64_t n = cells.cells.cols();
  CellAreas areas{DoubleVector(n), DoubleVector(n)};
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::int32_t>(begin); i < end; ++i) {
      double land = 0, whole = 0;
      const std::span<const std::int32_t> vertices = cells.vertices_on_cell[i];
      for (std::size_t k = 0; k < vertices.size(); ++k) {
        land += land_along(cells, crossings, counts, i, k);
        whole +=
            triangle_area(column(cells.cells, i), column(cells.vertices, start_of(cells, i, k)),
                          column(cells.vertices, vertices[k]));
      }
      areas.land[i] = land;
      areas.whole[i] = whole;
    }
  });
  for (const Piece& piece : pieces) // in the order of the arcs: the same bits for any threads
    areas.land[piece.cell] += piece.area;
  return areas;
}

/// The fractions of land. The given area of all land determines how many whole spheres the areas
/// lack.
DoubleVector make_fractions(const CellAreas& areas, double area) {
  const double excess = (area - areas.land.sum()) / whole_sphere, spheres = std::round(excess);
  require(std::abs(excess - spheres) < 1e-6,
          "the area of the land is not that of its coast; give both anew");
  DoubleVector fractions = areas.land.cwiseQuotient(areas.whole).array() + spheres;
  Eigen::Index cell = 0;
  const double beyond = (fractions.array() - 0.5).abs().maxCoeff(&cell) - 0.5;
  require(beyond <= 1e-6,
          "the land covers cell {} {} times, as its polygons overlap or cross themselves; give "
          "polygons that do not",
          cell, fractions[cell]);
  return fractions.cwiseMax(0).cwiseMin(1);
}

} // namespace
} // namespace oceans_detail

DoubleVector land_fractions(const Voronoi& cells, const Coast& coast) {
  using namespace oceans_detail;
  Traces traces = trace_coast(cells, make_arcs(coast));
  const EdgeCrossings crossings =
      by_edge(std::move(traces.crossings), cells.edges_on_cell.items.maxCoeff() + 1);
  return make_fractions(sum_areas(cells, crossings, std::move(traces.pieces)), coast.area);
}

std::vector<std::int32_t> cells_on_lines(const Voronoi& cells, const std::vector<Points3>& lines) {
  using namespace oceans_detail;
  const CellWalk walk(cells);
  std::vector<std::int32_t> found;
  std::int32_t cell = 0;
  for (const Points3& line : lines) {
    require(line.cols() > 0, "a line has no place; give at least one");
    Vec3 here = turned(column(line, 0));
    cell = walk.locate(cell, here);
    found.push_back(cell);
    for (Eigen::Index k = 1; k < line.cols(); ++k) {
      const Vec3 next = turned(column(line, k));
      if (next.x == here.x && next.y == here.y && next.z == here.z)
        continue;
      cell = walk.walk(cell, {here, next}, [&](std::int32_t left, std::size_t index) {
        found.push_back(cells.cells_on_cell[left][index]);
      });
      here = next;
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  found.erase(found.begin(), std::lower_bound(found.begin(), found.end(), 0));
  return found;
}

} // namespace calotte
