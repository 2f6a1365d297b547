// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/gates.h>
#include <calotte/mesh.h>
#include <calotte/progress.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Writers. Each file is written under a temporary name in the same folder, flushed to the disk and
/// renamed when complete, so that a reader sees all of it or none. A device or a pipe is written in
/// place.
CALOTTE_API_BEGIN
namespace calotte {

/// Writes x y z, in the plane x y, on each line, separated by blanks, with the fewest digits (at
/// most 17) that read back to the same bits.
/// \param points 3 x n or 2 x n, unchanged.
/// \throws Error invalid_argument for another number of rows, before any file is touched; file.
void write_points(const std::string& path, const PointsRef& points);
/// The same to a stream, which it flushes.
void write_points(std::ostream& out, const PointsRef& points);

/// Writes the part of each cell, see CellParts::part, on a line: a file graph.info.part.N as
/// gpmetis writes it and MPAS reads it. \throws Error file.
void write_parts(const std::string& path, const Ids& part);

/// Writes cell widths as read_cell_width() reads them, to the bit: NetCDF (.nc), or JIGSAW's
/// ELLIPSOID-GRID (.msh), whose angles in radians round.
/// \param widths of the sphere, km.
/// \throws Error invalid_argument as WidthField, for a raster of a plane or another suffix; file.
void write(const std::string& path, const Raster& widths);

/// The format of a mesh file. "Cells" are Voronoi cells, "triangles" Delaunay triangles.
enum class Format {
  by_name,         ///< selected by the file name, see write(); the default
  mpas,            ///< full MPAS mesh, NetCDF; NAME.graph.info, as METIS reads it, beside NAME.nc
  mpas_minimal,    ///< the input of MpasMeshConverter.x of MPAS, NetCDF
  ugrid,           ///< UGRID of the Voronoi cells, NetCDF
  ugrid_triangles, ///< UGRID of the Delaunay triangles, NetCDF
  scrip,           ///< SCRIP of the cells, NetCDF
  esmf,            ///< ESMF unstructured of the cells, NetCDF
  vtp,             ///< VTK PolyData of the triangles; a closed mesh has its CellFields at the sites
  vtu,             ///< VTK UnstructuredGrid of the same
  vtp_cells,       ///< VTK PolyData of the Voronoi cells with their CellFields
  vtu_cells,       ///< VTK UnstructuredGrid of the same
  off,             ///< OFF of the triangles, text, digits as in write_points()
  ply,             ///< PLY of the triangles, binary doubles
  triangles,       ///< text: the 0-based ids `i j k` of a triangle on each line, without points
  mpi_scvt,        ///< SaveVertices, and SaveTriangles and SaveDensity beside it
  msh,             ///< JIGSAW of the triangles
  geojson,         ///< the cells as polygons with their CellFields
  exodus,          ///< Exodus II of the cells, NetCDF, as TempestRemap reads it
  fesom,           ///< nod2d.out, and elem2d.out beside it: the triangles for FESOM, text
  gmsh,            ///< Gmsh 4.1 of the triangles, text, with the parts of the boundary
  schism,          ///< SCHISM's hgrid.gr3: the triangles, the boundary and depths, text
  adcirc,          ///< ADCIRC's fort.14: the same
  sms,             ///< SMS's .2dm: the same
  vtk,             ///< legacy VTK, read only: write() throws invalid_argument, for this and below
  icon,            ///< a grid of ICON, NetCDF, read only
  cf,              ///< cells with bounds as in the CF conventions, or of OASIS, NetCDF, read only
};

/// The order of the vertices around a cell, verticesOnCell, relative to its edges, edgesOnCell, in
/// MPAS files. Both lists run counter-clockwise. Models differ: see models().
enum class VertexOrder {
  after_edges,  ///< edge k lies between vertices k - 1 and k, as MPAS-Tools writes it
  before_edges, ///< edge k lies between vertices k and k + 1
};

/// The properties of a format.
struct FormatInfo {
  Format format = Format::by_name; ///< never by_name
  /// The name in the option --format, such as "ugrid-triangles"; empty where the format is read
  /// only.
  std::string word;
  /// Names that select it: suffixes such as ".exo", or whole names such as "nod2d.out".
  std::vector<std::string> names;
  std::string title;  ///< such as "UGRID of triangles"
  bool cells = false; ///< it stores Voronoi cells, and needs a closed mesh or a domain of the plane
  bool netcdf = false; ///< NetCDF, classic or HDF5
  bool read = true;    ///< read_mesh() reads it
  bool points = true;  ///< it stores the points; else read_mesh() needs them
};

/// Options of write(). No option changes the geometry of the mesh.
struct WriteOptions {
  Format format = Format::by_name; ///< must agree with the file name, see format_of()
  Numbering numbering =
      Numbering::by_format; ///< of the cells; a plane supports by_format and input
  /// Radius of the sphere in NetCDF files, in the file's unit of length (MPAS: metres); > 0 and
  /// finite; default 1. find_model() gives the value that a model expects. A plane and the other
  /// formats store the points unchanged.
  double sphere_radius = 1;
  /// Radius of the planet that the mesh is of, metres; > 0 and finite. NetCDF files on the unit
  /// sphere name it, as the attribute planet_radius, see MeshFile. Default: none, no attribute.
  std::optional<double> planet_radius = {};
  /// The order of verticesOnCell in complete MPAS files. Default: none, which means after_edges, or
  /// before_edges for a limited area.
  std::optional<VertexOrder> vertex_order = {};
  /// Density of the mesh, for fields such as meshDensity and nominalMinDc; in a plane its values at
  /// the sites. Default: uniform.
  Density density = {};
  /// n values >= 0, one of them positive, by site; they replace `density`. Default: none.
  DoubleVector site_density = {};
  /// Fields of the mesh, in its order. NetCDF formats store fields at cells, all but SCRIP at
  /// vertices, full MPAS at edges. VTK stores fields at cells and vertices, GeoJSON those at cells,
  /// with one number for each. SCHISM, ADCIRC and SMS take one at cells named depth for
  /// `site_depth`, and these and Gmsh one named open, which is above 0 there, for `open_sites`, as
  /// their readers give them. Other formats have none. A field that the format cannot store is
  /// refused, and so is one with the name of something that it has of its own, such as areaCell. In
  /// names, NetCDF formats replace characters other than letters, digits and _.+-@ by _. Default:
  /// none.
  std::vector<MeshField> fields = {};
  /// Dimensions of complete MPAS files besides those of the mesh and of fields: some models look
  /// for them, see models(). Default: none.
  std::vector<FieldDimension> dimensions = {};
  /// FESOM's aux3d.out beside nod2d.out: the bounds of the layers, metres, 0 first and falling or
  /// rising from there, at least 3; `site_depth` is of either sign then.
  /// Default: empty, no such file.
  DoubleVector depth_levels = {};
  /// n depths of the bottom by site, metres: see `depth_levels`; for schism, adcirc and sms
  /// positive below the surface of the sea, finite. Default: none, which these three formats write
  /// as 0.
  DoubleVector site_depth = {};
  /// Sites of the open boundary, in any order: see boundary_sites(). An outer edge between two of
  /// them is open. All others are land, of the mainland or of an island. For gmsh, schism, adcirc
  /// and sms; sites inside the mesh have no effect. Default: none.
  Ids open_sites = {};
  /// How the mesh was made, one fact a line; the attribute `history` of NetCDF files. Default:
  /// empty, no attribute.
  std::string history = {};
  /// Stages: number (on the sphere), write. A cancelled run leaves no file. Default: none.
  ProgressCallback progress = {};
};

/// Writes a mesh. The file name selects the format:
///
/// - .nc: mpas;
/// - .vtp, .vtu, .off, .ply, .msh, .geojson: the format of that name;
/// - .g, .exo: exodus;
/// - nod2d.out: fesom;
/// - .gr3, .ll: schism;
/// - .14, as in fort.14: adcirc;
/// - .2dm: sms;
/// - .txt, .tri: triangles. The ids are columns of the input of the triangulation, so that the file
///   belongs to the points that were triangulated. A site with duplicates has the id of its lowest
///   column;
/// - a name that starts with SaveVertices: mpi_scvt. The rest of the name is also that of
///   SaveTriangles and SaveDensity beside it.
///
/// On the sphere formats of cells require a closed mesh, or one of a part of the sphere, of which
/// they have the coastal_cells(). Coordinates in NetCDF files are
/// sphere_radius times the unit vectors; a point whose norm equals that radius up to rounding keeps
/// its bits.
///
/// A mesh of the plane keeps the order of its sites. All planes support triangles; one with a
/// period mpas and mpas_minimal; others vtp, vtu, off, ply, msh and gmsh, at z = 0; and a part of
/// the plane, which clips the cells, mpas, ugrid, vtp_cells, vtu_cells and geojson. An MPAS file
/// has the boundary that voronoi() describes, with 0 for what is missing. NetCDF files call the
/// unit of the points metre, GeoJSON has x and y instead of longitude and latitude. Fields at
/// vertices are not written to formats of clipped cells, whose corners are not those of the
/// triangles. \param mesh as delaunay() or read_mesh() returns it: on the sphere columns of any
/// norm,
///        triangles counter-clockwise seen from outside.
/// \throws Error invalid_argument for an unknown suffix, a format that does not support the mesh, a
///         radius out of range, an ill-formed density, or ids out of range; in the plane for
///         Numbering::curve, and as voronoi(); for a field that the format cannot store; all before
///         any file is written;
///         not_finite or zero_vector as renumbered(); cancelled; file.
void write(const std::string& path, const Mesh& mesh, const WriteOptions& options = {});

/// The same for a mesh that the function may move, with less memory: MPAS formats reuse the mesh's
/// arrays and free each after its last use. The mesh is empty afterwards. If the function throws,
/// the mesh is unchanged or empty.
void write(const std::string& path, Mesh&& mesh, const WriteOptions& options = {});

/// The format in which `write` writes a path: the option, or for by_name the format of the name.
/// The case of a suffix does not matter. An option other than mpi_scvt may have a name of unknown
/// suffix.
/// \throws Error invalid_argument if by_name meets an unknown suffix; for legacy VTK (.vtk); if the
///         option contradicts a known suffix, because readers go by the name (.nc has the NetCDF
///         formats, .vtp has vtp and vtp_cells, .vtu has vtu and vtu_cells); for mpi_scvt under
///         another name.
Format format_of(const std::string& path, Format option = Format::by_name);

/// Requires a format that stores fields. \throws Error invalid_argument, naming those that do; as
/// format_of().
void require_field_format(const std::string& path, Format option = Format::by_name);

/// All formats but by_name.
const std::vector<FormatInfo>& formats();

/// The properties of one format. \pre not by_name.
const FormatInfo& info_of(Format format);

/// A model, the options of write() that suit it, and its demands on grids.
struct ModelNeeds {
  std::string word;         ///< such as "mpas-ocean"
  std::string name;         ///< such as "MPAS-Ocean"
  Format format;            ///< of its files
  double sphere_radius = 1; ///< of its files
  double planet_radius = 0; ///< of the planet that it computes, metres
  /// Whether it uses lengths unchanged, in metres, so that other radii of a planet suit it, too.
  bool any_planet = false;
  Numbering numbering = Numbering::by_format;          ///< of the cells
  VertexOrder vertex_order = VertexOrder::after_edges; ///< of MPAS files
  std::vector<FieldDimension> dimensions = {};         ///< besides those of the mesh
  GridDemands demands = {};                            ///< see gates()
};

/// All models:
///
/// - MPAS-Atmosphere: the unit sphere. Its initialisation multiplies lengths by the radius of the
///   Earth (mpas_init_atm_static.F), whatever their unit. Its deformation weights take edge k of a
///   cell between vertices k and k + 1 (mpas_atm_advection.F).
/// - MPAS-Ocean: metres, which it takes as they are. 6371220 m is SHR_CONST_REARTH of E3SM, with
///   which MPAS-Tools makes its meshes.
/// - MPAS' shallow-water core: the unit sphere (mpas_sw_test_cases.F), and the dimensions
///   nVertLevels and nTracers, which it reads from the file.
/// - FESOM: the triangles, nod2d.out and elem2d.out.
///
/// The demands of the MPAS models are: five sides at least; Voronoi edges of short_voronoi_edge or
/// more; widths that double within six cells or more, so that they change by 2^(1/6) - 1 from one
/// cell to the next. MPAS-Atmosphere stores 15 cells that advect (FIFTEEN in its Registry.xml), and
/// often has coordinates of 32 bits. Its flow is at most 125 m/s, its waves are sound of 340 m/s;
/// those of the others are gravity waves of 11 km, 330 m/s. FESOM has no demands here.
const std::vector<ModelNeeds>& models();

/// The model of that word; null if there is none.
const ModelNeeds* find_model(std::string_view word);

/// Whether a model reads a file of a mesh of the sphere that write() makes with these options.
/// \param format not by_name.
bool suits(const ModelNeeds& model, Format format, double sphere_radius, VertexOrder vertex_order,
           const std::vector<FieldDimension>& dimensions = {});

/// Compares a grid with the demands of a model, see gates(voronoi, demands, radius, mask).
/// \param planet_radius of the grid, metres, which a model of any planet takes; others have theirs.
std::vector<Gate> gates(const Voronoi& voronoi, const ModelNeeds& model,
                        std::optional<double> planet_radius = {}, const Ids& mask = {});

} // namespace calotte
CALOTTE_API_END
