// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/generators.h>
#include <calotte/read.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string>

#include <sys/stat.h>

namespace fs = std::filesystem;

using namespace calotte::test;

namespace {

constexpr const char* octahedron_text = "1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n";

} // namespace

TEST_CASE("invalid points: the message names the line, and nothing is written") {
  const Bench bench;
  const auto check_bad = [&](const std::string& text, const std::string& message,
                             const std::string& options = "") {
    CAPTURE(text);
    bench.file("points.txt", text);
    check_refusals(bench, "delaunay points.txt -o mesh.vtp --report report.json",
                   options + " | 2 | " + message);
  };
  const std::string start = octahedron_text; // lines 1 to 6
  check_bad(start + "nan 0 1\n", "points.txt line 7: NaN gives no direction; remove the point");
  check_bad(start + "0 1 inf", "points.txt line 7: an infinite number gives no direction");
  check_bad("# a comment\n" + start + "0 0 0\n",
            "points.txt line 8: the zero vector has no direction");
  check_bad(start + "\n1 two 3\n",
            "points.txt line 8: \"two\" is not a number; write three numbers");
  check_bad("x,y,z\n" + start + "1,2\n",
            "points.txt line 8: 2 columns only; write three numbers x y z on each line, or");
  check_bad("x y z\n", "points.txt: no points in 1 line; write three numbers x y z on each line\n");
  check_bad("0 0\n90 91\n",
            "points.txt line 2: latitude 91 is outside -90 to 90; write longitude first",
            " --lonlat");
  check_refusals(bench, "delaunay -o mesh.vtp", R"(
absent.txt | 3 | cannot read absent.txt: No such file or directory; check its name and its permissions
. | 3 | cannot read .: it is a folder; give the name of a file
- </dev/null | 2 | standard input: no points in 0 lines
)");
  const std::string no_file = "cannot read 1000: No such file or directory; check its name and its "
                              "permissions\n"; // of commands without --cells
  CHECK(bench.run("delaunay 1000 -o mesh.vtp").err == "calotte: " + no_file);
  CHECK(bench.run("partition 1000 --parts 2").err == "calotte: " + no_file);
  CHECK(bench.run("cut 1000 --region circle=0,0,9deg -o mesh.nc").err == "calotte: " + no_file);
}

TEST_CASE("sets that span no mesh are refused, and nothing is written") {
  const Bench bench;
  bench.file("two.txt", "1 0 0\n0 1 0\n2 0 0\n0 3 0\n");
  bench.file("circle.txt", "1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n1 1 0\n");
  bench.file("twice.txt", "# six and one again\n" + std::string(octahedron_text) + "0 7 0\n");
  check_refusals(bench, "delaunay -o mesh.vtp", R"(
two.txt | 2 | 3
circle.txt | 2 | great circle
--duplicates refuse twice.txt | 2 | twice.txt line 8:
--duplicates refuse - <twice.txt | 2 | standard input line 8:
)");
}

TEST_CASE("bad usage is refused before any work") {
  const Bench bench;
  bench.file("points.txt", octahedron_text);
  // A named pipe without a writer: reading it would block, so the command must not read it.
  REQUIRE(::mkfifo((bench.folder() / "never").c_str(), 0600) == 0);
  check_refusals(bench, "delaunay -o mesh.vtp never", R"(
--regions many | 2 | --regions: "many" is not an integer >= 1; see calotte delaunay --help
--sort any | 2 | --sort: any not in {halo,distance,voronoi}
--fast | 2 | unknown option --fast; see calotte delaunay --help
--centres never | 2 | --centres: never not in {sample,fibonacci}
--report mesh.vtp | 2 | mesh.vtp is both mesh and report; give the report another name
)");
  check_refusals(bench, "", R"(
delaunay never -o mesh | 2 | mesh: no suffix; a mesh file ends in .nc,
delaunay never | 2 | --output is required
delaunay -o mesh.vtp | 2 | --points is required
triangulate | 2 | unknown command triangulate; see calotte --help
check mesh.tri | 2 | mesh.tri holds triangles only; give the points they refer to (--points FILE)
points random 9 -o points.vtp | 2 | points.vtp: points are text with x y z on each line
points random 9 -o points.tri | 2 | points.tri: points are text with x y z on each line
points fibonacci 9 --seed 3 -o points.txt | 2 | --seed applies to random points only
points spiral 9 --poles -o points.txt | 2 | --poles applies to latlon points only
delaunay points.txt -o points.txt | 2 | points.txt is both input and output
)");
  CHECK(contents(bench.folder() / "points.txt") == octahedron_text);
}

