// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/axes.h"
#include "draw/history_report.h"

#include <array>
#include <vector>

namespace calotte::tools {

/// The quantity on the horizontal axis.
enum class Across { evaluations, seconds };

/// Frames in one column that share the horizontal axis.
struct HistoryColumn {
  Across quantity = Across::evaluations;
  Frame norms;   ///< up: a norm of the moves over h
  Frame energy;  ///< up: energy_excess
  Frame repairs; ///< up: a row for each run, the first on top
};

/// The layout of a picture of convergence, in pixels. The horizontal axes are logarithmic if a run
/// has more than twenty times the evaluations of another.
struct HistoryPage {
  int width = 0, height = 0;
  double text = 0;                      ///< size of the letters
  double levels = 0;                    ///< baseline of the first row that names levels
  std::array<HistoryColumn, 2> columns; ///< against evaluations, against seconds
};

HistoryPage history_page(const std::vector<History>& histories, int size);

inline constexpr double legend_row = 1.5;  ///< height of a line of the legend, in letters
inline constexpr double repairs_row = 1.5; ///< of a run's row of repairs

/// The horizontal position of each evaluation.
std::vector<double> positions(const History& history, Across across);

/// The position of the border before an evaluation: between two numbers, or at the clock time.
double border_before(const History& history, std::size_t evaluation, Across across);

/// True if a run has more than one level.
bool has_levels(const History& history);

} // namespace calotte::tools
