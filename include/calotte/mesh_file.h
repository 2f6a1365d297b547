// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/check.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/refine.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The contents of mesh files: a mesh or its cells, the fields on it, and the changes that reading
/// made.
CALOTTE_API_BEGIN
namespace calotte {

/// Areas of polygons on the unit sphere, steradians; in a plane in the square of its unit.
/// \pre counter-clockwise; on the sphere each smaller than a hemisphere.
DoubleVector areas(const Polygons& polygons);

/// Unwraps polygons of a periodic plane into a plane without a period: each near its centre, or
/// else near its first corner. Corners that are needed on both sides of a seam have copies, which
/// follow the others. Other polygons are unchanged.
Polygons unwrapped(Polygons polygons);

/// Measures of polygons, and counts of those whose shape is not that of a centroidal Voronoi cell.
struct PolygonShapes {
  ValueRange area; ///< steradians; in a plane the square of its unit
  /// Distance of the centres of two polygons that share a side, radians or the plane's unit; all 0
  /// without centres, and if no two share one.
  ValueRange spacing;
  /// Polygons whose area is 0 up to rounding: with fewer than three corners, or with sides that run
  /// back along each other. They do not count below.
  std::int64_t without_area = 0;
  std::int64_t first_without_area = -1; ///< the first of them; -1 for none
  /// Polygons that turn to the right at a corner, by more than 1e-9 radians.
  std::int64_t not_convex = 0;
  std::int64_t first_not_convex = -1; ///< the first of them; -1 for none
  /// Polygons whose centre is farther than 1e-6 widths from their centroid. The width is the square
  /// root of the area; the centroid is the direction of the area's first moment.
  std::int64_t not_centroidal = 0;
  double off_centring = 0;         ///< the largest distance, in widths
  std::int64_t worst_centred = -1; ///< the polygon that has it; -1 without centres
};

/// Measures polygons. Polygons without corners, which are unknown, do not count.
/// \pre counter-clockwise, each smaller than a hemisphere.
PolygonShapes shapes(const Polygons& polygons);

/// The reason why polygons are not the Voronoi cells of their centres.
enum class CellFault {
  none,              ///< they are those of the whole sphere
  open,              ///< nothing, but they cover a part of the surface, and so does their mesh
  walls,             ///< nothing, but they are whole cells with a boundary
  clipped,           ///< nothing, but they have the boundary of a part of the plane
  no_centres,        ///< the file gives none
  no_triangulation,  ///< of their centres: NotVoronoi::detail says why
  other_number,      ///< some have one centre
  no_corners,        ///< a cell has none
  other_corner,      ///< a corner of a cell is not that of the Voronoi cell of its centre
  not_circumcentres, ///< of three centres each, which the corners of a part of the sphere would be
  common_corner,     ///< that of three cells is not the circumcentre of their centres
  no_tessellation,   ///< they overlap, or too many meet in a corner: NotVoronoi::detail
};

/// Whether polygons are the Voronoi cells of their centres, and if not, the first fault.
struct NotVoronoi {
  CellFault fault = CellFault::none;             ///< the first one
  std::array<std::int64_t, 3> cells{-1, -1, -1}; ///< the cell, or the three cells, at fault
  std::int64_t polygons = 0;                     ///< of other_number, their number
  std::int64_t centres = 0;                      ///< of other_number, that of distinct centres
  double distance = 0;     ///< of a corner from the circumcentre, in mean cell widths
  std::string detail = {}; ///< of faults that say so, the error that found them

  /// True if they are a Voronoi tessellation, or a part of one.
  bool passed() const { return fault <= CellFault::clipped; }
  /// The fault as a clause; empty for none.
  std::string text() const;
};

/// Compares polygons with the Voronoi cells of their centres. Corners are equal within a millionth
/// of the mean cell width. Those of a part of the sphere or of a plane need to be Voronoi vertices
/// only where three cells meet.
/// \pre counter-clockwise, each smaller than a hemisphere.
NotVoronoi not_voronoi(const Polygons& polygons);

/// Checks that polygons are cells: counter-clockwise, without overlap, and a Voronoi tessellation
/// or a part of one. A violated law is a result, not an error; it names the first polygon.
/// \returns sites is the number of polygons, area the sum of theirs, expected_area that of the
///          sphere if they cover it, else 0.
CheckReport check(const Polygons& polygons);

/// The contents of a mesh file. At least one of `mesh` and `polygons` is present.
struct MeshFile {
  std::string format = {}; ///< for messages, such as "MPAS" or "SCRIP"

