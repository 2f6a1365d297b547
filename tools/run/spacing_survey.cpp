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
constexpr double apart = 0.0087; // radians

using Values = std::function<DoubleVector(const Points3&)>;

/// The columns of a basis of the tangent plane.
Eigen::Matrix<double, 3, 2> tangents(const Eigen::Vector3d& x) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = x.unitOrthogonal();
  basis.col(1) = x.cross(basis.col(0));
  return basis;
}

/// |grad h| by differences over as much each way as `steps` has.
DoubleVector slopes(const Values& spacing, const Points3& x, const DoubleVector& steps) {
  DoubleVector squares = DoubleVector::Zero(x.cols());
  for (int axis = 0; axis < 2; ++axis) {
    Points3 ahead(3, x.cols()), behind(3, x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      const Eigen::Vector3d way = steps[i] * tangents(x.col(i)).col(axis);
      ahead.col(i) = (x.col(i) + way).normalized();
      behind.col(i) = (x.col(i) - way).normalized();
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
Peak climb(const Values& values, Peak peak) {
  constexpr int rounds = 8, side = 4;
  double reach = apart;
  for (int round = 0; round < rounds; ++round, reach /= 3) {
    Points3 around(3, (2 * side + 1) * (2 * side + 1));
    const Eigen::Matrix<double, 3, 2> basis = tangents(peak.position);
    Eigen::Index column = 0;
    for (int i = -side; i <= side; ++i)
      for (int j = -side; j <= side; ++j)
        around.col(column++) =
            (peak.position + reach / side * (basis * Eigen::Vector2d(i, j))).normalized();
    const Peak found = highest(values, around);
    if (found.value > peak.value)
      peak = found;
  }
  return peak;
}

/// The values on a surface, and less than any outside.
Values inside(const Values& values, const Surface& surface) {
  if (!surface.is_bounded())
    return values;
  return [values, surface](const Points3& x) -> DoubleVector {
    DoubleVector all = values(x);
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      if (!surface.contains(x.col(i)))
        all[i] = -std::numeric_limits<double>::infinity();
    return all;
  };
}

/// Points spread over a surface of the sphere.
Points3 samples(const Surface& surface) {
  return surface.is_bounded() ? random_points(lattice, surface) : fibonacci_sphere(lattice);
}

} // namespace

DoubleVector spacings_of(const Density& density, double unit, const Points3& x) {
  return unit * evaluate(density, x).array().max(1e-150).pow(-0.25);
}

SpacingSurvey survey_spacing(const Density& density, std::int64_t cells, const Surface& surface,
                             double unit) {
  const Points3 points = samples(surface);
  const double root = surface.area() * evaluate(density, points).cwiseSqrt().mean();
  SpacingSurvey survey;
  survey.unit =
      unit > 0 ? unit : std::sqrt(2 / std::numbers::sqrt3 * root / static_cast<double>(cells));
  const Values spacing = [&](const Points3& x) { return spacings_of(density, survey.unit, x); };
  const Values negative = [&](const Points3& x) -> DoubleVector { return -spacing(x); };
  const Values slope = [&](const Points3& x) {
    // Widths from node to node are steepest where they are interpolated, over less than a cell.
    constexpr double hundredth = 1.75e-4; // of a degree
    return slopes(spacing, x,
                  unit > 0 ? DoubleVector(spacing(x) / 2)
                           : DoubleVector::Constant(x.cols(), hundredth));
  };
  const auto peak = [&](const Values& values) {
    return climb(inside(values, surface), highest(values, points));
  };
  survey.least = -peak(negative).value;
  survey.greatest = peak(spacing).value;
  const Peak steepest = peak(slope);
  const Points2 at = to_lonlat(steepest.position);
  survey.steepest = {steepest.value, at(0, 0), at(1, 0)};
  return survey;
}

} // namespace calotte::tools
