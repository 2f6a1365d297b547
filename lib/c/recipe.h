// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "c/guard.h"

#include <calotte/grid.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <Eigen/Core>

#include <cstdint>
#include <string>

namespace calotte::c_detail {

/// Points of a caller, without a copy.
/// \param rows numbers of a point.
/// \param name for the message.
/// \throws Error invalid_argument for a count out of range and for a null pointer to points.
Eigen::Map<const DoubleMatrix> points_of(const double* values, std::int64_t n, int rows,
                                         const std::string& name);

/// \param given null for the sphere. \throws Error invalid_argument.
Surface surface_of(const calotte_surface* given);

/// The recipe of a caller. It refers to the density of the caller and its data.
/// \throws Error invalid_argument.
Recipe recipe_of(const calotte_recipe* given);

} // namespace calotte::c_detail
