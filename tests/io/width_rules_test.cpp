// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command.h"
#include "support/directions.h"
#include "support/files.h"
#include "support/text.h"

#include <calotte/error.h>
#include <calotte/ocean.h>
#include <calotte/read.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>
#include <netcdf.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

// Files of rules against the same rules in C++, and what is refused, with its line.

using namespace calotte;
using calotte::test::Scratch;

namespace {

Points3 sample_points() {
  Points3 points(3, 5);
  points << 1, 0, 0, 0.6, -0.36, 0, 1, 0, 0, 0.48, 0, 0, 1, 0.8, 0.8;
  return points;
}

/// A folder with a line from 10 W to 10 E on the equator, an island, and a file of rules.
class Rules {
public:
  Rules() {
    test::write_text(folder_ / "line.geojson",
                     R"({"type": "LineString", "coordinates": [[-10, 0], [10, 0]]})");
    test::write_text(
        folder_ / "island.geojson",
        R"({"type": "Polygon", "coordinates": [[[0, 0], [20, 0], [20, 20], [0, 0]]]})");
    test::write_text(folder_ / "islands.geojson", R"({"type": "MultiPolygon", "coordinates":
        [[[[-9, -5], [-1, -5], [-1, 5], [-9, -5]]], [[[9, 5], [1, 5], [1, -5], [9, 5]]]]})");
    test::write_text(folder_ / "points.txt", "0 90\n180 0\n");
  }
  std::string path() const { return folder_ / "w.toml"; }
  std::string beside(const std::string& name) const { return folder_ / name; }

  WidthRules read(const std::string& text) const {
    test::write_text(path(), text);
    return read_width_rules(path());
  }
  DoubleVector widths(const std::string& text) const {
    return evaluate(read("[cell-width]\n" + text).widths, sample_points());
  }
  /// Without the name of the file.
  std::string refused(const std::string& text) const {
    const std::string message = test::error_of([&] { read(text); }).what();
    REQUIRE(message.starts_with(path()));
    return message.substr(path().size());
  }

private:
  Scratch folder_;
};

/// A raster of one value at three latitudes, by default from pole to pole, and four longitudes.
void write_raster(const std::string& path, double value,
                  const std::array<double, 3>& south_to_north = {-90, 0, 90},
                  const std::array<double, 4>& eastward = {0, 90, 180, 270}) {
  int file = 0, lat = 0, lon = 0, latitudes = 0, longitudes = 0, heights = 0;
  REQUIRE(nc_create(path.c_str(), NC_CLOBBER, &file) == NC_NOERR);
  CHECK(nc_def_dim(file, "lat", 3, &lat) == NC_NOERR);
  CHECK(nc_def_dim(file, "lon", 4, &lon) == NC_NOERR);
  const std::array<int, 2> both{lat, lon};
  CHECK(nc_def_var(file, "lat", NC_DOUBLE, 1, &lat, &latitudes) == NC_NOERR);
  CHECK(nc_def_var(file, "lon", NC_DOUBLE, 1, &lon, &longitudes) == NC_NOERR);
  CHECK(nc_def_var(file, "z", NC_DOUBLE, 2, both.data(), &heights) == NC_NOERR);
  CHECK(nc_enddef(file) == NC_NOERR);
  const std::vector<double> values(12, value);
  CHECK(nc_put_var_double(file, latitudes, south_to_north.data()) == NC_NOERR);
  CHECK(nc_put_var_double(file, longitudes, eastward.data()) == NC_NOERR);
  CHECK(nc_put_var_double(file, heights, values.data()) == NC_NOERR);
  CHECK(nc_close(file) == NC_NOERR);
}

} // namespace

