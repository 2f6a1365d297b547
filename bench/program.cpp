// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include "clouds.h"
#include "stripack.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace calotte::bench {

namespace {

using Json = nlohmann::ordered_json;

bool start_google_benchmark(char* program, std::vector<std::string> arguments) {
  std::vector<char*> argv = {program};
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  int argc = static_cast<int>(argv.size());
  argv.push_back(nullptr);
  benchmark::Initialize(&argc, argv.data());
  return !benchmark::ReportUnrecognizedArguments(argc, argv.data());
}

Json row_json(const std::string& name, const Series& series) {
  Json row = {{"row", name}, {"rounds", Json::array()}, {"seconds", Json::array()}};
  for (const auto& [round, seconds] : series.seconds) {
    row["rounds"].push_back(round);
    row["seconds"].push_back(seconds);
  }
  row["counters"] = series.counters;
  row["lists"] = series.lists;
  return row;
}

Json set_json(const SetResults& set) {
  Json rows = Json::array();
  for (const std::string& name : set.order) {
    rows.push_back(row_json(name, set.rows.at(name)));
  }
  return {{"set", set.set}, {"sites", set.sites}, {"rows", std::move(rows)}};
}

/// All samples of a run, with the information to repeat it.
void write_json(const std::string& file, const std::vector<std::string>& arguments,
                const Program& program, const RoundReporter& reporter) {
  Json sets = Json::array();
  for (const SetResults& set : reporter.results()) {
    sets.push_back(set_json(set));
  }
  const Json all = {{"program", std::filesystem::path(arguments.front()).filename().string()},
                    {"arguments", std::vector(arguments.begin() + 1, arguments.end())},
                    {"compiler", __VERSION__},
                    {"hardware_threads", std::thread::hardware_concurrency()},
                    {"stripack", has_stripack()},
                    {"peers", program.peers},
                    {"failures", reporter.failures()},
                    {"sets", std::move(sets)}};
  std::ofstream out(file);
  out << all.dump(1) << '\n';
  if (!out.flush()) {
    throw std::runtime_error(file + " cannot be written");
  }
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
  std::string json;
  program.add_options(app);
  app.add_option("--json", json, "also write the samples of every round to this file");
  app.allow_extras();
  app.footer("Google Benchmark's own options work too: --benchmark_filter, --benchmark_out, "
             "--benchmark_list_tests.\nExit codes: 0 done, 1 a result was wrong, 2 bad usage.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!start_google_benchmark(argv[0], app.remaining())) {
    return 2;
  }
  keep_memory();
  program.register_rows();
  program.print_head(std::cout);
  RoundReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  program.print_results(std::cout, reporter.results());
  if (!json.empty()) {
    write_json(json, {argv, argv + argc}, program, reporter);
  }
  return reporter.failures().empty() ? 0 : 1;
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
  app.add_option("--sets", sets, "densities: uniform, x8")
      ->delimiter(',')
      ->check(CLI::IsMember({"uniform", "x8"}))
      ->capture_default_str();
  app.add_option("--sizes", sizes, "numbers of cells: 42, 162 ... 10 * 4^level + 2")
      ->delimiter(',')
      ->check(CLI::IsMember(bisected_sizes()))
      ->capture_default_str();
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
