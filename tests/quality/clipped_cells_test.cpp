// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/errors.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace calotte;
using namespace calotte::test;

namespace {

/// A square with a corner at every multiple of 90 degrees from `turn`.
Surface square(double turn) {
  Points2 corners(2, 4);
  for (int i = 0; i < 4; ++i) {
    const double angle = turn + std::numbers::pi / 2 * i;
    corners.col(i) << std::cos(angle), std::sin(angle);
  }
  return Surface::plane().within({corners});
}

std::int64_t sum(const std::vector<std::int64_t>& counts) {
  std::int64_t total = 0;
  for (const std::int64_t count : counts)
    total += count;
  return total;
}

} // namespace

TEST_CASE("a cell is clipped if a side of it is on the boundary, however the boundary runs") {
  for (const double turn : {0.0, 0.3, std::numbers::pi / 4}) {
    CAPTURE(turn);
    const Surface domain = square(turn);
    const Mesh mesh = delaunay(random_points(400, domain, {}, 5), domain);
    const std::vector<bool> clipped = clipped_cells(mesh);
    const Voronoi cells = voronoi(mesh);
    std::int64_t whole = 0;
    for (Eigen::Index i = 0; i < 400; ++i) {
      const auto neighbours = cells.cells_on_cell[i];
      CHECK(clipped[static_cast<std::size_t>(i)] ==
            (std::find(neighbours.begin(), neighbours.end(), -1) != neighbours.end()));
      whole += clipped[static_cast<std::size_t>(i)] ? 0 : 1;
    }
    CHECK(sum(quality(mesh).degrees) == whole);
    CHECK(whole > 280);
  }
}

TEST_CASE("clipped cells: none in a periodic box, and all outside the domain") {
  const Surface box = Surface::periodic({2, 1});
  const Mesh periodic = delaunay(random_points(300, box, {}, 3), box);
  CHECK(clipped_cells(periodic) == std::vector<bool>(300, false));
  const Points3 outside = random_points(50, rectangle({0, 0}, {1, 1}), {}, 3);
  CHECK(clipped_cells(delaunay(outside, rectangle({2, 2}, {3, 3}))) == std::vector<bool>(50, true));
}

TEST_CASE("clipped cells: two equal points have no cells") {
  const Surface square = rectangle({0, 0}, {1, 1});
  Mesh mesh = delaunay(random_points(20, square, {}, 3), square);
  mesh.points.col(5) = mesh.points.col(3);
  const Error error = test::error_of([&] { clipped_cells(mesh); });
  CHECK(error.code() == ErrorCode::duplicate);
  CHECK(error.index() == 5);
}
