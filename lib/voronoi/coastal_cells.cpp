// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/coastal_cells.h>

#include "base/points.h"
#include "base/require.h"
#include "exact/space.h"
#include "voronoi/connectivity.h"
#include "voronoi/open.h"
#include "voronoi/stages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace calotte {
namespace voronoi_detail {
namespace {

using Polygon = std::vector<std::int32_t>; ///< vertices of a cell, counter-clockwise

/// The least distance of a site from the lines of its cell's sides on the boundary, in widths.
constexpr double least_seen = 0.05;
/// The same after ends of edges have moved.
constexpr double least_left = 0.02;

void connect_and_measure(Voronoi& cells) {
  connect_open(cells);
  measure_open(cells);
}

bool is_on_boundary(const Voronoi& cells, std::int32_t vertex) {
  return cells.cells_on_vertex(2, vertex) < 0;
}

double width_of(const Voronoi& cells, std::int32_t cell) {
  return std::sqrt(cells.cell_area[cell]);
}

bool is_at_boundary(const Voronoi& cells, std::int32_t cell) {
  return std::ranges::any_of(cells.cells_on_cell[cell], [](std::int32_t id) { return id < 0; });
}

/// Whether a side of a cell, between vertices of its list, is on the boundary.
bool is_boundary_side(const Voronoi& cells, std::int32_t cell, std::int32_t from, std::int32_t to) {
  const std::span<const std::int32_t> all = cells.vertices_on_cell[cell];
  const auto index = static_cast<std::size_t>(std::ranges::find(all, to) - all.begin());
  return start_of(cells, cell, index) != from || cells.cells_on_cell[cell][index] < 0;
}

// ---- Simple polygons

/// Whether two sides have a common point. \pre they share no vertex.
template <Space S>
bool meet(const S& space, const Voronoi& cells, std::int32_t a, std::int32_t b, std::int32_t c,
          std::int32_t d) {
  const auto at = [&](std::int32_t v) { return space.position(column(cells.vertices, v)); };
  const auto a_at = at(a), b_at = at(b), c_at = at(c), d_at = at(d);
  return space.orientation(a_at, b_at, c_at) * space.orientation(a_at, b_at, d_at) <= 0 &&
         space.orientation(c_at, d_at, a_at) * space.orientation(c_at, d_at, b_at) <= 0;
}

/// Whether sides of a polygon meet only in the vertices that join them. The polygon is smaller
/// than a hemisphere.
template <Space S>
bool is_simple(const S& space, const Voronoi& cells, std::span<const std::int32_t> polygon) {
  const std::size_t n = polygon.size();
  const auto at = [&](std::size_t k) { return polygon[k % n]; };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && meet(space, cells, at(i), at(i + 1), at(j), at(j + 1)))
        return false;
  return n > 2;
}

/// Whether a site sees all sides of its cell on the boundary from a distance, so that kites beside
/// them have positive areas. Sides between cells are parts of bisectors, which it always sees.
/// \param least such distance.
template <Space S>
bool is_seen(const S& space, const Voronoi& cells, std::int32_t cell, double least,
             std::span<const std::int32_t> polygon) {
  const Vec3 &site = column(cells.cells, cell), up = S::up(site);
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::int32_t from = polygon[k], to = polygon[k + 1 == polygon.size() ? 0 : k + 1];
    const Vec3 way = space.offset(column(cells.vertices, from), column(cells.vertices, to)),
               there = space.offset(column(cells.vertices, from), site);
    if (is_boundary_side(cells, cell, from, to) &&
        !(dot(up, cross(way, there)) > least * norm(way)))
      return false;
  }
  return true;
}

// ---- Corners of the boundary

/// The distance of a point from the straight line between two others, seen along the normal of the
/// surface there.
template <Space S>
double distance_from_line(const S& space, const Vec3& x, const Vec3& from, const Vec3& to) {
  const Vec3 up = S::up(x);
  const auto tangent = [&](const Vec3& way) { return way - dot(way, up) * up; };
  const Vec3 way = tangent(space.offset(from, to)), there = tangent(space.offset(from, x));
  const double length2 = dot(way, way);
  const double share = length2 > 0 ? std::clamp(dot(there, way) / length2, 0.0, 1.0) : 0;
  return norm(there - share * way);
}

