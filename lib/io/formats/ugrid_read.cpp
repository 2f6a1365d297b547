// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/dual.h"
#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/formats/formats.h"
#include "io/formats/ugrid.h"
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace calotte::io_detail {
namespace {

/// Finds the first variable that describes a mesh of faces; "" without one.
std::string mesh_variable(const NetcdfReader& file) {
  for (const std::string& name : file.variable_names())
    if (file.text(name, "cf_role") == "mesh_topology" &&
        file.number(name, "topology_dimension", 2) == 2)
      return name;
  return "";
}

/// Whether a variable is the second coordinate: latitude, or y.
bool is_second(const NetcdfReader& file, const std::string& name) {
  const std::string standard_name = file.text(name, "standard_name");
  return standard_name == "latitude" || standard_name == "projection_y_coordinate" ||
         file.text(name, "units").find("north") != std::string::npos;
}

} // namespace

std::vector<std::string> names_in(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> names;
  for (std::string name; words >> name;)
    names.push_back(name);
  return names;
}

Topology read_topology(const NetcdfReader& file) {
  const std::string mesh = mesh_variable(file);
  Topology topology{
      file.text(mesh, "face_node_connectivity"),     file.text(mesh, "face_dimension"),
      names_in(file.text(mesh, "node_coordinates")), names_in(file.text(mesh, site_coordinates)),
      names_in(file.text(mesh, "face_coordinates")), mesh};
  if (topology.face_nodes.empty())
    file.fail("the mesh variable {} names no face_node_connectivity; add the attribute", mesh);
  if (topology.nodes.size() != 2)
    file.fail("the node_coordinates of the mesh variable {} are not the names of two variables, "
              "longitude and latitude; correct the attribute",
              mesh);
  topology.planar = file.text(topology.nodes[0], "standard_name").starts_with("projection_");
  if (is_second(file, topology.nodes[0]))
    std::swap(topology.nodes[0], topology.nodes[1]);
  if (topology.faces.size() != 2)
    topology.faces.clear();
  else if (is_second(file, topology.faces[0]))
    std::swap(topology.faces[0], topology.faces[1]);
  if (!topology.sites.empty() && topology.sites.size() != 3)
    file.fail("the {} of the mesh variable {} are not the names of three variables; correct the "
              "attribute or remove it",
              site_coordinates, mesh);
  return topology;
}

namespace {

/// The 0-based ids of nodes, with a column for each face; -1 after its last corner.
using FaceNodes = Eigen::Matrix<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

/// Converts ids of a file to such ids.
struct FaceNodesReader {
  const NetcdfReader& file;
  const std::string& name;
  std::int64_t nodes;
  double start;
  double fill = file.number(name, "_FillValue", std::numeric_limits<double>::quiet_NaN());

  std::int32_t id(double value, std::int64_t face) const {
    if (value == fill || std::isnan(value))
      return -1;
    const double node = value - start;
    if (!(node >= 0 && node < static_cast<double>(nodes)) || node != std::floor(node))
      file.fail("{} of face {} (0-based) has {}, which is not one of the {} nodes from {} on; make "
                "the file again",
                name, face, value, nodes, start);
    return static_cast<std::int32_t>(node);
  }

  void require_polygon(const FaceNodes& faces, std::int64_t face) const {
    const auto corners = faces.col(face).array() >= 0;
    const std::int64_t count = corners.count();
    if (count < 3 || !corners.head(count).all())
      file.fail(
          "{} of face {} (0-based) does not start with three or more nodes, then padding; make "
          "the file again",
          name, face);
  }
};

/// The first id. Without the attribute ids count from 0, but in files of FESOM from 1: one id is
/// the number of nodes, and no id is 0.
double find_start_index(const NetcdfReader& file, const std::string& name, std::int64_t nodes,
                        const std::vector<double>& ids) {
  const auto has = [&](std::int64_t id) {
    return std::find(ids.begin(), ids.end(), static_cast<double>(id)) != ids.end();
  };
  const double start = file.number(name, "start_index", -1);
  return start != -1 ? start : has(nodes) && !has(0) ? 1 : 0;
}

FaceNodes read_face_nodes(const NetcdfReader& file, const Topology& topology, std::int64_t nodes) {
  const std::string& name = topology.face_nodes;
  // Doubles represent every padding value that other programs use, whatever its type.
  const std::vector<double> values = file.doubles(name, {-1, -1});
  const std::vector<std::int64_t> shape = file.shape_of(name);
  const std::vector<std::string> dimensions = file.dimensions_of(name);
  const bool faces_last =
      dimensions[1] == topology.face_dimension && dimensions[0] != topology.face_dimension;
  const std::int64_t faces = shape[faces_last ? 1 : 0], most = shape[faces_last ? 0 : 1];

  const FaceNodesReader reader{file, name, nodes, find_start_index(file, name, nodes, values)};
  FaceNodes result(most, faces);
  for (std::int64_t face = 0; face < faces; ++face) {
    for (std::int64_t k = 0; k < most; ++k)
      result(k, face) = reader.id(
          values[static_cast<std::size_t>(faces_last ? k * faces + face : face * most + k)], face);
    reader.require_polygon(result, face);
  }
  return result;
}

/// Reads unit vectors, or points with z = 0 in a plane.
/// \param names of longitude and latitude, or x and y.
Points3 read_pairs(const NetcdfReader& file, const Topology& topology,
                   const std::vector<std::string>& names, std::int64_t count = -1) {
  if (!topology.planar)
    return read_lonlats(file, names[0], names[1], {count});
  const std::vector<double> x = cf_values(file, names[0], {count}),
                            y = cf_values(file, names[1], {std::ssize(x)});
  Points3 points = Points3::Zero(3, std::ssize(x));
  points.row(0) = Eigen::Map<const Eigen::RowVectorXd>(x.data(), points.cols());
  points.row(1) = Eigen::Map<const Eigen::RowVectorXd>(y.data(), points.cols());
  if (!points.allFinite())
    file.fail("{} and {} hold a number that is no place (NaN or infinite); make the file again",
              names[0], names[1]);
  return points;
}

/// Reads Cartesian coordinates.
/// \param count -1 for any number.
Points3 read_cartesian(const NetcdfReader& file, const std::vector<std::string>& names,
                       std::int64_t count) {
  Points3 points;
  for (int row = 0; row < 3; ++row) {
    const std::vector<double> values = file.doubles(names[static_cast<std::size_t>(row)], {count});
    points.resize(3, std::ssize(values));
    points.row(row) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), points.cols());
    count = points.cols();
  }
  return points;
}

