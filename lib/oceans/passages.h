// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oceans/openings.h"

#include <calotte/mesh.h>

#include <vector>

namespace calotte::oceans_detail {

/// Passages with ways from both ends on through the sea, to where it is as wide as a cell: the
/// shortest along the edges of the mesh that do not return along the passage. An end from which no
/// way leads there stays.
std::vector<Points3> continued_passages(const ShoreMesh& shore, const std::vector<Points3>& lines);

} // namespace calotte::oceans_detail
