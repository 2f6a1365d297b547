// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"
#include "support/files.h"

#include <calotte/density.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <sys/stat.h>

using namespace calotte::test;

namespace fs = std::filesystem;

namespace {

/// A mesh file and the option that its format needs.
struct File {
  std::string name, option;
};

/// Formats that hold their points as numbers x y z.
const std::vector<File> exact_formats{
    {"full.nc", ""}, {"mesh.vtp", ""}, {"mesh.ply", ""}, {"mesh.msh", ""}, {"SaveVertices", ""}};
const std::vector<File> more_exact_formats{
    {"minimal.nc", " --format mpas-minimal"}, {"mesh.vtu", ""}, {"mesh.off", ""}};

/// Formats of angles, or of cells.
const std::vector<File> inexact_formats{{"cells.nc", " --format ugrid"},
                                        {"triangles.nc", " --format ugrid-triangles"},
                                        {"scrip.nc", " --format scrip"},
                                        {"esmf.nc", " --format esmf"},
                                        {"cells.vtp", " --format vtp-cells"},
                                        {"cells.vtu", " --format vtu-cells"},
                                        {"cells.geojson", ""}};

/// A mesh that is no lattice, in the folder as start.vtp.
calotte::Mesh make_start(const Bench& bench, int count) {
  REQUIRE(bench.run("points random " + std::to_string(count) + " -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o start.vtp").code == 0);
  return calotte::read_mesh(bench.path("start.vtp"));
}

/// Converts a file and checks the messages.
void convert(const Bench& bench, const std::string& in, const File& out, int cells,
             const std::string& options = " --order input") {
  const Outcome made = bench.run("convert " + in + " " + out.name + out.option + options);
  CAPTURE(made.err);
  CHECK(made.code == 0);
  CHECK(made.err.empty());
  CHECK(made.out.ends_with(out.name + ": " + std::to_string(cells) + " sites, " +
                           std::to_string(2 * cells - 4) + " triangles, closed\n"));
}

} // namespace

TEST_CASE("from exact format to exact format: the points keep their bits, the mesh is the same") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 60);
  for (const File& in : exact_formats) {
    CAPTURE(in.name);
    fs::create_directory(bench.folder() / "in");
    convert(bench, "start.vtp", {"in/" + in.name, in.option}, 60);
    for (const File& out : exact_formats) {
      CAPTURE(out.name);
      convert(bench, "in/" + in.name, out, 60);
      const calotte::Mesh mesh = calotte::read_mesh(bench.path(out.name));
      CHECK((mesh.points == start.points));
      CHECK((mesh.triangles == start.triangles));
    }
  }
}

TEST_CASE("formats of angles and cells give the same mesh, places as far as angles tell") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 60);
  for (const File& file : inexact_formats) {
    CAPTURE(file.name);
    convert(bench, "start.vtp", file, 60);
    convert(bench, file.name, {"back.vtp", ""}, 60);
    const calotte::Mesh back = calotte::read_mesh(bench.path("back.vtp"));
    CHECK((back.triangles == start.triangles));
    CHECK((back.points - start.points).cwiseAbs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("the selected order of the cells") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 100);
  const auto check_order = [&](const std::string& out, const std::string& options,
                               calotte::Numbering numbering) {
    CAPTURE(options);
    convert(bench, "start.vtp", {out, ""}, 100, options);
    const calotte::Mesh expected = calotte::renumbered(start, numbering);
    const calotte::Mesh mesh = calotte::read_mesh(bench.path(out));
    CHECK((mesh.points == expected.points));
    CHECK((mesh.triangles == expected.triangles));
  };
  check_order("mesh.nc", "", calotte::Numbering::curve);
  check_order("mesh.vtp", "", calotte::Numbering::input);
  for (const std::string out : {"mesh.nc", "mesh.off"}) {
    check_order(out, " --order curve", calotte::Numbering::curve);
    check_order(out, " --order input", calotte::Numbering::input);
  }
}

