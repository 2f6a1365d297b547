// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/types.h>

#include <optional>
#include <string>

namespace calotte::tools {

/// What a picture shows of a mesh.
enum class Shapes {
  triangles, ///< the Delaunay triangles
  cells,     ///< the Voronoi cells; those that an open boundary leaves unbounded are left out
};

/// By what its shapes are coloured.
enum class Colouring {
  spacing, ///< mean distance of a site to its neighbours, or mean side of a triangle; radians
  angle,   ///< smallest angle of a triangle, or of those around a site; radians
  valence, ///< number of a site's neighbours; a triangle has that of its corner furthest from 6
  none,
};

/// A point of the globe, degrees.
struct LonLat {
  double longitude = 0;
  double latitude = 0;
};

struct DrawOptions {
  /// The middle of the globe; by default 15 E 25 N, or the middle of an open mesh.
  std::optional<LonLat> view = {};
  int size = 1200; ///< width in pixels; in points for SVG and PDF. 64 to 16384
  Shapes shapes = Shapes::triangles;
  Colouring colouring = Colouring::spacing;
};

/// Draws a mesh of the sphere as an orthographic globe with a title and a legend. The points may
/// have any norm. The file is written beside its place and renamed when whole.
/// \throws Error bad_option, file.
void draw(const std::string& path, const Mesh& mesh, const DrawOptions& options = {});

} // namespace calotte::tools
