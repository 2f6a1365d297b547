// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>
#include <ostream>
#include <utility>

namespace calotte::bench {

double quantile(std::vector<double> values, double p) {
  if (values.empty()) {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

double median(const std::vector<double>& values) { return quantile(values, 0.5); }

std::string fixed(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string scientific(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

std::string seconds_text(double s) {
  return fixed(s, s < 0.01 ? 6 : s < 0.1 ? 5 : s < 1 ? 4 : s < 10 ? 3 : 2);
}

std::string range_text(const std::vector<double>& values, double from, double to, int digits) {
  return fixed(quantile(values, from), digits) + " - " + fixed(quantile(values, to), digits);
}

std::vector<double> paired_ratios(const Series& row, const Series& base) {
  std::vector<double> ratios;
  for (const auto& [round, seconds] : row.seconds) {
    if (const auto found = base.seconds.find(round); found != base.seconds.end()) {
      ratios.push_back(seconds / found->second);
    }
  }
  return ratios;
}

std::vector<double> site_ratios(const SetResults& set, const SetResults& base,
                                const std::string& row) {
  std::vector<double> ratios = paired_ratios(set.rows.at(row), base.rows.at(row));
  for (double& ratio : ratios) {
    ratio *= static_cast<double>(base.sites) / static_cast<double>(set.sites);
  }
  return ratios;
}

std::string title(const SetResults& set) { return set.set + ", n = " + std::to_string(set.sites); }

namespace {

std::vector<double> values_of(const Series& series) {
  std::vector<double> values;
  for (const auto& [round, seconds] : series.seconds) {
    values.push_back(seconds);
  }
  return values;
}

bool is_sweep(const std::string& row) { return row.find(" regions") != std::string::npos; }

} // namespace

void print_times(std::ostream& out, const SetResults& set, const std::string& base) {
  out << "\n### " << title(set) << "\n\n"
      << "| run | rounds | median s | min - max s | CPU s | us a site | times " << base
      << " | quartiles | min - max |\n"
      << "| --- | --: | --: | --: | --: | --: | --: | --: | --: |\n";
  const auto found = set.rows.find(base);
  for (const std::string& name : set.order) {
    const Series& row = set.rows.at(name);
    const std::vector<double> s = values_of(row);
    out << "| " << name << " | " << s.size() << " | " << seconds_text(median(s)) << " | "
        << seconds_text(quantile(s, 0)) << " - " << seconds_text(quantile(s, 1)) << " | "
        << seconds_text(median(row.counters.at("cpu"))) << " | "
        << fixed(1e6 * median(s) / static_cast<double>(set.sites), 3) << " | ";
    if (found == set.rows.end()) {
      out << "| | |\n";
      continue;
    }
    const std::vector<double> r = paired_ratios(row, found->second);
    out << fixed(median(r), 2) << " | " << range_text(r, 0.25, 0.75, 2) << " | "
        << range_text(r, 0, 1, 2) << " |\n";
  }
}

namespace {

constexpr const char* stages[] = {"sites", "regions", "triangulate", "unite", "total"};

void print_stages(std::ostream& out, const SetResults& set) {
  const auto has_stages = [](const auto& row) { return row.second.counters.contains("total"); };
  if (std::none_of(set.rows.begin(), set.rows.end(), has_stages)) {
    return;
  }
  out << "\nStages, median seconds:\n\n"
      << "| run | sites | regions | triangulate | unite | total | regions used | overlap | exact "
         "predicates |\n"
      << "| --- | --: | --: | --: | --: | --: | --: | --: | --: |\n";
  for (const std::string& name : set.order) {
    const auto& counters = set.rows.at(name).counters;
    if (!counters.contains("total")) {
      continue;
    }
    out << "| " << name;
    for (const char* stage : stages) {
      out << " | " << seconds_text(median(counters.at(stage)));
    }
    out << " | " << fixed(median(counters.at("region count")), 0) << " | "
        << fixed(median(counters.at("overlap")), 3) << " | "
        << fixed(median(counters.at("exact")), 0) << " |\n";
  }
}

void print_sweep(std::ostream& out, const SetResults& set) {
  double best = HUGE_VAL;
  for (const auto& [name, row] : set.rows) {
    if (is_sweep(name)) {
      best = std::min(best, median(values_of(row)));
    }
  }
  if (best == HUGE_VAL) {
    return;
  }
  double worst = best;
  out << "\nBy number of regions, one thread:\n\n| run | median s | over the best | overlap |\n| "
         "--- | --: | --: | --: |\n";
  for (const std::string& name : set.order) {
    if (!is_sweep(name)) {
      continue;
    }
    const Series& row = set.rows.at(name);
    const double s = median(values_of(row));
    worst = std::max(worst, s);
    out << "| " << name << " | " << seconds_text(s) << " | " << fixed(100 * (s / best - 1), 1)
        << "% | " << fixed(median(row.counters.at("overlap")), 3) << " |\n";
  }
  out << "\nThe slowest takes " << fixed(100 * (worst / best - 1), 1)
      << "% longer than the best.\n";
}

/// Each later set's seconds a site over those of the first set of nearly the same size.
void print_sets(std::ostream& out, const std::vector<SetResults>& results,
                const std::string& base) {
  std::string lines;
  for (const SetResults& set : results) {
    const auto like = [&](const SetResults& other) {
      return other.set == results.front().set && other.sites <= 2 * set.sites &&
             set.sites <= 2 * other.sites;
    };
    const auto first = std::find_if(results.begin(), results.end(), like);
    if (set.set == results.front().set || first == results.end() || !set.rows.contains(base) ||
        !first->rows.contains(base)) {
      continue;
    }
    const std::vector<double> ratios = site_ratios(set, *first, base);
    lines += "| " + title(set) + " | " + fixed(median(ratios), 3) + " | " +
             range_text(ratios, 0, 1, 3) + " |\n";
  }
  if (!lines.empty()) {
    out << "\n### Cost a site of " << base << " against " << results.front().set
        << " sites\n\n| set | ratio | min - max |\n| --- | --: | --: |\n"
        << lines;
  }
}

} // namespace

namespace {

/// Of the current run; runs are sequential.
std::map<std::string, std::vector<double>>& pending_lists() {
  static std::map<std::string, std::vector<double>> lists;
  return lists;
}

} // namespace

void add_list(const std::string& name, std::vector<double> values) {
  pending_lists()[name] = std::move(values);
}

std::string threads_row(int threads) {
  return "calotte " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

void register_round(const std::string& set, std::int64_t n, int round,
                    const std::vector<RoundRow>& rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RoundRow& row = rows[(i + static_cast<std::size_t>(round)) % rows.size()];
    if (n > row.limit) {
      continue;
    }
    const std::string name =
        set + "/n:" + std::to_string(n) + "/round:" + std::to_string(round) + "/" + row.name;
    benchmark::RegisterBenchmark(name.c_str(), row.run)->Iterations(1)->UseManualTime();
  }
}

bool RoundReporter::ReportContext(const Context&) { return true; }

Series& RoundReporter::series(const std::string& name, int& round) {
  const std::size_t n_at = name.find("/n:");
  const std::size_t round_at = name.find("/round:");
  const std::size_t row_at = name.find('/', round_at + 1);
  // Google Benchmark appends /iterations:1/manual_time to the row's name.
  const std::string row = name.substr(row_at + 1, name.find('/', row_at + 1) - row_at - 1);
  const std::string set = name.substr(0, n_at);
  const std::int64_t sites = std::stoll(name.substr(n_at + 3));
  round = std::stoi(name.substr(round_at + 7));
  auto found = std::find_if(results_.begin(), results_.end(),
                            [&](const SetResults& r) { return r.set == set && r.sites == sites; });
  if (found == results_.end()) {
    found = results_.insert(found, {set, sites, {}, {}});
  }
  if (!found->rows.contains(row)) {
    found->order.push_back(row);
  }
  return found->rows[row];
}

void RoundReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const std::string name = run.benchmark_name();
    const auto lists = std::exchange(pending_lists(), {});
    if (run.error_occurred) {
      failures_.push_back(name + ": " + run.error_message);
      std::cerr << failures_.back() << '\n';
      continue;
    }
    int round = 0;
    Series& row = series(name, round);
    const double seconds = run.real_accumulated_time / static_cast<double>(run.iterations);
    row.seconds[round] = seconds;
    for (const auto& [counter, value] : run.counters) {
      row.counters[counter].push_back(value.value);
    }
    for (const auto& [list, values] : lists) {
      row.lists[list].push_back(values);
    }
    std::cerr << name.substr(0, name.find("/iterations")) << ": " << seconds_text(seconds)
              << " s\n";
  }
}

void print_tables(std::ostream& out, const std::vector<SetResults>& results,
                  const std::string& base) {
  for (const SetResults& set : results) {
    print_times(out, set, base);
    print_stages(out, set);
    print_sweep(out, set);
  }
  print_sets(out, results, base);
}

} // namespace calotte::bench
