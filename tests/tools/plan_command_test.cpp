// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"
#include "support/constants.h"

#include <calotte/generators.h>
#include <calotte/read.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>

using namespace calotte::test;

namespace {

constexpr double radius = 6371; // km

/// A raster in JIGSAW's format, of widths by latitude in degrees.
std::string raster(const std::function<double(double)>& width) {
  constexpr int columns = 8, rows = 37;
  std::string text = "mshid=3;ellipsoid-grid\nndims=2\ncoord=1;8\n";
  for (int i = 0; i < columns; ++i)
    text += std::to_string((-180 + 45 * i) * pi / 180) + "\n";
  text += "coord=2;37\n";
  for (int j = 0; j < rows; ++j)
    text += std::to_string((-90 + 5 * j) * pi / 180) + "\n";
  text += "value=" + std::to_string(columns * rows) + ";1\n";
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      text += std::to_string(width(-90 + 5 * j)) + "\n";
  return text;
}

nlohmann::json plan_report(const Bench& bench, const std::string& arguments) {
  const Outcome outcome = bench.run("plan " + arguments + " --report plan.json");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  return nlohmann::json::parse(bench.file("plan.json"));
}

double number(const nlohmann::json& json, const char* group, const char* key) {
  return json.at(group).at(key).get<double>();
}

} // namespace

TEST_CASE("widths in km: the cells that they imply, or a factor on them") {
  const Bench bench;
  bench.file("even.msh", raster([](double) { return 240; }));
  const double cells = 4 * pi * radius * radius * 2 / (std::sqrt(3.0) * 240 * 240);
  const nlohmann::json all = plan_report(bench, "--cell-width even.msh");
  CHECK(all["cells"] == calotte::geodesic_count(cells));
  CHECK(all["implied_cells"].get<double>() == doctest::Approx(cells));
  CHECK(number(all, "width_km", "min") == doctest::Approx(240).epsilon(1e-3));
  CHECK(number(all, "gradient", "slope") < 1e-12);
  const nlohmann::json quarter = plan_report(bench, "--cell-width even.msh --cells " +
                                                        std::to_string(std::llround(cells / 4)));
  CHECK(quarter["width_factor"].get<double>() == doctest::Approx(2).epsilon(1e-3));
  CHECK(number(quarter, "width_km", "max") == doctest::Approx(480).epsilon(1e-3));
  CHECK(number(quarter, "width_degrees", "max") ==
        doctest::Approx(480 / radius * 180 / pi).epsilon(1e-3));
}

TEST_CASE("of rules the plan tells where each gives the width") {
  const Bench bench;
  bench.file("line.geojson", R"({"type": "LineString", "coordinates": [[0, 90], [0, 89]]})");
  bench.file("w.toml", "[cell-width]\nminimum = [400, {by-latitude = [[-0.001, 800], [0, 200]]}, "
                       "{around = \"line.geojson\", width = 100, over = 1000}]");
  const nlohmann::json json = plan_report(bench, "--cell-width w.toml");
  REQUIRE(json["rules"].size() == 3);
  CHECK(json["rules"][2]["name"] == "around line.geojson");
  CHECK(json["rules"][0]["area"].get<double>() == doctest::Approx(0.5).epsilon(0.02));
  const double around = json["rules"][2]["area"].get<double>();
  CHECK(json["rules"][2]["cells"].get<double>() ==
        doctest::Approx(16 * around / (0.5 + 4 * (0.5 - around) + 16 * around)).epsilon(0.05));
  CHECK(json["width_seconds"].get<double>() > 0);
  const std::string table = bench.run("plan --cell-width w.toml").out;
  CHECK(has(table, "time of the widths"));
  CHECK(has(table, "  by-latitude "));
  CHECK(has(table, "% of the area, "));
}

