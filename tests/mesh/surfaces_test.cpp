// SPDX-License-Identifier: GPL-3.0-or-later
// Functions take all surfaces, and their errors say what to do.
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/text.h"

#include <calotte/calotte.h>

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using calotte::test::equal_bits;
using calotte::test::error_of;

namespace {

const Surface rectangle_of = rectangle({0, 0}, {2, 1});
const Surface box_of = Surface::periodic({2, 1});

Surface cap() { return circle({0.2, 0.3, 0.9}, 0.8, 60); }

/// A box, and a part of the plane.
struct Case {
  Surface domain;
  Mesh old; ///< of the plane without rings

  Mesh mesh() const { return delaunay(old.points.topRows<2>(), domain); }
};

std::vector<Case> planes() {
  return {{rectangle_of, delaunay(random_points(300, rectangle_of, {}, 5), Surface::plane())},
          {box_of, delaunay(random_points(300, box_of, {}, 6), box_of)}};
}

/// Rows of triangles between walls along x.
Mesh channel() {
  const Mesh box = hexagonal_box(8, 6, 1);
  std::vector<oracle::Triple> triangles;
  for (const auto& t : box.triangles.colwise()) {
    const Eigen::Vector3d y(box.points(1, t[0]), box.points(1, t[1]), box.points(1, t[2]));
    if (y.maxCoeff() - y.minCoeff() < 2)
      triangles.push_back({t[0], t[1], t[2]});
  }
  Mesh mesh = oracle::mesh_of(box.points, std::move(triangles));
  mesh.surface = Surface::periodic({8, 0});
  return mesh;
}

std::vector<Mesh> all_planes() {
  std::vector<Mesh> meshes{channel(), hexagonal_box(4, 4, 1)};
  for (const Case& plane : planes())
    meshes.push_back(plane.mesh());
  return meshes;
}

void check_same(const Mesh& mesh, const Mesh& old) {
  CHECK(equal_bits(mesh.points, old.points));
  CHECK(mesh.triangles == old.triangles);
  CHECK(mesh.neighbours == old.neighbours);
  CHECK(mesh.site_of_input == old.site_of_input);
}

Density bump() { return tanh_bump({0.7, 0.4, 0.5}, 0.3, 0.2, 0.1); }

} // namespace

TEST_CASE("points of a sphere are read in place, evaluated or taken over") {
  Points3 points = random_sphere(200, 3);
  const Mesh old = delaunay(points);
  const Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> row_major = points;
  const Eigen::MatrixXd any = points;
  check_same(delaunay(points), old);
  check_same(delaunay(any), old);
  check_same(delaunay(row_major), old);
  check_same(delaunay(Eigen::Map<const Points3>(points.data(), 3, 200)), old);
  check_same(delaunay(2 * points / 2), old);
  check_same(delaunay(PointsRef(points)), old);
  check_same(delaunay(random_sphere(200, 3)), old);
  const Triangulation both = triangulate(points, cap());
  check_same(both.mesh, old);
  CHECK(both.report.sites == 200);
  CHECK(both.mesh.surface == cap());
  const double* const memory = points.data();
  CHECK(delaunay(std::move(points)).points.data() == memory);
}

TEST_CASE("meshes of the plane have the triangles of the plane's own functions, and z = 0") {
  for (const Case& plane : planes()) {
    const Mesh mesh = plane.mesh();
    check_same(mesh, plane.old);
    CHECK(mesh.surface == plane.domain);
    CHECK(mesh.closed() == plane.domain.is_box());
    check_same(delaunay(mesh.points, plane.domain), mesh); // 3 rows
    check_same(delaunay(Points3(mesh.points), plane.domain), mesh);
  }
  const Mesh hexagons = hexagonal_box(8, 6, 0.5);
  check_same(hexagons, delaunay(hexagons.points, hexagons.surface));
}

