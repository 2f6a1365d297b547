// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/scale.h"
#include "draw/shapes.h"

#include <Eigen/Core>

#include <vector>

namespace calotte::tools {

/// \throws Error invalid_argument for the area or quality of cells, which an open mesh does not
/// have.
void require_closed_cells(Colouring colouring);

/// For each polygon its shortest over its longest side; NaN for one without corners.
DoubleVector side_ratios(const Polygons& cells);

/// For each site the mean distance to its neighbours, in radians; in a plane in the scene's unit.
std::vector<double> mean_distances(const Scene& scene);

/// For each site the number of its neighbours, or of the sides of its polygon if there is one;
/// where its triangles do not surround it, or its cell is clipped, boundary_valence in a plane and
/// NaN on the sphere. \param clipped by site; empty if no cell is.
std::vector<double> site_valences(const Scene& scene, const std::vector<bool>& clipped = {});

/// For each shape the quantity that colours it, NaN if it has none (an open cell of the sphere; the
/// domain closes those of a plane).
/// \param by_site for Colouring::density, field and region: n values.
/// \param clipped for Colouring::valence of a plane, as above.
/// \throws Error invalid_argument for the area or quality of cells of an open mesh.
std::vector<double> values_of(const Scene& scene, Colouring colouring,
                              const DoubleVector& by_site = {},
                              const std::vector<bool>& clipped = {});

} // namespace calotte::tools
