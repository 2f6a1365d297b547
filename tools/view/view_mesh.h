// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "view/quantities.h"

#include <calotte/density.h>
#include <calotte/mesh_file.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// A mesh as a page of calotte view shows it.
struct ViewMesh {
  std::string name = {};   ///< of the file
  std::string notice = {}; ///< what the page leaves out, a sentence or more; or ""
  bool on_sphere = true;
  std::optional<double> radius_km = {}; ///< of the sphere
  std::int64_t cells = 0;
  std::int64_t total = 0;   ///< cells of the file's mesh; these are a part of them, see thin()
  std::int64_t planned = 0; ///< of a plan: cells of the grid
  std::optional<Eigen::Vector3d> home = {}; ///< where the page opens; by default by the sites
  /// 3 x p, p >= cells: the sites, unit columns, then other corners of triangles. In a plane z = 0.
  Points3 points = {};
  std::vector<std::int32_t> copied = {}; ///< by point from `cells` on: the site that it copies
  Triangles triangles = {};              ///< 3 x m ids of points; may be none
  /// The shapes of the cells. None: they are the Voronoi cells of the triangles.
  std::optional<Polygons> shapes = {};
  std::vector<std::int32_t> number =
      {}; ///< by cell: its number in the file; empty if that is its own
  std::vector<Quantity> quantities = {};
};

/// What a page shows of a mesh.
struct ViewChoice {
  /// Of a plane; by default filled_surface(), or else a box around the sites.
  std::optional<Surface> surface = {};
  Density density = {};                 ///< otherwise the file's
  std::vector<std::string> fields = {}; ///< names; by default the first ones of the file
  std::optional<double> radius_km = {};
  std::optional<std::string> units = {};
  std::optional<LonLat> view = {};   ///< where the page opens, and a larger mesh is whole
  bool operators = false;            ///< adds the errors of operators
  std::int64_t most_cells = 1000000; ///< larger meshes are thinned
};

/// \throws Error invalid_argument for a field that the file does not have at cells or triangles,
///         and for a domain of another period; as cell_measures() and voronoi().
ViewMesh view_mesh(const std::string& name, MeshFile file, const ViewChoice& choice);

/// The numbers of one cell, a line each: its location and its quantities.
/// \throws Error invalid_argument if the mesh does not have it.
std::string cell_table(const ViewMesh& mesh, std::int64_t cell);

/// The same as JSON: a quantity by its name, with its unit; null where the cell has no value.
/// \throws Error as cell_table().
std::string cell_report(const ViewMesh& mesh, std::int64_t cell);

/// The site of the smallest cell.
Eigen::Vector3d finest_place(const ViewMesh& mesh);

/// Keeps a part of a mesh: a tenth of `most` around its home, or else its smallest cell; the ten
/// worst cells of each quantity with rows around them; and others, evenly spread. Those around the
/// home and the worst keep their triangles and shapes. The others have none, so that nothing is
/// shown that the mesh does not have.
void thin(ViewMesh& mesh, std::int64_t most);

/// Sets the shapes of the cells of a mesh of the plane, and its triangles, whose corners in a
/// periodic plane are next to each other. \param planar the sites and their triangles.
void set_plane(ViewMesh& mesh, const Mesh& planar, const Polygons& cells);
/// The same for the cells that voronoi() makes.
void set_plane(ViewMesh& mesh, const Mesh& planar);

} // namespace calotte::tools
