// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/domain.h>
#include <calotte/export.h>
#include <calotte/renumber.h>
#include <calotte/types.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// Every file is written beside its place, brought to the disk, and renamed when whole: it is there
/// as a whole or not at all. Messages name the file and, where there is one, the 1-based line.

enum class Columns {
  xyz,    ///< x y z: a direction of any norm but 0
  lonlat, ///< longitude (any) and latitude (-90 to 90), in degrees, become unit columns
};

/// Points as text, one a line: three numbers, or two with Columns::lonlat. Blanks or tabs, and at
/// most one of comma, semicolon and bar, separate them; `#` starts a comment; blank lines count for
/// nothing; one header line (it holds no number) may precede the points; further columns are
/// ignored. Lines end in LF, CRLF or CR; a missing final newline loses nothing.
///
/// Longitude and latitude are exact at multiples of 90 degrees, and the same bits on every machine:
/// longitudes that differ by 360 are one place, and so are all longitudes at a pole.
/// \param name stands for the stream in messages.
/// \param lines if not null, the 1-based line of each column.
/// \throws Error parse (index() is the 1-based line): text that is no number, NaN, infinite or the
///         zero vector; too few columns; a latitude out of range; no points at all. Error file.
Points3 read_points(std::istream& in, const std::string& name, Columns columns = Columns::xyz,
                    std::vector<std::int64_t>* lines = nullptr);
Points3 read_points(const std::string& path, Columns columns = Columns::xyz,
                    std::vector<std::int64_t>* lines = nullptr);

/// The same for places in the plane: x y a line. \throws Error as above.
Points2 read_planar_points(std::istream& in, const std::string& name,
                           std::vector<std::int64_t>* lines = nullptr);
Points2 read_planar_points(const std::string& path, std::vector<std::int64_t>* lines = nullptr);

/// A domain of the plane, ready for require_domain(), by the file's name:
///
/// .geojson, .json: Polygon and MultiPolygon geometries, alone or in features or collections, all
/// of them one domain. Positions are taken as x and y, in any unit; a third coordinate is ignored.
///
/// Else text: a corner x y a line, in the order of the ring, as read_planar_points has lines; a
/// blank line, or one that starts with `>` (as in GMT's files of many segments), ends a ring.
///
/// A ring may repeat its first corner at its end.
/// \throws Error parse, naming the line, or the feature and its ring; as require_domain(), with
///         the file's name; file.
PlanarDomain read_domain(const std::string& path);

/// x y z a line, or x y of places in a plane, with the fewest digits (17 at most) that read back to
/// the same bits.
/// \param points 3 x n, or 2 x n.
/// \throws Error bad_option for another number of rows, before any file is touched; file.
void write_points(const std::string& path, const PointsRef& points);
void write_points(std::ostream& out, const PointsRef& points);

enum class Format {
  by_name,         ///< of the path, see write
  mpas,            ///< full MPAS mesh, NetCDF; NAME.graph.info, as METIS reads it, beside NAME.nc
  mpas_minimal,    ///< what MPAS's MpasMeshConverter.x reads, NetCDF
  ugrid,           ///< UGRID of the Voronoi cells, NetCDF
  ugrid_triangles, ///< UGRID of the Delaunay triangles, NetCDF
  scrip,           ///< SCRIP of the cells, NetCDF
  esmf,            ///< ESMF unstructured of the cells, NetCDF
  vtp,             ///< VTK PolyData of the triangles, CellFields at the sites
  vtu,             ///< VTK UnstructuredGrid of the same
  vtp_cells,       ///< VTK PolyData of the Voronoi cells with their CellFields
  vtu_cells,       ///< VTK UnstructuredGrid of the same
  off,             ///< text, digits as write_points
  ply,             ///< binary doubles
  triangles,       ///< 0-based `i j k` a line
  mpi_scvt,        ///< SaveVertices, and SaveTriangles and SaveDensity beside it
  msh,             ///< JIGSAW
  geojson,         ///< the cells as polygons with their CellFields
};

struct WriteOptions {
  Format format = Format::by_name;
  Numbering numbering = Numbering::by_format;
  /// Of the sphere, in the file's unit of length (MPAS: metres): > 0. NetCDF formats; others hold
  /// the points as given.
  double sphere_radius = 1;
  /// What the mesh was made for: of the fields meshDensity and nominalMinDc, and the like.
  Density density = {};
  std::string history =
      {}; ///< one line a fact: how the mesh was made; an attribute of NetCDF files
};