TEST_CASE("an output that cannot be written is refused before any work") {
  const Bench bench;
  REQUIRE(::mkfifo((bench.folder() / "never").c_str(), 0600) == 0);
  fs::create_directory(bench.folder() / "folder.vtp");
  check_refusals(bench, "", R"(
delaunay never -o absent/mesh.vtp | 3 | cannot write absent/mesh.vtp: the folder absent does not exist; create it first
delaunay never -o mesh.vtp --report absent/report.json | 3 | cannot write absent/report.json: the
delaunay never -o folder.vtp | 3 | cannot write folder.vtp: it is a folder; give the name of a file
points random 9 -o absent/points.txt | 3 | cannot write absent/points.txt: the folder absent does
)");
}

TEST_CASE("a full disk leaves no new file, and the old file unchanged") {
  const Bench bench;
  const Outcome made = bench.run("points random 100 -o points.txt");
  REQUIRE(made.code == 0);
  bench.file("mesh.vtp", "old");
  // The shell's limit on the size of files stands for a full disk: 1 block of 512 or 1024 bytes.
  check_refusals(bench, "", R"(
delaunay points.txt -o mesh.vtp | 3 | cannot write mesh.vtp: File too large; make room or write elsewhere
delaunay points.txt -o other.off | 3 | cannot write other.off: File too large
points random 100 -o points.txt | 3 | cannot write points.txt: File too large
)",
                 "ulimit -f 1;");
  check_refusals(bench, "points random 100 -o",
                 "/dev/full | 3 | cannot write /dev/full: No space left on device");
  CHECK(contents(bench.folder() / "mesh.vtp") == "old");
  CHECK(calotte::read_points(bench.folder() / "points.txt").cols() == 100);
  CHECK(bench.run("points random 100 -o - >/dev/full").code == 3);
  CHECK(bench.run("--version >/dev/full").code == 3);
}

TEST_CASE("from points to a mesh that passes its check, in every format") {
  const Bench bench;
  CHECK(bench.run("points fibonacci 500 -o points.txt").out == "points.txt: 500 points\n");
  for (const std::string mesh : {"mesh.vtp", "mesh.vtu", "mesh.off", "mesh.ply", "mesh.tri"}) {
    CAPTURE(mesh);
    const Outcome made = bench.run("delaunay points.txt -o " + mesh);
    CHECK(made.code == 0);
    CHECK(made.out == mesh + ": 500 sites, 996 triangles, closed\n");
    CHECK(made.err.empty());
    const Outcome checked = bench.run("check " + mesh + " --points points.txt");
    CHECK(checked.code == 0);
    CHECK(has(checked.out, "triangles       996\n"));
    CHECK(checked.err.empty());
  }
  const calotte::Mesh mesh = calotte::read_mesh(bench.folder() / "mesh.vtp");
  CHECK(mesh.points == calotte::fibonacci_sphere(500));
}

TEST_CASE("standard input and output take the place of files") {
  const Bench bench;
  bench.file("points.txt", octahedron_text);
  CHECK(bench.run("delaunay - -o mesh.tri <points.txt").code == 0);
  CHECK(bench.run("check mesh.tri --points - <points.txt").code == 0);
  const Outcome points = bench.run("points icosahedron 12 -o -");
  CHECK(points.code == 0);
  CHECK(std::count(points.out.begin(), points.out.end(), '\n') == 12);
}

