// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_forecast.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace calotte;
using namespace calotte::tools;

namespace {

/// The progress of a run, with a report of its own.
struct Standing {
  CvtReport report;
  int iterations_of_level = 0, bisections_left = 0;
  CvtState state;

  operator CvtProgress() const { return {report, iterations_of_level, bisections_left, 0, state}; }
};

/// A level of iterations of two seconds each whose norms are factor^k.
Standing decaying(int iterations, double factor) {
  Standing state;
  state.iterations_of_level = iterations;
  for (int k = 0; k < iterations; ++k) {
    CvtIteration iteration;
    iteration.cells = 12;
    iteration.spacing = std::sqrt(4 * std::numbers::pi / 12);
    iteration.l2 = iteration.linf = iteration.gradient = std::pow(factor, k);
    iteration.seconds = 2;
    state.report.iterations.push_back(iteration);
  }
  state.report.residual = std::pow(factor, iterations - 1);
  return state;
}

} // namespace

TEST_CASE("the end of an exponential decay is predicted to the iteration") {
  CvtOptions options;
  options.tolerance = std::pow(0.9, 300.5); // 0.9^301 is the first below
  for (const Norm norm : {Norm::l2, Norm::linf, Norm::gradient})
    for (const int iterations : {10, 11, 100, 290}) {
      options.norm = norm;
      const auto end = forecast(decaying(iterations, 0.9), options);
      REQUIRE(end);
      CHECK(end->converges);
      CHECK(end->seconds == doctest::Approx(2 * (301 - (iterations - 1))));
    }
}

TEST_CASE("the limit of iterations ends longer runs, and runs of a fixed number of iterations") {
  CvtOptions options;
  options.tolerance = 1e-9;
  options.max_iterations = 100;
  for (const Norm norm : {Norm::l2_scaled, Norm::none}) {
    options.norm = norm;
    for (const double factor : {0.99, 1.0, 1.01}) { // also for a norm that does not fall
      const auto end = forecast(decaying(40, factor), options);
      REQUIRE(end);
      CHECK(!end->converges);
      CHECK(end->seconds == doctest::Approx(2 * 60));
    }
  }
}

TEST_CASE("a last step that went beyond the limit of iterations leaves no time") {
  CvtOptions options;
  options.norm = Norm::none;
  options.max_iterations = 38;
  CHECK(forecast(decaying(40, 0.9), options)->seconds == 0);
}

TEST_CASE("there is no prediction from few iterations, or from those of another level") {
  CvtOptions options;
  CHECK(!forecast(decaying(9, 0.9), options));
  Standing next = decaying(50, 0.9);
  next.iterations_of_level = 9;
  CHECK(!forecast(next, options));
  next.iterations_of_level = 0;
  CHECK(!forecast(next, options));
}

TEST_CASE("rejected trials count in the time but not in the norms") {
  CvtOptions options;
  options.norm = Norm::l2;
  options.tolerance = std::pow(0.9, 300.5);
  options.max_iterations = 1000;
  Standing state = decaying(101, 0.9);
  for (std::size_t k = 1; k < 101; k += 3) {
    state.report.iterations[k].accepted = false;
    state.report.iterations[k].l2 = 1e6 / static_cast<double>(k);
  }
  for (CvtIteration& iteration : state.report.iterations)
    iteration.seconds = 1.5, iteration.seconds_solver = 0.5;
  const auto end = forecast(state, options);
  REQUIRE(end);
  CHECK(end->converges);
  CHECK(end->seconds == doctest::Approx(2 * (301 - 100)));
}

TEST_CASE("a converged level takes no more time") {
  CvtOptions options;
  options.tolerance = 0.5;
  const auto end = forecast(decaying(50, 0.9), options);
  REQUIRE(end);
  CHECK(end->seconds == 0);
}

TEST_CASE("the norms are those of the report") {
  CvtIteration iteration;
  iteration.cells = 400;
  iteration.spacing = std::sqrt(4 * std::numbers::pi / 400);
  iteration.l2 = 1, iteration.linf = 2, iteration.gradient = 3;
  const double h = iteration.spacing;
  CHECK(norm_of(iteration, Norm::l2) == 1);
  CHECK(norm_of(iteration, Norm::linf) == 2);
  CHECK(norm_of(iteration, Norm::gradient) == 3);
  CHECK(norm_of(iteration, Norm::none) == 0);
  CHECK(norm_of(iteration, Norm::l2_scaled) == doctest::Approx(1 / h));
  CHECK(norm_of(iteration, Norm::linf_scaled) == doctest::Approx(2 / h));
}

TEST_CASE("the time left is a range that holds the levels that follow") {
  CvtOptions options;
  options.norm = Norm::l2;
  options.tolerance = std::pow(0.9, 300.5);
  Standing state = decaying(101, 0.9);
  const double rest = 2 * (301 - 100), level = 2 * 101 + rest;
  auto left = remaining(state, options);
  REQUIRE(left);
  CHECK(left->least == doctest::Approx(0.7 * rest));
  CHECK(left->most == doctest::Approx(1.4 * rest));
  state.bisections_left = 2;
  options.insertion_rounds = 1; // two descents on the last level, three and four before it
  options.tolerance = std::max(options.tolerance, 1e-30);
  left = remaining(state, options);
  REQUIRE(left);
  CHECK(left->least < left->most);
  CHECK(left->most > 1.99 * 2 * 101 * (4 * 3.0 / 4 + 4 * 3.0 / 4 * 4 * 2.0 / 3));
  CHECK(level > rest);
  CHECK(!remaining(decaying(9, 0.9), options));
}

TEST_CASE("the time left follows the wall clock, of which evaluations are a part") {
  CvtOptions options;
  options.norm = Norm::l2;
  options.tolerance = std::pow(0.9, 300.5);
  Standing state = decaying(101, 0.9);
  const auto idle = remaining(state, options);
  REQUIRE(idle);
  state.report.seconds = 3 * 2 * 101;
  const auto busy = remaining(state, options);
  REQUIRE(busy);
  CHECK(busy->least == doctest::Approx(3 * idle->least));
  CHECK(busy->most == doctest::Approx(3 * idle->most));
  state.bisections_left = 2;
  options.insertion_rounds = 1;
  const auto levels = remaining(state, options);
  state.report.seconds = 0;
  CHECK(levels->most == doctest::Approx(3 * remaining(state, options)->most));
}

TEST_CASE("progress names the level, the norm and the prediction") {
  Standing state = decaying(101, 0.9);
  state.bisections_left = 2;
  CvtOptions options;
  options.norm = Norm::l2;
  options.tolerance = std::pow(0.9, 110);
  CHECK(describe(state, options, "l2")
            .starts_with("12 cells, iteration 101, l2 2.66e-05 of 9e-06, energy x cells 0, then 2 "
                         "finer levels, "));
  options.norm = Norm::none;
  state.bisections_left = 0;
  options.max_iterations = 4000;
  CHECK(describe(state, options, "none") ==
        "12 cells, iteration 101, energy x cells 0, 91 min to 3.0 h left");
}
