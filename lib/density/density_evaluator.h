// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/elementary.h"
#include "base/vec3.h"
#include "density/room.h"

#include <calotte/density.h>

#include <span>
#include <string>
#include <vector>

namespace calotte::density_detail {

/// A bump as its inner loop needs it.
struct Profile {
  Vec3 centre, major; ///< unit vectors; major tangential
  double shrink;      ///< 1 - 1/stretch, by which offsets along major are reduced
  double beta, minus_two_over_alpha, height, gamma;
};

/// rho = gamma + 1 / ((1 - gamma) (1 + exp(-2 (beta - d)/alpha))), which is the tanh of Bump.
CALOTTE_INLINE double value_at(const Profile& bump, double distance) {
  return bump.gamma +
         bump.height / (1 + exponential((bump.beta - distance) * bump.minus_two_over_alpha));
}

/// All of a bump but its centre and its axis. \param name in messages.
/// \throws Error bad_option, where a number is out of range.
Profile profile_without_place(const Bump& bump, const std::string& name);

/// A density made ready to be evaluated many times.
class DensityEvaluator {
public:
  /// \throws Error bad_option, when the density is ill-formed.
  explicit DensityEvaluator(const Density& density);

  /// The density at unit vectors given by their coordinates. The same bits for a point in any
  /// company. \throws Error bad_option, when a callable's value is negative, infinite or NaN.
  void operator()(std::span<const double> x, std::span<const double> y, std::span<const double> z,
                  std::span<double> rho) const;

  struct Bounds {
    double least = 0, greatest = 0;
  };
  /// Of bumps, at the unit vectors within an angle `reach` of one. Where a bump's distances change
  /// by 1, or by sqrt(2) of a stretched one, at most per radian, so does the argument of its tanh:
  /// with p, w the components of x along the centre and the long axis and k = 1 - 1/stretch^2, the
  /// square of that slope is (1 + k^2 w^2 - (p + k w^2)^2) / (1 - (p + k w^2/2)^2), and that is at
  /// most 2 as p^2 + w^2 <= 1.
  Bounds bounds(const Vec3& middle, double reach) const;

private:
  void call(std::span<const double> x, std::span<const double> y, std::span<const double> z,
            std::span<double> rho) const;

  Density density_;
  std::vector<Profile> profiles_;
};

} // namespace calotte::density_detail
