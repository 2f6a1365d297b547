// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/widths.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <iomanip>
#include <numbers>
#include <sstream>
#include <string>

using namespace calotte::test;

namespace {

std::string small_radius(const std::string& origin, const std::string& radius) {
  return "calotte: warning: " + origin + ": a sphere with a radius of " + radius +
         " m is small; if these are km, give --sphere-radius " + radius +
         "000, or --sphere-radius earth (6371229 m)\n";
}

/// The warnings of a command.
std::string warnings(const Outcome& outcome) {
  std::string lines, rest = outcome.err;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n') + 1;
    if (rest.starts_with("calotte: warning: "))
      lines += rest.substr(0, end);
    rest = rest.substr(end);
  }
  return lines;
}

} // namespace

TEST_CASE("a width in km makes a uniform grid of the Earth, with the number of cells it implies") {
  const Bench bench;
  const Outcome made =
      check_success(bench, "cvt --cell-width 960km -o mesh.nc"); // 639 cells; 642 are symmetric
  CHECK(made.out.starts_with("mesh.nc: 642 cells, all shapes within the limits of models\n"));
  CHECK(made.err == "calotte: cells 960 km wide require 639 cells; a symmetric grid near that has "
                    "642, 957.8 km wide\n");
  const std::string mesh = bench.file("mesh.nc");
  for (const char* same : {"960", "'960 km'", "960.0km"}) {
    check_success(bench, std::string("cvt -o mesh.nc --cell-width ") + same);
    CHECK((bench.file("mesh.nc") == mesh));
  }
  check_success(bench, "cvt --cells 642 -o mesh.vtp --cell-width 960km");
  check_success(bench, "cvt --cells 642 -o plain.vtp");
  CHECK(bench.file("mesh.vtp") == bench.file("plain.vtp"));
  CHECK(has(check_success(bench, "cvt --cell-width 1000km -o other.vtp").out, " 589 cells, "));
  CHECK(has(check_success(bench, "plan --cell-width 1000km").out, "\ncells                 589\n"));
  CHECK(has(check_success(bench, "cvt --cell-width 400km -o finer.vtp").out,
            " 3672 cells, all shapes within"));
  CHECK(has(check_success(bench, "plan --cell-width 400km").out, "\ncells                 3672\n"));
  CHECK(
      has(check_success(bench, "info finer.vtp").out, "\ndegree: cells         5: 12, 6: 3660\n"));
  CHECK(has(check_success(bench, "cvt --cell-width 300km --earth-radius 1000 -o small.vtp").out,
            " 161 cells, "));
}

TEST_CASE("60 km are 163 842 cells, and 120 km 40 962") {
  const Bench bench;
  CHECK(
      has(check_success(bench, "plan --cell-width 60km").out, "\ncells                 163842\n"));
  CHECK(has(check_success(bench, "plan --cell-width 60000m").out,
            "\ncells                 163842\n"));
  CHECK(has(check_success(bench, "plan --cell-width 60").out,
            "\ncell width, km        59.96 to 59.96\n"));
  CHECK(
      has(check_success(bench, "plan --cell-width 120km").out, "\ncells                 40962\n"));
  CHECK(has(check_success(bench, "plan --cell-width 60km --cells 40962").out,
            "\ncell width, km        119.9 to 119.9\n"));
}

TEST_CASE("a file of options takes a width in km as a number or as text") {
  const Bench bench;
  for (const char* width : {"960", "\"960km\"", "\"960 km\"", "\"960000m\""}) {
    bench.file("grid.toml", "cell_width = " + std::string(width) +
                                "\noutput = \"grid.vtp\"\nsphere_radius = 1\niterations = 3\n");
    CHECK(check_success(bench, "cvt --config grid.toml").out.starts_with("grid.vtp: 642 cells, "));
  }
  bench.file("grid.toml", "cells = 12\noutput = \"grid.nc\"\nsphere_radius = \"earth\"\n");
  check_success(bench, "cvt --config grid.toml");
  CHECK(has(check_success(bench, "info grid.nc").out, "spacing, km           7053"));
}

