// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw_axes.h"
#include "draw_history_report.h"

#include <array>
#include <string>
#include <vector>

namespace calotte::tools {

inline constexpr std::size_t most_histories = 8; ///< in a picture: as many colours tell apart

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

/// The colour of a run by its number.
Rgb history_colour(std::size_t run);

/// Draws how runs of a CVT converged, against evaluations of the energy and against seconds: the
/// norms of the moves over h, with the tolerance; the energy's excess; flips and rebuilds; and
/// where a level ends. Curves go through what was accepted; the trials that were not count across.
/// \param size width in pixels; in points for SVG and PDF. 64 to 16384
/// \throws Error bad_option (also for no or too many runs), file.
void draw_history(const std::string& path, const std::vector<History>& histories, int size = 1200);

} // namespace calotte::tools
