// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/circle.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"
#include "domain/written_rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace domain_detail;

constexpr double least_angle = 1e-6;
constexpr double half_turn = std::numbers::pi, quarter_turn = 0.5 * std::numbers::pi;

/// Cosine and sine of i/n of a turn.
CosSin part_of_turn(std::int64_t i, std::int64_t n) {
  const auto octant = static_cast<int>(8 * i / n);
  const std::int64_t rest = 8 * i % n; // of n
  return cos_sin_of_octant(octant, static_cast<double>(octant % 2 == 0 ? rest : n - rest) /
                                       static_cast<double>(n));
}

/// Cosine and sine of any finite angle.
CosSin cos_sin_of(double angle) {
  const double turned = std::remainder(angle, 2 * half_turn);
  CosSin turn = cos_sin_of_angle(std::abs(turned));
  turn.sin = std::copysign(turn.sin, turned);
  return turn;
}

/// The directions of east and north at a point; at a pole, those at longitude 0.
struct Compass {
  Vec3 up, east, north;
};

Compass compass_at(const Eigen::Vector3d& point, const std::string& what) {
  require(point.allFinite() && !point.isZero(0),
          "the {}'s centre is no direction; give three finite numbers that are not all 0", what);
  const Vec3 up = as_unit({point.x(), point.y(), point.z()});
  const double sideways = std::sqrt(up.x * up.x + up.y * up.y);
  const Vec3 east = sideways > 0 ? Vec3{-up.y / sideways, up.x / sideways, 0} : Vec3{0, 1, 0};
  return {up, east, cross(up, east)};
}

void require_corners(int corners) {
  require(corners >= 8 && corners <= 1 << 24, "the number of corners is {}; give 8 to 16777216",
          corners);
}

/// The ring of the points point_at(cosine, sine) at the angles of a regular polygon.
template <class PointAt> Points3 ring_of(int corners, const PointAt& point_at) {
  Points3 ring(3, corners);
  for (int i = 0; i < corners; ++i)
    set_column(ring, i, as_unit(point_at(part_of_turn(i, corners))));
  return ring;
}

/// The parallel of a latitude, eastward.
Points3 parallel(double latitude, int corners) {
  const CosSin north = cos_sin_of_angle(std::abs(latitude));
  return ring_of(corners, [&](const CosSin& east) {
    return Vec3{north.cos * east.cos, north.cos * east.sin, std::copysign(north.sin, latitude)};
  });
}

Points3 reversed(const Points3& ring) { return ring.rowwise().reverse(); }

bool is_pole(double latitude) { return std::abs(latitude) >= quarter_turn - 1e-15; }

/// Refuses latitudes of a band that is empty, thin, or leaves too small a cap at a pole.
void require_band(double lower, double upper, const std::string& what) {
  constexpr double degrees = 180 / half_turn;
  require(
      lower < upper && std::abs(lower) <= quarter_turn && std::abs(upper) <= quarter_turn,
      "the {}'s latitudes are {} and {} degrees; give the lower one first, from -90 to 90 degrees",
      what, lower * degrees, upper * degrees);
  const auto valid = [](double latitude) {
    return is_pole(latitude) || std::abs(latitude) <= quarter_turn - least_angle;
  };
  require(
      valid(lower) && valid(upper) && upper - lower >= least_angle,
      "the {}'s latitudes {} and {} degrees are nearer than 6e-5 to each other or to a pole; give "
      "others, or the pole",
      what, lower * degrees, upper * degrees);
}

// ---- Boxes

/// The number of equal arcs along a side of a box that stay within 1/60 000 000 of its length from
/// the parallel, a thousandth of a cell where 60 000 cells lie along the side, and are shorter than
/// a half circle. An arc of the longitudes a is a^2/8 sin(latitude) cos(latitude) poleward of it.
int arcs_on_parallel(double latitude, double width) {
  constexpr double of_length = 1 / 60e6, longest = 1.5;
  const double arcs = std::sqrt(width * std::abs(cos_sin_of(latitude).sin) / (8 * of_length));
  return static_cast<int>(std::ceil(std::max(width / longest, arcs)));
}

/// The corners of a side of a box on a parallel, eastward with both ends; a pole is one corner.
std::vector<Vec3> side_on_parallel(double latitude, double west, double width) {
  if (is_pole(latitude))
    return {{0, 0, std::copysign(1.0, latitude)}};
  const CosSin north = cos_sin_of(latitude);
  const int arcs = arcs_on_parallel(latitude, width);
  std::vector<Vec3> corners;
  for (int i = 0; i <= arcs; ++i) {
    const CosSin east = cos_sin_of(west + width * i / arcs);
    corners.push_back(as_unit({north.cos * east.cos, north.cos * east.sin, north.sin}));
  }
  return corners;
}

