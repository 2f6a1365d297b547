// SPDX-License-Identifier: GPL-3.0-or-later
#include "remap/box_overlaps.h"

#include "base/spherical_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace calotte::remap_detail {
namespace {

using base_detail::longitude_of;

constexpr double degrees_per_radian = 180 / std::numbers::pi;

/// The turn of an arc of a great circle around the axis, and the area between the arc and a
/// parallel.
struct Turn {
  double angle; ///< radians eastwards
  double area;  ///< above the parallel
};

/// 2 (atan(h t) - t atan(h)) for |h| < 0.05, where e = 1 - t^2: its series in h.
double excess_of_small(double h, double t, double e) {
  const double h2 = h * h, t2 = t * t;
  const double t4 = t2 * t2, t6 = t4 * t2, t8 = t4 * t4;
  const double series =
      1.0 / 3 -
      h2 * ((1 + t2) / 5 - h2 * ((1 + t2 + t4) / 7 - h2 * ((1 + t2 + t4 + t6) / 9 -
                                                           h2 * ((1 + t2 + t4 + t6 + t8) / 11))));
  return 2 * t * e * h * h2 * series;
}

double twice_arc_tangent_of_small(double h) {
  const double h2 = h * h;
  return 2 * h * (1 - h2 * (1.0 / 3 - h2 * (1.0 / 5 - h2 * (1.0 / 7 - h2 * (1.0 / 9 - h2 / 11)))));
}

/// The area between the arc and the equator is S with tan(S/2) = t tan(D/2), D the difference of
/// longitudes, t = (z1 + z2) / (1 + r1 r2 + z1 z2) (Karney, J. Geodesy 87, 2013, Sect. 4, on the
/// sphere). From it the area D z of the strip below the parallel of height z is taken such that
/// small areas keep their digits: t - z and 1 - |t| are sums of small terms.
Turn turn_of(const MapPoint& from, const MapPoint& to, const Height& parallel) {
  const double sine = from.east_x * to.east_y - from.east_y * to.east_x,
               cosine = 1 + from.east_x * to.east_x + from.east_y * to.east_y;
  if (sine == 0)
    return {0, 0};
  const double z1 = from.height.sine, z2 = to.height.sine, radii = from.radius * to.radius,
               whole = 1 + radii + z1 * z2, t = (z1 + z2) / whole;
  const double up = rise(from.height, to.height), out = to.radius - from.radius;
  const double above = 0.5 * (rise(parallel, from.height) + rise(parallel, to.height)) +
                       0.25 * t * (up * up + out * out);
  const bool polar = std::abs(t) > 0.5 && z1 * z2 > 0;
  const double gap = polar ? (from.height.gap * to.height.gap + radii) / whole : 1 - std::abs(t);
  const double size = std::abs(t), h = sine / cosine;
  constexpr double small = 0.03; // h^12 is below rounding
  if (std::abs(h) < small) {
    const double angle = twice_arc_tangent_of_small(h);
    return {angle, angle * above + excess_of_small(h, t, gap * (1 + size))};
  }
  const double angle = 2 * longitude_of(cosine, sine);
  const double less = polar ? gap * angle - 2 * longitude_of(cosine * cosine + sine * sine * size,
                                                             sine * cosine * gap)
                            : 2 * longitude_of(cosine, sine * size) - size * angle;
  return {angle, angle * above + std::copysign(1, t) * less};
}

/// The point where the arc meets the meridian to its east or west.
MapPoint at_meridian(const MapPoint& from, const MapPoint& to, const Vec3& meridian) {
  const auto side = [&](const MapPoint& p) {
    return p.radius * (meridian.x * p.east_y - meridian.y * p.east_x);
  };
  const double a = std::abs(side(from)), b = std::abs(side(to));
  const Vec3 p = from.position(), q = to.position();
  const Vec3 met = a + b > 0 ? (b / (a + b)) * p + (a / (a + b)) * q : p;
  const double length = norm(met);
  const double radius = std::sqrt(met.x * met.x + met.y * met.y) / length, z = met.z / length;
  return {meridian.x, meridian.y, radius, {z, radius * radius / (1 + std::abs(z))}};
}

/// The point where an arc of monotonic height crosses a parallel. With the tangent w at p, the
/// point p cos x + w sin x has the height z cos x + w_z sin x and the slope w_z cos x - z sin x.
/// The square of the slope is the square of the circle's greatest height minus that of the
/// parallel's height. It is also the square of the parallel's radius minus that of the height of
/// the circle's normal, which is exact near a pole.
///
/// An end of the arc may lie on the parallel to the last bit, or the arc may touch the parallel.
/// Then rounding decides where the circles meet, or whether they do; the crossing is clamped to the
/// arc. Its exact position does not matter: between two such points, arc and parallel have the same
/// height up to rounding, and the areas of the boxes on both sides change by rounding only.
MapPoint at_parallel(const MapPoint& from, const MapPoint& to, const Height& parallel,
                     double radius) {
  const auto with_longitude_of = [&](const MapPoint& end) {
    return MapPoint{end.east_x, end.east_y, radius, parallel};
  };
  const Vec3 p = from.position(), q = to.position(), way = q - p;
  const double bend = 0.5 * dot(way, way);
  const Vec3 tangent{way.x + bend * p.x, way.y + bend * p.y,
                     rise(from.height, to.height) + bend * p.z};
  const double length = norm(tangent); // the sine of the arc
  if (!(length > 0))
    return with_longitude_of(from);
  const Vec3 w = (1 / length) * tangent;
  // 1 less the square of the height of the circle's normal: that of its greatest height
  const double normal = p.x * w.y - p.y * w.x, size = p.z * p.z + w.z * w.z, top = std::sqrt(size),
               square = size < 0.5
                            ? (top - std::abs(parallel.sine)) * (top + std::abs(parallel.sine))
                            : (radius - normal) * (radius + normal),
               slope =
                   std::copysign(std::sqrt(std::max(square, 0.0)), rise(from.height, to.height)),
               cosine = (p.z * parallel.sine + w.z * slope) / size,
               sine = (w.z * parallel.sine - p.z * slope) / size;
  if (!(sine > 0))
    return with_longitude_of(from);
  if (sine * (1 - bend) > cosine * length)
    return with_longitude_of(to);
  const double x = cosine * p.x + sine * w.x, y = cosine * p.y + sine * w.y,
               distance = std::sqrt(x * x + y * y);
  return distance > 0 ? MapPoint{x / distance, y / distance, radius, parallel}
                      : with_longitude_of(from);
}

/// An arc through a pole makes half a turn, to a fixed side: the polygons on both sides of the arc,
/// which run along it in opposite directions, must use the same side.
constexpr double half_turn = std::numbers::pi * (1 - 0x1p-50);
bool is_first(const MapPoint& a, const MapPoint& b) {
  return std::pair(a.east_x, a.east_y) < std::pair(b.east_x, b.east_y);
}

} // namespace

