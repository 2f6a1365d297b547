// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats.h"
#include "io/model_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

// The UGRID conventions 1.0 for unstructured grids in NetCDF files. They hold longitudes and
// latitudes, which do not lead back to the last bit of Cartesian coordinates: those of the sites go
// along, and the mesh variable's attribute site_coordinates, which is ours, names them. By it the
// reader knows a file of ours, and by their dimension whether sites are faces or nodes.

namespace calotte::io_detail {
namespace {

const std::string mesh_name = "mesh", node_name = "mesh_node", face_name = "mesh_face",
                  face_nodes_name = "mesh_face_nodes", site_coordinates = "site_coordinates";

// ---- Writing

NetcdfAttribute long_name(const std::string& text) { return {"long_name", text}; }

std::string three_names(const std::string& prefix) {
  return prefix + "_x " + prefix + "_y " + prefix + "_z";
}

/// The variable that says what the others are.
/// \param sites the prefix of the variables of the sites' places.
void add_topology(GridFile& file, const std::string& what, const std::string& sites,
                  bool face_places) {
  NetcdfAttributes attributes{
      {"cf_role", std::string("mesh_topology")},
      long_name(what),
      {"units", std::string("1")},
      {"topology_dimension", std::int32_t{2}},
      {"node_coordinates", node_name + "_lon " + node_name + "_lat"},
      {"face_node_connectivity", face_nodes_name},
      {"face_dimension", face_name},
      {site_coordinates, three_names(sites)},
  };
  if (face_places)
    attributes.push_back({"face_coordinates", face_name + "_lon " + face_name + "_lat"});
  file.ints(mesh_name, {}, attributes, constant(0));
}

/// Longitudes and latitudes of nodes or faces. \param of in words.
void add_lonlats(GridFile& file, const std::string& prefix, int dimension, const std::string& of,
                 const Points3& points) {
  file.doubles(prefix + "_lon", {dimension},
               {{"units", std::string("degrees_east")},
                {"standard_name", std::string("longitude")},
                long_name("longitude of " + of)},
               longitudes_of(points));
  file.doubles(prefix + "_lat", {dimension},
               {{"units", std::string("degrees_north")},
                {"standard_name", std::string("latitude")},
                long_name("latitude of " + of)},
               latitudes_of(points));
}

void add_places(GridFile& file, const std::string& prefix, int dimension, const Points3& points) {
  for (int row = 0; row < 3; ++row) {
    const std::string axis(1, "xyz"[row]);
    std::string name = prefix + "_";
    name += axis;
    file.doubles(name, {dimension},
                 {{"units", std::string("m")}, long_name("Cartesian " + axis + " of the site")},
                 row_of(points, row));
  }
}

/// \param node of face and corner; -1 past the last.
template <class Node>
void add_face_nodes(GridFile& file, int faces, std::int64_t most, const Node& node) {
  const int corners = file.netcdf().dimension("mesh_max_face_nodes", most);
  file.ints(face_nodes_name, {faces, corners},
            {{"cf_role", std::string("face_node_connectivity")},
             long_name("nodes of the face, counter-clockwise seen from outside"),
             {"units", std::string("1")},
             {"start_index", std::int32_t{0}},
             {"_FillValue", std::int32_t{-1}}},
            table<std::int32_t>(most, node));
}

constexpr const char* conventions = "CF-1.8 UGRID-1.0";

// ---- Reading

/// The names that the mesh variable lists.
struct Topology {
  std::string face_nodes, face_dimension;
  std::vector<std::string> nodes; ///< longitude and latitude
  std::vector<std::string> sites; ///< x, y, z; none in files of others
};

/// The first variable that describes a mesh of faces, or nothing.
std::string mesh_variable(const NetcdfReader& file) {
  for (const std::string& name : file.variables())
    if (file.text(name, "cf_role") == "mesh_topology" &&
        file.number(name, "topology_dimension", 2) == 2)
      return name;
  return "";
}

std::vector<std::string> names_in(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> names;
  for (std::string name; words >> name;)
    names.push_back(name);
  return names;
}

bool is_latitude(const NetcdfReader& file, const std::string& name) {
  return file.text(name, "standard_name") == "latitude" ||
         file.text(name, "units").find("north") != std::string::npos;
}

Topology topology_of(const NetcdfReader& file) {
  const std::string mesh = mesh_variable(file);
  Topology topology{file.text(mesh, "face_node_connectivity"), file.text(mesh, "face_dimension"),
                    names_in(file.text(mesh, "node_coordinates")),
                    names_in(file.text(mesh, site_coordinates))};
  if (topology.face_nodes.empty())
    file.fail("the mesh variable " + mesh + " names no face_node_connectivity; add the attribute");
  if (topology.nodes.size() != 2)
    file.fail("the node_coordinates of the mesh variable " + mesh +
              " are not the names of two variables, longitude and latitude; mend the attribute");
  if (is_latitude(file, topology.nodes[0]))
    std::swap(topology.nodes[0], topology.nodes[1]);
  if (!topology.sites.empty() && topology.sites.size() != 3)
    file.fail("the " + site_coordinates + " of the mesh variable " + mesh +
              " are not the names of three variables; mend the attribute or remove it");
  return topology;
}

/// Node ids, 0-based, a face a column; -1 past its last corner.
using FaceNodes = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Turns what a file holds into such ids.
struct FaceNodesReader {
  const NetcdfReader& file;
  const std::string& name;
  std::int64_t nodes;
  double start = file.number(name, "start_index", 0);
  double fill = file.number(name, "_FillValue", std::numeric_limits<double>::quiet_NaN());

