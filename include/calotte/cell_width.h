// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/raster.h>
#include <calotte/surface.h>
#include <calotte/types.h>

#include <cstdint>
#include <memory>

CALOTTE_API_BEGIN
namespace calotte {

/// The radius of the Earth in km, the default of the functions below.
inline constexpr double earth_radius_km = 6371;

/// Cell widths h at nodes that are prepared to be asked for at any place: those of a raster, or of
/// rules, see width_field(). They are distances between the centres of neighbouring cells, here and
/// below in km, in a plane in its unit. A value that is cheap to copy.
class WidthField {
public:
  /// \param widths > 0 and finite, max / min at most 1e30.
  /// \throws Error invalid_argument if they violate these conditions or those of Raster.
  WidthField(const Raster& widths); // NOLINT(google-explicit-constructor): a raster is a field
  /// Of a field of the library itself.
  explicit WidthField(std::shared_ptr<const density_detail::SampledWidths> widths);

  double least() const;       ///< of the nodes
  double greatest() const;    ///< of the nodes
  std::int64_t nodes() const; ///< their number
  /// Of rules: the largest distance of nodes, in widths there. 1, or more where there would be too
  /// many of them.
  double apart() const;
  bool of_plane() const; ///< whether lengths are those of a plane

  /// What copies share.
  const std::shared_ptr<const density_detail::SampledWidths>& sampled() const { return sampled_; }

private:
  std::shared_ptr<const density_detail::SampledWidths> sampled_;
};

/// The widths at n places.
/// \param places 3 x n directions, in a plane 2 x n, or 3 x n with z = 0.
/// \throws Error invalid_argument for another number of rows, and for a direction that is none.
DoubleVector evaluate(const WidthField& widths, const PointsRef& places);

/// The density rho = (h_min/h)^4, where h is the interpolated width and h_min its minimum over the
/// nodes. A CVT for this density has spacings proportional to h (Ju, Ringler and Gunzburger, 2011).
/// It returns the same bits for any number of threads and on every x86-64 machine. Widths of one
/// size give a uniform density.
Density density_of(const WidthField& widths);

/// Relative widths rho^(-1/4), of which the least is 1, of a density at nodes.
/// \throws Error invalid_argument as WidthField.
Raster widths_of_density(const Raster& density);

/// The number of cells that the widths h imply: the integral of 2/(sqrt(3) h^2) over the surface. A
/// regular hexagon of width h has the area sqrt(3)/2 h^2. Over a part of the sphere or the plane
/// within about 0.2%: of a raster as a mean over 2^18 random points, of rules by boxes.
/// \param surface of the kind of the widths; a plane with rings or two periods.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \throws Error invalid_argument for a radius out of range, and for another surface.
double implied_cells(const WidthField& widths, const Surface& surface = {},
                     double radius_km = earth_radius_km);

/// Throws unless the nodes cover the sphere, or a part of it or of the plane. At the boundary of a
/// part the nearest nodes are at most half of the widest step away. On the sphere, between the last
/// longitude and the first one and beyond the outer latitudes at most 1.5 of it.
/// \throws Error invalid_argument, naming the extent of the nodes and what they leave out; for
///         another surface, as for implied_cells().
void require_covering(const Raster& widths, const Surface& surface = {});

/// The gradient of cell widths at one place of the sphere.
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
/// sampled.) Most models need a value below steepest_width. Tiles that lie outside the surface that
/// widths are for do not count.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \throws Error invalid_argument for a radius out of range, and for widths of a plane.
Gradient largest_gradient(const WidthField& widths, double radius_km = earth_radius_km);

/// The largest widths that are nowhere above the given ones, and change by at most g km per km, in
/// a plane by g per unit of length, between any two nodes: the least of h(y) + g d(x, y) over all
/// nodes y. On the sphere d is the distance. In a plane it is the length of the shortest way in the
/// domain, round its islands and across its periods, between nodes of the domain; a node outside
/// has what the others allow it straight across. Where a node lowers none of its neighbours, but
/// one beyond, the way from it may be longer by some hundredths of a step of the raster, and round
/// islands by a third of one. The result has the same bits for any number of threads.
///
/// \param gradient g, > 0 and finite.
/// \param surface the sphere, whose boundary has no effect, or a plane.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \param widths as for WidthField, or infinite where there is no demand.
/// \throws Error as WidthField; invalid_argument for a gradient or a radius out of range, and for a
///         surface of another kind than the raster.
Raster limit_gradient(const Raster& widths, double gradient, const Surface& surface = {},
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
