// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {
namespace cvt_detail {
struct State;
}

/// The norm that is compared with the tolerance. x are the n generators, x' their centroids, the
/// targets of a Lloyd step. l2 and linf are as printed by Jacobsen et al., 2013, Sect. 2.2;
/// MPI-SCVT divides outside the root.
enum class Norm {
  l2,          ///< sqrt( (1/n) sum |x - x'|^2 )
  linf,        ///< max |x - x'|
  l2_scaled,   ///< l2 / h, h = sqrt(4 pi / n), in the plane sqrt(area / n)
  linf_scaled, ///< linf / h
  none,        ///< no test; stop after max_iterations and report convergence
};

/// The minimisation method. Methods differ in the number of evaluations of the energy. If edges
/// flip during a run, methods may reach different local minima.
enum class Method {
  /// lbfgs far from the minimum and in the short descents of a multilevel run, lbfgs_laplacian near
  /// the minimum.
  automatic,
  lloyd, ///< each generator moves to its centroid
  /// L-BFGS, preconditioned with Lloyd's map (Yang, Gunzburger and Ju, J. Comput. Phys. 2018).
  lbfgs,
  lbfgs_laplacian, ///< L-BFGS, preconditioned with the mesh's graph Laplacian
};

/// The boundary of a bounded surface in a run.
enum class Boundary {
  /// The boundary clips cells. The mesh has the triangles whose circumcentre lies in the region, in
  /// a plane all triangles.
  clip,
  /// The fixed generators include some on the boundary, as boundary_points() gives them, and the
  /// mesh ends there: its outer edges join each to the next one. The other edges are Delaunay as
  /// far as these allow (a constrained Delaunay triangulation; Chew, Algorithmica 4, 1989), so that
  /// no triangle crosses land narrower than a cell. A polish slides these generators along the
  /// boundary, but not around corners of more than 60 degrees.
  generators,
};

