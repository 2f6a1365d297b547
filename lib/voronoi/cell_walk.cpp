// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/cell_walk.h"

#include "base/points.h"
#include "base/require.h"
#include "voronoi/connectivity.h"

#include <span>

namespace calotte::voronoi_detail {

/// Whether x is on the cell's side of an edge. The edge's great circle runs from the lower vertex
/// to the higher one and belongs to its left side.
bool CellWalk::is_inside(std::int32_t cell, std::size_t index, const Vec3& x) const {
  const std::int32_t a = start_of(cells_, cell, index), b = cells_.vertices_on_cell[cell][index];
  const Vec3 &from = column(cells_.vertices, a), &to = column(cells_.vertices, b);
  return a < b ? turn(from, to, x) >= 0 : turn(to, from, x) < 0;
}

/// The great circle of the arc leaves a cell through the edge whose start is to its right and whose
/// end is to its left. The arc ends before that edge or beyond it.
std::optional<std::size_t> CellWalk::find_exit(std::int32_t cell, const Arc& arc) const {
  const std::span<const std::int32_t> vertices = cells_.vertices_on_cell[cell];
  const auto is_left = [&](std::int32_t vertex) {
    return turn(arc.from, arc.to, column(cells_.vertices, vertex)) >= 0;
  };
  bool left = is_left(vertices.back());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const bool was_left = left;
    left = is_left(vertices[k]);
    if (!was_left && left)
      return is_inside(cell, k, arc.to) ? std::nullopt : std::optional(k);
  }
  lose();
}

std::int32_t CellWalk::locate(std::int32_t near, const Vec3& point) const {
  std::int32_t cell = near;
  double nearest = dot(column(cells_.cells, cell), point);
  for (bool moved = true; moved;) {
    moved = false;
    const std::int32_t here = cell;
    for (const std::int32_t other : cells_.cells_on_cell[here]) {
      const double cosine = other < 0 ? -2 : dot(column(cells_.cells, other), point);
      if (cosine > nearest) {
        nearest = cosine;
        cell = other;
        moved = true;
      }
    }
  }
  const Vec3& generator = column(cells_.cells, cell);
  if (generator.x == point.x && generator.y == point.y && generator.z == point.z)
    return cell;
  return walk(cell, {generator, point}, [](std::int32_t, std::size_t) {});
}

void CellWalk::lose() {
  refuse("a line leaves the cells of the mesh, which do not cover the sphere; give a global mesh");
}

} // namespace calotte::voronoi_detail
