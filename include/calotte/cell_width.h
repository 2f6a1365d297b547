// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/surface.h>
#include <calotte/types.h>

#include <cstdint>

CALOTTE_API_BEGIN
namespace calotte {

/// Prescribed cell widths (distances between the centres of neighbouring cells) at the nodes of a
/// grid of longitudes and latitudes, which may be irregular. Between nodes the width is bilinear in
/// longitude and latitude, periodic in longitude. Between the first or last latitude and the pole
/// it is linear; the value at the pole is the mean of that row. The field is continuous on the
/// whole sphere.
struct CellWidth {
  DoubleVector
      longitudes; ///< nx >= 2 degrees, ascending by 1e-9 at least, the last below the first + 360
  DoubleVector latitudes; ///< ny >= 2 degrees, ascending likewise, within -90 to 90
  DoubleMatrix widths;    ///< nx x ny, > 0 and finite, in km; max / min at most 1e30
};

/// The radius of the Earth in km, the default of the functions below.
inline constexpr double earth_radius_km = 6371;

/// The density rho = (h_min/h)^4, where h is the interpolated width and h_min its minimum over the
/// nodes. A CVT for this density has spacings proportional to h (Ju, Ringler and Gunzburger, 2011).
/// The result is a callable that returns the same bits for any number of threads and on every
/// x86-64 machine.
/// \throws Error invalid_argument if shapes, coordinates or widths violate the conditions of
/// CellWidth.
Density density_of(const CellWidth& cell_width);

/// The widths in km at n points.
/// \param points 3 x n unit columns.
/// \throws Error as density_of; invalid_argument unless the points have 3 rows.
DoubleVector evaluate(const CellWidth& cell_width, const PointsRef& points);

/// The number of cells that the widths h imply: the integral of 2/(sqrt(3) h^2) over the sphere. A
/// regular hexagon of width h has the area sqrt(3)/2 h^2.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \throws Error as density_of; invalid_argument for a radius out of range.
double implied_cells(const CellWidth& cell_width, double radius_km = earth_radius_km);

/// The same integral over the sphere or a region of it; over a region within about 0.2%, as a mean
/// over 2^18 random points.
/// \throws Error as above; invalid_argument for a plane.
double implied_cells(const CellWidth& cell_width, const Surface& surface,
                     double radius_km = earth_radius_km);

/// Throws unless the nodes cover the sphere, or a region of it: at its boundary the nearest nodes
/// are at most half of the widest step away, between the last longitude and the first one and
/// beyond the outer latitudes at most 1.5 of it.
/// \throws Error invalid_argument, naming the extent of the nodes and a point of the region
///         outside; for a plane.
void require_covering(const CellWidth& cell_width, const Surface& surface = {});

/// The gradient of the cell width at one location.
struct Gradient {
  double slope = 0;     ///< |grad h|, km per km
  double longitude = 0; ///< degrees, from -180 to below 180
  double latitude = 0;  ///< degrees
};

/// The largest gradient of cell widths that most models accept, km per km.
inline constexpr double steepest_width = 0.03;
/// Whether one is larger by more than what the scale of a run's number of cells rounds.
inline bool is_too_steep(double slope) { return slope > 1.005 * steepest_width; }

/// The largest |grad h| that cells see: the largest mean of the gradient over a square of the width
/// h in the corner of a box between nodes, or over the box if that is smaller. (At a node the
/// gradient of the interpolated field itself may be sqrt(2) times that of the widths that were
/// sampled.) Most models need a value below steepest_width.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \throws Error as density_of; invalid_argument for a radius out of range.
Gradient largest_gradient(const CellWidth& cell_width, double radius_km = earth_radius_km);

/// The largest widths that are nowhere above the given ones, and change by at most g km per km
/// between any two nodes: the least of h(y) + g d(x, y) over all nodes y, with the distance d on
/// the sphere. Where a node lowers none of
/// its neighbours, but one beyond, the way from it may be longer by some hundredths of a step of
/// the raster. The result has the same bits for any number of threads.
///
/// \param gradient g, km per km, > 0 and finite.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \throws Error as density_of; invalid_argument for a gradient or a radius out of range.
CellWidth limit_gradient(const CellWidth& cell_width, double gradient,
                         double radius_km = earth_radius_km);

/// Widths for the polygons of a GeoJSON file, all in km, see read_cell_width(). A width of 0, the
/// default, is taken from the file; other values override the file. Valid values are >= 0 and
/// finite.
struct PolygonWidths {
  /// Width inside features that have no property "cellWidth"; in the file "insideWidth". Required
  /// if there is such a feature.
  double inside = 0;
  double outside = 0; ///< width far from all features; in the file "outsideWidth"; required
  /// Distance from the boundary outwards over which the width changes from `inside` to `outside` by
  /// a cubic with horizontal ends; in the file "transition". Required; at least 0.2 degrees of a
  /// great circle, about 22.2 km on the Earth.
  double transition = 0;
  double radius_km = earth_radius_km; ///< radius of the sphere, > 0 and finite
};

} // namespace calotte
CALOTTE_API_END