  /// The triangulation of the sites in canonical form, from the file. A file of cells has one if
  /// they are the Voronoi cells of their centres. Cells of a part of the sphere have one if each
  /// corner that cells surround is the circumcentre of three centres; it has the triangles of these
  /// corners only. No file contains the rings of a plane's surface, which clip the cells: a caller
  /// that knows them may set `mesh->surface` for write().
  std::optional<Mesh> mesh = {};
  /// The file's cells, unless they are exactly the Voronoi cells of `mesh`. Cells of a part of the
  /// sphere or of a plane with a boundary are always here.
  std::optional<Polygons> polygons = {};
  NotVoronoi not_voronoi = {}; ///< why `polygons` do not follow from `mesh`; none without polygons
  /// Whether the file contains cells, in its own order: `polygons`, or the Voronoi cells of `mesh`.
  /// Other files contain the triangles or points of `mesh`.
  bool has_cells = false;

  /// Radius of the sphere on which all points lie, with 12 digits; 1 if they lie on none.
  double sphere_radius = 1;
  /// Radius of the planet that a file of the sphere is of, metres; none if nothing names it. It is
  /// sphere_radius in NetCDF files, where that is not 1; 1000 times a radius of 6300 to 6400, which
  /// is the Earth's in km; on the unit sphere the attribute planet_radius, or sphere_radius, from
  /// 10 km on, or else that of the model which alone has such files, see suits().
  std::optional<double> planet_radius = {};
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of an MPAS file
  DoubleVector density = {};          ///< by site, as the file has it; empty if it has none
  std::vector<MeshField> fields = {}; ///< the file's fields

  std::vector<std::string> changes =
      {}; ///< what reading changed, such as "turned 12 clockwise triangles"
  std::vector<std::string> ignored = {}; ///< names of variables that were not read

