// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"
#include "support/spoilt_files.h"

#include <calotte/mesh_file.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace calotte::test;
namespace fs = std::filesystem;

namespace {

/// The neighbours of each cell as graph.info has them, by its own rules.
std::vector<std::vector<std::size_t>> graph_of(const Bench& bench, const std::string& name) {
  std::istringstream in(bench.file(name));
  std::string line;
  std::size_t cells = 0, edges = 0;
  in >> cells >> edges;
  std::getline(in, line);
  std::vector<std::vector<std::size_t>> graph(cells);
  for (std::vector<std::size_t>& list : graph) {
    REQUIRE(std::getline(in, line));
    std::istringstream words(line);
    for (std::size_t id = 0; words >> id;)
      list.push_back(id - 1);
  }
  return graph;
}

/// The parts as mpas_block_decomp_cells_for_proc reads them: a number from each of as many lines as
/// there are cells, and no line more.
std::vector<int> parts_of(const Bench& bench, const std::string& name, std::size_t cells,
                          int parts) {
  CAPTURE(name);
  const std::string text = bench.file(name);
  CHECK(std::count(text.begin(), text.end(), '\n') == static_cast<std::ptrdiff_t>(cells));
  CHECK(text.find_first_not_of("0123456789\n") == std::string::npos);
  CHECK(!has(text, "\n\n"));
  std::istringstream in(text);
  std::vector<int> part;
  for (int id = 0; in >> id;)
    part.push_back(id);
  REQUIRE(part.size() == cells);
  CHECK(std::set<int>(part.begin(), part.end()).size() == static_cast<std::size_t>(parts));
  CHECK(*std::min_element(part.begin(), part.end()) == 0);
  CHECK(*std::max_element(part.begin(), part.end()) == parts - 1);
  return part;
}

std::size_t cut_of(const std::vector<std::vector<std::size_t>>& graph,
                   const std::vector<int>& part) {
  std::size_t cut = 0;
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const std::size_t other : graph[i])
      cut += other > i && part[i] != part[other];
  return cut;
}

/// How many connected pieces the parts have in all.
std::size_t pieces_of(const std::vector<std::vector<std::size_t>>& graph,
                      const std::vector<int>& part) {
  std::vector<bool> seen(graph.size());
  std::size_t pieces = 0;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (seen[i])
      continue;
    ++pieces;
    seen[i] = true;
    for (std::vector<std::size_t> stack{i}; !stack.empty();) {
      const std::size_t from = stack.back();
      stack.pop_back();
      for (const std::size_t to : graph[from])
        if (!seen[to] && part[to] == part[from]) {
          seen[to] = true;
          stack.push_back(to);
        }
    }
  }
  return pieces;
}

/// Partitions a file that has a graph.info, which tells whether the command's graph is the same.
void check_partition(const Bench& bench, const std::string& name, int parts) {
  CAPTURE(name);
  const Outcome made = bench.run("partition " + name + ".nc " + std::to_string(parts));
  CHECK(made.code == 0);
  CHECK(made.err.empty());
  const auto graph = graph_of(bench, name + ".graph.info");
  const std::string file = name + ".graph.info.part." + std::to_string(parts);
  const std::vector<int> part = parts_of(bench, file, graph.size(), parts);
  CHECK(pieces_of(graph, part) == static_cast<std::size_t>(parts));
  CHECK(made.out.starts_with(file + ": " + std::to_string(cut_of(graph, part)) +
                             " edges cut, imbalance "));
}

void make_global(const Bench& bench) {
  REQUIRE(bench.run("points fibonacci 900 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o global.nc").code == 0);
}

} // namespace

TEST_CASE("partition: the cells of every kind of MPAS file, in its order") {
  const Bench bench;
  make_global(bench);
  REQUIRE(bench.run("cut global.nc --region circle=10,20,40deg --rings 2 -o area.nc").code == 0);
  bench.file("land.geojson", R"({"type":"Polygon","coordinates":[[[0,-60],[30,-60],[40,0],[30,60],)"
                             R"([0,60],[-10,0],[0,-60]]]})");
  REQUIRE(bench.run("cull global.nc --land land.geojson -o ocean.nc").code == 0);
  REQUIRE(bench.run("cvt --rectangle 0,0,4,3 --cells 300 -o plane.nc").code == 0);
  REQUIRE(bench.run("cvt --hexagons 12,16,10 -o box.nc").code == 0);
  REQUIRE(bench.run("cvt --hexagons 12,16,10 --walls y -o channel.nc").code == 0);
  for (const char* name : {"global", "area", "ocean", "plane", "box", "channel"})
    for (const int parts : {2, 9})
      check_partition(bench, name, parts);
}

