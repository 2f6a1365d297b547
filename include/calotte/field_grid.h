// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/raster.h>
#include <calotte/remap.h>

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Fields from one grid to another, in files: meshes and rasters of longitude and latitude.
CALOTTE_API_BEGIN
namespace calotte {

/// Positions without cells, such as those of stations.
struct Positions {
  Surface surface = {}; ///< the sphere, or a plane
  Points3 points = {};  ///< 3 x n: directions, or points of the plane with z = 0
  /// 2 x n, the same as files have them: longitudes and latitudes in degrees, or x and y.
  Points2 coordinates = {};
};

/// What carries fields: a mesh, a raster, or positions.
struct FieldGrid {
  std::string name;                        ///< of the file, for messages
  std::optional<LonLatBoxes> boxes = {};   ///< of a raster
  std::optional<Positions> positions = {}; ///< where there are no cells
  MeshFile mesh = {};                      ///< where there is neither; without its fields
  std::vector<MeshField> fields = {};      ///< at cells, or at positions as if these were cells
  std::vector<std::string> ignored = {};   ///< variables that are no such field
  /// Fields that FieldChoice::scalars leaves out, without values; of a file without its mesh alone.
  std::vector<MeshField> not_scalars = {};
  /// n: 1 for cells that count, 0 for those that the mask of SCRIP (grid_imask) or ESMF
  /// (elementMask) leaves out. Empty where all count.
  Ids mask = {};

  /// The number of cells, or of positions.
  std::int64_t size() const;
};

/// The columns of a text of positions and values. A column is chosen by its name in the header, in
/// any case where no other fits, or by its number, from 1 on.
struct ColumnChoice {
  bool plane = false; ///< whether positions are x y of a plane, or longitude and latitude
  /// Two columns. Default: those that the header names lon or longitude and lat or latitude, or x
  /// and y; without a header the first two.
  std::vector<std::string> position = {};
  /// Columns of values. Default: all others that the header names; without a header all others.
  std::optional<std::vector<std::string>> fields = {};
};

/// Reads positions and values as text, a row on each line. Commas, semicolons, bars or tabs
/// separate columns, or else blanks; not within double quotes, with which a column starts, and a
/// line ends even there. `#` starts a comment; blank lines are ignored. A line before the rows that
/// names the position or has no numbers is a header, and so is a comment that names the position
/// and as many columns as there are. An empty column, NaN and NA are missing values. All rows have
/// the same number of columns; those that are not chosen may hold any text.
///
/// Fields have the names of the header, or column3, column4 and so on.
/// \param name the name of the stream in messages.
/// \throws Error parse (index() is the 1-based line) for another number of columns, for text that
///         is not a number, for a latitude out of range and for a position that is missing; parse
///         for a header without a position, a column that there is not, of columns without a header
///         a first one that counts the lines or is no longitude, or a file without rows; file.
FieldGrid read_positions(std::istream& in, const std::string& name,
                         const ColumnChoice& choice = {});
/// The same from a file.
FieldGrid read_positions(const std::string& path, const ColumnChoice& choice = {});

/// Reads a mesh file of any format, see read_mesh_file(), or a raster: a NetCDF file with the
/// coordinate variables lat(lat) and lon(lon), latitude and longitude, or others whose
/// standard_name or units say so. Where these have bounds, the boxes are those; else see
/// lon_lat_boxes(). Or a raster in the plane of a projection, whose variables have the attribute
/// grid_mapping (CF conventions, Appendix F): polar_stereographic, lambert_conformal_conic,
/// lambert_azimuthal_equal_area or rotated_latitude_longitude. Its cells are polygons with corners
/// half way between nodes, of geodetic latitudes. Or a raster of variables whose attribute
/// coordinates names two-dimensional longitudes and latitudes without bounds: its corners are in
/// the middle of four centres. Fields of a raster have both dimensions, and any others, in any
/// order. Values are what their attributes say: unpacked, unsigned, and NaN where they are missing
/// or out of range, and where a mask leaves the cell out.
///
/// \param choice of the fields at chosen indices.
/// \param choices indices of the dimensions of fields, such as a time, for those that have them.
/// \throws Error as read_mesh_file() and lon_lat_boxes(), with the file's name; parse for a grid
///         mapping that is not read; invalid_argument as find_indices(), and for an index that
///         belongs to no field.
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
/// \throws Error as voronoi(); invalid_argument for positions.
Polygons cells_of(const FieldGrid& grid);

/// The weights from one grid to another.
///
/// - conservative: see conservative_weights().
/// - nearest: the cell, or box, that contains the centre of the target's cell.
/// - linear: on the triangles between the source's centres, or bilinear between a raster's nodes,
///   at the centre of the target's cell. Cells outside of the source have no weights.
/// - natural_neighbours: from meshes.
///
/// A target of positions has rows for these; it has no conservative weights. A source has cells.
///
/// Areas are set only for conservative weights.
/// \throws Error invalid_argument for grids on different surfaces, for a source of positions and
///         conservative weights to them; as conservative_weights(), interpolation_weights(),
///         cells_of().
GridWeights interpolation_weights(const FieldGrid& source, const FieldGrid& target,
                                  Interpolation kind);

/// Fields that scattered positions had, at a target.
struct ScatteredFields {
  std::vector<MeshField> fields; ///< in the order of the source
  /// The number of rows of the source whose value was averaged with that of an earlier row.
  std::int64_t merged = 0;
};

/// Takes fields from scattered positions to the centres of a target's cells, or to its positions,
/// by the Delaunay triangulation of the positions, see interpolation_weights() of a mesh.
///
/// Values that are NaN are missing: their positions count for the other fields alone. Fields with
/// values at the same positions share a triangulation. Positions in the same direction, or at the
/// same point, are one, whose value is the mean. But for `nearest`, the result is NaN outside of
/// the triangles: those of positions in a hemisphere, or in a plane, cover their convex hull. It is
/// NaN, too, where a mask leaves the target's cell out. The result has the same bits for any order
/// of the positions and any number of threads.
/// \param source positions and fields of one value each. \param kind not conservative.
/// \throws Error invalid_argument for another source or kind, for another surface of the target and
///         a field that has not one value for each position, an infinite one or none; for a field
///         with its name: too_few_sites for fewer than 3 distinct positions, degenerate for
///         positions on one great circle or line; not_finite and zero_vector, with the index of the
///         position.
ScatteredFields interpolate_scattered(const FieldGrid& source, const FieldGrid& target,
                                      Interpolation kind = Interpolation::linear);

/// A file of fields that is read in parts, so that a raster in the plane of a projection may be
/// larger than memory: a part has some of its rows. Any other file is one part.
class FieldParts {
public:
  /// \param choices as for read_field_grid(). \param most about as many cells are in a part,
  ///        less where cells have many numbers.
  /// \throws Error as read_field_grid().
  explicit FieldParts(const std::string& path, const std::vector<FieldIndex>& choices = {},
                      std::int64_t most = std::int64_t{1} << 20);

