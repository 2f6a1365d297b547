// SPDX-License-Identifier: GPL-3.0-or-later
#include "remap/box_tiling.h"

#include "base/lonlat.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/spherical_angles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace calotte {
namespace remap_detail {
namespace {

using base_detail::from_lonlat, base_detail::longitude_of, base_detail::lonlat_of;

constexpr double degree_in_radians = std::numbers::pi / 180;
constexpr double slack =
    1e-9; ///< degrees, rounding of sides that should be at a pole or close the circle
constexpr double widest = 180; ///< degrees, of a box; excluded

std::string named_value(const std::string& name, Eigen::Index i, double value) {
  return message("{}[{}] = {}", name, i, value);
}

/// \param sign 1 for ascending values, -1 for descending ones.
void require_order(const DoubleVector& values, const std::string& name, double sign) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      refuse(named_value(name, i, values[i]) + " is not finite; correct it");
    if (i > 0 && !(sign * values[i] > sign * values[i - 1]))
      refuse(message("{} does not follow {}; sort the raster along it",
                     named_value(name, i, values[i]), values[i - 1]));
  }
}

double sign_of(const DoubleVector& values) {
  return values.size() > 1 && values[1] < values[0] ? -1 : 1;
}

void require_latitudes(const DoubleVector& values, const std::string& name) {
  require_order(values, name, sign_of(values));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!(std::abs(values[i]) <= 90))
      refuse(named_value(name, i, values[i]) + " is outside -90 to 90; give degrees");
}

/// The middles between nodes, and the points half a step beyond the first and the last node.
DoubleVector middles(const DoubleVector& nodes) {
  const Eigen::Index n = nodes.size();
  DoubleVector sides(n + 1);
  for (Eigen::Index i = 1; i < n; ++i)
    sides[i] = 0.5 * (nodes[i - 1] + nodes[i]);
  sides[0] = nodes[0] - (sides[1] - nodes[0]);
  sides[n] = nodes[n - 1] + (nodes[n - 1] - sides[n - 1]);
  return sides;
}

DoubleVector meridians_around(const DoubleVector& nodes) {
  const Eigen::Index n = nodes.size();
  DoubleVector sides = middles(nodes);
  double step = 0;
  for (Eigen::Index i = 1; i < n; ++i)
    step = std::max(step, nodes[i] - nodes[i - 1]);
  const double gap = nodes[0] + 360 - nodes[n - 1];
  const double rounding = 0.01 * step;
  require(gap > -rounding, "the longitudes of a raster span {} degrees; give at most 360",
          nodes[n - 1] - nodes[0]);
  if (gap < rounding) { // the first meridian is repeated, up to the rounding of floats
    sides[0] = nodes[0];
    sides[n] = nodes[0] + 360;
  } else if (gap <= 1.5 * step) {
    sides[n] = nodes[n - 1] + 0.5 * gap;
    sides[0] = sides[n] - 360;
  }
  return sides;
}

/// The side beyond a node; at the pole if that is less than a step away.
double reaching_pole(double node, double side) {
  const double step = 2 * (side - node), pole = std::copysign(90, step);
  return std::abs(pole - node) <= std::abs(step) * (1 + slack) ? pole : side;
}

DoubleVector parallels_around(const DoubleVector& nodes) {
  const Eigen::Index n = nodes.size();
  DoubleVector sides = middles(nodes);
  sides[0] = reaching_pole(nodes[0], sides[0]);
  sides[n] = reaching_pole(nodes[n - 1], sides[n]);
  return sides;
}

} // namespace

Height height_of(double latitude) {
  const double half = from_lonlat(0, (90 - std::abs(latitude)) / 2).z;
  return {from_lonlat(0, latitude).z, 2 * half * half};
}

MapPoint map_point_of(const Vec3& unit) {
  constexpr double nothing = 1e-15;
  const double square = unit.x * unit.x + unit.y * unit.y, radius = std::sqrt(square);
  if (radius < nothing)
    return {1, 0, 0, {std::copysign(1, unit.z), 0}};
  return {unit.x / radius, unit.y / radius, radius, {unit.z, square / (1 + std::abs(unit.z))}};
}

