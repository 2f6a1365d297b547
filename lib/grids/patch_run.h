// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/patch.h"
#include "grids/room.h"

#include <calotte/grid.h>
#include <calotte/mesh.h>
#include <calotte/refine.h>

/// The run that makes new sites for a patch.
namespace calotte::grids_detail {

/// The replacement of a patch.
struct Replacement {
  /// The triangles within the rings, without neighbours; the fixed sites of the patch come first.
  /// In a periodic plane the points are unwrapped.
  Mesh mesh;
  std::int32_t on_boundary = 0; ///< the first of the sites after these, on the mesh's boundary
  DoubleVector width_ratio;     ///< by site that is not fixed, see ChangedMesh
  ChangedPatch change;
};

/// Widths that are known everywhere, not only at sites.
struct FineWidths {
  const Widths& widths;
  double scale; ///< from their unit to that of the mesh
};

/// Runs a patch on the surface that its rings bound, where its fixed sites stay and the mesh ends
/// at the rings. Other sites on these are replaced by generators along them, which slide.
/// \param own, wanted see wanted_widths(). \param fine limits widths between sites; null for none.
/// \throws Error as make_grid(); invalid_argument for a patch that leads around a periodic plane.
Replacement make_replacement(const Mesh& mesh, const PatchRegion& patch, const DoubleVector& own,
                             const DoubleVector& wanted, const FineWidths* fine,
                             const RefineOptions& options);

} // namespace calotte::grids_detail
