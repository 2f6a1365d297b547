// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/fields/room.h"

#include <calotte/field_grid.h>

#include <string>

namespace calotte::io_detail {

/// The centres of cells; of a mesh without cells of its own, its sites.
Points3 centres_of(const MeshFile& mesh);

/// Where values of a grid are: the centres of its cells, or its positions.
Points3 centres_of(const FieldGrid& grid);

/// \throws Error invalid_argument for grids on different surfaces.
void require_one_surface(const FieldGrid& source, const FieldGrid& target);

/// Requires a field without a dimension of size 0, such as times without records.
/// \param path of the grid. \throws Error parse, with the name of the dimension.
void require_records(const std::string& path, const FieldGrid& grid, FieldChoice choice);

} // namespace calotte::io_detail
