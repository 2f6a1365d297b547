// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/require.h"
#include "mesh/rows.h"
#include "oceans/parts.h"
#include "oceans/room.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace oceans_detail;

constexpr std::int32_t land = -1, sea = 0;

/// Sets cells to a value. \returns the number of cells that had another value.
std::int64_t set(const std::vector<std::int32_t>& cells, std::int32_t value, Ids& of_cell) {
  std::int64_t changed = 0;
  for (const std::int32_t cell : cells) {
    require(cell >= 0 && cell < of_cell.size(), "there is no cell {}", cell);
    changed += of_cell[cell] != value;
    of_cell[cell] = value;
  }
  return changed;
}

/// Turns cells of the sea into land that cannot stay, and then those that cannot without them.
/// \param cannot_stay(cell) of a cell of the sea. \returns the number of cells.
template <class CannotStay>
std::int64_t remove(const IdLists& cells_on_cell, Ids& of_cell, const CannotStay& cannot_stay) {
  std::vector<std::int32_t> stack;
  const auto look_at = [&](std::int32_t cell) {
    if (of_cell[cell] == sea && cannot_stay(cell))
      stack.push_back(cell);
  };
  for (std::int32_t cell = 0; cell < of_cell.size(); ++cell)
    look_at(cell);
  std::int64_t removed = 0;
  while (!stack.empty()) {
    const std::int32_t cell = stack.back();
    stack.pop_back();
    removed += of_cell[cell] == sea;
    of_cell[cell] = land;
    for (const std::int32_t other : cells_on_cell[cell])
      if (other >= 0)
        look_at(other);
  }
  return removed;
}

/// Turns cells of the sea with fewer than two neighbours in the sea into land. \returns their
/// number.
std::int64_t fill(const IdLists& cells_on_cell, Ids& of_cell) {
  return remove(cells_on_cell, of_cell, [&](std::int32_t cell) {
    int neighbours = 0;
    for (const std::int32_t other : cells_on_cell[cell])
      neighbours += other >= 0 && of_cell[other] == sea;
    return neighbours < 2;
  });
}

/// Turns cells that need an open vertex and have none into land, but for opened ones. \returns
/// their number.
std::int64_t lock(const IdLists& cells_on_cell, const SeaOptions& options, Ids& of_cell) {
  const std::vector<std::uint8_t>& flags = options.need_open_vertex;
  if (flags.empty())
    return 0;
  require(std::ssize(flags) == of_cell.size(),
          "need_open_vertex has {} flags for {} cells; give one for each", flags.size(),
          of_cell.size());
  std::vector<std::uint8_t> stays(flags.size());
  for (const std::int32_t cell : options.opened)
    stays[static_cast<std::size_t>(cell)] = 1;
  const auto is_sea = [&](std::int32_t cell) { return cell >= 0 && of_cell[cell] == sea; };
  return remove(cells_on_cell, of_cell, [&](std::int32_t cell) {
    const auto i = static_cast<std::size_t>(cell);
    if (flags[i] == 0 || stays[i] != 0)
      return false;
    const auto around = cells_on_cell[cell];
    for (std::size_t k = 0; k < around.size(); ++k)
      if (is_sea(around[k]) && is_sea(around[k == 0 ? around.size() - 1 : k - 1]))
        return false;
    return true;
  });
}

/// Whether each part is kept: those of the seeds, or the largest.
std::vector<bool> kept_parts(const Parts& parts, const std::vector<std::int32_t>& seeds) {
  std::vector<bool> kept(parts.sizes.size());
  if (seeds.empty())
    kept[static_cast<std::size_t>(std::max_element(parts.sizes.begin(), parts.sizes.end()) -
                                  parts.sizes.begin())] = true;
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    const std::int32_t part = parts.of_cell[seeds[k]];
    require(part >= 0, "seed {} is on land, in cell {}; give a place in the sea", k, seeds[k]);
    kept[static_cast<std::size_t>(part)] = true;
  }
  return kept;
}

/// One of the cells that the rows of a part, grown inwards from its outer cells, reach last.
std::int32_t middle_of(const IdLists& cells_on_cell, const Parts& parts, std::int32_t part) {
  std::vector<char> seen(static_cast<std::size_t>(parts.of_cell.size()));
  std::vector<std::int32_t> row;
  const auto is_inside = [&](std::int32_t cell) {
    return cell >= 0 && parts.of_cell[cell] == part;
  };
  const auto take = [&](std::int32_t cell) {
    return is_inside(cell) && std::exchange(seen[static_cast<std::size_t>(cell)], 1) == 0;
  };
  std::int32_t first = -1;
  for (std::int32_t cell = 0; cell < parts.of_cell.size(); ++cell) {
    if (!is_inside(cell))
      continue;
    first = first < 0 ? cell : first;
    const auto around = cells_on_cell[cell];
    if (!std::all_of(around.begin(), around.end(), is_inside) && take(cell))
      row.push_back(cell);
  }
  std::vector<std::int32_t> last{first};
  for (; !row.empty(); row = mesh_detail::next_row(
                           row, [&](std::int32_t cell) { return cells_on_cell[cell]; }, take))
    last = row;
  return *std::min_element(last.begin(), last.end());
}

/// The largest parts that are not kept, largest first.
std::vector<SeaPart> find_severed(const IdLists& cells_on_cell, const Parts& parts,
                                  const std::vector<bool>& kept) {
  std::vector<std::int32_t> severed;
  for (std::int32_t part = 0; part < std::ssize(parts.sizes); ++part)
    if (!kept[static_cast<std::size_t>(part)])
      severed.push_back(part);
  const auto size = [&](std::int32_t part) { return parts.sizes[static_cast<std::size_t>(part)]; };
  std::stable_sort(severed.begin(), severed.end(),
                   [&](std::int32_t a, std::int32_t b) { return size(a) > size(b); });
  severed.resize(std::min(severed.size(), max_severed_parts));
  std::vector<SeaPart> named;
  for (const std::int32_t part : severed)
    named.push_back({size(part), middle_of(cells_on_cell, parts, part)});
  return named;
}

} // namespace

SeaCells sea_cells(const IdLists& cells_on_cell, const std::vector<std::uint8_t>& is_land,
                   const SeaOptions& options) {
  Ids of_cell(cells_on_cell.size());
  for (std::int64_t i = 0; i < of_cell.size(); ++i)
    of_cell[i] = is_land[static_cast<std::size_t>(i)] != 0 ? land : sea;
  SeaReport counts;
  counts.closed = set(options.closed, land, of_cell);
  counts.opened = set(options.opened, sea, of_cell);
  if (options.fill)
    counts.filled = fill(cells_on_cell, of_cell);
  counts.locked = lock(cells_on_cell, options, of_cell);
  if (options.fill && counts.locked > 0)
    counts.filled += fill(cells_on_cell, of_cell);
  const Parts parts =
      find_parts(cells_on_cell, [&](std::int32_t cell) { return of_cell[cell] == sea; });
  require(!parts.sizes.empty(),
          "no cell is sea; check the polygons, the values of the raster, or the bounds of the "
          "field");
  const std::vector<bool> kept = kept_parts(parts, options.seeds);
  counts.parts = std::ssize(parts.sizes);
  counts.severed_parts = find_severed(cells_on_cell, parts, kept);
  for (std::int64_t i = 0; i < of_cell.size(); ++i)
    if (of_cell[i] == sea && !kept[static_cast<std::size_t>(parts.of_cell[i])]) {
      of_cell[i] = land;
      ++counts.severed;
    }
  return {std::move(of_cell), counts};
}

} // namespace calotte
