// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/raster_file.h"

#include "base/message.h"
#include "base/require.h"
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/cf_values.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace calotte {
namespace io_detail {
namespace {

using density_detail::ValueLaw;

/// Tolerance in degrees for coordinates rounded in a file.
constexpr double degree_slack = 1e-3;

void require_ascending(const DoubleVector& values, const std::string& variable,
                       const std::string& name) {
  if (values.size() < 2)
    fail_file(name, "{} has fewer than 2 values; give a raster that covers the domain", variable);
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]))
      fail_file(name, "{}[{}] is NaN or infinite; correct it", variable, i);
    if (i > 0 && !(values[i] > values[i - 1]))
      fail_file(name, "{}[{}] = {} does not follow {}; sort the raster along it", variable, i,
                values[i], values[i - 1]);
  }
}

/// Brings an axis into ascending order. \returns whether it descended.
bool turn(DoubleVector& axis, const std::string& variable, const std::string& name) {
  const bool descends = axis.size() > 1 && axis[1] < axis[0];
  if (descends)
    axis.reverseInPlace();
  require_ascending(axis, descends ? variable + " backwards" : variable, name);
  return descends;
}

/// Removes the last meridian if it repeats the first one.
void drop_repeated_meridian(RasterOfFile& stored, const std::string& name) {
  DoubleVector& x = stored.raster.x;
  DoubleMatrix& values = stored.raster.values;
  const Eigen::Index last = x.size() - 1;
  const double around = x[last] - x[0] - 360;
  if (around > degree_slack)
    fail_file(name, "{} spans more than 360 degrees; remove the repeated longitudes",
              stored.x_name);
  if (around < -degree_slack)
    return;
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    if (const double first = values(0, j), again = values(last, j);
        std::abs(again - first) > 1e-3 * std::abs(first))
      fail_file(name,
                "{} differs at longitudes {} and {} of latitude {}, which are one place; make them "
                "equal or leave the last out",
                stored.value_name, x[0], x[last], stored.raster.y[j]);
  x.conservativeResize(last);
  values.conservativeResize(last, Eigen::NoChange);
  require_ascending(x, stored.x_name, name);
}

void require_law(const RasterOfFile& stored, const std::string& name, const ValueLaw& law) {
  const DoubleMatrix& values = stored.raster.values;
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      if (!law.holds(values(i, j))) {
        const Eigen::Index first = stored.x_fastest ? j : i, second = stored.x_fastest ? i : j;
        fail_file(name, "{}[{}][{}] = {} is not {}; correct it", stored.value_name, first, second,
                  values(i, j), law.name);
      }
}

/// Clamps latitudes that rounding moved beyond a pole.
void clamp_latitudes(RasterOfFile& stored, const std::string& name) {
  for (double& latitude : stored.raster.y) {
    if (std::abs(latitude) > 90 + degree_slack)
      fail_file(name, "{} {} is outside -90 to 90; give degrees", stored.y_name, latitude);
    latitude = std::clamp(latitude, -90.0, 90.0);
  }
  require_ascending(stored.raster.y, stored.y_name, name); // still ascending
}

} // namespace

Raster ordered(RasterOfFile stored, const std::string& name, const ValueLaw& law) {
  Raster& raster = stored.raster;
  const bool turned_x = turn(raster.x, stored.x_name, name),
             turned_y = turn(raster.y, stored.y_name, name);
  if (!raster.of_plane)
    clamp_latitudes(stored, name);
  require_law(stored, name, law); // before the reversal, so that indices are those of the file
  if (turned_x)
    raster.values.colwise().reverseInPlace();
  if (turned_y)
    raster.values.rowwise().reverseInPlace();
  if (!raster.of_plane)
    drop_repeated_meridian(stored, name);
  return std::move(stored.raster);
}