// ---- The boundary

void BoxOverlaps::add_pole(const MapPoint& pole, const MapPoint& before, const MapPoint& after) {
  const double north = pole.height.sine;
  double turn = turn_between(before, after) * degrees_per_radian;
  if (north * turn > 0) // counter-clockwise, round the outside of the polygon
    turn -= north * 360;
  const double longitude = path_.back().longitude;
  path_.push_back({{before.east_x, before.east_y, 0, pole.height}, longitude});
  path_.push_back({{after.east_x, after.east_y, 0, pole.height}, longitude + turn});
}

void BoxOverlaps::set_path(std::span<const Vec3> corners) {
  path_.clear();
  const std::size_t n = corners.size();
  std::size_t first = 0;
  while (first < n && map_point_of(corners[first]).at_pole())
    ++first;
  if (first == n)
    return;
  const MapPoint start = map_point_of(corners[first]);
  path_.push_back({start, longitude_of(start.east_x, start.east_y) * degrees_per_radian});
  MapPoint before = start, pole{};
  bool through_pole = false;
  for (std::size_t k = 1; k <= n; ++k) {
    const MapPoint next = k == n ? start : map_point_of(corners[(first + k) % n]);
    if (next.at_pole()) {
      through_pole = true;
      pole = next;
      continue;
    }
    if (through_pole) {
      add_pole(pole, before, next);
      path_.push_back({next, path_.back().longitude});
    } else {
      double turn = turn_between(before, next);
      if (std::abs(turn) > half_turn)
        turn = std::copysign(turn, is_first(before, next) ? 1 : -1);
      path_.push_back({next, path_.back().longitude + turn * degrees_per_radian});
    }
    through_pole = false;
    before = next;
  }
}

