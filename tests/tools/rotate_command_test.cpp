// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/generators.h>
#include <calotte/read.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace calotte;
using namespace calotte::test;

namespace {

/// The largest difference of a coordinate between two files with as many points.
double distance(const Bench& bench, const std::string& a, const std::string& b) {
  return (read_mesh(bench.path(a)).points - read_mesh(bench.path(b)).points).cwiseAbs().maxCoeff();
}

} // namespace

TEST_CASE("a point of a mesh moves to where it is needed, and back") {
  const Bench bench;
  check_success(bench, "cvt --cells 642 -o base.nc");
  CHECK(check_success(bench, "rotate base.nc --from 0,90 --to -105,40 --bearing 30 -o there.nc")
            .out == "there.nc: 642 cells, 0,90 moved to -105,40, the mesh passes its check\n");
  check_success(bench, "check there.nc");
  CHECK(bench.file("there.graph.info") == bench.file("base.graph.info"));
  check_success(bench, "rotate there.nc --from -105,40 --to 0,90 --bearing -30 -o back.nc");
  CHECK(distance(bench, "base.nc", "there.nc") > 0.1);
  CHECK(distance(bench, "base.nc", "back.nc") <= 3e-16);
  const Points3 there = read_mesh(bench.path("there.nc")).points;
  CHECK(read_mesh(bench.path("there.nc")).triangles == read_mesh(bench.path("base.nc")).triangles);
  bench.file("there.toml", "from = \"0,90\"\nto = \"-105,40\"\nbearing = 30\n");
  check_success(bench, "rotate base.nc --config there.toml -o again.nc");
  CHECK(read_mesh(bench.path("again.nc")).points == there);
}

TEST_CASE("other formats keep the order of the sites, and MPAS files are written anew on request") {
  const Bench bench;
  check_success(bench, "cvt --cells 642 -o base.nc");
  const std::string rotate = "rotate base.nc --from 0,90 --to -105,40 -o ";
  check_success(bench, rotate + "copy.nc");
  for (const std::string output :
       {"new.vtp", "new.off", "new.nc --format mpas", "radius.nc --sphere-radius earth",
        "model.nc --for mpas-ocean"}) {
    CAPTURE(output);
    check_success(bench, rotate + output);
    const Points3 points = read_mesh(bench.path(output.substr(0, output.find(' ')))).points;
    const Points3 copy = read_mesh(bench.path("copy.nc")).points;
    CHECK((points.colwise().normalized() - copy).cwiseAbs().maxCoeff() <= 1e-15);
  }
  check_success(bench, "rotate new.vtp --from -105,40 --to 0,90 -o back.nc");
  CHECK(distance(bench, "base.nc", "back.nc") <= 3e-16);
  check_success(bench, "check back.nc");
}

TEST_CASE("meshes of cocircular sites, of coasts and of parts rotate") {
  const Bench bench;
  const std::string rotation = " --from 3,4 --to -105,40 --bearing 17 -o ";
  check_success(bench, "points icosahedron 10242 -o points.txt");
  check_success(bench, "delaunay points.txt -o lattice.nc");
  check_success(bench, "rotate lattice.nc" + rotation + "there.nc");
  check_success(bench, "check there.nc");
  check_success(bench, "cvt --region circle=10,10,1200km --cell-width 150km --boundary generators "
                       "--depth 300 --open box=-2,5,2,15 -o base.gr3");
  CHECK(has(check_success(bench, "rotate base.gr3" + rotation + "there.gr3").out, "depth"));
  check_success(bench, "check there.gr3");
  const auto tail = [](const std::string& text) {
    return text.substr(text.rfind("open boundaries"));
  };
  CHECK(tail(bench.file("there.gr3")) == tail(bench.file("base.gr3")));
  check_success(bench, "cvt --region box=0,0,20,20 --cell-width 300 --limited-area -o area.nc");
  check_success(bench, "rotate area.nc" + rotation + "there-area.nc");
  check_success(bench, "check there-area.nc");
}

TEST_CASE("a rotation that is not understood is refused in one line") {
  const Bench bench;
  check_success(bench, "cvt --cells 100 -o base.nc");
  check_success(bench, "cvt --rectangle 0,0,30,20 --cells 100 -o plane.nc");
  check_success(bench, "points fibonacci 50 -o points.txt");
  check_refusals(bench, "rotate", R"(
base.nc --to 1,2 -o new.nc | 2 | --from is required
base.nc --from 1,2 -o new.nc | 2 | --to is required
base.nc --from 1 --to 1,2 -o new.nc | 2 | --from 1: this is no place; give LON,LAT in degrees, as in -105,40
base.nc --from 1,2 --to 1,91 -o new.nc | 2 | --to 1,91: this is no place; give LON,LAT in degrees, as in -105,40
base.nc --from 1,2 --to 1,2,3 -o new.nc | 2 | --to 1,2,3: this is no place
base.nc --from nan,2 --to 1,2 -o new.nc | 2 | --from nan,2: this is no place
base.nc --from 1,2 --to 1,2 --bearing nan -o new.nc | 2 | --bearing
base.nc --from 1,2 --to 1,2 --bearing north -o new.nc | 2 | --bearing
base.nc --from 1,2 --to 1,3 -o base.nc | 2 | base.nc
base.nc --from 1,2 --to 1,3 -o new.tri | 2 | the format holds triangles without points
plane.nc --from 1,2 --to 1,3 -o new.nc | 2 | plane.nc: it holds a mesh of a plane
none.nc --from 1,2 --to 1,3 -o new.nc | 3 | none.nc
base.nc --from 1,2 --to 1,3 -o no/new.nc | 3 | no
)");
}
