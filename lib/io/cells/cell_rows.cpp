// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/cell_rows.h"

#include "io/bytes/text.h"
#include "io/cells/distinct_points.h"
#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/polygons.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace calotte::io_detail {
namespace {

constexpr std::size_t fewest_corners = 3;

// ---- Corners

bool may_be_missing(const NetcdfReader& file, const std::string& name) {
  return !file.numbers(name, "_FillValue").empty() || !file.numbers(name, "missing_value").empty();
}

/// Reorders values with corners first to a row of corners for each cell.
void transpose(std::vector<double>& values, std::int64_t corners) {
  const std::vector<double> old = values;
  const std::int64_t cells = std::ssize(old) / corners;
  for (std::int64_t k = 0; k < corners; ++k)
    for (std::int64_t i = 0; i < cells; ++i)
      values[static_cast<std::size_t>(i * corners + k)] =
          old[static_cast<std::size_t>(k * cells + i)];
}

double corner_degrees_per_unit(const NetcdfReader& file, const std::string& corners,
                               const std::string& centres) {
  const bool own = centres.empty() || !file.text(corners, "units").empty();
  return degrees_per_unit(file, own ? corners : centres);
}

/// Replaces missing corners by the coordinates of another corner.
/// \returns the indices of the missing corners.
std::vector<std::size_t> fill_missing(const NetcdfReader& file, const CellRows& rows,
                                      LonLats& points) {
  std::vector<std::size_t> missing;
  if (!may_be_missing(file, rows.corner_longitude) && !may_be_missing(file, rows.corner_latitude))
    return missing;
  const std::size_t count = points.longitudes.size();
  std::size_t known = count;
  for (std::size_t i = 0; i < count; ++i)
    if (std::isnan(points.longitudes[i]) || std::isnan(points.latitudes[i]))
      missing.push_back(i);
    else
      known = std::min(known, i);
  if (known == count)
    file.fail("{} and {} hold fill values only; make the file again", rows.corner_longitude,
              rows.corner_latitude);
  for (const std::size_t i : missing) {
    points.longitudes[i] = points.longitudes[known];
    points.latitudes[i] = points.latitudes[known];
  }
  return missing;
}

// ---- Names

/// Finds the bounds of coordinates. Empty if there are none, or if their shape does not fit.
std::string find_bounds(const NetcdfReader& file, const std::string& name) {
  const std::string bounds = file.text(name, "bounds");
  if (bounds.empty() || !file.has_variable(bounds))
    return {};
  const std::vector<std::string> own = file.dimensions_of(name), more = file.dimensions_of(bounds);
  const bool follows = more.size() == own.size() + 1 && !own.empty() && own.size() <= 2 &&
                       std::equal(own.begin(), own.end(), more.begin());
  return follows ? bounds : "";
}

bool has_corners(const NetcdfReader& file, const std::string& bounds) {
  return !bounds.empty() &&
         static_cast<std::size_t>(file.shape_of(bounds).back()) >= fewest_corners;
}

/// Finds the latitudes with bounds that have the dimensions of the longitudes.
std::string find_latitude(const NetcdfReader& file, const std::string& longitude) {
  const std::vector<std::string> dimensions = file.dimensions_of(longitude);
  for (const std::string& name : file.variable_names())
    if (is_latitude(file, name) && file.dimensions_of(name) == dimensions &&
        has_corners(file, find_bounds(file, name)))
      return name;
  return {};
}

/// Counts the variables that have all dimensions of a coordinate.
std::int64_t count_variables(const NetcdfReader& file, const std::string& coordinate) {
  const std::vector<std::string> wanted = file.dimensions_of(coordinate);
  const std::vector<std::string> names = file.variable_names();
  return std::count_if(names.begin(), names.end(), [&](const std::string& name) {
    const std::vector<std::string> has = file.dimensions_of(name);
    return std::all_of(wanted.begin(), wanted.end(), [&](const std::string& dimension) {
      return std::find(has.begin(), has.end(), dimension) != has.end();
    });
  });
}

std::optional<CellRows> bounded_cells(const NetcdfReader& file) {
  std::optional<CellRows> best;
  std::int64_t most = -1;
  for (const std::string& name : file.variable_names()) {
    if (!is_longitude(file, name) || !has_corners(file, find_bounds(file, name)))
      continue;
    const std::string latitude = find_latitude(file, name);
    if (const std::int64_t count = count_variables(file, name); !latitude.empty() && count > most) {
      most = count;
      best = {find_bounds(file, name), find_bounds(file, latitude), name, latitude};
    }
  }
  return best;
}

constexpr std::string_view oasis_corners = ".clo";

std::vector<std::string> oasis_grids(const NetcdfReader& file) {
  std::vector<std::string> grids;
  for (const std::string& name : file.variable_names())
    if (name.ends_with(oasis_corners)) {
      const std::string grid = name.substr(0, name.size() - oasis_corners.size());
      if (file.has_variable(grid + ".cla"))
        grids.push_back(grid);
    }
  return grids;
}

std::optional<CellRows> oasis_cells(const NetcdfReader& file) {
  const std::vector<std::string> grids = oasis_grids(file);
  if (grids.empty())
    return {};
  const std::string& grid = grids.front();
  if (grids.size() > 1)
    file.fail("grids of OASIS for several models ({}, {}{}); write one of them to a file of its "
              "own, such as with ncks -v {}.lon,{}.lat,{}.clo,{}.cla",
              grid, grids[1], grids.size() > 2 ? ", ..." : "", grid, grid, grid, grid);
  const bool centres = file.has_variable(grid + ".lon") && file.has_variable(grid + ".lat");
  return CellRows{grid + ".clo", grid + ".cla", centres ? grid + ".lon" : "",
                  centres ? grid + ".lat" : "", true};
}

// ---- What a file is instead of a mesh

/// The first variable for which is(variable) is true; empty without one.
template <class Is> std::string first_variable(const NetcdfReader& file, const Is& is) {
  const std::vector<std::string> names = file.variable_names();
  const auto found = std::find_if(names.begin(), names.end(), is);
  return found == names.end() ? "" : *found;
}

std::string two_bounds(const NetcdfReader& file) {
  return first_variable(file, [&](const std::string& name) {
    const std::string bounds = is_longitude(file, name) ? find_bounds(file, name) : "";
    return !bounds.empty() && file.shape_of(bounds).back() == 2;
  });
}

} // namespace