TEST_CASE("the steepest gradient of widths grows with the factor on them") {
  const Bench bench;
  // 5 km per degree, and 10 from 30 to 35 N
  bench.file("steps.msh",
             raster([](double latitude) { return 500 + 5 * latitude + (latitude > 30 ? 25 : 0); }));
  const nlohmann::json json = plan_report(bench, "--cell-width steps.msh");
  const double expected = 10 / (radius * pi / 180);
  const double factor = json["width_factor"].get<double>();
  CHECK(number(json, "gradient", "slope") == doctest::Approx(factor * expected).epsilon(1e-4));
  CHECK(number(json, "gradient", "latitude") == doctest::Approx(30).epsilon(0.2));
  const Outcome shown = bench.run("plan --cell-width steps.msh");
  CHECK(has(shown.out, "above 0.03, the limit for most models"));
}

TEST_CASE("a density: spacings and their gradient are those of a profile in closed form") {
  const Bench bench;
  const auto rho = [](double t) {
    constexpr double gamma = 1.0 / 4096;
    return (std::tanh((pi / 6 - t) / 0.2) + 1) / (2 * (1 - gamma)) + gamma;
  };
  constexpr int parts = 100000;
  double root = 0, slope = 0;
  for (int k = 0; k < parts; ++k) {
    const double t = (k + 0.5) * pi / parts, step = pi / parts / 2;
    root += 2 * pi * std::sqrt(rho(t)) * std::sin(t) * pi / parts;
    slope = std::max(slope, (std::pow(rho(t + step), -0.25) - std::pow(rho(t - step), -0.25)) /
                                (2 * step));
  }
  const double unit = std::sqrt(2 / std::sqrt(3.0) * root / 10242);
  const nlohmann::json json = plan_report(bench, "--cells 10242 --density " + bump_density(8));
  CHECK_FALSE(json.contains("width_km"));
  const double degrees = 180 / pi;
  CHECK(number(json, "width_degrees", "min") ==
        doctest::Approx(unit * std::pow(rho(0), -0.25) * degrees).epsilon(1e-4));
  CHECK(number(json, "width_degrees", "max") ==
        doctest::Approx(unit * std::pow(rho(pi), -0.25) * degrees).epsilon(1e-4));
  CHECK(number(json, "gradient", "slope") == doctest::Approx(unit * slope).epsilon(1e-4));
  const nlohmann::json in_km =
      plan_report(bench, "--cells 10242 --sphere-radius 1e6 --density " + bump_density(8));
  CHECK(number(in_km, "width_km", "min") ==
        doctest::Approx(1000 * unit * std::pow(rho(0), -0.25)).epsilon(1e-4));
  CHECK(number(plan_report(bench, "--cells 12 --density uniform"), "gradient", "slope") < 1e-9);
}

TEST_CASE("file sizes are those of the files that cvt writes") {
  const Bench bench;
  const nlohmann::json json = plan_report(bench, "--cells 2562 --density uniform");
  CHECK(bench.run("points icosahedron 2562 -o points.txt").code == 0);
  constexpr double head = 20000;
  for (const auto& [name, key] :
       {std::pair("mesh.nc", "mpas_bytes"), std::pair("mesh.vtp", "vtp_bytes")}) {
    CHECK(bench.run(std::string("delaunay points.txt -o ") + name).code == 0);
    const auto size = static_cast<double>(std::filesystem::file_size(bench.folder() / name));
    CHECK(size >= number(json, "estimates", key));
    CHECK(size <= number(json, "estimates", key) + head);
  }
}

TEST_CASE("the estimates are for the number of threads, and grow with the cells") {
  const Bench bench;
  const nlohmann::json one = plan_report(bench, "--cells 40962 --density uniform --threads 1"),
                       four = plan_report(bench, "--cells 40962 --density uniform --threads 4"),
                       more = plan_report(bench, "--cells 163842 --density uniform --threads 1");
  CHECK(one["estimates"]["threads"] == 1);
  CHECK(four["estimates"]["threads"] == 4);
  CHECK(number(four, "estimates", "seconds") < number(one, "estimates", "seconds") / 2);
  for (const char* key : {"seconds", "memory_bytes", "mpas_bytes", "vtp_bytes"})
    CHECK(number(more, "estimates", key) > 2 * number(one, "estimates", key));
}

