// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/elementary.h"
#include "base/require.h"
#include "base/vec3.h"
#include "density/bounds.h"
#include "density/room.h"
#include "density/sampled_widths.h"

#include <calotte/density.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace calotte::density_detail {

/// A bump in the form that the inner loop reads.
struct Profile {
  Vec3 centre, major;                ///< unit vectors; major tangential
  double shrink;                     ///< 1 - 1/stretch, by which offsets along major are reduced
  double beta, slope, height, gamma; ///< slope -2/(alpha ln(2))
};

/// rho = gamma + 1 / ((1 - gamma) (1 + exp(-2 (beta - d)/alpha))), which is the tanh of
/// DensityBump.
CALOTTE_INLINE double value_at(const Profile& bump, double distance) {
  return bump.gamma + bump.height * logistic((bump.beta - distance) * bump.slope);
}

/// \throws Error invalid_argument, naming bump b, unless a condition on it holds.
inline void require_of_bump(std::size_t b, bool holds, const char* fault) {
  require(holds, "bump {} of the density: {}", b, fault);
}

/// The profile without centre and axis of bump b.
/// \throws Error invalid_argument if a number is out of range.
Profile profile_without_centre(const DensityBump& bump, std::size_t b);

/// A density prepared for repeated evaluation.
class DensityEvaluator {
public:
  /// \throws Error invalid_argument if the density is ill-formed.
  explicit DensityEvaluator(const Density& density);

  /// The density at unit vectors given by their coordinates. The bits of each value depend on its
  /// vector alone.
  /// \throws Error invalid_argument if a value of a callable is negative, infinite or NaN.
  void operator()(std::span<const double> x, std::span<const double> y, std::span<const double> z,
                  std::span<double> rho) const;

  /// The same at `count` columns.
  void operator()(const Vec3* columns, std::int64_t count, double* rho) const;

  /// Bounds of bumps over the unit vectors within an angle `reach` of one. The distance of a bump
  /// changes by at most 1 per radian, that of a stretched bump by at most sqrt(2), and so does the
  /// argument of its tanh: with p, w the components of x along the centre and the long axis and k =
  /// 1 - 1/stretch^2, the square of that slope is (1 + k^2 w^2 - (p + k w^2)^2) / (1 - (p + k
  /// w^2/2)^2), which is at most 2 as p^2 + w^2 <= 1.
  Bounds bounds(const Vec3& middle, double reach) const;

private:
  void call(std::span<const double> x, std::span<const double> y, std::span<const double> z,
            std::span<double> rho) const;

  Density density_;
  std::vector<Profile> profiles_;
};

} // namespace calotte::density_detail
