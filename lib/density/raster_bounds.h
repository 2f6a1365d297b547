// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "density/bounds.h"
#include "density/raster_field.h"
#include "density/room.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace calotte::density_detail {

/// Bounds of the values of a raster near points, from bounds of squares of nodes whose size doubles
/// from level to level.
class RasterBounds {
public:
  /// \param field must outlive it.
  explicit RasterBounds(const RasterField& field);
  /// \param value gives the value of a node instead of the field.
  RasterBounds(const RasterField& field,
               const std::function<double(std::int64_t i, std::int64_t j)>& value);

  /// Bounds of the interpolated values within a distance of a point.
  /// \param centre unit vector, in a plane x y 0.
  /// \param reach radians, in a plane its unit.
  Bounds within(const Vec3& centre, double reach) const;

private:
  struct Level {
    int shift; ///< squares of 2^shift nodes
    std::int64_t columns;
    std::vector<Bounds> squares; ///< row by row
  };
  Bounds of_nodes(std::int64_t west, std::int64_t east, std::int64_t south,
                  std::int64_t north) const;

  const RasterField* field_;
  std::vector<Level> levels_; ///< the finest first
};

} // namespace calotte::density_detail