/// The generators at the start of a run.
struct CvtStart {
  /// The kind of start. Brackets name the surfaces to which a kind is limited.
  enum class Kind {
    /// multilevel for a density that is not uniform, for a part of the sphere, in the plane and
    /// with fixed generators, unless bisections or iterations are given; otherwise continuation on
    /// the whole sphere without fixed generators, else density.
    automatic,
    points, ///< those of CvtStart::points, which need not be distinct
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

/// The end of a run.
struct CvtStop {
  Norm norm = Norm::l2_scaled; ///< compared with the tolerance; not none
  /// Stop when the norm is at most this; > 0 and finite. Default 1e-4 for a run that ends
  /// well-centred, below which the errors of a model's operators hardly fall; else 1e-6.
  std::optional<double> tolerance = {};
  int max_iterations = 1000; ///< evaluations of a descent; >= 0
  /// This number of evaluations of each level, >= 1, instead of norm, tolerance and max_iterations.
  /// Default: none.
  std::optional<int> iterations = {};
  /// Whether shapes are brought within the limits of models at the end. A CVT without this has few
  /// shapes beyond them, at dislocations, which are pairs of cells with 5 and 7 neighbours. First,
  /// dislocations at short Voronoi edges are moved along their rows, and the generators around them
  /// relax. Then the polish minimises the energy plus a penalty for the remaining shapes beyond the
  /// limits: angles of triangles from 38 to 87 degrees, Voronoi edges from 0.21 to 1.1 times the
  /// length of the Delaunay edges across, and these from least_spacing to 1.23 times the spacing
  /// that the density demands (1.3 beside fixed generators). It moves generators next to such
  /// shapes away from their centroids. The mesh is well-centred if no cotangent and no ratio
  /// exceeds its limit by 0.03. Default: with kind multilevel, unless iterations are given.
  std::optional<bool> well_centred = {};
  /// At a well-centred end: the minimum length of a Delaunay edge, in units of the spacing that the
  /// density demands there; 0 to 0.95. Values near 1 move many generators away from their
  /// centroids.
  double least_spacing = 0.83;
  /// At a well-centred end: how far the midpoint of a Delaunay edge may be from that of its Voronoi
  /// edge, in units of the Delaunay edge, before the square of the excess is added to the penalty;
  /// > 0. The errors of a model's divergence and Laplacian are largest where these midpoints are
  /// apart (Heikes and Randall, Mon. Weather Rev. 123, 1995), which is at dislocations. 0.01 halves
  /// these errors; those of the tangential velocity grow. Default 1: no edge is beyond.
  double most_off_midpoint = 1;
};

/// A request for a grid.
struct Recipe {
  /// Number of cells of the grid, 12 to 2^30, 4 in a part of the sphere, 3 in the plane; fixed
  /// generators among them. 0, the default: as many as the widths imply, or as the start has
  /// points. Where fixed generators leave no edge to change, the grid has the nearest number that
  /// rounds of insertion reach.
  std::int64_t cells = 0;
  /// The relative size of cells, by a density; or cell widths in km, in a plane in its unit, which
  /// cover the surface. A number is a width, and a raster has widths. Default: a uniform density.
  std::variant<Density, Widths> resolution = {};
  double radius_km = earth_radius_km; ///< of the sphere that widths refer to; > 0 and finite
  Surface surface = {};               ///< default: the sphere
  /// The grid is a limited area: the run covers the surface, a part of the sphere, with the rings
  /// around it that write_limited_area() writes. It requires widths.
  bool limited_area = false;
  /// The directions in which a box ends at walls. The run covers a wider box, with further cells in
  /// a gap beyond the walls; walled() selects the cells between the walls. Default: none.
  Walls walls = {};
  Boundary boundary = Boundary::clip; ///< of a bounded surface
  /// Generators that stay where they are, 3 x n, the first columns of the result. A unit column, up
  /// to round-off, keeps its bits. Default: none.
  Points3 fixed = {};
  /// Lines that generators follow, such as rivers. These generators come after the fixed ones, see
  /// line_points(). They stay, too, but for a few next to shapes that a polish does not bring
  /// within its limits otherwise; confluences and ends last. See CvtReport::moved_on_lines.
  /// Default: none.
  std::vector<Points3> lines = {};
  CvtStart start = {};                       ///< the generators to begin with
  CvtStop stop = {};                         ///< the end of the run
  std::uint64_t seed = 1;                    ///< of random points
  Method method = Method::automatic;         ///< see Method
  Duplicates duplicates = Duplicates::merge; ///< of the start
  double merge_within = 0;                   ///< of the start, see DelaunayOptions
};

/// One evaluation of the energy and the centroids; in Lloyd's method one iteration. Lengths are on
/// the unit sphere, in the plane in the unit of the domain.
struct CvtIteration {
  std::int64_t cells = 0; ///< number of generators
  double spacing = 0;     ///< h, the square root of the mean cell area
  int rule = 0;           ///< quadrature points per half kite; 0 for exact moments
  /// The density is linear between the generators, as in a run with insertion rounds except at its
  /// end; the moments are exact.
  bool linear_density = false;
  double l2 = 0;       ///< Norm::l2, not scaled
  double linf = 0;     ///< Norm::linf, not scaled
  double gradient = 0; ///< sqrt( sum |g|^2 ), g = dE/dx of the energy, before the move
  double energy = 0;   ///< sum over cells of the integral of rho |x - x_i|^2
  /// At a well-centred end, see CvtStop::well_centred: the largest excess of a shape over its
  /// limit; otherwise 0.
  double shape_excess = 0;
  /// In a polish: the number of generators farther than 0.01 of the demanded spacing from their
  /// centroids; otherwise 0.
  std::int64_t off_centroid = 0;
  double largest_offset = 0; ///< in a polish: the largest such distance over the spacing
  bool accepted = true;      ///< false if the line search rejected this trial
  std::int64_t flips = 0;    ///< edge flips after the last move
  bool rebuilt = false;      ///< the last move required a new triangulation
  double seconds = 0;        ///< wall-clock time of the evaluation
  /// Time of copying positions, summed over the regions' tasks, not wall-clock.
  double seconds_exchange = 0;
  double seconds_repair = 0;  ///< the same of restoring the Delaunay property
  double seconds_moments = 0; ///< the same of moments and the move
  double seconds_solver = 0;  ///< wall-clock time of computing the search direction
};

/// A region at the end of the run.
struct CvtRegion {
  std::int64_t sites = 0; ///< number of sites that the region owns
  double seconds = 0;     ///< time of its tasks since the last assignment of sites to regions
};

/// The value to compare with the tolerance; 0 for Norm::none.
double norm_of(const CvtIteration& iteration, Norm norm);

/// A step of a run: a change of the generators, and the descent that follows.
struct CvtAction {
  /// The kind of change.
  enum class Kind {
    start,    ///< the generators of the start
    bisect,   ///< a generator at the midpoint of each edge begins the next level
    insert,   ///< a round of insertion and contraction, see split_and_collapse()
    converge, ///< none: the generators of the last round descend to the requested end
    polish,   ///< the descent minimises a penalty for shapes, too, see CvtStop::well_centred
    raise,    ///< the polish continues with a larger penalty, and moves generators on lines
              ///< next to shapes beyond their limits, where it did not suffice
  };
  Kind kind = Kind::start; ///< see Kind
  /// The number of generators at the end of the action; for `start` and `bisect`, at the end of the
  /// rounds that follow. After bisections on a surface with a boundary there may be fewer, as
  /// midpoints outside are not added.
  std::int64_t cells = 0;
  /// The maximum number of times. A round after a long descent counts as two, and a penalty is
  /// raised only where that helps. The last level has further rounds until it has its number of
  /// cells. A descent follows each time; the last round of that level is followed by `converge`.
  int times = 1;
  Norm norm = Norm::l2_scaled; ///< of each descent; in a polish shapes decide
  double tolerance = 0;        ///< of this norm; 0 with Norm::none and in a polish
  int max_iterations = 0;      ///< evaluations of each descent
};

/// The plan that follows from a recipe, before any generator moves.
struct Schedule {
  /// The recipe with its choices made: the number of cells, the surface that the run covers, the
  /// fixed generators with those on lines and on the boundary, the kind of start, its rounds, the
  /// end, and as the resolution the density.
  Recipe recipe;
  Density density;                  ///< of the run, on its surface
  std::optional<WidthField> widths; ///< that give the density, see width_field(); or none
  CvtStart::Kind first = CvtStart::Kind::density; ///< how the points of the first level are made
  std::vector<CvtAction> actions;                 ///< of the run, in order
  double implied_cells = 0;                       ///< by the widths; 0 without
  std::int64_t on_boundary = 0; ///< the last of the fixed generators, by Boundary::generators
  /// By fixed generator the next one along the boundary, with the surface to the left; -1 for
  /// others. The mesh ends at the edges between these. None without them.
  std::vector<std::int32_t> next_on_boundary;
  std::int64_t on_lines = 0;  ///< fixed generators before those, by Recipe::lines
  std::int64_t line_ends = 0; ///< the first of those, see LinePoints::ends
  double from_lines = 0;      ///< see LinePoints::farthest
};

/// The executed part of an action.
struct CvtDone {
  int times = 0;          ///< rounds or raises that were made; 1 for other actions
  int iterations = 0;     ///< evaluations of its descents
  std::int64_t cells = 0; ///< number of generators at its end; 0 if it was skipped
};

/// The course of a run.
struct CvtReport {
  /// The norm of the last level, before a polish, is at most the tolerance; with Norm::none, all
  /// iterations are done.
  bool converged = false;
  bool well_centred = false; ///< a polish brought all shapes within their limits
  /// After a polish that did not succeed: the number of cells whose triangles are beyond a limit.
  std::int64_t cells_beyond_limits = 0;
  std::int64_t worst_cell = -1; ///< one with the shape farthest beyond; -1 for none
  /// The number of generators on lines that a polish moved, see Recipe::lines.
  std::int64_t moved_on_lines = 0;
  double farthest_move = 0; ///< the largest of their distances from where they were, in widths
  /// With Boundary::generators: the number of the mesh's outer edges that do not join generators on
  /// the boundary, or that are missing there; 0 if the mesh ends at the boundary all around. The
  /// mesh may leave the boundary where the surface, or a gap in it, is narrower than a cell.
  std::int64_t off_boundary = 0;
  double residual = 0;            ///< the selected norm at the end of the run
  std::vector<CvtAction> actions; ///< all of the schedule, in order
  std::vector<CvtDone> done;      ///< of each action; of fewer during a run, or if it was stopped
  std::vector<CvtIteration> iterations; ///< all evaluations, of all levels, in order
  std::vector<CvtRegion> regions;       ///< of the last level
  double seconds = 0; ///< wall-clock time of the run, including the parts before a resumption
};

/// The state from which a run continues to the same bits. write_checkpoint() saves it,
/// read_checkpoint() loads it.
class CvtState {
public:
  CvtState();                          ///< a state without generators, which no run accepts
  CvtState(const CvtState& other);     ///< copies
  CvtState(CvtState&& other) noexcept; ///< afterwards assign to `other` or destroy it only
  CvtState& operator=(CvtState other) noexcept; ///< takes the state of `other`
  ~CvtState();

