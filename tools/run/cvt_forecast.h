// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

#include <optional>
#include <string>

namespace calotte::tools {

/// When a level ends.
struct Forecast {
  double seconds = 0;
  bool converges = false; ///< the norm reaches the tolerance; else the limit of iterations ends it
};

/// From the decay of the norm over the level's last half, 10 to 500 iterations: a straight line
/// through its logarithms where they were accepted, and the mean of the seconds of all, which the
/// trials take part in. While the norm does not fall, the limit is foreseen; nothing before there
/// are 10 iterations.
std::optional<Forecast> forecast(const CvtProgress& progress, const CvtOptions& options);

/// Where a run stands: the line that progress shows.
std::string describe(const CvtProgress& progress, const CvtOptions& options,
                     const std::string& norm);

} // namespace calotte::tools
