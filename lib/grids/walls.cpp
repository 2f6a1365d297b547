// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/walls.h"

#include "density/surface_density.h"
#include "domain/surface.h"

#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::grids_detail {
namespace {

constexpr std::int64_t samples = 1 << 16;

/// Points on the walls.
Points2 on_walls(const Eigen::Vector2d& extent, Walls walls) {
  constexpr int side = 500;
  Points2 points(2, 4 * side);
  Eigen::Index count = 0;
  for (int i = 0; i < side; ++i)
    for (const double end : {0.0, 1.0}) {
      const double part = (i + 0.5) / side;
      if (walls.x)
        points.col(count++) << end * extent.x(), part * extent.y();
      if (walls.y)
        points.col(count++) << part * extent.x(), end * extent.y();
    }
  return points.leftCols(count);
}

double mean_root(const Density& density, const Surface& box, const Points3& points) {
  return evaluate(density, points, box).cwiseSqrt().mean();
}

/// The density between the walls, extended over the gap by the periodic box: from the middle of the
/// gap on, points count as those before 0.
Density unwrapped(const Density& density, const Eigen::Vector2d& extent,
                  const Eigen::Vector2d& period) {
  const Density::Callable given = density_detail::make_callable(density);
  if (!given)
    return density;
  Density out;
  out.kind = Density::Kind::callable;
  out.callable = [inner = given, extent, period](const Eigen::Ref<const Points3>& x,
                                                 Eigen::Ref<DoubleVector> rho) {
    Points3 near = x;
    for (Eigen::Index i = 0; i < near.cols(); ++i)
      for (int k = 0; k < 2; ++k)
        if (period[k] > extent[k] && near(k, i) > (extent[k] + period[k]) / 2)
          near(k, i) -= period[k];
    inner(near, rho);
  };
  return out;
}

} // namespace

WallsRun run_between_walls(const Surface& channel, Walls walls, const Density& density,
                           std::int64_t cells) {
  const Eigen::Vector2d extent = channel.period();
  const auto widened = [&](double gap) -> Eigen::Vector2d {
    return extent + Eigen::Vector2d(walls.x ? gap : 0, walls.y ? gap : 0);
  };
  const Surface apart = Surface::periodic(widened(10 * extent.maxCoeff())); // no copies across
  const double root = mean_root(density, apart, random_points(samples, channel)) * extent.prod();
  const double unit = std::sqrt(2 / std::numbers::sqrt3 * root / static_cast<double>(cells));
  const double least =
      std::max(evaluate(density, on_walls(extent, walls), apart).minCoeff(), 1e-150);
  constexpr double widths = 4;
  const double gap = std::min(widths * unit * std::pow(least, -0.25), 4 * extent.maxCoeff());
  const Surface box = Surface::periodic(widened(gap));
  WallsRun run{box, unwrapped(density, extent, box.period()), 0};
  const double all = mean_root(run.density, box, random_points(samples, box)) * box.area();
  run.cells = std::max<std::int64_t>(std::llround(static_cast<double>(cells) * all / root), 12);
  return run;
}

} // namespace calotte::grids_detail