/// Writes a mesh. By its name the format is that of
///   .nc          mpas
///   .vtp .vtu .off .ply .msh .geojson
///   .txt .tri    triangles: the ids are columns of the input of the triangulation, so that the
///   file goes
///                with the points it was made from: a merged duplicate goes by its site's lowest
///                column
///   SaveVertices mpi_scvt; the rest of the name, if any, is that of the files beside it, too
/// Formats of cells, and the fields of the others, need a closed mesh.
/// Places of NetCDF files are sphere_radius times the unit vectors; a point whose norm is that
/// radius but for rounding keeps its bits.
/// \throws Error bad_option for an unknown suffix, a radius out of range, an ill-formed density,
///         ids that are not the mesh's, an open mesh where cells are asked for: before any file is
///         touched; file.
void write(const std::string& path, const Mesh& mesh, const WriteOptions& options = {});

/// A plane, numbered as it is. Periodic: mpas, mpas_minimal and triangles. Not periodic: triangles,
/// and the streams vtp, vtu, off, ply and msh with z = 0.
void write(const std::string& path, const PlanarMesh& mesh, const WriteOptions& options = {});

/// The format that `write` gives a path: the option's, or else that of its name.
/// \throws Error bad_option for a name that says none; for an option that is not that of the name's
///         suffix (a NetCDF format of .nc; vtp and vtp_cells of .vtp, and so on), as nobody could
///         read the file; for mpi_scvt under another name.
Format format_of(const std::string& path, Format option = Format::by_name);

/// Whether the format's files hold Voronoi cells, so that it needs a closed mesh.
bool holds_cells(Format format);

/// \throws Error bad_option when `write` has no planar mesh, or no periodic one, of that format.
void require_planar_format(const std::string& path, bool periodic, Format format);

/// \throws Error bad_option when `write` does not know the path's suffix.
void require_mesh_suffix(const std::string& path);

/// Reads a mesh that `write` wrote, of any format, and those of their kind that others wrote. By
/// name as `write`, except that a NetCDF file's contents tell which of these it is, and that it is
/// one where its name says nothing. Coordinates come back bit for bit where the format holds them.
/// Formats without triangles of the sites (scrip, esmf, geojson, and cells of UGRID that others
/// wrote) and files of points alone give the sites' Delaunay triangulation, in which equal
/// directions are one site; so does SaveVertices without a SaveTriangles beside it that closes the
/// sphere. Ids are checked to be in range, geometry is not: check() proves it. Neighbours are
/// rebuilt; an edge of three triangles, or of two that run through it the same way, stays open.
/// \param points the columns that a .txt/.tri file refers to; not used otherwise. A column in no
///        triangle is the duplicate of one that has the same direction, or else stays as a site
///        without triangles.
/// \throws Error bad_option, parse, file; of a planar mesh (all z are 0) bad_option; of sites that
/// spherical_delaunay()
///         refuses, its code.
Mesh read_mesh(const std::string& path, const Points3* points = nullptr);

/// The points of such a file, without a look at its triangles: the generators of an MPAS or UGRID
/// mesh, the nodes of another's UGRID, SaveVertices, .msh; and MPI-SCVT's centres of regions, which
/// RegionList holds, and RegionTriangulation by the RegionList beside it. (read_mesh triangulates
/// these.)
/// \throws Error as read_mesh.
Points3 read_sites(const std::string& path);

/// A mesh of the plane: a periodic one from an MPAS file (.nc); others from all that
/// write(path, PlanarMesh) writes, and JIGSAW's of NDIMS=2. Without triangles, the points are
/// triangulated.
/// \param points as read_mesh's. \throws Error as read_mesh; bad_option of a sphere's mesh, one
/// with a z that is not 0.
PlanarMesh read_planar_mesh(const std::string& path, const Points2* points = nullptr);

/// A variable of a NetCDF file with one number for each cell.
struct CellField {
  Eigen::VectorXd values;       ///< NaN where the file has its _FillValue
  std::string long_name, units; ///< the variable's attributes, or empty
};

/// Reads a variable whose one dimension, or the last after some of size 1, has the size `cells`.
/// \param cells the columns of read_sites: cells of MPAS and UGRID files, nodes of UGRID triangles.
/// \throws Error bad_option where the file has no such variable (names those there are); parse,
///         file.
CellField read_cell_field(const std::string& path, const std::string& name, std::int64_t cells);

/// A checkpoint: a run's state as binary, with the configuration that it belongs to in words of the
/// caller's choice. A file that was cut short or damaged is refused, and so is another version's.
/// \throws Error file.
void write_checkpoint(const std::string& path, const CvtState& state,
                      const std::string& configuration);
/// \throws Error file, parse, bad_option (of another configuration).
CvtState read_checkpoint(const std::string& path, const std::string& configuration);

/// The bytes of a file. \throws Error file.
std::string read_file(const std::string& path);

/// Writes bytes in the way of all files here.
/// \throws Error file.
void write_file(const std::string& path, std::string_view bytes);

} // namespace calotte
CALOTTE_API_END