Raster covering(RasterOfFile stored, const std::string& name, const ValueLaw& law,
                const Surface& surface, const Points3& points) {
  const std::string x_name = stored.x_name, y_name = stored.y_name;
  Raster raster = ordered(std::move(stored), name, law);
  // Only the caller may know the domain of a plane; it then checks again.
  const bool known = surface.is_sphere() || surface.is_bounded() || surface.is_box();
  const std::string problem = points.cols() > 0
                                  ? density_detail::uncovered(raster, points, x_name, y_name)
                              : known ? density_detail::uncovered(raster, surface, x_name, y_name)
                                      : "";
  if (!problem.empty())
    fail_file(name, problem);
  return raster;
}

// ---- NetCDF

namespace {

constexpr std::array<std::string_view, 5> kilometres{"km", "kilometer", "kilometers", "kilometre",
                                                     "kilometres"},
    metres{"m", "meter", "meters", "metre", "metres"};

/// Removes blanks at both ends. Converts names, which are longer than symbols, to lower case, since
/// UDUNITS ignores their case.
std::string canonical(const std::string& unit) {
  const std::size_t first = unit.find_first_not_of(" \t"), last = unit.find_last_not_of(" \t");
  std::string text = first == std::string::npos ? "" : unit.substr(first, last - first + 1);
  if (text.size() > 2)
    std::ranges::transform(text, text.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    });
  return text;
}

/// The size of the unit of a variable in km, by its attribute `units`.
/// \throws Error parse, with the variable.
double kilometres_per_unit(const NetcdfReader& file, const std::string& variable) {
  try {
    return kilometres_in(file.text(variable, "units"));
  } catch (const Error& error) {
    file.fail("{}: {}", variable, error.what());
  }
}

/// The factor that converts heights to metres: 1000 for km. It is negative for depths, which the
/// attribute `positive` or the standard name tells.
/// \throws Error parse, for another unit.
double metres_per_unit(const NetcdfReader& file, const std::string& variable) {
  const std::string positive = file.text(variable, "positive"),
                    standard = file.text(variable, "standard_name"),
                    units = file.text(variable, "units");
  const bool down =
      positive == "down" || (positive.empty() && standard.find("depth") != std::string::npos);
  try {
    return (down ? -1 : 1) * (units.empty() ? 1 : std::round(1000 * kilometres_in(units)));
  } catch (const Error&) {
    file.fail("{}: the unit \"{}\" is not one of heights; give m or km", variable, units);
  }
}

/// The axes of a plane: variables x(x) and y(y).
RasterAxes plane_axes(const NetcdfReader& file) {
  for (const std::string name : {"x", "y"})
    if (!file.has_variable(name) || file.shape_of(name).size() != 1)
      file.fail("no coordinate variable {}; give {}({})", name, name, name);
  return {"x", "y"};
}

/// \throws Error parse, if the file has no axes.
RasterAxes require_axes(const NetcdfReader& file, const std::string& variable) {
  std::optional<RasterAxes> axes = variable_axes(file, variable);
  if (!axes)
    axes = raster_axes(file);
  if (axes)
    return *axes;
  const std::vector<std::string> names = file.variable_names();
  const bool has_latitude = std::ranges::any_of(names, [&](const std::string& one) {
    return is_latitude(file, one) && file.dimensions_of(one) == std::vector{one};
  });
  const std::string name = has_latitude ? "lon" : "lat";
  file.fail("no coordinate variable {}; give {}({}) in degrees", name, name, name);
}

std::string axes_words(bool of_plane) { return of_plane ? "x and y" : "latitudes and longitudes"; }

std::vector<std::string> raster_names(const NetcdfReader& file, bool of_plane) {
  std::vector<std::string> found;
  for (const std::string& name : file.variable_names())
    if (file.is_numeric(name) &&
        (of_plane ? file.dimensions_of(name).size() == 2 : variable_axes(file, name).has_value()))
      found.push_back(name);
  return found;
}

