// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/read.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

TEST_CASE("refine and coarsen keep the cells beside the part that they change") {
  const Bench bench;
  REQUIRE(bench.run("cvt --cells 2562 -o base.nc").code == 0);
  const Outcome finer = bench.run(
      "refine base.nc --region circle=10,50,1200km --factor 2 -o finer.nc --report r.json "
      "--cell-map .");
  CAPTURE(finer.err);
  REQUIRE(finer.code == 0);
  CHECK(has(finer.out, " new in 1 patch, all new shapes within the limits of models\n"));
  const auto report = nlohmann::json::parse(bench.file("r.json"));
  const auto kept = report["kept"].get<Eigen::Index>();
  CHECK(report["held"] == 0);
  CHECK(report["patches"][0]["well_centred"] == true);
  CHECK(bench.run("check finer.nc").code == 0);
  const Points3 base = read_mesh(bench.folder() / "base.nc").points,
                after = read_mesh(bench.folder() / "finer.nc").points;
  CHECK(after.cols() == report["cells"]);
  Eigen::Index next = 0, found = 0; // the kept ones in their order
  for (Eigen::Index i = 0; i < base.cols() && next < kept; ++i)
    if (base.col(i) == after.col(next)) {
      ++next;
      ++found;
    }
  CHECK(found == kept);
  std::istringstream forward(bench.file("cellMapForward.txt")),
      backward(bench.file("cellMapBackward.txt"));
  std::vector<std::int64_t> new_of_old, old_of_new;
  for (std::int64_t id = 0; forward >> id;)
    new_of_old.push_back(id);
  for (std::int64_t id = 0; backward >> id;)
    old_of_new.push_back(id);
  REQUIRE(std::ssize(new_of_old) == base.cols());
  REQUIRE(std::ssize(old_of_new) == after.cols());
  for (std::size_t i = 0; i < new_of_old.size(); ++i)
    if (new_of_old[i] >= 0)
      CHECK(old_of_new[static_cast<std::size_t>(new_of_old[i])] == static_cast<std::int64_t>(i));
  CHECK(std::ranges::count(old_of_new, -1) == after.cols() - kept);
  const Outcome coarser =
      bench.run("coarsen finer.nc --cell-width 400km --gradient 0.2 -o coarser.nc");
  CAPTURE(coarser.err);
  CHECK((coarser.code == 0 || coarser.code == 5)); // all of the sphere changes
  CHECK(bench.run("check coarser.nc").code == 0);
  CHECK(read_mesh(bench.folder() / "coarser.nc").points.cols() < 1.2 * 2562);
}

TEST_CASE("cells of a plane that its boundary clips stay, as the file or the option tells") {
  const Bench bench;
  REQUIRE(bench.run("cvt --rectangle 0,0,30,20 --cells 375 -o plane.nc").code == 0);
  bench.file("line.geojson", R"({"type": "LineString", "coordinates": [[10, 10], [15, 2]]})");
  bench.file("demand.toml", "[cell-width]\naround = \"line.geojson\"\nwidth = 0.7\nover = 3\n");
  const Outcome finer =
      bench.run("refine plane.nc --cell-width demand.toml --gradient 0.2 -o finer.nc");
  CAPTURE(finer.err);
  CHECK(finer.code == 1); // by the boundary
  CHECK(has(finer.err, "because they are at the boundary or next to it"));
  CHECK(bench.run("check finer.nc").code == 0);
  const auto obtuse = [&](const std::string& name) {
    REQUIRE(bench.run("info --plane " + name + " --rectangle 0,0,30,20 --report info.json").code ==
            0);
    return nlohmann::json::parse(bench.file("info.json"))["obtuse"].get<int>();
  };
  CHECK(obtuse("finer.nc") <= obtuse("plane.nc"));

  REQUIRE(bench.run("convert plane.nc plane.vtp").code == 0);
  check_refusals(bench, "refine plane.vtp --cell-width demand.toml",
                 "-o finer.vtp | 2 | a planar mesh needs its domain");
  CHECK(bench
            .run("refine plane.vtp --rectangle 0,0,30,20 --cell-width demand.toml "
                 "--gradient 0.2 -o finer.vtp")
            .code == 1);
  CHECK(read_mesh(bench.folder() / "finer.vtp", nullptr).points.cols() > 0);
}

