// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/cvt.h"
#include "cvt/stages.h"
#include "support/laws.h"

#include "support/densities.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/sanitizer.h"
#include "support/text.h"

#include <calotte/check.h>
#include <calotte/checkpoint.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

/// A graded run that a model could use.
Recipe graded(std::int64_t cells, const Density& density) {
  return {.cells = cells, .resolution = density, .start = {.kind = CvtStart::Kind::multilevel}};
}

Points3 random_start(std::int64_t n, const Density& density, std::uint64_t seed = 1) {
  return random_sphere(n, site_density(density), seed);
}

Density stretched_bump() {
  Density density = tanh_bump({1, 2, -1}, 0.4, 0.25, 1.0 / 256);
  density.bumps[0].stretch = 3;
  density.bumps[0].major = {0, 1, 0};
  return density;
}

Density two_bumps() {
  Density density = tanh_bump({1, 0, 0}, 0.5, 0.2, 1.0 / 256);
  density.bumps.push_back(tanh_bump({1, 1, 0}, 0.3, 0.3, 1.0 / 81).bumps[0]);
  return density;
}

/// E n over the limit of regular hexagons everywhere, less 1; its integral is from a fine lattice.
double excess(const Cvt& grid, const Density& density) {
  const Points3 lattice = fibonacci_sphere(200000);
  const double integral = 4 * std::numbers::pi * evaluate(density, lattice).cwiseSqrt().mean();
  const double limit = 5 / (18 * std::numbers::sqrt3) * integral * integral;
  return quality(grid.mesh, density).energy * static_cast<double>(grid.mesh.points.cols()) / limit -
         1;
}

void check_shapes(const Mesh& mesh) {
  const Quality q = quality(mesh);
  CHECK(q.angles.min > 36.9); // cot of 1.3 + 0.03
  CHECK(q.angles.max < 88.9); // and of 0.05 - 0.03
  CHECK(q.obtuse == 0);
  for (std::size_t degree = 0; degree < q.degrees.size(); ++degree)
    if (degree < 5 || degree > 7)
      CHECK(q.degrees[degree] == 0);
}

bool same_run(const Cvt& a, const Cvt& b) {
  return identical(a.mesh, b.mesh) && a.report.converged == b.report.converged &&
         a.report.well_centred == b.report.well_centred &&
         a.report.iterations.size() == b.report.iterations.size();
}

} // namespace

TEST_CASE("stages: insertion reaches any number of cells, from any start") {
  for (const auto& [start, bisections, cells] : {std::tuple{12, 0, 12},
                                                 {12, 0, 13},
                                                 {30, 0, 20},
                                                 {40, 0, 160},
                                                 {50, 1, 700},
                                                 {300, 1, 700},
                                                 {100, 2, 2600}}) {
    CAPTURE(start);
    CAPTURE(cells);
    Recipe recipe = graded(cells, two_bumps());
    recipe.stop.tolerance = 1e-4;
    recipe.stop.well_centred = false;
    const Schedule schedule = plan(recipe);
    CHECK(std::ranges::count(schedule.actions, CvtAction::Kind::bisect, &CvtAction::kind) ==
          bisections);
    const Cvt grid = cvt(random_sphere(start), schedule);
    CHECK(grid.mesh.points.cols() == cells);
    CHECK(grid.report.converged);
    CHECK(check(grid.mesh).failure == "");
    CHECK(grid.report.residual <= 1e-4);
  }
}

// Slow: two descents to 4 000 cells.
TEST_CASE("stages: insertion finds a better minimum than descents alone [slow]") {
  const CvtStop stop{.tolerance = 1e-4, .well_centred = false};
  Recipe recipe = graded(4000, x8());
  recipe.stop = stop;
  const double with = excess(make_grid(recipe), x8());
  const Cvt plain = make_grid({.cells = 4002,
                               .resolution = x8(),
                               .start = {.kind = CvtStart::Kind::density, .bisections = 2},
                               .stop = stop});
  CHECK(with < 0.85 * excess(plain, x8()));
  CHECK(with > 0);
}

