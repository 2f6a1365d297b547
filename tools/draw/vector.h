// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/painting.h"

#include <cairo.h>

namespace calotte::tools {

/// The shapes that are at least partly on the map; some outside the window may be counted.
std::int64_t visible_shapes(const Painting& painting, const MapWindow& window);

/// The window's outline as a path around the origin: the limb, a rectangle, or a square without
/// what is beyond the limb.
void add_border(cairo_t* context, const MapWindow& window, double width);

/// A window of the map in paths, of that width, around the origin; the current transformation must
/// be the identity except for a translation.
void vector_map(cairo_t* context, const Painting& painting, const MapWindow& window, double width);

/// A flat scene in paths, at that number of pixels per unit, around the origin, within the clip
/// path.
void flat_map(cairo_t* context, const Painting& painting, double scale);

inline constexpr int graticule_step = 30; ///< degrees, on a whole map

/// Lines on the earth through unit directions, joined by arcs of great circles.
using EarthLines = std::vector<std::vector<Eigen::Vector3d>>;

/// A line between light ones.
struct Stroke {
  double width = 1;           ///< pixels
  double dark = 1, light = 1; ///< the alpha of the line and of those beside it
  Rgb colour = {};
};

/// Draws lines, clipped to a window of the map.
/// \param frame from points on the earth to directions of the scene.
/// \param width of the window in pixels.
void draw_lines(cairo_t* context, const EarthLines& lines, const Eigen::Matrix3d& frame,
                const MapWindow& window, double width, const Stroke& stroke);

/// Faint meridians and parallels of a whole map, parameters as above.
/// \param line their width in pixels.
void draw_graticule(cairo_t* context, const Eigen::Matrix3d& frame, const MapWindow& window,
                    double width, double line);

/// The coastlines of the earth, finer on an enlarged map (see fine_coast()); parameters as above.
void draw_coastlines(cairo_t* context, const Eigen::Matrix3d& frame, const MapWindow& window,
                     double width, double line);

} // namespace calotte::tools
