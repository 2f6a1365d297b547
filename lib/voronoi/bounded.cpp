// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/voronoi.h>

#include "base/lists.h"
#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/clipped_cell.h"
#include "domain/outline.h"
#include "domain/surface.h"
#include "mesh/ids.h"
#include "voronoi/boundary_walk.h"
#include "voronoi/groups.h"
#include "voronoi/open.h"
#include "voronoi/stages.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

// The Voronoi cells of a bounded plane. The boundary's vertices form closed walks in the
// triangulation (boundary_walk.h). The winding number of these walks around a triangle tells
// whether its circumcentre is inside, and on each Voronoi edge starts and ends alternate: rounding
// cannot make cells that do not fit together.

namespace calotte::voronoi_detail {
namespace {

void require_mesh(const Mesh& mesh) {
  require(are_ids(mesh.triangles, mesh.points.cols()),
          "the mesh has an id that is not one of its {} points: triangulate the points anew",
          mesh.points.cols());
}

// ---- Edges of the triangulation

/// An edge from the lower to the higher of two sites, with the triangles to its right and to its
/// left; none beyond the hull.
struct DelaunayEdge {
  std::int32_t low, high;
  std::int32_t right = none, left = none;
};

[[noreturn]] void refuse_edge(const DelaunayEdge& edge) {
  refuse(message("the edge from site {} to {} has several triangles on one side: "
                 "triangulate the points anew",
                 edge.low, edge.high));
}

/// The edges, sorted by their sites.
std::vector<DelaunayEdge> delaunay_edges(const Triangles& triangles, std::int64_t sites) {
  std::vector<DelaunayEdge> sides;
  sides.reserve(static_cast<std::size_t>(triangles.size()));
  for (std::int32_t t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = triangles(i, t), b = triangles((i + 1) % 3, t);
      sides.push_back(a < b ? DelaunayEdge{a, b, none, t} : DelaunayEdge{b, a, t, none});
    }
  const auto sites_of = [](const DelaunayEdge& edge) { return std::tie(edge.low, edge.high); };
  sort_in_groups(
      sites, [](const DelaunayEdge& side) { return side.low; },
      [](const DelaunayEdge& a, const DelaunayEdge& b) {
        return std::tie(a.high, a.left, a.right) < std::tie(b.high, b.left, b.right);
      },
      sides);
  std::vector<DelaunayEdge> edges;
  for (const DelaunayEdge& side : sides) {
    if (edges.empty() || sites_of(edges.back()) != sites_of(side)) {
      edges.push_back(side);
      continue;
    }
    std::int32_t& slot = side.left >= 0 ? edges.back().left : edges.back().right;
    if (slot >= 0)
      refuse_edge(side);
    slot = std::max(side.left, side.right);
  }
  return edges;
}

Neighbours neighbours_across(const std::vector<DelaunayEdge>& edges, std::int64_t sites) {
  Neighbours out =
      base_detail::lists_by_key<std::vector<std::int32_t>>(sites, [&](const auto& put) {
        for (const DelaunayEdge& edge : edges) {
          put(edge.low, edge.high);
          put(edge.high, edge.low);
        }
      });
  for (std::int64_t i = 0; i < sites; ++i)
    if (out.count(i) == 0)
      refuse_at(i, "site {} is not a vertex of any triangle: triangulate the points anew");
  return out;
}

// ---- Vertices

/// A vertex where the boundary cuts a Voronoi edge.
struct Crossing {
  std::size_t edge;
  bool starts;  ///< the part of the edge inside the domain starts here, seen from its lower site
  double along; ///< its position on the edge, which has its lower site to the left
  std::int32_t vertex; ///< number in the whole boundary
};

/// Finds the crossings, in their order on each edge.
std::vector<Crossing> find_crossings(const std::vector<std::vector<BoundaryVertex>>& rings,
                                     const std::vector<DelaunayEdge>& edges, const Points3& sites) {
  std::vector<Crossing> crossings;
  std::int32_t vertex = 0;
  for (const auto& ring : rings)
    for (const BoundaryVertex& at : ring) {
      const std::int32_t own = vertex++;
      if (!at.crossing())
        continue;
      const auto [low, high] = std::minmax(at.before, at.after);
      const auto edge = std::lower_bound(
          edges.begin(), edges.end(), std::pair(low, high),
          [](const DelaunayEdge& e, const auto& key) { return std::pair(e.low, e.high) < key; });
      const Vec2 from{sites(0, low), sites(1, low)}, to{sites(0, high), sites(1, high)};
      crossings.push_back({static_cast<std::size_t>(edge - edges.begin()), at.before == low,
                           cross(to - from, at.point - from), own});
    }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.edge, a.along, a.vertex) < std::tie(b.edge, b.along, b.vertex);
  });
  return crossings;
}

