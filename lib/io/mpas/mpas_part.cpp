// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_part.h"

#include "base/parallel.h"
#include "base/require.h"
#include "io/bytes/big_endian.h"
#include "io/mpas/mpas.h"
#include "io/mpas/vertex_order.h"
#include "voronoi/connectivity.h"

#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace calotte::io_detail {
namespace {

/// Throws unless the file has a mesh of the sphere with the lists of its cells.
void require_lists(const NetcdfReader& file) {
  const std::string& path = file.path();
  require(is_mpas(file), "{} holds no MPAS mesh; convert it with calotte convert", path);
  require(!is_planar_mpas(file), "{} holds a mesh of the plane, not of the sphere; give another",
          path);
  for (const char* name :
       {mpas::n_edges_on_cell, mpas::cells_on_cell, mpas::edges_on_cell, mpas::vertices_on_cell})
    require(file.has_variable(name), "{} holds no {}; complete it with calotte convert IN OUT.nc",
            path, name);
  for (const MpasKind& kind : {mpas_cell, mpas_edge, mpas_vertex})
    if (file.dimension(kind.dimension()) < 0)
      file.fail("it has no dimension {}; make the file again", kind.dimension());
}

/// The radius of the sphere.
/// \throws Error parse, unless the first generator is on the sphere of the attribute.
double read_radius(const NetcdfReader& file) {
  std::array<double, 3> x{};
  for (std::size_t k = 0; k < 3; ++k)
    file.rows(mpas_cell.axis(k), 0, 1, &x[k]);
  const double distance = norm(Vec3{x[0], x[1], x[2]}),
               radius = file.number("", "sphere_radius", distance);
  if (!(std::abs(radius - distance) <= 1e-3 * distance))
    file.fail(
        "the first cell is {} from the centre of the sphere, but the attribute sphere_radius is "
        "{}; correct it",
        distance, radius);
  return radius;
}

Points3 read_coordinates(const NetcdfReader& file, const MpasKind& kind, std::int64_t count) {
  Points3 points(3, count);
  for (int row = 0; row < 3; ++row) {
    const std::vector<double> values = file.doubles(kind.axis(row), {count});
    points.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), count);
  }
  return points;
}

/// Throws unless edge k of each cell joins vertices k - 1 and k, and the other cell agrees.
void require_edges(const NetcdfReader& file, std::int64_t edges, const Voronoi& cells) {
  if (cells.edges_on_cell.items.minCoeff() < 0 || cells.vertices_on_cell.items.minCoeff() < 0)
    file.fail("a cell lacks an edge or a vertex; give a global mesh");
  Pairs ends = Pairs::Constant(2, edges, -1);
  for (std::int64_t i = 0; i < cells.vertices_on_cell.size(); ++i) {
    const std::span<const std::int32_t> vertices = cells.vertices_on_cell[i];
    if (vertices.size() < 3)
      file.fail("cell {} (1-based) has {} edges in nEdgesOnCell, fewer than three; make the file "
                "again",
                i + 1, vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::int32_t end = vertices[k], start = voronoi_detail::start_of(cells, i, k);
      const Eigen::Vector2i pair(std::min(start, end), std::max(start, end));
      auto known = ends.col(cells.edges_on_cell[i][k]);
      if (known[0] >= 0 && known != pair)
        file.fail(
            "edgesOnCell and verticesOnCell of cell {} (1-based) do not correspond: in all "
            "cells edge k lies between vertices k - 1 and k, or between k and k + 1; make the "
            "file again",
            i + 1);
      known = pair;
    }
  }
}

template <class T>
void take_row(const NetcdfReader& file, const std::string& variable, std::int64_t row,
              const T* stored, std::int64_t bound, std::span<std::int32_t> out) {
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (stored[k] < 0 || stored[k] > bound + 1)
      file.fail("{} has the id {} at cell {} (both 1-based), but there are {}; make the file again",
                variable, stored[k], row + 1, bound);
    out[k] = stored[k] == bound + 1 ? -1 : static_cast<std::int32_t>(stored[k]) - 1;
  }
}

/// Keeps the edges, or vertices, that the lists of kept cells name.
/// \param cells_at receives the number of kept cells at each.
Kept select_named(const Ids& ids, std::int64_t bound, std::vector<std::uint8_t>& cells_at) {
  std::vector<std::int8_t> count(static_cast<std::size_t>(bound), -1);
  for (const std::int32_t id : ids)
    if (id >= 0 && count[static_cast<std::size_t>(id)] < 3)
      count[static_cast<std::size_t>(id)] = std::max<std::int8_t>(
          static_cast<std::int8_t>(count[static_cast<std::size_t>(id)] + 1), 1);
  Kept kept = select_kept(count);
  cells_at.resize(static_cast<std::size_t>(kept.count()));
  for (std::int64_t k = 0; k < kept.count(); ++k)
    cells_at[static_cast<std::size_t>(k)] =
        static_cast<std::uint8_t>(count[static_cast<std::size_t>(kept.old[k])]);
  return kept;
}

