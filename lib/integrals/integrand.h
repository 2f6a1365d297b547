// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/density_evaluator.h"
#include "integrals/quadrature.h"
#include "integrals/room.h"

#include <calotte/density.h>

#include <vector>

namespace calotte::integrals_detail {

/// The integrand over Voronoi cells and its rule: rho = 1 exactly, other densities by a rule on
/// each half kite, which is first divided into divisions^2 similar triangles.
struct Integrand {
  DensityEvaluator density;
  bool uniform = true;
  /// Whether the density is evaluated at the sites only and is linear on each triangle; false in a
  /// plane.
  bool at_sites = false;
  /// The nodes on all parts of a half kite, in threes; weights sum to 1. Empty for uniform density.
  std::vector<QuadratureRule::Node> nodes;
};

/// The rule of Integrand::at_sites.
inline constexpr int rule_at_sites = -1;

/// \param rule a number of points, see quadrature_rule(), or rule_at_sites.
/// \param divisions >= 1. Neither has an effect for uniform density.
/// \throws Error invalid_argument for an ill-formed density.
Integrand make_integrand(const Density& density, int rule, int divisions);

} // namespace calotte::integrals_detail