TEST_CASE("widths that are none are refused") {
  const Bench bench;
  check_refusals(bench, "cvt -o mesh.vtp", R"(
--cell-width 0km | 2 | --cell-width: "0km" is not a positive number
--cell-width 0 | 2 | --cell-width: "0" is not a positive number
--cell-width '60 miles' | 2 | --cell-width: "60 miles" is in miles; give km or m, such as 60km
--cell-width 60.nc | 3 | 60.nc
--cell-width 960km --transition 100km | 2 | 960 km holds no polygons; leave --transition out
--cell-width 60km --rectangle 0,0,1,1 | 2 | the plane has the unit of its coordinates; give a number without a unit
--cells 12 --sphere-radius moon | 2 | --sphere-radius: "moon" is not a number; give metres, or earth
)");
}

TEST_CASE("files are on the unit sphere by default, and name the planet that their widths are of") {
  const Bench bench;
  const auto spacing = [&](const std::string& arguments) {
    check_success(bench, "cvt --cells 12 --iterations 1 -o mesh.nc " + arguments);
    const std::string shown = check_success(bench, "info mesh.nc").out;
    const std::size_t from = shown.find("spacing, ");
    return shown.substr(from, shown.find(' ', from + 22) - from);
  };
  const std::string width = "--cell-width 7000km ", km = "spacing, km           ";
  CHECK(spacing("") == "spacing, degrees      63.4349");
  CHECK(spacing("--format ugrid") == "spacing, degrees      63.4349");
  CHECK(spacing(width) == km + "7053.64"); // atan(2) 6371
  for (const char* format : {"mpas-minimal", "ugrid", "scrip", "esmf"})
    CHECK(spacing(width + "--format " + format) == km + "7053.64");
  CHECK(spacing(width + "--earth-radius 3390") == km + "3753.23");
  CHECK(spacing(width + "--sphere-radius earth") == km + "7053.9"); // 6371.229
  CHECK(spacing(width + "--sphere-radius 1") == km + "7053.64");
  CHECK(spacing("--sphere-radius 2e6") == km + "2214.3");
  CHECK(spacing("--for mpas-atmosphere") == km + "7053.9");
  CHECK(spacing("--for mpas-sw") == km + "7053.9");
  CHECK(spacing("--for mpas-ocean") == km + "7053.89"); // 6371.22
  CHECK(spacing("--for mpas-atmosphere " + width) == km + "7053.64");
}

TEST_CASE("a file's planet follows it through conversions, changes, cuts and unknown attributes") {
  const Bench bench;
  const auto is_km = [&](const std::string& name) {
    return has(check_success(bench, "info " + name).out, "spacing, km ");
  };
  check_success(bench, "cvt --cell-width 960km -o widths.nc");
  check_success(bench, "convert widths.nc same.nc");
  CHECK(is_km("same.nc"));
  check_success(bench, "convert widths.nc other.nc --format ugrid");
  CHECK(is_km("other.nc"));
  check_success(bench, "refine widths.nc --region circle=0,0,3000km --factor 1.3 -o finer.nc");
  CHECK(is_km("finer.nc"));
  check_success(bench, "cut widths.nc --region circle=0,0,3000km --rings 2 -o part.nc");
  CHECK(is_km("part.nc"));
  CHECK(has(bench.file("part.nc"), "planet_radius"));
  check_success(bench, "cut widths.nc --region circle=0,0,3000km --rings 2 --sphere-radius earth "
                       "-o scaled.nc");
  CHECK(!has(bench.file("scaled.nc"), "planet_radius")); // 6371 km, of the unit sphere
  check_success(bench, "convert widths.nc ocean.nc --for mpas-ocean");
  check_success(bench,
                "cull ocean.nc --field latCell --sea-below 0 --for mpas-atmosphere -o sea.nc");
  CHECK(is_km("sea.nc"));
  check_success(bench, "convert ocean.nc back.nc --sphere-radius 1");
  CHECK(has(check_success(bench, "info back.nc --report a.json").out, "spacing, km "));
  const nlohmann::json report = nlohmann::json::parse(bench.file("a.json"));
  CHECK(report["radius_km"] == 6371.22);
  CHECK(report["cell_area_km2"]["mean"].get<double>() ==
        doctest::Approx(report["cell_area"]["mean"].get<double>() * 6371.22 * 6371.22));
  check_success(bench, "cvt --cells 162 -o grid.nc --for mpas-ocean --report run.json");
  CHECK(nlohmann::json::parse(bench.file("run.json"))["radius_km"] == 6371.22);
  // Of other programs: MPAS-Atmosphere's order of vertices, and FESOM's own format.
  check_success(bench, "cvt --cells 162 -o air.nc --for mpas-atmosphere");
  std::string bytes = bench.file("air.nc");
  bytes.replace(bytes.find("planet_radius"), 13, "planet_tinted");
  bench.file("air.nc", bytes);
  CHECK(is_km("air.nc"));
  check_success(bench, "convert air.nc nod2d.out --for fesom");
  CHECK(is_km("nod2d.out"));
  check_success(bench, "convert air.nc mesh.vtp");
  CHECK(!is_km("mesh.vtp")); // its format names no planet
}

