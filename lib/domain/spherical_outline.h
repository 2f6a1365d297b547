// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arc_tree.h"
#include "domain/arcs.h"
#include "domain/outline.h"
#include "domain/rings.h"
#include "domain/room.h"
#include "domain/side_cells.h"

#include <cstdint>
#include <vector>

namespace calotte::domain_detail {

/// The boundary of a region of the sphere, prepared for many queries. Immutable and thread-safe.
class SphericalOutline {
public:
  /// The region lies to the left of an arc, which is shorter than a half circle; unit vectors.
  using Edge = Arc;

  /// \pre there are rings. \throws Error as Surface::within().
  explicit SphericalOutline(const Surface::Rings& rings);

  double area() const { return area_; }                            ///< steradians
  const std::vector<Edge>& edges() const { return cells_.arcs(); } ///< ring by ring
  /// The corners of each ring, with the region to the left; unit vectors.
  std::vector<std::vector<Vec3>> rings() const;

  /// The position of a direction relative to the boundary; exact for the stored corners. Directions
  /// whose norm is not 1 up to round-off are rounded to unit vectors first, as the corners are.
  Side side(const Vec3& point) const { return cells_.side(as_unit(point)); }

  /// Calls body(edge) once for each edge that may come within a distance of a point. It calls the
  /// body for all edges that do, and for few others. The order of the calls is a function of the
  /// edges and the point.
  /// \param point unit vector. \param reach angle in radians.
  template <class Body>
  void for_each_edge_near(const Vec3& point, double reach, const Body& body) const {
    const double chord = reach + 1e-14; // a chord is shorter than its arc
    tree_.visit([&](const Box3& box) { return square_from(box, point) <= chord * chord; },
                [&](std::int32_t e) {
                  const Edge& edge = edges()[static_cast<std::size_t>(e)];
                  if (square_from(edge, point) <= chord * chord) // boxes of long edges reach far
                    body(edge);
                });
  }

private:
  explicit SphericalOutline(const Rings& rings);

  ArcTree tree_;
  SideCells cells_;
  std::vector<std::int32_t> ring_begin_; ///< in the edges
  double area_;
};

} // namespace calotte::domain_detail
