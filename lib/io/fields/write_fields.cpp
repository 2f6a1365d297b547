// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/bytes/text.h"
#include "io/cells/model_grid.h"
#include "io/cells/written_fields.h"
#include "io/command.h"
#include "io/fields/carried.h"
#include "io/fields/cell_dimension.h"
#include "io/fields/centres.h"

#include <calotte/field_grid.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::require;

/// Whether a dimension is the first of all fields and variables that have it, as records must be.
bool is_first_of_all(const std::string& name, const std::vector<MeshField>& fields,
                     const std::vector<Carried>& carried) {
  const auto is_first = [&](const std::vector<FieldDimension>& dimensions, bool leads) {
    for (std::size_t d = 0; d < dimensions.size(); ++d)
      if (dimensions[d].name == name && (d > 0 || !leads))
        return false;
    return true;
  };
  return std::ranges::all_of(fields,
                             [&](const MeshField& field) {
                               return is_first(field.dimensions, field.leading > 0);
                             }) &&
         std::ranges::all_of(
             carried, [&](const Carried& variable) { return is_first(variable.dimensions, true); });
}

/// The dimensions of fields besides those of their cells, in a file that is written.
class OtherDimensions {
public:
  /// Declares the unlimited dimension, if it is the first of all that have it.
  OtherDimensions(NetcdfWriter& file, const std::vector<MeshField>& fields,
                  const std::vector<Carried>& carried)
      : file_(file) {
    for (const MeshField& field : fields)
      for (const FieldDimension& dimension : field.dimensions)
        if (dimension.unlimited && records_.empty() &&
            is_first_of_all(dimension.name, fields, carried)) {
          records_ = dimension.name;
          id_of_records_ = file.record_dimension(netcdf_name(records_), dimension.size);
        }
  }
  std::vector<int> ids(const std::vector<FieldDimension>& dimensions) const {
    std::vector<int> ids;
    for (const FieldDimension& dimension : dimensions)
      ids.push_back(dimension.name == records_
                        ? id_of_records_
                        : file_.field_dimension(netcdf_name(dimension.name), dimension.size));
    return ids;
  }

private:
  NetcdfWriter& file_;
  std::string records_;
  int id_of_records_ = -1;
};

/// Declares fields, and variables that describe their other dimensions.
/// \param of_cells ids of the dimensions of their cells, the slowest first.
/// \param coordinates names of the coordinate variables of the cells.
void add_fields(NetcdfGridFile& file, const std::vector<MeshField>& fields,
                const std::vector<Carried>& carried, const std::vector<int>& of_cells,
                const std::string& coordinates) {
  const OtherDimensions others(file.netcdf(), fields, carried);
  for (const Carried& variable : carried) {
    const std::int64_t size = size_of(variable.type);
    file.bytes(variable.name, variable.type, others.ids(variable.dimensions), variable.attributes,
               [&variable, size](std::int64_t begin, std::int64_t end, char* out) {
                 std::copy_n(variable.bytes.data() + begin * size, (end - begin) * size, out);
               });
  }
  for (const MeshField& field : fields) {
    std::string all = coordinates;
    for (const Carried& variable : carried)
      if (std::ranges::find(variable.of, field.name) != variable.of.end())
        all.append(all.empty() ? "" : " ").append(variable.name);
    NetcdfAttributes attributes;
    if (!all.empty())
      attributes.push_back({"coordinates", all});
    add_field(file, field, of_cells, others.ids(field.dimensions), attributes, Missing::filled);
  }
}

// ---- Rasters

void add_axis(NetcdfGridFile& file, const std::string& name, const std::string& standard_name,
              const std::string& unit, const DoubleVector& nodes, const DoubleVector& sides,
              int dimension, int pair) {
  file.doubles(name, {dimension},
               {{"units", unit}, {"standard_name", standard_name}, {"bounds", name + "_bnds"}},
               values_of(nodes));
  file.doubles(name + "_bnds", {dimension, pair}, {},
               table<double>(2, [&sides](std::int64_t i, std::int64_t k) { return sides[i + k]; }));
}

