// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/vec3.h"
#include "exact/space.h"
#include "integrals/quads.h"
#include "integrals/room.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

using Triple = std::array<std::int32_t, 3>; ///< local numbers of a triangle's corners

/// Triangles of unit vectors.
struct SphericalTriangles {};

/// Triangles of positions with z = 0, in a periodic box or without one.
struct FlatTriangles {
  Plane space;
  double largest; ///< coordinate, or period
};

/// Up to `lanes` consecutive triangles; the last one fills the remaining lanes.
struct alignas(64) Batch {
  std::array<Rows3, 3> corner; ///< [vertex][x, y, z]; in the plane relative to the first one
  Rows3 rho;                   ///< [vertex]: the density there; set by gather_density()
  std::size_t count;
  const Triple* locals; ///< of the first
};

/// Corners a and b are nearly antipodal if 1 - |a-b|^2/4 is below this: the middle of an edge
/// between them is not well defined.
constexpr double antipodal = 0x1p-40;

/// Quantities derived from the corners, per edge or corner, named by the vertex across or there.
struct alignas(64) TriangleRows {
  Rows3 quarter;   ///< |a-b|^2/4 of the edge across
  Rows3 cotangent; ///< of the flat triangle's angle
  Rows3 normal;    ///< (b - a) x (c - a), [x, y, z]
  Row scale;       ///< 1/|normal|
  Row height;      ///< positive when counter-clockwise: the normal times a, in the plane its z
  /// Positive only if the triangle is certainly acute and counter-clockwise, and no two corners are
  /// nearly antipodal; in a periodic box, only if its circumcircle is also small compared with the
  /// box.
  Row clearance;
};

Batch gather(const SphericalTriangles&, std::span<const Triple> triangles, const Array<Vec3>& x,
             std::size_t first);
Batch gather(const FlatTriangles& plane, std::span<const Triple> triangles, const Array<Vec3>& x,
             std::size_t first);

/// Sets the density at the corners. \param rho by local number.
void gather_density(const Array<double>& rho, Batch& batch);

/// True if the clearance of all lanes is positive.
bool triangle_rows(const SphericalTriangles&, const Batch& batch, TriangleRows& out);
bool triangle_rows(const FlatTriangles& plane, const Batch& batch, TriangleRows& out);

/// The circumcentres of the flat triangles; in the plane relative to the first corner.
struct alignas(64) CentreRows {
  Rows3 centre;
  Row distance; ///< of the triangle's plane from the sphere's centre; 0 in the plane
};

CentreRows centre_rows(const SphericalTriangles&, const Batch& batch, const TriangleRows& rows);
CentreRows centre_rows(const FlatTriangles&, const Batch& batch, const TriangleRows& rows);

} // namespace calotte::integrals_detail
