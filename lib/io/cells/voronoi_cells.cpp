// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/voronoi_cells.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "io/cells/dual.h"
#include "io/cells/open_cells.h"
#include "io/cells/polygons.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace calotte::io_detail {
namespace {

/// The square of the distance from a point to the nearest of some columns.
double nearest(const Vec3& p, const Points3& points, std::span<const std::int32_t> ids) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t id : ids) {
    const Vec3 apart = p - column(points, id);
    least = std::min(least, dot(apart, apart));
  }
  return least;
}

/// The largest distance from a corner of either cell to the nearest corner of the other.
double corner_distance(const Voronoi& voronoi, const Polygons& polygons, std::int64_t cell) {
  const std::span<const std::int32_t> corners = polygons.ids[cell],
                                      vertices = voronoi.vertices_on_cell[cell];
  double most = 0;
  for (const std::int32_t id : corners)
    most = std::max(most, nearest(column(polygons.corners, id), voronoi.vertices, vertices));
  for (const std::int32_t id : vertices)
    most = std::max(most, nearest(column(voronoi.vertices, id), polygons.corners, corners));
  return std::sqrt(most);
}

/// The first difference between polygons and Voronoi cells.
/// \pre there are as many of either.
NotVoronoi difference(const Voronoi& voronoi, const Polygons& polygons, double rounding) {
  const std::int64_t count = polygons.size();
  const double width = mean_width(count), tolerance = corner_tolerance(width, rounding);
  std::vector<std::int64_t> first(static_cast<std::size_t>(block_count(count)), -1);
  for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::int64_t& found = first[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end && found < 0; ++i)
      if (!(corner_distance(voronoi, polygons, i) <= tolerance))
        found = i;
  });
  const auto found =
      std::find_if(first.begin(), first.end(), [](std::int64_t cell) { return cell >= 0; });
  if (found == first.end())
    return {};
  if (polygons.ids.count(*found) == 0)
    return {.fault = CellFault::no_corners, .cells = {*found, -1, -1}};
  return {.fault = CellFault::other_corner,
          .cells = {*found, -1, -1},
          .distance = corner_distance(voronoi, polygons, *found) / width};
}

} // namespace

ComparedCells compare_cells(Mesh mesh, const Polygons& polygons, double rounding) {
  ComparedCells out;
  const Surface& surface = mesh.surface;
  if (!surface.is_sphere() && surface.period().isZero(0)) {
    out.answer.fault = CellFault::clipped;
  } else if (!mesh.closed()) {
    out.answer.fault = CellFault::open;
  } else if (polygons.size() != mesh.points.cols()) {
    out.answer = {.fault = CellFault::other_number,
                  .polygons = polygons.size(),
                  .centres = mesh.points.cols()};
  } else {
    out.voronoi = voronoi(mesh);
    out.answer = difference(*out.voronoi, polygons, rounding);
  }
  out.mesh = std::move(mesh);
  return out;
}

ComparedCells compare_cells(Points3 centres, const Polygons& polygons, double rounding,
                            std::vector<MeshField>& fields) {
  ComparedCells out;
  if (centres.cols() == 0) {
    out.answer.fault = CellFault::no_centres;
    return out;
  }
  out.mesh = mesh_of_cells(centres, polygons, rounding, fields);
  if (out.mesh) {
    out.answer.fault = out.mesh->closed() ? CellFault::none : CellFault::open;
    return out;
  }
  if (!cover_sphere(polygons)) {
    out.answer.fault = CellFault::not_circumcentres;
    return out;
  }
  try {
    out.mesh = delaunay(centres);
  } catch (const Error& error) {
    out.answer = {.fault = CellFault::no_triangulation, .detail = error.what()};
    return out;
  }
  out = compare_cells(*std::move(out.mesh), polygons, rounding);
  if (out.answer.fault != CellFault::none) // the triangles of the centres are not those of the file
    out.mesh.reset();
  return out;
}

} // namespace calotte::io_detail

namespace calotte {

std::string NotVoronoi::text() const {
  using base_detail::message;
  switch (fault) {
  case CellFault::none:
    return {};
  case CellFault::open:
    return "the mesh is open";
  case CellFault::walls:
    return "they have a boundary";
  case CellFault::clipped:
    return "the boundary of the plane clips them";
  case CellFault::no_centres:
    return "the cells have no centres";
  case CellFault::other_number:
    return message("there are {} cells, but {} distinct centres", polygons, centres);
  case CellFault::no_corners:
    return message("cell {} has no corners", cells[0]);
  case CellFault::other_corner:
    return message(
        "a corner of cell {} is {} mean cell widths away from that of the Voronoi cell of "
        "its centre",
        cells[0], distance);
  case CellFault::not_circumcentres:
    return "they are a part of the sphere, and their corners are not the circumcentres of three "
           "centres each";
  case CellFault::common_corner:
    return message("the common corner of cells {}, {} and {} is {} cell widths away from the "
                   "circumcentre of their centres",
                   cells[0], cells[1], cells[2], distance);
  case CellFault::no_triangulation:
  case CellFault::no_tessellation:
    break;
  }
  return detail;
}

NotVoronoi not_voronoi(const Polygons& polygons) {
  using namespace io_detail;
  if (polygons.surface.is_sphere()) {
    std::vector<MeshField> fields;
    return compare_cells(polygons.centres, polygons, 0, fields).answer;
  }
  OpenCells cells = open_cells(polygons);
  if (cells.problem.passed() && (cells.voronoi.cells_on_edge.row(1).array() < 0).any())
    cells.problem.fault = CellFault::open;
  return cells.problem;
}

CheckReport check(const Polygons& polygons) {
  using namespace io_detail;
  const DoubleVector areas = areas_of(polygons);
  CheckReport found;
  found.sites = polygons.size();
  found.area = areas.sum();
  found.expected_area = cover_sphere(polygons) ? 4 * std::numbers::pi : 0;
  const auto clockwise =
      std::ranges::find_if(areas, [](double area) { return area < 0; }) - areas.begin();
  if (clockwise < areas.size())
    found.failure = message("cell {} runs clockwise seen from outside", clockwise);
  else
    found.failure = overlap_in(polygons).text;
  if (!found.passed())
    return found;
  if (const NotVoronoi answer = not_voronoi(polygons); !answer.passed())
    found.failure = "the cells are not Voronoi cells: " + answer.text();
  return found;
}

} // namespace calotte
