// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/cell_width_polygons.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/vec3.h"
#include "density/raster_field.h"
#include "domain/arc_tree.h"
#include "domain/arcs.h"
#include "domain/written_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

namespace calotte::density_detail {
namespace {

// ---- Inside or outside

/// Longitudes are integers in units of 1e-9 degrees, so that turns by 360 degrees are exact and the
/// number of crossings of a meridian and a ring is topologically correct.
using Longitude = std::int64_t;
constexpr double units = 1e9; ///< in a degree
constexpr Longitude turn = 360'000'000'000;

Longitude to_units(double degrees) { return std::llround(std::remainder(degrees, 360) * units); }

/// The longitude in [0, 360) degrees.
Longitude wrapped(Longitude longitude) {
  const Longitude rest = longitude % turn;
  return rest < 0 ? rest + turn : rest;
}

/// A straight line in longitude and latitude, which begins at `west` and runs east.
struct Edge {
  Longitude west, span; ///< 0 <= span <= turn
  double west_latitude, east_latitude;
  std::int32_t polygon, ring;
};

/// The longitude step to the next point, the shorter way around. A written difference of 360
/// degrees is kept.
Longitude eastward(const LonLat& from, const LonLat& to) {
  const double written = to.longitude - from.longitude;
  if (std::abs(written) == 360)
    return written > 0 ? turn : -turn;
  const Longitude way = wrapped(to_units(to.longitude) - to_units(from.longitude));
  return way < turn / 2 || (way == turn / 2 && written > 0) ? way : way - turn;
}

/// Calls body(arc, start, end) for the arcs of an edge, from west to east; start and end are from 0
/// to 1 along the edge. An edge is straight in longitude and latitude; arcs of half a degree
/// deviate from it by 30 m at most.
template <class Body> void for_each_arc(const Edge& edge, const Body& body) {
  constexpr double longest = 0.5;
  const double north = edge.east_latitude - edge.west_latitude,
               east = static_cast<double>(edge.span) / units;
  const int parts =
      static_cast<int>(std::ceil(std::max({1.0, std::abs(north) / longest, east / longest})));
  const auto at = [&](int part) {
    const double fraction = static_cast<double>(part) / parts;
    return from_lonlat(static_cast<double>(edge.west) / units + fraction * east,
                       part == parts ? edge.east_latitude : edge.west_latitude + fraction * north);
  };
  for (int part = 0; part < parts; ++part) {
    const Vec3 from = at(part), to = at(part + 1), apart = to - from;
    const bool is_point = !(dot(apart, apart) > 1e-24); // at a pole, or repeated
    if (!is_point)
      body(Arc{from, to}, static_cast<double>(part) / parts, static_cast<double>(part + 1) / parts);
  }
}

/// Adds the edges of a ring; returns true if the north pole is inside it.
bool add_edges(const Ring& ring, std::int32_t polygon, std::int32_t number,
               std::vector<Edge>& edges) {
  Longitude round = 0;
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const LonLat &from = ring[i], &to = ring[(i + 1) % ring.size()];
    const Longitude span = eastward(from, to), start = to_units(from.longitude);
    const bool east = span >= 0;
    round += span;
    edges.push_back(
        east ? Edge{wrapped(start), span, from.latitude, to.latitude, polygon, number}
             : Edge{wrapped(start + span), -span, to.latitude, from.latitude, polygon, number});
    for_each_arc(edges.back(), [&](const Arc& arc, double, double) {
      arcs.push_back(east ? arc : Arc{arc.to, arc.from});
    });
  }
  require(std::abs(round) <= turn,
          "polygon {} of a width runs round the Earth more than once; cut it in parts", polygon);
  const bool north_is_left = round > 0;
  return round != 0 && domain_detail::enclose_left(arcs) == north_is_left;
}

/// Point-in-polygon test: counts the crossings of each ring along the meridian from the point to
/// the north pole.
class Inside {
public:
  explicit Inside(const std::vector<Polygon>& polygons) : bins_(bin_count) {
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      bool pole = false;
      for (std::size_t r = 0; r < polygons[p].rings.size(); ++r)
        pole ^= add_edges(polygons[p].rings[r], static_cast<std::int32_t>(p),
                          static_cast<std::int32_t>(r), edges_);
      pole_.push_back(pole);
    }
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (Longitude bin = edges_[e].west / bin_width;
           bin <= (edges_[e].west + edges_[e].span) / bin_width &&
           bin < edges_[e].west / bin_width + bin_count;
           ++bin)
        bins_[static_cast<std::size_t>(bin % bin_count)].push_back(static_cast<std::int32_t>(e));
    for (std::size_t p = 0; p < polygons.size(); ++p)
      if (const auto& point = polygons[p].inside)
        pole_[p] ^= !contains(p, to_units(point->longitude), point->latitude);
  }

