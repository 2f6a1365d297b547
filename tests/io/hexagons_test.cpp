// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/files.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;

namespace {

const double root3 = std::sqrt(3.0);

double remainder_of(double x, double period) { return period > 0 ? std::remainder(x, period) : x; }

/// The distance of nearest copies.
double apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector2d& period) {
  return std::hypot(remainder_of(a.x() - b.x(), period.x()),
                    remainder_of(a.y() - b.y(), period.y()));
}

/// How many cells there are at each corner, each with the right distance from all.
std::map<int, int> cells_at_corners(const Polygons& polygons, double spacing) {
  std::vector<int> count(static_cast<std::size_t>(polygons.corners.cols()));
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    CHECK(polygons.ids.count(i) == 6);
    for (const std::int32_t corner : polygons.ids[i]) {
      ++count[static_cast<std::size_t>(corner)];
      CHECK(apart(polygons.corners.col(corner), polygons.centres.col(i),
                  polygons.surface.period()) == doctest::Approx(spacing / root3));
    }
  }
  std::map<int, int> out;
  for (const int cells : count)
    ++out[cells];
  return out;
}

std::string refusal_of_hexagons(std::int64_t columns, std::int64_t rows, double spacing,
                                Walls walls = {}) {
  try {
    planar_hexagons(columns, rows, spacing, walls);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("hexagons of a box lie where planar_hex puts them, moved into the period") {
  const double d = 1234.5;
  const MeshFile file = planar_hexagons(6, 8, d);
  REQUIRE(file.plane());
  const Mesh& mesh = *file.plane();
  const Eigen::Vector2d& period = mesh.surface.period();
  CHECK(period.x() == 6 * d);
  CHECK(period.y() == doctest::Approx(8 * d * root3 / 2).epsilon(1e-15));
  CHECK(check(mesh).failure == "");
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 6; ++column) {
      const Eigen::Vector3d expected(d * (column + (row % 2 == 0 ? 0.5 : 1)),
                                     d * (row + 1) * root3 / 2, 0);
      CHECK(apart(mesh.points.col(6 * row + column), expected, period) < 1e-9);
    }
  const Voronoi cells = voronoi(mesh);
  CHECK((cells.dc.array() - d).abs().maxCoeff() < 1e-9 * d);
  CHECK((cells.dv.array() - d / root3).abs().maxCoeff() < 1e-9 * d);
}

TEST_CASE("at walls cells are whole hexagons, as planar_hex has them after its cull") {
  const double d = 10;
  // A channel of 5 x 4 cells: corners of 3 cells inside; of 2 and 1 along the two zigzag walls, one
  // of each for a cell.
  const MeshFile channel = planar_hexagons(5, 4, d, {.y = true});
  REQUIRE(channel.polygons);
  CHECK(channel.polygons->size() == 20);
  CHECK(channel.polygons->surface.period() == Eigen::Vector2d(50, 0));
  CHECK(cells_at_corners(*channel.polygons, d) ==
        std::map<int, int>{{3, 2 * 5 * 3}, {2, 2 * 5}, {1, 2 * 5}});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 5; ++column) { // row + 1 of 6 in planar_hex
      const Eigen::Vector3d expected(d * (column + (row % 2 == 0 ? 1 : 0.5)),
                                     d * (row + 2) * root3 / 2, 0);
      const Eigen::Vector3d centre = channel.polygons->centres.col(5 * row + column);
      CHECK(apart(centre, expected, channel.polygons->surface.period()) < 1e-12);
      CHECK(centre.y() == doctest::Approx(expected.y()).epsilon(1e-15));
      CHECK((centre.x() >= 0 && centre.x() < 50));
    }
  CHECK(areas(*channel.polygons).sum() == doctest::Approx(20 * root3 / 2 * d * d));
  // An odd number of rows needs no period in y.
  CHECK(cells_at_corners(*planar_hexagons(3, 5, d, {.y = true}).polygons, d)[3] == 2 * 3 * 4);
  // Walls in x, whose corners of one cell are those at both ends of each row.
  const MeshFile upright = planar_hexagons(4, 6, d, {.x = true});
  CHECK(upright.polygons->surface.period().x() == 0);
  CHECK(upright.polygons->surface.period().y() == doctest::Approx(6 * d * root3 / 2));
  CHECK(upright.polygons->size() == 24);
  // All around: Euler's formula for one outer boundary, V - E + F = 1.
  const MeshFile all = planar_hexagons(4, 6, d, {true, true});
  CHECK(all.polygons->surface.period() == Eigen::Vector2d(0, 0));
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (std::int64_t i = 0; i < 24; ++i)
    for (std::size_t k = 0; k < 6; ++k) {
      const std::int32_t a = all.polygons->ids[i][k], b = all.polygons->ids[i][(k + 1) % 6];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  CHECK(all.polygons->corners.cols() - std::ssize(edges) + 24 == 1);
}

TEST_CASE("an MPAS file of a channel keeps its cells, and passes its check") {
  const test::Scratch scratch;
  for (const Walls walls : {Walls{.y = true}, Walls{.x = true}, Walls{true, true}}) {
    CAPTURE(walls.x);
    CAPTURE(walls.y);
    const std::string path = scratch / "channel.nc";
    const MeshFile made = planar_hexagons(6, 4, 500, walls);
    write(path, made, {});
    const MeshFile read = read_mesh_file(path);
    REQUIRE(read.plane());
    REQUIRE(read.polygons);
    CHECK(read.mesh->surface.period() == made.polygons->surface.period());
    CHECK(read.polygons->centres == made.polygons->centres);
    CHECK(read.polygons->size() == 24);
    CHECK((areas(*read.polygons).array() / (root3 / 2 * 500 * 500) - 1).abs().maxCoeff() < 1e-12);
    CHECK(check_file(path, read_mesh_file(path)).empty());
    CHECK(count_edges(*read.mesh).not_delaunay == 0);
    const Eigen::VectorXd dc = read_cell_field(path, "areaCell", 24).values;
    CHECK((dc.array() / (root3 / 2 * 500 * 500) - 1).abs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("hexagons out of range are refused") {
  CHECK(refusal_of_hexagons(6, 5, 1) ==
        "hexagons of 6 columns and 5 rows: give at least 3 columns and 4 rows, "
        "an even number for the period in y");
  CHECK(refusal_of_hexagons(6, 5, 1, {.y = true}) == "");
  CHECK(refusal_of_hexagons(2, 4, 1) != "");
  CHECK(refusal_of_hexagons(2, 4, 1, {.x = true}) == "");
  CHECK(refusal_of_hexagons(6, 1, 1, {.y = true}) != "");
  CHECK(refusal_of_hexagons(1 << 20, 1 << 10, 1) ==
        "hexagons of 1048576 columns and 1024 rows are more than 268435456; give fewer");
  for (const double spacing : {0.0, -1.0, 1e300, std::nan("")})
    CHECK(refusal_of_hexagons(6, 6, spacing) ==
          "the distance of the hexagons must be from 1e-20 to 1e20");
}

TEST_CASE("between walls stay the cells whose sites are there, with corners beside them") {
  const Surface box = Surface::periodic({10, 8});
  const Mesh mesh = delaunay(random_points(400, box, {}, 3), box);
  const Voronoi cells = voronoi(mesh);
  const MeshFile file = walled(mesh, {10, 6}, {.y = true});
  REQUIRE(file.polygons);
  CHECK(file.polygons->surface.period() == Eigen::Vector2d(10, 0));
  std::int64_t next = 0;
  const Eigen::VectorXd found = areas(*file.polygons);
  for (Eigen::Index i = 0; i < 400; ++i)
    if (mesh.points(1, i) <= 6) {
      CHECK(file.polygons->centres.col(next) == mesh.points.col(i));
      CHECK(found[next] == doctest::Approx(cells.cell_area[i]).epsilon(1e-9));
      ++next;
    }
  CHECK(next == file.polygons->size());
  CHECK(file.polygons->corners.row(1).minCoeff() < 0); // beside the cells at the lower wall
  CHECK_THROWS_AS(walled(mesh, {10, 6}, {}), Error);
  CHECK_THROWS_AS(walled(mesh, {10, 8}, {.y = true}), Error);
}
