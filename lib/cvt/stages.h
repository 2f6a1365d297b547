// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cvt.h"
#include "cvt/insertion.h"
#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/state.h"
#include "cvt/tessellation.h"

#include <calotte/cvt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

/// The course of a run: descents, and what happens to the generators between two of them.
///
///     descent -> [ insert -> descent ]* -> [ bisect -> descent -> [ insert -> descent ]* ]*
///             -> [ glide ]* -> [ polish -> [ raise ]* ]
///
/// A glide is part of the descent before the polish, see glide.h.
namespace calotte::cvt_detail {

/// \throws Error invalid_argument for a value out of range.
void require_options(const CvtOptions& options);

/// What follows a descent.
enum class Stage {
  insert, ///< insertion and contraction on the same level
  bisect, ///< the next level
  polish, ///< a descent with the penalty of shape.h
  raise,  ///< the polish goes on with a larger penalty, where it fell short
  end,
};

/// The number of generators at the end of a level of a run with insertion.
template <class World>
std::int64_t cells_of_level(const World& world, std::int64_t cells, int bisections_left) {
  for (int k = 0; k < bisections_left; ++k)
    cells = world.halved(cells);
  return cells;
}

/// The last evaluation of the run that was accepted. \pre there is one.
const CvtIteration& last_accepted(const State& state);

/// Whether 45 evaluations of a descent before a polish have not halved the norm: generators glide
/// on along defects, where widths change too steeply or are noisy, and the grid hardly gets better.
bool creeps(const State& state, const CvtOptions& options);

/// Whether ten evaluations of a polish have hardly improved the worst shape.
bool has_stalled(const State& state);

Stage stage_after(const State& state, const CvtOptions& options);

/// Whether dislocations may be moved: at the end of the descent before a polish, up to four times.
bool may_glide(const State& state, const CvtOptions& options);

/// The limits of the next glide: twice a little within shape_limits, so that few shapes come near
/// these, then shape_limits, so that few are left to the penalty.
ShapeLimits limits_of_glide(const State& state);

/// The options of the current descent.
/// \param at_sites whether the cells can be integrated with rule_at_sites.
CvtOptions options_of_descent(const State& state, const CvtOptions& options, bool at_sites);

void begin_descent(State& state);

/// Coarser levels, where rounds are cheap, have more of them.
inline int rounds_of_level(int bisections_left, const CvtOptions& options) {
  constexpr int most = 14;
  return std::min(options.insertion_rounds * (bisections_left + 1),
                  std::max(options.insertion_rounds, most));
}

/// The tolerance, norm and number of evaluations of all descents but the last of a run with
/// insertion. \pre the run has insertion rounds and a norm.
CvtOptions early(const CvtOptions& options);

/// The levels of a run.
/// \param first number of generators of the start. \param bisections that follow.
template <class World>
std::vector<CvtLevel> levels_of(const World& world, std::int64_t first, int bisections,
                                const CvtOptions& options) {
  const bool inserts = options.insertion_rounds > 0, counted = options.norm == Norm::none;
  const CvtOptions here = inserts && !counted ? early(options) : options;
  std::vector<CvtLevel> levels;
  for (int left = bisections; left >= 0; --left) {
    levels.push_back({inserts ? cells_of_level(world, options.cells, left) : first,
                      inserts ? rounds_of_level(left, options) : 0, counted ? 0 : here.tolerance,
                      here.max_iterations});
    if (left > 0)
      first = world.bisected(first);
  }
  return levels;
}

/// A round after a descent of more than 15 evaluations counts for two: where widths are steep, a
/// round takes long and gains less.
inline int count_of_round(const State& state) {
  constexpr int steep = 15;
  return state.iterations_of_level > steep ? 2 : 1;
}

/// The next level.
template <class World, class AnyMesh>
Level begin_level(const World& world, State& state, const CvtOptions& options,
                  const AnyMesh& mesh) {
  Level level = world.set_bisected(state, mesh);
  --state.bisections_left;
  state.rounds_left = rounds_of_level(state.bisections_left, options);
  state.site_of_input.clear();
  begin_descent(state);
  return level;
}

/// The edges of a round: a twentieth of the dislocations that the density demands while rounds are
/// left, and the difference to the number of cells. Half of them give less energy, but the errors
/// of a model's vorticity, divergence and kinetic energy grow with the number of dislocations. With
/// fewer, cells are sheared, so that the stable step of gravity waves is shorter.
template <class AnyMesh>
EdgeChanges edge_changes_of(const State& state, const AnyMesh& mesh, const Density& density,
                            std::int64_t cells) {
  constexpr double share = 0.05; // of the dislocations
  constexpr double most = 0.02;  // of the generators
  const std::int64_t n = mesh.points.cols();
  std::int64_t both = 0;
  if (state.rounds_left > 0)
    both = static_cast<std::int64_t>(
        std::ceil(std::min(share * dislocations(mesh, density), most * static_cast<double>(n))));
  return {both + std::max<std::int64_t>(cells - n, 0), both + std::max<std::int64_t>(n - cells, 0),
          state.fixed};
}

/// A round of insertion and contraction.
template <class World, class AnyMesh>
Level begin_round(const World& world, State& state, const CvtOptions& options,
                  const AnyMesh& mesh) {
  Level level = world.set_split_and_collapsed(
      state, mesh, options.density,
      edge_changes_of(state, mesh, options.density,
                      cells_of_level(world, options.cells, state.bisections_left)));
  state.rounds_left = std::max(state.rounds_left - count_of_round(state), 0);
  state.site_of_input.clear();
  begin_descent(state);
  return level;
}

/// Sets the factor of the penalty and the demanded spacing from the last evaluation.
void begin_polish(State& state);

/// Raises the factor.
void begin_raised(State& state);

} // namespace calotte::cvt_detail
