// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/options.h"
#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/state.h"
#include "cvt/tessellation.h"
#include "mesh/connectivity.h"

#include <calotte/cvt.h>
#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cstdint>
#include <optional>
#include <vector>

/// The course of a run: its actions, and what each does to the generators.
///
///     start -> insert* -> [ bisect -> insert* ]* -> converge -> [ polish -> raise* ]
///
/// A descent follows each action, see CvtAction. Without insertion, the descent of the last
/// bisection is the last one before a polish. A glide is part of the descent before the polish, see
/// glide.h. A polish begins in subdomains, see polish.h.
namespace calotte::cvt_detail {

/// Whether the actions are in that order, and the values of each are within their range.
/// \param fixed number of generators that stay.
bool are_actions(const std::vector<CvtAction>& actions, std::int64_t fixed);

/// Whether a state's run has an action of a kind.
bool has(const State& state, CvtAction::Kind kind);

/// The last evaluation of the run that was accepted. \pre there is one.
const CvtIteration& last_accepted(const State& state);

/// Whether the last evaluations of a descent before a polish have hardly lowered the norm, see
/// course::creeping. Always true after glides that no descent follows.
bool creeps(const State& state, const DescentOptions& options);

/// Whether the last evaluations of a polish have hardly improved the worst shape.
bool has_stalled(const State& state);

/// The cursor of the descent after the current one; none at the end of the run.
std::optional<Cursor> next_cursor(const State& state);

/// The numbers of bisections, and of rounds of insertion on this level, after the current descent.
int bisections_left(const State& state);
int rounds_left(const State& state);

/// Whether dislocations may be moved: at the end of the descent before a polish, a few times.
bool may_glide(const State& state);

/// The limits of the next glide: at first a little within shape_limits, so that few shapes come
/// near these, then shape_limits, so that few are left to the penalty.
ShapeLimits limits_of_glide(const State& state);

/// The penalty of the current action; factors of 0 before a polish.
ShapePenalty penalty_of(const State& state, const CvtStop& stop);

/// The current descent.
/// \param density of the run, here and below as surface_density() gives it.
/// \param quadrature of the run, see Execution. In a run with insertion, the descents before
///        Kind::converge end with its first rule. Where the density is nearly linear between
///        generators, the rule at the sites replaces it.
DescentOptions make_descent_options(const State& state, const Recipe& recipe,
                                    const Density& density, const Quadrature& quadrature);

/// Begins the action at a cursor: changes the generators.
/// \param mesh of them, if it is known.
Level begin_action(State& state, const Cursor& cursor, const Surface& surface,
                   const Density& density, std::optional<Connectivity>&& mesh);

/// Adds a descent that has ended to the report of its action.
void add_done(State& state);

} // namespace calotte::cvt_detail
