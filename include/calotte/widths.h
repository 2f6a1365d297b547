// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/raster.h>
#include <calotte/surface.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// The radius of the Earth in km, the default of the functions below.
inline constexpr double earth_radius_km = 6371;

/// Whether a radius in km is the Earth's within 1%, by which models of it differ.
inline bool is_earth(double radius_km) {
  return std::abs(radius_km - earth_radius_km) <= 0.01 * earth_radius_km;
}

/// Cell widths h at nodes, prepared for evaluation at any point: those of a raster, or of rules,
/// see width_field(). They are distances between the centres of neighbouring cells, here and below
/// in km, in a plane in its unit. A value that is cheap to copy.
class WidthField {
public:
  /// \param widths > 0 and finite, max / min at most 1e30.
  /// \throws Error invalid_argument if they violate these conditions or those of Raster.
  WidthField(const Raster& widths); // NOLINT(google-explicit-constructor): a raster is a field
  /// A field made by the library.
  explicit WidthField(std::shared_ptr<const density_detail::SampledWidths> widths);

  double least() const;       ///< of the nodes
  double greatest() const;    ///< of the nodes
  std::int64_t nodes() const; ///< their number
  /// For rules, the largest distance of neighbouring nodes, in local widths: 1, or more where that
  /// would require too many nodes.
  double apart() const;
  bool of_plane() const; ///< whether lengths are those of a plane

  /// The data that copies share.
  const std::shared_ptr<const density_detail::SampledWidths>& sampled() const { return sampled_; }

private:
  std::shared_ptr<const density_detail::SampledWidths> sampled_;
};

/// The widths at n points.
/// \param points 3 x n directions, in a plane 2 x n, or 3 x n with z = 0.
/// \throws Error invalid_argument for another number of rows, and for a direction that is none.
DoubleVector evaluate(const WidthField& widths, const PointsRef& points);

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

/// Requires nodes that cover the sphere, or a part of it or of the plane. At the boundary of a part
/// the nearest nodes are at most half of the widest step away. On the sphere, between the last
/// longitude and the first one and beyond the outer latitudes at most 1.5 of it.
/// \throws Error invalid_argument, naming the extent of the nodes and what they leave out; for
///         another surface, as for implied_cells().
void require_covering(const Raster& widths, const Surface& surface = {});

/// The gradient of cell widths at one point of the sphere.
struct WidthGradient {
  double slope = 0;     ///< |grad h|, km per km
  double longitude = 0; ///< degrees, from -180 to below 180
  double latitude = 0;  ///< degrees
};

/// The largest gradient of cell widths that most models accept, km per km.
inline constexpr double steepest_width = 0.03;
/// Whether a slope exceeds steepest_width by more than the rounding of a run's number of cells
/// explains.
inline bool is_too_steep(double slope) { return slope > 1.005 * steepest_width; }

/// The largest |grad h| at the scale of cells: the largest mean of the gradient over a square of
/// the width h in the corner of a box between nodes, or over the box if that is smaller. (At a node
/// the gradient of the interpolated field itself may be sqrt(2) times that of the widths that were
/// sampled.) Most models need a value below steepest_width. Tiles that lie outside the surface that
/// widths are for do not count.
/// \param radius_km radius of the sphere, > 0 and finite; default that of the Earth.
/// \throws Error invalid_argument for a radius out of range, and for widths of a plane.
WidthGradient largest_gradient(const WidthField& widths, double radius_km = earth_radius_km);

/// The largest widths that are nowhere above the given ones, and change by at most g km per km, in
/// a plane by g per unit of length, between any two nodes: the least of h(y) + g d(x, y) over all
/// nodes y. On the sphere d is the distance. In a plane it is the length of the shortest way in the
/// domain, round its islands and across its periods, between nodes of the domain; a node outside is
/// limited by the others along straight lines. Where a node lowers a node beyond its neighbours,
/// but none of these, the computed path may be longer by some hundredths of a step of the raster,
/// and round islands by a third of a step. The result has the same bits for any number of threads.
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

struct Coast;

namespace density_detail {
class WidthRule;
class ShareRule;
template <class Rule> class OfRadius;
} // namespace density_detail

/// A width as a function of a number, such as a distance or a latitude.
struct WidthProfile {
  /// The number and the width in km, > 0; one node or more, the numbers ascending. Before the first
  /// and beyond the last the width stays.
  std::vector<std::array<double, 2>> nodes;
  bool smooth = false; ///< between two nodes along a cubic that is level at both, not a line
};

