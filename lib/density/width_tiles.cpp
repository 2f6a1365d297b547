// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_tiles.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/vector_loops.h"
#include "density/width_table.h"

#include <array>
#include <cmath>
#include <numbers>

namespace calotte::density_detail {
namespace {

/// The nodes of an edge of a tile.
struct Edge {
  double* values;
  std::int64_t stride;
  std::int32_t intervals;

  double& operator[](std::int64_t k) const { return values[k * stride]; }
};

/// Sets the nodes of an edge to the linear interpolation of another edge, which has at most as many
/// nodes.
void follow(const Edge& other, const Edge& edge) {
  const std::int32_t parts = edge.intervals / other.intervals;
  for (std::int32_t k = 0; k < other.intervals; ++k)
    for (std::int32_t part = 1; part < parts; ++part)
      edge[std::int64_t{k} * parts + part] =
          other[k] + (other[k + 1] - other[k]) * (static_cast<double>(part) / parts);
}

void join(const Edge& a, const Edge& b) {
  if (a.intervals < b.intervals)
    follow(a, b);
  else
    follow(b, a);
}

} // namespace

Vec3 point_at(double x, double y, bool of_plane) {
  return of_plane ? Vec3{x, y, 0} : base_detail::from_lonlat(x, y);
}

Extent extent_of(const CoordinateBox& box, bool of_plane) {
  const Vec3 middle = point_at(box.west + box.dx / 2, box.south + box.dy / 2, of_plane);
  double reach = 0, widest = 0;
  for (const double y : {box.south, box.south + box.dy}) {
    const Vec3 a = point_at(box.west, y, of_plane), b = point_at(box.west + box.dx, y, of_plane);
    reach = std::max({reach, norm(a - middle), norm(b - middle)});
    widest = std::max(widest, norm(b - a));
  }
  constexpr double slack = 1e-9;
  if (of_plane)
    return {middle, reach * (1 + slack), box.dx, box.dy};
  const auto arc = [](double chord) { return 2 * base_detail::arc_sine(chord / 2); };
  return {middle, arc(reach) + slack, arc(widest), box.dy * (std::numbers::pi / 180)};
}

TileBox tiles_of_sphere() { return {-180, 1, -90, 1, 360, 180, false, true, false}; }

WidthTiles::WidthTiles(const TileBox& box, const std::vector<Shape>& shapes) : box_(box) {
  std::int32_t begin = 0;
  const auto add = [&](const Shape& shape) {
    layout_.begin.push_back(begin);
    layout_.columns.push_back(shape.columns);
    layout_.rows.push_back(shape.rows);
  };
  auto shape = shapes.begin();
  for (std::int32_t row = 0; row < box.rows; ++row) {
    for (std::int32_t column = 0; column < box.columns; ++column, ++shape) {
      add(*shape);
      outside_.push_back(shape->outside);
      begin += (shape->columns + 1) * (shape->rows + 1);
    }
    add({1, 1});
  }
  values_.resize(static_cast<std::size_t>(begin));
}

double WidthTiles::Tile::sine(std::int64_t j) const {
  return base_detail::from_lonlat(0, y_[j] * (180 / std::numbers::pi)).z;
}

WidthTiles::Tile WidthTiles::operator[](std::int64_t tile) const {
  const TileNodes nodes = at(tile);
  const double unit = box_.unit();
  Tile result;
  result.x_ = {x_of(tile, 0) * unit, box_.dx * unit / nodes.columns, nodes.columns};
  result.y_ = {y_of(tile, 0) * unit, box_.dy * unit / nodes.rows, nodes.rows};
  result.values_ = &values_[static_cast<std::size_t>(nodes.begin)];
  return result;
}

std::vector<Vec3> WidthTiles::points(std::int64_t tile) const {
  const TileNodes nodes = at(tile);
  std::vector<Vec3> round, points;
  for (std::int32_t i = 0; i <= nodes.columns; ++i)
    round.push_back(box_.of_plane ? Vec3{x_of(tile, i), 0, 0}
                                  : base_detail::from_lonlat(x_of(tile, i), 0));
  for (std::int32_t j = 0; j <= nodes.rows; ++j) {
    const double y = y_of(tile, j);
    const Vec3 meridian = box_.of_plane ? Vec3() : base_detail::from_lonlat(0, y);
    for (const Vec3& at : round)
      points.push_back(box_.of_plane ? Vec3{at.x, y, 0}
                                     : Vec3{meridian.x * at.x, meridian.x * at.y, meridian.z});
  }
  return points;
}

namespace {

/// Some columns and rows of nodes.
struct NodeBlock {
  std::int32_t west, columns, south, rows;
};

/// Appends the nodes of a block, half by half.
void append_halves(const NodeBlock& block, std::int32_t stride, std::vector<std::int32_t>& nodes) {
  if (block.columns == 1 && block.rows == 1) {
    nodes.push_back(block.south * stride + block.west);
    return;
  }
  NodeBlock first = block, second = block;
  if (block.columns > block.rows) {
    first.columns /= 2;
    second.west += first.columns;
    second.columns -= first.columns;
  } else {
    first.rows /= 2;
    second.south += first.rows;
    second.rows -= first.rows;
  }
  append_halves(first, stride, nodes);
  append_halves(second, stride, nodes);
}

} // namespace

std::vector<std::int32_t> WidthTiles::near_order(std::int64_t tile) const {
  const TileNodes nodes = at(tile);
  std::vector<std::int32_t> order;
  order.reserve(static_cast<std::size_t>((nodes.columns + 1) * (nodes.rows + 1)));
  append_halves({0, nodes.columns + 1, 0, nodes.rows + 1}, nodes.columns + 1, order);
  return order;
}

/// \param across whether b lies east of a; else it lies north.
void WidthTiles::join(std::int64_t a, std::int64_t b, bool across) {
  const TileNodes of_a = at(a), of_b = at(b);
  double *const values_a = values(a), *const values_b = values(b);
  if (across)
    density_detail::join({values_a + of_a.columns, of_a.columns + 1, of_a.rows},
                         {values_b, of_b.columns + 1, of_b.rows});
  else
    density_detail::join({values_a + std::int64_t{of_a.rows} * (of_a.columns + 1), 1, of_a.columns},
                         {values_b, 1, of_b.columns});
}

void WidthTiles::join_edges() {
  const auto join_beside = [&](std::int64_t tile, std::int64_t beside, bool across) {
    if (!lies_outside(tile) && !lies_outside(beside))
      join(tile, beside, across);
  };
  const std::int64_t columns = box_.columns, last_row = size() - columns;
  for (std::int64_t tile = 0; tile < size(); ++tile) {
    const bool is_last = tile % columns == columns - 1;
    if (!is_last || box_.around_x)
      join_beside(tile, is_last ? tile + 1 - columns : tile + 1, true);
    if (tile < last_row || box_.around_y)
      join_beside(tile, tile < last_row ? tile + columns : tile - last_row, false);
  }
}

namespace {

/// Cells of a plane; see find_cells().
void find_cells_of_plane(const WidthTable::Grid& grid, const double* x, const double* y,
                         std::size_t count, GridCells& out) {
  for (std::size_t k = 0; k < count; ++k) {
    std::int32_t i = 0, j = 0;
    split_position((x[k] - grid.west) * grid.inverse_dx, grid.columns, i, out.u[k]);
    split_position((y[k] - grid.south) * grid.inverse_dy, grid.rows, j, out.v[k]);
    out.corner[k] = j * (grid.columns + 1) + i;
  }
}

/// Replaces the cells of a box, which are tiles, by the cells of these tiles.
/// \param stride from a node to the one north of it.
CALOTTE_VECTOR_WIDTHS
void find_nodes(const WidthTiles::Layout& layout, std::size_t count, GridCells& cells,
                std::int32_t* stride) {
  const std::int32_t *const begin = layout.begin.data(), *const columns = layout.columns.data(),
                            *const rows = layout.rows.data();
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t tile = cells.corner[k], across = columns[tile], up = rows[tile];
    std::int32_t i = 0, j = 0;
    double u = 0, v = 0;
    split_position(cells.u[k] * across, across, i, u);
    split_position(cells.v[k] * up, up, j, v);
    cells.corner[k] = begin[tile] + j * (across + 1) + i;
    stride[k] = across + 1;
    cells.u[k] = u;
    cells.v[k] = v;
  }
}

CALOTTE_VECTOR_WIDTHS
void interpolate_in_tiles(const GridCells& cells, const std::int32_t* stride, const double* values,
                          std::size_t count, double* widths) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < count; ++k) {
    const double* const low = values + cells.corner[k];
    const double* const high = low + stride[k];
    const double u = cells.u[k], south = low[0] + u * (low[1] - low[0]),
                 north = high[0] + u * (high[1] - high[0]);
    widths[k] = south + cells.v[k] * (north - south);
  }
}

} // namespace

void WidthTiles::operator()(const double* x, const double* y, const double* z, std::size_t count,
                            double* widths) const {
  const double unit = box_.unit();
  const WidthTable::Grid grid{box_.west * unit,     1 / (box_.dx * unit), box_.south * unit,
                              1 / (box_.dy * unit), box_.columns,         box_.rows};
  GridCells cells;
  std::array<std::int32_t, GridCells::size> stride;
  for (std::size_t begin = 0; begin < count; begin += GridCells::size) {
    const std::size_t size = std::min(GridCells::size, count - begin);
    if (box_.of_plane)
      find_cells_of_plane(grid, x + begin, y + begin, size, cells);
    else
      find_cells(grid, x + begin, y + begin, z + begin, size, cells);
    find_nodes(layout_, size, cells, stride.data());
    interpolate_in_tiles(cells, stride.data(), values_.data(), size, widths + begin);
  }
}

} // namespace calotte::density_detail
