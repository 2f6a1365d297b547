// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "cvt/laplacian.h"
#include "cvt/options.h"
#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/tessellation.h"
#include "integrals/integrand.h"

#include <calotte/cvt.h>
#include <calotte/surface.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace calotte::cvt_detail {

/// The rule of an evaluation, see Quadrature.
inline int rule_of(const CvtIteration& iteration) {
  return iteration.linear_density ? integrals_detail::rule_at_sites : iteration.rule;
}

/// The CVT energy E of n generators x, with Lloyd's map or with the gradient. Lloyd's map follows
/// from the gradient: storing both would take 48 bytes more for each generator.
struct Evaluation {
  CvtIteration iteration; ///< energy, norms, effort
  Points3 centroids;      ///< Lloyd's map, 3 x n; without the gradient
  Points3 gradient;       ///< dE/dx, tangential; on request
  Array<double> mass;     ///< with the gradient; see Pull
  double penalty = 0;     ///< for the shapes of a polish; the gradient includes it
  ShapeTerms shapes;      ///< of a polish

  /// The value that a descent minimises.
  double value() const { return iteration.energy + penalty; }
};

/// The energy as a function of generators, and the motions that these can make. A Descent minimises
/// it.
class Functional {
public:
  virtual ~Functional() = default;

  /// \param points 3 x n.
  /// \param final_rule uses the finer of the two rules.
  /// \throws Error invalid_argument for a density that is zero or infinite over a cell;
  /// too_few_sites.
  virtual void evaluate(const Points3& points, bool final_rule, bool with_gradient,
                        Evaluation& out) = 0;

  /// Sets `to`, which may be `points`, to Lloyd's map of points, from their gradient and masses.
  /// \pre no penalty.
  virtual void set_centroids(const Points3& points, const Evaluation& at, Points3& to) const = 0;

  /// Sets `to`, whose memory is kept, to x + step d, projected back to the domain of the
  /// generators.
  virtual void retract(const Points3& x, double step, const Points3& d, Points3& to) const = 0;
  /// Removes from each vector of a part the component that is no motion at x.
  virtual void make_tangential(Points3& vectors, const Points3& x,
                               base_detail::Part part) const = 0;
  /// See laplacian.h.
  virtual Laplacian laplacian(const Points3& points) = 0;
};

/// The functional of all generators of a run, over cells that persist between calls.
class RunFunctional : public Functional {
public:
  /// Adds the penalty of shape.h to each evaluation from here on.
  virtual void penalise(const ShapePenalty& penalty) = 0;

  /// Pins generators: each counts as being at its centroid, its gradient is 0, and it does not
  /// move.
  /// \param fixed by generator, see shape.h; empty if none is pinned.
  virtual void pin(std::vector<std::uint8_t> fixed) = 0;

  /// Sets the edges of the boundary at which the mesh ends. \param along by generator, see
  /// positioned_mesh.h; or empty.
  virtual void end_along(std::vector<std::int32_t> along) = 0;

  /// Moves dislocations, see glide.h. Returns the number of steps; 0 if the points stay.
  virtual std::int64_t glide(Points3& points, const ShapeLimits& limits) = 0;

  /// Polishes shapes in subdomains, see polish.h. Returns the number of subdomains; 0 if the points
  /// stay.
  /// \param raised how often the penalty has been raised. Then generators on lines that are at bad
  ///        shapes may move, from the third time on those at ends of lines, too. From the second
  ///        time on dislocations are moved among them.
  virtual std::int64_t polish(Points3& points, int raised) = 0;

  virtual std::vector<CvtRegion> regions() const = 0;

  /// Moves out the connectivity of the Delaunay triangulation of the generators at their current
  /// points. No evaluation may follow. Empty if the points must be triangulated, as in a bounded
  /// plane, where the mesh of this class has a hull of its own.
  virtual std::optional<Connectivity> take_mesh(const Points3& points) = 0;
};

/// Makes the functional of a surface, see Cells.
/// \param density as surface_density() gives it.
/// \throws Error as Tessellation.
std::unique_ptr<RunFunctional> make_functional(const Points3& points, const Surface& surface,
                                               const Density& density, const Execution& execution,
                                               Boundary boundary = Boundary::clip,
                                               Level&& level = {});

} // namespace calotte::cvt_detail
