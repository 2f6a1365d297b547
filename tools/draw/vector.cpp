// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/vector.h"

#include "draw/coastlines.h"
#include "draw/fine_coast.h"
#include "draw/projection.h"
#include "draw/text.h"

#include <calotte/widths.h>

namespace calotte::tools {

namespace {

constexpr double tolerance = 0.1; ///< maximum distance in pixels of a chord from its arc

/// A line on a map, continuous across the seam: points beyond the seam represent those a period
/// away.
using MapPath = std::vector<MapPoint>;

/// Of the points that represent a direction, the one nearest to another. A pole, and a direction
/// that rounding cannot distinguish from it, has all longitudes.
template <class Map> MapPoint point_near(const Vector3d& p, const MapPoint& other) {
  MapPoint point = Map::project(p);
  if constexpr (Map::period != 0) {
    const bool pole = std::hypot(p.x(), p.z()) < 1e-9;
    point.u = pole ? other.u : other.u + std::remainder(point.u - other.u, Map::period);
  }
  return point;
}

/// Adds the great-circle arc from a, whose point ends the path, to b.
template <class Map>
void add_arc(MapPath& path, const Vector3d& a, const Vector3d& b, double scale, int depth = 0) {
  const MapPoint from = path.back();
  const Vector3d sum = a + b;
  if (sum.norm() < 1e-9) {
    return;
  }
  const Vector3d middle = sum.normalized();
  const MapPoint halfway = point_near<Map>(middle, from);
  const MapPoint to = point_near<Map>(b, halfway);
  const double off = std::hypot((from.u + to.u) / 2 - halfway.u, (from.v + to.v) / 2 - halfway.v);
  const bool straight = (a - b).squaredNorm() < 0.02 && off * scale < tolerance;
  if (straight || depth == 12) {
    if (Map::period != 0 && std::hypot(a.x(), a.z()) < 1e-9) {
      path.push_back({to.u, from.v}); // along the pole
    }
    path.push_back(to);
    return;
  }
  add_arc<Map>(path, a, middle, scale, depth + 1);
  add_arc<Map>(path, middle, b, scale, depth + 1);
}

/// Around a polygon, back to its first corner or to a point a period away.
template <class Map> MapPath path_around(const std::vector<Vector3d>& polygon, double scale) {
  MapPath path;
  if (!polygon.empty()) {
    path.push_back(Map::project(polygon.front()));
  }
  if constexpr (std::is_same_v<Map, Flat>) {
    for (std::size_t i = 1; i < polygon.size(); ++i) {
      path.push_back(Map::project(polygon[i]));
    }
    return path;
  }
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    add_arc<Map>(path, polygon[i], polygon[(i + 1) % polygon.size()], scale);
  }
  return path;
}

/// The winding number of the line around the map: 1 counter-clockwise around the north pole.
template <class Map> int turns_of(const MapPath& path) {
  return Map::period == 0 || path.empty()
             ? 0
             : static_cast<int>(std::lround((path.back().u - path.front().u) / Map::period));
}

void add_path(cairo_t* context, const MapPath& path, double scale, double shift) {
  cairo_new_sub_path(context);
  for (const MapPoint& point : path) {
    cairo_line_to(context, scale * (point.u + shift), -scale * point.v);
  }
}

/// Adds the line once for each time that the map shows it.
template <class Map>
void add_copies(cairo_t* context, const MapPath& path, double scale, bool close) {
  const auto by_u = [](const MapPoint& a, const MapPoint& b) { return a.u < b.u; };
  const auto [left, right] = std::minmax_element(path.begin(), path.end(), by_u);
  for (const double shift : {-Map::period, 0.0, Map::period}) {
    if (path.empty() || (Map::period == 0 && shift != 0) || left->u + shift > Map::half_width ||
        right->u + shift < -Map::half_width) {
      continue;
    }
    add_path(context, path, scale, shift);
    if (close) {
      cairo_close_path(context);
    }
    if (Map::period == 0) {
      return;
    }
  }
}

/// The interior of a polygon: around a pole, the area between its outline and the map's edge.
template <class Map>
void add_inside(cairo_t* context, const std::vector<Vector3d>& polygon, double scale) {
  MapPath path = path_around<Map>(Map::clipped(polygon), scale);
  if (const int turns = turns_of<Map>(path); turns != 0) {
    const double pole = turns > 0 ? Map::half_height : -Map::half_height;
    path.push_back({path.back().u, pole});
    path.push_back({path.front().u, pole});
  }
  add_copies<Map>(context, path, scale, true);
}

template <class Map>
void add_outline(cairo_t* context, const std::vector<Vector3d>& polygon, double scale) {
  const MapPath path = path_around<Map>(Map::clipped(polygon), scale);
  add_copies<Map>(context, path, scale, turns_of<Map>(path) == 0);
}

template <class Map>
void fill_layer(cairo_t* context, const Painting& painting, const Layer& layer,
                const MapWindow& window, double scale) {
  for_each_visible<Map>(painting, layer, window,
                        [&](std::size_t shape, const std::vector<Vector3d>& corners) {
                          set_colour(context, painting.scale.colour(painting.values[shape]));
                          add_inside<Map>(context, corners, scale);
                          cairo_fill_preserve(context);
                          // closes the seams that antialiasing leaves between fills
                          cairo_set_line_width(context, 0.4);
                          cairo_stroke(context);
                        });
}

template <class Map>
void stroke_layer(cairo_t* context, const Painting& painting, const Layer& layer,
                  const MapWindow& window, double scale) {
  for_each_visible<Map>(painting, layer, window,
                        [&](std::size_t shape, const std::vector<Vector3d>& corners) {
                          const Line line = layer.line(shape, scale, Map::height(corners));
                          if (line.alpha > 0) {
                            add_outline<Map>(context, corners, scale);
                            // Two shapes draw a shared side, each with half of the opacity.
                            cairo_set_source_rgba(context, line.colour.r, line.colour.g,
                                                  line.colour.b, 1 - std::sqrt(1 - line.alpha));
                            cairo_set_line_width(context, line.width);
                            cairo_stroke(context);
                          }
                        });
}

template <class Map>
void draw_layers(cairo_t* context, const Painting& painting, const MapWindow& window,
                 double scale) {
  for (const Layer& layer : layers_of(painting)) {
    if (layer.filled) {
      fill_layer<Map>(context, painting, layer, window, scale);
    }
    stroke_layer<Map>(context, painting, layer, window, scale);
  }
}

template <class Map> std::int64_t count_visible(const Painting& painting, const MapWindow& window) {
  std::int64_t count = 0;
  for (const Layer& layer : layers_of(painting)) {
    for_each_visible<Map>(painting, layer, window,
                          [&](std::size_t, const std::vector<Vector3d>&) { ++count; });
  }
  return count;
}

// ---- Lines on the earth

/// Adds the line through directions of the scene, in its visible part.
template <class Map>
void add_line(cairo_t* context, const std::vector<Vector3d>& line, double scale) {
  MapPath path;
  const auto flush = [&] {
    add_copies<Map>(context, path, scale, false);
    path.clear();
  };
  Vector3d before = Vector3d::Zero();
  for (const Vector3d& p : line) {
    const bool first = &p == &line.front();
    if (Map::shows(p)) {
      if (path.empty()) {
        before = first ? p : limb_between(before, p);
        path.push_back(Map::project(before));
      }
      add_arc<Map>(path, before, p, scale);
    } else if (!path.empty()) {
      add_arc<Map>(path, before, limb_between(before, p), scale);
      flush();
    }
    before = p;
  }
  flush();
}

/// Adds lines in a window of the map. Arcs that are known to be outside are left out.
void add_lines(cairo_t* context, const EarthLines& lines, const Eigen::Matrix3d& frame,
               const MapWindow& window, double width) {
  with_map(window.projection, [&]<class Map>() {
    const double scale = window.scale<Map>(width);
    cairo_translate(context, 0, scale * window.middle);
    std::vector<Vector3d> seen;
    const auto flush = [&] {
      add_line<Map>(context, seen, scale);
      seen.clear();
    };
    for (const std::vector<Vector3d>& line : lines) {
      for (const Vector3d& point : line) {
        const Vector3d p = frame * point;
        if (!seen.empty() && !Map::may_show({seen.back(), p}, window)) {
          flush();
        }
        seen.push_back(p);
      }
      flush();
    }
  });
}

std::vector<Vector3d> directions_of(const std::vector<LonLat>& points) {
  std::vector<Vector3d> line;
  for (const LonLat& point : points) {
    line.push_back(direction_of(point));
  }
  return line;
}

/// A dark line between light ones, visible on any background.
void stroke_outlined(cairo_t* context, const Stroke& stroke) {
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_set_source_rgba(context, 1, 1, 1, stroke.light);
  cairo_set_line_width(context, 2.2 * stroke.width);
  cairo_stroke_preserve(context);
  cairo_set_source_rgba(context, stroke.colour.r, stroke.colour.g, stroke.colour.b, stroke.dark);
  cairo_set_line_width(context, stroke.width);
  cairo_stroke(context);
}

} // namespace