  /// The generators: 3 x n unit columns, in a plane with z = 0, in the order of the result.
  Points3 points() const;

  const CvtReport& report() const; ///< of the run so far

private:
  friend struct cvt_detail::State;
  std::unique_ptr<cvt_detail::State> state_;
};

/// The progress of a run after an accepted iteration. Valid during the call that it is passed to.
struct CvtProgress {
  const CvtReport& report;       ///< of the run so far, with the current residual and seconds
  int iterations_of_descent = 0; ///< evaluations, trials included
  int bisections_left = 0;       ///< levels that follow the current one
  int rounds_left = 0;           ///< rounds of insertion on this level after this descent
  const CvtState& state;         ///< for write_checkpoint()
};

/// A centroidal Voronoi tessellation: generators that are the centroids of their Voronoi cells.
struct Cvt {
  Mesh mesh; ///< Delaunay triangulation of the generators, unit columns, in the order of the start
             ///< (after bisections, the midpoints follow)
  CvtReport report; ///< how the run went
};

/// Splits the longest edges of a mesh at their midpoints and collapses the shortest edges to their
/// midpoints. Lengths are relative to the spacing h ~ rho^(-1/4) at the ends of the edge. No end of
/// a chosen edge is an end of another one or next to it; if a mesh has no more such edges, fewer
/// are chosen. Equal lengths are ordered by the edges' ends. Edges at a site with 8 neighbours or
/// more count as twice as long, those at a site with 4 or fewer as half as long. On a bounded
/// surface edges are chosen whose midpoint lies inside.
///
/// In a graded mesh of minimal CVT energy, pairs of cells with 5 and 7 neighbours (dislocations)
/// let rows of cells end. A descent cannot create them; this function can.
/// \param mesh on the sphere of columns of any norm.
/// \param splits, collapses numbers of edges, >= 0.
/// \returns the points that remain, in their order, a midpoint where the lower end of a collapsed
///          edge was, then the midpoints of split ones; on the sphere unit columns.
/// \throws Error invalid_argument for a negative number, more than 2^30 points, an id out of range,
///         or an ill-formed density.
Points3 split_and_collapse(const Mesh& mesh, const Density& density, std::int64_t splits,
                           std::int64_t collapses);

} // namespace calotte
CALOTTE_API_END
