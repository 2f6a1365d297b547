// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/painting.h"

#include <cairo.h>

#include <vector>

namespace calotte::tools {

/// A marker for each site that has neither 6 neighbours nor a boundary.
/// \param valences by site, as site_valences().
/// \param widths of the sites' cells, in the unit of the scene.
std::vector<Marker> markers_of(const Scene& scene, const std::vector<double>& valences,
                               const std::vector<float>& widths);

/// A dot for each site, black for Colouring::none. All have one size, so that their number tells
/// how dense the sites are: four fifths of the width of narrow cells, at least a pixel wide.
/// \param width of the window, around the origin; \param most_radius of few sites, pixels.
void draw_points(cairo_t* context, const Painting& painting, const MapWindow& window, double width,
                 double most_radius);

/// The same in a plane, at that number of pixels per unit, within the clip path.
void draw_flat_points(cairo_t* context, const Painting& painting, double scale, double most_radius);

/// Dots of one size, in the colours of their valences, where cells are smaller than a dot. Many
/// dots are smaller than few, so that they cover at most a fifth of the map; below a radius of one
/// pixel none is drawn. \param width of the window, around the origin; \param radius of few dots,
/// pixels.
void draw_markers(cairo_t* context, const Painting& painting, const MapWindow& window, double width,
                  double radius);

/// The same in a plane, at that number of pixels per unit, within the clip path.
/// \param area of the map, pixels squared.
void draw_flat_markers(cairo_t* context, const Painting& painting, double scale, double area,
                       double radius);

} // namespace calotte::tools
