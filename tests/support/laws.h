// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/exact.h"
#include "support/oracle.h"

#include <calotte/check.h>
#include <calotte/mesh.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

/// The laws of a mesh as assertions. They do not use lib/mesh/check.cpp, so that each tests the
/// other.
namespace calotte::test {

using oracle::site;
using oracle::Triple;

inline Triple triple(const Mesh& mesh, std::int64_t t) {
  return {mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
}

template <class Matrix> bool same_bits(const Matrix& a, const Matrix& b) {
  return a.cols() == b.cols() &&
         (a.size() == 0 ||
          std::memcmp(a.data(), b.data(), sizeof(*a.data()) * static_cast<std::size_t>(a.size())) ==
              0);
}

/// Equal to the last bit.
inline bool identical(const Mesh& a, const Mesh& b) {
  return same_bits(a.points, b.points) && same_bits(a.triangles, b.triangles) &&
         same_bits(a.neighbours, b.neighbours) && a.site_of_input == b.site_of_input;
}

/// Law 1, exact: every triangle is counter-clockwise; no site is inside a circumcap, ties by the
/// rule. Up to 60 sites all are tested; beyond, the site across each edge, which implies the
/// others.
inline void require_exact(const Mesh& mesh) {
  const auto n = static_cast<std::int32_t>(mesh.points.cols());
  const auto inside = [&](const Triple& t, std::int32_t d) {
    return exact::in_circle_resolved({}, site(mesh.points, t[0]), site(mesh.points, t[1]),
                                     site(mesh.points, t[2]), site(mesh.points, d)) >= 0;
  };
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    const Triple own = triple(mesh, t);
    CAPTURE(t);
    REQUIRE(exact::orientation(site(mesh.points, own[0]), site(mesh.points, own[1]),
                               site(mesh.points, own[2])) > 0);
    if (n <= 60)
      for (std::int32_t d = 0; d < n; ++d)
        REQUIRE((std::find(own.begin(), own.end(), d) != own.end() || !inside(own, d)));
    else
      for (int i = 0; i < 3; ++i) {
        const std::int32_t other = mesh.neighbours(i, t);
        for (int j = 0; other > t && j < 3; ++j)
          REQUIRE((std::find(own.begin(), own.end(), mesh.triangles(j, other)) != own.end() ||
                   !inside(own, mesh.triangles(j, other))));
      }
  }
}

/// Each triangle starts at its lowest vertex, and they ascend.
inline void require_canonical(const Mesh& mesh) {
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    const Triple own = triple(mesh, t);
    REQUIRE((own[0] < own[1] && own[0] < own[2] && own[1] != own[2]));
    REQUIRE((t == 0 || triple(mesh, t - 1) < own));
  }
}

/// The sum of the triangles' areas in long doubles, by the sines of half angles.
inline double total_area(const Mesh& mesh) {
  using LongVector = Eigen::Matrix<long double, 3, 1>;
  const auto unit = [&](std::int32_t i) -> LongVector {
    const LongVector p = mesh.points.col(i).cast<long double>();
    return p / p.norm();
  };
  long double sum = 0;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    const LongVector a = unit(mesh.triangles(0, t)), b = unit(mesh.triangles(1, t)),
                     c = unit(mesh.triangles(2, t));
    const LongVector p = b - a, q = c - a;
    sum += 2 * std::atan2(std::max(a.dot(p.cross(q)), 0.0L), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return static_cast<double>(sum);
}

/// Law 4, whole: each edge in two triangles, as neighbours says, or in one along an open boundary
/// that is one polygon; every site a vertex; the numbers of triangles; Euler's characteristic;
/// areas.
inline void require_whole(const Mesh& mesh, bool closed) {
  const std::int64_t n = mesh.points.cols(), m = mesh.triangles.cols();
  std::map<std::pair<std::int32_t, std::int32_t>, std::int64_t> triangle_of_edge;
  std::vector<bool> used(static_cast<std::size_t>(n));
  for (std::int64_t t = 0; t < m; ++t)
    for (int i = 0; i < 3; ++i) {
      used[static_cast<std::size_t>(mesh.triangles(i, t))] = true;
      REQUIRE(triangle_of_edge
                  .insert({{mesh.triangles((i + 1) % 3, t), mesh.triangles((i + 2) % 3, t)}, t})
                  .second);
    }
  CHECK(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
  std::map<std::int32_t, std::int32_t> next_on_boundary;
  for (std::int64_t t = 0; t < m; ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = mesh.triangles((i + 1) % 3, t), b = mesh.triangles((i + 2) % 3, t);
      const auto twin = triangle_of_edge.find({b, a});
      REQUIRE(mesh.neighbours(i, t) == (twin == triangle_of_edge.end() ? -1 : twin->second));
      if (twin == triangle_of_edge.end())
        REQUIRE(next_on_boundary.insert({a, b}).second);
    }
  const auto boundary = static_cast<std::int64_t>(next_on_boundary.size());
  CHECK((boundary == 0) == closed);
  CHECK(mesh.closed() == closed);
  CHECK(m == 2 * n - (closed ? 4 : 2 + boundary));
  CHECK(n - (3 * m + boundary) / 2 + m == (closed ? 2 : 1));
  if (closed) {
    // Each area of the long doubles errs by some 2^-60; near-antipodal edges are worse.
    CHECK(std::abs(total_area(mesh) - 4 * std::numbers::pi) < 1e-9);
    return;
  }
  std::int64_t walked = 1;
  const std::int32_t start = next_on_boundary.begin()->first;
  for (std::int32_t at = next_on_boundary[start]; at != start && walked <= boundary; ++walked)
    at = next_on_boundary[at];
  CHECK(walked == boundary);
}

inline void require_laws(const Mesh& mesh, bool closed) {
  require_canonical(mesh);
  require_whole(mesh, closed);
  require_exact(mesh);
  CHECK(check(mesh).failure == "");
}

/// The mesh with its sites renumbered: site i of `mesh` is site `to[i]` of the result.
inline Mesh renumbered(const Mesh& mesh, const std::vector<std::int32_t>& to) {
  Points3 points(3, mesh.points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(to[static_cast<std::size_t>(i)]) = mesh.points.col(i);
  std::vector<Triple> triangles;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    Triple own = triple(mesh, t);
    for (std::int32_t& vertex : own)
      vertex = to[static_cast<std::size_t>(vertex)];
    triangles.push_back(own);
  }
  return oracle::mesh_of(points, std::move(triangles));
}

} // namespace calotte::test
