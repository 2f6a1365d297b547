// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/spacing_survey.h"

#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace calotte::tools {
namespace {

constexpr std::int64_t lattice = 165'000;

using Values = std::function<DoubleVector(const Points3&)>;

/// Moves points by two coordinates in the tangent plane, or in the plane that is the surface.
class Mover {
public:
  explicit Mover(const Surface& surface) : sphere_(surface.is_sphere()) {}

  Eigen::Vector3d operator()(const Eigen::Vector3d& x, const Eigen::Vector2d& way) const {
    if (!sphere_)
      return {x.x() + way.x(), x.y() + way.y(), 0};
    const Eigen::Vector3d first = x.unitOrthogonal(), second = x.cross(first);
    return (x + way.x() * first + way.y() * second).normalized();
  }

private:
  bool sphere_;
};

/// |grad h| by differences over as much each way as `steps` has.
DoubleVector slopes(const Values& spacing, const Mover& moved, const Points3& x,
                    const DoubleVector& steps) {
  DoubleVector squares = DoubleVector::Zero(x.cols());
  for (int axis = 0; axis < 2; ++axis) {
    Points3 ahead(3, x.cols()), behind(3, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Eigen::Vector2d way = steps[i] * Eigen::Vector2d::Unit(axis);
      ahead.col(i) = moved(x.col(i), way);
      behind.col(i) = moved(x.col(i), -way);
    }
    squares += ((spacing(ahead) - spacing(behind)).array() / (2 * steps.array())).square().matrix();
  }
  return squares.cwiseSqrt();
}

struct Peak {
  Eigen::Vector3d position;
  double value;
};

Peak highest(const Values& values, const Points3& x) {
  const DoubleVector all = values(x);
  Eigen::Index best = 0;
  all.maxCoeff(&best);
  return {x.col(best), all[best]};
}

/// The maximum near a point, by lattices of a third of the width each.
/// \param reach of the first.
Peak climb(const Values& values, const Mover& moved, Peak peak, double reach) {
  constexpr int rounds = 8, side = 4;
  for (int round = 0; round < rounds; ++round, reach /= 3) {
    Points3 around(3, (2 * side + 1) * (2 * side + 1));
    Eigen::Index column = 0;
    for (int i = -side; i <= side; ++i)
      for (int j = -side; j <= side; ++j)
        around.col(column++) = moved(peak.position, reach / side * Eigen::Vector2d(i, j));
    const Peak found = highest(values, around);
    if (found.value > peak.value)
      peak = found;
  }
  return peak;
}

/// The values on a surface, and less than any outside.
Values inside(const Values& values, const Surface& surface) {
  if (surface.is_whole_sphere())
    return values;
  return [values, surface](const Points3& x) -> DoubleVector {
    DoubleVector all = values(x);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      if (!surface.contains(x.col(i)))
        all[i] = -std::numeric_limits<double>::infinity();
    return all;
  };
}

/// Points spread over a surface.
Points3 samples(const Surface& surface) {
  return surface.is_whole_sphere() ? fibonacci_sphere(lattice) : random_points(lattice, surface);
}

} // namespace

DoubleVector spacings_of(const Density& density, double unit, const Points3& x,
                         const Surface& surface) {
  return unit * evaluate(density, x, surface).array().max(1e-150).pow(-0.25);
}

SpacingSurvey survey_spacing(const Density& density, std::int64_t cells, const Surface& surface,
                             double unit) {
  const Points3 points = samples(surface);
  const Mover moved(surface);
  const double root = surface.area() * evaluate(density, points, surface).cwiseSqrt().mean();
  SpacingSurvey survey;
  survey.unit =
      unit > 0 ? unit : std::sqrt(2 / std::numbers::sqrt3 * root / static_cast<double>(cells));
  const Values spacing = [&](const Points3& x) {
    return spacings_of(density, survey.unit, x, surface);
  };
  const Values negative = [&](const Points3& x) -> DoubleVector { return -spacing(x); };
  // Distances of the sphere's lattice, and as much of a plane.
  const double scale = surface.is_sphere() ? 1 : std::sqrt(surface.area() / (4 * std::numbers::pi)),
               apart = 0.0087 * scale;
  const Values slope = [&](const Points3& x) {
    // Widths from node to node are steepest where they are interpolated, over less than a cell.
    constexpr double hundredth = 1.75e-4; // of a degree
    return slopes(spacing, moved, x,
                  unit > 0 ? DoubleVector(spacing(x) / 2)
                           : DoubleVector::Constant(x.cols(), hundredth * scale));
  };
  const auto peak = [&](const Values& values) {
    return climb(inside(values, surface), moved, highest(values, points), apart);
  };
  survey.least = -peak(negative).value;
  survey.greatest = peak(spacing).value;
  const Peak steepest = peak(slope);
  const Eigen::Vector3d& at = steepest.position;
  const Points2 lonlat = surface.is_sphere() ? to_lonlat(at) : Points2(at.head<2>());
  survey.steepest = {steepest.value, lonlat(0, 0), lonlat(1, 0)};
  return survey;
}

} // namespace calotte::tools