Polygons read_cell_rows(const NetcdfReader& file, const CellRows& rows, const Points3& centres) {
  const std::vector<std::int64_t> shape = file.shape_of(rows.corner_longitude);
  if (shape.size() < 2)
    file.fail("{} has no dimension of corners; make the file again", rows.corner_longitude);
  const std::int64_t most = rows.corners_first ? shape.front() : shape.back();
  if (most < 3)
    file.fail("{} has {} corners a cell; make the file again with three or more",
              rows.corner_longitude, most);
  LonLats points{cf_values(file, rows.corner_longitude, shape),
                 cf_values(file, rows.corner_latitude, shape)};
  const std::int64_t cells = std::ssize(points.longitudes) / most;
  if (centres.cols() > 0 && cells != centres.cols())
    file.fail("{} holds {} cells, but there are {} centres; make the file again",
              rows.corner_longitude, cells, centres.cols());
  if (rows.corners_first)
    for (std::vector<double>* values : {&points.longitudes, &points.latitudes})
      transpose(*values, most);
  const std::vector<std::size_t> missing = fill_missing(file, rows, points);
  scale(points.longitudes, corner_degrees_per_unit(file, rows.corner_longitude, rows.longitude));
  scale(points.latitudes, corner_degrees_per_unit(file, rows.corner_latitude, rows.latitude));
  points = checked(file, rows.corner_longitude + " and " + rows.corner_latitude, std::move(points));
  DistinctPoints distinct = find_distinct_points(points.longitudes, points.latitudes);
  for (const std::size_t i : missing)
    distinct.id[i] = -1;
  return make_polygons(distinct.id, most, from_degrees(distinct.longitudes, distinct.latitudes),
                       centres);
}

