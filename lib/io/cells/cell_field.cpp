// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_error.h"
#include "io/netcdf/cf_values.h"

#include <calotte/read.h>

#include <algorithm>
#include <limits>

namespace calotte {
namespace {

/// One value for each of so many cells.
bool is_cell_field(const io_detail::NetcdfReader& file, const std::string& name,
                   std::int64_t cells) {
  const std::vector<std::int64_t> shape = file.shape_of(name);
  return !shape.empty() && shape.back() == cells &&
         std::all_of(shape.begin(), shape.end() - 1, [](std::int64_t size) { return size == 1; });
}

std::string names_of_cell_fields(const io_detail::NetcdfReader& file, std::int64_t cells) {
  std::string names;
  for (const std::string& name : file.variable_names())
    if (is_cell_field(file, name, cells))
      names += (names.empty() ? "" : ", ") + name;
  return names;
}

[[noreturn]] void refuse_field(const io_detail::NetcdfReader& file, const std::string& problem,
                               std::int64_t cells) {
  const std::string names = names_of_cell_fields(file, cells);
  io_detail::refuse_path(
      file.path(),
      problem + "; " + (names.empty() ? "the file has none: give another" : "there are " + names));
}

} // namespace

CellField read_cell_field(const std::string& path, const std::string& name, std::int64_t cells) {
  const io_detail::NetcdfReader file(path);
  if (!file.has_variable(name))
    refuse_field(file, "no variable " + name, cells);
  if (!is_cell_field(file, name, cells))
    refuse_field(file, name + " has not one value for each of " + std::to_string(cells) + " cells",
                 cells);
  const std::vector<double> values = io_detail::cf_values(file, name, file.shape_of(name));
  CellField field;
  field.values = Eigen::Map<const DoubleVector>(values.data(), cells);
  field.long_name = file.text(name, "long_name");
  field.units = file.text(name, "units");
  return field;
}

} // namespace calotte
