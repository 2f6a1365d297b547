// SPDX-License-Identifier: GPL-3.0-or-later
// Times whole runs to a CVT from bisected and from Monte Carlo starts, to the rms distance of
// generators from their centroids of 1e-6 on the unit sphere.

#include "clouds.h"
#include "program.h"

#include <calotte/generators.h>
#include <calotte/grid.h>

#include <map>

namespace calotte::bench {

namespace {

/// Maximum number of cells of Monte Carlo starts, which take minutes beyond.
constexpr std::int64_t monte_carlo_limit = 200000;

constexpr int max_evaluations = 3000; ///< on each level

struct Options : RoundOptions {
  std::vector<std::string> methods = {"automatic", "lloyd"};
};

/// The cost of the finest level's evaluations, and the result of the run.
Sample sample_of(const CvtReport& report, std::int64_t n, int threads) {
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
  return {report.seconds,
          {{"evaluations", static_cast<double>(report.iterations.size())},
           {"on the finest level", static_cast<double>(seconds.size())},
           {"s per evaluation", median(seconds)},
           {"exchange", exchange / sum},
           {"triangulation", repair / sum},
           {"integration", moments / sum},
           {"converged", report.converged ? 1.0 : 0.0},
           {"final rms", report.residual}},
          {}};
}

Sample run(std::int64_t n, const std::string& method, bool bisected, const Options& options) {
  Recipe recipe{.stop = {.norm = Norm::l2, .tolerance = 1e-6, .max_iterations = max_evaluations},
                .method = method == "lloyd" ? Method::lloyd : Method::automatic};
  if (bisected)
    recipe.start = {.points = bisected_icosahedron(1), .bisections = bisection_level(n) - 1};
  else
    recipe.start = {.points = random_sphere(n, site_density(Density()))};
  CvtReport report;
  on_threads(options.threads, [&] { report = make_grid(recipe).report; });
  return sample_of(report, n, options.threads);
}

std::vector<Row> rows(std::int64_t n, const Options& options) {
  std::vector<Row> result;
  for (const std::string& method : options.methods)
    for (const bool bisected : {true, false})
      if (bisected || n <= monte_carlo_limit)
        result.push_back({(bisected ? "bisection, " : "Monte Carlo, ") + method,
                          [=, &options] { return run(n, method, bisected, options); }});
  return result;
}

void add_options(CLI::App& app, Options& options) {
  add_list_option(app, "--sizes", options.sizes, "numbers of cells: 42, 162 ... 10 * 4^level + 2",
                  CLI::IsMember(bisected_sizes()));
  add_list_option(app, "--methods", options.methods, "automatic, lloyd",
                  CLI::IsMember({"automatic", "lloyd"}));
  add_threads_option(app, options);
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  options.sets = {"uniform"};
  options.sizes = {10242, 40962, 163842};
  options.rounds = 3;
  return run_program(argc, argv, options,
                     {"Times whole runs to a CVT from bisected and from Monte Carlo starts.",
                      {},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&](const std::string&, std::int64_t n) { return rows(n, options); }});
}
