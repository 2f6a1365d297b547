// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/coastal_cells.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/surface.h>
#include <calotte/voronoi.h>

#include "support/errors.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// The Voronoi cells of a part of the sphere, which its boundary clips.

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double degree = std::numbers::pi / 180;

Points3 ring_of(const std::vector<std::array<double, 2>>& lonlat) {
  Points2 degrees(2, std::ssize(lonlat));
  for (std::size_t k = 0; k < lonlat.size(); ++k)
    degrees.col(static_cast<Eigen::Index>(k)) << lonlat[k][0], lonlat[k][1];
  return from_lonlat(degrees);
}

Surface region_of(const std::vector<std::vector<std::array<double, 2>>>& rings) {
  std::vector<Points3> points;
  for (const auto& ring : rings)
    points.push_back(ring_of(ring));
  return enclosed_region(points);
}

/// A square of some degrees around a place near the equator.
std::vector<std::array<double, 2>> square(double lon, double lat, double half) {
  return {{lon - half, lat - half},
          {lon + half, lat - half},
          {lon + half, lat + half},
          {lon - half, lat + half}};
}

struct Case {
  std::string name;
  Surface region;
  int sites;
};

/// Regions whose cells are single polygons.
std::vector<Case> regions() {
  return {{"circle", circle({1, 2, 2}, 0.4, 90), 200},
          {"annulus over the pole", channel(60 * degree, 80 * degree, 100), 300},
          {"L with corners", region_of({{{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}}}),
           150},
          {"two islands", region_of({square(0, 0, 30), square(-10, 0, 6), square(12, 5, 7)}), 700},
          {"two basins", region_of({square(0, 0, 10), square(40, 3, 12)}), 300},
          {"strip narrower than a cell", region_of({{{0, 0}, {60, 0}, {60, 1}, {0, 1}}}), 12},
          {"all but a small cap", circle({0, 0, -1}, std::numbers::pi - 0.2, 40), 500},
          {"more than a hemisphere", circle({1, 0, 0}, 2, 200), 400}};
}

/// Sites that some iterations have spread.
Mesh mesh_in(const Case& of) {
  const Recipe recipe{.cells = of.sites, .surface = of.region, .stop = {.iterations = 30}};
  return make_grid(recipe).mesh;
}

Eigen::Vector3d unit_at(const Points3& points, std::int64_t i) { return points.col(i); }

/// Whether a point is in a polygon that is smaller than a hemisphere: the winding number around it.
bool is_in_cell(const Voronoi& cells, std::int64_t cell, const Eigen::Vector3d& x) {
  double sum = 0;
  const auto vertices = cells.vertices_on_cell[cell];
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto tangent = [&](std::size_t index) -> Eigen::Vector3d {
      const Eigen::Vector3d p = unit_at(cells.vertices, vertices[index % vertices.size()]);
      return p - p.dot(x) * x;
    };
    sum += std::atan2(x.dot(tangent(k).cross(tangent(k + 1))), tangent(k).dot(tangent(k + 1)));
  }
  return sum > std::numbers::pi;
}

/// The distance of a point from the boundary, in radians.
double distance_from_boundary(const Surface& region, const Eigen::Vector3d& x) {
  double least = 10;
  for (const DoubleMatrix& ring : region.rings())
    for (Eigen::Index k = 0; k < ring.cols(); ++k) {
      const Eigen::Vector3d a = ring.col(k).normalized(),
                            b = ring.col((k + 1) % ring.cols()).normalized(),
                            pole = a.cross(b).normalized();
      const bool beside = a.cross(x).dot(pole) > -1e-15 && x.cross(b).dot(pole) > -1e-15;
      least =
          std::min({least, beside ? std::abs(pole.dot(x)) : 10, (x - a).norm(), (x - b).norm()});
    }
  return least;
}