void write_raster(const std::string& path, const LonLatBoxes& boxes,
                  const std::vector<MeshField>& fields, const std::vector<Carried>& carried,
                  const WriteOptions& options) {
  NetcdfGridFile file(path, options, "CF-1.8");
  const int lat = file.netcdf().dimension("lat", boxes.latitudes.size()),
            lon = file.netcdf().dimension("lon", boxes.longitudes.size()),
            pair = file.netcdf().field_dimension("bnds", 2); // shared with the bounds of times
  add_axis(file, "lat", "latitude", "degrees_north", boxes.latitudes, boxes.parallels, lat, pair);
  add_axis(file, "lon", "longitude", "degrees_east", boxes.longitudes, boxes.meridians, lon, pair);
  add_fields(file, fields, carried, {lat, lon}, "");
  file.commit();
}

// ---- Meshes and positions

/// \param first, second longitudes and latitudes, or x and y.
void write_points_with_fields(const std::string& path, bool sphere, const std::string& dimension,
                              std::int64_t size, const NetcdfWriter::Fill<double>& first,
                              const NetcdfWriter::Fill<double>& second,
                              const std::vector<MeshField>& fields,
                              const std::vector<Carried>& carried, const WriteOptions& options) {
  NetcdfGridFile file(path, options, "CF-1.8");
  const int cells = file.netcdf().dimension(dimension, size);
  if (sphere) {
    file.doubles(
        "lat", {cells},
        {{"units", std::string("degrees_north")}, {"standard_name", std::string("latitude")}},
        second);
    file.doubles(
        "lon", {cells},
        {{"units", std::string("degrees_east")}, {"standard_name", std::string("longitude")}},
        first);
  } else {
    file.doubles("x", {cells}, {{"units", std::string("m")}}, first);
    file.doubles("y", {cells}, {{"units", std::string("m")}}, second);
  }
  add_fields(file, fields, carried, {cells}, sphere ? "lat lon" : "x y");
  file.commit();
}

void write_cells(const std::string& path, const FieldGrid& grid,
                 const std::vector<MeshField>& fields, const std::vector<Carried>& carried,
                 const WriteOptions& options) {
  const Points3 centres = centres_of(grid);
  const bool sphere = grid.mesh.surface().is_sphere();
  write_points_with_fields(path, sphere, cell_dimension(grid.mesh.format), grid.size(),
                           sphere ? longitudes_of(centres) : coordinate_row(centres, 0),
                           sphere ? latitudes_of(centres) : coordinate_row(centres, 1), fields,
                           carried, options);
}

void write_positions(const std::string& path, const Positions& positions,
                     const std::vector<MeshField>& fields, const std::vector<Carried>& carried,
                     const WriteOptions& options) {
  const auto row = [&](int k) {
    return table<double>(
        1, [&positions, k](std::int64_t i, std::int64_t) { return positions.coordinates(k, i); });
  };
  write_points_with_fields(path, positions.surface.is_sphere(), "position", positions.points.cols(),
                           row(0), row(1), fields, carried, options);
}

// ---- Text

/// A name as one column of a header.
std::string column_name(std::string name) {
  std::ranges::replace_if(
      name,
      [](char c) { return std::string_view(" \t\r\n,;|#\"'").find(c) != std::string_view::npos; },
      '_');
  return name;
}

std::array<const char*, 2> coordinate_names(const Positions& positions) {
  if (positions.surface.is_sphere())
    return {"lon", "lat"};
  return {"x", "y"};
}

void write_text(const std::string& path, const Positions& positions,
                const std::vector<MeshField>& fields) {
  const std::string_view between = suffix_of(path) == ".csv" ? "," : " ";
  OutputFile file(path);
  Writer out([&](std::string_view bytes) { file.append(bytes); });
  const auto [first, second] = coordinate_names(positions);
  out.text(first).text(between).text(second);
  for (const MeshField& field : fields)
    out.text(between).text(column_name(field.name));
  out.text("\n");
  for (Eigen::Index i = 0; i < positions.coordinates.cols(); ++i) {
    out.number(positions.coordinates(0, i)).text(between).number(positions.coordinates(1, i));
    for (const MeshField& field : fields)
      if (out.text(between); std::isnan(field.values[i]))
        out.text("NaN");
      else
        out.number(field.values[i]);
    out.text("\n");
  }
  out.flush();
  file.commit();
}

