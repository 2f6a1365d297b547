// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/command.h"
#include "support/constants.h"
#include "support/directions.h"

#include <calotte/read.h>
#include <calotte/surface.h>

#include <doctest/doctest.h>

#include <string>

// calotte coast: from polygons of land to a region for grids.

using namespace calotte;
using namespace calotte::test;

namespace {

/// Land of 40 by 40 degrees over the date line, whose bay is reached by a strait of 71 km.
const std::string land = R"({"type":"Polygon","coordinates":[[[160,-20],[-160,-20],[-160,-0.32],
    [-170,-0.32],[-170,-10],[170,-10],[170,10],[-170,10],[-170,0.32],[-160,0.32],[-160,20],[160,20],
    [160,-20]]]})";

} // namespace

TEST_CASE("the sea of a coast is a region of other commands") {
  const Bench bench;
  bench.file("land.geojson", land);
  bench.file("strait.geojson", R"({"type":"LineString","coordinates":[[180,0],[-155,0]]})");
  const auto sea = [&](const std::string& options) {
    const Outcome made =
        bench.run("coast land.geojson --cell-width 100km -o sea.geojson" + options);
    CAPTURE(made.err);
    CHECK(made.code == 0);
    return std::pair(read_region(bench.folder() / "sea.geojson"), made.out);
  };
  const Eigen::Vector3d bay = direction(180, 0), ocean = direction(0, 0);
  const auto [closed, closed_text] = sea("");
  CHECK(closed.contains(ocean));
  CHECK(!closed.contains(bay));
  CHECK(has(closed_text, "parts of the sea left out   1\n"));
  CHECK(has(closed_text, "straits closed              1\n"));
  CHECK(has(closed_text, "--passage connects a part"));
  const auto [open, open_text] = sea(" --passage strait.geojson");
  CHECK(open.contains(ocean));
  CHECK(open.contains(bay));
  CHECK(has(open_text, "parts of the sea left out   0\n"));
  const auto [inner, inner_text] = sea(" --seed 180,0");
  CHECK(!inner.contains(ocean));
  CHECK(inner.contains(bay));
  CHECK(has(inner_text, "sea.geojson: 1 ring, "));
  const Outcome planned = bench.run("plan --region sea.geojson --cell-width 100km");
  CHECK(planned.code == 0);
  CHECK(has(planned.out, "region                sea.geojson"));
}

TEST_CASE("what calotte coast refuses") {
  const Bench bench;
  bench.file("land.geojson", land);
  check_refusals(bench, "coast land.geojson", R"(
-o sea.geojson | 2 | there are no widths; give --cell-width KM|FILE
--cell-width 100km -o sea.nc | 2 | sea.nc: the sea is written to GeoJSON
--cell-width 100km -o land.geojson | 2 | land.geojson
--cell-width 100km --seed 165,0 -o sea.geojson | 2 | seed 0 is on land
--cell-width 100km --least-island 0 -o sea.geojson | 2 | the least island has 0 cells
--cell-width 30000km -o sea.geojson | 2 | smaller than the least island that counts
)");
}
