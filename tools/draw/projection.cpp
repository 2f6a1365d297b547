// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/projection.h"

namespace calotte::tools {

namespace {

/// Larger than the displacement of a point by rounding.
constexpr double rounding_margin = 1e-9;

double longitude_step(const Vector3d& from, const Vector3d& to) {
  return std::remainder(PlateCarree::project(to).u - PlateCarree::project(from).u,
                        PlateCarree::period);
}

/// True if the pole is in the facet or on its outline, or so near that longitudes are unreliable.
bool holds_pole(const Facet& f, double sign) {
  return std::min({sign * f.a.cross(f.b).y(), sign * f.b.cross(f.c).y(),
                   sign * f.c.cross(f.a).y()}) > -1e-12;
}

} // namespace

Vector3d limb_between(const Vector3d& a, const Vector3d& b) {
  Vector3d crossing = (b.z() * a - a.z() * b) * (b.z() > a.z() ? 1 : -1);
  crossing.z() = 0;
  return crossing.normalized();
}

double Orthographic::height(const std::vector<Vector3d>& corners) {
  double sum = 0;
  for (const Vector3d& p : corners) {
    sum += p.z();
  }
  return sum / static_cast<double>(corners.size());
}

bool Orthographic::may_show(const std::vector<Vector3d>& corners, const MapWindow& window) {
  const double half = window.half_width<Orthographic>();
  const auto beyond = [&](const auto& coordinate) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vector3d& p) { return coordinate(p) > half; });
  };
  return window.whole() || !(beyond([](const Vector3d& p) { return p.x(); }) ||
                             beyond([](const Vector3d& p) { return -p.x(); }) ||
                             beyond([](const Vector3d& p) { return p.y(); }) ||
                             beyond([](const Vector3d& p) { return -p.y(); }));
}

bool Orthographic::direction(const MapPoint& point, Vector3d& p) {
  const double z2 = 1 - point.u * point.u - point.v * point.v;
  p = {point.u, point.v, std::sqrt(std::max(0.0, z2))};
  return z2 > 0;
}

/// The cut runs along the limb.
std::vector<Vector3d> Orthographic::clipped(const std::vector<Vector3d>& polygon) {
  std::vector<Vector3d> result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& a = polygon[i];
    const Vector3d& b = polygon[(i + 1) % polygon.size()];
    if (a.z() >= 0) {
      result.push_back(a);
    }
    if ((a.z() >= 0) != (b.z() >= 0)) {
      result.push_back(limb_between(a, b));
    }
  }
  return result;
}

/// The image of the flat triangle, widened by the bulge of the facet: at most 1 - |p|.
Bounds Orthographic::bounds(const Facet& f) {
  const double bulge = 1 - std::sqrt(std::max(0.0, 1 - f.longest() / 3));
  const auto [left, right] = std::minmax({f.a.x(), f.b.x(), f.c.x()});
  const auto [bottom, top] = std::minmax({f.a.y(), f.b.y(), f.c.y()});
  return {left - bulge, right + bulge, bottom - bulge, top + bulge};
}

/// Longitude is monotone along a great-circle arc, so its extremes are at corners, unless a pole is
/// inside. The sine of latitude is p.y/|p| of the flat triangle's points.
Bounds PlateCarree::bounds(const Facet& f) {
  const double norm = std::sqrt(std::max(0.0, 1 - f.longest() / 3));
  const auto latitude = [norm](double y, bool outwards) {
    return outwards ? std::asin(std::min(1.0, std::abs(y) / std::max(norm, 1e-300)))
                    : std::asin(std::min(1.0, std::abs(y)));
  };
  const auto [least, greatest] = std::minmax({f.a.y(), f.b.y(), f.c.y()});
  Bounds bounds;
  bounds.top = greatest > 0 ? latitude(greatest, true) : -latitude(greatest, false);
  bounds.bottom = least < 0 ? -latitude(least, true) : latitude(least, false);
  const bool north = holds_pole(f, 1);
  const bool south = holds_pole(f, -1);
  if (north || south) {
    return {-half_width, half_width, south ? -half_height : bounds.bottom,
            north ? half_height : bounds.top};
  }
  const double a = project(f.a).u;
  const double b = a + longitude_step(f.a, f.b);
  const double c = b + longitude_step(f.b, f.c);
  const auto [left, right] = std::minmax({a, b, c});
  return {left - rounding_margin, right + rounding_margin, bounds.bottom - rounding_margin,
          bounds.top + rounding_margin};
}

bool PlateCarree::direction(const MapPoint& point, Vector3d& p) {
  const double c = std::cos(point.v);
  p = {c * std::sin(point.u), std::sin(point.v), c * std::cos(point.u)};
  return std::abs(point.v) <= half_height;
}

PlateCarree::Rays::Rays(int columns, int rows, const MapWindow& window) {
  for (int column = 0; column < columns; ++column) {
    const double u = middle_of(column, columns, window.half_width<PlateCarree>());
    columns_.push_back({std::sin(u), std::cos(u)});
  }
  for (int row = 0; row < rows; ++row) {
    const double v = window.middle - middle_of(row, rows, window.half_height<PlateCarree>());
    rows_.push_back({std::sin(v), std::cos(v)});
  }
}

} // namespace calotte::tools
