// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/array.h"
#include "base/points.h"
#include "io/cells/model_grid.h"
#include "io/cells/written_fields.h"
#include "io/formats/formats.h"
#include "io/netcdf/cf_values.h"

#include <limits>

// The unstructured grid file of the Earth System Modeling Framework (its reference manual,
// "ESMF Unstructured Grid File Format"): elements are the cells, nodes their corners.

namespace calotte::io_detail {
namespace {

/// Writes the corners of each element, 1-based.
void add_elements(NetcdfGridFile& file, const Polygons& cells, int elements) {
  const std::int64_t most = most_corners(cells);
  const int corners = file.netcdf().dimension("maxNodePElement", most);
  const std::string unit = "1";
  file.ints("elementConn", {elements, corners},
            {{"units", unit},
             {"long_name", std::string("node indices of the element, counter-clockwise")},
             {"start_index", std::int32_t{1}},
             {"_FillValue", std::int32_t{-1}}},
            table<std::int32_t>(most, [&cells](std::int64_t cell, std::int64_t k) {
              const std::int32_t node = corner(cells, cell, k);
              return node < 0 ? -1 : node + 1;
            }));

  const NetcdfAttributes attributes{{"units", unit},
                                    {"long_name", std::string("number of nodes of the element")}};
  const auto count = [&cells](std::int64_t cell, std::int64_t /*k*/) {
    return static_cast<std::int32_t>(cells.ids.count(cell));
  };
  // The type of the manual is too small for a cell at a pole that has many meridians.
  if (most <= std::numeric_limits<std::int8_t>::max())
    file.variable<std::int8_t>("numElementConn", NetcdfType::int8, {elements}, attributes,
                               table<std::int8_t>(1, [count](std::int64_t cell, std::int64_t k) {
                                 return static_cast<std::int8_t>(count(cell, k));
                               }));
  else
    file.ints("numElementConn", {elements}, attributes, table<std::int32_t>(1, count));
}

NetcdfAttributes degrees(const std::string& of) {
  return {{"units", std::string("degrees")}, {"long_name", "longitude and latitude of " + of}};
}

/// Reads longitudes and latitudes in pairs.
Points3 read_pairs(const NetcdfReader& file, const std::string& name) {
  const std::vector<double> pairs = cf_values(file, name, {-1, 2});
  const double factor = degrees_per_unit(file, name);
  const std::size_t count = pairs.size() / 2;
  LonLats points{std::vector<double>(count), std::vector<double>(count)};
  for (std::size_t i = 0; i < count; ++i) {
    points.longitudes[i] = factor * pairs[2 * i];
    points.latitudes[i] = factor * pairs[2 * i + 1];
  }
  points = checked(file, name, std::move(points));
  return from_degrees(points.longitudes, points.latitudes);
}

/// Reads the corners of the elements. Values after the number in numElementConn are padding.
Polygons read_elements(const NetcdfReader& file, Points3 nodes, Points3 centres) {
  const std::vector<std::int32_t> all = file.ints("elementConn", {-1, -1});
  const std::int64_t elements = file.shape_of("elementConn")[0],
                     most = file.shape_of("elementConn")[1];
  const std::vector<std::int32_t> counts = file.ints("numElementConn", {elements});
  const std::int64_t start = file.start_index("elementConn", 1);
  Polygons polygons{
      std::move(nodes), {Offsets(elements + 1), Ids(std::ssize(all))}, std::move(centres)};
  auto& [begin, ids] = polygons.ids;
  begin[0] = 0;
  for (std::int64_t i = 0; i < elements; ++i) {
    const std::int32_t count = counts[static_cast<std::size_t>(i)];
    if (count < 3 || count > most)
      file.fail("element {} (0-based) has {} nodes in numElementConn; make the file again", i,
                count);
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t id = all[static_cast<std::size_t>(i * most + k)] - start;
      if (id < 0 || id >= polygons.corners.cols())
        file.fail("element {} (0-based) has node {} in elementConn, which is not one of {} from {} "
                  "on; make the file again",
                  i, id + start, polygons.corners.cols(), start);
      ids[begin[i] + k] = static_cast<std::int32_t>(id);
    }
    begin[i + 1] = begin[i] + count;
  }
  ids.conservativeResize(begin[elements]);
  return polygons;
}

} // namespace

const NetcdfMeshNames& esmf_names() {
  static const NetcdfMeshNames names{
      .cells = "elementCount",
      .vertices = "nodeCount",
      .variables = {"nodeCoords", "elementConn", "numElementConn", "centerCoords"},
      .derived = {"elementArea", "elementMask"}};
  return names;
}

void write_esmf(const std::string& path, const CellGrid& grid, const WriteOptions& options) {
  const Polygons& cells = grid.polygons;
  NetcdfGridFile file(path, options, "CF-1.8");
  file.netcdf().attribute({"gridType", std::string("unstructured")});
  file.netcdf().attribute({"version", std::string("0.9")});
  const int nodes = file.netcdf().dimension("nodeCount", cells.corners.cols());
  const int elements = file.netcdf().dimension("elementCount", cells.size());
  const int pair = file.netcdf().dimension("coordDim", 2);

  file.doubles("nodeCoords", {nodes, pair}, degrees("the node, a corner of cells"),
               lonlats_of(cells.corners));
  add_elements(file, cells, elements);
  if (cells.centres.cols() > 0)
    file.doubles("centerCoords", {elements, pair}, degrees("the element's site"),
                 lonlats_of(cells.centres));
  file.doubles("elementArea", {elements},
               {{"units", std::string("radians^2")},
                {"long_name", std::string("area of the element on the unit sphere")}},
               values_of(grid.area));
  file.ints("elementMask", {elements},
            {{"units", std::string("1")},
             {"long_name", std::string("mask of the elements: 1 takes part")}},
            make_mask(options));
  add_fields(file, options, {.cells = {elements}, .vertices = {nodes}}, esmf_names());
  file.commit();
}

bool is_esmf(const NetcdfReader& file) {
  return file.dimension("elementCount") >= 0 || file.has_variable("elementConn");
}

Points3 read_esmf_centres(const NetcdfReader& file) {
  return file.has_variable("centerCoords") ? read_pairs(file, "centerCoords") : Points3();
}

Polygons read_esmf_cells(const NetcdfReader& file, const Points3& centres) {
  return read_elements(file, read_pairs(file, "nodeCoords"), centres);
}

RawMesh read_esmf(const NetcdfReader& file, FieldChoice choice) {
  RawMesh raw{.points = read_esmf_centres(file)};
  if (file.has_variable("elementConn")) {
    raw.polygons = read_esmf_cells(file, raw.points);
    raw.corner_rounding = find_rounding(file, "nodeCoords");
  } else if (raw.points.cols() == 0) {
    file.fail("it has neither centerCoords, the cells' sites, nor elementConn, their corners; give "
              "a file that has");
  }
  read_fields(file, esmf_names(), choice, raw);
  drop_derived_fields(raw);
  return raw;
}

} // namespace calotte::io_detail
