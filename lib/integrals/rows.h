// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "base/vec3.h"
#include "integrals/patches.h"
#include "integrals/quads.h"
#include "integrals/room.h"

#include <array>
#include <cstddef>
#include <vector>

namespace calotte::integrals_detail {

/// Triangles are processed in batches of this size, each quantity in a row: loops over the lanes of
/// rows become vector code, and the rows stay in the first-level cache.
constexpr std::size_t lanes = 32;

using Row = std::array<double, lanes>;
using Rows3 = std::array<Row, 3>;

template <class Rows> CALOTTE_INLINE Vec3 at(const Rows& rows, std::size_t lane) {
  return {rows[0][lane], rows[1][lane], rows[2][lane]};
}

template <class Rows> CALOTTE_INLINE void put(const Vec3& value, Rows& rows, std::size_t lane) {
  rows[0][lane] = value.x;
  rows[1][lane] = value.y;
  rows[2][lane] = value.z;
}

/// Four triples of doubles, each followed by one more double.
struct FourColumns {
  const void *a, *b, *c, *d;
};

/// Sets four lanes of rows to the triples.
/// \param last set to the doubles that follow them.
CALOTTE_INLINE void put_columns(const FourColumns& columns, std::size_t lane, Rows3& rows,
                                Quad& last) {
  Quad a = quad_at(columns.a).value, b = quad_at(columns.b).value, c = quad_at(columns.c).value,
       d = quad_at(columns.d).value;
  transpose(a, b, c, d);
  quad_at(rows[0].data() + lane).value = a;
  quad_at(rows[1].data() + lane).value = b;
  quad_at(rows[2].data() + lane).value = c;
  last = d;
}

/// Up to `lanes` consecutive triangles of a patch; the last fills the lanes that are left.
struct alignas(64) Batch {
  std::array<Rows3, 3> corner; ///< [vertex][x, y, z]
  Rows3 rho;                   ///< [vertex]: the density there; set by gather_density()
  std::size_t count;
  const std::array<std::int32_t, 3>* locals; ///< of the first: local numbers of its corners
};

/// Corners a and b are nearly antipodal if 1 - |a-b|^2/4 is below this: an edge between them hardly
/// has a middle.
constexpr double antipodal = 0x1p-40;

/// Quantities derived from the corners, per edge or corner, named by the vertex across or there.
struct alignas(64) TriangleRows {
  Rows3 quarter;   ///< |a-b|^2/4 of the edge across
  Rows3 cotangent; ///< of the flat triangle's angle
  Rows3 normal;    ///< (b - a) x (c - a), [x, y, z]
  Row scale;       ///< 1/|normal|
  Row height;      ///< normal times a: positive when counter-clockwise
  /// Positive only if the triangle is certainly acute and counter-clockwise, and no two corners are
  /// nearly antipodal.
  Row clearance;
};

/// An edge's half, from its end to its middle, and the signed arc from there to the circumcentre.
struct HalfEdge {
  double sine, cosine; ///< of half of the edge's arc
  double arc, tangent; ///< the signed arc, and the tangent of half of it
};

/// A triangle whose circumcentre follows from digits that its corners as stored do not have; see
/// slivers.h.
struct Sliver {
  std::size_t lane;
  std::array<Vec3, 3> side; ///< unit vectors along b - c, c - a and a - b
  std::array<HalfEdge, 3> half;
};

/// The contribution of each edge, named by the vertex across, to both of its ends, for rho = 1.
struct alignas(64) EdgeRows {
  Rows3 pull; ///< delta / (2 |a-b|): the first moment's part is that times (a - b) for a
  Rows3 energy, area;
};

/// The coordinates of what edges add to the first moments of a triangle's corners, each of them x,
/// y or z. \param Value a double, or several lanes.
template <class Value>
CALOTTE_INLINE std::array<Value, 3> pulled(const std::array<Value, 3>& corner,
                                           const std::array<Value, 3>& pull) {
  const Value of_a = pull[0] * (corner[1] - corner[2]), of_b = pull[1] * (corner[2] - corner[0]),
              of_c = pull[2] * (corner[0] - corner[1]);
  return {of_c - of_b, of_a - of_c, of_b - of_a};
}

/// A vertex is an end of the two edges that are named by the others.
template <class Value>
CALOTTE_INLINE std::array<Value, 3> sums_at_ends(const std::array<Value, 3>& of_edges) {
  return {of_edges[1] + of_edges[2], of_edges[2] + of_edges[0], of_edges[0] + of_edges[1]};
}

/// What triangles add to the moments of one of their corners.
struct alignas(64) VertexTerms {
  Rows3 first;
  Row energy, mass;
};
using TriangleTerms = std::array<VertexTerms, 3>;

Batch gather(const Patch& patch, const Array<Vec3>& x, std::size_t first);

/// Sets the density at the corners. \param rho by local number.
void gather_density(const Array<double>& rho, Batch& batch);

/// True if the clearance of all lanes is positive.
bool triangle_rows(const Batch& batch, TriangleRows& out);

/// As triangle_rows() and edge_rows() without the areas, in less time. True if the rows are set:
/// the clearance of all lanes is positive, and no edge is long.
/// \param rows for intermediate results.
bool small_edge_rows(const Batch& batch, TriangleRows& rows, EdgeRows& edges);

/// \param with_area otherwise edges.area is not set.
void edge_rows(const TriangleRows& rows, bool with_area, EdgeRows& edges);

/// Terms for rho = 1.
/// \param slivers of the batch: their sides and halves take the place of the rows.
/// \param with_mass otherwise the masses are not set.
void uniform_terms(const Batch& batch, EdgeRows& edges, const std::vector<Sliver>& slivers,
                   bool with_mass, TriangleTerms& terms);

} // namespace calotte::integrals_detail
