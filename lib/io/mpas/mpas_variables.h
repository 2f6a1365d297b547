// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/cells/netcdf_fields.h"
#include "io/mpas/room.h"

#include <calotte/voronoi.h>

#include <cstdint>
#include <span>
#include <string>

/// The table of the variables that describe a mesh in MPAS files. Writer, reader, check, cut and
/// cull take from it the name of a variable, its dimensions, the kind of its numbers, and the rule
/// for its values.
namespace calotte::io_detail {

/// Names of variables that code refers to individually.
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

/// The names and texts of the coordinates of cells, edges or vertices.
struct MpasKind {
  MpasDimension rows;
  std::string name;    ///< suffix of the names of its variables
  std::string word;    ///< noun for one of them
  std::string subject; ///< noun in the long names of coordinates
  std::string rule;    ///< rule for the coordinates

  std::string dimension() const { return name_of(rows); }
  std::string axis(int k) const { return std::string(1, "xyz"[k]) + name; }
  std::string latitude() const { return "lat" + name; }
  std::string longitude() const { return "lon" + name; }
  std::string numbers() const { return "indexTo" + name + "ID"; }
  /// Numbers in the file that an ocean was culled from.
  std::string base_numbers() const { return "mapCulledToBase" + name; }
};
inline const MpasKind mpas_cell{MpasDimension::cells, "Cell", "cell", "the cells' generators",
                                "in the plane, or on the sphere of sphere_radius"};
inline const MpasKind mpas_edge{MpasDimension::edges, "Edge", "edge",
                                "the edges, where those between cells and vertices cross",
                                "the middle between the cells of each edge"};
inline const MpasKind mpas_vertex{MpasDimension::vertices, "Vertex", "vertex", "the vertices",
                                  "the circumcentre of the cells around each vertex"};

/// The kind of numbers in a variable. Ids count from 1; 0 is none.
enum class MpasNumbers {
  plain,        ///< independent of the radius
  length,       ///< proportional to the radius of the sphere
  area,         ///< proportional to its square
  per_length,   ///< inversely proportional to the radius
  per_area,     ///< inversely proportional to its square
  cells,        ///< ids
  edges,        ///< ids
  vertices,     ///< ids
  own,          ///< numbers of the rows, from 1 on
  angle,        ///< angle of the normal of an edge, radians
  normal,       ///< vector along the normal of an edge
  lists_of_ids, ///< lists of ids that models make, in formats of their own
};

/// How a variable that models add turns with a mesh that is rotated; the variables of the mesh
/// follow from its points.
enum class MpasTurn {
  none,    ///< it stays
  vectors, ///< Cartesian vectors, in the last dimension
  east,    ///< eastward components; the next row of the table has the northward ones
  east2,   ///< cosines of twice an angle from east; the next row has the sines
  north,   ///< those of the row before
  coriolis ///< a function of the latitude
};

/// The end of the long_name of ids.
inline constexpr const char* index_base = ", 1-based; 0 where there is none";

/// A row of the table. A variable without dimensions is one number.
struct MpasVariable {
  std::string name;
  MpasDimension rows = MpasDimension::none, columns = MpasDimension::none;
  bool integer = false;
  MpasNumbers numbers = MpasNumbers::plain;
  std::string units = "1", long_name = {}, standard_name = {};
  std::string rule = {}; ///< what the values are; only variables that the check compares have one
  /// The values of rows begin to end - 1 of a variable with one column, on the unit sphere. Writer
  /// and check compute them by this function. Null for variables with code of their own.
  void (*values)(const Voronoi&, std::int64_t begin, std::int64_t end, double* out) = nullptr;
  /// Models add the variable to meshes. It is neither written nor checked, but may be read as a
  /// field.
  bool of_models = false;
  MpasTurn turn = MpasTurn::none; ///< of those that models add
};

/// All rows of the table, in the order of variables in a file where that matters.
std::span<const MpasVariable> mpas_variables();
/// \pre the table has it.
const MpasVariable& mpas_variable(const std::string& name);

/// The power of the radius to which the values of a variable are proportional.
int radius_power(const MpasVariable& variable);
/// The factor from values on the unit sphere to those in a file: the radius to that power.
double radius_factor(const MpasVariable& variable, double radius);

/// The dimensions, and the variables that describe a mesh.
const NetcdfMeshNames& mpas_names();

} // namespace calotte::io_detail
