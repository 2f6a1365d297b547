// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "cvt/cvt.h"
#include "cvt/functional.h"
#include "cvt/insertion.h"
#include "cvt/state.h"
#include "cvt/tessellation.h"
#include "domain/planar_domain.h"
#include "mesh/connectivity.h"
#include "mesh/planar_mesh.h"

#include <calotte/cvt.h>

#include <cstdint>
#include <memory>

namespace calotte::cvt_detail {

/// \throws Error invalid_argument: the state is not one that a run has left.
[[noreturn]] void refuse_state();

/// \throws Error invalid_argument for a number of fixed generators out of range; duplicate, with
///         the index of a fixed generator that merges with an earlier one.
void require_fixed(const Sites& sites, std::int64_t fixed);

/// The sites of a start, distinct as unit columns: directions that differ by less than rounding are
/// duplicates, too. \throws Error as make_sites().
Sites distinct_units(Sites&& sites, const CvtOptions& options);

/// Sets the generators of a state, in the order of the sites. On the sphere a fixed one keeps the
/// bits that it has by id, if it is a unit vector there up to round-off.
/// \param points by rank: unit vectors, or places with z = 0.
void set_points(State& state, const Sites& sites, const Array<Vec3>& points);

/// The start of a run.
struct Begun {
  State state;
  Level level;
};

/// The interface of the sphere for a run. PlanarWorld provides the same functions for the plane.
class SphericalWorld {
public:
  using Result = Cvt;
  static constexpr std::int64_t fewest = 12; ///< generators
  static constexpr bool at_sites = true;     ///< its cells can be integrated with rule_at_sites

  /// \throws Error as make_sites(); too_few_sites.
  static Begun begin(Points3&& start, const CvtOptions& options);
  static Begun begin(const Points3Ref& start, const CvtOptions& options);

  /// The density in the form that the functional takes.
  /// \throws Error invalid_argument if it is ill-formed.
  static Density density(const Density& density);

  /// Throws for a state whose points are not unit vectors, or too few.
  static void require_points(const State& state);

  static std::unique_ptr<Functional> functional(const Points3& points, const CvtOptions& options,
                                                Level&& level) {
    return make_functional(points, options, std::move(level));
  }

  /// The largest number of generators after a bisection of n.
  static std::int64_t bisected(std::int64_t n) { return 4 * n - 6; }
  /// The number whose bisection is nearest to n.
  static std::int64_t halved(std::int64_t n) { return (n + 8) / 4; }

  /// The Delaunay triangulation of generators, by a new triangulation.
  static Mesh triangulated(Points3&& points);

  /// The same from its connectivity in canonical order.
  static Mesh mesh(Points3&& points, Connectivity&& canonical);

  /// Sets the generators of a state to those of a bisected mesh, in curve order; returns the start
  /// of the next level.
  static Level set_bisected(State& state, const Mesh& coarse);

  /// The same after insertion and contraction of edges.
  static Level set_split_and_collapsed(State& state, const Mesh& mesh, const Density& density,
                                       const EdgeChanges& changes);
};

/// The same of a domain in the plane.
class PlanarWorld {
public:
  using Result = PlanarCvt;
  static constexpr std::int64_t fewest = 3;
  static constexpr bool at_sites = false;

  /// \throws Error as require_domain().
  explicit PlanarWorld(const PlanarDomain& domain);

  static Begun begin(const Points2Ref& start, const CvtOptions& options);
  Density density(const Density& density) const;
  void require_points(const State& state) const;
  std::unique_ptr<Functional> functional(const Points3& points, const CvtOptions& options,
                                         Level&& level) const {
    return make_functional(points, domain_, options, std::move(level));
  }
  static std::int64_t bisected(std::int64_t n) { return 4 * n; } // some midpoints may be outside
  static std::int64_t halved(std::int64_t n) { return (n + 2) / 4; }
  PlanarMesh triangulated(const Points3& points) const;
  PlanarMesh mesh(const Points3& points, Connectivity&& canonical) const; ///< of a periodic box
  Level set_bisected(State& state, const PlanarMesh& coarse) const;
  Level set_split_and_collapsed(State& state, const PlanarMesh& mesh, const Density& density,
                                const EdgeChanges& changes) const;

private:
  bool all_inside(const Points3& points) const;
  Points2 in_domain(const Points3& points) const;

  PlanarDomain domain_;
};

} // namespace calotte::cvt_detail
