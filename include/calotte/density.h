// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/raster.h>
#include <calotte/surface.h>

#include <functional>
#include <memory>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// The paper's bump (Jacobsen et al., 2013, Sect. 4.3), with angles in radians: rho(x) =
/// (tanh((beta - d)/alpha) + 1) / (2 (1 - gamma)) + gamma, where d is the angle between x and the
/// centre. The density is about 1 for d < beta and gamma far from the centre; the transition has
/// width alpha. The largest spacing is gamma^(-1/4) times the smallest; gamma = (1/8)^4 is the
/// paper's x8.
///
/// In the plane the centre is the point (x, y), z is ignored, d is the distance to the centre, and
/// beta and alpha are lengths. In a periodic box d is the distance to the nearest copy of the
/// centre.
struct DensityBump {
  Eigen::Vector3d centre{0, 0, 1};  ///< a direction, finite and non-zero
  double beta = 0.5235987755982988; ///< radius in radians, > 0; default pi / 6
  double alpha = 0.2;               ///< width of the transition in radians, > 0
  double gamma = 1.0 / 4096;        ///< density far from the centre; 0 < gamma < 1
  /// Ratio of the axes of an elliptic bump: distances along the long axis are divided by it; >= 1.
  /// Default 1, a circular bump.
  double stretch = 1;
  /// Direction of the long axis at the centre, of any norm; the library projects it to the tangent
  /// plane, where it must not vanish. It has an effect only if stretch > 1.
  Eigen::Vector3d major{1, 0, 0};
};

namespace density_detail {
class SampledWidths;
}

/// A density rho >= 0 on the unit sphere or in the plane: uniform, one or more bumps, that of cell
/// widths, or a callable. Only its ratios matter: widths of cells follow rho^(-1/4), so that cells
/// are 4 times finer where rho is 256 times as large. Default: uniform.
struct Density {
  /// Uniform, the maximum or the sum of the bumps, that of widths, or the callable.
  enum class Kind { uniform, maximum, sum, widths, callable };
  /// Sets rho(j) to the density at column j of x (3 x k, unit columns). rho(j) is 0 or from 1e-150
  /// to 1e150 and depends on column j alone. Many threads call it concurrently, with blocks of a
  /// few dozen columns; the last columns of a block may repeat. In the plane the columns are (x, y,
  /// 0). They lie in the periodic box, or inside another domain or outside it within the width of a
  /// cell.
  using Callable =
      std::function<void(const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho)>;

  Kind kind = Kind::uniform; ///< what determines the density
  std::vector<DensityBump> bumps =
      {}; ///< combined by maximum or sum, of which there is one at least
  /// The widths of Kind::widths, which density_of() makes. A uniform density with these, a callable
  /// or bumps is ill-formed; for other kinds they have no effect.
  std::shared_ptr<const density_detail::SampledWidths> widths = {};
  Callable callable = {}; ///< not empty for Kind::callable; see `widths`

  /// True if the density is 1 everywhere.
  bool uniform() const { return kind == Kind::uniform; }
};

/// A circular bump.
/// \param centre direction of any norm > 0.
/// \param beta, alpha radians, > 0.
/// \param gamma in (0, 1). Functions that use the density throw for values out of range.
Density tanh_bump(const Eigen::Vector3d& centre, double beta, double alpha, double gamma);

/// The density of a function of one point.
///
///     const Density finer_in_the_north =
///         density_of([](const Eigen::Vector3d& x) { return x.z() > 0 ? 16. : 1.; });
///
/// \param rho the density at a unit vector, in the plane at (x, y, 0), as Density::Callable
///        demands: many threads call it at once, so that it must not write to what they share. What
///        it throws ends the call that needs the density. Its values are densities, not widths: for
///        cells of the width w(x) let it return w(x)^(-4), up to a factor.
/// \throws Error invalid_argument for an empty function.
Density density_of(std::function<double(const Eigen::Vector3d& x)> rho);

/// The density of the generators of an optimal CVT with many cells: rho^(1/2); uniform for uniform
/// density. Random starts should follow it. (In d dimensions rho^(d/(d+2)); Gersho, IEEE Trans.
/// Inf. Theory 25, 1979.)
/// \param surface where the density is; in a periodic plane the result is periodic. Default: the
///        sphere.
/// \throws Error invalid_argument if the density is ill-formed.
Density site_density(const Density& density, const Surface& surface = {});

/// The density at each of n points.
/// \param points on the sphere 3 x n unit columns; in the plane 2 x n, or 3 x n with z = 0.
/// \param surface where the points are; in a periodic plane the density is periodic. Its rings have
///        no effect. Default: the sphere.
/// \throws Error invalid_argument: another number of rows, or a z in the plane; an ill-formed
///         density; a callable's value that is negative, infinite or NaN.
DoubleVector evaluate(const Density& density, const PointsRef& points, const Surface& surface = {});

/// The density that interpolates values at the sites of a mesh on its whole surface: rho^(-1/4),
/// which cell widths are proportional to, is linear on each triangle, on the sphere of unit
/// vectors. With a period it is periodic. Outside an open mesh the nearest triangle found
/// determines the density.
/// \param mesh the density keeps a copy of what it needs.
/// \param density n values >= 0, finite, by site.
/// \throws Error invalid_argument for another number of values, a value out of range, no triangle,
///         or a site more than 2^30 periods from the box.
Density interpolated_density(const Mesh& mesh, const DoubleVector& density);

/// The density that interpolates a raster.
/// \param density values >= 0, finite.
/// \throws Error invalid_argument if it violates the conditions of Raster, and naming the node, for
///         a value out of range.
Density interpolated_density(const Raster& density);

} // namespace calotte
CALOTTE_API_END
