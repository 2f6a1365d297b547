// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/history_page.h"

#include "text/text.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace calotte::tools {

namespace {

constexpr double least_excess = 1e-14; ///< smaller differences of energies are rounding
constexpr std::size_t far_apart = 20;  ///< above this ratio of evaluations the axes are logarithmic

std::vector<double>
values_of_runs(const std::vector<History>& histories,
               const std::function<std::vector<double>(const History&)>& values) {
  std::vector<double> all;
  for (const History& history : histories) {
    const std::vector<double> own = values(history);
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

Axis norms_axis(const std::vector<History>& histories) {
  std::vector<double> all = values_of_runs(histories, scaled_l2);
  for (const auto& others :
       {values_of_runs(histories, scaled_linf), values_of_runs(histories, scaled_tolerance)}) {
    all.insert(all.end(), others.begin(), others.end());
  }
  return axis_around(all, true);
}

Axis energy_axis(const std::vector<History>& histories) {
  std::vector<double> all;
  for (const std::vector<double>& excesses : energy_excess(histories)) {
    for (const double excess : excesses) {
      all.push_back(excess > 0 ? std::max(excess, least_excess) : excess);
    }
  }
  return axis_around(all, true);
}

bool are_far_apart(const std::vector<History>& histories) {
  const auto shorter = [](const History& a, const History& b) {
    return a.iterations.size() < b.iterations.size();
  };
  const auto [least, most] = std::minmax_element(histories.begin(), histories.end(), shorter);
  return most->iterations.size() > far_apart * least->iterations.size();
}

Axis evaluations_axis(const std::vector<History>& histories) {
  std::size_t most = 1;
  for (const History& history : histories) {
    most = std::max(most, history.iterations.size());
  }
  const double margin = 0.01 * static_cast<double>(most);
  return {0.5 - margin, 0.5 + static_cast<double>(most) + margin};
}

Axis seconds_axis(const std::vector<History>& histories) {
  double most = 1e-9;
  for (const History& history : histories) {
    most = std::max(most, elapsed_seconds(history).back());
  }
  most = std::min(most, 1e100);
  return {-0.01 * most, 1.01 * most};
}

Axis across_axis(const std::vector<History>& histories, Across across) {
  if (are_far_apart(histories)) {
    const auto own = [&](const History& history) { return positions(history, across); };
    return axis_around(values_of_runs(histories, own), true, 0.01);
  }
  return across == Across::seconds ? seconds_axis(histories) : evaluations_axis(histories);
}

std::size_t count_with_levels(const std::vector<History>& histories) {
  return static_cast<std::size_t>(std::count_if(histories.begin(), histories.end(), has_levels));
}

} // namespace

std::vector<double> positions(const History& history, Across across) {
  return across == Across::seconds ? elapsed_seconds(history) : evaluation_numbers(history);
}

double border_before(const History& history, std::size_t evaluation, Across across) {
  return across == Across::seconds ? elapsed_seconds(history)[evaluation - 1]
                                   : static_cast<double>(evaluation) + 0.5;
}

bool has_levels(const History& history) { return level_starts(history).size() > 2; }

HistoryPage history_page(const std::vector<History>& histories, int size) {
  HistoryPage page;
  page.width = size;
  page.text = size / 80.0;
  const auto runs = static_cast<double>(histories.size());
  const auto rows = static_cast<double>(count_with_levels(histories));
  double y = 1.7 + legend_row * (runs + 1);
  page.levels = y * page.text;
  y += rows > 0 ? 1.1 * rows - 0.65 : -0.5;
  page.columns[1].quantity = Across::seconds;
  const auto frames = [&](Frame HistoryColumn::*position, double height, const Axis& up) {
    double left = 7;
    for (HistoryColumn& column : page.columns) {
      column.*position = {left * page.text,
                          y * page.text,
                          34 * page.text,
                          height * page.text,
                          across_axis(histories, column.quantity),
                          up};
      left += 38;
    }
    y += height + 1.1;
  };
  frames(&HistoryColumn::norms, 19, norms_axis(histories));
  frames(&HistoryColumn::energy, 15, energy_axis(histories));
  frames(&HistoryColumn::repairs, repairs_row * runs + 0.1, {0, runs});
  page.height = static_cast<int>(std::ceil((y + 2.5) * page.text));
  return page;
}

} // namespace calotte::tools