// Slow: eight descents to 3 001 cells with a finish.
TEST_CASE("stages: a finish gives the shapes that models require [slow]") {
  for (const Density& density : {x8(), stretched_bump(), two_bumps(), Density{}})
    for (const std::uint64_t seed : {1, 2}) {
      CAPTURE(seed);
      Recipe recipe = graded(3001, density);
      recipe.seed = seed;
      const Cvt grid = make_grid(recipe);
      CHECK(grid.mesh.points.cols() == 3001);
      CHECK(grid.report.converged);
      CHECK(grid.report.well_centred);
      CHECK(grid.report.iterations.back().shape_excess <= 0.03);
      CHECK(check(grid.mesh).failure == "");
      check_shapes(grid.mesh);
      CHECK(grid.report.residual < 0.02);
      const Percentiles lengths = quality(grid.mesh, density).dc_over_h;
      CHECK(lengths.min > 0.80 - 0.01); // the demanded spacing follows from the energy
      CHECK(lengths.max < 1.26 + 0.01);
    }
}

TEST_CASE("stages: in each descent every accepted step lowers the energy") {
  int descents = 0, steps = 0;
  double before = 0;
  std::tuple<int, int, int, int> rule_and_stage;
  const cvt_detail::Execution execution{.quadrature = {.divisions = 2}};
  cvt(random_start(190, x8()), plan(graded(3000, x8())), execution, [&](const CvtProgress& now) {
    const CvtIteration& here = now.report.iterations.back();
    const cvt_detail::State& state = cvt_detail::State::of(now.state);
    if (state.in_polish() || !here.accepted) // a polish minimises another function
      return false;
    const std::tuple now_in(here.rule, now.bisections_left, now.rounds_left, state.cursor.glides);
    const bool same = now.iterations_of_descent > 1 && now_in == rule_and_stage;
    if (same)
      CHECK(here.energy <= before * (1 + 1e-7));
    (same ? steps : descents) += 1;
    before = here.energy;
    rule_and_stage = now_in;
    return false;
  });
  CHECK(descents > 8);
  CHECK(steps > 40);
}

TEST_CASE("stages: a density of 0 on a part of the sphere leaves its edges without a demand") {
  const Cvt grid = cvt(fibonacci_sphere(400), plan(graded(600, rising(0.999))));
  CHECK(grid.mesh.points.cols() == 600);
  CHECK(grid.mesh.points.allFinite());
  CHECK(check(grid.mesh).failure == "");
}

TEST_CASE("stages: a density is evaluated at the sites only where cells are small everywhere") {
  const auto at_sites = [](const Points3& start, const Density& density) {
    const Cvt grid =
        cvt(start, plan(graded(2600, density)), {}, [](const CvtProgress&) { return true; });
    return grid.report.iterations.front().linear_density;
  };
  CHECK(at_sites(random_start(2500, x8()), x8()));
  const Density steep = tanh_bump({1, 0, 0}, 0.3, 0.1, 1e-6); // some cells 20 degrees wide
  CHECK(!at_sites(random_start(2500, steep), steep));
  CHECK(!at_sites(fibonacci_sphere(2500), rising(0.999))); // 0 at a pole
}

TEST_CASE("stages: threads and regions have no effect on insertion and finish") {
  const auto with = [&](std::size_t threads, int regions) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Recipe recipe = graded(2800, x8());
    recipe.stop.most_off_midpoint = 0.01;
    return make_grid(recipe, {.decomposition = {.regions = regions}});
  };
  const Cvt one = with(1, 1);
  CHECK(one.report.converged);
  CHECK(one.report.well_centred);
  if (!test::sanitized)
    CHECK(same_run(one, with(2, 12)));
  CHECK(same_run(one, with(4, 42)));
}

TEST_CASE("stages: a run resumes to the same bits within each stage") {
  const Scratch scratch;
  Recipe recipe = graded(700, two_bumps());
  recipe.seed = 4;
  std::vector<CvtState> states;
  const auto keep = [&](const Progress& now) {
    states.push_back(now.run->state);
    return ProgressReply::proceed;
  };
  const Cvt whole = make_grid(recipe, {.progress = keep});
  REQUIRE(cvt_detail::State::of(states.back()).in_polish());
  REQUIRE(states.size() > 40);
  constexpr std::size_t stride = test::sanitized ? 38 : 19;
  for (std::size_t k = 0; k < states.size(); k += k + 6 < states.size() ? stride : 1) {
    CAPTURE(k);
    write_checkpoint(scratch / "run.ckpt", states[k], "same");
    const CvtState state = read_checkpoint(scratch / "run.ckpt", "same");
    CHECK(same_run(make_grid(recipe, {.state = state}), whole));
  }
}

