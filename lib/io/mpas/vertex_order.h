// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/mpas/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/write.h>

#include <algorithm>
#include <span>

namespace calotte::io_detail {

/// The order of a file: that of its first cell whose edges and vertices tell it. That of
/// MPAS-Tools where none does, or where the file lacks a list. \throws Error parse, file.
VertexOrder vertex_order_of(const NetcdfReader& file);

/// The long_name of verticesOnCell.
const char* described(VertexOrder order);

/// Brings the vertices of one cell from the order of MPAS-Tools, which voronoi() has, to that of
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
