// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace calotte::io_detail {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The default fill value of the C library; none for types whose values are all in use.
double default_fill(NetcdfType type) {
  switch (type) {
  case NetcdfType::int16:
    return -32767;
  case NetcdfType::int32:
    return -2147483647;
  case NetcdfType::uint16:
    return 65535;
  case NetcdfType::uint32:
    return 4294967295;
  case NetcdfType::int64:
    return -9223372036854775806.0;
  case NetcdfType::uint64:
    return 18446744073709551614.0;
  case NetcdfType::float32:
    return static_cast<double>(9.9692099683868690e+36F);
  case NetcdfType::float64:
    return 9.9692099683868690e+36;
  default:
    return none;
  }
}

/// The conversion of the stored numbers of a variable.
struct Meaning {
  double wrap = 0; ///< added to negative numbers, which stand for unsigned ones
  std::vector<double> missing;
  double least = -std::numeric_limits<double>::infinity(),
         most = std::numeric_limits<double>::infinity(), factor = 1, offset = 0;

  double stored(double value) const { return value < 0 ? value + wrap : value; }
  double operator()(double given) const {
    const double value = stored(given);
    if (value < least || value > most ||
        std::find(missing.begin(), missing.end(), value) != missing.end())
      return none;
    return factor == 1 && offset == 0 ? value : offset + factor * value;
  }
};

Meaning read_meaning(const NetcdfReader& file, const std::string& variable) {
  Meaning out;
  const std::optional<NetcdfType> type =
      file.variables()[static_cast<std::size_t>(file.find(variable))].type;
  if (const std::string text = file.text(variable, "_Unsigned"); text == "true" || text == "True")
    out.wrap = type == NetcdfType::int8    ? 0x1p8
               : type == NetcdfType::int16 ? 0x1p16
               : type == NetcdfType::int32 ? 0x1p32
                                           : 0;
  const auto all = [&](const std::string& attribute) {
    std::vector<double> values = file.numbers(variable, attribute);
    for (double& value : values)
      value = out.stored(value);
    return values;
  };
  out.missing = all("_FillValue");
  if (out.missing.empty() && type)
    out.missing.push_back(out.stored(default_fill(*type)));
  for (const double value : all("missing_value"))
    out.missing.push_back(value);
  if (const std::vector<double> range = all("valid_range"); range.size() == 2)
    out.least = range[0], out.most = range[1];
  if (const std::vector<double> least = all("valid_min"); least.size() == 1)
    out.least = least[0];
  if (const std::vector<double> most = all("valid_max"); most.size() == 1)
    out.most = most[0];
  out.factor = file.number(variable, "scale_factor", 1);
  out.offset = file.number(variable, "add_offset", 0);
  return out;
}

std::vector<double> interpreted(const NetcdfReader& file, const std::string& variable,
                                std::vector<double> stored) {
  const Meaning meaning = read_meaning(file, variable);
  std::transform(stored.begin(), stored.end(), stored.begin(), meaning);
  return stored;
}

} // namespace

std::vector<double> cf_values(const NetcdfReader& file, const std::string& variable,
                              const std::vector<std::int64_t>& shape) {
  return interpreted(file, variable, file.doubles(variable, shape));
}

std::vector<double> cf_part(const NetcdfReader& file, const std::string& variable,
                            const std::vector<std::int64_t>& start,
                            const std::vector<std::int64_t>& count) {
  return interpreted(file, variable, file.part(variable, start, count));
}

bool is_packed(const NetcdfReader& file, const std::string& variable) {
  return file.number(variable, "scale_factor", 1) != 1 ||
         file.number(variable, "add_offset", 0) != 0;
}

} // namespace calotte::io_detail
