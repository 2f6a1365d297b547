// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/shapes.h"
#include "draw/title.h"
#include "draw/values.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace calotte;
using namespace calotte::tools;

TEST_CASE("a range has three digits and its unit, and is one number if its ends agree") {
  CHECK(range_text(29.96, 240.4, "km") == "30 to 240 km");
  CHECK(range_text(0.0123456, 5020.4, "km") == "0.0123 to 5\u2009020 km");
  CHECK(range_text(119.99, 120.01, "km") == "120 km");
  CHECK(range_text(1.8, 2.25, "\u00b0") == "1.8\u00b0 to 2.25\u00b0");
  CHECK(range_text(2, 2.001, "\u00b0") == "2\u00b0");
  CHECK(range_text(1e-5, 3, "") == "1e-05 to 3");
}

TEST_CASE("a title has the name, the number of cells and the range: in km if the radius is known") {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> lengths = {0.03, nothing, 0.04, 0.02};
  DrawOptions options;
  CHECK(mesh_title(options, "4 cells", "spacing", lengths) ==
        "4 cells, spacing 1.15\u00b0 to 2.29\u00b0");
  options.name = "a*b_{2}.nc"; // marks are no part of the text
  CHECK(mesh_title(options, "4 cells", "spacing", lengths) ==
        "ab_2.nc: 4 cells, spacing 1.15\u00b0 to 2.29\u00b0");
  options.name = "a.nc";
  options.unit = calotte::unit_of({}, 6371.22);
  CHECK(mesh_title(options, "4 cells", "spacing", lengths) ==
        "a.nc: 4 cells, spacing 127 to 255 km");
  CHECK(mesh_title(options, "4 cells", "spacing", lengths, true) ==
        "a.nc: 4 cells, spacing 0.02 to 0.04");
  CHECK(mesh_title(options, "4 cells", "spacing", {}) == "a.nc: 4 cells");
  CHECK(mesh_title(options, "4 cells", "spacing", {nothing}) == "a.nc: 4 cells");
}

TEST_CASE("the spacing in a title is the mean distance of a site to its neighbours") {
  const Mesh icosahedron = delaunay(bisected_icosahedron(0));
  for (const Shapes shapes : {Shapes::triangles, Shapes::cells}) {
    for (const double spacing : mean_distances(make_scene(icosahedron, shapes, {}))) {
      CHECK(spacing == doctest::Approx(std::atan(2)).epsilon(1e-14));
    }
  }
  const Mesh random = delaunay(random_sphere(100));
  const Scene scene = make_scene(random, Shapes::cells, {});
  CHECK(mean_distances(scene) == values_of(scene, Colouring::spacing));
}
