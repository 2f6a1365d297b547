// SPDX-License-Identifier: GPL-3.0-or-later
// Times one iteration of calotte::cvt from a bisected start beside one of a serial program around
// STRIPACK, in one process and in rounds: each round runs every row once on every set, so that a
// ratio of two rows of a round saw the same machine. The next round starts with the next row. All
// generators are compared; a difference ends in a message and exit code 1.

#include "clouds.h"
#include "cvt/cvt.h"
#include "lloyd.h"
#include "program.h"
#include "stripack.h"

#include <calotte/cvt.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>

namespace calotte::bench {

namespace {

/// Maximum difference of generators after one iteration of n from the same points. The terms of a
/// first moment have the size h of a cell, the moment has that of its area h^2: rounding grows as
/// 1/h, and at 163 842 sites is about 6 roundoffs over h.
double tolerance(std::int64_t n) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
  return std::max(1e-13, 8 * 0x1p-53 / h);
}

struct Options : RoundOptions {
  std::vector<std::string> sets = {"uniform", "x8"};
  std::vector<std::int64_t> sizes = {163842};
  std::vector<std::string> rows = {"calotte", "one-thread", "stripack"};
  std::string order = "natural";
  std::vector<int> sweep;
  int iterations = 12;
  std::int64_t stripack_limit = 200000;
};

/// One set of sites and the data of its iterations; computed at first use.
struct Workload {
  std::string set;
  std::int64_t n = 0;
  Target target;
  Points3 start;
  Points3 result;        ///< of the first of the library's runs
  Points3 before, after; ///< the library's generators around the first iteration that is timed
};

std::shared_ptr<Workload> make_workload(const std::string& set, std::int64_t n) {
  Workload work{set, n, {named_density(set)}, {}, {}, {}, {}};
  return std::make_shared<Workload>(std::move(work));
}

Points3 bisected_start(std::int64_t n, const std::string& order) {
  return order == "shuffled" ? cloud("bisection", n) : natural_bisection(n);
}

void report(benchmark::State& state, const Iterated& outcome) {
  state.SetIterationTime(outcome.seconds);
  for (const auto& [name, value] : outcome.counters)
    state.counters[name] = value;
}

void run_library(benchmark::State& state, Workload& work, const Options& options, int threads) {
  if (work.start.cols() == 0)
    work.start = bisected_start(work.n, options.order);
  for (auto _ : state) {
    const Iterated outcome = run_cvt(work.start, work.target, options.iterations, threads);
    report(state, outcome);
    if (!outcome.failure.empty()) {
      state.SkipWithError(outcome.failure.c_str());
      return;
    }
    if (work.result.cols() == 0)
      work.result = outcome.points;
    if (outcome.points != work.result)
      state.SkipWithError("other generators than the library's first run gave");
  }
}

void run_serial(benchmark::State& state, Workload& work, const Options& options) {
  if (work.before.cols() == 0) {
    const Points3 start = bisected_start(work.n, options.order);
    work.before = cvt(start, Surface::sphere(), fixed_iterations(work.target, warm_up)).mesh.points;
    work.after = cvt(work.before, Surface::sphere(), fixed_iterations(work.target, 1)).mesh.points;
  }
  for (auto _ : state) {
    const Iterated outcome = run_stripack_iteration(work.before, work.target);
    report(state, outcome);
    if (!outcome.failure.empty()) {
      state.SkipWithError(outcome.failure.c_str());
      return;
    }
    const double difference = largest_distance(outcome.points, work.after);
    state.counters["difference"] = difference;
    if (const double most = tolerance(work.n); !(difference <= most)) {
      std::ostringstream message;
      message << "generators differ from the library's by " << difference
              << ", where rounding explains " << most;
      state.SkipWithError(message.str().c_str());
    }
  }
}

std::vector<RoundRow> make_rows(const Options& options, const std::shared_ptr<Workload>& work) {
  const auto library = [=](int threads) {
    return [=](benchmark::State& state) { run_library(state, *work, options, threads); };
  };
  std::vector<RoundRow> rows;
  for (const int threads : options.sweep)
    rows.push_back({threads_row(threads), library(threads)});
  for (const std::string& name : options.rows)
    if (name == "calotte")
      rows.push_back({"calotte", library(options.threads)});
    else if (name == "one-thread")
      rows.push_back({threads_row(1), library(1)});
    else if (name == "stripack" && has_stripack())
      rows.push_back({"STRIPACK", [=](auto& state) { run_serial(state, *work, options); },
                      options.stripack_limit});
  return rows;
}

/// Registered in the order of execution: sizes and sets alternate within a round.
void register_all(const Options& options) {
  std::vector<std::shared_ptr<Workload>> works;
  for (const std::int64_t n : options.sizes)
    for (const std::string& set : options.sets)
      works.push_back(make_workload(set, n));
  for (int round = 0; round < options.rounds; ++round)
    for (const auto& work : works)
      register_round(work->set, work->n, round, make_rows(options, work));
}

void add_options(CLI::App& app, Options& options) {
  add_grid_options(app, options.sets, options.sizes);
  app.add_option("--order", options.order,
                 "of the start: natural, coarse levels first, or shuffled; the library sorts them "
                 "anyway, STRIPACK is slower on shuffled ones")
      ->check(CLI::IsMember({"natural", "shuffled"}))
      ->capture_default_str();
  add_list_option(app, "--rows", options.rows, "what to time: calotte, one-thread, stripack",
                  CLI::IsMember({"calotte", "one-thread", "stripack"}));
  add_round_options(app, options);
  add_list_option(app, "--sweep", options.sweep,
                  "also time the library on these numbers of threads", CLI::PositiveNumber);
  app.add_option("--iterations", options.iterations,
                 "of each of the library's runs; the first " + std::to_string(warm_up) +
                     " are left out, and the median of the others counts")
      ->check(CLI::Range(warm_up + 1, 10000))
      ->capture_default_str();
  app.add_option("--stripack-limit", options.stripack_limit,
                 "most sites that STRIPACK is given; it is slow beyond")
      ->capture_default_str();
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  return run_program(
      argc, argv,
      {"Times one iteration of a centroidal Voronoi tessellation, interleaved with one of a serial "
       "program around STRIPACK.",
       has_stripack() ? std::map<std::string, std::string>{{"STRIPACK", ""}}
                      : std::map<std::string, std::string>{},
       [&](CLI::App& app) { add_options(app, options); }, [&] { register_all(options); }});
}
