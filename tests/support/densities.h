// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/constants.h"

#include <calotte/density.h>

#include <cmath>

namespace calotte::test {

/// The paper's x8 bump (Jacobsen et al., 2013, Sect. 4.3): around 270 E 30 N.
inline Density x8() {
  return tanh_bump({0, -std::cos(pi / 6), std::sin(pi / 6)}, pi / 6, 0.2, 1.0 / 4096);
}

/// The density max(0, z + shift) on the sphere: 0 on a cap around the south pole.
inline Density rising(double shift) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [shift](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (x.row(2).transpose().array() + shift).max(0);
  };
  return density;
}

} // namespace calotte::test