TEST_CASE("the sphere's radius: the selected one, or that of the points") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 50);
  const auto points = [&](const std::string& name) {
    return calotte::read_mesh(bench.path(name)).points;
  };
  convert(bench, "start.vtp", {"unit.nc", ""}, 50);
  CHECK((points("unit.nc") == start.points));
  convert(bench, "start.vtp", {"earth.nc", " --sphere-radius 6371229"}, 50);
  CHECK(((points("earth.nc") / 6371229 - start.points).cwiseAbs().maxCoeff() < 1e-15));
  convert(bench, "earth.nc", {"again.nc", ""}, 50);
  CHECK((points("again.nc") == points("earth.nc")));
  CHECK((bench.file("again.nc").size() == bench.file("earth.nc").size()));
  convert(bench, "earth.nc", {"back.nc", " --sphere-radius 1"}, 50);
  CHECK(((points("back.nc") - start.points).cwiseAbs().maxCoeff() < 1e-15));
  // Points that stand on no sphere have one of radius 1.
  bench.file("octahedron.off", "OFF\n6 8 0\n1 0 0\n0 2 0\n0 0 3\n-1 0 0\n0 -1 0\n0 0 -1\n"
                               "3 0 1 2\n3 0 2 4\n3 0 4 5\n3 0 5 1\n3 1 3 2\n3 1 5 3\n3 2 3 4\n"
                               "3 3 5 4\n");
  convert(bench, "octahedron.off", {"octahedron.nc", ""}, 6);
  CHECK(points("octahedron.nc").colwise().norm().maxCoeff() == doctest::Approx(1).epsilon(1e-15));
}

TEST_CASE("the density goes into the fields, and equal runs give equal files") {
  const Bench bench;
  make_start(bench, 60);
  const std::string graded = " --density " + bump_density(3);
  convert(bench, "start.vtp", {"first.nc", ""}, 60, graded);
  convert(bench, "start.vtp", {"second.nc", ""}, 60, graded);
  convert(bench, "start.vtp", {"uniform.nc", ""}, 60, "");
  CHECK((bench.file("first.nc") == bench.file("second.nc")));
  const auto density = [&](const std::string& name) {
    return calotte::read_cell_field(bench.path(name), "meshDensity", 60).values;
  };
  CHECK(density("uniform.nc") == Eigen::VectorXd::Ones(60));
  CHECK(density("first.nc").maxCoeff() == 1);
  CHECK(density("first.nc").minCoeff() < 0.02);
  CHECK(has(bench.file("first.nc"), "calotte 1.0."));
}

TEST_CASE("triangles alone go with their points") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 40);
  convert(bench, "start.vtp", {"mesh.tri", ""}, 40, "");
  convert(bench, "mesh.tri --points points.txt", {"back.off", ""}, 40, "");
  const calotte::Mesh back = calotte::read_mesh(bench.path("back.off"));
  CHECK((back.points == start.points));
  CHECK((back.triangles == start.triangles));
  check_refusals(bench, "convert", R"(
points.txt mesh.nc | 2 | points.txt holds triangles without points; give the points with --points FILE
mesh.tri mesh.nc | 2 | mesh.tri holds triangles without points; give the points with --points FILE
start.vtp mesh.tri --order curve | 2 | refer to the input points; leave --order out
)");
}

TEST_CASE("MPI-SCVT's files are a mesh, a start and points") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 60);
  std::string vertices = bench.file("points.txt");
  vertices.pop_back(); // its final newline
  bench.file("SaveVertices", vertices);
  CHECK(bench.run("delaunay SaveVertices -o mesh.vtp").code == 0);
  CHECK((calotte::read_mesh(bench.path("mesh.vtp")).triangles == start.triangles));
  CHECK(bench.run("cvt SaveVertices --iterations 1 -o mesh.vtp").code == 0);
  CHECK(calotte::read_mesh(bench.path("mesh.vtp")).points.cols() == 60);
}

TEST_CASE("every format's points can be triangulated and iterated from again") {
  const Bench bench;
  const calotte::Mesh start = make_start(bench, 60);
  for (const std::vector<File>& files : {more_exact_formats, inexact_formats})
    for (const File& file : files) {
      CAPTURE(file.name);
      convert(bench, "start.vtp", file, 60);
      CHECK(bench.run("delaunay " + file.name + " -o again.vtp").code == 0);
      CHECK((calotte::read_mesh(bench.path("again.vtp")).triangles == start.triangles));
    }
  CHECK(bench.run("cvt minimal.nc --iterations 1 -o again.nc").code == 0);
  CHECK(bench.run("check minimal.nc").code == 0);
  CHECK(bench.run("info minimal.nc").out == bench.run("info start.vtp").out);
}