  std::int32_t id(double value, std::int64_t face) const {
    if (value == fill || std::isnan(value))
      return -1;
    const double node = value - start;
    if (!(node >= 0 && node < static_cast<double>(nodes)) || node != std::floor(node)) {
      std::ostringstream text;
      text << name << " of face " << face << " (0-based) has " << value
           << ", which is not one of the " << nodes << " nodes from " << start
           << " on; make the file again";
      file.fail(text.str());
    }
    return static_cast<std::int32_t>(node);
  }

  void require_polygon(const FaceNodes& faces, std::int64_t face) const {
    const auto corners = faces.col(face).array() >= 0;
    const std::int64_t count = corners.count();
    if (count < 3 || !corners.head(count).all())
      file.fail(name + " of face " + std::to_string(face) +
                " (0-based) does not start with three or more nodes, then padding; make the file "
                "again");
  }
};

FaceNodes face_nodes_of(const NetcdfReader& file, const Topology& topology, std::int64_t nodes) {
  const std::string& name = topology.face_nodes;
  // Doubles hold every padding that others use, whatever its type.
  const std::vector<double> values = file.doubles(name, {-1, -1});
  const std::vector<std::int64_t> shape = file.shape_of(name);
  const std::vector<std::string> dimensions = file.dimensions_of(name);
  const bool faces_last =
      dimensions[1] == topology.face_dimension && dimensions[0] != topology.face_dimension;
  const std::int64_t faces = shape[faces_last ? 1 : 0], most = shape[faces_last ? 0 : 1];

  const FaceNodesReader reader{file, name, nodes};
  FaceNodes result(most, faces);
  for (std::int64_t face = 0; face < faces; ++face) {
    for (std::int64_t k = 0; k < most; ++k)
      result(k, face) = reader.id(
          values[static_cast<std::size_t>(faces_last ? k * faces + face : face * most + k)], face);
    reader.require_polygon(result, face);
  }
  return result;
}

/// The faces' places as given. \param count -1 for any number.
Points3 read_places(const NetcdfReader& file, const std::vector<std::string>& names,
                    std::int64_t count) {
  Points3 places;
  for (int row = 0; row < 3; ++row) {
    const std::vector<double> values = file.doubles(names[static_cast<std::size_t>(row)], {count});
    places.resize(3, std::ssize(values));
    places.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), places.cols());
    count = places.cols();
  }
  return places;
}

/// A face at a node, and the nodes before and after it along the face.
struct FaceAtNode {
  std::int32_t face, before, after;
};

/// The triangle of the faces around a node, counter-clockwise from the lowest: the next face is
/// across the edge to the node before.
bool turn_around(std::array<FaceAtNode, 3>& faces) {
  std::sort(faces.begin(), faces.end(),
            [](const FaceAtNode& a, const FaceAtNode& b) { return a.face < b.face; });
  if (faces[1].after != faces[0].before)
    std::swap(faces[1], faces[2]);
  for (std::size_t k = 0; k < 3; ++k)
    if (faces[(k + 1) % 3].after != faces[k].before)
      return false;
  return true;
}

