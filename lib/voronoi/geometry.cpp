// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/geometry.h"

#include "base/array.h"
#include "base/double_double.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "base/vec3.h"
#include "integrals/rows.h"
#include "voronoi/connectivity.h"
#include "voronoi/dual_measures.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace calotte::voronoi_detail {
namespace {

using namespace dual;

// ---- Triangles

/// Up to `lanes` triangles; the last one fills the remaining lanes. Arrays of three are indexed by
/// vertex, or by the vertex across from a side.
struct alignas(64) TriangleBatch {
  std::array<Rows3, 3> corner;
  std::array<Rows3, 3> side; ///< from the next vertex to the one before
  Rows3 centre;
  Rows3 arc, area; ///< of the side's half kites
};

CALOTTE_INLINE void put_half(const HalfKite& half, std::size_t across, std::size_t lane,
                             TriangleBatch& batch) {
  batch.arc[across][lane] = half.arc;
  batch.area[across][lane] = half.area;
}

template <class Measures>
CALOTTE_INLINE void measure_triangle(const Measures& measures, TriangleBatch& batch,
                                     std::size_t lane) {
  const Vec3 a = at(batch.corner[0], lane), b = at(batch.corner[1], lane),
             c = at(batch.corner[2], lane);
  const Vec3 bc = at(batch.side[0], lane), ca = at(batch.side[1], lane),
             ab = at(batch.side[2], lane);
  // The corner p across from the longest side gives the normal with the most digits.
  const double across_a = square(bc), across_b = square(ca), across_c = square(ab);
  const bool at_a = across_a >= across_b && across_a >= across_c, at_b = across_b >= across_c;
  const Vec3 p = choose(at_a, a, choose(at_b, b, c)), next = choose(at_a, ab, choose(at_b, bc, ca)),
             before = -choose(at_a, ca, choose(at_b, ab, bc));
  const Vec3 normal = cross(next, before);
  const double squared = square(normal), nn = square(next), bb = square(before);
  const bool thin = !(squared > 1e-200);
  const Vec3 middle = choose(thin, 0.5 * choose(nn > bb, next, before),
                             (0.5 / (thin ? 1 : squared)) * cross(nn * before - bb * next, normal));
  put(measures.circumcentre(choose(thin, {0, 0, 0}, normal), p, middle), batch.centre, lane);
  const double height = measures.height(normal, p);
  put_half(measures.half_kite(b, bc, thin ? 0 : -dot(ca, ab), height), 0, lane, batch);
  put_half(measures.half_kite(c, ca, thin ? 0 : -dot(ab, bc), height), 1, lane, batch);
  put_half(measures.half_kite(a, ab, thin ? 0 : -dot(bc, ca), height), 2, lane, batch);
}

CALOTTE_VECTOR_WIDTHS
void measure_triangles(const SphereMeasures& measures, TriangleBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_triangle(measures, batch, lane);
}

CALOTTE_VECTOR_WIDTHS
void measure_triangles(const PlaneMeasures& measures, TriangleBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_triangle(measures, batch, lane);
}

template <class Measures>
void gather_triangles(const Measures& measures, const Points3& cells, const Triangles& triangles,
                      std::int64_t t, std::int64_t end, TriangleBatch& batch) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::int32_t a = triangles(0, t), b = triangles(1, t), c = triangles(2, t);
    put(column(cells, a), batch.corner[0], lane);
    put(column(cells, b), batch.corner[1], lane);
    put(column(cells, c), batch.corner[2], lane);
    put(measures.difference(cells, b, c), batch.side[0], lane);
    put(measures.difference(cells, c, a), batch.side[1], lane);
    put(measures.difference(cells, a, b), batch.side[2], lane);
    t = std::min(t + 1, end - 1);
  }
}

/// Calls body(batch, lane, t) for triangles begin to end - 1, measured.
template <class Measures, class Body>
void measure_each(const Measures& measures, const Points3& cells, const Triangles& triangles,
                  std::int64_t begin, std::int64_t end, const Body& body) {
  TriangleBatch batch;
  for (std::int64_t first = begin; first < end; first += lanes) {
    gather_triangles(measures, cells, triangles, first, end, batch);
    measure_triangles(measures, batch);
    const std::int64_t last = std::min(first + static_cast<std::int64_t>(lanes), end);
    for (std::int64_t t = first; t < last; ++t)
      body(batch, static_cast<std::size_t>(t - first), t);
  }
}

