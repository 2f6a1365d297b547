// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "base/vec3.h"
#include "cvt/laplacian.h"
#include "cvt/repair.h"
#include "cvt/room.h"
#include "delaunay/regions.h"
#include "delaunay/sites.h"
#include "domain/along_boundary.h"
#include "domain/surface.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/surface.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace calotte::cvt_detail {

/// The effect of a cell on its generator x: Lloyd's map M/|M| and dE/dx = -2 (M - (M.x) x) on the
/// sphere, with M the first moment; M/m and -2 M in the plane, with M about the generator.
struct Pull {
  Vec3 centroid; ///< where Lloyd's step leads
  Vec3 gradient; ///< of the energy; a motion that the generator can make
  double mass;   ///< of the cell; on the sphere |M|, the cell's up to a factor 1 + O(h^2), negative
                 ///< if M.x is. NaN for a cell without mass
};

/// The Voronoi cells of generators that move on a surface.
///
/// Generators are unit columns on the sphere, and columns with z = 0 in the plane. In a periodic
/// plane they may leave the box; the mesh has their copies inside. On a bounded surface the hull's
/// points follow the generators in the mesh, see hull.h. They lie outside and do not move, so that
/// all generators have closed stars, and the boundary clips their cells.
template <Space S> class Cells {
public:
  /// Whether the mesh may have a copy of a generator instead of the generator itself.
  static constexpr bool positions_wrap = !S::on_sphere;

  /// Cells with the far hull, for any generators.
  /// \throws Error as outline_of().
  explicit Cells(const Surface& surface, Boundary boundary = Boundary::clip);
  /// Cells for a run that starts from some generators. In a region of the sphere they have
  /// hull_rows(), too, without the points whose cells meet the region, such as points beside an
  /// island without a generator near it.
  Cells(const Surface& surface, Boundary boundary, const Density& density, const Points3& start);

  /// Sets the generators, which must stay there until the next call.
  void move(const Points3& points);

  const S& space() const { return space_; }
  std::int64_t generator_count() const { return generators_; }
  /// The number of sites of the mesh, of which generators come first.
  std::int64_t site_count() const { return std::ssize(sites_); }
  const Vec3& position(std::int32_t site) const { return sites_[static_cast<std::size_t>(site)]; }
  SitePositions<S> positions() const { return {space_, sites_}; }
  Vec3 offset(const Vec3& from, const Vec3& to) const { return space_.offset(from, to); }
  /// Whether the mesh has sites that are no generators.
  bool has_hull() const { return outline_ != nullptr; }
  /// Whether the surface has the circumcentre of a triangle of generators; with generators on the
  /// boundary, its centre of mass and the ways from there to its corners.
  bool has_centre(const Vec3& a, const Vec3& b, const Vec3& c) const;

  Sites sites() const; ///< of the generators; equal ones merged
  /// The mesh of all sites.
  /// \throws Error too_few_sites if two sites coincide, or all leave a hemisphere empty; as
  ///         delaunay().
  Connectivity triangulate() const;
  /// The same from the sites of the generators, which it consumes.
  Connectivity triangulate(Sites&& sites, Regions&& regions) const;
  double spacing() const; ///< the square root of the area for each generator

  /// See moments.h.
  void integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                 Array<CellMoments>& moments, std::vector<std::int32_t>& suspects) const;
  void find_suspects(const Patch& patch, const Array<Vec3>& x,
                     std::vector<std::int32_t>& suspects) const;

  static Pull pull(const Vec3& x, const CellMoments& cell) {
    const Vec3 centroid = integrals_detail::centroid_of<S>(x, cell.first);
    if constexpr (S::on_sphere) {
      const double along = dot(cell.first, x);
      const Vec3 tangent = cell.first - along * x;
      return {centroid, -2 * tangent, std::copysign(norm(cell.first), along)};
    } else {
      // |M|^2 <= m E for any density >= 0 (Cauchy and Schwarz). Where the density jumps, the signed
      // kites of obtuse triangles may outweigh the others, and m and M are no moments: the
      // generator then waits until its neighbours have moved.
      const double mass = cell.first.z,
                   square = cell.first.x * cell.first.x + cell.first.y * cell.first.y;
      if (mass < 0 || square > mass * cell.energy)
        return {x, {0, 0, 0}, std::abs(mass)};
      return {centroid, {-2 * cell.first.x, -2 * cell.first.y, 0}, mass > 0 ? mass : std::nan("")};
    }
  }
  /// The pull's centroid again.
  static Vec3 centroid(const Vec3& x, const Vec3& gradient, double mass);

  // ---- How generators move

  /// Sets `to` to x + step d, projected back to the surface: generators that would leave it move to
  /// the nearest point inside.
  void retract(const Points3& x, double step, const Points3& d, Points3& to) const;
  /// Removes the components that are no motion of a generator.
  static void make_tangential(Points3& vectors, const Points3& x, base_detail::Part part);
  /// See along_boundary.h. \pre the surface is bounded.
  Vec3 along_boundary(const Vec3& x, double reach) const {
    return domain_detail::along_boundary<S>(*outline_, x, reach);
  }
  Vec3 slid_on_boundary(const Vec3& x, const Vec3& way, double reach) const {
    return domain_detail::slid_on_boundary<S>(*outline_, x, way, reach);
  }
  Laplacian laplacian(const Connectivity& mesh, const Density& density) const;

private:
  Generators<S> generators() const { return {space_, outline_, generators_}; }
  bool drop_intruders(Eigen::Index far);
  void enter(const Points3& x, Points3& to) const;

  Surface surface_;
  S space_;
  const OutlineOf<S>* outline_; ///< of the surface; null without a boundary
  Boundary boundary_;
  Points3 hull_;
  std::int64_t generators_ = 0;
  std::span<const Vec3> sites_; ///< the sites of the mesh: the generators themselves, or `copies_`
  Array<Vec3> copies_;
};

} // namespace calotte::cvt_detail
