// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/check.h>
#include <calotte/quality.h>
#include <calotte/read.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace calotte::test;

namespace {

const std::string sphere = "MSHID=3;ELLIPSOID-MESH\nRADII=6371;6371;6371\n";
const std::string square = "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=4\n0;0;0\n9;0;0\n9;9;0\n0;9;0\n"
                           "EDGE2=4\n0;1;0\n1;2;0\n2;3;0\n3;0;0\n";
const std::string head = "# of a caller\n GEOM_FILE = geom.msh\nMESH_FILE=mesh.msh\n";

/// Without a mesh, as nothing is half-written.
void check_refused(const Bench& bench, const std::string& options, const std::string& message) {
  bench.file("a.jig", options);
  check_refusals(bench, "jigsaw", "a.jig | 2 | " + message);
}

} // namespace

TEST_CASE("jigsaw: one width on the sphere, relative and absolute") {
  const Bench bench;
  bench.file("geom.msh", sphere);
  bench.file("a.jig", head + "HFUN_HMAX=0.05\nMESH_DIMS=2\nNUMTHREAD=1\n");
  const Outcome outcome = bench.run("jigsaw a.jig");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(outcome.err.empty());
  const calotte::Mesh mesh = calotte::read_mesh(bench.folder() / "mesh.msh");
  // 0.05 of the diameter is 0.1 of the radius.
  const double cells = 4 * 3.14159265 * 2 / (std::sqrt(3.0) * 0.01);
  CHECK(double(mesh.points.cols()) == doctest::Approx(cells).epsilon(0.03));
  CHECK(mesh.points.col(0).norm() == doctest::Approx(6371).epsilon(1e-12));
  const std::string file = bench.file("mesh.msh");
  CHECK(has(file, "MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT="));
  CHECK(has(file, "\nPOWER="));
  bench.file("b.jig", head + "hfun_hmax = 637.1\nhfun_scal = ABSOLUTE\nMESH_FILE=b.msh\n");
  REQUIRE(bench.run("jigsaw b.jig").code == 0);
  CHECK(bench.file("b.msh") == file);
}

TEST_CASE("jigsaw: a plane's mesh fills its polygon, and ends at edges") {
  const Bench bench;
  bench.file("geom.msh", square);
  bench.file("hfun.msh", "MSHID=3;EUCLIDEAN-GRID\nNDIMS=2\nCOORD=1;2\n-1\n10\nCOORD=2;2\n-1\n10\n"
                         "VALUE=4;1\n.2\n.2\n.9\n.9\n");
  bench.file("a.jig", head + "HFUN_FILE=hfun.msh\nHFUN_SCAL=absolute\nHFUN_HMAX=inf\n"
                             "HFUN_HMIN=0.3\nVERBOSITY=1\nOPTM_QLIM=0.9375\n");
  const Outcome outcome = bench.run("jigsaw a.jig");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(outcome.out, "a.jig line 9: OPTM_QLIM has no effect"));
  const calotte::Mesh mesh = calotte::read_mesh(bench.folder() / "mesh.msh");
  CHECK(calotte::check_surface(mesh).area == doctest::Approx(81).epsilon(1e-12));
  CHECK(has(bench.file("mesh.msh"), "\nEDGE2="));
  CHECK(has(bench.file("mesh.msh"), "NDIMS=2\n"));
}

TEST_CASE("jigsaw: widths of 0 take the least one") {
  const Bench bench;
  bench.file("geom.msh", square);
  bench.file("hfun.msh", "MSHID=3;EUCLIDEAN-GRID\nNDIMS=2\nCOORD=1;2\n-1\n10\nCOORD=2;2\n-1\n10\n"
                         "VALUE=4;1\n0\n0\n0.1\n0.1\n");
  const std::string options = head + "HFUN_FILE=hfun.msh\nHFUN_SCAL=absolute\nHFUN_HMAX=inf\n";
  bench.file("a.jig", options + "HFUN_HMIN=1\n");
  CHECK(bench.run("jigsaw a.jig").code == 0);
  std::filesystem::remove(bench.folder() / "mesh.msh");
  check_refused(bench, options, "hfun.msh: VALUE[0][0] = 0 is not positive and finite");
}

TEST_CASE("jigsaw: points of negative tags stay, lines are followed, a start alone is kept") {
  const Bench bench;
  bench.file("geom.msh", sphere + "NDIMS=2\nPOINT=2\n0;0;0\n0.8;0.3;0\nEDGE2=1\n0;1;0\n");
  bench.file("init.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=2\n0;0;6371;-1\n0;0;-6371;0\n");
  bench.file("a.jig", head + "HFUN_HMAX=0.06\nINIT_FILE=init.msh\nVERBOSITY=1\n");
  const Outcome outcome = bench.run("jigsaw a.jig");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(outcome.out, "1 points without a negative tag have no effect"));
  const calotte::Points3 points = calotte::read_sites(bench.folder() / "mesh.msh");
  CHECK((points.col(0) - Eigen::Vector3d(0, 0, 6371)).norm() < 1e-11);
  CHECK((points.col(1) - Eigen::Vector3d(6371, 0, 0)).norm() < 1e-11); // an end of the line
  std::filesystem::copy_file(bench.folder() / "mesh.msh", bench.folder() / "start.msh");
  bench.file("b.jig", head + "HFUN_HMAX=0.06\nINIT_FILE=start.msh\nMESH_ITER=0\n");
  REQUIRE(bench.run("jigsaw b.jig").code == 0);
  CHECK(calotte::read_sites(bench.folder() / "mesh.msh").cols() == points.cols());
}

