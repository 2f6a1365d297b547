// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/types.h>

#include <Eigen/SparseCore>

CALOTTE_API_BEGIN
namespace calotte {

/// How values at sites or of cells become values elsewhere. All but `conservative` are exact at the
/// sites.
enum class Interpolation {
  linear, ///< on each triangle, by the weights of locate()
  /// By the areas that a cell of the position would take from the cells of the sites around it
  /// (Sibson, Math. Proc. Camb. Phil. Soc. 87, 1980). Smooth except at the sites. In the plane it
  /// is exact for linear functions.
  natural_neighbours,
  nearest,      ///< the value at the nearest site
  conservative, ///< the mean over a cell by shared areas, see conservative_weights(); not at
                ///< positions
};

/// Weights of sites: a row for each position, a column for each site. The weights of a row are >= 0
/// and sum to 1; a row outside of an open mesh has none, unless it is of the nearest site.
using Weights = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The weights that interpolate from the sites of a mesh to positions on its surface.
/// \param mesh, positions as for locate().
/// \throws Error as locate(); invalid_argument for Interpolation::conservative.
Weights interpolation_weights(const Mesh& mesh, const PointsRef& positions,
                              Interpolation kind = Interpolation::linear);

/// Values at positions: the product of weights and values; NaN outside.
/// \param values by site.
/// \throws Error invalid_argument unless there is a value for each site.
DoubleVector interpolate(const Weights& weights, const DoubleVector& values);

} // namespace calotte
CALOTTE_API_END
