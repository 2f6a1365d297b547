// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>
#include <calotte/checkpoint.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include "cvt/cvt.h"
#include "grids/start.h"
#include "support/constants.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/joined.h"
#include "support/laws.h"

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
using grids_detail::cells_beside;
using grids_detail::free_generators;

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

/// Lloyd's map of generators, none of which is held, by the rule at the end of a run.
Points3 centroids(const Points3& points, const Recipe& recipe) {
  const Schedule once = plan({.resolution = recipe.resolution,
                              .surface = recipe.surface,
                              .start = {.points = points},
                              .stop = {.iterations = 1},
                              .method = Method::lloyd});
  return cvt(points, once, {.quadrature = {.rule = cvt_detail::Quadrature().final_rule}})
      .mesh.points;
}

/// The fixed generators keep their bits; the others are centroids within the tolerance of the run.
void check_fixed_and_centroids(const Cvt& grid, const Recipe& recipe) {
  const Eigen::Index f = recipe.fixed.cols(), n = grid.mesh.points.cols();
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points.leftCols(f) == recipe.fixed);
  const Points3 moved = centroids(grid.mesh.points, recipe);
  const double h = std::sqrt(recipe.surface.area() / static_cast<double>(n));
  const double rms =
      std::sqrt((moved - grid.mesh.points).rightCols(n - f).squaredNorm() / static_cast<double>(n));
  CHECK(rms <= 1.5 * *recipe.stop.tolerance * h); // the last step goes to the centroids
}

Recipe graded_with_fixed(std::int64_t cells, const Surface& region, double tolerance) {
  return {.cells = cells,
          .resolution = tanh_bump(centre, 20 * degree, 10 * degree, 1.0 / 81),
          .surface = region,
          .fixed = stations(cells),
          .start = {.insertion_rounds = 1},
          .stop = {.tolerance = tolerance}};
}

} // namespace

TEST_CASE("fixed generators keep their bits, and all others are centroids") {
  const Points3 fixed = stations(400);
  for (const Surface& region : {Surface(), circle(centre, 35 * degree)}) {
    for (const Method method : {Method::automatic, Method::lloyd}) {
      const Recipe recipe{.surface = region,
                          .fixed = fixed,
                          .start = {.points = random_points(388, region)},
                          .stop = {.tolerance = 1e-4, .max_iterations = 20000},
                          .method = method};
      const Cvt grid = make_grid(recipe);
      CHECK(grid.mesh.points.cols() == 400);
      check_fixed_and_centroids(grid, recipe);
      if (region.is_whole_sphere())
        CHECK(check(grid.mesh).failure == "");
    }
  }
}

TEST_CASE("fixed generators of any norm are normalised once") {
  const Points3 fixed = 7.3 * stations(400);
  const Points3 once =
      make_grid({.fixed = fixed, .start = {.points = random_sphere(100)}}).mesh.points;
  CHECK((once.leftCols(12) - fixed / 7.3).cwiseAbs().maxCoeff() < 1e-15);
  const Cvt again =
      make_grid({.fixed = once.leftCols(12), .start = {.points = once.rightCols(100)}});
  CHECK(again.mesh.points.leftCols(12) == once.leftCols(12));
}

TEST_CASE("fixed generators only: nothing moves") {
  const Points3 all = random_sphere(50);
  const Cvt grid = make_grid({.fixed = all, .start = {.points = all.leftCols(1)}}); // which merges
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points == all);
}

// Slow: all stages of a run, on the sphere and in a region.
TEST_CASE("fixed generators through bisections, insertion and a finish [slow]") {
  const std::int64_t cells = 3000;
  for (const Surface& region : {Surface(), circle(centre, 35 * degree)}) {
    Recipe recipe = graded_with_fixed(cells, region, 1e-5);
    recipe.stop.well_centred = false;
    const Schedule schedule = plan(recipe);
    CHECK(std::ranges::count(schedule.actions, CvtAction::Kind::bisect, &CvtAction::kind) > 0);
    const Cvt grid = make_grid(schedule);
    CHECK(grid.mesh.points.cols() == cells);
    check_fixed_and_centroids(grid, recipe);
    const Cvt finished = make_grid(graded_with_fixed(cells, region, 3e-4));
    CHECK(finished.mesh.points.leftCols(12) == recipe.fixed);
    CHECK(finished.mesh.points.cols() == cells);
  }
}

