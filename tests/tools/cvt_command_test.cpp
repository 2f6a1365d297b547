// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/read.h>

#include <calotte/mesh_file.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace calotte::test;

namespace fs = std::filesystem;

namespace {

/// Waits for a condition that another process fulfils; fails after minutes.
void wait_until(const std::function<bool()>& done) {
  for (int k = 0; k < 200'000 && !done(); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  REQUIRE(done());
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

/// A key as it stands in a report.
std::string quoted(const std::string& key) { return std::string("\"").append(key).append("\": "); }

/// The lines of a report that the run determines, independent of host and time.
std::vector<std::string> course(const std::string& report) {
  std::vector<std::string> lines;
  for (const std::string& line : lines_of(report))
    for (const char* key : {"cells", "rule", "l2", "linf", "gradient", "energy"})
      if (line.find(quoted(key)) != std::string::npos)
        lines.push_back(line);
  return lines;
}

/// True if the command runs in that process and handles the signal. (After the fork the process is
/// briefly the test's own, which handles it, too.)
bool handles(pid_t process, int signal) {
  std::istringstream status(contents("/proc/" + std::to_string(process) + "/status"));
  bool command = false;
  for (std::string word; status >> word;) {
    if (word == "Name:" && status >> word)
      command = word == "calotte";
    if (word == "SigCgt:" && status >> word)
      return command && (std::stoull(word, nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

/// Waits until the command's process handles a signal. An emulator handles every signal from its
/// start on, which hides when the command does: there the command gets time.
void wait_for_handler(pid_t process, int signal) {
  if constexpr (CALOTTE_EMULATED)
    std::this_thread::sleep_for(std::chrono::seconds(10));
  else
    wait_until([&] { return handles(process, signal); });
}

/// Starts a run with a log and waits until it iterates, so that it handles signals: before that a
/// signal ends the command. The first line on its standard error is that of the log.
pid_t start_iterating(const Bench& bench, const std::string& arguments) {
  const pid_t process = bench.start(arguments, "export CALOTTE_LOG_AFTER=0;");
  wait_until([&] { return has(bench.err(), "iteration "); });
  return process;
}

/// Options of a run that is long enough to be interrupted many times; it saves its state after
/// every iteration.
const std::string long_run = "cvt --cells 162 --start random --seed 5 --iterations 3000";
const std::string long_levels =
    "cvt --cells 162 --start icosahedron --bisections 2 --method lbfgs --iterations 1500";
const std::string long_bump =
    "cvt --cells 162 --method lloyd --start density --iterations 3000 --density " + bump_density(3);
const std::string kept = " --checkpoint run.checkpoint --checkpoint-every 1";

/// Interrupts a run before its end.
Outcome interrupt(const Bench& bench, const std::string& arguments, int signal) {
  const pid_t process = bench.start(arguments + kept + " -o mesh.vtp --report report.json");
  wait_until([&] { return fs::exists(bench.folder() / "run.checkpoint"); });
  REQUIRE(::kill(process, signal) == 0);
  return bench.finish(process);
}

/// Every state has the whole course: a resumed run that saved it after each iteration, too, would
/// write its square.
const std::string kept_rarely = " --checkpoint-every 1000 ";

/// Resumes a run and compares the result with that of an uninterrupted one.
void check_resumed(const Bench& bench, const std::string& arguments, const std::string& other) {
  REQUIRE(bench.run(arguments + " -o whole.vtp --report whole.json").code == 0);
  const Outcome resumed = bench.run(arguments +
                                    " --resume run.checkpoint -o mesh.vtp "
                                    "--report report.json " +
                                    kept_rarely + other);
  CHECK(resumed.code == 0);
  CHECK(resumed.err.empty());
  CHECK(has(resumed.out, ", resumed after "));
  CHECK((bench.file("mesh.vtp") == bench.file("whole.vtp")));
  CHECK((course(bench.file("report.json")) == course(bench.file("whole.json"))));
}

} // namespace

TEST_CASE("every start leads to the requested number of cells") {
  const Bench bench;
  const auto check_start = [&](const std::string& arguments, int cells, const std::string& note) {
    CAPTURE(arguments);
    const Outcome made =
        bench.run("cvt " + arguments + " -o mesh.vtp --iterations 5 --report report.json");
    CHECK(made.code == 0);
    CHECK(made.err == note);
    CHECK(one_line(made.out));
    CHECK(made.out.starts_with("mesh.vtp: " + std::to_string(cells) + " cells, "));
    CHECK(calotte::read_mesh(bench.folder() / "mesh.vtp").points.cols() == cells);
    CHECK(bench.run("check mesh.vtp").code == 0);
    CHECK(has(bench.file("report.json"), "\n \"cells\": " + std::to_string(cells) + ",\n"));
  };
  check_start("--cells 12", 12, "");
  check_start("--cells 162", 162, "");
  check_start("--cells 162 --density " + bump_density(3), 162, "");
  check_start("--cells 150 --start continuation", 150, "");
  check_start("--cells 150 --start geodesic", 150, "");
  check_start("--cells 594 --start geodesic --bisections 1", 594, "");
  check_start("--cells 100 --seed 4 --density " + bump_density(3), 100,
              "calotte: 100 cells is not 10 x 4^k + 2: the start is 100 points drawn from the "
              "density\n");
  check_start("--cells 100 --start random", 100, "");
  check_start("--cells 100 --start random --seed 7", 100, "");
  check_start("--cells 100 --start density --density " + bump_density(3), 100, "");
  check_start("--cells 100 --start fibonacci", 100, "");
  check_start("--cells 102 --start fibonacci --bisections 1", 102, "");
  check_start("--cells 100 --start spiral", 100, "");
  check_start("--cells 162 --start icosahedron", 162, "");
  check_start("--cells 162 --start icosahedron --bisections 2", 162, "");
  CHECK(bench.run("points random 50 -o points.txt").code == 0);
  check_start("points.txt", 50, "");
  check_start("- <points.txt", 50, "");
  check_start("points.txt --bisections 1", 194, "");
  CHECK(bench.run("cvt points.txt --iterations 1 -o mesh.off").code == 0);
  fs::copy_file(bench.folder() / "mesh.off", bench.folder() / "grid.off");
  check_start("grid.off", 50, "");
  bench.file("places.txt", "0 0\n90 0\n180 0\n270 0\n45 45\n135 45\n225 45\n315 45\n0 -45\n90 -45\n"
                           "180 -45\n270 -45\n0 90\n");
  check_start("--lonlat places.txt", 13, "");
  check_start("places.txt --lonlat --density uniform", 13, "");
}

TEST_CASE("a run continues from the mesh of another run, in any format") {
  const Bench bench;
  const std::string run = "cvt --method lloyd --duplicates refuse --iterations ";
  CHECK(bench.run("points random 60 -o points.txt").code == 0);
  CHECK(bench.run(run + "7 points.txt -o whole.vtp").code == 0);
  const calotte::Mesh whole = calotte::read_mesh(bench.folder() / "whole.vtp");
  for (const std::string grid : {"grid.vtp", "grid.vtu", "grid.off", "grid.ply"}) {
    CAPTURE(grid);
    CHECK(bench.run(run + "4 points.txt -o " + grid).code == 0);
    CHECK(bench.run(run + "3 " + grid + " -o mesh.vtp").code == 0);
    const calotte::Mesh mesh = calotte::read_mesh(bench.folder() / "mesh.vtp");
    CHECK((mesh.triangles == whole.triangles));
    CHECK((mesh.points - whole.points).cwiseAbs().maxCoeff() < 1e-13); // normalised again
    CHECK(bench.run("delaunay " + grid + " -o same.vtp").code == 0);
    CHECK(calotte::read_mesh(bench.folder() / "same.vtp").triangles.cols() == 116);
    for (const std::string command : {"cvt ", "delaunay "})
      check_refusals(bench, command + grid,
                     " --lonlat -o mesh.tri | 2 | " + grid + ": the points of a mesh are x y z");
  }
  bench.file("text.vtp", bench.file("points.txt"));
  check_refusals(bench, "cvt -o mesh.tri", R"(
text.vtp | 2 | text.vtp
absent.vtp | 3 | cannot read absent.vtp
)");
}

TEST_CASE("every method converges in its own way, and the report names it") {
  const Bench bench;
  const auto converged = [&](const std::string& method) {
    CAPTURE(method);
    const Outcome made = bench.run("cvt --cells 162 --tolerance 1e-4 -o mesh.vtp "
                                   "--report report.json " +
                                   (method.empty() ? "" : "--method " + method));
    CHECK(made.code == 0);
    CHECK(has(bench.file("report.json"),
              "\n \"method\": \"" + (method.empty() ? "auto" : method) + "\",\n"));
    return bench.file("mesh.vtp");
  };
  CHECK((converged("") == converged("auto")));
  std::set<std::string> meshes;
  for (const std::string method : {"lloyd", "lbfgs", "lbfgs-laplacian"})
    meshes.insert(converged(method));
  CHECK(meshes.size() == 3);
}

TEST_CASE("seeds are whole numbers below 2^64, in decimal") {
  const Bench bench;
  for (const std::string command :
       {"cvt --cells 20 --start random --iterations 1 -o ", "points random 20 -o "}) {
    const auto made = [&](const std::string& seed) {
      CHECK(bench.run(command + "made.txt --seed " + seed).code == 0);
      return bench.file("made.txt");
    };
    CHECK(made("010") == made("10"));
    CHECK(made("010") != made("8"));
    CHECK(made("0") != made("1"));
    CHECK(made("18446744073709551615") != made("9223372036854775807"));
    for (const std::string seed : {"-1", "18446744073709551616", "", "0x10", "1.5", "1e3", "+1"})
      check_refusals(bench, command,
                     "mesh.txt --seed '" + seed + "' | 2 | --seed: \"" + seed +
                         "\" is not an integer from 0 to 18446744073709551615");
  }
}

TEST_CASE("seeds make a difference, and the same seed makes none") {
  const Bench bench;
  const auto made = [&](const std::string& arguments) {
    CHECK(bench.run("cvt --cells 100 --iterations 3 -o mesh.off " + arguments).code == 0);
    return bench.file("mesh.off");
  };
  CHECK(made("--start random") == made("--start random --seed 1"));
  CHECK(made("--start random") != made("--start random --seed 2"));
  CHECK(made("--start density --density " + bump_density(3)) !=
        made("--start density --seed 2 --density " + bump_density(3)));
}

TEST_CASE("bad usage is refused before any work") {
  const Bench bench;
  // A named pipe without a writer: reading it would block, so the command must not read it.
  REQUIRE(::mkfifo((bench.folder() / "never").c_str(), 0600) == 0);
  check_refusals(bench, "cvt -o mesh.vtp", R"(
--sphere-radius 6371229 never | 2 | applies to NetCDF files only, not to mesh.vtp; leave it out
| 2 | no start: give a file of points, or the number of cells (--cells N)
never --cells 12 | 2 | the start is the file never; leave --cells out
never --start random | 2 | the start is the file never; leave --start out
never --seed 2 | 2 | the start is the file never; leave --seed out
--cells=2 | 2 | --cells: "2" is not an integer from 3 to 1073741824
--cells=many | 2 | --cells: "many" is not an integer
--cells 11 | 2 | the number of cells is 11; give a number from 12 to 1073741824
--cells 12 --lonlat | 2 | --lonlat applies to a file of points only; leave it out
--cells 12 --start fibonacci --seed 2 | 2 | --seed applies to the starts multilevel,
--cells 42 --bisections 1 | 2 | the start continuation chooses the bisections
--cells 100 --start multilevel --bisections 2 | 2 | chooses the bisections
--cells 100 --insertion-rounds 2 | 2 | apply to the start multilevel only
--cells 1000 --start icosahedron | 2 | makes 10 x 4^k + 2 cells, not 1000; the nearest numbers are 642 and 2562
--cells 100 --start icosahedron --bisections 3 | 2 | not 100; the nearest number is 642
--cells 42 --start icosahedron --bisections 2 | 2 | not 42; the nearest number is 162
--cells 100 --start spiral --bisections 1 | 2 | 1 bisection does not lead to 100 cells; the nearest numbers are 98 and 102
--cells 30 --start random --bisections 1 | 2 | the nearest number is 42
--cells 12 --start there | 2 | --start: there not in {multilevel,continuation,
--cells 100 --stop well-centered | 2 | --stop: well-centered not in {
--cells 100 --stop well-centred --iterations 3 | 2 | --stop excludes --iterations
never --tolerance=0 | 2 | --tolerance 0 is not a positive number; give one such as 1e-6
never --tolerance=nan | 2 | --tolerance nan is not a positive number
never --norm l3 | 2 | --norm: l3 not in {l2,linf,l2-scaled,linf-scaled}
never --max-iterations 0 | 2 | --max-iterations: "0" is not an integer >= 1
never --checkpoint-every 0 | 2 | --checkpoint-every: "0" is not an integer >= 1
never --iterations 9 --norm l2 | 2 | --norm excludes --iterations; see calotte cvt --help
never --iterations 9 --tolerance 1 | 2 | --tolerance excludes --iterations
never --iterations 9 --max-iterations 9 | 2 | --max-iterations excludes --iterations
never --method newton | 2 | --method: newton not in {auto,lloyd,lbfgs,lbfgs-laplacian}
never --checkpoint-minutes 0 | 2 | --checkpoint-minutes 0 is not a positive number; give one such as 10
never --density tanh:lon=0,lat=0,beta=1,alpha=1,gamma=0 | 2 | gamma=0": gamma "0" is not between 0 and 1; give such a number
never --threads 0 | 2 | --threads: "0" is not an integer from 1 to 4096
never never | 2 | The following argument was not expected: never
--cells auto | 2 | --cells auto requires cell widths; give --cell-width
)");
  check_refusals(bench, "cvt never", R"(
| 2 | --output is required
-o mesh.stl | 2 | mesh.stl: unknown suffix ".stl"; a mesh file ends in .nc,
)");
}

TEST_CASE(
    "outputs that cannot be written, or would replace an input, are refused before any work") {
  const Bench bench;
  REQUIRE(::mkfifo((bench.folder() / "never").c_str(), 0600) == 0);
  bench.file("points.off", "0 0 1\n");
  bench.file("start.txt", "0 0 1\n");
  bench.file("config.off", "threads = 2\n");
  check_refusals(bench, "cvt", R"(
never -o absent/mesh.vtp | 3 | cannot write absent/mesh.vtp: the folder absent does not exist
never -o mesh.vtp --report absent/file | 3 | cannot write absent/file: the folder absent does not
never -o mesh.vtp --checkpoint absent/file | 3 | cannot write absent/file: the folder absent does
never -o mesh.vtp --report ./mesh.vtp | 2 | ./mesh.vtp is both mesh and report; give the report
never -o mesh.vtp --report file --checkpoint file | 2 | file is both report and checkpoint
points.off -o points.off | 2 | points.off is both input and output; give the output another
start.txt -o mesh.vtp --checkpoint start.txt | 2 | start.txt is both input and output
never --config config.off -o config.off | 2 | config.off is both input and output
never --resume points.off -o points.off | 2 | points.off: not a checkpoint; give the file that
never --cell-width points.off -o points.off | 2 | points.off is both input and output
)");
  CHECK(bench.file("points.off") == "0 0 1\n");
}

TEST_CASE("starts that make no tessellation are refused, and nothing is written") {
  const Bench bench;
  CHECK(bench.run("points fibonacci 11 -o eleven.txt").code == 0);
  CHECK(bench.run("points fibonacci 13 -o points.txt").code == 0);
  bench.file("twice.txt", bench.file("points.txt") + "# again\n" + bench.file("points.txt"));
  check_refusals(bench, "cvt -o mesh.vtp", R"(
eleven.txt | 2 | 12
twice.txt --duplicates refuse | 2 | twice.txt line 15:
absent.txt | 3 | cannot read absent.txt
)");
  CHECK(bench.run("cvt twice.txt -o mesh.vtp --iterations 2").code == 0);
}

TEST_CASE(
    "options from a file: the command line takes precedence, and unknown options are refused") {
  const Bench bench;
  bench.file("run.toml", "# a run\ncells = 42\nstart = \"random\"\niterations = 4\n"
                         "density = [\"" +
                             bump_density(3) + "\",\n  \"" + bump_density(3) +
                             "\"]\njoin = \"sum\"\n"
                             "output = \"mesh.vtp\"\nreport = 'report.json'\n");
  const std::string outright = "cvt --start random --iterations 4 --density " + bump_density(3) +
                               " --density " + bump_density(3) + " --join sum -o mesh.off ";
  CHECK(bench.run("cvt --config run.toml").code == 0);
  CHECK(has(bench.file("report.json"),
            "\n \"density\": [\n  \"" + bump_density(3) + "\",\n  \"" + bump_density(3)));
  CHECK(bench.run("cvt --config run.toml -o mesh.off").code == 0);
  const std::string from_file = bench.file("mesh.off");
  CHECK(bench.run(outright + "--cells 42").code == 0);
  CHECK((bench.file("mesh.off") == from_file));
  CHECK(bench.run("cvt --cells 50 --config run.toml -o mesh.off").code == 0);
  CHECK(bench.run(outright + "--cells 50 --report other.json").code == 0);
  CHECK(has(bench.file("other.json"), "\n \"cells\": 50,\n"));
  CHECK((course(bench.file("report.json")) == course(bench.file("other.json"))));
  bench.file("places.txt", "0 0\n90 0\n180 0\n270 0\n45 45\n135 45\n225 45\n315 45\n0 -45\n90 -45\n"
                           "180 -45\n270 -45\n0 90\n");
  bench.file("places.toml", "points = \"places.txt\"\nlonlat = true\niterations = 1");
  CHECK(bench.run("cvt --config places.toml -o mesh.vtp").out.starts_with("mesh.vtp: 13 cells"));
  fs::create_directory(bench.folder() / "away"); // files are where the file of options is
  CHECK(bench.run("cvt --config ../places.toml -o mesh.vtp", "cd away;")
            .out.starts_with("mesh.vtp: 13 cells"));
  const auto check_file = [&](const std::string& text, int line, const std::string& message) {
    bench.file("bad.toml", text);
    check_refusals(bench, "cvt --config bad.toml",
                   " -o mesh.tri | 2 | bad.toml line " + std::to_string(line) + ": " + message);
  };
  const std::string see = " calotte cvt --help";
  check_file("cells = 12\ntolerence = 3\n", 2,
             "unknown option \"tolerence\"; did you mean tolerance? See" + see);
  check_file("config = \"bad.toml\"\n", 1, "unknown option \"config\"; see" + see);
  check_file("cells = 2\n", 1, "--cells: \"2\" is not an integer from 3 to 1073741824");
  check_file("tolerance = 'small'\n", 1, "Could not convert: --tolerance = small");
  check_file("[a]\nlonlat = 1\n", 2, "lonlat takes true or false");
  check_refusals(bench, "cvt -o mesh.tri --config", R"(
absent.toml | 3 | cannot read absent.toml: No such file or directory
. | 3 | cannot read .: it is a folder
)");
}

TEST_CASE("the examples run, from anywhere, and write to the current folder") {
  const Bench bench;
  fs::copy(CALOTTE_FIXTURES "/../../tools/examples", bench.folder() / "examples");
  std::set<std::string> runs;
  for (const auto& entry : fs::directory_iterator(bench.folder() / "examples"))
    if (entry.path().extension() == ".toml")
      runs.insert(entry.path().stem());
  CHECK(runs == std::set<std::string>{"coastal", "lake", "uniform-120km", "x8"});
  for (const std::string& run : runs) {
    CAPTURE(run);
    const bool plane = run == "lake";
    const std::string mesh = run + (plane ? ".vtp" : ".nc");
    const Outcome made =
        bench.run("cvt --config examples/" + run + ".toml --cells 162 --max-iterations 30");
    CAPTURE(made.err);
    // So few cells cannot follow the densities with good shapes.
    CHECK((made.code == 0 || has(made.err, "increase --max-iterations") ||
           has(made.err, "give more cells") || has(made.err, "more cells mend it")));
    // Widths in km that are scaled to so few cells are steep.
    CHECK(has(made.err, "warning: the cell width changes by") == (run == "coastal"));
    CHECK(made.out.starts_with(mesh + ": 162 cells, "));
    CHECK(bench.run((plane ? "check --plane " : "check ") + mesh).code == 0);
  }
  CHECK(fs::exists(bench.folder() / "x8.json"));
  // MPI-SCVT's names
  CHECK(has(bench.file("x8.nc"), "; tolerance 1e-04; max-iterations 30"));
  CHECK(has(bench.file("coastal.nc"), "cell-width of "));
}

TEST_CASE("cell widths determine the number of cells, give warnings, and belong to a checkpoint") {
  const Bench bench;
  const auto widths = [&](const std::string& one) {
    bench.file("widths.msh", "MSHID=3;ELLIPSOID-GRID\nNDIMS=2\nCOORD=1;2\n0\n3.141592653589793\n"
                             "COORD=2;3\n-1.5707963267948966\n0\n1.5707963267948966\n"
                             "VALUE=6;1\n1500\n1500\n1500\n1500\n" +
                                 one + "\n1500\n");
  };
  widths("1500");
  const std::string run = "cvt --cell-width widths.msh --cells auto --iterations 2 -o mesh.vtp ";
  const Outcome outcome = bench.run(run + kept);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.starts_with("mesh.vtp: 262 cells, ")); // 4 pi R^2 / (sqrt(3)/2 h^2) = 261.8
  CHECK(outcome.err.starts_with(
      "calotte: widths.msh: cells 1500 to 1500 km wide, at 6 nodes, require 262 cells; "));
  CHECK(!has(outcome.err, "warning"));
  CHECK(bench.run(run + "--resume run.checkpoint").code == 0);
  widths("1500.5");
  check_refusals(bench, run, "--resume run.checkpoint | 2 | cell-width of");
  widths("2500");
  // Half a cell from the tip along both axes: 1000 km over 10 007 km times 15/16, and over 20 015
  // km times 7/8 over the cosine of 11.25 degrees.
  CHECK(has(bench.run(run).err, "calotte: warning: the cell width changes by 0.1 km per km at "));
  check_refusals(bench, "cvt --cells auto --cell-width widths.msh",
                 "--start icosahedron -o other.vtp | 2 | makes 10 x 4^k + 2 cells, not 186");
}

TEST_CASE("a mesh file contains its provenance, and equal runs give equal bytes") {
  const Bench bench;
  const std::string run = "cvt --cells 42 --seed 3 --iterations 4 --density " + bump_density(3);
  const auto history = [&](const std::string& name) {
    const std::string bytes = bench.file(name);
    const std::size_t from = bytes.find("start continuation; "), to = bytes.find("merge-within 0");
    REQUIRE(from < to);
    REQUIRE(to != std::string::npos);
    return bytes.substr(from, to - from);
  };
  CHECK(bench.run(run + " -o first.nc").code == 0);
  CHECK(bench.run(run + " -o second.nc --threads 1 --regions 3").code == 0);
  CHECK((bench.file("first.nc") == bench.file("second.nc")));
  CHECK(has(bench.file("first.nc"), "calotte 1.0."));
  CHECK(history("first.nc") == "start continuation; cells 42; seed 3; density " + bump_density(3) +
                                   "; method auto; duplicates merge; ");
  CHECK(has(bench.file("first.nc"), "merge-within 0; iterations 4"));
  CHECK(bench.run(run + " --method lloyd -o other.nc").code == 0);
  CHECK(history("other.nc") != history("first.nc"));
}

TEST_CASE("formats are no part of a checkpoint's configuration") {
  const Bench bench;
  const std::string run = "cvt --cells 162 --method lloyd --iterations 4";
  CHECK(bench.run(run + " -o mesh.vtp" + kept).code == 0);
  const std::string earth = " --format mpas-minimal --sphere-radius 6371229 --order input";
  CHECK(bench.run(run + " --resume run.checkpoint -o resumed.nc" + earth).code == 0);
  CHECK(bench.run(run + " -o whole.nc" + earth).code == 0);
  CHECK((bench.file("resumed.nc") == bench.file("whole.nc")));
}

TEST_CASE("not converging is exit code 1 with the residual; the mesh and the report are there") {
  const Bench bench;
  const Outcome outcome = bench.run("cvt --cells 100 --start random --method lloyd "
                                    "--max-iterations 3 "
                                    "--tolerance 1e-5 -o mesh.vtp --report report.json");
  CHECK(outcome.code == 1);
  CHECK(one_line(outcome.err));
  CHECK(outcome.err.starts_with("calotte: not converged: l2-scaled 0."));
  CHECK(outcome.err.ends_with(" is above the tolerance 1e-05 after 3 iterations; the mesh is "
                              "written; increase --max-iterations\n"));
  CHECK(outcome.out == "mesh.vtp: 100 cells, not converged\n");
  CHECK(bench.run("check mesh.vtp").code == 0);
  CHECK(has(bench.file("report.json"), "\"converged\": false"));
  CHECK(bench.run("cvt --cells 12 -o mesh.vtp").out ==
        "mesh.vtp: 12 cells, all shapes within the limits of models\n");
}

TEST_CASE("the selected norm ends the run") {
  const Bench bench;
  const auto iterations = [&](const std::string& options) {
    const Outcome made = bench.run(
        "cvt --cells 100 --start fibonacci --method lloyd -o mesh.vtp --report a.json " + options);
    CHECK(made.code == 0);
    return nlohmann::json::parse(bench.file("a.json"))["iterations"].size();
  };
  std::set<std::size_t> counts;
  for (const std::string norm : {"l2", "linf", "l2-scaled", "linf-scaled"})
    counts.insert(iterations("--tolerance 2e-3 --norm " + norm));
  CHECK(counts.size() == 4);
  CHECK(iterations("--tolerance 2e-3") == iterations("--tolerance 2e-3 --norm l2-scaled"));
}

TEST_CASE("the report has the documented content") {
  const Bench bench;
  CHECK(bench
            .run("cvt --cells 162 --start icosahedron --bisections 2 --method lloyd --iterations 2 "
                 "--threads 2 --regions 3 -o mesh.vtp --report report.json")
            .code == 0);
  const std::string report = bench.file("report.json");
  std::istringstream keys("calotte density method norm tolerance converged residual cells threads "
                          "seconds iterations regions rule l2 linf gradient energy accepted flips "
                          "rebuilt seconds_exchange "
                          "seconds_repair seconds_moments seconds_solver sites");
  for (std::string key; keys >> key;) {
    CAPTURE(key);
    CHECK(has(report, "\"" + key + "\": "));
  }
  CHECK(has(report, "\"norm\": \"none\""));
  CHECK(has(report, "\"threads\": 2,"));
  CHECK(has(report, "\"density\": [\n  \"uniform\"\n ]"));
  // Cells; of three actions the planned ones and those at the end; two iterations of each.
  CHECK(course(report).size() == 1 + 3 * 2 + 6 * 6);
}

TEST_CASE("the mesh file is the same bytes for any threads, regions, centres and sort") {
  const Bench bench;
  const std::string run =
      "cvt --cells 500 --start random --iterations 20 --density " + bump_density(3);
  CHECK(bench.run(run + " -o first.vtp").code == 0);
  for (const std::string options :
       {"--threads 1", "--threads 3 --regions 7", "--regions 1", "--sort distance --regions 6",
        "--sort voronoi --regions 6", "--centres fibonacci"}) {
    CAPTURE(options);
    CHECK(bench.run(run + " -o mesh.vtp " + options).code == 0);
    CHECK((bench.file("mesh.vtp") == bench.file("first.vtp")));
  }
}

TEST_CASE("SIGTERM and SIGINT end a run in order, and it resumes to the same bits") {
  for (const auto& [arguments, signal, name, code] :
       {std::tuple(long_run, SIGTERM, "SIGTERM", 143), {long_levels, SIGINT, "SIGINT", 130}}) {
    const Bench bench;
    CAPTURE(name);
    const Outcome outcome = interrupt(bench, arguments, signal);
    CHECK(outcome.code == code);
    CHECK(outcome.out.empty());
    const std::vector<std::string> lines = lines_of(outcome.err);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].starts_with("calotte: the run stops after the "));
    CHECK(has(lines[0], " kB to mesh.vtp and its state to run.checkpoint; Ctrl-C again, "));
    CHECK(lines[1].starts_with("calotte: stopped by " + std::string(name) + " after iteration "));
    CHECK(lines[1].ends_with("; the mesh is written as it is; to continue: calotte cvt --resume "
                             "run.checkpoint"));
    CHECK(bench.names() == std::set<std::string>{"mesh.vtp", "report.json", "run.checkpoint"});
    CHECK(bench.run("check mesh.vtp").code == 0);
    CHECK(has(bench.file("report.json"), "\"converged\": false"));
    check_resumed(bench, arguments, "--threads 1 --regions 5");
  }
}

TEST_CASE("a run that is stopped again goes on with the checkpoint that it came from") {
  const Bench bench;
  for (const auto& [run, mesh] :
       {std::pair<std::string, std::string>{
            "--cells 2562 --start random --method lloyd --iterations 1000000 --keep-every 3",
            "mesh"},
        {"--resume mesh.vtp.checkpoint", "other"}}) {
    const pid_t process = bench.start("cvt " + run + " -o " + mesh + ".vtp");
    wait_until([&, mesh = mesh] {
      return std::ranges::any_of(bench.names(), [&](const std::string& name) {
        return name.starts_with(mesh + ".00") && name.ends_with(".vtp");
      });
    });
    REQUIRE(::kill(process, SIGINT) == 0);
    const Outcome outcome = bench.finish(process);
    CHECK(outcome.code == 130);
    CHECK(outcome.err.ends_with("to continue: calotte cvt --resume mesh.vtp.checkpoint\n"));
  }
  CHECK(!fs::exists(bench.folder() / "other.vtp.checkpoint"));
}

TEST_CASE("a checkpoint knows its command: --resume alone continues to the same bits") {
  const Bench bench;
  const std::string bumps =
      "cvt --cells 162 --method lloyd --start density --density " + bump_density(3);
  const std::string rest = " --density tanh:lon=10,lat=0,beta=0.3,alpha=0.2,gamma=x2 --join sum "
                           "--iterations 8000 --duplicates refuse -o mesh.vtp";
  CHECK(bench.run(bumps + rest).code == 0);
  const std::string whole = bench.file("mesh.vtp");
  fs::remove(bench.folder() / "mesh.vtp");
  const pid_t process =
      bench.start(bumps + rest + " --checkpoint run.checkpoint --checkpoint-every 200");
  wait_until([&] { return fs::exists(bench.folder() / "run.checkpoint"); });
  REQUIRE(::kill(process, SIGINT) == 0);
  CHECK(bench.finish(process).code == 130);
  CHECK((bench.file("mesh.vtp") != whole));
  const Outcome resumed = bench.run("cvt --resume run.checkpoint");
  CHECK(resumed.err == "");
  CHECK(resumed.code == 0);
  CHECK((bench.file("mesh.vtp") == whole));
  CHECK(bench.run("cvt --resume run.checkpoint -o other.vtp").code == 0); // takes precedence
  CHECK((bench.file("other.vtp") == whole));
}

// Slow: a run of 10 000 cells is interrupted and resumed in each phase.
TEST_CASE("a graded run resumes to the same bits after a signal in any of its phases [slow]") {
  const Bench bench;
  const std::string run = "cvt --cells 10000 --density "
                          "tanh:lon=270,lat=30,beta=30deg,alpha=0.30,gamma=x3 -o mesh.vtp";
  CHECK(bench.run(run).code == 0);
  const std::string whole = bench.file("mesh.vtp");
  int interrupted = 0;
  for (int milliseconds = 20; milliseconds < 2000; milliseconds += milliseconds) {
    CAPTURE(milliseconds);
    const pid_t process = start_iterating(bench, run);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    ::kill(process, SIGINT);
    const int code = bench.finish(process).code;
    if (code == 0) // it had ended
      continue;
    CHECK(code == 130);
    ++interrupted;
    CHECK(bench.run("check mesh.vtp").code == 0);
    CHECK(bench.run("cvt --resume mesh.vtp.checkpoint").code == 0);
    CHECK((bench.file("mesh.vtp") == whole));
  }
  CHECK(interrupted >= 2);
}

TEST_CASE("a resumed run may stop by another rule, with the bits of a run that has it") {
  const Bench bench;
  const std::string run = "cvt --cells 162 --start random --seed 5 ";
  CHECK(bench.run(run + "--iterations 2500 -o whole.vtp").code == 0);
  CHECK(interrupt(bench, long_run, SIGTERM).code == 143); // of 3000
  const Outcome resumed = bench.run("cvt --resume run.checkpoint --iterations 2500" + kept_rarely);
  CHECK(resumed.err == "");
  CHECK(resumed.code == 0);
  CHECK((bench.file("mesh.vtp") == bench.file("whole.vtp")));
  // A state that has converged goes on to a smaller tolerance.
  CHECK(bench.run(run + "--tolerance 1e-3 -o mesh.vtp" + kept).code == 0);
  CHECK(bench.run("cvt --resume run.checkpoint --max-iterations 1 -o few.vtp").code == 0);
  const Outcome onward = bench.run("cvt --resume run.checkpoint --tolerance 1e-5 -o onward.vtp");
  CHECK(onward.code == 0);
  CHECK(has(onward.out, ", all shapes within the limits of models, resumed after "));
  CHECK((bench.file("onward.vtp") != bench.file("mesh.vtp")));
}

TEST_CASE("a batch job has a log: a line for each level") {
  const Bench bench;
  const std::string run = "cvt --cells 2562 --tolerance 1e-3 --density "
                          "tanh:lon=270,lat=30,beta=30deg,alpha=0.30,gamma=x3 -o mesh.vtp";
  CHECK(bench.run(run).err.empty()); // short runs have none
  const Outcome outcome = bench.run(run, "export CALOTTE_LOG_AFTER=0;");
  CHECK(outcome.code == 0);
  const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
  CHECK(lines >= 2);
  CHECK(lines <= 4);
  for (const char* part :
       {"calotte: ", " cells, iteration ", "l2-scaled ", "energy x cells ", " finer level", " s)"})
    CHECK(has(outcome.err, part));
}

TEST_CASE("a run without a checkpoint keeps its state when a signal ends it") {
  const Bench bench;
  const pid_t process = start_iterating(bench, long_run + "000 -o mesh.vtp");
  REQUIRE(::kill(process, SIGTERM) == 0);
  const Outcome outcome = bench.finish(process);
  CHECK(outcome.code == 143);
  CHECK(lines_of(outcome.err).size() == 3);
  CHECK(has(outcome.err, "; to continue: calotte cvt --resume mesh.vtp.checkpoint\n"));
  CHECK(bench.names() == std::set<std::string>{"mesh.vtp", "mesh.vtp.checkpoint"});
}

TEST_CASE("signals within a second count as one") {
  const Bench bench;
  const pid_t process = start_iterating(bench, long_run + "000 -o mesh.vtp");
  REQUIRE(::kill(process, SIGTERM) == 0);
  for (int again = 0; again < 300; ++again) { // until after its end
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(process, SIGTERM);
  }
  const Outcome outcome = bench.finish(process);
  CHECK(outcome.code == 143);
  CHECK(lines_of(outcome.err).size() == 3); // one answer
  CHECK(bench.names() == std::set<std::string>{"mesh.vtp", "mesh.vtp.checkpoint"});
}

TEST_CASE("the answer to a signal gives the size that the file then has") {
  const Bench bench;
  const pid_t process = start_iterating(bench, "cvt --cells 2562 --iterations 1000000 -o mesh.nc");
  REQUIRE(::kill(process, SIGTERM) == 0);
  const Outcome outcome = bench.finish(process);
  CHECK(outcome.code == 143);
  std::smatch found;
  REQUIRE(std::regex_search(outcome.err, found, std::regex("then writes ([0-9.]+) MB to mesh.nc")));
  const double told = 1e6 * std::stod(found[1]),
               size = static_cast<double>(fs::file_size(bench.folder() / "mesh.nc"));
  CHECK(told == doctest::Approx(size).epsilon(0.02));
}

TEST_CASE("a signal before an output says that nothing is written, and ends the command at once") {
  const Bench bench;
  REQUIRE(::mkfifo((bench.folder() / "never").c_str(), 0600) == 0);
  for (const std::string command : {"cvt never -o mesh.vtp", "delaunay never -o mesh.vtp"})
    for (const int signal : {SIGINT, SIGTERM}) {
      CAPTURE(command);
      CAPTURE(signal);
      const pid_t process = bench.start(command);
      wait_for_handler(process, signal);
      REQUIRE(::kill(process, signal) == 0);
      const Outcome outcome = bench.finish(process);
      CHECK(outcome.code == -signal);
      CHECK(outcome.err == std::string("calotte: stopped by ") +
                               (signal == SIGINT ? "SIGINT" : "SIGTERM") +
                               "; nothing is written\n");
      CHECK(bench.names() == std::set<std::string>{"never"});
    }
}

TEST_CASE("a signal while a command writes says what becomes of its files") {
  const Bench bench;
  const std::string pipe = bench.path("points.txt");
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  REQUIRE(reader >= 0);
  const pid_t process = bench.start("points random 100000 -o points.txt"); // more than a pipe holds
  char first = 0;
  wait_until([&] { return ::read(reader, &first, 1) == 1; });
  REQUIRE(::kill(process, SIGTERM) == 0);
  const Outcome outcome = bench.finish(process);
  ::close(reader);
  CHECK(outcome.code == -SIGTERM);
  CHECK(outcome.err == "calotte: stopped by SIGTERM; unfinished files are named *.part*, and "
                       "removed when they are written again\n");
}

TEST_CASE("a command that was started to ignore SIGINT ignores it") {
  const Bench bench;
  REQUIRE(::mkfifo((bench.folder() / "never").c_str(), 0600) == 0);
  const pid_t process = bench.start("delaunay never -o mesh.vtp", "trap '' INT;");
  wait_for_handler(process, SIGTERM);
  REQUIRE(::kill(process, SIGINT) == 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  REQUIRE(::kill(process, SIGTERM) == 0);
  const Outcome outcome = bench.finish(process);
  CHECK(outcome.code == -SIGTERM);
  CHECK(has(outcome.err, "stopped by SIGTERM"));
}

TEST_CASE("a terminal shows the stage, and the answer to a signal in a line of its own") {
  const Bench bench;
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  REQUIRE(terminal >= 0);
  REQUIRE(::grantpt(terminal) == 0);
  REQUIRE(::unlockpt(terminal) == 0);
  const winsize size{.ws_row = 24, .ws_col = 60, .ws_xpixel = 0, .ws_ypixel = 0};
  REQUIRE(::ioctl(terminal, TIOCSWINSZ, &size) == 0);
  const pid_t process = bench.start("cvt --cells 2562 --iterations 1000000 -o mesh.nc 2>" +
                                    std::string(::ptsname(terminal)));
  std::string shown;
  const auto read_more = [&] {
    std::array<char, 4096> text;
    const auto got = ::read(terminal, text.data(), text.size());
    if (got > 0)
      shown.append(text.data(), static_cast<std::size_t>(got));
    return got;
  };
  wait_until([&] { return read_more(), has(shown, "iteration "); });
  REQUIRE(::kill(process, SIGTERM) == 0);
  wait_until([&] { return read_more(), has(shown, "stopped by SIGTERM after "); });
  CHECK(bench.finish(process).code == 143);
  ::close(terminal);
  CHECK(has(shown, "\r\033[Kcalotte: the run stops after the "));
  CHECK(has(shown, "... (")); // a line of progress is no wider than the terminal
  std::replace(shown.begin(), shown.end(), '\r', '\n');
  for (const std::string& line : lines_of(shown))
    if (line.ends_with(" s)\033[K"))
      CHECK(line.size() < 60 + std::string("\033[K").size());
}

TEST_CASE("a signal a second after another one ends the process at once") {
  const Bench bench;
  // One iteration of this run, whose density is a maximum of many bumps, takes longer than the
  // waits between the signals.
  std::string bumps;
  for (int k = 0; k < 3000; ++k)
    bumps += (k == 0 ? "\"" : ", \"") + bump_density(3) + "\"";
  bench.file("bumps.toml", "density = [" + bumps + "]\n");
  const pid_t process = start_iterating(
      bench, "cvt --cells 40000 --start random --threads 1 --config bumps.toml -o mesh.vtp "
             "--checkpoint run.checkpoint");
  REQUIRE(::kill(process, SIGTERM) == 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(1300));
  REQUIRE(::kill(process, SIGINT) == 0);
  CHECK(bench.finish(process).code == -SIGINT);
  CHECK(bench.names() == std::set<std::string>{"bumps.toml"});
}

TEST_CASE("kill -9 at any moment: the run resumes from its checkpoint to the same bits") {
  const Bench bench;
  const fs::path checkpoint = bench.folder() / "run.checkpoint";
  CHECK(interrupt(bench, long_bump, SIGKILL).code == -SIGKILL);
  for (const int milliseconds : {1, 5, 11}) { // resumes repeatedly from the same file
    const auto size = fs::file_size(checkpoint);
    const pid_t process =
        bench.start(long_bump + kept + " --resume run.checkpoint --regions 4 -o mesh.vtp");
    wait_until([&] { return fs::file_size(checkpoint) > size; }); // each iteration adds to it
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    const auto before = fs::file_size(checkpoint);
    REQUIRE(::kill(process, SIGKILL) == 0);
    CHECK(bench.finish(process).code == -SIGKILL);
    CHECK(fs::file_size(checkpoint) >= before);
    CHECK(!fs::exists(bench.folder() / "mesh.vtp"));
  }
  check_resumed(bench, long_bump, "--threads 2 --sort voronoi");
}

TEST_CASE("checkpoints come every so many iterations or minutes, over all levels") {
  const Bench bench;
  const auto before = [&](const std::string& options) {
    const std::string run =
        "cvt --cells 42 --method lloyd --iterations 17 "; // 34 on the two levels
    fs::remove(bench.folder() / "run.checkpoint");
    CHECK(bench.run(run + "-o mesh.vtp --checkpoint run.checkpoint " + options).code == 0);
    if (!fs::exists(bench.folder() / "run.checkpoint"))
      return std::string("none");
    const std::string out = bench.run(run + "-o again.vtp --resume run.checkpoint").out;
    CHECK((bench.file("again.vtp") == bench.file("mesh.vtp")));
    const std::size_t place = out.find("resumed after ");
    return out.substr(place, out.find('\n') - place);
  };
  CHECK(before("") == "none");
  CHECK(before("--checkpoint-every 20") == "resumed after 20 iterations");
  CHECK(before("--checkpoint-every 9") == "resumed after 27 iterations");
  CHECK(before("--checkpoint-every 17") == "resumed after 34 iterations");
  CHECK(before("--checkpoint-minutes 1e-9") == "resumed after 34 iterations");
}

TEST_CASE("a checkpoint that cannot be written is reported, and the run continues") {
  const Bench bench;
  // The shell's limit on the size of files stands for a full disk: 1 block of 512 or 1024 bytes.
  const Outcome outcome = bench.run("cvt --cells 12 --method lloyd --iterations 50 -o mesh.tri "
                                    "--checkpoint run.checkpoint --checkpoint-every 20",
                                    "ulimit -f 1;");
  CHECK(outcome.code == 0);
  const std::string warning = "calotte: cannot write run.checkpoint: File too large; make room or "
                              "write elsewhere (the run continues)\n";
  CHECK(outcome.err == warning + warning);
  CHECK(bench.names() == std::set<std::string>{"mesh.tri"});
}

TEST_CASE("a checkpoint of another configuration is refused with the option that differs") {
  const Bench bench;
  CHECK(bench.run("points random 60 -o points.txt").code == 0);
  CHECK(bench.run("points random 60 --seed 2 -o others.txt").code == 0);
  const auto check_other = [&](const std::string& run, const std::string& other,
                               const std::string& theirs, const std::string& ours) {
    CAPTURE(other);
    fs::remove(bench.folder() / "run.checkpoint");
    bench.run("cvt " + run + kept + " -o mesh.vtp");
    const Outcome outcome = bench.run("cvt " + other + " --resume run.checkpoint -o other.vtp");
    CHECK(outcome.code == 2);
    CHECK(one_line(outcome.err));
    CHECK(has(outcome.err, "run.checkpoint: a checkpoint of another configuration: it has \"" +
                               theirs + "\" where this run has \"" + ours + "\""));
    CHECK(!fs::exists(bench.folder() / "other.vtp"));
  };
  const std::string base = "--cells 42 --start random --max-iterations 2 ";
  check_other(base, "--cells 50 --start random --max-iterations 2", "cells 42", "cells 50");
  check_other(base, "--start continuation", "start random", "start continuation");
  check_other(base, base + "--seed 2", "seed 1", "seed 2");
  check_other(base, base + "--density " + bump_density(3), "density uniform",
              "density " + bump_density(3));
  check_other(base, base + "--method lloyd", "method auto", "method lloyd");
  check_other(base, base + "--duplicates refuse", "duplicates merge", "duplicates refuse");
  check_other(base, base + "--merge-within 1e-4", "merge-within 0", "merge-within 1e-04");
  check_other("--cells 42 --start icosahedron --iterations 2",
              "--cells 42 --start icosahedron --bisections 1 --iterations 2", "bisections 0",
              "bisections 1");
  bench.run("cvt points.txt --iterations 2" + kept + " -o mesh.vtp");
  fs::copy_file(bench.folder() / "points.txt", bench.folder() / "same.txt");
  CHECK(bench.run("cvt same.txt --iterations 2 --resume run.checkpoint -o mesh.vtp").code == 0);
  check_refusals(bench, "cvt others.txt --iterations 2 --resume run.checkpoint", R"(
-o mesh.tri | 2 | it has "points 60 with checksum
)");
}

TEST_CASE("a checkpoint that is cut short, damaged, something else or missing is refused") {
  const Bench bench;
  const std::string run = "cvt --cells 42 --iterations 2 ";
  CHECK(bench.run(run + kept + " -o mesh.vtp").code == 0);
  const std::string whole = bench.file("run.checkpoint");
  const auto refused = [&](int code, const std::string& text) {
    check_refusals(bench, run,
                   "--resume run.checkpoint -o other.vtp | " + std::to_string(code) + " | " + text);
  };
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{5}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    bench.file("run.checkpoint", whole.substr(0, size));
    refused(2, "run.checkpoint: the checkpoint is cut short");
  }
  std::string damaged = whole;
  damaged[whole.size() / 3] ^= 1;
  bench.file("run.checkpoint", damaged);
  refused(2, "damaged; use another or start anew");
  fs::copy_file(bench.folder() / "mesh.vtp", bench.folder() / "run.checkpoint",
                fs::copy_options::overwrite_existing);
  refused(2, "run.checkpoint: not a checkpoint");
  fs::remove(bench.folder() / "run.checkpoint");
  refused(3, "cannot read run.checkpoint: No such file or directory");
}

// ---- In the plane

TEST_CASE("a lake with an island: the mesh, its report, its quality, its picture, and resuming") {
  const Bench bench;
  bench.file("lake.txt",
             "0 0\n8 0\n9 4\n5 3\n0 5\n>\n2 1\n4 1\n3 2\n"); // its boundary is not convex
  const std::string run = "cvt --domain lake.txt --cells 300 --density "
                          "tanh:x=7,y=1,beta=1,alpha=1,gamma=x2 --tolerance 1e-3";
  const Outcome done = bench.run(run + " -o lake.vtp --report lake.json");
  CHECK(done.code == 0);
  CHECK(done.out == "lake.vtp: 300 cells, all shapes within the limits of models\n");
  CHECK(has(bench.file("lake.json"), quoted("spacing")));
  CHECK(bench.run("check lake.vtp").code == 0);
  const Outcome info = bench.run("info lake.vtp --domain lake.txt --report info.json");
  CHECK(info.code == 0);
  CHECK(has(bench.file("info.json"), quoted("domain_area") + "31"));
  CHECK(bench.run("draw lake.vtp --domain lake.txt --what cells -o lake.png").code == 0);
  CHECK(bench.run("draw --history lake.json -o history.png").code == 0);

  CHECK(bench.run(run + " -o lake.nc").code == 0);
  CHECK(bench.run("check lake.nc").code == 0);
  CHECK(bench.run("info lake.nc --domain lake.txt").code == 0);
  CHECK(bench.run("convert lake.vtp lake.grid.nc --domain lake.txt --format ugrid").code == 0);
  CHECK(bench.run("convert lake.nc cells.vtp --format vtp-cells").code == 0);
  bench.file("islet.txt", "0 0\n8 0\n8 8\n0 8\n\n1 1\n1.1 1\n1 1.1\n");
  const Outcome coarse = bench.run("cvt --domain islet.txt --cells 4 -o coarse.nc");
  CHECK(coarse.code == 2);
  CHECK(has(coarse.err, "encloses an island"));
  CHECK(has(coarse.err, "coarse.nc.vtp has the triangles"));
  CHECK(bench.run("check coarse.nc.vtp").code == 0);

  const Outcome stopped = bench.run(run + " --max-iterations 5 --checkpoint c --checkpoint-every 2 "
                                          "-o other.vtp");
  CHECK(stopped.code == 1); // not converged
  CHECK(bench.run("cvt --domain lake.txt --cells 301 --resume c -o other.vtp").code == 2);
  const Outcome whole = bench.run(run + " --checkpoint d --checkpoint-every 5 -o again.vtp");
  CHECK(whole.code == 0);
  CHECK(bench.run(run + " --resume d --threads 1 --regions 7 -o resumed.vtp").code == 0);
  CHECK(bench.file("resumed.vtp") == bench.file("lake.vtp"));
  CHECK(bench.run("cvt lake.vtp --domain lake.txt --iterations 2 -o more.off").code == 0);
}

TEST_CASE("a periodic box: MPAS's file, bisections, hexagons at rest") {
  const Bench bench;
  const Outcome hexagons = bench.run("cvt --periodic 24,20.784609690826528 --start hexagonal "
                                     "--cells 576 -o hexagons.nc --report hexagons.json");
  CHECK(hexagons.code == 0);
  const auto report = nlohmann::json::parse(bench.file("hexagons.json"));
  REQUIRE(report["iterations"].size() == 1);
  const auto area = report["area"].get<double>();
  CHECK(report["iterations"][0]["energy"].get<double>() * 576 / (area * area) ==
        doctest::Approx(0.1603751));
  CHECK(
      bench.run("cvt --periodic 2,1 --cells 3200 --bisections 2 --tolerance 1e-2 -o box.nc").code ==
      0);
  CHECK(bench.run("check box.nc").code == 0);
  CHECK(bench.run("info box.nc").code == 0);
}

TEST_CASE("hexagons with and without walls are written without a run, and read without a domain") {
  const Bench bench;
  const Outcome box = bench.run("cvt --hexagons 6,8,10 -o box.nc");
  CHECK(box.code == 0);
  CHECK(box.out == "box.nc: 48 hexagons, periodic in x, 60; periodic in y, 69.28203230275508\n");
  const Outcome channel = bench.run("cvt --hexagons 6,8,10 --walls y -o channel.nc");
  CHECK(channel.code == 0);
  CHECK(channel.out == "channel.nc: 48 hexagons, periodic in x, 60; with walls in y\n");
  CHECK(fs::exists(bench.folder() / "channel.graph.info"));
  for (const char* name : {"box.nc", "channel.nc"})
    CHECK(bench.run(std::string("check --plane ") + name).code == 0);
  const Outcome info = bench.run("info box.nc");
  CHECK(info.code == 0);
  CHECK(has(info.out, "cells                 48\n"));
  CHECK(has(info.out, "86.6025")); // the area of each cell, sqrt(3)/2 100
}

TEST_CASE("a channel: cells between walls, as many as asked for but for a few") {
  const Bench bench;
  const Outcome made = bench.run("cvt --periodic 3,1 --walls y --cells 600 --tolerance 1e-2 "
                                 "--density tanh:x=1,y=0.5,beta=0.3,alpha=0.5,gamma=x2 -o c.nc");
  CAPTURE(made.err);
  CHECK(made.code == 0);
  CHECK_FALSE(has(made.err, "instead of"));
  CHECK(bench.run("check c.nc").code == 0);
  const calotte::MeshFile file = calotte::read_mesh_file(bench.folder() / "c.nc");
  REQUIRE(file.plane());
  CHECK(file.mesh->surface.period() == Eigen::Vector2d(3, 0));
  CHECK(file.mesh->points.row(1).minCoeff() >= 0);
  CHECK(file.mesh->points.row(1).maxCoeff() <= 1);
  CHECK(std::abs(static_cast<double>(file.mesh->points.cols()) - 600) < 0.05 * 600);
  REQUIRE(file.polygons);
  CHECK(calotte::areas(*file.polygons).sum() == doctest::Approx(3).epsilon(0.05));
  // x2: the square of the width at the bump over that far from it is near 1/4.
  REQUIRE(file.density.size() == file.mesh->points.cols());
  CHECK(file.density.maxCoeff() / file.density.minCoeff() > 4);
}

TEST_CASE("in the plane a width has the unit of the domain, and gives the number of cells") {
  const Bench bench;
  const Outcome made =
      bench.run("cvt --rectangle 0,0,4,3 --cell-width 0.2 --tolerance 1e-2 -o wide.nc");
  CHECK(made.code == 0);
  CHECK(has(made.out, "wide.nc: 346 cells, ")); // 12 / (sqrt(3)/2 0.04) = 346.4
  CHECK(made.err == "calotte: cells 0.2 wide require 346 cells\n");
  bench.file("two.txt", "1 1\n3 2\n");
  const Outcome beside = bench.run(
      "cvt --rectangle 0,0,4,3 --cell-width 0.2 --fixed two.txt --tolerance 1e-2 -o beside.nc");
  CHECK(has(beside.err, "2 fixed points leave room for 344 free ones: 346 cells")); // one cell each
  const Outcome info = bench.run("info wide.nc"); // the domain is what the cells fill
  CHECK(info.code == 0);
  CHECK(info.err.empty());
  CHECK(has(info.out, "cells                 346\n"));
  const Outcome named = bench.run("info wide.nc --rectangle 0,0,4,3");
  const auto from_energy = [](const std::string& text) { return text.substr(text.find("energy")); };
  CHECK(from_energy(info.out).substr(0, 20) == from_energy(named.out).substr(0, 20));
}

TEST_CASE("a lattice that misses the number of cells of a box says why") {
  const Bench bench;
  const Outcome made =
      bench.run("cvt --periodic 100,86.6 --cells 4000 --start hexagonal --iterations 1 -o box.nc");
  CHECK(made.code == 0);
  CHECK(made.err == "calotte: 4032 cells instead of 4000: the hexagonal lattice has whole rows and "
                    "columns; --start density gives exactly as many\n");
}

TEST_CASE("a graded box starts from as many cells as half of it needs") {
  const Bench bench;
  const Outcome made = bench.run("cvt --periodic 400,100 --cells 800 --tolerance 1e-2 --stop "
                                 "tolerance --density tanh:x=50,y=50,beta=10,alpha=20,gamma=x4 "
                                 "-o x4.nc");
  CAPTURE(made.err);
  CHECK(made.code == 0);
  CHECK(has(made.out, "x4.nc: 800 cells, "));
}

TEST_CASE("options that a planar run does not support are refused before any work, in one line") {
  const Bench bench;
  bench.file("points.txt", "0.5 0.5\n0.1 0.2\n3 3\n0.9 0.1\n");
  check_refusals(bench, "cvt --rectangle 0,0,1,1", R"(
points.txt -o m.vtp | 2 | line 3: point 2 is outside of the domain
--cells 100 -o m.nc --format scrip | 2 | vtp-cells
--cells 100 --start fibonacci -o m.vtp | 2 | applies to the sphere only
--cells 100 --density tanh:lon=0,lat=0,beta=1,alpha=1,gamma=x8 -o m.vtp | 2 | unknown key "lon"; the keys are x, y
--cell-width 0.1km -o m.vtp | 2 | --cell-width: the plane has the unit of its coordinates; give a number
--cell-width w.geojson -o m.vtp | 2 | give NetCDF cellWidth(y, x) (.nc)
--cell-width 1e-9 -o m.vtp | 2 | the widths require 1.1547e+18 cells
--cell-width 100 -o m.vtp | 2 | but a grid has 3 to 1073741824; give narrower ones
--cells 100 --walls y -o m.nc | 2 | --walls applies to a periodic box
)");
  check_refusals(bench, "cvt", R"(
--periodic 1,1 --cells 100 -o m.vtp | 2 | .nc
--periodic 1,1 --cells 102 --bisections 1 -o m.nc | 2 | 100 and 104
--cells 100 --start hexagonal -o m.vtp | 2 | applies to the plane only
--rectangle 1,0,0,1 --cells 100 -o m.vtp | 2 | not a rectangle
--periodic 1,1 --cells 100 --walls xy -o m.nc | 2 | --walls xy leaves no period
--periodic 1,1 --cells 100 --walls y -o m.txt | 2 | a plane with walls is written as MPAS
--hexagons 4,5,1 -o m.nc | 2 | an even number for the period in y
--hexagons 4.5,6,1 -o m.nc | 2 | --hexagons 4.5,6,1 is not two counts and a distance
--hexagons 4,6,1 --cells 24 -o m.nc | 2 | makes a uniform grid without a run; leave --cells out
--hexagons 4,6,1 --seed 2 -o m.nc | 2 | without a run; leave --seed out
--hexagons 4,6,1 --tolerance 1e-3 -o m.nc | 2 | without a run; leave --tolerance out
--hexagons 4,6,1 --density x4:0,0 -o m.nc | 2 | without a run; leave --density out
--hexagons 4,6,1 --fixed f -o m.nc | 2 | without a run; leave --fixed out
--hexagons 4,6,1 --walls y -o m.vtp | 2 | a plane with walls is written as MPAS
)");
}

TEST_CASE("a graded run reaches its number of cells and ends with good shapes") {
  const Bench bench;
  const std::string density = "--density tanh:lon=270,lat=30,beta=30deg,alpha=0.30,gamma=x3 ";
  const Outcome made = bench.run("cvt --cells 1111 " + density + "-o a.vtp --report a.json");
  CHECK(made.code == 0);
  CHECK(made.err.empty());
  CHECK(made.out == "a.vtp: 1111 cells, all shapes within the limits of models\n");
  const std::string report = bench.file("a.json");
  CHECK(has(report, "\"stop\": \"well-centred\""));
  CHECK(has(report, "\"tolerance\": 0.0001"));
  CHECK(has(report, "\"converged\": true"));
  const std::string last = report.substr(report.rfind("\"shape_excess\": "));
  CHECK(std::stod(last.substr(last.find(' '))) <= 0.03);
  const Outcome wide = bench.run("cvt --cells 1111 " + density + "--least-spacing 0.9 -o c.vtp");
  CHECK(wide.code == 0);
  CHECK(has(bench.run("cvt --cells 1111 --least-spacing 1.2 -o c.vtp").err, "--least-spacing"));
  CHECK(has(bench.run("cvt --cells 1111 --least-spacing 0.9 -o c.vtp").err, // uniform
            "applies to --stop well-centred only"));
  const Outcome pure =
      bench.run("cvt --cells 1111 " + density + "--stop tolerance --tolerance 1e-4 -o b.vtp");
  CHECK(pure.out == "b.vtp: 1111 cells, all shapes within the limits of models\n");
  const Outcome loose = bench.run("cvt --cells 400 --start random --tolerance 0.05 -o c.vtp");
  CHECK(has(loose.out, ", to which models object; give --stop well-centred\n"));
  const Outcome few = bench.run("cvt --cells 400 --start random --iterations 2 -o c.vtp");
  CHECK(few.code == 0);
  CHECK(std::regex_match(few.out, std::regex("c.vtp: 400 cells, \\d+ obtuse triangles and \\d+ "
                                             "Voronoi edges below 0.18 times the Delaunay edge, to "
                                             "which models object; leave --iterations out\n")));
}

// Slow: the line appears after a second.
TEST_CASE("on a terminal a line shows the level and a range of the time left [slow]") {
  const Bench bench; // script(1) gives the command a terminal
  const Outcome outcome =
      bench.run("", "exec script -qefc \"'" CALOTTE_COMMAND "' cvt --cells 20000 --start density "
                    "--density " +
                        bump_density(3) +
                        " --iterations 500 --threads 1 -o mesh.vtp\" "
                        "/dev/null </dev/null;");
  CHECK(outcome.code == 0);
  CHECK(has(outcome.out, "\rcalotte: 20000 cells, iteration "));
  CHECK(has(outcome.out, ", energy x cells "));
  CHECK(has(outcome.out, " s left ("));
  CHECK(has(outcome.out, "mesh.vtp: 20 000 cells, "));
}

TEST_CASE("what can fail at the end is tried before the run") {
  const Bench bench;
  fs::create_directory(bench.folder() / "mesh.graph.info");
  check_refusals(bench, "cvt", R"(
--cells 100000 -o mesh.nc | 3 | cannot write mesh.graph.info: it is a folder
--cells 100000 -o no/mesh.nc | 3 | the folder no does not exist
--cells 1000000000 -o big.nc | 3 | cannot write big.nc: it will have about 1.1 TB, but the disk has
)");
}

TEST_CASE("another number of cells than requested is said") {
  const Bench bench;
  bench.file("lake.txt", "0 0\n8 0\n9 4\n5 3\n0 5\n");
  const Outcome made =
      bench.run("cvt --domain lake.txt --cells 400 --bisections 1 --tolerance 1e-2 -o lake.vtp");
  CHECK(made.code == 0);
  CHECK(has(made.err, " cells instead of 400: bisections of a domain with a boundary"));
}

TEST_CASE("widths that no grid can follow end in a grid and an exit code of their own") {
  const Bench bench;
  const Outcome made = bench.run("cvt --cells 1500 --density "
                                 "tanh:lon=270,lat=30,beta=30deg,alpha=0.02,gamma=x6 -o a.vtp");
  CHECK(made.code == 5);
  CHECK(made.out == "a.vtp: 1500 cells, not well-centred\n");
  const std::regex message(
      "not well-centred: (\\d+) of 1500 cells with shapes beyond their limits, the "
      "worst, \\S+ beyond, at cell \\d+ \\(at \\S+ [EW] (\\S+) N\\); the mesh is");
  std::smatch found;
  REQUIRE(std::regex_search(made.err, found, message));
  CHECK(std::stoi(found[1]) > 0);
  CHECK(std::abs(std::stod(found[2]) - 30) < 40); // where the density is steep
  CHECK(bench.run("check a.vtp").code == 0);
}

TEST_CASE("a limited-area grid in one command, the same after a resumption") {
  const Bench bench;
  const std::string grid = "cvt --region circle=10,50,500km --cell-width 60km --limited-area -o ";
  const Outcome made = bench.run(grid + "a.nc --checkpoint a.state --checkpoint-every 30");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(has(made.out, " in the region and "));
  CHECK(has(bench.run("check a.nc").out, "Delaunay        yes, every edge"));
  CHECK(fs::exists(bench.folder() / "a.graph.info"));
  CHECK(bench.run("cvt --resume a.state -o b.nc").code == 0);
  CHECK(bench.file("a.graph.info") == bench.file("b.graph.info"));
  CHECK(bench.run("cvt --region circle=10,50,500km --cell-width 60km -o c.vtp").code == 0);
  CHECK(has(bench.run("check c.vtp").out, "Delaunay        yes, every edge"));
}

TEST_CASE("the cells of a region follow its boundary") {
  const Bench bench;
  const Outcome made = bench.run("cvt --region circle=10,50,500km --cell-width 60km --for "
                                 "mpas-ocean -o a.nc --report a.json");
  CAPTURE(made.err);
  REQUIRE(made.code == 0);
  CHECK(!has(made.err, "at the coast"));
  CHECK(has(bench.file("a.json"), "\"hidden_cells\": 0"));
  CHECK(fs::exists(bench.folder() / "a.graph.info"));
  CHECK(bench.run("check a.nc --for mpas-ocean").code == 0);
  CHECK(bench.run("info a.nc").code == 0);
  CHECK(bench.run("draw a.nc -o a.png --what cells").code == 0);
  CHECK(bench.run("interpolate a.nc 36x18 --weights b.nc").code == 0);
  // Cells at the boundary stay, so that not all widths are met.
  CHECK(bench.run("refine a.nc --region circle=10,50,100km --factor 1.5 -o c.nc").code <= 1);
  CHECK(bench.run("check c.nc --for mpas-ocean").code == 0);
}

TEST_CASE("bays that hide a coast, and spits that cut cells, are told with an exit code") {
  const Bench bench;
  std::string comb = "[20,0]";
  for (int k = 0; k < 200; ++k)
    comb += ",[" + std::to_string(20 - 0.1 * k) + (k % 2 == 0 ? ",19]" : ",21]");
  bench.file("comb.geojson",
             R"({"type":"Polygon","coordinates":[[[0,0],)" + comb + ",[0,20],[0,0]]]}");
  const Outcome made = bench.run("cvt --region comb.geojson --cell-width 200km -o a.nc");
  CAPTURE(made.err);
  CHECK(made.code == 5);
  CHECK(has(made.err, "where land or sea is narrower than a cell"));
  CHECK(has(made.err, "behind a bend of the coast"));
  CHECK(has(made.err, "make the region by calotte coast"));
  CHECK(bench.run("check a.nc").code == 0);
}

TEST_CASE("the options of a region are checked before any work") {
  const Bench bench;
  check_refusals(bench, "cvt --region circle=10,50,500km", R"(
--cells 500 --limited-area -o a.nc | 2 | a limited area requires cell widths
--cell-width 60km --limited-area -o a.vtp | 2 | a.vtp: the grid is an MPAS file
--cell-width 60km --format mpas-minimal -o a.nc | 2 | clips those along its boundary; write mpas
--cell-width 60km --boundary generators -o a.nc | 2 | a.nc: this format has cells, whose centres
--cells 500 --rectangle 0,0,1,1 -o a.vtp | 2 | --region applies to the sphere only
--cells 500 --start fibonacci -o a.vtp | 2 | applies to the whole sphere only
)");
  check_refusals(bench, "cvt", R"(
--cell-width 60km --limited-area -o a.nc | 2 | --limited-area requires a region; give --region
--region no.geojson --cells 500 -o a.vtp | 3 | no.geojson
--region circle=10,50,3km --cell-width 60km -o a.vtp | 2 | cells in the region, but a grid has 40
)");
}
