// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "delaunay/room.h"
#include "exact/plane_predicates.h"

#include <calotte/types.h>

#include <functional>
#include <vector>

namespace calotte::delaunay_detail {

/// Triangulates sites with copies in the plane, see delaunay.cpp.
using TriangulateImages = std::function<PlanarMesh(std::vector<Image> images, const Vec2& period)>;

/// The Delaunay triangulation of a doubly periodic box: that of its sites with their copies in a
/// margin around it, of which one copy of each triangle is kept. Certified: every circle of a
/// triangle at a site of the box lies where all copies are; else the margin is doubled. \param
/// sites 2 x n, distinct, in the box. \throws Error too_few_sites, where an empty circle is wider
/// than half of the box: two triangles
///         might share three sites then, or one have a site twice.
PlanarMesh triangulate_periodic(const Points2& sites, const Eigen::Vector2d& period,
                                const TriangulateImages& triangulate);

/// \throws Error bad_option for a period that is not positive and finite, or a point outside.
void require_in_box(const Points2Ref& points, const Eigen::Vector2d& period);

} // namespace calotte::delaunay_detail
