// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// Measures of the triangle around each vertex that MPAS files contain; 0 where there is none.
namespace calotte::io_detail {

/// Whether a vertex has three cells and three edges, as all of a closed mesh have.
bool has_triangle(const Voronoi& voronoi, std::int64_t vertex);

/// Shortest over longest side.
double side_quality(const Voronoi& voronoi, std::int64_t vertex);

/// Obtuse by more than rounding, as in Quality::obtuse.
bool is_obtuse(const Voronoi& voronoi, std::int64_t vertex);

/// Smallest over largest angle, of the vertices begin to end - 1.
void fill_angle_qualities(const Voronoi& voronoi, std::int64_t begin, std::int64_t end,
                          double* out);

} // namespace calotte::io_detail
