// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/sanitizer.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

// Sites so close together that rounding makes the circumcaps of their triangles useless in doubles.

using namespace calotte;

namespace {

/// n sites within a square of that half width around a unit vector, on a lattice where `lattice`.
Points3 cluster(const Eigen::Vector3d& centre, Eigen::Index n, double width, bool lattice = false) {
  const Points3 random = random_sphere(n, 7);
  const Eigen::Vector3d east = centre.unitOrthogonal(), north = centre.cross(east);
  const auto side = static_cast<Eigen::Index>(std::sqrt(static_cast<double>(n)));
  const auto step = [&](Eigen::Index i) {
    return 2 * static_cast<double>(i) / static_cast<double>(side) - 1;
  };
  Points3 points(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = lattice ? step(i % side) : random(0, i),
                 y = lattice ? step(i / side) : random(1, i);
    points.col(i) = centre + width * (x * east + y * north);
  }
  return points;
}

Points3 beside(const Points3& a, const Points3& b) {
  Points3 both(3, a.cols() + b.cols());
  both << a, b;
  return both;
}

DelaunayOptions regions(int count, RegionOverlap overlap = RegionOverlap::halo) {
  DelaunayOptions options;
  options.decomposition.regions = count;
  options.decomposition.overlap = overlap;
  return options;
}

const Eigen::Vector3d here = Eigen::Vector3d(1, 2, 3).normalized();

/// The mesh of one region, from caps.
void check_caps(const Points3& points, int count, RegionOverlap overlap = RegionOverlap::halo) {
  CAPTURE(count);
  CAPTURE(static_cast<int>(overlap));
  const auto [mesh, report] = triangulate(points, {}, regions(count, overlap));
  CHECK_FALSE(report.serial);
  const Mesh whole = delaunay(points, {}, regions(1));
  CHECK((mesh.triangles == whole.triangles));
  CHECK((mesh.neighbours == whole.neighbours));
  CHECK(mesh.closed());
}

} // namespace

TEST_CASE("a cluster within one region or over several does not make the run serial") {
  const Points3 others = random_sphere(8000, 3);
  const std::vector<double> widths =
      test::sanitized ? std::vector{1e-6, 1e-15} : std::vector{1e-6, 1e-9, 1e-11, 1e-13, 1e-15};
  for (const double width : widths) {
    CAPTURE(width);
    const Points3 few = beside(others, cluster(here, 500, width)),
                  many = beside(others, cluster(here, 3000, width));
    check_caps(few, 12);
    check_caps(many, 42);
    check_caps(many, 42, RegionOverlap::distance);
  }
}

TEST_CASE("a lattice in a cluster, and clusters in several places") {
  const Points3 others = random_sphere(12000, 3);
  check_caps(beside(others, cluster(here, 2500, 1e-9, true)), 42);
  const Points3 two = beside(cluster(here, 1500, 1e-10), cluster(-here, 1500, 1e-12));
  check_caps(beside(others, two), 42);
  const Eigen::Vector3d near = (here + 1e-7 * here.unitOrthogonal()).normalized();
  check_caps(beside(others, beside(cluster(here, 1500, 1e-11), cluster(near, 1500, 1e-11))), 42);
}

TEST_CASE("a cluster that holds most sites, or alone, has the mesh of one region") {
  for (const Eigen::Index others : {4, 100, 1000}) {
    CAPTURE(others);
    const Points3 points = beside(random_sphere(others, 3), cluster(here, 3000, 1e-9));
    const Mesh mesh = delaunay(points, {}, regions(24)), whole = delaunay(points, {}, regions(1));
    CHECK((mesh.triangles == whole.triangles));
    CHECK((mesh.neighbours == whole.neighbours));
  }
}

TEST_CASE("in the plane, too") {
  for (const double width : {1e-6, 1e-9, 1e-12, 1e-14}) {
    CAPTURE(width);
    Points2 points(2, 11000);
    points << random_sphere(8000, 3).topRows<2>(),
        (width * random_sphere(3000, 4).topRows<2>()).colwise() + Eigen::Vector2d(0.3, 0.2);
    const Mesh mesh = delaunay(points, Surface::plane(), regions(42)),
               whole = delaunay(points, Surface::plane(), regions(1));
    CHECK((mesh.triangles == whole.triangles));
    CHECK((mesh.neighbours == whole.neighbours));
  }
}

TEST_CASE("the mesh of a cluster passes the exact check") {
  const Points3 points = beside(random_sphere(3000, 3), cluster(here, 1000, 1e-12));
  CHECK(check(delaunay(points, {}, regions(24))).passed());
}