/// Copies to `kept` those corners between two vertices that are needed to stay within a distance
/// of all (Douglas and Peucker, Cartographica 10, 1973).
/// \param chain the vertices, with the corners between.
template <Space S>
void keep_bends(const S& space, const Voronoi& cells, std::span<const std::int32_t> chain,
                double distance, Polygon& kept) {
  std::size_t farthest = 0;
  double most = distance;
  for (std::size_t k = 1; k + 1 < chain.size(); ++k)
    if (const double from = distance_from_line(space, column(cells.vertices, chain[k]),
                                               column(cells.vertices, chain.front()),
                                               column(cells.vertices, chain.back()));
        from > most) {
      most = from;
      farthest = k;
    }
  if (farthest == 0)
    return;
  keep_bends(space, cells, chain.first(farthest + 1), distance, kept);
  kept.push_back(chain[farthest]);
  keep_bends(space, cells, chain.subspan(farthest), distance, kept);
}

/// A cell with few corners of the boundary, none near the ends of edges between cells.
template <Space S>
Polygon straightened(const S& space, const Voronoi& cells, std::int32_t cell, double straightness) {
  const std::span<const std::int32_t> all = cells.vertices_on_cell[cell];
  const auto is_corner = [&](std::int32_t v) { return cells.cells_on_vertex(1, v) < 0; };
  const auto first = std::find_if_not(all.begin(), all.end(), is_corner);
  Polygon polygon(all.begin(), all.end());
  if (first == all.end()) // a cell without neighbours
    return polygon;
  std::rotate(polygon.begin(), polygon.begin() + (first - all.begin()), polygon.end());
  polygon.push_back(polygon.front());
  const double width = width_of(cells, cell), distance = straightness * width,
               near = std::min(4 * distance, width / 8);
  Polygon kept{polygon.front()};
  for (std::size_t from = 0, to = 1; to < polygon.size(); ++to) {
    if (is_corner(polygon[to]))
      continue;
    const auto first_bend = std::ssize(kept);
    keep_bends(space, cells, std::span(polygon).subspan(from, to - from + 1), distance, kept);
    const auto is_near_end = [&](std::int32_t corner) {
      const auto from_corner = [&](std::int32_t v) {
        return norm(space.offset(column(cells.vertices, corner), column(cells.vertices, v)));
      };
      return std::min(from_corner(polygon[from]), from_corner(polygon[to])) < near;
    };
    kept.erase(std::remove_if(kept.begin() + first_bend, kept.end(), is_near_end), kept.end());
    kept.push_back(polygon[to]);
    from = to;
  }
  kept.pop_back(); // the first one again
  // The list starts with the end of the edge towards the lowest neighbour, which is no corner.
  if (const auto start = std::find(kept.begin(), kept.end(), all.front()); start != kept.end())
    std::rotate(kept.begin(), start, kept.end());
  return kept;
}

/// A cell without those corners of the boundary that are not needed, and without those that hide
/// a part of the boundary from the site.
template <Space S>
Polygon fewest_corners(const S& space, const Voronoi& cells, std::int32_t cell,
                       double straightness) {
  constexpr double farthest = 0.5; // that a corner may be from the line that replaces it
  const std::span<const std::int32_t> all = cells.vertices_on_cell[cell];
  Polygon fewest(all.begin(), all.end());
  bool found = false;
  const auto suits = [&](double share) {
    Polygon polygon = straightened(space, cells, cell, share);
    const bool simple = polygon.size() == all.size() || is_simple(space, cells, polygon),
               seen = simple &&
                      is_seen(space, cells, cell, least_seen * width_of(cells, cell), polygon);
    if (seen || (simple && !found))
      fewest = std::move(polygon);
    found = found || simple;
    return seen;
  };
  if (suits(straightness))
    return fewest;
  for (double share = 2 * straightness; straightness > 0 && share <= farthest; share *= 2)
    if (suits(share))
      return fewest;
  if (straightness > 0)
    suits(std::numeric_limits<double>::infinity());
  return fewest;
}

