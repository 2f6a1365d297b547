// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>
#include <calotte/checkpoint.h>
#include <calotte/cvt.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include "cvt/cvt.h"
#include "support/constants.h"
#include "support/files.h"
#include "support/joined.h"
#include "support/laws.h"
#include "support/starts.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

const Eigen::Vector3d centre(0.6, 0, 0.8);

/// Points here and there, and a cluster of some that are nearer to each other than cells are wide.
Points3 stations(std::int64_t cells) {
  const double h = std::sqrt(4 * pi / static_cast<double>(cells));
  Points3 points(3, 12);
  points.leftCols(8) = random_points(8, circle(centre, 30 * degree), {}, 5);
  points.rightCols(4) = random_points(4, circle(centre, h / 2), {}, 6);
  return points;
}

CvtOptions fixing(std::int64_t fixed) {
  CvtOptions options;
  options.fixed = fixed;
  return options;
}

/// Lloyd's map of generators, none of which is held.
Points3 centroids(const Points3& points, const Surface& region, CvtOptions options) {
  options.fixed = options.insertion_rounds = 0;
  options.cells = options.bisections = 0;
  options.well_centred = false;
  options.method = Method::lloyd;
  options.norm = Norm::none;
  options.max_iterations = 1;
  options.rule = options.final_rule;
  return cvt(points, region, options).mesh.points;
}

/// The fixed generators keep their bits; the others are centroids within the tolerance of the run.
void check_fixed_and_centroids(const Cvt& grid, const Points3& fixed, const Surface& region,
                               const CvtOptions& options) {
  const Eigen::Index f = fixed.cols(), n = grid.mesh.points.cols();
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points.leftCols(f) == fixed);
  const Points3 moved = centroids(grid.mesh.points, region, options);
  const double h = std::sqrt(region.area() / static_cast<double>(n));
  const double rms =
      std::sqrt((moved - grid.mesh.points).rightCols(n - f).squaredNorm() / static_cast<double>(n));
  CHECK(rms <= 1.5 * options.tolerance * h); // the last step goes to the centroids
}

CvtOptions graded_with_fixed(std::int64_t cells, std::int64_t fixed, int bisections) {
  CvtOptions options = fixing(fixed);
  options.density = tanh_bump(centre, 20 * degree, 10 * degree, 1.0 / 81);
  options.cells = cells;
  options.insertion_rounds = 1;
  options.bisections = bisections;
  options.tolerance = 1e-5;
  return options;
}

std::string message_of(const Points3& start, const Surface& region, const CvtOptions& options) {
  try {
    cvt(start, region, options);
    return "";
  } catch (const Error& error) {
    return error.what() + (" @" + std::to_string(error.index()));
  }
}

} // namespace

TEST_CASE("fixed generators keep their bits, and all others are centroids") {
  const Points3 fixed = stations(400);
  for (const Surface& region : {Surface(), circle(centre, 35 * degree)}) {
    const Points3 start = joined(fixed, random_points(388, region));
    for (const Method method : {Method::automatic, Method::lloyd}) {
      CvtOptions options = fixing(12);
      options.method = method;
      options.tolerance = 1e-4;
      options.max_iterations = 20000;
      const Cvt grid = cvt(start, region, options);
      CHECK(grid.mesh.points.cols() == 400);
      check_fixed_and_centroids(grid, fixed, region, options);
      if (region.is_whole_sphere())
        CHECK(check(grid.mesh).failure == "");
    }
  }
}

TEST_CASE("fixed generators of any norm are normalised once") {
  Points3 fixed = 7.3 * stations(400);
  const Cvt once = cvt(joined(fixed, random_sphere(100)), {}, fixing(12));
  CHECK((once.mesh.points.leftCols(12) - fixed / 7.3).cwiseAbs().maxCoeff() < 1e-15);
  fixed = once.mesh.points.leftCols(12);
  const Cvt again = cvt(once.mesh.points, {}, fixing(12));
  CHECK(again.mesh.points.leftCols(12) == fixed);
}

