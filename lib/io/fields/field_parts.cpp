// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "base/require.h"
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/fields/centres.h"
#include "io/fields/projected_grid.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/netcdf_reader.h"
#include "remap/mean_sums.h"

#include <calotte/field_grid.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

/// The fields of a part in the order of others, of which each is there.
std::vector<MeshField> in_order(std::vector<MeshField> part, const std::vector<MeshField>& fields,
                                const std::string& path) {
  std::vector<MeshField> out;
  for (const MeshField& field : fields) {
    const auto found = std::ranges::find(part, field.name, &MeshField::name);
    base_detail::require(found != part.end(), "{} has no field {} at cells; leave it out", path,
                         field.name);
    if (field.integer && !found->integer)
      fail_file(path,
                "{} holds numbers that are no 32-bit integers, and is taken as categories; "
                "take it as numbers (--numbers)",
                field.name);
    out.push_back(std::move(*found));
  }
  return out;
}

/// The numbers that a raster's variables have for a cell.
std::int64_t numbers_of_cell(const NetcdfReader& file, const ProjectedAxes& axes) {
  std::int64_t numbers = 0;
  for (const std::string& name : file.variable_names()) {
    const std::vector<std::string> dimensions = file.dimensions_of(name);
    if (std::ranges::count(dimensions, axes.x) != 1 || std::ranges::count(dimensions, axes.y) != 1)
      continue;
    std::int64_t of_name = 1;
    for (const std::string& dimension : dimensions)
      of_name *= dimension == axes.x || dimension == axes.y ? 1 : file.dimension(dimension);
    numbers += of_name;
  }
  return numbers;
}

} // namespace
} // namespace io_detail

/// A raster of which rows are read, or the path of another file.
struct FieldParts::File {
  struct Raster {
    io_detail::NetcdfReader reader;
    io_detail::ProjectedRaster raster;

    Raster(const std::string& path, const io_detail::ProjectedAxes& axes)
        : reader(path), raster(reader, axes) {}
  };

  std::string path;
  std::vector<FieldIndex> choices;
  std::unique_ptr<const Raster> raster; ///< none for another file
  std::int64_t parts = 1;
};

FieldParts::FieldParts(const std::string& path, const std::vector<FieldIndex>& choices,
                       std::int64_t most) {
  using namespace io_detail;
  base_detail::require(most >= 1, "a part has {} cells; give 1 or more", most);
  auto file = std::make_shared<File>(File{path, choices, nullptr});
  if (is_netcdf_file(path)) {
    const NetcdfReader reader(path);
    if (!raster_axes(reader))
      if (const std::optional<ProjectedAxes> axes = projected_axes(reader)) {
        file->raster = std::make_unique<File::Raster>(path, *axes);
        const ProjectedRaster& raster = file->raster->raster;
        constexpr std::int64_t polygon = 32; // numbers that the search of a cell takes
        const std::int64_t cells = most * polygon / (polygon + numbers_of_cell(reader, *axes)),
                           rows = std::max<std::int64_t>(cells / raster.columns(), 1);
        file->parts = (raster.rows() + rows - 1) / rows;
      }
  }
  file_ = std::move(file);
}

std::int64_t FieldParts::count() const { return file_->parts; }

FieldGrid FieldParts::read(std::int64_t part,
                           const std::optional<std::vector<std::string>>& names) const {
  using namespace io_detail;
  base_detail::require(part >= 0 && part < count(), "there is no part {}; give 0 to {}", part,
                       count() - 1);
  if (!file_->raster) {
    FieldGrid grid = read_field_grid(file_->path, FieldChoice::all, file_->choices);
    std::erase_if(grid.fields, [&](const MeshField& field) {
      return names && std::ranges::find(*names, field.name) == names->end();
    });
    return grid;
  }
  const ProjectedRaster& raster = file_->raster->raster;
  const std::int64_t first = raster.rows() * part / count(),
                     last = raster.rows() * (part + 1) / count();
  FieldGrid grid = raster.read(first, last - first, FieldChoice::all, file_->choices, names);
  if (!names)
    require_records(file_->path, grid, FieldChoice::all);
  return grid;
}

CoveredFields interpolate_parts(const FieldParts& source, const std::vector<MeshField>& fields,
                                const FieldGrid& target, double min_cover) {
  using namespace io_detail;
  remap_detail::require_min_cover(min_cover);
  FieldGrid cells{.name = target.name, .boxes = target.boxes, .mask = target.mask};
  if (!cells.boxes)
    cells.mesh.polygons = cells_of(target);
  std::vector<std::string> names;
  for (const MeshField& field : fields)
    names.push_back(field.name);
  remap_detail::MeanSums sums(cells.size(), fields);
  for (std::int64_t k = 0; k < source.count(); ++k) {
    FieldGrid part = source.read(k, names);
    const GridWeights weights = interpolation_weights(part, cells, Interpolation::conservative);
    sums.add(weights, in_order(std::move(part.fields), fields, part.name));
  }
  return {sums.means(min_cover), sums.target_fraction()};
}

} // namespace calotte
