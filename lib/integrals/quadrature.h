// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "integrals/room.h"

#include <span>

namespace calotte::integrals_detail {

/// A quadrature rule on a triangle: points in barycentric coordinates, weights that sum to 1.
struct QuadratureRule {
  struct Node {
    double a, b, c; ///< sum to 1
    double weight;
  };
  std::span<const Node> nodes; ///< orbits of three
  int degree;                  ///< polynomials up to this degree are integrated exactly
};

/// The rule of 3 or 6 interior points: degrees 2 and 4 (Strang and Fix, 1973; Dunavant, Int. J.
/// Numer. Methods Eng. 21, 1985). \pre points is 3 or 6.
const QuadratureRule& quadrature_rule(int points);

} // namespace calotte::integrals_detail