TEST_CASE("jigsaw: what it cannot do is refused in one line, without a file") {
  const Bench bench;
  bench.file("geom.msh", sphere);
  check_refused(bench, head + "MESH_DIMS=3\n", "a.jig line 4: MESH_DIMS: 3; only surfaces");
  check_refused(bench, head + "MESH_SIZE=3\n", "a.jig line 4: JIGSAW has no option MESH_SIZE");
  check_refused(bench, head + "TRIA_FILE=a.msh\n", "a.jig line 4: TRIA_FILE: there is no complex");
  check_refused(bench, head + "HFUN_HMAX=wide\n", "a.jig line 4: HFUN_HMAX: \"wide\" is no number");
  check_refused(bench, head + "HFUN_HMAX=-1\n", "HFUN_HMAX: give a number > 0");
  check_refused(bench, head + "HFUN_HMIN=.5\n", "HFUN_HMIN: give a number that is not above");
  check_refused(bench, head + "HFUN_SCAL=km\n", "HFUN_SCAL: give RELATIVE or ABSOLUTE");
  check_refused(bench, head + "MESH_ITER=0\n", "MESH_ITER: 0 needs INIT_FILE");
  check_refused(bench, head + "MESH_ITER=1.5\n", "MESH_ITER: \"1.5\" is no whole number");
  check_refused(bench, head + "VERBOSITY\n", "a.jig line 4: not a line NAME = VALUE");
  check_refused(bench, "MESH_FILE=mesh.msh\n", "a.jig: no GEOM_FILE");
  check_refused(bench, "GEOM_FILE=geom.msh\n", "a.jig: no MESH_FILE");
  bench.file("geom.msh", "MSHID=3;ELLIPSOID-MESH\nRADII=1;1;2\n");
  check_refused(bench, head, "geom.msh: the radii differ");
  bench.file("geom.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=1\n0;0;1;0\n");
  check_refused(bench, head, "geom.msh: a geometry of the kind");
}

TEST_CASE("marche: the gradient of a grid is limited, the file has the same nodes") {
  const Bench bench;
  const std::string grid = "MSHID=3;EUCLIDEAN-GRID\nNDIMS=2\nCOORD=1;3\n0\n1\n2\n"
                           "COORD=2;2\n0\n1\nVALUE=6;1\n1\n9\n9\n9\n9\n9\nSLOPE=1;1\n.5\n";
  bench.file("w.msh", grid);
  bench.file("a.jig", "HFUN_FILE=w.msh\n");
  const Outcome outcome = bench.run("marche a.jig");
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  CHECK(has(bench.file("w.msh"), "VALUE=6;1\n1\n1.5\n1.5\n1.707106"));
  bench.file("w.msh", "MSHID=3;EUCLIDEAN-MESH\nNDIMS=2\nPOINT=1\n0;0;0\nVALUE=1;1\n1\n");
  CHECK(bench.run("marche a.jig").code == 2);
}

TEST_CASE("cvt: --fixed takes lines, and the report says how near generators are") {
  const Bench bench;
  bench.file("rivers.geojson",
             R"({"type":"MultiLineString","coordinates":[[[170,10],[179,20],[-170,25]],)"
             R"([[179,20],[179,-10]]]})");
  const Outcome outcome = bench.run(
      "cvt --cell-width 400km --fixed rivers.geojson --iterations 20 -o a.nc --report a.json");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(has(outcome.err, "rivers.geojson: 2 lines hold "));
  CHECK(has(bench.file("a.json"), "\"farthest_in_widths\": 0."));
  bench.file("pier.geojson", R"({"type":"LineString","coordinates":[[1,1],[3,2]]})");
  const Outcome plane = bench.run("cvt --rectangle 0,0,4,3 --cells 400 --fixed pier.geojson "
                                  "--iterations 20 -o p.vtp");
  CHECK(plane.code == 0);
  CHECK(has(plane.err, "pier.geojson: 1 line holds "));
  bench.file("both.geojson", R"({"type":"GeometryCollection","geometries":[
      {"type":"LineString","coordinates":[[1,1],[3,2]]},{"type":"Point","coordinates":[1,1]}]})");
  CHECK(has(bench.run("cvt --cells 400 --fixed both.geojson -o b.vtp").err, "lines beside other"));
  const Outcome outside = bench.run(
      "cvt --cell-width 100km --region circle=0,0,2000km --fixed rivers.geojson -o b.vtp");
  CHECK(outside.code == 2);
  CHECK(has(outside.err, "rivers.geojson: line 0, point 0 is outside the surface"));
}
