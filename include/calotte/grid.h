// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/progress.h>
#include <calotte/raster.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

/// Grids: a recipe, the schedule of descents that follows from it, and the run.
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

/// The generators at the start of a run.
struct Start {
  /// How they are made. In brackets: what a kind applies to, if not to all surfaces.
  enum class Kind {
    /// multilevel for a density that is not uniform, for a part of the sphere, in the plane and
    /// with fixed generators, unless bisections or iterations are given; otherwise continuation on
    /// the whole sphere without fixed generators, else density.
    automatic,
    points, ///< those of Start::points, which need not be distinct
    /// Random points that follow site_density(), as few as resolve the density, beside the fixed
    /// ones. Levels with rounds of insertion and contraction and bisections between them lead to
    /// any number of cells.
    multilevel,
    /// Bisections alone, from the coarsest start from which they reach the number of cells: 12
    /// generators or more for uniform density, 642 for others; a bisected icosahedron where the
    /// number is 10 x 4^k + 2, else a Fibonacci lattice (uniform density) or random points that
    /// follow site_density(). For uniform density and 150 cells or more geodesic, without
    /// bisections. [whole sphere, no fixed generators]
    continuation,
    density,     ///< random points that follow site_density()
    random,      ///< random points, uniform
    fibonacci,   ///< see fibonacci_sphere() [whole sphere, no fixed generators]
    spiral,      ///< see spiral_sphere() [the same]
    icosahedron, ///< see bisected_icosahedron() [the same]
    geodesic,    ///< see geodesic_sphere(n) [the same]
    hexagonal,   ///< see hexagonal_lattice() [plane, no fixed generators]
  };
  Kind kind = Kind::automatic; ///< points if there are some
  /// 3 x n directions, in the plane x, y and 0; without the fixed ones. The number of cells
  /// follows.
  Points3 points = {};
  /// Bisections of the converged grid, each followed by a descent; 0 to 13. Kinds multilevel and
  /// continuation choose them. Default 0.
  std::optional<int> bisections = {};
  /// Rounds of insertion and contraction on the last level of kind multilevel, see
  /// split_and_collapse(); coarser levels have up to 14. 1 to 100. Default 1; 3 with fixed
  /// generators, which further rounds move free ones away from. The errors of a model's operators
  /// do not fall with more.
  std::optional<int> insertion_rounds = {};
};

/// Where a run stops.
struct Stop {
  Norm norm = Norm::l2_scaled; ///< compared with the tolerance; not none
  /// Stop when the norm is at most this; > 0 and finite. Default 1e-4 for a run that ends
  /// well-centred, below which the errors of a model's operators hardly fall; else 1e-6.
  std::optional<double> tolerance = {};
  int max_iterations = 1000; ///< evaluations of a descent; >= 0
  /// This number of evaluations of each level, >= 1, in place of norm, tolerance and
  /// max_iterations. Default: none.
  std::optional<int> iterations = {};
  /// Whether shapes are brought within the limits of models at the end. A pure CVT has few others,
  /// at dislocations, pairs of cells with 5 and 7 neighbours. First, dislocations at short Voronoi
  /// edges are moved along their rows, and the generators around them relax.
  /// Then the polish minimises the energy plus a penalty for what is left beyond the limits: angles
  /// of triangles from 38 to 87 degrees, Voronoi edges from 0.21 to 1.1 times the length of the
  /// Delaunay edges across, and these from least_spacing to 1.3 times the spacing that the density
  /// demands. It moves generators next to such shapes away from their centroids. The mesh is
  /// well-centred if no cotangent and no ratio exceeds its limit by 0.03. Default: with kind
  /// multilevel, unless iterations are given.
  std::optional<bool> well_centred = {};
  /// At that end: the least length of a Delaunay edge over the spacing that the density demands
  /// there; 0 to 0.95. Values near 1 move many generators away from their centroids.
  double least_spacing = 0.8;
};

