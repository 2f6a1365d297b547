// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/raster_field.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/shapes/room.h"

#include <calotte/matrices.h>
#include <calotte/raster.h>
#include <calotte/surface.h>

#include <iterator>
#include <string>
#include <vector>

/// Rasters of files.
namespace calotte::io_detail {

/// A raster as stored in a file, with the names of its variables. Its axes may descend.
struct RasterOfFile {
  Raster raster;
  std::string x_name, y_name, value_name;
  bool x_fastest = true; ///< order in the file, by which messages give the index of a value
};

/// The raster with both coordinates ascending and no longitude repeated.
/// \param law which values are accepted.
/// \throws Error parse, "NAME: ..." with the variable and its index, if the axes are not sorted or
///         a value violates the law.
Raster ordered(RasterOfFile stored, const std::string& name, const density_detail::ValueLaw& law);

/// The same for a raster that must cover a surface, or points of the sphere, if there are any.
/// \throws Error parse, also if it does not.
Raster covering(RasterOfFile stored, const std::string& name, const density_detail::ValueLaw& law,
                const Surface& surface, const Points3& points = Points3(3, 0));

/// The coordinates as Eigen's vector.
inline DoubleVector to_vector(const std::vector<double>& values) {
  return Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
}

} // namespace calotte::io_detail