/// The faces as polygons.
Polygons make_polygons(const FaceNodes& faces, Points3 nodes, Points3 centres, bool planar) {
  Polygons polygons{std::move(nodes),
                    {Offsets(faces.cols() + 1), {}},
                    std::move(centres),
                    planar ? Surface::plane() : Surface::sphere()};
  auto& [begin, ids] = polygons.ids;
  begin[0] = 0;
  for (Eigen::Index face = 0; face < faces.cols(); ++face)
    begin[face + 1] = begin[face] + (faces.col(face).array() >= 0).count();
  ids.resize(begin[faces.cols()]);
  for (Eigen::Index face = 0; face < faces.cols(); ++face)
    std::copy_n(faces.col(face).data(), polygons.ids.count(face), ids.data() + begin[face]);
  return polygons;
}

/// Finds the first node that other than three faces surround.
std::int64_t find_incomplete_node(const Dual& dual) {
  if (dual.failed >= 0)
    return dual.failed;
  std::int64_t node = 0;
  while (node < dual.corner.size() && dual.corner[node] == node)
    ++node;
  return node;
}

/// Makes a triangle of faces at each node.
Triangles make_triangles(const NetcdfReader& file, const FaceNodes& faces, std::int64_t nodes) {
  Dual dual = make_dual(make_polygons(faces, {}, {}, false), nodes);
  if (dual.failed >= 0 || dual.triangles.cols() < nodes)
    file.fail("the faces around node {} (0-based) are not three that share edges; make the file "
              "again",
              find_incomplete_node(dual));
  return std::move(dual.triangles);
}

