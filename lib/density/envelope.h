// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/density_evaluator.h"
#include "density/room.h"
#include "domain/outline.h"

#include <calotte/density.h>

#include <array>
#include <cstdint>
#include <vector>

namespace calotte::density_detail {

/// Hemispheres as unit discs, by Lambert's azimuthal projection, which keeps areas: the disc's
/// point (x, y) is (x r, y r, +-(1 - s)) on the sphere, s = x^2 + y^2, r = sqrt(2 - s). A distance
/// in the disc is at least half of the chord on the sphere.
Vec3 on_sphere(double x, double y, bool south);

/// A square of a map: corners (x, y) and (x + side, y + side). It may stick out of what the map
/// shows.
struct Box {
  double x = -1, y = -1, side = 2;
  bool south = false; ///< which hemisphere; false in a plane
  DensityEvaluator::Bounds bounds;

  double area() const { return side * side; } ///< in proportion to that of what is mapped
};

/// How much of a box shows a place.
enum class Shown { none, part, whole };

/// The two maps of the sphere. (Area: half of that on the sphere.)
struct Hemispheres {
  static constexpr const char* name = "sphere";

  static std::vector<Box> squares() { return {Box{}, Box{-1, -1, 2, true, {}}}; }
  /// A box that sticks out of its disc counts as whole: what is proposed there is as many as a
  /// bound in the disc says.
  static Shown shown(const Box& box);
  static Vec3 place(double x, double y, bool south) { return on_sphere(x, y, south); }
  static bool holds(double x, double y, const Vec3&) { return x * x + y * y < 1; }
  /// The map's point that is nearest to (x, y), where the density is known.
  static std::array<double, 2> nearest(double x, double y);
  /// Whether bounds() of a density that is not a callable are certain.
  static bool is_certain(const Density&) { return true; }
  static DensityEvaluator::Bounds bounds(const DensityEvaluator& density, const Box& box);
};

/// A domain of the plane, its longer extent from -1 to 1.
class PlanarMap {
public:
  static constexpr const char* name = "domain";

  /// \throws Error as require_domain().
  explicit PlanarMap(const PlanarDomain& domain);

  static std::vector<Box> squares() { return {Box{}}; }
  Shown shown(const Box& box) const;
  Vec3 place(double x, double y, bool) const {
    return {middle_.x + half_ * x, middle_.y + half_ * y, 0};
  }
  /// Inside, not on the boundary; in a periodic box, in the half-open box.
  bool holds(double x, double y, const Vec3& place) const;
  std::array<double, 2> nearest(double x, double y) const;
  static bool is_certain(const Density& density) { return density.uniform(); }
  static DensityEvaluator::Bounds bounds(const DensityEvaluator&, const Box&) { return {1, 1}; }

private:
  Outline outline_;
  bool periodic_;
  Vec2 middle_, half_extent_; ///< these in the plane
  double half_;               ///< the larger of half_extent_
};

/// A value of the density that was found in a box.
struct Witness {
  std::int64_t box = 0;
  double x = 0, y = 0, rho = 0;
};

/// A density's upper bound that is constant on boxes, small ones where the density varies. Boxes
/// are halved until the bound's integral is about twice that of a lower bound: proposals that
/// follow it are accepted more often than not, however peaked the density is.
///
/// For bumps on the sphere the bound is certain. For others it rests on a lattice of 64 values in
/// and around each box, and is nowhere less than a sixteenth of the bound's mean: what hides
/// between the lattice's points (0.01 radians apart; 0.001 when all coarser lattices meet zeros
/// only) is known when a proposal hits it.
///
/// Where nothing is shown the density counts as 0, so that boxes are halved along a boundary, too.
template <class Map> class EnvelopeOf {
public:
  /// \throws Error bad_option, when the density is ill-formed, negative, infinite or NaN, or zero
  /// everywhere.
  /// \param density of places of the map.
  explicit EnvelopeOf(const Density& density, Map map = Map());

  /// The box that a number from [0, 1) falls to, each box by its bound's integral.
  std::int64_t choose(double unit) const;

  /// Cuts the witnesses' boxes into smaller ones about them, bounded by twice what was found.
  void raise(const std::vector<Witness>& witnesses);

  const Map& map() const { return map_; }
  const DensityEvaluator& density() const { return density_; }
  const std::vector<Box>& boxes() const { return boxes_; }

private:
  void cover(int depth);
  void refine();
  void finish();
  void bound(std::vector<Box>& boxes) const;
  DensityEvaluator::Bounds sampled_bounds(const Box& box) const;
  void add_quarters(const Box& box, std::vector<Box>& out) const;

  Map map_;
  DensityEvaluator density_;
  bool sampled_;
  std::vector<Box> boxes_;
  std::vector<double> mass_before_; ///< sums of the boxes' bounds times areas, up to and with each
};

extern template class EnvelopeOf<Hemispheres>;
extern template class EnvelopeOf<PlanarMap>;

using Envelope = EnvelopeOf<Hemispheres>;

} // namespace calotte::density_detail