/// The boundary of a polygon around the north pole is extended: to the pole, around it, and back
/// along the same meridian.
void BoxOverlaps::close_path() {
  const double around = path_.back().longitude - path_.front().longitude;
  contains_south_pole_ = around < -180;
  if (around <= 180)
    return;
  const PathPoint end = path_.back();
  const MapPoint pole{end.point.east_x, end.point.east_y, 0, {1, 0}};
  path_.push_back({pole, end.longitude});
  path_.push_back({pole, path_.front().longitude});
}

// ---- Its pieces

void BoxOverlaps::add_piece(const MapPoint& from, const MapPoint& to) {
  const Turn turn = turn_of(from, to, tiling_.height(row_));
  if (turn.angle != 0)
    pieces_.push_back({column_, row_, turn.angle, turn.area});
}

/// \param start, end of an arc of monotonic height.
/// \param from, to points of the arc in one column. Further points are computed from the ends of
///        the arc, so that rounding does not accumulate.
void BoxOverlaps::trace_in_column(const PathPoint& start, const PathPoint& end, MapPoint from,
                                  const MapPoint& to) {
  const auto pass = [&](std::int64_t parallel) {
    const MapPoint met =
        at_parallel(start.point, end.point, tiling_.height(parallel), tiling_.radius(parallel));
    add_piece(from, met);
    from = met;
  };
  while (row_ + 1 < tiling_.rows() && rise(tiling_.height(row_ + 1), to.height) > 0) {
    pass(row_ + 1);
    ++row_;
  }
  while (row_ > 0 && rise(tiling_.height(row_), to.height) < 0) {
    pass(row_);
    --row_;
  }
  add_piece(from, to);
}

void BoxOverlaps::trace_monotone(const PathPoint& start, const PathPoint& end) {
  MapPoint from = start.point;
  const auto pass = [&](std::int64_t meridian) {
    const MapPoint met = at_meridian(start.point, end.point, tiling_.direction_of(meridian));
    trace_in_column(start, end, from, met);
    from = met;
  };
  while (tiling_.west_of(column_ + 1) < end.longitude) {
    pass(column_ + 1);
    ++column_;
  }
  while (tiling_.west_of(column_) > end.longitude) {
    pass(column_);
    --column_;
  }
  trace_in_column(start, end, from, end.point);
}

/// Traces the boundary around the north pole. Around the south pole there is no area below.
void BoxOverlaps::trace_pole(const PathPoint& from, const PathPoint& to) {
  double longitude = from.longitude;
  const double high = rise(tiling_.height(row_), from.point.height);
  const auto pass = [&](double next) {
    const double turn = (next - longitude) / degrees_per_radian;
    pieces_.push_back({column_, row_, turn, turn * high});
    longitude = next;
  };
  while (tiling_.west_of(column_ + 1) < to.longitude) {
    pass(tiling_.west_of(column_ + 1));
    ++column_;
  }
  while (tiling_.west_of(column_) > to.longitude) {
    pass(tiling_.west_of(column_));
    --column_;
  }
  pass(to.longitude);
}