/// The laws of a complex with a boundary.
void check_complex(const Voronoi& cells) {
  std::vector<int> boundary_edges(static_cast<std::size_t>(cells.vertices.cols()));
  for (Eigen::Index e = 0; e < cells.cells_on_edge.cols(); ++e) {
    CHECK(cells.cells_on_edge(0, e) >= 0);
    CHECK(cells.vertices_on_edge.col(e).minCoeff() >= 0);
    for (int end = 0; end < 2 && cells.cells_on_edge(1, e) < 0; ++end)
      ++boundary_edges[static_cast<std::size_t>(cells.vertices_on_edge(end, e))];
  }
  for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v) {
    CHECK(cells.cells_on_vertex(0, v) >= 0);
    CHECK(boundary_edges[static_cast<std::size_t>(v)] == (cells.cells_on_vertex(2, v) < 0 ? 2 : 0));
  }
  DoubleVector by_cell = DoubleVector::Zero(cells.cells.cols());
  for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v)
    for (int j = 0; j < 3; ++j)
      if (cells.cells_on_vertex(j, v) >= 0)
        by_cell[cells.cells_on_vertex(j, v)] += cells.kites(j, v);
  CHECK((by_cell.array() / cells.cell_area.array() - 1).abs().maxCoeff() < 1e-10);
  CHECK(cells.vertex_area.sum() / cells.cell_area.sum() == doctest::Approx(1).epsilon(1e-12));
}

/// The least area of the kites of cells.
double least_kite(const Voronoi& cells) {
  double least = 10;
  for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v)
    for (int j = 0; j < 3; ++j)
      if (cells.cells_on_vertex(j, v) >= 0)
        least = std::min(least, cells.kites(j, v));
  return least;
}

/// The corners of the boundary in vertices with one cell.
std::int64_t corners(const Voronoi& cells) {
  return (cells.cells_on_vertex.row(1).array() < 0).count();
}

} // namespace

TEST_CASE("cells of a part of the sphere are the nearest points of the part") {
  for (const Case& of : regions()) {
    CAPTURE(of.name);
    const Mesh mesh = mesh_in(of);
    const Voronoi cells = voronoi(mesh);
    REQUIRE(cells.cells.cols() == mesh.points.cols());
    check_complex(cells);
    CHECK(cells.cell_area.sum() / of.region.area() == doctest::Approx(1).epsilon(1e-12));
    double length = 0, perimeter = 0;
    for (Eigen::Index e = 0; e < cells.dv.size(); ++e)
      length += cells.cells_on_edge(1, e) < 0 ? cells.dv[e] : 0;
    for (const DoubleMatrix& ring : of.region.rings())
      for (Eigen::Index k = 0; k < ring.cols(); ++k)
        perimeter += 2 * std::asin((ring.col((k + 1) % ring.cols()) - ring.col(k)).norm() / 2);
    CHECK(length / perimeter == doctest::Approx(1).epsilon(1e-12));
    for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v)
      if (cells.cells_on_vertex(2, v) < 0)
        CHECK(distance_from_boundary(of.region, unit_at(cells.vertices, v)) < 1e-14);
    Random random(7);
    for (int k = 0; k < 300; ++k) {
      const auto point = random.direction();
      const Eigen::Vector3d x(point.x, point.y, point.z);
      Eigen::Index nearest = 0;
      (mesh.points.transpose() * x).maxCoeff(&nearest);
      CHECK(is_in_cell(cells, nearest, x) == of.region.contains(x));
    }
  }
}

TEST_CASE("the rings of a closed mesh clip its cells") {
  const Surface region = circle({0, 0, -1}, std::numbers::pi - 0.02, 20); // in one triangle
  const Points3 points = fibonacci_sphere(400);
  const Mesh mesh = delaunay(points);
  REQUIRE(mesh.closed());
  Mesh part = mesh;
  part.surface = region;
  if (region.contains(points.col(0)))
    CHECK(refusal_of([&] { voronoi(part); }).find("encloses an island") != std::string::npos);
}

TEST_CASE("coastal cells lie between points of the boundary") {
  for (const Case& of : regions()) {
    CAPTURE(of.name);
    const Mesh mesh = mesh_in(of);
    const CoastalCells coastal = coastal_cells(mesh, {.straightness = 1.0 / 32, .least_edge = 0});
    const Voronoi &cells = coastal.voronoi, exact = voronoi(mesh);
    check_complex(cells);
    CHECK(coastal.changes.merged_parts + coastal.changes.removed_parts +
              coastal.changes.removed_islands + coastal.changes.moved_ends ==
          0);
    CHECK(coastal.changes.removed_corners == corners(exact) - corners(cells));
    CHECK(least_kite(cells) > 0);
    for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v)
      if (cells.cells_on_vertex(2, v) < 0)
        CHECK(distance_from_boundary(of.region, unit_at(cells.vertices, v)) < 1e-14);
    // A corner that hides a part of the boundary from a site may be far from the edge that remains.
    CHECK((cells.cell_area.array() / exact.cell_area.array() - 1).abs().maxCoeff() < 0.1);
    for (Eigen::Index e = 0; e < cells.dc.size(); ++e)
      if (cells.cells_on_edge(1, e) < 0) {
        const Eigen::Vector3d cell = unit_at(cells.cells, cells.cells_on_edge(0, e));
        CHECK(cells.dc[e] / (4 * std::asin((unit_at(cells.edges, e) - cell).norm() / 2)) ==
              doctest::Approx(1).epsilon(1e-12));
      }
  }
}

