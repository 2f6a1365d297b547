// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "io/geojson_text.h"
#include "support/constants.h"

#include "support/files.h"
#include "support/text.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double earth = 6371229;

Eigen::Vector3d lonlat(double longitude, double latitude) {
  const base_detail::Vec3 p = base_detail::from_lonlat(longitude, latitude);
  return {p.x, p.y, p.z};
}

Surface region_from(const std::string& name, const std::string& text) {
  std::istringstream in(text);
  return read_region(in, name);
}

Surface geojson(const std::string& text) { return region_from("R.geojson", text); }

/// A polygon of positions "[0,0],[1,0],[1,1]" for each ring.
std::string polygon_of(const std::vector<std::string>& rings) {
  std::string text;
  for (const std::string& ring : rings)
    text += (text.empty() ? "[" : ",[") + ring + "]";
  return polygon(text);
}

std::string refusal_of_region(const std::string& name, const std::string& text,
                              ErrorCode code = ErrorCode::parse) {
  const Error error = error_of([&] { region_from(name, text); });
  CHECK(error.code() == code);
  return error.what();
}

const std::string square = "[0,0],[20,0],[20,20],[0,20],[0,0]",
                  inner = "[5,5],[10,5],[10,10],[5,10]",
                  inner_clockwise = "[5,10],[10,10],[10,5],[5,5]";

} // namespace

TEST_CASE("GeoJSON: a polygon with a hole, of any winding of the hole") {
  for (const std::string& hole : {inner, inner_clockwise}) {
    const Surface region = geojson(polygon_of({square, hole}));
    CHECK(region.rings().size() == 2);
    CHECK(region.rings()[0].cols() == 4);
    CHECK(region.contains(lonlat(2, 3)));
    CHECK_FALSE(region.contains(lonlat(7, 8)));
    CHECK(region.contains(lonlat(5, 5)));
    CHECK_FALSE(region.contains(lonlat(-100, 8)));
  }
  const double whole = geojson(polygon_of({square})).area(),
               hole = geojson(polygon_of({inner})).area();
  CHECK(geojson(polygon_of({square, inner})).area() ==
        doctest::Approx(whole - hole).epsilon(1e-14));
}

TEST_CASE("GeoJSON: over the date line in each style, and round a pole") {
  for (const std::string& text : {std::string("[170,-10],[-170,-10],[-170,10],[170,10]"),
                                  std::string("[170,-10],[190,-10],[190,10],[170,10]"),
                                  std::string("[-190,-10],[-170,-10],[-170,10],[-190,10]")}) {
    const Surface region = geojson(polygon_of({text}));
    CHECK(region.rings() == geojson(polygon_of({"[170,-10],[190,-10],[190,10],[170,10]"})).rings());
    CHECK(region.contains(lonlat(180, 0)));
    CHECK_FALSE(region.contains(lonlat(0, 0)));
  }
  const std::string east = "[170,-10],[180,-11],[180,11],[170,10]",
                    west = "[-180,-11],[-170,-10],[-170,10],[-180,11]";
  const Surface cut =
      geojson(collection({feature(polygon_of({east})), feature(polygon_of({west}))}));
  CHECK(cut.rings().size() == 1);
  CHECK(cut.rings()[0].cols() == 6);
  CHECK(cut.contains(lonlat(180, 0)));
  CHECK(cut.area() ==
        doctest::Approx(geojson(polygon_of({east})).area() + geojson(polygon_of({west})).area())
            .epsilon(1e-14));

  const Surface pole =
      geojson(polygon_of({"[180,-60],[120,-61],[60,-60],[0,-62],[-60,-60],[-120,-61],[-180,-60]"}));
  CHECK_FALSE(pole.contains(lonlat(0, 90)));
  CHECK(pole.contains(lonlat(0, -90)));
  const Surface spiked =
      geojson(polygon_of({"[180,-60],[120,-61],[60,-60],[0,-62],[-60,-60],[-120,-61]"
                          ",[-180,-60],[-180,-90],[180,-90]"}));
  CHECK(spiked.rings().size() == 1);
  CHECK(spiked.area() == doctest::Approx(pole.area()).epsilon(1e-14));
  CHECK(spiked.contains(lonlat(180, -80)));

  // A channel whose sides meet at 180 degrees.
  const Surface tropics = geojson(
      polygon_of({"[-180,-10],[-60,-10],[60,-10],[180,-10],[180,10],[60,10],[-60,10],[-180,10]"}));
  CHECK(tropics.rings().size() == 2);
  CHECK(tropics.contains(lonlat(180, 0)));
  CHECK_FALSE(tropics.contains(lonlat(0, 90)));
}

