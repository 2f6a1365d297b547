// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/shapes.h"

#include <Eigen/Core>

#include <vector>

namespace calotte::tools {

/// For each site the mean distance to its neighbours, in radians; in a plane in the scene's unit.
std::vector<double> mean_distances(const Scene& scene);

/// For each shape the quantity that colours it, NaN if it has none (an open cell of the sphere; the
/// domain closes those of a plane).
/// \param by_site for Colouring::density and field: n values.
/// \throws Error bad_option for the area or quality of cells of an open mesh.
std::vector<double> values_of(const Scene& scene, Colouring colouring,
                              const Eigen::VectorXd& by_site = {});

} // namespace calotte::tools