TEST_CASE("one edge lies between two crossings of a smooth coast, and corners stay") {
  const Mesh round = mesh_in({"circle", circle({1, 2, 2}, 0.4, 720), 800});
  const CoastalCells cells = coastal_cells(round);
  CHECK(corners(cells.voronoi) == 0);
  CHECK(cells.changes.removed_corners == 720);
  const Surface sea = region_of({square(0, 0, 10)});
  const CoastalCells bent =
      coastal_cells(delaunay(ring_of({{-5, -5}, {6, -4}, {5, 5}, {-4, 6}, {0.5, 0.3}}), sea));
  CHECK(bent.changes.removed_corners == 0);
  CHECK(corners(bent.voronoi) == 4);
  const CoastalCells all = coastal_cells(round, {.straightness = 0, .least_edge = 0});
  CHECK(all.changes.removed_corners == 0);
  CHECK(all.voronoi.cell_area.sum() / round.surface.area() == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a spit that cuts cells leaves each cell the part around its site") {
  // A spit of 0.4 degrees into a sea with cells of some 3 degrees.
  const Surface sea =
      region_of({{{0, 0}, {9.8, 0}, {9.8, 12}, {10.2, 12}, {10.2, 0}, {20, 0}, {20, 20}, {0, 20}}});
  Points3 points = random_points(60, sea, {}, 5);
  const Mesh mesh = delaunay(points, sea);
  CHECK(refusal_of([&] { voronoi(mesh); }).find("into several parts") != std::string::npos);
  const CoastalCells coastal = coastal_cells(mesh, {.straightness = 0, .least_edge = 0});
  const CoastChanges& changes = coastal.changes;
  CHECK(changes.merged_parts + changes.removed_parts > 0);
  CHECK(changes.removed_islands == 0);
  check_complex(coastal.voronoi);
  CHECK((coastal.voronoi.cell_area.sum() + changes.removed_area) / sea.area() ==
        doctest::Approx(1).epsilon(1e-12));
  for (std::int64_t i = 0; i < points.cols(); ++i)
    CHECK(is_in_cell(coastal.voronoi, i, unit_at(coastal.voronoi.cells, i)));
}

TEST_CASE("an island within a cell becomes sea") {
  const Surface sea = region_of({square(0, 0, 20), square(0.5, 0.2, 0.3)});
  const Points3 points = ring_of(
      {{0, 0}, {10, 0}, {-10, 0}, {0, 10}, {0, -10}, {10, 11}, {-10, 12}, {-11, -10}, {10, -12}});
  const Mesh mesh = delaunay(points, sea);
  CHECK(refusal_of([&] { voronoi(mesh); }).find("encloses an island") != std::string::npos);
  const CoastalCells coastal = coastal_cells(mesh, {.straightness = 0, .least_edge = 0});
  check_complex(coastal.voronoi);
  CHECK(coastal.changes.removed_islands == 1);
  CHECK((coastal.voronoi.cell_area.sum() - coastal.changes.island_area) / sea.area() ==
        doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a coast that hides itself from a site is straightened, or counted") {
  // Teeth of the coast hide parts of it. Those of the second sea are half a cell high.
  const auto toothed = [](double height) {
    std::vector<std::array<double, 2>> ring{{0, 0}, {20, 0}, {20, 10}};
    for (int k = 1; k < 40; ++k)
      ring.push_back({20 - 0.5 * k, 10 + (k % 2 == 0 ? 0 : height)});
    ring.push_back({0, 10});
    return region_of({ring});
  };
  for (const double height : {1.2, 2.0}) {
    CAPTURE(height);
    const Mesh mesh = mesh_in({"teeth", toothed(height), 30});
    const CoastalCells all = coastal_cells(mesh, {.straightness = 0, .least_edge = 0});
    CHECK(least_kite(all.voronoi) < 0);
    CHECK(all.changes.hidden_cells > 0);
    const CoastalCells coastal = coastal_cells(mesh);
    check_complex(coastal.voronoi);
    CHECK(coastal.changes.hidden_cells < all.changes.hidden_cells);
    CHECK((least_kite(coastal.voronoi) > 0) == (coastal.changes.hidden_cells == 0));
    CHECK((coastal.changes.hidden_cell < 0) == (coastal.changes.hidden_cells == 0));
    CHECK((coastal.changes.hidden_cells == 0) == (height < 2));
    CHECK(coastal.changes.changed_area < 0.2 * mesh.surface.area());
  }
}

TEST_CASE("cells that a coast leaves small are counted") {
  const Surface sea = region_of({square(0, 0, 10)});
  const Mesh mesh =
      delaunay(ring_of({{-5, -5}, {6, -6}, {5, 5}, {-6, 6}, {8, 8}, {9.7, 9.7}}), sea);
  const CoastChanges changes = coastal_cells(mesh).changes;
  CHECK(changes.small_cells == 1);
  CHECK(changes.small_cell == 5);
}

TEST_CASE("short edges behind the boundary are lengthened") {
  // The circumcentre of the first three is just inside the northern side.
  const Surface sea = region_of({square(0, 0, 10)});
  const Points3 points =
      ring_of({{-4, 4}, {4, 4}, {0, 9.9 - std::hypot(4, 5.9)}, {-6, -6}, {6, -6}, {0, -8}});
  const Mesh mesh = delaunay(points, sea);
  const auto shortest = [](const Voronoi& cells) {
    double least = 10;
    for (Eigen::Index e = 0; e < cells.dv.size(); ++e)
      if (cells.cells_on_edge(1, e) >= 0)
        least = std::min(least, cells.dv[e] / cells.dc[e]);
    return least;
  };
  CHECK(shortest(voronoi(mesh)) < 0.05);
  const CoastalCells coastal = coastal_cells(mesh);
  check_complex(coastal.voronoi);
  CHECK(coastal.changes.moved_ends == 1);
  CHECK(shortest(coastal.voronoi) > 0.199);
}

TEST_CASE("edges on the boundary have a length") {
  const Surface sea = region_of({square(0, 0, 10)});
  const auto shortest = [](const Voronoi& cells) {
    double least = 10;
    for (Eigen::Index e = 0; e < cells.dv.size(); ++e)
      if (cells.cells_on_edge(1, e) < 0)
        least =
            std::min(least, cells.dv[e] / std::sqrt(cells.cell_area[cells.cells_on_edge(0, e)]));
    return least;
  };
  // The first cell has its tip between the next two, where these meet the northern side.
  int found = 0;
  for (double latitude = 1.8; latitude < 2.2; latitude += 0.002) {
    const Points3 points =
        ring_of({{0, 0}, {-6, latitude}, {6, latitude}, {-6, -6}, {6, -6}, {0, -8}});
    const Mesh mesh = delaunay(points, sea);
    if (!(shortest(voronoi(mesh)) < 0.04))
      continue;
    ++found;
    const CoastalCells coastal = coastal_cells(mesh);
    check_complex(coastal.voronoi);
    CHECK(coastal.changes.moved_ends == 2);
    CHECK(shortest(coastal.voronoi) > 0.049);
    CHECK(coastal.changes.hidden_cells == 0);
    CHECK(least_kite(coastal.voronoi) > 0);
  }
  CHECK(found > 3);
}

TEST_CASE("coastal cells of unsuitable arguments are refused in one line") {
  const Surface sea = region_of({square(0, 0, 20)});
  const Points3 points = random_points(40, sea, {}, 2);
  const Mesh mesh = delaunay(points, sea);
  CHECK(refusal_of([&] { coastal_cells(delaunay(points)); }).find("no boundary") !=
        std::string::npos);
  CHECK(refusal_of([&] { coastal_cells(mesh, {.straightness = -1}); }).find("straightness") !=
        std::string::npos);
  CHECK(refusal_of([&] { coastal_cells(mesh, {.least_edge = 0.6}); }).find("0 to 0.5") !=
        std::string::npos);
  CHECK(refusal_of([&] {
          coastal_cells(mesh, {.least_edge = std::numeric_limits<double>::quiet_NaN()});
        }).find("0 to 0.5") != std::string::npos);
  Points3 outside = points;
  outside.col(7) = ring_of({{50, 0}});
  const Error error = error_of([&] { voronoi(delaunay(outside, sea)); });
  CHECK(error.index() == 7);
}
