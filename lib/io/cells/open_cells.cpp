// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/open_cells.h"

#include "base/points.h"
#include "exact/space.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "voronoi/open.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

/// Sets the cells. Corners that are used keep their order.
void set_cells(const Polygons& polygons, Voronoi& out) {
  std::vector<std::int32_t> vertex(static_cast<std::size_t>(polygons.corners.cols()), -1);
  for (const std::int32_t id : polygons.ids.items)
    vertex[static_cast<std::size_t>(id)] = 0;
  std::int32_t count = 0;
  for (std::int32_t& id : vertex)
    id = id < 0 ? -1 : count++;
  out.surface = polygons.surface;
  out.cells = polygons.centres;
  out.vertices.resize(3, count);
  for (std::size_t k = 0; k < vertex.size(); ++k)
    if (vertex[k] >= 0)
      out.vertices.col(vertex[k]) = polygons.corners.col(static_cast<Eigen::Index>(k));
  out.vertices_on_cell = polygons.ids;
  for (std::int32_t& id : out.vertices_on_cell.items)
    id = vertex[static_cast<std::size_t>(id)];
}

/// The length of a chord; in a periodic plane, to the nearest copy.
double chord_length(const Voronoi& cells, const Vec3& from, const Vec3& to) {
  return in_space_of(cells.surface,
                     [&](const auto& space) { return norm(space.offset(from, to)); });
}

/// The distance of a vertex from the circumcentre of its cells, divided by the width or by the
/// distance of the circumcentre from the cells, whichever is larger.
/// \param width mean width of a cell.
double distance_from_circumcentre(const Voronoi& cells, Eigen::Index v, double width) {
  const Vec3 centre = cell_circumcentre(cells, v);
  const double reach =
      chord_length(cells, centre, column(cells.cells, cells.cells_on_vertex(0, v)));
  return chord_length(cells, column(cells.vertices, v), centre) / std::max(width, reach);
}

/// Reports the first vertex that is not a circumcentre.
NotVoronoi first_difference(const Voronoi& cells) {
  const double width = std::sqrt(
      cells.cell_area.sum() / static_cast<double>(std::max<Eigen::Index>(cells.cells.cols(), 1)));
  // Models write the positions of their grids in single precision, on the sphere to 4e-7.
  const double rounding = cells.surface.is_sphere() ? float_rounding : 0,
               tolerance = 1e-6 + rounding / width;
  for (Eigen::Index v = 0; v < cells.vertices.cols(); ++v) {
    if (cells.cells_on_vertex.col(v).minCoeff() < 0)
      continue;
    const double distance = distance_from_circumcentre(cells, v, width);
    if (!(distance <= tolerance))
      return {.fault = CellFault::common_corner,
              .cells = {cells.cells_on_vertex(0, v), cells.cells_on_vertex(1, v),
                        cells.cells_on_vertex(2, v)},
              .distance = distance};
  }
  return {};
}

} // namespace

Vec3 cell_circumcentre(const Voronoi& cells, Eigen::Index v) {
  const Vec3 &a = column(cells.cells, cells.cells_on_vertex(0, v)),
             &b = column(cells.cells, cells.cells_on_vertex(1, v)),
             &c = column(cells.cells, cells.cells_on_vertex(2, v));
  return in_space_of(cells.surface, [&](const auto& space) { return space.circumcentre(a, b, c); });
}

OpenCells open_cells(const Polygons& polygons) {
  OpenCells out;
  if (polygons.centres.cols() != polygons.size()) {
    out.problem.fault = CellFault::no_centres;
    return out;
  }
  set_cells(polygons, out.voronoi);
  try {
    voronoi_detail::connect_open(out.voronoi);
  } catch (const Error& error) {
    out.problem = {.fault = CellFault::no_tessellation, .detail = error.what()};
    return out;
  }
  voronoi_detail::measure_open(out.voronoi);
  out.problem = first_difference(out.voronoi);
  return out;
}

OpenCells open_cells(const MeshFile& file) {
  OpenCells cells = open_cells(*file.polygons);
  const bool whole = file.mesh ? file.mesh->closed() : cover_sphere(*file.polygons);
  if (whole && !cells.problem.passed() && !file.not_voronoi.passed())
    cells.problem = file.not_voronoi;
  return cells;
}

} // namespace calotte::io_detail