TEST_CASE("GeoJSON: a hemisphere is to the left of its ring, whichever way it runs") {
  CHECK(geojson(polygon_of({"[0,0],[120,0],[-120,0]"})).contains(lonlat(0, 90)));
  CHECK(geojson(polygon_of({"[0,0],[-120,0],[120,0]"})).contains(lonlat(0, -90)));
  CHECK(geojson(polygon_of({"[10,-30],[10,50],[-170,40],[-170,-50]"})).contains(lonlat(-80, 0)));
}

TEST_CASE("GeoJSON: several polygons, and what is not one region") {
  const std::string other = "[30,0],[40,0],[40,10],[30,10]";
  const Surface two =
      geojson(R"({"type":"MultiPolygon","coordinates":[[[)" + square + "]],[[" + other + "]]]}");
  CHECK(two.rings().size() == 2);
  CHECK(two.contains(lonlat(35, 5)));
  // An island in a lake.
  const Surface island = geojson(collection(
      {feature(polygon_of({square, inner})), feature(polygon_of({"[6,6],[8,6],[8,8]"}))}));
  CHECK(island.contains(lonlat(7.5, 6.5)));
  CHECK(refusal_of_region("R.geojson",
                          collection({feature(polygon_of({square})), feature(polygon_of({inner}))}),
                          ErrorCode::invalid_argument) ==
        "R.geojson: the region: it is to the left of feature 0: ring 0 and to the right of feature "
        "1: ring 0; give rings that all have it to their left: an outer boundary "
        "counter-clockwise, a hole clockwise");
  CHECK(
      has(refusal_of_region("R.geojson",
                            collection({feature(polygon_of({square})), feature(polygon_of({other})),
                                        feature(polygon_of({"[35,5],[45,5],[45,15]"}))}),
                            ErrorCode::invalid_argument),
          "R.geojson: the region: the edges from feature 1: ring 0, corner 1 and from feature "
          "2: ring 0, corner 0 meet; rings may neither cross nor touch"));
  CHECK(
      has(refusal_of_region("R.geojson", polygon_of({"[0,0],[10,10],[10,0],[0,10]"}),
                            ErrorCode::invalid_argument),
          "R.geojson: the region: the edges from ring 0, corner 0 and from ring 0, corner 2 meet"));
  CHECK(has(refusal_of_region("R.geojson", polygon_of({square, "[30,0],[40,0],[40,10]"}),
                              ErrorCode::invalid_argument),
            "to the right of ring 1"));
  CHECK(has(refusal_of_region("R.geojson",
                              collection({feature(polygon_of({"[0,0],[90,0],[180,0],[-90,0]"})),
                                          feature(polygon_of({"[-90,0],[180,0],[90,0],[0,0]"}))})),
            "R.geojson: its polygons cover the sphere"));
}

TEST_CASE("GeoJSON: a place inside decides, otherwise rings of either orientation enclose") {
  const std::string clockwise = "[0,20],[20,20],[20,0],[0,0]";
  CHECK(geojson(polygon_of({clockwise})).area() == geojson(polygon_of({square})).area());
  CHECK(geojson(polygon_of({clockwise, inner})).contains(lonlat(2, 3)));
  CHECK_FALSE(geojson(polygon_of({clockwise, inner})).contains(lonlat(7, 8)));
  for (const std::string& outer : {square, clockwise})
    for (const std::string& hole : {inner, inner_clockwise}) {
      const Surface land = geojson(feature(polygon_of({outer, hole}), R"({"inside":[2,3]})"));
      CHECK(land.contains(lonlat(2, 3)));
      CHECK_FALSE(land.contains(lonlat(7, 8)));
      CHECK_FALSE(land.contains(lonlat(90, 8)));
      const Surface water = geojson(feature(polygon_of({outer, hole}), R"({"inside":[90,8]})"));
      CHECK_FALSE(water.contains(lonlat(2, 3)));
      CHECK(water.contains(lonlat(7, 8)));
      CHECK(land.area() + water.area() == doctest::Approx(4 * pi).epsilon(1e-15));
    }
  CHECK(has(refusal_of_region("R.geojson", feature(polygon_of({square}), R"({"inside":[0,5]})"),
                              ErrorCode::invalid_argument),
            "R.geojson: the place that is to be inside the region is on its boundary"));
  CHECK(has(refusal_of_region("R.geojson", feature(polygon_of({square}), R"({"inside":"here"})")),
            "its property \"inside\" is not a position [longitude, latitude]; give degrees"));
  CHECK(has(refusal_of_region("R.geojson", feature(polygon_of({square}), R"({"inside":[5,95]})")),
            "its property \"inside\" is [5.0, 95.0], no longitude"));
}

