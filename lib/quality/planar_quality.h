// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/room.h"

#include <calotte/quality.h>

namespace calotte::quality_detail {

/// What triangle_quality() measures in a plane, and with `cells` what open_quality() does.
/// \throws Error as these.
Quality measure_open_plane(const PlanarMesh& mesh, bool cells);

} // namespace calotte::quality_detail
