// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/room.h"

#include <calotte/raster.h>
#include <calotte/widths.h>

#include <iosfwd>
#include <string>

namespace calotte::io_detail {

/// Reads cell widths from polygons in GeoJSON; see read_cell_width().
Raster read_cell_width_geojson(std::istream& in, const std::string& name,
                               const PolygonWidths& widths);

} // namespace calotte::io_detail
