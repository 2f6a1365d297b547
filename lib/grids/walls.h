// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/room.h"

#include <calotte/density.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::grids_detail {

/// A run in a doubly periodic box, of which the cells between walls are kept. Beyond the walls the
/// box has a gap four cells wide, so that no cell at one wall is a neighbour of a cell at the
/// other.
struct WallsRun {
  Surface box;
  Density density; ///< of the box: between the walls the given one, in the gap that of the nearest
                   ///< point
  std::int64_t cells = 0; ///< of the box
};

/// \param channel the periodic box of the request. \param cells wanted between the walls.
/// \throws Error as evaluate().
WallsRun run_between_walls(const Surface& channel, Walls walls, const Density& density,
                           std::int64_t cells);

} // namespace calotte::grids_detail
