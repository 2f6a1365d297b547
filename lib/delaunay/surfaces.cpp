// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"

#include "base/points.h"
#include "base/require.h"

#include <utility>

namespace calotte {
namespace {

using namespace delaunay_detail;
using base_detail::directions_of;
using base_detail::plane_points_of;
using base_detail::require;

/// The mesh of points of a surface that is a plane.
Mesh mesh_in_plane(const PointsRef& points, const Surface& surface, const DelaunayOptions& options,
                   DelaunayReport& report) {
  const Points2Ref planar = plane_points_of(points);
  if (surface.is_box())
    return mesh_of_box(planar, surface, options, report);
  require(surface.period().isZero(0),
          "the surface is a channel, periodic in one direction only, and points do not tell where "
          "its walls are: make its mesh with make_grid(), or read it from a file");
  Mesh mesh = mesh_of_plane(planar, options, report);
  mesh.surface = surface;
  return mesh;
}

} // namespace

calotte::Triangulation triangulate(const PointsRef& points, const Surface& surface,
                                   const DelaunayOptions& options) {
  calotte::Triangulation out;
  if (surface.is_sphere()) {
    out.mesh =
        mesh_of_sphere(directions_of(points, "call triangulate() with a surface of the plane"),
                       options, out.report);
    out.mesh.surface = surface;
  } else {
    out.mesh = mesh_in_plane(points, surface, options, out.report);
  }
  return out;
}

calotte::Triangulation triangulate(Points3&& points, const Surface& surface,
                                   const DelaunayOptions& options) {
  if (!surface.is_sphere())
    return triangulate(PointsRef(points), surface, options);
  calotte::Triangulation out;
  out.mesh = mesh_of_sphere(std::move(points), options, out.report);
  out.mesh.surface = surface;
  return out;
}

} // namespace calotte
