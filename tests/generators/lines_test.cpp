// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/directions.h"
#include "support/errors.h"

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using calotte::test::direction;
using calotte::test::directions;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// The distance of neighbours in a uniform grid of the sphere.
double width(double cells) { return std::sqrt(2 / std::sqrt(3.0) * 4 * std::numbers::pi / cells); }

double least_distance_of_all(const Points3& points) {
  double least = 4;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      least = std::min(least, (points.col(i) - points.col(j)).norm());
  return least;
}

double distance_to(const Points3& points, const Eigen::Vector3d& x) {
  return (points.colwise() - x).colwise().norm().minCoeff();
}

/// The largest distance of places along lines from the nearest point, place by place.
double farthest(const std::vector<Points3>& lines, const Points3& points) {
  double most = 0;
  for (const Points3& line : lines)
    for (Eigen::Index k = 1; k < line.cols(); ++k)
      for (int i = 0; i <= 400; ++i) {
        const Eigen::Vector3d x =
            ((1 - i / 400.0) * line.col(k - 1) + i / 400.0 * line.col(k)).normalized();
        most = std::max(most, distance_to(points, x));
      }
  return most;
}

std::string message_of(const std::vector<Points3>& lines, const Surface& surface = {}) {
  return test::message_of([&] { line_points(lines, surface, 1000); });
}

/// Three rivers, one over the date line, that meet at 175 E 10 N.
std::vector<Points3> rivers() {
  return {directions({{150, 30}, {160, 22}, {175, 10}}),
          directions({{-160, 35}, {-175, 25}, {175, 10}}), directions({{175, 10}, {176, -20}})};
}

} // namespace

TEST_CASE("lines: confluences and ends stay, neighbours are at the demanded distance") {
  const std::vector<Points3> lines = rivers();
  for (const std::int64_t cells : {500, 5000, 50000}) {
    CAPTURE(cells);
    const double h = width(static_cast<double>(cells));
    const LinePoints found = line_points(lines, {}, cells);
    for (const auto& [lon, lat] : {std::pair{175, 10}, {150, 30}, {-160, 35}, {176, -20}})
      CHECK(distance_to(found.points, direction(lon, lat)) < 1e-15);
    CHECK(least_distance_of_all(found.points) > 0.66 * h);
    CHECK(((found.points.colwise().norm().array() - 1).abs() < 1e-15).all());
    CHECK(found.farthest == doctest::Approx(farthest(lines, found.points) / h).epsilon(0.02));
    CHECK(found.farthest < 0.85);
  }
}

TEST_CASE("lines: how they are cut, repeated or ordered does not matter") {
  const std::vector<Points3> whole = rivers();
  std::vector<Points3> parts;
  for (const Points3& line : whole)
    for (Eigen::Index k = 1; k < line.cols(); ++k)
      parts.emplace_back(line.middleCols(k - 1, 2));
  parts.push_back(parts.front());
  const Points3 one = line_points(whole, {}, 3000).points,
                other = line_points(parts, {}, 3000).points;
  REQUIRE(one.cols() == other.cols());
  for (Eigen::Index i = 0; i < one.cols(); ++i)
    CHECK(distance_to(other, one.col(i)) < 1e-14);
}

TEST_CASE("lines: a loop has the same generators wherever it is begun or cut") {
  std::vector<std::array<double, 2>> ring;
  for (int k = 0; k < 36; ++k)
    ring.push_back({10.0 * k, 60 + 5 * std::sin(k)});
  const auto from = [&](int first, int last) {
    std::vector<std::array<double, 2>> part;
    for (int k = first; k <= last; ++k)
      part.push_back(ring[static_cast<std::size_t>(k % 36)]);
    return directions(part);
  };
  const Points3 one = line_points({from(0, 36)}, {}, 3000).points,
                other = line_points({from(20, 30), from(30, 56)}, {}, 3000).points;
  REQUIRE(one.cols() == other.cols());
  CHECK(one.cols() > 20);
  for (Eigen::Index i = 0; i < one.cols(); ++i)
    CHECK(distance_to(other, one.col(i)) < 1e-14);
}

TEST_CASE("lines: those that run side by side or cross share generators") {
  std::vector<std::array<double, 2>> north, south, across;
  for (int k = 0; k <= 20; ++k) {
    north.push_back({3.0 * k, 0.2});
    south.push_back({3.0 * k, -0.2});
    across.push_back({31 + 0.1 * k, 1.5 * k - 15});
  }
  const std::vector<Points3> lines{directions(north), directions(south), directions(across)};
  const std::int64_t cells = 2000;
  const LinePoints found = line_points(lines, {}, cells);
  CHECK(least_distance_of_all(found.points) > 0.66 * width(cells));
  CHECK(found.farthest < 1.3);
  CHECK(found.points.cols() < 1.3 * (60 + 30) * degree / width(cells));
}

