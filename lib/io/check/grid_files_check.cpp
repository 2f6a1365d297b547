// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/model_grid.h"
#include "io/check/grid_check.h"
#include "io/formats/formats.h"
#include "io/formats/ugrid.h"

#include "base/message.h"
#include "base/points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace calotte::io_detail {
namespace {

// ---- Attributes

/// Checks that the names in an attribute of a variable are variables.
void check_names(const std::string& variable, const std::string& attribute,
                 Deviations& deviations) {
  for (const std::string& name : names_in(deviations.file().text(variable, attribute)))
    if (!deviations.file().has_variable(name))
      deviations.add(variable, message("the attribute {} of {} names {}, which is no variable of "
                                       "the file",
                                       attribute, variable, name));
}

void check_all_names(Deviations& deviations) {
  for (const std::string& variable : deviations.file().variable_names())
    for (const char* attribute :
         {"coordinates", "bounds", "mesh", "node_coordinates", "edge_coordinates",
          "face_coordinates", "face_node_connectivity", "edge_node_connectivity",
          "face_edge_connectivity", "face_face_connectivity", "edge_face_connectivity"})
      check_names(variable, attribute, deviations);
}

/// Checks the units of longitudes and latitudes.
void check_units(const std::string& variable, Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  if (file.has_variable(variable) && file.text(variable, "units").empty())
    deviations.add(variable, message("{} has no units; they must be degrees or radians", variable));
}

void check_role(const std::string& variable, const std::string& role, Deviations& deviations) {
  const std::string stored = deviations.file().text(variable, "cf_role");
  if (!stored.empty() && stored != role)
    deviations.add(variable, message("the attribute cf_role of {} is \"{}\" instead of \"{}\"",
                                     variable, stored, role));
}

void check_ugrid_attributes(const Topology& topology, Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  check_all_names(deviations);
  check_role(topology.face_nodes, "face_node_connectivity", deviations);
  if (file.number(topology.mesh, "topology_dimension", -1) != 2)
    deviations.add(
        topology.mesh,
        message("the attribute topology_dimension of {} is missing; it must be 2", topology.mesh));
  const double start = file.number(topology.face_nodes, "start_index", 0);
  if (start != 0 && start != 1)
    deviations.add(topology.face_nodes,
                   message("the attribute start_index of {} is {}; it must be 0 or 1",
                           topology.face_nodes, start));
  if (!topology.face_dimension.empty() && file.dimension(topology.face_dimension) < 0)
    deviations.add(topology.mesh, message("the attribute face_dimension of {} names {}, which is "
                                          "no dimension of the file",
                                          topology.mesh, topology.face_dimension));
  for (const auto* names : {&topology.nodes, &topology.faces})
    for (const std::string& name : *names)
      check_units(name, deviations);
}

// ---- Sites

/// Compares Cartesian coordinates with longitudes and latitudes.
void check_sites(const std::vector<std::string>& names, const Points3& points, double rounding,
                 const MeshFile& file, Deviations& deviations) {
  const double stored_radius = deviations.file().number("", "sphere_radius", 0);
  const double radius =
      stored_radius > 0 && std::isfinite(stored_radius) ? stored_radius : file.sphere_radius;
  const double width = std::sqrt(4 * std::numbers::pi /
                                 static_cast<double>(std::max<Eigen::Index>(points.cols(), 1)));
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& name = names[static_cast<std::size_t>(axis)];
    if (!deviations.has(name, {points.cols()}))
      continue;
    const double of_floats = rounding + find_rounding(deviations.file(), name);
    deviations.check_rows<double>(
        name, "the place at the longitude and latitude, on the sphere of sphere_radius",
        [&](std::int64_t i, const double* stored, Differences& out) {
          out.compare(i, *stored, radius * points(axis, i), radius * width,
                      rounding_of_others + of_floats / width);
        });
  }
}

// ---- Bounds

/// Compares the bounds of longitudes or latitudes of the faces with their nodes. Values after the
/// last corner may be any of the corners, or NaN.
void check_bounds(const std::string& variable, bool longitude, const StoredGrid& grid,
                  Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  const std::string name = file.text(variable, "bounds");
  if (name.empty() || !deviations.has(name, {grid.polygons.size(), -1}))
    return;
  const double unit = degrees_per_unit(file, variable), fill = file.number(name, "_FillValue", NAN),
               degree = std::numbers::pi / 180,
               tolerance = 1e-9 + (grid.rounding + find_rounding(file, name)) / degree;
  const Polygons& faces = grid.polygons;
  const std::int64_t width = deviations.width(name);
  const auto corner_at = [&](std::int64_t face, std::int64_t k) {
    return eastern_lonlat_of(column(faces.corners, corner_or_last(faces, face, k)));
  };
  const auto is_angle_of = [&](const LonLat& corner, double value) { // or cannot be told there
    return longitude ? std::abs(std::remainder(unit * value - corner.longitude, 360.0)) *
                               std::cos(corner.latitude * degree) <=
                           tolerance
                     : std::abs(unit * value - corner.latitude) <= tolerance;
  };
  const auto fits = [&](std::int64_t face, std::int64_t k, double value) {
    const std::int64_t count = faces.ids.count(face);
    bool any =
        k >= count ? value == fill || std::isnan(value) : is_angle_of(corner_at(face, k), value);
    for (std::int64_t j = 0; !any && k >= count && j < count; ++j)
      any = is_angle_of(corner_at(face, j), value);
    return any;
  };
  deviations.check_rows<double>(
      name, "the corners of the faces in their order",
      [&](std::int64_t face, const double* row, Differences& out) {
        for (std::int64_t k = 0; k < width; ++k)
          if (!fits(face, k, row[k])) {
            const LonLat corner = corner_at(face, k);
            out.note(face * width + k, row[k],
                     (longitude ? corner.longitude : corner.latitude) / unit, 1);
          }
      });
}

