// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte::test;

namespace {

/// A run's mesh and report.
void make_run(const Bench& bench, const std::string& name) {
  const Outcome outcome =
      bench.run("cvt --cells 162 --stop tolerance --tolerance 1e-2 --density " + bump_density(2) +
                " -o " + name + ".vtp --report " + name + ".json");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
}

} // namespace

TEST_CASE("the reports of calotte cvt become a picture of convergence") {
  const Bench bench;
  make_run(bench, "a");
  make_run(bench, "b");
  const Outcome one = bench.run("draw --history a.json -o a.png --size 300");
  CHECK(one.code == 0);
  CHECK(one.err.empty());
  CHECK(one.out == "a.png: convergence of 1 run\n");
  CHECK(bench.file("a.png").starts_with("\x89PNG"));
  const Outcome two = bench.run("draw --history a.json b.json -o two.svg");
  CHECK(two.out == "two.svg: convergence of 2 runs\n");
  CHECK(bench.file("two.svg").ends_with("</svg>\n"));
}

TEST_CASE("a mesh and its density become a picture of the spacing law") {
  const Bench bench;
  make_run(bench, "a");
  const Outcome outcome =
      bench.run("draw a.vtp --spacing-law --density " + bump_density(2) + " -o law.pdf");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out == "law.pdf: spacing law of 162 sites, 320 triangles\n");
  CHECK(bench.file("law.pdf").starts_with("%PDF-"));
}