TEST_CASE("partition: other files of cells have the parts of their own order") {
  const Bench bench;
  make_global(bench);
  const auto graph = graph_of(bench, "global.graph.info"); // in the order of the files below
  for (const auto& [file, format] :
       std::vector<std::pair<std::string, std::string>>{{"small.nc", "mpas-minimal"},
                                                        {"faces.nc", "ugrid"},
                                                        {"scrip.nc", "scrip"},
                                                        {"mesh.g", "exodus"},
                                                        {"cells.vtp", "vtp-cells"}}) {
    CAPTURE(file);
    REQUIRE(
        bench.run("convert global.nc " + file + " --format " + format + " --order input").code ==
        0);
    const Outcome made = bench.run("partition " + file + " 6 -o parts");
    CHECK(made.code == 0);
    const std::vector<int> part = parts_of(bench, "parts.part.6", 900, 6);
    CHECK(pieces_of(graph, part) == 6);
    CHECK(made.out.starts_with("parts.part.6: " + std::to_string(cut_of(graph, part)) + " edges"));
  }
}

TEST_CASE("partition: lists and ranges of numbers, names, and a report") {
  const Bench bench;
  make_global(bench);
  fs::create_directory(bench.folder() / "parts");
  bench.file("parts/8", "old");
  const Outcome made =
      bench.run("partition global.nc 8 1,2 10:16:4 8 -o parts/ --report report.json --threads 2");
  CHECK(made.code == 0);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(bench.folder() / "parts"))
    names.insert(entry.path().filename());
  CHECK((names == std::set<std::string>{"1", "2", "8", "10", "14"}));
  CHECK(bench.file("parts/1") == [] {
    std::string zeros;
    for (int i = 0; i < 900; ++i)
      zeros += "0\n";
    return zeros;
  }());
  const auto graph = graph_of(bench, "global.graph.info");
  const nlohmann::json report = nlohmann::json::parse(bench.file("report.json"));
  CHECK(report["mesh"] == "global.nc");
  CHECK(report["cells"] == 900);
  CHECK(report["edges"] == 2694);
  CHECK(report["components"] == std::vector<int>{900});
  CHECK(report["threads"] == 2);
  CHECK(report["seconds"]["partition"] > 0);
  REQUIRE(report["partitions"].size() == 5);
  for (const nlohmann::json& row : report["partitions"]) {
    const int parts = row["parts"];
    const std::vector<int> part =
        parts_of(bench, "parts/" + std::to_string(parts), graph.size(), parts);
    CHECK(row["file"] == "parts/" + std::to_string(parts));
    CHECK(row["edge_cut"] == cut_of(graph, part));
    std::vector<int> sizes(static_cast<std::size_t>(parts));
    for (const int id : part)
      ++sizes[static_cast<std::size_t>(id)];
    CHECK(row["imbalance"] ==
          doctest::Approx(*std::max_element(sizes.begin(), sizes.end()) * parts / 900.0 - 1));
    CHECK(row["balanced"] == true);
    CHECK(row["unconnected"] == 0);
  }
  std::istringstream lines(made.out);
  std::vector<std::string> starts;
  for (std::string line; std::getline(lines, line);)
    starts.push_back(line.substr(0, line.find(':')));
  CHECK((starts ==
         std::vector<std::string>{"parts/1", "parts/2", "parts/8", "parts/10", "parts/14"}));
  bench.file("run.toml", "input = \"global.nc\"\nparts = [8, \"10:14:4\"]\noutput = \"of\"\n");
  CHECK(bench.run("partition --config run.toml --threads 1").code == 0);
  CHECK(bench.file("of.part.8") == bench.file("parts/8"));
  CHECK(bench.file("of.part.14") == bench.file("parts/14"));
}