// ---- SCRIP

void check_grid_dims(std::int64_t cells, Deviations& deviations) {
  if (!deviations.has("grid_dims", {-1}))
    return;
  double product = 1;
  for (const double size : deviations.file().doubles("grid_dims", {-1}))
    product *= size;
  if (product != static_cast<double>(cells))
    deviations.add(
        "grid_dims",
        message("grid_dims: the product of its sizes is {}, but grid_size is {}", product, cells),
        0, std::abs(product / static_cast<double>(cells) - 1));
}

// ---- ESMF

/// Whether an entry after the last node of an element is another node. The last node again is
/// padding.
bool is_node(std::int32_t id, std::int32_t last, std::int32_t start, double fill,
             std::int64_t nodes) {
  return id != last && id != fill && id >= start && id < start + nodes;
}

void check_padding(std::int64_t nodes, Deviations& deviations) {
  const NetcdfReader& file = deviations.file();
  const std::int32_t start = file.start_index("elementConn", 1);
  const double fill =
      file.number("elementConn", "_FillValue", std::numeric_limits<double>::quiet_NaN());
  const std::vector<std::int32_t> counts = file.ints("numElementConn", {-1});
  const std::int64_t width = deviations.width("elementConn");
  const Differences differences = deviations.visit_rows<std::int32_t>(
      "elementConn", [&](std::int64_t i, const std::int32_t* row, Differences& out) {
        std::int64_t count = counts[static_cast<std::size_t>(i)];
        while (count < width && is_node(row[count], row[count - 1], start, fill, nodes))
          ++count;
        if (count != counts[static_cast<std::size_t>(i)])
          out.note(i, counts[static_cast<std::size_t>(i)], static_cast<double>(count), 1);
      });
  deviations.add("numElementConn", differences, "the numbers of nodes in elementConn");
}

} // namespace

void check_ugrid(const MeshFile& file, Deviations& deviations) {
  const NetcdfReader& stored = deviations.file();
  const Topology topology = read_topology(stored);
  check_ugrid_attributes(topology, deviations);
  const StoredGrid grid{read_ugrid_faces(stored, topology), topology.face_nodes,
                        topology.nodes[0] + ", " + topology.nodes[1],
                        topology.faces.empty() ? "" : topology.faces[0] + ", " + topology.faces[1],
                        find_rounding(stored, topology.nodes[0])};
  if (!topology.sites.empty()) {
    const bool at_nodes =
        stored.dimensions_of(topology.sites[0]) == stored.dimensions_of(topology.nodes[0]);
    const Points3& points = at_nodes ? grid.polygons.corners : grid.polygons.centres;
    if (points.cols() > 0)
      check_sites(topology.sites, points, grid.rounding, file, deviations);
  }
  const Sides sides(grid.polygons);
  check_polygons(grid, sides, deviations);
  check_areas(grid, "cell_area", deviations);
  for (std::size_t k = 0; k < topology.faces.size() && grid.polygons.surface.is_sphere(); ++k)
    check_bounds(topology.faces[k], k == 0, grid, deviations);
  check_ugrid_connectivity(grid.polygons, sides, topology.mesh, deviations);
}

void check_scrip(const MeshFile& /*file*/, Deviations& deviations) {
  const NetcdfReader& stored = deviations.file();
  check_all_names(deviations);
  Points3 centres;
  if (stored.has_variable("grid_center_lon"))
    centres = read_lonlats(stored, "grid_center_lon", "grid_center_lat");
  const std::int64_t cells = stored.dimension("grid_size");
  check_grid_dims(cells, deviations);
  check_mask("grid_imask", cells, deviations);
  for (const char* name :
       {"grid_center_lon", "grid_center_lat", "grid_corner_lon", "grid_corner_lat"})
    check_units(name, deviations);
  if (!stored.has_variable("grid_corner_lon"))
    return;
  const StoredGrid grid{read_scrip_cells(stored, centres), "grid_corner_lon, grid_corner_lat",
                        "grid_corner_lon, grid_corner_lat", "grid_center_lon, grid_center_lat",
                        find_rounding(stored, "grid_corner_lon")};
  check_polygons(grid, Sides(grid.polygons), deviations);
  check_areas(grid, "grid_area", deviations);
}

void check_esmf(const MeshFile& /*file*/, Deviations& deviations) {
  const NetcdfReader& stored = deviations.file();
  check_all_names(deviations);
  for (const char* name : {"nodeCoords", "centerCoords"})
    check_units(name, deviations);
  if (!stored.has_variable("elementConn"))
    return;
  const StoredGrid grid{read_esmf_cells(stored, read_esmf_centres(stored)), "elementConn",
                        "nodeCoords", "centerCoords", find_rounding(stored, "nodeCoords")};
  check_mask("elementMask", grid.polygons.size(), deviations);
  check_padding(grid.polygons.corners.cols(), deviations);
  check_polygons(grid, Sides(grid.polygons), deviations);
  check_areas(grid, "elementArea", deviations);
}

} // namespace calotte::io_detail