/// A neighbour of a triangle, and by how much its winding number is larger.
struct Beyond {
  std::int32_t triangle = none;
  int more = 0;
};

void add(std::array<Beyond, 3>& list, const Beyond& beyond) {
  for (Beyond& entry : list)
    if (entry.triangle < 0) {
      entry = beyond;
      return;
    }
}

/// The winding number of the boundary around each triangle, 0 or 1 by the rings' orientation. To
/// the left of an edge it is larger by one for each crossing that starts there.
std::vector<std::int8_t> triangles_inside(const std::vector<DelaunayEdge>& edges,
                                          const std::vector<int>& starts, const Mesh& mesh) {
  constexpr std::int8_t unknown = -1;
  std::vector<std::int8_t> inside(static_cast<std::size_t>(mesh.triangles.cols()), unknown);
  std::vector<std::array<Beyond, 3>> beyond(inside.size());
  std::vector<std::int32_t> known;
  const auto set = [&](std::int32_t triangle, int turns) {
    require(turns == 0 || turns == 1,
            "the domain's boundary and the cells around site {} do not fit: give the Delaunay "
            "triangulation of the points, and rings that keep more than rounding apart",
            mesh.triangles(0, triangle));
    inside[static_cast<std::size_t>(triangle)] = static_cast<std::int8_t>(turns);
    known.push_back(triangle);
  };
  const auto is_known = [&](std::int32_t t) { return inside[static_cast<std::size_t>(t)] >= 0; };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high, right, left] = edges[e];
    if (right >= 0 && left >= 0) {
      add(beyond[static_cast<std::size_t>(right)], {left, starts[e]});
      add(beyond[static_cast<std::size_t>(left)], {right, -starts[e]});
    } else if (!is_known(std::max(left, right))) {
      set(std::max(left, right), left >= 0 ? starts[e] : -starts[e]);
    }
  }
  while (!known.empty()) {
    const std::int32_t triangle = known.back();
    known.pop_back();
    for (const auto& [other, more] : beyond[static_cast<std::size_t>(triangle)])
      if (other >= 0 && !is_known(other))
        set(other, inside[static_cast<std::size_t>(triangle)] + more);
  }
  return inside;
}

/// The circumcentre, computed from the corner across from the longest side, which keeps the most
/// digits.
Vec3 circumcentre_of(const Points3& sites, const Triangles& triangles, std::int64_t t) {
  const auto at = [&](int i) {
    const std::int32_t site = triangles(i % 3, t);
    return Vec2{sites(0, site), sites(1, site)};
  };
  int corner = 0;
  double longest = -1;
  for (int i = 0; i < 3; ++i)
    if (const Vec2 side = at(i + 2) - at(i + 1); dot(side, side) > longest) {
      longest = dot(side, side);
      corner = i;
    }
  const Vec2 from = at(corner);
  const Vec2 point = from + circumcentre(at(corner + 1) - from, at(corner + 2) - from);
  return {point.x, point.y, 0};
}

// ---- Cells

/// A side of a cell, counter-clockwise.
struct ClippedSide {
  std::int32_t cell, from, to;
  std::int32_t beyond; ///< the cell across, or none
};

/// Adds the sides along Voronoi edges. On each edge, starts and ends of parts alternate.
void add_inner_sides(const std::vector<DelaunayEdge>& edges, const std::vector<Crossing>& crossings,
                     const std::vector<std::int32_t>& vertex_of_triangle,
                     std::int32_t first_of_boundary, std::vector<ClippedSide>& sides) {
  const auto vertex_of = [&](std::int32_t triangle) {
    return triangle < 0 ? none : vertex_of_triangle[static_cast<std::size_t>(triangle)];
  };
  std::vector<std::int32_t> starts, ends;
  auto crossing = crossings.begin();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    starts.clear();
    ends.clear();
    const std::int32_t first = vertex_of(edges[e].right), last = vertex_of(edges[e].left);
    if (first >= 0)
      starts.push_back(first);
    for (; crossing != crossings.end() && crossing->edge == e; ++crossing)
      (crossing->starts ? starts : ends).push_back(first_of_boundary + crossing->vertex);
    if (last >= 0)
      ends.push_back(last);
    for (std::size_t k = 0; k < std::min(starts.size(), ends.size()); ++k) {
      sides.push_back({edges[e].low, starts[k], ends[k], edges[e].high});
      sides.push_back({edges[e].high, ends[k], starts[k], edges[e].low});
    }
  }
}

void add_boundary_sides(const std::vector<std::vector<BoundaryVertex>>& rings,
                        std::int32_t first_vertex, std::vector<ClippedSide>& sides) {
  for (const auto& ring : rings) {
    const auto size = static_cast<std::int32_t>(ring.size());
    for (std::int32_t k = 0; k < size; ++k)
      sides.push_back({ring[static_cast<std::size_t>(k)].after, first_vertex + k,
                       first_vertex + (k + 1 == size ? 0 : k + 1), none});
    first_vertex += size;
  }
}