TEST_CASE("lines: loops, points, the pole, and a density") {
  std::vector<std::array<double, 2>> ring;
  for (int k = 0; k <= 36; ++k)
    ring.push_back({10.0 * k, 80});
  ring.back() = ring.front();
  const std::vector<Points3> lines{directions(ring), Points3(direction(0, 90)),
                                   directions({{0, -60}, {0, 60}})};
  const Density density = tanh_bump(direction(0, 0), 20 * degree, 10 * degree, 1.0 / 256);
  const std::int64_t cells = 20000;
  const Points3 points = line_points(lines, {}, cells, density).points;
  CHECK(distance_to(points, direction(0, 90)) == 0);
  // Along the meridian cells are four times finer in the bump than far from it.
  std::vector<double> latitudes;
  for (const auto& p : points.colwise())
    if (std::abs(p.y()) < 1e-12 && p.x() > 0 && std::abs(p.z()) < 0.9)
      latitudes.push_back(std::asin(p.z()) / degree);
  std::sort(latitudes.begin(), latitudes.end());
  const auto middle = std::lower_bound(latitudes.begin(), latitudes.end(), 0);
  CHECK((latitudes[1] - latitudes[0]) / (*middle - *(middle - 1)) ==
        doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("lines: generators keep their distance from others") {
  const Points3 beside = line_points({rivers().front()}, {}, 3000).points;
  const Points3 rest = line_points(rivers(), {}, 3000, {}, beside).points;
  Points3 all(3, beside.cols() + rest.cols());
  all << beside, rest;
  CHECK(least_distance_of_all(all) > 0.66 * width(3000));
}

TEST_CASE("lines: a grid keeps them, in the plane, too") {
  Recipe recipe;
  recipe.surface = rectangle({0, 0}, {2, 1});
  recipe.cells = 600;
  Points3 line(3, 3);
  line << 0.3, 1, 1.7, 0.5, 0.6, 0.4, 0, 0, 0;
  recipe.lines = {line};
  const Schedule schedule = plan(recipe);
  CHECK(schedule.on_lines > 20);
  CHECK(schedule.recipe.fixed.cols() == schedule.on_lines);
  const Cvt grid = make_grid(schedule);
  CHECK(grid.mesh.points.cols() == 600);
  CHECK(grid.mesh.points.leftCols(schedule.on_lines) == schedule.recipe.fixed);
  CHECK(distance_to(grid.mesh.points, line.col(0)) == 0);
  CHECK(distance_to(grid.mesh.points, line.col(2)) == 0);
}

// Slow: runs to a well-centred end.
TEST_CASE("lines: cells are within the limits where they meet [slow]") {
  std::vector<Points3> lines;
  for (int k = 0; k < 12; ++k)
    for (int arm = 0; arm < 3; ++arm) {
      const double bearing = (17 * k * k + 120 * arm + 35 * std::sin(7 * k + 2 * arm)) * degree,
                   lon = 30 * k, lat = 12 * (k % 5 - 2);
      std::vector<std::array<double, 2>> line;
      for (const double far : {0, 6, 11, 16})
        line.push_back({lon + far * std::cos(bearing + far / 30) / std::cos(lat * degree),
                        lat + far * std::sin(bearing + far / 30)});
      lines.push_back(directions(line));
    }
  const Schedule schedule = plan({.cells = 5000, .lines = lines});
  const Cvt grid = make_grid(schedule);
  CHECK(grid.report.well_centred);
  const Points3 &before = schedule.recipe.fixed,
                &after = grid.mesh.points.leftCols(schedule.on_lines);
  CHECK(schedule.line_ends >= 12 * 4 - 2); // ends of lines near others go
  CHECK(after.leftCols(schedule.line_ends) == before.leftCols(schedule.line_ends));
  const auto moves = (after - before).colwise().norm();
  CHECK((moves.array() > 0).count() == grid.report.moved_on_lines);
  const double farthest = grid.report.farthest_move * width(5000);
  CHECK(std::abs(moves.maxCoeff() / farthest - 1) < 0.01); // the spacing follows from the energy
  CHECK(grid.report.moved_on_lines > 0);                   // otherwise this tests nothing
  CHECK(grid.report.moved_on_lines < schedule.on_lines / 2);
  CHECK(grid.report.farthest_move < 0.5);
}

TEST_CASE("lines: the same bits for any number of threads") {
  const Density density = tanh_bump(direction(175, 10), 20 * degree, 10 * degree, 1.0 / 256);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return line_points(rivers(), {}, 5000, density);
  };
  const LinePoints one = with(1), many = with(4);
  CHECK(one.points == many.points);
  CHECK(one.farthest == many.farthest);
}

TEST_CASE("lines: bad ones are refused in one line with line and point") {
  CHECK(message_of({directions({{0, 0}, {1, 0}}), directions({{0, 0}, {180, 0}})})
            .find("line 1, point 1 is opposite to the one before") == 0);
  Points3 zero = directions({{0, 0}, {1, 1}});
  zero.col(1).setZero();
  CHECK(message_of({zero}).find("line 0, point 1 is no direction") == 0);
  zero(0, 1) = std::nan("");
  CHECK(message_of({zero}).find("line 0, point 1 is no direction") == 0);
  CHECK(message_of({directions({{0, 0}, {30, 0}})}, circle(direction(0, 0), 10 * degree))
            .find("line 0, point 1 is outside the surface") == 0);
  CHECK(line_points({}, {}, 1000).points.cols() == 0);
  DoubleMatrix outer(2, 4), hole(2, 4);
  outer << 0, 9, 9, 0, 0, 0, 9, 9;
  hole << 3, 6, 6, 3, 3, 3, 6, 6;
  Points3 across(3, 2);
  across << 1, 8, 4, 5, 0, 0;
  CHECK(message_of({across}, Surface::plane().within({outer, hole}))
            .find("a line crosses what the surface leaves out, at ") == 0);
  CHECK(message_of({across}, Surface::periodic({9, 9})).find("lines are not followed in a") == 0);
}
