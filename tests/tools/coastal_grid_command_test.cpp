// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

// The options of grids of the coastal ocean: --depth and --open, of convert and of cvt.

using namespace calotte;
using namespace calotte::test;

namespace {

const std::string disc = "--region circle=134,-25,2000km --cells 400 --boundary generators";

DoubleVector values_of(const Bench& bench, const std::string& name, const std::string& field) {
  const MeshFile file = read_mesh_file(bench.folder() / name);
  const auto found = std::ranges::find(file.fields, field, &MeshField::name);
  REQUIRE(found != file.fields.end());
  return found->values;
}

} // namespace

TEST_CASE("cvt and convert write the same coastal grids, with their open boundary and depths") {
  const Bench bench;
  check_success(bench, "cvt " + disc + " -o disc.vtp");
  for (const std::string name : {"hgrid.gr3", "fort.14", "sea.2dm"}) {
    CAPTURE(name);
    const std::string options = " --open box=105,-50,165,-38 --depth 70 -o ";
    check_success(bench, "cvt " + disc + options + name);
    check_success(bench, "convert disc.vtp" + options + "of-" + name);
    CHECK(bench.file(name) == bench.file("of-" + name));
    CHECK(has(check_success(bench, "check " + name).out, "passed"));
    CHECK((values_of(bench, name, "depth").array() == 70).all());
    CHECK(has(check_success(bench, "convert disc.vtp " + name).out,
              name + ": no depths are given, so that each is 0; give --depth"));
  }
  check_success(bench, "convert disc.vtp open.gr3 --open box=105,-50,165,-38");
  const DoubleVector open = values_of(bench, "open.gr3", "open");
  CHECK(open.sum() > 5);
  CHECK(open.sum() < 40);
  bench.file("line.geojson",
             R"({"type":"LineString","coordinates":[[117,-38],[125,-41.5],[134,-43]]})");
  check_success(bench, "convert disc.vtp line.gr3 --open line.geojson");
  CHECK(values_of(bench, "line.gr3", "open").sum() > 3);
  check_success(bench, "convert line.gr3 again.14 --depth depth");
  CHECK(values_of(bench, "again.14", "open") == values_of(bench, "line.gr3", "open"));
  check_success(bench, "convert disc.vtp disc.msh --format gmsh --open line.geojson");
  CHECK(values_of(bench, "disc.msh", "open") == values_of(bench, "line.gr3", "open"));
}

TEST_CASE("FESOM's grid of a region has no ears, and depths of its nodes") {
  const Bench bench;
  check_success(bench, "cvt --region circle=134,-25,2000km --cells 300 -o nod2d.out --for fesom "
                       "--depth-levels 0,10,100 --depth 60");
  CHECK(has(check_success(bench, "check nod2d.out").out, "passed"));
  CHECK((values_of(bench, "nod2d.out", "depth").array() == 60).all());
}

TEST_CASE("depths by a raster are the heights below 0 at the sites") {
  const Bench bench;
  check_success(bench, "cvt " + disc + " -o disc.vtp");
  const Mesh world = delaunay(fibonacci_sphere(5000));
  const MeshField heights{.name = "height",
                          .units = "m",
                          .values = 1000 * (world.points.row(0).array() + 0.6).transpose()};
  write(bench.folder() / "world.nc", world, {.fields = {heights}});
  check_success(bench, "interpolate world.nc 360x180 --method linear -o heights.nc");
  check_success(bench, "convert disc.vtp a.14 --depth heights.nc");
  const MeshFile file = read_mesh_file(bench.folder() / "a.14");
  const DoubleVector depth = values_of(bench, "a.14", "depth");
  const DoubleVector expected =
      (-1000 * (file.mesh->points.row(0).array() + 0.6)).transpose().cwiseMax(0.0);
  CHECK((depth - expected).cwiseAbs().maxCoeff() < 2); // the meshes are a hundredth apart
  CHECK((depth.array() == 0).count() > 40);            // on land
  CHECK(depth.maxCoeff() > 200);
  check_success(bench, "convert a.14 b.14 --depth depth --least-depth 50");
  CHECK(values_of(bench, "b.14", "depth") == depth.cwiseMax(50.0));
}

TEST_CASE("coastal options that do not apply, and boundaries that are not there, are refused") {
  const Bench bench;
  check_success(bench, "cvt " + disc + " -o disc.vtp");
  bench.file("far.geojson", R"({"type":"LineString","coordinates":[[0,0],[10,0]]})");
  bench.file("empty.geojson", R"({"type":"FeatureCollection","features":[]})");
  check_refusals(bench, "convert disc.vtp", R"(
a.14 --open circle=0,0,100km | 2 | --open circle=0,0,100km: no edge of the boundary lies in it; give a larger region
a.14 --open far.geojson | 2 | --open far.geojson: no edge of the boundary lies along the lines, within half its length; draw
a.14 --open none.geojson | 3 | none.geojson
a.14 --open empty.geojson | 2 | empty.geojson
a.14 --depth none | 2 | --depth none: the input has no field of that name
a.14 --depth none.nc | 3 | none.nc
a.14 --depth nan | 2 | a.14: the depth is nan at site 0
a.14 --depth 5 --depth-levels 0,5,9 | 2 | a.14: --depth-levels applies to FESOM's nod2d.out
a.vtp --depth 5 | 2 | a.vtp: --depth applies to SCHISM (.gr3), ADCIRC (.14), SMS (.2dm) and FESOM
a.vtp --open circle=0,0,100km | 2 | a.vtp: --open applies to SCHISM (.gr3), ADCIRC (.14), SMS (.2dm) and Gmsh
nod2d.out --depth 5 | 2 | nod2d.out: FESOM's depths need layers; give --depth-levels, too
)");
  // A run keeps its triangles.
  const Outcome lost = bench.run("cvt " + disc + " -o sea.14 --open circle=0,0,100km");
  CHECK(lost.code == 2);
  CHECK(has(lost.err, "no edge of the boundary lies in it; give a larger region; sea.14.vtp has "
                      "the triangles"));
  check_success(bench, "convert sea.14.vtp sea.14");
}
