// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/limited_area.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/ocean.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include "support/errors.h"
#include "support/files.h"
#include "support/meshes.h"

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

std::vector<std::int32_t> kept_sites(const Ids& mask) {
  std::vector<std::int32_t> sites;
  for (std::int32_t i = 0; i < mask.size(); ++i)
    if (mask[i] >= 0)
      sites.push_back(i);
  return sites;
}

Ids mask_where(const Mesh& mesh, const std::function<bool(const Eigen::Vector3d&)>& inside) {
  Ids mask(mesh.points.cols());
  for (Eigen::Index i = 0; i < mask.size(); ++i)
    mask[i] = inside(mesh.points.col(i)) ? 0 : -1;
  return mask;
}

/// The edge between two sites of the whole; -1 for none.
std::int32_t edge_between(const Voronoi& whole, std::int32_t a, std::int32_t b) {
  for (std::int64_t k = 0; k < whole.cells_on_cell.count(a); ++k)
    if (whole.cells_on_cell[a][static_cast<std::size_t>(k)] == b)
      return whole.edges_on_cell[a][static_cast<std::size_t>(k)];
  return -1;
}

double difference(const Points3& a, Eigen::Index i, const Points3& b, Eigen::Index j) {
  return (a.col(i) - b.col(j)).norm();
}

/// The cell of each kept site is that of the whole: corners, neighbours, edges and measures.
void check_cells(const Voronoi& whole, const Voronoi& part, const Ids& mask, double unit) {
  const std::vector<std::int32_t> site = kept_sites(mask);
  REQUIRE(part.cells.cols() == std::ssize(site));
  const double close = 1e-13 * unit;
  std::set<std::int32_t> edges;
  for (std::int64_t i = 0; i < part.cells.cols(); ++i) {
    const std::int32_t s = site[static_cast<std::size_t>(i)];
    CHECK(part.cells.col(i) == whole.cells.col(s));
    CHECK(std::abs(part.cell_area[i] - whole.cell_area[s]) < close * unit);
    const auto corners = part.vertices_on_cell[i], expected = whole.vertices_on_cell[s];
    const auto neighbours = whole.cells_on_cell[s];
    REQUIRE(corners.size() == expected.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      CHECK(difference(part.vertices, corners[k], whole.vertices, expected[k]) < close);
      const std::int32_t other = part.cells_on_cell[i][k], edge = part.edges_on_cell[i][k];
      edges.insert(edge);
      if (other >= 0)
        CHECK(site[static_cast<std::size_t>(other)] == neighbours[k]);
      else
        CHECK(mask[neighbours[k]] < 0);
      const std::int32_t before = edge_between(whole, s, neighbours[k]);
      CHECK(difference(part.edges, edge, whole.edges, before) < close);
      CHECK(std::abs(part.dc[edge] - whole.dc[before]) < close);
      CHECK(std::abs(part.dv[edge] - whole.dv[before]) < close);
      // The normal leaves the one cell that is there.
      const bool turned = whole.cells_on_edge(0, before) != s && other < 0;
      const double turn = std::abs(
          std::remainder(part.angle[edge] - whole.angle[before] - (turned ? std::numbers::pi : 0),
                         2 * std::numbers::pi));
      CHECK(turn < 1e-9);
    }
  }
  CHECK(std::ssize(edges) == part.cells_on_edge.cols());
  CHECK(part.kites.sum() == doctest::Approx(part.cell_area.sum()).epsilon(1e-12));
  CHECK(part.vertex_area.sum() == doctest::Approx(part.cell_area.sum()).epsilon(1e-12));
  for (std::int64_t e = 0, open = 0; e < part.cells_on_edge.cols(); ++e) {
    open += part.cells_on_edge(1, e) < 0;
    CHECK(part.cells_on_edge(0, e) >= 0);
    CHECK((part.cells_on_edge(1, e) < 0) == (open > 0)); // these are last
  }
}

} // namespace

TEST_CASE("law: the cells of some sites are those of the whole, on the sphere and in a box") {
  const Mesh sphere = delaunay(random_sphere(500, 3)), plane = hexagonal_box(12, 14, 0.1);
  const auto in_cap = [](const Eigen::Vector3d& x) { return x.z() > 0.4; };
  const auto islands = [](const Eigen::Vector3d& x) { return std::sin(9 * x.x()) > 0.2; };
  const auto all = [](const Eigen::Vector3d&) { return true; };
  for (const auto& inside : {std::function(in_cap), std::function(islands), std::function(all)})
    check_cells(voronoi(sphere), voronoi(sphere, mask_where(sphere, inside)),
                mask_where(sphere, inside), 1);
  const Ids mask =
      mask_where(plane, [](const Eigen::Vector3d& x) { return std::hypot(x.x(), x.y()) < 0.4; });
  check_cells(voronoi(plane), voronoi(plane, mask), mask, 1);
  const Voronoi one = voronoi(sphere, mask_where(sphere, [&](const Eigen::Vector3d& x) {
                                return x == Eigen::Vector3d(sphere.points.col(7));
                              }));
  CHECK(one.cells.cols() == 1);
  CHECK(one.cells_on_vertex.row(1).maxCoeff() == -1);
}