TEST_CASE("a mesh that is not Delaunay fails its check with exit code 1") {
  const Bench bench;
  bench.file("points.txt", "0.1 0 1\n-0.1 0 1\n0 1 1\n0 -1 1\n");
  bench.file("mesh.tri", "0 2 3\n1 3 2\n"); // the long diagonal
  const Outcome outcome = bench.run("check mesh.tri --points points.txt");
  CHECK(outcome.code == 1);
  CHECK(outcome.err == "calotte: mesh.tri: failed: 1 of 5 edges are not Delaunay; the first is "
                       "from site 2 to 3\n");
  CHECK(has(outcome.out, "sites           4\n"));
  CHECK(has(outcome.out, "boundary edges  4\n"));
  CHECK(has(outcome.out, "Delaunay        no\n"));
}

TEST_CASE("in the plane the other diagonal of cocircular sites passes, as on the sphere") {
  const Bench bench;
  bench.file("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  bench.file("kite.off", "OFF\n4 2 0\n0 0 0\n1 -.1 0\n2 0 0\n1 .1 0\n3 0 1 2\n3 0 2 3\n");
  const Outcome square = bench.run("check square.off");
  CHECK(square.code == 0);
  CHECK(square.err.empty());
  CHECK(square.out.ends_with("cocircular      1 edges take the other diagonal\n"
                             "boundaries      1, not convex at 0 sites\n"
                             "Delaunay        yes, every edge\n"
                             "square.off: passed\n"));
  const Outcome info = bench.run("info square.off --rectangle 0,0,1,1");
  CHECK(info.code == 0);
  CHECK(has(info.out, "cells                 4\n"));
  const Outcome kite = bench.run("check kite.off");
  CHECK(kite.code == 1);
  CHECK(kite.err == "calotte: kite.off: failed: 1 of 5 edges are not Delaunay; the first is from "
                    "site 0 to 2\n");
  check_refusals(bench, "info kite.off",
                 "--rectangle 0,-1,2,1 | 2 | edge (2, 0) of triangle 0 (0, 1, 2) is not Delaunay: "
                 "site 3 is inside the circumcircle; triangulate the points anew");
}

TEST_CASE("a file that deviates from its mesh fails its check with exit code 1") {
  const Bench bench;
  bench.file("points.txt", octahedron_text);
  CHECK(bench.run("delaunay points.txt -o mesh.nc").code == 0);
  CHECK(check_success(bench, "check mesh.nc").out.ends_with("\nmesh.nc: passed\n"));
  std::string bytes = bench.file("mesh.nc");
  bytes.replace(bytes.find("YES"), 3, "YEP"); // of on_a_sphere
  bench.file("mesh.nc", bytes);
  const Outcome outcome = bench.run("check mesh.nc");
  CHECK(outcome.code == 1);
  CHECK(outcome.err == "calotte: mesh.nc: failed: 1 variable deviates from the mesh or the format: "
                       "on_a_sphere\n");
  CHECK(outcome.out.ends_with("Delaunay        yes, all checks passed\n"
                              "the attribute on_a_sphere is \"YEP\" instead of \"YES\"\n"));
}

TEST_CASE("triangles of both orientations are refused with the first of the rarer") {
  const Bench bench;
  bench.file("points.txt", octahedron_text);
  bench.file("mesh.tri", "0 1 2\n0 2 4\n0 4 5\n0 5 1\n1 3 2\n1 5 3\n2 3 4\n3 4 5\n");
  for (const std::string command : {"check", "info"})
    check_refusals(bench, command,
                   "mesh.tri --points points.txt | 2 | mesh.tri: triangle 7 (3, 4, 5) runs "
                   "clockwise, but 7 triangles run the other way");
}

TEST_CASE("duplicates are merged and counted, and triangles as text keep the input's ids") {
  const Bench bench;
  bench.file("points.txt", "1 0 0\n2 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n0 0 -9\n");
  CHECK(bench.run("delaunay points.txt -o mesh.tri").out ==
        "mesh.tri: 6 sites, 8 triangles, closed, 2 duplicates merged\n");
  CHECK(contents(bench.folder() / "mesh.tri").starts_with("0 2 3\n"));
  CHECK(bench.run("check mesh.tri --points points.txt").code == 0);
}

TEST_CASE("a set in a hemisphere gives an open mesh and a message") {
  const Bench bench;
  bench.file("points.txt", "0 0 1\n1 0 1\n0 1 1\n-1 -1 1\n");
  CHECK(bench.run("delaunay points.txt -o mesh.vtp").out ==
        "mesh.vtp: 4 sites, 3 triangles, open: all sites lie in a hemisphere\n");
  CHECK(bench.run("check mesh.vtp").code == 0);
}

TEST_CASE("the report has the documented content") {
  const Bench bench;
  CHECK(bench.run("points random 2000 --seed 5 -o points.txt").code == 0);
  CHECK(bench.run("delaunay points.txt -o mesh.vtp --threads 2 --regions 12 --report report.json")
            .code == 0);
  const std::string report = contents(bench.folder() / "report.json");
  for (const char* key :
       {"sites", "regions", "threads", "overlap", "seconds", "triangulate", "unite", "total",
        "read", "write", "memory", "peak_bytes", "page_faults", "touched_bytes", "duplicates",
        "seam_triangles", "exact_predicates", "sites_per_region"})
    CHECK(has(report, std::string("\"").append(key).append("\": ")));
  CHECK(has(report, "\"regions\": 12,"));
  CHECK(has(report, "\"threads\": 2,"));
}

#ifdef __GLIBC__
// Slow: of few cells the program itself is most of the memory, and sanitizers have their own
// malloc.
TEST_CASE("a run touches hardly more pages than it holds at its peak [slow]") {
  const Bench bench;
  CHECK(bench.run("cvt --cells 163842 -o grid.nc --report report.json").code == 0);
  const auto memory = nlohmann::json::parse(bench.file("report.json"))["memory"];
  CHECK(memory["touched_bytes"].get<double>() < 1.25 * memory["peak_bytes"].get<double>());
}
#endif

TEST_CASE("the mesh file is the same bytes for any threads, regions, centres and sort") {
  const Bench bench;
  CHECK(bench.run("points random 3000 -o points.txt").code == 0);
  CHECK(bench.run("delaunay points.txt -o first.vtp").code == 0);
  for (const char* options :
       {"--threads 1", "--threads 3 --regions 42", "--regions 1", "--sort distance --regions 12",
        "--sort voronoi --regions 12", "--centres fibonacci"}) {
    CHECK(bench.run("delaunay points.txt -o mesh.vtp " + std::string(options)).code == 0);
    CHECK(contents(bench.folder() / "mesh.vtp") == contents(bench.folder() / "first.vtp"));
  }
}

TEST_CASE("every kind of points") {
  const Bench bench;
  const auto count = [&](const std::string& arguments) {
    CHECK(bench.run("points " + arguments + " -o points.txt").code == 0);
    return calotte::read_points(bench.folder() / "points.txt").cols();
  };
  CHECK(count("random 7") == 7);
  CHECK(count("fibonacci 7") == 7);
  CHECK(count("spiral 7") == 7);
  CHECK(count("geodesic 163") == 163);
  CHECK(count("icosahedron 162") == 162);
  CHECK(count("latlon 4") == 32);
  CHECK(count("latlon 4 --poles") == 34);
  CHECK(count("cubed 3") == 54);
  check_refusals(bench, "points -o a.txt icosahedron", R"(
5 | 2 | a bisected icosahedron has 12, 42, 162, 642 and so on points, not 5; give 12
100 | 2 | give 42 or 162
10000000000 | 2 | of 10000000000 points is too large; give 671088642 or fewer
)");
}

TEST_CASE("the weather stations become a mesh") {
  const Bench bench;
  const std::string stations = CALOTTE_FIXTURES "/weather-stations.csv";
  const Outcome made = bench.run("delaunay '" + stations + "' --lonlat -o mesh.tri");
  CHECK(made.code == 0);
  CHECK(has(made.out, ", closed"));
  CHECK(bench.run("check mesh.tri --lonlat --points '" + stations + "'").code == 0);
}

TEST_CASE("info prints a table of the mesh as a grid, and reports the same as JSON") {
  const Bench bench;
  CHECK(bench.run("points icosahedron 12 -o points.txt").code == 0);
  CHECK(bench.run("delaunay points.txt -o mesh.tri").code == 0);
  const Outcome shown = bench.run("info mesh.tri --points points.txt --report report.json");
  CHECK(shown.code == 0);
  CHECK(shown.err.empty());
  for (const char* row :
       {"cells                 12\n", "triangles             20\n", "degree: cells         5: 12\n",
        "sigma                 1  ", "spacing, degrees      63.4349       63.4349       63.4349\n",
        "area ratio            1\n", "obtuse triangles      0\n"})
    CHECK(has(shown.out, row));
  const std::string report = contents(bench.folder() / "report.json");
  std::istringstream keys(
      "cells triangles degrees obtuse spacing sigma cell_quality cell_area area_ratio "
      "triangle_quality angles off_centring residual energy energy_times_cells cells_area "
      "triangles_area limit excess "
      "dc_over_h p50 dv_over_dc short_voronoi_edges mismatched_edges bad_cells");
  for (std::string key; keys >> key;)
    CHECK(has(report, "\"" + key + "\": "));
}

TEST_CASE("info measures against a density") {
  const Bench bench;
  CHECK(bench.run("points icosahedron 162 -o points.txt").code == 0);
  CHECK(bench.run("delaunay points.txt -o mesh.vtp").code == 0);
  const Outcome uniform = bench.run("info mesh.vtp --density uniform");
  const Outcome bump =
      bench.run("info mesh.vtp --density tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8");
  CHECK(uniform.out == bench.run("info mesh.vtp").out);
  CHECK(bump.code == 0);
  const auto before = [](const Outcome& outcome) {
    return outcome.out.substr(0, outcome.out.find("density"));
  };
  CHECK(before(bump) == before(uniform)); // parts that do not depend on the density
  CHECK(bump.out != uniform.out);
}

TEST_CASE("info converts distances to km where a radius is known") {
  const Bench bench;
  CHECK(bench.run("points icosahedron 12 -o points.txt").code == 0);
  CHECK(bench.run("delaunay points.txt -o mesh.vtp").code == 0);
  CHECK(bench.run("convert mesh.vtp mesh.nc --sphere-radius 1000000").code == 0);
  CHECK(!has(bench.run("info mesh.vtp").out, "km"));
  const std::string row = "spacing, km           1107.15       1107.15       1107.15\n"; // atan(2)
  CHECK(has(bench.run("info mesh.nc").out, row));
  const Outcome given = bench.run("info mesh.vtp --sphere-radius 1e6 --report report.json");
  CHECK(has(given.out, row));
  CHECK(has(bench.file("report.json"), "\"least_dc_km\": 1107.14871"));
  CHECK(has(bench.run("info mesh.nc --sphere-radius 1e3").out, "spacing, km           1.10715 "));
  check_refusals(
      bench, "info mesh.vtp",
      "--sphere-radius -1 | 2 | --sphere-radius -1 is not a positive number; give one such as");
}

TEST_CASE("info counts the cells of a limited-area grid by their masks, and measures whole ones") {
  const Bench bench;
  REQUIRE(
      bench.run("cvt --region circle=0,90,900km --cell-width 150km --limited-area -o a.nc").code ==
      0);
  const Outcome info = bench.run("info a.nc --sphere-radius earth --report report.json");
  CAPTURE(info.out);
  CHECK(info.code == 0);
  CHECK(has(info.out, "\n  relaxation, 1 to 5  "));
  CHECK(has(info.out, "\nboundary loops        1\n"));
  CHECK(has(info.out, "\ndv / dc "));
  CHECK(has(info.out, "\nspacing, km "));
  const auto report = nlohmann::json::parse(bench.file("report.json"));
  const auto masks = report["cells_by_mask"].get<std::vector<int>>();
  CHECK(masks.size() == 8);
  CHECK(std::accumulate(masks.begin(), masks.end(), 0) == report["cells"]);
  CHECK(report["cells_inside"] == masks[0]);
  CHECK(report["cells_specified"] == masks[6] + masks[7]);
  CHECK(report["whole_cells"] < report["cells"]);
  CHECK(report["dv_over_dc"]["mean"] == doctest::Approx(0.577).epsilon(0.05));
}

TEST_CASE("info prints the errors of operators, and reports the same as JSON") {
  const Bench bench;
  REQUIRE(bench.run("cvt --cells 642 -o grid.nc --sphere-radius earth").code == 0);
  const Outcome plain = bench.run("info grid.nc");
  const Outcome info = bench.run("info grid.nc --operators --report report.json");
  CAPTURE(info.out);
  CHECK(info.code == 0);
  REQUIRE(info.out.starts_with(plain.out));
  const auto report = nlohmann::json::parse(bench.file("report.json"))["operators"];
  std::istringstream lines(info.out.substr(plain.out.size()));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "errors of operators    l2           max          at cell     lon, lat");
  for (const char* key :
       {"divergence", "gradient", "laplacian", "curl", "tangential", "kinetic_energy"}) {
    CAPTURE(key);
    std::getline(lines, line);
    double l2 = 0, max = 0;
    std::int64_t cell = 0;
    std::istringstream(line.substr(23)) >> l2 >> max >> cell;
    CHECK(report[key]["l2"].get<double>() == doctest::Approx(l2).epsilon(1e-3));
    CHECK(report[key]["max"].get<double>() == doctest::Approx(max).epsilon(1e-3));
    CHECK(report[key]["cell"] == cell);
    CHECK(report[key]["at"].size() == 2);
    CHECK(l2 < max);
  }
  const double kilometres = 6371.229 * std::sqrt(8 / report["primal_eigenvalue"].get<double>());
  const std::string row = "\nlongest stable step x speed of waves, km        ";
  REQUIRE(has(info.out, row));
  CHECK(std::stod(info.out.substr(info.out.find(row) + row.size())) ==
        doctest::Approx(kilometres).epsilon(1e-3));
  const std::string worst = std::to_string(report["tangential"]["cell"].get<int>());
  CHECK(has(bench.run("info grid.nc --operators --cell " + worst).out,
            "\ntangential velocity error   "));
}

