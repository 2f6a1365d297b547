// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/voronoi.h>

namespace calotte::detail {

/// The tessellation of a mesh whose sites stand at other points, without a copy of the mesh; else
/// as voronoi(mesh). \param points as many as the mesh's.
Voronoi voronoi_at(const Points3& points, const Mesh& mesh);

} // namespace calotte::detail
