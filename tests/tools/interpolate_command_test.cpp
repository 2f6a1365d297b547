// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command.h"
#include "support/command.h"

#include <calotte/field_grid.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
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

/// times.nc: whole(time), missing at the north at each time, and ever(time, lev), missing at the
/// first time alone.
void make_times(const Bench& bench) {
  const FieldGrid raster = *raster_of("24x12");
  MeshField whole{.name = "whole", .dimensions = {{"time", 3}}, .leading = 1},
      ever{.name = "ever", .dimensions = {{"time", 3}, {"lev", 2}}, .leading = 1};
  whole.values = DoubleVector::LinSpaced(3 * 288, 0, 1);
  whole.values.tail(3 * 72).setConstant(std::nan(""));
  ever.values = DoubleVector::LinSpaced(6 * 288, 0, 1);
  for (Eigen::Index i = 0; i < 72; ++i)
    ever.values[6 * i] = std::nan("");
  write_fields(bench.path("times.nc"), raster, {whole, ever});
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

TEST_CASE("interpolate: what is missing is counted by cell where it is the same at each time") {
  const Bench bench;
  make_grids(bench);
  make_times(bench);
  CHECK(bench.run("interpolate times.nc 24x12 -o a.nc --fields whole").out ==
        "a.nc: whole: 72 of 288 cells have no value, at each time, as times.nc has none there\n"
        "a.nc: whole at 288 cells, conservative\n");
  CHECK(bench.run("interpolate times.nc 24x12 -o a.nc --fields ever").out ==
        "a.nc: ever: 72 of 1728 numbers have no value, in all, over time (3), lev (2), as times.nc "
        "has none there\n"
        "a.nc: ever at 288 cells, conservative\n");
  CHECK(bench.run("interpolate times.nc 24x12 -o a.nc --fields whole --min-cover 1").out ==
        "a.nc: whole: 72 of 288 cells have no value, at each time, as times.nc has values for less "
        "than 1 of the cell\n"
        "a.nc: whole at 288 cells, conservative\n");
  CHECK(bench.run("interpolate times.nc 24x12 -o a.nc --at time=0,lev=0").out ==
        "a.nc: whole: 72 of 288 cells have no value, as times.nc has none there\n"
        "a.nc: ever: 72 of 288 cells have no value, as times.nc has none there\n"
        "a.nc: whole, ever at 288 cells, conservative\n");
}

TEST_CASE("interpolate: times go to formats that hold them, and one of them to others") {
  const Bench bench;
  make_grids(bench);
  make_times(bench);
  CHECK(bench.run("interpolate times.nc mesh.nc -o all.g --fields whole").code == 0);
  CHECK(read_field_grid(bench.path("all.g")).fields.at(0).count() == 3);
  for (const char* name : {"one.vtp", "one.vtu", "one.geojson"}) {
    CHECK(bench
              .run("interpolate times.nc mesh.nc --method nearest --at tim=-1 --fields whole -o " +
                   std::string(name))
              .code == 0);
    const FieldGrid one = read_field_grid(bench.path(name));
    const auto whole = std::ranges::find(one.fields, "whole", &MeshField::name);
    REQUIRE(whole != one.fields.end());
    CHECK(whole->count() == 1);
  }
  check_refusals(bench, "interpolate times.nc mesh.nc", R"(
-o a.vtp --fields whole | 2 | a.vtp: the field whole has several numbers for each of the cells: time (3), and VTK holds one; choose an index of each (--at), or write .nc or .g
-o a.vtu --at time=0 | 2 | a.vtu: the field ever has several numbers for each of the cells: lev (2), and VTK
-o a.geojson | 2 | a.geojson: the field whole has several numbers
-o a.vtp --at time=3 | 2 | time=3 is out of range: time has the indices 0 to 2
-o a.vtp --at x=0 | 2 | times.nc: no field has a dimension x; there are time (3), lev (2)
-o a.ply --at time=0,lev=0 | 2 | a.ply: PLY holds no fields; write .nc, .g, .vtp, .vtu or .geojson
-o a.off | 2 | a.off: OFF holds no fields
-o a.msh | 2 | a.msh: MSH holds no fields
-o a.xyz | 2 | a.xyz: unknown suffix
)");
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
raster.nc 720 -o out.nc | 2 | 720 is no file; the size of a raster is its columns x its rows, such as 720x360
raster.nc 8x4 -o out.vtp | 2 | give a name that ends in .nc
raster.nc mesh.nc -o raster.nc | 2 | raster.nc
never.nc mesh.nc -o out.nc | 3 | never.nc
)");
  const Outcome high = bench.run("interpolate mesh.nc 8x12 --weights high.nc");
  CHECK(high.code == 0);
  CHECK(
      has(high.err, "8x12 has 8 columns and 12 rows, whose boxes are 45 degrees wide and 15 high"));
  check_refusals(bench, "info", R"(
raster.nc | 2 | raster.nc: a raster of lat and lon, not a mesh; interpolate, cvt --cell-width and cull --raster take
)");
}