/// The names of the variables that the mesh variable refers to. They are not fields.
NetcdfMeshNames list_mesh_names(const NetcdfReader& file, const Topology& topology,
                                bool sites_are_nodes) {
  const std::vector<std::string> of_faces = file.dimensions_of(topology.face_nodes);
  const std::string nodes = file.dimensions_of(topology.nodes[0]).front();
  const std::string faces =
      !topology.face_dimension.empty() ? topology.face_dimension : of_faces[0];
  NetcdfMeshNames names{sites_are_nodes ? nodes : faces,
                        sites_are_nodes ? faces : nodes,
                        {topology.mesh, topology.face_nodes}};
  if (!topology.sites.empty())
    names.variables.insert("cell_area"); // Calotte writes it
  for (const auto* list : {&topology.nodes, &topology.sites, &topology.faces})
    names.variables.insert(list->begin(), list->end());
  for (const char* attribute :
       {"edge_node_connectivity", "face_edge_connectivity", "face_face_connectivity",
        "edge_face_connectivity", "boundary_node_connectivity"})
    names.variables.insert(file.text(topology.mesh, attribute));
  for (const std::string& face : topology.faces)
    names.variables.insert(file.text(face, "bounds"));
  return names;
}

bool all_triangles(const FaceNodes& faces) {
  return faces.cols() > 0 && (faces.bottomRows(faces.rows() - 3).array() < 0).all();
}

} // namespace

bool is_ugrid(const NetcdfReader& file) { return !mesh_variable(file).empty(); }

Polygons read_ugrid_faces(const NetcdfReader& file, const Topology& topology) {
  Points3 nodes = read_pairs(file, topology, topology.nodes);
  const FaceNodes faces = read_face_nodes(file, topology, nodes.cols());
  Points3 centres;
  if (!topology.faces.empty())
    centres = read_pairs(file, topology, topology.faces, faces.cols());
  return make_polygons(faces, std::move(nodes), std::move(centres), topology.planar);
}

RawMesh read_ugrid(const NetcdfReader& file, FieldChoice choice) {
  const Topology topology = read_topology(file);
  const std::vector<std::int64_t> nodes = file.shape_of(topology.nodes[0]);
  if (nodes.size() != 1)
    file.fail("{} is not a list of nodes; make the file again", topology.nodes[0]);
  const FaceNodes faces = read_face_nodes(file, topology, nodes[0]);

  RawMesh raw;
  const std::vector<std::string>& sites = topology.sites;
  const bool sites_are_faces =
      !sites.empty() && file.dimensions_of(sites[0]) != file.dimensions_of(topology.nodes[0]);
  const bool sites_are_nodes = !sites_are_faces && (!sites.empty() || all_triangles(faces));
  raw.has_cells = !sites_are_nodes;
  if (sites_are_faces) {
    raw.points = read_cartesian(file, sites, faces.cols());
    raw.triangles = make_triangles(file, faces, nodes[0]);
  } else if (sites_are_nodes) {
    raw.points = sites.empty() ? read_pairs(file, topology, topology.nodes)
                               : read_cartesian(file, sites, nodes[0]);
    raw.triangles = faces.topRows(3);
  } else {
    if (!topology.faces.empty())
      raw.points = read_pairs(file, topology, topology.faces);
    else if (topology.planar)
      file.fail("the mesh variable {} names no face_coordinates, which cells of a plane need; add "
                "the attribute",
                topology.mesh);
    raw.polygons = make_polygons(faces, read_pairs(file, topology, topology.nodes), raw.points,
                                 topology.planar);
    raw.corner_rounding = find_rounding(file, topology.nodes[0]);
  }
  read_fields(file, list_mesh_names(file, topology, sites_are_nodes), choice, raw);
  drop_derived_fields(raw);
  return raw;
}

} // namespace calotte::io_detail
