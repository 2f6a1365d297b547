// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

/// The constants of a run's course. Limits of shapes are in shape.h; those of a method beside it.
///
/// What they buy was measured on four kinds of grids with three seeds each: x8 of 3 000 and 20 000
/// cells, one width in a region (1 400 cells), and widths of a gradient of 0.2 (4 000). Numbers are
/// medians over the seeds beside the values here, and the range of the four kinds: *work* is
/// evaluations times cells, *energy* that of the result. All grids are well-centred where nothing
/// else is said.
namespace calotte::cvt_detail::course {

// ---- Rounds of insertion and contraction

/// The most rounds of a level, which coarser ones have more of, as they are cheap there. It limits
/// large numbers of rounds; 5 makes no difference by default.
inline constexpr int most_rounds = 14;
/// Edges of each kind in a round, as a share of the dislocations that the density demands. Half of
/// them: energy +0.01 to +0.08%, and cells are sheared, so that the stable step of gravity waves is
/// shorter. Twice as many: energy -0.06 to +0.01%, work 1.01 to 1.08; but the errors of a model's
/// vorticity, divergence and kinetic energy grow with the number of dislocations.
inline constexpr double share_of_dislocations = 0.05;
/// At most this share of the generators: where a density jumps. No difference on these grids.
inline constexpr double share_of_generators = 0.02;
/// Evaluations of a descent after which a round counts for two: where widths are steep, a round
/// takes long and gains less. Without: work 0.99 to 1.20, energy -0.00 to +0.09%.
inline constexpr int steep = 25;
/// The number of generators is far from that of the level's end, as at a start from points that
/// were given, beyond a part of it and a few: rounds change it first, after descents of a few
/// evaluations.
inline constexpr std::int64_t far_part = 20, far_few = 10;
inline constexpr int evaluations_while_far = 8;
/// Rounds that bring the number of generators no nearer to that of the level's end: between fixed
/// ones there may be no edge left to split or to collapse.
inline constexpr int most_idle = 20;

// ---- Descents

/// The end of descents between rounds, in the norm l2_scaled. 1e-4: work 1.2 to 2.8, energy -0.03
/// to +0.12%. 1e-2: work 0.31 to 0.60, energy +0.04 to +0.23%, which is up to the excess over the
/// limit that a good grid has.
inline constexpr double early_tolerance = 1e-3;
/// And evaluations. 25: work 0.70 to 1.07, energy -0.08 to +0.05%. No limit: work 1.00 to 1.28.
inline constexpr int early_iterations = 75;
/// Generators from which on descents between rounds take no graph Laplacian, which takes as long as
/// five evaluations to make, and cells of the sphere are flat.
inline constexpr std::int64_t flat_from = 2000;
/// The widest cells, radians, over which a density is nearly linear; and how many generators tell.
inline constexpr double widest_linear = 0.25;
inline constexpr std::int64_t samples_of_widths = 4096;
/// The tolerance from which on the coarser quadrature ends a run.
inline constexpr double fine_tolerance = 1e-5;
/// Evaluations, after insertion and otherwise, that did not halve the norm of the last descent
/// before a polish: generators creep along defects, and glides take dislocations on faster. After
/// insertion only dislocations are out of balance; other starts are so everywhere. Without, after
/// insertion: work 2.2 to 4.0, energy -0.02 to +0.14%. 12: work 1.1 to 1.6.
inline constexpr int creeping_after_insertion = 6, creeping = 45;
inline constexpr double creeping_progress = 0.5;

// ---- Glides and the polish

/// Glides at the end of that descent. None: work 0.76 to 0.90, energy +0.02 to +0.13%, and one grid
/// of twelve is not well-centred.
inline constexpr int most_glides = 4;
/// Glides after which the descent goes on. All: work 1.2 to 1.4, energy -0.01 to +0.02%.
inline constexpr int glides_with_descent = 1;
/// Glides within limits that are a little narrower, so that few shapes come near those of the
/// penalty. None: energy +0.00 to +0.05%.
inline constexpr int early_glides = 3;
/// The penalty of an excess squared, in units of a cell's energy; how much larger it becomes where
/// the polish falls short, and how often. Glides leave little to it: a third or three times the
/// penalty, and no raise, make no difference on these grids. It serves fixed generators and
/// boundaries.
inline constexpr double penalty = 60, raise = 4;
inline constexpr int most_raised = 2;
/// Evaluations of a polish; and those that hardly improved the worst shape, which end it. No
/// difference on these grids, either.
inline constexpr int polish_iterations = 60, stall = 10;
inline constexpr double stall_progress = 0.95;

} // namespace calotte::cvt_detail::course
