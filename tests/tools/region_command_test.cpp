// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"
#include "support/constants.h"

#include <calotte/read.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>
#include <string>

using namespace calotte;
using namespace calotte::test;

namespace fs = std::filesystem;

namespace {

Points3 points_of(const Bench& bench, const std::string& name) {
  return read_sites(bench.folder() / name);
}

/// The points of a text, as the command reads them.
Points3 directions_in(const std::string& text, Columns columns) {
  std::istringstream in(text);
  return read_points(in, "text", columns).colwise().normalized();
}

const std::string three = "10 50\n12 51.5\n9 48.25\n";

} // namespace

TEST_CASE("fixed points come first in the mesh, on the sphere and in a region") {
  const Bench bench;
  bench.file("fixed.txt", three);
  const Points3 fixed = directions_in(three, Columns::lonlat);
  for (const std::string where : {"", "--region circle=10,50,900km "}) {
    const Outcome outcome =
        bench.run("cvt --cells 300 --fixed fixed.txt --lonlat --stop tolerance --tolerance 1e-4 " +
                  where + "-o a.vtp --checkpoint a.state --checkpoint-every 10");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    const Points3 made = points_of(bench, "a.vtp");
    CHECK(made.cols() == 300);
    CHECK((made.leftCols(3) - fixed).cwiseAbs().maxCoeff() < 2e-16);
    CHECK(bench.run("cvt --resume a.state -o b.vtp").code == 0);
    CHECK(bench.file("a.vtp") == bench.file("b.vtp"));
  }
}

TEST_CASE("rings of a file run either way, and --inside tells another side of them") {
  const Bench bench;
  bench.file("clockwise.geojson", R"({"type":"Polygon","coordinates":
      [[[0,0],[0,20],[20,20],[20,0],[0,0]]]})");
  bench.file("arctic.geojson", R"({"type":"Polygon","coordinates":
      [[[-180,65.5],[-90,70],[0,72],[90,71],[180,65.50000000000003],[180,90],[-180,90],
        [-180,65.5]]]})");
  const auto made = [&](const std::string& region) {
    const Outcome outcome =
        bench.run("cvt --cells 100 --stop tolerance --tolerance 0.1 -o a.vtp --region " + region);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
    return points_of(bench, "a.vtp");
  };
  const Eigen::Vector3d middle = directions_in("10 10\n", Columns::lonlat).col(0);
  const auto nearest = [](const Points3& points, const Eigen::Vector3d& place) {
    return (points.colwise() - place).colwise().norm().minCoeff();
  };
  const Points3 within = made("clockwise.geojson");
  CHECK((within.colwise() - middle).colwise().norm().maxCoeff() < 15 * degree);
  CHECK(nearest(made("clockwise.geojson --inside -100,0"), middle) > 7 * degree);
  CHECK(nearest(made("clockwise.geojson --inside 10,10"), middle) < 2 * degree);
  CHECK(nearest(made("circle=10,10,1000km --inside 100,0"), middle) > 0.15);
  const Points3 arctic = made("arctic.geojson");
  CHECK(arctic.row(2).minCoeff() > std::sin(65 * degree));
  CHECK(nearest(arctic, directions_in("180 80\n", Columns::lonlat).col(0)) < 6 * degree);
  check_refusals(bench, "cvt --cells 100 -o b.vtp", R"(
--inside 1,2 | 2 | --inside requires --region
--region clockwise.geojson --inside 1 | 2 | --inside 1: this is no place; give LON,LAT in degrees, as in -105,40
--region clockwise.geojson --inside 1,95 | 2 | --inside 1,95: this is no place; give LON,LAT in degrees
--region clockwise.geojson --inside 0,5 | 2 | --inside 0,5: the place that is to be inside the region is on
)");
}

TEST_CASE("fixed points beside a file of others, in the plane, and in a limited area") {
  const Bench bench;
  bench.file("fixed.txt", three);
  CHECK(bench.run("points fibonacci 200 -o start.txt").code == 0);
  bench.file("fixed.xyz", "1 0 0\n0 0.6 0.8\n");
  CHECK(bench.run("cvt start.txt --fixed fixed.xyz -o a.vtp").code == 0);
  const Points3 made = points_of(bench, "a.vtp");
  CHECK(made.cols() == 202);
  CHECK(made.leftCols(2) == directions_in("1 0 0\n0 0.6 0.8\n", Columns::xyz));
  bench.file("fixed.xy", "0.25 0.5\n0.75 0.125\n");
  CHECK(bench.run("cvt --rectangle 0,0,1,1 --cells 60 --fixed fixed.xy -o plane.vtp").code == 0);
  const Points3 places = read_mesh(bench.folder() / "plane.vtp").points;
  CHECK(places.cols() == 60);
  CHECK(places.topLeftCorner<2, 2>() == (Points2(2, 2) << 0.25, 0.75, 0.5, 0.125).finished());
  CHECK(bench
            .run("cvt --region circle=10,50,500km --cell-width 60km --limited-area --fixed "
                 "fixed.txt --lonlat -o area.nc")
            .code == 0);
  const Points3 cells = points_of(bench, "area.nc"), fixed = directions_in(three, Columns::lonlat);
  for (const auto& x : fixed.colwise())
    CHECK((cells.colwise() - x).colwise().norm().minCoeff() < 1e-15);
}

