// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>

#include <Eigen/Core>

#include <cstdint>
#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// How wide cells shall be (the distance of neighbours' centres), on a grid of longitudes and
/// latitudes that need not be regular. Between nodes widths are bilinear in longitude and latitude;
/// after the last longitude comes the first. From the first and last latitudes to the poles they
/// lead to one value there, the mean of the row: the field is continuous on the whole sphere.
struct CellWidth {
  Eigen::VectorXd longitudes; ///< nx >= 2 degrees, ascending, the last below the first + 360
  Eigen::VectorXd latitudes;  ///< ny >= 2 degrees, ascending, from -90 to 90
  Eigen::MatrixXd widths;     ///< nx x ny, > 0 and finite, in km
};

/// The radius in km that widths are measured on where nobody says otherwise: the Earth's.
inline constexpr double earth_radius = 6371;

/// rho = (h_min/h)^4, h the width interpolated and h_min the least of the nodes: a CVT of this
/// density has spacings that are proportional to h. (Ju, Ringler and Gunzburger, 2011.) A callable,
/// which gives the same bits for any threads and on every x86-64 machine.
/// \throws Error bad_option where shapes, coordinates or widths are not as CellWidth says.
Density density_of(const CellWidth& cell_width);

/// The widths in km at n unit columns.
/// \param points 3 x n.
/// \throws Error as density_of; bad_option unless the points have 3 rows.
Eigen::VectorXd evaluate(const CellWidth& cell_width, const PointsRef& points);

/// How many cells the widths h ask for: the integral of 2/(sqrt(3) h^2) over the sphere, as a
/// regular hexagon whose neighbours are h away has the area sqrt(3)/2 h^2.
/// \param radius of the sphere in km. \throws Error as density_of.
double implied_cells(const CellWidth& cell_width, double radius = earth_radius);

/// How steep widths are at a place in degrees. km per km: a tenth of 0.3 says that a neighbour 10
/// km away may be 0.3 km wider.
struct Gradient {
  double slope = 0;
  double longitude = 0, latitude = 0;
};

/// The largest |grad h| of the interpolated field, found exactly: it lies at a corner of a box of
/// the grid. Models want it below about 0.03. \throws Error as density_of.
Gradient largest_gradient(const CellWidth& cell_width, double radius = earth_radius);

/// Of the polygons of a GeoJSON file, in km; 0 where the file says it.
struct PolygonWidths {
  double inside = 0;  ///< of features without a property "cellWidth" (the file's "insideWidth")
  double outside = 0; ///< far from them all ("outsideWidth")
  /// From the boundary outwards, over that distance, the width goes from one to the other by a
  /// cubic with horizontal ends ("transition").
  double transition = 0;
  double radius = earth_radius; ///< of the sphere, > 0
};

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

} // namespace calotte
CALOTTE_API_END
