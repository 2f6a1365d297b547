// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/mpas_subset.h"
#include "io/mpas/room.h"

#include <cstdint>
#include <vector>

namespace calotte::io_detail {

/// By kept edge: 1 if its second cell is kept, and its first one is not.
using ReversedEdges = std::vector<std::uint8_t>;
/// \throws Error parse, for a source without cellsOnEdge.
ReversedEdges reversed_edges(const MpasSource& source, const MpasPart& part);

/// Adds the changes of variables at reversed edges, and of kites of removed cells. The result
/// refers to all arguments.
void add_reversals(const MpasSource& source, const MpasPart& part, const ReversedEdges& reversed,
                   NetcdfSubset& subset);
void add_kites(const MpasSource& source, const MpasPart& part, NetcdfSubset& subset);

} // namespace calotte::io_detail
