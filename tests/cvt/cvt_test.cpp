// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/grid.h>

#include "base/points.h"
#include "cvt/cvt.h"
#include "cvt/state.h"
#include "delaunay/delaunay.h"
#include "integrals/moments.h"
#include "support/constants.h"
#include "support/densities.h"
#include "support/descent.h"
#include "support/errors.h"
#include "support/sanitizer.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::integrals_detail;
using cvt_detail::State;

namespace {

constexpr std::array<Method, 4> methods{Method::lloyd, Method::lbfgs, Method::lbfgs_laplacian,
                                        Method::automatic};

/// Runs one method from a random start.
void check_random_start(const Density& density, Method method) {
  CAPTURE(static_cast<int>(method));
  constexpr int iterations = test::sanitized ? 15 : 40;
  const Recipe recipe{.resolution = density,
                      .start = {.points = random_sphere(1700, 4)},
                      .stop = {.max_iterations = iterations},
                      .method = method};
  const auto with = [&](std::size_t threads, int regions, RegionOverlap overlap) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return make_grid(recipe, {.decomposition = {.regions = regions, .overlap = overlap}});
  };
  const Cvt one = with(1, 1, RegionOverlap::halo);
  CHECK(!one.report.converged);
  CHECK(one.report.iterations.size() >= iterations);
  CHECK(check(one.mesh).failure == "");
  check_descent(one.report, 2e-13);
  for (const Cvt& other : {with(4, 12, RegionOverlap::halo), with(2, 42, RegionOverlap::distance),
                           with(3, 2, RegionOverlap::voronoi), with(2, 300, RegionOverlap::halo)}) {
    CHECK((one.mesh.points == other.mesh.points));
    CHECK((one.mesh.triangles == other.mesh.triangles));
    for (std::size_t k = 0; k < one.report.iterations.size(); ++k) {
      CHECK(one.report.iterations[k].energy == other.report.iterations[k].energy);
      CHECK(one.report.iterations[k].l2 == other.report.iterations[k].l2);
      CHECK(one.report.iterations[k].linf == other.report.iterations[k].linf);
      CHECK(one.report.iterations[k].gradient == other.report.iterations[k].gradient);
    }
  }
}

} // namespace

TEST_CASE("every method takes uniform bisected grids to the known optimum without a flip") {
  Recipe recipe{.stop = {.tolerance = 1e-8, .max_iterations = 3000}};
  const std::array<double, 2> energies{25.44900, 25.44443}; // E n for n = 2562 and 10 242
  for (int level = 4; level <= (test::sanitized ? 4 : 5); ++level) {
    double lowest = 0;
    recipe.start.points = bisected_icosahedron(level);
    for (const Method method : methods) {
      CAPTURE(static_cast<int>(method));
      recipe.method = method;
      const Cvt grid = make_grid(recipe);
      const double energy =
          grid.report.iterations.back().energy * static_cast<double>(grid.mesh.points.cols());
      CHECK(grid.report.converged);
      CHECK(energy == doctest::Approx(energies[static_cast<std::size_t>(level - 4)]).epsilon(1e-6));
      if (method == Method::lloyd)
        lowest = energy;
      CHECK(energy == doctest::Approx(lowest).epsilon(1e-10));
      for (const CvtIteration& iteration : grid.report.iterations)
        CHECK(iteration.flips + iteration.rebuilt == 0);
      if (method == Method::lbfgs_laplacian || method == Method::automatic)
        CHECK(grid.report.iterations.size() < 60); // Lloyd's method takes hundreds
      check_descent(grid.report, 2e-13);
      CHECK(check(grid.mesh).failure == "");
    }
  }
}

TEST_CASE("random starts: the energy falls, and threads, regions and sorts have no effect") {
  for (const Method method : methods) {
    check_random_start(Density{}, method);
    check_random_start(x8(), method);
  }
}

