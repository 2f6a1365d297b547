// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "grids/start.h"

#include <calotte/grid.h>

#include <algorithm>
#include <cstdint>

/// The first levels of runs, for tests that make the descents themselves.
namespace calotte::test {

struct FirstGenerators {
  Points3 start; ///< without the fixed ones; in the plane with z = 0
  int bisections = 0;
  bool icosahedral = false;
};

inline FirstGenerators first_generators(const Recipe& recipe) {
  const Schedule schedule = plan(recipe);
  return {grids_detail::free_generators(schedule),
          static_cast<int>(
              std::ranges::count(schedule.actions, CvtAction::Kind::bisect, &CvtAction::kind)),
          schedule.first == CvtStart::Kind::icosahedron};
}

inline Recipe recipe_of(CvtStart::Kind kind, std::int64_t cells, const Density& density,
                        std::uint64_t seed) {
  Recipe recipe;
  recipe.cells = cells;
  recipe.resolution = density;
  recipe.start.kind = kind;
  recipe.seed = seed;
  return recipe;
}

inline FirstGenerators continuation(std::int64_t cells, const Density& density,
                                    std::uint64_t seed = 1) {
  return first_generators(recipe_of(CvtStart::Kind::continuation, cells, density, seed));
}

inline FirstGenerators multilevel(std::int64_t cells, const Surface& surface,
                                  const Density& density, std::uint64_t seed = 1,
                                  const Points3& fixed = Points3(3, 0)) {
  Recipe recipe = recipe_of(CvtStart::Kind::multilevel, cells, density, seed);
  recipe.surface = surface;
  recipe.fixed = fixed;
  return first_generators(recipe);
}

} // namespace calotte::test