// Slow: a run for each number of threads and of regions, and for each interruption.
TEST_CASE("fixed generators: the same bits for all threads and regions, and resumed [slow]") {
  const Scratch scratch;
  for (const Surface& region : {Surface(), circle(centre, 35 * degree)}) {
    const Recipe recipe = graded_with_fixed(1200, region, 3e-4);
    const auto with = [&](std::size_t threads, int regions) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return make_grid(recipe, {.decomposition = {.regions = regions}});
    };
    const Cvt one = with(1, 1);
    CHECK(identical(one.mesh, with(2, 12).mesh));
    CHECK(identical(one.mesh, with(4, 42).mesh));
    std::vector<CvtState> states;
    const auto keep = [&](const Progress& now) {
      states.push_back(now.run->state);
      return ProgressReply::proceed;
    };
    make_grid(recipe, {.progress = keep});
    for (std::size_t k = 5; k < states.size(); k += states.size() / 4) {
      write_checkpoint(scratch / "run.ckpt", states[k], "same");
      const CvtState state = read_checkpoint(scratch / "run.ckpt", "same");
      CHECK(identical(make_grid(recipe, {.state = state}).mesh, one.mesh));
    }
  }
}

TEST_CASE("fixed generators in the plane") {
  for (const Surface& domain : {rectangle({0, 0}, {4, 3}), Surface::periodic({4, 3})}) {
    const Points3 fixed = random_points(9, domain, {}, 3);
    const Cvt grid = make_grid({.cells = 900,
                                .surface = domain,
                                .fixed = fixed,
                                .start = {.insertion_rounds = 1},
                                .stop = {.tolerance = 1e-4, .well_centred = false}});
    CHECK(grid.report.converged);
    CHECK(grid.mesh.points.cols() == 900);
    CHECK(grid.mesh.points.leftCols(9) == fixed);
    Points3 apart = centroids(grid.mesh.points, {.surface = domain}) - grid.mesh.points;
    for (int k = 0; k < 2 && domain.is_box(); ++k)
      apart.row(k) = apart.row(k).unaryExpr(
          [&](double d) { return d - domain.period()[k] * std::round(d / domain.period()[k]); });
    CHECK(apart.rightCols(891).norm() <= 1.5 * 1e-4 * std::sqrt(12.0));
  }
}

TEST_CASE("fixed generators: bad input is one clear line with the index") {
  const Surface region = circle(centre, 35 * degree);
  Points3 all = random_points(60, region);
  const auto fixing = [&](std::int64_t fixed, const Surface& surface) -> Recipe {
    return {.surface = surface,
            .fixed = all.leftCols(fixed),
            .start = {.points = all.rightCols(60 - fixed)}};
  };
  const auto message = [](const Recipe& recipe) {
    const Error error = error_of([&] { make_grid(recipe); });
    return error.what() + (" @" + std::to_string(error.index()));
  };
  CHECK(message({.cells = 15, .surface = region, .fixed = all.leftCols(20)}) ==
        "fixed point 14 leaves no free one of the 15 cells; give more cells or fewer fixed points "
        "@14");
  all.col(7) = 2 * all.col(3);
  for (const Surface& surface : {region, Surface{}})
    CHECK(message(fixing(10, surface)) ==
          "fixed generator 7 merges with fixed generator 3: give it once @7");
  CHECK_NOTHROW(make_grid(fixing(7, region))); // a free one merges with a fixed one
  all.col(4) = -centre;
  CHECK(message(fixing(10, region)).starts_with("fixed generator 4 is outside the region"));
  CHECK(message(fixing(2, region)).starts_with("generator 4 is outside the region"));
}

