// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "io/formats.h"
#include "io/model_grid.h"

#include <limits>

// The unstructured grid file of the Earth System Modeling Framework (its reference manual,
// "ESMF Unstructured Grid File Format"): elements are the cells, nodes their corners.

namespace calotte::io_detail {
namespace {

/// The corners of each element, 1-based.
void add_elements(GridFile& file, const Voronoi& cells, int elements) {
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
    return static_cast<std::int32_t>(cells.begin[cell + 1] - cells.begin[cell]);
  };
  // The manual's type is too small for the cell of a pole among many meridians.
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

} // namespace

void write_esmf(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  const Voronoi cells = voronoi(mesh);
  GridFile file(path, options, "CF-1.8");
  file.netcdf().attribute({"gridType", std::string("unstructured")});
  file.netcdf().attribute({"version", std::string("0.9")});
  const int nodes = file.netcdf().dimension("nodeCount", cells.vertices.cols());
  const int elements = file.netcdf().dimension("elementCount", cells.cells.cols());
  const int pair = file.netcdf().dimension("coordDim", 2);

  file.doubles("nodeCoords", {nodes, pair}, degrees("the node, a corner of cells"),
               lonlats_of(cells.vertices));
  add_elements(file, cells, elements);
  file.doubles("centerCoords", {elements, pair}, degrees("the element's site"),
               lonlats_of(cells.cells));
  file.doubles("elementArea", {elements},
               {{"units", std::string("radians^2")},
                {"long_name", std::string("area of the element on the unit sphere")}},
               values_of(cells.cell_area));
  file.ints("elementMask", {elements},
            {{"units", std::string("1")},
             {"long_name", std::string("mask of the elements: 1 takes part")}},
            constant(1));
  file.commit();
}

bool is_esmf(const NetcdfReader& file) {
  return file.dimension("elementCount") >= 0 || file.has_variable("elementConn");
}

Soup read_esmf(const NetcdfReader& file) {
  const std::string name = "centerCoords";
  if (!file.has_variable(name))
    file.fail("it has no variable " + name +
              ", which holds the cells' sites; add it, or give a "
              "file of another format");
  const std::vector<double> pairs = file.doubles(name, {-1, 2});
  const double scale = degrees_per_unit(file, name);
  std::vector<double> longitudes, latitudes;
  for (std::size_t i = 0; i < pairs.size(); i += 2) {
    longitudes.push_back(scale * pairs[i]);
    latitudes.push_back(scale * pairs[i + 1]);
  }
  return {from_lonlats(file, name, longitudes, latitudes), {}};
}

} // namespace calotte::io_detail