/// The only raster of a file.
/// \param usual the name of the variable that is meant if there are several, or "".
std::string only_raster(const NetcdfReader& file, bool of_plane, const std::string& usual) {
  const std::vector<std::string> found = raster_names(file, of_plane);
  if (found.empty() && usual.empty())
    file.fail("no variable is a raster of {}; give a file with one", axes_words(of_plane));
  if (found.empty())
    file.fail("no variable {}; give {}({})", usual, usual, of_plane ? "y, x" : "lat, lon");
  if (found.size() > 1)
    file.fail("{}{} variables are rasters of {}: {}; {}, or give a file with one",
              usual.empty() ? "" : message("no variable {}; ", usual), found.size(),
              axes_words(of_plane), listed(found),
              usual.empty() ? "name one" : message("name one of them {}", usual));
  return found.front();
}

/// The variable that is meant if none is named: the usual one of a quantity, or the only raster.
std::string default_variable(const NetcdfReader& file, RasterQuantity quantity, bool of_plane) {
  const std::string usual = quantity == RasterQuantity::cell_width ? "cellWidth"
                            : quantity == RasterQuantity::density  ? "density"
                                                                   : "";
  return !usual.empty() && file.has_variable(usual) ? usual : only_raster(file, of_plane, usual);
}

[[noreturn]] void refuse_variable(const NetcdfReader& file, const std::string& variable,
                                  bool of_plane) {
  const std::vector<std::string> known = raster_names(file, of_plane);
  if (known.empty())
    file.fail("no variable {}; give {}({})", variable, variable, of_plane ? "y, x" : "lat, lon");
  file.fail("no variable {}; there are {}", variable, listed(known));
}

/// Reads a variable with any order of its dimensions; dimensions besides those of the axes have the
/// size 1. Missing values are NaN.
RasterOfFile stored_raster(const NetcdfReader& file, const std::string& variable, bool of_plane) {
  if (!file.has_variable(variable))
    refuse_variable(file, variable, of_plane);
  const RasterAxes axes = of_plane ? plane_axes(file) : require_axes(file, variable);
  RasterOfFile stored{.raster = {.of_plane = of_plane},
                      .x_name = axes.longitude,
                      .y_name = axes.latitude,
                      .value_name = variable};
  const auto nodes = [&](const std::string& axis) {
    return to_vector(of_plane ? cf_values(file, axis, {-1}) : read_degrees_of_axis(file, axis));
  };
  Raster& raster = stored.raster;
  raster.x = nodes(axes.longitude);
  raster.y = nodes(axes.latitude);
  const std::string of_x = file.dimensions_of(axes.longitude)[0],
                    of_y = file.dimensions_of(axes.latitude)[0];
  std::vector<std::string> of_values = file.dimensions_of(variable);
  std::erase_if(of_values, [&](const std::string& name) { // ignore a single time or level
    return file.dimension(name) == 1 && name != of_y && name != of_x;
  });
  stored.x_fastest = of_values == std::vector{of_y, of_x};
  if (!stored.x_fastest && of_values != std::vector{of_x, of_y})
    file.fail("{} is not {}({}, {}); give it these dimensions", variable, variable, of_y, of_x);
  const std::vector<double> values = cf_values(file, variable, file.shape_of(variable));
  const Eigen::Index columns = raster.x.size(), rows = raster.y.size();
  if (stored.x_fastest)
    raster.values = Eigen::Map<const DoubleMatrix>(values.data(), columns, rows);
  else
    raster.values = Eigen::Map<const DoubleMatrix>(values.data(), rows, columns).transpose();
  return stored;
}

constexpr double fraction_slack = 1e-6; ///< tolerance for rounded fractions

constexpr ValueLaw anything{[](double) { return true; }, "a number"},
    nearly_a_fraction{
        [](double value) { return value >= -fraction_slack && value <= 1 + fraction_slack; },
        "a fraction from 0 to 1"};

ValueLaw make_law(RasterQuantity quantity, bool of_plane) {
  switch (quantity) {
  case RasterQuantity::any:
    return anything;
  case RasterQuantity::cell_width:
    return density_detail::positive_and_finite;
  case RasterQuantity::density:
    return of_plane ? density_detail::not_negative : density_detail::positive_and_finite;
  case RasterQuantity::height:
    return density_detail::finite;
  case RasterQuantity::land_fraction:
  case RasterQuantity::sea_fraction:
    break;
  }
  return nearly_a_fraction;
}

