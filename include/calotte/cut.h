// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/limited_area.h>
#include <calotte/mesh.h>
#include <calotte/ocean.h>
#include <calotte/progress.h>
#include <calotte/surface.h>
#include <calotte/write.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Parts of MPAS files: limited-area grids cut from global ones, and ocean grids without land.
CALOTTE_API_BEGIN
namespace calotte {

/// Options of cut().
struct CutOptions {
  int rings = limited_area_rings; ///< of boundary cells, 0 to limited_area_rings
  /// Radius of the sphere of the new file, > 0. MPAS-Atmosphere expects grids on the unit sphere; a
  /// file of static or initial fields keeps the radius that these were made with. Default: 1; none
  /// keeps that of the source.
  std::optional<double> sphere_radius = 1;
  /// The order of verticesOnCell in the new file. Default: that of MPAS-Atmosphere, see models();
  /// none keeps the source's.
  std::optional<VertexOrder> vertex_order = VertexOrder::before_edges;
  std::vector<FieldDimension> dimensions = {}; ///< new ones, see models(). Default: none.
  /// How the file was made; precedes the source's attribute `history`. Default: empty.
  std::string history = {};
  /// Stage: write. A cancelled run leaves no file. Default: none.
  ProgressCallback progress = {};
};

/// The result of cut().
struct CutReport {
  std::int64_t cells = 0;                  ///< of the new mesh
  std::int64_t edges = 0;                  ///< of the new mesh
  std::int64_t vertices = 0;               ///< of the new mesh
  std::vector<std::int64_t> cells_by_mask; ///< rings + 1: inside, then by ring
  /// Variables of the source that the new file lacks: strings, user-defined types, and lists that
  /// the model makes itself (advCells, advCellsForEdge).
  std::vector<std::string> left_out;
  double sphere_radius = 1;                            ///< of the new file
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of the new file
};

/// Cuts a limited-area grid from an MPAS file of the sphere, as limited_area_mask() selects its
/// cells, and carries all fields along.
///
/// The new file has the selected cells with every edge and vertex that touches one, in the order of
/// the source, and:
///
/// - each variable with a dimension nCells, nEdges or nVertices, without the rows left out, of any
///   type and with any other dimensions; all others, all attributes and dimensions;
/// - ids numbered anew from 1 on, 0 for a missing cell, edge or vertex at its index in the list;
///   the weights of missing edges in weightsOnEdge are 0; verticesOnCell has the order of
///   CutOptions::vertex_order. All other values keep their bits; measures at the boundary, such as
///   kiteAreasOnVertex, are those of the source;
/// - boundaryVertex 1 where a vertex lacks a cell, if the source has the variable;
/// - bdyMaskCell, bdyMaskEdge and bdyMaskVertex, see limited_area_mask() and least_mask();
/// - meshDensity divided by its maximum, and nominalMinDc of that maximum, computed by
///   nominal_spacing() if the source has none;
/// - lengths and areas on a sphere of sphere_radius, if that is not the source's: coordinates,
///   dcEdge, dvEdge, areaCell, areaTriangle, kiteAreasOnVertex, gridSpacing, nominalMinDc, defc_a,
///   defc_b, deriv_two, cell_gradient_coef_x and cell_gradient_coef_y;
/// - the attributes on_a_sphere "YES", sphere_radius, is_periodic "NO", mesh_spec "1.1", file_id
///   and parent_id, to which the source's file_id is added.
///
/// NAME.graph.info is written beside NAME.nc. Both are complete or absent. The file is a classic
/// one, with 64-bit offsets if possible.
/// \param source an MPAS file with connectivity, written by any program.
/// \throws Error invalid_argument as limited_area_mask(), for a source that contains no such mesh,
///         for a radius that is not positive and finite, and for a variable with two of the
///         dimensions; parse; cancelled; file.
CutReport cut(const std::string& source, const std::string& target, const Surface& region,
              const CutOptions& options = {});

/// The same with a region given by a function.
/// \param inside whether a point on the sphere of the source lies in the region. Several threads
///        call it at once.
CutReport cut(const std::string& source, const std::string& target,
              const std::function<bool(const Eigen::Vector3d&)>& inside,
              const CutOptions& options = {});

/// Writes the limited-area grid of a run in a region that is wider than the grid's: the cells of
/// the grid's region with their rings, see limited_area_mask(), and the masks of cut(). The cells
/// are those of voronoi(mesh, mask).
/// \param mesh of the wider region, as make_grid() makes it with Recipe::limited_area; its surface
///        contains the region and its rings.
/// \param region the region of the recipe.
/// \param options of an MPAS file; vertices of cells are paired as MPAS-Atmosphere does unless they
///        say otherwise; site_density and fields have no effect.
/// \throws Error as limited_area_mask(), voronoi() and write().
CutReport write_limited_area(const std::string& target, const Mesh& mesh, const Surface& region,
                             const WriteOptions& options = {});

/// A field that distinguishes sea from land.
struct SeaField {
  std::string path;     ///< NetCDF file; empty for the source
  std::string variable; ///< one number for each cell; empty for no field
  /// Cells with lower <= value < upper may be sea; others, and those without a number, are land.
  /// Default: below 0, as for a topography.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = 0; ///< see `lower`
};

/// Options of cull().
struct CullOptions {
  Coast coast = {};   ///< Default: none, no land.
  Raster raster = {}; ///< Default: no values, none.
  /// Cells with a larger fraction of land, by the coast or by the raster, are land; 0 to less
  /// than 1.
  double land_fraction = 0.5;
  SeaField field = {}; ///< in addition to these. Default: none.
  /// Lines that stay open: all cells on them are sea. Each is 3 x points, unit columns, joined by
  /// arcs of great circles. A line on land that reaches no sea has no effect; it is an error if all
  /// are so. Default: none.
  std::vector<Points3> passages = {};
  std::vector<Points3> barriers = {}; ///< lines whose cells are land, unless on a passage
  /// Cells with a single neighbour in the sea become land, repeatedly. Default: true.
  bool fill = true;
  /// Cells from this latitude on, degrees, towards both poles, need an open vertex for sea ice, see
  /// SeaOptions::need_open_vertex; 0 to 90. Default: none.
  std::optional<double> sea_ice_latitude = {};
  Points3 seeds = {}; ///< points in the sea, unit columns. Default: none, its largest part.
  /// MPAS file of all other cells, made as that of the sea: the land of a coupled model, and what
  /// is left out of the sea. With that of the sea it has each cell of the source once. Default:
  /// empty, no file.
  std::string land_path = {};
  /// File for the culled cells: the variables cullCell and regionCellMasks (1 for land), oceanCell
  /// and landCell (the 0-based id among the cells of the sea, of the others, or -1), and
  /// landFraction if there is a coast or a raster (of both the greater), by cell of the source.
  /// Default: empty, no file.
  std::string mask_path = {};
  /// Folder for cellMapForward.txt and cellMapBackward.txt, the text files of MPAS-Tools' culler
  /// with option -c. Forward has a line for each cell of the source: the 0-based id in the new
  /// mesh, or -1 for a cell that is left out. Backward has a line for each cell of the new mesh:
  /// its 0-based id in the source. Default: empty, no files.
  std::string cell_map_folder = {};
  /// Radius of the sphere of the new file, > 0. Default: none, that of the source.
  std::optional<double> sphere_radius = {};
  std::optional<VertexOrder> vertex_order = {}; ///< of the new file. Default: none, the source's.
  std::vector<FieldDimension> dimensions = {};  ///< new ones, see models(). Default: none.
  std::string history = {};       ///< how the file was made; precedes that of the source
  ProgressCallback progress = {}; ///< stage: write. A cancelled run leaves no file.
};

/// The result of cull().
struct CullReport {
  std::int64_t cells = 0;                              ///< of the new mesh
  std::int64_t edges = 0;                              ///< of the new mesh
  std::int64_t vertices = 0;                           ///< of the new mesh
  double sphere_radius = 1;                            ///< of the new file
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of the new file
  std::int64_t land = 0;   ///< cells that coast, raster and field make land
  std::int64_t others = 0; ///< cells of the file of all other cells
  SeaReport sea;           ///< decisions of sea_cells()
  Points3 severed;         ///< the middle of each of sea.severed_parts, unit columns
  /// Passages on land that reach no sea, as where a gulf is narrower than cells: their indices.
  std::vector<std::int64_t> stranded_passages = {};
  std::vector<std::string> left_out; ///< variables, as CutReport::left_out
};

/// Removes the land cells from an MPAS file of the sphere, see sea_cells(), and carries all fields
/// along, as cut() does. The new file has the cells of the sea, with every edge and vertex that
/// touches one, in the order of the source. As in files of MPAS-Tools:
///
/// - edges have their first cell: where that of the source is land, the cells of cellsOnEdge and
///   the vertices of verticesOnEdge are exchanged. angleEdge turns by pi, edgeNormalVectors and the
///   weights in weightsOnEdge to and from such edges change their sign;
/// - kiteAreasOnVertex is 0 for cells of land; areaTriangle is the sum of the kites;
/// - the variables mapCulledToBaseCell, mapCulledToBaseEdge and mapCulledToBaseVertex hold the
///   0-based ids of the source;
/// - other measures at the boundary and the density are those of the source; lengths and areas
///   those of sphere_radius, as cut() converts them.
///
/// NAME.graph.info is written beside NAME.nc. All files are complete or absent: they get their
/// names when all are written, the mesh last.
/// \throws Error invalid_argument as land_fractions(), cells_on_lines() and sea_cells(); for a
///         source that holds no mesh of the sphere with connectivity, a fraction out of range, and
///         if there is neither a coast nor a raster nor a field nor a barrier; parse; cancelled;
///         file.
CullReport cull(const std::string& source, const std::string& target,
                const CullOptions& options = {});

} // namespace calotte
CALOTTE_API_END
