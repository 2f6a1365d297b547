// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/raster.h>
#include <calotte/remap.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Fields from one grid to another, in files: meshes and rasters of longitude and latitude.
CALOTTE_API_BEGIN
namespace calotte {

/// A grid that carries fields: a mesh, or a raster.
struct FieldGrid {
  std::string name;                      ///< of the file, for messages
  std::optional<LonLatBoxes> boxes = {}; ///< of a raster
  MeshFile mesh = {};                    ///< where there are no boxes; without its fields
  std::vector<MeshField> fields = {};    ///< at cells
  std::vector<std::string> ignored = {}; ///< variables that are no such field
  /// Fields that FieldChoice::scalars leaves out, without values; of a file without its mesh alone.
  std::vector<MeshField> not_scalars = {};
  /// n: 1 for cells that count, 0 for those that the mask of SCRIP (grid_imask) or ESMF
  /// (elementMask) leaves out. Empty where all count.
  Ids mask = {};

  /// The number of cells.
  std::int64_t size() const;
};

/// Reads a mesh file of any format, see read_mesh_file(), or a raster: a NetCDF file with the
/// coordinate variables lat(lat) and lon(lon), latitude and longitude, or others whose
/// standard_name or units say so. Where these have bounds, the boxes are those; else see
/// lon_lat_boxes(). Fields of a raster have both dimensions, and any others, in any order. Values
/// are what their attributes say: unpacked, unsigned, and NaN where they are missing or out of
/// range, and where a mask leaves the cell out.
/// \param choice of the fields at chosen indices.
/// \param choices indices of the dimensions of fields, such as a time, for those that have them.
/// \throws Error as read_mesh_file() and lon_lat_boxes(), with the file's name; invalid_argument as
///         find_indices(), and for an index that belongs to no field.
FieldGrid read_field_grid(const std::string& path, FieldChoice choice = FieldChoice::all,
                          const std::vector<FieldIndex>& choices = {});

/// The first cell of a file that does not hold the position which is given for it; -1 if all do. A
/// position counts as held within 1e-6 radians of the centre, and where it is NaN, and so do all in
/// a plane.
/// \param positions 3 x n directions, one for each cell.
std::int64_t first_misplaced(const MeshFile& mesh, const Points3& positions);

/// Requires the cells of a file of fields to be in the order of a mesh, where the file has their
/// longitudes and latitudes, or lonCell and latCell, see first_misplaced().
/// \param mesh_path the name of the mesh, for the message.
/// \throws Error parse, with the index of the first cell in another order; file.
void require_order(const std::string& path, const MeshFile& mesh, const std::string& mesh_path);

/// The same for a file of fields without their mesh, such as a model's history, and a file of the
/// mesh. In the file of fields, nCells is the dimension of the cells, or else the only dimension of
/// their number. The cells must be in the order of the mesh, see require_order().
/// \throws Error as above; parse for a file without such a dimension; as require_order();
///         invalid_argument for a mesh file that is a raster.
FieldGrid read_field_grid(const std::string& path, const std::string& mesh_path,
                          FieldChoice choice = FieldChoice::all,
                          const std::vector<FieldIndex>& choices = {});

/// The raster that "720x360" stands for, see lon_lat_boxes(); none for other texts.
/// \throws Error invalid_argument for numbers out of range.
std::optional<FieldGrid> raster_of(const std::string& columns_x_rows);

/// The cells of a grid that is no raster: those of its file, or the Voronoi cells of its mesh.
/// \throws Error as voronoi().
Polygons cells_of(const FieldGrid& grid);

/// The weights from one grid to another.
///
/// - conservative: see conservative_weights().
/// - nearest: the cell, or box, that contains the centre of the target's cell.
/// - linear: on the triangles between the source's centres, or bilinear between a raster's nodes,
///   at the centre of the target's cell. Cells outside of the source have no weights.
/// - natural_neighbours: from meshes.
///
/// Areas are set only for conservative weights.
/// \throws Error invalid_argument for grids on different surfaces; as conservative_weights(),
///         interpolation_weights(), cells_of().
GridWeights interpolation_weights(const FieldGrid& source, const FieldGrid& target,
                                  Interpolation kind);

/// A format of files of weights, NetCDF.
enum class WeightsFormat {
  esmf, ///< as ESMF_RegridWeightGen writes it: n_a, n_b, n_s, row, col, S
  scrip ///< as SCRIP and CDO write it: src_address, dst_address, remap_matrix
};

/// Writes weights, with centres, corners, areas and fractions of both grids. The rows sum to 1: the
/// normalisation is "fracarea" in the words of SCRIP and ESMF.
/// \param history attribute; empty for none.
/// \throws Error invalid_argument for grids of a plane; file.
void write_weights(const std::string& path, const GridWeights& weights, const FieldGrid& source,
                   const FieldGrid& target, Interpolation kind,
                   WeightsFormat format = WeightsFormat::esmf, const std::string& history = {});

/// Reads weights of either format, also of other programs: they are applied as they are. Of several
/// weights of a link (second order) the first is taken if the others are 0.
/// \throws Error parse: an address out of range, naming the link; other variables; file.
GridWeights read_weights(const std::string& path);

/// Requires that write_fields() can write fields of these names and dimensions, before their values
/// are computed.
/// \throws Error invalid_argument, for a name that the file needs, and for a format that cannot
///         store the grid or a field.
void require_storable(const std::string& path, const FieldGrid& grid,
                      const std::vector<MeshField>& fields);

/// Writes fields of a grid to a NetCDF file: of a raster with its coordinates and bounds; of a mesh
/// with the longitudes and latitudes, or x and y, of its cells, in the order of its file. The
/// dimension of the cells has the name that the mesh's format gives it, such as nCells. Another
/// suffix writes the mesh with its fields, see write().
/// \param history attribute; empty for none.
/// \param source NetCDF file that the fields are from; empty for none. Its data on their other
///        dimensions are copied to the file: coordinates such as time and lev with bounds and
///        terms, times as text, scalar coordinates. An unlimited dimension stays so, where all have
///        it first.
/// \throws Error invalid_argument for a field without a value for each cell, and as
///         require_storable(); file.
void write_fields(const std::string& path, const FieldGrid& grid,
                  const std::vector<MeshField>& fields, const std::string& history = {},
                  const std::string& source = {});

/// The sea floor at the cells of an ocean.
struct SeaFloor {
  /// Those of the stream topography of MPAS-Ocean's initial state: bed_elevation, the mean height
  /// of the part of each cell where heights are below 0, metres, and oceanFracObserved, that part;
  /// ssh, landIceDraftObserved, landIcePressureObserved, landIceThkObserved, landIceFracObserved
  /// and landIceFloatingFracObserved, which are 0: an ocean without ice shelves.
  std::vector<MeshField> fields = {};
  std::int64_t dry = 0; ///< cells without such a part: their bed_elevation is 0
};

/// Takes heights to an ocean by conservative weights, as compass makes topography_culled.nc.
/// \param heights of the sphere, metres, negative below the sea. NaN counts neither as sea nor as
///        land.
/// \param ocean of a mesh of the sphere, as cull() writes it.
/// \throws Error invalid_argument for heights of a plane; as interpolation_weights().
SeaFloor sea_floor(const Raster& heights, const FieldGrid& ocean);

} // namespace calotte
CALOTTE_API_END
