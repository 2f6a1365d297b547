// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "support/directions.h"
#include "support/errors.h"
#include "support/files.h"

#include <calotte/read.h>
#include <calotte/write_region.h>

#include <doctest/doctest.h>

#include <string>

// Regions to GeoJSON and back.

using namespace calotte;
using namespace calotte::test;

TEST_CASE("a region that is written is read again, whichever side of its rings it is") {
  const Surface pole = circle(direction(0, 90), 30 * degree),
                island = circle(direction(180, 0), 20 * degree),
                rest = Surface::sphere().within({pole.rings().front().rowwise().reverse(),
                                                 island.rings().front().rowwise().reverse()});
  for (const Surface& region : {pole, island, rest}) {
    const Scratch scratch;
    const std::string path = scratch / "region.geojson";
    write_region(path, region);
    const Surface back = read_region(path);
    REQUIRE(back.rings().size() == region.rings().size());
    CHECK(back.area() == doctest::Approx(region.area()).epsilon(1e-12));
    for (std::size_t r = 0; r < region.rings().size(); ++r)
      CHECK((back.rings()[r] - region.rings()[r]).norm() < 1e-13);
  }
}

TEST_CASE("the whole sphere, planes and other names are no files of regions") {
  CHECK(refusal_of([] { write_region("a.geojson", {}); }).find("give one with rings") !=
        std::string::npos);
  CHECK(refusal_of([] {
          write_region("a.geojson", rectangle({0, 0}, {1, 1}));
        }).find("part of the sphere") != std::string::npos);
  CHECK(refusal_of([] {
          write_region("a.pts", circle(direction(0, 0), 1));
        }).find(".geojson or .json") != std::string::npos);
}