/// A rule for widths by the depth of the sea and its gradient. (Waves and slopes: Roberts, Pringle
/// and Westerink, Geosci. Model Dev. 12, 2019. Rossby radii: Gill, Atmosphere-Ocean Dynamics,
/// 1982.)
struct DepthRule {
  /// The length that cells share.
  enum class Kind {
    wavelength, ///< of shallow water: sqrt(g depth) period
    rossby,     ///< sqrt(g depth) / max(|f|, sqrt(2 beta sqrt(g depth))), with f of the Earth
    slope       ///< 2 pi depth / |grad depth|
  };
  Kind kind = Kind::wavelength; ///< default: that of a wave
  double cells = 0;             ///< that share the length, > 0
  double period = 0;            ///< seconds, > 0, of a wave
  double least = 0;             ///< km, > 0: where the sea is shallow, and at the coast
};

/// The side on which a rule by the distance from a coast applies.
enum class CoastSide { both, sea, land };

/// A rule for widths in the sea's channels and straits.
struct ChannelRule {
  double cells = 0;    ///< across a channel, > 0
  double least = 0;    ///< km, > 0: in channels that are narrower than so many such cells
  double widest = 500; ///< km, > 0, of the channels that count. Default 500.
};

/// The share of one of two rules, from 0 to 1 for every point. A value that is cheap to copy.
class WidthShare {
public:
  /// 1 in a region and on its boundary, 0 outside.
  WidthShare(const Surface& region); // NOLINT(google-explicit-constructor): a region is a share
  /// A share by the distance from the boundary of a region: > 0 outside, < 0 inside.
  /// \param profile shares of the distance, instead of widths.
  /// \throws Error invalid_argument for a surface without a boundary; naming the node, a profile
  ///         that is none, or a share that is not 0 to 1.
  WidthShare(const Surface& region, const WidthProfile& profile);
  /// A share by the distance from a coast: > 0 in the sea, < 0 on land.
  /// \throws Error invalid_argument as Widths::by_distance(); naming the node, for a share that is
  ///         not 0 to 1.
  WidthShare(const Coast& coast, const WidthProfile& profile);
  /// The fractions of a raster, such as those of land.
  /// \throws Error invalid_argument for one that violates the conditions of Raster, and naming the
  ///         node, for a value that is not 0 to 1.
  WidthShare(const Raster& raster); // NOLINT(google-explicit-constructor)

  /// The data that copies share, for any sphere.
  const std::shared_ptr<const density_detail::OfRadius<density_detail::ShareRule>>&
  rule_of_radius() const {
    return rule_of_radius_;
  }

private:
  std::shared_ptr<const density_detail::OfRadius<density_detail::ShareRule>> rule_of_radius_;
};

/// Cell widths as an expression: rules, each with a width for every point, and combinations of
/// rules. Widths are positive. Lengths are in km on a sphere of radius earth_radius_km, or of that
/// of on_sphere(); in a plane in its unit. Rules of the sphere and of a plane cannot be combined.
/// Rules of a plane are numbers, rasters, and those by distance. A value that is cheap to copy.
/// Copies share the data that are prepared for queries. Any number of threads may call const
/// functions.
///
///     const Widths coast = Widths::by_distance(shapes, {{{0, 10}, {600, 60}}});
///     const Widths zones = Widths::by_latitude({{{-90, 35}, {0, 60}, {90, 35}}});
///     const Raster raster = sampled(Widths::minimum({coast, zones}).limit_gradient(0.03));
class Widths {
public:
  /// One width everywhere, or no_demand.
  /// \throws Error invalid_argument unless it is > 0.
  Widths(double width); // NOLINT(google-explicit-constructor): a number is a rule
  /// The widths of a raster. \throws Error invalid_argument as WidthField.
  Widths(Raster raster); // NOLINT(google-explicit-constructor)
  /// A rule made by the library.
  explicit Widths(std::shared_ptr<const density_detail::OfRadius<density_detail::WidthRule>> rule,
                  double radius_km = earth_radius_km);

  /// \param profile of the latitude in degrees, from -90 to 90.
  /// \throws Error invalid_argument, naming the node, for a profile that is none.
  static Widths by_latitude(const WidthProfile& profile);