TEST_CASE("cells at the shore become finer where the mesh ends at generators") {
  const Bench bench;
  check_success(bench, "cvt --region circle=10,10,1200km --cell-width 150km --boundary generators "
                       "--depth 300 --open box=-2,5,2,15 -o base.gr3");
  const std::string circle =
      "refine base.gr3 --region circle=0,10,500km --factor 2 --gradient 0.1 -o ";
  const Outcome held = bench.run(circle + "held.gr3");
  CHECK(held.code == 1);
  CHECK(has(held.err, "if the mesh ends at generators, give --boundary generators"));
  CHECK(has(check_success(bench, circle + "finer.gr3 --boundary generators").out,
            "fields at new cells are those of the nearest old one: open\n"));
  CHECK(bench.run("check finer.gr3").code == 0);
  const auto open_nodes = [&](const std::string& name) {
    const std::string text = bench.file(name);
    const std::size_t end = text.find(" = number of nodes of open boundaries");
    REQUIRE(end != std::string::npos);
    return std::stoi(text.substr(text.rfind('\n', end) + 1));
  };
  CHECK(open_nodes("base.gr3") > 5);
  CHECK(open_nodes("finer.gr3") > 1.6 * open_nodes("base.gr3"));
  check_success(bench, "cvt --cells 642 -o whole.nc");
  check_refusals(bench, "refine", R"(
whole.nc --region circle=0,10,500km --factor 2 --boundary generators -o new.nc | 2 | no boundary
)");
  check_refusals(bench, "coarsen", R"(
base.gr3 --region circle=0,10,500km --factor 2 --boundary generators -o new.gr3 | 2 | --boundary
)");
}

TEST_CASE(
    "the end of a change is one line, which says what is good or what is not and what to do") {
  const Bench bench;
  check_success(bench, "cvt --cells 642 -o base.nc");
  CHECK(check_success(bench, "refine base.nc --cell-width 2000km -o same.nc").out ==
        "same.nc: 642 cells, 642 of 642 kept (100.00%), 0 new in 0 patches; the demand is met\n");
  check_success(bench, "cvt --region box=0,0,20,20 --cell-width 300 --limited-area -o area.nc");
  check_refusals(bench, "refine area.nc -o far.nc --factor 2 --region", R"(
circle=100,-40,500km | 2 | the region holds no cells of the mesh; give a region inside the mesh
)");
  CHECK(!std::filesystem::exists(bench.folder() / "far.nc"));
  const Outcome small =
      bench.run("coarsen base.nc --region circle=10,50,2000km --factor 3 -o c.nc");
  CHECK(small.code == 1);
  CHECK(one_line(small.out));
  CHECK(small.err.starts_with("calotte: c.nc: the demand is met in none of its "));
  CHECK(small.err.ends_with("; give a larger region or --gradient\n"));
  CHECK(one_line(small.err));
}

TEST_CASE("km are those of another planet where the file is of one") {
  const Bench bench;
  const auto cells = [&](const std::string& arguments) {
    check_success(bench, "refine " + arguments + " --factor 2 -o new.nc --report r.json");
    return nlohmann::json::parse(bench.file("r.json"))["cells"];
  };
  check_success(bench, "cvt --cells 2562 --cell-width 60km --earth-radius 3390 -o mars.nc");
  check_success(bench, "cvt --cells 2562 -o unit.nc");
  check_success(bench, "cvt --cells 2562 -o air.nc --for mpas-atmosphere");
  CHECK(cells("mars.nc --region circle=10,50,900km") ==
        cells("unit.nc --region circle=10,50,1691.407km")); // 900 6371 / 3390
  CHECK(cells("air.nc --region circle=10,50,900km") ==
        cells("unit.nc --region circle=10,50,900km"));
}

TEST_CASE("bad demands end in one line and leave no file") {
  const Bench bench;
  REQUIRE(bench.run("cvt --cells 642 -o base.nc").code == 0);
  bench.file("square.txt", "0 0\n1 0\n1 1\n0 1\n");
  check_refusals(bench, "refine base.nc --region circle=10,50,1200km -o new.nc", R"(
| 2 | --factor
--factor 1 | 2 | the factor is 1
--factor 2 --cell-width 60 | 2 | --cell-width
--factor 2 --tolerance 3 | 2 | the tolerance is 3
--factor 2 --nearest depth | 2 | no field "depth" at cells
--factor 2 --conservative depth | 2 | no field "depth" at cells
--factor 2 --cell-map . --order curve | 2 | --cell-map
--factor 2 --cell-map no/folder | 3 | the folder no/folder does not exist
)");
  check_refusals(bench, "refine", R"(
base.nc -o new.nc | 2 | there are no widths; give --cell-width
base.nc --region circle=10,50,1200km --factor 2 -o base.nc | 2 | base.nc
base.nc --region circle=10,50,1200km --factor 2 -o new.txt2 | 2 | new.txt2
--plane base.vtp --domain square.txt --cell-width 1 -o square.txt | 2 | square.txt
)");
}