TEST_CASE("a run continues from any of its states to the same bits") {
  for (const Method method : methods) {
    CAPTURE(static_cast<int>(method));
    // The final rule takes over, and the Laplacian is computed again.
    const Recipe recipe{.resolution = x8(),
                        .start = {.points = random_sphere(300, 4), .bisections = 1},
                        .stop = {.tolerance = 1e-3, .max_iterations = 100},
                        .method = method};
    std::vector<CvtState> states;
    const auto keep = [&](const Progress& now) {
      states.push_back(now.run->state);
      return ProgressReply::proceed;
    };
    const Cvt whole = make_grid(recipe, {.progress = keep});
    CHECK(whole.mesh.points.cols() == 4 * 300 - 6);
    if (method != Method::lloyd) // smaller than before
      CHECK(whole.report.iterations.back().rule == cvt_detail::Quadrature().final_rule);
    for (std::size_t k = 0; k < states.size(); k += test::sanitized ? 27 : 9) {
      const Cvt rest = make_grid(recipe, {.state = states[k]});
      CAPTURE(k);
      CHECK((rest.mesh.points == whole.mesh.points));
      CHECK((rest.mesh.triangles == whole.mesh.triangles));
      CHECK(rest.report.iterations.size() == whole.report.iterations.size());
      CHECK(rest.report.iterations.back().energy == whole.report.iterations.back().energy);
    }
  }
}

TEST_CASE("every machine, compiler option and vector width gives the same bits") {
  // FNV-1a of the coordinates, from a build without vector code: the sanitizers' builds have none,
  // the release build has that of the machine.
  const auto hash = [](const Points3& points) {
    std::uint64_t h = 0xcbf29ce484222325U;
    for (const double value : points.reshaped())
      for (int byte = 0; byte < 8; ++byte)
        h = (h ^ (std::bit_cast<std::uint64_t>(value) >> (8 * byte) & 0xff)) * 0x100000001b3U;
    return h;
  };
  Recipe recipe{.start = {.points = random_sphere(1500, 6)},
                .stop = {.max_iterations = 30},
                .method = Method::lloyd};
  CHECK(hash(make_grid(recipe).mesh.points) == 9742159583379483476U);
  recipe.resolution = x8();
  CHECK(hash(make_grid(recipe).mesh.points) == 4403101448020715688U);
  recipe.method = Method::lbfgs_laplacian;
  CHECK(hash(make_grid(recipe).mesh.points) == 11222898154665023123U);
}

TEST_CASE("a state that no run has left is refused") {
  const Recipe recipe{.start = {.points = random_sphere(50)}, .stop = {.max_iterations = 1}};
  CvtState good;
  const auto keep = [&](const Progress& now) {
    good = now.run->state;
    return ProgressReply::stop;
  };
  make_grid(recipe, {.progress = keep});
  CHECK_NOTHROW(make_grid(recipe, {.state = good}));
  std::vector<CvtState> bad(9, good);
  State::of(bad[0]).id[3] = State::of(bad[0]).id[4];
  State::of(bad[1]).id.pop_back();
  State::of(bad[2]).points(0, 7) = std::nan("");
  State::of(bad[3]).points *= 2;
  State::of(bad[4]).site_of_input[0] = 50;
  State::of(bad[5]).cursor.action = 1;
  State::of(bad[6]).report.done.clear();
  State::of(bad[7]).report.actions.clear();
  State::of(bad[8]).memory.iterations = -1;
  for (const CvtState& state : bad)
    CHECK_THROWS_AS(make_grid(recipe, {.state = state}), Error);
  CvtState few = good;
  State::of(few).points = good.points().leftCols(11);
  State::of(few).id = base_detail::themselves(11);
  State::of(few).site_of_input.clear();
  State::of(few).memory = {};
  CHECK_THROWS_WITH_AS(
      make_grid(recipe, {.state = few}),
      "the state has 11 generators, and a run on the surface has at least 12; give "
      "the surface of the run that left it",
      Error);
}

TEST_CASE("each norm stops the run at its tolerance") {
  const double h = std::sqrt(4 * pi / 642);
  for (const Norm norm : {Norm::l2, Norm::linf, Norm::l2_scaled, Norm::linf_scaled}) {
    const Cvt grid = make_grid({.start = {.points = bisected_icosahedron(3)},
                                .stop = {.norm = norm, .tolerance = 1e-5, .max_iterations = 2000}});
    CHECK(grid.report.converged);
    const auto value = [&](const CvtIteration& it) {
      return norm == Norm::l2          ? it.l2
             : norm == Norm::linf      ? it.linf
             : norm == Norm::l2_scaled ? it.l2 / h
                                       : it.linf / h;
    };
    for (std::size_t k = 0; k + 1 < grid.report.iterations.size(); ++k)
      CHECK(value(grid.report.iterations[k]) > 1e-5);
    CHECK(value(grid.report.iterations.back()) <= 1e-5);
    CHECK(grid.report.residual == doctest::Approx(value(grid.report.iterations.back())));
  }
}

