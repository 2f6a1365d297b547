// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/fields/room.h"

#include <calotte/field_grid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte {
namespace {

MeshField field(const char* name, const char* long_name, const char* units, DoubleVector values) {
  return {.name = name, .long_name = long_name, .units = units, .values = std::move(values)};
}

} // namespace

SeaFloor sea_floor(const Raster& heights, const FieldGrid& ocean) {
  base_detail::require(!heights.of_plane,
                       "the heights are of a plane; give a raster of the sphere");
  const FieldGrid source{.name = "heights", .boxes = lon_lat_boxes(heights)};
  const GridWeights weights = interpolation_weights(source, ocean, Interpolation::conservative);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  DoubleVector below(heights.values.size()), is_below(heights.values.size());
  for (Eigen::Index i = 0; i < below.size(); ++i) {
    const double height = heights.values.data()[i];
    below[i] = height < 0 ? height : unknown;
    is_below[i] = std::isnan(height) ? unknown : height < 0 ? 1 : 0;
  }
  MeshField bed = interpolate(weights, field("bed_elevation", "mean height of the sea floor", "m",
                                             std::move(below))),
            part = interpolate(weights, field("oceanFracObserved", "part of the cell that is sea",
                                              "1", std::move(is_below)));
  SeaFloor floor;
  for (Eigen::Index i = 0; i < bed.values.size(); ++i) {
    if (std::isnan(bed.values[i])) {
      bed.values[i] = 0;
      ++floor.dry;
    }
    part.values[i] = std::isnan(part.values[i]) ? 0 : std::min(part.values[i], 1.0); // rounding
  }
  const DoubleVector zero = DoubleVector::Zero(bed.values.size());
  floor.fields = {
      std::move(bed),
      std::move(part),
      field("ssh", "height of the sea surface", "m", zero),
      field("landIceDraftObserved", "height of the base of land ice", "m", zero),
      field("landIcePressureObserved", "pressure of land ice", "Pa", zero),
      field("landIceThkObserved", "thickness of land ice", "m", zero),
      field("landIceFracObserved", "part of the cell under land ice", "1", zero),
      field("landIceFloatingFracObserved", "part of the cell under floating land ice", "1", zero)};
  return floor;
}

} // namespace calotte
