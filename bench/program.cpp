// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include "clouds.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <exception>
#include <iostream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace calotte::bench {

namespace {

/// One line a run on the error stream.
class Progress : public benchmark::BenchmarkReporter {
public:
  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const std::string name = run.benchmark_name();
      std::cerr << name.substr(0, name.find("/iterations")) << ": ";
      if (run.error_occurred)
        std::cerr << run.error_message << '\n';
      else
        std::cerr << run.GetAdjustedRealTime() << " s\n";
      failed_ |= run.error_occurred;
    }
  }

  bool failed() const { return failed_; }

private:
  bool failed_ = false;
};

bool start_google_benchmark(char* program, std::vector<std::string> arguments) {
  std::vector<char*> argv = {program};
  for (std::string& argument : arguments)
    argv.push_back(argument.data());
  int argc = static_cast<int>(argv.size());
  argv.push_back(nullptr);
  benchmark::Initialize(&argc, argv.data());
  return !benchmark::ReportUnrecognizedArguments(argc, argv.data());
}

/// Keeps freed memory for the next round, for the peers and the library alike. Otherwise the system
/// reclaims large arrays at once; if the host of a virtual machine reclaims its free memory,
/// faulting it in again took 3 s per GiB, more than a triangulation in it. The library itself
/// returns the memory of more than 2^23 sites.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_ARENA_MAX, 1); // the two settings above do not affect the arenas of other threads
#endif
}

int run(int argc, char** argv, const Program& program) {
  CLI::App app{program.purpose};
  program.add_options(app);
  app.allow_extras();
  app.footer("Google Benchmark's own options work too: --benchmark_filter, --benchmark_out, "
             "--benchmark_list_tests.\nExit codes: 0 done, 1 a result was wrong, 2 bad usage.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!start_google_benchmark(argv[0], app.remaining()))
    return 2;
  benchmark::AddCustomContext("compiler", __VERSION__);
  for (const auto& [name, version] : program.peers)
    benchmark::AddCustomContext("peer " + name, version);
  keep_memory();
  program.register_rows();
  Progress progress;
  benchmark::RunSpecifiedBenchmarks(&progress);
  benchmark::Shutdown();
  return progress.failed() ? 1 : 0;
}

} // namespace

void add_round_options(CLI::App& app, RoundOptions& options) {
  app.add_option("--rounds", options.rounds, "how often every row runs")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads of the library's rows")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void add_grid_options(CLI::App& app, std::vector<std::string>& sets,
                      std::vector<std::int64_t>& sizes) {
  add_list_option(app, "--sets", sets, "densities: uniform, x8", CLI::IsMember({"uniform", "x8"}));
  add_list_option(app, "--sizes", sizes, "numbers of cells: 42, 162 ... 10 * 4^level + 2",
                  CLI::IsMember(bisected_sizes()));
}

std::string threads_row(int threads) {
  return "calotte " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

void register_round(const std::string& set, std::int64_t n, int round,
                    const std::vector<RoundRow>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RoundRow& row = rows[(i + static_cast<std::size_t>(round)) % rows.size()];
    if (n > row.limit)
      continue;
    const std::string name =
        set + "/n:" + std::to_string(n) + "/round:" + std::to_string(round) + "/" + row.name;
    benchmark::RegisterBenchmark(name.c_str(), row.run)
        ->Iterations(1)
        ->UseManualTime()
        ->Unit(benchmark::kSecond);
  }
}

void set_lists(benchmark::State& state, const std::map<std::string, std::vector<double>>& lists) {
  state.SetLabel(nlohmann::json(lists).dump());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values.at((values.size() - 1) / 2) + values.at(values.size() / 2)) / 2;
}

int run_program(int argc, char** argv, const Program& program) {
  try {
    return run(argc, argv, program);
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}

} // namespace calotte::bench
