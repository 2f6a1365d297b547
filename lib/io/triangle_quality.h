// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// What an MPAS file says of the shape of the triangle around each vertex.
namespace calotte::io_detail {

/// Shortest over longest side.
double side_quality(const Voronoi& voronoi, std::int64_t vertex);

/// By more than rounding, as Quality::obtuse has it.
bool is_obtuse(const Voronoi& voronoi, std::int64_t vertex);

/// Smallest over largest angle, of the vertices begin to end - 1.
void fill_angle_qualities(const Voronoi& voronoi, std::int64_t begin, std::int64_t end,
                          double* out);

} // namespace calotte::io_detail
