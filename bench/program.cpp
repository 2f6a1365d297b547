// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include "clouds.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>

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
/// faulting it in again took 3 s per GiB, more than a triangulation in it.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_ARENA_MAX, 1); // the two settings above do not affect the arenas of other threads
#endif
}

/// Microseconds that the first touch of a small page costs here and now: on a virtual machine whose
/// host takes free memory back some 10, else about a quarter of one.
double cost_of_a_page_fault() {
  constexpr std::size_t bytes = std::size_t{256} << 20;
  void* const block =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED)
    throw std::bad_alloc();
#ifdef MADV_NOHUGEPAGE
  madvise(block, bytes, MADV_NOHUGEPAGE);
#endif
  const Stopwatch watch;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  for (std::size_t at = 0; at < bytes; at += page)
    static_cast<volatile char*>(block)[at] = 1;
  const Timed timed = watch.stop();
  munmap(block, bytes);
  return 1e6 * timed.seconds / timed.page_faults;
}

void run_row(benchmark::State& state, const Row& row) {
  for (auto _ : state)
    try {
      const Sample sample = row.run();
      state.SetIterationTime(sample.seconds);
      for (const auto& [name, value] : sample.counters)
        state.counters[name] = value;
      if (!sample.lists.empty())
        state.SetLabel(nlohmann::json(sample.lists).dump());
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
    }
}

/// In the order of execution; the sets alternate, too.
void register_rounds(const RoundOptions& options, const Program& program) {
  for (const std::int64_t n : options.sizes) {
    std::vector<std::vector<Row>> rows_of_sets;
    for (const std::string& set : options.sets)
      rows_of_sets.push_back(program.rows(set, n));
    for (int round = 0; round < options.rounds; ++round)
      for (std::size_t s = 0; s < rows_of_sets.size(); ++s)
        for (std::size_t i = 0; i < rows_of_sets[s].size(); ++i) {
          const std::vector<Row>& rows = rows_of_sets[s];
          const Row& row = rows[(i + static_cast<std::size_t>(round)) % rows.size()];
          const std::string name = options.sets[s] + "/n:" + std::to_string(n) +
                                   "/round:" + std::to_string(round) + "/" + row.name;
          benchmark::RegisterBenchmark(name.c_str(), [row](auto& state) { run_row(state, row); })
              ->Iterations(1)
              ->UseManualTime()
              ->Unit(benchmark::kSecond);
        }
  }
}

int run(int argc, char** argv, RoundOptions& options, const Program& program) {
  CLI::App app{program.purpose};
  app.add_option("--rounds", options.rounds, "how often every row runs; the last one given counts")
      ->check(CLI::PositiveNumber)
      ->take_last()
      ->capture_default_str();
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
  benchmark::AddCustomContext("page fault, us", std::to_string(cost_of_a_page_fault()));
  keep_memory();
  register_rounds(options, program);
  Progress progress;
  benchmark::RunSpecifiedBenchmarks(&progress);
  benchmark::Shutdown();
  return progress.failed() ? 1 : 0;
}

} // namespace

void on_threads(int threads, const std::function<void()>& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

Sample sample_of(const Timed& timed) {
  Sample sample{timed.seconds, {}, {}};
  if (timed.cpu_seconds > 0)
    sample.counters["cpu"] = timed.cpu_seconds;
  if (timed.page_faults > 0)
    sample.counters["faults"] = timed.page_faults;
  return sample;
}

double page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_minflt);
}

std::string threads_row(int threads) {
  return "calotte " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

void add_threads_option(CLI::App& app, RoundOptions& options) {
  app.add_option("--threads", options.threads, "threads of the library's rows")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void add_grid_options(CLI::App& app, RoundOptions& options) {
  add_list_option(app, "--sets", options.sets, "densities: uniform, x8",
                  CLI::IsMember({"uniform", "x8"}));
  add_list_option(app, "--sizes", options.sizes, "numbers of cells: 42, 162 ... 10 * 4^level + 2",
                  CLI::IsMember(bisected_sizes()));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values.at((values.size() - 1) / 2) + values.at(values.size() / 2)) / 2;
}

int run_program(int argc, char** argv, RoundOptions& options, const Program& program) {
  try {
    return run(argc, argv, options, program);
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << '\n';
    return 1;
  }
}

} // namespace calotte::bench
