// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/mesh_file.h>

#include <cstdint>

namespace calotte::tools {

/// A run in a doubly periodic box, of which the cells between walls are written. Beyond the walls
/// the box has a gap four cells wide, so that the cells at one wall are neighbours of none at the
/// other.
struct ChannelRun {
  PlanarDomain box;
  Density density;        ///< of the box: that of the channel, beyond a wall of what is nearest
  std::int64_t cells = 0; ///< of the box
};

/// \param channel the periodic box of the request. \param cells wanted between the walls.
/// \throws Error as evaluate().
ChannelRun channel_run(const PlanarDomain& channel, Walls walls, const Density& density,
                       std::int64_t cells);

} // namespace calotte::tools
