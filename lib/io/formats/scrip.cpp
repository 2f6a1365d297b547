// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "io/cells/cell_rows.h"
#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/polygons.h"
#include "io/cells/written_fields.h"
#include "io/formats/formats.h"

// The grid file of SCRIP, a package for conservative remapping (Jones, Mon. Weather Rev. 127,
// 1999). CDO, ESMF, NCO and TempestRemap read it, too. Each cell has its own copies of its corners.
// Bounds and coordinates make it a file of the CF conventions.

namespace calotte::io_detail {
namespace {

/// The attributes of a longitude or latitude.
NetcdfAttributes angle(const std::string& standard_name, const std::string& of) {
  return {{"units", std::string("degrees")},
          {"standard_name", standard_name},
          {"long_name", standard_name + " of " + of}};
}

NetcdfAttributes centre_angle(const std::string& standard_name, const std::string& bounds) {
  NetcdfAttributes attributes = angle(standard_name, "the cell's site");
  attributes.push_back({"bounds", bounds});
  return attributes;
}

/// An angle of the corners of the cells. The last corner fills the rest of a row.
NetcdfWriter::Fill<double> corner_angles(const Polygons& cells, double LonLat::*angle) {
  return table<double>(most_corners(cells), [&cells, angle](std::int64_t cell, std::int64_t k) {
    return eastern_lonlat_of(column(cells.corners, corner_or_last(cells, cell, k))).*angle;
  });
}

} // namespace

const NetcdfMeshNames& scrip_names() {
  static const NetcdfMeshNames names{.cells = "grid_size",
                                     .vertices = "",
                                     .variables = {"grid_dims", "grid_center_lat",
                                                   "grid_center_lon", "grid_corner_lat",
                                                   "grid_corner_lon"},
                                     .derived = {"grid_area", "grid_imask"}};
  return names;
}

void write_scrip(const std::string& path, const CellGrid& grid, const WriteOptions& options) {
  const Polygons& cells = grid.polygons;
  const std::string unit = "1", coordinates = "grid_center_lat grid_center_lon";
  NetcdfGridFile file(path, options, "CF-1.8");
  const int size = file.netcdf().dimension("grid_size", cells.size());
  const int corners = file.netcdf().dimension("grid_corners", most_corners(cells));
  const int rank = file.netcdf().dimension("grid_rank", 1);

  file.doubles("grid_center_lat", {size}, centre_angle("latitude", "grid_corner_lat"),
               latitudes_of(cells.centres));
  file.doubles("grid_center_lon", {size}, centre_angle("longitude", "grid_corner_lon"),
               longitudes_of(cells.centres));
  file.ints("grid_imask", {size},
            {{"units", unit},
             {"long_name", std::string("mask of the cells: 1 takes part")},
             {"coordinates", coordinates}},
            make_mask(options));
  file.doubles("grid_area", {size},
               {{"units", std::string("radians^2")},
                {"long_name", std::string("area of the cell on the unit sphere")},
                {"coordinates", coordinates}},
               values_of(grid.area));
  const std::string corner = "the cell's corners, counter-clockwise";
  file.doubles("grid_corner_lat", {size, corners}, angle("latitude", corner),
               corner_angles(cells, &LonLat::latitude));
  file.doubles("grid_corner_lon", {size, corners}, angle("longitude", corner),
               corner_angles(cells, &LonLat::longitude));
  add_fields(file, options, {.cells = {size, {{"coordinates", coordinates}}}}, scrip_names());
  // Last: CDO takes the first variable of data for the grid that it is asked about.
  file.ints("grid_dims", {rank}, {{"units", unit}, {"long_name", std::string("number of cells")}},
            constant(cells.size()));
  file.commit();
}

bool is_scrip(const NetcdfReader& file) {
  return file.dimension("grid_size") >= 0 || file.has_variable("grid_center_lon");
}

Polygons read_scrip_cells(const NetcdfReader& file, const Points3& centres) {
  return read_cell_rows(
      file, {"grid_corner_lon", "grid_corner_lat", "grid_center_lon", "grid_center_lat"}, centres);
}

RawMesh read_scrip(const NetcdfReader& file, FieldChoice choice) {
  RawMesh raw;
  if (file.has_variable("grid_center_lon") || !file.has_variable("grid_corner_lon"))
    raw.points = read_lonlats(file, "grid_center_lon", "grid_center_lat");
  if (file.has_variable("grid_corner_lon")) {
    raw.polygons = read_scrip_cells(file, raw.points);
    raw.corner_rounding = find_rounding(file, "grid_corner_lon");
  }
  read_fields(file, scrip_names(), choice, raw);
  drop_derived_fields(raw);
  return raw;
}

} // namespace calotte::io_detail