double turn_between(const MapPoint& from, const MapPoint& to) {
  return longitude_of(from.east_x * to.east_x + from.east_y * to.east_y,
                      from.east_x * to.east_y - from.east_y * to.east_x);
}

BoxTiling::BoxTiling(const LonLatBoxes& boxes)
    : width_(static_cast<std::int32_t>(boxes.longitudes.size())),
      meridians_(boxes.meridians.begin(), boxes.meridians.end()) {
  require_boxes(boxes);
  column_of_.resize(static_cast<std::size_t>(width_));
  for (std::int32_t i = 0; i < width_; ++i)
    column_of_[static_cast<std::size_t>(i)] = i;
  const double end = meridians_.front() + 360;
  if (meridians_.back() < end - slack) {
    column_of_.push_back(-1);
    meridians_.push_back(end);
  }
  meridians_.back() = end;
  for (std::size_t k = 0; k + 1 < meridians_.size(); ++k)
    directions_.push_back(from_lonlat(meridians_[k], 0));

  std::vector<double> parallels(boxes.parallels.begin(), boxes.parallels.end());
  for (std::int32_t j = 0; j < boxes.latitudes.size(); ++j)
    row_of_.push_back(j);
  if (parallels.front() > parallels.back()) {
    std::reverse(parallels.begin(), parallels.end());
    std::reverse(row_of_.begin(), row_of_.end());
  }
  if (parallels.front() > slack - 90) {
    parallels.insert(parallels.begin(), -90);
    row_of_.insert(row_of_.begin(), -1);
  }
  if (parallels.back() < 90 - slack) {
    parallels.push_back(90);
    row_of_.push_back(-1);
  }
  parallels.front() = -90;
  parallels.back() = 90;
  for (const double parallel : parallels) {
    heights_.push_back(height_of(parallel));
    radii_.push_back(from_lonlat(0, parallel).x);
  }
}

std::int64_t BoxTiling::column_at(double longitude) const {
  const double turns = std::floor((longitude - meridians_.front()) / 360),
               inside = longitude - 360 * turns;
  const auto after = std::upper_bound(meridians_.begin() + 1, meridians_.end() - 1, inside);
  return after - meridians_.begin() - 1 + static_cast<std::int64_t>(turns) * columns();
}

std::int32_t BoxTiling::box_at(const Vec3& unit) const {
  return box(wrapped(column_at(lonlat_of(unit).longitude)), row_at(map_point_of(unit).height));
}

std::int64_t BoxTiling::row_at(const Height& height) const {
  const auto after =
      std::upper_bound(heights_.begin() + 1, heights_.end() - 1, height,
                       [](const Height& a, const Height& b) { return rise(a, b) > 0; });
  return after - heights_.begin() - 1;
}

} // namespace remap_detail

LonLatBoxes lon_lat_boxes(std::int64_t columns, std::int64_t rows) {
  constexpr std::int64_t most = std::int64_t{1} << 20;
  base_detail::require(columns >= 3 && columns <= most && rows >= 1 && rows <= most,
                       "a raster of {} x {} boxes is out of range; "
                       "give 3 to 2^20 columns and 1 to 2^20 rows",
                       columns, rows);
  LonLatBoxes boxes{DoubleVector(columns), DoubleVector(rows), DoubleVector(columns + 1),
                    DoubleVector(rows + 1)};
  for (std::int64_t i = 0; i <= columns; ++i)
    boxes.meridians[i] = 360.0 * static_cast<double>(i) / static_cast<double>(columns);
  for (std::int64_t i = 0; i < columns; ++i)
    boxes.longitudes[i] = 180.0 * static_cast<double>(2 * i + 1) / static_cast<double>(columns);
  for (std::int64_t j = 0; j <= rows; ++j) // the same digits on both sides of the equator
    boxes.parallels[j] = 90.0 * static_cast<double>(2 * j - rows) / static_cast<double>(rows);
  for (std::int64_t j = 0; j < rows; ++j)
    boxes.latitudes[j] = 90.0 * static_cast<double>(2 * j + 1 - rows) / static_cast<double>(rows);
  require_boxes(boxes);
  return boxes;
}