/// The difference of longitudes from west to east, above 0; 2 pi for a whole parallel.
double width_of_box(double west, double east) {
  constexpr double turn = 2 * half_turn, slack = 1e-9, degrees = 180 / half_turn;
  require(std::isfinite(west) && std::isfinite(east),
          "a longitude of the box is not finite; give radians");
  const double width =
      east < west ? east - west + turn * std::ceil((west - east) / turn) : east - west;
  require(width <= turn + slack,
          "the box runs {} degrees eastward from its west side, more than all around; give at most "
          "360",
          width * degrees);
  require(width >= least_angle && (west <= east || width <= turn - slack),
          "the box has no width: its west side {} and its east side {} are one meridian; give two, "
          "or -180 and 180 degrees for all longitudes",
          west * degrees, east * degrees);
  return width >= turn - least_angle ? turn : width;
}

} // namespace

Surface rectangle(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper) {
  base_detail::require(
      (lower.array() < upper.array()).all(),
      "the rectangle's lower corner is not below and left of the upper one; give the "
      "lesser coordinates first");
  Points2 ring(2, 4);
  ring << lower.x(), upper.x(), upper.x(), lower.x(), lower.y(), lower.y(), upper.y(), upper.y();
  return Surface::plane().within({ring});
}

Surface circle(const Eigen::Vector3d& centre, double radius, int corners) {
  const auto [up, east, north] = compass_at(centre, "circle");
  require(radius >= least_angle && radius <= half_turn - least_angle,
          "the circle's radius is {}; give 1e-6 to pi - 1e-6 radians", radius);
  require_corners(corners);
  const CosSin away = cos_sin_of_angle(radius);
  return UncheckedSurface::of_sphere(
      {ring_of(corners, [&, up = up, east = east, north = north](const CosSin& turn) {
        return away.cos * up + away.sin * (turn.cos * north - turn.sin * east);
      })});
}

// In the plane that touches the sphere at the centre, great circles are straight lines, and the
// ellipse is an ellipse of the semi-axes tan(semi_major) and tan(semi_minor).
Surface ellipse(const Eigen::Vector3d& centre, double semi_major, double semi_minor, double bearing,
                int corners) {
  const auto [up, east, north] = compass_at(centre, "ellipse");
  require(semi_minor >= least_angle && semi_minor <= semi_major &&
              semi_major <= quarter_turn - least_angle,
          "the ellipse's semi-axes are {} and {}; give the major one first, and "
          "1e-6 to pi/2 - 1e-6 radians for both",
          semi_major, semi_minor);
  require(std::isfinite(bearing), "the ellipse's bearing is not finite; give radians from north");
  require_corners(corners);
  const CosSin along = cos_sin_of(bearing);
  const CosSin a = cos_sin_of_angle(semi_major), b = cos_sin_of_angle(semi_minor);
  const Vec3 major = (a.sin / a.cos) * (along.cos * north + along.sin * east),
             minor = (b.sin / b.cos) * (along.sin * north - along.cos * east);
  return UncheckedSurface::of_sphere({ring_of(corners, [&, up = up](const CosSin& turn) {
    return up + turn.cos * major + turn.sin * minor;
  })});
}

Surface channel(double lower, double upper, int corners) {
  require_band(lower, upper, "channel");
  require(!is_pole(lower) || !is_pole(upper),
          "the band from pole to pole is the whole sphere; give no region");
  require_corners(corners);
  Surface::Rings rings;
  if (!is_pole(lower))
    rings.push_back(parallel(lower, corners));
  if (!is_pole(upper))
    rings.push_back(reversed(parallel(upper, corners)));
  return UncheckedSurface::of_sphere(std::move(rings));
}

Surface box(double west, double south, double east, double north) {
  require_band(south, north, "box");
  const double width = width_of_box(west, east);
  if (width == 2 * half_turn)
    return channel(south, north,
                   std::max({8, arcs_on_parallel(south, width), arcs_on_parallel(north, width)}));
  std::vector<Vec3> corners = side_on_parallel(south, west, width);
  const std::vector<Vec3> upper = side_on_parallel(north, west, width);
  const CosSin middle = cos_sin_of(0.5 * (south + north)); // of a meridian from pole to pole
  const auto add_middle = [&](double longitude) {
    const CosSin at = cos_sin_of(longitude);
    if (north - south > quarter_turn)
      corners.push_back(as_unit({middle.cos * at.cos, middle.cos * at.sin, middle.sin}));
  };
  add_middle(west + width);
  corners.insert(corners.end(), upper.rbegin(), upper.rend());
  add_middle(west);
  Points3 ring(3, std::ssize(corners));
  for (std::size_t i = 0; i < corners.size(); ++i)
    set_column(ring, static_cast<Eigen::Index>(i), corners[i]);
  return UncheckedSurface::of_sphere({ring});
}

Surface region_around(const std::vector<Points3>& rings, const Eigen::Vector3d& point) {
  require(!rings.empty(), "the region has no rings; give one at least");
  require(point.allFinite() && !point.isZero(0),
          "the place inside the region is no direction; give three finite numbers that are not "
          "all 0");
  return UncheckedSurface::of_sphere(
      corners_of(around(written(rings), as_unit({point.x(), point.y(), point.z()}))));
}

Surface enclosed_region(const std::vector<Points3>& rings) {
  require(!rings.empty(), "the region has no rings; give one at least");
  return UncheckedSurface::of_sphere(corners_of(enclosed(written(rings))));
}

} // namespace calotte