TEST_CASE("bad fixed points are refused in one line that names the line of the file") {
  const Bench bench;
  bench.file("fixed.txt", three);
  bench.file("twice.txt", three + "12 51.5\n");
  bench.file("out.txt", three + "# far\n100 0\n");
  check_refusals(bench, "cvt -o a.vtp", R"(
--lonlat --cells 100 --fixed twice.txt | 2 | twice.txt line 4: fixed generator 3 merges with fixed generator 1
--lonlat --cells 100 --region circle=10,50,900km --fixed out.txt | 2 | out.txt line 5: fixed generator 3 is outside the region
--lonlat --cells 3 --fixed fixed.txt | 2 | fixed.txt line 3: fixed point 2 leaves no free one of the 3 cells
--lonlat --cells 100 --fixed fixed.txt --start fibonacci | 2 | the start fibonacci does not leave room for fixed
- --fixed - | 2 | both standard input
)");
}

TEST_CASE("generators on the boundary: the mesh ends at them") {
  const Bench bench;
  const std::string run =
      "cvt --region circle=10,50,900km --cell-width 100km --boundary generators ";
  const Outcome outcome = bench.run(run + "-o a.vtp --checkpoint a.state --checkpoint-every 10");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(bench.run("check a.vtp").code == 0);
  const Surface region = circle(directions_in("10 50\n", Columns::lonlat), 900 / 6371.0);
  const Points3 made = points_of(bench, "a.vtp");
  for (const auto& x : made.colwise())
    CHECK(region.contains(x));
  CHECK(bench.run("cvt --resume a.state -o b.vtp --threads 1 --regions 3").code == 0);
  CHECK(bench.file("a.vtp") == bench.file("b.vtp"));
  CHECK(!has(outcome.err, "leaves the boundary"));
  // Two bays with a wall between them that is much thinner than a cell.
  bench.file("wall.geojson", R"({"type": "Polygon", "coordinates": [[[0, 0], [20, 0], [20, 20],
             [10.1, 20], [10.05, 2], [9.95, 2], [9.9, 20], [0, 20], [0, 0]]]})");
  const Outcome wall = bench.run(
      "cvt --region wall.geojson --cells 60 --boundary generators --start random -o wall.vtp");
  CHECK(wall.code == 0);
  CHECK(!has(wall.err, "leaves the boundary"));
  CHECK(bench.run("check wall.vtp").code == 0);
  // A wall with spikes on one side, bent so that the edges along both sides cross each other.
  const auto corner = [](double radius, int tens) {
    const double angle = tens * 10 * degree;
    return "[" + std::to_string(10 + radius * std::cos(angle)) + ", " +
           std::to_string(10 + radius * std::sin(angle)) + "], ";
  };
  std::string bent;
  for (int k = 0; k <= 17; ++k)
    bent += corner(k % 5 == 2 ? 6.5 : 5, k);
  for (int k = 17; k >= 0; --k)
    bent += corner(4.98, k);
  bench.file("bent.geojson", R"({"type": "Polygon", "coordinates": [[[0, 0], [20, 0], [20, 20],
             [0, 20], [0, 0]], [)" +
                                 bent + "[15, 10]]]}");
  const Outcome around =
      bench.run("cvt --region bent.geojson --cells 200 --boundary generators -o bent.vtp");
  CHECK(around.code == 5);
  CHECK(has(around.err, "the mesh leaves the boundary of the region in places"));
  CHECK(bench.run("check bent.vtp").code == 0);
  bench.file("square.geojson", R"({"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9],
                                  [0, 9], [0, 0]]]})");
  check_refusals(bench, "cvt --boundary generators", R"(
--cells 100 -o c.vtp | 2 | --boundary generators requires a region
--region circle=10,50,900km --cell-width 100km --limited-area -o c.nc | 2 | does not apply to --limited-area
--region square.geojson --cells 4 -o c.vtp | 2 | the boundary takes 4 of the 4 generators; give more cells
)");
}

