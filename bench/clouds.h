// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::bench {

/// The names that `cloud` accepts: random, bisection, x8.
const std::vector<std::string>& cloud_names();

/// About n sites of a set, in random order (as STRIPACK's documentation recommends), 3 x n unit
/// columns:
///   random     independent and uniform;
///   bisection  the bisected icosahedron of the level nearest to n, shuffled;
///   x8         drawn from the density whose spacing is 8 times finer in a cap of 30 degrees
///              than far from it, with a smooth step between (Jacobsen et al., 2013, Sect. 3:
///              rho = 8^4 : 1; spacing follows rho^(-1/4), and sites rho^(1/2)).
/// Seeded: the same call gives the same sites.
Points3 cloud(const std::string& name, std::int64_t n);

/// Numbers of sites of bisected icosahedra: 42, 162 ... 10 * 4^level + 2.
const std::vector<std::int64_t>& bisected_sizes();

/// The bisected icosahedron of n sites in its natural order, coarse levels first, except for two
/// sites: TRMESH rejects input whose first three sites lie on one great circle.
/// \pre n is one of bisected_sizes().
Points3 natural_bisection(std::int64_t n);

/// The paper's bump with spacings 8 times finer inside (Jacobsen et al., 2013, Sect. 4.3).
Density x8_density();

/// The density of a set of that name: uniform, or the x8 bump.
Density named_density(const std::string& name);

} // namespace calotte::bench
