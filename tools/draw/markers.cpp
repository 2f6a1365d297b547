// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/markers.h"

#include "draw/projection.h"
#include "draw/text.h"
#include "draw/vector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

namespace calotte::tools {

namespace {

constexpr double few_cover = 0.02, most_cover = 0.2; ///< parts of the map that dots may cover
constexpr double least_radius = 1;                   ///< pixels
constexpr Rgb rim_colour = {0.07, 0.09, 0.13};

void dot(cairo_t* context, const MapPoint& at, double radius, const Rgb& colour) {
  cairo_new_path(context);
  cairo_arc(context, at.u, -at.v, radius, 0, 2 * std::numbers::pi);
  set_colour(context, colour);
  cairo_fill_preserve(context);
  cairo_set_source_rgba(context, rim_colour.r, rim_colour.g, rim_colour.b, 0.6);
  cairo_set_line_width(context, 0.2 * radius);
  cairo_stroke(context);
}

template <class Map>
void draw_dots(cairo_t* context, const Painting& painting, const MapWindow& window, double scale,
               double area, double radius) {
  std::vector<const Marker*> small;
  for (const Marker& marker : painting.markers) {
    if (marker.width * scale < 2 * radius && Map::shows_some({marker.point}) &&
        Map::may_show({marker.point}, window)) {
      small.push_back(&marker);
    }
  }
  const double share = area / (std::numbers::pi * static_cast<double>(small.size()));
  radius = std::min(std::clamp(std::sqrt(few_cover * share), 0.4 * radius, radius),
                    std::sqrt(most_cover * share));
  if (radius < least_radius) {
    return;
  }
  for (const Marker* marker : small) {
    if (marker->width * scale < 2 * radius) {
      const MapPoint point = Map::project(marker->point);
      dot(context, {scale * point.u, scale * point.v}, radius,
          painting.scale.colour(marker->valence));
    }
  }
}

constexpr double least_point = 0.5; ///< radius, pixels
constexpr Rgb black = {0, 0, 0}, no_value_colour = {0.7, 0.7, 0.7};

/// Of the tenth of the cells that are narrowest, the widest.
double narrow_width(std::vector<float> widths) {
  const auto at = widths.begin() + std::ssize(widths) / 10;
  std::nth_element(widths.begin(), at, widths.end());
  return *at;
}

Rgb point_colour(const Painting& painting, std::size_t site) {
  if (painting.scale.colouring == Colouring::none)
    return black;
  const double value = painting.values[site];
  return std::isnan(value) ? no_value_colour : painting.scale.colour(value);
}

/// Whether a dot is at least partly in the window of a plane. \param radius in the scene's unit.
bool may_show_dot(const Scene& scene, const Vector3d& at, double radius) {
  const auto beyond = [&](int k) { return std::abs(at[k]) > scene.reach[k] + radius; };
  return !scene.flat || !(beyond(0) || beyond(1));
}

/// A line without length and with a round cap is a dot, and many are one path: SVG needs a few
/// bytes for each.
template <class Map>
void draw_sites(cairo_t* context, const Painting& painting, const MapWindow& window, double scale,
                double most_radius) {
  const Scene& scene = painting.scene;
  const double radius = std::clamp(0.4 * narrow_width(painting.widths) * scale, least_point,
                                   std::max(least_point, most_radius));
  cairo_new_path(context);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(context, 2 * radius);
  constexpr int most_in_path = 1000;
  std::optional<std::uint32_t> colour;
  int dots = 0;
  const auto stroke = [&] {
    if (dots > 0)
      cairo_stroke(context);
    dots = 0;
  };
  for (std::size_t i = 0; i < painting.widths.size(); ++i) {
    const Rgb own = point_colour(painting, i);
    if (colour != bytes_of(own) || dots >= most_in_path) {
      stroke();
      set_colour(context, own);
      colour = bytes_of(own);
    }
    for (const Vector3d& copy : scene.copies) {
      const Vector3d at = scene.sites.col(static_cast<Eigen::Index>(i)) + copy;
      if (!Map::shows_some({at}) || !Map::may_show({at}, window) ||
          !may_show_dot(scene, at, radius / scale))
        continue;
      const MapPoint point = Map::project(at);
      cairo_move_to(context, scale * point.u, -scale * point.v);
      cairo_line_to(context, scale * point.u, -scale * point.v);
      ++dots;
    }
  }
  stroke();
}

} // namespace

void draw_points(cairo_t* context, const Painting& painting, const MapWindow& window, double width,
                 double most_radius) {
  cairo_save(context);
  add_border(context, window, width);
  cairo_clip(context);
  with_map(window.projection, [&]<class Map>() {
    const double scale = window.scale<Map>(width);
    cairo_translate(context, 0, scale * window.middle);
    draw_sites<Map>(context, painting, window, scale, most_radius);
  });
  cairo_restore(context);
}

void draw_flat_points(cairo_t* context, const Painting& painting, double scale,
                      double most_radius) {
  cairo_save(context);
  draw_sites<Flat>(context, painting, {}, scale, most_radius);
  cairo_restore(context);
}

std::vector<Marker> markers_of(const Scene& scene, const std::vector<double>& valences,
                               const std::vector<float>& widths) {
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < valences.size(); ++i) {
    if (valences[i] > 0 && valences[i] != 6) { // not NaN
      markers.push_back({scene.sites.col(static_cast<Eigen::Index>(i)), valences[i], widths[i]});
    }
  }
  return markers;
}

void draw_markers(cairo_t* context, const Painting& painting, const MapWindow& window, double width,
                  double radius) {
  cairo_save(context);
  add_border(context, window, width);
  cairo_clip(context);
  const bool disk = window.projection == Projection::globe && window.whole();
  const bool square = window.projection == Projection::globe && !disk;
  const double area = width * width * (disk ? std::numbers::pi / 4 : square ? 1 : 0.5);
  with_map(window.projection, [&]<class Map>() {
    const double scale = window.scale<Map>(width);
    cairo_translate(context, 0, scale * window.middle);
    draw_dots<Map>(context, painting, window, scale, area, radius);
  });
  cairo_restore(context);
}

void draw_flat_markers(cairo_t* context, const Painting& painting, double scale, double area,
                       double radius) {
  draw_dots<Flat>(context, painting, {}, scale, area, radius);
}

} // namespace calotte::tools
