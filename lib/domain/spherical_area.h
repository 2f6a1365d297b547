// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "domain/room.h"
#include "domain/side_cells.h"

#include <span>

/// Areas between rings of arcs, in steradians; they err by about 1e-15.
namespace calotte::domain_detail {

/// The area inside polygons, whose inside is to the left of every arc.
double area_inside(const SideCells& cells);

/// The area to the left of closed rings, from 0 to below 4 pi. Arcs that are passed in both
/// directions have no effect.
double area_to_the_left(std::span<const Arc> arcs);

/// The area to the left of closed rings, less 4 pi if the opposite of the origin is to the left. It
/// loses digits where an arc comes near that opposite.
double area_seen_from(const Vec3& origin, std::span<const Arc> arcs);

} // namespace calotte::domain_detail
