// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/room.h"

#include <calotte/density.h>
#include <calotte/surface.h>

#include <cstdint>

namespace calotte::grids_detail {

/// A run in a doubly periodic box, of which the cells between walls are taken. Beyond the walls the
/// box has a gap four cells wide, so that the cells at one wall are neighbours of none at the
/// other.
struct WallsRun {
  Surface box;
  Density density;        ///< of the box: that between the walls, beyond them of what is nearest
  std::int64_t cells = 0; ///< of the box
};

/// \param channel the periodic box of the request. \param cells wanted between the walls.
/// \throws Error as evaluate().
WallsRun run_between_walls(const Surface& channel, Walls walls, const Density& density,
                           std::int64_t cells);

} // namespace calotte::grids_detail
