// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/quality.h>
#include <calotte/surface.h>

#include <functional>
#include <numbers>
#include <optional>
#include <string>

namespace calotte::tools {

enum class Projection {
  globe,        ///< orthographic: one half of the sphere, from far away
  plate_carree, ///< the whole sphere: longitude to the right, latitude up, in the same unit
};

/// The shapes that a picture shows.
enum class Shapes {
  triangles, ///< the Delaunay triangles
  cells,     ///< the Voronoi cells; cells without bound at an open boundary are omitted,
             ///< unless DrawOptions::cells gives their shapes
  both,      ///< the cells, with the triangles' edges on top
  points,    ///< the sites, each a dot in the colour of its cell, or black; as in a stippling
};

/// The quantity that colours the shapes. Cells have the values of their sites; triangles their own,
/// or for density and field the mean of their corners.
enum class Colouring {
  spacing, ///< mean distance of a site to its neighbours, or mean side of a triangle; radians
  angle,   ///< smallest angle of a triangle, or of those around a site; radians
  valence, ///< number of a site's neighbours; a triangle has that of its corner furthest from 6
  area,    ///< over the mean; of cells of closed meshes only
  quality, ///< shortest over longest side of a cell, closed meshes only; Quality::triangle_quality
  density, ///< DrawOptions::density, divided by its maximum over the sites
  field,   ///< DrawOptions::field
  region,  ///< DrawOptions::field as bdyMaskCell: inside, relaxation, specified zone
  none,
};

inline constexpr double radians_per_degree = std::numbers::pi / 180;

/// A point of the globe, degrees.
struct LonLat {
  double longitude = 0;
  double latitude = 0;
};

inline constexpr double most_zoom = 2000;

/// The colours of a colour bar; see palette_colour().
enum class Palette { viridis, cividis, magma, diverging };

/// The ends of a colour bar, low < high, in the unit that its legend has.
struct ColourRange {
  double low = 0, high = 1;
};

/// The style of a picture of the sphere.
/// How colours follow values.
enum class ScaleKind {
  automatic, ///< by the quantity and its range, see make_scale()
  linear,
  logarithmic
};

struct Look {
  Projection projection = Projection::globe;
  /// Centre of the view of the globe, default 15 E 25 N or the middle of an open mesh; for plate
  /// carree the central longitude, default 0, and, where enlarged, the latitude.
  std::optional<LonLat> view = {};
  /// Enlargement of the map, 1 (all of it) to most_zoom. Default: 1, or for an open mesh that
  /// covers a small part of the map as much as lets it fill the picture.
  std::optional<double> zoom = {};
  Surface region = {}; ///< whose boundary is drawn; the whole sphere for none
  /// Faint meridians and parallels, labelled. An enlarged globe has them wherever they are bent.
  bool graticule = false;
  bool coastlines = true; ///< of the earth
  int size = 1200;        ///< width in pixels; in points for SVG and PDF. 64 to 16384
  Palette palette = Palette::viridis;
  std::optional<ColourRange> range = {};  ///< of the colour bar; by default that of the values
  ScaleKind scale = ScaleKind::automatic; ///< of the colour bar
  std::string title = {};                 ///< in place of the usual one
};

struct DrawOptions {
  Look look = {};
  Shapes shapes = Shapes::triangles;
  Colouring colouring = Colouring::spacing;
  Density density = {};
  CellField field = {};        ///< by site
  std::string field_name = {}; ///< for the legend
  std::string name = {};       ///< of the mesh, such as its file's, for the title
  Unit unit = unit_of({}, {}); ///< of lengths and areas of the sphere
  /// The cells of an open mesh, one for each site, if known: also those at the boundary are drawn.
  const Polygons* cells = nullptr;
};

/// Draws a mesh with a legend and a title: name, number of cells, range of spacing. The file is
/// written beside its path and renamed when whole.
///
/// On the sphere the points may have any norm. In the plane, of the look, only size, palette, range
/// and title have an effect. The rings of the mesh's surface clip the cells, or otherwise the
/// triangles' hull does. Triangles are not clipped, but those with their
/// circumcentre outside the surface are left out. Of a periodic direction one period is drawn.
/// \throws Error invalid_argument, also for cells' area or quality of an open mesh, and for a
///         density or field that does not fit; file.
void draw(const std::string& path, const Mesh& mesh, const DrawOptions& options = {});

/// Draws cells that need not be Voronoi cells, coloured by area (the default in place of spacing),
/// valence (the number of their sides), a field, or not at all.
/// \throws Error invalid_argument, also for triangles and for other colourings; file.
void draw(const std::string& path, const Polygons& polygons, const DrawOptions& options = {});

/// A scalar field on the whole sphere.
struct SphereField {
  /// At each of n unit columns; finite.
  std::function<DoubleVector(const Points3& x)> values;
  std::string title, caption;
};

/// Draws a field, each pixel evaluated, with its title and a colour bar.
/// \throws Error invalid_argument, file, and what `values` throws.
void draw(const std::string& path, const SphereField& field, const Look& look = {});

} // namespace calotte::tools
