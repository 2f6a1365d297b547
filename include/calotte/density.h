// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/domain.h>
#include <calotte/export.h>
#include <calotte/types.h>

#include <functional>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// The paper's bump (Jacobsen et al., 2013, Sect. 4.3), with angles in radians:
/// rho(x) = (tanh((beta - d)/alpha) + 1) / (2 (1 - gamma)) + gamma, d the angle between x and the
/// centre. About 1 within beta of the centre, gamma far away, changing over a width alpha. Spacings
/// differ by gamma^(-1/4): (1/8)^4 is the paper's x8.
///
/// In the plane the centre is a place (x, y, any z), d a distance, in a periodic box the least to a
/// copy of the centre; beta and alpha are lengths.
struct Bump {
  Eigen::Vector3d centre{0, 0, 1};  ///< a direction
  double beta = 0.5235987755982988; ///< > 0
  double alpha = 0.2;               ///< > 0
  double gamma = 1.0 / 4096;        ///< 0 < gamma < 1
  /// Of an ellipse: distances along the long axis count this much less than across. 1 for a circle.
  double stretch = 1;
  /// Direction of the long axis at the centre, projected to the tangent plane there. Used where
  /// stretch > 1.
  Eigen::Vector3d major{1, 0, 0};
};

/// A density on the unit sphere or in the plane: uniform, bumps, or a callable.
struct Density {
  enum class Kind { uniform, maximum, sum, callable };
  /// Fills rho(j) with the density at column j of x, unit columns: from 1e-150 to 1e150 where it is
  /// not 0, and of that column alone. It is called from many threads at once with blocks of a few
  /// dozen columns, the last of which may be repeats. In the plane columns are (x, y, 0): of a
  /// periodic box inside it; of another domain inside it or, beside its boundary, within a cell's
  /// width of it.
  using Callable =
      std::function<void(const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho)>;

  Kind kind = Kind::uniform;
  std::vector<Bump> bumps; ///< joined by their maximum or their sum
  Callable callable;

  bool uniform() const { return kind == Kind::uniform; }
};

/// One round bump about a direction of any norm; angles in radians. What is out of range is refused
/// where the density is used.
Density tanh_bump(const Eigen::Vector3d& centre, double beta, double alpha, double gamma);

/// How the generators of an optimal CVT of many cells are distributed: as rho^(1/2). (In d
/// dimensions as rho^(d/(d+2)): Gersho, IEEE Trans. Inf. Theory 25, 1979.) Starts are best drawn
/// from that. \throws Error bad_option, when the density is ill-formed.
Density site_density(const Density& density);

/// The same of a density in a planar domain; what it gives knows of a box's period.
Density site_density(const Density& density, const PlanarDomain& domain);

/// The density at each of n unit columns.
/// \param points 3 x n.
/// \throws Error bad_option: not 3 rows; an ill-formed density; a callable's value that is
///         negative, infinite or NaN.
Eigen::VectorXd evaluate(const Density& density, const PointsRef& points);

/// The density at n places of a planar domain.
/// \param places 2 x n.
/// \throws Error bad_option as above, with 2 rows.
Eigen::VectorXd evaluate(const Density& density, const PlanarDomain& domain,
                         const PointsRef& places);

} // namespace calotte
CALOTTE_API_END