std::int64_t visible_shapes(const Painting& painting, const MapWindow& window) {
  return with_map(window.projection,
                  [&]<class Map>() { return count_visible<Map>(painting, window); });
}

void add_border(cairo_t* context, const MapWindow& window, double width) {
  if (window.projection != Projection::globe) {
    cairo_rectangle(context, -width / 2, -width / 4, width, width / 2);
    return;
  }
  cairo_new_sub_path(context);
  if (window.whole()) {
    cairo_arc(context, 0, 0, width / 2, 0, 2 * std::numbers::pi);
    return;
  }
  const double limb = window.zoom * width / 2;
  if (limb * limb >= width * width / 2) {
    cairo_rectangle(context, -width / 2, -width / 2, width, width);
    return;
  }
  const double side = std::acos(1 / window.zoom); // half of the angle in which a side is seen
  for (int corner = 0; corner < 4; ++corner) {
    const double turn = corner * std::numbers::pi / 2;
    cairo_arc(context, 0, 0, limb, turn + side, turn + std::numbers::pi / 2 - side);
  }
  cairo_close_path(context);
}

void vector_map(cairo_t* context, const Painting& painting, const MapWindow& window, double width) {
  cairo_save(context);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  add_border(context, window, width);
  set_colour(context, globe_colour);
  cairo_fill_preserve(context);
  cairo_clip(context);
  with_map(window.projection, [&]<class Map>() {
    const double scale = window.scale<Map>(width);
    cairo_translate(context, 0, scale * window.middle);
    draw_layers<Map>(context, painting, window, scale);
  });
  cairo_restore(context);
}

