// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <span>
#include <vector>

using namespace calotte;

namespace {

Polygons cells_on(const Surface& surface, std::int64_t count) {
  return polygons_of(voronoi(delaunay(random_points(count, surface, {}, 3), surface)));
}

/// The first cells.
Polygons some(Polygons cells, std::int64_t count) {
  cells.ids.begin.conservativeResize(count + 1);
  cells.ids.items.conservativeResize(cells.ids.begin[count]);
  cells.centres.conservativeResize(3, count);
  return cells;
}

} // namespace

TEST_CASE("Voronoi cells are what they are on each surface, and parts of them have a boundary") {
  const Polygons sphere = cells_on(Surface::sphere(), 300);
  CHECK(not_voronoi(sphere).fault == CellFault::none);
  CHECK(not_voronoi(sphere).text().empty());
  const CheckReport found = check(sphere);
  CHECK(found.failure.empty());
  CHECK(found.sites == 300);
  CHECK(found.area == doctest::Approx(4 * std::numbers::pi));
  CHECK(found.expected_area == 4 * std::numbers::pi);
  CHECK(not_voronoi(cells_on(Surface::periodic({2, 1}), 200)).fault == CellFault::none);
  const Polygons plane = cells_on(rectangle({0, 0}, {2, 1}), 200);
  CHECK(plane.surface.is_bounded());
  for (const Polygons& part : {some(sphere, 280), plane}) {
    CHECK(not_voronoi(part).fault == CellFault::open);
    CHECK(check(part).passed());
    CHECK(check(part).expected_area == 0);
  }
}

TEST_CASE("the first fault of cells has its cell and its size") {
  const Polygons cells = cells_on(Surface::sphere(), 300);
  Polygons other = cells;
  other.centres.resize(3, 0);
  CHECK(not_voronoi(other).fault == CellFault::no_centres);
  other = cells;
  other.centres.col(7) = other.centres.col(8);
  const NotVoronoi doubled = not_voronoi(other);
  CHECK(doubled.fault == CellFault::other_number);
  CHECK(doubled.polygons == 300);
  CHECK(doubled.centres == 299);
  CHECK(doubled.text() == "there are 300 cells, but 299 distinct centres");
  other = cells;
  const auto ids = other.ids[5];
  other.corners.col(ids[0]) =
      (0.99 * other.corners.col(ids[0]) + 0.01 * other.centres.col(5)).normalized();
  const auto has_it = [&](std::int64_t i) { return std::ranges::count(other.ids[i], ids[0]) > 0; };
  std::int64_t first = 0;
  while (!has_it(first))
    ++first;
  const NotVoronoi moved = not_voronoi(other);
  CHECK(moved.fault == CellFault::other_corner);
  CHECK(moved.cells[0] == first);
  CHECK(moved.distance > 1e-6);
  CHECK(moved.distance < 0.1);
  CHECK(check(other).failure == "the cells are not Voronoi cells: " + moved.text());
  Polygons part = some(other, 280);
  CHECK(not_voronoi(part).fault == CellFault::not_circumcentres);
}

TEST_CASE("cells in a plane name the three whose corner is elsewhere") {
  Polygons cells = cells_on(rectangle({0, 0}, {2, 1}), 200);
  std::vector<std::vector<std::int64_t>> at(static_cast<std::size_t>(cells.corners.cols()));
  for (std::int64_t i = 0; i < cells.size(); ++i)
    for (const std::int32_t id : cells.ids[i])
      at[static_cast<std::size_t>(id)].push_back(i);
  const auto corner = std::ranges::find_if(at, [](const auto& of) { return of.size() == 3; });
  REQUIRE(corner != at.end());
  cells.corners(0, corner - at.begin()) += 1e-3;
  const NotVoronoi moved = not_voronoi(cells);
  CHECK(moved.fault == CellFault::common_corner);
  std::vector<std::int64_t> named(moved.cells.begin(), moved.cells.end());
  std::ranges::sort(named);
  CHECK(named == *corner);
  CHECK(moved.distance > 1e-3);
  CHECK(moved.distance <= 1.001e-3 / 0.1); // cells are as wide as 0.1
}

TEST_CASE("cells that run clockwise or overlap are no Voronoi cells") {
  Polygons turned = cells_on(Surface::sphere(), 100);
  std::ranges::reverse(turned.ids[4]);
  CHECK(check(turned).failure == "cell 4 runs clockwise seen from outside");
  Polygons twice = some(cells_on(Surface::sphere(), 100), 99);
  const std::span<const std::int32_t> first = twice.ids[0];
  std::vector<std::int32_t> items(twice.ids.items.begin(), twice.ids.items.end());
  items.insert(items.end(), first.begin(), first.end());
  twice.ids.items = Eigen::Map<const Ids>(items.data(), std::ssize(items));
  twice.ids.begin.conservativeResize(101);
  twice.ids.begin[100] = std::ssize(items);
  twice.centres.conservativeResize(3, 100);
  twice.centres.col(99) = twice.centres.col(0);
  CHECK(check(twice).failure == "cell 0 and cell 99 overlap, as both lie to the left of one side");
}