[[noreturn]] void refuse_cell(std::int32_t cell) {
  refuse_at(cell, "the domain's boundary cuts the Voronoi cell of site {} into several parts, or "
                  "encloses an island in it, and a cell is one polygon; give more sites there");
}

/// Appends the vertices of a cell, starting with the end of the side towards the lowest neighbour.
/// \param sides of the cell, sorted by their first vertex.
void append_cell(const ClippedSide* begin, const ClippedSide* end,
                 std::vector<std::int32_t>& vertices) {
  const ClippedSide* first = begin;
  for (const ClippedSide* side = begin; side != end; ++side)
    if (side->beyond >= 0 && (first->beyond < 0 || side->beyond < first->beyond))
      first = side;
  std::int64_t count = 0;
  const ClippedSide* side = first;
  do {
    vertices.push_back(side->to);
    side = std::lower_bound(begin, end, side->to, [](const ClippedSide& s, std::int32_t vertex) {
      return s.from < vertex;
    });
    if (side == end || side->from != vertices.back() || ++count > end - begin)
      refuse_cell(begin->cell);
  } while (side != first);
  if (count != end - begin)
    refuse_cell(begin->cell);
}

void set_cells(std::vector<ClippedSide> sides, std::int64_t cells, Voronoi& out) {
  sort_in_groups(
      cells, [](const ClippedSide& side) { return side.cell; },
      [](const ClippedSide& a, const ClippedSide& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
      },
      sides);
  std::vector<std::int32_t> vertices;
  out.vertices_on_cell.begin.resize(cells + 1);
  const ClippedSide* side = sides.data();
  const ClippedSide* const end = side + sides.size();
  for (std::int32_t i = 0; i < cells; ++i) {
    out.vertices_on_cell.begin[i] = std::ssize(vertices);
    const ClippedSide* const first = side;
    while (side != end && side->cell == i)
      ++side;
    if (first == side)
      refuse_cell(i);
    append_cell(first, side, vertices);
  }
  out.vertices_on_cell.begin[cells] = std::ssize(vertices);
  out.vertices_on_cell.items = Eigen::Map<const Ids>(vertices.data(), std::ssize(vertices));
}

void set_vertices(const Mesh& mesh, const std::vector<std::int32_t>& vertex_of_triangle,
                  const std::vector<std::vector<BoundaryVertex>>& rings, std::int32_t inner,
                  Voronoi& out) {
  std::int64_t count = inner;
  for (const auto& ring : rings)
    count += std::ssize(ring);
  out.vertices.resize(3, count);
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    if (const std::int32_t v = vertex_of_triangle[static_cast<std::size_t>(t)]; v >= 0)
      set_column(out.vertices, v, circumcentre_of(mesh.points, mesh.triangles, t));
  std::int64_t v = inner;
  for (const auto& ring : rings)
    for (const BoundaryVertex& at : ring)
      set_column(out.vertices, v++, {at.point.x, at.point.y, 0});
}

Voronoi bounded(const Mesh& mesh, const Outline& outline) {
  const std::vector<DelaunayEdge> edges = delaunay_edges(mesh.triangles, mesh.points.cols());
  const auto rings =
      walk_boundary(outline, mesh.points, neighbours_across(edges, mesh.points.cols()));
  const std::vector<Crossing> crossings = find_crossings(rings, edges, mesh.points);
  std::vector<int> starts(edges.size());
  for (const Crossing& crossing : crossings)
    starts[crossing.edge] += crossing.starts ? 1 : -1;
  const std::vector<std::int8_t> inside = triangles_inside(edges, starts, mesh);
  std::vector<std::int32_t> vertex_of_triangle(inside.size(), none);
  std::int32_t inner = 0;
  for (std::size_t t = 0; t < inside.size(); ++t)
    if (inside[t] == 1)
      vertex_of_triangle[t] = inner++;

  Voronoi out;
  out.surface = mesh.surface;
  out.cells = with_z(mesh.points.topRows<2>());
  set_vertices(mesh, vertex_of_triangle, rings, inner, out);
  std::vector<ClippedSide> sides;
  add_inner_sides(edges, crossings, vertex_of_triangle, inner, sides);
  add_boundary_sides(rings, inner, sides);
  set_cells(std::move(sides), mesh.points.cols(), out);
  connect_open(out);
  measure_open(out);
  return out;
}

} // namespace

Voronoi bounded(const Mesh& mesh) {
  const Outline& outline = *domain_detail::outline_of<exact_detail::Plane>(mesh.surface);
  require_mesh(mesh);
  require_inside(mesh.points, mesh.surface);
  return bounded(mesh, outline);
}

} // namespace calotte::voronoi_detail
