// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_writer.h"
#include "support/command.h"

#include <calotte/field_grid.h>

#include <doctest/doctest.h>

#include <string>

using namespace calotte;
using namespace calotte::test;

namespace {

/// A mesh of 300 cells, grid.nc, and fields of 3 times and 2 levels without a mesh, history.nc. At
/// cell i the value is i + 1000 time + 10000 level.
void make_history(const Bench& bench) {
  REQUIRE(bench.run("cvt --cells 300 --max-iterations 3 --stop tolerance -o grid.nc").code <= 1);
  const FieldGrid grid = read_field_grid(bench.path("grid.nc"), FieldChoice::none);
  MeshField ssh{.name = "ssh", .units = "m", .dimensions = {{"Time", 3, true}}, .leading = 1};
  MeshField theta{.name = "theta",
                  .long_name = "potential temperature",
                  .dimensions = {{"Time", 3, true}, {"nVertLevels", 2}},
                  .leading = 1};
  MeshField depth{.name = "depth", .values = DoubleVector::LinSpaced(300, 0, 299)};
  ssh.values.resize(300 * 3);
  theta.values.resize(300 * 6);
  for (int i = 0; i < 300; ++i)
    for (int time = 0; time < 3; ++time) {
      ssh.values[3 * i + time] = i + 1000 * time;
      for (int level = 0; level < 2; ++level)
        theta.values[2 * (3 * i + time) + level] = i + 1000 * time + 10000 * level;
    }
  write_fields(bench.path("history.nc"), grid, {ssh, theta, depth});
  REQUIRE(bench.run("convert grid.nc triangles.vtp").code == 0);
}

} // namespace

TEST_CASE("info: the ranges of fields without their mesh, at a time and a level") {
  const Bench bench;
  make_history(bench);
  const Outcome at = bench.run("info history.nc --mesh grid.nc --at time=-1,lev=1");
  CHECK(at.err.empty());
  CHECK(at.out == "indices                   time=-1, lev=1\n"
                  "ssh                       2000 to 2299, mean 2150 m\n"
                  "theta                     1.2e+04 to 1.23e+04, mean 1.215e+04\n"
                  "depth                     0 to 299, mean 149.5\n");
  const Outcome none = bench.run("info history.nc --mesh grid.nc");
  CHECK(none.out == "depth                     0 to 299, mean 149.5\n"
                    "ssh                       Time (3); see --at\n"
                    "theta                     Time (3), nVertLevels (2); see --at\n");
  CHECK(has(bench.run("info history.nc --mesh grid.nc --at time=0").out,
            "theta                     nVertLevels (2); see --at\n"));
  const Outcome cell = bench.run("info history.nc --mesh grid.nc --at Time=1 --cell 7");
  CHECK(has(cell.out, "1007 m"));
  CHECK(bench.run("info grid.nc --at time=0").code == 2);
}

TEST_CASE("draw: a field without its mesh, at a time and a level") {
  const Bench bench;
  make_history(bench);
  const std::string draw = "draw history.nc --mesh grid.nc --colour field:theta --what cells ";
  const Outcome picture = bench.run(draw + "--at TIME=2,nVertLevels=1 -o a.svg");
  CHECK(picture.err.empty());
  CHECK(picture.out == "a.svg: picture of 300 sites, 596 triangles\n");
  const Outcome by_word = bench.run(draw + "--at time=-1,lev=-1 -o b.svg");
  CHECK(by_word.code == 0);
  const Outcome other = bench.run(draw + "--at time=0,lev=1 -o c.svg");
  CHECK(other.code == 0);
  CHECK(bench.file("a.svg") != bench.file("c.svg"));
  CHECK(bench.run("draw history.nc --mesh grid.nc --colour field:depth -o d.png").code == 0);
  CHECK(bench.run("draw grid.nc --colour field:areaCell -o e.png").code == 0);
}

TEST_CASE("view: fields without their mesh, at a time, beside those of another file") {
  const Bench bench;
  make_history(bench);
  const Outcome page = bench.run(
      "view history.nc history.nc --mesh grid.nc --at time=1,lev=0 --field theta -o a.html");
  CHECK(page.err.empty());
  CHECK(page.out == "a.html: page of 300 cells and 300 cells\n");
  CHECK(has(bench.file("a.html"), "Fields are shown at time=1, lev=0."));
}

TEST_CASE("indices of fields: bad input is one line") {
  const Bench bench;
  make_history(bench);
  io_detail::NetcdfWriter alone(bench.path("alone.nc"));
  alone.dimension("nCells", 3);
  alone.begin();
  alone.finish();
  alone.commit();
  check_refusals(bench, "draw -o a.png", R"(
history.nc --mesh grid.nc | 2 | --mesh is for a field of MESH; name it, as in --colour field:NAME
grid.nc --at time=0 | 2 | --at is for a field of MESH
history.nc --mesh grid.nc --colour field:theta | 2 | history.nc: theta has several numbers for each cell: Time (3), nVertLevels (2); choose one index of each: --at Time=0,nVertLevels=0
history.nc --mesh grid.nc --colour field:theta --at time=0 | 2 | choose one index of each: --at nVertLevels=0
history.nc --mesh grid.nc --colour field:theta --at time=3,lev=0 | 2 | time=3 is out of range: Time has the indices 0 to 2
history.nc --mesh grid.nc --colour field:ssh --at time=0,lev=0 | 2 | history.nc: ssh has no dimension lev; it has Time (3)
history.nc --mesh grid.nc --colour field:theta --at time=0,Time=1 | 2 | there are two indices of the dimension Time
history.nc --mesh grid.nc --colour field:theta --at e=0 | 2 | e is a part of several names of dimensions: Time (3), nVertLevels (2)
history.nc --mesh grid.nc --colour field:hta | 2 | history.nc: no variable hta; there are
history.nc --mesh grid.nc --colour field:theta --at time | 2 | --at time: time is no index of a dimension; give NAME=INDEX
history.nc --mesh grid.nc --colour field:theta --at time=x | 2 | --at time=x: time=x is no index
history.nc --mesh triangles.vtp --colour field:theta --at time=0,lev=0x | 2 | lev=0x is no index
history.nc --mesh never.nc --colour field:depth | 3 | never.nc
history.nc --colour field:depth | 2 | history.nc
alone.nc | 2 | zCell are missing); give the mesh, too (--mesh FILE of draw, view, info and interpolate), or add
)");
  check_refusals(bench, "info", R"(
history.nc --mesh grid.nc --at lev=5 | 2 | lev=5 is out of range
history.nc --mesh grid.nc --at x=5 | 2 | history.nc: no field has a dimension x; there are Time (3), nVertLevels (2)
history.nc --mesh grid.nc --operators | 2 | --mesh and --at print fields, not measures; leave out --operators
history.nc --mesh grid.nc --units km --report a.json | 2 | not measures; leave out --report, --units
grid.nc --at time=0 --sphere-radius earth --density x8 | 2 | not measures; leave out --sphere-radius, --density
history.nc --mesh grid.nc --cell-width 60km | 2 | not measures; leave out --cell-width
grid.nc --at x=5 | 2 | grid.nc: no field has a dimension x; leave it out
)");
  check_refusals(bench, "view", R"(
history.nc --mesh grid.nc --field theta --at time=0 | 2 | of which --at chooses one
--plan --cell-width 60km --at time=0 | 2 | leave out --field, --mesh, --at,
)");
}
