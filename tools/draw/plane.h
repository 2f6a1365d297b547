// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "draw/painting.h"

#include <calotte/surface.h>
#include <calotte/voronoi.h>

#include <string>
#include <vector>

/// Pictures of meshes of the plane.
namespace calotte::tools {

/// Whether the plane is periodic in a direction, and the mesh has a boundary.
inline bool has_walls(const Mesh& mesh) {
  return mesh.surface.period().maxCoeff() > 0 && !mesh.closed();
}

/// The visible part of the plane.
struct Window {
  Eigen::Vector2d low, high;

  Eigen::Vector2d middle() const { return low + (high - low) / 2; }
  Eigen::Vector2d extent() const { return high - low; }
  double half() const { return extent().maxCoeff() / 2; } ///< the unit of the scene
};

/// The period in a direction that has one. Otherwise the extent of the cells, of the mesh's part of
/// the plane, or of its sites, with a margin.
/// \param cells of the mesh, or null.
Window window_of(const Mesh& mesh, const Polygons* cells = nullptr);

/// What a picture of a mesh of the plane shows. Its cells are those of the options, those of a box,
/// or else those of the whole plane, cut off at the mesh's part of it or at the triangles' hull.
struct PlaneMap {
  /// \throws Error invalid_argument for a density or field that does not fit, and for the area or
  ///         quality of cells that the window cuts off.
  PlaneMap(const Mesh& mesh, const DrawOptions& options);
  PlaneMap(const PlaneMap&) = delete; // the scene refers to `cells`
  PlaneMap& operator=(const PlaneMap&) = delete;

  const Polygons* given; ///< the options' cells; null for a box, which has its own
  Window window;
  Surface part;                ///< what clips the cells; a plane without an end where nothing does
  Polygons cells;              ///< in the scene's unit
  std::vector<double> spacing; ///< by site: mean distance to the neighbours, in the mesh's unit
  Painting painting;           ///< its values are in the mesh's unit
};

/// The picture of a mesh of the plane. \pre the path and the options are checked.
void draw_plane(const std::string& path, const Mesh& mesh, const DrawOptions& options);

} // namespace calotte::tools
