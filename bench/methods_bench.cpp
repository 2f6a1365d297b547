// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the evaluations that each method takes to bring the rms distance of generators from their
// centroids below 1e-6, 1e-8 and 1e-10, from the bisected optimum of the next coarser level.

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <CLI/CLI.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

namespace calotte::bench {

namespace {

struct Named {
  const char* name;
  Method method;
};

constexpr std::array<Named, 4> all_methods{{{"lloyd", Method::lloyd},
                                            {"nesterov", Method::nesterov},
                                            {"lbfgs", Method::lbfgs},
                                            {"lbfgs-laplacian", Method::lbfgs_laplacian}}};
constexpr std::array<double, 3> goals{1e-6, 1e-8, 1e-10};

struct Options {
  std::vector<std::int64_t> sizes = {2562, 10242};
  std::vector<std::string> sets = {"uniform", "x8"};
  std::vector<std::string> methods = {"lloyd", "nesterov", "lbfgs", "lbfgs-laplacian"};
  int limit = 3000;
};

/// The paper's x8 bump (Jacobsen et al., 2013, Sect. 4.3), or uniform.
Density density_of(const std::string& set) {
  if (set == "uniform") {
    return {};
  }
  constexpr double pi = std::numbers::pi;
  return tanh_bump({0, -std::cos(pi / 6), std::sin(pi / 6)}, pi / 6, 0.2, 1.0 / 4096);
}

CvtOptions options_of(const Density& density, Method method, int limit) {
  CvtOptions options;
  options.density = density;
  options.method = method;
  options.norm = Norm::l2;
  options.tolerance = goals.back();
  options.max_iterations = limit;
  options.rule = options.final_rule = 6;
  return options;
}

/// The bisected optimum of the coarser level, by the default method.
Points3 start_of(std::int64_t cells, const Density& density) {
  const Continuation from = continuation((cells - 2) / 4 + 2, density);
  CvtOptions options = options_of(density, Method::automatic, 3000);
  options.tolerance = 1e-9;
  options.bisections = from.bisections;
  return bisect(cvt(from.start, options).mesh);
}

void print_row(const std::string& set, const Named& named, const Cvt& grid) {
  const auto cells = static_cast<double>(grid.mesh.points.cols());
  std::printf("| %s %.0f | %s |", set.c_str(), cells, named.name);
  for (const double goal : goals) {
    double seconds = 0;
    std::size_t k = 0;
    const std::vector<CvtIteration>& all = grid.report.iterations;
    for (; k < all.size(); ++k) {
      seconds += all[k].seconds + all[k].seconds_solver;
      if (all[k].accepted && all[k].l2 <= goal) {
        break;
      }
    }
    if (k < all.size()) {
      std::printf(" %zu (%.2f s) |", k + 1, seconds);
    } else {
      std::printf(" - |");
    }
  }
  std::int64_t flips = 0;
  for (const CvtIteration& iteration : grid.report.iterations) {
    flips += iteration.flips;
  }
  const CvtIteration& last = grid.report.iterations.back();
  std::printf(" %.9f | %lld |\n", last.energy * cells, static_cast<long long>(flips));
  std::fflush(stdout);
}

void run(const Options& options) {
  std::printf(
      "Evaluations (and seconds) to an rms distance of generators from their centroids, from "
      "the bisected optimum of the coarser level; at most %d.\n\n"
      "| start | method | 1e-6 | 1e-8 | 1e-10 | energy x cells | flips |\n"
      "| --- | --- | --: | --: | --: | --: | --: |\n",
      options.limit);
  for (const std::string& set : options.sets) {
    for (const std::int64_t cells : options.sizes) {
      const Density density = density_of(set);
      const Points3 start = start_of(cells, density);
      for (const Named& named : all_methods) {
        if (std::find(options.methods.begin(), options.methods.end(), named.name) !=
            options.methods.end()) {
          print_row(set, named, cvt(start, options_of(density, named.method, options.limit)));
        }
      }
    }
  }
}

} // namespace

int bench_main(int argc, char** argv) {
  Options options;
  CLI::App app{"Counts the evaluations that each method of the CVT takes."};
  app.add_option("--sizes", options.sizes, "numbers of cells, 10 * 4^k + 2")->delimiter(',');
  app.add_option("--sets", options.sets, "uniform, x8")
      ->delimiter(',')
      ->check(CLI::IsMember({"uniform", "x8"}));
  app.add_option("--methods", options.methods, "lloyd, nesterov, lbfgs, lbfgs-laplacian")
      ->delimiter(',')
      ->check(CLI::IsMember({"lloyd", "nesterov", "lbfgs", "lbfgs-laplacian"}));
  app.add_option("--limit", options.limit, "most evaluations")->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  run(options);
  return 0;
}

} // namespace calotte::bench

int main(int argc, char** argv) {
  try {
    return calotte::bench::bench_main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "methods_bench: " << error.what() << '\n';
    return 1;
  }
}