LonLatBoxes lon_lat_boxes(const DoubleVector& longitudes, const DoubleVector& latitudes) {
  using namespace remap_detail;
  require(longitudes.size() >= 3 && latitudes.size() >= 2,
          "there are {} longitudes and {} latitudes; give at least 3 and 2", longitudes.size(),
          latitudes.size());
  require_order(longitudes, "longitude", 1);
  require_latitudes(latitudes, "latitude");
  LonLatBoxes boxes{longitudes, latitudes, meridians_around(longitudes),
                    parallels_around(latitudes)};
  require_boxes(boxes);
  return boxes;
}

LonLatBoxes lon_lat_boxes(const Raster& raster) {
  LonLatBoxes boxes = lon_lat_boxes(raster.x, raster.y);
  const Eigen::Index columns = raster.x.size(), rows = raster.y.size();
  boxes.meridians[columns] = 0.5 * (raster.x[columns - 1] + raster.x[0] + 360);
  boxes.meridians[0] = boxes.meridians[columns] - 360;
  boxes.parallels[0] = -90;
  boxes.parallels[rows] = 90;
  require_boxes(boxes);
  return boxes;
}

void require_boxes(const LonLatBoxes& boxes) {
  using namespace remap_detail;
  const DoubleVector &meridians = boxes.meridians, &parallels = boxes.parallels;
  const Eigen::Index columns = boxes.longitudes.size(), rows = boxes.latitudes.size();
  require(columns >= 1 && rows >= 1 && meridians.size() == columns + 1 &&
              parallels.size() == rows + 1,
          "a raster's boxes have {} meridians and {} parallels for {} x {} nodes; "
          "give one more of each",
          meridians.size(), parallels.size(), columns, rows);
  require(columns * rows <= std::numeric_limits<std::int32_t>::max(),
          "a raster of {} x {} boxes has more than 2^31 - 1; give a smaller one", columns, rows);
  require_order(meridians, "meridian", 1);
  require_latitudes(parallels, "parallel");
  require(meridians[columns] - meridians[0] <= 360 + slack,
          "the meridians of a raster span {} degrees; give at most 360",
          meridians[columns] - meridians[0]);
  for (Eigen::Index i = 0; i < columns; ++i)
    if (const double width = meridians[i + 1] - meridians[i]; !(width < widest))
      refuse(message("box {} of a raster is {} degrees wide; give boxes below 180", i, width));
  require_order(boxes.longitudes, "longitude", 1);
  require_latitudes(boxes.latitudes, "latitude");
}

DoubleVector areas(const LonLatBoxes& boxes) {
  using namespace remap_detail;
  require_boxes(boxes);
  const Eigen::Index columns = boxes.longitudes.size(), rows = boxes.latitudes.size();
  DoubleVector out(columns * rows);
  for (Eigen::Index j = 0; j < rows; ++j) {
    const double high =
        std::abs(rise(height_of(boxes.parallels[j]), height_of(boxes.parallels[j + 1])));
    for (Eigen::Index i = 0; i < columns; ++i)
      out[j * columns + i] =
          degree_in_radians * (boxes.meridians[i + 1] - boxes.meridians[i]) * high;
  }
  return out;
}

Points3 nodes(const LonLatBoxes& boxes) {
  using namespace remap_detail;
  const Eigen::Index columns = boxes.longitudes.size(), rows = boxes.latitudes.size();
  Points3 out(3, columns * rows);
  for_each_block(rows, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (Eigen::Index j = begin; j < end; ++j)
      for (Eigen::Index i = 0; i < columns; ++i)
        set_column(out, j * columns + i, from_lonlat(boxes.longitudes[i], boxes.latitudes[j]));
  });
  return out;
}

} // namespace calotte