/// dv stores the arc to the left of an edge, and dc that to its right, until measure_edges()
/// computes their sum.
void scatter_triangle(const TriangleBatch& batch, std::size_t lane, std::int64_t t, Voronoi& out) {
  for (int j = 0; j < 3; ++j) {
    const int before = previous_vertex(j), after = next_vertex(j);
    out.kites(j, t) = batch.area[static_cast<std::size_t>(after)][lane] +
                      batch.area[static_cast<std::size_t>(before)][lane];
    const bool left = out.cells_on_vertex(before, t) < out.cells_on_vertex(j, t);
    (left ? out.dv : out.dc)[out.edges_on_vertex(j, t)] =
        batch.arc[static_cast<std::size_t>(after)][lane];
  }
}

template <class Measures>
void set_vertices(const Measures& measures, std::int64_t begin, std::int64_t end, Voronoi& out,
                  Vec3* positions) {
  measure_each(measures, out.cells, out.cells_on_vertex, begin, end,
               [&](const TriangleBatch& batch, std::size_t lane, std::int64_t t) {
                 positions[t - begin] = at(batch.centre, lane);
                 scatter_triangle(batch, lane, t, out);
               });
}

template <class Measures>
Vec3 circumcentre(const Measures& measures, const Voronoi& of, std::int64_t triangle) {
  TriangleBatch batch;
  gather_triangles(measures, of.cells, of.cells_on_vertex, triangle, triangle + 1, batch);
  measure_triangles(measures, batch);
  return at(batch.centre, 0);
}

// ---- Edges

struct alignas(64) EdgeBatch {
  Rows3 cell, normal; ///< the lower cell, and the way from it to the other
  Rows3 centre;       ///< the vertex to the left if the cells are opposite; else unused
  Rows3 middle;
  Row left, right; ///< arcs
  Row dc, dv, angle;
};

template <class Measures>
CALOTTE_INLINE void measure_edge(const Measures& measures, EdgeBatch& batch, std::size_t lane) {
  const Vec3 a = at(batch.cell, lane), normal = at(batch.normal, lane);
  const Vec3 middle = measures.midpoint(a, normal, at(batch.centre, lane));
  put(middle, batch.middle, lane);
  batch.dc[lane] = measures.distance(a, normal);
  batch.angle[lane] = measures.angle(middle, normal);
  const double arc = batch.left[lane] + batch.right[lane];
  batch.dv[lane] = arc > 0 ? arc : 0;
}

CALOTTE_VECTOR_WIDTHS
void measure_edges(const SphereMeasures& measures, EdgeBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_edge(measures, batch, lane);
}

CALOTTE_VECTOR_WIDTHS
void measure_edges(const PlaneMeasures& measures, EdgeBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_edge(measures, batch, lane);
}

/// The vertex to the left of an edge's normal.
std::int32_t left_vertex(const Voronoi& of, std::int64_t edge) {
  const std::int32_t cell = of.cells_on_edge(0, edge);
  std::size_t index = 0;
  while (of.edges_on_cell[cell][index] != edge)
    ++index;
  return of.vertices_on_cell[cell][index];
}

template <class Measures>
void gather_edges(const Measures& measures, const Voronoi& of, std::int64_t e, std::int64_t end,
                  EdgeBatch& batch) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::int32_t a = of.cells_on_edge(0, e);
    const Vec3 cell = column(of.cells, a);
    const Vec3 normal = measures.difference(of.cells, a, of.cells_on_edge(1, e));
    const bool opposite = !(square((cell + cell) + normal) > 1e-290);
    put(cell, batch.cell, lane);
    put(normal, batch.normal, lane);
    put(opposite ? circumcentre(measures, of, left_vertex(of, e)) : cell, batch.centre, lane);
    batch.left[lane] = of.dv[e];
    batch.right[lane] = of.dc[e];
    e = std::min(e + 1, end - 1);
  }
}