TEST_CASE("the gradient is the energy's slope") {
  // Along the steepest descent from x the energy falls by |g|^2 for a unit of it.
  const Points3 x = random_sphere(300, 9);
  const Schedule once = plan({.resolution = x8(),
                              .start = {.points = x},
                              .stop = {.iterations = 1},
                              .method = Method::lloyd});
  const auto at = [&](const Points3& points) { // otherwise the rule's error appears in the energy
    return cvt(points, once, {.quadrature = {6, 6, 4}}).report.iterations.back();
  };
  const Moments moments = mesh_moments(delaunay(x), x8(), 6, 4);
  Points3 gradient(3, x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 first = moments.first[i];
    const Eigen::Vector3d m(first.x, first.y, first.z);
    gradient.col(i) = -2 * (m - m.dot(x.col(i)) * x.col(i));
  }
  CHECK(at(x).gradient == doctest::Approx(gradient.norm()).epsilon(1e-12));
  const double step = 1e-4;
  const Points3 there = (x - step * gradient).colwise().normalized();
  const Points3 back = (x + step * gradient).colwise().normalized();
  const double slope = (at(back).energy - at(there).energy) / (2 * step);
  CHECK(slope == doctest::Approx(gradient.squaredNorm()).epsilon(2e-3));
}

TEST_CASE("the report counts the regions' sites and their seconds") {
  const Recipe recipe{.start = {.points = bisected_icosahedron(5)}, .stop = {.iterations = 3}};
  for (const RegionOverlap overlap :
       {RegionOverlap::halo, RegionOverlap::distance, RegionOverlap::voronoi}) {
    const CvtReport report = make_grid(recipe, {.decomposition = {.overlap = overlap}}).report;
    std::int64_t sites = 0;
    for (const CvtRegion& region : report.regions) {
      sites += region.sites;
      CHECK(region.seconds > 0);
    }
    CHECK(report.converged);
    CHECK(sites == recipe.start.points.cols());
    for (const CvtIteration& iteration : report.iterations)
      CHECK(iteration.seconds_exchange + iteration.seconds_moments > 0);
  }
}

TEST_CASE("generators stay in the order of the start") {
  const Points3 start = bisected_icosahedron(3);
  const Cvt grid = make_grid({.start = {.points = start}, .stop = {.max_iterations = 20}});
  CHECK((grid.mesh.points - start).colwise().norm().maxCoeff() < 0.05);
}

// Slow: up to 1 500 iterations for 2 562 generators.
TEST_CASE("the tanh bump spreads spacings by the fourth root of its contrast [slow]") {
  const Cvt grid = make_grid({.resolution = x8(),
                              .start = {.points = bisected_icosahedron(4)},
                              .stop = {.tolerance = 1e-5, .max_iterations = 1500}});
  check_descent(grid.report, 2e-13);
  double shortest = 4, longest = 0;
  for (Eigen::Index t = 0; t < grid.mesh.triangles.cols(); ++t)
    for (int e = 0; e < 3; ++e) {
      const double side = (grid.mesh.points.col(grid.mesh.triangles(e, t)) -
                           grid.mesh.points.col(grid.mesh.triangles((e + 1) % 3, t)))
                              .norm();
      shortest = std::min(shortest, side);
      longest = std::max(longest, side);
    }
  CHECK(longest / shortest > 6);
  CHECK(longest / shortest < 14);
}

// Slow: five descents to a tolerance of 1e-10.
TEST_CASE("the fixed point depends on the rule by the rule's order only [slow]") {
  // Smooth and without any symmetry, so that the generators cannot rotate.
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    const auto px = x.row(0).array(), py = x.row(1).array(), pz = x.row(2).array();
    rho = (pz + 0.7 * px + 2 * py * py - px * pz).exp().matrix().transpose();
  };
  const Schedule schedule = plan({.resolution = density,
                                  .start = {.points = bisected_icosahedron(1)},
                                  .stop = {.tolerance = 1e-10, .max_iterations = 20000}});
  const auto fixed_point = [&](int rule, int divisions) {
    const Cvt grid =
        cvt(bisected_icosahedron(1), schedule, {.quadrature = {rule, rule, divisions}});
    CHECK(grid.report.converged);
    return grid.mesh.points;
  };
  const Points3 exact = fixed_point(6, 8);
  const auto error = [&](int rule, int divisions) {
    return (fixed_point(rule, divisions) - exact).colwise().norm().maxCoeff();
  };
  const double three = error(3, 1), six = error(6, 1);
  CHECK(three < 0.02);
  CHECK(error(3, 2) < three / 3); // its degree is 2
  CHECK(six < three / 5);
  CHECK(error(6, 2) < six / 10); // its degree is 4
}

