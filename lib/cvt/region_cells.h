// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/laplacian.h"
#include "cvt/room.h"
#include "cvt/signs.h"
#include "cvt/spherical_cells.h"
#include "delaunay/regions.h"
#include "delaunay/sites.h"
#include "domain/spherical_outline.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"

#include <calotte/cvt.h>
#include <calotte/density.h>
#include <calotte/types.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace calotte::cvt_detail {

/// Places outside a region: directions that are not near its boundary, and rows along it, at 4, 8,
/// 16, ... times the spacing that a density demands of so many generators there. Together with
/// generators that are spread over the region, they leave no hemisphere empty. All have few
/// neighbours.
Points3 hull_of(const SphericalOutline& outline, const Density& density, std::int64_t generators);

/// The cells of generators in a region of the sphere, with the functions of SphericalCells.
///
/// Generators are unit columns. Further places follow them, outside the region: the hull, which
/// does not move. All generators then have closed stars, and the region clips their cells. The hull
/// is that of hull_of(): with the far hull only, generators along the boundary form flat triangles
/// with each other, which overturn at every step.
class RegionCells {
public:
  using Signs = SphereSigns;
  static constexpr bool places_wrap = false;
  using Pull = SphericalCells::Pull;

  /// With the hull's directions only, for any generators.
  RegionCells(std::shared_ptr<const SphericalOutline> outline, Boundary boundary);
  /// For a run that starts from some generators. Without those of the hull's rows whose cells meet
  /// the region, such as beside an island that no generator is near.
  RegionCells(std::shared_ptr<const SphericalOutline> outline, Boundary boundary,
              const Density& density, const Points3& start);

  void move(const Points3& points);

  std::int64_t places() const { return places_.cols(); }
  static Vec3 offset(const Vec3& from, const Vec3& to) { return to - from; }
  const Vec3& place(std::int32_t site) const { return column(places_, site); }
  static bool has_hull() { return true; }
  /// With generators on the boundary: whether the region has the triangle's centre of mass.
  bool has_centre(std::int32_t a, std::int32_t b, std::int32_t c) const;
  Signs signs() const { return Signs(places_); }
  Sites sites() const; ///< of the generators; equal ones merged
  /// Includes the hull.
  Connectivity triangulate(Sites&&, Regions&&) const { return signs().triangulate(); }
  double spacing() const;

  /// See region_moments.h.
  void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                 Array<CellMoments>& moments, std::vector<std::int32_t>& suspects) const;
  static void find_suspects(const Patch& patch, const Array<Vec3>& x,
                            std::vector<std::int32_t>& suspects) {
    integrals_detail::find_suspects(patch, x, suspects);
  }

  static Pull pull(const Vec3& x, const CellMoments& cell) { return SphericalCells::pull(x, cell); }
  static Vec3 centroid(const Vec3& x, const Vec3& gradient, double mass) {
    return SphericalCells::centroid(x, gradient, mass);
  }

  /// Moves generators that would leave the region to the nearest place inside.
  void retract(const Points3& x, double step, const Points3& d, Points3& to) const;
  static void make_tangential(Points3& vectors, const Points3& x, base_detail::Part part) {
    SphericalCells::make_tangential(vectors, x, part);
  }
  Laplacian laplacian(const Connectivity& mesh, const Density& density) const;

private:
  bool drop_intruders();

  std::shared_ptr<const SphericalOutline> outline_;
  Boundary boundary_;
  Points3 hull_;
  std::int64_t generators_ = 0;
  Points3 places_;
};

} // namespace calotte::cvt_detail
