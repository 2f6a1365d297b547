// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/options.h>
#include <calotte/region.h>
#include <calotte/types.h>

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// The norm that is compared with the tolerance. x are the n generators, x' their centroids, the
/// targets of a Lloyd step. l2 and linf are as printed by Jacobsen et al., 2013, Sect. 2.2;
/// MPI-SCVT divides outside the root.
enum class Norm {
  l2,          ///< sqrt( (1/n) sum |x - x'|^2 )
  linf,        ///< max |x - x'|
  l2_scaled,   ///< l2 / h, h = sqrt(4 pi / n), in the plane sqrt(area / n)
  linf_scaled, ///< linf / h
  gradient,    ///< sqrt( sum |g|^2 ), g = dE/dx of the energy, before the move
  none,        ///< no test; stop after max_iterations and report convergence
};

/// The minimisation method. Methods differ in the number of evaluations of the energy. If edges
/// flip during a run, methods may reach different local minima.
enum class Method {
  automatic, ///< lbfgs far from the minimum, lbfgs_laplacian near it
  lloyd,     ///< each generator moves to its centroid
  nesterov,  ///< accelerated Lloyd; restarts if the energy would rise
  /// L-BFGS, preconditioned with Lloyd's map (Yang, Gunzburger and Ju, J. Comput. Phys. 2018).
  lbfgs,
  lbfgs_laplacian, ///< L-BFGS, preconditioned with the mesh's graph Laplacian
};

/// The boundary of a region in a run.
enum class Boundary {
  /// The boundary clips cells. The mesh has the triangles whose circumcentre lies in the region.
  clip,
  /// The fixed generators include some on the boundary, as boundary_points() gives them, and the
  /// mesh ends there: it has the triangles whose centre of mass lies in the region.
  generators,
};

/// Options of a CVT run. A function that takes them throws Error bad_option for a value out of
/// range.
struct CvtOptions {
  Density density = {};              ///< rho of the energy; default uniform
  Method method = Method::automatic; ///< see Method
  /// Factor of the steps of Method::lloyd towards the centroid; 1 <= relaxation < 2. A step that
  /// would raise the energy is repeated with factor 1. Other methods ignore it.
  double relaxation = 1;
  Norm norm = Norm::l2_scaled; ///< compared with the tolerance
  double tolerance = 1e-6;     ///< stop when the norm is at most this; > 0 and finite
  /// Maximum number of evaluations per level; >= 0. The last line search may exceed it.
  int max_iterations = 1000;
  /// Number of bisections after the first level; >= 0, and at most 2^30 generators in the last
  /// level. A level that has converged or reached max_iterations is bisected (n -> 4n - 6, see
  /// bisect()) and converges again.
  int bisections = 0;
  /// Rounds of insertion and contraction on the last level, see insert_and_contract(), and up to
  /// 14 on coarser levels; each is followed by a descent. A round after a descent of more than 15
  /// evaluations counts for two. With rounds, all descents but the last end at an l2_scaled norm of
  /// 1e-3 or the tolerance, whichever is larger, or after 75 evaluations. >= 0; default 0.
  int insertion_rounds = 0;
  /// Number of generators of the result; > 0 if and only if insertion_rounds is. A level of b
  /// bisections before the last has 4^-b times as many.
  std::int64_t cells = 0;
  /// Ends the run with the shapes that models ask for. A pure CVT has few others, at dislocations,
  /// pairs of cells with 5 and 7 neighbours. First, up to four times after the last descent,
  /// dislocations at short Voronoi edges are moved along their rows, the generators around them
  /// relax, and the descent goes on. Then a finish minimises the energy plus the squares of
  /// excesses over limits that are left: angles of triangles from 38 to 87 degrees, Voronoi edges
  /// from 0.21 to 1.1 times the length of the Delaunay edges across, and these from 0.8 to 1.3
  /// times the spacing that the density demands. It moves generators next to such shapes away from
  /// their centroids. It ends when no cotangent and no such ratio exceeds its limit by more than
  /// 0.02, after 60 evaluations, or after ten that hardly improve the worst shape; the mesh is
  /// well-centred if none does by 0.03. Near that the finish goes on, up to twice, with squares of
  /// four times the weight. A mesh within the limits does not change. A descent before a finish
  /// also converges when 45 evaluations have not halved its norm. Default false: a pure CVT.
  bool well_centred = false;
  /// In a finish: the least length of a Delaunay edge over the spacing that the density demands
  /// there; 0 to 0.95. The shortest edge decides the stable step of gravity waves. Values near 1
  /// move many generators away from their centroids. Where the widths do not allow it, the report
  /// is not well_centred. Default 0.8.
  double least_spacing = usual_least_spacing;
  static constexpr double usual_least_spacing = 0.8; ///< its default
  /// Quadrature points per half kite: 1, 3, 6, 7, 13 or 19; no effect for uniform density.
  int rule = 3;
  /// Rule from the iteration on in which the norm is at most ten times the tolerance or a line
  /// search fails; same values as `rule`. A run converges with this rule only. No effect for
  /// uniform density and with Norm::none. With insertion_rounds and a tolerance of 1e-5 or more,
  /// `rule` takes its place.
  int final_rule = 6;
  int triangle_divisions = 1; ///< divides each half kite into this number squared; 1 to 100
  Duplicates duplicates = Duplicates::merge; ///< of the start, see DelaunayOptions
  double merge_within = 0;                   ///< of the start, see DelaunayOptions; >= 0 and finite
  /// Number of generators that stay where they are: the first columns of the start, and of the
  /// result. A unit column, up to round-off, keeps its bits; others are normalised. They are
  /// distinct, count as cells, and for all norms as being at their centroids. Bisections keep them,
  /// and insertion contracts no edge between two of them; an edge to another generator is
  /// contracted to the fixed one. >= 0; default 0.
  std::int64_t fixed = 0;
  Boundary boundary = Boundary::clip; ///< of a region of the sphere
  Partition partition = {};           ///< affects time and memory, not the result
};