TEST_CASE("GeoJSON: the whole band between two parallels, cut at 180 degrees") {
  std::string south, north;
  for (int longitude = -180; longitude <= 180; longitude += 10) {
    south += "[" + std::to_string(longitude) + ",-60],";
    north += "[" + std::to_string(-longitude) + ",60.00000000000001],";
  }
  const Surface band = geojson(polygon_of({south + north + "[-180,-60]"}));
  CHECK(band.rings().size() == 2);
  CHECK(band.contains(lonlat(180, 0)));
  CHECK_FALSE(band.contains(lonlat(0, 90)));
  CHECK_FALSE(band.contains(lonlat(0, -90)));
  // Arcs of 10 degrees rise above the parallels.
  CHECK(band.area() == doctest::Approx(4 * pi * std::sin(60 * degree)).epsilon(0.01));
}

TEST_CASE("GeoJSON: an ocean around a pole whose cut differs by rounding") {
  const std::string around = "[-180,65.5],[-90,70],[0,72],[90,71],[180,";
  const Surface exact = geojson(polygon_of({around + "65.5],[180,90],[-180,90],[-180,65.5]"}));
  for (const std::string end : {"65.50000000000003", "65.49999999999997", "65.5000000001"}) {
    const Surface region = geojson(polygon_of({around + end + "],[180,90],[-180,90],[-180,65.5]"}));
    CHECK(region.rings().size() == 1);
    CHECK(region.area() == doctest::Approx(exact.area()).epsilon(1e-9));
    CHECK(region.contains(lonlat(180, 80)));
  }
}

TEST_CASE("GeoJSON: positions") {
  CHECK(has(refusal_of_region("R.geojson", polygon_of({square, "[0,0],[0,91],[1,1]"})),
            "R.geojson: position 1 of ring 1 is [0.0, 91.0], no longitude and latitude in "
            "degrees; give longitude first"));
  CHECK(has(refusal_of_region("R.json", polygon_of({"[0,0],[0,1e999],[1,1]"})),
            "a number that no double can hold"));
  CHECK(has(refusal_of_region("R.geojson", polygon_of({"[-180,-20],[180,-20],[180,20],[-180,20]"})),
            "ring 0 has fewer than 3 distinct places; an edge is the shorter arc of a great "
            "circle, so give more places "
            "along a parallel"));
  CHECK(has(refusal_of_region("R.geojson", polygon_of({"[0,0],[180,0],[90,10]"}),
                              ErrorCode::invalid_argument),
            "ring 0, corner 0 and the next are opposite"));
  CHECK(geojson(polygon_of({"[0,0],[0,0],[20,0],[20,20],[20,20],[0,0],[0,0]"})).rings()[0].cols() ==
        3);
}

// ---- MPAS-Limited-Area

TEST_CASE(".pts: circles, ellipses and channels") {
  const Surface circular = region_from(
      "india.pts", "Name: india\nType: circle\nPoint: 20.0, 80.0\nradius: 2000000.0   # Meters\n");
  CHECK(circular == circle(lonlat(80, 20), 2e6 / earth));
  const Surface oval =
      region_from("japan.PTS", "name: japan\nTYPE:Ellipse\r\n point : 38 , 138\nSemi-major-axis: "
                               "1580000\nSemi-minor-axis: 1e6\nOrientation-angle: 45\n");
  CHECK(oval == ellipse(lonlat(138, 38), 1.58e6 / earth, 1e6 / earth, 45 * degree));
  for (const std::string& text :
       {std::string("ulat: 23.4\nllat: -10\n"), std::string("Upper-lat: 23.4\nLower-lat: -10\n")})
    CHECK(region_from("tropics.pts", "Name: tropics\nType: channel\n" + text) ==
          channel(-10 * degree, 23.4 * degree));
}

