// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/grid.h>

namespace calotte::test {

/// A grid with its recipe and schedule.
struct Made {
  explicit Made(const Recipe& asked) : recipe(asked), schedule(plan(asked)) {
    mesh = make_grid(schedule).mesh;
  }
  Recipe recipe;
  Schedule schedule;
  Mesh mesh;
};

} // namespace calotte::test
