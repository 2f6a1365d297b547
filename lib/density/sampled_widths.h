// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/raster_field.h"
#include "density/room.h"
#include "density/width_tiles.h"

#include <calotte/mesh.h>

#include <cstddef>
#include <cstdint>
#include <variant>

namespace calotte::density_detail {

/// Widths at nodes, prepared for repeated evaluation, and their density (h_min/h)^4. The bits of
/// each value depend on its point alone.
class SampledWidths {
public:
  /// \throws Error invalid_argument as require_widths().
  explicit SampledWidths(const Raster& widths);
  /// \throws Error invalid_argument for widths whose ratio exceeds 1e30.
  SampledWidths(WidthTiles tiles, double apart);

  /// Widths at unit vectors, or points of the plane, given by their coordinates.
  void operator()(const double* x, const double* y, const double* z, std::size_t count,
                  double* widths) const;
  void densities(const double* x, const double* y, const double* z, std::size_t count,
                 double* rho) const;
  void densities(const Eigen::Ref<const Points3>& points, Eigen::Ref<Eigen::VectorXd> rho) const;

  double least() const { return least_; }
  double greatest() const { return greatest_; }
  std::int64_t count() const { return count_; }
  /// The largest distance of neighbouring nodes, in local widths.
  double apart() const { return apart_; }
  bool of_plane() const { return of_plane_; }

  const std::variant<RasterField, WidthTiles>& nodes() const { return field_; }

private:
  std::variant<RasterField, WidthTiles> field_;
  double least_, greatest_; ///< of the nodes
  std::int64_t count_;
  double apart_ = 1;
  bool of_plane_;
};

} // namespace calotte::density_detail