std::optional<CellRows> find_cell_rows(const NetcdfReader& file) {
  const std::optional<CellRows> cells = bounded_cells(file);
  return cells ? cells : oasis_cells(file);
}

RawMesh read_cells(const NetcdfReader& file, const CellRows& rows, FieldChoice choice) {
  RawMesh raw;
  if (!rows.longitude.empty())
    raw.points =
        read_lonlats(file, rows.longitude, rows.latitude,
                     std::vector<std::int64_t>(file.dimensions_of(rows.longitude).size(), -1));
  raw.polygons = read_cell_rows(file, rows, raw.points);
  raw.corner_rounding = find_rounding(file, rows.corner_longitude);
  std::vector<std::string> dimensions = file.dimensions_of(rows.corner_longitude);
  dimensions.erase(rows.corners_first ? dimensions.begin() : std::prev(dimensions.end()));
  read_fields_on(
      file,
      {.dimensions = dimensions,
       .no_fields = {rows.corner_longitude, rows.corner_latitude, rows.longitude, rows.latitude},
       .choice = choice},
      raw.fields, raw.ignored);
  drop_derived_fields(raw);
  return raw;
}

void refuse_netcdf(const NetcdfReader& file) {
  const std::string connectivity = first_variable(file, [&](const std::string& name) {
    return file.text(name, "cf_role") == "face_node_connectivity";
  });
  if (!connectivity.empty())
    file.fail("the connectivity {} of UGRID, but no variable of cf_role \"mesh_topology\" and "
              "topology_dimension 2, which names it and the coordinates of the nodes; add one",
              connectivity);
  if (file.has_variable("elements") && file.has_variable("edge_cross_dxdy"))
    file.fail("the mesh information of an older FESOM, without the topology of UGRID; give the "
              "model's nod2d.out, or the fesom.mesh.diag.nc of FESOM 2.1 or later");
  if (file.has_variable("nv") && file.has_variable("lonc"))
    file.fail(
        "the triangles of FVCOM (nv) without the topology of UGRID; add a variable of cf_role "
        "\"mesh_topology\" and topology_dimension 2, whose face_node_connectivity is nv and "
        "whose node_coordinates are lon lat, and to nv the attribute start_index 1");
  if (const std::optional<RasterAxes> axes = raster_axes(file))
    file.fail("a raster of {} and {}, not a mesh; interpolate, cvt --cell-width and cull --raster "
              "take rasters, and cdo setgridtype,curvilinear makes cells of one",
              axes->latitude, axes->longitude);
  if (const std::string longitude = two_bounds(file); !longitude.empty())
    file.fail("a grid of rows and columns, as {} has two bounds; cells need their corners, which "
              "cdo setgridtype,curvilinear writes",
              longitude);
  if (file.dimension("nCells") >= 0 && !file.has_variable("xCell"))
    file.fail(
        "fields of MPAS without the mesh (xCell, yCell and zCell are missing); give the mesh, "
        "too, or add its variables with ncks -A");
  const std::string points = first_variable(file, [&](const std::string& name) {
    return is_longitude(file, name) && file.dimensions_of(name).size() == 1;
  });
  if (!points.empty())
    file.fail("longitudes ({}) without bounds of three corners or more, so that its cells have no "
              "shape; give a file with bounds, or the points as text to calotte delaunay --lonlat",
              points);
  file.fail("a NetCDF file, but no mesh of MPAS, UGRID, SCRIP, ESMF, Exodus or ICON, and no cells "
            "with bounds as in the CF conventions; convert it to one of them");
}

} // namespace calotte::io_detail
