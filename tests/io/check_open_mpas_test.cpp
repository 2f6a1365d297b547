// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/meshes.h"
#include "support/open_mpas.h"
#include "support/spoilt_files.h"

#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using open_mpas::Cut;
using open_mpas::open_file;
using open_mpas::put_attributes;

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

TEST_CASE("an edge of an open mesh may have its only cell as the second") {
  const Scratch scratch;
  const std::string path = scratch / "open.nc";
  Cut file = open_file(scratch, fibonacci_sphere(300), -0.3);
  const Cut before = file;
  std::vector<bool> turned(file.count("nEdges"));
  for (std::size_t e = 0; e < turned.size(); ++e)
    turned[e] = e % 3 == 0 && file.at("cellsOnEdge", e, 1) == 0;
  for (std::size_t e = 0; e < turned.size(); ++e) {
    for (std::size_t k = 0; k < file["weightsOnEdge"].width(); ++k)
      if (file.at("edgesOnEdge", e, k) > 0 && turned[e] != turned[file.id("edgesOnEdge", e, k)])
        file.at("weightsOnEdge", e, k) *= -1;
    if (!turned[e])
      continue;
    for (const char* name : {"cellsOnEdge", "verticesOnEdge"})
      std::swap(file.at(name, e, 0), file.at(name, e, 1));
    file.at("angleEdge", e) += open_mpas::pi;
  }
  REQUIRE(std::ranges::count(turned, true) > 10);
  file.create(path, NC_DOUBLE, put_attributes);
  check_none(path);
  for (const std::string name : {"angleEdge", "weightsOnEdge"}) { // those before it was turned
    CAPTURE(name);
    Cut spoilt = file;
    spoilt.variables.at(name) = before.variables.at(name);
    spoilt.create(path, NC_DOUBLE, put_attributes);
    REQUIRE(deviations_of(path).size() == 1);
    CHECK(deviations_of(path)[0].variable == name);
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

TEST_CASE("masks of a limited area follow at edges and vertices from those of cells") {
  const Scratch scratch;
  const std::string path = scratch / "open.nc";
  Cut file = open_file(scratch, fibonacci_sphere(200), 0);
  const auto add = [&](const std::string& kind, const std::string& dimension, auto&& value) {
    const std::size_t count = file.count(dimension);
    Variable mask{"bdyMask" + kind, {count}, {dimension}, true, std::vector<double>(count)};
    for (std::size_t i = 0; i < count; ++i)
      mask.values[i] = value(i);
    file.variables[mask.name] = mask;
    return mask;
  };
  const Variable of_cells =
      add("Cell", "nCells", [](std::size_t i) { return static_cast<double>(i * i % 8); });
  const auto least = [&](const std::string& list, std::size_t row, std::size_t width) {
    double out = 8;
    for (std::size_t k = 0; k < width; ++k)
      if (const double id = file.at(list, row, k); id > 0)
        out = std::min(out, of_cells.values[static_cast<std::size_t>(id) - 1]);
    return out;
  };
  file.create(path, NC_DOUBLE, put_attributes);
  CHECK(is_found(path)); // the others are missing
  Variable edges = add("Edge", "nEdges", [&](std::size_t e) { return least("cellsOnEdge", e, 2); });
  add("Vertex", "nVertices", [&](std::size_t v) { return least("cellsOnVertex", v, 3); });
  file.create(path, NC_DOUBLE, put_attributes);
  check_none(path);
  edges.values[5] += 1;
  Patch(path).put(edges);
  CHECK(is_found(path));
}