  std::int64_t count() const; ///< of the parts, 1 or more

  /// Reads the cells of a part, and their fields.
  /// \param names of the fields that are read. Default: all.
  /// \throws Error as read_field_grid().
  FieldGrid read(std::int64_t part,
                 const std::optional<std::vector<std::string>>& names = {}) const;

private:
  struct File;
  std::shared_ptr<const File> file_;
};

/// Fields at a target.
struct CoveredFields {
  std::vector<MeshField> fields; ///< in the order in which they were asked for
  DoubleVector target_fraction;  ///< of each cell's area, what the source covers
};

/// Takes fields from a file that is read in parts to the cells of a target: what interpolate()
/// gives with conservative weights, up to the rounding of the sums. The result has the same bits
/// for any number of threads.
/// \param fields those that are taken, such as FieldParts::read(0) has them: their names, and
///        whether they are categories; not their values.
/// \throws Error as FieldParts::read() and interpolation_weights(); parse for a field of categories
///         of which a part holds no 32-bit integers.
CoveredFields interpolate_parts(const FieldParts& source, const std::vector<MeshField>& fields,
                                const FieldGrid& target, double min_cover = 0);

/// A format of files of weights, NetCDF.
enum class WeightsFormat {
  esmf, ///< as ESMF_RegridWeightGen writes it: n_a, n_b, n_s, row, col, S
  scrip ///< as SCRIP and CDO write it: src_address, dst_address, remap_matrix
};

/// Writes weights, with centres, corners, areas and fractions of both grids. The rows sum to 1: the
/// normalisation is "fracarea" in the words of SCRIP and ESMF.
/// \param history attribute; empty for none.
/// \throws Error invalid_argument for grids of a plane and positions; file.
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
/// suffix writes the mesh with its fields, see write(). Of positions it writes NetCDF (.nc), or
/// text with a header, the positions and a column for each field: .csv with commas, .txt with
/// blanks, and NaN where there is no value.
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