TEST_CASE("each rule of a file is that of the library") {
  const Rules rules;
  const Points3 line = read_lines(rules.beside("line.geojson")).front();
  const WidthProfile grows{{{0, 10}, {600, 60}}};
  CHECK(rules.widths("width = 60") == DoubleVector::Constant(5, 60));
  CHECK(rules.widths("by-latitude = [[-90, 35], [0, 60], [90, 20]]") ==
        evaluate(Widths::by_latitude({{{-90, 35}, {0, 60}, {90, 20}}}), sample_points()));
  CHECK(rules.widths("by-distance = \"line.geojson\"\nnear = 10\nfar = 60\nover = 600") ==
        evaluate(Widths::by_distance({line}, grows), sample_points()));
  CHECK(rules.widths("by-distance = \"line.geojson\"\nprofile = [[0, 10], [600, 60]]\n"
                     "smooth = true") ==
        evaluate(Widths::by_distance({line}, {grows.nodes, true}), sample_points()));
  CHECK(rules.widths("by-distance = \"island.geojson\"\nnear = 10\nfar = 60\nover = 600") ==
        evaluate(Widths::by_distance(shores(read_coast(rules.beside("island.geojson"))), grows),
                 sample_points()));
  CHECK(rules.widths("minimum = [50, {by-channel = \"islands.geojson\", cells = 4, least = 10}]") ==
        evaluate(
            Widths::minimum({50.0, Widths::by_channel(read_coast(rules.beside("islands.geojson")),
                                                      {.cells = 4, .least = 10})}),
            sample_points()));
  const Coast island = read_coast(rules.beside("island.geojson"));
  CHECK(rules.widths(
            "by-distance = \"island.geojson\"\nprofile = [[-200, 60], [0, 10], [600, 60]]") ==
        evaluate(Widths::by_distance(island, {{{-200, 60}, {0, 10}, {600, 60}}}), sample_points()));
  CHECK(rules.widths("by-distance = \"island.geojson\"\nnear = 10\nfar = 60\nover = 600\n"
                     "side = \"land\"") ==
        evaluate(Widths::by_distance(island, grows, CoastSide::land), sample_points()));
  const Points3 points = read_points(rules.beside("points.txt"), Columns::lonlat);
  CHECK(rules.widths("by-distance = \"points.txt\"\nnear = 10\nfar = 60\nover = 600") ==
        evaluate(Widths::by_distance({Points3(points.col(0)), Points3(points.col(1))}, grows),
                 sample_points()));
  CHECK(rules.widths("gradient = 0.03\nminimum = [50, {by-latitude = [[0, 60], [90, 20]]}, "
                     "{by-distance = \"line.geojson\", near = 10, far = 60, over = 600}]") ==
        evaluate(Widths::minimum({50.0, Widths::by_latitude({{{0, 60}, {90, 20}}}),
                                  Widths::by_distance({line}, grows)})
                     .limit_gradient(0.03),
                 sample_points()));
  CHECK(rules.widths("sum = [30, 5]\ntimes = 2\nmost = 65") == DoubleVector::Constant(5, 65));
}

TEST_CASE("a rule for a part says nothing elsewhere") {
  const Rules rules;
  const DoubleVector band =
      rules.widths("minimum = [60, {around = \"line.geojson\", width = 5, over = 200}]");
  CHECK(band == DoubleVector{{5, 60, 60, 60, 60}});
  const DoubleVector part = rules.widths("width = 5\nwithin = \"island.geojson\"");
  CHECK(part[2] >= Widths::no_demand);
  write_raster(rules.beside("half.nc"), 0.5);
  CHECK(rules.widths("width = 5\nwithin = \"half.nc\"") == DoubleVector::Constant(5, 5));
  CHECK(rules.widths("blend = [20, 30]\nshare = \"half.nc\"") == DoubleVector::Constant(5, 25));
  const Surface island = read_region(rules.beside("island.geojson"));
  CHECK(rules.widths("blend = [60, 20]\nshare = \"island.geojson\"") ==
        evaluate(Widths::where(island, 20.0, 60.0), sample_points()));
  CHECK(rules.widths("blend = [60, 20]\nshare = \"island.geojson\"\nover = 3000") ==
        evaluate(Widths::blend(60.0, 20.0, WidthShare(island, {{{0, 1}, {3000, 0}}})),
                 sample_points()));
  CHECK(rules.widths(
            "blend = [60, 20]\nshare = \"island.geojson\"\nprofile = [[-500, 1], [0, 0.5]]") ==
        evaluate(Widths::blend(60.0, 20.0, WidthShare(island, {{{-500, 1}, {0, 0.5}}})),
                 sample_points()));
  const DoubleVector land = rules.widths("blend = [60, 20]\nshare = \"island.geojson\"\nleast-area "
                                         "= 1\nprofile = [[-500, 1], [0, 0.5]]");
  CHECK((land - evaluate(Widths::blend(60.0, 20.0, WidthShare(island, {{{-500, 1}, {0, 0.5}}})),
                         sample_points()))
            .cwiseAbs()
            .maxCoeff() < 1e-9);
  CHECK(rules
            .refused("[cell-width]\nblend = [60, 20]\nshare = \"island.geojson\"\n"
                     "least-area = 1e9\nover = 5")
            .find("all land of the coast is smaller than the least area") != std::string::npos);
  CHECK(rules.refused("[cell-width]\nblend = [60, 20, 5]\nshare = \"half.nc\"") ==
        " line 2: blend holds 3 rules; give [A, B]");
  CHECK(rules.refused("[cell-width]\nblend = [60, 20]\nshare = 1") ==
        " line 3: share is no text; give a region in quotes");
  CHECK(rules.read("[cell-width]\nstep = 0.5\nwidth = 60").widths.step() == 0.5);
  test::write_text(rules.path(),
                   "[cell-width]\nminimum = [{by-distance = \"a.nc\"}, {within = \"b.pts\"}, "
                   "{within = \"box=0,0,9,9\"}, {share = \"land=c.nc,1,2\"}]");
  CHECK(files_of_rules(rules.path()) == std::vector<std::string>{rules.beside("a.nc"),
                                                                 rules.beside("b.pts"),
                                                                 rules.beside("c.nc")});
}

