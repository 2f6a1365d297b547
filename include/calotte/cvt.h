// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/domain.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/options.h>
#include <calotte/types.h>

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// What is compared with the tolerance, for n generators x whose centroids, to which Lloyd's step
/// would move them, are x'. The first two are as printed by Jacobsen et al.,
/// 2013, Sect. 2.2; MPI-SCVT divides outside the root.
enum class Norm {
  l2,          ///< sqrt( (1/n) sum |x - x'|^2 )
  linf,        ///< max |x - x'|
  l2_scaled,   ///< l2 over h = sqrt(4 pi / n), in the plane sqrt(area / n)
  linf_scaled, ///< linf over h
  gradient,    ///< sqrt( sum |g|^2 ), g = dE/dx of the energy, before the move
  none,        ///< nothing is: the run ends, converged, after max_iterations
};

/// How the energy is brought down. They differ in how many evaluations of it that takes; where
/// edges flip on the way, they may end in different optima.
enum class Method {
  automatic, ///< lbfgs from afar, lbfgs_laplacian from near
  lloyd,     ///< each generator moves to its centroid
  nesterov,  ///< Lloyd's map, accelerated; restarts where it would climb
  lbfgs,     ///< quasi-Newton, from Lloyd's map (Yang, Gunzburger and Ju, J. Comput. Phys. 2018)
  lbfgs_laplacian, ///< quasi-Newton, from the inverse of the graph Laplacian of the mesh
};

struct CvtOptions {
  Density density = {};
  Method method = Method::automatic;
  /// Of Lloyd's steps: times the way to the centroid; from 1 to below 2. A step that would climb is
  /// taken without it.
  double relaxation = 1;
  Norm norm = Norm::l2_scaled;
  double tolerance = 1e-6;   ///< stop when the norm is at most this; > 0
  int max_iterations = 1000; ///< evaluations on each level, but for a search's last ones; >= 0
  /// Continuation: that often, what has converged, or come to max_iterations, is bisected (n -> 4n
  /// - 6, see bisect()) and converged again; from 0 to what 2^30 generators allow.
  int bisections = 0;
  int rule = 3; ///< quadrature points on each half kite: 1, 3, 6, 7, 13 or 19; not used for uniform
                ///< density
  int final_rule = 6; ///< the same once the norm is within ten times the tolerance; a run without a
                      ///< norm keeps to the first
  int triangle_divisions = 1; ///< each half kite is first cut into that many squared; 1 to 100
  Duplicates duplicates = Duplicates::merge; ///< of the start, see DelaunayOptions
  double merge_within = 0;                   ///< of the start, see DelaunayOptions; >= 0
  Partition partition = {};                  ///< never affects the result
};

/// One evaluation of the energy and its centroids; an iteration of Lloyd's method.
struct CvtIteration {
  std::int64_t cells = 0;
  double spacing = 0;      ///< h of so many cells: the root of the area of one
  int rule = 0;            ///< quadrature points on each half kite, 0 for the exact moments
  double l2 = 0, linf = 0; ///< on the unit sphere, not scaled
  double gradient = 0;     ///< see Norm
  double energy = 0;       ///< sum over cells of the integral of rho |x - x_i|^2
  bool accepted = true;    ///< false for a trial that was not gone on from
  std::int64_t flips = 0;  ///< of edges, that the move to there called for
  bool rebuilt = false;    ///< that move called for a new triangulation
  double seconds = 0;      ///< wall-clock time of the evaluation
  /// Sums over the regions' tasks, whatever number ran at a time: taking over positions; finding
  /// and mending what is no longer Delaunay; moments and the move.
  double seconds_exchange = 0, seconds_repair = 0, seconds_moments = 0;
  double seconds_solver = 0; ///< wall-clock time of finding the direction that led there
};

/// A region at the end of the run.
struct CvtRegion {
  std::int64_t sites = 0; ///< that it owns
  double seconds = 0;     ///< of its tasks since the sites were last sorted to regions
};

/// The value that CvtOptions::tolerance is compared with; 0 for Norm::none.
double norm_of(const CvtIteration& iteration, Norm norm);

struct CvtReport {
  bool converged = false;
  double residual = 0; ///< the norm where the run ended
  std::vector<CvtIteration> iterations;
  std::vector<CvtRegion> regions;
  double seconds = 0; ///< wall-clock time of the run; of all its parts when it was resumed
};

/// All that a run needs to go on to the same bits. write_checkpoint() saves it, read_checkpoint()
/// loads it.
class CvtState {
public:
  CvtState(); ///< of no generators
  CvtState(const CvtState& other);
  CvtState(CvtState&& other) noexcept; ///< the other may only be assigned to or destroyed then
  CvtState& operator=(CvtState other) noexcept;
  ~CvtState();

  /// The generators: 3 x n unit columns, in a plane with z = 0, in the order of the result.
  Points3 points() const;

