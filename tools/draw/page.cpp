// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/page.h"

#include "draw/degrees.h"
#include "draw/text.h"
#include "draw/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::tools {

namespace {

constexpr double label_letters = 0.8; ///< of degrees, of the other letters

/// Along the lower and the left edge of a plate carree.
void edge_labels(cairo_t* context, const Page& page, const Eigen::Matrix3d& frame) {
  const double scale = page.map.width / 360.0;
  const double bottom = page.map.height / 2.0;
  select_font(context, label_letters * page.text);
  set_colour(context, text_colour);
  for (int longitude = -180; longitude < 180; longitude += 60) {
    const MapPoint point = PlateCarree::project(frame * direction_of(LonLat{1.0 * longitude, 0}));
    const double x = point.u / std::numbers::pi * page.map.width / 2;
    centred_text(context, x, bottom + 1.1 * page.text, longitude_label(longitude));
    if (std::abs(x) > 179.5 * scale) { // at the seam it appears at both ends
      centred_text(context, -x, bottom + 1.1 * page.text, longitude_label(longitude));
    }
  }
  for (int latitude = -90; latitude <= 90; latitude += 30) {
    const std::string label = latitude_label(latitude);
    cairo_move_to(context, -180 * scale - 0.4 * page.text - text_width(context, label),
                  -scale * latitude + 0.28 * page.text);
    cairo_show_text(context, label.c_str());
  }
}

/// Text on a light background that fades out.
void haloed_text(cairo_t* context, double x, double baseline, const std::string& text,
                 double size) {
  cairo_move_to(context, x - text_width(context, text) / 2, baseline);
  cairo_text_path(context, text.c_str());
  cairo_set_source_rgba(context, 1, 1, 1, 0.75);
  cairo_set_line_width(context, 0.25 * size);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  cairo_stroke_preserve(context);
  set_colour(context, text_colour);
  cairo_fill(context);
}

/// Latitudes outside a globe's rim, where the parallels meet it.
void rim_labels(cairo_t* context, const Page& page, const LonLat& view) {
  const double radius = page.map.width / 2.0;
  const double size = label_letters * page.text;
  set_colour(context, text_colour);
  for (int latitude = -60; latitude <= 60; latitude += graticule_step) {
    if (const std::optional<MapPoint> point = rim_point(view, latitude)) {
      const double x = (radius + 0.4 * size) * point->u;
      const double y = -(radius + 0.4 * size) * point->v;
      marked_text(context, x, y + 0.36 * size * (1 - point->v), latitude_label(latitude),
                  0.5 - 0.5 * point->u);
    }
  }
}

/// On a globe longitudes stand along one of three parallels near the equator; latitudes at the rim,
/// or, of a parallel around the pole that does not meet it, between two meridians.
void globe_labels(cairo_t* context, const Page& page, const Look& look,
                  const Eigen::Matrix3d& frame) {
  const double radius = page.map.width / 2.0;
  const double size = label_letters * page.text;
  const LonLat view = look.view.value_or(LonLat{});
  const auto nearest = [](double degrees) {
    return graticule_step * static_cast<int>(std::lround(degrees / graticule_step));
  };
  const int latitude = std::clamp(nearest(view.latitude), -30, 30); // meridians crowd at 60
  const int longitude = nearest(view.longitude);
  const auto label = [&](int lon, int lat, const std::string& text) {
    const Eigen::Vector3d p = frame * direction_of(LonLat{1.0 * lon, 1.0 * lat});
    if (p.z() > 0.25) {
      haloed_text(context, radius * p.x(), -radius * p.y() + 0.35 * size, text, size);
    }
  };
  select_font(context, size);
  for (int lon = -180; lon < 180; lon += graticule_step) {
    label(lon, latitude, longitude_label(lon));
  }
  for (int lat = -60; lat <= 60; lat += graticule_step) {
    if (!rim_point(view, lat)) {
      label(longitude + graticule_step / 2, lat, latitude_label(lat));
    }
  }
  rim_labels(context, page, view);
}

/// Labels at the edges of an enlarged map, with ticks, and inside it.
void window_labels(cairo_t* context, const Page& page, const MapWindow& window,
                   const std::vector<DegreeLabel>& labels) {
  using At = DegreeLabel::At;
  const double size = label_letters * page.text, tick = 0.25 * page.text;
  const double scale =
      with_map(window.projection, [&]<class Map>() { return window.scale<Map>(page.map.width); });
  select_font(context, size);
  cairo_set_line_width(context, std::max(0.8, 0.05 * page.text));
  for (const DegreeLabel& label : labels) {
    const double x = scale * label.point.u, y = scale * (window.middle - label.point.v);
    if (label.at == At::inside) {
      haloed_text(context, x, y + 0.35 * size, label.text, size);
      continue;
    }
    const int right = label.at == At::right ? 1 : label.at == At::left ? -1 : 0;
    const int down = label.at == At::bottom ? 1 : 0;
    cairo_move_to(context, x, y);
    cairo_line_to(context, x + right * tick, y + down * tick);
    set_colour(context, map_border_colour);
    cairo_stroke(context);
    set_colour(context, text_colour);
    const double gap = 1.4 * tick;
    const double baseline = y + down * gap + (down > 0 ? 0.8 : 0.35) * size;
    marked_text(context, x + right * gap, baseline, label.text, 0.5 - 0.5 * right);
  }
}

void draw_border(cairo_t* context, const Page& page, const MapWindow& window) {
  add_border(context, window, page.map.width);
  set_colour(context, map_border_colour);
  cairo_set_line_width(context, std::max(0.8, 0.05 * page.text));
  cairo_stroke(context);
}

/// The boundary of a region, each ring a closed line.
void draw_region(cairo_t* context, const Page& page, const Surroundings& around) {
  EarthLines lines;
  for (const DoubleMatrix& ring : around.look.region.rings()) {
    std::vector<Eigen::Vector3d> line;
    for (Eigen::Index i = 0; i <= ring.cols(); ++i) {
      line.push_back(direction_of(Eigen::Vector3d(ring.col(i % ring.cols()))));
    }
    lines.push_back(std::move(line));
  }
  constexpr Rgb colour = {0.82, 0.07, 0.38};
  draw_lines(context, lines, around.frame, around.window, page.map.width,
             {std::max(1.2, 0.12 * page.text), 1, 0.8, colour});
}

/// Coastlines, the graticule, the region, the border and its labels.
void draw_surroundings_of_map(cairo_t* context, const Page& page, const Surroundings& around) {
  const bool globe = around.look.projection == Projection::globe;
  const bool whole = around.window.whole(), graticule = around.look.graticule;
  const Degrees degrees = whole ? Degrees() : degrees_of(around.window, around.frame);
  const double line = std::max(0.6, 0.04 * page.text);
  if (around.look.coastlines) {
    draw_coastlines(context, around.frame, around.window, page.map.width,
                    std::max(0.7, 0.055 * page.text));
  }
  if (whole && graticule) {
    draw_graticule(context, around.frame, around.window, page.map.width, line);
  } else if (graticule || (degrees.bent && page.labelled)) {
    draw_lines(context, degrees.lines, around.frame, around.window, page.map.width,
               {line, 0.35, 0.2});
  }
  if (around.look.region.is_bounded()) {
    draw_region(context, page, around);
  }
  draw_border(context, page, around.window);
  if (!page.labelled) {
    return;
  }
  if (!whole) {
    window_labels(context, page, around.window, degrees.labels);
  } else if (!globe) {
    edge_labels(context, page, around.frame);
  } else if (graticule) {
    globe_labels(context, page, around.look, around.frame);
  }
}

/// Puts title, map and legend below each other.
/// \param below the map: labels.
void arrange(Page& page, double below, bool with_legend) {
  const double middle = 2.6 * page.text + page.map.height / 2.0;
  const double bottom = middle + page.map.height / 2.0 + below;
  page.middle_x = std::floor(page.width / 2.0);
  page.middle_y = std::floor(middle);
  page.legend_top = bottom + 1.6 * page.text;
  page.height = static_cast<int>(std::ceil(bottom + (with_legend ? 6.0 : 1.2) * page.text));
}

} // namespace

