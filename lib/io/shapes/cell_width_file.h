// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/room.h"

#include <calotte/cell_width.h>
#include <calotte/raster.h>

#include <iosfwd>
#include <string>

/// Readers of cell widths, one function per format; see read_cell_width().
namespace calotte::io_detail {

Raster read_cell_width_msh(std::istream& in, const std::string& name, const Surface& surface);
Raster read_cell_width_geojson(std::istream& in, const std::string& name,
                               const PolygonWidths& widths);

} // namespace calotte::io_detail
