// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_forecast.h"
#include "run/progress.h"
#include "support/text.h"
#include "text/text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::tools;
using calotte::test::has;

namespace {

/// The progress of a run, with a report of its own.
struct Standing {
  CvtReport report;
  int iterations_of_descent = 0, bisections_left = 0;
  CvtState state;

  operator CvtProgress() const {
    return {report, iterations_of_descent, bisections_left, 0, state};
  }
};

/// A level of iterations of two seconds each whose norms are factor^k.
Standing decaying(int iterations, double factor) {
  Standing state;
  state.iterations_of_descent = iterations;
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

/// A run of one level, in the norm l2.
Schedule one_level(double tolerance) {
  Schedule schedule;
  schedule.recipe.stop.norm = Norm::l2;
  schedule.recipe.stop.tolerance = tolerance;
  schedule.recipe.stop.well_centred = false;
  schedule.actions = {{.kind = CvtAction::Kind::start,
                       .norm = Norm::l2,
                       .tolerance = tolerance,
                       .max_iterations = 1000}};
  return schedule;
}

/// Three levels with three, two and one round, in the norm of a schedule.
std::vector<CvtAction> with_rounds(const Schedule& schedule) {
  std::vector<CvtAction> actions;
  for (const int rounds : {3, 2, 1})
    for (const bool insert : {false, true}) {
      CvtAction& action = actions.emplace_back(schedule.actions.front());
      action.kind = insert        ? CvtAction::Kind::insert
                    : rounds == 3 ? CvtAction::Kind::start
                                  : CvtAction::Kind::bisect;
      action.times = insert ? rounds : 1;
    }
  return actions;
}

} // namespace

TEST_CASE("the end of an exponential decay is predicted to the iteration") {
  CvtAction action{.norm = Norm::l2_scaled, .tolerance = 1e-6, .max_iterations = 1000};
  action.tolerance = std::pow(0.9, 300.5); // 0.9^301 is the first below
  for (const Norm norm : {Norm::l2, Norm::linf})
    for (const int iterations : {10, 11, 100, 290}) {
      action.norm = norm;
      const auto end = forecast(decaying(iterations, 0.9), action);
      REQUIRE(end);
      CHECK(end->converges);
      CHECK(end->seconds == doctest::Approx(2 * (301 - (iterations - 1))));
    }
}

TEST_CASE("the limit of iterations ends longer runs, and runs of a fixed number of iterations") {
  CvtAction action{.norm = Norm::l2_scaled, .tolerance = 1e-6, .max_iterations = 1000};
  action.tolerance = 1e-9;
  action.max_iterations = 100;
  for (const Norm norm : {Norm::l2_scaled, Norm::none}) {
    action.norm = norm;
    for (const double factor : {0.99, 1.0, 1.01}) { // also for a norm that does not fall
      const auto end = forecast(decaying(40, factor), action);
      REQUIRE(end);
      CHECK(!end->converges);
      CHECK(end->seconds == doctest::Approx(2 * 60));
    }
  }
}

TEST_CASE("a last step that went beyond the limit of iterations leaves no time") {
  CvtAction action{.norm = Norm::l2_scaled, .tolerance = 1e-6, .max_iterations = 1000};
  action.norm = Norm::none;
  action.max_iterations = 38;
  CHECK(forecast(decaying(40, 0.9), action)->seconds == 0);
}

TEST_CASE("there is no prediction from few iterations, or from those of another level") {
  CvtAction action{.norm = Norm::l2_scaled, .tolerance = 1e-6, .max_iterations = 1000};
  CHECK(!forecast(decaying(9, 0.9), action));
  Standing next = decaying(50, 0.9);
  next.iterations_of_descent = 9;
  CHECK(!forecast(next, action));
  next.iterations_of_descent = 0;
  CHECK(!forecast(next, action));
}

TEST_CASE("rejected trials count in the time but not in the norms") {
  CvtAction action{.norm = Norm::l2_scaled, .tolerance = 1e-6, .max_iterations = 1000};
  action.norm = Norm::l2;
  action.tolerance = std::pow(0.9, 300.5);
  action.max_iterations = 1000;
  Standing state = decaying(101, 0.9);
  for (std::size_t k = 1; k < 101; k += 3) {
    state.report.iterations[k].accepted = false;
    state.report.iterations[k].l2 = 1e6 / static_cast<double>(k);
  }
  for (CvtIteration& iteration : state.report.iterations)
    iteration.seconds = 1.5, iteration.seconds_solver = 0.5;
  const auto end = forecast(state, action);
  REQUIRE(end);
  CHECK(end->converges);
  CHECK(end->seconds == doctest::Approx(2 * (301 - 100)));
}

TEST_CASE("the last descent of a graded run is expected to end as others did") {
  Schedule schedule = one_level(1e-4);
  schedule.actions.push_back(schedule.actions.front());
  schedule.actions.back().kind = CvtAction::Kind::converge;
  const auto seconds = [&](int iterations, double factor) {
    Standing state = decaying(iterations, factor);
    state.report.done.resize(2);
    state.report.seconds = 2 * iterations;
    const auto left = remaining(state, schedule);
    REQUIRE(left);
    return left->most / 1.4;
  };
  for (const double factor : {0.99, 1.01}) { // slow, and no decay yet
    CHECK(seconds(12, factor) == doctest::Approx(2 * 13));
    CHECK(seconds(40, factor) == doctest::Approx(2 * 5));
  }
  CHECK(seconds(400, 1.01) == doctest::Approx(2 * 600)); // unusual
  schedule.recipe.method = Method::lloyd;
  CHECK(seconds(12, 1.01) == doctest::Approx(2 * 988));
  schedule.recipe.method = Method::automatic;
  schedule.actions.back().tolerance = 1e-6; // of a pure CVT
  CHECK(seconds(12, 1.01) == doctest::Approx(2 * 988));
}

TEST_CASE("a converged level takes no more time") {
  CvtAction action{.norm = Norm::l2_scaled, .tolerance = 1e-6, .max_iterations = 1000};
  action.tolerance = 0.5;
  const auto end = forecast(decaying(50, 0.9), action);
  REQUIRE(end);
  CHECK(end->seconds == 0);
}

TEST_CASE("the norms are those of the report") {
  CvtIteration iteration;
  iteration.cells = 400;
  iteration.spacing = std::sqrt(4 * std::numbers::pi / 400);
  iteration.l2 = 1, iteration.linf = 2;
  const double h = iteration.spacing;
  CHECK(norm_of(iteration, Norm::l2) == 1);
  CHECK(norm_of(iteration, Norm::linf) == 2);
  CHECK(norm_of(iteration, Norm::none) == 0);
  CHECK(norm_of(iteration, Norm::l2_scaled) == doctest::Approx(1 / h));
  CHECK(norm_of(iteration, Norm::linf_scaled) == doctest::Approx(2 / h));
}

TEST_CASE("the time left is a range that holds the levels that follow") {
  Schedule schedule = one_level(std::pow(0.9, 300.5));
  Standing state = decaying(101, 0.9);
  const double rest = 2 * (301 - 100), level = 2 * 101 + rest;
  auto left = remaining(state, schedule);
  REQUIRE(left);
  CHECK(left->least == doctest::Approx(0.7 * rest));
  CHECK(left->most == doctest::Approx(1.4 * rest));
  state.bisections_left = 2;
  schedule.actions =
      with_rounds(schedule); // two descents on the last level, three and four before it
  left = remaining(state, schedule);
  REQUIRE(left);
  CHECK(left->least < left->most);
  CHECK(left->most > 1.99 * 2 * 101 * (4 * 3.0 / 4 + 4 * 3.0 / 4 * 4 * 2.0 / 3));
  CHECK(level > rest);
  CHECK(!remaining(decaying(9, 0.9), schedule));
}

TEST_CASE("the time left follows the wall clock, of which evaluations are a part") {
  Schedule schedule = one_level(std::pow(0.9, 300.5));
  Standing state = decaying(101, 0.9);
  const auto idle = remaining(state, schedule);
  REQUIRE(idle);
  state.report.seconds = 3 * 2 * 101;
  const auto busy = remaining(state, schedule);
  REQUIRE(busy);
  CHECK(busy->least == doctest::Approx(3 * idle->least));
  CHECK(busy->most == doctest::Approx(3 * idle->most));
  state.bisections_left = 2;
  schedule.actions = with_rounds(schedule);
  const auto levels = remaining(state, schedule);
  state.report.seconds = 0;
  CHECK(levels->most == doctest::Approx(3 * remaining(state, schedule)->most));
}

TEST_CASE("times for people have two digits, or are whole") {
  for (const auto& [seconds, words] : std::vector<std::pair<double, std::string>>{{0, "0 s"},
                                                                                  {0.412, "0.41 s"},
                                                                                  {9.97, "10 s"},
                                                                                  {110, "110 s"},
                                                                                  {150, "2.5 min"},
                                                                                  {6600, "110 min"},
                                                                                  {94000, "26 h"}})
    CHECK(duration(seconds) == words);
}

TEST_CASE("sizes of data for people have three digits") {
  for (const auto& [bytes, words] :
       std::vector<std::pair<double, std::string>>{{0, "0 kB"},
                                                   {41'237, "41.2 kB"},
                                                   {999'499, "999 kB"},
                                                   {999'501, "1 MB"},
                                                   {325e6, "325 MB"},
                                                   {999.9e6, "1 GB"},
                                                   {2.873e9, "2.87 GB"},
                                                   {4e12, "4 TB"},
                                                   {5e15, "5e+03 TB"}})
    CHECK(data_size(bytes) == words);
}

TEST_CASE("the line of a stage has a bar where the part that is done is known") {
  CHECK(progress_line("reading a.nc", {}, 3.14, 0) == "calotte: reading a.nc (3.1 s)");
  CHECK(progress_line("writing a.nc", 0.25, 3.14, 0) ==
        "calotte: writing a.nc [#####---------------]  25% (3.1 s)");
  CHECK(has(progress_line("w", 0, 0, 0), " [--------------------]   0% "));
  CHECK(has(progress_line("w", 1, 0, 0), " [####################] 100% "));
  CHECK(has(progress_line("w", 1.5, 0, 0), " [####################] 100% "));
}

TEST_CASE("the line of a stage is narrower than the terminal, and cut between characters") {
  const std::string name = "writing Küstengitter/höchste-Auflösung.nc";
  for (int columns = 1; columns < 120; ++columns) {
    CAPTURE(columns);
    const std::string line = progress_line(name, 0.5, 3.14, columns);
    const std::string whole = progress_line(name, 0.5, 3.14, 0);
    CHECK(line.ends_with(" [##########----------]  50% (3.1 s)"));
    CHECK((line.size() < static_cast<std::size_t>(columns) || columns < 50));
    const std::size_t end = line.find("... [");
    CHECK((line == whole || end != std::string::npos));
    if (line != whole) { // what is left is a beginning of whole characters
      CHECK(whole.starts_with(line.substr(0, end)));
      CHECK((static_cast<unsigned char>(whole[end]) & 0xc0U) != 0x80);
    }
  }
}

TEST_CASE("progress names the level, the norm and the prediction") {
  Standing state = decaying(101, 0.9);
  state.bisections_left = 2;
  Schedule schedule = one_level(std::pow(0.9, 110));
  schedule.actions.resize(3, {.kind = CvtAction::Kind::bisect});
  CHECK(describe(state, schedule)
            .starts_with("12 cells, iteration 101, l2 2.66e-05 of 9e-06, energy x cells 0, then 2 "
                         "finer levels, "));
  schedule.recipe.stop.iterations = 4000;
  schedule.actions = {{.norm = Norm::none, .max_iterations = 4000}};
  state.bisections_left = 0;
  CHECK(describe(state, schedule) ==
        "12 cells, iteration 101, energy x cells 0, 91 min to 3 h left");
}
