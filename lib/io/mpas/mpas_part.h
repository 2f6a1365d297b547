// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/room.h"
#include "io/netcdf/netcdf_subset.h"

#include <calotte/limited_area.h>
#include <calotte/matrices.h>
#include <calotte/mesh.h>
#include <calotte/write.h>

#include <cstdint>
#include <string>
#include <vector>

/// MPAS files, and parts of their meshes.
namespace calotte::io_detail {

/// An MPAS file with lists of the edges and vertices of its cells.
class MpasSource {
public:
  /// \throws Error file; parse; invalid_argument for a file without a mesh of the sphere, or
  /// without these lists.
  explicit MpasSource(const std::string& path);

  const NetcdfReader& netcdf() const { return netcdf_; }
  std::int64_t cells() const { return cells_; }
  std::int64_t edges() const { return edges_; }
  std::int64_t vertices() const { return vertices_; }
  double radius() const { return radius_; } ///< of its sphere
  VertexOrder vertex_order() const { return vertex_order_; }
  /// nEdgesOnCell of a cell.
  std::int32_t edge_count(std::int64_t cell) const {
    return counts_[static_cast<std::size_t>(cell)];
  }

  Points3 generators() const; ///< 3 x n, as in the file
  Points3 vertex_points() const;

  /// Reads a variable with a list of ids for each cell, or for each kept cell: 0-based, -1 for a
  /// missing one. Vertices are in the order of MPAS-Tools.
  /// \param bound upper bound of the ids, excluded.
  IdLists lists(const std::string& variable, std::int64_t bound) const;
  IdLists lists(const std::string& variable, std::int64_t bound, const Kept& kept) const;

private:
  NetcdfReader netcdf_;
  std::int64_t cells_ = 0, edges_ = 0, vertices_ = 0;
  double radius_ = 1;
  VertexOrder vertex_order_ = VertexOrder::after_edges;
  std::vector<std::int32_t> counts_; ///< nEdgesOnCell
};

/// Reads the cells as polygons: generators, vertices and the lists of the cells.
/// \throws Error parse, for an incomplete cell, and for lists of a cell that contradict each other.
Voronoi read_tessellation(const MpasSource& source);

/// The part of a mesh that is kept.
struct MpasPart {
  Kept cells, edges, vertices;
  /// By kept edge and vertex: the number of kept cells there.
  std::vector<std::uint8_t> cells_at_edge, cells_at_vertex;
  /// Lists of the kept cells with new 0-based ids; -1 for a cell that is not kept.
  IdLists edges_on_cell, vertices_on_cell, cells_on_cell;
};

/// Selects the kept cells and all their edges and vertices.
/// \param keep by cell: >= 0 if it is kept.
/// \throws Error parse, for ids out of range.
MpasPart select_part(const MpasSource& source, const Ids& keep);

} // namespace calotte::io_detail