TEST_CASE("a region of a rule is a shape by words, too") {
  const Rules rules;
  CHECK(rules.widths("width = 5\nwithin = \"circle=90,0,500km\"") ==
        evaluate(Widths::where(circle({0, 1, 0}, 500 / earth_radius_km), 5.0, Widths::no_demand),
                 sample_points()));
  CHECK(rules.widths("blend = [60, 20]\nshare = \"box=-20,-20,60,60\"\nover = 3000") ==
        evaluate(Widths::blend(60.0, 20.0,
                               WidthShare(read_region("box=-20,-20,60,60"), {{{0, 1}, {3000, 0}}})),
                 sample_points()));
  CHECK(rules.widths("width = 5\nwithin = \"land=island.geojson,15,5\"") ==
        rules.widths("width = 5\nwithin = \"island.geojson\""));
  CHECK(rules.refused("[cell-width]\nwidth = 5\nwithin = \"circle(0,0,9km)\"") ==
        " line 1: circle(0,0,9km): this is no shape; write circle=LON,LAT,RADIUS, as in "
        "circle=-105,40,1000km");
}

TEST_CASE("islands and lakes below the least area of a rule do not count") {
  const Rules rules;
  const Coast all = read_coast(rules.beside("islands.geojson"));
  test::write_text(rules.beside("few.geojson"), R"({"type": "MultiPolygon", "coordinates":
      [[[[-9, -5], [-1, -5], [-1, 5], [-9, -5]]], [[[50, 5], [50.1, 5], [50.1, 5.1], [50, 5]]]]})");
  const std::string grows = "near = 10\nfar = 60\nover = 600\n",
                    few = "by-distance = \"few.geojson\"\n";
  const Coast large = without_small(read_coast(rules.beside("few.geojson")), 1000, earth_radius_km);
  CHECK(large.rings.size() == 1);
  const WidthProfile profile{{{0, 10}, {600, 60}}};
  CHECK(rules.widths(few + grows + "least-area = 1000") ==
        evaluate(Widths::by_distance(shores(large), profile), sample_points()));
  CHECK(rules.widths(few + grows + "side = \"sea\"\nleast-area = 1000") ==
        evaluate(Widths::by_distance(large, profile, CoastSide::sea), sample_points()));
  CHECK(rules.widths("minimum = [50, {by-channel = \"islands.geojson\", cells = 4, least = 10, "
                     "least-area = 1000}]") ==
        evaluate(Widths::minimum({50.0, Widths::by_channel(all, {.cells = 4, .least = 10})}),
                 sample_points()));
  CHECK(rules.refused("[cell-width]\n" + few + grows + "least-area = 1e9") ==
        " line 1: all land of the coast is smaller than the least area; give a smaller one");
}

TEST_CASE("the raster of a rule is the only one of its file, or a variable that it names") {
  const Rules rules;
  write_raster(rules.beside("one.nc"), 77);
  CHECK(rules.widths("raster = \"one.nc\"") == DoubleVector::Constant(5, 77));
  CHECK(rules.widths("raster = \"one.nc\"\nvariable = \"z\"") == DoubleVector::Constant(5, 77));
  const std::string message =
      test::error_of([&] { rules.widths("raster = \"one.nc\"\nvariable = \"w\""); }).what();
  CHECK(message == rules.beside("one.nc") + ": no variable w; there are z");
}

