// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/laws.h"

#include <calotte/mesh.h>

#include <doctest/doctest.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

/// The laws of a planar mesh as assertions, in rational arithmetic and without the library's
/// predicates.
namespace calotte::test::plane_laws {

/// A row x, y, x^2 + y^2, 1.
using LiftedRow = std::array<mpq_class, 4>;

inline LiftedRow lifted(const PointsRef& points, std::int32_t i) {
  const mpq_class x(points(0, i)), y(points(1, i));
  return {x, y, x * x + y * y, 1};
}

/// Determinant of three rows without one of their columns.
inline mpq_class minor_of(const LiftedRow& a, const LiftedRow& b, const LiftedRow& c,
                          std::size_t without) {
  std::array<std::size_t, 3> k{};
  for (std::size_t j = 0, n = 0; j < 4; ++j)
    if (j != without)
      k[n++] = j;
  const auto [x, y, z] = k;
  return a[x] * (b[y] * c[z] - b[z] * c[y]) - a[y] * (b[x] * c[z] - b[z] * c[x]) +
         a[z] * (b[x] * c[y] - b[y] * c[x]);
}

inline int orientation(const PointsRef& points, const Triple& t) {
  return sgn(minor_of(lifted(points, t[0]), lifted(points, t[1]), lifted(points, t[2]), 2));
}

/// The sign of the determinant of the four lifted rows; if it is 0, its first non-zero derivative
/// with respect to the lifts of the sites in the order of (x, y).
inline int in_circle_resolved(const PointsRef& points, const Triple& t, std::int32_t d) {
  const std::array<std::int32_t, 4> site{t[0], t[1], t[2], d};
  std::array<LiftedRow, 4> row;
  for (std::size_t r = 0; r < 4; ++r)
    row[r] = lifted(points, site[r]);
  const auto cofactor = [&](std::size_t r, std::size_t column) -> mpq_class {
    std::array<std::size_t, 3> others{};
    for (std::size_t j = 0, n = 0; j < 4; ++j)
      if (j != r)
        others[n++] = j;
    const mpq_class value = minor_of(row[others[0]], row[others[1]], row[others[2]], column);
    return (r + column) % 2 == 0 ? value : mpq_class(-value);
  };
  mpq_class determinant = 0;
  for (std::size_t r = 0; r < 4; ++r)
    determinant += cofactor(r, 2) * row[r][2];
  if (sgn(determinant) != 0)
    return sgn(determinant);
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) {
    return std::pair(row[p][0], row[p][1]) < std::pair(row[q][0], row[q][1]);
  });
  for (const std::size_t r : order)
    if (const int sign = sgn(cofactor(r, 2)))
      return sign;
  return 0;
}

/// Law 1: every triangle is counter-clockwise, and no site is inside a circumcircle. Up to 50 sites
/// all are tested; beyond, the site across each edge, which implies the others.
inline void require_exact(const Mesh& mesh) {
  const auto n = static_cast<std::int32_t>(mesh.points.cols());
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    const Triple own = triple(mesh, t);
    CAPTURE(t);
    REQUIRE(orientation(mesh.points, own) > 0);
    if (n <= 50) {
      for (std::int32_t d = 0; d < n; ++d)
        if (std::find(own.begin(), own.end(), d) == own.end())
          REQUIRE(in_circle_resolved(mesh.points, own, d) < 0);
      continue;
    }
    for (int i = 0; i < 3; ++i)
      if (const std::int32_t other = mesh.neighbours(i, t); other >= 0) {
        const Triple across = triple(mesh, other);
        for (const std::int32_t d : across)
          if (std::find(own.begin(), own.end(), d) == own.end())
            REQUIRE(in_circle_resolved(mesh.points, own, d) < 0);
      }
  }
}

/// The edges of one triangle only, each by its start.
inline std::map<std::int32_t, std::int32_t> boundary_of(const Mesh& mesh) {
  std::map<std::int32_t, std::int32_t> next;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < 0)
        REQUIRE(
            next.emplace(mesh.triangles((i + 1) % 3, t), mesh.triangles((i + 2) % 3, t)).second);
  return next;
}

/// Law 4: canonical order, mutual neighbours, every site a vertex, Euler's formula, and one
/// boundary that nowhere turns right: that of the convex hull.
inline void require_whole(const Mesh& mesh) {
  const std::int64_t n = mesh.points.cols(), m = mesh.triangles.cols();
  std::vector<bool> is_vertex(static_cast<std::size_t>(n), false);
  for (std::int64_t t = 0; t < m; ++t) {
    const Triple own = triple(mesh, t);
    REQUIRE(own[0] < std::min(own[1], own[2]));
    if (t > 0)
      REQUIRE(triple(mesh, t - 1) < own);
    for (int i = 0; i < 3; ++i) {
      is_vertex[static_cast<std::size_t>(own[static_cast<std::size_t>(i)])] = true;
      const std::int32_t other = mesh.neighbours(i, t);
      if (other < 0)
        continue;
      const auto back = mesh.neighbours.col(other);
      const int j = back(0) == t ? 0 : back(1) == t ? 1 : 2;
      REQUIRE(back(j) == t);
      REQUIRE(mesh.triangles((j + 1) % 3, other) == mesh.triangles((i + 2) % 3, t));
      REQUIRE(mesh.triangles((j + 2) % 3, other) == mesh.triangles((i + 1) % 3, t));
    }
  }
  REQUIRE(std::find(is_vertex.begin(), is_vertex.end(), false) == is_vertex.end());
  const std::map<std::int32_t, std::int32_t> next = boundary_of(mesh);
  REQUIRE(m == 2 * n - 2 - std::ssize(next));
  std::int64_t length = 0;
  std::int32_t a = next.begin()->first;
  do {
    const std::int32_t b = next.at(a), c = next.at(b);
    REQUIRE(orientation(mesh.points, {a, b, c}) >= 0);
    a = b;
    ++length;
  } while (a != next.begin()->first);
  REQUIRE(length == std::ssize(next));
}

} // namespace calotte::test::plane_laws