TEST_CASE("the widths are drawn on a map") {
  const Bench bench;
  CHECK(bench.run("plan --cells 642 --density " + bump_density(8) + " -o widths.png").code == 0);
  CHECK(bench.file("widths.png").starts_with("\x89PNG"));
  CHECK(bench.run("plan --cells 642 --density " + bump_density(8) + " --no-coastlines -o bare.png")
            .code == 0);
  CHECK(bench.file("bare.png") != bench.file("widths.png"));
  bench.file("even.msh", raster([](double latitude) { return 300 + latitude; }));
  CHECK(bench.run("plan --cell-width even.msh -o widths.svg").code == 0);
  CHECK(has(bench.file("widths.svg"), "<svg"));
}

TEST_CASE("a plan takes what a run takes: starts, fixed points, lines, planes, files of options") {
  const Bench bench;
  bench.file("points.txt", "1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n1 1 1\n-1 1 1\n"
                           "1 -1 1\n1 1 -1\n-1 -1 1\n-1 1 -1\n1 -1 -1\n-1 -1 -1\n");
  CHECK(plan_report(bench, "points.txt")["cells"] == 14);
  bench.file("river.geojson", R"({"type": "LineString", "coordinates": [[0, 0], [20, 0]]})");
  const nlohmann::json river =
      plan_report(bench, "--cell-width 600km --fixed river.geojson --stop tolerance");
  CHECK(river["fixed"].get<int>() > 2);
  const nlohmann::json few = plan_report(bench, "--cells 2562 --iterations 3 --threads 1"),
                       many = plan_report(bench, "--cells 2562 --iterations 30 --threads 1");
  CHECK(number(many, "estimates", "seconds") > 5 * number(few, "estimates", "seconds"));

  bench.file("run.toml", "output = \"grid.nc\"\nreport = \"run.json\"\ncheckpoint = \"state\"\n"
                         "for = \"mpas-atmosphere\"\ncell-width = 500\n"
                         "region = \"circle=10,50,2000km\"\nlimited-area = true\n");
  const nlohmann::json of_file = plan_report(bench, "--config run.toml");
  CHECK(bench.names() == std::set<std::string>{"plan.json", "points.txt", "river.geojson",
                                               "run.toml"}); // no file of the run
  bench.run("cvt --config run.toml --max-iterations 1");
  CHECK(nlohmann::json::parse(bench.file("run.json"))["cells"] == of_file["cells"]);
  bench.file("w.toml", "[cell-width]\nminimum = [400, 600]\n");
  check_refusals(bench, "", R"(
cvt --config w.toml -o a.nc | 2 | w.toml: it holds widths of cells, not options; give --cell-width w.toml
plan --config w.toml | 2 | w.toml: it holds widths of cells, not options; give --cell-width w.toml
)");
}

