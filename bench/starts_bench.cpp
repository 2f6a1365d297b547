// SPDX-License-Identifier: GPL-3.0-or-later
// Times whole runs to a CVT from bisected and from Monte Carlo starts, in rounds, to the rms
// distance of generators from their centroids of 1e-6 on the unit sphere.

#include "clouds.h"
#include "cvt/cvt.h"
#include "program.h"
#include "support/starts.h"

#include <calotte/cvt.h>
#include <calotte/generators.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::bench {

namespace {

const std::map<std::string, Method> methods = {{"automatic", Method::automatic},
                                               {"lloyd", Method::lloyd},
                                               {"lbfgs", Method::lbfgs},
                                               {"lbfgs-laplacian", Method::lbfgs_laplacian}};

struct Options : RoundOptions {
  std::vector<std::string> sets = {"uniform"};
  std::vector<std::int64_t> sizes = {10242, 40962, 163842};
  std::vector<std::string> methods = {"automatic", "lloyd"};
  double tolerance = 1e-6;
  int limit = 3000;
  std::int64_t monte_carlo_limit = 200000;
};

CvtOptions cvt_options(const std::string& set, const std::string& method, const Options& options) {
  CvtOptions result;
  result.density = named_density(set);
  result.method = methods.at(method);
  result.norm = Norm::l2;
  result.tolerance = options.tolerance;
  result.max_iterations = options.limit;
  return result;
}

/// The cost of the finest level's evaluations, and the result of the run.
void add_counters(benchmark::State& state, const CvtReport& report, std::int64_t n, int threads) {
  std::vector<double> seconds;
  double exchange = 0, repair = 0, moments = 0, sum = 0;
  for (const CvtIteration& iteration : report.iterations) {
    if (iteration.cells != n)
      continue;
    seconds.push_back(iteration.seconds);
    sum += iteration.seconds * threads;
    exchange += iteration.seconds_exchange;
    repair += iteration.seconds_repair;
    moments += iteration.seconds_moments;
  }
  state.counters["evaluations"] = static_cast<double>(report.iterations.size());
  state.counters["evaluations of the finest level"] = static_cast<double>(seconds.size());
  state.counters["seconds an evaluation"] = median(seconds);
  state.counters["exchange"] = exchange / sum;
  state.counters["repair"] = repair / sum;
  state.counters["moments"] = moments / sum;
  state.counters["converged"] = report.converged ? 1 : 0;
  state.counters["l2"] = report.residual;
}

struct Start {
  Points3 points;
  int bisections = 0;
};

Start start_of(bool bisected, std::int64_t n, const Density& density) {
  if (!bisected)
    return {random_sphere(n, site_density(density)), 0};
  if (density.uniform()) { // the library itself starts such a run on its finest level
    const auto& sizes = bisected_sizes();
    const auto level = std::find(sizes.begin(), sizes.end(), n) - sizes.begin();
    return {bisected_icosahedron(1), static_cast<int>(level)};
  }
  const test::FirstGenerators from = test::continuation(n, density);
  return {from.start, from.bisections};
}

RoundRow row_of(const std::string& set, std::int64_t n, const std::string& method, bool bisected,
                const Options& options) {
  const auto run = [=](benchmark::State& state) {
    CvtOptions cvt_options = bench::cvt_options(set, method, options);
    const Start start = start_of(bisected, n, cvt_options.density);
    cvt_options.bisections = start.bisections;
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
    tbb::task_arena arena(options.threads);
    for (auto _ : state) {
      CvtReport report;
      arena.execute([&] { report = cvt(start.points, Surface::sphere(), cvt_options).report; });
      state.SetIterationTime(report.seconds);
      add_counters(state, report, n, options.threads);
    }
  };
  const std::string name = (bisected ? "bisection, " : "Monte Carlo, ") + method;
  return {name, run,
          bisected ? std::numeric_limits<std::int64_t>::max() : options.monte_carlo_limit};
}

void register_all(const Options& options) {
  for (int round = 0; round < options.rounds; ++round)
    for (const std::string& set : options.sets)
      for (const std::int64_t n : options.sizes) {
        std::vector<RoundRow> rows;
        for (const std::string& method : options.methods)
          for (const bool bisected : {true, false})
            rows.push_back(row_of(set, n, method, bisected, options));
        register_round(set, n, round, rows);
      }
}

void add_options(CLI::App& app, Options& options) {
  add_grid_options(app, options.sets, options.sizes);
  add_list_option(app, "--methods", options.methods, "automatic, lloyd, lbfgs, lbfgs-laplacian",
                  CLI::IsMember(methods));
  app.add_option("--tolerance", options.tolerance, "rms distance from the centroids, unit sphere")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--limit", options.limit, "most evaluations on each level")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--monte-carlo-limit", options.monte_carlo_limit,
                 "most cells that are started from random places")
      ->capture_default_str();
  add_round_options(app, options);
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.rounds = 3;
  return run_program(argc, argv,
                     {"Times whole runs to a CVT from bisected and from Monte Carlo starts.",
                      {},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&] { register_all(options); }});
}
