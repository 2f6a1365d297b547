// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/voronoi.h>

#include <cstdint>

/// Measures of the triangle around each vertex, as in MPAS files; 0 where there is no triangle.
namespace calotte::io_detail {

/// Whether a vertex has three cells and three edges, as all vertices of a closed mesh.
bool has_triangle(const Voronoi& voronoi, std::int64_t vertex);

/// The shortest side divided by the longest one.
double side_quality(const Voronoi& voronoi, std::int64_t vertex);

/// Whether a triangle is obtuse by more than rounding, as in Quality::obtuse.
bool is_obtuse(const Voronoi& voronoi, std::int64_t vertex);

/// Fills in the smallest angle divided by the largest one, for the vertices begin to end - 1.
void fill_angle_qualities(const Voronoi& voronoi, std::int64_t begin, std::int64_t end,
                          double* out);

} // namespace calotte::io_detail
