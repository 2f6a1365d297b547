// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <cstdint>
#include <vector>

/// Equal places among longitudes and latitudes.
namespace calotte::io_detail {

/// Places in the order in which they first come, so that neighbours are near each other in memory.
struct DistinctPlaces {
  std::vector<double> longitudes, latitudes; ///< degrees
  std::vector<std::int32_t> id;              ///< by input: its place
};

/// Longitudes that differ by whole turns are equal, and at a pole all longitudes. Linear time.
/// \param longitudes, latitudes in degrees, finite, as many of each, fewer than 2^31.
DistinctPlaces distinct_places(const std::vector<double>& longitudes,
                               const std::vector<double>& latitudes);

} // namespace calotte::io_detail
