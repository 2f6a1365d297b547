// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "report.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <functional>
#include <iosfwd>
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

/// --sets, names of densities, and --sizes, of bisected icosahedra.
void add_grid_options(CLI::App& app, std::vector<std::string>& sets,
                      std::vector<std::int64_t>& sizes);

/// A program that measures rows in rounds.
struct Program {
  std::string purpose;                      ///< one line, for --help
  std::map<std::string, std::string> peers; ///< versions of the programs compared, by name
  std::function<void(CLI::App&)> add_options;
  std::function<void()> register_rows; ///< called after the options are read
  /// Markdown: the subject and the method of the measurements, printed before; the tables, printed
  /// after.
  std::function<void(std::ostream&)> print_head;
  std::function<void(std::ostream&, const std::vector<SetResults>&)> print_results;
};

/// The main function: reads the options, passes those that the program does not know to Google
/// Benchmark, runs the rows and prints their tables; with --json FILE, writes the samples of every
/// round. It returns the exit code: 0 done, 1 a wrong result or a failure, 2 invalid usage.
int run_program(int argc, char** argv, const Program& program);

} // namespace calotte::bench
