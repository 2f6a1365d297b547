// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "domain/arcs.h"
#include "domain/outline.h"
#include "domain/room.h"
#include "domain/spherical_outline.h"
#include "domain/surface.h"

#include <calotte/surface.h>

namespace calotte::domain_detail {

/// Whether the boundary of a surface may come within a distance of a point: false is certain.
/// \param point unit vector, in a plane x y 0. \param reach radians, in a plane its unit.
bool is_near_boundary(const Surface& surface, const Vec3& point, double reach);

/// Calls body(edge) for each edge of a boundary that may come within a distance of a point, in a
/// plane a straight line. The order of the calls is a function of the edges and the point.
/// \param point unit vector, in a plane x y 0. \param reach radians, in a plane its unit.
template <Space S, class Body>
void for_each_edge_near(const OutlineOf<S>& outline, const Vec3& point, double reach,
                        const Body& body) {
  if constexpr (S::on_sphere)
    outline.for_each_edge_near(point, reach, body);
  else
    outline.for_each_edge_near(
        {{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}},
        [&](const Outline::Edge& edge) {
          body(Arc{{edge.from.x, edge.from.y, 0}, {edge.to.x, edge.to.y, 0}});
        });
}

/// The point of an edge nearest to x.
template <Space S> Vec3 nearest_point(const Arc& edge, const Vec3& x);
extern template Vec3 nearest_point<Sphere>(const Arc&, const Vec3&);
extern template Vec3 nearest_point<Plane>(const Arc&, const Vec3&);

} // namespace calotte::domain_detail