  /// A width by the distance from the nearest of some lines, along great circles; in a plane along
  /// straight lines, also over land.
  /// \param lines each 3 x points, directions, joined by arcs shorter than a half circle, in a
  ///        plane x y 0; one point is a line, too. See read_shapes() and shores().
  /// \param profile of the distance, from 0 on.
  /// \param surface the sphere or a plane, whose boundary has no effect.
  /// \throws Error invalid_argument, naming line and point: opposite neighbours, a point that is no
  ///         direction, no line; naming the node, a profile that is none.
  static Widths by_distance(const std::vector<Points3>& lines, const WidthProfile& profile,
                            const Surface& surface = {});

  /// One width up to a distance from the nearest of some lines; no_demand beyond it.
  ///
  /// \param lines as for by_distance().
  /// \param width > 0.
  /// \param over the distance, > 0.
  /// \param surface as for by_distance().
  /// \throws Error invalid_argument as by_distance().
  static Widths around(const std::vector<Points3>& lines, double width, double over,
                       const Surface& surface = {});

  /// A width by the distance from a coast: > 0 in the sea, < 0 on land.
  /// \param profile of the distance in km. With a single side, of the distance on that side, from 0
  ///        on; no_demand on the other side.
  /// \throws Error invalid_argument, naming ring and corner: one that is no direction, or opposite
  ///         to the one before; for a coast without lines, see shores(); naming the node, a profile
  ///         that is none.
  static Widths by_distance(const Coast& coast, const WidthProfile& profile,
                            CoastSide side = CoastSide::both);

  /// A width by the depth at the nodes of a raster of the sphere, whose values are metres up; below
  /// 0 is sea. The result is no_demand on land, except at nodes next to the sea.
  /// \throws Error invalid_argument for a value of the rule out of range, or a raster that violates
  ///         the conditions of Raster, and naming the node, for a height that is not finite.
  static Widths by_depth(const Raster& heights, const DepthRule& rule);

  /// A width by that of channels and straits, max(least, width / cells); no_demand elsewhere.
  ///
  /// The width at a point of the sea is twice the distance R from the coast. It counts if two of
  /// the nearest points of the coast lie in directions more than 120 degrees apart, and at least 6
  /// R from each other along the coast, or on different lines of it: in straits, also between
  /// islands, and in inlets that are about as long as wide, but not in wider bays. The rule applies
  /// in the circles of radius R about such points; limit_gradient() is exact. The points are the
  /// circumcentres of Delaunay triangles of points along the coast (Dey and Zhao, Algorithmica 38,
  /// 2004), and R errs by less than 1/100.
  ///
  /// \throws Error invalid_argument for a value of the rule out of range; naming ring and corner of
  ///         the coast, one that is no direction or opposite to the one before. When it is first
  ///         evaluated, for a least width that cuts the coast into more than 20 million pieces on
  ///         its sphere, and as delaunay() for a coast along one great circle.
  static Widths by_channel(const Coast& coast, const ChannelRule& rule);

  /// The value of a rule where it gives no width: infinity, so that other rules decide in a
  /// minimum.
  static constexpr double no_demand = std::numeric_limits<double>::infinity();
  /// Whether a rule gives a width, that is not no_demand.
  static bool is_demand(double width) { return width < no_demand; }

  /// The minimum of several at each point. Widths of the Earth adopt the sphere of the others.
  /// \throws Error invalid_argument for an empty list, and for widths of a sphere and of a plane,
  ///         or of two other spheres, here and below.
  static Widths minimum(const std::vector<Widths>& of);
  static Widths maximum(const std::vector<Widths>& of); ///< the greatest
  static Widths sum(const std::vector<Widths>& of);     ///< all together
  /// One rule within a region, or where a share is 1/2 or more, another outside.
  static Widths where(const WidthShare& share, const Widths& inside, const Widths& outside);
  /// (1 - t) a + t b with the share t.
  static Widths blend(const Widths& a, const Widths& b, const WidthShare& t);

  /// These widths times a number.
  /// \param factor > 0 and finite.
  /// \throws Error invalid_argument for a factor out of range.
  Widths times(double factor) const;