  const std::vector<Edge>& edges() const { return edges_; }

  bool operator()(Longitude longitude, double latitude) const {
    return any(longitude, latitude, [](std::size_t, bool inside) { return inside; });
  }

private:
  static constexpr Longitude bin_count = 7200, bin_width = turn / bin_count;

  /// True if holds(polygon, inside) is true for a polygon; `inside` tells whether it contains the
  /// point.
  template <class Holds> bool any(Longitude longitude, double latitude, const Holds& holds) const {
    // A pole has the side of the points next to it.
    constexpr double highest = 90 - 1e-9;
    latitude = std::clamp(latitude, -highest, highest);
    const Longitude meridian = wrapped(longitude);
    const std::vector<std::int32_t>& bin = bins_[static_cast<std::size_t>(meridian / bin_width)];
    auto next = bin.begin(); // edges stand polygon by polygon
    for (std::size_t p = 0; p < pole_.size(); ++p) {
      bool inside = pole_[p];
      for (; next != bin.end() && edge(*next).polygon == static_cast<std::int32_t>(p); ++next)
        inside ^= crosses(edge(*next), meridian, latitude);
      if (holds(p, inside))
        return true;
    }
    return false;
  }

  /// True if one polygon contains a point.
  bool contains(std::size_t polygon, Longitude longitude, double latitude) const {
    return any(longitude, latitude,
               [&](std::size_t p, bool inside) { return p == polygon && inside; });
  }

  const Edge& edge(std::int32_t e) const { return edges_[static_cast<std::size_t>(e)]; }

  /// True if the meridian crosses the edge north of the latitude.
  static bool crosses(const Edge& edge, Longitude meridian, double latitude) {
    const Longitude offset = wrapped(meridian - edge.west);
    if (offset >= edge.span)
      return false;
    const double part = static_cast<double>(offset) / static_cast<double>(edge.span);
    return edge.west_latitude + part * (edge.east_latitude - edge.west_latitude) > latitude;
  }

  std::vector<Edge> edges_;
  std::vector<char> pole_;                      ///< by polygon: the north pole is inside
  std::vector<std::vector<std::int32_t>> bins_; ///< by longitude: edges, ascending
};

// ---- Distance

/// True if the part of an edge from `start` to `end` (0 to 1) has polygons on one side only.
bool is_boundary(const Inside& inside, const Edge& edge, double start, double end) {
  constexpr double aside = 1e-6; // degrees: a tenth of a metre
  const double middle = 0.5 * (start + end),
               latitude = edge.west_latitude + middle * (edge.east_latitude - edge.west_latitude),
               cosine = std::max(1e-6, from_lonlat(0, latitude).x);
  const double east = static_cast<double>(edge.span) / units * cosine,
               north = edge.east_latitude - edge.west_latitude,
               scale = aside / std::sqrt(east * east + north * north);
  const Longitude meridian = edge.west + std::llround(middle * static_cast<double>(edge.span)),
                  shift = std::llround(scale * north / cosine * units);
  return inside(meridian - shift, latitude + scale * east) !=
         inside(meridian + shift, latitude - scale * east);
}

void add_arcs(const Inside& inside, const Edge& edge, std::vector<Arc>& arcs) {
  for_each_arc(edge, [&](const Arc& arc, double start, double end) {
    if (is_boundary(inside, edge, start, end))
      arcs.push_back(arc);
  });
}