TEST_CASE(
    "a plan says the extent and the area of its region, in km if widths are, and of a plane") {
  const Bench bench;
  const nlohmann::json disc =
      plan_report(bench, "--cell-width 100km --region circle=-105,40,1000km");
  const double angle = 1000 / radius;
  CHECK(disc["area_km2"].get<double>() ==
        doctest::Approx(2 * pi * radius * radius * (1 - std::cos(angle))).epsilon(1e-3));
  const double degrees = 180 / pi * angle;
  CHECK(disc["extent"]["latitude"][0].get<double>() == doctest::Approx(40 - degrees).epsilon(1e-4));
  CHECK(disc["extent"]["latitude"][1].get<double>() == doctest::Approx(40 + degrees).epsilon(1e-4));
  const double half = 180 / pi * std::asin(std::sin(angle) / std::cos(40 * pi / 180));
  CHECK(disc["extent"]["longitude"][0].get<double>() == doctest::Approx(-105 - half).epsilon(1e-3));
  const auto shown = [&](const std::string& arguments) {
    return check_success(bench, "plan " + arguments).out;
  };
  CHECK(has(shown("--cell-width 100km --region circle=-105,40,1000km"),
            "\nextent                116.8 W to 93.2 W, 31.0 N to 49.0 N\narea                  "
            "3 134 992 km^2, 0.61% of the sphere\n"));
  CHECK(has(shown("--cell-width 100km --region circle=-105,40,1000km --limited-area"),
            ", with those of the rings and some beyond\n"));
  CHECK(has(shown("--cells 200 --periodic 2,1 --walls y"),
            ", with those of a gap beyond the walls\n"));
  CHECK(shown("--hexagons 6,8,10 --walls y") == "cells                 48 regular hexagons\n");
  CHECK(has(shown("--cells 500 --region channel=-90,-40"),
            "\nextent                all longitudes, 90.0 S to 40.0 S\n"));
  CHECK(has(shown("--cells 500 --region circle=179,0,1000km"),
            "extent                170.0 E to 172.0 W"));
  for (const auto& [region, extent] :
       {std::pair("channel=-23.5,23.5", "all longitudes, 23.5 S to 23.5 N"),
        std::pair("box=-180,-20,180,20", "all longitudes, 20.0 S to 20.0 N"),
        std::pair("box=170,60,-170,90", "170.0 E to 170.0 W, 60.0 N to 90.0 N"),
        std::pair("box=10,-90,50,90", "10.0 E to 50.0 E, 90.0 S to 90.0 N"),
        std::pair("circle=20,0,90deg", "70.0 W to 110.0 E, 90.0 S to 90.0 N"),
        std::pair("circle=0,0,120deg", "all longitudes, 90.0 S to 90.0 N")}) {
    CAPTURE(region);
    CHECK(has(shown(std::string("--cells 500 --region ") + region),
              std::string("extent                ") + extent + "\n"));
  }
  const std::string plane = shown("--cells 500 --rectangle 1,0,3,1");
  CHECK(has(plane, "\nextent                x 1 to 3, y 0 to 1\narea                  2\n"));
  CHECK(has(plane, "\ncell width            0.06796 to 0.06796\n")); // sqrt(2 / sqrt 3 2 / 500)
  CHECK(
      has(shown("--cells 500 --periodic 2,1 --density tanh:x=1,y=0.5,beta=0.3,alpha=0.5,gamma=x2"),
          " at x "));
}

TEST_CASE("a plan is in km where widths, a radius or a model give one, and says whether it fits") {
  const Bench bench;
  const auto shown = [&](const std::string& arguments) {
    return check_success(bench, "plan " + arguments).out;
  };
  const auto in_km = [&](const std::string& arguments) {
    return has(shown("--cells 642 " + arguments), "\ncell width, km        ");
  };
  CHECK(!in_km(""));
  CHECK(in_km("--for mpas-atmosphere"));
  CHECK(in_km("--sphere-radius earth"));
  CHECK(in_km("--cell-width 900km"));
  CHECK(in_km("--region circle=10,50,1500km"));
  CHECK(in_km("--region circle=10,50,1500000m"));
  CHECK(!in_km("--region circle=10,50,20deg"));
  CHECK(!in_km("--cell-width 900km --units degrees"));
  CHECK(has(shown("--cells 642"), " MB; it fits into the "));
  CHECK(has(shown("--cells 1000000000"), " of this machine: give fewer cells, or use a larger "));
}

TEST_CASE("a plan and a run of hexagons take the same options, also of a model") {
  const Bench bench;
  bench.file("box.toml", "hexagons = \"6,8,10\"\nwalls = \"y\"\nfor = \"mpas-ocean\"\n");
  CHECK(check_success(bench, "plan --config box.toml").out ==
        "cells                 48 regular hexagons\n");
  CHECK(has(check_success(bench, "cvt --config box.toml -o box.nc").out, "box.nc: 48 hexagons, "));
}

