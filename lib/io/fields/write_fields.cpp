// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/bytes/file_names.h"
#include "io/cells/centroids.h"
#include "io/cells/model_grid.h"
#include "io/cells/written_fields.h"
#include "io/fields/cell_dimension.h"

#include <calotte/field_grid.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::require;

/// NetCDF's default fill values.
constexpr double no_double = 9.9692099683868690e+36;
constexpr std::int32_t no_int = -2147483647;

/// Values in the order of a file, in which leading dimensions come before the cells.
/// \param slowest the size of the slowest dimension of the cells.
template <class T>
NetcdfWriter::Fill<T> contents_of(const MeshField& field, std::int64_t slowest, T none) {
  std::int64_t before = 1;
  for (int d = 0; d < field.leading; ++d)
    before *= field.dimensions[static_cast<std::size_t>(d)].size;
  const std::int64_t after = field.count() / before, cells = field.values.size() / field.count(),
                     rows = field.leading > 0 ? field.dimensions[0].size : slowest,
                     width = field.values.size() / rows;
  const double* const values = field.values.data();
  return [=](std::int64_t begin, std::int64_t end, T* out) {
    for (std::int64_t k = begin * width; k < end * width; ++k) {
      const std::int64_t cell = k / after % cells, leading = k / after / cells;
      const double value = values[(cell * before + leading) * after + k % after];
      *out++ = std::isnan(value) ? none : static_cast<T>(value);
    }
  };
}

/// \param dimensions of the cells, the slowest first.
void add_field(NetcdfGridFile& file, const MeshField& field, const std::vector<int>& dimensions,
               std::int64_t slowest, const std::string& coordinates) {
  NetcdfAttributes attributes;
  if (!field.units.empty())
    attributes.push_back({"units", field.units});
  if (!field.long_name.empty())
    attributes.push_back({"long_name", field.long_name});
  if (!coordinates.empty())
    attributes.push_back({"coordinates", coordinates});
  std::vector<int> all;
  for (const FieldDimension& dimension : field.dimensions)
    all.push_back(file.netcdf().field_dimension(dimension.name, dimension.size));
  all.insert(all.begin() + field.leading, dimensions.begin(), dimensions.end());
  if (field.integer) {
    attributes.push_back({"_FillValue", no_int});
    file.ints(field.name, all, attributes, contents_of<std::int32_t>(field, slowest, no_int));
  } else {
    attributes.push_back({"_FillValue", no_double});
    file.doubles(field.name, all, attributes, contents_of<double>(field, slowest, no_double));
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
                  const std::vector<MeshField>& fields, const WriteOptions& options) {
  NetcdfGridFile file(path, options, "CF-1.8");
  const int lat = file.netcdf().dimension("lat", boxes.latitudes.size()),
            lon = file.netcdf().dimension("lon", boxes.longitudes.size()),
            pair = file.netcdf().dimension("bnds", 2);
  add_axis(file, "lat", "latitude", "degrees_north", boxes.latitudes, boxes.parallels, lat, pair);
  add_axis(file, "lon", "longitude", "degrees_east", boxes.longitudes, boxes.meridians, lon, pair);
  for (const MeshField& field : fields)
    add_field(file, field, {lat, lon}, boxes.latitudes.size(), "");
  file.commit();
}

// ---- Meshes

void write_cells(const std::string& path, const FieldGrid& grid,
                 const std::vector<MeshField>& fields, const WriteOptions& options) {
  const Points3 centres = !grid.mesh.polygons ? grid.mesh.mesh->points
                          : grid.mesh.polygons->centres.cols() > 0
                              ? grid.mesh.polygons->centres
                              : centroids_of(*grid.mesh.polygons);
  const bool sphere =
      grid.mesh.polygons ? grid.mesh.polygons->on_sphere : grid.mesh.mesh->surface.is_sphere();
  NetcdfGridFile file(path, options, "CF-1.8");
  const int cells = file.netcdf().dimension(cell_dimension(grid.mesh.format), grid.size());
  if (sphere) {
    file.doubles(
        "lat", {cells},
        {{"units", std::string("degrees_north")}, {"standard_name", std::string("latitude")}},
        latitudes_of(centres));
    file.doubles(
        "lon", {cells},
        {{"units", std::string("degrees_east")}, {"standard_name", std::string("longitude")}},
        longitudes_of(centres));
  } else {
    file.doubles("x", {cells}, {{"units", std::string("m")}}, row_of(centres, 0));
    file.doubles("y", {cells}, {{"units", std::string("m")}}, row_of(centres, 1));
  }
  for (const MeshField& field : fields)
    add_field(file, field, {cells}, grid.size(), sphere ? "lat lon" : "x y");
  file.commit();
}

/// Names that the file's own variables have.
void require_free_names(const std::string& path, const std::vector<MeshField>& fields) {
  for (const MeshField& field : fields)
    for (const std::string name : {"lat", "lon", "lat_bnds", "lon_bnds", "x", "y"})
      require(field.name != name, path + ": the field " + name +
                                      " has the name of a coordinate; leave it out with --fields");
}

} // namespace
} // namespace io_detail

void write_fields(const std::string& path, const FieldGrid& grid,
                  const std::vector<MeshField>& fields, const std::string& history) {
  using namespace io_detail;
  for (const MeshField& field : fields)
    require(field.location == Location::cells && field.values.size() == grid.size() * field.count(),
            "the field " + field.name + " does not have a value for each of " +
                std::to_string(grid.size()) + " cells; interpolate it to " + grid.name);
  WriteOptions options;
  options.history = history;
  options.sphere_radius = grid.boxes ? 1 : grid.mesh.sphere_radius;
  if (suffix_of(path) != ".nc") {
    require(!grid.boxes, path + ": a raster is written to NetCDF; give a name that ends in .nc");
    options.fields = fields;
    write(path, grid.mesh, options);
    return;
  }
  require_free_names(path, fields);
  std::vector<MeshField> named = fields;
  replace_names(named);
  if (grid.boxes)
    write_raster(path, *grid.boxes, named, options);
  else
    write_cells(path, grid, named, options);
}

} // namespace calotte
