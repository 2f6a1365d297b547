// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh_file.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace calotte::io_detail {

/// "Time (24), nVertLevels (55)".
std::string in_words(const std::vector<FieldDimension>& dimensions);

/// Whether a choice belongs to one of the dimensions, see find_indices().
/// \throws Error invalid_argument for a name that several of them contain.
bool belongs(const FieldIndex& choice, const std::vector<FieldDimension>& dimensions);

/// The field at indices, by dimension, without the dimensions that have one.
MeshField field_at_indices(MeshField field,
                           const std::vector<std::optional<std::int64_t>>& indices);

} // namespace calotte::io_detail
