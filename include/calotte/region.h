// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// A part of the sphere between closed rings of great-circle arcs.
struct Region {
  /// Boundary rings, each 3 x corners, directions of any norm. An arc shorter than a half circle
  /// joins each corner to the next, and the last to the first. The region lies to the left of every
  /// ring, seen from outside the sphere: an outer boundary runs counter-clockwise, a hole
  /// clockwise. Default: none, which is the whole sphere.
  std::vector<Points3> rings;

  Region() = default; ///< the whole sphere
  /// The part within these rings.
  Region(std::vector<Points3> all) : rings(std::move(all)) {}
  Region(const Surface& surface); ///< \throws Error bad_option for a plane

  /// True for the whole sphere.
  bool whole() const { return rings.empty(); }
};

/// A circle around a centre, as a regular polygon with corners on the circle.
/// \param centre direction of any norm.
/// \param radius angle in radians, from 1e-6 to pi - 1e-6.
/// \param corners 8 to 2^24; the first is north of the centre. Default 360.
/// \throws Error bad_option for a value out of range.
Region circle(const Eigen::Vector3d& centre, double radius, int corners = 360);

/// An ellipse, as a polygon with corners on it: the places whose distances from two foci have a sum
/// of twice the semi-major axis.
/// \param semi_major, semi_minor angles in radians; 1e-6 <= semi_minor <= semi_major <= pi/2 -
///        1e-6.
/// \param bearing of the major axis at the centre, radians clockwise from north; at a pole, north
///        is that of longitude 0.
/// \param corners as for a circle; the first is at an end of the major axis.
/// \throws Error bad_option for a value out of range.
Region ellipse(const Eigen::Vector3d& centre, double semi_major, double semi_minor, double bearing,
               int corners = 360);

/// The band between two latitudes, as polygons with corners on the parallels at equal longitudes.
/// Each arc between corners is poleward of its parallel, by 122 m on the Earth at most for 360
/// corners.
/// \param lower, upper radians, -pi/2 to pi/2; 1e-6 or more from each other and from a pole that is
///        not one of them. A band up to a pole contains it.
/// \param corners as for a circle, of each parallel; the first is at longitude 0.
/// \throws Error bad_option for a value out of range, and for the whole sphere.
Region channel(double lower, double upper, int corners = 360);

/// The region that rings enclose. One rule holds for all rings that users or files write, in either
/// direction: they enclose the side without poles, as on a map of longitudes and latitudes; if both
/// sides have a pole, or the rings pass through one, they enclose the smaller side, and of two
/// equal ones that to the left of the first ring. So a ring of one continent or ocean encloses it,
/// and a ring around a pole its polar cap.
///
/// Corners that repeat the one before are ignored, and a ring may repeat its first corner at its
/// end. Arcs that occur in both directions are no boundary: areas that are cut at a meridian are
/// joined, and a ring may reach a pole along a meridian and return along it. Where rings would
/// meet, both sides of such a cut may differ by 1e-9 radians (6 mm on the Earth), and in their
/// corners.
/// \param rings as in Region; at least one. Several enclose one of the two parts into which they
///        cut the sphere, such that every arc is between both.
/// \throws Error as require_region(), orientation aside.
Region enclosed_region(const std::vector<Points3>& rings);

/// The same for the side of the rings that contains a place.
/// \param place direction of any norm, not on a ring.
/// \throws Error as above; bad_option for a place on the boundary.
Region region_around(const std::vector<Points3>& rings, const Eigen::Vector3d& place);

/// Throws unless the rings bound a region. The whole sphere is valid.
/// \throws Error bad_option, naming ring and corner, with the ring as index(): fewer than three
///         corners; a corner that is no direction; equal or opposite neighbours; arcs that meet
///         elsewhere than in the corner that joins them; rings of which one does not have the
///         region to its left.
void require_region(const Region& region);

/// The area in steradians; 4 pi for the whole sphere. It errs by about 1e-15.
/// \throws Error as require_region().
double area(const Region& region);

/// True if a direction lies inside the region or on its boundary; false for zero and non-finite
/// vectors. The test is exact. (Corners and places whose norm is not 1 up to round-off are rounded
/// to unit vectors first.) Each call prepares the boundary; for many places call containing().
/// \throws Error as require_region().
bool contains(const Region& region, const Eigen::Vector3d& place);

/// Returns contains() as a function for many places. It prepares the boundary once; a call reads
/// only the arcs near the place. The result keeps a copy of the boundary; threads may share it.
/// \throws Error as require_region().
std::function<bool(const Eigen::Vector3d&)> containing(const Region& region);

/// A region that holds all places within a distance of another one, and few more: the boundary
/// moves outwards in a stereographic projection about the middle of the region. The whole sphere if
/// the result would reach farther than 2 radians from there.
/// \param distance angle in radians, > 0 and finite.
/// \throws Error as require_region(); bad_option for a distance out of range.
Region widened(const Region& region, double distance);

} // namespace calotte
CALOTTE_API_END