/// Replaces old ids by new ones.
void renumber(const Kept& kept, Ids& ids) {
  for_each_block(ids.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k)
      if (ids[k] >= 0)
        ids[k] = kept.number[ids[k]] - 1;
  });
}

} // namespace

MpasSource::MpasSource(const std::string& path) : netcdf_(path) {
  require_lists(netcdf_);
  const NetcdfReader& file = netcdf_;
  cells_ = file.dimension(mpas_cell.dimension());
  edges_ = file.dimension(mpas_edge.dimension());
  vertices_ = file.dimension(mpas_vertex.dimension());
  radius_ = read_radius(file);
  vertex_order_ = read_vertex_order(file);
  counts_ = file.ints(mpas::n_edges_on_cell, {cells_});
  const std::int64_t width = netcdf_.product(netcdf_.find(mpas::cells_on_cell), 1, 2);
  for (const std::int32_t count : counts_)
    if (count < 0 || count > width)
      file.fail("nEdgesOnCell is {} at a cell, but cellsOnCell holds {}; make the file again",
                count, width);
}

Points3 MpasSource::generators() const { return read_coordinates(netcdf_, mpas_cell, cells_); }

Points3 MpasSource::vertex_points() const {
  return read_coordinates(netcdf_, mpas_vertex, vertices_);
}

IdLists MpasSource::lists(const std::string& variable, std::int64_t bound) const {
  Kept all{Array<std::int32_t>(cells_), {}};
  for (std::int32_t i = 0; i < cells_; ++i)
    all.old[i] = i;
  return lists(variable, bound, all);
}

IdLists MpasSource::lists(const std::string& variable, std::int64_t bound, const Kept& kept) const {
  const int v = netcdf_.find(variable);
  const NetcdfReader& file = netcdf_;
  const std::int64_t width = netcdf_.product(netcdf_.find(mpas::cells_on_cell), 1, 2);
  if (file.shape_of(variable) != std::vector<std::int64_t>{cells_, width})
    file.fail("{} has another shape than cellsOnCell; make the file again", variable);
  const std::optional<NetcdfType> type = netcdf_.variables()[static_cast<std::size_t>(v)].type;
  if (type != NetcdfType::int32 && type != NetcdfType::int64)
    file.fail("{} does not hold integers of 4 or 8 bytes; make the file again", variable);
  const bool turned =
      variable == mpas::vertices_on_cell && vertex_order_ == VertexOrder::before_edges;
  IdLists lists{Offsets(kept.count() + 1), {}};
  lists.begin[0] = 0;
  for (std::int64_t i = 0; i < kept.count(); ++i)
    lists.begin[i + 1] = lists.begin[i] + counts_[static_cast<std::size_t>(kept.old[i])];
  lists.items.resize(lists.begin[kept.count()]);
  for_each_block(kept.count(), [&](std::int64_t, std::int64_t first, std::int64_t last) {
    const std::int64_t values = (last - first) * width, size = size_of(*type);
    Array<std::int64_t> room(values); // sufficient for ids of 4 or 8 bytes
    auto* const bytes = reinterpret_cast<char*>(room.begin());
    read_kept_rows(netcdf_, v, 0, kept, first, last, bytes);
    swap_big_endian(bytes, values, size, bytes);
    for (std::int64_t i = first; i < last; ++i) {
      const char* const row = bytes + (i - first) * width * size;
      if (size == 4)
        take_row(netcdf_, variable, kept.old[i], reinterpret_cast<const std::int32_t*>(row), bound,
                 lists[i]);
      else
        take_row(netcdf_, variable, kept.old[i], reinterpret_cast<const std::int64_t*>(row), bound,
                 lists[i]);
      if (turned)
        put_after_edges(lists[i]);
    }
  });
  return lists;
}

Voronoi read_tessellation(const MpasSource& source) {
  Voronoi cells;
  cells.cells = source.generators();
  cells.vertices = source.vertex_points();
  for (Points3* points : {&cells.cells, &cells.vertices})
    for (auto point : points->colwise())
      point /= point.norm();
  cells.edges_on_cell = source.lists(mpas::edges_on_cell, source.edges());
  cells.vertices_on_cell = source.lists(mpas::vertices_on_cell, source.vertices());
  cells.cells_on_cell = source.lists(mpas::cells_on_cell, source.cells());
  require_edges(source.netcdf(), source.edges(), cells);
  return cells;
}

MpasPart select_part(const MpasSource& source, const Ids& keep) {
  MpasPart part;
  part.cells = select_kept(keep);
  part.edges_on_cell = source.lists(mpas::edges_on_cell, source.edges(), part.cells);
  part.vertices_on_cell = source.lists(mpas::vertices_on_cell, source.vertices(), part.cells);
  part.cells_on_cell = source.lists(mpas::cells_on_cell, source.cells(), part.cells);
  part.edges = select_named(part.edges_on_cell.items, source.edges(), part.cells_at_edge);
  part.vertices =
      select_named(part.vertices_on_cell.items, source.vertices(), part.cells_at_vertex);
  renumber(part.edges, part.edges_on_cell.items);
  renumber(part.vertices, part.vertices_on_cell.items);
  renumber(part.cells, part.cells_on_cell.items);
  return part;
}

} // namespace calotte::io_detail
