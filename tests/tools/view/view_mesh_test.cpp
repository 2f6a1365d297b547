// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "view/quantities.h"
#include "view/view_mesh.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
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

using Corners = std::set<std::array<std::int32_t, 3>>;

/// The triangles of a mesh by the numbers of their cells.
Corners corners_of(const ViewMesh& mesh) {
  Corners corners;
  for (const auto& t : mesh.triangles.colwise()) {
    std::array<std::int32_t, 3> cells{};
    for (int v = 0; v < 3; ++v) {
      const std::int32_t cell =
          t[v] < mesh.cells ? t[v] : mesh.copied[static_cast<std::size_t>(t[v] - mesh.cells)];
      cells[static_cast<std::size_t>(v)] =
          mesh.number.empty() ? cell : mesh.number[static_cast<std::size_t>(cell)];
    }
    std::rotate(cells.begin(), std::min_element(cells.begin(), cells.end()), cells.end());
    corners.insert(cells);
  }
  return corners;
}

/// The cells that triangles of a mesh touch, and the number of triangles at each.
std::map<std::int32_t, int> stars_of(const Corners& corners) {
  std::map<std::int32_t, int> stars;
  for (const auto& cells : corners)
    for (const std::int32_t cell : cells)
      ++stars[cell];
  return stars;
}

/// A value for each cell, of which those of the last cells are worst.
Quantity numbered(std::int64_t cells) {
  return {.name = "rank",
          .worst = Worst::high,
          .values = DoubleVector::LinSpaced(cells, 0, static_cast<double>(cells - 1))};
}

TEST_CASE("a part of a mesh has true triangles around its place and its worst cells") {
  const ViewMesh all = sea(20'000, {{Eigen::Vector3d::UnitX(), 40},
                                    {Eigen::Vector3d::UnitY(), 12},
                                    {Eigen::Vector3d(-1, 1, 1).normalized(), 6}});
  const Corners corners = corners_of(all);
  const std::map<std::int32_t, int> stars = stars_of(corners);
  for (const std::int64_t most : {20, 800, 3000}) {
    CAPTURE(most);
    ViewMesh part = all;
    part.home = Eigen::Vector3d(-1, 0.2, -0.3).normalized();
    part.quantities = {numbered(all.cells)};
    thin(part, most);
    CHECK(part.cells <= std::max<std::int64_t>(most, 13));
    CHECK(part.cells >= most / 2);
    CHECK(part.total == all.cells);
    for (std::int64_t i = 0; i < part.cells; ++i) {
      const std::int32_t number = part.number[static_cast<std::size_t>(i)];
      CHECK(part.points.col(i) == all.points.col(number));
      CHECK(part.quantities[0].values[i] == number);
    }
    const Corners kept = corners_of(part);
    CHECK(std::includes(corners.begin(), corners.end(), kept.begin(), kept.end()));
    CHECK(part.quantities[0].values[part.cells - 1] == all.cells - 1);
    if (most < 800)
      continue;
    const std::map<std::int32_t, int> kept_stars = stars_of(kept);
    const auto is_whole = [&](Eigen::Index cell) {
      return kept_stars.contains(static_cast<int>(cell)) &&
             kept_stars.at(static_cast<int>(cell)) == stars.at(static_cast<int>(cell));
    };
    Eigen::Index nearest = 0;
    (all.points.colwise() - *part.home).colwise().squaredNorm().minCoeff(&nearest);
    CHECK(is_whole(nearest));
    for (Eigen::Index worst = all.cells - 10; worst < all.cells; ++worst)
      CHECK(is_whole(worst));
  }
}

TEST_CASE("cells that no triangle or shape surrounds are spread over the mesh") {
  ViewMesh mesh = sea(5000, {});
  const Points3 points = mesh.points;
  thin(mesh, 500);
  double farthest = 0; // from the nearest cell of the part
  for (const auto& point : points.colwise())
    farthest = std::max(farthest, (mesh.points.colwise() - point).colwise().norm().minCoeff());
  CHECK(farthest < 3 * std::sqrt(4 * pi / 500));
}

TEST_CASE("a part of a periodic box has copies of its cells only") {
  const Surface box = Surface::periodic({2, 1});
  Points3 sites = Points3::Zero(3, 200);
  for (Eigen::Index i = 0; i < 200; ++i)
    sites.col(i).head(2) << std::fmod(0.618034 * static_cast<double>(i), 2), (i + 0.5) / 200;
  const Mesh mesh = delaunay(sites, box);
  ViewMesh all{.on_sphere = false, .cells = 200, .total = 200};
  set_plane(all, mesh);
  ViewMesh part = all;
  part.quantities = {numbered(200)};
  thin(part, 150);
  const Corners corners = corners_of(all), kept = corners_of(part);
  CHECK(!kept.empty());
  CHECK(std::includes(corners.begin(), corners.end(), kept.begin(), kept.end()));
  REQUIRE(part.shapes);
  CHECK(part.shapes->size() == part.cells);
  std::int64_t whole = 0;
  for (std::int64_t i = 0; i < part.cells; ++i) {
    const std::int32_t cell = part.number[static_cast<std::size_t>(i)];
    if (part.shapes->ids.count(i) == 0)
      continue;
    ++whole;
    REQUIRE(part.shapes->ids.count(i) == all.shapes->ids.count(cell));
    for (std::int64_t k = 0; k < part.shapes->ids.count(i); ++k)
      CHECK(part.shapes->corners.col(
                std::as_const(*part.shapes).ids[i][static_cast<std::size_t>(k)]) ==
            all.shapes->corners.col(all.shapes->ids[cell][static_cast<std::size_t>(k)]));
  }
  CHECK(whole >= 15);
  CHECK(whole < part.cells);
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