/// Leaves out the vertices that no cell has.
void drop_unused_vertices(Voronoi& cells) {
  std::vector<std::int32_t> id(static_cast<std::size_t>(cells.vertices.cols()), -1);
  for (const std::int32_t v : cells.vertices_on_cell.items)
    id[static_cast<std::size_t>(v)] = 0;
  std::int32_t count = 0;
  for (std::size_t v = 0; v < id.size(); ++v)
    if (id[v] >= 0) {
      id[v] = count;
      cells.vertices.col(count++) = cells.vertices.col(static_cast<Eigen::Index>(v)).eval();
    }
  cells.vertices.conservativeResize(3, count);
  for (std::int32_t& v : cells.vertices_on_cell.items)
    v = id[static_cast<std::size_t>(v)];
}

/// Removes corners of the boundary. \pre connected and measured.
template <Space S>
void straighten(const S& space, double straightness, CoastChanges& changes, Voronoi& cells) {
  IdLists lists;
  lists.begin.resize(cells.vertices_on_cell.begin.size());
  Polygon items;
  for (std::int32_t i = 0; i < cells.cells.cols(); ++i) {
    lists.begin[i] = std::ssize(items);
    const std::span<const std::int32_t> all = cells.vertices_on_cell[i];
    const Polygon polygon = is_at_boundary(cells, i) ? fewest_corners(space, cells, i, straightness)
                                                     : Polygon(all.begin(), all.end());
    items.insert(items.end(), polygon.begin(), polygon.end());
  }
  lists.begin[cells.cells.cols()] = std::ssize(items);
  lists.items = Eigen::Map<const Ids>(items.data(), std::ssize(items));
  changes.removed_corners = cells.vertices_on_cell.items.size() - lists.items.size();
  cells.vertices_on_cell = std::move(lists);
  drop_unused_vertices(cells);
}

// ---- Short edges

Vec3 moved(const Sphere&, const Vec3& x, const Vec3& way) { return normalised(x + way); }
Vec3 moved(const Plane&, const Vec3& x, const Vec3& way) { return x + way; }

/// An end of an edge between two cells, on the boundary.
struct End {
  std::int64_t edge;
  int end; ///< 0 or 1 of its vertices
};

std::int32_t vertex_of(const Voronoi& cells, End at) {
  return cells.vertices_on_edge(at.end, at.edge);
}

/// The end of the edge between two cells at a vertex on the boundary, if there is one.
std::optional<End> inner_end(const Voronoi& cells, std::int32_t vertex) {
  for (const std::int32_t e : cells.edges_on_vertex.col(vertex))
    if (e >= 0 && cells.cells_on_edge(1, e) >= 0)
      return End{e, cells.vertices_on_edge(0, e) == vertex ? 0 : 1};
  return std::nullopt;
}

/// The unit vector along the bisector, away from the edge.
template <Space S> Vec3 outward(const S& space, const Voronoi& cells, End at) {
  const Vec3 way = space.offset(column(cells.cells, cells.cells_on_edge(0, at.edge)),
                                column(cells.cells, cells.cells_on_edge(1, at.edge)));
  const Vec3 left = cross(S::up(column(cells.vertices, vertex_of(cells, at))), way);
  return (at.end == 0 ? -1 : 1) / norm(left) * left;
}

/// Moves an end along its bisector, outwards or by less than 0 inwards, unless a cell would overlap
/// itself, or hide a part of the boundary from a site that sees all of it. \param widths of the
/// cells. \returns whether it did.
template <Space S>
bool move_end(const S& space, const DoubleVector& widths, End at, double distance, Voronoi& cells) {
  const auto pair = cells.cells_on_edge.col(at.edge);
  const auto suits = [&](std::int32_t cell) {
    return is_simple(space, cells, cells.vertices_on_cell[cell]);
  };
  const auto seen = [&](std::int32_t cell) {
    return is_seen(space, cells, cell, least_left * widths[cell], cells.vertices_on_cell[cell]);
  };
  const bool before_a = seen(pair(0)), before_b = seen(pair(1));
  const std::int32_t v = vertex_of(cells, at);
  const Vec3 x = column(cells.vertices, v);
  set_column(cells.vertices, v, moved(space, x, distance * outward(space, cells, at)));
  if (suits(pair(0)) && suits(pair(1)) && (!before_a || seen(pair(0))) &&
      (!before_b || seen(pair(1))))
    return true;
  set_column(cells.vertices, v, x);
  return false;
}

