// SPDX-License-Identifier: GPL-3.0-or-later
// Times what a full MPAS mesh costs beside the triangulation that it is of, in rounds: the
// triangulation, the connectivity alone, and the file, connectivity included, on the disk.

#include "report.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/io.h>
#include <calotte/voronoi.h>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <chrono>
#include <ctime>
#include <exception>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

namespace calotte::bench {
namespace {

struct Options {
  int level = 9, rounds = 5, threads = 2;
  std::string folder = ".";
};

/// A row that times a body once a round.
RoundRow row_of(const std::string& name, const std::function<void()>& body) {
  return {name, [=](benchmark::State& state) {
            for (auto _ : state) {
              const std::clock_t cpu = std::clock();
              const auto start = std::chrono::steady_clock::now();
              body();
              const std::chrono::duration<double> s = std::chrono::steady_clock::now() - start;
              state.SetIterationTime(s.count());
              state.counters["cpu"] = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
            }
          }};
}

void register_all(const Options& options, const Mesh& mesh, const std::filesystem::path& file) {
  for (int round = 0; round < options.rounds; ++round)
    register_round("bisection", mesh.points.cols(), round,
                   {row_of("delaunay", [&mesh] { delaunay(mesh.points); }),
                    row_of("voronoi", [&mesh] { voronoi(mesh); }), row_of("write", [&mesh, file] {
                      write(file, mesh, {.sphere_radius = 6371229});
                    })});
}

int bench_main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times writing a full MPAS mesh beside the triangulation it is of."};
  app.add_option("--level", options.level, "of the bisected icosahedron: 10 x 4^level + 2 cells")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  app.add_option("--folder", options.folder, "where the file is written, and removed at the end")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  app.add_option("--rounds", options.rounds, "how often every row runs")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "of all rows")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!start_google_benchmark(argv[0], {}))
    return 2;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(options.threads));
  const Mesh mesh = renumbered(delaunay(bisected_icosahedron(options.level)), Numbering::curve);
  const auto file = std::filesystem::path(options.folder) / "files_bench.nc";
  register_all(options, mesh, file);
  std::cout << "# A full MPAS mesh: seconds and ratios to its triangulation, " << options.threads
            << " threads\n";
  RoundReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  std::filesystem::remove(file);
  std::filesystem::remove(std::filesystem::path(file).replace_extension(".graph.info"));
  print_times(std::cout, reporter.results().front(), "delaunay");
  return reporter.failed() ? 1 : 0;
}

} // namespace
} // namespace calotte::bench

int main(int argc, char** argv) {
  try {
    return calotte::bench::bench_main(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "files_bench: " << error.what() << '\n';
    return 1;
  }
}
