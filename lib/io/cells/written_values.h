// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>
#include <calotte/write.h>

#include <cstdint>
#include <span>
#include <string>

/// The values that are written with a mesh: the density of its sites, and fields.
namespace calotte::io_detail {

struct MeshSizes {
  std::int64_t sites, triangles;
  bool closed; ///< each edge belongs to two triangles
};

/// \throws Error invalid_argument, for values that do not fit the mesh.
void require_values(const std::string& path, const MeshSizes& mesh, const WriteOptions& options);

/// Reorders the values of the options as the sites, edges and triangles of a mesh are renumbered.
/// \param new_site by old site.
void renumber_values(const Mesh& mesh, std::span<const std::int32_t> new_site,
                     WriteOptions& options);

} // namespace calotte::io_detail
