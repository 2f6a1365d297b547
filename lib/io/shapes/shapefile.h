// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/geojson.h"
#include "io/shapes/room.h"

#include <string>

/// ESRI's shapefiles (ESRI Shapefile Technical Description, 1998), by shapelib.
namespace calotte::io_detail {

/// Passes the geometry of each record of NAME.shp, as GeoJSON has it: heights and measures are left
/// out; records without a shape, and those that NAME.dbf marks as deleted, are skipped. Of several
/// rings those that run as the largest one are outer rings, and each other ring is a hole of the
/// smallest outer ring around it, or where there is none a polygon. The numbers
/// in NAME.dbf are the properties. If the pair is longitude and latitude, NAME.prj must say degrees
/// east of Greenwich; without that file the coordinates must be within a turn and 90 degrees.
/// \throws Error parse, "PATH: shape 3: ..." with the remedy, also for a surface of several patches
///         (multipatch); file, if NAME.shx is missing.
void read_shapefile(const std::string& path, const GeoPair& pair, const GeometryVisit& visit);

} // namespace calotte::io_detail