  /// The polygons if they are other than Voronoi cells: without a mesh, or beside a closed one.
  const Polygons* other_cells() const {
    return polygons && !(mesh && !mesh->closed()) ? &*polygons : nullptr;
  }
  /// True if the rings of a plane's surface clip the cells of the mesh.
  bool is_clipped() const { return plane() && mesh->surface.is_bounded(); }
  /// Radius of the sphere in NetCDF formats, which are in metres: that of the file, or in metres
  /// that of an Earth in km; 1 for the unit sphere.
  double radius_in_metres() const {
    return sphere_radius == 1 ? 1 : planet_radius.value_or(sphere_radius);
  }
  /// The surface of the mesh and the polygons.
  const Surface& surface() const { return mesh ? mesh->surface : polygons->surface; }
  /// The mesh if it is one of the sphere; otherwise null.
  const Mesh* sphere() const { return mesh && mesh->surface.is_sphere() ? &*mesh : nullptr; }
  /// The mesh if it is one of a plane; otherwise null.
  const Mesh* plane() const { return mesh && !mesh->surface.is_sphere() ? &*mesh : nullptr; }
};

/// Regular hexagons in a plane that is periodic, as planar_hex of MPAS-Tools makes them: cell r
/// columns + c has its centre at ((c + 1/2) d, (r + 1) d sqrt(3)/2), in odd rows at ((c + 1) d,
/// ...), moved into the period. The periods are columns d and rows d sqrt(3)/2.
///
/// At walls the cells are whole hexagons, and the boundary runs along their sides: as in planar_hex
/// the mesh has a row or a column more on either side, which is then removed (r and c count from
/// 1). Periods across walls are 0.
/// \param columns, rows numbers of cells, at most 2^28 in all: columns >= 3, with walls in x >= 2;
///        rows >= 4 and even, with walls in y >= 2.
/// \param spacing d, the distance of neighbours, in any unit of length; from 1e-20 to 1e20.
/// \returns `mesh` of a box without walls, else `polygons`.
/// \throws Error invalid_argument for an argument out of range.
MeshFile planar_hexagons(std::int64_t columns, std::int64_t rows, double spacing, Walls walls = {});

/// The Voronoi cells of a doubly periodic box whose sites lie in a part of it, from 0 to `extent`
/// in the directions of the walls; in the others the box stays periodic. The boundary runs along
/// the sides of whole cells, as MPAS-Ocean has it.
/// \param box as make_grid() makes it with Recipe::walls: its period is that of the part where
///        there is no wall, and larger where there is one.
/// \returns `polygons`, in the order of the sites.
/// \throws Error invalid_argument for no wall, an extent that is not below the box's period, or no
///         cell; as voronoi().
MeshFile walled(const Mesh& box, const Eigen::Vector2d& extent, Walls walls);

/// The chosen index of each dimension of a field, none where no choice is made. A choice belongs to
/// the dimension of its name, in any case, or else to the only one whose name contains it: "lev" to
/// nVertLevels. A choice that belongs to none has no effect.
/// \throws Error invalid_argument for an index out of range, a name that several dimensions
///         contain, and two choices of one dimension.
std::vector<std::optional<std::int64_t>> find_indices(const std::vector<FieldDimension>& dimensions,
                                                      const std::vector<FieldIndex>& choices);

/// The index of every dimension of a field that then has one number for each cell: 0 in dimensions
/// of the size 1, and else the chosen one.
/// \param name of the field, for messages.
/// \throws Error as find_indices(); invalid_argument for a choice that belongs to no dimension, and
///         for dimensions that lack one, naming those of the field.
std::vector<std::int64_t> find_all_indices(const std::string& name,
                                           const std::vector<FieldDimension>& dimensions,
                                           const std::vector<FieldIndex>& choices);

/// The field at chosen indices, without their dimensions.
/// \throws Error as find_indices(); invalid_argument for a choice that belongs to no dimension,
///         naming those of the field.
MeshField field_at(const MeshField& field, const std::vector<FieldIndex>& choices);

/// Fields of one file at chosen indices: those that have such dimensions, and the others as they
/// are.
/// \throws Error as find_indices(); invalid_argument for a choice that belongs to no field.
std::vector<MeshField> fields_at(std::vector<MeshField> fields,
                                 const std::vector<FieldIndex>& choices);

/// The fields that read_mesh_file() reads from NetCDF files; the others are among `ignored`.
enum class FieldChoice {
  none,    ///< none, and no variable is among `ignored`
  scalars, ///< those with one number for each cell, edge or vertex
  all,
};

/// Reads a mesh file of any format, recognised as read_mesh() does, and brings the mesh to
/// canonical form.
///
/// Clockwise triangles and polygons are turned if all run clockwise; in GeoJSON, whose polygons
/// have either orientation, each is. Triangles start at their lowest vertex and are sorted.
/// `changes` names the changes.
///
/// GeoJSON is a FeatureCollection. Polygons of one ring, longitude and latitude in degrees, are
/// cells, whose corners agree to 1e-9 degrees; their sides are taken as arcs of great circles. The
/// parts of a MultiPolygon are joined at sides that they share, such as the meridian of 180
/// degrees. The properties x, y and z of all features are the cells' centres; other numbers are
/// fields, and `density` the density. Features without polygons, and Voronoi cells that this
/// library wrote, are sites; such cells of a part of the sphere are cells.
///
/// Values at edges are brought into the order of FieldLocation::edges. `changes` names the fields
/// that are taken for components along the edges, MeshField::directed: those whose name, long_name
/// or standard_name holds "normal" or "tangent", and u, v and ru.
///
/// \param points as read_mesh's.
/// \throws Error as read_mesh; parse for a file that contradicts itself, naming the first offender:
///         triangles or polygons of both orientations, an edge of more than two of them, or cells
///         that overlap.
MeshFile read_mesh_file(const std::string& path, const Points3* points = nullptr,
                        FieldChoice choice = FieldChoice::all);

/// Reads a mesh file with the fields at chosen indices, see fields_at().
/// \param choice of the fields at these indices; the choices have no effect with none.
/// \throws Error as above, and as fields_at() with the file's name.
MeshFile read_mesh_file(const std::string& path, const Points3* points, FieldChoice choice,
                        const std::vector<FieldIndex>& choices);

/// The part of a plane that a file covers: its mesh's surface if that is bounded or a box, or the
/// part that its cells fill, provided that they are the Voronoi cells that this part clips.
/// \returns none for other files, where boundaries touch, and for channels.
std::optional<Surface> filled_surface(const MeshFile& file);

/// The tessellation of a file's cells: that of its mesh, or of its polygons where these are part of
/// a Voronoi tessellation, such as the cells of an ocean or a limited area. Polygons keep their
/// corners; edges at their boundary have one cell, as in a bounded plane.
/// \throws Error as voronoi(); invalid_argument for polygons that are no Voronoi cells, with the
///         reason, and for a plane whose surface is not bounded, without polygons.
Voronoi voronoi(const MeshFile& file);

/// The neighbours of each cell of a file, in the file's order of cells: those that it shares an
/// edge with, ascending. The file's polygons are the cells where there are any, else the Voronoi
/// cells of its mesh. \throws Error invalid_argument for a file with neither.
IdLists cell_neighbours(const MeshFile& file);

/// The density that follows from the cells of a file, see spacing_density(voronoi): those of its
/// mesh, or of its polygons where these are part of a Voronoi tessellation.
/// \returns by cell; none if the cells are uniform, or if they have no spacing: for other polygons,
///          an open mesh, and a plane whose surface is not bounded.
/// \throws Error as voronoi().
DoubleVector spacing_density(const MeshFile& file);

/// The triangles and sites that without_ears() removed.
struct EarReport {
  std::int64_t triangles = 0; ///< with one neighbour, or none
  std::int64_t sites = 0;     ///< that no triangle was left with
};

/// The result of without_ears().
struct WithoutEars {
  MeshFile file;     ///< the rest
  EarReport removed; ///< counts
};

/// Removes the triangles of an open mesh of the sphere that have a single neighbour, or none,
/// repeatedly, and the sites that no triangle is left with: FESOM's partitioner refuses them
/// (fvom_init.F90, find_elem_neighbors_ini). Density and fields follow. A closed mesh has none.
/// \throws Error invalid_argument, for a file without a mesh of the sphere, and if no triangle is
/// left.
WithoutEars without_ears(MeshFile file);

/// A file after a change of a part of its mesh.
struct ChangedFile {
  MeshFile file; ///< its mesh, polygons, density and fields
  /// Fields whose new cells have the value of the nearest old one.
  std::vector<std::string> nearest;
  std::vector<std::string> left_out; ///< fields at edges and at vertices, which do not follow
};

/// Names of fields at cells whose values at new cells are not computed in the default way. The
/// default is linear between the old cells, and for whole numbers the value of the nearest old
/// cell.
struct FieldMethods {
  std::vector<std::string> nearest = {}; ///< the value of the nearest old cell
  /// The mean over the new cell by the areas that it shares with old cells, see
  /// conservative_weights(); for whole numbers the value of the largest area.
  std::vector<std::string> conservative = {};
};

/// Requires a file that has all these fields at its cells, each with one method.
/// \throws Error invalid_argument, naming the field.
void require_fields(const MeshFile& file, const FieldMethods& methods);

/// The contents of a file after refine() or coarsen(). Cells whose corners did not change keep
/// them, and their order; so do cells at a boundary. New cells have the circumcentres of their
/// triangles. Cells that stayed keep the values of all fields at cells, and of the density. At new
/// ones, methods say what the values are; outside the triangles of an open mesh those that would be
/// linear are those of the nearest old cell. The density at new cells is the old one there, made
/// denser as the widths are finer. Masks of a limited area at edges and vertices follow when an
/// MPAS file is written. The field mapNewToBase is added: the number of each cell in the old file,
/// from 1 on, and 0 for new cells.
/// \param old the file, as read_mesh_file() returns it; that of a plane whose rings clip the cells
///        with them, see filled_surface().
/// \param changed of its mesh.
/// \throws Error invalid_argument for a file without a mesh, for polygons that are not those of its
///         sites; for conservative fields of an open mesh without cells; as require_fields().
ChangedFile changed_file(const MeshFile& old, ChangedMesh changed,
                         const FieldMethods& methods = {});

/// The treatment of a file's fields by write().
struct WrittenFields {
  std::vector<std::string> dropped; ///< names of those that the format cannot hold
  /// The fields whose names NetCDF refuses, such as "sea level" and "a/b", with their names in the
  /// file.
  std::vector<std::array<std::string, 2>> renamed;
};

/// Requires that write() stores all fields of the options. Values at cells may be missing: programs
/// that compute them may ask before.
/// \throws Error invalid_argument, naming the first field and the formats that store it; as
///         format_of().
void require_storable(const std::string& path, const MeshFile& file, const WriteOptions& options);

/// Writes the contents of a file to another format. The cells keep their shapes: polygons go to
/// formats of cells, and to those of triangles that can hold other faces (vtp, vtu, off, ply) where
/// there is no mesh. Fields of the file that the format cannot hold are left out, those of the
/// options are refused. The planet stays that of the file, unless the options have another. MPAS
/// needs Voronoi cells: the polygons of an open mesh are written if each corner of three cells is
/// the circumcentre of their centres, within a millionth of a cell's width. Density and fields at
/// cells go along.
/// \param options its density, if not uniform, replaces the file's.
/// \throws Error as write(); invalid_argument if the format cannot hold the mesh, with the reason.
WrittenFields write(const std::string& path, const MeshFile& file,
                    const WriteOptions& options = {});

/// A variable or attribute of a file that contradicts the mesh of the file or a rule of its format.
struct Deviation {
  std::string variable; ///< its name in the file
  /// The largest relative difference between a stored and the derived value; 1 for ids and for
  /// rules without a measure; infinite for values that are not finite.
  double difference = 0;
  std::int64_t index = -1; ///< 0-based, of that value in the variable; -1 for none
  /// True if all its differences are a known fault of MpasMeshConverter (MPAS-Tools), in variables
  /// that do not enter a model's equations.
  bool known = false;
  std::string text; ///< one line: the variable, the rule, the index, and both values
};

/// Compares the variables of a NetCDF mesh file with values derived from its mesh, and with the
/// rules of its format (MPAS, UGRID, SCRIP, ESMF); and the boundary in files of FESOM, SCHISM,
/// ADCIRC, SMS and Gmsh with that of the mesh, and with the rules of these models. Absent variables
/// are not checked. The file's numbering of edges and vertices, the first entry of a cyclic list,
/// and the first cell of an edge are free.
///
/// The mesh is that of the cells and of cellsOnVertex (MPAS), or of the polygons. All else follows
/// from it, so that a wrong position of a cell makes many variables deviate.
///
/// Differences count from 1e-6 of a value's scale on, because MpasMeshConverter computes lengths
/// and areas in single precision; angles are compared modulo 2 pi. The scale is local: that of
/// dvEdge is dcEdge, that of an area is the sum of its kites, that of a coordinate the distance to
/// the nearest cells. Longitudes and latitudes of MPAS may differ by 2e-8 + 1e-6 mean cell widths.
/// nominalMinDc, a sum over all cells of a closed mesh, must agree to 1e-10, because it alone tells
/// of meshDensity.
///
/// The spacing of cells that have all their neighbours is compared with nominalMinDc
/// meshDensity^(-1/4). The ratios are smoothed over neighbours. Their median may be 1/1.25 to 1.25,
/// where an open mesh has nominalMinDc, and their 95% quantile 1.6 times the 5% quantile: within
/// that are independent random sites of uniform density, and CVTs of any density.
/// Files with coordinates in single precision have a wider tolerance.
///
/// Not checked: what depends on the missing cells of an open MPAS mesh, and the positions of its
/// vertices on the boundary; fields; masks, but for
/// values other than 0 and 1; areas in units other than radians^2; centres that are inside their
/// cells, where most of the cells are not Voronoi cells.
///
/// \param file the contents of the file at `path`, as read_mesh_file() returns them.
/// \returns nothing for other formats.
/// \throws Error file, parse, as read_mesh_file().
std::vector<Deviation> check_file(const std::string& path, const MeshFile& file);

/// The same with less memory for MPAS: parts of `file` are freed during the call, and it is
/// unspecified afterwards.
std::vector<Deviation> check_file(const std::string& path, MeshFile&& file);

} // namespace calotte
CALOTTE_API_END
