// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/room.h"

#include <calotte/mesh.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// The masks of a limited area in MPAS files. The mask of the cells is a field; those of edges and
/// vertices are derived from it, see least_mask().
namespace calotte::io_detail {

inline constexpr const char* cell_mask = "bdyMaskCell";
std::string cell_mask_meaning(int rings); ///< its long_name

/// A derived mask.
struct DerivedMask {
  const char* name;
  const char* meaning; ///< its long_name
};
inline constexpr DerivedMask edge_mask{"bdyMaskEdge",
                                       "least bdyMaskCell of the cells on each edge"},
    vertex_mask{"bdyMaskVertex", "least bdyMaskCell of the cells on each vertex"};

/// By point: 1 if it is inside, else 0.
/// \param inside is called by several threads at once.
std::vector<std::uint8_t> flag_points(const Points3& points,
                                      const std::function<bool(const Eigen::Vector3d&)>& inside);

/// The mask of the cells among fields; none without a field of 32-bit integers of that name and
/// size.
std::optional<Ids> cell_mask_among(const std::vector<MeshField>& fields, std::int64_t cells);

/// Whether a name is that of a mask at edges or vertices, which is derived because the fields have
/// the mask of the cells.
bool is_derived_mask(const std::string& name, const std::vector<MeshField>& fields);

} // namespace calotte::io_detail