TEST_CASE("info speaks in km, degrees or radians") {
  const Bench bench;
  check_success(bench, "cvt --cells 12 -o unit.vtp");
  const auto shown = [&](const std::string& arguments) {
    return check_success(bench, "info unit.vtp " + arguments + " --report report.json").out;
  };
  CHECK(has(shown(""), "\nspacing, degrees      63.4349 "));
  CHECK(!has(bench.file("report.json"), "spacing_km"));
  CHECK(has(shown("--units radians"), "\nspacing, radians      1.10715 "));
  CHECK(has(shown(""), "\ncell area, steradians 1.0472 "));
  CHECK(has(shown("--sphere-radius 1e6"), "\nspacing, km           1107.15 "));
  CHECK(has(shown("--sphere-radius 1e6"), "\ncell area, km^2       1.0472e+06"));
  CHECK(has(shown("--sphere-radius earth"), "\nspacing, km           7053.9 "));
  const nlohmann::json report = nlohmann::json::parse(bench.file("report.json"));
  CHECK(report["radius_km"] == 6371.229);
  CHECK(report["spacing_km"]["min"].get<double>() == doctest::Approx(7053.9));
  CHECK(report["spacing"]["min"].get<double>() == doctest::Approx(1.10715));
  CHECK(has(shown("--sphere-radius earth --units degrees"), "\nspacing, degrees      63.4349 "));
  CHECK(has(shown("--cell-width 7000km"), "\nspacing, km           7053.64"));
  check_refusals(bench, "info unit.vtp", R"(
--units km | 2 | --units km requires the radius of the sphere; give --sphere-radius earth, or a radius in metres
--plane --units km | 2 | unit.vtp: it holds no mesh of the plane: z is not 0 at point 0; leave --plane out
--rectangle 0,0,1,1 | 2 | --rectangle applies to the plane only, and unit.vtp holds a mesh of the sphere; leave it out
)");
}

TEST_CASE("a run tells its widths in km, or in the unit of --units") {
  const Bench bench;
  const double degrees = 900 / calotte::earth_radius_km * 180 / std::numbers::pi;
  const auto told = [&](const std::string& options) {
    return check_success(bench, "cvt --iterations 1 -o a.vtp --cells 642 " + options).err;
  };
  CHECK(told("--cell-width 900km") == told("--cell-width 900km --units km"));
  CHECK(has(told("--cell-width 900km"), "cells 900 km wide require "));
  std::ostringstream words;
  words << "cells " << std::setprecision(4) << degrees << " degrees wide require ";
  CHECK(has(told("--cell-width 900km --units degrees"), words.str()));
  CHECK(has(told("--cell-width 900km --units radians"), "cells 0.1413 radians wide require "));
  // The unit is that of the output alone: the mesh is the same.
  const std::string mesh = bench.file("a.vtp");
  told("--cell-width 900km");
  CHECK(bench.file("a.vtp") == mesh);
  check_refusals(bench, "cvt -o b.vtp", R"(
--cells 100 --units km | 2 | --units is the unit of widths; leave it out, or give --cell-width
--cells 100 --units miles --cell-width 900km | 2 | --units: miles not in {km,degrees,radians}
--cells 100 --rectangle 0,0,2,1 --units km | 2 | a plane has the unit of its coordinates; leave --units out
--hexagons 6,8,10 --units km | 2 | without a run; leave --units out
)");
}