TEST_CASE("bad input ends in one line, and nothing is written") {
  const Bench bench;
  bench.file("metres.msh", raster([](double) { return 30000; }));
  bench.file("place.geojson", R"({"type": "LineString", "coordinates": [[10, 20], [11, 20]]})");
  bench.file("alone.toml", "[cell-width]\naround = \"place.geojson\"\nwidth = 60\nover = 500\n");
  check_refusals(bench, "plan", R"(
-o widths.png --density uniform | 2 | no start: give a file of points, or the number of cells (--cells N), or cell widths
-o widths.txt --cells 162 | 2 | widths.txt: the suffix names no picture format; use .png, .svg, .pdf or .html
-o widths.png --cells auto | 2 | --cells auto requires cell widths; give --cell-width, or a number of cells
-o widths.png --cells 11 | 2 | 11
-o widths.png --cells 100 --sphere-radius 0 | 2 | --sphere-radius 0 is not a positive number; give one such as
-o widths.png --cells 100 --for mpas-ocean --sphere-radius 1 | 2 | --for mpas-ocean needs a sphere with a radius of 6371220
--hexagons 6,8,10 --report plan.json | 2 | --hexagons needs no run; leave --report, --output and --raster out
--hexagons 6,8,10 -o widths.png | 2 | --hexagons needs no run; leave --report, --output and --raster out
--hexagons 6,8,10 --raster a.nc | 2 | --hexagons needs no run; leave --report, --output and --raster out
--hexagons 6,8,10 --units km | 2 | without a run; leave --units out
--hexagons 6,8,10 --sphere-radius earth | 2 | without a run; leave --sphere-radius out
--hexagons 6,8,10 --cells 48 | 2 | without a run; leave --cells out
--rectangle 0,0,2,1 --cells 100 --units km | 2 | a plane has the unit of its coordinates; leave --units out
--rectangle 0,0,2,1 --cells 100 --sphere-radius earth | 2 | --sphere-radius does not apply to the plane
-o widths.png --cells 100 --rectangle 0,0,2,1 | 2 | -o draws widths on the sphere; leave it out for a plane
--cells 100 --start fibonacci --seed 2 | 2 | --seed applies to the starts multilevel, continuation, random and density only
-o widths.png --report plan.json --cell-width absent.nc | 3 | absent.nc
--cells 100 -o widths.gif | 2 | widths.gif
--cells 100 -o same.png --report same.png | 2 | same.png is both picture and report; give the report another name
-o widths.png --cell-width metres.msh | 2 | the widths require 0.654413 cells, but a grid has 12 to 1073741824
-o widths.png --cell-width alone.toml | 2 | no rule gives a width at longitude -180, latitude -90; add one that holds everywhere
)");
}

TEST_CASE("a budget is the number of cells, the memory or the step of the model") {
  const Bench bench;
  const auto report = [&](const std::string& arguments) {
    check_success(bench, "plan --cell-width rules.toml --report plan.json " + arguments);
    return nlohmann::json::parse(bench.file("plan.json"));
  };
  bench.file("rules.toml",
             "[cell-width]\nminimum = [{ by-latitude = [[-90, 300], [0, 600], [90, 300]] }]\n");
  CHECK(report("--budget 5000-cells")["cells"] == 5000);
  const nlohmann::json memory = report("--budget 1GiB --levels 40 --bytes-per-level 1000");
  CHECK(memory["cells"] == (1 << 30) / 40000);
  CHECK(memory["model"]["levels"] == 40);
  CHECK(memory["model"]["memory_bytes"].get<double>() <= 1 << 30);
  const nlohmann::json step = report("--budget step=600s");
  CHECK(step["model"]["step_seconds"].get<double>() == doctest::Approx(600).epsilon(2e-3));
  CHECK(step["model"]["step_seconds"].get<double>() >= 600);
  CHECK(step["width_km"]["min"].get<double>() ==
        doctest::Approx(600 * 125 / 0.9 / 0.83 / 1000).epsilon(2e-3));
  CHECK(report("--budget step=10min")["cells"] == step["cells"]);
  check_success(bench, "cvt --cell-width rules.toml --budget 700-cells -o mesh.nc");
  CHECK(calotte::read_mesh(bench.path("mesh.nc")).points.cols() == 700);
  check_refusals(bench, "plan --cell-width rules.toml", R"(
--budget 24 | 2 | --budget 24: it has no unit
--budget 24km | 2 | "km" is no unit here
--budget -3GB | 2 | that is no positive number
--budget many | 2 | that is no positive number
--budget 1-cells | 2 | 1 cells are out of range
--budget step=10 | 2 | "10" is no time; give a number and its unit, s, min, h or d
--budget step=1ms | 2 | "1ms" is no time
--budget 5000-cells --cells 5000 | 2 | --cells
)");
  check_refusals(bench, "plan", "--density x8 --budget step=10s | 2 | requires cell widths");
}
