// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"

#include <calotte/read.h>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>

using namespace calotte;
using namespace calotte::test;

namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("refine and coarsen keep the cells beside the part that they change") {
  const Bench bench;
  REQUIRE(bench.run("cvt --cells 2562 -o base.nc").code == 0);
  const Outcome finer = bench.run(
      "refine base.nc --region circle=10,50,1200km --factor 2 -o finer.nc --report r.json");
  CAPTURE(finer.err);
  REQUIRE(finer.code == 0);
  CHECK(has(finer.out, " new in 1 patch\n"));
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
  const Outcome coarser =
      bench.run("coarsen finer.nc --cell-width 400km --gradient 0.2 -o coarser.nc");
  CAPTURE(coarser.err);
  CHECK((coarser.code == 0 || coarser.code == 5)); // all of the sphere changes
  CHECK(bench.run("check coarser.nc").code == 0);
  CHECK(read_mesh(bench.folder() / "coarser.nc").points.cols() < 1.2 * 2562);
}

TEST_CASE("bad demands end in one line and leave no file") {
  const Bench bench;
  REQUIRE(bench.run("cvt --cells 642 -o base.nc").code == 0);
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    check_command_refused(bench, arguments, part);
  };
  const std::string part = "refine base.nc --region circle=10,50,1200km ";
  refused("refine base.nc -o new.nc", "there are no widths; give --cell-width");
  refused(part + "-o new.nc", "--factor");
  refused(part + "--factor 1 -o new.nc", "the factor is 1");
  refused(part + "--factor 2 --cell-width 60 -o new.nc", "--cell-width");
  refused(part + "--factor 2 --tolerance 3 -o new.nc", "the tolerance is 3");
  refused(part + "--factor 2 --nearest depth -o new.nc", "no field \"depth\" at cells");
  refused(part + "--factor 2 -o base.nc", "base.nc");
  refused(part + "--factor 2 -o new.txt2", "new.txt2");
}