TEST_CASE("pictures are in the unit that info has, or in that of --units") {
  const Bench bench;
  check_success(bench, "cvt --cells 12 -o unit.nc");
  check_success(bench, "cvt --cell-width 7000km -o earth.nc");
  const auto drawn = [&](const std::string& arguments) {
    check_success(bench, "draw " + arguments + " -o a.svg --title x --what cells");
    return bench.file("a.svg");
  };
  CHECK((drawn("unit.nc") == drawn("unit.nc --units degrees")));
  CHECK((drawn("unit.nc --units radians") != drawn("unit.nc")));
  CHECK((drawn("unit.nc --sphere-radius 6371000") == drawn("earth.nc")));
  CHECK((drawn("earth.nc") == drawn("earth.nc --units km")));
  CHECK((drawn("earth.nc --units degrees") == drawn("unit.nc")));
  CHECK((drawn("earth.nc --colour area") != drawn("earth.nc --colour area --units degrees")));
  check_refusals(bench, "draw -o a.svg", R"(
unit.nc --units km | 2 | --units km requires the radius of the sphere; give --sphere-radius earth
unit.nc --plane --units km | 2 | unit.nc: it holds no mesh of the plane
--density x8 --units km | 2 | a density has no unit of lengths; leave --units out, or give widths in km
)");
  check_success(bench, "draw --cell-width 7000km --units degrees -o a.svg");
}

TEST_CASE("a radius that may be in km gives a warning, where it is given and where it is read") {
  const Bench bench;
  const std::string run = "cvt --cells 12 -o mesh.nc --sphere-radius ";
  CHECK(check_success(bench, run + "6371").err == small_radius("--sphere-radius", "6371"));
  CHECK(check_success(bench, "info mesh.nc").err == small_radius("mesh.nc", "6371"));
  CHECK(check_success(bench, "draw mesh.nc -o mesh.png").err == small_radius("mesh.nc", "6371"));
  CHECK(check_success(bench, run + "1000").err == small_radius("--sphere-radius", "1000"));
  for (const char* radius : {"1", "999", "10001", "6371000", "earth"}) {
    CHECK(check_success(bench, run + radius).err.empty());
    CHECK(check_success(bench, "info mesh.nc").err.empty());
  }
}

TEST_CASE("widths that may be in metres give a warning") {
  const Bench bench;
  const std::string large = " km wide are large; if these are metres, give km\n";
  CHECK(check_success(bench, "plan --cell-width 3000").err ==
        "calotte: warning: cells 3000" + large);
  CHECK(warnings(check_success(bench, "cvt --cell-width 60000 --cells 42 -o mesh.vtp")) ==
        "calotte: warning: cells 60000" + large);
  CHECK(check_success(bench, "plan --cell-width 2000").err.empty());
}

TEST_CASE("an angle of a density that may be in degrees gives a warning") {
  const Bench bench;
  const auto warned = [&](const std::string& angles) {
    return warnings(
        check_success(bench, "plan --cells 100 --density tanh:lon=0,lat=0,gamma=x2," + angles));
  };
  const std::string start = "calotte: warning: --density \"tanh:lon=0,lat=0,gamma=x2,";
  CHECK(warned("beta=30,alpha=0.2") ==
        start + "beta=30,alpha=0.2\": beta is 30 radians, more than pi; for degrees give "
                "beta=30deg\n");
  CHECK(warned("beta=30deg,alpha=10") ==
        start + "beta=30deg,alpha=10\": alpha is 10 radians, more than pi; for degrees give "
                "alpha=10deg\n");
  CHECK(warned("beta=30deg,alpha=10deg").empty());
  CHECK(warned("beta=3.1,alpha=3.1").empty());
  const Outcome plane =
      check_success(bench, "cvt --rectangle 0,0,100,100 --cells 50 --iterations 1 --density "
                           "tanh:x=3,y=4,beta=30,alpha=10,gamma=x2 -o mesh.vtp");
  CHECK(warnings(plane).empty()); // lengths
}
