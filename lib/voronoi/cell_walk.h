// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "voronoi/room.h"

#include <calotte/voronoi.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace calotte::voronoi_detail {

/// Walks along arcs from cell to cell of a closed tessellation of the sphere. The cells are the
/// polygons of its vertices; which side of an edge a point is on is exact, and the same for both
/// cells. The walk passes through edges only.
///
/// A point on an edge, or an arc through a vertex, may have no such walk: a caller rotates its arcs
/// slightly.
class CellWalk {
public:
  /// \pre cells and vertices are unit columns; the neighbours of cells are theirs across the edges.
  explicit CellWalk(const Voronoi& cells) : cells_(cells) {}

  /// The cell that contains a unit vector. \param near a cell; the time is proportional to the
  /// number of cells between it and the point.
  /// \throws Error invalid_argument, if there is no walk.
  std::int32_t locate(std::int32_t near, const Vec3& point) const;

  /// Walks along an arc from the cell that contains its start.
  /// \param cross called as cross(cell, k) before the walk leaves a cell through the edge at index
  ///        k of its lists.
  /// \returns the cell that contains the end.
  /// \throws Error invalid_argument, if there is no walk, as in a mesh that does not cover the
  /// sphere.
  template <class Cross>
  std::int32_t walk(std::int32_t cell, const Arc& arc, const Cross& cross) const {
    for (std::int64_t steps = 0; steps <= cells_.cells.cols(); ++steps) {
      const std::optional<std::size_t> exit = find_exit(cell, arc);
      if (!exit)
        return cell;
      cross(cell, *exit);
      cell = cells_.cells_on_cell[cell][*exit];
      if (cell < 0)
        break;
    }
    lose();
  }

private:
  /// The index, in the cell's lists, of the edge through which the arc leaves the cell; none if the
  /// arc ends in the cell.
  std::optional<std::size_t> find_exit(std::int32_t cell, const Arc& arc) const;
  bool is_inside(std::int32_t cell, std::size_t index, const Vec3& x) const;
  [[noreturn]] static void lose();

  const Voronoi& cells_;
};

} // namespace calotte::voronoi_detail
