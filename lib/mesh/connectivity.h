// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesh/room.h"

#include <calotte/types.h>

namespace calotte::mesh_detail {

/// A mesh without its points.
struct Connectivity {
  Triangles triangles;  ///< 3 x m vertex ids, counter-clockwise, in any order
  Triangles neighbours; ///< 3 x m, as Mesh's
};

} // namespace calotte::mesh_detail
