// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>

#include <Eigen/Core>

#include <cstdint>

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

/// The Earth's radius, the default of the functions below.
inline constexpr double earth_radius_km = 6371;

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
/// \param radius_km of the sphere, > 0. \throws Error as density_of.
double implied_cells(const CellWidth& cell_width, double radius_km = earth_radius_km);

/// How steep widths are at a place in degrees. km per km: a tenth of 0.3 says that a neighbour 10
/// km away may be 0.3 km wider.
struct Gradient {
  double slope = 0;
  double longitude = 0, latitude = 0;
};

/// The largest |grad h| of the interpolated field, found exactly: it lies at a corner of a box of
/// the grid. Models want it below about 0.03. \throws Error as density_of.
Gradient largest_gradient(const CellWidth& cell_width, double radius_km = earth_radius_km);

/// Widths for the polygons of a GeoJSON file, in km; 0: the file says it.
struct PolygonWidths {
  double inside = 0;  ///< of features without a property "cellWidth" (the file's "insideWidth")
  double outside = 0; ///< far from all of them (the file's "outsideWidth")
  /// Over this distance from the boundary outwards the width changes from `inside` to `outside`, by
  /// a cubic with horizontal ends (the file's "transition").
  double transition = 0;
  double radius_km = earth_radius_km; ///< of the sphere, > 0
};

} // namespace calotte
CALOTTE_API_END
