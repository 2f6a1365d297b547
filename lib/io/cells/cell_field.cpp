// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/cells/netcdf_fields.h"

#include <calotte/read.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace calotte {
namespace {

/// The index of the dimension of the cells: the last one of their number.
std::optional<std::size_t> find_cells(const io_detail::NetcdfReader& file, const std::string& name,
                                      std::int64_t cells) {
  const std::vector<std::int64_t> shape = file.shape_of(name);
  const auto last = std::ranges::find(shape.rbegin(), shape.rend(), cells);
  if (last == shape.rend() || std::ranges::find(shape, 0) != shape.end() || !file.is_numeric(name))
    return std::nullopt;
  return static_cast<std::size_t>(shape.rend() - last) - 1;
}

[[noreturn]] void refuse_field(const io_detail::NetcdfReader& file, const std::string& problem,
                               std::int64_t cells) {
  std::vector<std::string> names = file.variable_names();
  std::erase_if(names, [&](const std::string& name) { return !find_cells(file, name, cells); });
  io_detail::refuse_path(file.path(), "{}; {}", problem,
                         names.empty()
                             ? "no variable of the file has: give the mesh of these fields"
                             : "there are " + base_detail::listed(names));
}

} // namespace

CellField read_cell_field(const std::string& path, const std::string& name, std::int64_t cells,
                          const std::vector<FieldIndex>& choices) {
  const io_detail::NetcdfReader file(path);
  if (!file.has_variable(name))
    refuse_field(file, base_detail::message("no variable {}", name), cells);
  const std::optional<std::size_t> of_cells = find_cells(file, name, cells);
  if (!of_cells) {
    std::vector<std::string> sizes;
    for (const std::int64_t size : file.shape_of(name))
      sizes.push_back(std::to_string(size));
    refuse_field(file,
                 base_detail::message("{} has {} values, not one for each of {} cells", name,
                                      base_detail::listed(sizes, " x ", " x "), cells),
                 cells);
  }
  MeshField field = io_detail::read_field_at(file, name, *of_cells, choices);
  return {std::move(field.values), std::move(field.long_name), std::move(field.units)};
}

} // namespace calotte
