// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density_evaluator.h"
#include "vec3.h"

#include <calotte/density.h>

#include <cstdint>
#include <vector>

namespace calotte::detail {

/// Hemispheres as unit discs, by Lambert's azimuthal projection, which keeps areas: the disc's
/// point (x, y) is (x r, y r, +-(1 - s)) on the sphere, s = x^2 + y^2, r = sqrt(2 - s). A distance
/// in the disc is at least half of the chord on the sphere.
Vec3 on_sphere(double x, double y, bool south);

/// A square of the map: corners (x, y) and (x + side, y + side). It may stick out of the disc.
struct Box {
  double x = -1, y = -1, side = 2;
  bool south = false;
  DensityEvaluator::Bounds bounds;

  double area() const { return side * side; } ///< half of that on the sphere
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
/// For bumps the bound is certain. For a callable it rests on a lattice of 64 values in and around
/// each box, and is nowhere less than a sixteenth of the bound's mean: what hides between the
/// lattice's points (0.01 radians apart; 0.001 when all coarser lattices meet zeros only) is known
/// when a proposal hits it.
class Envelope {
public:
  /// \throws Error bad_option, when the density is ill-formed, negative, infinite or NaN, or zero
  /// everywhere.
  explicit Envelope(const Density& density);

  /// The box that a number from [0, 1) falls to, each box by its bound's integral.
  std::int64_t choose(double unit) const;

  /// Cuts the witnesses' boxes into smaller ones about them, bounded by twice what was found.
  void raise(const std::vector<Witness>& witnesses);

  const DensityEvaluator& density() const { return density_; }
  const std::vector<Box>& boxes() const { return boxes_; }

private:
  void cover(int depth);
  void refine();
  void finish();
  void bound(std::vector<Box>& boxes) const;
  DensityEvaluator::Bounds sampled_bounds(const Box& box) const;

  DensityEvaluator density_;
  bool sampled_;
  std::vector<Box> boxes_;
  std::vector<double> mass_before_; ///< sums of the boxes' bounds times areas, up to and with each
};

} // namespace calotte::detail
