// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh_field.h>
#include <calotte/ocean.h>
#include <calotte/progress.h>
#include <calotte/write.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Ocean grids: global ones without their cells of land.
CALOTTE_API_BEGIN
namespace calotte {

/// A field that tells the sea from the land.
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
  /// Lines that stay open: all cells on them are sea. Each 3 x points, unit columns, joined by arcs
  /// of great circles. One that is on land and reaches no sea is an error. Default: none.
  std::vector<Points3> passages = {};
  std::vector<Points3> barriers = {}; ///< lines whose cells are land, unless on a passage
  /// Cells with a single neighbour in the sea become land, repeatedly. Default: true.
  bool fill = true;
  Points3 seeds = {}; ///< points in the sea, unit columns. Default: none, its largest part.
  /// File for what is culled: the variables cullCell and regionCellMasks (1 for land), and
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

/// What cull() made.
struct CullReport {
  std::int64_t cells = 0;                              ///< of the new mesh
  std::int64_t edges = 0;                              ///< of the new mesh
  std::int64_t vertices = 0;                           ///< of the new mesh
  double sphere_radius = 1;                            ///< of the new file
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of the new file
  std::int64_t land = 0;             ///< cells that coast, raster and field make land
  SeaReport sea;                     ///< what followed
  std::vector<std::string> left_out; ///< variables, as CutReport::left_out
};

/// Leaves the cells of land out of an MPAS file of the sphere, see sea_cells(), and carries all
/// fields along, as cut() does. The new file holds the sea's cells, with every edge and vertex that
/// touches one, in the order of the source. As MPAS-Tools leaves them:
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
