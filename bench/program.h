// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdint>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace calotte::bench {

struct Timed {
  double seconds = 0;     ///< wall-clock
  double cpu_seconds = 0; ///< of all threads in that time
  double page_faults = 0; ///< pages of memory that they touched first
};

/// Pages of memory that this process has touched first so far.
double page_faults();

/// Measures from its construction.
class Stopwatch {
public:
  Timed stop() const {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    return {seconds, static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC,
            page_faults() - faults_};
  }

private:
  using Clock = std::chrono::steady_clock;
  double faults_ = page_faults();
  std::clock_t cpu_start_ = std::clock();
  Clock::time_point start_ = Clock::now();
};

/// Runs the library on a number of threads.
void on_threads(int threads, const std::function<void()>& work);

/// What a row measures in one round.
struct Sample {
  double seconds = 0;
  std::map<std::string, double> counters;
  /// Such as one number a region. They become the run's label, as JSON: Google Benchmark's counters
  /// are single numbers.
  std::map<std::string, std::vector<double>> lists;
};

/// With the counters cpu, of CPU seconds, and faults, where they are known.
Sample sample_of(const Timed& timed);

/// A row of every round. A wrong result is an exception, and no sample.
struct Row {
  std::string name;
  std::function<Sample()> run;
};

/// The name of the library's row for a number of threads.
std::string threads_row(int threads);

/// Options of every program.
struct RoundOptions {
  std::vector<std::string> sets;
  std::vector<std::int64_t> sizes; ///< numbers of sites or cells
  int rounds = 7;
  int threads = 2; ///< of the library's rows
};

/// An option of several values, separated by commas; all pass the check.
template <class Value>
void add_list_option(CLI::App& app, const std::string& name, std::vector<Value>& values,
                     const std::string& text, const CLI::Validator& check) {
  app.add_option(name, values, text)->delimiter(',')->check(check)->capture_default_str();
}

void add_threads_option(CLI::App& app, RoundOptions& options);

/// --sets uniform,x8, names of densities, and --sizes, of bisected icosahedra.
void add_grid_options(CLI::App& app, RoundOptions& options);

double median(std::vector<double> values);

/// A program that measures rows in rounds: each round runs every row once on the same sites, so
/// that a ratio of two rows of a round saw the same machine. The next round starts with the next
/// row. A benchmark's name is set/n:SITES/round:ROUND/row, as bench/report reads it.
struct Program {
  std::string purpose;                        ///< one line, for --help
  std::map<std::string, std::string> peers;   ///< versions of the programs compared, by name
  std::function<void(CLI::App&)> add_options; ///< beside --rounds
  std::function<std::vector<Row>(const std::string& set, std::int64_t n)> rows;
};

/// The main function: reads the options, passes those that the program does not know to Google
/// Benchmark, and runs the rows, with a line for each on standard error. --benchmark_out=FILE keeps
/// the samples. It returns the exit code: 0 done, 1 a wrong result or a failure, 2 invalid usage.
int run_program(int argc, char** argv, RoundOptions& options, const Program& program);

} // namespace calotte::bench
