// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/voronoi.h>

#include "base/lists.h"
#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/clipped_cell.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "mesh/ids.h"
#include "voronoi/boundary_walk.h"
#include "voronoi/cell_parts.h"
#include "voronoi/far_side.h"
#include "voronoi/groups.h"
#include "voronoi/open.h"
#include "voronoi/stages.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

// The Voronoi cells of a part of a plane or of the sphere. The boundary's vertices form closed
// walks in the triangulation (boundary_walk.h). The winding number of these walks around a triangle
// tells whether its circumcentre is inside, and on each Voronoi edge starts and ends alternate:
// rounding cannot make cells that do not fit together.

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

/// The position of a point on the Voronoi edge between two sites, growing with `from` to the left.
double position_between(const Plane&, const Vec3& from, const Vec3& to, const Vec3& point) {
  return cross(to - from, point - from).z;
}
double position_between(const Sphere&, const Vec3& from, const Vec3& to, const Vec3& point) {
  return std::atan2(dot(cross(to - from, point - from), point),
                    norm(to - from) * dot(from + to, point));
}

/// Finds the crossings, in their order on each edge.
template <Space S>
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
      crossings.push_back({static_cast<std::size_t>(edge - edges.begin()), at.before == low,
                           position_between(S(), column(sites, low), column(sites, high), at.point),
                           own});
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