TEST_CASE("plan: the grid of a region") {
  const Bench bench;
  const auto plan = [&](const std::string& arguments) {
    const Outcome outcome = bench.run("plan " + arguments + " --report plan.json");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(has(outcome.out, "region "));
    return nlohmann::json::parse(bench.file("plan.json"));
  };
  const std::string where = "--region circle=10,50,500km --cell-width 60km";
  const double cells =
      2 * pi * (1 - std::cos(500 / 6371.0)) * 6371 * 6371 / (std::sqrt(3.0) / 2 * 60 * 60);
  const nlohmann::json part = plan(where), area = plan(where + " --limited-area");
  CHECK(part["cells"].get<double>() == doctest::Approx(cells).epsilon(0.005));
  CHECK(part["width_km"]["min"].get<double>() == doctest::Approx(60).epsilon(1e-6));
  CHECK(area["cells"] > part["cells"]);
  CHECK(area["estimates"]["seconds"] > 0);
  CHECK(area["estimates"]["mpas_bytes"] > part["estimates"]["mpas_bytes"]);
  // A run has as many cells, and its file about as many bytes.
  const Outcome run = bench.run("cvt " + where + " --limited-area -o a.nc");
  CHECK(has(run.err, "requires " + area["cells"].dump() + " cells"));
  CHECK(has(run.err, " E to "));
  const double bytes = static_cast<double>(fs::file_size(bench.folder() / "a.nc"));
  CHECK(area["estimates"]["mpas_bytes"].get<double>() == doctest::Approx(bytes).epsilon(0.5));
  const nlohmann::json bump = plan("--region circle=10,50,20deg --cells 1000 --density "
                                   "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8");
  CHECK(bump["cells"] == 1000);
  CHECK(bump["width_degrees"]["max"] < 3); // uniform there: 1.2 degrees
  check_refusals(bench, "plan --cell-width 60km",
                 "--limited-area | 2 | --limited-area requires a region");
}

TEST_CASE("rings that meet themselves around the sphere are refused in one clear line") {
  const Bench bench;
  const Outcome outcome =
      bench.run("cvt --region circle=10,50,11000km --cell-width 1500km --limited-area -o a.nc");
  CHECK(outcome.code == 2);
  CHECK(has(outcome.err, "the region and its 7 rings hold all "));
  CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 2); // and the number of cells
  CHECK(bench.names().empty());
}

TEST_CASE("bad regions end in one clear line before any work") {
  const Bench bench;
  const auto geojson = [](const std::string& corners) {
    return R"({"type": "Polygon", "coordinates": [[)" + corners + "]]}";
  };
  bench.file("bow.geojson", geojson("[0, 0], [10, 10], [10, 0], [0, 10], [0, 0]"));
  bench.file("Bow.pts", "Name: bow\nType: custom\nPoint: 5, 5\n0, 0\n10, 10\n0, 10\n10, 0\n");
  check_refusals(bench, "", R"(
cvt --region bow.geojson --cell-width 60km -o a.vtp | 2 | bow.geojson:
plan --region bow.geojson --cell-width 60km | 2 | bow.geojson:
cvt --region Bow.pts --cell-width 60km -o a.vtp | 2 | Bow.pts
cvt --region circle=10,50,3km --cell-width 60km -o a.vtp | 2 | the widths require 0.00906854 cells in the region
plan --region circle=10,50,3km --cell-width 60km | 2 | the widths require 0.00906854 cells in the region
cvt --region circle=10,50,3km --cell-width 60km --limited-area -o a.nc | 2 | the region has room for 0.00906854 cells only
plan --region circle=10,50,3km --cell-width 60km --limited-area | 2 | the region has room for 0.00906854 cells only
)");
}

TEST_CASE("a raster of a part of the sphere is enough for a region in it, with its rings") {
  const Bench bench;
  std::string text = "mshid=3;ellipsoid-grid\nndims=2\ncoord=1;41\n";
  for (int i = 0; i <= 40; ++i) // 100 to 180 E
    text += std::to_string((100 + 2 * i) * degree) + "\n";
  text += "coord=2;31\n";
  for (int j = 0; j <= 30; ++j) // 0 to 60 N
    text += std::to_string(2 * j * degree) + "\n";
  text += "value=1271;1\n";
  for (int k = 0; k < 1271; ++k)
    text += "300\n";
  bench.file("part.msh", text);
  const std::string widths = " --cell-width part.msh ";
  const Outcome plan = bench.run("plan --region circle=140,30,1500km" + widths);
  CHECK(plan.code == 0);
  // pi 1500^2 / (sqrt(3)/2 300^2), on a cap of the sphere 0.5% less.
  CHECK(has(plan.out, "cells                 90\n"));
  CHECK(bench.run("cvt --region circle=140,30,1500km --tolerance 1e-2 -o part.vtp" + widths).code ==
        0);
  CHECK(bench.run("plan --region circle=140,30,2500km" + widths).code ==
        0); // its rings reach farther
  check_refusals(bench, "", R"(
plan --cell-width part.msh | 2 | leaves part of the sphere out; give a global raster
cvt --cell-width part.msh --region circle=140,30,3600km -o a.vtp | 2 | of the region; give a raster in degrees that
cvt --cell-width part.msh --region circle=-140,30,900km -o a.vtp | 2 | of the region; give a raster in degrees that
plan --cell-width part.msh --limited-area --region circle=140,30,2500km | 2 | of the region; give a raster in
)");
}