/// Moves ends of short edges outwards. \pre connected and measured.
template <Space S>
std::int64_t lengthen(const S& space, const DoubleVector& widths, double least_edge,
                      Voronoi& cells) {
  std::int64_t count = 0;
  for (std::int64_t e = 0; e < cells.cells_on_edge.cols() && cells.cells_on_edge(1, e) >= 0; ++e) {
    const bool right = is_on_boundary(cells, cells.vertices_on_edge(0, e)),
               left = is_on_boundary(cells, cells.vertices_on_edge(1, e));
    const double lacking = least_edge * cells.dc[e] - cells.dv[e];
    if (!(lacking > 0) || (!right && !left))
      continue;
    const double each = right && left ? lacking / 2 : lacking;
    for (const auto& [moves, end] : {std::pair{right, 0}, {left, 1}})
      for (double share = 1; moves && share > 0.2; share -= 0.25)
        if (move_end(space, widths, {e, end}, share * each, cells)) {
          ++count;
          break;
        }
  }
  return count;
}

/// The length of an edge between two cells, as the vertices are.
template <Space S> double length_of(const S& space, const Voronoi& cells, std::int64_t e) {
  return norm(space.offset(column(cells.vertices, cells.vertices_on_edge(0, e)),
                           column(cells.vertices, cells.vertices_on_edge(1, e))));
}

/// Moves the ends of a short edge on the boundary along both bisectors, to where they are farther
/// from each other: a cell may touch the boundary with its tip alone. \returns whether it did.
template <Space S>
bool widen(const S& space, const DoubleVector& widths, double least_edge, std::int64_t e,
           Voronoi& cells) {
  constexpr double least = 0.05, farthest = 0.25; // widths
  const std::int32_t from = cells.vertices_on_edge(0, e), to = cells.vertices_on_edge(1, e);
  const double width = widths[cells.cells_on_edge(0, e)];
  const Vec3 start = column(cells.vertices, from),
             way = space.offset(start, column(cells.vertices, to));
  if (!(norm(way) < least * width))
    return false;
  const std::optional<End> first = inner_end(cells, from), last = inner_end(cells, to);
  if (!first || !last)
    return false;
  const Vec3 of_first = outward(space, cells, *first), of_last = outward(space, cells, *last);
  const Vec3 along =
      normalised(cross(S::up(start), of_first + of_last)); // with the cell to the left
  const double distance = (least * width - dot(way, along)) / dot(of_last - of_first, along);
  const auto leaves_edge = [&](End at) {
    return length_of(space, cells, at.edge) + distance > least_edge * cells.dc[at.edge];
  };
  if (!(std::abs(distance) < farthest * width) || !leaves_edge(*first) || !leaves_edge(*last))
    return false;
  if (move_end(space, widths, *first, distance, cells)) {
    if (move_end(space, widths, *last, distance, cells))
      return true;
    set_column(cells.vertices, from, start);
  }
  return false;
}

// ---- Edges on the boundary

/// The position of the foot of a point on a line, 0 at its start and 1 at its end.
double foot_on(const Plane&, const Vec3& from, const Vec3& to, const Vec3& x) {
  return dot(x - from, to - from) / dot(to - from, to - from);
}
double foot_on(const Sphere&, const Vec3& from, const Vec3& to, const Vec3& x) {
  const Vec3 pole = cross(from, to - from), foot = x - dot(x, pole) / dot(pole, pole) * pole;
  const double before = dot(pole, cross(from, foot)), after = dot(pole, cross(foot, to));
  return before / (before + after);
}