TEST_CASE("fixed generators only: nothing moves") {
  const Points3 all = random_sphere(50);
  const Cvt grid = cvt(all, {}, fixing(50));
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points == all);
}

// Slow: all stages of a run, on the sphere and in a region.
TEST_CASE("fixed generators through bisections, insertion and a finish [slow]") {
  const std::int64_t cells = 3000;
  const Points3 fixed = stations(cells);
  for (const Surface& region : {Surface(), circle(centre, 35 * degree)}) {
    CvtOptions options = graded_with_fixed(cells, 12, 0);
    const test::FirstGenerators from = test::multilevel(cells, region, options.density, 1, fixed);
    CHECK(from.bisections > 0);
    options.bisections = from.bisections;
    const Points3 start = joined(fixed, from.start);
    const Cvt grid = cvt(start, region, options);
    CHECK(grid.mesh.points.cols() == cells);
    check_fixed_and_centroids(grid, fixed, region, options);
    options.well_centred = true;
    options.tolerance = 3e-4;
    const Cvt finished = cvt(start, region, options);
    CHECK(finished.mesh.points.leftCols(12) == fixed);
    CHECK(finished.mesh.points.cols() == cells);
  }
}

// Slow: a run for each number of threads and of regions, and for each interruption.
TEST_CASE("fixed generators: the same bits for all threads and regions, and resumed [slow]") {
  const std::int64_t cells = 1200;
  const Points3 fixed = stations(cells);
  const Scratch scratch;
  for (const Surface& region : {Surface(), circle(centre, 35 * degree)}) {
    CvtOptions options = graded_with_fixed(cells, 12, 0);
    options.well_centred = true;
    options.tolerance = 3e-4;
    const test::FirstGenerators from = test::multilevel(cells, region, options.density, 1, fixed);
    options.bisections = from.bisections;
    const Points3 start = joined(fixed, from.start);
    const auto with = [&](std::size_t threads, int regions) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      CvtOptions here = options;
      here.partition.regions = regions;
      return cvt(start, region, here);
    };
    const Cvt one = with(1, 1);
    CHECK(identical(one.mesh, with(2, 12).mesh));
    CHECK(identical(one.mesh, with(4, 42).mesh));
    std::vector<CvtState> states;
    cvt(start, region, options, [&](const CvtProgress& now) {
      states.push_back(now.state);
      return false;
    });
    for (std::size_t k = 5; k < states.size(); k += states.size() / 4) {
      write_checkpoint(scratch / "run.ckpt", states[k], "same");
      const CvtState state = read_checkpoint(scratch / "run.ckpt", "same");
      CHECK(identical(cvt(state, region, options).mesh, one.mesh));
    }
  }
}

TEST_CASE("fixed generators in the plane") {
  for (const Surface& domain : {rectangle({0, 0}, {4, 3}), Surface::periodic({4, 3})}) {
    const Points3 fixed = random_points(9, domain, {}, 3);
    const test::FirstGenerators from = test::multilevel(900, domain, {}, 1, fixed);
    CvtOptions options = fixing(9);
    options.insertion_rounds = 1;
    options.cells = 900;
    options.bisections = from.bisections;
    options.tolerance = 1e-4;
    const Cvt grid = cvt(joined(fixed, from.start), domain, options);
    CHECK(grid.report.converged);
    CHECK(grid.mesh.points.cols() == 900);
    CHECK(grid.mesh.points.leftCols(9) == fixed);
    CvtOptions once;
    once.method = Method::lloyd;
    once.norm = Norm::none;
    once.max_iterations = 1;
    Points3 apart = cvt(grid.mesh.points, domain, once).mesh.points - grid.mesh.points;
    for (int k = 0; k < 2 && domain.is_box(); ++k)
      apart.row(k) = apart.row(k).unaryExpr(
          [&](double d) { return d - domain.period()[k] * std::round(d / domain.period()[k]); });
    CHECK(apart.rightCols(891).norm() <= 1.5 * options.tolerance * std::sqrt(12.0));
  }
}

