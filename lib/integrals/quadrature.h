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
  std::span<const Node> nodes;
  int degree; ///< polynomials up to this degree are integrated exactly
};

/// The rule of 1, 3, 6, 7, 13 or 19 interior points: degrees 1, 2, 4, 5, 7 and 9 (Strang and Fix,
/// 1973; Dunavant, Int. J. Numer. Methods Eng. 21, 1985). \throws Error invalid_argument for
/// another number.
const QuadratureRule& quadrature_rule(int points);

} // namespace calotte::integrals_detail
