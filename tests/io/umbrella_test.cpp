// SPDX-License-Identifier: GPL-3.0-or-later
// One header brings all of the library.
#include "delaunay/delaunay.h"

#include <calotte/calotte.h>

#include <doctest/doctest.h>

#include <string>

TEST_CASE("calotte.h is enough for each kind of work") {
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(100));
  CHECK(calotte::check(mesh).passed());
  CHECK(calotte::voronoi(mesh).cells.cols() == 100);
  CHECK(calotte::quality(mesh).cells == 100);
  CHECK(calotte::renumbered(mesh, calotte::Numbering::curve).closed());
  CHECK(calotte::format_of("mesh.nc") == calotte::Format::mpas);
  CHECK(calotte::earth_radius_km == 6371);
}

TEST_CASE("the version string agrees with the version numbers") {
  CHECK(std::string(CALOTTE_VERSION) == std::to_string(CALOTTE_VERSION_MAJOR) + "." +
                                            std::to_string(CALOTTE_VERSION_MINOR) + "." +
                                            std::to_string(CALOTTE_VERSION_PATCH));
}
