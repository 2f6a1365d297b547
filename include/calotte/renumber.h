// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

CALOTTE_API_BEGIN
namespace calotte {

/// The order of the cells in a file.
enum class Numbering {
  by_format, ///< curve in NetCDF files, input in all others
  curve,     ///< along a space-filling curve
  input,     ///< the order of the sites in the mesh
};

/// The same mesh with its sites in another order and its triangles in canonical order. For a
/// Delaunay mesh the result is that of delaunay() for the permuted points. site_of_input maps each
/// input column to its new site. Numbering::curve keeps the order of sites that already follow the
/// curve. The time is linear.
/// \param mesh as delaunay() or read_mesh() returns it; it may be open.
/// \param numbering by_format and input return the mesh unchanged.
/// \throws Error invalid_argument for ids out of range, or neighbours that do not match the
///         triangles; with Numbering::curve not_finite and zero_vector (on the sphere), with the
///         index of the point.
Mesh renumbered(const Mesh& mesh, Numbering numbering);

} // namespace calotte
CALOTTE_API_END