TEST_CASE("partition: weights are a field of the file") {
  const Bench bench;
  make_global(bench);
  calotte::MeshFile file = calotte::read_mesh_file(bench.folder() / "global.nc");
  calotte::MeshField work{.name = "work"};
  work.values.resize(900);
  for (int i = 0; i < 900; ++i)
    work.values[i] = file.mesh->points(2, i) > 0 ? 3 : 0.5;
  file.fields.push_back(work);
  calotte::write(bench.folder() / "work.nc", file, {.numbering = calotte::Numbering::input});
  CHECK(bench.run("partition work.nc 7 --weights work").code == 0);
  const std::vector<int> part = parts_of(bench, "work.graph.info.part.7", 900, 7);
  std::vector<double> sums(7);
  for (std::size_t i = 0; i < 900; ++i)
    sums[static_cast<std::size_t>(part[i])] += work.values[static_cast<Eigen::Index>(i)];
  CHECK(*std::max_element(sums.begin(), sums.end()) <= 1.03005 * work.values.sum() / 7 + 3);
  CHECK(bench.run("partition global.nc 7 --weights areaCell").code == 0);
  check_refusals(bench, "partition global.nc 7 --weights", R"(
absent | 2 | global.nc: no variable absent; there are latCell, lonCell, xCell, yCell, zCell,
xVertex | 2 | xVertex has 1796 values, not one for each of 900 cells
zCell | 2 | global.nc: the weight of cell
)");
  {
    const Patch patch(bench.folder() / "global.nc");
    Variable area = patch.get("areaCell");
    area.values[5] = std::nan("");
    patch.put(area);
  }
  check_refusals(bench, "partition global.nc 7 --weights",
                 "areaCell | 2 | the weight of cell 5 is nan; give finite weights");
}

TEST_CASE("partition: a mesh that is not connected is said to be so") {
  const Bench bench;
  REQUIRE(bench.run("points fibonacci 900 -o points.txt").code == 0);
  REQUIRE(bench.run("delaunay points.txt -o global.nc --sphere-radius earth").code == 0);
  bench.file("band.geojson", R"({"type":"Polygon","coordinates":[[[-180,-20],[-90,-20],[0,-20],)"
                             R"([90,-20],[180,-20],[180,20],[90,20],[0,20],[-90,20],[-180,20],)"
                             R"([-180,-20]]]})");
  REQUIRE(bench.run("cull global.nc --land band.geojson --seed 0,80 --seed 0,-80 -o two.nc").code ==
          0);
  const Outcome made = bench.run("partition two.nc 2 3");
  CHECK(made.code == 0);
  const auto graph = graph_of(bench, "two.graph.info");
  CHECK(made.out.starts_with("two.nc: the cells are not connected: 2 components, the largest of "));
  CHECK(has(made.out, "two.graph.info.part.2: 0 edges cut"));
  CHECK(made.out.ends_with(", 1 part is not connected\n"));
  CHECK(pieces_of(graph, parts_of(bench, "two.graph.info.part.3", graph.size(), 3)) == 4);
}

TEST_CASE("partition: bad input is refused with its reason, and nothing is written") {
  const Bench bench;
  make_global(bench);
  REQUIRE(bench.run("convert global.nc triangles.off").code == 0);
  fs::create_directory(bench.folder() / "folder.part.5");
  check_refusals(bench, "partition", R"(
global.nc 4 0 | 2 | "0" is no number of parts; give integers >= 1, or ranges FIRST:LAST:STEP such as 16:512:16
global.nc 4 many | 2 | "many" is no number of parts
global.nc 4 16:8 | 2 | "16:8" is no number of parts
global.nc 4 4: | 2 | "4:" is no number of parts
global.nc 4 4:8:0 | 2 | "4:8:0" is no number of parts
global.nc 4 4:8:2:1 | 2 | "4:8:2:1" is no number of parts
global.nc 4 1.5 | 2 | "1.5" is no number of parts
global.nc 4 901 | 2 | global.nc: 900 cells cannot make 901 parts; give numbers up to 900
global.nc 1:2000000000 | 2 | 900 cells cannot make 2000000000 parts
global.nc | 2 | --parts is required; see calotte partition --help
triangles.off 4 | 2 | triangles.off holds triangles or points, and no cells; give a file of cells,
points.txt 4 | 2 | points.txt holds triangles or points, and no cells
absent.nc 4 | 3 | cannot read absent.nc: No such file or directory
global.nc 4 -o absent/parts | 3 | cannot write absent/parts.part.4: the folder absent does not exist
global.nc 4 5 -o folder | 3 | cannot write folder.part.5: it is a folder; give the name of a file
global.nc 4 --report global.nc | 2 | global.nc is both input and output; give the output another name
nowhere/global.nc 4 | 3 | cannot read nowhere/global.nc: No such file or directory
global.nc 4 --report global.graph.info.part.4 | 2 | global.graph.info.part.4 is both report and 4 parts
)");
}

TEST_CASE("partition: a full disk leaves no file of parts") {
  const Bench bench;
  make_global(bench);
  check_refusals(bench, "partition",
                 "global.nc 4 | 3 | cannot write global.graph.info.part.4: File too large",
                 "ulimit -f 1;");
}