void flat_map(cairo_t* context, const Painting& painting, double scale) {
  cairo_save(context);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  draw_layers<Flat>(context, painting, {}, scale);
  cairo_restore(context);
}

EarthLines graticule_lines() {
  EarthLines lines;
  for (int line = -180; line < 180; line += graticule_step) {
    std::vector<LonLat> meridian;
    std::vector<LonLat> parallel;
    for (int at = -180; at <= 180; ++at) {
      meridian.push_back({1.0 * line, at / 2.0 * 0.999}); // short of the poles
      parallel.push_back({1.0 * at, 1.0 * line});
    }
    lines.push_back(directions_of(meridian));
    if (std::abs(line) < 90) {
      lines.push_back(directions_of(parallel));
    }
  }
  return lines;
}

/// \param pixel its width on the Earth, km.
EarthLines fine_coast_lines(double pixel) {
  EarthLines lines;
  for (const Points3& ring : fine_coast(pixel)) {
    std::vector<Vector3d> line(ring.colwise().begin(), ring.colwise().end());
    line.push_back(ring.col(0));
    lines.push_back(std::move(line));
  }
  return lines;
}

EarthLines coast_lines() {
  EarthLines lines;
  for (const std::vector<LonLat>& line : coastlines()) {
    lines.push_back(directions_of(line));
  }
  return lines;
}

void draw_lines(cairo_t* context, const EarthLines& lines, const Eigen::Matrix3d& frame,
                const MapWindow& window, double width, const Stroke& stroke) {
  cairo_save(context);
  add_border(context, window, width);
  cairo_clip(context);
  add_lines(context, lines, frame, window, width);
  stroke_outlined(context, stroke);
  cairo_restore(context);
}

void draw_graticule(cairo_t* context, const Eigen::Matrix3d& frame, const MapWindow& window,
                    double width, double line) {
  draw_lines(context, graticule_lines(), frame, window, width, {line, 0.35, 0.2});
}

void draw_coastlines(cairo_t* context, const Eigen::Matrix3d& frame, const MapWindow& window,
                     double width, double line) {
  const double scale =
      with_map(window.projection, [&]<class Map>() { return window.scale<Map>(width); });
  EarthLines lines;
  if (!window.whole()) {
    lines = fine_coast_lines(earth_radius_km / scale);
  }
  draw_lines(context, lines.empty() ? coast_lines() : lines, frame, window, width,
             {line, 0.8, 0.6});
}

} // namespace calotte::tools