  /// The largest widths below these that change by at most g km per km, over the poles and the date
  /// line, too. Rules of distances that grow, of latitudes, and minima of such are limited exactly.
  /// Others are limited at the nodes of a raster whose step is their least width, from 0.05 to 1
  /// degree, see limit_gradient(); the result is the lesser of that and these widths. Widths
  /// between the nodes lower them, too: those at each node of a rule's own raster, and for other
  /// rules at points up to four times as dense. A raster is limited at its own nodes. In a plane
  /// rules that are not limited exactly are refused: give their domain.
  /// \param gradient g, > 0 and finite.
  /// \throws Error invalid_argument for a gradient out of range.
  Widths limit_gradient(double gradient) const;
  /// The same on the sphere. In a plane, the raster of these widths with a limited gradient in the
  /// domain, see limit_gradient(const Raster&).
  /// \throws Error invalid_argument for a gradient out of range, and as sampled().
  Widths limit_gradient(double gradient, const Surface& surface) const;

  /// The same widths with a step for the rasters that sampled() makes of them. Their
  /// limit_gradient() keeps the step; combinations of them have none. \throws Error
  /// invalid_argument unless it is > 0 and finite.
  Widths with_step(double step) const;
  double step() const { return step_; } ///< 0: by their least width

  /// The same rules on a sphere of another radius: distances, slopes and gradients are km of it. A
  /// Rossby radius has the Earth's gravity and rotation. Rules of a plane stay.
  /// \param radius_km > 0 and finite.
  /// \throws Error invalid_argument for a radius out of range, and for widths of a third sphere.
  Widths on_sphere(double radius_km) const;
  double radius_km() const { return radius_km_; } ///< of the sphere that lengths refer to

  bool is_of_plane() const; ///< whether some of its rules are rules of a plane

  /// The data that copies share. They are prepared at the first call.
  std::shared_ptr<const density_detail::WidthRule> rule() const;
  /// The same for any sphere.
  const std::shared_ptr<const density_detail::OfRadius<density_detail::WidthRule>>&
  rule_of_radius() const {
    return rule_of_radius_;
  }

private:
  std::shared_ptr<const density_detail::OfRadius<density_detail::WidthRule>> rule_of_radius_;
  double radius_km_;
  double step_ = 0;
};

/// The widths at n points.
/// \param points 3 x n directions, in a plane 2 x n, or 3 x n with z = 0.
/// \throws Error invalid_argument for another number of rows, and for a direction that is none.
DoubleVector evaluate(const Widths& widths, const PointsRef& points);

/// The rule of a minimum that gives the width at each of n points: its index in the list of
/// Widths::minimum(), the first of equal ones. For a minimum with a limited gradient, the rule from
/// which the width grows. 0 for any other rule.
///
/// \param points as for evaluate().
/// \throws Error as there.
Ids active_rules(const Widths& minimum, const PointsRef& points);

/// The widths in the form that a run uses: rules at nodes whose distance is at most the least width
/// around them. They lie on tiles of one degree, in a plane on some four thousand. Each tile is
/// divided by powers of two, up to 1024, and not at all where its widths differ by less than
/// 1/1000. Between nodes widths are bilinear, and in the surface they are continuous. Where widths
/// change by at most g km per km, they err by at most 1.3 g + 1/1000 times the width.
///
/// Where nodes would be more than forty million, or a tile have more than 1024 a side, they are
/// farther apart, see WidthField::apart(), and the error grows as much. Tiles that lie outside a
/// bounded surface have nodes at their corners. Without a demand, outside, a node has the largest
/// width of the others. Widths that are a raster keep its nodes.
///
/// \param surface the sphere, a part of it, or a plane of finite area.
/// \throws Error as sampled() and require_covering().
WidthField width_field(const Widths& widths, const Surface& surface = {});

/// The widths at the nodes of a regular raster: of the sphere, with nodes at the poles; of a plane,
/// over the box around its boundary or over its periods. Nodes outside a bounded surface without a
/// demand have the largest width of the others. Without a step, widths that are a raster have its
/// nodes, and a number has two nodes in each direction, which cover any surface.
/// \param surface the sphere, a part of it, or a plane of finite area.
/// \param step largest distance of rows and of columns: 0.01 to 10 degrees; in a plane > 0, for at
///        most 20 million nodes. Default 0: their own, see Widths::with_step(), or that of the
///        least width, within 0.05 to 1 degree; in a plane half of the least width, or what gives 4
///        million nodes.
/// \throws Error invalid_argument for a step out of range, widths of another surface or whose
///         ratios exceed 1e30, and naming a node of the surface where no rule gives a width.
Raster sampled(const Widths& widths, const Surface& surface = {}, double step = 0);

} // namespace calotte
CALOTTE_API_END
