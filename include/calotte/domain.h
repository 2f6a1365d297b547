// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

#include <functional>
#include <utility>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// A bounded domain of the plane: the interior of closed polygons, or a doubly periodic box.
struct PlanarDomain {
  /// Boundary polygons, each 2 x corners in either orientation, in any unit of length; an edge
  /// joins the last corner to the first. A point is inside the domain if it lies inside an odd
  /// number of rings, so that rings can be outer boundaries, holes and islands. Default: none, a
  /// periodic box.
  std::vector<DoubleMatrix> rings;
  /// Side lengths of the box [0, period.x) x [0, period.y); from 1e-30 to 1e30 without rings, else
  /// 0.
  Eigen::Vector2d period{0, 0};

  PlanarDomain() = default; ///< neither rings nor a box
  /// The members.
  PlanarDomain(std::vector<DoubleMatrix> all, const Eigen::Vector2d& box = {0, 0})
      : rings(std::move(all)), period(box) {}
  PlanarDomain(const Surface& surface); ///< \throws Error bad_option for the sphere

  /// True for a periodic box.
  bool periodic() const { return rings.empty(); }
};

/// The rectangle [lower.x, upper.x] x [lower.y, upper.y], in any unit of length.
/// \param lower, upper opposite corners; finite.
/// \throws Error bad_option unless lower < upper in both coordinates.
PlanarDomain rectangle(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper);

/// The doubly periodic box [0, period.x) x [0, period.y).
/// \param period side lengths, from 1e-30 to 1e30, in any unit of length.
/// \throws Error bad_option for a side length out of range.
PlanarDomain periodic_box(const Eigen::Vector2d& period);

/// Throws unless the rings bound a well-defined region, or the period is valid. Absolute
/// coordinates are at most 1e30; the domain's extent is at least 1e-30.
/// \throws Error bad_option, naming ring and corner: no ring and no period; a ring that has not 2
///         rows; fewer than three corners; a coordinate that is not finite; an edge without length;
///         edges that meet elsewhere than in the corner that joins them.
void require_domain(const PlanarDomain& domain);

/// The area of the domain, in the square of its unit.
/// \throws Error as require_domain() if the domain has rings.
double area(const PlanarDomain& domain);

/// True if the point lies inside the domain or on its boundary; for a periodic box, if it lies in
/// the half-open box. The test is exact. Each call prepares the boundary; for many places call
/// containing().
/// \param place in the unit of the domain; false for NaN.
/// \throws Error as require_domain() if the domain has rings.
bool contains(const PlanarDomain& domain, const Eigen::Vector2d& place);

/// Returns contains() as a function for many places. It prepares the boundary once; a call reads
/// only the edges near the place. The result keeps a copy of the boundary.
/// \throws Error as require_domain() if the domain has rings.
std::function<bool(const Eigen::Vector2d&)> containing(const PlanarDomain& domain);

} // namespace calotte
CALOTTE_API_END
