// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/parallel.h"
#include "base/points.h"
#include "base/vec3.h"
#include "density/room.h"
#include "density/width_table.h"

#include <calotte/density.h>
#include <calotte/raster.h>
#include <calotte/surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace calotte::density_detail {

/// Ascending values in which intervals are found in constant time.
class Axis {
public:
  Axis() = default;
  /// At least two values.
  explicit Axis(std::vector<double> values);

  /// The last i with values[i] <= x, clamped to the first and last interval.
  std::int64_t interval(double x) const;

  /// The relative position of x in interval i: 0 at its start, 1 at its end, clamped.
  double fraction(std::int64_t i, double x) const;

  double operator[](std::int64_t i) const { return values_[static_cast<std::size_t>(i)]; }
  std::int64_t intervals() const { return static_cast<std::int64_t>(values_.size()) - 1; }

private:
  std::vector<double> values_, inverse_steps_;
  std::vector<std::int32_t> first_; ///< by bin: the interval that contains the start of the bin
  double bins_per_unit_ = 0;
};

/// A condition on the values of a raster.
struct ValueLaw {
  bool (*holds)(double value);
  const char* name; ///< "positive and finite"
};

inline constexpr ValueLaw positive_and_finite{
    [](double value) { return value > 0 && value <= std::numeric_limits<double>::max(); },
    "positive and finite"},
    positive{[](double value) { return value > 0; }, "positive"},
    not_negative{
        [](double value) { return value >= 0 && value <= std::numeric_limits<double>::max(); },
        "0 or positive, and finite"},
    finite{[](double value) { return std::abs(value) <= std::numeric_limits<double>::max(); },
           "finite"},
    a_fraction{[](double value) { return value >= 0 && value <= 1; }, "a fraction from 0 to 1"};

/// \param name of the raster in messages.
/// \throws Error invalid_argument, naming the node, unless axes and shape meet the conditions of
///         Raster.
void require_raster(const Raster& raster, const std::string& name);
/// Requires a valid raster whose values all meet a law. \throws Error invalid_argument, naming the
/// node.
void require_values(const Raster& raster, const std::string& name, const ValueLaw& law);
/// Requires a valid raster of cell widths: > 0 and finite, max / min at most 1e30.
void require_widths(const Raster& widths);
/// \throws Error invalid_argument unless a number of a rule is positive and finite.
/// \param rules what it is a rule of, for the message.
void require_positive(double value, const char* name, const char* rules);
/// \throws Error invalid_argument for widths whose ratio exceeds 1e30.
void require_ratio(double most, double least);

/// A raster prepared for repeated evaluation. On the sphere the first column is repeated at the
/// end, and the rows at the poles have one value each.
class RasterField {
public:
  /// \throws Error invalid_argument as require_raster().
  explicit RasterField(const Raster& raster);

  /// Values at unit vectors, or at points of the plane, given by their coordinates. The bits of a
  /// value depend on its point alone.
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* values) const;

  bool of_plane() const { return of_plane_; }
  const Axis& x() const { return x_; } ///< radians, the first from -pi to pi; or x of the plane
  const Axis& y() const { return y_; } ///< radians, from pole to pole; or y of the plane
  double value(std::int64_t i, std::int64_t j) const {
    return values_[static_cast<std::size_t>(j * (x_.intervals() + 1) + i)];
  }

  /// Cosine of the latitude of a row, as from_lonlat() computes it: the same bits on every machine.
  double cosine(std::int64_t j) const { return cosines_[static_cast<std::size_t>(j)]; }
  double sine(std::int64_t j) const { return sines_[static_cast<std::size_t>(j)]; }

private:
  void add_row(const Raster& raster, Eigen::Index row, double latitude);
  double between(double x, double y) const;

  Axis x_, y_;
  bool of_plane_;
  std::optional<WidthTable> table_; ///< of a regular grid of the sphere
  std::vector<double> values_;      ///< row by row
  std::vector<double> cosines_, sines_;
};

/// The values of a field at the columns of a block.
/// \tparam Field takes x, y, z, their number and values, as RasterField.
template <class Field>
void evaluate_block(const Field& field, const Eigen::Ref<const Points3>& points,
                    Eigen::Ref<Eigen::VectorXd> values) {
  constexpr Eigen::Index most = 128;
  std::array<std::array<double, most>, 3> rows;
  for (Eigen::Index begin = 0; begin < points.cols(); begin += most) {
    const Eigen::Index count = std::min(most, points.cols() - begin);
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index i = 0; i < 3; ++i)
        rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = points(i, begin + j);
    field(rows[0].data(), rows[1].data(), rows[2].data(), static_cast<std::size_t>(count),
          values.data() + begin);
  }
}
/// The same at a list of points.
template <class Field>
void evaluate_block(const Field& field, std::span<const Vec3> points, std::span<double> values) {
  if (!points.empty())
    evaluate_block(field, Eigen::Map<const Points3>(&points.front().x, 3, std::ssize(points)),
                   Eigen::Map<Eigen::VectorXd>(values.data(), std::ssize(values)));
}

/// The same at any number of points, by all threads.
/// \throws Error as evaluate(const Raster&, const PointsRef&).
template <class Field> DoubleVector evaluate_field(const Field& field, const PointsRef& points) {
  const Points3 x = field.of_plane() ? base_detail::with_z(base_detail::plane_points_of(points))
                                     : Points3(base_detail::directions_of(points));
  DoubleVector values(x.cols());
  base_detail::for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    evaluate_block(field, x.middleCols(begin, end - begin), values.segment(begin, end - begin));
  });
  return values;
}

/// \throws Error invalid_argument unless widths are those of a surface of this kind.
void require_kind(bool of_plane, const Surface& surface);

/// \throws Error invalid_argument unless a radius is > 0 and finite.
void require_radius(double radius_km);

/// The reason why nodes do not cover a surface, see require_covering(); empty if they do.
/// \param x, y names of the axes in the message.
std::string uncovered(const Raster& raster, const Surface& surface, const std::string& x,
                      const std::string& y);
/// The same for points of the sphere. \pre the raster is one of the sphere.
std::string uncovered(const Raster& raster, const Points3& points, const std::string& x,
                      const std::string& y);

/// A regular grid of the sphere, poles included, without values. Its step is the largest divisor of
/// 180 degrees of at most `step`.
Raster regular_grid(double step);

/// A grid over a rectangle of a plane, of at most so many nodes, without values.
/// \param size of the rectangle; > 0. \param step maximum distance of neighbouring nodes, > 0; it
///        grows where there would be more nodes.
Raster grid_over(const Eigen::Vector2d& low, const Eigen::Vector2d& size, double step,
                 double most_nodes);

} // namespace calotte::density_detail
