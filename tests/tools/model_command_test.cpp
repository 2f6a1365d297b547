// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/command.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <filesystem>
#include <sstream>
#include <string>

// --for: the files that models read.

using calotte::VertexOrder;
using namespace calotte::test;

namespace {

double radius_of(const Bench& bench, const std::string& name) {
  return calotte::read_mesh_file(bench.folder() / name).sphere_radius;
}

calotte::VertexOrder order_of(const Bench& bench, const std::string& name) {
  return calotte::read_mesh_file(bench.folder() / name).vertex_order;
}

const std::string other_models = "; for others see --for\n",
                  no_model = ", for no model; name one with --for\n";

} // namespace

TEST_CASE("a model sets the radius, in every command that writes a mesh") {
  const Bench bench;
  check_success(bench, "points fibonacci 600 -o points.txt");
  const auto check = [&](const std::string& arguments, double radius, const std::string& names) {
    CAPTURE(arguments);
    const std::string said = check_success(bench, arguments + " -o mesh.nc").out;
    CHECK(radius_of(bench, "mesh.nc") == radius);
    CHECK(order_of(bench, "mesh.nc") ==
          (names == "MPAS-Atmosphere" ? VertexOrder::before_edges : VertexOrder::after_edges));
    CHECK(has(said, "mesh.nc: " + std::string(radius == 1 ? "unit sphere" : "sphere of 6371220 m") +
                        (names.empty() ? no_model : ", for " + names + other_models)));
  };
  const std::string sw = "MPAS' shallow-water core";
  for (const std::string command : {"cvt --cells 600 --iterations 2", "delaunay points.txt"}) {
    check(command, 1, "");
    check(command + " --for mpas-atmosphere", 1, "MPAS-Atmosphere");
    check(command + " --for mpas-sw", 1, sw);
    check(command + " --for mpas-ocean", 6371220, "MPAS-Ocean");
  }
  check("cvt --region circle=10,50,900km --cell-width 100km --limited-area --iterations 2", 1,
        "MPAS-Atmosphere");
  check_success(bench, "delaunay points.txt -o earth.nc --for mpas-ocean");
  check("convert earth.nc", 6371220, "MPAS-Ocean");
  check("convert earth.nc --for mpas-atmosphere", 1, "MPAS-Atmosphere");
  check_success(bench, "cvt --cells 2562 -o air.nc --for mpas-atmosphere");
  check("convert air.nc", 1, "MPAS-Atmosphere");
  check_success(bench, "refine air.nc --region circle=10,50,3000km --factor 1.5 -o finer.nc");
  CHECK(order_of(bench, "finer.nc") == VertexOrder::before_edges);
  const std::string cut = "cut earth.nc --region circle=10,50,3000km --rings 2";
  check(cut, 1, "MPAS-Atmosphere");
  check(cut + " --for mpas-sw", 1, sw);
  check(cut + " --for mpas-ocean", 6371220, "MPAS-Ocean");
  const std::string cull = " --field latCell --sea-below 0";
  check("cull earth.nc" + cull, 6371220, "MPAS-Ocean");
  check_success(bench, "delaunay points.txt -o unit.nc");
  check("cull unit.nc" + cull, 1, "");
  check("cull air.nc" + cull, 1, "MPAS-Atmosphere");
  check("cull unit.nc --for mpas-ocean" + cull, 6371220, "MPAS-Ocean");
  check_success(bench, "convert unit.nc nod2d.out --for fesom");
  CHECK(check_success(bench, "convert unit.nc grid.nc --format scrip").out ==
        "grid.nc: 600 sites, 1196 triangles, closed\n");
}

TEST_CASE("a model does not replace what is given: a contradiction is an error") {
  const Bench bench;
  const std::string run = "cvt --cells 42 --iterations 1 ";
  check_success(bench, run + "-o mesh.nc --for mpas-ocean --sphere-radius earth");
  CHECK(radius_of(bench, "mesh.nc") == 6371229);
  CHECK(has(check_success(bench, run + "-o mesh.nc --sphere-radius 2").out,
            "mesh.nc: sphere of 2 m" + no_model));
  check_refusals(bench, "cvt --cells 42", R"(
-o a.nc --for mpas-atmosphere --sphere-radius earth | 2 | needs a sphere with a radius of 1, not --sphere-radius 6371229
-o a.nc --for mpas-ocean --sphere-radius 1 | 2 | needs a sphere with a radius of 6371220, not --sphere-radius 1
-o a.nc --for mpas-ocean --format ugrid | 2 | a.nc: --for mpas-ocean writes the format mpas, not ugrid; give
-o a.vtp --for mpas-sw | 2 | a.vtp: --for mpas-sw writes the format mpas, not vtp; give a name that ends in .nc
-o a.nc --for fesom | 2 | a.nc: --for fesom writes the format fesom, not mpas; give the name nod2d.out
-o a.nc --for wrf | 2 | --for
)");
  check_refusals(bench, "cut mesh.nc --region circle=0,0,30deg -o a.nc", R"(
--for fesom | 2 | --for fesom: the grid is an MPAS file
--for mpas-ocean --sphere-radius 1 | 2 | --for mpas-ocean needs
)");
}

