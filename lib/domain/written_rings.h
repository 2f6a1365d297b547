// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "domain/room.h"

#include <calotte/error.h>
#include <calotte/mesh.h>

#include <span>
#include <string>
#include <vector>

/// Rings as users and files write them: in either direction, closed or not, cut along lines to a
/// pole.
namespace calotte::domain_detail {

/// A ring and its origin, for messages.
struct WrittenRing {
  std::vector<Vec3> corners; ///< unit vectors; the last leads back to the first
  std::string origin;        ///< a noun: "ring 2", "feature 1: ring 0"
  bool reversed = false;     ///< the corners stand in the reverse order of those written
};

/// The arcs of a ring. \pre at least two corners.
std::vector<Arc> arcs_of(const WrittenRing& ring);

/// A distance in radians, far above round-off; 6 mm on the Earth.
inline constexpr double nearby = 1e-9;

/// A caller's rings, 3 x corners directions each, which may repeat corners.
/// \throws Error invalid_argument, naming ring and corner, for a corner that is no direction.
std::vector<WrittenRing> written(const std::vector<Points3>& rings);

/// Removes corners that repeat the previous one; at the end, those that repeat the first.
void drop_repeated(std::vector<Vec3>& corners);

/// True if rings enclose the side to their left. This rule applies to all rings that may run in
/// either direction: they enclose the side without poles, as on a map of longitudes and latitudes.
/// If both sides have a pole, or the rings pass through one, they enclose the smaller side; of two
/// equal ones, that to the left.
/// \param arcs of closed rings with one region to the left of all.
bool enclose_left(std::span<const Arc> arcs);

/// Turns a ring so that the side that it encloses is to its left, or to its right for a hole.
void enclose(WrittenRing& ring, bool hole = false);

/// Removes arcs that occur in both directions, in two rings or in one, and joins the remaining arcs
/// to rings. Polygons that were cut at a meridian become one, and a ring that reaches a pole along
/// a meridian and returns along it runs round the pole. The two sides of such a cut may differ by
/// rounding and in their corners: corners `nearby` another corner or an edge are first moved onto
/// it. If the rings then meet, no corner is moved.
/// \throws Error as rings_of().
std::vector<WrittenRing> joined(std::vector<WrittenRing> rings);

/// Joined rings, turned so that the side that they enclose together is to the left of each.
/// \throws Error as Surface::within(), orientation aside.
std::vector<WrittenRing> enclosed(std::vector<WrittenRing> rings);

/// Joined rings, turned so that the side that contains a point is to the left of each.
/// \param point unit vector.
/// \throws Error as Surface::within(), orientation aside; invalid_argument for a point on the
/// boundary.
std::vector<WrittenRing> around(std::vector<WrittenRing> rings, const Vec3& point);

/// The corners of each ring, 3 x n.
Surface::Rings corners_of(const std::vector<WrittenRing>& rings);

/// The message of an error about these rings. Each "ring N" is replaced by the ring's origin, and a
/// corner where an edge begins by the corner of the written ring.
std::string explained(const std::vector<WrittenRing>& rings, const Error& error);

/// Calls a function whose errors name these rings by their numbers.
template <class Call>
auto with_origins(const std::vector<WrittenRing>& rings, const Call& call) -> decltype(call()) {
  try {
    return call();
  } catch (const Error& error) {
    throw Error(error.code(), explained(rings, error), error.index());
  }
}

} // namespace calotte::domain_detail
