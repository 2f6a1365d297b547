// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/write.h>

#include <algorithm>
#include <span>
#include <string>

namespace calotte::io_detail {

/// The order of the vertices of cells in a file, from the first cell whose edges and vertices
/// determine it. If none does, or if the file lacks a list, the order of MPAS-Tools.
/// \throws Error parse, file.
VertexOrder read_vertex_order(const NetcdfReader& file);

/// The long_name of verticesOnCell.
std::string described(VertexOrder order);

/// Converts the vertices of one cell from the order of MPAS-Tools, as in Voronoi, to that of
/// MPAS-Atmosphere.
template <class T> void put_before_edges(std::span<T> vertices) {
  if (!vertices.empty())
    std::rotate(vertices.begin(), vertices.end() - 1, vertices.end());
}

/// The reverse.
template <class T> void put_after_edges(std::span<T> vertices) {
  if (!vertices.empty())
    std::rotate(vertices.begin(), vertices.begin() + 1, vertices.end());
}

} // namespace calotte::io_detail