/// The circumcentre, computed from the corner across from the longest side, which keeps the most
/// digits.
Vec3 circumcentre_of(const Plane&, const Points3& sites, const Triangles& triangles,
                     std::int64_t t) {
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

/// The circumcentre; of a triangle of the far side, which runs clockwise, there.
Vec3 circumcentre_of(const Sphere& sphere, const Points3& sites, const Triangles& triangles,
                     std::int64_t t) {
  return sphere.circumcentre(column(sites, triangles(0, t)), column(sites, triangles(1, t)),
                             column(sites, triangles(2, t)));
}

/// A triangle outside the domain by the crossings of its edges; none without crossings.
std::int32_t outer_triangle(const std::vector<DelaunayEdge>& edges,
                            const std::vector<int>& starts) {
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (starts[e] != 0)
      return starts[e] > 0 ? edges[e].right : edges[e].left;
  return none;
}

/// The winding number of the boundary around each triangle, 0 or 1 by the rings' orientation. To
/// the left of an edge it is larger by one for each crossing that starts there.
std::vector<std::int8_t> triangles_inside(const std::vector<DelaunayEdge>& edges,
                                          const std::vector<int>& starts, const Mesh& mesh,
                                          const Surface& surface) {
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
  if (known.empty()) { // the triangles cover the sphere
    const std::int32_t outer = outer_triangle(edges, starts);
    const Vec3 first = circumcentre_of(Sphere(), mesh.points, mesh.triangles, 0);
    set(std::max(outer, 0), outer < 0 && surface.contains({first.x, first.y, first.z}) ? 1 : 0);
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

// ---- Cells

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
/// \param begin, end of the cell's sides, which are sorted by their first vertex.
void append_cell(const std::vector<ClippedSide>& sides, const std::vector<std::int64_t>& begin,
                 std::int32_t cell, std::vector<std::int32_t>& vertices) {
  const std::int64_t from = begin[static_cast<std::size_t>(cell)],
                     end = begin[static_cast<std::size_t>(cell) + 1];
  const auto at = [&](std::int64_t s) -> const ClippedSide& {
    return sides[static_cast<std::size_t>(s)];
  };
  if (from == end)
    refuse_cell(cell);
  std::int64_t first = from;
  for (std::int64_t s = from; s < end; ++s)
    if (at(s).beyond >= 0 && (at(first).beyond < 0 || at(s).beyond < at(first).beyond))
      first = s;
  std::int64_t count = 0, side = first;
  do {
    vertices.push_back(at(side).to);
    side = side_from(sides, begin, cell, at(side).to);
    if (side < 0 || ++count > end - from)
      refuse_cell(cell);
  } while (side != first);
  if (count != end - from)
    refuse_cell(cell);
}

void set_cells(std::vector<ClippedSide> sides, std::int32_t cells, Voronoi& out) {
  const std::vector<std::int64_t> begin = sort_sides(cells, sides);
  std::vector<std::int32_t> vertices;
  out.vertices_on_cell.begin.resize(cells + 1);
  for (std::int32_t i = 0; i < cells; ++i) {
    out.vertices_on_cell.begin[i] = std::ssize(vertices);
    append_cell(sides, begin, i, vertices);
  }
  out.vertices_on_cell.begin[cells] = std::ssize(vertices);
  out.vertices_on_cell.items = Eigen::Map<const Ids>(vertices.data(), std::ssize(vertices));
}

template <Space S>
void set_vertices(const Mesh& mesh, const std::vector<std::int32_t>& vertex_of_triangle,
                  const std::vector<std::vector<BoundaryVertex>>& rings, std::int32_t inner,
                  Voronoi& out) {
  std::int64_t count = inner;
  for (const auto& ring : rings)
    count += std::ssize(ring);
  out.vertices.resize(3, count);
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    if (const std::int32_t v = vertex_of_triangle[static_cast<std::size_t>(t)]; v >= 0)
      set_column(out.vertices, v, circumcentre_of(S(), out.cells, mesh.triangles, t));
  std::int64_t v = inner;
  for (const auto& ring : rings)
    for (const BoundaryVertex& at : ring)
      set_column(out.vertices, v++, at.point);
}

/// The triangles in which every site has a closed star, on the sphere; in a plane the mesh itself.
Mesh surrounded(const Sphere&, const Mesh& mesh) {
  Mesh whole = mesh.closed() ? mesh : delaunay(mesh.points);
  require(whole.points.cols() == mesh.points.cols(),
          "the mesh has equal sites: triangulate the points anew");
  return whole.closed() ? whole : triangulate_hull(whole);
}
const Mesh& surrounded(const Plane&, const Mesh& mesh) { return mesh; }

Points3 centres_of(const Sphere&, const Mesh& mesh) { return checked_centres(mesh); }
Points3 centres_of(const Plane&, const Mesh& mesh) { return with_z(mesh.points.topRows<2>()); }

template <Space S>
Voronoi clipped(const Mesh& sites, const OutlineOf<S>& outline, CoastChanges* joined) {
  const Mesh& mesh = surrounded(S(), sites);
  Voronoi out;
  out.surface = sites.surface;
  out.cells = centres_of(S(), sites);
  const std::vector<DelaunayEdge> edges = delaunay_edges(mesh.triangles, mesh.points.cols());
  const auto rings =
      walk_boundary<S>(outline, out.cells, neighbours_across(edges, mesh.points.cols()));
  const std::vector<Crossing> crossings = find_crossings<S>(rings, edges, out.cells);
  std::vector<int> starts(edges.size());
  for (const Crossing& crossing : crossings)
    starts[crossing.edge] += crossing.starts ? 1 : -1;
  const std::vector<std::int8_t> inside = triangles_inside(edges, starts, mesh, sites.surface);
  std::vector<std::int32_t> vertex_of_triangle(inside.size(), none);
  std::int32_t inner = 0;
  for (std::size_t t = 0; t < inside.size(); ++t)
    if (inside[t] == 1)
      vertex_of_triangle[t] = inner++;
  set_vertices<S>(mesh, vertex_of_triangle, rings, inner, out);
  std::vector<ClippedSide> sides;
  add_inner_sides(edges, crossings, vertex_of_triangle, inner, sides);
  add_boundary_sides(rings, inner, sides);
  if (joined != nullptr)
    *joined = join_parts(out.surface, out.cells, out.vertices, sides);
  set_cells(std::move(sides), static_cast<std::int32_t>(mesh.points.cols()), out);
  return out;
}

} // namespace

Voronoi clipped_polygons(const Mesh& mesh, CoastChanges* joined) {
  require_mesh(mesh);
  require_inside(mesh.points, mesh.surface);
  if (mesh.surface.is_sphere())
    return clipped<Sphere>(mesh, *outline_of<Sphere>(mesh.surface), joined);
  return clipped<Plane>(mesh, *outline_of<Plane>(mesh.surface), joined);
}

Voronoi bounded(const Mesh& mesh) {
  Voronoi out = clipped_polygons(mesh);
  connect_open(out);
  measure_open(out);
  return out;
}

} // namespace calotte::voronoi_detail