TEST_CASE("info prints the errors of operators of limited areas and planes") {
  const Bench bench;
  REQUIRE(
      bench.run("cvt --region circle=0,90,900km --cell-width 150km --limited-area -o a.nc").code ==
      0);
  CHECK(has(bench.run("info a.nc --operators").out, "\ntangential velocity    0."));
  REQUIRE(bench.run("cvt --rectangle 0,0,4,3 --cells 200 -o plane.vtp").code == 0);
  CHECK(has(bench.run("info plane.vtp --rectangle 0,0,4,3 --operators").out,
            "\nlongest stable step x speed of waves            "));
}

TEST_CASE("info measures an open mesh, and refuses a report in its place") {
  const Bench bench;
  bench.file("points.txt", "0 0 1\n1 0 1\n0 1 1\n-1 -1 1\n");
  CHECK(bench.run("delaunay points.txt -o mesh.vtp").code == 0);
  const Outcome open = bench.run("info mesh.vtp --report report.json");
  CHECK(open.code == 0);
  CHECK(has(bench.run("info mesh.vtp --density x8").out,
            "mesh.vtp: the density x8 is not used: closed meshes and domains of a plane"));
  CHECK(open.out.starts_with("mesh.vtp: the mesh is open: 3 boundary edges in 1 loop; its "
                             "triangles and whole cells are measured\n"));
  CHECK(has(bench.file("report.json"), "\"whole_cells\": 1,"));
  CHECK(!has(bench.file("report.json"), "\"residual\""));
  check_refusals(bench, "info mesh.vtp --report", R"(
mesh.vtp | 2 | mesh.vtp is both input and output
absent/report.json | 3 | the folder absent does not exist
)");
}

