// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/cvt.h"
#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/state.h"
#include "cvt/tessellation.h"

#include <calotte/cvt.h>
#include <calotte/surface.h>
#include <calotte/types.h>

#include <algorithm>
#include <cstdint>
#include <vector>

/// The course of a run: descents, and what happens to the generators between two of them.
///
///     descent -> [ insert -> descent ]* -> [ bisect -> descent -> [ insert -> descent ]* ]*
///             -> [ glide -> descent -> glide* ] -> [ polish -> [ raise ]* ]
///
/// A glide is part of the descent before the polish, see glide.h; a polish begins in subdomains,
/// see polish.h.
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
std::int64_t cells_of_level(const Surface& surface, std::int64_t cells, int bisections_left);

/// The last evaluation of the run that was accepted. \pre there is one.
const CvtIteration& last_accepted(const State& state);

/// Whether the last six evaluations of a descent before a polish have not halved the norm, or the
/// last 45 of a run without insertion: generators creep along defects, and glides take dislocations
/// on faster. After the second glide, always: a descent follows the first only.
bool creeps(const State& state, const CvtOptions& options);

/// Whether ten evaluations of a polish have hardly improved the worst shape.
bool has_stalled(const State& state);

Stage stage_after(const State& state, const CvtOptions& options);

/// Whether dislocations may be moved: at the end of the descent before a polish, up to four times.
bool may_glide(const State& state, const CvtOptions& options);

/// The limits of the next glide: three times a little within shape_limits, so that few shapes come
/// near these, then shape_limits, so that few are left to the penalty.
ShapeLimits limits_of_glide(const State& state);

/// The options of the current descent.
CvtOptions options_of_descent(const State& state, const Surface& surface,
                              const CvtOptions& options);

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
std::vector<CvtLevel> levels_of(const Surface& surface, std::int64_t first, int bisections,
                                const CvtOptions& options);

/// The next level.
Level begin_level(State& state, const CvtOptions& options, const Mesh& mesh);

/// A round of insertion and contraction.
Level begin_round(State& state, const CvtOptions& options, const Mesh& mesh);

/// Sets the factor of the penalty and the demanded spacing from the last evaluation.
void begin_polish(State& state);

/// Raises the factor.
void begin_raised(State& state);

} // namespace calotte::cvt_detail
