// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/room.h"

/// Points to start from: random sets, lattices, spirals, bisected icosahedra, geodesic nets, and
/// the midpoints that a bisection adds.
///
/// In: a number and a seed, or a mesh. Out: points; the same bits on every machine.
namespace calotte::generators_detail {
using namespace density_detail; // and the rooms below it
}