/// Refuses widths of the sphere that have no unit and look like metres.
void require_known_unit(const DoubleMatrix& values, const NetcdfReader& file,
                        const std::string& variable) {
  const double most = values.array().isNaN().select(0, values.array()).maxCoeff();
  if (most > widest_in_km && file.text(variable, "units").empty())
    file.fail("{} is up to {} and has no unit: metres or km? Give it the attribute units, \"m\" or "
              "\"km\"",
              variable, most);
}

/// Converts values to the unit of a quantity.
void convert(DoubleMatrix& values, const NetcdfReader& file, const RasterOfFile& stored,
             RasterQuantity quantity) {
  const std::string& variable = stored.value_name;
  if (quantity == RasterQuantity::cell_width && !stored.raster.of_plane) {
    require_known_unit(values, file, variable);
    if (const double factor = kilometres_per_unit(file, variable); factor != 1)
      values /= 1 / factor; // a division by 1000 restores widths that are exact in km
  } else if (quantity == RasterQuantity::cell_width) {
    if (!file.text(variable, "units").empty() && !file.text(stored.x_name, "units").empty())
      values *= kilometres_per_unit(file, variable) / kilometres_per_unit(file, stored.x_name);
  } else if (quantity == RasterQuantity::height) {
    const double factor = metres_per_unit(file, variable);
    if (factor != 1)
      values *= factor;
    if (factor < 0) // land has no depth
      values = values.unaryExpr([](double height) { return std::isnan(height) ? 0.0 : height; });
  } else if (quantity == RasterQuantity::land_fraction ||
             quantity == RasterQuantity::sea_fraction) {
    if (file.text(variable, "units") == "%")
      values /= 100;
  }
}

} // namespace
} // namespace io_detail

double kilometres_in(const std::string& unit) {
  const std::string name = io_detail::canonical(unit);
  if (name.empty() || std::ranges::find(io_detail::kilometres, name) != io_detail::kilometres.end())
    return 1;
  if (std::ranges::find(io_detail::metres, name) != io_detail::metres.end())
    return 0.001;
  base_detail::refuse(base_detail::message("the unit \"{}\" is no length; give km or m", unit));
}

Raster read_raster(const std::string& path, const RasterChoice& choice) {
  using namespace io_detail;
  const NetcdfReader file(path);
  const bool of_plane = !choice.surface.is_sphere();
  base_detail::require(!of_plane || choice.points.cols() == 0,
                       "the points that a raster covers are those of the sphere; leave them out");
  const RasterQuantity quantity = choice.quantity;
  const std::string variable =
      !choice.variable.empty() ? choice.variable : default_variable(file, quantity, of_plane);
  RasterOfFile stored = stored_raster(file, variable, of_plane);
  convert(stored.raster.values, file, stored, quantity);
  const ValueLaw law = make_law(quantity, of_plane);
  if (quantity == RasterQuantity::any)
    return ordered(std::move(stored), path, law);
  Raster raster = covering(std::move(stored), path, law, choice.surface, choice.points);
  if (quantity == RasterQuantity::land_fraction || quantity == RasterQuantity::sea_fraction)
    raster.values = raster.values.cwiseMax(0).cwiseMin(1);
  return raster;
}

Raster read_land(const std::string& path, const std::string& variable, RasterQuantity quantity) {
  Raster raster = read_raster(path, {.variable = variable, .quantity = quantity});
  if (quantity == RasterQuantity::sea_fraction) {
    raster.values = 1 - raster.values.array();
  } else if (quantity != RasterQuantity::land_fraction) {
    if (!(raster.values.array() < 0).any())
      io_detail::fail_file(
          path, "no height is below 0, so that all is land; if the values are depths, give their "
                "variable the attribute positive = \"down\"; if they are fractions of land or sea, "
                "say so");
    raster.values = raster.values.unaryExpr([](double height) { return height < 0 ? 0.0 : 1.0; });
  }
  return raster;
}

} // namespace calotte