/// One evaluation of the energy and the centroids; in Lloyd's method one iteration. Lengths are on
/// the unit sphere, in the plane in the unit of the domain.
struct CvtIteration {
  std::int64_t cells = 0; ///< number of generators
  double spacing = 0;     ///< h, the square root of the mean cell area
  /// Quadrature points per half kite; 0 for exact moments; -1 for a density that is linear between
  /// the generators, as in a run with insertion_rounds except at its end.
  int rule = 0;
  double l2 = 0;       ///< Norm::l2, not scaled
  double linf = 0;     ///< Norm::linf, not scaled
  double gradient = 0; ///< Norm::gradient
  double energy = 0;   ///< sum over cells of the integral of rho |x - x_i|^2
  /// In a finish, see CvtOptions::well_centred: the largest excess of a shape over its limit;
  /// otherwise 0.
  double misshapen = 0;
  /// In a finish: the number of generators farther than 0.01 of the demanded spacing from their
  /// centroids; otherwise 0.
  std::int64_t displaced = 0;
  double displacement = 0; ///< in a finish: the largest such distance over the spacing
  bool accepted = true;    ///< false if the line search rejected this trial
  std::int64_t flips = 0;  ///< edge flips after the last move
  bool rebuilt = false;    ///< the last move required a new triangulation
  double seconds = 0;      ///< wall-clock time of the evaluation
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

/// The value that CvtOptions::tolerance is compared with; 0 for Norm::none.
double norm_of(const CvtIteration& iteration, Norm norm);

/// The course of a run.
struct CvtReport {
  /// The norm of the last level, before a finish, is at most the tolerance; with Norm::none, all
  /// iterations are done.
  bool converged = false;
  bool well_centred = false; ///< a finish brought all shapes within their limits
  /// After a finish that did not: the number of cells whose triangles are beyond a limit.
  std::int64_t misshapen_cells = 0;
  std::int64_t worst_cell = -1;         ///< one with the shape farthest beyond; -1 for none
  double residual = 0;                  ///< the selected norm at the end of the run
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

