// SPDX-License-Identifier: GPL-3.0-or-later
// Times one iteration of calotte::cvt from a bisected start beside one of a serial program around
// STRIPACK, in one process and in rounds: each round runs every row once on every set, so that a
// ratio of two rows of a round saw the same machine. The next round starts with the next row. All
// generators are compared; a difference ends in a message and exit code 1.

#include "clouds.h"
#include "cvt_tables.h"
#include "density_cost.h"
#include "lloyd.h"
#include "report.h"
#include "stripack.h"

#include <calotte/cvt.h>
#include <calotte/generators.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <memory>
#include <numbers>
#include <thread>

namespace calotte::bench {

namespace {

/// How far generators may differ after one iteration of n from the same points. A first moment's
/// terms are of the size h of a cell, the moment of its area h^2: rounding grows as 1/h, and at
/// 163 842 sites reaches some 6 roundoffs over h.
double tolerance(std::int64_t n) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
  return std::max(1e-13, 8 * 0x1p-53 / h);
}

struct Options {
  std::vector<std::string> sets = {"uniform", "x8"};
  std::vector<std::int64_t> sizes = {163842};
  std::vector<std::string> rows = {"calotte", "one-thread", "stripack"};
  std::string order = "natural";
  int rounds = 7;
  int threads = 2;
  int iterations = 12;
  int rule = 3;
  std::int64_t stripack_limit = 200000;
  int density_samples = 101;
};

/// The paper's bump with spacings 8 times finer inside (Jacobsen et al., 2013, Sect. 4.3).
Density x8_density() {
  const double latitude = std::numbers::pi / 6; // and longitude 270 degrees
  return tanh_bump({0, -std::cos(latitude), std::sin(latitude)}, std::numbers::pi / 6, 0.2,
                   1.0 / 4096);
}

/// One set of sites and what it is iterated with; made when first needed.
struct Workload {
  std::string set;
  std::int64_t n = 0;
  Target target;
  Points3 start;
  Points3 result;        ///< of the first of the library's runs
  Points3 before, after; ///< the library's generators around the first iteration that is timed
};

std::shared_ptr<Workload> make_workload(const std::string& set, std::int64_t n, int rule) {
  Workload work{set, n, {set == "x8" ? x8_density() : Density{}, rule}, {}, {}, {}, {}};
  return std::make_shared<Workload>(std::move(work));
}

/// Numbers of sites of bisected icosahedra, by level.
const std::vector<std::int64_t>& bisected_sizes() {
  static const std::vector<std::int64_t> sizes = [] {
    std::vector<std::int64_t> result;
    for (int level = 1; level <= 12; ++level)
      result.push_back(10 * (std::int64_t{1} << (2 * level)) + 2);
    return result;
  }();
  return sizes;
}

/// In its natural order, but for two sites: TRMESH refuses three first ones on one great circle.
Points3 natural_start(std::int64_t n) {
  const auto at = std::find(bisected_sizes().begin(), bisected_sizes().end(), n);
  Points3 points = bisected_icosahedron(static_cast<int>(at - bisected_sizes().begin()) + 1);
  const Eigen::Vector3d normal =
      Eigen::Vector3d(points.col(0)).cross(Eigen::Vector3d(points.col(1)));
  Eigen::Index third = 2;
  while (std::abs(normal.dot(points.col(third))) < 0.1)
    ++third;
  points.col(2).swap(points.col(third));
  return points;
}

Points3 bisected_start(std::int64_t n, const std::string& order) {
  return order == "shuffled" ? cloud("bisection", n) : natural_start(n);
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
    work.before = cvt(start, fixed_iterations(work.target, warm_up)).mesh.points;
    work.after = cvt(work.before, fixed_iterations(work.target, 1)).mesh.points;
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
      const std::string message = "generators differ from the library's by " +
                                  scientific(difference) + ", where rounding explains " +
                                  scientific(most);
      state.SkipWithError(message.c_str());
    }
  }
}

std::vector<RoundRow> make_rows(const Options& options, const std::shared_ptr<Workload>& work) {
  const auto library = [=](int threads) {
    return [=](benchmark::State& state) { run_library(state, *work, options, threads); };
  };
  std::vector<RoundRow> rows;
  for (const std::string& name : options.rows)
    if (name == "calotte")
      rows.push_back({"calotte", library(options.threads)});
    else if (name == "one-thread")
      rows.push_back({"calotte 1 thread", library(1)});
    else if (name == "stripack" && has_stripack())
      rows.push_back({"STRIPACK", [=](auto& state) { run_serial(state, *work, options); },
                      options.stripack_limit});
  return rows;
}

