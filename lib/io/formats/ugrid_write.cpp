// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/model_grid.h"
#include "io/cells/written_fields.h"
#include "io/formats/formats.h"
#include "io/formats/ugrid.h"

#include "base/points.h"

namespace calotte::io_detail {
namespace {

const std::string mesh_name = "mesh", node_name = "mesh_node", face_name = "mesh_face",
                  face_nodes_name = "mesh_face_nodes", bounds_end = "_bnds";

NetcdfAttribute long_name(const std::string& text) { return {"long_name", text}; }

std::string three_names(const std::string& prefix) {
  return prefix + "_x " + prefix + "_y " + prefix + "_z";
}

/// The names of longitude and latitude, or of x and y in a plane.
std::string coordinate_names(const std::string& prefix, bool on_sphere) {
  std::string names = prefix;
  names.append(on_sphere ? "_lon " : "_x ").append(prefix).append(on_sphere ? "_lat" : "_y");
  return names;
}

/// Adds the mesh variable, which names the others.
/// \param sites prefix of the coordinate variables of the sites; empty for none.
void add_topology(NetcdfGridFile& file, const std::string& what, const std::string& sites,
                  bool has_face_coordinates, bool on_sphere) {
  NetcdfAttributes attributes{
      {"cf_role", std::string("mesh_topology")},
      long_name(what),
      {"units", std::string("1")},
      {"topology_dimension", std::int32_t{2}},
      {"node_coordinates", coordinate_names(node_name, on_sphere)},
      {"face_node_connectivity", face_nodes_name},
      {"face_dimension", face_name},
  };
  if (!sites.empty())
    attributes.push_back({site_coordinates, three_names(sites)});
  if (has_face_coordinates)
    attributes.push_back({"face_coordinates", coordinate_names(face_name, on_sphere)});
  file.ints(mesh_name, {}, attributes, constant(0));
}

/// Adds x and y in a plane.
/// \param of noun in the long name.
void add_projected(NetcdfGridFile& file, const std::string& prefix, int dimension,
                   const std::string& of, const Points3& points) {
  for (int row = 0; row < 2; ++row) {
    const std::string axis(1, "xy"[row]);
    std::string name = prefix + "_";
    name += axis;
    file.doubles(name, {dimension},
                 {{"units", std::string("m")},
                  {"standard_name", "projection_" + axis + "_coordinate"},
                  long_name(axis + " of " + of)},
                 coordinate_row(points, row));
  }
}

/// Adds longitudes and latitudes of nodes or faces.
/// \param of noun in the long name.
/// \param bounds whether they have bounds, see add_bounds().
void add_lonlats(NetcdfGridFile& file, const std::string& prefix, int dimension,
                 const std::string& of, const Points3& points, bool bounds = false) {
  const auto add = [&](const std::string& axis, const std::string& name, const std::string& units,
                       const NetcdfWriter::Fill<double>& contents) {
    NetcdfAttributes attributes{
        {"units", units}, {"standard_name", name}, long_name(name + " of " + of)};
    if (bounds)
      attributes.push_back({"bounds", prefix + axis + bounds_end});
    file.doubles(prefix + axis, {dimension}, attributes, contents);
  };
  add("_lon", "longitude", "degrees_east", longitudes_of(points));
  add("_lat", "latitude", "degrees_north", latitudes_of(points));
}

/// Adds the corners of the faces as bounds of their longitudes and latitudes, as the CF conventions
/// define them; without bounds CDO cannot compute areas. The last corner fills the rest of a row.
/// \param corner(face, k) the k-th corner of a face, k < most; the last one from there on.
template <class Corner>
void add_bounds(NetcdfGridFile& file, int faces, std::int64_t most, const Corner& corner) {
  const int corners = file.netcdf().dimension("mesh_max_face_bounds", most);
  const auto add = [&](const std::string& axis, const std::string& what, const std::string& units,
                       const auto& angle) {
    file.doubles(face_name + axis + bounds_end, {faces, corners},
                 {{"units", units}, long_name(what + " of the corners of the face")},
                 table<double>(most, [corner, angle](std::int64_t face, std::int64_t k) {
                   return angle(eastern_lonlat_of(corner(face, k)));
                 }));
  };
  add("_lon", "longitude", "degrees_east", [](const LonLat& lonlat) { return lonlat.longitude; });
  add("_lat", "latitude", "degrees_north", [](const LonLat& lonlat) { return lonlat.latitude; });
}

void add_cartesian(NetcdfGridFile& file, const std::string& prefix, int dimension,
                   const Points3& points) {
  for (int row = 0; row < 3; ++row) {
    const std::string axis(1, "xyz"[row]);
    std::string name = prefix + "_";
    name += axis;
    file.doubles(name, {dimension},
                 {{"units", std::string("m")}, long_name("Cartesian " + axis + " of the site")},
                 coordinate_row(points, row));
  }
}

/// \param node(face, k) the k-th node of a face; -1 past the last.
template <class Node>
void add_face_nodes(NetcdfGridFile& file, int faces, std::int64_t most, const Node& node) {
  const int corners = file.netcdf().dimension("mesh_max_face_nodes", most);
  file.ints(
      face_nodes_name, {faces, corners},
      {{"cf_role", std::string("face_node_connectivity")},
       long_name("nodes of the face, counter-clockwise seen from outside, 0-based; -1 where there "
                 "is none"),
       {"units", std::string("1")},
       {"start_index", std::int32_t{0}},
       {"_FillValue", std::int32_t{-1}}},
      table<std::int32_t>(most, node));
}

constexpr const char* conventions = "CF-1.8 UGRID-1.0";

/// Attributes of a data variable at faces or nodes.
/// \param coordinates names of their coordinates; empty for none.
NetcdfAttributes located(const std::string& location, const std::string& coordinates) {
  NetcdfAttributes attributes{{"mesh", mesh_name}, {"location", location}};
  if (!coordinates.empty())
    attributes.push_back({"coordinates", coordinates});
  return attributes;
}

/// Adds a data variable at the faces. Without one, CDO does not recognise an unstructured grid.
void add_areas(NetcdfGridFile& file, int faces, const DoubleVector& areas,
               bool has_face_coordinates, bool on_sphere) {
  NetcdfAttributes attributes =
      located("face", has_face_coordinates ? coordinate_names(face_name, on_sphere) : "");
  attributes.push_back({"units", std::string(on_sphere ? "radians^2" : "m2")});
  attributes.push_back(
      long_name(on_sphere ? "area of the face on the unit sphere" : "area of the face"));
  attributes.push_back({"standard_name", std::string("cell_area")});
  file.doubles("cell_area", {faces}, attributes, values_of(areas));
}

} // namespace

NetcdfMeshNames ugrid_names(bool of_cells) {
  NetcdfMeshNames names{of_cells ? face_name : node_name,
                        of_cells ? node_name : face_name,
                        {mesh_name, face_nodes_name, "cell_area"}};
  for (const std::string& prefix : {node_name, face_name})
    for (const char* end : {"_lon", "_lat", "_x", "_y", "_z"})
      names.variables.insert(prefix + end);
  for (const char* end : {"_lon", "_lat"})
    names.variables.insert(face_name + end + bounds_end);
  return names;
}

void write_ugrid(const std::string& path, const CellGrid& grid, const WriteOptions& options) {
  const Polygons& cells = grid.polygons;
  const bool on_sphere = cells.surface.is_sphere();
  NetcdfGridFile file(path, on_sphere ? options : of_plane(options), conventions);
  const auto add_coordinates = [&](const std::string& prefix, int dimension, const std::string& of,
                                   const Points3& points) {
    if (on_sphere)
      add_lonlats(file, prefix, dimension, of, points, prefix == face_name);
    else
      add_projected(file, prefix, dimension, of, points);
  };
  const bool has_centres = cells.centres.cols() > 0, has_sites = grid.sites.cols() > 0;
  const Points3 sites = io_detail::on_sphere(grid.sites, options.sphere_radius);
  const int nodes = file.netcdf().dimension(node_name, cells.corners.cols());
  const int faces = file.netcdf().dimension(face_name, cells.size());
  add_areas(file, faces, grid.area, has_centres,
            on_sphere); // first, because CDO uses its grid for the file
  add_topology(file, has_sites ? "Voronoi cells of the sites" : "cells", has_sites ? face_name : "",
               has_centres, on_sphere);
  add_coordinates(node_name, nodes, "the node, a corner of cells", cells.corners);
  if (has_centres)
    add_coordinates(face_name, faces, "the face's site", cells.centres);
  add_face_nodes(file, faces, most_corners(cells),
                 [&cells](std::int64_t cell, std::int64_t k) { return corner(cells, cell, k); });
  if (on_sphere && has_centres)
    add_bounds(file, faces, most_corners(cells), [&cells](std::int64_t cell, std::int64_t k) {
      return column(cells.corners, corner_or_last(cells, cell, k));
    });
  if (has_sites)
    add_cartesian(file, face_name, faces, sites);
  add_fields(
      file, options,
      {.cells = {faces, located("face", has_centres ? coordinate_names(face_name, on_sphere) : "")},
       .vertices = {nodes, located("node", coordinate_names(node_name, on_sphere))}},
      ugrid_names(true));
  file.commit();
}

void write_ugrid_triangles(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  const Points3 sites = on_sphere(mesh.points, options.sphere_radius);
  const Points3 directions = on_sphere(mesh.points, 1);
  const Points3 centres = mesh.closed() ? voronoi(mesh).vertices : Points3();
  NetcdfGridFile file(path, options, conventions);
  const int nodes = file.netcdf().dimension(node_name, sites.cols());
  const int faces = file.netcdf().dimension(face_name, mesh.triangles.cols());
  add_topology(file, "Delaunay triangles of the sites", node_name, mesh.closed(), true);
  add_lonlats(file, node_name, nodes, "the node, a site", directions);
  if (mesh.closed())
    add_lonlats(file, face_name, faces, "the face's circumcentre", centres, true);
  add_face_nodes(file, faces, 3, [&mesh](std::int64_t triangle, std::int64_t k) {
    return mesh.triangles(k, triangle);
  });
  if (mesh.closed())
    add_bounds(file, faces, 3, [&](std::int64_t triangle, std::int64_t k) {
      return column(directions, mesh.triangles(k, triangle));
    });
  add_cartesian(file, node_name, nodes, sites);
  add_fields(file, options,
             {.cells = {nodes, located("node", coordinate_names(node_name, true))},
              .vertices = {faces, located("face",
                                          mesh.closed() ? coordinate_names(face_name, true) : "")}},
             ugrid_names(false));
  file.commit();
}

} // namespace calotte::io_detail