TEST_CASE("a file of a plane keeps its order, and has no radius, for any model") {
  const Bench bench;
  for (const std::string run :
       {"cvt --cells 40 --periodic 1,1", "cvt --cells 40 --rectangle 0,0,2,1"}) {
    CAPTURE(run);
    check_success(bench, run + " -o plain.nc");
    const std::string plain = bench.file("plain.nc");
    check_success(bench, run + " -o mesh.nc --for mpas-ocean");
    CHECK((bench.file("mesh.nc") == plain));
    check_success(bench, run + " -o mesh.nc --for mpas-atmosphere");
    CHECK(order_of(bench, "mesh.nc") == VertexOrder::before_edges);
    check_success(bench, run + " -o mesh.nc --for mpas-sw");
    CHECK(has(bench.file("mesh.nc"), "nTracers"));
    CHECK(!has(plain, "nTracers"));
    check_success(bench, "convert plain.nc other.nc");
    check_success(bench, "convert plain.nc mesh.nc --for mpas-ocean");
    CHECK((bench.file("mesh.nc") == bench.file("other.nc")));
  }
}

TEST_CASE("a mesh without a density gets that of its spacing, and says so") {
  const Bench bench;
  const std::string bump = " --density tanh:lon=0,lat=90,beta=40deg,alpha=0.3,gamma=x6";
  check_success(bench, "cvt --cells 1500 -o mesh.msh" + bump);
  const auto density = [&](const std::string& name) {
    return calotte::read_mesh_file(bench.folder() / name).density;
  };
  const std::string said = check_success(bench, "convert mesh.msh grid.nc").out;
  CHECK(has(said, "grid.nc: no density is given; meshDensity follows from the smoothed spacing of "
                  "the cells, which varies by a factor of "));
  CHECK(density("grid.nc").maxCoeff() == 1);
  CHECK(density("grid.nc").minCoeff() < 1 / std::pow(4.0, 4));
  check_success(bench, "check grid.nc");
  const std::string given = check_success(bench, "convert mesh.msh grid.nc" + bump).out;
  CHECK(!has(given, "no density is given"));
  check_success(bench, "convert mesh.msh uniform.nc --density uniform");
  CHECK(density("uniform.nc").minCoeff() == 1);
  const Outcome wrong = bench.run("check uniform.nc");
  CHECK(wrong.code == 1);
  CHECK(has(wrong.out, "meshDensity: the cells (dcEdge) are "));
  // What another program stored as 1 is as good as none.
  CHECK(has(check_success(bench, "convert uniform.nc again.nc").out, "no density is given"));
  check_success(bench, "check again.nc");
  check_success(bench, "cvt --cells 642 -o even.vtp");
  CHECK(!has(check_success(bench, "convert even.vtp even.nc").out, "no density is given"));
  CHECK(density("even.nc").minCoeff() == 1);
}

TEST_CASE("FESOM: an ocean without ears, and its depths") {
  const Bench bench;
  check_success(bench, "points random 1500 --seed 3 -o points.txt");
  check_success(bench, "delaunay points.txt -o global.nc");
  bench.file("land.geojson", R"({"type":"Polygon","coordinates":[[[0,-60],[30,-60],[40,0],[30,60],)"
                             R"([0,60],[-10,0],[0,-60]]]})");
  check_success(bench, "cull global.nc --land land.geojson -o ocean.nc");
  const std::string said =
      check_success(bench,
                    "convert ocean.nc nod2d.out --for fesom --depth-levels 0,10,30,100 --depth 80")
          .out;
  CHECK(has(said, "nod2d.out: without "));
  CHECK(has(said, " triangles of fewer than two neighbours, and without the "));
  const calotte::Mesh mesh = calotte::read_mesh(bench.folder() / "nod2d.out");
  for (const auto& neighbours : mesh.neighbours.colwise())
    CHECK((neighbours.array() >= 0).count() >= 2);
  std::istringstream depths(bench.file("aux3d.out"));
  std::int64_t count = 0;
  for (std::string line; std::getline(depths, line);)
    ++count;
  CHECK(count == 1 + 4 + mesh.points.cols());
  bench.file("levels.txt", "0\n-5\n-50\n");
  check_success(bench,
                "convert ocean.nc nod2d.out --depth-levels levels.txt --depth mapCulledToBaseCell");
  CHECK(bench.file("aux3d.out").starts_with("3\n0\n-5\n-50\n"));
  check_refusals(bench, "convert ocean.nc", R"(
nod2d.out --depth-levels 0,5,x --depth 3 | 2 | --depth-levels 0,5,x: "x" is not a number; give metres
nod2d.out --depth-levels 0,5,9 --depth none | 2 | --depth none: the input has no field of that name
nod2d.out --depth 9 | 2 | --depth-levels
a.vtp --depth 9 --depth-levels 0,5,9 | 2 | a.vtp: --depth-levels applies to FESOM's nod2d.out
)");
}