TEST_CASE("a periodic plane goes from MPAS to MPAS") {
  const Bench bench;
  const calotte::Mesh plane = calotte::hexagonal_box(6, 4, 0.25);
  calotte::write(bench.path("plane.nc"), plane);
  for (const std::string format : {"", " --format mpas-minimal"}) {
    const Outcome made = bench.run("convert plane.nc again.nc" + format);
    CHECK(made.code == 0);
    CHECK(made.out == "again.nc: 24 sites, 48 triangles, a periodic plane\n");
    const calotte::Mesh again = calotte::read_mesh(bench.path("again.nc"));
    CHECK((again.points == plane.points));
    CHECK((again.triangles == plane.triangles));
    CHECK(again.surface == plane.surface);
  }
  check_refusals(bench, "convert plane.nc", R"(
plane.vtp | 2 | plane.vtp:
scrip.nc --format scrip | 2 | scrip.nc:
)");
}

TEST_CASE("invalid options are refused before anything is read") {
  const Bench bench;
  REQUIRE(::mkfifo((bench.folder() / "never.vtp").c_str(), 0600) == 0);
  bench.file("mesh.vtp", "a mesh");
  bench.file("widths.geojson", "widths");
  check_refusals(bench, "convert never.vtp", R"(
mesh.vtp --format ugrid | 2 | mesh.vtp:
mesh.nc --format msh | 2 | mesh.nc:
grid --format mpi-scvt | 2 | grid:
mesh.nc --format netcdf | 2 | --format: netcdf not in {mpas,
mesh.nc --sphere-radius=0 | 2 | --sphere-radius 0 is not a positive number; give one such as 6371229, in metres
mesh.nc --sphere-radius=nan | 2 | --sphere-radius nan is not a positive number
other.off --sphere-radius 6371229 | 2 | applies to NetCDF files only, not to other.off
mesh.nc --order random | 2 | --order: random not in {curve,input}
widths.geojson --cell-width widths.geojson | 2 | widths.geojson is both input and output
absent/mesh.nc | 3 | cannot write absent/mesh.nc: the folder absent does not exist
| 2 | --output is required; see calotte convert --help
)");
  check_refusals(bench, "convert", R"(
mesh.vtp ./mesh.vtp | 2 | ./mesh.vtp is both input and output; give the output another name
absent.nc mesh.off | 3 | absent.nc
mesh.vtp mesh.off | 2 | mesh.vtp
)");
  CHECK(bench.file("mesh.vtp") == "a mesh");
}

TEST_CASE("options of convert and delaunay from a file") {
  const Bench bench;
  REQUIRE(bench.run("points fibonacci 30 -o points.txt").code == 0);
  bench.file("mesh.toml",
             "points = \"points.txt\"\n[out]\noutput = \"mesh.nc\"\nformat = \"scrip\"\n"
             "sort_method = 0\n");
  CHECK(bench.run("delaunay --config mesh.toml").out ==
        "mesh.nc: 30 sites, 56 triangles, closed\n");
  bench.file("convert.toml", "input = \"mesh.nc\"\noutput = \"mesh.off\"\n");
  CHECK(bench.run("convert --config convert.toml").code == 0);
  CHECK(bench.run("convert mesh.nc other.off --config convert.toml").code == 0);
  CHECK((bench.file("mesh.off") == bench.file("other.off")));
  check_refusals(bench, "delaunay --config", R"(
convert.toml | 2 | convert.toml line 1: unknown option "input"
)");
}

// Slow: the file is large, so that a signal meets the writing.
TEST_CASE("kill -9 in the midst of writing leaves the old file whole [slow]") {
  const Bench bench;
  REQUIRE(bench.run("points fibonacci 100000 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o mesh.vtp").code == 0);
  bench.file("mesh.nc", "old");
  bench.file("mesh.graph.info", "old");
  const auto before = bench.names();
  for (int k = 0; k < 5; ++k) {
    const pid_t process = bench.start("convert mesh.vtp mesh.nc");
    for (int wait = 0; wait < 100'000 && bench.names() == before; ++wait) // blocks until it writes
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    std::this_thread::sleep_for(std::chrono::milliseconds(k * k));
    REQUIRE(::kill(process, SIGKILL) == 0);
    CHECK(bench.finish(process).code == -SIGKILL);
    CHECK(bench.file("mesh.nc") == "old");
    const std::string graph = bench.file("mesh.graph.info");
    CHECK((graph == "old" || std::count(graph.begin(), graph.end(), '\n') == 100'001));
    for (const std::string& name : bench.names())
      if (!before.contains(name))
        fs::remove(bench.folder() / name); // the remaining file has another name
  }
  CHECK(bench.run("convert mesh.vtp mesh.nc").code == 0);
  CHECK(calotte::read_sites(bench.path("mesh.nc")).cols() == 100'000);
}

TEST_CASE("the points of an open mesh are triangulated with a warning") {
  const Bench bench;
  bench.file("open.off", "OFF\n6 7 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
                         "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n");
  const Outcome outcome = bench.run("delaunay open.off -o closed.off");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "open.off: its mesh is open, with 7 triangles; the new one closes the "
                       "sphere\nclosed.off: 6 sites, 8 triangles, closed\n");
  CHECK(bench.run("delaunay closed.off -o again.off").out ==
        "again.off: 6 sites, 8 triangles, closed\n");
}

namespace {

/// A cube's faces in longitude and latitude, seen from above: four of the sides, and the caps.
void make_cube(const Bench& bench) {
  std::ostringstream text;
  text << R"({"type":"FeatureCollection","features":[)";
  const auto add = [&](const std::vector<int>& places, const char* centre) {
    text << (text.tellp() > 50 ? "," : "")
         << R"({"type":"Feature","geometry":{"type":"Polygon","coordinates":[[)";
    for (std::size_t k = 0; k <= places.size(); k += 2)
      text << (k > 0 ? "," : "") << "[" << places[k % places.size()] << ","
           << places[(k + 1) % places.size()] << "]";
    text << R"(]]},"properties":{"sea level":)" << text.tellp() << R"(,"name":"face",)" << centre
         << "}}";
  };
  add({-45, -30, 45, -30, 45, 30, -45, 30}, R"("x":1,"y":0,"z":0)");
  add({45, -30, 135, -30, 135, 30, 45, 30}, R"("x":0.1,"y":1,"z":0)"); // not its centroid
  add({135, -30, 225, -30, 225, 30, 135, 30}, R"("x":-1,"y":0,"z":0)");
  add({225, -30, 315, -30, 315, 30, 225, 30}, R"("x":0,"y":-1,"z":0)");
  add({45, 30, 135, 30, 225, 30, 315, 30}, R"("x":0,"y":0,"z":1)");
  add({-45, -30, 225, -30, 135, -30, 180, -80, 45, -30}, R"("x":0,"y":0,"z":-1)"); // a notch
  text << "]}";
  bench.file("cube.geojson", text.str());
}

} // namespace

TEST_CASE("cells that are no Voronoi cells: what info, check and convert say of them") {
  const Bench bench;
  make_cube(bench);
  const Outcome info = bench.run("info cube.geojson --report report.json");
  CHECK(info.code == 0);
  CHECK(has(info.out, "not convex            1; the first is cell 5\n"));
  CHECK(has(info.out, "not centroidal        2; the farthest centre is "));
  CHECK(!has(info.out, "not Delaunay")); // of no triangles
  const auto report = nlohmann::json::parse(calotte::test::read_file(bench.path("report.json")));
  CHECK(report["not_convex"] == 1);
  CHECK(report["first_not_convex"] == 5);
  CHECK(report["not_centroidal"] == 2);
  CHECK(report["off_centring"]["cell"] == 5);
  CHECK(report["off_centring"]["max"] > 0.1);
  const Outcome check = bench.run("check cube.geojson");
  CHECK(has(check.out, "not convex      1; the first is cell 5\n"));
  const Outcome made = bench.run("convert cube.geojson cube.nc --format ugrid");
  CHECK(made.code == 0);
  CHECK(made.out.starts_with("cube.nc: names that NetCDF refuses: \"sea level\" became sea_level\n"
                             "cube.nc: not converted: name\n"
                             "cube.nc: 6 cells, not Voronoi cells: "));
}

TEST_CASE("cells without area are named with exit code 1, and converted as they are") {
  const Bench bench;
  const auto feature = [](const std::string& ring) {
    return R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[)" +
           ring + "]}}";
  };
  bench.file("flat.geojson",
             R"({"type":"FeatureCollection","features":[)" +
                 feature("[[0,0],[9,0],[9,9],[0,9],[0,0]]") + "," +
                 feature("[[0,0],[4,0],[9,0],[0,0]]") + "]}"); // along the equator
  const std::string fault = "1 cell has no area; it is cell 1\n";
  const Outcome check = bench.run("check flat.geojson");
  CHECK(check.code == 1);
  CHECK(check.err == "calotte: flat.geojson: failed: " + fault);
  CHECK(has(check.out, "without area    1; the first is cell 1\n"));
  const Outcome made = bench.run("convert flat.geojson flat.nc --format esmf");
  CHECK(made.code == 1);
  CHECK(made.err == "calotte: flat.geojson: " + fault);
  CHECK(has(bench.run("info flat.nc").out, "\ncells                 2\n"));
  CHECK(bench.run("check flat.nc").code == 1);
}

TEST_CASE("a region of cells is measured as cells, without a triangle of the hull") {
  const Bench bench;
  std::string features;
  for (int k = 0; k < 4; ++k) { // of one degree, in a square
    const auto place = [&](int x, int y) {
      return "[" + std::to_string(10 + k % 2 + x) + "," + std::to_string(50 + k / 2 + y) + "]";
    };
    features += k > 0 ? "," : "";
    features +=
        R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[)" +
        place(0, 0) + "," + place(1, 0) + "," + place(1, 1) + "," + place(0, 1) + "," +
        place(0, 0) + "]]}}";
  }
  bench.file("four.geojson", R"({"type":"FeatureCollection","features":[)" + features + "]}");
  const Outcome info = bench.run("info four.geojson");
  CHECK(info.code == 0);
  CHECK(!has(info.out, "nan"));
  CHECK(!has(info.out, "triangles"));
  CHECK(has(info.out, "\ncells                 4\n"));
  CHECK(bench.run("convert four.geojson four.off").code == 0);
  CHECK(bench.file("four.off").starts_with("OFF\n9 4 0\n"));
}

TEST_CASE("cut: a limited-area grid, which other commands read") {
  const Bench bench;
  REQUIRE(bench.run("points fibonacci 2000 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o global.nc --sphere-radius earth").code == 0);
  const Outcome made =
      bench.run("cut global.nc --region circle=10,50,1500km -o region.nc --rings 2");
  CHECK(made.err.empty());
  CHECK(made.code == 0);
  CHECK(made.out == "region.nc: 79 cells, 27 in the region and 52 in 2 rings around it, 270 edges, "
                    "192 vertices\n"
                    "region.nc: unit sphere, for MPAS-Atmosphere; for others see --for\n");
  const Outcome without = bench.run("cut global.nc --region circle=10,50,1500km -o a.nc --rings 0");
  CHECK(without.out.starts_with("a.nc: 27 cells, all in the region, without rings, "));
  CHECK(!has(bench.file("a.nc"), "1 to 0"));
  CHECK(has(bench.run("cut global.nc --region circle=10,50,1500km -o a.nc --rings 1").out,
            " in 1 ring around it, "));
  CHECK(bench.names().contains("region.graph.info"));
  CHECK(bench.run("check region.nc").code == 0);
  CHECK(bench.run("cut global.nc --region channel=-20,20 -o band.nc --keep-radius").code == 0);
  CHECK(has(bench.run("info band.nc").out, "spacing, km "));
}

TEST_CASE("cut refuses what makes no grid") {
  const Bench bench;
  REQUIRE(bench.run("points fibonacci 200 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o global.nc").code == 0);
  check_refusals(bench, "cut", R"(
global.nc --region circle=0,0,30deg -o region.vtp | 2 | region.vtp: the grid is an MPAS file; give a name that ends in .nc
global.nc --region circle=0,0,30deg -o global.nc | 2 | global.nc
global.nc --region circle=0,0,1km -o region.nc | 2 | none of the 200 cells
global.nc --region circle=0,0,60deg -o region.nc | 2 | hold all 200 cells
global.nc --region circle=0,0,60deg -o region.nc --rings 8 | 2 | from 0 to 7
absent.nc --region circle=0,0,60deg -o region.nc | 3 | absent.nc
points.txt --region circle=0,0,60deg -o region.nc | 2 | points.txt
global.nc -o region.nc | 2 | --region is required
)");
}

TEST_CASE("cull: an ocean grid, and what became of its cells") {
  const Bench bench;
  REQUIRE(bench.run("points fibonacci 2000 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o global.nc --sphere-radius earth").code == 0);
  bench.file("land.geojson", R"({"type":"Polygon","coordinates":[[[0,-60],[30,-60],[40,0],[30,60],)"
                             R"([0,60],[-10,0],[0,-60]]]})");
  bench.file("strait.geojson", R"({"type":"LineString","coordinates":[[-20,10],[50,10]]})");
  const Outcome made = bench.run("cull global.nc --land land.geojson -o ocean.nc --mask mask.nc");
  CHECK(made.err.empty());
  CHECK(made.code == 0);
  CHECK(made.out.starts_with("cells of land               "));
  CHECK(has(made.out, "\nparts of the sea            1\n"));
  CHECK(bench.names().contains("ocean.graph.info"));
  CHECK(bench.names().contains("mask.nc"));
  const std::string checked = check_success(bench, "check ocean.nc").out;
  CHECK(has(checked, "\nVoronoi         yes, inside the boundary\n"));
  CHECK(!has(checked, "centroidal")); // of cells that a coast cuts off from their neighbours
  CHECK(checked.ends_with("\nocean.nc: passed\n"));
  const Outcome open =
      bench.run("cull global.nc --land land.geojson --passage strait.geojson -o open.nc");
  CHECK(has(open.out, "\nopened by passages          "));
  CHECK(bench.run("check open.nc").code == 0);
  CHECK(bench.run("info open.nc").code == 0);
  CHECK(bench.run("cull global.nc --field latCell --sea-below 1 --seed 0,-90 -o south.nc").code ==
        0);
  check_refusals(bench, "cull global.nc -o bad.nc", R"(
--land land.geojson --topography floor.nc | 2 | --topography needs heights
--land land.geojson --topography floor.txt --heights bed.nc | 2 | floor.txt
--land land.geojson --topography floor.nc --heights no.nc | 3 | no.nc
| 2 | there is no land; give --land FILE
--land strait.geojson | 2 | LineString
--land land.geojson --passage land.geojson | 2 | Polygon
--land land.geojson --seed 10,10 | 2 | seed 0 is on land
--sea-below 1 | 2 | --field
--raster global.nc | 2 | no variable is a raster
--raster-variable z --land land.geojson | 2 | --raster
--raster-values height --land land.geojson | 2 | --raster
--raster global.nc --raster-variable z | 2 | no variable z
--raster global.nc --raster-variable latCell | 2 | no coordinate variable lat
--raster global.nc --raster-variable z --raster-values depth | 2 | --raster-values
--land land.geojson --cell-map absent | 3 | absent
)");
  check_refusals(bench, "cull global.nc", "--land land.geojson -o global.nc | 2 | global.nc");
}

TEST_CASE("cull prints the seas that it leaves out, and passages of the world connect them") {
  const Bench bench;
  const std::string land = "cull earth.nc --land " CALOTTE_GSHHG "/binned_GSHHS_l.nc -o ocean.nc ",
                    examples = CALOTTE_FIXTURES "/../../tools/examples/";
  REQUIRE(bench.run("cvt --cells 10242 --for mpas-ocean -o earth.nc").code == 0);
  const Outcome parted = bench.run(land);
  CHECK(parted.code == 0);
  CHECK(has(parted.out, "\n  around 39.5 E 18.0 N      4\n")); // the Red Sea
  CHECK(has(parted.out, "\n  --passage connects a part, --seed selects parts by points in them\n"));
  const Outcome joined = bench.run(land + "--passage " + examples + "passages.geojson --barrier " +
                                   examples + "barriers.geojson --least-area 10000km2");
  CHECK(joined.code == 0);
  CHECK(has(joined.out, "\ncells in parts left out     0\n"));
  CHECK(!has(joined.out, "around"));
  bench.file("bands.geojson", R"({"type": "MultiPolygon", "coordinates":
      [[[[-180, -5], [-60, -5], [60, -5], [180, -5], [180, 5], [60, 5], [-60, 5], [-180, 5], [-180, -5]]],
       [[[-180, 60], [-60, 60], [60, 60], [180, 60], [180, 65], [60, 65], [-60, 65], [-180, 65], [-180, 60]]]]})");
  const Outcome one_left =
      bench.run("cull earth.nc --land bands.geojson -o ocean.nc --seed 0,-60 --seed 0,85");
  CHECK(has(one_left.out, "\nparts of the sea            3\n"));
  CHECK(has(one_left.out, "\n  --passage connects a part, ")); // and no others
  bench.file("inland.geojson", R"({"type": "MultiLineString", "coordinates":
      [[[-10, 36], [0, 38]], [[60, 60], [65, 60]]]})");
  CHECK(has(bench.run(land + "--passage inland.geojson").out,
            "1 passage on land only, without effect: 65.0 E 60.0 N\n"));
  check_refusals(bench, land, R"(
--least-area 1000km | 2 | --least-area: "1000km" is no area; give km^2, such as 1000
--least-area 1e9 | 2 | all land of the coast is smaller than the least area
)");
}

TEST_CASE("cull: the coast of GSHHG, maps of cells; the land around a place as a region") {
  const Bench bench;
  const std::string coast = CALOTTE_GSHHG "/binned_GSHHS_c.nc";
  REQUIRE(bench.run("points fibonacci 2000 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o global.nc --sphere-radius earth").code == 0);
  CHECK(bench.run("cull global.nc --land " + coast + " --cell-map . -o ocean.nc").code == 0);
  CHECK(bench.run("check ocean.nc").code == 0);
  for (const char* name : {"cellMapForward.txt", "cellMapBackward.txt", "ocean.graph.info"})
    CHECK(bench.names().contains(name));
  const std::string region = "cut global.nc --region land=" + coast;
  const Outcome made = bench.run(region + ",134,-25 --rings 2 -o australia.nc");
  CHECK(made.code == 0);
  CHECK(has(made.out, " in the region and "));
  check_refusals(bench, "cull global.nc -o bad.nc",
                 "--land " CALOTTE_GSHHG "/binned_border_c.nc | 2 | land is polygons of GeoJSON or "
                 "a shapefile, or a binned file of GSHHG");
  bench.file("inland.geojson",
             R"({"type": "LineString", "coordinates": [[134, -25], [134.5, -25]]})");
  check_refusals(
      bench, "cull global.nc -o bad.nc",
      "--land " + coast +
          " --passage inland.geojson | 2 | inland.geojson: passage 0 lies "
          "on land only and reaches no sea; begin and end it in the sea, and give longitudes");
  check_refusals(bench, "cut global.nc -o bad.nc",
                 "--region land=" + coast + " | 2 | give land=FILE,LON,LAT");
  check_refusals(bench, "cut global.nc -o bad.nc",
                 "--region land=" + coast + ",-150,0 | 2 | no ring of the coast contains");
  check_refusals(bench, "cut global.nc -o bad.nc",
                 "--region land=" + coast + ",134,-95 | 2 | no latitude from -90 to 90");
  bench.file("x.nc", "");
  check_refusals(bench, "cut global.nc", R"(
--region land=a,b.nc,0,0 -o bad.nc | 3 | a,b.nc
--region land=x.nc,0,0 -o x.nc | 2 | x.nc
)");
}
