// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/axes.h"
#include "draw/history_report.h"

#include <array>
#include <vector>

namespace calotte::tools {

/// What runs from left to right.
enum class Across { evaluations, seconds };

/// Frames one below the other that share what runs from left to right.
struct HistoryColumn {
  Across quantity = Across::evaluations;
  Frame norms;   ///< up: a norm of the moves over h
  Frame energy;  ///< up: energy_excess
  Frame repairs; ///< up: a row for each run, the first on top
};

/// Where things stand in a picture of convergence, pixels. The axes across are logarithmic when a
/// run has more than twenty times the evaluations of another.
struct HistoryPage {
  int width = 0, height = 0;
  double text = 0;                      ///< size of the letters
  double levels = 0;                    ///< baseline of the first row that names levels
  std::array<HistoryColumn, 2> columns; ///< against evaluations, against seconds
};

HistoryPage history_page(const std::vector<History>& histories, int size);

inline constexpr double legend_row = 1.5;  ///< height of a line of the legend, in letters
inline constexpr double repairs_row = 1.5; ///< of a run's row of repairs

/// By evaluation its place across.
std::vector<double> places(const History& history, Across across);

/// The place of the border before an evaluation: between two numbers; where the clock stood.
double border_before(const History& history, std::size_t evaluation, Across across);

/// Whether a run has more than one level.
bool has_levels(const History& history);

} // namespace calotte::tools
