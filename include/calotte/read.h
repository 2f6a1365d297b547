// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cell_width.h>
#include <calotte/domain.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/planar_raster.h>
#include <calotte/types.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

/// Readers. Error messages name the file and, where there is one, the 1-based line.
CALOTTE_API_BEGIN
namespace calotte {

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
/// \throws Error bad_option, parse, file; of a planar mesh (all z are 0) bad_option; of sites
///         that spherical_delaunay() refuses, its code.
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

/// The bytes of a file. \throws Error file.
std::string read_file(const std::string& path);

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

/// Cell widths from a file, by its suffix:
///
/// .nc (NetCDF): the variable cellWidth(lat, lon) in km, with the coordinate variables lat and lon
/// in degrees, one of them for each of its dimensions. Latitudes may descend; longitudes may be any
/// 360 degrees, with the first meridian repeated at the end or not. Both must cover the sphere: no
/// gap wider than 1.5 times the widest step.
///
/// .msh (JIGSAW): an ellipsoid-grid, its longitudes and latitudes in radians, values by columns of
/// latitudes; or a mesh (ellipsoid-mesh of longitude and latitude in radians, euclidean-mesh of
/// x y z about the sphere's centre) with a value at each point. A mesh's values are interpolated on
/// the Delaunay triangles of its points and sampled with half the points' least common spacing (but
/// from 0.05 to 1 degree).
///
/// .geojson, .json: Polygon and MultiPolygon geometries, alone or in features or collections. An
/// edge is straight in longitude and latitude (RFC 7946, Sect. 3.1.1), runs the shorter way round,
/// and once round the Earth where its longitudes differ by 360. A ring encloses what it cuts off
/// from both poles; one that runs round the Earth encloses the smaller side. Its orientation does
/// not matter. Rings after the first are holes. Inside, a feature's width holds: its property
/// "cellWidth", or `inside`. Outside, the distance to the boundary along great circles leads to
/// `outside`; edges with polygons of the same width on both sides, as cuts at a meridian leave
/// them, are no boundary. Where features or their surroundings overlap, the least width holds. The
/// widths are sampled at a sixteenth of the transition (but from 0.05 to 1 degree).
///
/// \param polygons of GeoJSON alone.
/// \throws Error bad_option for another suffix, a polygon width that is missing or not positive;
///         parse, naming the variable and its index, the line or the feature; file.
CellWidth read_cell_width(const std::string& path, const PolygonWidths& polygons = {});

/// As read_cell_width of a NetCDF file, from a variable density(lat, lon): widths rho^(-1/4), over
/// the least of them. They know ratios only: no number of cells follows from them.
CellWidth read_density_raster(const std::string& path);

/// From a NetCDF file: the variable density(y, x), with the coordinate variables x(x) and y(y),
/// either of which may descend.
/// \throws Error parse, naming the variable and its index; file.
PlanarRaster read_planar_raster(const std::string& path);

} // namespace calotte
CALOTTE_API_END
