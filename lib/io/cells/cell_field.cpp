// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/netcdf/cf_values.h"

#include <calotte/read.h>

#include <algorithm>
#include <limits>

namespace calotte {
namespace {

/// Whether a variable has exactly one value for each cell.
bool is_cell_field(const io_detail::NetcdfReader& file, const std::string& name,
                   std::int64_t cells) {
  const std::vector<std::int64_t> shape = file.shape_of(name);
  return !shape.empty() && shape.back() == cells &&
         std::all_of(shape.begin(), shape.end() - 1, [](std::int64_t size) { return size == 1; });
}

[[noreturn]] void refuse_field(const io_detail::NetcdfReader& file, const std::string& problem,
                               std::int64_t cells) {
  std::vector<std::string> names = file.variable_names();
  std::erase_if(names, [&](const std::string& name) { return !is_cell_field(file, name, cells); });
  io_detail::refuse_path(file.path(), "{}; {}", problem,
                         names.empty() ? "the file has none: give another"
                                       : "there are " + base_detail::listed(names));
}

} // namespace

CellField read_cell_field(const std::string& path, const std::string& name, std::int64_t cells) {
  const io_detail::NetcdfReader file(path);
  if (!file.has_variable(name))
    refuse_field(file, base_detail::message("no variable {}", name), cells);
  if (!is_cell_field(file, name, cells))
    refuse_field(file,
                 base_detail::message("{} has not one value for each of {} cells", name, cells),
                 cells);
  const std::vector<double> values = io_detail::cf_values(file, name, file.shape_of(name));
  CellField field;
  field.values = Eigen::Map<const DoubleVector>(values.data(), cells);
  field.long_name = file.text(name, "long_name");
  field.units = file.text(name, "units");
  return field;
}

} // namespace calotte
