// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/require.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "io/cells/polygons.h"

#include <calotte/voronoi.h>

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using base_detail::require;
using base_detail::set_column;
using base_detail::Vec3;
using exact_detail::Plane;

/// The lattice of planar_hex. In a direction with walls it has one more row or column on either
/// side; these are removed. Cells are numbered by rows.
struct Lattice {
  std::int64_t columns, rows;
  double spacing;
  Walls walls;
  std::int64_t wide, high; ///< numbers of columns and rows, including removed ones

  std::int64_t id(std::int64_t row, std::int64_t column) const {
    return ((row + high) % high) * wide + (column + wide) % wide;
  }
  Eigen::Vector2d period() const {
    return {walls.x ? 0 : static_cast<double>(columns) * spacing,
            walls.y ? 0 : static_cast<double>(rows) * spacing * std::sqrt(3.0) / 2};
  }
  Eigen::Vector2d centre(std::int64_t row, std::int64_t column) const {
    const double shift = row % 2 == 0 ? 0.5 : 1;
    return {spacing * (static_cast<double>(column) + shift),
            spacing * static_cast<double>(row + 1) * std::sqrt(3.0) / 2};
  }
  /// A corner of a cell. Each cell has two of its own, on its left.
  Eigen::Vector2d corner(std::int64_t row, std::int64_t column, int which) const {
    const double rise = spacing * std::sqrt(3.0) / 6;
    return centre(row, column) + Eigen::Vector2d(-0.5 * spacing, which == 0 ? rise : -rise);
  }
  /// The corners of a cell, counter-clockwise from the upper left one.
  std::array<std::int64_t, 6> corners(std::int64_t row, std::int64_t column) const {
    const std::int64_t shift = row % 2, here = id(row, column), right = id(row, column + 1),
                       below = id(row - 1, column + shift), above = id(row + 1, column + shift);
    return {2 * here, 2 * here + 1, 2 * below, 2 * right + 1, 2 * right, 2 * above + 1};
  }
};

Lattice make_lattice(std::int64_t columns, std::int64_t rows, double spacing, const Walls& walls) {
  constexpr std::int64_t most = std::int64_t{1} << 28;
  const std::int64_t few_columns = walls.x ? 2 : 3, few_rows = walls.y ? 2 : 4;
  require(columns >= few_columns && rows >= few_rows && (walls.y || rows % 2 == 0),
          "hexagons of {} columns and {} rows: give at least {} columns and {} rows{}", columns,
          rows, few_columns, few_rows, walls.y ? "" : ", an even number for the period in y");
  require(columns <= most && rows <= most / columns,
          "hexagons of {} columns and {} rows are more than 268435456; give fewer", columns, rows);
  require(spacing > 1e-20 && spacing < 1e20,
          "the distance of the hexagons must be from 1e-20 to 1e20");
  return {columns, rows, spacing, walls, columns + (walls.x ? 2 : 0), rows + (walls.y ? 2 : 0)};
}

/// Calls body(row, column) for the cells that are not removed.
template <class Body> void for_each_cell(const Lattice& lattice, const Body& body) {
  const std::int64_t first_row = lattice.walls.y ? 1 : 0, first_column = lattice.walls.x ? 1 : 0;
  for (std::int64_t row = 0; row < lattice.rows; ++row)
    for (std::int64_t column = 0; column < lattice.columns; ++column)
      body(first_row + row, first_column + column);
}

Vec3 within(const Eigen::Vector2d& point, const Eigen::Vector2d& period) {
  return Plane(period).wrapped(Vec3{point.x(), point.y(), 0});
}

