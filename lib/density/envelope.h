// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/density_evaluator.h"
#include "density/room.h"
#include "domain/outline.h"
#include "domain/spherical_outline.h"

#include <calotte/density.h>

#include <array>
#include <cstdint>
#include <vector>

namespace calotte::density_detail {

/// Hemispheres as unit discs, by Lambert's azimuthal projection, which keeps areas: the disc's
/// point (x, y) is (x r, y r, +-(1 - s)) on the sphere, s = x^2 + y^2, r = sqrt(2 - s). A distance
/// in the disc is at least half of the chord on the sphere.
Vec3 on_sphere(double x, double y, bool south);

/// A square of a map, with corners (x, y) and (x + side, y + side). It may extend beyond the mapped
/// area.
struct Box {
  double x = -1, y = -1, side = 2;
  bool south = false; ///< which hemisphere; false in a plane
  Bounds bounds;

  double area() const { return side * side; } ///< proportional to the area mapped
};

/// The part of a box that the map shows.
enum class Shown { none, part, whole };

/// The two maps of the sphere. Areas in a map are half of those on the sphere.
struct Hemispheres {
  static constexpr const char* name = "sphere";

  static std::vector<Box> squares() { return {Box{}, Box{-1, -1, 2, true, {}}}; }
  /// A box that extends beyond its disc counts as whole: the bound in the disc applies to all of
  /// its proposals.
  static Shown shown(const Box& box);
  static Vec3 point(double x, double y, bool south) { return on_sphere(x, y, south); }
  static bool contains(double x, double y, const Vec3&) { return x * x + y * y < 1; }
  /// The map's point that is nearest to (x, y), where the density is known.
  static std::array<double, 2> nearest(double x, double y);
  /// True if bounds() is certain for a density that is uniform or made of bumps.
  static bool is_certain(const Density&) { return true; }
  static Bounds bounds(const DensityEvaluator& density, const Box& box);
};

/// The part of these maps that shows a region.
class RegionMap {
public:
  static constexpr const char* name = "region";

  /// \param outline must outlive the map.
  RegionMap(const SphericalOutline& outline, bool uniform)
      : outline_(&outline), uniform_(uniform) {}

  static std::vector<Box> squares() { return Hemispheres::squares(); }
  Shown shown(const Box& box) const;
  static Vec3 point(double x, double y, bool south) { return on_sphere(x, y, south); }
  bool contains(double x, double y, const Vec3& point) const {
    return Hemispheres::contains(x, y, point) && outline_->side(point) == Side::inside;
  }
  static std::array<double, 2> nearest(double x, double y) { return Hemispheres::nearest(x, y); }
  static bool is_certain(const Density&) { return true; }
  Bounds bounds(const DensityEvaluator& density, const Box& box) const {
    return uniform_ ? Bounds{1, 1} : Hemispheres::bounds(density, box);
  }

private:
  const SphericalOutline* outline_;
  bool uniform_;
};

/// A domain of the plane, its longer extent from -1 to 1.
class PlanarMap {
public:
  static constexpr const char* name = "domain";

  /// \throws Error as require_finite_plane().
  explicit PlanarMap(const Surface& surface);

  static std::vector<Box> squares() { return {Box{}}; }
  Shown shown(const Box& box) const;
  Vec3 point(double x, double y, bool) const {
    return {middle_.x + half_ * x, middle_.y + half_ * y, 0};
  }
  /// Whether a point is inside the domain, not on its boundary; in a periodic box, whether it is in
  /// the half-open box.
  bool contains(double x, double y, const Vec3& point) const;
  std::array<double, 2> nearest(double x, double y) const;
  static bool is_certain(const Density& density) { return density.uniform(); }
  static Bounds bounds(const DensityEvaluator&, const Box&) { return {1, 1}; }

private:
  Surface bounded_; ///< the surface, or the rectangle of a periodic box
  const Outline* outline_;
  bool periodic_;
  Vec2 middle_, half_extent_; ///< these in the plane
  double half_;               ///< the larger of half_extent_
};

/// A value of the density found in a box.
struct Witness {
  std::int64_t box = 0;
  double x = 0, y = 0, rho = 0;
};

/// An upper bound of a density that is constant on boxes, which are small where the density varies.
/// Boxes are halved until the integral of the bound is about twice that of a lower bound, so that
/// more than half of the proposals are accepted, even for a density with high peaks.
///
/// For bumps on the sphere the bound is certain. For other densities it rests on a lattice of 64
/// values in and around each box, and is nowhere less than a sixteenth of its mean. A feature
/// between the points of the lattice (0.01 radians apart; 0.001 if all coarser lattices meet zeros
/// only) is found when a proposal hits it.
///
/// Outside the map the density counts as 0, so that boxes are halved along a boundary, too.
template <class Map> class EnvelopeOf {
public:
  /// \param density of points of the map.
  /// \throws Error invalid_argument if the density is ill-formed, negative, infinite or NaN, or
  ///         zero everywhere.
  explicit EnvelopeOf(const Density& density, Map map = Map());

  /// The box for a number from [0, 1): the probability of a box is proportional to the integral of
  /// its bound.
  std::int64_t choose(double unit) const;

  /// Cuts the boxes of the witnesses into smaller ones around them, with twice the value found as
  /// bound.
  void raise(const std::vector<Witness>& witnesses);

  const Map& map() const { return map_; }
  const DensityEvaluator& density() const { return density_; }
  const std::vector<Box>& boxes() const { return boxes_; }

private:
  void cover(int depth);
  void refine();
  void finish();
  void bound(std::vector<Box>& boxes) const;
  Bounds sampled_bounds(const Box& box) const;
  void add_quarters(const Box& box, std::vector<Box>& out) const;

  Map map_;
  DensityEvaluator density_;
  bool sampled_;
  std::vector<Box> boxes_;
  std::vector<double> mass_before_; ///< sums of the boxes' bounds times areas, up to and with each
};

extern template class EnvelopeOf<Hemispheres>;
extern template class EnvelopeOf<RegionMap>;
extern template class EnvelopeOf<PlanarMap>;

using Envelope = EnvelopeOf<Hemispheres>;

} // namespace calotte::density_detail
