// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>
#include <calotte/remap.h>

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "density/raster_field.h"
#include "oceans/room.h"
#include "remap/box_overlaps.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte {

DoubleVector land_fractions(const Voronoi& cells, const Raster& land) {
  using namespace oceans_detail;
  require(!land.of_plane, "the raster of land is one of a plane; give longitudes and latitudes");
  density_detail::require_values(land, "land", density_detail::a_fraction);
  const remap_detail::BoxTiling tiling(lon_lat_boxes(land));
  DoubleVector fractions(cells.cells.cols());
  for_each_block(fractions.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    remap_detail::BoxOverlaps overlaps(tiling);
    std::vector<Vec3> corners;
    remap_detail::WeightRow shared;
    for (std::int64_t i = begin; i < end; ++i) {
      corners.clear();
      for (const std::int32_t vertex : cells.vertices_on_cell[i])
        corners.push_back(column(cells.vertices, vertex));
      overlaps.set(corners, shared);
      if (shared.empty()) // a cell of no area
        shared.push_back({tiling.box_at(column(cells.cells, i)), 1});
      // Values are summed as differences from one of them, which are exactly 0 where all are equal.
      const double usual = land.values.data()[shared[0].column];
      double area = 0, excess = 0;
      for (const auto& [box, part] : shared) {
        area += part;
        excess += part * (land.values.data()[box] - usual);
      }
      fractions[i] = std::clamp(usual + excess / area, 0.0, 1.0);
    }
  });
  return fractions;
}

} // namespace calotte
