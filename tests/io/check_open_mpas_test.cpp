// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/meshes.h"
#include "support/open_mpas.h"
#include "support/spoilt_files.h"

#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::test::open_mpas;

TEST_CASE("an open MPAS file has no deviation") {
  const Scratch scratch;
  const std::string path = scratch / "open.nc";
  for (const double lowest : {-0.9, -0.3, 0.4})
    for (const Points3& points : {fibonacci_sphere(300), bisected_icosahedron(2)}) {
      open_file(scratch, points, lowest).create(path, NC_DOUBLE, put_attributes);
      REQUIRE(!read_mesh_file(path).mesh->closed());
      check_none(path);
    }
}

TEST_CASE("a variable of an open MPAS file that is spoilt alone is found") {
  const Scratch scratch;
  const std::string path = scratch / "open.nc";
  Cut file = open_file(scratch, random_sphere(60, 11), -0.2);
  file.create(path, NC_DOUBLE, put_attributes);
  check_none(path);
  for (const auto& [name, variable] : file.variables)
    for (const Corruption& corruption : corruptions()) {
      if (corruption.of_one_value)
        continue; // a value on the boundary may be free
      Variable spoilt = variable;
      corruption.spoil(spoilt, 0);
      if (std::equal(spoilt.values.begin(), spoilt.values.end(), variable.values.begin()) ||
          name == "meshDensity")
        continue; // without nominalMinDc nothing tells of the density
      CAPTURE(name);
      CAPTURE(corruption.name);
      Patch(path).put(spoilt);
      CHECK(is_found(path));
      Patch(path).put(variable);
    }
}
