// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/legend.h"
#include "draw/painting.h"

#include <Eigen/Core>

/// Common code of the pictures of meshes of the sphere and of the plane.
namespace calotte::tools {

/// Sets the scale of the painting, and brings its values to the unit of the legend: on the sphere
/// km or degrees, angles in degrees, areas over their mean.
Legend make_legend(Painting& painting, const DrawOptions& options);

/// The values of the sites for Colouring::density, over their greatest, field and region; else
/// none. \throws Error invalid_argument for a density or field that does not fit.
DoubleVector by_site(const Mesh& mesh, const DrawOptions& options);

} // namespace calotte::tools
