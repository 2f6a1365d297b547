// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/history_page.h"

#include <string>
#include <vector>

namespace calotte::tools {

inline constexpr std::size_t most_histories =
    8; ///< in a picture: the number of distinguishable colours

/// The colour of a run by its number.
Rgb history_colour(std::size_t run);

/// Draws the convergence of CVT runs, against evaluations of the energy and against seconds: the
/// norms of the moves over h, with the tolerance; the energy's excess; flips and rebuilds; and the
/// ends of the levels. Curves connect accepted evaluations; rejected trials count on the horizontal
/// axis.
/// \param size width in pixels; in points for SVG and PDF. 64 to 16384
/// \throws Error invalid_argument (also for no or too many runs), file.
void draw_history(const std::string& path, const std::vector<History>& histories, int size = 1200);

} // namespace calotte::tools