TEST_CASE("meshes of the plane are proven, and searched for positions with or without z") {
  for (Mesh mesh : all_planes()) {
    CHECK(check(mesh).failure == "");
    CHECK(check(mesh).area == doctest::Approx(check(mesh).expected_area));
    CHECK(check_surface(mesh).passed());
    const Points3 at = random_points(100, Surface::periodic({4, 3}));
    const Locations with_z = locate(mesh, at), without = locate(mesh, at.topRows<2>());
    CHECK(without.triangle == with_z.triangle);
    CHECK(equal_bits(without.weights, with_z.weights));
    CHECK(without.nearest == with_z.nearest);
    const auto kind = Interpolation::natural_neighbours;
    CHECK(interpolation_weights(mesh, at.topRows<2>(), kind)
              .isApprox(interpolation_weights(mesh, at, kind), 0));
    CHECK(triangle_quality(mesh).angles.max == open_quality(mesh).angles.max);
    const Mesh other = renumbered(mesh, Numbering::curve);
    CHECK(check(other).failure == "");
    CHECK(other.surface == mesh.surface);
    mesh.points(2, 7) = 1;
    CHECK(check(mesh).failure == "site 7 of the plane has a z that is not 0");
  }
}

TEST_CASE("cells and quality are those of the surface") {
  for (const Case& plane : planes()) {
    const Mesh mesh = plane.mesh();
    const Voronoi cells = voronoi(mesh);
    CHECK(cells.cell_area.sum() == doctest::Approx(mesh.surface.area()).epsilon(1e-12));
    for (const Density& density : {Density(), bump()}) {
      const Quality measured = quality(mesh, density);
      CHECK(measured.cells == 300);
      CHECK(measured.cells_area == doctest::Approx(1).epsilon(1e-12));
      CHECK(equal_bits(cell_measures(mesh, density).area, cells.cell_area));
      CHECK(operator_errors(mesh, density).by_cell.divergence.size() == 300);
    }
    const std::vector<bool> clipped = clipped_cells(mesh);
    CHECK((std::count(clipped.begin(), clipped.end(), true) > 0) == mesh.surface.is_bounded());
  }
  Mesh part = delaunay(random_points(300, cap(), {}, 4), cap());
  CHECK(voronoi(part).cell_area.sum() / cap().area() == doctest::Approx(1).epsilon(1e-12));
  part.surface = {};
  CHECK(clipped_cells(part) == std::vector<bool>(300, false));
}

TEST_CASE("points and densities are those of the surface") {
  CHECK(equal_bits(random_points(50, {}), random_sphere(50)));
  CHECK(equal_bits(random_points(50, {}, bump(), 3), random_sphere(50, bump(), 3)));
  for (const Case& plane : planes()) {
    const Surface surface = plane.domain;
    const Points3 points = random_points(50, surface, bump(), 3);
    CHECK(points.row(2).isZero(0));
    for (const Points3& places : {points, hexagonal_lattice(40, surface)})
      for (const auto& place : places.colwise())
        CHECK(surface.contains(place));
    const DoubleVector rho = evaluate(bump(), points, surface);
    CHECK(rho == evaluate(bump(), points.topRows<2>(), surface));
    CHECK(evaluate(site_density(bump(), surface), points).isApprox(rho.cwiseSqrt(), 1e-14));
    const Mesh mesh = plane.mesh();
    for (const Points3& places : {bisect(mesh), split_and_collapse(mesh, bump(), 9, 5)}) {
      CHECK(places.row(2).isZero(0));
      for (const auto& place : places.colwise())
        CHECK(surface.contains(place));
    }
    const Raster widths{Eigen::Vector2d(0, 2), Eigen::Vector2d(0, 1),
                        Eigen::MatrixXd::Constant(2, 2, 0.1), true};
    CHECK(implied_cells(widths, surface) == doctest::Approx(400 / std::numbers::sqrt3));
    CHECK_NOTHROW(require_covering(widths, surface));
  }
  const Raster widths{Eigen::Vector3d(-120, 0, 120), Eigen::Vector2d(-80, 80),
                      Eigen::MatrixXd::Constant(3, 2, 300)};
  CHECK(with_rings(cap(), widths).area() > cap().area());
  CHECK_NOTHROW(require_covering(widths));
  for (const double bad : {0.0, -300.0, std::nan("")}) {
    Raster spoilt = widths;
    spoilt.values(1, 0) = bad;
    CHECK_THROWS_WITH_AS(with_rings(cap(), spoilt),
                         "cell width: value (1, 0) is not positive and finite; correct it", Error);
  }
  CHECK_THROWS_AS(with_rings(cap(), Raster{widths.x, widths.y, widths.values, true}), Error);
}

