// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/room.h"

/// Densities and cell widths: tanh bumps, rasters, polygons and callables, evaluated in batches,
/// bounded from above, and sampled. Widths::by_distance() and by_channel(), members of a class of
/// this room, are defined in the room oceans, which knows coasts.
///
/// In: a density or cell widths. Out: values at points, and random points distributed as a density.
namespace calotte::density_detail {
using namespace domain_detail; // and the rooms below it
}
