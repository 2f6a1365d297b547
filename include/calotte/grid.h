// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/export.h>
#include <calotte/progress.h>

#include <optional>
#include <span>
#include <string_view>

/// Grids: the schedule that follows from a recipe, and its run.
///
///     const Recipe recipe{.cells = 40'962, .resolution = tanh_bump(centre, beta, alpha, gamma)};
///     const Cvt grid = make_grid(recipe);
///     if (!grid.report.converged || !grid.report.well_centred)
///       ...
///
/// A number is a width in km: make_grid({.resolution = Widths(120)}) is a grid of the sphere whose
/// cells are 120 km wide. All functions run in the caller's task arena, which sets the threads:
///
///     tbb::task_arena(4).execute([&] { grid = make_grid(recipe); });
CALOTTE_API_BEGIN
namespace calotte {

/// Makes all choices of a recipe.
/// \throws Error invalid_argument, with what is out of range or does not fit together, and the
///         remedy; with the index of a fixed generator that leaves no free one; naming a point
///         without a width. As width_field(), implied_cells(), with_rings(), boundary_points(),
///         line_points() and evaluate().
Schedule plan(Recipe recipe);

/// Options that do not change a run's result, unless the callback stops it, and the state from
/// which it continues.
struct RunOptions {
  Decomposition decomposition = {}; ///< see Decomposition
  ProgressCallback progress = {};   ///< called after each accepted iteration
  /// The state of an earlier run of the same recipe, which continues. Its actions and its number of
  /// fixed generators are compared with the recipe. The caller must ensure that the density and the
  /// surface are the same.
  std::optional<CvtState> state = {};
};

/// Makes the centroidal Voronoi tessellation of a recipe: calls plan(), makes the points of the
/// start, and executes the descents of the schedule. These move the generators until they are, up
/// to the tolerance, the centroids of their cells, on the sphere the constrained centroids
/// (Jacobsen et al., 2013, Sect. 3.3). They minimise the energy, the sum over cells of the integral
/// of rho |x - x_i|^2.
///
/// The result has the same bits for any number of threads and regions, and for a run that a state
/// continues. A run that does not converge is no error; the report says so. The mesh of a part of
/// the sphere has the triangles in it, see Boundary; its surface is the schedule's. An exception
/// that a callable density throws ends the run and reaches the caller.
/// \throws Error as plan(); as delaunay(); too_few_sites where generators leave a hemisphere empty
///         or meet; invalid_argument for a density that is negative or NaN somewhere, or zero over
///         a whole cell, for a start outside the surface, with its index, counted after the fixed
///         ones, and for the state of a run with other levels.
Cvt make_grid(const Recipe& recipe, RunOptions options = {});

/// Executes a schedule that plan() has returned.
Cvt make_grid(const Schedule& schedule, RunOptions options = {});

/// A value with its name in options, files and other languages.
template <class Value> struct NamedValue {
  std::string_view word; ///< as in options of the command
  Value value;           ///< what it stands for
};

std::span<const NamedValue<CvtStart::Kind>>
start_words();                                      ///< "automatic", "points", "multilevel", ...
std::span<const NamedValue<Norm>> norm_words();     ///< "l2", "linf", "l2-scaled", ..., "none"
std::span<const NamedValue<Method>> method_words(); ///< "auto", "lloyd", ...
std::span<const NamedValue<Boundary>> boundary_words();      ///< "clip", "generators"
std::span<const NamedValue<CvtAction::Kind>> action_words(); ///< "start", "bisect", "insert", ...
std::string_view word_of(CvtStart::Kind kind);               ///< of start_words()
std::string_view word_of(Norm norm);                         ///< of norm_words()
std::string_view word_of(CvtAction::Kind kind);              ///< of action_words()

} // namespace calotte
CALOTTE_API_END