TEST_CASE("the rules of a minimum have names") {
  const Rules rules;
  CHECK(rules
            .read("[cell-width]\ngradient = 10\ntimes = 2\nminimum = [100, {by-latitude = [[-90, "
                  "200]]}, "
                  "{around = \"line.geojson\", width = 5, over = 200}]")
            .names == std::vector<std::string>{"width 100", "by-latitude", "around line.geojson"});
  CHECK(rules.read("[cell-width]\nwidth = 60").names == std::vector<std::string>{"width 60"});
}

TEST_CASE("distances and gradients of rules are those of the sphere that the widths are for") {
  const Rules rules;
  constexpr double radius = 3389.5;
  test::write_text(rules.path(),
                   "[cell-width]\nstep = 2\nminimum = [{by-distance = \"points.txt\", "
                   "near = 10, far = 100, over = 4000}, {polygons = "
                   "\"island.geojson\", inside = 20, outside = 300, "
                   "transition = 1000, gradient = 0.05}]");
  const Widths read = read_width_rules(rules.path(), {}, radius).widths;
  const Widths made = Widths::minimum(
      {Widths::by_distance({test::directions({{0, 90}}), test::directions({{180, 0}})},
                           {{{0, 10}, {4000, 100}}})
           .on_sphere(radius),
       Widths(
           read_cell_width(rules.beside("island.geojson"),
                           {.inside = 20, .outside = 300, .transition = 1000, .radius_km = radius}))
           .on_sphere(radius)
           .limit_gradient(0.05)});
  CHECK(evaluate(read, sample_points()) == evaluate(made, sample_points()));
  const Raster raster = read_cell_width(rules.path(), {.radius_km = radius});
  CHECK(raster.y.size() == 91);
  CHECK(raster.values == sampled(made, {}, 2).values);
}

TEST_CASE("heights of a file give the widths of waves") {
  const Rules rules;
  write_raster(rules.beside("sea.nc"), -4000);
  const DoubleVector widths =
      rules.widths("by-depth = \"sea.nc\"\nperiod = \"12.42h\"\ncells = 60\nleast = 2");
  CHECK(widths[0] == doctest::Approx(std::sqrt(9.80665 * 4000) * 12.42 * 3600 / 60 / 1000));
  for (const std::string period : {"12.42", "-1h", "1 week"})
    CHECK(rules.refused("[cell-width]\nby-depth = \"sea.nc\"\nperiod = \"" + period +
                        "\"\ncells = 60\nleast = 2") ==
          " line 3: period \"" + period +
              "\" is no time; give a number and its unit, s, min, h or d, such as 12.42h");
  CHECK(rules.refused("[cell-width]\nby-depth = \"sea.nc\"\nslope = 5") ==
        " line 1: the rule needs least; give a number");
}

TEST_CASE("a raster of a rule covers the sphere, or the region that the rule is for") {
  const Rules rules;
  write_raster(rules.beside("part.nc"), -4000, {40, 50, 60}, {-10, 0, 10, 20});
  write_raster(rules.beside("widths.nc"), 60, {40, 50, 60}, {-10, 0, 10, 20});
  for (const std::string rule : {"by-depth = \"part.nc\"\nslope = 5\nleast = 2",
                                 "raster = \"widths.nc\"\nvariable = \"z\""}) {
    const auto refused = [&](const std::string& within) {
      return test::message_of([&] { rules.widths(rule + within); });
    };
    CHECK(test::has(refused(""), ".nc: lon runs from -10 to 20"));
    CHECK(test::has(refused("\nwithin = \"box=0,30,30,50\""), "leaves out the place "));
  }
  const DoubleVector widths =
      rules.widths("by-depth = \"part.nc\"\nperiod = \"12.42h\"\ncells = 60\nleast = 2\n"
                   "within = \"box=-5,45,15,58\"");
  CHECK(widths[3] == doctest::Approx(std::sqrt(9.80665 * 4000) * 12.42 * 3600 / 60 / 1000));
  CHECK(!Widths::is_demand(widths[0]));
  CHECK(!Widths::is_demand(widths[4]));
}

TEST_CASE("a distance that is farther than any place names its key") {
  const Rules rules;
  const std::string problem =
      "over is 1000000 km, and distances are 0 to 300000; give km, not metres";
  CHECK(rules.refused("[cell-width]\nby-distance = \"line.geojson\"\nnear = 60\nfar = 300\n"
                      "over = 1000000") == " line 5: " + problem);
  CHECK(rules.refused("[cell-width]\naround = \"line.geojson\"\nwidth = 30\nover = 1000000") ==
        " line 4: " + problem);
}

