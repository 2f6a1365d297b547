// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "mesh/adjacency.h"
#include "mesh/subdivide.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <array>

using namespace calotte;
using namespace calotte::mesh_detail;

namespace {

/// Checks the places of the parts of each triangle in a subdivision: one part at each vertex and
/// one in the middle, whose vertices are the midpoints of the edges.
void check_parts(const Mesh& mesh, const Points3& points, const Connectivity& parts) {
  const std::int64_t n = mesh.points.cols();
  REQUIRE(parts.triangles.cols() == 4 * mesh.triangles.cols());
  REQUIRE(parts.neighbours.cols() == parts.triangles.cols());
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t middle = parts.triangles(i, 4 * t + 3), a = mesh.triangles((i + 1) % 3, t),
                         b = mesh.triangles((i + 2) % 3, t);
      REQUIRE(middle >= n);
      REQUIRE(middle < points.cols());
      const Eigen::Vector3d sum = mesh.points.col(a) + mesh.points.col(b);
      REQUIRE((points.col(middle) - sum.normalized()).norm() < 1e-14);
      REQUIRE(parts.triangles(0, 4 * t + i) == mesh.triangles(i, t));
      REQUIRE(parts.triangles(1, 4 * t + i) == parts.triangles((i + 2) % 3, 4 * t + 3));
      REQUIRE(parts.triangles(2, 4 * t + i) == parts.triangles((i + 1) % 3, 4 * t + 3));
    }
}

Points3 northern(std::int64_t n) {
  Points3 points = random_sphere(n, 3);
  points.row(2) = points.row(2).cwiseAbs().array() + 0.01;
  return points.colwise().normalized();
}

} // namespace

TEST_CASE("a closed mesh, and an open one, is cut at the midpoints that bisect() gives") {
  for (const Points3& points : {random_sphere(4), random_sphere(5000, 2), cubed_sphere(6),
                                bisected_icosahedron(2), northern(400)}) {
    const Mesh mesh = delaunay(points);
    const Points3 fine = bisect(mesh);
    const Connectivity parts = subdivided(mesh.triangles, mesh.neighbours, mesh.points.cols());
    check_parts(mesh, fine, parts);
    CHECK(parts.neighbours == neighbours_of(parts.triangles, fine.cols()));
  }
}

TEST_CASE("in a periodic box neighbours are mutual and share an edge") {
  const Mesh mesh = hexagonal_box(4, 4, 1);
  const Connectivity parts = subdivided(mesh.triangles, mesh.neighbours, mesh.points.cols());
  REQUIRE(parts.triangles.cols() == 8 * 16);
  CHECK(parts.triangles.maxCoeff() == 4 * 16 - 1);
  for (Eigen::Index t = 0; t < parts.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t u = parts.neighbours(i, t);
      int shared = 0;
      for (int k = 0; k < 3; ++k)
        shared += parts.neighbours(k, u) == t &&
                  parts.triangles((k + 1) % 3, u) == parts.triangles((i + 2) % 3, t) &&
                  parts.triangles((k + 2) % 3, u) == parts.triangles((i + 1) % 3, t);
      REQUIRE(shared == 1);
    }
}
