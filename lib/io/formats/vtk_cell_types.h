// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/poly_data.h"
#include "io/formats/room.h"

#include <cstdint>
#include <string>

namespace calotte::io_detail {

/// Types of cells that are read (vtkCellType.h).
inline constexpr std::int32_t triangle_type = 5, polygon_type = 7, quad_type = 9;

/// Accepts the cell types triangle (5), polygon (7) and quad (9) of VTK.
/// \param types one for each polygon.
/// \throws Error parse, naming the first cell of another type, or with a number of corners that its
/// type does not have.
void require_cell_types(const std::string& name, const PolyData& poly_data, const Ids& types,
                        const std::string& array = "types");

/// \throws Error parse, always: a file of triangle strips.
[[noreturn]] void refuse_strips(const std::string& name, std::int64_t strips);

} // namespace calotte::io_detail
