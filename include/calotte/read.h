// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/ocean.h>
#include <calotte/raster.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

/// Readers. Error messages name the file and, in text formats, the 1-based line, which is also
/// index(). The case of a suffix does not matter.
CALOTTE_API_BEGIN
namespace calotte {

/// The contents of the columns of a text file of points.
enum class Columns {
  xyz,    ///< x y z: a direction of any norm but 0; the default
  lonlat, ///< longitude (any) and latitude (-90 to 90), in degrees, become unit columns
  xy,     ///< x y of the plane, in any unit; z becomes 0
};

/// Reads points as text, one on each line: three numbers, or two with Columns::lonlat and
/// Columns::xy. The result is 3 x n. Blanks or tabs, and at most one of comma, semicolon and bar,
/// separate them, but not within double quotes; `#` starts a comment; blank lines are ignored; one
/// header line may precede the points, which names the coordinates or has no numbers.
/// A header that names lon or longitude and lat or latitude, or x, y and z, tells which columns are
/// read; without one the first are, and further ones are ignored. Lines end in LF, CRLF or CR; a
/// missing final newline loses nothing.
///
/// Longitude and latitude are exact at multiples of 90 degrees and give the same bits on every
/// machine. Longitudes that differ by 360 give the same point, and so do all longitudes at a pole.
/// \param name the name of the stream in messages.
/// \throws Error parse (index() is the 1-based line) for text that is not a number, NaN, infinity,
///         a decimal comma or the zero vector, too few columns, a latitude out of range, a header
///         that names longitude and latitude, or x and y, where x y z are read, of more columns
///         without a header a first one that counts the lines or is no longitude from -360 to 360,
///         or a file without points; file.
Points3 read_points(std::istream& in, const std::string& name, Columns columns = Columns::xyz);
/// The same from a file.
Points3 read_points(const std::string& path, Columns columns = Columns::xyz);

/// Points of a text, and their lines.
struct PointLines {
  Points3 points;                  ///< as of read_points()
  std::vector<std::int64_t> lines; ///< for each column its 1-based line
  /// Whether the first line has more columns than are read, and no header names these.
  bool further_columns = false;
};

/// Does what read_points() does, and returns the lines, for messages about a point.
PointLines read_point_lines(std::istream& in, const std::string& name,
                            Columns columns = Columns::xyz);
/// The same from a file.
PointLines read_point_lines(const std::string& path, Columns columns = Columns::xyz);

/// Reads a planar domain. The suffix selects the format:
///
/// .geojson, .json, of the sphere: Polygon and MultiPolygon geometries, alone or in features or
/// collections, all of them one domain. Positions are taken as x and y, in any unit; a third
/// coordinate is ignored.
///
/// .shp: the polygons of a shapefile, with its index .shx beside it.
///
/// .msh: the closed rings of edges of JIGSAW's euclidean-mesh with NDIMS=2.
///
/// Other suffixes: text with a corner x y on each line, in the order of the ring, in the syntax of
/// read_points() with Columns::xy. A blank line, or a line that starts with `>` (as in GMT's
/// multi-segment files), ends a ring.
///
/// A ring may repeat its first corner at its end.
/// \throws Error parse, naming the line, or the feature and its ring; as Surface::within(), with
///         the file's name; file.
Surface read_domain(const std::string& path);

/// A region of the sphere by a word: a shape and its values, or the name of a file. Longitudes and
/// latitudes are degrees; lengths have a unit, km, m or deg.
///
///     circle=LON,LAT,RADIUS                 circle()
///     ellipse=LON,LAT,MAJOR,MINOR,BEARING   ellipse(); the bearing in degrees from north
///     box=WEST,SOUTH,EAST,NORTH             box()
///     channel=LOWER,UPPER                   channel()
///     land=FILE,LON,LAT                     land_around() of read_coast()
///
/// The name of a file selects its format. An edge is the shorter arc of a great
/// circle between two corners; a parallel needs corners at short intervals. Rings may run either
/// way, be closed and be cut at a meridian, as for enclosed_region().
///
/// .geojson, .json, of the sphere: Polygon and MultiPolygon geometries, alone or in features or
/// collections, in longitude (any, the edge takes the shorter way) and latitude in degrees; all of
/// them are one region. An outer ring encloses its polygon, and a hole what is left out of it, by
/// the rule of enclosed_region() whichever way they run. If a feature names a point inside by the
/// property "inside": [longitude, latitude], its rings enclose the side that contains the point.
///
/// .shp: the polygons of a shapefile, with its index .shx beside it, in longitude and latitude by
/// its .prj.
///
/// .pts: a point file of MPAS-Limited-Area, of the type custom, circle, ellipse or channel.
/// Circles, ellipses and channels have 360 corners; metres are those of a sphere of radius 6371229
/// m. A custom polygon may run either way: its inside is the side of the line Point. The case of
/// keywords does not matter.
/// \param radius_km radius of the sphere to which lengths in km and m refer.
/// \throws Error invalid_argument for a word of another shape or other values, naming what they
///         are; as the functions of the shapes; parse, naming the line, or the feature and its
///         ring; as Surface::within(), with the file's name; invalid_argument for an unknown
///         suffix; file.
Surface read_region(const std::string& word, double radius_km = earth_radius_km);

/// The region of a file, from a stream.
/// \param name the name of the stream in messages, which selects the format.
Surface read_region(std::istream& in, const std::string& name);

/// Reads a mesh in any format that `write` supports, also from other programs. The surface is the
/// sphere, or a plane if an MPAS file says so, a JIGSAW file has NDIMS=2, or z is 0 at all of three
/// or more points. Of a plane, a mesh that is periodic in one direction, or has land in a box, has
/// the triangles of three cells each, and the sites of cells that a boundary clips are
/// triangulated; read_mesh_file() reads the cells, too. The name selects the format as in `write`.
/// A file of suffix .nc, or a NetCDF file of unknown suffix, has the format of its content.
/// Coordinates keep their bits if the format stores them. Formats without triangles of the sites
/// (scrip, esmf, geojson, and cells of UGRID that others wrote) and files of points alone give the
/// sites' Delaunay triangulation, in which equal directions are one site; so does SaveVertices
/// without a SaveTriangles beside it that closes the sphere. The function checks that ids are in
/// range; check() proves the geometry. Neighbours are rebuilt. An edge of three triangles, or of
/// two that run through it in the same direction, stays open.
///
/// Of NetCDF files that this library does not write, ICON's grids are read, cells with bounds as in
/// the CF conventions (longitudes and latitudes with three corners or more for each cell), and the
/// one grid of an OASIS file. Corners that are _FillValue or missing_value pad a cell. A .msh file
/// is JIGSAW's, or the text of Gmsh's formats 2 and 4, whose triangles are read.
///
/// VTK files are XML (.vtp, .vtu: PolyData or UnstructuredGrid; text, base64 or appended; also
/// compressed by zlib) or legacy (.vtk: POLYDATA or UNSTRUCTURED_GRID, to version 5.1). PLY files
/// are text or binary. Their triangles are those of the points; a file with other polygons contains
/// cells, and the cell data `site` or `Center` are their centres. Triangle strips, other types of
/// cells, several pieces and other compression are errors.
/// \param points 3 x n, the points that the ids of a .txt or .tri file refer to; other formats
///         ignore them. A column in no triangle is a duplicate of a column of the same direction,
///         or else a site without triangles. Default null.
/// \throws Error invalid_argument for an unknown suffix, or a .txt or .tri file without `points`;
///         parse; file; for sites that delaunay() refuses, its code.
Mesh read_mesh(const std::string& path, const Points3* points = nullptr);

/// Reads the points of such a file of the sphere, 3 x n, and ignores its triangles. In a UGRID file
/// without sites the points are the nodes.
/// \throws Error as read_mesh; invalid_argument for a mesh of the plane.
Points3 read_sites(const std::string& path);

/// Reads areas of land.
///
/// GeoJSON: Polygon and MultiPolygon geometries of longitude and latitude in degrees, alone or in
/// features or collections. The edges are arcs of great circles. Rings enclose their land as those
/// of read_region() do. Polygons may share edges, but not overlap.
///
/// NetCDF: a binned file of GSHHG as GMT reads it, binned_GSHHS_c.nc to binned_GSHHS_f.nc. The land
/// includes lakes, and the ice shelves of Antarctica.
/// \throws Error parse, naming the feature or the variable; file.
Coast read_coast(const std::string& path);

/// Reads areas of land from several files, which must not overlap.
/// \throws Error as read_coast().
Coast read_coasts(const std::vector<std::string>& paths);

/// The quantity of a raster's values.
enum class RasterQuantity {
  any,           ///< as the file has them
  cell_width,    ///< > 0, in km, in a plane in its unit
  density,       ///< > 0, in a plane >= 0
  height,        ///< of topography or bathymetry, metres up; below 0 is sea
  land_fraction, ///< 0 to 1
  sea_fraction   ///< 0 to 1
};

/// The choice of a raster in a file.
struct RasterChoice {
  /// The variable. Default: cellWidth for widths and density for densities, if the file has them;
  /// else its only raster.
  std::string variable = {};
  RasterQuantity quantity = RasterQuantity::any; ///< Default: any.
  /// The sphere, a part of it, or a plane. A raster of a quantity must cover it, see
  /// require_covering(), but a plane without rings and periods. Default: the sphere.
  Surface surface = {};
  /// Points of the sphere that it must cover instead, 3 x n directions. Default: none.
  Points3 points = Points3(3, 0);
};

/// Reads a raster from a NetCDF file: a variable of latitude and longitude, or of y and x of a
/// plane, in any order; other dimensions have the size 1. Packed values are unpacked, missing ones
/// are NaN.
///
/// The axes of the sphere are variables named lat and lon, or latitude and longitude, or with such
/// a standard_name or units, in degrees or radians; those of a plane x and y. Either may descend.
/// Longitudes cover any interval of 360 degrees; the first meridian may be repeated at the end.
///
/// Values are brought to the unit of their quantity by the attribute units, see kilometres_in():
/// widths to km, in a plane to the unit of x where both have units; heights to m; fractions may be
/// in %. Depths, by the attribute positive "down" or a standard_name, become heights. A missing
/// value is an error, except for RasterQuantity::any and for land among depths, which ocean models
/// leave out. Widths of the sphere above 2000 need a unit: they may be metres.
/// \throws Error parse, naming the variable and its index, for a file with several rasters, and for
///         another variable, with the names of those that are there; file.
Raster read_raster(const std::string& path, const RasterChoice& choice = {});

/// Reads fractions of land: those of a file, 1 minus those of the sea, or 1 where a height is not
/// below 0.
/// \param quantity height, land_fraction or sea_fraction.
/// \throws Error as read_raster(); parse, for heights of which none is below 0: they may be depths
///         or fractions.
Raster read_land(const std::string& path, const std::string& variable = {},
                 RasterQuantity quantity = RasterQuantity::height);

/// Reads lines from GeoJSON: LineString and MultiLineString geometries of longitude and latitude in
/// degrees, in a plane of x and y, alone or in features or collections.
/// \param surface the sphere or a plane. Default: the sphere.
/// \returns for each line its points, unit columns, in a plane x y 0.
/// \throws Error parse, naming the feature; file.
std::vector<Points3> read_lines(const std::string& path, const Surface& surface = {});

/// Reads lines for widths by the distance from them. GeoJSON gives lines, see read_lines(), and the
/// coasts of polygons, see read_coast(), which may be in one file; GSHHG gives its coasts; a .txt
/// gives points of longitude and latitude, each a line of its own. In a plane positions are x and
/// y, lines have z = 0, and polygons give their rings.
/// \param surface the sphere or a plane. Default: the sphere.
/// \throws Error as these functions.
std::vector<Points3> read_shapes(const std::string& path, const Surface& surface = {});

/// A variable of a NetCDF file with one number for each cell.
struct CellField {
  DoubleVector values;   ///< NaN where the file has its _FillValue
  std::string long_name; ///< the variable's attribute, or empty
  std::string units;     ///< the variable's attribute, or empty
};

/// Reads a NetCDF variable with a dimension of the size `cells`, the last of several.
/// \param name name of the variable.
/// \param cells number of columns of read_sites(): cells of MPAS and UGRID files, nodes of UGRID
///        triangles.
/// \param choices indices of its other dimensions, see find_indices(); none where these have the
///        size 1.
/// \throws Error invalid_argument if the file has no such variable, naming the variables of that
///         size; as field_at(); for a variable with several numbers for a cell; parse; file.
CellField read_cell_field(const std::string& path, const std::string& name, std::int64_t cells,
                          const std::vector<FieldIndex>& choices = {});

/// A number with a unit.
struct Measure {
  double value = 0; ///< in the unit
  std::string unit; ///< letters, or "" if there are none
};

/// Reads a number and a unit: "60km", "60 km", "60"; nothing for other text, such as a file's name.
std::optional<Measure> measure_of(const std::string& text);

/// The seconds of a time with its unit, s, min, h or d, such as "12.42h".
/// \throws Error invalid_argument for other text, and for a time that is not positive and finite.
double seconds_in(const std::string& text);

/// The kilometres in a unit of length: 1 for km and 0.001 for m, by symbol or by name as UDUNITS
/// spells them (km, kilometer, kilometres, m, meters, metre, ...); 1 for an empty text.
/// \throws Error invalid_argument for any other unit.
double kilometres_in(const std::string& unit);

/// Reads cell widths from a file. The suffix selects the format:
///
/// .nc (NetCDF): the variable cellWidth(lat, lon) or cellWidth(y, x), see read_raster().
///
/// .msh (JIGSAW): an ellipsoid-grid, its longitudes and latitudes in radians, values in km by
/// columns of latitudes; or a mesh (ellipsoid-mesh of longitude and latitude in radians,
/// euclidean-mesh of x y z about the sphere's centre) with a value at each point. The values of a
/// mesh are interpolated linearly on the Delaunay triangles of its points. The sampling interval is
/// half of the spacing that a tenth of the edges are shorter than, from 0.05 to 1 degree. Of a
/// plane: a euclidean-grid, or a euclidean-mesh of NDIMS=2; beyond the points the nearest one's
/// value holds.
///
/// .geojson, .json, of the sphere: Polygon and MultiPolygon geometries, alone or in features or
/// collections. An edge is straight in longitude and latitude (RFC 7946, Sect. 3.1.1), runs the
/// shorter way round, and once round the Earth where its longitudes differ by 360. A ring encloses
/// a side as those of read_region() do, and rings after the first are holes. In a feature the width
/// is its property "cellWidth", or `inside`. Outside, the width approaches `outside` with the
/// great-circle distance to the boundary. An edge between polygons of the same width, such as a cut
/// along a meridian, is not a boundary. Where features or transitions overlap, the smallest width
/// applies. The sampling interval of the widths is a sixteenth of the transition, from 0.05 to 1
/// degree.
///
/// .toml: rules, see read_width_rules(), as sampled() has them on the surface.
///
/// \param polygons widths for GeoJSON; its radius is also that of rules. Other formats ignore them.
/// \param surface the sphere, a part of it or a plane, which the widths must cover; default the
/// sphere. \throws Error invalid_argument for an unknown suffix, rules in a plane of no finite
/// area, a width, transition or radius that is
///         missing or not positive, a transition narrower than 0.2 degrees, or points of a mesh
///         within a hemisphere; parse, naming the variable and its index, the line or the feature;
///         file.
Raster read_cell_width(const std::string& path, const PolygonWidths& polygons = {},
                       const Surface& surface = {});

/// The rules for widths of a file.
struct WidthRules {
  Widths widths = Widths::no_demand;   ///< of the whole file, with its step
  std::optional<double> gradient = {}; ///< limit of the whole file
  std::vector<std::string> names = {}; ///< of the rules that active_rules() numbers
};

/// Reads the table [cell-width] of a TOML file, whose keys the manual's page on cell widths lists.
/// Names of files are relative to its folder.
/// \param surface the sphere, or a plane: the domain in which the gradient of all is limited.
/// \param radius_km of the sphere that widths and distances refer to.
/// \throws Error parse, naming the line and the key; as the readers of the files; in a plane with a
///         limited gradient as sampled().
WidthRules read_width_rules(const std::string& path, const Surface& surface = {},
                            double radius_km = earth_radius_km);

/// The widths of a file of any kind as an expression: rules themselves, others as a raster.
/// \param polygons as for read_cell_width().
/// \param surface as for read_width_rules().
/// \throws Error as read_cell_width(), but for points without a demand.
Widths read_widths(const std::string& path, const PolygonWidths& polygons = {},
                   const Surface& surface = {});

} // namespace calotte
CALOTTE_API_END