TEST_CASE("a plane is triangulated, open or periodic, written and read back") {
  const Bench bench;
  std::string lattice = "x, y\n";
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      lattice += std::to_string(i) + ", " + std::to_string(j) + "\n";
  bench.file("points.txt", lattice);
  CHECK(bench.run("delaunay --plane points.txt -o mesh.off").out ==
        "mesh.off: 100 sites, 162 triangles, 36 sites on the hull\n");
  CHECK(bench.run("delaunay --plane points.txt -o mesh.vtp --regions 4").code == 0);
  const Outcome box = bench.run("delaunay --plane --periodic 10,10 points.txt -o box.nc");
  CHECK(box.out == "box.nc: 100 sites, 200 triangles, periodic\n");
  CHECK(bench.run("convert box.nc again.nc").code == 0);
  CHECK(calotte::read_mesh(bench.folder() / "box.nc").triangles ==
        calotte::read_mesh(bench.folder() / "again.nc").triangles);
}

TEST_CASE("planar points in a domain, and the proof that their mesh is Delaunay") {
  const Bench bench;
  bench.file("lake.txt", "0 0\n4 0\n4 3\n0 3\n\n1 1\n2 1\n1 2\n");
  CHECK(bench.run("points random-plane 500 --domain lake.txt --seed 3 -o lake.points").code == 0);
  CHECK(bench.run("points hexagonal 120 --rectangle=-1,-1,1,1 -o square.points").code == 0);
  CHECK(bench.run("points hexagonal 120 --periodic 10,10.392304845413264 -o box.points").out ==
        "box.points: 120 points\n");
  CHECK(bench.run("delaunay --plane lake.points -o lake.vtp").code == 0);
  CHECK(bench.run("delaunay --plane square.points -o square.tri").code == 0);
  CHECK(bench.run("delaunay --plane --periodic 10,10.392304845413264 box.points -o box.nc").code ==
        0);
  CHECK(has(bench.run("check lake.vtp").out, "Delaunay        yes"));
  const Outcome square = bench.run("check --plane square.tri --points square.points");
  CHECK(has(square.out, "area / hull     "));
  CHECK(has(square.out, "Delaunay        yes"));
  CHECK(has(bench.run("check box.nc").out, "boundary edges  0\narea / box"));
  CHECK(bench.run("convert lake.vtp lake.off").out.ends_with(", a plane\n"));
  check_refusals(bench, "convert", R"(
lake.vtp lake.nc | 2 | need its domain, which clips them; give --domain FILE
box.nc lake.vtp --domain lake.txt | 2 | holds no mesh of a bounded plane; leave --domain
)");
  CHECK(bench.run("convert --plane square.tri --points square.points square.ply").code == 0);
  CHECK(bench.run("convert square.ply square.nc --rectangle=-1,-1,1,1").code == 0);
  CHECK(bench.run("check square.nc").code == 0);
  bench.file("bent.off", "OFF\n4 2 0\n0 0 0\n4 0 0\n2 1 0\n2 -1 0\n3 0 1 2\n3 0 3 1\n");
  const Outcome bent = bench.run("check bent.off");
  CHECK(bent.code == 1);
  CHECK(bent.err ==
        "calotte: bent.off: failed: 1 of 5 edges are not Delaunay; the first is from site 0 to "
        "1\n");
}

