// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/geometry.h"

#include "base/double_double.h"
#include "base/elementary.h"
#include "base/matrix_memory.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "base/vec3.h"
#include "integrals/rows.h"
#include "voronoi/connectivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace calotte::voronoi_detail {
namespace {

// Operations per lane have no branches, so that the loops over lanes become vector code.

// ---- Elementary functions

constexpr double pi = std::numbers::pi;

/// The angle of (x, y) from the first axis, -pi to pi; 0 of the zero vector. Of any norm.
CALOTTE_INLINE double angle_of(double x, double y) {
  const double across = std::abs(y), along = std::abs(x);
  const bool steep = across > along;
  const double larger = steep ? across : along, smaller = steep ? along : across;
  const double acute = arc_tangent(larger > 0 ? smaller / larger : 0);
  const double above = steep ? pi / 2 - acute : acute;
  return std::copysign(x < 0 ? pi - above : above, y);
}

CALOTTE_INLINE double square(const Vec3& a) { return dot(a, a); }

CALOTTE_INLINE Vec3 choose(bool first, const Vec3& a, const Vec3& b) {
  return {first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z};
}

/// The direction of a vector of moderate norm; for a zero vector, a given direction.
CALOTTE_INLINE Vec3 direction_or(const Vec3& a, const Vec3& other) {
  const double s = square(a);
  const bool some = s > 1e-300;
  return choose(some, (1 / std::sqrt(some ? s : 1)) * a, other);
}

// ---- The two spaces

/// The half kites at an edge of a triangle: those at its two ends are mirror images.
struct HalfKite {
  double arc;  ///< signed, from the edge's middle to the circumcentre
  double area; ///< signed, of either
};

/// The unit sphere; places are unit vectors.
struct Sphere {
  Array<double> surplus; ///< by cell: by how much its norm exceeds 1

  /// Computed as if both points were exactly on the sphere: for a short edge, the rounding of norms
  /// is large.
  Vec3 difference(const Points3& cells, std::int32_t from, std::int32_t to) const {
    const Vec3 &a = column(cells, from), &b = column(cells, to);
    return (b - a) + (surplus[from] * a - surplus[to] * b);
  }

  /// \param normal (b - a) x (c - a) of a triangle; zero of a thin one.
  /// \param middle the flat triangle's circumcentre, from a.
  CALOTTE_INLINE Vec3 circumcentre(const Vec3& normal, const Vec3& a, const Vec3& middle) const {
    // The flat centre keeps the digits of small triangles; the normal keeps those of large ones,
    // whose flat centre is near the sphere's.
    const double outward = dot(normal, a);
    const bool flat = square(middle) < 0.25 || outward == 0;
    return direction_or(choose(flat, a + middle, std::copysign(1.0, outward) * normal), a);
  }
  /// Rounding can reverse a triangle whose corners are equal up to rounding.
  CALOTTE_INLINE double height(const Vec3& normal, const Vec3& a) const {
    return 2 * std::abs(dot(normal, a));
  }
  CALOTTE_INLINE HalfKite half_kite(const Vec3& a, const Vec3& difference, double product,
                                    double height) const {
    const double length = std::sqrt(square(difference));
    const double sum = std::sqrt(square((a + a) + difference));
    const double sine = length * product, hypotenuse = std::sqrt(sine * sine + height * height);
    const double divisor = hypotenuse + height;
    const double tangent = sine / (divisor > 0 ? divisor : 1);
    return {2 * arc_tangent(tangent), 2 * arc_tangent(length / (2 + sum) * tangent)};
  }
  CALOTTE_INLINE Vec3 midpoint(const Vec3& a, const Vec3& difference, const Vec3& centre) const {
    return direction_or((a + a) + difference, centre);
  }
  CALOTTE_INLINE double distance(const Vec3& a, const Vec3& difference) const {
    return 4 * arc_tangent(std::sqrt(square(difference)) /
                           (2 + std::sqrt(square((a + a) + difference))));
  }
  /// The angle from east, (-y, x, 0) over r = sqrt(x^2 + y^2), to north, (-x z, -y z, r^2) over r.
  CALOTTE_INLINE double angle(const Vec3& m, const Vec3& normal) const {
    const bool pole = m.x == 0 && m.y == 0;
    const double x = pole ? 1 : m.x, y = m.y;
    const double rise = pole ? 0 : normal.z;
    return angle_of(x * normal.y - y * normal.x,
                    rise * (x * x + y * y) - m.z * (x * normal.x + y * normal.y));
  }
};

/// A periodic plane; places are in its box.
struct Plane {
  double width, depth;