/// Registered in the order in which they are to run: sizes and sets take turns within a round.
void register_all(const Options& options) {
  std::vector<std::shared_ptr<Workload>> works;
  for (const std::int64_t n : options.sizes)
    for (const std::string& set : options.sets)
      works.push_back(make_workload(set, n, options.rule));
  for (int round = 0; round < options.rounds; ++round)
    for (const auto& work : works)
      register_round(work->set, work->n, round, make_rows(options, work));
}

void add_set_options(CLI::App& app, Options& options) {
  app.add_option("--sets", options.sets, "densities: uniform, x8")
      ->delimiter(',')
      ->check(CLI::IsMember({"uniform", "x8"}))
      ->capture_default_str();
  app.add_option("--sizes", options.sizes, "numbers of sites: 42, 162 ... 10 * 4^level + 2")
      ->delimiter(',')
      ->check(CLI::IsMember(bisected_sizes()))
      ->capture_default_str();
  app.add_option("--order", options.order,
                 "of the start: natural, coarse levels first, or shuffled; the library sorts them "
                 "anyway, STRIPACK is slower on shuffled ones")
      ->check(CLI::IsMember({"natural", "shuffled"}))
      ->capture_default_str();
  app.add_option("--rule", options.rule, "quadrature points on each half kite, for x8")
      ->check(CLI::IsMember({1, 3, 6, 7, 13, 19}))
      ->capture_default_str();
}

void add_run_options(CLI::App& app, Options& options) {
  app.add_option("--rows", options.rows, "what to time: calotte, one-thread, stripack, or none")
      ->delimiter(',')
      ->check(CLI::IsMember({"calotte", "one-thread", "stripack", "none"}))
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "how often every row runs")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads of the row calotte")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--iterations", options.iterations,
                 "of each of the library's runs; the first " + std::to_string(warm_up) +
                     " are left out, and the median of the others counts")
      ->check(CLI::Range(warm_up + 1, 10000))
      ->capture_default_str();
  app.add_option("--stripack-limit", options.stripack_limit,
                 "most sites that STRIPACK is given; it is slow beyond")
      ->capture_default_str();
  app.add_option("--density-samples", options.density_samples,
                 "how often the evaluation of the x8 bump is timed; 0 for not at all")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.allow_extras();
  app.footer("Google Benchmark's own options work too: --benchmark_filter, --benchmark_out, "
             "--benchmark_list_tests.\nExit codes: 0 done, 1 a result was wrong, 2 bad usage.");
}

void print_head(const Options& options) {
  const bool natural = options.order == "natural";
  std::cout << "# One iteration of a centroidal Voronoi tessellation: seconds and paired ratios\n\n"
            << "calotte on " << options.threads << " threads of "
            << std::thread::hardware_concurrency() << ", STRIPACK on one; compiler " << __VERSION__
            << "; " << options.rounds << " rounds, each runs every row once.\n"
            << "The start is a bisected icosahedron "
            << (natural
                    ? "in its own order, coarse levels first: STRIPACK is faster so than on a "
                      "shuffled one.\n"
                    : "in random order, as STRIPACK's documentation asks for; it is faster in the "
                      "natural one.\n")
            << "calotte's seconds are the median of its iterations " << warm_up + 1 << " to "
            << options.iterations << ", STRIPACK's those of iteration " << warm_up + 1
            << " alone: triangulation, lists, moments and step,\nx8 by the rule of " << options.rule
            << " points in both. The generators after that iteration must agree to 1e-13, or where "
               "rounding is larger to 8 roundoffs\nover h = sqrt(4 pi / n).\nA ratio is the row's "
               "seconds over calotte's of the same round. Where CPU seconds of a "
               "row with one thread are less than its seconds, the machine was busy.\n";
  if (!has_stripack())
    std::cout << "STRIPACK is left out: this program was built without libncarg-dev.\n";
}

} // namespace

int bench_main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times one iteration of a centroidal Voronoi tessellation, interleaved with one of "
               "a serial program around STRIPACK."};
  add_set_options(app, options);
  add_run_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!start_google_benchmark(argv[0], app.remaining()))
    return 2;
  register_all(options);
  RoundReporter reporter;
  print_head(options);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  print_iterations(std::cout, reporter.results(), "calotte");
  if (options.density_samples > 0)
    print_density_costs(std::cout, density_costs(x8_density(), {32, 512}, options.density_samples));
  return reporter.failed() ? 1 : 0;
}

} // namespace calotte::bench

int main(int argc, char** argv) {
  try {
    return calotte::bench::bench_main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "cvt_bench: " << error.what() << '\n';
    return 1;
  }
}