TEST_CASE("rules of a plane: files of x and y, and a limit that is left to the domain") {
  const Rules rules;
  const Surface plane = rectangle({0, 0}, {200, 100});
  test::write_text(rules.beside("pier.geojson"),
                   R"({"type": "LineString", "coordinates": [[100, 500], [100, 20]]})");
  test::write_text(rules.beside("bay.txt"), "0 0\n50 0\n50 50\n0 50\n");
  test::write_text(rules.path(), "[cell-width]\ngradient = 0.2\nstep = 5\nminimum = [\n"
                                 "{by-distance = \"pier.geojson\", near = 1, far = 9, over = 80},\n"
                                 "{width = 2, within = \"bay.txt\"}]");
  const WidthRules read = read_width_rules(rules.path(), plane);
  CHECK(read.gradient == 0.2);
  const Raster raster = read_cell_width(rules.path(), {}, plane);
  CHECK(raster.x[1] - raster.x[0] == 5);
  CHECK(limit_gradient(raster, 0.2, plane).values == raster.values);
  const DoubleVector widths = evaluate(read.widths, Points2{{100, 140, 25}, {50, 50, 25}});
  CHECK(widths[0] == doctest::Approx(1));
  CHECK(widths[1] == doctest::Approx(5));
  CHECK(widths[2] == doctest::Approx(2));
  const auto refused = [&](const std::string& text) {
    test::write_text(rules.path(), text);
    const std::string message =
        test::error_of([&] { read_width_rules(rules.path(), plane); }).what();
    return message.substr(rules.path().size());
  };
  CHECK(refused("[cell-width]\n\nby-latitude = [[0, 60]]") ==
        " line 3: by-latitude applies to the sphere only; in a plane give by-distance, around, "
        "raster or width");
  CHECK(refused("[cell-width]\nby-distance = \"pier.geojson\"\nnear = 1\nfar = 2\nover = 3\n"
                "side = \"sea\"")
            .starts_with(" line 6: the rule does not take side"));
}

TEST_CASE("files of rules that are none are refused with their line") {
  const Rules rules;
  CHECK(rules.refused("width = 60") ==
        ": a file of widths has one table, [cell-width]; see calotte help widths");
  CHECK(rules.refused("[cell-width]\nwidths = 60") ==
        " line 2: a rule has one of the keys minimum, maximum, sum, blend, by-latitude, "
        "by-distance, around, by-channel, by-depth, raster, polygons, width; this one has widths");
  CHECK(rules.refused("[cell-width]\nwidth = -60") ==
        " line 2: width is not a positive number; give one without quotes or unit");
  CHECK(rules.refused("[cell-width]\n\nminimum = [60,\n {width = 5, over = 3}]") ==
        " line 4: the rule does not take over; it takes gradient, least, most, times, width, "
        "within; see calotte help widths");
  CHECK(rules.refused("[cell-width]\nby-latitude = [[0, 60], [10]]") ==
        " line 2: by-latitude holds no pair at place 1; give [[number, width], ...]");
  CHECK(rules.refused("[cell-width]\nby-latitude = [[0, 60], [100, 10]]") ==
        " line 1: node 1 of a profile of the latitude is at 100, outside -90 to 90; correct it");
  CHECK(rules.refused("[cell-width]\nby-distance = \"line.geojson\"\nnear = 10") ==
        " line 1: the rule needs far; give a number");
  CHECK(
      rules.refused("[cell-width]\nby-distance = \"island.geojson\"\nnear = 1\nfar = 2\nover = 3\n"
                    "side = \"left\"") == " line 6: side is \"left\"; give sea or land");
  CHECK(rules.refused("[cell-width]\nby-latitude = [[0, 60]]\nmost = 20\nleast = 30") ==
        " line 4: least is 30, above most, 20; exchange them");
  for (const std::string key : {"raster", "polygons"})
    CHECK(rules.refused("[cell-width]\n" + key + " = \"W.TOML\"") ==
          " line 2: " + key + " is a file of rules; write its rules in this file");
  CHECK(rules.refused("[cell-width]\nminimum = []") ==
        " line 2: minimum holds no rules; give [{...}, {...}]");
  CHECK(rules.refused("[cell-width]\nwidth = 5\nsmooth = true")
            .starts_with(" line 3: the rule does not take smooth"));
  CHECK(test::error_of([&] {
          rules.read("[cell-width]\nby-distance = \"none.nc\"\nnear = 1\nfar = 2\nover = 3");
        }).code() == ErrorCode::file);
}
