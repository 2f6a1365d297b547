// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/connectivity.h"

#include "base/array.h"
#include "base/first_fault.h"
#include "base/lists.h"
#include "base/parallel.h"
#include "base/triangle.h"

#include <calotte/error.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace calotte::voronoi_detail {
namespace {

// ---- Rings: the triangles around a site, counter-clockwise

/// Calls body(corner) for the corners at a site.
/// \returns the corner whose next one does not match, or none.
template <class Body>
Corner walk_ring(const Faces& surface, std::int32_t first, std::int32_t site, const Body& body) {
  return walk_around(
      Corner{first, vertex_at(surface.triangle_ids, first, site)},
      [&](Corner corner) { return fitting_next(surface, corner); }, body);
}

/// A triangle at each site. The choice may vary; the order of the rings does not depend on it.
Array<std::int32_t> some_triangles(const Faces& surface) {
  Array<std::int32_t> some(surface.sites());
  for_each_block(surface.sites(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::fill(some.begin() + begin, some.begin() + end, none);
  });
  FirstFault fault;
  for_each_block(surface.triangles(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const std::int32_t a = surface.triangle_ids(0, t), b = surface.triangle_ids(1, t),
                         c = surface.triangle_ids(2, t);
      if (std::min({a, b, c}) < 0 || std::max({a, b, c}) >= surface.sites() || a == b || b == c ||
          c == a) {
        fault.at(t);
        continue;
      }
      for (const std::int32_t site : {a, b, c})
        std::atomic_ref(some[site]).store(static_cast<std::int32_t>(t), std::memory_order_relaxed);
    }
  });
  fault.refuse("triangle",
               "has a vertex outside the mesh's points, or one of them twice: triangulate "
               "the points anew");
  return some;
}

/// Sets the lengths of lists in the arrays of their starts: in edges_on_cell, and in first_edge of
/// the rings.
Rings count_rings(const Faces& surface, Voronoi& out) {
  Rings rings{some_triangles(surface), Array<std::int32_t>(surface.sites())};
  out.edges_on_cell.begin.resize(surface.sites() + 1);
  FirstFault lonely, unfit;
  for_each_block(surface.sites(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      std::int32_t degree = 0, higher = 0, lowest = std::numeric_limits<std::int32_t>::max();
      const std::int32_t some = rings.first[i];
      if (some == none) {
        lonely.at(i);
        continue;
      }
      const Corner fault = walk_ring(surface, some, i, [&](Corner corner) {
        const std::int32_t j = following_site(surface, corner);
        ++degree;
        higher += j > i;
        if (j < lowest) {
          lowest = j;
          rings.first[i] = corner.triangle;
        }
      });
      if (exists(fault))
        unfit.at(fault.triangle);
      out.edges_on_cell.begin[i] = degree;
      rings.first_edge[i] = higher;
    }
  });
  lonely.refuse("site", "is not a vertex of any triangle: triangulate the points anew");
  unfit.refuse("triangle", "has a neighbour that does not fit it: triangulate the points anew");
  return rings;
}

/// Refuses a site whose triangles form more than one ring.
[[noreturn]] void refuse_second_ring(const Faces& surface, const Voronoi& out) {
  std::vector<std::int64_t> corners(static_cast<std::size_t>(surface.sites()));
  for (const std::int32_t site : surface.triangle_ids.reshaped())
    ++corners[static_cast<std::size_t>(site)];
  FirstFault fault;
  for (std::int64_t i = 0; i != surface.sites(); ++i)
    if (corners[static_cast<std::size_t>(i)] != out.edges_on_cell.count(i))
      fault.at(i);
  fault.refuse("site", "has triangles that do not form one ring around it: triangulate the points "
                       "anew");
  throw Error(ErrorCode::internal, "the rings of a mesh were miscounted");
}

// ---- Edges: numbered by their lower cell, then by their higher one

/// A neighbour of a cell, and the index of its edge in the cell's list.
struct Neighbour {
  std::int32_t cell;
  std::size_t index;
};