  const CvtReport& report() const; ///< of the run so far

  /// For the library alone.
  struct Data;
  explicit CvtState(Data data);
  const Data& data() const { return *data_; }
  Data& data() { return *data_; }

private:
  std::unique_ptr<Data> data_;
};

/// Where a run stands after an accepted iteration. Valid during the call that it is passed to.
struct CvtProgress {
  const CvtReport& report;     ///< so far; residual and seconds are those of now
  int iterations_of_level = 0; ///< evaluations of the current level, trials included
  int bisections_left = 0;     ///< levels that follow the current one
  const CvtState& state;       ///< what a checkpoint holds
};

/// Called after each accepted iteration; return true to stop the run there. The result is then the
/// mesh of the generators as they are, marked not converged. An exception that it throws ends the
/// run and reaches the caller, as does one that a callable density throws.
using CvtCallback = std::function<bool(const CvtProgress&)>;

/// A centroidal Voronoi tessellation: generators that are the centroids of their Voronoi cells.
struct Cvt {
  Mesh mesh; ///< Delaunay triangulation of the generators, unit columns, in the order of the start
             ///< (after bisections, the midpoints follow)
  CvtReport report;
};

/// A centroidal Voronoi tessellation of the unit sphere: the generators are moved until they are
/// the constrained centroids M/|M| of their cells, M the integral of rho x (Jacobsen et al., 2013,
/// Sect. 3.3), up to the tolerance; then once more to these. What is brought down is the energy E,
/// the sum over cells of the integral of rho |x - x_i|^2. A region's task integrates over the cells
/// that the region owns.
///
/// The same start gives the same bits for any number of threads and any regions. Not converging
/// within max_iterations is reported, not an error.
///
/// \param start 3 x n directions, 12 distinct at least, not within a hemisphere; equal ones merge.
///
/// \throws Error as spherical_delaunay(); too_few_sites for fewer than 12 generators, or when they
/// leave a hemisphere empty or meet; bad_option for an option out of range, or a density that is
/// ill-formed, negative or NaN somewhere, or zero over a whole cell.
Cvt spherical_cvt(const PointsRef& start, const CvtOptions& options = {},
                  const CvtCallback& callback = {});

/// The same for a start handed over: an rvalue Points3, which is not kept beside the run's own
/// points.
template <std::same_as<Points3> Points>
Cvt spherical_cvt(Points&& start, const CvtOptions& options = {}, const CvtCallback& callback = {});
template <>
Cvt spherical_cvt(Points3&& start, const CvtOptions& options, const CvtCallback& callback);

/// Goes on from a state to the bits that the run would have reached without the interruption,
/// provided that the options are the same. \throws Error as above; bad_option for a state that is
/// not whole.
Cvt spherical_cvt(CvtState state, const CvtOptions& options, const CvtCallback& callback = {});

/// A centroidal Voronoi tessellation of a planar domain.
struct PlanarCvt {
  PlanarMesh mesh; ///< Delaunay triangulation of the generators, in the order of the start; in a
                   ///< periodic box where that is
  CvtReport report;
};

/// The same in a domain of the plane, whose boundary clips the cells. The centroid M/m of a cell
/// that reaches around a corner of the domain may lie outside: its generator then goes to the
/// nearest place inside, and rests there. A bisection adds the midpoints of the edges that lie
/// inside; lengths of the report are in the domain's unit.
///
/// \param start 2 x n places inside the domain, 3 distinct at least, not on one line; in a periodic
///        box as periodic_delaunay() requires.
/// \throws Error as above; bad_option as require_domain(), or with the index of a generator outside
///         of the domain.
PlanarCvt planar_cvt(const PointsRef& start, const PlanarDomain& domain,
                     const CvtOptions& options = {}, const CvtCallback& callback = {});

/// \throws Error as above.
PlanarCvt planar_cvt(CvtState state, const PlanarDomain& domain, const CvtOptions& options,
                     const CvtCallback& callback = {});

/// Where a continuation to a number of cells starts: n cells with bisections b reach it when
/// cells = 4^b (n - 2) + 2.
struct Continuation {
  Points3 start;
  int bisections = 0;
  bool icosahedral = false; ///< the start is a bisected icosahedron
};

/// The coarsest start that bisections lead from: the least such n that is at least 12 (uniform
/// density) or 642 (others); all of the cells, where no bisection leads to their number from there.
/// When cells = 10 * 4^k + 2, it is a bisected icosahedron; otherwise a Fibonacci lattice (uniform
/// density) or points drawn from its site_density().
/// \throws Error bad_option for cells < 12 or > 2^30, an ill-formed density, or as
/// random_sphere(n, density, seed) where it draws.
Continuation continuation(std::int64_t cells, const Density& density, std::uint64_t seed = 1);

} // namespace calotte
CALOTTE_API_END
