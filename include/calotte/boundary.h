// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <vector>

/// Parts of the boundary of an open mesh, such as the open boundary of a model of the coastal
/// ocean. boundary_loops() gives the whole.
CALOTTE_API_BEGIN
namespace calotte {

/// The sites of the boundary that lie in a region, ascending.
/// \param mesh as for boundary_loops().
/// \param region a part of the mesh's surface.
/// \throws Error as boundary_loops(); as Surface::contains().
Ids boundary_sites(const Mesh& mesh, const Surface& region);

/// The sites of the boundary that lie near lines, ascending: within half the mean length of the
/// outer edges at the site.
/// \param mesh as for boundary_loops().
/// \param lines on the mesh's surface, as read_lines() returns them.
/// \throws Error as boundary_loops(); as Widths::by_distance() for lines that are none.
Ids boundary_sites(const Mesh& mesh, const std::vector<Points3>& lines);

} // namespace calotte
CALOTTE_API_END
