// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/limited_area.h>

#include "base/lists.h"
#include "base/message.h"
#include "base/require.h"
#include "density/width_rules.h"
#include "domain/surface.h"
#include "grids/room.h"
#include "mesh/rows.h"

#include <algorithm>
#include <initializer_list>
#include <string>

namespace calotte {
namespace {

using base_detail::none, base_detail::require;

/// Whether a cell has fewer than two selected neighbours.
bool is_loose(const IdLists& cells_on_cell, const Ids& mask, std::int32_t cell) {
  int neighbours = 0;
  for (const std::int32_t other : cells_on_cell[cell])
    neighbours += other >= 0 && mask[other] >= 0;
  return neighbours < 2;
}

/// Removes cells that have fewer than two selected neighbours, until there are none.
void remove_loose(const IdLists& cells_on_cell, Ids& mask) {
  std::vector<std::int32_t> loose;
  for (std::int32_t cell = 0; cell < mask.size(); ++cell)
    if (mask[cell] >= 0 && is_loose(cells_on_cell, mask, cell))
      loose.push_back(cell);
  while (!loose.empty()) {
    const std::int32_t cell = loose.back();
    loose.pop_back();
    mask[cell] = none;
    for (const std::int32_t other : cells_on_cell[cell])
      if (other >= 0 && mask[other] >= 0 && is_loose(cells_on_cell, mask, other))
        loose.push_back(other);
  }
}

} // namespace

Ids limited_area_mask(const IdLists& cells_on_cell, const std::vector<std::uint8_t>& inside,
                      int rings) {
  require(rings >= 0 && rings <= limited_area_rings,
          "the number of rings is {}; give one from 0 to {}", rings, limited_area_rings);
  const std::int64_t cells = cells_on_cell.size();
  Ids mask = Ids::Constant(cells, none);
  std::vector<std::int32_t> ring;
  for (std::int32_t i = 0; i < cells; ++i)
    if (inside[static_cast<std::size_t>(i)] != 0) {
      mask[i] = 0;
      ring.push_back(i);
    }
  require(
      !ring.empty(),
      "none of the {} cells has its generator in the region; give a larger region or a finer mesh",
      cells);
  for (int k = 1; k <= rings; ++k)
    ring = mesh_detail::next_row(
        ring, [&](std::int32_t cell) { return cells_on_cell[cell]; },
        [&](std::int32_t cell) {
          const bool is_next = cell >= 0 && mask[cell] == none;
          if (is_next)
            mask[cell] = k;
          return is_next;
        });
  const bool open = std::any_of(cells_on_cell.items.begin(), cells_on_cell.items.end(),
                                [](std::int32_t cell) { return cell < 0; });
  require(open || mask.minCoeff() == none,
          "the region and its {} rings hold all {} cells, so that there is no boundary; give a "
          "smaller region, fewer rings or a finer mesh",
          rings, cells);
  remove_loose(cells_on_cell, mask);
  require(mask.maxCoeff() >= 0, "no cell of the region has two neighbours in it; give a larger "
                                "region or a finer mesh");
  return mask;
}

Ids least_mask(const IdLists& on_cell, const Ids& mask, std::int64_t count) {
  Ids least = Ids::Constant(count, none);
  for (std::int64_t i = 0; i < mask.size(); ++i)
    for (const std::int32_t id : on_cell[i])
      if (id >= 0 && mask[i] >= 0 && (least[id] < 0 || mask[i] < least[id]))
        least[id] = mask[i];
  return least;
}

Surface with_rings(const Surface& surface, const Widths& widths) {
  constexpr int beyond = 4; // cells
  domain_detail::require_sphere(surface, "a limited area is");
  density_detail::require_kind(widths.is_of_plane(), surface);
  Surface meshed = surface;
  for (int k = 0; k < 3; ++k) { // the widths may grow outwards
    double widest = 0;
    for (const Surface* part : std::initializer_list<const Surface*>{&surface, &meshed})
      widest = std::max(widest, density_detail::widest_at_corners(widths, *part));
    meshed = widened(surface, (limited_area_rings + beyond) * widest / widths.radius_km());
  }
  return meshed;
}

} // namespace calotte