  static CALOTTE_INLINE double nearest(double difference, double period) {
    return difference - period * std::floor(difference / period + 0.5);
  }
  static CALOTTE_INLINE double wrapped(double x, double period) {
    const double inside = x - period * std::floor(x / period);
    return inside < period ? inside : 0; // rounding can reach it
  }
  CALOTTE_INLINE Vec3 place(const Vec3& p) const {
    return {wrapped(p.x, width), wrapped(p.y, depth), 0};
  }

  Vec3 difference(const Points3& cells, std::int32_t from, std::int32_t to) const {
    const Vec3 &a = column(cells, from), &b = column(cells, to);
    return {nearest(b.x - a.x, width), nearest(b.y - a.y, depth), 0};
  }
  CALOTTE_INLINE Vec3 circumcentre(const Vec3&, const Vec3& a, const Vec3& middle) const {
    return place(a + middle);
  }
  CALOTTE_INLINE double height(const Vec3& normal, const Vec3&) const {
    return 2 * std::abs(normal.z);
  }
  CALOTTE_INLINE HalfKite half_kite(const Vec3&, const Vec3& difference, double product,
                                    double height) const {
    const double length = std::sqrt(square(difference));
    const double arc = length * product / (height > 0 ? height : 1);
    return {arc, 0.25 * length * arc};
  }
  CALOTTE_INLINE Vec3 midpoint(const Vec3& a, const Vec3& difference, const Vec3&) const {
    return place(a + 0.5 * difference);
  }
  CALOTTE_INLINE double distance(const Vec3&, const Vec3& difference) const {
    return std::sqrt(square(difference));
  }
  CALOTTE_INLINE double angle(const Vec3&, const Vec3& normal) const {
    const double signed_angle = angle_of(normal.x, normal.y);
    const double turned = signed_angle < 0 ? signed_angle + 2 * pi : signed_angle;
    return turned < 2 * pi ? turned : 0;
  }
};

// ---- Triangles

/// Up to `lanes` triangles; the last fills the lanes that are left. [vertex], or [of the side
/// across from it].
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

template <class Space>
CALOTTE_INLINE void measure_triangle(const Space& space, TriangleBatch& batch, std::size_t lane) {
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
  put(space.circumcentre(choose(thin, {0, 0, 0}, normal), p, middle), batch.centre, lane);
  const double height = space.height(normal, p);
  put_half(space.half_kite(b, bc, thin ? 0 : -dot(ca, ab), height), 0, lane, batch);
  put_half(space.half_kite(c, ca, thin ? 0 : -dot(ab, bc), height), 1, lane, batch);
  put_half(space.half_kite(a, ab, thin ? 0 : -dot(bc, ca), height), 2, lane, batch);
}

CALOTTE_VECTOR_WIDTHS
void measure_triangles(const Sphere& space, TriangleBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_triangle(space, batch, lane);
}

CALOTTE_VECTOR_WIDTHS
void measure_triangles(const Plane& space, TriangleBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_triangle(space, batch, lane);
}

template <class Space>
void gather_triangles(const Space& space, const Voronoi& of, std::int64_t t, std::int64_t end,
                      TriangleBatch& batch) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::int32_t a = of.cells_on_vertex(0, t), b = of.cells_on_vertex(1, t),
                       c = of.cells_on_vertex(2, t);
    put(column(of.cells, a), batch.corner[0], lane);
    put(column(of.cells, b), batch.corner[1], lane);
    put(column(of.cells, c), batch.corner[2], lane);
    put(space.difference(of.cells, b, c), batch.side[0], lane);
    put(space.difference(of.cells, c, a), batch.side[1], lane);
    put(space.difference(of.cells, a, b), batch.side[2], lane);
    t = std::min(t + 1, end - 1);
  }
}

/// dv stores the arc to the left of an edge, and angle that to its right, until their sum is
/// computed.
void scatter_triangle(const TriangleBatch& batch, std::size_t lane, std::int64_t t, Voronoi& out) {
  set_column(out.vertices, t, at(batch.centre, lane));
  double sum = 0;
  for (int j = 0; j < 3; ++j) {
    const int before = previous_vertex(j), after = next_vertex(j);
    const double kite = batch.area[static_cast<std::size_t>(after)][lane] +
                        batch.area[static_cast<std::size_t>(before)][lane];
    out.kites(j, t) = kite;
    sum += kite;
    const bool left = out.cells_on_vertex(before, t) < out.cells_on_vertex(j, t);
    (left ? out.dv : out.angle)[out.edges_on_vertex(j, t)] =
        batch.arc[static_cast<std::size_t>(after)][lane];
  }
  out.vertex_area[t] = sum;
}

