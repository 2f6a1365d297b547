// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace calotte::bench {

/// One row of one set: the measurements of all rounds, in chronological order.
struct Series {
  std::map<int, double> seconds;                       ///< by round
  std::map<std::string, std::vector<double>> counters; ///< by name: one value a round
  /// By name: one list per round, such as one value per region.
  std::map<std::string, std::vector<std::vector<double>>> lists;
};

/// All series of one set of sites, by row, in the order of their first run.
struct SetResults {
  std::string set;
  std::int64_t sites = 0;
  std::vector<std::string> order;
  std::map<std::string, Series> rows;
};

/// The p-quantile of unsorted values, linear between neighbours; 0 for no values.
double quantile(std::vector<double> values, double p);
double median(const std::vector<double>& values);

/// The ratio row / base for every round in which both ran.
std::vector<double> paired_ratios(const Series& row, const Series& base);

/// The ratio of a row's seconds per site to those of another set, for every round in which both
/// ran.
std::vector<double> site_ratios(const SetResults& set, const SetResults& base,
                                const std::string& row);

std::string fixed(double value, int digits);
/// With two significant digits.
std::string scientific(double value);
/// Seconds with about four significant digits.
std::string seconds_text(double s);
/// Two quantiles of the values, as "from - to".
std::string range_text(const std::vector<double>& values, double from, double to, int digits);
/// The set's name and its number of sites.
std::string title(const SetResults& set);

/// The name of the library's row for a number of threads.
std::string threads_row(int threads);

/// A row of every round, in sets of up to a number of sites.
struct RoundRow {
  std::string name;
  std::function<void(benchmark::State&)> run; ///< once a round; sets the iteration's time
  std::int64_t limit = std::numeric_limits<std::int64_t>::max(); ///< sites
};

/// Adds a list to the current run, whose counters hold single numbers only.
void add_list(const std::string& name, std::vector<double> values);

/// Registers one round over one set: every row once, starting with the row whose number is that of
/// the round.
void register_round(const std::string& set, std::int64_t n, int round,
                    const std::vector<RoundRow>& rows);

/// A benchmark's name is set/n:SITES/round:ROUND/row. This reporter writes one line a run to the
/// error stream, and collects the runs for `print_tables`.
class RoundReporter : public benchmark::BenchmarkReporter {
public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  const std::vector<SetResults>& results() const { return results_; }
  /// One line for each run that failed.
  const std::vector<std::string>& failures() const { return failures_; }

private:
  Series& series(const std::string& name, int& round);
  std::vector<SetResults> results_;
  std::vector<std::string> failures_;
};

/// Markdown: the seconds of a set's rows, and their ratios to `base`, paired by round. Rows have a
/// counter cpu.
void print_times(std::ostream& out, const SetResults& set, const std::string& base);

/// Markdown: for each set the rows' seconds and the ratios to `base`, paired by round; then the
/// stages of the library's rows; then the sweep over region counts; then each set's cost a site
/// against the first set's.
void print_tables(std::ostream& out, const std::vector<SetResults>& results,
                  const std::string& base);

} // namespace calotte::bench