/// What a user asks for.
struct Recipe {
  /// Number of cells of the grid, 12 to 2^30, 4 in a part of the sphere, 3 in the plane; fixed
  /// generators among them. 0, the default: as many as the widths imply, or of the start's points.
  /// The number that rounds of insertion come nearest to, where fixed ones leave no edge to change.
  std::int64_t cells = 0;
  /// How large cells are beside each other, by a density; or cell widths in km, in a plane in its
  /// unit, which cover the surface. A number is a width, and a raster has widths. Default: a
  /// uniform density.
  std::variant<Density, Widths> resolution = {};
  double radius_km = earth_radius_km; ///< of the sphere that widths refer to; > 0 and finite
  Surface surface = {};               ///< default: the sphere
  /// The grid is a limited area: the run covers the surface, a part of the sphere, with the rings
  /// around it that write_limited_area() writes. It requires widths.
  bool limited_area = false;
  /// Directions of a box in which it ends at walls. The run covers a wider box, whose gap beyond
  /// the walls holds more cells; walled() takes those between them. Default: none.
  Walls walls = {};
  Boundary boundary = Boundary::clip; ///< of a bounded surface
  /// Generators that stay where they are, 3 x n, the first columns of the result. A unit column, up
  /// to round-off, keeps its bits. Default: none.
  Points3 fixed = {};
  /// Lines that generators follow, such as rivers; those stay, after the fixed ones. See
  /// line_points(). Default: none.
  std::vector<Points3> lines = {};
  Start start = {};                          ///< the generators to begin with
  Stop stop = {};                            ///< the end of the run
  std::uint64_t seed = 1;                    ///< of random points
  Method method = Method::automatic;         ///< see Method
  Duplicates duplicates = Duplicates::merge; ///< of the start
  double merge_within = 0;                   ///< of the start, see DelaunayOptions
};

/// What follows from a recipe before any generator moves.
struct Schedule {
  /// The recipe with its choices made: the number of cells, the surface that the run covers, the
  /// fixed generators with those on lines and on the boundary, the kind of start, its rounds, the
  /// end, and as the resolution the density.
  Recipe recipe;
  Density density;                          ///< that the run follows, on its surface
  std::optional<WidthField> widths;         ///< that give it, see width_field(); none without
  Start::Kind first = Start::Kind::density; ///< how the points of the first level are made
  std::vector<CvtAction> actions;           ///< of the run, in order
  double implied_cells = 0;                 ///< by the widths; 0 without
  std::int64_t on_boundary = 0; ///< the last of the fixed generators, by Boundary::generators
  std::int64_t on_lines = 0;    ///< fixed generators before those, by Recipe::lines
  double from_lines = 0;        ///< see LinePoints::farthest
};

/// Makes all choices of a recipe.
/// \throws Error invalid_argument, with what is out of range or does not fit together, and the
///         remedy; with the index of a fixed generator that leaves no free one; naming a place
///         without a width. As width_field(), implied_cells(), with_rings(), boundary_points(),
///         line_points() and evaluate().
Schedule plan(Recipe recipe);

/// What affects a run's course, but not its result, and where it goes on.
struct RunOptions {
  Partition partition = {};           ///< see Partition
  ProgressCallback progress = {};     ///< called after each accepted iteration
  std::optional<CvtState> state = {}; ///< of an earlier run of the same recipe, which goes on
};

/// A centroidal Voronoi tessellation as a recipe asks for it: plan(), the points of the start, and
/// the descents of the schedule. It moves the generators until they are, up to the tolerance, the
/// centroids of their cells, and minimises the energy, the sum over cells of the integral of rho
/// |x - x_i|^2; on the sphere the constrained centroids (Jacobsen et al., 2013, Sect. 3.3).
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

/// The run of a schedule, as plan() returns it.
Cvt make_grid(const Schedule& schedule, RunOptions options = {});

/// A value with its word, as options, files and other languages name it.
template <class Value> struct Word {
  std::string_view word; ///< as in options of the command
  Value value;           ///< what it stands for
};

std::span<const Word<Start::Kind>> start_words();      ///< "automatic", "points", "multilevel", ...
std::span<const Word<Norm>> norm_words();              ///< "l2", "linf", "l2-scaled", ..., "none"
std::span<const Word<Method>> method_words();          ///< "auto", "lloyd", ...
std::span<const Word<CvtAction::Kind>> action_words(); ///< "start", "bisect", "insert", ...
std::string_view word_of(Start::Kind kind);            ///< of start_words()
std::string_view word_of(Norm norm);                   ///< of norm_words()
std::string_view word_of(CvtAction::Kind kind);        ///< of action_words()

} // namespace calotte
CALOTTE_API_END
