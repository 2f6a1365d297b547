// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt_tables.h"

#include <ostream>

namespace calotte::bench {

namespace {

using Counters = std::map<std::string, std::vector<double>>;

std::string percent(const Counters& counters, const std::string& name) {
  return fixed(100 * median(counters.at(name)), 1) + "%";
}

void print_shares(std::ostream& out, const SetResults& set) {
  std::string lines;
  for (const std::string& name : set.order) {
    const Counters& counters = set.rows.at(name).counters;
    if (!counters.contains("repair"))
      continue;
    const double shares = median(counters.at("exchange")) + median(counters.at("repair")) +
                          median(counters.at("moments"));
    lines += "| " + name + " | " + fixed(median(counters.at("median ns")), 1) + " | " +
             fixed(median(counters.at("mean ns")), 1) + " | " + percent(counters, "exchange") +
             " | " + percent(counters, "repair") + " | " + percent(counters, "moments") + " | " +
             fixed(100 * (1 - shares), 1) + "% | " + fixed(median(counters.at("flipped")), 0) +
             " | " + fixed(median(counters.at("flips")), 0) + " |\n";
  }
  if (!lines.empty())
    out << "\nA site and core (seconds x threads / sites), and what that is spent on:\n\n"
        << "| run | ns, median iteration | ns, mean | exchange | repair | moments and step | sums, "
           "waiting | iterations with flips | flips |\n"
        << "| --- | --: | --: | --: | --: | --: | --: | --: | --: |\n"
        << lines;
}

void print_serial_shares(std::ostream& out, const SetResults& set) {
  for (const std::string& name : set.order) {
    const Counters& counters = set.rows.at(name).counters;
    if (counters.contains("lists"))
      out << '\n'
          << name << ": " << fixed(median(counters.at("median ns")), 0) << " ns a site, "
          << percent(counters, "triangulate") << " for the triangulation, "
          << percent(counters, "lists") << " for reading its lists, "
          << percent(counters, "moments") << " for moments and step; generators within "
          << scientific(quantile(counters.at("difference"), 1)) << " of calotte's.\n";
  }
}

/// The smallest set of the same name that has measurements of the row.
const SetResults& smallest(const std::vector<SetResults>& results, const SetResults& set,
                           const std::string& row) {
  const SetResults* found = &set;
  for (const SetResults& other : results)
    if (other.set == set.set && other.rows.contains(row) && other.sites < found->sites)
      found = &other;
  return *found;
}

void print_cost_a_site(std::ostream& out, const std::vector<SetResults>& results) {
  std::string lines;
  for (const SetResults& set : results)
    for (const std::string& row : set.order) {
      const SetResults& base = smallest(results, set, row);
      if (&base == &set)
        continue;
      const std::vector<double> ratios = site_ratios(set, base, row);
      lines += "| " + title(set) + " | " + row + " | " +
               fixed(median(set.rows.at(row).counters.at("median ns")), 1) + " | " +
               std::to_string(base.sites) + " | " + fixed(median(ratios), 3) + " | " +
               range_text(ratios, 0, 1, 3) + " |\n";
    }
  if (!lines.empty())
    out << "\n### Cost a site as sets grow\n\n"
        << "| set | run | ns a site and core | against n = | ratio | min - max |\n"
        << "| --- | --- | --: | --: | --: | --: |\n"
        << lines;
}

} // namespace

void print_iterations(std::ostream& out, const std::vector<SetResults>& results,
                      const std::string& base) {
  for (const SetResults& set : results) {
    print_times(out, set, base);
    print_shares(out, set);
    print_serial_shares(out, set);
  }
  print_cost_a_site(out, results);
}

void print_density_costs(std::ostream& out, const std::vector<DensityCost>& costs) {
  out << "\n### One evaluation of the x8 density, one thread\n\n"
      << "| density | points in a row | median ns | quartiles | min - max |\n"
      << "| --- | --: | --: | --: | --: |\n";
  for (const DensityCost& cost : costs)
    out << "| " << cost.density << " | " << cost.row << " | " << fixed(median(cost.nanoseconds), 2)
        << " | " << range_text(cost.nanoseconds, 0.25, 0.75, 2) << " | "
        << range_text(cost.nanoseconds, 0, 1, 2) << " |\n";
}

} // namespace calotte::bench
