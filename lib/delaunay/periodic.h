// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "delaunay/room.h"
#include "exact/plane_predicates.h"

#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <functional>
#include <vector>

namespace calotte::delaunay_detail {

/// Triangulates sites with copies in the plane, see delaunay.cpp.
using TriangulateImages = std::function<Mesh(std::vector<Image> images, const Vec2& period)>;

/// The Delaunay triangulation of a doubly periodic box: the function triangulates the sites with
/// their copies in a margin around the box and keeps one copy of each triangle. It is certified:
/// every circumcircle of a triangle at a site of the box lies where all copies are present;
/// otherwise the margin is doubled.
/// \param sites 3 x n with z = 0, distinct, in the box.
/// \throws Error too_few_sites if an empty circle is wider than half of the box: two triangles
///         could then share three sites, or one could have a site twice.
Mesh triangulate_periodic(const Points3& sites, const Surface& box,
                          const TriangulateImages& triangulate);

} // namespace calotte::delaunay_detail
