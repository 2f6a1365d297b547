// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/painting.h"

#include <cairo.h>

namespace calotte::tools {

/// The shapes that are at least partly on the map.
std::int64_t visible_shapes(const Painting& painting, Projection projection);

/// The map's outline as a path around the origin: the limb, or a rectangle.
void add_border(cairo_t* context, Projection projection, double width);

/// The map in paths, of that width, around the origin; the current transformation must be the
/// identity except for a translation.
void vector_map(cairo_t* context, const Painting& painting, Projection projection, double width);

/// A flat scene in paths, at that number of pixels per unit, around the origin, within the clip
/// path.
void flat_map(cairo_t* context, const Painting& painting, double scale);

inline constexpr int graticule_step = 30; ///< degrees

/// Faint meridians and parallels.
/// \param frame from places on the earth to directions of the scene.
/// \param line their width in pixels.
void draw_graticule(cairo_t* context, const Eigen::Matrix3d& frame, Projection projection,
                    double width, double line);

/// The coastlines of the earth, parameters as above.
void draw_coastlines(cairo_t* context, const Eigen::Matrix3d& frame, Projection projection,
                     double width, double line);

} // namespace calotte::tools
