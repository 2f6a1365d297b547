// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/voronoi.h>

#include "base/first_fault.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "exact/predicates.h"
#include "mesh/ids.h"
#include "voronoi/connectivity.h"
#include "voronoi/far_side.h"
#include "voronoi/geometry.h"
#include "voronoi/open.h"
#include "voronoi/stages.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte {
namespace voronoi_detail {
namespace {

/// The unit vector of x. A vector of norm 1 up to rounding keeps its bits: normalised columns err
/// by 5 units of roundoff, their squares by twice that plus 3.
Vec3 unit_column(const Vec3& x) { return std::abs(dot(x, x) - 1) <= 0x1p-49 ? x : normalised(x); }

/// \throws Error invalid_argument for a mesh that does not cover its space.
void set_space(const Mesh& mesh, Voronoi& out) {
  if (mesh.surface.is_sphere()) {
    require(mesh.closed(), "the mesh is open, and a grid of its cells would reach round the far "
                           "side of the sphere: give sites all around");
    return;
  }
  // Products and quotients of areas must stay in the range of doubles.
  const Eigen::Vector2d& period = mesh.surface.period();
  require(period.minCoeff() > 1e-30 && period.maxCoeff() < 1e30,
          "the box of the plane is {} x {}: give two positive periods between 1e-30 and 1e30",
          period[0], period[1]);
  require(mesh.closed(),
          "the mesh of {} sites has {} triangles, and one that covers a periodic box has two for "
          "each site: give such a mesh",
          mesh.points.cols(), mesh.triangles.cols());
  out.surface = mesh.surface;
}

/// Sets the cells, the starts of their lists of edges, and the kind of space.
Rings begin(const Mesh& mesh, Voronoi& out) {
  set_space(mesh, out);
  constexpr std::int64_t most_cells = std::int64_t{1} << 29;
  require(mesh.points.cols() <= most_cells,
          "the mesh has {} sites, and the edges of more than {} cannot be numbered: give fewer",
          mesh.points.cols(), most_cells);
  require_neighbours(mesh);
  Rings rings = find_rings(faces_of(mesh), out);
  out.cells = checked_centres(mesh);
  return rings;
}

void copy_triangles(const Triangles& triangles, Voronoi& out) {
  out.cells_on_vertex.resize(3, triangles.cols());
  for_each_block(triangles.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::copy(triangles.data() + begin, triangles.data() + end, out.cells_on_vertex.data() + begin);
  });
}

Voronoi voronoi_of_closed(const Mesh& mesh) {
  Voronoi out;
  const Rings rings = begin(mesh, out);
  copy_triangles(mesh.triangles, out);
  connect(faces_of(mesh), rings, out);
  measure(out);
  return out;
}

/// The tessellation of an open mesh. The measures put corners on the near side, so the corners of
/// the far side are set here.
Voronoi voronoi_of_open(const Mesh& mesh) {
  const Mesh hull = triangulate_hull(mesh);
  Voronoi out;
  const Rings rings = begin(hull, out);
  copy_triangles(hull.triangles, out);
  connect(faces_of(hull), rings, out);
  out.vertices.resize(3, hull.triangles.cols());
  for_each_block(hull.triangles.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const Vec3 &a = column(out.cells, hull.triangles(0, t)),
                 &b = column(out.cells, hull.triangles(1, t)),
                 &c = column(out.cells, hull.triangles(2, t));
      const Vec3 normal = normalised(cross(b - a, c - a));
      // Rounding can turn the normal of a triangle whose corners are equal up to rounding.
      const bool turned = dot(normal, a) < 0 ? !is_far(hull, t) : is_far(hull, t);
      set_column(out.vertices, t, turned ? -normal : normal);
    }
  });
  measure_open(out);
  for (std::int64_t t = 0; t < hull.triangles.cols(); ++t)
    if (is_far(hull, t))
      measure_far(hull, t, out);
  measure_areas(out); // of kites: the corners of a cell can be opposite each other
  return out;
}

} // namespace

Points3 checked_centres(const Mesh& mesh) {
  const bool on_sphere = mesh.surface.is_sphere();
  const Eigen::Vector2d& period = mesh.surface.period();
  const auto is_in = [](double x, double side) {
    return std::isfinite(x) && (side == 0 || (x >= 0 && x < side));
  };
  Points3 centres;
  centres.resize(3, mesh.points.cols());
  FirstFault fault;
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3& point = column(mesh.points, i);
      const Vec3 centre = on_sphere ? unit_column(point) : Vec3{point.x, point.y, 0};
      set_column(centres, i, centre);
      const bool right = on_sphere ? std::abs(dot(centre, centre) - 1) < 1e-9 // not NaN
                                   : is_in(centre.x, period[0]) && is_in(centre.y, period[1]);
      if (!right)
        fault.at(i);
    }
  });
  fault.refuse("site", on_sphere
                           ? "has no direction: give finite points other than 0"
                           : "lies outside the periodic box: give the copy of it that is inside");
  return centres;
}

BegunVoronoi begun(Mesh& mesh) {
  BegunVoronoi out;
  out.rings = begin(mesh, out.voronoi);
  out.voronoi.cells_on_vertex = std::move(mesh.triangles);
  out.neighbours = std::move(mesh.neighbours);
  return out;
}

void connect(BegunVoronoi& out) {
  connect(Faces{out.voronoi.cells_on_vertex, out.neighbours, out.voronoi.cells.cols()}, out.rings,
          out.voronoi);
  out.rings = {};
  out.neighbours = {};
}

} // namespace voronoi_detail

Voronoi voronoi(const Mesh& mesh) {
  using namespace voronoi_detail;
  const Surface& surface = mesh.surface;
  if (surface.is_bounded())
    return bounded(mesh);
  return surface.is_sphere() && !mesh.closed() ? voronoi_of_open(mesh) : voronoi_of_closed(mesh);
}

Polygons polygons_of(Voronoi voronoi) {
  return {std::move(voronoi.vertices), std::move(voronoi.vertices_on_cell),
          std::move(voronoi.cells), std::move(voronoi.surface)};
}

} // namespace calotte