TEST_CASE("invalid domains and planar points are refused in one line") {
  const Bench bench;
  bench.file("bow.txt", "0 0\n4 4\n4 0\n0 4\n");
  check_refusals(bench, "points -o x.txt", R"(
hexagonal 50 | 2 | --domain
fibonacci 50 --rectangle 0,0,1,1 | 2 | sphere
hexagonal 50 --seed 1 --rectangle 0,0,1,1 | 2 | --seed
random-plane 50 --domain bow.txt | 2 | meet
random-plane 50 --domain absent.txt | 3 | absent.txt
random-plane 9 --periodic 1,1 --rectangle 0,0,1,1 | 2 | excludes
)");
  for (const std::string word : {"1,2,3", "0,0,0,1", "1,0,0,1", "0,0,1,nan", "0,0,1,1,", "a"})
    check_refusals(bench, "points random-plane 50 -o x.txt",
                   "--rectangle " + word + " | 2 | --rectangle " + word + " is not a rectangle");
  for (const std::string word : {"1", "1,0", "-1,1", "1,1,1", "1,x"})
    check_refusals(bench, "points random-plane 50 -o x.txt",
                   "--periodic " + word + " | 2 | --periodic " + word + " is not a box");
}

TEST_CASE("a file that knows that it is planar needs no --plane, which may agree") {
  const Bench bench;
  bench.file("points.txt", "0 0\n4 0\n4 3\n0 3\n2 1\n");
  CHECK(bench.run("delaunay --plane points.txt -o mesh.vtp").code == 0);
  CHECK(bench.run("delaunay --plane points.txt -o mesh.tri").code == 0);
  CHECK(bench.run("cvt --periodic 4,3 --cells 40 -o box.nc").code == 0);
  for (const std::string plane : {"", " --plane"}) {
    CHECK(bench.run("delaunay mesh.vtp -o again.vtp" + plane).code == 0);
    CHECK((bench.file("again.vtp") == bench.file("mesh.vtp")));
    CHECK(has(bench.run("delaunay box.nc -o again.nc" + plane).out,
              "40 sites, 80 triangles, periodic"));
    CHECK(bench.run("delaunay box.nc --periodic 4,3 -o again.nc" + plane).code == 0);
    CHECK(bench.run("check mesh.tri --points mesh.vtp" + plane).code == 0);
    CHECK(bench.run("convert mesh.vtp mesh.nc --rectangle 0,0,4,3" + plane).code == 0);
    CHECK(bench.run("refine mesh.nc --cell-width 9 -o finer.nc" + plane).code == 0);
    for (const std::string command : {"check ", "info ", "draw -o a.svg ", "view -o a.html "})
      for (const std::string mesh : {"mesh.nc", "box.nc"})
        CHECK(bench.run(command + mesh + plane).code == 0);
  }
  check_refusals(bench, "delaunay -o never.nc", R"(
box.nc --periodic 4,4 | 2 | box.nc: its periodic box is 4 x 3; leave --periodic out
mesh.vtp --sphere-radius 5 | 2 | --sphere-radius does not apply to a plane; leave it out
)");
  check_refusals(bench, "cvt -o never.vtp", R"(
--points mesh.vtp | 2 | mesh.vtp: it holds points of a plane; give its domain (--rectangle
)");
}

TEST_CASE("invalid planar input is refused, naming line or option") {
  const Bench bench;
  bench.file("points.txt", "0 0\n1 0\n0.5 1\n0.7 0.2\n");
  bench.file("bad.txt", "0 0\n1 0\n0.5 inf\n");
  bench.file("line.txt", "0 0\n1 1\n2 2\n");
  CHECK(bench.run("points random 20 -o globe.txt").code == 0);
  CHECK(bench.run("delaunay globe.txt -o globe.off").code == 0);
  check_refusals(bench, "delaunay -o mesh.vtp --plane", R"(
bad.txt | 2 | bad.txt line 3: an infinite number gives no place; remove the point or correct it
line.txt | 2 | on one line
globe.off | 2 | globe.off: it holds points of the sphere; give points of a plane, or leave --plane
--lonlat points.txt | 2 | excludes
)");
  check_refusals(bench, "delaunay -o mesh.nc points.txt", R"(
--plane | 2 | a plane is written as
--plane --periodic 2,2 | 2 | a circle wider than half of the periodic box
--plane --periodic 0.5,2 | 2 | point 1 is outside the periodic box
--plane --periodic 5 | 2 | --periodic 5 is not a box
--periodic 5,5 | 2 | --periodic requires --plane
)");
}
