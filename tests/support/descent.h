// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>

#include <doctest/doctest.h>

namespace calotte::test {

/// Accepted steps of a stage do not raise the energy, except for `rounding`, relative.
inline void check_descent(const CvtReport& report, double rounding) {
  const CvtIteration* before = nullptr;
  for (const CvtIteration& iteration : report.iterations) {
    if (!iteration.accepted)
      continue;
    if (before != nullptr && before->cells == iteration.cells && before->rule == iteration.rule &&
        before->linear_density == iteration.linear_density)
      CHECK(iteration.energy <= before->energy * (1 + rounding));
    before = &iteration;
  }
}

} // namespace calotte::test
