// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/types.h>

#include <functional>
#include <vector>

CALOTTE_API_BEGIN
namespace calotte {

/// A part of the plane that cells tessellate: what closed polygons enclose, or a doubly periodic
/// box.
struct PlanarDomain {
  /// Polygons, 2 x corners each, in either sense; the last corner is joined to the first. Inside is
  /// what lies inside an odd number of them: outer boundaries, holes in these, islands in those.
  std::vector<Eigen::MatrixXd> rings;
  Eigen::Vector2d period{0, 0}; ///< without rings: of the box [0, period.x) x [0, period.y)

  bool periodic() const { return rings.empty(); }
};

/// \throws Error bad_option unless lower < upper.
PlanarDomain rectangle(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper);

/// \throws Error bad_option for a period that is not positive and finite.
PlanarDomain periodic_box(const Eigen::Vector2d& period);

/// Refuses what encloses no area in one way only. Coordinates may be as large as 1e30, and the
/// domain as small as 1e-30.
/// \throws Error bad_option, naming ring and corner: no ring and no period; a ring that has not 2
///         rows; fewer than three
///         corners; a coordinate that is not finite; an edge without length; edges that meet
///         elsewhere than in the corner that joins them.
void require_domain(const PlanarDomain& domain);

/// \pre require_domain().
double area(const PlanarDomain& domain);

/// Whether a place is inside or on the boundary, exactly; of a box, whether it is in the half-open
/// box. It looks at the whole boundary each time. \pre require_domain().
bool contains(const PlanarDomain& domain, const Eigen::Vector2d& place);

/// contains() for many places: the boundary is prepared once, and a call looks at the part of it
/// beside the place. \pre require_domain().
std::function<bool(const Eigen::Vector2d&)> containing(const PlanarDomain& domain);

} // namespace calotte
CALOTTE_API_END
