// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "support/directions.h"
#include "support/errors.h"

#include <calotte/check.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

/// A polygon with a reflex corner, and a hole.
Surface holed() {
  return Surface::sphere().within(
      {directions({{0, 0}, {40, 0}, {40, 30}, {25, 30}, {20, 15}, {0, 25}}),
       directions({{28, 8}, {28, 16}, {35, 16}, {35, 8}})});
}

Density bump_at_the_hole() { return tanh_bump(direction(30, 5), 8 * degree, 5 * degree, 1.0 / 81); }

struct Case {
  std::string name;
  Surface region;
  Density density;
};

std::vector<Case> cases() {
  return {{"circle", circle(direction(10, 20), 12 * degree), {}},
          {"hemisphere", circle(direction(10, 20), 90 * degree), {}},
          {"polygon with a hole", holed(), {}},
          {"graded", holed(), bump_at_the_hole()}};
}

/// The arcs' distance from a place, as a sine.
double distance(const Surface& region, const Eigen::Vector3d& x) {
  double least = 4;
  for (const DoubleMatrix& ring : region.rings())
    for (Eigen::Index k = 0; k < ring.cols(); ++k) {
      const Eigen::Vector3d a = ring.col(k).normalized(),
                            b = ring.col(k + 1 == ring.cols() ? 0 : k + 1).normalized(),
                            normal = a.cross(b - a).normalized(); // precise for short arcs
      const bool beside = normal.cross(a).dot(x) >= 0 && b.cross(normal).dot(x) >= 0;
      least =
          std::min({least, beside ? std::abs(normal.dot(x)) : 4, (x - a).norm(), (x - b).norm()});
    }
  return least;
}

/// The distance of neighbours that the density demands at a place: rho^(-1/4) times a factor, which
/// is the mean over the edges of the mesh.
double demanded(const Mesh& mesh, const Density& density, const Eigen::Vector3d& x) {
  const double rho = evaluate(density, Points3(x))[0];
  const Eigen::VectorXd all = evaluate(density, mesh.points);
  double sum = 0, count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v) {
      const auto a = mesh.triangles(v, t), b = mesh.triangles((v + 1) % 3, t);
      sum += (mesh.points.col(a) - mesh.points.col(b)).norm() * std::pow(all[a] * all[b], 0.125);
      ++count;
    }
  return sum / count * std::pow(rho, -0.25);
}

using DirectedEdge = std::pair<std::int32_t, std::int32_t>;

/// The outer edges of a mesh, each with the mesh to its left.
std::set<DirectedEdge> outer_edges(const Mesh& mesh) {
  std::set<DirectedEdge> edges;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (mesh.neighbours(v, t) < 0)
        edges.insert({mesh.triangles((v + 1) % 3, t), mesh.triangles((v + 2) % 3, t)});
  return edges;
}

double least_angle(const Mesh& mesh) {
  double least = 180;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v) {
      const Eigen::Vector3d c = mesh.points.col(mesh.triangles(v, t)),
                            a = mesh.points.col(mesh.triangles((v + 1) % 3, t)) - c,
                            b = mesh.points.col(mesh.triangles((v + 2) % 3, t)) - c;
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) / degree);
    }
  return least;
}

Recipe ending_at_generators(const Case& here, std::int64_t cells) {
  return {.cells = cells,
          .resolution = here.density,
          .surface = here.region,
          .boundary = Boundary::generators,
          .start = {.insertion_rounds = 2},
          .stop = {.tolerance = 3e-4}};
}

} // namespace

TEST_CASE("boundary: its generators lie on it, at the demanded distances, and keep the corners") {
  for (const Case& here : cases())
    for (const std::int64_t cells : {200, 1500, 20000}) {
      CAPTURE(here.name);
      CAPTURE(cells);
      const Points3 points = boundary_points(here.region, cells, here.density);
      for (Eigen::Index i = 0; i < points.cols(); ++i) {
        CHECK(here.region.contains(points.col(i)));
        CHECK(distance(here.region, points.col(i)) <= 1e-15);
      }
      if (here.region.rings().size() == 2) // few enough corners, and sharp
        for (const DoubleMatrix& ring : here.region.rings())
          for (Eigen::Index k = 0; k < ring.cols(); ++k)
            CHECK((points.colwise() - ring.col(k)).colwise().norm().minCoeff() < 1e-15);
    }
  CHECK(boundary_points({}, 100).cols() == 0);
}

