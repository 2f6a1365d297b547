// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/grid.h>

#include <optional>
#include <string>

namespace calotte::tools {

/// The predicted end of a level.
struct Forecast {
  double seconds = 0;
  bool converges =
      false; ///< the norm reaches the tolerance; otherwise the limit of iterations ends the level
};

/// Extrapolates the decay of the norm over the last half of the level, 10 to 500 iterations: a
/// straight line through the logarithms of the accepted norms, and the mean time of all
/// evaluations, trials included. If the norm does not decrease, the prediction is the limit. No
/// prediction before 10 iterations.
/// \param action whose descent runs.
std::optional<Forecast> forecast(const CvtProgress& progress, const CvtAction& action);

/// Seconds that the rest of a run takes.
struct Remaining {
  double least = 0, most = 0;
};

/// Estimates them from the forecast of the descent and, if levels follow, the times of the current
/// one. The range is wide as long as levels or rounds of insertion follow.
std::optional<Remaining> remaining(const CvtProgress& progress, const Schedule& schedule);

/// The line of a run's progress and of its log: the level, the iteration, the norm, the energy, and
/// the time left.
std::string describe(const CvtProgress& progress, const Schedule& schedule);

} // namespace calotte::tools