TEST_CASE("interpolate: a text of values onto a raster, a mesh and positions") {
  const Bench bench;
  make_grids(bench);
  std::ofstream(bench.path("obs.csv"))
      << "id,lon,lat,t,u\nA,0,0,1,\nB,90,0,2,7\nC,180,0,3,7\nD,-90,0,4,7\nE,0,90,5,7\nF,0,-90,6,7\n"
         "G,-180,0,5,7\n";
  std::ofstream(bench.path("to.txt")) << "0.1 0.25\n180 0\n";
  const std::string merged = "calotte: warning: obs.csv: 1 row had the position of an earlier row; "
                             "the values at one position are averaged\n";
  const Outcome raster = bench.run("interpolate obs.csv 24x12 -o map.nc --fields t,u");
  CHECK(raster.code == 0);
  CHECK(raster.err == merged);
  CHECK(has(raster.out, "map.nc: u: 144 of 288 cells are outside of the triangles between"));
  CHECK(has(raster.out, "map.nc: t, u at 288 cells, linear\n"));
  CHECK(read_field_grid(bench.path("map.nc")).fields.size() == 2);
  CHECK(bench.run("interpolate obs.csv mesh.nc -o cells.vtp --fields T --method natural").out ==
        "cells.vtp: t at 500 cells, natural\n");
  CHECK(bench.run("interpolate obs.csv to.txt -o at.csv --fields t,5 --method nearest").out ==
        "at.csv: t, u at 2 positions, nearest\n");
  CHECK(read_file(bench.path("at.csv")) == "lon,lat,t,u\n0.1,0.25,1,7\n180,0,4,7\n");
  CHECK(bench.run("interpolate raster.nc to.txt -o at.txt --fields height").out ==
        "at.txt: height at 2 positions, linear\n");
  CHECK(bench.run("interpolate mesh.vtp to.txt -o at.txt").code == 3);
  std::ofstream(bench.path("part.csv")) << "lon,lat,t\n0,0,1\n90,0,2\n0,90,3\n";
  CHECK(bench.run("interpolate part.csv 24x12 -o part.nc").out ==
        "part.nc: t: 252 of 288 cells are outside of the triangles between the positions of "
        "part.csv, and missing\npart.nc: t at 288 cells, linear\n");
}

TEST_CASE("interpolate: values of a plane") {
  const Bench bench;
  std::ofstream(bench.path("obs.txt")) << "x y t\n0 0 0\n1000 0 1\n0 1000 2\n1000 1000 3\n";
  std::ofstream(bench.path("to.txt")) << "x y\n500 250\n2000 0\n";
  CHECK(bench.run("interpolate obs.txt to.txt --plane -o at.txt --method natural").code == 0);
  CHECK(read_file(bench.path("at.txt")) == "x y t\n500 250 1\n2000 0 NaN\n");
  REQUIRE(bench.run("points random-plane 60 --rectangle 0,0,1000,1000 -o p.txt").code == 0);
  REQUIRE(bench.run("delaunay p.txt --plane -o plane.vtp").code == 0);
  CHECK(bench.run("interpolate obs.txt plane.vtp --plane -o at.nc").out ==
        "at.nc: t at 60 cells, linear\n");
  CHECK(has(bench.run("interpolate obs.txt plane.vtp --position 1,2 -o at.nc").err,
            "latitude 1000 is outside -90 to 90"));
}

TEST_CASE("interpolate: options and texts that do not go together, and bad texts") {
  const Bench bench;
  make_grids(bench);
  std::ofstream(bench.path("obs.csv")) << "lon,lat,t\n0,0,1\n90,0,2\n0,90,3\n";
  std::ofstream(bench.path("word.csv")) << "lon,lat,t\n0,0,1\n90,0,warm\n0,90,3\n";
  std::ofstream(bench.path("line.csv")) << "lon,lat,t\n0,0,1\n90,0,2\n50,0,3\n";
  std::ofstream(bench.path("empty.csv"));
  check_refusals(bench, "interpolate", R"(
obs.csv 24x12 | 2 | nothing to write; give -o FILE
obs.csv 24x12 -o out.csv | 2 | give a name that ends in .nc
obs.csv obs.csv -o out.vtp | 2 | give a name that ends in .csv, .txt or .nc
obs.csv 24x12 -o out.nc --method conservative | 2 | positions have no cells to share areas; give linear, nearest or natural
raster.nc obs.csv -o out.csv --method conservative | 2 | positions have no cells to share areas
raster.nc obs.csv -o out.csv --fields heigth | 2 | did you mean height?
obs.csv 24x12 -o out.nc --weights w.nc | 2 | --weights does not apply to positions, which have no cells; leave it out
obs.csv 24x12 -o out.nc --mesh mesh.nc | 2 | --mesh does not apply to a text of values; leave it out
obs.csv 24x12 -o out.nc --at time=0 | 2 | --at does not apply
obs.csv 24x12 -o out.nc --min-cover 0.5 | 2 | --min-cover does not apply
obs.csv 24x12 -o out.nc --fields u | 2 | obs.csv line 1: no column u; the header names lon, lat, t
obs.csv 24x12 -o out.nc --position lon | 2 | --position
raster.nc mesh.nc -o out.nc --position lon,lat | 2 | --position does not apply to meshes and rasters
raster.nc mesh.nc -o out.nc --plane | 2 | --plane does not apply to meshes and rasters
obs.csv 24x12 -o out.nc --plane --position 1,2 | 2 | obs.csv is in a plane, and 24x12 is on the sphere; give grids of one surface
word.csv 24x12 -o out.nc | 2 | word.csv line 3: "warm" is not a number, in the column t
line.csv 24x12 -o out.nc | 2 | line.csv: the 3 rows with t are all on one great circle
empty.csv 24x12 -o out.nc | 2 | empty.csv: no rows of numbers in 0 lines
never.csv 24x12 -o out.nc | 3 | never.csv
obs.csv obs.csv -o obs.csv | 2 | obs.csv
)");
}