/// One triangle of faces a node.
Triangles dual(const NetcdfReader& file, const FaceNodes& faces, std::int64_t nodes) {
  std::vector<std::array<FaceAtNode, 3>> at(static_cast<std::size_t>(nodes));
  std::vector<std::uint8_t> count(at.size());
  const auto fail = [&file](std::int64_t node) {
    file.fail("the faces around node " + std::to_string(node) +
              " (0-based) are not three that share edges; make the file again");
  };
  for (std::int32_t face = 0; face < faces.cols(); ++face) {
    const auto corners = static_cast<Eigen::Index>((faces.col(face).array() >= 0).count());
    for (Eigen::Index k = 0; k < corners; ++k) {
      const auto node = static_cast<std::size_t>(faces(k, face));
      if (count[node] == 3)
        fail(faces(k, face));
      at[node][count[node]++] = {face, faces((k + corners - 1) % corners, face),
                                 faces((k + 1) % corners, face)};
    }
  }
  Triangles triangles(3, nodes);
  for (std::int64_t node = 0; node < nodes; ++node) {
    std::array<FaceAtNode, 3>& around = at[static_cast<std::size_t>(node)];
    if (count[static_cast<std::size_t>(node)] != 3 || !turn_around(around))
      fail(node);
    triangles.col(node) << around[0].face, around[1].face, around[2].face;
  }
  return triangles;
}

bool all_triangles(const FaceNodes& faces) {
  return faces.cols() > 0 && (faces.bottomRows(faces.rows() - 3).array() < 0).all();
}

} // namespace

void write_ugrid(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  const Voronoi cells = voronoi(mesh);
  const Points3 sites = on_sphere(mesh.points, options.sphere_radius);
  GridFile file(path, options, conventions);
  const int nodes = file.netcdf().dimension(node_name, cells.vertices.cols());
  const int faces = file.netcdf().dimension(face_name, sites.cols());
  add_topology(file, "Voronoi cells of the sites", face_name, true);
  add_lonlats(file, node_name, nodes, "the node, a corner of cells", cells.vertices);
  add_lonlats(file, face_name, faces, "the face's site", cells.cells);
  add_face_nodes(file, faces, most_corners(cells),
                 [&cells](std::int64_t cell, std::int64_t k) { return corner(cells, cell, k); });
  add_places(file, face_name, faces, sites);
  file.commit();
}

void write_ugrid_triangles(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  const Points3 sites = on_sphere(mesh.points, options.sphere_radius);
  const Points3 directions = on_sphere(mesh.points, 1);
  const Points3 centres = mesh.closed() ? voronoi(mesh).vertices : Points3();
  GridFile file(path, options, conventions);
  const int nodes = file.netcdf().dimension(node_name, sites.cols());
  const int faces = file.netcdf().dimension(face_name, mesh.triangles.cols());
  add_topology(file, "Delaunay triangles of the sites", node_name, mesh.closed());
  add_lonlats(file, node_name, nodes, "the node, a site", directions);
  if (mesh.closed())
    add_lonlats(file, face_name, faces, "the face's circumcentre", centres);
  add_face_nodes(file, faces, 3, [&mesh](std::int64_t triangle, std::int64_t k) {
    return mesh.triangles(k, triangle);
  });
  add_places(file, node_name, nodes, sites);
  file.commit();
}

bool is_ugrid(const NetcdfReader& file) { return !mesh_variable(file).empty(); }

Soup read_ugrid(const NetcdfReader& file) {
  const Topology topology = topology_of(file);
  const std::vector<std::int64_t> nodes = file.shape_of(topology.nodes[0]);
  if (nodes.size() != 1)
    file.fail(topology.nodes[0] + " is not a list of nodes; make the file again");
  const FaceNodes faces = face_nodes_of(file, topology, nodes[0]);

  const std::vector<std::string>& sites = topology.sites;
  if (!sites.empty() && file.dimensions_of(sites[0]) != file.dimensions_of(topology.nodes[0]))
    return {read_places(file, sites, faces.cols()), dual(file, faces, nodes[0])};
  Points3 points = sites.empty() ? read_lonlats(file, topology.nodes[0], topology.nodes[1])
                                 : read_places(file, sites, nodes[0]);
  return {std::move(points), all_triangles(faces) ? Triangles(faces.topRows(3)) : Triangles()};
}

} // namespace calotte::io_detail
