// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/errors.h"
#include "support/parts.h"
#include "support/random.h"

#include <calotte/boundary.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

// The sites of the boundary in a region, and near lines.

using namespace calotte;
using namespace calotte::test;

namespace {

Eigen::Vector3d at(double longitude, double latitude) {
  return from_lonlat(Eigen::Vector2d(longitude, latitude));
}

/// The sphere without a cap around the north pole and an island.
Mesh sea() {
  const Mesh whole = delaunay(fibonacci_sphere(1500));
  return part_of(whole, [&](std::int64_t t) {
    for (const std::int32_t site : whole.triangles.col(t))
      if (whole.points(2, site) > 0.8 || whole.points.col(site).dot(at(40, -10)) > 0.97)
        return false;
    return true;
  });
}

/// By site of the boundary, the lengths of its outer edges, by the definition.
std::vector<std::vector<double>> lengths_by_definition(const Mesh& mesh) {
  std::vector<std::vector<double>> lengths(static_cast<std::size_t>(mesh.points.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (mesh.neighbours(i, t) < 0) {
        const std::int32_t a = mesh.triangles((i + 1) % 3, t), b = mesh.triangles((i + 2) % 3, t);
        const double length = std::acos(mesh.points.col(a).dot(mesh.points.col(b)));
        for (const std::int32_t site : {a, b})
          lengths[static_cast<std::size_t>(site)].push_back(length);
      }
  return lengths;
}

std::vector<std::int32_t> list(const Ids& ids) { return {ids.begin(), ids.end()}; }

} // namespace

TEST_CASE("those in a region are the sites of the boundary that it contains") {
  const Mesh mesh = sea();
  const auto lengths = lengths_by_definition(mesh);
  const Surface region = circle(at(40, 0), 0.6, 90);
  std::vector<std::int32_t> expected;
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i)
    if (!lengths[static_cast<std::size_t>(i)].empty() && region.contains(mesh.points.col(i)))
      expected.push_back(i);
  CHECK(expected.size() > 10);
  CHECK(list(boundary_sites(mesh, region)) == expected);
  CHECK(boundary_sites(mesh, circle(at(200, -50), 0.2, 90)).size() == 0); // inside the mesh
}

TEST_CASE("those near a line lie within half of the mean of their edges") {
  const Mesh mesh = sea();
  const auto lengths = lengths_by_definition(mesh);
  Points3 line(3, 91); // along the rim of the cap, by a hair off it
  for (int k = 0; k <= 90; ++k)
    line.col(k) = at(k, std::asin(0.76) * 180 / std::numbers::pi);
  std::vector<std::int32_t> expected;
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i) {
    const auto& edges = lengths[static_cast<std::size_t>(i)];
    double distance = 10;
    for (int k = 0; k < 90; ++k)
      for (int part = 0; part <= 50; ++part) // closer than the margin below
        distance = std::min(distance, std::acos(std::min(1.0, ((1 - part / 50.0) * line.col(k) +
                                                               part / 50.0 * line.col(k + 1))
                                                                  .normalized()
                                                                  .dot(mesh.points.col(i)))));
    double half = 0;
    for (const double edge : edges)
      half += edge / 2 / static_cast<double>(edges.size());
    if (!edges.empty())
      REQUIRE(std::abs(distance - half) > 1e-6); // the test is clear
    if (!edges.empty() && distance < half)
      expected.push_back(i);
  }
  CHECK(expected.size() > 5);
  CHECK(list(boundary_sites(mesh, std::vector<Points3>{line})) == expected);
}

TEST_CASE("in a plane, too; a closed mesh has none; a mesh without neighbours is refused") {
  Points2 corners(2, 5);
  corners << 0, 4, 4, 0, 2, 0, 0, 4, 4, 2;
  const Mesh square = delaunay(corners, Surface::plane());
  Points3 side(3, 2);
  side << -1, 5, 1, 1, 0, 0;
  CHECK(list(boundary_sites(square, std::vector<Points3>{side})) ==
        std::vector<std::int32_t>{0, 1});
  const Mesh closed = delaunay(fibonacci_sphere(50));
  CHECK(boundary_sites(closed, circle(at(0, 0), 1, 90)).size() == 0);
  Mesh broken = square;
  broken.neighbours.resize(3, 0);
  CHECK(code_of([&] { boundary_sites(broken, std::vector<Points3>{side}); }) ==
        ErrorCode::invalid_argument);
}