TEST_CASE("FESOM: the sum of a field tells heights from depths, and land has the depth 0") {
  const Bench bench;
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(60));
  Eigen::VectorXd values = Eigen::VectorXd::Constant(60, 4000);
  values[7] = -50; // land in a field of depths
  calotte::MeshField depths{.name = "depths", .values = values};
  calotte::MeshField heights{.name = "heights", .values = -values};
  calotte::write(bench.folder() / "mesh.nc", mesh, {.fields = {depths, heights}});
  const auto count = [&](const std::string& line) {
    std::istringstream in(bench.file("aux3d.out"));
    std::int64_t found = 0;
    for (std::string other; std::getline(in, other);)
      found += other == line ? 1 : 0;
    return found;
  };
  for (const std::string field : {"depths", "heights"}) {
    CAPTURE(field);
    check_success(bench, "convert mesh.nc nod2d.out --depth-levels 0,10,30 --depth " + field);
    CHECK(count("-4000") == 59);
    CHECK(count("0") == 2); // the first level, and the land
  }
}

TEST_CASE("check --for names the demands that fail, and where") {
  const Bench bench;
  check_success(bench, "cvt --cells 2562 -o good.nc --for mpas-atmosphere");
  const std::string passed = check_success(bench, "check good.nc --for mpas-atmosphere").out;
  for (const char* name : {"sides of a cell, least", "dv / dc, least", "change of width, most",
                           "cells that advect, most", "longest step, s, of flow"})
    CHECK(has(passed, name));
  CHECK(has(passed, "good.nc: passed"));
  check_success(bench, "points random 500 --seed 3 -o random.txt");
  check_success(bench, "delaunay random.txt -o random.nc");
  const Outcome failed = bench.run("check random.nc --for mpas-ocean");
  CHECK(failed.code == 1);
  CHECK(has(failed.err, "random.nc: failed: beyond the limits of MPAS-Ocean: sides of a cell, "
                        "least: 3, the limit is 5, "));
  CHECK(has(failed.err, "; dv / dc, least: "));
  CHECK(has(failed.err, "; change of width, most: "));
  CHECK(has(failed.err,
            "; the file is not one for MPAS-Ocean: its radius is 1, instead of 6371220; "));
  CHECK(has(bench.run("check good.nc --for mpas-sw").err,
            "edge k of its cells lies between vertices k and k + 1, instead of k - 1 and k; "
            "calotte convert FILE NEW --for mpas-sw"));
  check_success(bench, "cvt --cells 642 -o planet.nc --sphere-radius earth");
  CHECK(has(
      bench.run("check planet.nc --for mpas-atmosphere").err,
      "its radius is 6371229, instead of 1 and edge k ")); // init_atmosphere would scale it again
  CHECK(bench.run("check random.nc").code == 0);
  check_success(bench, "info random.nc --for mpas-sw --report report.json");
  CHECK(has(bench.file("report.json"), "\"beyond\""));
  CHECK(bench.run("check random.nc --for fesom").code == 2);
}

TEST_CASE("a run for a model whose demands it does not meet ends with exit code 5") {
  const Bench bench;
  const Outcome outcome = bench.run(
      "cvt --cells 1000 --iterations 3 --start density -o steep.nc --for mpas-ocean --density "
      "tanh:lon=270,lat=30,beta=10deg,alpha=0.02,gamma=x16");
  CHECK(outcome.code == 5);
  CHECK(has(outcome.err, "beyond the limits of MPAS-Ocean: "));
  CHECK(has(outcome.err, "; the mesh is written"));
  CHECK(std::filesystem::exists(bench.folder() / "steep.nc"));
}