TEST_CASE(".pts: a polygon around its point, of any winding") {
  const std::string head = "Name: conus\nType: custom\nPoint: 40.0, -100.0\n",
                    corners = "50.0, -129.0\n50.0, -65.0\n20.0, -65.0\n20.0, -129.0\n",
                    reverse = "20.0, -129.0\n20.0 -65.0\n50.0, -65.0\n50.0, -129.0\n20,-129\n";
  const Surface region = region_from("conus.custom.pts", head + corners);
  CHECK(region.contains(lonlat(-100, 40)));
  CHECK(region.area() < 1);
  CHECK(region_from("conus.pts", head + reverse).area() ==
        doctest::Approx(region.area()).epsilon(1e-14));
  const Surface rest = region_from("conus.pts", "Type: custom\nPoint: -40, 100\n" + corners);
  CHECK(rest.area() + region.area() == doctest::Approx(4 * pi).epsilon(1e-15));

  CHECK(has(refusal_of_region("a.pts", "Type: custom\n" + corners),
            "a.pts: a region of the type custom has no line \"Point:\"; add a place inside it"));
  CHECK(has(refusal_of_region("a.pts", head + "50, -129\n50 -65\n20\n"),
            "a.pts line 6: \"20\" is no place"));
  CHECK(has(refusal_of_region("a.pts", head + "50, -129\n50 -65\n", ErrorCode::invalid_argument),
            "a.pts: the region: ring 0 has 2 corners"));
  CHECK(has(refusal_of_region("a.pts", head + "50, -129\n20, -65\n50, -65\n20, -129\n",
                              ErrorCode::invalid_argument),
            "meet; rings may neither"));
}

TEST_CASE(".pts: lines that are none") {
  for (const auto& [text, words] : std::vector<std::array<std::string, 2>>{
           {"Typ: circle\n", "a.pts line 1: \"typ\" is no keyword; write Name, Type"},
           {"Name: x\n",
            "a.pts: no line \"Type:\"; write Type: custom, circle, ellipse or channel"},
           {"Type: square\n", "a.pts: the type \"square\" is unknown; write Type: custom"},
           {"Type: circle\nPoint: 1, 2\n",
            "a region of the type circle has no line \"radius:\"; add it"},
           {"Type: circle\nRadius: 385.5 km\n",
            "line 2: \"385.5 km\" is no radius; write a number of metres"},
           {"Type: channel\nUpper-lat: 100\n",
            "\"100\" is no upper-lat; write a number of degrees"},
           {"Type: circle\nPoint: 1, 2\nRadius: 1000\n1, 2\n",
            "corners, which only Type: custom takes"},
           {"Point: 100, 2\n", "a.pts line 1: \"100, 2\" is no place; write latitude"}})
    CHECK(has(refusal_of_region("a.pts", text), words));
  CHECK(has(refusal_of_region("a.pts", "Type: channel\nUpper-lat: 10\nLower-lat: 20\n",
                              ErrorCode::invalid_argument),
            "a.pts: the channel's latitudes are"));
}

TEST_CASE("a file cut short is read or refused, with one line") {
  const Scratch folder;
  const auto cut = [&](const std::string& name, const std::string& text) {
    write_text(folder / name, text);
    return done_when_cut(folder / name, [&] { read_region(folder / name); });
  };
  CHECK(cut("R.geojson", collection({feature(polygon_of({square, inner}))})) == 0);
  CHECK(cut("R.pts", "Type: custom\nPoint: 1, 1\n0, 0\n0, 20\n20, 20.000000000000\n") > 0);
}

TEST_CASE("names and files") {
  CHECK(has(refusal_of_region("region.txt", "", ErrorCode::invalid_argument),
            "region.txt: the name determines no format of regions"));
  CHECK(code_of([] { read_region("/nowhere/R.geojson"); }) == ErrorCode::file);
  CHECK(has(refusal_of_region("R.geojson", "{"), "R.geojson: no JSON"));
}