bool is_text(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".csv" || suffix == ".txt";
}

/// Requires fields that a text can hold.
void require_text(const std::string& path, const Positions& positions,
                  const std::vector<MeshField>& fields) {
  require(is_text(path),
          "{}: values at positions are written as text or NetCDF; give a name that ends in .csv, "
          ".txt or .nc",
          path);
  const auto [first, second] = coordinate_names(positions);
  std::vector<std::string> names{first, second};
  for (const MeshField& field : fields) {
    require(field.count() == 1,
            "{}: the field {} has several numbers for each position, and text has one; choose an "
            "index of each dimension (--at), or write .nc",
            path, field.name);
    const std::string name = column_name(field.name);
    require(
        !name.empty() && std::ranges::find(names, name) == names.end(),
        "{}: the field {} would be a column {}, and there is one, or that is no name; rename it",
        path, in_quotes(field.name), in_quotes(name));
    names.push_back(name);
  }
}

constexpr std::array<const char*, 6> own_names{"lat", "lon", "lat_bnds", "lon_bnds", "x", "y"};

bool is_own_name(const std::string& name) {
  return std::ranges::find(own_names, name) != own_names.end();
}

/// Refuses fields with names of variables of the file.
void require_free_names(const std::string& path, const std::vector<MeshField>& fields) {
  for (const MeshField& field : fields)
    require(!is_own_name(field.name), "{}: the field {} has the name of a coordinate; leave it out",
            path, field.name);
}

/// The variables that describe the other dimensions of fields in a source.
/// \param renamed their old and new names.
std::vector<Carried> carried_from(const std::string& source, const std::vector<MeshField>& fields,
                                  const std::vector<std::array<std::string, 2>>& renamed) {
  if (source.empty() || !is_netcdf_file(source))
    return {};
  std::vector<Carried> carried = carried_with(NetcdfReader(source), fields);
  std::erase_if(carried, [&](const Carried& variable) {
    return is_own_name(variable.name) || std::ranges::any_of(renamed, [&](const auto& names) {
             return names[1] == variable.name;
           });
  });
  for (const auto& [before, now] : renamed)
    for (Carried& variable : carried)
      std::ranges::replace(variable.of, before, now);
  return carried;
}

} // namespace
} // namespace io_detail

void require_storable(const std::string& path, const FieldGrid& grid,
                      const std::vector<MeshField>& fields) {
  using namespace io_detail;
  if (suffix_of(path) == ".nc")
    return require_free_names(path, fields);
  if (grid.positions)
    return require_text(path, *grid.positions, fields);
  require(!grid.boxes, "{}: a raster is written to NetCDF; give a name that ends in .nc", path);
  WriteOptions options;
  options.fields = fields;
  require_storable(path, grid.mesh, options);
}

void write_fields(const std::string& path, const FieldGrid& grid,
                  const std::vector<MeshField>& fields, const std::string& history,
                  const std::string& source) {
  using namespace io_detail;
  for (const MeshField& field : fields)
    require(field.location == FieldLocation::cells &&
                field.values.size() == grid.size() * field.count(),
            "the field {} does not have a value for each of {} cells; interpolate it to {}",
            field.name, grid.size(), grid.name);
  require_storable(path, grid, fields);
  WriteOptions options;
  options.history = history;
  options.sphere_radius = grid.boxes || grid.positions ? 1 : grid.mesh.sphere_radius;
  if (grid.positions && is_text(path))
    return write_text(path, *grid.positions, fields);
  if (suffix_of(path) != ".nc") {
    options.fields = fields;
    write(path, grid.mesh, options);
    return;
  }
  std::vector<MeshField> named = fields;
  const std::vector<Carried> carried = carried_from(source, fields, replace_names(named));
  if (grid.boxes)
    write_raster(path, *grid.boxes, named, carried, options);
  else if (grid.positions)
    write_positions(path, *grid.positions, named, carried, options);
  else
    write_cells(path, grid, named, carried, options);
}

} // namespace calotte