// Slow: a descent to 10 242 generators, then moments with 64 times the triangles.
TEST_CASE("x8: the default rule's centroids are right to 1e-8 of the spacing [slow]") {
  const Cvt grid = make_grid({.resolution = x8(),
                              .start = {.points = bisected_icosahedron(3), .bisections = 2},
                              .stop = {.tolerance = 1e-3}});
  const double h = std::sqrt(4 * pi / 10242);
  CHECK(grid.mesh.points.cols() == 10242);
  CHECK(grid.report.converged);
  const Moments rule = mesh_moments(grid.mesh, x8(), cvt_detail::Quadrature().final_rule);
  const Moments exact = mesh_moments(grid.mesh, x8(), 6, 8);
  double squares = 0;
  for (std::int64_t i = 0; i < 10242; ++i) {
    const Vec3 apart =
        (1 / norm(rule.first[i])) * rule.first[i] - (1 / norm(exact.first[i])) * exact.first[i];
    squares += dot(apart, apart);
  }
  CHECK(std::sqrt(squares / 10242) < 1e-8 * h);
}

TEST_CASE("directions that differ by less than rounding are one generator") {
  Points3 start = random_sphere(40, 3);
  start.col(20) = Eigen::Vector3d(5e-324, 1, 0);
  start.col(30) = Eigen::Vector3d(5e-324, 1 - 0x1p-53, 0); // exactly, another direction
  Recipe recipe{.start = {.points = start}, .stop = {.max_iterations = 3}};
  const Cvt result = make_grid(recipe);
  CHECK(result.mesh.points.cols() == 39);
  CHECK(result.mesh.site_of_input[20] == result.mesh.site_of_input[30]);
  recipe.duplicates = Duplicates::refuse;
  CHECK(code_of([&] { make_grid(recipe); }) == ErrorCode::duplicate);
}

TEST_CASE("directions that are equal after normalisation are one generator, in whatever bits") {
  Points3 start = random_sphere(40, 3);
  start.col(20) = Eigen::Vector3d(0, 1, 0);
  start.col(30) = Eigen::Vector3d(1e-320, 3e150, 0); // normalised, (0, 1 - 2^-53, 0)
  const Cvt result = make_grid({.start = {.points = start}, .stop = {.max_iterations = 3}});
  CHECK(result.mesh.points.cols() == 39);
  CHECK(result.mesh.site_of_input[20] == result.mesh.site_of_input[30]);
}

TEST_CASE("directions that are equal only when they are normalised twice are two generators") {
  const std::array<std::array<double, 3>, 18> given{{
      {-0.682373046875, -0.682373046875, -0.682373046875},
      {-0.68237304687499989, -0.682373046875, -0.682373046875},
      {15.625, 15.625, 15.625},
      {15.625, 15.625, -0.682373046875},
      {15.624999999999998, 15.625, -0.682373046875},
      {-0.682373046875, -0.682373046875, -0.518310546875},
      {15.624999999999996, 15.625, -0.682373046875},
      {-0.68237304687499989, -0.682373046875, -0.68237304687499989},
      {0.156890869140625, 0, 1.0411759937510769},
      {15.624999999999995, 15.625, -0.682373046875},
      {0.15689086914067032, 0, 1.0411759937513778},
      {12.75, 12.75, -0.682342529296875},
      {15.624999999999993, 15.625, -0.682373046875},
      {0.1568908691406703, 0, 1.0411759937513778},
      {15.624999999999996, 15.625, 15.625},
      {15.625, 15.625, -11},
      {15.624999999999995, 15.625, 15.625},
      {-0.682373046875, -0.682373046875, -0.68237304687499989},
  }};
  Points3 points(3, given.size());
  for (std::size_t i = 0; i < given.size(); ++i)
    for (std::size_t row = 0; row < 3; ++row)
      points(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i)) = given[i][row];
  const Recipe recipe{.start = {.points = points}, .stop = {.max_iterations = 1}};
  const Cvt result = make_grid(recipe); // once it did not end
  CHECK(check(result.mesh).passed());
  // Some cells are smaller than rounding: slivers of other regions.
  CHECK(make_grid(recipe, {.decomposition = {.regions = 5}}).mesh.points == result.mesh.points);
}