Polygons make_hexagons(const Lattice& lattice) {
  const std::int64_t cells = lattice.columns * lattice.rows;
  Polygons out;
  const Eigen::Vector2d period = lattice.period();
  out.surface = domain_detail::UncheckedSurface::of_plane({}, period);
  out.centres.resize(3, cells);
  out.ids.begin.resize(cells + 1);
  out.ids.begin[0] = 0;
  std::vector<std::int32_t> ids;
  ids.reserve(static_cast<std::size_t>(6 * cells));
  std::int64_t next = 0;
  for_each_cell(lattice, [&](std::int64_t row, std::int64_t column) {
    set_column(out.centres, next, within(lattice.centre(row, column), period));
    for (const std::int64_t corner : lattice.corners(row, column))
      ids.push_back(static_cast<std::int32_t>(corner));
    out.ids.begin[++next] = std::ssize(ids);
  });
  out.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
  out.corners.resize(3, 2 * lattice.wide * lattice.high);
  for (std::int64_t row = 0; row < lattice.high; ++row)
    for (std::int64_t column = 0; column < lattice.wide; ++column)
      for (int which = 0; which < 2; ++which)
        set_column(out.corners, 2 * lattice.id(row, column) + which,
                   within(lattice.corner(row, column, which), period));
  return io_detail::with_used_corners(std::move(out));
}

} // namespace

MeshFile planar_hexagons(std::int64_t columns, std::int64_t rows, double spacing, Walls walls) {
  const Lattice lattice = make_lattice(columns, rows, spacing, walls);
  MeshFile file;
  file.format = "hexagons";
  if (walls.x || walls.y) {
    file.polygons = make_hexagons(lattice);
    file.not_voronoi.fault = CellFault::walls;
    return file;
  }
  Points3 points(3, columns * rows);
  std::int64_t next = 0;
  for_each_cell(lattice, [&](std::int64_t row, std::int64_t column) {
    set_column(points, next++, within(lattice.centre(row, column), lattice.period()));
  });
  file.mesh = delaunay(points, Surface::periodic(lattice.period()));
  return file;
}

MeshFile walled(const Mesh& box, const Eigen::Vector2d& extent, Walls walls) {
  require(walls.x || walls.y, "no wall is given; write the periodic mesh, or give one");
  const Eigen::Vector2d& period = box.surface.period();
  for (int k = 0; k < 2; ++k)
    require(!(k == 0 ? walls.x : walls.y) || (extent[k] > 0 && extent[k] < period[k]),
            "the distance of the walls is not positive and below the period of the box; give a "
            "larger box");
  const Voronoi cells = voronoi(box);
  MeshFile file;
  file.format = "cells between walls";
  file.not_voronoi.fault = CellFault::walls;
  Polygons& out = file.polygons.emplace();
  out.surface = domain_detail::UncheckedSurface::of_plane(
      {}, {walls.x ? 0 : period.x(), walls.y ? 0 : period.y()});
  std::vector<std::int32_t> number(static_cast<std::size_t>(cells.vertices.cols()), -1), ids;
  std::vector<std::int64_t> begin{0}, site;
  std::vector<Eigen::Vector3d> corners;
  for (Eigen::Index i = 0; i < cells.cells.cols(); ++i) {
    const Eigen::Vector3d centre = cells.cells.col(i);
    if ((walls.x && centre.x() > extent.x()) || (walls.y && centre.y() > extent.y()))
      continue;
    site.push_back(i);
    for (const std::int32_t vertex : cells.vertices_on_cell[i]) {
      std::int32_t& to = number[static_cast<std::size_t>(vertex)];
      if (to < 0) {
        to = static_cast<std::int32_t>(corners.size());
        Eigen::Vector3d corner = cells.vertices.col(vertex);
        for (int axis = 0; axis < 2; ++axis) // across a wall the copy beside the cell
          if (axis == 0 ? walls.x : walls.y)
            corner[axis] += period[axis] * std::round((centre[axis] - corner[axis]) / period[axis]);
        corners.push_back(corner);
      }
      ids.push_back(to);
    }
    begin.push_back(std::ssize(ids));
  }
  require(!site.empty(), "no site lies between the walls; give more cells");
  const auto count = std::ssize(site);
  out.centres.resize(3, count);
  for (std::int64_t i = 0; i < count; ++i)
    out.centres.col(i) = cells.cells.col(site[static_cast<std::size_t>(i)]);
  out.corners.resize(3, std::ssize(corners));
  for (std::size_t k = 0; k < corners.size(); ++k)
    out.corners.col(static_cast<Eigen::Index>(k)) = corners[k];
  out.ids = {Eigen::Map<const Offsets>(begin.data(), std::ssize(begin)),
             Eigen::Map<const Ids>(ids.data(), std::ssize(ids))};
  return file;
}

} // namespace calotte