std::vector<Arc> boundary_arcs(const Inside& inside) {
  const auto count = static_cast<std::int64_t>(inside.edges().size());
  std::vector<std::vector<Arc>> of_block(static_cast<std::size_t>(block_count(count)));
  for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e != end; ++e)
      add_arcs(inside, inside.edges()[static_cast<std::size_t>(e)],
               of_block[static_cast<std::size_t>(block)]);
  });
  std::vector<Arc> arcs;
  for (const std::vector<Arc>& some : of_block)
    arcs.insert(arcs.end(), some.begin(), some.end());
  return arcs;
}

/// Distances to the boundary of polygons.
class Boundary {
public:
  explicit Boundary(const Inside& inside) : arcs_(boundary_arcs(inside)), tree_(arcs_) {}

  /// The square of the chord from a unit vector to the boundary, at most `far`.
  double square(const Vec3& p, double far) const {
    tree_.visit([&](const Box3& box) { return square_from(box, p) < far; },
                [&](std::int32_t arc) {
                  far = std::min(far, square_from(arcs_[static_cast<std::size_t>(arc)], p));
                });
    return far;
  }

private:
  std::vector<Arc> arcs_;
  ArcTree tree_;
};

// ---- Widths

/// Merges regions of equal width, so that edges between them are no boundary.
std::vector<WidthRegion> merged(const std::vector<WidthRegion>& regions) {
  std::vector<WidthRegion> all;
  for (const WidthRegion& region : regions) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const WidthRegion& other) {
      return other.inside == region.inside;
    });
    if (same == all.end())
      all.push_back(region);
    else
      same->polygons.insert(same->polygons.end(), region.polygons.begin(), region.polygons.end());
  }
  return all;
}

struct Region {
  explicit Region(const WidthRegion& region)
      : width(region.inside), inside(region.polygons), boundary(inside) {}

  double width;
  Inside inside;
  Boundary boundary;
};

/// The weight of the outside width at a point: 0 inside, 1 beyond the transition.
double outside_weight(const Region& region, const PolygonWidths& widths, double longitude,
                      double latitude) {
  if (region.inside(to_units(longitude), latitude))
    return 0;
  const double width = widths.transition / widths.radius_km, // as an angle
      square = region.boundary.square(from_lonlat(longitude, latitude),
                                      std::min(4.0, width * width)), // chords are shorter
      angle = 2 * arc_sine(std::min(1.0, 0.5 * std::sqrt(square))),
               t = std::min(1.0, angle / width);
  return t * t * (3 - 2 * t);
}

double width_at(const Region& region, const PolygonWidths& widths, double longitude,
                double latitude) {
  const double weight = outside_weight(region, widths, longitude, latitude);
  return (1 - weight) * region.width + weight * widths.outside;
}

/// The step between samples, degrees.
double step_for(const PolygonWidths& widths) {
  constexpr double finest = 0.05, coarsest = 1;
  constexpr double samples = 16, fewest_samples = 4; ///< of a transition
  const double degrees = widths.transition / widths.radius_km * 180 / std::numbers::pi;
  if (degrees < fewest_samples * finest) {
    const double least = widths.transition * fewest_samples * finest / degrees;
    char text[128];
    std::snprintf(text, sizeof text,
                  "a transition of %g km is too narrow for the finest raster, of %g degrees; give "
                  "at least %.3g km",
                  widths.transition, finest, 1.005 * least);
    refuse(text);
  }
  return std::clamp(degrees / samples, finest, coarsest);
}

} // namespace

Raster make_cell_width(const std::vector<WidthRegion>& regions, const PolygonWidths& widths) {
  Raster grid = regular_grid(step_for(widths));
  std::vector<std::unique_ptr<const Region>> parts;
  for (const WidthRegion& region : merged(regions))
    parts.push_back(std::make_unique<const Region>(region));
  for_each_task(grid.y.size(), [&](std::int64_t j) {
    for (Eigen::Index i = 0; i < grid.x.size(); ++i) {
      double least = parts.empty() ? widths.outside : std::numeric_limits<double>::infinity();
      for (const auto& part : parts)
        least = std::min(least, width_at(*part, widths, grid.x[i], grid.y[j]));
      grid.values(i, j) = least;
    }
  });
  return grid;
}

} // namespace calotte::density_detail
