// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/mesh.h>

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::bench {

/// The names that `cloud` accepts.
const std::vector<std::string>& cloud_names();

/// Whether the sites of a set lie in the plane, otherwise on the sphere.
bool in_plane(const std::string& set);

/// About n sites of a set, in random order (as STRIPACK's documentation recommends): unit columns,
/// in the plane with z = 0:
///   random     on the sphere, independent and uniform;
///   bisection  the bisected icosahedron of the level nearest to n, shuffled;
///   uniform    in the unit square of the plane, independent;
///   clusters   in the plane, 20 Gaussian clusters of width 0.01;
///   line       in the plane, Gaussian about a line, 1e-6 wide.
/// Seeded: the same call gives the same sites.
Points3 cloud(const std::string& set, std::int64_t n);

/// Numbers of sites of bisected icosahedra: 42, 162 ... 10 * 4^level + 2.
const std::vector<std::int64_t>& bisected_sizes();

/// The level of a bisected icosahedron.
/// \throws std::invalid_argument if n is none of bisected_sizes().
int bisection_level(std::int64_t n);

/// The bisected icosahedron of n sites in its natural order, coarse levels first, except for two
/// sites: TRMESH rejects input whose first three sites lie on one great circle.
/// \throws std::invalid_argument as bisection_level().
Points3 natural_bisection(std::int64_t n);

/// The density of a set: uniform, or x8, the paper's bump with spacings 8 times finer inside
/// (Jacobsen et al., 2013, Sect. 4.3).
Density named_density(const std::string& set);

} // namespace calotte::bench
