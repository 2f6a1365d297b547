// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/view.h"

#include "draw/shapes.h"

#include <optional>

namespace calotte::tools {

namespace {

constexpr double margin = 1.07;    ///< of the picture, over the mesh
constexpr double least_zoom = 1.5; ///< a mesh that would be enlarged less is drawn on a whole map

LonLat lonlat_or_pole(const Vector3d& p) {
  const LonLat point = lonlat_of(p);
  constexpr double polar = 89.5; // any longitude is as good there
  return std::abs(point.latitude) < polar ? point : LonLat{0, std::copysign(90, point.latitude)};
}

/// The bounds of points on the map with this middle; none if the map does not show them all.
template <class Map> std::optional<Bounds> bounds_of(const Points3& points, const LonLat& middle) {
  const Eigen::Matrix3d frame = frame_of(middle);
  Bounds bounds = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vector3d p = frame * direction_of(Vector3d(points.col(i)));
    if (!Map::shows(p)) {
      return std::nullopt;
    }
    const MapPoint point = Map::project(p);
    bounds = {std::min(bounds.left, point.u), std::max(bounds.right, point.u),
              std::min(bounds.bottom, point.v), std::max(bounds.top, point.v)};
  }
  return bounds;
}

/// The direction on the earth of the middle of the points' bounds.
template <class Map> Vector3d centre_of(const Bounds& bounds, const LonLat& middle) {
  Vector3d p;
  Map::direction({(bounds.left + bounds.right) / 2, (bounds.bottom + bounds.top) / 2}, p);
  return frame_of(middle).transpose() * p;
}

/// The centre of the view given, or else of the map's bounds of the points. An orthographic map
/// changes with its middle, so that the second takes a few steps.
template <class Map>
LonLat centre_around(const Look& look, const LonLat& start, const Points3& points) {
  LonLat centre = look.view.value_or(start);
  constexpr int steps = 6;
  for (int step = 0; step < steps && !look.view; ++step) {
    const LonLat middle = Map::period > 0 ? LonLat{centre.longitude, 0} : centre;
    if (const std::optional<Bounds> bounds = bounds_of<Map>(points, middle)) {
      centre = lonlat_or_pole(centre_of<Map>(*bounds, middle));
    }
  }
  return centre;
}

template <class Map> View centred(const Look& look, const LonLat& centre, double zoom) {
  if (Map::period == 0) {
    return {centre, {look.projection, zoom, 0}};
  }
  const double most = Map::half_height * (1 - 1 / zoom);
  return {{centre.longitude, 0},
          {look.projection, zoom, std::clamp(centre.latitude * radians_per_degree, -most, most)}};
}

/// How far a map whose window has that centre can be enlarged; 0 if it does not show all points.
template <class Map> double zoom_around(const View& view, double latitude, const Points3& points) {
  const std::optional<Bounds> bounds = bounds_of<Map>(points, view.middle);
  if (!bounds) {
    return 0;
  }
  const double v = Map::period > 0 ? latitude * radians_per_degree : 0;
  const double width = std::max(-bounds->left, bounds->right);
  const double height = std::max(v - bounds->bottom, bounds->top - v);
  const double zoom =
      std::min(Map::half_width / (margin * width), Map::half_height / (margin * height));
  return std::min(zoom, most_zoom);
}

} // namespace

View view_of(const Look& look, const LonLat& middle) {
  const bool flat = look.projection == Projection::plate_carree;
  const LonLat view = look.view.value_or(flat ? LonLat{} : middle);
  return with_map(look.projection,
                  [&]<class Map>() { return centred<Map>(look, view, look.zoom.value_or(1)); });
}

View view_around(const Look& look, const LonLat& middle, const Points3& points) {
  return with_map(look.projection, [&]<class Map>() {
    const LonLat centre = centre_around<Map>(look, middle, points);
    const double fitting = zoom_around<Map>(centred<Map>(look, centre, 1), centre.latitude, points);
    const double zoom = look.zoom.value_or(fitting < least_zoom ? 1 : fitting);
    return zoom == 1 ? view_of(look, middle) : centred<Map>(look, centre, zoom);
  });
}

} // namespace calotte::tools
