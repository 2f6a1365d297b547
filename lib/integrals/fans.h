// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/clipped_cell.h"
#include "domain/tangent_outline.h"
#include "integrals/half_edge.h"
#include "integrals/integrand.h"
#include "integrals/kites.h"
#include "integrals/room.h"

#include <cmath>
#include <vector>

/// Moments of cells that a boundary may clip. In a plane, the part of such a cell inside is a
/// polygon with the site at 0: a fan of triangles with a corner at 0, one for each side, signed by
/// their orientation.
namespace calotte::integrals_detail {

/// Integrals over a fan.
struct FanSums {
  Vec2 along{0, 0};  ///< the first moment, in the coordinates u of the plane
  double height = 0; ///< on the sphere along the site, in the plane the mass
  double energy = 0;

  FanSums& operator+=(const FanSums& other) {
    along = along + other.along;
    height += other.height;
    energy += other.energy;
    return *this;
  }
  friend FanSums operator*(double s, const FanSums& a) {
    return {s * a.along, s * a.height, s * a.energy};
  }
};

/// The lift of cells in the plane itself: the identity.
class FlatLift {
public:
  explicit FlatLift(const Vec2& site) : site_(site) {}

  /// The point where the density is evaluated.
  Vec3 position(const Vec2& u) const { return {site_.x + u.x, site_.y + u.y, 0}; }
  /// The integrands at u, for rho = 1.
  static FanSums at(const Vec2& u) { return {u, 1, dot(u, u)}; }
  /// The integrals over the triangle at a side, for rho = 1.
  static FanSums over(const CellSide& side) {
    const double area = cross(side.p, side.q) / 2;
    return {(area / 3) * (side.p + side.q), area,
            area / 6 * (dot(side.p, side.p) + dot(side.p, side.q) + dot(side.q, side.q))};
  }
  static CellMoments moments(const FanSums& sums) {
    return {{sums.along.x, sums.along.y, sums.height}, sums.energy};
  }

private:
  Vec2 site_;
};

/// The lift of cells on the sphere, from the tangent plane at the site: y = (x_i + u) / sqrt(1 +
/// u^2). Bisectors and boundary are straight lines there.
class TangentLift {
public:
  explicit TangentLift(const TangentPlane& plane) : plane_(&plane) {}

  Vec3 position(const Vec2& u) const {
    const Vec3 there = plane_->lifted(u);
    return (1 / norm(there)) * there;
  }
  /// The integrands at u, for rho = 1. An area in the plane is (1 + u^2)^(3/2) times that on the
  /// sphere.
  static FanSums at(const Vec2& u) {
    const double square = dot(u, u), root = std::sqrt(1 + square);
    return (1 / ((1 + square) * (1 + square))) *
           FanSums{u, 1, 2 * square / (root + 1)}; // |y - x|^2 = 2 (1 - 1/root)
  }
  /// The integrals over the triangle at a side, for rho = 1. The first moment is half of the side's
  /// arc times its normal.
  static FanSums over(const CellSide& side) {
    const Halves halves(side);
    return {(0.5 * halves.arc() * halves.to.cosine) * halves.across,
            0.5 * halves.arc() * halves.to.sine, half_energy(halves.to) - half_energy(halves.from)};
  }
  static double area(const CellSide& side) {
    const Halves halves(side);
    return half_area(halves.to) - half_area(halves.from);
  }
  CellMoments moments(const FanSums& sums) const {
    return {sums.height * plane_->at() + plane_->tangent(sums.along), sums.energy};
  }

private:
  /// The two right triangles whose difference is the triangle at a side: from the site to the
  /// nearest point of the side's line, and on to the side's ends.
  struct Halves {
    explicit Halves(const CellSide& side) {
      const Vec2 way = side.q - side.p;
      const double length = norm(way);
      if (!(length > 0))
        return;
      const Vec2 along = (1 / length) * way;
      const double distance = cross(side.p, along), root = std::sqrt(1 + distance * distance);
      const auto half = [&](const Vec2& end) {
        const double t = dot(end, along) / root, tangent = t / (1 + std::sqrt(1 + t * t));
        return HalfEdge{distance / root, 1 / root, 2 * arc_tangent(tangent), tangent};
      };
      across = {-along.y, along.x};
      from = half(side.p);
      to = half(side.q);
    }
    double arc() const { return to.arc - from.arc; }

    Vec2 across{0, 0}; ///< the side's direction, turned to the left
    HalfEdge from{0, 1, 0, 0}, to = from;
  };

  const TangentPlane* plane_;
};

/// Sums the integrals over a fan: in closed form for uniform density, else by the integrand's rule
/// on each triangle.
template <class Lift>
FanSums sum_fan(const Integrand& integrand, const Lift& lift, const std::vector<CellSide>& sides) {
  FanSums sums;
  if (integrand.uniform) {
    for (const CellSide& side : sides)
      sums += lift.over(side);
    return sums;
  }
  const auto offset = [](const CellSide& side, const QuadratureRule::Node& node) {
    return node.b * side.p + node.c * side.q;
  };
  std::vector<double> x, y, z;
  for (const CellSide& side : sides)
    for (const QuadratureRule::Node& node : integrand.nodes) {
      const Vec3 there = lift.position(offset(side, node));
      x.push_back(there.x);
      y.push_back(there.y);
      z.push_back(there.z);
    }
  std::vector<double> rho(x.size());
  integrand.density(x, y, z, rho);
  auto next = rho.begin();
  for (const CellSide& side : sides) {
    const double area = cross(side.p, side.q) / 2;
    for (const QuadratureRule::Node& node : integrand.nodes)
      sums += (area * node.weight * *next++) * lift.at(offset(side, node));
  }
  return sums;
}

} // namespace calotte::integrals_detail