TEST_CASE("fixed generators: bad input is one clear line with the index") {
  const Surface region = circle(centre, 35 * degree);
  Points3 start = random_points(60, region);
  CHECK(message_of(start, region, fixing(61)) ==
        "fixed is 61; give 0 to 60, the number of generators of the start @-1");
  CHECK(message_of(start, region, fixing(-1)).find("fixed is -1; give 0 to 60") == 0);
  CvtOptions few = fixing(20);
  few.insertion_rounds = 1;
  few.cells = 15;
  CHECK(message_of(start, region, few).find("fixed generator 15 is beyond the 15 cells") == 0);
  start.col(7) = 2 * start.col(3);
  for (const Surface& place : {region, Surface{}})
    CHECK(message_of(start, place, fixing(10)) ==
          "fixed generator 7 merges with fixed generator 3: give it once @7");
  CHECK(message_of(start, region, fixing(7)) == ""); // a free one merges with a fixed one
  start.col(4) = -centre;
  CHECK(message_of(start, region, fixing(10)).find("fixed generator 4 is outside the region") == 0);
  CHECK(message_of(start, region, fixing(2)).find("generator 4 is outside the region") == 0);
  CHECK_THROWS_AS(test::multilevel(100, {}, Density{}, 1, random_sphere(100)), Error);
}

namespace {

/// Widths of 1 far from the centre, and of a quarter near it.
Density quarter_widths() { return tanh_bump(centre, 12 * degree, 3 * degree, 1.0 / 256); }

/// The cells of a uniform grid that are not near the centre.
Points3 kept_cells(std::int64_t cells) {
  const Points3 grid = cvt(geodesic_sphere(cells), {}).mesh.points;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < grid.cols(); ++i)
    if (grid.col(i).dot(centre) < std::cos(24 * degree))
      kept.push_back(i);
  return grid(Eigen::all, kept);
}

/// The cells that the density demands in all and near the centre, where a uniform grid of some
/// cells meets it elsewhere: integrals of its square root.
struct Demand {
  std::int64_t all;
  double near;
};

Demand demand_of(const Density& density, std::int64_t around) {
  const Points3 samples = random_sphere(200000, 7);
  const Eigen::VectorXd cells = evaluate(density, samples).cwiseSqrt() * 16 *
                                static_cast<double>(around) / static_cast<double>(samples.cols());
  const auto is_near = (centre.transpose() * samples).array() >= std::cos(24 * degree);
  return {std::llround(cells.sum()), is_near.select(cells.transpose().array(), 0).sum()};
}

/// The smallest distance from one of the columns to those of the others.
double nearest(const Points3& columns, const Points3& others) {
  double least = 2;
  for (const auto& p : columns.colwise())
    least = std::min(least, (others.colwise() - p).colwise().norm().minCoeff());
  return least;
}

} // namespace

TEST_CASE("fixed generators: free ones start where these leave the density unmet") {
  const std::int64_t around = 2562;
  const Points3 fixed = kept_cells(around);
  const Density density = quarter_widths();
  const Demand demand = demand_of(density, around);
  const std::int64_t cells = grids_detail::cells_beside(fixed, demand.all, density, {});
  CHECK(std::abs(static_cast<double>(cells - fixed.cols()) - demand.near) < 0.05 * demand.near);

  const test::FirstGenerators from = test::multilevel(cells, {}, density, 1, fixed);
  CHECK(from.start.cols() == cells - fixed.cols());
  for (const auto& p : from.start.colwise())
    CHECK(p.dot(centre) > std::cos(25 * degree)); // a cell is 4 degrees wide
  CHECK(test::multilevel(cells, {}, density, 1, fixed).start == from.start);
  CHECK(test::multilevel(cells, {}, density, 2, fixed).start != from.start);
}

