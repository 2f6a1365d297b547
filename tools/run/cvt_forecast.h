// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

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
std::optional<Forecast> forecast(const CvtProgress& progress, const CvtOptions& options);

/// The progress line of a run.
std::string describe(const CvtProgress& progress, const CvtOptions& options,
                     const std::string& norm);

} // namespace calotte::tools
