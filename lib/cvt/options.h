// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>

namespace calotte::cvt_detail {

/// Quadrature of a density over a cell, see make_integrand(). No effect for a uniform one.
struct Quadrature {
  int rule = 3; ///< points per half kite
  /// The finer rule. It is used once the norm is at most ten times the tolerance, or a line search
  /// fails. A descent converges with this rule only.
  int final_rule = 6;
  int divisions = 1; ///< of both
};

/// The options of the execution of a schedule.
struct Execution {
  Decomposition decomposition = {}; ///< affects time and memory, not the result
  /// The quadrature of the last descent and of a polish. It is coarser at a large tolerance and in
  /// other descents, see make_descent_options().
  Quadrature quadrature = {};
};

/// The options of a descent: its method, and where it ends.
struct DescentOptions {
  Method method = Method::automatic;
  Norm norm = Norm::none;
  double tolerance = 0;
  int max_iterations = 0;
  Quadrature quadrature = {};
  bool may_creep = false; ///< ends also where it creeps, see creeps()
};

} // namespace calotte::cvt_detail
