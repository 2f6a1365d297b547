// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/netcdf_fields.h"
#include "io/mpas/room.h"

#include <calotte/voronoi.h>

#include <cstdint>
#include <span>
#include <string>

/// One table of the variables that describe a mesh in MPAS files. Writer, reader, check, cut and
/// cull take from it what a variable is called, its dimensions, what its numbers are, and the rule
/// that they keep.
namespace calotte::io_detail {

/// Names of variables that code treats each in its own way.
namespace mpas {
inline constexpr const char* n_edges_on_cell = "nEdgesOnCell";
inline constexpr const char* edges_on_cell = "edgesOnCell";
inline constexpr const char* vertices_on_cell = "verticesOnCell";
inline constexpr const char* cells_on_cell = "cellsOnCell";
inline constexpr const char* cells_on_edge = "cellsOnEdge";
inline constexpr const char* vertices_on_edge = "verticesOnEdge";
inline constexpr const char* cells_on_vertex = "cellsOnVertex";
inline constexpr const char* edges_on_vertex = "edgesOnVertex";
inline constexpr const char* boundary_vertex = "boundaryVertex";
inline constexpr const char* n_edges_on_edge = "nEdgesOnEdge";
inline constexpr const char* edges_on_edge = "edgesOnEdge";
inline constexpr const char* weights_on_edge = "weightsOnEdge";
inline constexpr const char* dc_edge = "dcEdge";
inline constexpr const char* dv_edge = "dvEdge";
inline constexpr const char* angle_edge = "angleEdge";
inline constexpr const char* area_cell = "areaCell";
inline constexpr const char* area_triangle = "areaTriangle";
inline constexpr const char* kite_areas_on_vertex = "kiteAreasOnVertex";
inline constexpr const char* mesh_density = "meshDensity";
inline constexpr const char* nominal_min_dc = "nominalMinDc";
inline constexpr const char* grid_spacing = "gridSpacing";
inline constexpr const char* triangle_angle_quality = "triangleAngleQuality";
inline constexpr const char* obtuse_triangle = "obtuseTriangle";
} // namespace mpas

/// The dimensions of these variables.
enum class MpasDimension { none, cells, edges, vertices, max_edges, max_edges2, two, degree };

/// "nCells" and so on.
const char* name_of(MpasDimension dimension);

/// One of the three kinds of places.
struct MpasKind {
  MpasDimension rows;
  std::string name;  ///< ends the names of its variables
  std::string word;  ///< for one of it
  std::string place; ///< where it is
  std::string rule;  ///< what its coordinates are

  std::string dimension() const { return name_of(rows); }
  std::string axis(int k) const { return std::string(1, "xyz"[k]) + name; }
  std::string latitude() const { return "lat" + name; }
  std::string longitude() const { return "lon" + name; }
  std::string numbers() const { return "indexTo" + name + "ID"; }
};
inline const MpasKind mpas_cell{MpasDimension::cells, "Cell", "cell", "the cells' generators",
                                "in the plane, or on the sphere of sphere_radius"};
inline const MpasKind mpas_edge{MpasDimension::edges, "Edge", "edge",
                                "the edges, where those between cells and vertices cross",
                                "the middle between the cells of each edge"};
inline const MpasKind mpas_vertex{MpasDimension::vertices, "Vertex", "vertex", "the vertices",
                                  "the circumcentre of the cells around each vertex"};

/// What the numbers of a variable are. Ids count from 1, and 0 is none.
enum class MpasNumbers {
  plain,        ///< they stay as they are
  length,       ///< times the radius of the sphere
  area,         ///< times its square
  per_length,   ///< over the radius
  per_area,     ///< over its square
  cells,        ///< ids
  edges,        ///< ids
  vertices,     ///< ids
  own,          ///< of the rows, from 1 on
  angle,        ///< of an edge's normal, radians
  normal,       ///< a vector along an edge's normal
  lists_of_ids, ///< that models make, in a way of their own
};

/// A row of the table. A variable without dimensions is one number.
struct MpasVariable {
  std::string name;
  MpasDimension rows = MpasDimension::none, columns = MpasDimension::none;
  bool integer = false;
  MpasNumbers numbers = MpasNumbers::plain;
  std::string units = "1", long_name = {}, standard_name = {};
  std::string rule = {}; ///< what the values are, where check compares each with another
  /// The values of rows begin to end - 1 of a variable of one column, of the unit sphere. Writer
  /// and check compute them by this function; null for variables that have code of their own.
  void (*values)(const Voronoi&, std::int64_t begin, std::int64_t end, double* out) = nullptr;
  /// Models add it to meshes; it is neither written nor checked, and may be read as a field.
  bool of_models = false;
};

/// In the order of a file, as far as there is one.
std::span<const MpasVariable> mpas_variables();
/// \pre the table has it.
const MpasVariable& mpas_variable(const std::string& name);

/// The power of the radius in a variable's values.
int radius_power(const MpasVariable& variable);
/// What the values of the unit sphere are multiplied by: the radius to that power.
double radius_factor(const MpasVariable& variable, double radius);

/// The dimensions, and the variables that describe a mesh.
const NetcdfMeshNames& mpas_names();

} // namespace calotte::io_detail