  /// \cond internal
  // Internal to the library.
  struct Data;
  explicit CvtState(Data data);
  const Data& data() const { return *data_; }
  Data& data() { return *data_; }
  /// \endcond

private:
  std::unique_ptr<Data> data_;
};

/// The progress of a run after an accepted iteration. Valid during the call that it is passed to.
struct CvtProgress {
  const CvtReport& report;     ///< of the run so far, with the current residual and seconds
  int iterations_of_level = 0; ///< evaluations of the current descent, trials included
  int bisections_left = 0;     ///< levels that follow the current one
  int rounds_left = 0;         ///< rounds of insertion on this level after this descent
  const CvtState& state;       ///< for write_checkpoint()
};

/// Called after each accepted iteration; return true to stop the run there. The result is then the
/// mesh of the generators as they are, marked not converged. An exception that it throws ends the
/// run and reaches the caller, as does one that a callable density throws.
using CvtCallback = std::function<bool(const CvtProgress&)>;

/// A centroidal Voronoi tessellation: generators that are the centroids of their Voronoi cells.
struct Cvt {
  Mesh mesh; ///< Delaunay triangulation of the generators, unit columns, in the order of the start
             ///< (after bisections, the midpoints follow)
  CvtReport report; ///< how the run went
};

/// Computes a centroidal Voronoi tessellation of the unit sphere. It moves the generators until
/// they are, up to the tolerance, the constrained centroids M/|M| of their cells, with M the
/// integral of rho x (Jacobsen et al., 2013, Sect. 3.3), and then moves them to these centroids. It
/// minimises the energy E, the sum over cells of the integral of rho |x - x_i|^2. Each region's
/// task integrates over the cells that the region owns.
///
/// The same start gives the same bits for any number of threads and regions. A run that does not
/// converge within max_iterations is no error; the report says so.
///
/// \param start 3 x n directions of any norm, 12 distinct at least, not within a hemisphere; by
///        default equal ones merge.
/// \param callback called after each accepted iteration, see CvtCallback; default none.
///
/// \throws Error as spherical_delaunay(); too_few_sites for fewer than 12 generators, or when they
///         leave a hemisphere empty or meet; bad_option for an option out of range, or a density
///         that is ill-formed, negative or NaN somewhere, or zero over a whole cell.
Cvt spherical_cvt(const PointsRef& start, const CvtOptions& options = {},
                  const CvtCallback& callback = {});

/// The same for a start handed over: an rvalue Points3, which is not kept beside the run's own
/// points.
template <std::same_as<Points3> Points>
Cvt spherical_cvt(Points&& start, const CvtOptions& options = {}, const CvtCallback& callback = {});
/// Its one specialisation.
template <>
CALOTTE_API_SPECIALISATION Cvt spherical_cvt(Points3&& start, const CvtOptions& options,
                                             const CvtCallback& callback);

/// Continues from a state. With the same options the result has the bits of an uninterrupted run.
/// CvtOptions::bisections, duplicates, merge_within and fixed have no effect; the state holds the
/// bisections that remain and the number of fixed generators.
/// \throws Error as above; bad_option for an incomplete state.
Cvt spherical_cvt(CvtState state, const CvtOptions& options, const CvtCallback& callback = {});

/// The same in a region of the sphere, whose boundary clips the cells. Generators stay inside:
/// where the centroid of a cell lies outside the region, its generator moves to the nearest point
/// inside. A bisection adds the midpoints of the edges that lie inside.
///
/// The mesh has the Delaunay triangles of the generators whose circumcentre lies in the region. It
/// is open along the boundary, within about a cell of it; a generator may be in no triangle. With
/// Boundary::generators the mesh ends at the generators on the boundary. A bisection then adds no
/// midpoint between two of them along the boundary.
///
/// \param start 3 x n directions inside the region, 4 distinct at least.
/// \throws Error as above and as require_region(); bad_option with the index of a generator outside
///         the region.
Cvt spherical_cvt(const PointsRef& start, const Region& region, const CvtOptions& options = {},
                  const CvtCallback& callback = {});
/// Continues from a state in a region.
/// \throws Error as above; bad_option for an incomplete state.
Cvt spherical_cvt(CvtState state, const Region& region, const CvtOptions& options,
                  const CvtCallback& callback = {});

/// A centroidal Voronoi tessellation of a planar domain.
struct PlanarCvt {
  /// Delaunay triangulation of the generators, in the order of the start (after bisections, the
  /// midpoints follow); periodic if the domain is.
  PlanarMesh mesh;
  CvtReport report; ///< how the run went
};

/// The same in a domain of the plane, whose boundary clips the cells. The centroid M/m of a cell at
/// a reflex corner may lie outside the domain; its generator then moves to the nearest point inside
/// and stays there. A bisection adds the midpoints of the edges that lie inside. Lengths in the
/// report are in the domain's unit.
///
/// \param start 2 x n places inside the domain, 3 distinct at least, not on one line; in a periodic
///         box as periodic_delaunay() requires.
/// \param domain bounded by rings, or a periodic box.
/// \throws Error as planar_delaunay() and periodic_delaunay(); bad_option as above, as
///         require_domain(), or with the index of a generator outside of the domain.
PlanarCvt planar_cvt(const PointsRef& start, const PlanarDomain& domain,
                     const CvtOptions& options = {}, const CvtCallback& callback = {});

/// Continues from a state of a run in the same domain.
/// \throws Error as above; bad_option for an incomplete state.
PlanarCvt planar_cvt(CvtState state, const PlanarDomain& domain, const CvtOptions& options,
                     const CvtCallback& callback = {});

/// The start of a continuation on the sphere: n generators and b bisections give 4^b (n - 2) + 2
/// cells.
struct Continuation {
  Points3 start;            ///< 3 x n unit columns
  int bisections = 0;       ///< value for CvtOptions::bisections
  bool icosahedral = false; ///< the start is a bisected icosahedron
};

/// The start of a run without insertion. For uniform density and 150 cells or more these are the
/// points of geodesic_sphere(cells), without bisections: a descent of some 25 evaluations leads to
/// 12 cells of five neighbours and all others of six.
///
/// Otherwise it is the coarsest start from which bisections reach `cells`: the least such n of at
/// least 12 for uniform density, or 642 for others; `cells` itself if no bisection reaches it. For
/// cells = 10 * 4^k + 2 the start is a bisected icosahedron, else a Fibonacci lattice (uniform
/// density) or random points that follow site_density().
/// \param cells number of cells, 12 to 2^30.
/// \param density density of the run, whose start the function computes.
/// \param seed seed of random points; default 1.
/// \throws Error bad_option for cells < 12 or > 2^30, an ill-formed density, or as random_sphere(n,
///         density, seed) where it draws.
Continuation continuation(std::int64_t cells, const Density& density, std::uint64_t seed = 1);

/// A value for CvtOptions::tolerance of a run with CvtOptions::well_centred. The errors of a
/// model's operators hardly fall below it.
inline constexpr double tolerance_before_finish = 1e-4;

/// A value for CvtOptions::insertion_rounds. The errors of a model's operators do not fall with
/// further rounds.
inline constexpr int usual_insertion_rounds = 1;

/// The same with fixed generators: further rounds move free ones away from places between these.
inline constexpr int insertion_rounds_beside_fixed = 3;

/// The start of a run with CvtOptions::insertion_rounds, for any number of cells: random points
/// that follow site_density(), and as many bisections as leave at least 160 of them, and 12 in each
/// hemisphere on average, and at least four times as many as fixed ones; or `cells` itself.
/// \param cells value for CvtOptions::cells, 12 to 2^30.
/// \param fixed 3 x m, m < cells: generators that the caller puts before the start, see
///        CvtOptions::fixed. The start has m points fewer, and where the fixed ones meet the
///        density none. Default: none.
/// \throws Error as above.
Continuation multilevel(std::int64_t cells, const Density& density, std::uint64_t seed = 1,
                        const Points3& fixed = {});

/// The same in a region; `cells` from 4 on.
/// \throws Error as above and as require_region().
Continuation multilevel(std::int64_t cells, const Region& region, const Density& density,
                        std::uint64_t seed = 1, const Points3& fixed = {});

/// The number of cells of a grid with fixed generators: theirs, and as many of those that a density
/// demands as the fixed ones leave unmet. An estimate from random places.
/// \param cells number that the density demands without fixed generators.
/// \param region default: the sphere.
/// \throws Error as above.
std::int64_t cells_beside(const Points3& fixed, std::int64_t cells, const Density& density,
                          const Region& region = {});

/// The same in the plane. \param fixed 2 x m places in the domain.
std::int64_t cells_beside(const Points2& fixed, std::int64_t cells, const Density& density,
                          const PlanarDomain& domain);

/// The same in the plane.
struct PlanarContinuation {
  Points2 start;      ///< 2 x n places
  int bisections = 0; ///< value for CvtOptions::bisections
};

/// \param cells 3 to 2^30.
/// \throws Error bad_option for a number out of range, or as random_places(n, domain, density,
/// seed).
PlanarContinuation multilevel(std::int64_t cells, const PlanarDomain& domain,
                              const Density& density, std::uint64_t seed = 1,
                              const Points2& fixed = {});

} // namespace calotte
CALOTTE_API_END
