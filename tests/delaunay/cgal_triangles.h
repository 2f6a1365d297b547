// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <array>
#include <cstdint>
#include <vector>

/// CGAL's triangles, for sets in general position only: each counter-clockwise from its lowest
/// vertex, and ascending.
namespace calotte::test {

/// On the sphere, without the ghosts of an open boundary. CGAL merges sites nearer than 2^-23 and
/// treats the stored doubles as points on the sphere.
std::vector<std::array<std::int32_t, 3>> cgal_triangles(const Points3& points);

std::vector<std::array<std::int32_t, 3>> cgal_triangles(const Points2& points);

/// In the unit square whose opposite sides are one.
std::vector<std::array<std::int32_t, 3>> cgal_periodic_triangles(const Points2& points);

} // namespace calotte::test
