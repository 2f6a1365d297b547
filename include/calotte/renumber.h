// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

CALOTTE_API_BEGIN
namespace calotte {

/// How the cells of a file are numbered.
enum class Numbering {
  by_format, ///< curve where the cells are numbered anew for a model (NetCDF), else input
  curve,     ///< along a space-filling curve
  rcm,       ///< reverse Cuthill-McKee: small differences between neighbours
  input,     ///< as the mesh's sites
};

/// The same mesh with its sites in another order, and its triangles in the canonical order of
/// these: the mesh that spherical_delaunay() makes of the permuted points, where it is Delaunay.
/// site_of_input tells where the sites went. A mesh that is along the curve stays as it is;
/// by_format and input change nothing. Any mesh that read_mesh returns will do. Linear time.
/// \throws Error bad_option, for ids out of range; not_finite, zero_vector.
Mesh renumbered(const Mesh& mesh, Numbering numbering);

} // namespace calotte
CALOTTE_API_END
