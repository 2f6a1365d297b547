// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw_axes.h"
#include "draw_history_report.h"

#include <string>
#include <vector>

namespace calotte::tools {

inline constexpr std::size_t most_histories = 8; ///< in a picture: as many colours tell apart

/// Where things stand in a picture of convergence, pixels. The frames share the axis of iterations,
/// which count from 1 through all levels.
struct HistoryPage {
  int width = 0, height = 0;
  double text = 0;   ///< size of the letters
  double levels = 0; ///< baseline of the first row that names levels
  Frame norms;       ///< up: a norm of the moves over h
  Frame energy;      ///< up: energy_excess
  Frame repairs;     ///< up: a row for each run, the first on top
};

HistoryPage history_page(const std::vector<History>& histories, int size);

/// The colour of a run by its number.
Rgb history_colour(std::size_t run);

/// Draws how runs of a CVT converged: the norms of the moves over h against the iteration, with the
/// tolerance; the energy's excess; flips and rebuilds; and where a level ends.
/// \param size width in pixels; in points for SVG and PDF. 64 to 16384
/// \throws Error bad_option (also for no or too many runs), file.
void draw_history(const std::string& path, const std::vector<History>& histories, int size = 1200);

} // namespace calotte::tools