/// The point of the middle half of an edge on the boundary that is nearest to its cell: kites
/// beside it have an area, whatever the edge's angle. NaN for other edges, and for those that are
/// too near.
template <Space S> Points3 boundary_edges(const S& space, const Voronoi& cells) {
  constexpr double margin = 0.25;
  Points3 edges =
      Points3::Constant(3, cells.cells_on_edge.cols(), std::numeric_limits<double>::quiet_NaN());
  for (std::int64_t e = 0; e < edges.cols(); ++e) {
    if (cells.cells_on_edge(1, e) >= 0)
      continue;
    const Vec3 &from = column(cells.vertices, cells.vertices_on_edge(0, e)),
               &to = column(cells.vertices, cells.vertices_on_edge(1, e));
    const double foot = foot_on(space, from, to, column(cells.cells, cells.cells_on_edge(0, e)));
    const double share = foot > margin ? std::min(foot, 1 - margin) : margin; // NaN: any
    const Vec3 at = moved(space, from, share * (to - from));
    const std::int32_t cell = cells.cells_on_edge(0, e);
    if (norm(space.offset(column(cells.cells, cell), at)) > least_left * width_of(cells, cell))
      set_column(edges, e, at);
  }
  return edges;
}

/// Counts cells that hide a part of the boundary from their sites.
template <Space S>
void count_hidden(const S& space, const DoubleVector& widths, const Voronoi& cells,
                  CoastChanges& changes) {
  for (std::int32_t i = 0; i < cells.cells.cols(); ++i)
    if (is_at_boundary(cells, i) &&
        !is_seen(space, cells, i, least_left * widths[i], cells.vertices_on_cell[i]) &&
        changes.hidden_cells++ == 0)
      changes.hidden_cell = i;
}

/// Counts cells that are slivers.
void count_small(const Voronoi& cells, CoastChanges& changes) {
  constexpr double least = 1.0 / 3; // of the mean area of the neighbours
  for (std::int32_t i = 0; i < cells.cells.cols(); ++i) {
    if (!is_at_boundary(cells, i))
      continue;
    double sum = 0;
    int count = 0;
    for (const std::int32_t other : cells.cells_on_cell[i])
      if (other >= 0) {
        sum += cells.cell_area[other];
        ++count;
      }
    if (count * cells.cell_area[i] < least * sum && changes.small_cells++ == 0)
      changes.small_cell = i;
  }
}

} // namespace
} // namespace voronoi_detail

CoastalCells coastal_cells(const Mesh& mesh, const CoastalOptions& options) {
  using namespace voronoi_detail;
  require(mesh.surface.is_bounded(),
          "the surface has no boundary that clips cells; give one within rings, or use voronoi()");
  require(options.straightness >= 0 && options.straightness <= 0.5,
          "the straightness is {}; give a share of a cell's width, 0 to 0.5", options.straightness);
  require(options.least_edge >= 0 && options.least_edge <= 0.5,
          "the least length of an edge is {} distances of cells; give 0 to 0.5",
          options.least_edge);
  CoastalCells out;
  Voronoi& cells = out.voronoi;
  cells = clipped_polygons(mesh, &out.changes);
  drop_unused_vertices(cells);
  connect_and_measure(cells);
  in_space_of(mesh.surface, [&](const auto& space) {
    const DoubleVector before = cells.cell_area, widths = before.cwiseSqrt();
    straighten(space, options.straightness, out.changes, cells);
    connect_and_measure(cells);
    out.changes.moved_ends = lengthen(space, widths, options.least_edge, cells);
    for (std::int64_t e = 0; e < cells.cells_on_edge.cols(); ++e)
      if (options.least_edge > 0 && cells.cells_on_edge(1, e) < 0)
        out.changes.moved_ends += widen(space, widths, options.least_edge, e, cells) ? 2 : 0;
    measure_open(cells, boundary_edges(space, cells));
    count_hidden(space, widths, cells, out.changes);
    count_small(cells, out.changes);
    out.changes.changed_area = (cells.cell_area - before).cwiseAbs().sum();
  });
  return out;
}

} // namespace calotte
