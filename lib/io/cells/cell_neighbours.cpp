// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lists.h"
#include "base/parallel.h"
#include "base/require.h"
#include "io/cells/polygons.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// Calls put(cell, neighbour) for the two cells of each side, in both orders.
template <class Put> void for_each_pair(const Polygons& polygons, const Sides& sides, Put put) {
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    const std::span<const std::int32_t> ids = polygons.ids[i];
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::int32_t other = sides.polygon_of(ids[(k + 1) % ids.size()], ids[k]);
      if (other >= 0 && other != i) {
        put(i, other);
        put(other, static_cast<std::int32_t>(i));
      }
    }
  }
}

/// Sorts each list in ascending order and removes duplicates.
template <class AnyLists> IdLists sorted(AnyLists lists) {
  const std::int64_t cells = lists.size();
  IdLists out;
  out.begin.setZero(cells + 1);
  for_each_block(cells, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const std::span<std::int32_t> list = lists[i];
      std::sort(list.begin(), list.end());
      out.begin[i] = std::unique(list.begin(), list.end()) - list.begin();
    }
  });
  out.items.resize(
      exclusive_scan(std::span(out.begin.data(), static_cast<std::size_t>(cells) + 1)));
  for_each_block(cells, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      std::copy_n(lists[i].begin(), out.count(i), out[i].begin());
  });
  return out;
}

} // namespace

IdLists cell_neighbours(const MeshFile& file) {
  require(file.mesh || file.polygons, "the file holds neither a mesh nor cells");
  if (!file.polygons)
    return sorted(neighbours(*file.mesh));
  const Sides sides(*file.polygons);
  return sorted(lists_by_key<std::vector<std::int32_t>>(
      file.polygons->size(), [&](const auto& put) { for_each_pair(*file.polygons, sides, put); }));
}

} // namespace calotte
