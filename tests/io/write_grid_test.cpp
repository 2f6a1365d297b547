// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/full_disk.h"
#include "support/made.h"

#include <calotte/cut.h>
#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/write_grid.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>

using namespace calotte;
using test::Scratch;

namespace {

Recipe graded() {
  return {
      .cells = 400, .resolution = tanh_bump({0, 0, 1}, 0.5, 0.3, 0.1), .stop = {.iterations = 3}};
}

Recipe limited_area() {
  return {.resolution = Raster{Eigen::Vector2d(0, 180), Eigen::Vector2d(-90, 90),
                               Eigen::MatrixXd::Constant(2, 2, 500)},
          .surface = circle({1, 2, 2}, 0.3, 24),
          .limited_area = true,
          .stop = {.iterations = 3}};
}

/// Cells are smaller towards y = 0.
Recipe between_walls() {
  Recipe recipe{.cells = 200, .surface = Surface::periodic({2, 1}), .walls = {.y = true}};
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = 1 / (1 + x.row(1).array().abs()).square();
  };
  recipe.resolution = density;
  return recipe;
}

} // namespace

TEST_CASE("the mesh of the whole sphere is written with the density of its recipe") {
  const Scratch scratch;
  Made made(graded());
  WriteOptions options;
  options.density = made.schedule.density;
  write(scratch / "whole.nc", made.mesh, options);
  const std::string expected = calotte::test::read_file(scratch / "whole.nc");
  const GridFile file = write_grid(scratch / "whole.nc", made.mesh, made.recipe, made.schedule);
  CHECK(file.cells == 400);
  CHECK(file.inside == 400);
  CHECK(calotte::test::read_file(scratch / "whole.nc") == expected);
  write_grid(scratch / "whole.nc", std::move(made.mesh), made.recipe, made.schedule);
  CHECK(calotte::test::read_file(scratch / "whole.nc") == expected);
  CHECK(made.mesh.points.cols() == 0);
}

TEST_CASE("a limited area is the region and its rings") {
  const Scratch scratch;
  const Made made(limited_area());
  const GridFile file = write_grid(scratch / "area.nc", made.mesh, made.recipe, made.schedule);
  const std::string written = calotte::test::read_file(scratch / "area.nc");
  const WriteOptions of_widths{.planet_radius = 1000 * made.recipe.radius_km};
  const CutReport report =
      write_limited_area(scratch / "area.nc", made.mesh, made.recipe.surface, of_widths);
  CHECK(file.cells == report.cells);
  CHECK(file.inside == report.cells_by_mask.front());
  CHECK(file.inside < file.cells);
  CHECK(file.cells < made.mesh.points.cols());
  CHECK(written == calotte::test::read_file(scratch / "area.nc"));
  { // in a folder that has room for it alone
    const calotte::test::FullDisk full(written.size());
    write_limited_area(scratch / "area.nc", made.mesh, made.recipe.surface, of_widths);
  }
  CHECK(written == calotte::test::read_file(scratch / "area.nc"));
  CHECK_THROWS_AS(write_grid(scratch / "area.vtp", made.mesh, made.recipe, made.schedule), Error);
  const Made other(graded());
  CHECK_THROWS_AS(write_grid(scratch / "other.nc", other.mesh, made.recipe, made.schedule), Error);
  CHECK(scratch.files() == 2); // with the graph
}

TEST_CASE("the cells between walls are written, with their density") {
  const Scratch scratch;
  const Made made(between_walls());
  const GridFile file = write_grid(scratch / "walls.nc", made.mesh, made.recipe, made.schedule);
  CHECK(file.cells == file.inside);
  CHECK(file.period == Eigen::Vector2d(2, 0));
  const MeshFile read = read_mesh_file(scratch / "walls.nc");
  REQUIRE(read.polygons);
  CHECK(read.polygons->size() == file.cells);
  const Points3& centres = read.polygons->centres;
  CHECK(centres.row(1).minCoeff() >= 0);
  CHECK(centres.row(1).maxCoeff() <= 1);
  REQUIRE(read.density.size() == file.cells);
  Eigen::VectorXd expected = 1 / (1 + centres.row(1).array()).square();
  expected /= expected.maxCoeff();
  CHECK((read.density - expected).cwiseAbs().maxCoeff() < 1e-12);
}
