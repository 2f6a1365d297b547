// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace calotte::bench {

/// Options of every program that measures in rounds.
struct RoundOptions {
  int rounds = 7;
  int threads = 2; ///< of the library's rows
};

void add_round_options(CLI::App& app, RoundOptions& options);

/// An option of several values, separated by commas; all pass the check.
template <class Value>
void add_list_option(CLI::App& app, const std::string& name, std::vector<Value>& values,
                     const std::string& text, const CLI::Validator& check) {
  app.add_option(name, values, text)->delimiter(',')->check(check)->capture_default_str();
}

/// --sets, names of densities, and --sizes, of bisected icosahedra.
void add_grid_options(CLI::App& app, std::vector<std::string>& sets,
                      std::vector<std::int64_t>& sizes);

/// The name of the library's row for a number of threads.
std::string threads_row(int threads);

/// A row of every round, in sets of up to a number of sites.
struct RoundRow {
  std::string name;
  std::function<void(benchmark::State&)> run; ///< once a round; sets the iteration's time
  std::int64_t limit = std::numeric_limits<std::int64_t>::max(); ///< sites
};

/// Registers one round over one set: every row once, starting with the row whose number is that of
/// the round. A benchmark's name is set/n:SITES/round:ROUND/row, as bench/reporting/samples.py
/// reads it.
void register_round(const std::string& set, std::int64_t n, int round,
                    const std::vector<RoundRow>& rows);

/// Lists of numbers by name, such as one number a region. They become the run's label, as JSON:
/// Google Benchmark's counters are single numbers.
void set_lists(benchmark::State& state, const std::map<std::string, std::vector<double>>& lists);

double median(std::vector<double> values);

/// A program that measures rows in rounds.
struct Program {
  std::string purpose;                      ///< one line, for --help
  std::map<std::string, std::string> peers; ///< versions of the programs compared, by name
  std::function<void(CLI::App&)> add_options;
  std::function<void()> register_rows; ///< called after the options are read
};

/// The main function: reads the options, passes those that the program does not know to Google
/// Benchmark, and runs the rows, with a line for each on standard error. --benchmark_out=FILE keeps
/// the samples. It returns the exit code: 0 done, 1 a wrong result or a failure, 2 invalid usage.
int run_program(int argc, char** argv, const Program& program);

} // namespace calotte::bench
