// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/laplacian.h"
#include "cvt/room.h"
#include "cvt/signs.h"
#include "delaunay/delaunay.h"
#include "delaunay/regions.h"
#include "delaunay/sites.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"

#include <calotte/types.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {

/// The interface of the sphere for Tessellation and Functional. PlanarCells provides the same
/// functions for the plane.
class SphericalCells {
public:
  using Signs = SphereSigns;
  static constexpr bool places_wrap = false; ///< place(i) may be a copy of generator i

  /// Sets the generators: unit columns that must stay there until the next call.
  void move(const Points3& points) { points_ = &points; }

  std::int64_t places() const { return points_->cols(); } ///< of the mesh: generators come first
  static Vec3 offset(const Vec3& from, const Vec3& to) { return to - from; }
  const Vec3& place(std::int32_t site) const { return column(*points_, site); }
  static bool has_hull() { return false; } ///< places of the mesh that are no generators
  /// Whether the domain has the circumcentre of a triangle of generators.
  static bool has_centre(std::int32_t, std::int32_t, std::int32_t) { return true; }
  Signs signs() const { return Signs(*points_); }
  Sites sites() const { return make_sites(*points_, Duplicates::merge, 0); } ///< equal ones merged
  /// The mesh of all places, from their sites, which it consumes.
  Connectivity triangulate(Sites&& sites, Regions&& regions) const {
    return closed_connectivity(
        delaunay_detail::spherical_mesh(std::move(sites), std::move(regions)), places());
  }
  double spacing() const; ///< the spacing h for that number of generators

  /// See moments.h.
  static void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                        Array<CellMoments>& moments, std::vector<std::int32_t>& suspects) {
    integrals_detail::integrate(integrand, patch, x, moments, nullptr, suspects);
  }
  static void find_suspects(const Patch& patch, const Array<Vec3>& x,
                            std::vector<std::int32_t>& suspects) {
    integrals_detail::find_suspects(patch, x, suspects);
  }

  /// The effect of a cell on its generator.
  struct Pull {
    Vec3 centroid; ///< where Lloyd's step leads
    Vec3 gradient; ///< of the energy; a motion that the generator can make
    double mass;   ///< |M| of the first moment M, the cell's up to a factor 1 + O(h^2); negative if
                   ///< M.x is; NaN for a cell without mass
  };
  /// Lloyd's map M/|M| and dE/dx = -2 (M - (M.x) x).
  static Pull pull(const Vec3& x, const CellMoments& cell) {
    const double length = norm(cell.first), along = dot(cell.first, x);
    const Vec3 tangent = cell.first - along * x;
    return {(1 / length) * cell.first, -2 * tangent, std::copysign(length, along)};
  }
  /// The pull's centroid again.
  static Vec3 centroid(const Vec3& x, const Vec3& gradient, double mass);

  // ---- How generators move

  static void retract(const Points3& x, double step, const Points3& d, Points3& to);
  static void make_tangential(Points3& vectors, const Points3& x, base_detail::Part part);
  Laplacian laplacian(const Connectivity& mesh, const Density& density) const {
    return graph_laplacian(*points_, mesh, density);
  }

private:
  const Points3* points_ = nullptr;
};

} // namespace calotte::cvt_detail
