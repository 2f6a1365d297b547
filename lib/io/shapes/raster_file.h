// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_reader.h"
#include "io/shapes/room.h"

#include <calotte/matrices.h>
#include <calotte/surface.h>

#include <Eigen/Core>

#include <iterator>
#include <string>
#include <vector>

/// Rasters of longitudes and latitudes over the sphere.
namespace calotte::io_detail {

/// A raster as stored in a file, with the names of its variables there.
struct Raster {
  std::vector<double> longitudes, latitudes; ///< degrees
  DoubleMatrix values;                       ///< longitudes x latitudes
  std::string longitude_name, latitude_name, value_name;
  bool longitude_fastest = true; ///< in the file: how messages give a value's index
};

/// What its values must be.
struct RasterLaw {
  bool (*holds)(double value);
  std::string name; ///< "positive and finite"
};

/// The raster with both coordinates ascending and no longitude repeated.
/// \throws Error parse, "NAME: ..." with the variable and its index, if it does not cover the
///         region, or a value violates the law.
Raster ordered(Raster raster, const std::string& name, const RasterLaw& law,
               const Surface& region = {});

/// The coordinates as Eigen's vector.
inline DoubleVector vector_of(const std::vector<double>& values) {
  return Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
}

/// Reads a variable(lat, lon), in any order of its dimensions, of which others have the size 1,
/// with the axes that axes_of() finds. Missing values are NaN. \throws Error parse; file.
Raster read_raster(const NetcdfReader& file, const std::string& variable);

} // namespace calotte::io_detail
