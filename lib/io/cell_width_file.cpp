// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cell_width_file.h"

#include "io/file.h"
#include "io/file_names.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace calotte {
namespace io_detail {
namespace {

/// Tolerance in degrees for coordinates rounded in a file.
constexpr double slack = 1e-3;

std::string shortly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

[[noreturn]] void refuse(const std::string& name, const std::string& problem) {
  throw Error(ErrorCode::parse, name + ": " + problem);
}

std::string at(const std::string& variable, std::size_t index) {
  return variable + "[" + std::to_string(index) + "]";
}

void require_ascending(const std::vector<double>& values, const std::string& variable,
                       const std::string& name) {
  if (values.size() < 2)
    refuse(name, variable + " has fewer than 2 values; give a raster of the whole sphere");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      refuse(name, at(variable, i) + " is NaN or infinite; correct it");
    if (i > 0 && !(values[i] > values[i - 1]))
      refuse(name, at(variable, i) + " = " + shortly(values[i]) + " does not follow " +
                       shortly(values[i - 1]) + "; sort the raster along it");
  }
}

double widest_step(const std::vector<double>& values) {
  double widest = 0;
  for (std::size_t i = 1; i < values.size(); ++i)
    widest = std::max(widest, values[i] - values[i - 1]);
  return widest;
}

void require_covering(double gap, const std::vector<double>& values, const std::string& variable,
                      const std::string& name) {
  if (gap > 1.5 * widest_step(values) + slack)
    refuse(name, variable + " runs from " + shortly(values.front()) + " to " +
                     shortly(values.back()) +
                     " and leaves part of the sphere out; give a global raster in degrees");
}

void require_widths(const Raster& raster, const std::string& name) {
  for (Eigen::Index j = 0; j < raster.widths.cols(); ++j)
    for (Eigen::Index i = 0; i < raster.widths.rows(); ++i) {
      const double width = raster.widths(i, j);
      if (width > 0 && std::isfinite(width))
        continue;
      const Eigen::Index first = raster.longitude_fastest ? j : i,
                         second = raster.longitude_fastest ? i : j;
      refuse(name, raster.width_name + "[" + std::to_string(first) + "][" + std::to_string(second) +
                       "] = " + shortly(width) + " is not positive and finite; correct it");
    }
}

/// The first meridian may be repeated at the end.
void drop_repeated(Raster& raster, const std::string& name) {
  const double around = raster.longitudes.back() - raster.longitudes.front() - 360;
  if (around > slack)
    refuse(name,
           raster.longitude_name + " spans more than 360 degrees; remove the repeated longitudes");
  if (around < -slack)
    return;
  const Eigen::Index last = raster.widths.rows() - 1;
  for (Eigen::Index j = 0; j < raster.widths.cols(); ++j)
    if (const double first = raster.widths(0, j), again = raster.widths(last, j);
        std::abs(again - first) > 1e-3 * first)
      refuse(name, raster.width_name + " differs at longitudes " +
                       shortly(raster.longitudes.front()) + " and " +
                       shortly(raster.longitudes.back()) + " of latitude " +
                       shortly(raster.latitudes[static_cast<std::size_t>(j)]) +
                       ", which are one place; make them equal or leave the last out");
  raster.longitudes.pop_back();
  raster.widths.conservativeResize(last, Eigen::NoChange);
}

} // namespace

CellWidth checked(Raster raster, const std::string& name) {
  if (raster.latitudes.size() > 1 && raster.latitudes[1] < raster.latitudes[0]) {
    std::reverse(raster.latitudes.begin(), raster.latitudes.end());
    require_ascending(raster.latitudes, raster.latitude_name + " backwards", name);
    require_widths(raster, name); // before the reversal, so that indices are those of the file
    raster.widths = raster.widths.rowwise().reverse().eval();
  }
  require_ascending(raster.longitudes, raster.longitude_name, name);
  require_ascending(raster.latitudes, raster.latitude_name, name);
  for (double& latitude : raster.latitudes) {
    if (std::abs(latitude) > 90 + slack)
      refuse(name, raster.latitude_name + " " + shortly(latitude) +
                       " is outside -90 to 90; give degrees");
    latitude = std::clamp(latitude, -90.0, 90.0);
  }
  require_ascending(raster.latitudes, raster.latitude_name, name); // still ascending after clamping
  require_widths(raster, name);
  drop_repeated(raster, name);
  require_ascending(raster.longitudes, raster.longitude_name, name);
  require_covering(360 - (raster.longitudes.back() - raster.longitudes.front()), raster.longitudes,
                   raster.longitude_name, name);
  require_covering(std::max(raster.latitudes.front() + 90, 90 - raster.latitudes.back()),
                   raster.latitudes, raster.latitude_name, name);
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  return {vector(raster.longitudes), vector(raster.latitudes), std::move(raster.widths)};
}

} // namespace io_detail

CellWidth read_cell_width(const std::string& path, const PolygonWidths& polygons) {
  const std::string suffix = io_detail::suffix_of(path);
  if (suffix == ".nc")
    return io_detail::read_cell_width_netcdf(path, "cellWidth");
  if (suffix != ".msh" && suffix != ".geojson" && suffix != ".json")
    throw Error(ErrorCode::bad_option,
                path + ": unknown suffix of a file of cell widths; give .nc, .msh or "
                       ".geojson");
  std::ifstream in = io_detail::open_input(path);
  return suffix == ".msh" ? io_detail::read_cell_width_msh(in, path)
                          : io_detail::read_cell_width_geojson(in, path, polygons);
}

CellWidth read_density_raster(const std::string& path) {
  CellWidth raster = io_detail::read_cell_width_netcdf(path, "density");
  const auto width_of = [](double density) { return 1 / std::sqrt(std::sqrt(density)); };
  raster.widths = raster.widths.unaryExpr(width_of).eval();
  raster.widths /= raster.widths.minCoeff();
  return raster;
}

} // namespace calotte