TEST_CASE("fixed generators: all free ones find a place where no gap is left") {
  const Points3 fixed = cvt(geodesic_sphere(642), {}).mesh.points;
  const test::FirstGenerators from = test::multilevel(700, {}, Density{}, 1, fixed);
  CHECK(from.start.cols() == 58);
  CHECK(nearest(from.start, fixed) > 0); // the farthest places, which are distinct from them
  CHECK(grids_detail::cells_beside(fixed, 642, Density{}, {}) == 642);
}

// Slow: 10 242 generators, with a finish.
TEST_CASE("fixed generators: a refined part of a grid is well-centred [slow]") {
  const Points3 fixed = kept_cells(10242);
  CvtOptions options;
  options.density = quarter_widths();
  options.fixed = fixed.cols();
  options.cells =
      grids_detail::cells_beside(fixed, demand_of(options.density, 10242).all, options.density, {});
  options.insertion_rounds = 3;
  options.well_centred = true;
  options.tolerance = 1e-4;
  const test::FirstGenerators from = test::multilevel(options.cells, {}, options.density, 1, fixed);
  options.bisections = from.bisections;
  const Cvt grid = cvt(joined(fixed, from.start), {}, options);
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points.leftCols(fixed.cols()) == fixed);
  CHECK(check(grid.mesh).passed());
  // No cell is squeezed: of a start anywhere, thousands are.
  CHECK(grid.report.cells_beyond_limits <= 2);
  CHECK(grid.report.iterations.back().shape_excess < 0.1);
}

TEST_CASE("fixed generators: rounds end where a hole has room for fewer than it starts with") {
  constexpr int side = 5; // a lattice without its middle, in whose place there are four
  const double height = std::sqrt(0.75);
  const Eigen::Vector2d middle(2.25, 2.5 * height);
  Points3 start = Points3::Zero(3, side * side - 1 + 4);
  Eigen::Index next = 0;
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c)
      if (r != 2 || c != 2)
        start.col(next++).head<2>() << c + 0.25 + 0.5 * (r % 2), (r + 0.5) * height;
  CvtOptions options;
  options.fixed = next;
  options.cells = next + 1;
  options.boundary = Boundary::generators;
  options.well_centred = true;
  options.tolerance = 1e-4;
  options.density.kind = Density::Kind::callable;
  options.density.callable = [](const Eigen::Ref<const Points3>& x,
                                Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (-0.4 * x.row(0).transpose()).array().exp();
  };
  for (const auto& [x, y] : {std::array{-0.3, 0.0}, {0.3, 0.0}, {0.0, 0.3}, {0.0, -0.3}})
    start.col(next++).head<2>() = middle + Eigen::Vector2d(x, y);
  for (const int rounds : {1, 3}) {
    options.insertion_rounds = rounds;
    const Cvt grid = cvt(start, rectangle({0, 0}, {side + 0.5, side * height}), options,
                         [](const CvtProgress& now) { return now.report.iterations.size() > 500; });
    CHECK(grid.report.iterations.size() < 300);
    CHECK(grid.mesh.points.cols() == options.cells);
  }
}

TEST_CASE("fixed generators in the plane: free ones start where these leave room") {
  for (const Surface& domain : {rectangle({0, 0}, {4, 3}), Surface::periodic({4, 3})}) {
    CvtOptions once;
    once.tolerance = 1e-3;
    const Points3 grid = cvt(random_points(600, domain), domain, once).mesh.points;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < grid.cols(); ++i)
      if (grid(0, i) < 3)
        kept.push_back(i);
    const Points3 fixed = grid(Eigen::all, kept);
    const test::FirstGenerators from = test::multilevel(600, domain, {}, 1, fixed);
    CHECK(from.start.cols() == 600 - fixed.cols());
    const double inside = (from.start.row(0).array() > 2.9).cast<double>().sum();
    CHECK(inside > 0.9 * static_cast<double>(from.start.cols()));
    // The gap is a quarter of the domain; the fixed cells at its edge lie half outside of it.
    CHECK(std::abs(static_cast<double>(grids_detail::cells_beside(fixed, 600, {}, domain)) - 600) <
          20);
  }
}