/// Sets all data of edge e, the `index`-th of the lower cell's list.
void set_edge(const Faces& surface, std::int32_t e, std::int32_t lower, std::size_t index,
              Voronoi& out) {
  const std::int32_t left = out.vertices_on_cell[lower][index], right = start_of(out, lower, index);
  out.cells_on_edge.col(e) << lower, out.cells_on_cell[lower][index];
  out.vertices_on_edge.col(e) << right, left;
  out.edges_on_cell[lower][index] = e;
  // Edge j of a vertex joins its cells j - 1 and j.
  out.edges_on_vertex(next_vertex(vertex_at(surface.triangle_ids, left, lower)), left) = e;
  out.edges_on_vertex(vertex_at(surface.triangle_ids, right, lower), right) = e;
}

void set_cell(const Faces& surface, const Rings& rings, std::int32_t i,
              std::vector<Neighbour>& higher, Voronoi& out, FirstFault& twice) {
  const std::span<std::int32_t> vertices = out.vertices_on_cell[i], cells = out.cells_on_cell[i];
  std::size_t index = 0;
  higher.clear();
  walk_ring(surface, rings.first[i], i, [&](Corner corner) {
    const std::int32_t j = following_site(surface, corner);
    vertices[index] = corner.triangle;
    cells[index] = j;
    if (j > i)
      higher.push_back({j, index});
    ++index;
  });
  std::sort(higher.begin(), higher.end(),
            [](const Neighbour& a, const Neighbour& b) { return a.cell < b.cell; });
  std::int32_t e = rings.first_edge[i];
  for (std::size_t k = 0; k < higher.size(); ++k) {
    if (k > 0 && higher[k].cell == higher[k - 1].cell)
      twice.at(i);
    set_edge(surface, e++, i, higher[k].index, out);
  }
}

void set_cells_and_edges(const Faces& surface, const Rings& rings, Voronoi& out) {
  FirstFault twice;
  for_each_block(surface.sites(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::vector<Neighbour> higher;
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i)
      set_cell(surface, rings, i, higher, out, twice);
  });
  twice.refuse("cell",
               "shares two edges with one neighbour: give a mesh with more sites, or a wider "
               "box");
}

/// Sets the entries of edges that the lower cells have numbered.
void set_edges_of_higher_cells(const Faces& surface, Voronoi& out) {
  for_each_block(surface.sites(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      const std::span<const std::int32_t> cells = out.cells_on_cell[i];
      for (std::size_t index = 0; index != cells.size(); ++index)
        if (cells[index] < i) {
          const std::int32_t t = out.vertices_on_cell[i][index];
          out.edges_on_cell[i][index] =
              out.edges_on_vertex(next_vertex(vertex_at(surface.triangle_ids, t, i)), t);
        }
    }
  });
}

} // namespace

Rings find_rings(const Faces& surface, Voronoi& out) {
  Rings rings = count_rings(surface, out);
  Offsets& begin = out.edges_on_cell.begin;
  begin[surface.sites()] = 0;
  const std::int64_t found =
      exclusive_scan(std::span(begin.data(), static_cast<std::size_t>(begin.size())));
  if (found != surface.triangle_ids.size())
    refuse_second_ring(surface, out);
  exclusive_scan(std::span(rings.first_edge.begin(), rings.first_edge.end()));
  return rings;
}

void connect(const Faces& surface, const Rings& rings, Voronoi& out) {
  const std::int64_t corners = surface.triangle_ids.size(), edges = corners / 2;
  const Offsets& begins = out.edges_on_cell.begin;
  out.edges_on_cell.items.resize(corners);
  for (IdLists* const lists : {&out.vertices_on_cell, &out.cells_on_cell}) {
    lists->begin.resize(begins.size());
    lists->items.resize(corners);
    for_each_block(begins.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      std::copy(begins.data() + begin, begins.data() + end, lists->begin.data() + begin);
    });
  }
  out.edges_on_vertex.resize(3, surface.triangles());
  out.cells_on_edge.resize(2, edges);
  out.vertices_on_edge.resize(2, edges);
  set_cells_and_edges(surface, rings, out);
  set_edges_of_higher_cells(surface, out);
}

} // namespace calotte::voronoi_detail