TEST_CASE("stages: a finish leaves a mesh of good shapes as it is") {
  Recipe recipe{.start = {.points = bisected_icosahedron(3)}, .stop = {.tolerance = 1e-6}};
  const Cvt pure = make_grid(recipe);
  recipe.stop.well_centred = true;
  const Cvt finished = make_grid(recipe);
  CHECK((pure.mesh.points == finished.mesh.points));
  CHECK(finished.report.converged);
  CHECK(finished.report.well_centred);
  CHECK(!pure.report.well_centred);
  CHECK(finished.report.iterations.size() == pure.report.iterations.size() + 1);
}

TEST_CASE("stages: a finish lessens the errors of operators at dislocations") {
  Recipe recipe = graded(4000, x8());
  const Cvt usual = make_grid(recipe);
  recipe.stop.most_off_midpoint = 0.01;
  const Cvt nearer = make_grid(recipe);
  CHECK(nearer.report.well_centred);
  CHECK(nearer.report.iterations.size() > usual.report.iterations.size() + 10);
  const OperatorErrors with = operator_errors(nearer.mesh), without = operator_errors(usual.mesh);
  CHECK(with.off_midpoint.max < 0.8 * without.off_midpoint.max);
  CHECK(with.laplacian.l2 < 0.9 * without.laplacian.l2);
  CHECK(with.laplacian.max < 0.8 * without.laplacian.max);
  for (const double value : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    recipe.stop.most_off_midpoint = value;
    CHECK(has(refusal_of([&] { make_grid(recipe); }), "most_off_midpoint is "));
  }
}

TEST_CASE("stages: a least spacing is kept, or the report says that it is not") {
  const auto least = [](const Cvt& grid) { return quality(grid.mesh, x8()).dc_over_h.min; };
  Recipe recipe = graded(3001, x8());
  const Cvt usual = make_grid(recipe);
  recipe.stop.least_spacing = 0.9;
  const Cvt wider = make_grid(recipe);
  CHECK(least(usual) < 0.86);
  if (wider.report.well_centred)
    CHECK(least(wider) > 0.9 - 0.03 - 0.01); // the demanded spacing follows from the energy
  else
    CHECK(wider.report.iterations.back().shape_excess > 0.03);
  recipe.stop.least_spacing = 0.97;
  CHECK(refusal_of([&] { make_grid(recipe); }) ==
        "least_spacing is 0.97; give a share of the demanded spacing, 0 to 0.95");
}

// Slow: descents with a finish in two domains.
TEST_CASE("stages: in the plane, with a boundary and in a box [slow]") {
  const Density fine = tanh_bump({0.7, 0.5, 0}, 0.2, 0.2, 1.0 / 256);
  for (const Surface& domain : {rectangle({0, 0}, {2, 1}), Surface::periodic({2, 1})}) {
    CAPTURE(domain.is_box());
    Recipe recipe = graded(2600, fine);
    recipe.surface = domain;
    recipe.seed = 3;
    const Cvt grid = make_grid(recipe);
    CHECK(grid.mesh.points.cols() == 2600);
    CHECK(grid.report.converged);
    CHECK(check(grid.mesh).failure == "");
    const Quality q = quality(grid.mesh, fine);
    CHECK(q.angles.min > 36.9);
    CHECK(q.obtuse == 0);
  }
}

TEST_CASE("stages: a round after a descent of more than 25 evaluations counts for two") {
  const auto rounds_of = [](const Density& density) {
    Recipe recipe = graded(600, density);
    recipe.start.insertion_rounds = 6;
    recipe.stop.well_centred = false;
    int left = 6, evaluations = 0, count = 0;
    const auto follow = [&](const Progress& progress) {
      const CvtProgress& now = *progress.run;
      if (now.rounds_left != left) {
        CHECK(now.rounds_left == std::max(left - (evaluations > 25 ? 2 : 1), 0));
        left = now.rounds_left;
        ++count;
      }
      evaluations = now.iterations_of_descent;
      return ProgressReply::proceed;
    };
    make_grid(recipe, {.progress = follow});
    CHECK(left == 0);
    return count;
  };
  CHECK(rounds_of(x8()) < 6);
}
