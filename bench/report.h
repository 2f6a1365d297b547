// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <benchmark/benchmark.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace calotte::bench {

/// One row of one set: the measurements of all rounds, in the order they were made.
struct Series {
  std::map<int, double> seconds;                       ///< by round
  std::map<std::string, std::vector<double>> counters; ///< by name: one value a round
};

/// All series of one set of sites, by row, in the order of their first run.
struct SetResults {
  std::string set;
  std::int64_t sites = 0;
  std::vector<std::string> order;
  std::map<std::string, Series> rows;
};

/// A benchmark's name is set/n:SITES/round:ROUND/row. This reporter writes one line a run to the
/// error stream, and collects the runs for `print_tables`.
class RoundReporter : public benchmark::BenchmarkReporter {
public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  const std::vector<SetResults>& results() const { return results_; }
  bool failed() const { return failed_; }

private:
  Series& series(const std::string& name, int& round);
  std::vector<SetResults> results_;
  bool failed_ = false;
};

/// Markdown: for each set the rows' seconds and the ratios to `base`, paired by round; then the
/// stages of the library's rows; then the sweep over region counts; then each set's cost a site
/// against the first set's.
void print_tables(std::ostream& out, const std::vector<SetResults>& results,
                  const std::string& base);

} // namespace calotte::bench
