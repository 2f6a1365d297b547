// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "view/quantities.h"
#include "view/view_mesh.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;

struct Hole {
  Eigen::Vector3d centre;
  double radius; ///< degrees
};

/// A triangulation of the sphere without the sites in holes, nor triangles at them.
ViewMesh sea(std::int64_t sites, const std::vector<Hole>& holes) {
  const Mesh whole = delaunay(fibonacci_sphere(sites));
  std::vector<std::int32_t> number;
  ViewMesh mesh;
  mesh.points.resize(3, sites);
  for (Eigen::Index i = 0; i < sites; ++i) {
    bool land = false;
    for (const Hole& hole : holes)
      land |= whole.points.col(i).dot(hole.centre) > std::cos(hole.radius * degree);
    number.push_back(land ? -1 : static_cast<std::int32_t>(mesh.cells));
    if (!land)
      mesh.points.col(mesh.cells++) = whole.points.col(i);
  }
  mesh.points.conservativeResize(3, mesh.cells);
  mesh.total = mesh.cells;
  mesh.triangles.resize(3, whole.triangles.cols());
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < whole.triangles.cols(); ++t) {
    const Eigen::Vector3i ids = whole.triangles.col(t).unaryExpr(
        [&](std::int32_t i) { return number[static_cast<std::size_t>(i)]; });
    if (ids.minCoeff() >= 0)
      mesh.triangles.col(count++) = ids;
  }
  mesh.triangles.conservativeResize(3, count);
  return mesh;
}

double area_of(const ViewMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles.colwise()) {
    const Eigen::Vector3d a = mesh.points.col(t[0]), b = mesh.points.col(t[1]),
                          c = mesh.points.col(t[2]);
    sum += 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return sum;
}

TEST_CASE("a thinned ocean has no cells on land") {
  const std::vector<Hole> lands{{Eigen::Vector3d::UnitX(), 40},
                                {Eigen::Vector3d::UnitY(), 12},
                                {Eigen::Vector3d(-1, 1, 1).normalized(), 6}};
  for (const std::int64_t most : {800, 3000}) {
    CAPTURE(most);
    ViewMesh mesh = sea(20'000, lands);
    const double area = area_of(mesh);
    thin(mesh, {}, most);
    CHECK(mesh.cells <= most);
    const double spacing = std::sqrt(4 * pi / static_cast<double>(most)) / degree;
    for (const auto& t : mesh.triangles.colwise()) {
      const Eigen::Vector3d middle =
          (mesh.points.col(t[0]) + mesh.points.col(t[1]) + mesh.points.col(t[2])).normalized();
      for (const Hole& land : lands)
        REQUIRE(middle.dot(land.centre) < std::cos((land.radius - 2) * degree));
    }
    // At the coast it has at most a spacing less than before.
    double coast = 0;
    for (const Hole& land : lands)
      coast += 2 * pi * std::sin(land.radius * degree);
    CHECK(area_of(mesh) < area);
    CHECK(area_of(mesh) > area - coast * 1.5 * spacing * degree);
  }
}

TEST_CASE("a thinned mesh of the whole sphere covers it") {
  ViewMesh mesh = sea(5000, {});
  thin(mesh, {}, 500);
  CHECK(mesh.triangles.cols() == 2 * mesh.cells - 4);
  CHECK(area_of(mesh) == doctest::Approx(4 * pi));
}

TEST_CASE("a field that is a ratio has no unit") {
  const auto unit = [](const std::string& units) {
    return quantity_of({.name = "a",
                        .long_name = "",
                        .units = units,
                        .location = FieldLocation::cells,
                        .values = Eigen::VectorXd::Ones(3)})
        .unit;
  };
  for (const char* ratio : {"1", "-", "", "none", "unitless", "dimensionless"})
    CHECK(unit(ratio).empty());
  for (const char* other : {"m", "1e-3", "K", "m s-1", "s^{-1}"})
    CHECK(unit(other) == other);
  CHECK(value_text(36416, unit("1")) == "3.642e+04");
}

} // namespace
