// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/surface.h>

#include <string>

/// Regions written to files.
CALOTTE_API_BEGIN
namespace calotte {

/// Writes a region of the sphere to GeoJSON (.geojson, .json), which read_region() reads: a polygon
/// of all its rings in degrees, longitude and latitude, each with the region to its left and its
/// first corner again at its end, and a point inside by the property "inside", since a polygon of
/// GeoJSON alone has no side on a sphere. The file is complete or absent, as with write().
/// \param region a part of the sphere with rings.
/// \throws Error invalid_argument for another surface, and for another suffix; file.
void write_region(const std::string& path, const Surface& region);

} // namespace calotte
CALOTTE_API_END
