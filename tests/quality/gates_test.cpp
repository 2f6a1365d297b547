// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/gates.h>

#include "cvt/cvt.h"
#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/errors.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/limited_area.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double earth = 6371229;

const GridDemands strict{.least_sides = 5,
                         .least_dv_over_dc = 0.18,
                         .largest_change = 0.1225,
                         .most_advecting_cells = 15,
                         .least_dv_in_float32 = 100,
                         .wind = 125,
                         .waves = 340};

const Gate& gate_of(const std::vector<Gate>& gates, const std::string& name) {
  const auto found =
      std::find_if(gates.begin(), gates.end(), [&](const Gate& gate) { return gate.name == name; });
  REQUIRE_MESSAGE(found != gates.end(), name);
  return *found;
}

bool all_passed(const std::vector<Gate>& gates) {
  return std::all_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.passed(); });
}

} // namespace

TEST_CASE("a geodesic grid passes, and its worst are those of quality()") {
  const Mesh mesh = delaunay(bisected_icosahedron(4));
  const Quality measured = quality(mesh);
  const std::vector<Gate> found = gates(voronoi(mesh), strict, earth);
  CHECK(all_passed(found));
  CHECK(gate_of(found, "sides of a cell, least").value == 5);
  CHECK(gate_of(found, "sides of a cell, most").value == 6);
  CHECK(gate_of(found, "cells that advect, most").value == 10);
  CHECK(gate_of(found, "dv / dc, least").value ==
        doctest::Approx(measured.dv_over_dc.min).epsilon(1e-9));
  CHECK(gate_of(found, "longest step, s, of flow").value ==
        doctest::Approx(0.9 * earth * measured.spacing.min / 125).epsilon(1e-9));
  const double exact = wave_step(operator_errors(mesh), 340) * earth,
               bound = gate_of(found, "longest step, s, of waves").value;
  CHECK(bound <= 1.01 * exact); // the eigenvalue is known within 1%
  CHECK(bound >= 0.8 * exact);
}

TEST_CASE("numbers of 32 bits have units of half a metre on the Earth") {
  const Voronoi cells = voronoi(delaunay(bisected_icosahedron(3)));
  const Gate found = gate_of(gates(cells, strict, earth), "dv / unit of float32, least");
  CHECK(found.value == doctest::Approx(earth * cells.dv.minCoeff() / 0.5));
  CHECK(gate_of(gates(cells, {.least_dv_in_float32 = 1e7}, earth), "dv / unit of float32, least")
            .beyond == cells.dv.size());
}

TEST_CASE("the cells that advect are the two of an edge and their neighbours") {
  const Mesh mesh = delaunay(random_sphere(300, 7));
  const Voronoi cells = voronoi(mesh);
  const IdLists around = neighbours(mesh);
  std::size_t most = 0;
  for (const auto& edge : cells.cells_on_edge.colwise()) {
    std::set<std::int32_t> set{edge[0], edge[1]};
    for (const std::int32_t cell : edge)
      set.insert(around[cell].begin(), around[cell].end());
    most = std::max(most, set.size());
  }
  const Gate found = gate_of(gates(cells, strict, earth), "cells that advect, most");
  CHECK(found.value == static_cast<double>(most));
  CHECK(found.passed() == (most <= 15));
}

TEST_CASE("cells of four sides fail, all of them, at the first") {
  const Voronoi cells = voronoi(delaunay(octahedron()));
  REQUIRE(cells.cells.cols() == 6);
  const Gate found = gate_of(gates(cells, strict, earth), "sides of a cell, least");
  CHECK(found.value == 4);
  CHECK(found.beyond == 6);
  CHECK(found.cell == 0);
  CHECK_FALSE(found.passed());
  CHECK(all_passed(gates(cells, {}, earth))); // without demands
}

TEST_CASE("the change of width is that of the density") {
  const Density bump = tanh_bump({0, 0, 1}, std::numbers::pi / 6, 0.2, std::pow(8.0, -4));
  const Mesh mesh = make_grid({.cells = 10242, .resolution = bump}).mesh;
  const Voronoi cells = voronoi(mesh);
  const DoubleVector density = evaluate(bump, cells.cells);
  double demanded = 0;
  for (const auto& edge : cells.cells_on_edge.colwise())
    demanded = std::max(demanded, std::pow(density[edge[0]] / density[edge[1]], 0.25));
  const Gate found = gate_of(gates(cells, strict, earth), "change of width, most");
  CHECK(found.value == doctest::Approx(demanded - 1).epsilon(0.12));
  CHECK_FALSE(found.passed()); // so few cells are too few for a contrast of 8
  // In a well-centred grid four angles, each below 90 degrees, do not surround a generator.
  CHECK(gate_of(gates(cells, strict, earth), "sides of a cell, least").value == 5);
  const double width = gate_of(gates(voronoi(make_grid({.cells = 2562}).mesh), strict, earth),
                               "change of width, most")
                           .value;
  CHECK(width < 0.03);
}

TEST_CASE("rings follow one another") {
  const Mesh mesh = delaunay(bisected_icosahedron(4));
  std::vector<std::uint8_t> inside;
  for (const auto& point : mesh.points.colwise())
    inside.push_back(point.z() > 0.9 ? 1 : 0);
  const Ids mask = limited_area_mask(neighbours(mesh), inside);
  const Voronoi part = voronoi(mesh, mask);
  std::vector<std::int32_t> kept;
  for (const std::int32_t of : mask)
    if (of >= 0)
      kept.push_back(of);
  Ids rings = Eigen::Map<const Ids>(kept.data(), std::ssize(kept));
  const auto beyond = [&](const Ids& of) {
    return gate_of(gates(part, strict, earth, of), "rings out of order").beyond;
  };
  CHECK(all_passed(gates(part, strict, earth, rings)));
  const auto change = [&](std::int32_t from, std::int32_t to) {
    Ids changed = rings;
    *std::find(changed.begin(), changed.end(), from) = to;
    return changed;
  };
  CHECK(beyond(change(3, 6)) >= 2); // the cell, and its neighbours of the rings 2 to 4
  CHECK(beyond(change(7, 6)) >= 1); // a ring that is open
  Ids apart = rings;                // no ring 4
  for (std::int32_t& of : apart)
    of = of == 4 ? 5 : of;
  CHECK(beyond(apart) > 0);
}

TEST_CASE("bad input of gates names what is wrong") {
  const Voronoi cells = voronoi(delaunay(bisected_icosahedron(1)));
  CHECK(refusal_of([&] { gates(cells, strict, 0); }) == "the radius 0 is not positive and finite");
  CHECK(refusal_of([&] { gates(cells, strict, earth, Ids::Zero(3)); }) == "3 masks for 42 cells");
  const Voronoi plane =
      voronoi(make_grid({.cells = 100, .surface = Surface::periodic({1, 1})}).mesh);
  CHECK(refusal_of([&] { gates(plane, strict, earth); }) ==
        "a model's demands are on grids of the sphere");
}