TEST_CASE("the options of one picture are refused for another, before anything is read") {
  const Bench bench;
  check_refusals(bench, "draw", R"(
-o a.png | 2 | MESH is required; see calotte draw --help
a.vtp -o a.png --colour blue | 2 | --colour: "blue" is not one of spacing, angle, valence (or degree),
a.vtp -o a.png --colour field: | 2 | --colour: "field:" is not one of spacing,
-o a.png --density uniform --what cells | 2 | --what: MESH is required
a.vtp -o a.png --spacing-law --density uniform --view 1,2 | 2 | --view excludes --spacing-law
a.vtp --history a.json -o a.png | 2 | MESH excludes --history
--history a.json -o a.png --what cells | 2 | --what excludes --history
--history a.json -o a.png --spacing-law | 2 | --history excludes --spacing-law
--history a.json -o a.png --density uniform | 2 | --density excludes --history
--history a.json -o a.png --projection globe | 2 | --projection excludes --history
--history 1 2 3 4 5 6 7 8 9 -o a.png | 2 | --history: At Most 8 required but received 9
--history a.json -o a.gif | 2 | a.gif: the suffix names no picture format; use .png, .svg or .pdf
a.vtp -o a.png --spacing-law | 2 | --spacing-law requires a density; give --density or --cell-width
a.vtp -o a.png --colour density | 2 | --colour density requires a density; give --density or
a.vtp -o a.png --density uniform | 2 | a mesh with a density requires --colour density or --spacing-law
-o a.png --density uniform --colour valence | 2 | a picture of a density is coloured by density or spacing
a.vtp -o a.png --range 1 | 2 | --range 1 is no range of a colour bar; give its lower and its upper end
a.vtp -o a.png --range 1,1 | 2 | --range 1,1 is no range
a.vtp -o a.png --range a,b | 2 | --range a,b is no range
a.vtp -o a.png --range 1,2,3 | 2 | --range 1,2,3 is no range
a.vtp -o a.png --range nan,1 | 2 | --range nan,1 is no range
a.vtp -o a.png --range 0,inf | 2 | --range 0,inf is no range
a.vtp -o a.png --palette jet | 2 | --palette: jet not in {viridis,
a.vtp -o a.png --zoom 0.5 | 2 | --zoom 0.5 is no enlargement; give auto, whole or a number from 1 to 2000
a.vtp -o a.png --zoom 3000 | 2 | --zoom 3000 is no enlargement
a.vtp -o a.png --zoom 2x | 2 | --zoom 2x is no enlargement
a.vtp -o a.png --colour error:vorticity | 2 | is not error: with one of divergence, gradient, laplacian,
)");
}

TEST_CASE("a mesh is drawn on either map, by its shapes and by what they are coloured by") {
  const Bench bench;
  make_run(bench, "a");
  const std::vector<std::string> looks = {
      "--projection plate-carree --view 180,0 --graticule --what both --colour area",
      "--projection globe --colour quality", "--colour degree --what cells",
      "--colour density --what cells --density " + bump_density(2)};
  for (const std::string& options : looks) {
    const Outcome outcome = bench.run("draw a.vtp -o a.png --size 200 " + options);
    CAPTURE(options);
    CHECK(outcome.err.empty());
    CHECK(outcome.out == "a.png: picture of 162 sites, 320 triangles\n");
    CHECK(bench.file("a.png").starts_with("\x89PNG"));
  }
}

TEST_CASE("range, palette and title of a picture") {
  const Bench bench;
  make_run(bench, "a");
  const auto drawn = [&](const std::string& options) {
    const Outcome outcome = bench.run("draw a.vtp -o a.svg --size 300 " + options);
    CAPTURE(options);
    CHECK(outcome.err.empty());
    CHECK(outcome.code == 0);
    return bench.file("a.svg");
  };
  const std::string usual = drawn("");
  CHECK(drawn("--palette viridis") == usual);
  std::set<std::string> all{usual};
  for (const char* options :
       {"--palette magma", "--palette cividis", "--palette diverging", "--range 10,20",
        "--range 10,30", "--range 10,30 --scale log", "--title 'My grid'"})
    CHECK(all.insert(drawn(options)).second);
  CHECK(bench
            .run("draw --density " + bump_density(2) +
                 " -o b.png --range 0,2 --palette magma --title x --size 200")
            .code == 0);
  check_refusals(bench, "draw a.vtp -o b.svg",
                 R"(
--colour valence --range 5,7 | 2 | does not have; leave --range out
--colour valence --scale log | 2 | does not have; leave --scale out
--scale log --range 0,1 | 2 | --scale log needs values above 0, and the colour bar begins at 0;
--scale decibel | 2 | --scale: decibel not in {auto,linear,log}
)");
}

TEST_CASE("maps show the coastlines of the earth, unless they are turned off or the radius is "
          "another's") {
  const Bench bench;
  const auto picture = [&](const std::string& arguments) {
    const Outcome outcome = bench.run("draw -o a.png --size 200 " + arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return bench.file("a.png");
  };
  // A file of its own for each radius, since the title names it.
  const auto make = [&](const std::string& folder, const std::string& radius) {
    std::filesystem::create_directory(bench.folder() / folder);
    REQUIRE(bench.run("cvt --cells 42 -o " + folder + "/a.nc --sphere-radius " + radius).code == 0);
    return folder + "/a.nc";
  };
  for (const std::string look : {"", " --projection plate-carree"}) {
    for (const auto& [radius, earth] :
         {std::pair("1", true), {"6371229", true}, {"6400000", true}, {"3389500", false}}) {
      CAPTURE(radius);
      const std::string mesh = make(radius, radius) + look;
      const std::string with = picture(mesh + " --coastlines");
      const std::string without = picture(mesh + " --no-coastlines");
      CHECK(with != without);
      CHECK(picture(mesh) == (earth ? with : without));
    }
    const std::string field = "--density " + bump_density(2) + look;
    CHECK(picture(field) == picture(field + " --coastlines"));
    CHECK(picture(field) != picture(field + " --no-coastlines"));
  }
}

TEST_CASE("a picture names the file and says its spacing in km if the file has a radius") {
  const Bench bench;
  const auto mesh = [&](const std::string& name, const std::string& radius) {
    REQUIRE(bench.run("cvt --cells 42 -o " + name + " --sphere-radius " + radius).code == 0);
    return name;
  };
  const auto picture = [&](const std::string& arguments) {
    REQUIRE(bench.run("draw -o a.png --size 200 " + arguments).code == 0);
    return bench.file("a.png");
  };
  const std::string one = picture(mesh("a.nc", "1") + " --colour degree");
  const std::string earth = picture(mesh("a.nc", "6371229") + " --colour degree");
  CHECK(earth != one);
  CHECK(earth == picture("a.nc --colour degree"));
  CHECK(earth != picture(mesh("b.nc", "6371229") + " --colour degree"));
}

TEST_CASE("a density alone gives a picture of it, or of the spacings that it implies") {
  const Bench bench;
  const std::vector<std::string> looks = {"", "--projection plate-carree --graticule",
                                          "--colour spacing --view 270,30",
                                          "--join sum --density " + bump_density(2)};
  for (const std::string& options : looks) {
    CAPTURE(options);
    const Outcome outcome =
        bench.run("draw -o a.png --size 200 --density " + bump_density(2) + " " + options);
    CHECK(outcome.err.empty());
    CHECK(outcome.out == "a.png: picture of a density\n");
    CHECK(bench.file("a.png").starts_with("\x89PNG"));
  }
}

TEST_CASE("the errors of operators colour cells") {
  const Bench bench;
  REQUIRE(bench.run("cvt --cells 162 -o a.nc").code == 0);
  std::set<std::string> pictures;
  for (const char* word :
       {"divergence", "gradient", "laplacian", "curl", "tangential", "kinetic_energy"}) {
    CAPTURE(word);
    CHECK(
        bench.run(std::string("draw a.nc -o a.png --size 200 --what cells --colour error:") + word)
            .code == 0);
    pictures.insert(bench.file("a.png"));
  }
  CHECK(pictures.size() == 6);
}

TEST_CASE("a mesh file's variables colour its cells; an unknown one names those there are") {
  const Bench bench;
  make_run(bench, "a");
  REQUIRE(bench.run("convert a.vtp a.nc").code == 0);
  const Outcome outcome =
      bench.run("draw a.nc -o a.png --size 200 --what cells --colour field:areaCell");
  CHECK(outcome.err.empty());
  CHECK(outcome.out == "a.png: picture of 162 sites, 320 triangles\n");
  check_refusals(bench, "draw -o b.png --colour field:area", R"(
a.nc | 2 | a.nc: no variable area; there are
a.nc | 2 | areaCell
a.vtp | 2 | a.vtp
)");
}

TEST_CASE("a limited-area grid fills the picture and shows its zones") {
  const Bench bench;
  const std::string circle = "--region circle=179,-18,900km";
  REQUIRE(bench.run("cvt " + circle + " --cell-width 150km --limited-area -o a.nc").code == 0);
  const auto picture = [&](const std::string& options) {
    const Outcome outcome = bench.run("draw a.nc -o a.png --size 300 " + options);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    return bench.file("a.png");
  };
  for (const std::string map : {"", " --projection plate-carree"}) {
    const std::string zones = picture("--what cells" + map);
    CHECK(zones == picture("--what cells --colour region --zoom auto" + map));
    CHECK(zones != picture("--what cells --colour spacing" + map));
    CHECK(zones != picture("--what cells " + circle + map));
    const std::string whole = picture("--what cells --zoom whole" + map);
    CHECK(zones != whole);
    CHECK(whole == picture("--what cells --zoom 1" + map));
    CHECK(whole != picture("--what cells --zoom 2" + map));
    CHECK(picture(map) == picture("--colour spacing" + map)); // triangles
  }
  make_run(bench, "b");
  check_refusals(bench, "draw -o b.png", R"(
b.vtp --colour region | 2 | b.vtp
a.nc --region circle=1,2 | 2 | --region
)");
  REQUIRE(bench.run("draw b.vtp -o b.png --size 200").code == 0);
  REQUIRE(bench.run("draw b.vtp -o c.png --size 200 --zoom whole").code == 0);
  CHECK(bench.file("b.png") == bench.file("c.png"));
}

TEST_CASE("a file that is no report is named, and nothing is written") {
  const Bench bench;
  bench.file("a.json", "{\"norm\": \"l2\"}\n");
  bench.file("empty.json", "");
  bench.file("a.png", "{}");
  check_refusals(bench, "draw -o a.png", R"(
--history a.json | 2 | a.json: density is missing; give a report of calotte cvt --report
--history empty.json | 2 | empty.json line 1: this is not JSON, or was cut short; give a report of
--history absent.json | 3 | cannot read absent.json: No such file or directory
--history a.png | 2 | a.png is both input and output; give the output another name
)");
}

TEST_CASE("a mesh of the plane becomes a picture, with its domain") {
  const Bench bench;
  bench.file("lake.txt", "0 0\n4 0\n4 3\n0 3\n\n1 1\n2 1\n1 2\n");
  CHECK(bench.run("points random-plane 100 --domain lake.txt -o points.txt").code == 0);
  CHECK(bench.run("delaunay --plane points.txt -o mesh.vtp").code == 0);
  const Outcome lake = bench.run("draw mesh.vtp --domain lake.txt --what cells -o lake.png");
  CHECK(lake.out.starts_with("lake.png: picture of 100 sites, "));
  CHECK(bench.file("lake.png").starts_with("\x89PNG"));
  CHECK(bench.run("draw mesh.vtp -o triangles.svg --size 300").code == 0);
  CHECK(bench.run("draw mesh.vtp --what points -o points.svg --size 300 --title x").code == 0);
  const std::string dots = bench.file("points.svg");
  CHECK(has(dots, "stroke:rgb(0%,0%,0%)"));
  CHECK(!has(dots, "stroke:rgb(26")); // no lines of cells
  CHECK(bench.run("draw mesh.vtp --what points --colour spacing -o coloured.svg").code == 0);
  CHECK(!has(bench.file("coloured.svg"), "stroke:rgb(0%,0%,0%)"));
  CHECK(bench.run("points hexagonal 64 --periodic 1,1 -o box.txt").code == 0);
  CHECK(bench.run("delaunay --plane --periodic 1,1 box.txt -o box.nc").code == 0);
  CHECK(bench.run("draw box.nc --what both --colour quality -o box.pdf").code == 0);
  check_refusals(bench, "draw -o a.png", R"(
box.nc --periodic 1,2 | 2 | the domain's period is not that of the mesh, 1 x 1; leave
box.nc --rectangle 0,0,1,1 | 2 | the domain's period is not that of the mesh
mesh.vtp --colour region | 2 | mesh.vtp
mesh.vtp --view 1,2 | 2 | --view applies to the sphere only, and mesh.vtp holds a mesh of the plane; leave it out
--plane mesh.vtp --view 1,2 | 2 | --view applies to the sphere only
--density x8 --plane | 2 | a picture of a density is one of the sphere
--density x8 --domain lake.txt | 2 | a picture of a density is one of the sphere
)");
}