template <class Measures>
void set_edges(const Measures& measures, std::int64_t begin, std::int64_t end, Voronoi& out,
               Vec3* positions, double* angles) {
  EdgeBatch batch;
  for (std::int64_t first = begin; first < end; first += lanes) {
    gather_edges(measures, out, first, end, batch);
    measure_edges(measures, batch);
    const std::int64_t last = std::min(first + static_cast<std::int64_t>(lanes), end);
    for (std::int64_t e = first; e < last; ++e) {
      const auto lane = static_cast<std::size_t>(e - first);
      positions[e - begin] = at(batch.middle, lane);
      angles[e - begin] = batch.angle[lane];
      out.dc[e] = batch.dc[lane];
      out.dv[e] = batch.dv[lane];
    }
  }
}

/// Calls body(measures) with the measures of the tessellation's space.
template <class Body>
void with_measures(const Surface& surface, const Array<double>& surplus, const Body& body) {
  if (surface.is_sphere())
    body(SphereMeasures{surplus});
  else
    body(PlaneMeasures{surface.period()[0], surface.period()[1]});
}

/// The columns of points from `first` on.
Vec3* columns(Points3& points, std::int64_t first) {
  return reinterpret_cast<Vec3*>(points.data()) + first;
}

} // namespace

void measure_areas(Voronoi& out) {
  out.cell_area.resize(out.cells.cols());
  for_each_block(out.cells.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      double area = 0;
      for (const std::int32_t t : out.vertices_on_cell[i])
        area += out.kites(vertex_at(out.cells_on_vertex, t, i), t);
      out.cell_area[i] = area;
    }
  });
}

Array<double> surplus_of(const Surface& surface, const Points3& cells) {
  if (!surface.is_sphere())
    return {};
  Array<double> surplus(cells.cols());
  for_each_block(cells.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3& x = column(cells, i);
      const DoubleDouble square =
          two_product(x.x, x.x) + two_product(x.y, x.y) + two_product(x.z, x.z);
      surplus[i] = 0.5 * ((square.hi - 1) + square.lo);
    }
  });
  return surplus;
}

Array<double> begin_measures(Voronoi& out) {
  out.kites.resize(3, out.cells_on_vertex.cols());
  out.dv.resize(out.cells_on_edge.cols());
  out.dc.resize(out.cells_on_edge.cols());
  return surplus_of(out.surface, out.cells);
}

void measure_half_kites(const Surface& surface, const Points3& cells, const Array<double>& surplus,
                        const Triangles& triangles, std::int64_t begin, std::int64_t end,
                        HalfKites* out) {
  with_measures(surface, surplus, [&](const auto& measures) {
    measure_each(measures, cells, triangles, begin, end,
                 [&](const TriangleBatch& batch, std::size_t lane, std::int64_t t) {
                   for (std::size_t j = 0; j < 3; ++j)
                     out[t - begin][j] = {batch.arc[j][lane], batch.area[j][lane]};
                 });
  });
}

void measure_vertices(const Array<double>& surplus, std::int64_t begin, std::int64_t end,
                      Voronoi& out, Vec3* positions) {
  with_measures(out.surface, surplus,
                [&](const auto& measures) { set_vertices(measures, begin, end, out, positions); });
}

void measure_edges(const Array<double>& surplus, std::int64_t begin, std::int64_t end, Voronoi& out,
                   Vec3* positions, double* angles) {
  with_measures(out.surface, surplus, [&](const auto& measures) {
    set_edges(measures, begin, end, out, positions, angles);
  });
}

void measure(Voronoi& out) {
  const std::int64_t edges = out.cells_on_edge.cols(), vertices = out.cells_on_vertex.cols();
  const Array<double> surplus = begin_measures(out);
  out.vertices.resize(3, vertices);
  out.vertex_area.resize(vertices);
  for_each_block(vertices, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    measure_vertices(surplus, begin, end, out, columns(out.vertices, begin));
    for (std::int64_t t = begin; t != end; ++t)
      out.vertex_area[t] = vertex_area(out, t);
  });
  out.edges.resize(3, edges);
  out.angle.resize(edges);
  for_each_block(edges, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    measure_edges(surplus, begin, end, out, columns(out.edges, begin), out.angle.data() + begin);
  });
  measure_areas(out);
}

} // namespace calotte::voronoi_detail
