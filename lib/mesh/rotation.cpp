// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/rotation.h>

#include "base/double_double.h"
#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace base_detail;

using Triple = std::array<DoubleDouble, 3>;

/// Cosine and sine, the sum of whose squares is 1 within 1e-31.
struct Turn {
  DoubleDouble cos, sin;
};

Turn turn_by(double degrees) {
  const Vec3 at = from_lonlat(degrees, 0);
  const DoubleDouble scale = inverse_sqrt(two_product(at.x, at.x) + two_product(at.y, at.y));
  return {DoubleDouble{at.x, 0} * scale, DoubleDouble{at.y, 0} * scale};
}

/// East, north and up at a point, an orthonormal frame.
struct Frame {
  Triple east, north, up;
};

Frame frame_at(const Eigen::Vector2d& lonlat) {
  const Turn lon = turn_by(lonlat[0]), lat = turn_by(lonlat[1]);
  return {{-lon.sin, lon.cos, {}},
          {-(lat.sin * lon.cos), -(lat.sin * lon.sin), lat.cos},
          {lat.cos * lon.cos, lat.cos * lon.sin, lat.sin}};
}

/// a cos + b sin.
Triple combined(const DoubleDouble& cos, const Triple& a, const DoubleDouble& sin,
                const Triple& b) {
  return {cos * a[0] + sin * b[0], cos * a[1] + sin * b[1], cos * a[2] + sin * b[2]};
}

/// -1, 0 and 1 instead of numbers that differ from them by the rounding of a few operations.
DoubleDouble snapped(const DoubleDouble& value) {
  const double whole = std::round(value.hi);
  return std::abs((value.hi - whole) + value.lo) < 0x1p-96 ? DoubleDouble{whole, 0} : value;
}

void require_lonlat(const char* name, const Eigen::Vector2d& lonlat) {
  require(
      lonlat.allFinite() && std::abs(lonlat[1]) <= 90,
      "the point {} has the longitude {} and the latitude {}; give finite degrees, the latitude "
      "from -90 to 90",
      name, lonlat[0], lonlat[1]);
}

/// A power of two that brings a vector of an extreme norm near 1; else 1.
double scale_of(const Eigen::Vector3d& point) {
  const double size = point.cwiseAbs().maxCoeff();
  if (!(size > 0) || (size > 0x1p-300 && size < 0x1p300))
    return 1;
  return std::ldexp(1.0, -std::clamp(std::ilogb(size), -1000, 1000));
}

} // namespace

Rotation::Rotation(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bearing) {
  require_lonlat("from", from);
  require_lonlat("to", to);
  require(std::isfinite(bearing), "the bearing is {}; give finite degrees", bearing);
  const Frame old = frame_at(from), now = frame_at(to);
  const Turn turn = turn_by(bearing);
  const Triple east = combined(turn.cos, now.east, -turn.sin, now.north),
               north = combined(turn.sin, now.east, turn.cos, now.north);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const DoubleDouble entry =
          snapped(east[i] * old.east[j] + north[i] * old.north[j] + now.up[i] * old.up[j]);
      high_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entry.hi + 0.0;
      low_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entry.lo + 0.0;
    }
}

Eigen::Vector3d Rotation::operator()(const Eigen::Vector3d& point) const {
  if (is_identity())
    return point;
  const double scale = scale_of(point);
  Eigen::Vector3d out;
  for (Eigen::Index i = 0; i < 3; ++i) {
    DoubleDouble sum;
    for (Eigen::Index j = 0; j < 3; ++j)
      sum = sum + DoubleDouble{high_(i, j), low_(i, j)} * DoubleDouble{point[j] * scale, 0};
    out[i] = (sum.hi + 0.0) / scale; // no coordinate is -0
  }
  return out;
}

Points3 Rotation::operator()(const Points3& points) const {
  if (is_identity())
    return points;
  Points3 out(3, points.cols());
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      out.col(i) = (*this)(Eigen::Vector3d(points.col(i)));
  });
  return out;
}

Rotation Rotation::inverse() const {
  Rotation back;
  back.high_ = high_.transpose();
  back.low_ = low_.transpose();
  return back;
}

bool Rotation::is_identity() const {
  return high_ == Eigen::Matrix3d::Identity() && low_ == Eigen::Matrix3d::Zero();
}

namespace {

/// Moves sites that rounding has put outside of the surface inside, towards a triangle of theirs:
/// those on its boundary.
void keep_inside(Mesh& mesh) {
  std::vector<std::uint8_t> outside(static_cast<std::size_t>(mesh.points.cols()));
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      outside[static_cast<std::size_t>(i)] = mesh.surface.contains(mesh.points.col(i)) ? 0 : 1;
  });
  for (const auto& triangle : mesh.triangles.colwise())
    for (const std::int32_t site : triangle) {
      if (std::exchange(outside[static_cast<std::size_t>(site)], std::uint8_t{0}) == 0)
        continue;
      const Eigen::Vector3d x = mesh.points.col(site);
      const Eigen::Vector3d way = (mesh.points.col(triangle(0)) + mesh.points.col(triangle(1)) +
                                   mesh.points.col(triangle(2))) /
                                      3 -
                                  x;
      for (double share = 0x1p-52; share < 0x1p-36; share *= 2) {
        const Eigen::Vector3d inside = x + share * way;
        if (!mesh.surface.contains(inside))
          continue;
        mesh.points.col(site) = inside;
        break;
      }
    }
}

} // namespace

Mesh rotated(Mesh mesh, const Rotation& rotation) {
  require(
      mesh.surface.is_sphere(),
      "the mesh is one of a plane, but a rotation moves points of the sphere; give a mesh of the "
      "sphere");
  if (rotation.is_identity())
    return mesh;
  mesh.points = rotation(mesh.points);
  if (mesh.surface.is_bounded()) {
    Surface::Rings rings = mesh.surface.rings();
    for (DoubleMatrix& ring : rings)
      ring = rotation(Points3(ring));
    mesh.surface = Surface::sphere().within(std::move(rings));
    keep_inside(mesh);
  }
  return mesh;
}

} // namespace calotte
