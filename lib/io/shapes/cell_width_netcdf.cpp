// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_reader.h"
#include "io/shapes/cell_width_file.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace calotte {
namespace {

constexpr std::array<std::string_view, 5> kilometres{"km", "kilometer", "kilometers", "kilometre",
                                                     "kilometres"},
    metres{"m", "meter", "meters", "metre", "metres"};

/// Without the blanks at its ends; names, which are longer than symbols, in lower case: their case
/// does not matter to UDUNITS.
std::string canonical(const std::string& unit) {
  const std::size_t first = unit.find_first_not_of(" \t"), last = unit.find_last_not_of(" \t");
  std::string text = first == std::string::npos ? "" : unit.substr(first, last - first + 1);
  if (text.size() > 2)
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

template <std::size_t n>
bool holds(const std::array<std::string_view, n>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

double kilometres_in(const std::string& unit) {
  const std::string name = canonical(unit);
  if (name.empty() || holds(kilometres, name))
    return 1;
  if (holds(metres, name))
    return 0.001;
  throw Error(ErrorCode::invalid_argument,
              "the unit \"" + unit + "\" is not one of cell widths; give km or m");
}

namespace io_detail {

double kilometres_of(const NetcdfReader& file, const std::string& variable) {
  try {
    return kilometres_in(file.text(variable, "units"));
  } catch (const Error& error) {
    file.fail(variable + ": " + error.what());
  }
}

CellWidth read_cell_width_netcdf(const std::string& path, const Surface& region) {
  const std::string variable = "cellWidth";
  const NetcdfReader file(path);
  Raster raster = read_raster(file, variable);
  if (const double factor = kilometres_of(file, variable); factor != 1)
    raster.values /= 1 / factor; // a division by 1000 is exact where the widths in km are
  return checked(std::move(raster), path, region);
}

CellWidth read_density_netcdf(const std::string& path, const Surface& region) {
  return checked(read_raster(NetcdfReader(path), "density"), path, region);
}

} // namespace io_detail
} // namespace calotte
