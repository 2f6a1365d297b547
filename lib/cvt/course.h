// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

/// The constants of a run's course. The limits of shapes are in shape.h; the constants of a method
/// are in its file.
///
/// The effect of each was measured on four kinds of grids with three seeds each: x8 of 3 000 and
/// 20 000 cells, one width in a region (1 400 cells), and widths of a gradient of 0.2 (4 000
/// cells). A comment gives other values and their results relative to the value here: medians over
/// the seeds, as a range over the four kinds. *Work* is evaluations times cells, *energy* the
/// energy of the result. Unless a comment says otherwise, all grids are well-centred.
namespace calotte::cvt_detail::course {

// ---- Rounds of insertion and contraction

/// The maximum number of rounds of a coarser level, if the last level does not have more. Coarser
/// levels have more rounds than the last one, as these are cheap there. It limits large numbers of
/// rounds only: 5 makes no difference by default.
inline constexpr int most_rounds = 14;
/// Splits and collapses in a round, each as a share of the dislocations that the density demands.
/// Half of them: energy +0.01 to +0.08%, and cells are sheared, so that the stable step of gravity
/// waves is shorter. Twice as many: energy -0.06 to +0.01%, work 1.01 to 1.08; but the errors of a
/// model's vorticity, divergence and kinetic energy grow with the number of dislocations.
inline constexpr double share_of_dislocations = 0.05;
/// The maximum of either, as a share of the generators. It matters where a density jumps; no
/// difference on these grids.
inline constexpr double share_of_generators = 0.02;
/// A round whose descent takes more evaluations counts as two: where widths are steep, a round
/// takes longer and gains less. Without: work 0.99 to 1.20, energy -0.00 to +0.09%.
inline constexpr int steep = 25;
/// The number of generators is far from the number at the level's end if it differs by more than
/// far_few and by more than 1/far_part of that number, as at a start from given points. Then rounds
/// first change the number, after descents of a few evaluations.
inline constexpr std::int64_t far_part = 20, far_few = 10;
inline constexpr int evaluations_while_far = 8;
/// The maximum number of rounds that bring the number of generators no nearer to that of the
/// level's end: between fixed generators there may be no edge left to split or to collapse.
inline constexpr int most_idle = 20;

// ---- Descents

/// The tolerance of descents between rounds, in the norm l2_scaled. 1e-4: work 1.2 to 2.8, energy
/// -0.03 to +0.12%. 1e-2: work 0.31 to 0.60, energy +0.04 to +0.23%, which is up to the excess over
/// the limit that a good grid has.
inline constexpr double early_tolerance = 1e-3;
/// The maximum number of evaluations of these descents. 25: work 0.70 to 1.07, energy -0.08 to
/// +0.05%. No limit: work 1.00 to 1.28.
inline constexpr int early_iterations = 75;
/// With this number of generators or more, descents between rounds use no graph Laplacian, which
/// costs five evaluations, and cells of the sphere count as flat.
inline constexpr std::int64_t flat_from = 2000;
/// The largest cell width, radians, over which a density counts as nearly linear, and the number of
/// sampled widths that decide.
inline constexpr double widest_linear = 0.25;
inline constexpr std::int64_t samples_of_widths = 4096;
/// With this tolerance or a larger one, a run converges with the coarser quadrature.
inline constexpr double fine_tolerance = 1e-5;
/// The last descent before a polish ends where so many evaluations, after insertion and otherwise,
/// have not halved the norm: generators creep along defects, and glides move dislocations faster.
/// After insertion only dislocations are out of balance; after another start, all cells are.
/// Without, after insertion: work 2.2 to 4.0, energy -0.02 to +0.14%. 12: work 1.1 to 1.6.
inline constexpr int creeping_after_insertion = 6, creeping = 45;
inline constexpr double creeping_progress = 0.5;

// ---- Glides and the polish

/// The maximum number of glides at the end of that descent. None: work 0.76 to 0.90, energy +0.02
/// to +0.13%, and one grid of twelve is not well-centred.
inline constexpr int most_glides = 4;
/// The number of glides after which the descent continues. All: work 1.2 to 1.4, energy -0.01 to
/// +0.02%.
inline constexpr int glides_with_descent = 1;
/// The number of glides with slightly narrower limits, so that few shapes come near those of the
/// penalty. None: energy +0.00 to +0.05%.
inline constexpr int early_glides = 3;
/// The penalty of a squared excess, in units of a cell's energy, and the factor by which it is
/// raised where the polish does not suffice. After glides it has little effect: a third or three
/// times the penalty, and no raise, make no difference on these grids. It matters for fixed
/// generators and boundaries.
inline constexpr double penalty = 60, raise = 4;
/// The maximum number of times that the penalty is raised.
inline constexpr int most_raised = 2;
/// The same beside generators on lines. These move, from the third time on those at ends and
/// confluences, too. 2: seven of 14 networks of 100 confluences keep bad cells. 3: none does.
inline constexpr int most_raised_beside_lines = 4;
/// The maximum number of evaluations of a polish, and the number without a clear improvement of the
/// worst shape that ends it. No difference on these grids, either.
inline constexpr int polish_iterations = 60, stall = 10;
inline constexpr double stall_progress = 0.95;
/// The number of evaluations of a polish for edges whose midpoints are off, see
/// CvtStop::most_off_midpoint. With 150, errors of operators differ by less than 3%.
inline constexpr int evaluations_for_midpoints = 20;

} // namespace calotte::cvt_detail::course