// Slow: a run of 1 500 cells for each region.
TEST_CASE("boundary: the mesh ends at its generators, without slivers [slow]") {
  for (const Case& here : cases()) {
    CAPTURE(here.name);
    const std::int64_t cells = 1500;
    const Points3 boundary = boundary_points(here.region, cells, here.density);
    const Cvt grid = make_grid(ending_at_generators(here, cells));
    const Mesh& mesh = grid.mesh;
    const auto f = static_cast<std::int32_t>(boundary.cols());
    CHECK(grid.report.converged);
    CHECK(mesh.points.cols() == cells);
    // Those of the boundary may slide along it.
    for (std::int32_t i = 0; i < f; ++i) {
      CHECK(distance(here.region, mesh.points.col(i)) <= 1e-15);
      CHECK((mesh.points.col(i) - boundary.col(i)).norm() <
            0.5 * demanded(mesh, here.density, boundary.col(i)));
    }
    CHECK(check_surface(mesh).failure == "");
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
      CAPTURE(i);
      CHECK(here.region.contains(mesh.points.col(i)));
    }
    // Each edge along the boundary joins a generator to the next one of its ring; rings close.
    const std::set<DirectedEdge> outer = outer_edges(mesh);
    CHECK(std::ssize(outer) == f);
    std::size_t returns = 0;
    double shortest = 1e9, longest = 0;
    for (const auto& [a, b] : outer) {
      CHECK(std::max(a, b) < f);
      returns += b != a + 1;
      const Eigen::Vector3d middle = (mesh.points.col(a) + mesh.points.col(b)).normalized();
      const double ratio =
          (mesh.points.col(a) - mesh.points.col(b)).norm() / demanded(mesh, here.density, middle);
      shortest = std::min(shortest, ratio);
      longest = std::max(longest, ratio);
    }
    CHECK(returns == here.region.rings().size());
    CHECK(shortest > 0.6); // 5/8 and 5/4, and rounding by the mean of the widths
    CHECK(longest < 1.3);
    // Every generator is in the mesh, whose Euler characteristic is that of the region.
    std::set<std::int32_t> used(mesh.triangles.data(),
                                mesh.triangles.data() + mesh.triangles.size());
    CHECK(std::ssize(used) == cells);
    CHECK(mesh.triangles.cols() == 2 * cells - f - 2 + 2 * (std::ssize(here.region.rings()) - 1));
    CHECK(least_angle(mesh) > 35);
  }
}

// Slow: a run for each number of threads and of regions.
TEST_CASE("boundary: the same bits for all threads and regions [slow]") {
  for (const std::int64_t cells : {900, 3000}) { // 3000: after a bisection
    const Recipe recipe = ending_at_generators(cells < 1000 ? cases().back() : cases()[0], cells);
    const Schedule schedule = plan(recipe);
    CHECK((std::ranges::count(schedule.actions, CvtAction::Kind::bisect, &CvtAction::kind) > 0) ==
          (cells > 1000));
    const auto with = [&](std::size_t threads, int regions) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return make_grid(schedule, {.decomposition = {.regions = regions}}).mesh;
    };
    const Mesh one = with(1, 1), many = with(4, 12);
    CHECK(one.points == many.points);
    CHECK(one.triangles == many.triangles);
  }
}

namespace {

/// An L with a square hole.
Surface bent() {
  DoubleMatrix ring(2, 6), hole(2, 4);
  ring << 0, 2, 2, 1, 1, 0, 0, 0, 1, 1, 2, 2;
  hole << 0.3, 0.7, 0.7, 0.3, 0.3, 0.3, 0.7, 0.7;
  return Surface::plane().within({ring, hole});
}

} // namespace

// Slow: two runs of 1 500 cells.
TEST_CASE("boundary: in the plane the mesh fills the domain to its corners [slow]") {
  for (const bool graded : {false, true}) {
    CAPTURE(graded);
    Recipe recipe;
    recipe.surface = bent();
    recipe.boundary = Boundary::generators;
    recipe.cells = 1500;
    if (graded)
      recipe.resolution =
          density_of([](const Eigen::Vector3d& x) { return std::pow(1 + x.squaredNorm(), -4); });
    const Schedule schedule = plan(recipe);
    const Cvt grid = make_grid(schedule);
    const Mesh& mesh = grid.mesh;
    const auto b = schedule.on_boundary;
    for (const DoubleMatrix& ring : recipe.surface.rings())
      for (const auto& corner : ring.colwise())
        CHECK((mesh.points.topRows<2>().colwise() - corner).colwise().norm().minCoeff() == 0);
    CHECK(check_surface(mesh).area == doctest::Approx(recipe.surface.area()).epsilon(1e-12));
    CHECK(std::ssize(outer_edges(mesh)) == b);
    CHECK(mesh.triangles.cols() == 2 * 1500 - b); // a ring: Euler's characteristic is 0
    CHECK(least_angle(mesh) > 33);
    CHECK(grid.report.converged);
  }
}

TEST_CASE("boundary: in the plane the same bits for all threads and regions") {
  Recipe recipe;
  recipe.surface = bent();
  recipe.boundary = Boundary::generators;
  recipe.cells = 400;
  const auto with = [&](std::size_t threads, int regions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_grid(recipe, {.decomposition = {.regions = regions}}).mesh;
  };
  const Mesh one = with(1, 1), many = with(4, 12);
  CHECK(one.points == many.points);
  CHECK(one.triangles == many.triangles);
}

TEST_CASE("boundary: too few cells are refused in one line") {
  const auto message = [](std::int64_t cells) {
    return test::message_of([&] { boundary_points(holed(), cells); });
  };
  CHECK(message(8).find("the boundary takes ") == 0);
  CHECK(message(3).find("the number of cells is 3; give a number from 4 to") == 0);
}
