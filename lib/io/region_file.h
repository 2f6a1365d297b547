// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "io/room.h"

#include <calotte/error.h>
#include <calotte/region.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Readers of regions of the sphere, one a format; see read_region().
namespace calotte::io_detail {

/// Corners as unit vectors; the last leads back to the first.
using SphericalRing = std::vector<Vec3>;

/// A ring and its origin in the file, for messages.
struct RegionRing {
  SphericalRing corners;
  std::string origin; ///< a noun: "feature 2: ring 0", "the loop that begins in line 7"
};

/// All of a text as finite numbers with blanks, or one of comma, semicolon and bar, between; none
/// for any other text.
std::optional<std::vector<double>> numbers_of(std::string_view text);

/// Removes corners that repeat the one before, or at the end the first.
void drop_repeated(SphericalRing& ring);

/// Removes arcs that occur in both directions, in two rings or in one, and joins what is left of
/// these rings.
std::vector<RegionRing> joined(std::vector<RegionRing> rings);

/// The corners of each ring, 3 x n.
std::vector<Points3> corners_of(const std::vector<RegionRing>& rings);

/// The message of an error of these rings, in which each "ring N" becomes its origin, with the
/// file's name.
std::string explained(const std::string& name, const std::vector<RegionRing>& rings,
                      const Error& error);

Region read_region_geojson(std::istream& in, const std::string& name);

/// Point files of MPAS-Limited-Area.
Region read_region_pts(std::istream& in, const std::string& name);

/// Loops of MPI-SCVT.
/// \param counts of SaveLoopCounts, or null: all points are one loop.
Region read_region_loops(std::istream& in, const std::string& name, std::istream* counts,
                         const std::string& counts_name);

} // namespace calotte::io_detail
