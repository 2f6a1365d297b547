// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/laplacian.h"
#include "cvt/room.h"
#include "cvt/signs.h"
#include "delaunay/regions.h"
#include "delaunay/sites.h"
#include "domain/outline.h"
#include "domain/planar_domain.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"

#include <calotte/types.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace calotte::cvt_detail {

/// \throws Error invalid_argument with the index of the first place outside the domain.
void require_inside(const Points2Ref& places, const PlanarDomain& domain);

/// The cells of generators in a planar domain, with the functions of SphericalCells.
///
/// Generators are columns with z = 0. In a periodic box they may leave the box; the places of the
/// mesh are the copies inside. In another domain three further places follow the generators, so far
/// away that their cells do not reach the domain: the hull, which does not move. All generators
/// then have closed stars, and the domain clips their cells.
class PlanarCells {
public:
  using Signs = PlaneSigns;
  static constexpr bool places_wrap = true;

  /// \throws Error as require_domain().
  explicit PlanarCells(const PlanarDomain& domain);

  void move(const Points3& points);

  std::int64_t places() const { return places_.size(); }
  Vec3 offset(const Vec3& from, const Vec3& to) const {
    const Vec2 way = nearest_offset(from, to, period_);
    return {way.x, way.y, 0};
  }
  const Vec3& place(std::int32_t site) const { return places_[site]; }
  bool has_hull() const { return outline_ != nullptr; }
  bool has_centre(std::int32_t a, std::int32_t b, std::int32_t c) const;
  Signs signs() const { return Signs(places_, period_); }
  Sites sites() const;
  /// Excludes the hull, and copies in a box.
  Connectivity triangulate(Sites&&, Regions&&) const { return signs().triangulate(); }
  double spacing() const;

  /// See planar_moments.h.
  void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                 Array<CellMoments>& moments, std::vector<std::int32_t>& suspects) const;
  void find_suspects(const Patch& patch, const Array<Vec3>& x,
                     std::vector<std::int32_t>& suspects) const;

  struct Pull {
    Vec3 centroid;
    Vec3 gradient;
    double mass;
  };
  static Pull pull(const Vec3& x, const CellMoments& cell);
  static Vec3 centroid(const Vec3& x, const Vec3& gradient, double mass);

  /// Moves generators that would leave the domain to the nearest place inside.
  void retract(const Points3& x, double step, const Points3& d, Points3& to) const;
  static void make_tangential(Points3&, const Points3&, base_detail::Part) {} ///< all motions are
  Laplacian laplacian(const Connectivity& mesh, const Density& density) const;

private:
  Array<Vec3> places_of(const Points3& points) const;

  std::shared_ptr<const Outline> outline_; ///< none of a periodic box
  Vec2 period_;
  double area_;
  std::array<Vec3, 3> hull_;
  std::int64_t generators_ = 0;
  Array<Vec3> places_;
};

} // namespace calotte::cvt_detail
