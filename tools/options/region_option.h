// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cell_width.h>
#include <calotte/region.h>

#include <string>

namespace calotte::tools {

/// The region of the word of --region: a file, or circle=LON,LAT,RADIUS,
/// ellipse=LON,LAT,MAJOR,MINOR,BEARING, channel=LOWER,UPPER or land=FILE,LON,LAT, see `calotte help
/// region`. Reads the file, if there is one.
/// \param radius_km radius of the sphere to which lengths in km refer.
/// \throws Error bad_option naming the word and the remedy; as read_region, read_coast and
///         land_around.
Region region_of(const std::string& word, double radius_km = earth_radius_km);

/// The file that the word names; empty if it names none.
std::string region_file(const std::string& word);

/// A fingerprint of the corners, a line for a run's configuration.
std::string region_configuration(const Region& region);

} // namespace calotte::tools
