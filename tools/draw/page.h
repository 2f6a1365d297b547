// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/legend.h"
#include "draw/projection.h"
#include "draw/raster.h"

#include <cairo.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

namespace calotte::tools {

/// The layout of a picture of the sphere or of a plane, in pixels: a title, the map, a legend, from
/// top to bottom.
struct Page {
  int width = 0, height = 0;
  double text = 0; ///< size of the letters
  MapSize map;
  double middle_x = 0, middle_y = 0; ///< of the map, whole pixels
  double legend_top = 0;
  bool labelled = false; ///< true if there is space for degrees at the map's edge
};

/// \param window not used of plate carree.
Page page_of(const Look& look, bool with_legend, const MapWindow& window = {});

/// The point on the left half of a globe's rim, the unit circle, where a parallel meets it; none if
/// the parallel lies on one side of the globe.
/// \param latitude of the parallel, degrees.
std::optional<MapPoint> rim_point(const LonLat& view, double latitude);

/// For a plane.
/// \param aspect the map's height over its width.
Page page_of_plane(int size, double aspect, bool with_legend);

/// The radius of one of few dots that mark cells too small to see, pixels.
inline double marker_radius(const Page& page) { return std::max(2.0, 0.2 * page.text); }

/// The radius of the dots of a few sites, pixels.
inline double point_radius(const Page& page) { return 1.5 * marker_radius(page); }

/// The texts around the map.
struct Surroundings {
  Look look;
  Eigen::Matrix3d frame; ///< from points on the earth to directions of the scene
  std::string title;
  Legend legend;    ///< no value for Colouring::none
  MapWindow window; ///< of the look's map
};

/// Draws the page. paint() draws the map around the origin, in pixels.
void draw_page(cairo_t* context, const Page& page, const std::string& title, const Legend& legend,
               const std::function<void()>& paint);

/// The same with the labels around a map of the sphere.
void draw_page(cairo_t* context, const Page& page, const Surroundings& surroundings,
               const std::function<void()>& paint);

/// Draws an image of the map, of a size that is a multiple of the page's, around the origin. The
/// image is destroyed.
void paint_image(cairo_t* context, const MapSize& map, cairo_surface_t* image);

} // namespace calotte::tools
