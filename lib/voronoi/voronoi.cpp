// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/voronoi.h>

#include "base/first_fault.h"
#include "base/matrix_memory.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "exact/predicates.h"
#include "voronoi/connectivity.h"
#include "voronoi/geometry.h"
#include "voronoi/stages.h"

#include <calotte/error.h>

#include <cmath>
#include <string>
#include <utility>

namespace calotte {
namespace voronoi_detail {
namespace {

/// A norm that is 1 up to rounding is kept, so that unit columns keep their bits: normalised
/// columns err by 5 units of roundoff, their squares by twice that and 3 of their own.
Vec3 unit_column(const Vec3& x) { return std::abs(dot(x, x) - 1) <= 0x1p-49 ? x : normalised(x); }

/// A mesh of the sphere with sites at other points.
struct MeshAt {
  const Points3& points;
  const Triangles &triangles, &neighbours;
};

void set_cells(const MeshAt& mesh, Voronoi& out) {
  make_room(out.cells, 3, mesh.points.cols());
  FirstFault fault;
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 unit = unit_column(column(mesh.points, i));
      set_column(out.cells, i, unit);
      if (!(std::abs(dot(unit, unit) - 1) < 1e-9)) // NaN for points without a direction
        fault.at(i);
    }
  });
  fault.refuse("site", "has no direction: give finite points other than 0");
}

void set_cells(const PlanarMesh& mesh, Voronoi& out) {
  make_room(out.cells, 3, mesh.points.cols());
  FirstFault fault;
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const double x = mesh.points(0, i), y = mesh.points(1, i);
      set_column(out.cells, i, {x, y, 0});
      if (!(x >= 0 && x < mesh.period[0] && y >= 0 && y < mesh.period[1]))
        fault.at(i);
    }
  });
  fault.refuse("site", "lies outside the periodic box: give the copy of it that is inside");
}

/// Sets all members of begun() except the kind of the space.
template <class AnyMesh> void begin(const AnyMesh& mesh, BegunVoronoi& out) {
  constexpr std::int64_t most_cells = std::int64_t{1} << 29;
  require(mesh.points.cols() <= most_cells,
          "the mesh has " + std::to_string(mesh.points.cols()) +
              " sites, and the edges of more than 536870912 cannot be numbered: give fewer");
  require(mesh.neighbours.cols() == mesh.triangles.cols(),
          "the mesh has " + std::to_string(mesh.triangles.cols()) +
              " triangles but neighbours of " + std::to_string(mesh.neighbours.cols()) +
              ": give a mesh with both");
  out.rings = find_rings(faces_of(mesh), out.voronoi);
  set_cells(mesh, out.voronoi);
}

} // namespace

BegunVoronoi begun(const Points3& points, const Mesh& mesh) {
  require(mesh.closed(),
          "the mesh is open, as all its sites lie in a hemisphere, and its Voronoi cells do not "
          "tessellate the sphere: give sites all around");
  BegunVoronoi out;
  begin(MeshAt{points, mesh.triangles, mesh.neighbours}, out);
  return out;
}

BegunVoronoi begun(const PlanarMesh& mesh) {
  // Products and quotients of areas must stay in the range of doubles.
  require(mesh.period.minCoeff() > 1e-30 && mesh.period.maxCoeff() < 1e30,
          "the box of the plane is " + std::to_string(mesh.period[0]) + " x " +
              std::to_string(mesh.period[1]) +
              ": give two positive periods between 1e-30 and 1e30");
  require(mesh.triangles.cols() == 2 * mesh.points.cols(),
          "the mesh of " + std::to_string(mesh.points.cols()) + " sites has " +
              std::to_string(mesh.triangles.cols()) +
              " triangles, and one that covers a periodic box has two for each site: give "
              "such a mesh");
  BegunVoronoi out;
  out.voronoi.on_sphere = false;
  out.voronoi.period = mesh.period;
  begin(mesh, out);
  return out;
}

void connect(const Mesh& mesh, BegunVoronoi& out) {
  connect(faces_of(mesh), out.rings, out.voronoi);
}

void connect(const PlanarMesh& mesh, BegunVoronoi& out) {
  connect(faces_of(mesh), out.rings, out.voronoi);
}

namespace {

template <class AnyMesh> Voronoi ended(const AnyMesh& mesh, BegunVoronoi begun) {
  connect(mesh, begun);
  measure(begun.voronoi);
  return std::move(begun.voronoi);
}

} // namespace
} // namespace voronoi_detail

Voronoi voronoi(const Mesh& mesh) {
  return voronoi_detail::ended(mesh, voronoi_detail::begun(mesh.points, mesh));
}

Voronoi voronoi(const PlanarMesh& mesh) {
  return voronoi_detail::ended(mesh, voronoi_detail::begun(mesh));
}

} // namespace calotte