std::optional<MapPoint> rim_point(const LonLat& view, double latitude) {
  const double up = std::sin(latitude * radians_per_degree),
               most = std::cos(view.latitude * radians_per_degree);
  if (!(std::abs(up) < 0.995 * most)) {
    return std::nullopt;
  }
  return MapPoint{-std::sqrt(1 - up / most * (up / most)), up / most};
}

Page page_of(const Look& look, bool with_legend, const MapWindow& window) {
  const bool disk = look.projection == Projection::globe && window.whole();
  Page page;
  page.width = look.size;
  page.text = std::clamp(look.size / (disk ? 46.0 : 56.0), 7.0, 40.0);
  page.labelled = look.size >= 280;
  const double letters = window.whole() ? 3.2 : 3.8; // "120°W" beside an enlarged map
  const double margin = page.labelled ? letters * page.text : page.text;
  const double part = page.labelled && look.graticule ? 0.435 : 0.465; // latitudes are beside it
  page.map = disk ? map_size(look.projection, 2 * static_cast<int>(part * look.size))
                  : map_size(look.projection, static_cast<int>(look.size - 2 * margin));
  arrange(page, disk || !page.labelled ? 0 : 1.2 * page.text, with_legend);
  return page;
}

Page page_of_plane(int size, double aspect, bool with_legend) {
  constexpr double tallest = 1.4; // of the page's width
  Page page;
  page.width = size;
  page.text = std::clamp(size / 46.0, 7.0, 40.0);
  const double room = 0.93 * size;
  const double width = std::min(room, tallest * room / aspect);
  page.map = {std::max(2, static_cast<int>(width)), std::max(2, static_cast<int>(width * aspect))};
  arrange(page, 0, with_legend);
  return page;
}

void draw_page(cairo_t* context, const Page& page, const std::string& title, const Legend& legend,
               const std::function<void()>& paint) {
  cairo_save(context);
  cairo_translate(context, page.middle_x, page.middle_y);
  paint();
  cairo_restore(context);
  set_colour(context, text_colour);
  fitted_text(context, page.width / 2.0, 1.65 * page.text, title, 1.1 * page.text,
              0.97 * page.width);
  if (legend.scale.colouring != Colouring::none) {
    draw_legend(context, legend, page.width, page.legend_top, page.text);
  }
}

void draw_page(cairo_t* context, const Page& page, const Surroundings& surroundings,
               const std::function<void()>& paint) {
  draw_page(context, page, surroundings.title, surroundings.legend, [&] {
    paint();
    draw_surroundings_of_map(context, page, surroundings);
  });
}

void paint_image(cairo_t* context, const MapSize& map, cairo_surface_t* image) {
  const double scale = static_cast<double>(map.width) / cairo_image_surface_get_width(image);
  cairo_save(context);
  cairo_translate(context, -map.width / 2.0, -map.height / 2.0);
  cairo_scale(context, scale, scale);
  cairo_set_source_surface(context, image, 0, 0);
  cairo_paint(context);
  cairo_restore(context);
  cairo_surface_destroy(image);
}

} // namespace calotte::tools
