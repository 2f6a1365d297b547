// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

#include <cstdint>
#include <functional>
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

  bool whole() const { return rings.empty(); }
};

/// A circle around a centre, as a regular polygon.
/// \param centre direction of any norm.
/// \param radius angle in radians, from 1e-6 to pi - 1e-6.
/// \param corners at least 8.
/// \throws Error bad_option for a value out of range.
Region circle(const Eigen::Vector3d& centre, double radius, int corners = 360);

/// An ellipse: the places whose distances from two foci have a sum of at most twice the semi-major
/// axis, as a polygon.
/// \param semi_major, semi_minor angles in radians; 0 < semi_minor <= semi_major < pi / 2.
/// \param bearing of the major axis at the centre, radians clockwise from north.
/// \throws Error bad_option for a value out of range.
Region ellipse(const Eigen::Vector3d& centre, double semi_major, double semi_minor, double bearing,
               int corners = 360);

/// The band between two latitudes in radians, as polygons; one of them may be a pole.
/// \throws Error bad_option unless -pi/2 <= lower < upper <= pi/2, and not both are poles.
Region channel(double lower, double upper, int corners = 360);

/// Throws unless the rings bound a region.
/// \throws Error bad_option, naming ring and corner: fewer than three corners; a corner that is no
///         direction; equal or opposite neighbours; arcs that meet elsewhere than in the corner
///         that joins them; rings of which one does not have the others to its left.
void require_region(const Region& region);

/// The area in steradians; 4 pi for the whole sphere. Accurate to 1e-14.
/// \throws Error as require_region().
double area(const Region& region);

/// True if a direction lies inside the region or on its boundary. The test is exact. Each call
/// prepares the boundary; for many places call containing() or inside().
/// \throws Error as require_region().
bool contains(const Region& region, const Eigen::Vector3d& place);

/// Returns contains() as a function for many places.
/// \throws Error as require_region().
std::function<bool(const Eigen::Vector3d&)> containing(const Region& region);

} // namespace calotte
CALOTTE_API_END
