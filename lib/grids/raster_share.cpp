// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "grids/room.h"

#include <calotte/ocean.h>
#include <calotte/widths.h>

namespace calotte {

Share::Share(const LandRaster& raster) {
  const auto& shares = raster.land.array();
  base_detail::require(raster.land.rows() == raster.longitudes.size() &&
                           raster.land.cols() == raster.latitudes.size() &&
                           (shares >= 0 && shares <= 1).all(),
                       "shares are not 0 to 1, one for each longitude and latitude; correct the "
                       "raster");
  rule_ = Widths(CellWidth{raster.longitudes, raster.latitudes, (shares + 1).matrix()})
              .rule_of_radius();
}

} // namespace calotte