TEST_CASE("law: the cells of some sites have the same bits for any number of threads") {
  const Mesh mesh = delaunay(random_sphere(20'000, 9));
  const Ids mask = mask_where(mesh, [](const Eigen::Vector3d& x) { return x.y() > -0.3; });
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return voronoi(mesh, mask);
  };
  const Voronoi one = with(1), four = with(4);
  CHECK(one.vertices == four.vertices);
  CHECK(one.edges == four.edges);
  CHECK(one.cells_on_cell.items == four.cells_on_cell.items);
  CHECK(one.vertices_on_cell.items == four.vertices_on_cell.items);
  CHECK(one.edges_on_vertex == four.edges_on_vertex);
  for (const auto values : {&Voronoi::dc, &Voronoi::dv, &Voronoi::angle, &Voronoi::cell_area})
    CHECK(one.*values == four.*values);
  CHECK(one.kites == four.kites);
}

TEST_CASE("a limited area and an ocean in memory are those of files") {
  const Scratch scratch;
  const Mesh mesh = delaunay(fibonacci_sphere(3000));
  const IdLists around = neighbours(mesh);
  std::vector<std::uint8_t> inside(3000), land(3000);
  for (std::size_t i = 0; i < inside.size(); ++i) {
    inside[i] = mesh.points(2, static_cast<Eigen::Index>(i)) > 0.9;
    land[i] = mesh.points(0, static_cast<Eigen::Index>(i)) > 0.7;
  }
  for (const Ids& mask : {limited_area_mask(around, inside, 3), sea_cells(around, land).mask}) {
    const Voronoi part = voronoi(mesh, mask);
    write(scratch / "part.nc", {.polygons = polygons_of(part)});
    const MeshFile file = read_mesh_file(scratch / "part.nc");
    CHECK(file.polygons->size() == part.cells.cols());
    const std::vector<std::int32_t> site = kept_sites(mask);
    for (std::size_t i = 0; i < site.size(); ++i) {
      const auto missing =
          std::ranges::count_if(around[site[i]], [&](auto other) { return mask[other] < 0; });
      CHECK(std::ranges::count(part.cells_on_cell[static_cast<std::int64_t>(i)], -1) == missing);
    }
  }
}

TEST_CASE("cells of an open mesh that triangles do not surround are refused, and bad masks") {
  const auto in_cap = [](const Eigen::Vector3d& x) { return x.z() > 0.6; };
  const Mesh whole = delaunay(random_sphere(400, 5));
  std::vector<Eigen::Index> upper;
  for (Eigen::Index i = 0; i < 400; ++i)
    if (whole.points(2, i) > 0.2)
      upper.push_back(i);
  const Mesh open = delaunay(Points3(whole.points(Eigen::all, upper)));
  REQUIRE(!open.closed());
  const Ids mask = mask_where(whole, in_cap);
  const Voronoi of_open = voronoi(open, mask_where(open, in_cap)), of_whole = voronoi(whole, mask);
  CHECK(of_open.vertices == of_whole.vertices);
  CHECK(of_open.dc == of_whole.dc);
  CHECK(of_open.cells_on_cell.items == of_whole.cells_on_cell.items);
  const Error error = error_of([&] { voronoi(open, Ids::Zero(open.points.cols())); });
  CHECK(std::string(error.what())
            .starts_with("site " + std::to_string(error.index()) + " is to have a cell, but "));
  CHECK(open.points(2, error.index()) < 0.5);
  const auto refusal = [](const Mesh& of, const Ids& masks) {
    return std::string(error_of([&] { voronoi(of, masks); }).what());
  };
  CHECK(refusal(whole, Ids::Constant(400, -1)) == "no site is to have a cell; keep at least one");
  CHECK(refusal(whole, Ids::Zero(3)) == "there are 3 masks for 400 sites; give one for each");
  Mesh pinched = open; // a triangle more at a site that others surround
  const std::int32_t n = static_cast<std::int32_t>(open.points.cols());
  const std::int32_t site = kept_sites(mask_where(open, in_cap)).front();
  pinched.points.conservativeResize(3, n + 2);
  pinched.points.rightCols(2) << 0, 0.1, 0.1, 0, -1, -1;
  pinched.triangles.conservativeResize(3, open.triangles.cols() + 1);
  pinched.neighbours.conservativeResize(3, open.triangles.cols() + 1);
  pinched.triangles.rightCols(1) << site, n, n + 1;
  pinched.neighbours.rightCols(1).setConstant(-1);
  Ids alone = Ids::Constant(n + 2, -1);
  alone[site] = 0;
  CHECK(refusal(pinched, alone).starts_with("site " + std::to_string(site) + " is to have a cell"));
  Mesh broken = whole;
  broken.neighbours(1, 4) = broken.neighbours(0, 4);
  CHECK(refusal(broken, Ids::Zero(400)).starts_with("triangle "));
}
