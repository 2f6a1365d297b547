// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the evaluations that each method needs to reduce the rms distance of generators from their
// centroids below 1e-6, 1e-8 and 1e-10, starting from the bisected optimum of the next coarser
// level.

#include "clouds.h"
#include "cvt/cvt.h"
#include "program.h"
#include "report.h"
#include "support/starts.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <string>

namespace calotte::bench {

namespace {

const std::map<std::string, Method> methods = {{"lloyd", Method::lloyd},
                                               {"lbfgs", Method::lbfgs},
                                               {"lbfgs-laplacian", Method::lbfgs_laplacian}};

struct Goal {
  const char* name;
  double l2;
};
constexpr std::array<Goal, 3> goals{{{"1e-6", 1e-6}, {"1e-8", 1e-8}, {"1e-10", 1e-10}}};

struct Options {
  std::vector<std::int64_t> sizes = {2562, 10242};
  std::vector<std::string> sets = {"uniform", "x8"};
  std::vector<std::string> methods = {"lloyd", "lbfgs", "lbfgs-laplacian"};
  int limit = 3000;
};

CvtOptions options_of(const Density& density, Method method, int limit) {
  CvtOptions options;
  options.density = density;
  options.method = method;
  options.norm = Norm::l2;
  options.tolerance = goals.back().l2;
  options.max_iterations = limit;
  options.rule = options.final_rule = 6;
  return options;
}

/// The bisected optimum of the coarser level, by the default method.
Points3 start_of(std::int64_t cells, const Density& density) {
  const test::FirstGenerators from = test::continuation((cells - 2) / 4 + 2, density);
  CvtOptions options = options_of(density, Method::automatic, 3000);
  options.tolerance = 1e-9;
  options.bisections = from.bisections;
  return bisect(cvt(from.start, Surface::sphere(), options).mesh);
}

/// For each goal that was reached, the number of evaluations and the seconds.
void add_counters(benchmark::State& state, const CvtReport& report) {
  double seconds = 0, flips = 0, evaluations = 0;
  std::size_t next = 0;
  for (const CvtIteration& iteration : report.iterations) {
    ++evaluations;
    seconds += iteration.seconds + iteration.seconds_solver;
    flips += static_cast<double>(iteration.flips);
    for (; next < goals.size() && iteration.accepted && iteration.l2 <= goals[next].l2; ++next) {
      state.counters[std::string("evaluations ") + goals[next].name] = evaluations;
      state.counters[std::string("seconds ") + goals[next].name] = seconds;
    }
  }
  const CvtIteration& last = report.iterations.back();
  state.counters["energy x cells"] = last.energy * static_cast<double>(last.cells);
  state.counters["flips"] = flips;
}

void register_all(const Options& options) {
  for (const std::string& set : options.sets)
    for (const std::int64_t cells : options.sizes) {
      const auto start = std::make_shared<Points3>();
      std::vector<RoundRow> rows;
      for (const std::string& name : options.methods)
        rows.push_back({name, [=, limit = options.limit](benchmark::State& state) {
                          if (start->cols() == 0)
                            *start = start_of(cells, named_density(set));
                          const CvtOptions cvt_options =
                              options_of(named_density(set), methods.at(name), limit);
                          for (auto _ : state) {
                            const CvtReport report =
                                cvt(*start, Surface::sphere(), cvt_options).report;
                            state.SetIterationTime(report.seconds);
                            add_counters(state, report);
                          }
                        }});
      register_round(set, cells, 0, rows);
    }
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--sizes", options.sizes, "numbers of cells, 10 * 4^k + 2")
      ->delimiter(',')
      ->check(CLI::IsMember(bisected_sizes()));
  app.add_option("--sets", options.sets, "uniform, x8")
      ->delimiter(',')
      ->check(CLI::IsMember({"uniform", "x8"}));
  app.add_option("--methods", options.methods, "lloyd, lbfgs, lbfgs-laplacian")
      ->delimiter(',')
      ->check(CLI::IsMember(methods));
  app.add_option("--limit", options.limit, "most evaluations")->check(CLI::PositiveNumber);
}

void print_head(std::ostream& out, const Options& options) {
  out << "Evaluations (and seconds) to an rms distance of generators from their centroids, from "
         "the bisected optimum of the coarser level; at most "
      << options.limit
      << ".\n\n"
         "| start | method | 1e-6 | 1e-8 | 1e-10 | energy x cells | flips |\n"
         "| --- | --- | --: | --: | --: | --: | --: |\n";
}

void print_results(std::ostream& out, const std::vector<SetResults>& results) {
  for (const SetResults& set : results)
    for (const std::string& name : set.order) {
      const auto& counters = set.rows.at(name).counters;
      const auto value = [&](const std::string& counter) { return counters.at(counter).front(); };
      out << "| " << set.set << ' ' << set.sites << " | " << name << " |";
      for (const Goal& goal : goals) {
        const std::string evaluations = std::string("evaluations ") + goal.name;
        if (counters.contains(evaluations))
          out << ' ' << fixed(value(evaluations), 0) << " ("
              << fixed(value(std::string("seconds ") + goal.name), 2) << " s) |";
        else
          out << " - |";
      }
      out << ' ' << fixed(value("energy x cells"), 9) << " | " << fixed(value("flips"), 0)
          << " |\n";
    }
}

} // namespace

} // namespace calotte::bench

int main(int argc, char** argv) {
  using namespace calotte::bench;
  Options options;
  return run_program(argc, argv,
                     {"Counts the evaluations that each method of the CVT takes.",
                      {},
                      [&](CLI::App& app) { add_options(app, options); },
                      [&] { register_all(options); },
                      [&](std::ostream& out) { print_head(out, options); },
                      [](std::ostream& out, const auto& results) { print_results(out, results); }});
}
