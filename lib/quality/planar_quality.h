// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/quality.h>

/// What quality() and its kin measure in the plane.
namespace calotte::quality_detail {

/// \throws Error as quality() and cell_measures().
Quality quality_in_plane(const Mesh& mesh, const Density& density);
CellMeasures cell_measures_in_plane(const Mesh& mesh, const Density& density);

/// What triangle_quality() measures in a plane, and with `cells` what open_quality() does.
/// \throws Error as these.
Quality measure_open_plane(const Mesh& mesh, bool cells);

} // namespace calotte::quality_detail