TEST_CASE("bad input is refused in one line") {
  const Points3 start = random_sphere(100);
  const auto code = [](const Recipe& recipe) { return code_of([&] { make_grid(recipe); }); };
  for (const int few : {1, 2, 11})
    CHECK(code({.start = {.points = random_sphere(few)}}) == ErrorCode::too_few_sites);
  Points3 half = start;
  half.row(2) = half.row(2).cwiseAbs();
  CHECK(code({.start = {.points = half}}) == ErrorCode::too_few_sites);
  const auto refusal = [&](int bisections, const CvtStop& stop, Method method = Method::automatic) {
    return refusal_of([&] {
      plan({.start = {.points = start, .bisections = bisections}, .stop = stop, .method = method});
    });
  };
  CHECK(refusal(0, {.tolerance = 0}) == "the tolerance is 0; give a positive number such as 1e-6");
  CHECK(refusal(0, {.max_iterations = -1}) == "the number of iterations is -1; give 0 or more");
  for (const int bisections : {-1, 100})
    CHECK(refusal(bisections, {}) ==
          "the number of bisections is " + std::to_string(bisections) + "; give 0 to 13");
  CHECK(refusal(12, {}) == "12 bisections of 100 generators are too many; give at most 11");
  CHECK(refusal(11, {}, Method::lbfgs_laplacian) ==
        "411041794 generators are too many for the method lbfgs_laplacian, which takes at most "
        "306783378; give the method lbfgs or lloyd");
  const auto of_density = [&](const Density& density) {
    return code({.resolution = density, .start = {.points = start}});
  };
  CHECK(of_density(tanh_bump({0, 0, 1}, 0.5, 0.2, 0)) == ErrorCode::invalid_argument);
  for (const double value : {0.0, -1.0, std::nan("")}) {
    Density density;
    density.kind = Density::Kind::callable;
    density.callable = [value](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
      rho.setConstant(value);
    };
    CHECK(of_density(density) == ErrorCode::invalid_argument);
  }
}

TEST_CASE("a schedule that plan() has not made is refused") {
  const Recipe recipe{.cells = 50};
  std::vector<Schedule> bad(16, plan(recipe));
  bad[0].actions = {};
  bad[1].actions[0].tolerance = -1;
  bad[2].actions[0].tolerance = 0;
  bad[3].actions[0].tolerance = std::nan("");
  bad[4].actions[0].kind = CvtAction::Kind::converge;
  bad[5].actions[0].cells = 0;
  bad[6].actions[0].times = -1;
  bad[7].actions[0].max_iterations = -1;
  bad[8] = {};
  bad[9].actions.push_back(bad[9].actions[0]); // starts twice
  bad[10].actions[0].norm = static_cast<Norm>(99);
  bad[11].actions.push_back({.kind = static_cast<CvtAction::Kind>(99), .cells = 50});
  for (const CvtAction::Kind kind : {CvtAction::Kind::polish, CvtAction::Kind::insert})
    bad[12].actions.push_back({.kind = kind, .cells = 50, .tolerance = 1, .max_iterations = 9});
  bad[13].recipe.stop.least_spacing = 5;
  bad[14].recipe.fixed = fibonacci_sphere(51);
  bad[15].actions.push_back({.kind = CvtAction::Kind::polish, .cells = 50}); // of no evaluation
  CvtState state;
  const auto keep = [&](const Progress& now) {
    state = now.run->state;
    return ProgressReply::stop;
  };
  make_grid(recipe, {.progress = keep});
  for (const Schedule& schedule : bad) {
    CAPTURE(&schedule - bad.data());
    for (const std::optional<CvtState>& from : {std::optional<CvtState>(), std::optional(state)})
      CHECK(refusal_of([&] { make_grid(schedule, {.state = from}); }) ==
            "the schedule lacks choices; give one of plan()");
  }
  Schedule fixing = plan(recipe);
  fixing.recipe.fixed = fibonacci_sphere(3);
  CHECK(refusal_of([&] {
          make_grid(fixing, {.state = state});
        }).starts_with("the state is of a run with 0 fixed generators, not 3"));
}

TEST_CASE("a run of no evaluation keeps the start, also where a polish is asked for") {
  const Cvt grid = make_grid({.resolution = x8(),
                              .start = {.points = random_sphere(300, x8())},
                              .stop = {.max_iterations = 0, .well_centred = true}});
  CHECK(grid.mesh.points.cols() == 300);
  CHECK(grid.report.iterations.empty());
  CHECK_FALSE(grid.report.well_centred);
  CHECK_FALSE(grid.report.converged);
}
