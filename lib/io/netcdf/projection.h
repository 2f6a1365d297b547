// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/room.h"

#include <array>
#include <memory>
#include <string>

/// Map projections of CF grid mappings (CF conventions 1.11, Appendix F), from their planes to
/// longitude and latitude. Formulas are those of Snyder, Map Projections: A Working Manual, U.S.
/// Geological Survey Professional Paper 1395, 1987, on an ellipsoid.
namespace calotte::io_detail {

class Projection {
public:
  /// \param mapping a variable with the attribute grid_mapping_name: polar_stereographic,
  ///        lambert_azimuthal_equal_area, lambert_conformal_conic or rotated_latitude_longitude.
  /// \param metres in the unit of the plane's axes, in which false_easting and false_northing are.
  /// \throws Error parse, naming the variable, for another mapping, and for parameters that are
  ///         missing or out of range.
  Projection(const NetcdfReader& file, const std::string& mapping, double metres = 1);

  /// Whether a grid_mapping_name is one of these.
  static bool reads(const std::string& name);

  /// Longitude and geodetic latitude in degrees; NaN outside of what the plane shows.
  /// \param x, y metres; of a rotated pole degrees.
  std::array<double, 2> lonlat(double x, double y) const { return inverse_->lonlat(x, y); }

  /// Whether x and y are degrees.
  bool of_degrees() const { return of_degrees_; }

  struct Inverse {
    virtual ~Inverse() = default;
    virtual std::array<double, 2> lonlat(double x, double y) const = 0;
  };

private:
  std::shared_ptr<const Inverse> inverse_;
  bool of_degrees_;
};

} // namespace calotte::io_detail
