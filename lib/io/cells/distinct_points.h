// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <cstdint>
#include <vector>

/// Finds equal points among longitudes and latitudes.
namespace calotte::io_detail {

/// Points in the order of their first occurrence, so that neighbours are close in memory.
struct DistinctPoints {
  std::vector<double> longitudes, latitudes; ///< degrees
  std::vector<std::int32_t> id;              ///< by input: index of its point
};

/// Longitudes that differ by whole turns are equal. At a pole all longitudes are equal. Linear
/// time.
/// \param longitudes, latitudes in degrees, finite, as many of each, fewer than 2^31.
DistinctPoints find_distinct_points(const std::vector<double>& longitudes,
                                    const std::vector<double>& latitudes);

} // namespace calotte::io_detail