namespace {

/// Widths of 1 far from the centre, and of a quarter near it.
Density quarter_widths() { return tanh_bump(centre, 12 * degree, 3 * degree, 1.0 / 256); }

/// The cells of a uniform grid that are not near the centre.
Points3 kept_cells(std::int64_t cells) {
  const Points3 grid = make_grid({.start = {.points = geodesic_sphere(cells)}}).mesh.points;
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
  const std::int64_t cells = cells_beside(fixed, demand.all, density, {});
  CHECK(std::abs(static_cast<double>(cells - fixed.cols()) - demand.near) < 0.05 * demand.near);

  const auto start = [&](std::uint64_t seed) {
    return free_generators(
        plan({.cells = cells, .resolution = density, .fixed = fixed, .seed = seed}));
  };
  const Points3 free = start(1);
  CHECK(free.cols() == cells - fixed.cols());
  for (const auto& p : free.colwise())
    CHECK(p.dot(centre) > std::cos(25 * degree)); // a cell is 4 degrees wide
  CHECK(start(1) == free);
  CHECK(start(2) != free);
}

TEST_CASE("fixed generators: all free ones find a place where no gap is left") {
  const Points3 fixed = make_grid({.start = {.points = geodesic_sphere(642)}}).mesh.points;
  const Points3 free = free_generators(plan({.cells = 700, .fixed = fixed}));
  CHECK(free.cols() == 58);
  CHECK(nearest(free, fixed) > 0); // the farthest places, which are distinct from them
  CHECK(cells_beside(fixed, 642, Density{}, {}) == 642);
}

// Slow: 10 242 generators, with a finish.
TEST_CASE("fixed generators: a refined part of a grid is well-centred [slow]") {
  const Points3 fixed = kept_cells(10242);
  const Density density = quarter_widths();
  const Cvt grid =
      make_grid({.cells = cells_beside(fixed, demand_of(density, 10242).all, density, {}),
                 .resolution = density,
                 .fixed = fixed});
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
  Points3 fixed = Points3::Zero(3, side * side - 1), free = Points3::Zero(3, 4);
  Eigen::Index next = 0;
  for (int r = 0; r < side; ++r)
    for (int c = 0; c < side; ++c)
      if (r != 2 || c != 2)
        fixed.col(next++).head<2>() << c + 0.25 + 0.5 * (r % 2), (r + 0.5) * height;
  next = 0;
  for (const auto& [x, y] : {std::array{-0.3, 0.0}, {0.3, 0.0}, {0.0, 0.3}, {0.0, -0.3}})
    free.col(next++).head<2>() = middle + Eigen::Vector2d(x, y);
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (-0.4 * x.row(0).transpose()).array().exp();
  };
  for (const int rounds : {1, 3}) {
    Schedule schedule = plan({.cells = fixed.cols() + 1,
                              .resolution = density,
                              .surface = rectangle({0, 0}, {side + 0.5, side * height}),
                              .fixed = fixed,
                              .start = {.insertion_rounds = rounds}});
    schedule.recipe.boundary = Boundary::generators; // as in a patch, without more fixed ones
    const Cvt grid = cvt(joined(fixed, free), schedule, {},
                         [](const CvtProgress& now) { return now.report.iterations.size() > 500; });
    CHECK(grid.report.iterations.size() < 300);
    CHECK(grid.mesh.points.cols() == fixed.cols() + 1);
  }
}

TEST_CASE("fixed generators in the plane: free ones start where these leave room") {
  for (const Surface& domain : {rectangle({0, 0}, {4, 3}), Surface::periodic({4, 3})}) {
    const Points3 grid = make_grid({.cells = 600,
                                    .surface = domain,
                                    .start = {.kind = CvtStart::Kind::random},
                                    .stop = {.tolerance = 1e-3}})
                             .mesh.points;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < grid.cols(); ++i)
      if (grid(0, i) < 3)
        kept.push_back(i);
    const Points3 fixed = grid(Eigen::all, kept);
    const Points3 free = free_generators(plan({.cells = 600, .surface = domain, .fixed = fixed}));
    CHECK(free.cols() == 600 - fixed.cols());
    const double inside = (free.row(0).array() > 2.9).cast<double>().sum();
    CHECK(inside > 0.9 * static_cast<double>(free.cols()));
    // The gap is a quarter of the domain; the fixed cells at its edge lie half outside of it.
    CHECK(std::abs(static_cast<double>(cells_beside(fixed, 600, {}, domain)) - 600) < 20);
  }
}
