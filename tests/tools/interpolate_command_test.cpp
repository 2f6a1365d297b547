// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/field_grid.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace calotte;
using namespace calotte::test;

namespace {

/// A mesh, mesh.nc, and a raster of heights and land use, raster.nc.
void make_grids(const Bench& bench) {
  REQUIRE(bench.run("points fibonacci 500 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o mesh.nc").code == 0);
  const FieldGrid raster = *raster_of("24x12");
  MeshField height{.name = "height", .units = "m"}, use{.name = "use", .integer = true},
      steps{.name = "steps", .units = "m", .integer = true};
  height.values = 1000 * nodes(*raster.boxes).row(2).transpose();
  use.values = DoubleVector::LinSpaced(288, 0, 287);
  steps.values = use.values;
  write_fields(bench.path("raster.nc"), raster, {height, use, steps});
}

} // namespace

TEST_CASE("interpolate: a raster onto a mesh and back, and its weights") {
  const Bench bench;
  make_grids(bench);
  const Outcome made = bench.run("interpolate raster.nc mesh.nc -o cells.nc --weights w.nc");
  CHECK(made.code == 0);
  CHECK(has(made.out, "use holds integers without a unit, taken as categories"));
  CHECK(has(made.out, "steps holds integers in m, taken as numbers"));
  CHECK(has(made.out, "cells.nc: height, use, steps at 500 cells, conservative\n"));
  const Outcome applied =
      bench.run("interpolate raster.nc mesh.nc --apply w.nc -o again.nc --fields height");
  CHECK(applied.out == "again.nc: height at 500 cells, by w.nc\n");
  CHECK(
      bench.run("interpolate raster.nc mesh.nc -o mesh.vtp --method linear --fields height").out ==
      "mesh.vtp: height at 500 cells, linear\n");
  const FieldGrid mesh = read_field_grid(bench.path("mesh.vtp"));
  REQUIRE(mesh.fields.size() >= 1);
  const Outcome back = bench.run("interpolate mesh.vtp 12x6 -o back.nc --fields height "
                                 "--method nearest --threads 1");
  CHECK(back.out == "back.nc: height at 72 cells, nearest\n");
  const FieldGrid raster = read_field_grid(bench.path("back.nc"));
  const DoubleVector exact = 1000 * nodes(*raster.boxes).row(2).transpose();
  CHECK((raster.fields.at(0).values - exact).cwiseAbs().maxCoeff() < 150);
  const Outcome apart =
      bench.run("interpolate cells.nc 12x6 --mesh mesh.nc -o apart.nc --fields height,use");
  CHECK(has(apart.out, "apart.nc: height, use at 72 cells, conservative\n"));
  const Outcome weights = bench.run(
      "interpolate mesh.nc 12x6 --weights scrip.nc --weights-format scrip --method linear");
  CHECK(weights.code == 0);
  CHECK(has(weights.out, " weights from 500 to 72 cells\n"));
}

TEST_CASE("interpolate: bad input is one line, and leaves no file") {
  const Bench bench;
  make_grids(bench);
  REQUIRE(bench.run("interpolate raster.nc mesh.nc --weights w.nc").code == 0);
  check_refusals(bench, "interpolate", R"(
raster.nc mesh.nc | 2 | nothing to write; give -o FILE
raster.nc mesh.nc -o out.nc --fields hight | 2 | raster.nc has no field hight at cells; did you mean height?
mesh.nc raster.nc -o out.nc --fields height | 2 | mesh.nc has no field height
raster.nc 36x18 -o out.nc --apply w.nc | 2 | w.nc: the weights are for a target of 500 cells, and 36x18 has 648
mesh.nc raster.nc -o out.nc --apply w.nc | 2 | give
raster.nc mesh.nc -o out.nc --apply w.nc --method linear | 2 | --method excludes --apply
raster.nc mesh.nc -o out.nc --apply raster.nc | 2 | give a file of weights
raster.nc mesh.nc -o out.nc --categories height | 2 | --categories height: the field does not hold integers
raster.nc mesh.nc -o out.nc --min-cover 2 | 2 | --min-cover
raster.nc mesh.nc -o out.nc --method cubic | 2 | --method
raster.nc mesh.nc -o out.nc --method natural | 2 | nearest and linear only
raster.nc 8x4 --mesh mesh.nc -o out.nc | 2 | raster.nc: no dimension of 500, the number of cells of mesh.nc
raster.nc 8x4 --mesh raster.nc -o out.nc | 2 | raster.nc is a raster
raster.nc 2x2 -o out.nc | 2 | 2 x 2
raster.nc 8x4 -o out.vtp | 2 | give a name that ends in .nc
raster.nc mesh.nc -o raster.nc | 2 | raster.nc
never.nc mesh.nc -o out.nc | 3 | never.nc
)");
}
