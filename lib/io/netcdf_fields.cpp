// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf_fields.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace calotte::io_detail {
namespace {

/// The location of a variable whose only dimension not of size 1 is that of a location; nothing
/// for any other, and for text.
std::optional<Location> location_of(const NetcdfReader& file, const NetcdfMeshNames& names,
                                    const std::string& variable) {
  const std::vector<std::string> dimensions = file.dimensions_of(variable);
  if (dimensions.empty() || !file.is_numeric(variable))
    return std::nullopt;
  for (const std::string& other : dimensions)
    if (&other != &dimensions.back() && file.dimension(other) != 1)
      return std::nullopt;
  if (dimensions.back() == names.cells)
    return Location::cells;
  if (!names.vertices.empty() && dimensions.back() == names.vertices)
    return Location::vertices;
  return std::nullopt;
}

} // namespace

Eigen::VectorXd values_with_fill(const NetcdfReader& file, const std::string& name) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> read = file.doubles(name, file.shape_of(name));
  const double fill = file.number(name, "_FillValue", none);
  const Eigen::Map<const Eigen::VectorXd> values(read.data(), std::ssize(read));
  return (values.array() == fill).select(none, values);
}

void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, Soup& soup) {
  for (const std::string& name : file.variables()) {
    if (names.variables.contains(name))
      continue;
    const std::optional<Location> location = location_of(file, names, name);
    if (!location) {
      soup.ignored.push_back(name);
      continue;
    }
    soup.fields.push_back({name, file.text(name, "long_name"), file.text(name, "units"), *location,
                           values_with_fill(file, name)});
  }
}

} // namespace calotte::io_detail