/// Traces an arc, which is cut where its height is greatest or least.
void BoxOverlaps::trace(const PathPoint& from, const PathPoint& to) {
  if (from.point.at_pole() && to.point.at_pole())
    return trace_pole(from, to);
  const Vec3 p = from.point.position(), q = to.point.position(), way = q - p;
  const double up = rise(from.point.height, to.point.height), bend = 0.5 * dot(way, way),
               start = up + bend * p.z, end = up - bend * q.z; // slopes
  const bool meridian = from.point.at_pole() || to.point.at_pole();
  if (meridian || !(start * end < 0))
    return trace_monotone(from, to);
  const Vec3 n = cross(p, way);
  const double side = std::copysign(1, start);
  const Vec3 top{-side * n.x * n.z, -side * n.y * n.z, side * (n.x * n.x + n.y * n.y)};
  const double length = norm(top);
  if (!(length > 0))
    return trace_monotone(from, to);
  const MapPoint point = map_point_of((1 / length) * top);
  if (point.at_pole()) {
    const PathPoint before{{from.point.east_x, from.point.east_y, 0, point.height}, from.longitude},
        after{{to.point.east_x, to.point.east_y, 0, point.height}, to.longitude};
    trace_monotone(from, before);
    trace_pole(before, after);
    return trace_monotone(after, to);
  }
  const double longitude = from.longitude + turn_between(from.point, point) * degrees_per_radian;
  const double west = std::min(from.longitude, to.longitude),
               east = std::max(from.longitude, to.longitude);
  if (longitude < west || longitude > east)
    return trace_monotone(from, to);
  trace_monotone(from, {point, longitude});
  trace_monotone({point, longitude}, to);
}

// ---- Areas

void BoxOverlaps::put(double area, double whole, std::int32_t box, double box_area,
                      WeightRow& out) const {
  constexpr double rounding = 0x1p-50;
  if (box >= 0 && area > rounding * std::sqrt(std::min(whole, box_area)))
    out.push_back({box, area});
}

double BoxOverlaps::set_areas(WeightRow& out) {
  const auto [west, east] =
      std::minmax_element(pieces_.begin(), pieces_.end(),
                          [](const Piece& a, const Piece& b) { return a.column < b.column; });
  const auto [south, north] = std::minmax_element(
      pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.row < b.row; });
  const std::int64_t first = west->column, all = tiling_.columns(),
                     columns = std::min(east->column - first + 1, all),
                     base = contains_south_pole_ ? 0 : south->row, rows = north->row - base + 1;
  areas_.assign(static_cast<std::size_t>(columns * rows), 0);
  turns_.assign(static_cast<std::size_t>(columns * rows), 0);
  for (const Piece& piece : pieces_) {
    std::int64_t i = piece.column - first;
    while (i >= all)
      i -= all;
    const auto k = static_cast<std::size_t>(i * rows + piece.row - base);
    areas_[k] -= piece.area;
    turns_[k] += piece.turn;
  }
  rises_.clear();
  for (std::int64_t j = base; j < base + rows; ++j)
    rises_.push_back(rise(tiling_.height(j), tiling_.height(j + 1)));
  double whole = 0;
  columns_.clear();
  for (std::int64_t i = 0; i < columns; ++i) {
    double turn = 0; // of what is above
    for (auto j = rises_.size(); j-- > 0;) {
      const std::size_t k = static_cast<std::size_t>(i) * rises_.size() + j;
      areas_[k] -= turn * rises_[j];
      turn += turns_[k];
      whole += areas_[k];
    }
    columns_.push_back(
        {tiling_.wrapped(first + i),
         (tiling_.west_of(first + i + 1) - tiling_.west_of(first + i)) / degrees_per_radian});
  }
  for (std::size_t j = 0; j < rises_.size(); ++j)
    for (std::size_t i = 0; i < columns_.size(); ++i)
      put(areas_[i * rises_.size() + j], whole,
          tiling_.box(columns_[i].wrapped, base + static_cast<std::int64_t>(j)),
          columns_[i].wide * rises_[j], out);
  sort_by_column(out);
  return whole;
}

double BoxOverlaps::set(std::span<const Vec3> corners, WeightRow& out) {
  out.clear();
  pieces_.clear();
  set_path(corners);
  if (path_.empty())
    return 0;
  close_path();
  column_ = tiling_.column_at(path_.front().longitude);
  row_ = tiling_.row_at(path_.front().point.height);
  for (std::size_t k = 0; k + 1 < path_.size(); ++k)
    trace(path_[k], path_[k + 1]);
  return pieces_.empty() ? 0 : set_areas(out);
}

} // namespace calotte::remap_detail