TEST_CASE("midpoints stay on the surface") {
  const Mesh part = delaunay(random_points(100, cap(), {}, 4), cap());
  const Points3 finer = bisect(part), exchanged = split_and_collapse(part, {}, 20, 0);
  CHECK(finer.cols() > 300);
  for (const Points3& points : {finer, exchanged})
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      CHECK(part.surface.contains(points.col(i)));
  const Mesh walls = channel();
  const Points3 fine = bisect(walls);
  CHECK(fine.cols() == walls.points.cols() + count_edges(walls).edges);
  CHECK((fine.row(0).array() >= 0 && fine.row(0).array() < 8).all());
  CHECK(fine.row(1).maxCoeff() == walls.points.row(1).maxCoeff());
}

TEST_CASE("values at the sites of a mesh are a density of its surface") {
  for (const Mesh& mesh : all_planes()) {
    const Eigen::VectorXd rho = (mesh.points.row(1).array() + 1).pow(2).transpose();
    const Density density = interpolated_density(mesh, rho);
    CHECK((evaluate(density, mesh.points, mesh.surface) - rho).cwiseAbs().maxCoeff() < 1e-12);
    const Points3 at = random_points(200, rectangle_of);
    const Eigen::VectorXd widths = rho.array().pow(-0.25),
                          found = evaluate(density, at, mesh.surface).array().pow(-0.25),
                          known = interpolate(interpolation_weights(mesh, at), widths);
    for (Eigen::Index i = 0; i < at.cols(); ++i)
      if (known[i] == known[i]) // inside
        CHECK(found[i] == doctest::Approx(known[i]).epsilon(1e-12));
  }
}

TEST_CASE("errors name the point and the remedy") {
  const Surface box = box_of, plane = Surface::plane(), walls = Surface::periodic({1, 0});
  Points3 points = random_points(20, box);
  points(2, 4) = 0.5;
  const auto names = [](const std::function<void()>& work, const std::string& part) {
    const std::string text = error_of(work).what();
    CAPTURE(text);
    CHECK(test::has(text, part));
  };
  for (const Surface& surface : {box, plane})
    CHECK(error_of([&] { delaunay(points, surface); }).index() == 4);
  CHECK(error_of([&] { evaluate({}, points, plane); }).index() == 4);
  CHECK(error_of([&] { locate(hexagonal_box(4, 4, 1), points); }).index() == 4);
  points.row(2).setZero();
  names([&] { delaunay(points, walls); }, "make_grid()");
  names([&] { delaunay(points.topRows<2>()); }, "a surface of the plane");
  names([&] { delaunay(Eigen::MatrixXd(4, 9), plane); }, "or 3 x n with z = 0");
  names([&] { voronoi(delaunay(points, plane)); }, "give two positive periods");
  names([&] { quality(delaunay(points, plane)); }, "give rings");
  names([&] { random_points(9, plane); }, "give rings");
  names([&] { random_points(9, walls); }, "give rings");
  CHECK(error_of([&] { voronoi(delaunay(points, rectangle({0, 0}, {2, 0.5}))); }).index() >= 0);
  names([&] { hexagonal_lattice(9, Surface()); }, "give one of the plane");
  CHECK(boundary_points(plane, 99).cols() == 0);
  names([&] { line_points({}, plane, 99); }, "give rings");
  names([&] { clipped_cells(delaunay(random_sphere(9), cap())); }, "region of the sphere");
}