template <class Space> void set_vertices(const Space& space, Voronoi& out) {
  for_each_block(out.cells_on_vertex.cols(), [&](std::int64_t, std::int64_t begin,
                                                 std::int64_t end) {
    TriangleBatch batch;
    for (std::int64_t t = begin; t < end; t += lanes) {
      gather_triangles(space, out, t, end, batch);
      measure_triangles(space, batch);
      for (std::size_t lane = 0; lane < lanes && t + static_cast<std::int64_t>(lane) < end; ++lane)
        scatter_triangle(batch, lane, t + static_cast<std::int64_t>(lane), out);
    }
  });
}

// ---- Edges

struct alignas(64) EdgeBatch {
  Rows3 cell, normal; ///< the lower cell, and the way from it to the other
  Rows3 centre;       ///< a vertex
  Rows3 middle;
  Row left, right; ///< arcs
  Row dc, dv, angle;
};

template <class Space>
CALOTTE_INLINE void measure_edge(const Space& space, EdgeBatch& batch, std::size_t lane) {
  const Vec3 a = at(batch.cell, lane), normal = at(batch.normal, lane);
  const Vec3 middle = space.midpoint(a, normal, at(batch.centre, lane));
  put(middle, batch.middle, lane);
  batch.dc[lane] = space.distance(a, normal);
  batch.angle[lane] = space.angle(middle, normal);
  const double arc = batch.left[lane] + batch.right[lane];
  batch.dv[lane] = arc > 0 ? arc : 0;
}

CALOTTE_VECTOR_WIDTHS
void measure_edges(const Sphere& space, EdgeBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_edge(space, batch, lane);
}

CALOTTE_VECTOR_WIDTHS
void measure_edges(const Plane& space, EdgeBatch& batch) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t lane = 0; lane < lanes; ++lane)
    measure_edge(space, batch, lane);
}

template <class Space>
void gather_edges(const Space& space, const Voronoi& of, std::int64_t e, std::int64_t end,
                  EdgeBatch& batch) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::int32_t a = of.cells_on_edge(0, e);
    put(column(of.cells, a), batch.cell, lane);
    put(space.difference(of.cells, a, of.cells_on_edge(1, e)), batch.normal, lane);
    put(column(of.vertices, of.vertices_on_edge(1, e)), batch.centre, lane);
    batch.left[lane] = of.dv[e];
    batch.right[lane] = of.angle[e];
    e = std::min(e + 1, end - 1);
  }
}

template <class Space> void set_edges(const Space& space, Voronoi& out) {
  for_each_block(out.cells_on_edge.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    EdgeBatch batch;
    for (std::int64_t first = begin; first < end; first += lanes) {
      gather_edges(space, out, first, end, batch);
      measure_edges(space, batch);
      const std::int64_t last = std::min(first + static_cast<std::int64_t>(lanes), end);
      for (std::int64_t e = first; e < last; ++e) {
        const auto lane = static_cast<std::size_t>(e - first);
        set_column(out.edges, e, at(batch.middle, lane));
        out.dc[e] = batch.dc[lane];
        out.dv[e] = batch.dv[lane];
        out.angle[e] = batch.angle[lane];
      }
    }
  });
}

// ---- Cells

void set_cell_areas(Voronoi& out) {
  for_each_block(out.cells.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      double area = 0;
      for (std::int64_t place = out.begin[i]; place != out.begin[i + 1]; ++place) {
        const std::int32_t t = out.vertices_on_cell[place];
        area += out.kites(vertex_at(out.cells_on_vertex, t, i), t);
      }
      out.cell_area[i] = area;
    }
  });
}

/// The amount by which the norms of unit columns exceed 1, to a few digits.
Array<double> surplus_of(const Points3& cells) {
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

/// body(space) of the tessellation's.
template <class Body> void in_space(const Voronoi& of, const Body& body) {
  if (of.on_sphere)
    body(Sphere{surplus_of(of.cells)});
  else
    body(Plane{of.period[0], of.period[1]});
}

} // namespace

void measure_vertices(Voronoi& out) {
  const std::int64_t edges = out.cells_on_edge.cols(), vertices = out.cells_on_vertex.cols();
  make_room(out.vertices, 3, vertices);
  make_room(out.vertex_area, vertices, 1);
  make_room(out.kites, 3, vertices);
  make_room(out.dv, edges, 1);
  make_room(out.angle, edges, 1);
  in_space(out, [&](const auto& space) { set_vertices(space, out); });
}

void measure_edges_and_cells(Voronoi& out) {
  make_room(out.edges, 3, out.cells_on_edge.cols());
  make_room(out.dc, out.cells_on_edge.cols(), 1);
  make_room(out.cell_area, out.cells.cols(), 1);
  in_space(out, [&](const auto& space) { set_edges(space, out); });
  set_cell_areas(out);
}

void measure(Voronoi& out) {
  measure_vertices(out);
  measure_edges_and_cells(out);
}

} // namespace calotte::voronoi_detail
