// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "io/format_files.h"
#include "support/clouds.h"
#include "support/constants.h"
#include "support/densities.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/spoilt_files.h"

#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

// What a file stores against what its mesh says: files of this library agree; a file of which any
// variable is spoilt is found out.

using namespace calotte;
using namespace calotte::test;

namespace {

// ---- Files of this library

const std::vector<FormatFile> netcdf_files{
    {"mesh.nc", Format::mpas},         {"minimal.nc", Format::mpas_minimal},
    {"cells.ugrid.nc", Format::ugrid}, {"triangles.ugrid.nc", Format::ugrid_triangles},
    {"cells.scrip.nc", Format::scrip}, {"cells.esmf.nc", Format::esmf}};

/// A density that differs from cell to cell, and is that of the cells' areas, roughly.
WriteOptions options_with_density(const Mesh& mesh, double radius, Format format) {
  WriteOptions options{.format = format, .sphere_radius = radius};
  options.site_density = voronoi(mesh).cell_area.cwiseAbs().cwiseInverse().cwiseAbs2();
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    options.site_density[i] *= 2 + mesh.points.col(i).normalized().z();
  return options;
}

void check_corruptions(int sites, std::size_t picks) {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(sites, 7));
  for (const auto& [name, format] : netcdf_files) {
    if (format == Format::mpas_minimal)
      continue; // nothing else tells of the density there
    CAPTURE(name);
    const std::string path = scratch / name;
    write(path, mesh, options_with_density(mesh, 6371229, format));
    CHECK(check_each_variable(path, format, picks) > 30);
  }
}

// ---- The free choices of an MPAS file

/// Stores every second edge from its other cell.
void reverse_edges(Mpas& file) {
  const auto reversed = [](std::size_t e) { return e % 2 == 1; };
  for (std::size_t e = 0; e < file.rows("cellsOnEdge"); ++e) {
    const auto count = static_cast<std::size_t>(file.at("nEdgesOnEdge", e));
    for (std::size_t k = 0; k < count; ++k)
      if (reversed(e) != reversed(file.id("edgesOnEdge", e, k)))
        file.at("weightsOnEdge", e, k) *= -1;
    if (!reversed(e))
      continue;
    const auto first =
        static_cast<std::size_t>(file.at("nEdgesOnCell", file.id("cellsOnEdge", e, 0))) - 1;
    for (const char* name : {"edgesOnEdge", "weightsOnEdge"})
      file.rotate_row(name, e, first, count);
    for (const char* name : {"cellsOnEdge", "verticesOnEdge"})
      std::swap(file.at(name, e, 0), file.at(name, e, 1));
    file.at("angleEdge", e) += file.at("angleEdge", e) > 0 ? -pi : pi;
  }
}

/// Starts every list around a cell or vertex elsewhere.
void rotate_lists(Mpas& file) {
  for (std::size_t i = 0; i < file.rows("nEdgesOnCell"); ++i) {
    const auto count = static_cast<std::size_t>(file.at("nEdgesOnCell", i));
    for (const char* name : {"edgesOnCell", "verticesOnCell", "cellsOnCell"})
      file.rotate_row(name, i, i % count, count);
  }
  for (std::size_t v = 0; v < file.rows("cellsOnVertex"); ++v)
    for (const char* name : {"cellsOnVertex", "edgesOnVertex", "kiteAreasOnVertex"})
      file.rotate_row(name, v, v % 3, 3);
}

/// Numbers edges or vertices from the last to the first.
void renumber(Mpas& file, std::size_t count, const std::set<std::string>& lists,
              const std::string& numbers) {
  for (auto& [name, variable] : file.variables) {
    if (lists.contains(name))
      for (double& id : variable.values)
        id = id > 0 ? static_cast<double>(count) + 1 - id : id;
    if (variable.shape.empty() || variable.shape[0] != count || name == numbers)
      continue;
    const std::vector<double> old = variable.values;
    const auto width = static_cast<std::ptrdiff_t>(variable.width());
    for (std::ptrdiff_t row = 0; row < static_cast<std::ptrdiff_t>(count); ++row)
      std::copy_n(old.end() - (row + 1) * width, width, variable.values.begin() + row * width);
  }
}

} // namespace

TEST_CASE("files of this library have no deviation") {
  const Scratch scratch;
  for (const auto& [name, mesh] : uneven_meshes())
    for (const double radius : {1.0, 6371229.0})
      for (const Numbering numbering : {Numbering::input, Numbering::curve})
        for (const auto& [file, format] : netcdf_files) {
          CAPTURE(name);
          CAPTURE(radius);
          CAPTURE(file);
          CAPTURE(int(numbering));
          WriteOptions options = options_with_density(mesh, radius, format);
          options.numbering = numbering;
          write(scratch / file, mesh, options);
          check_none(scratch / file);
        }
}

TEST_CASE("numbers of edges and vertices, starts of lists and ways of edges are free") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  for (const auto& [name, mesh] : test::closed_meshes()) {
    CAPTURE(name);
    write(path, mesh, options_with_density(mesh, 6371229, Format::mpas));
    Mpas file(path);
    reverse_edges(file);
    rotate_lists(file);
    const std::size_t edges = file.rows("cellsOnEdge"), vertices = file.rows("cellsOnVertex");
    renumber(file, edges, {"edgesOnCell", "edgesOnVertex", "edgesOnEdge"}, "indexToEdgeID");
    if (vertices != file.rows("nEdgesOnCell")) // of the tetrahedron: shapes do not tell them apart
      renumber(file, vertices, {"verticesOnCell", "verticesOnEdge"}, "indexToVertexID");
    file.write(path);
    check_none(path);
    const auto& latitudes = file["latEdge"].values; // at a pole there is no east
    const auto far = std::min_element(latitudes.begin(), latitudes.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
    file.at("angleEdge", static_cast<std::size_t>(far - latitudes.begin())) += pi;
    file.write(path);
    CHECK(deviations_of(path).at(0).variable == "angleEdge");
  }
}

TEST_CASE("a periodic plane has no deviation, and one that is spoilt is found") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  Points2 points = 5 * Points2::Random(2, 150).array().abs();
  points.row(0) *= 2;
  for (const double shift : {0.0, 7.5}) {
    const Mesh mesh = delaunay(points, Surface::periodic({10, 5}));
    WriteOptions options{.format = Format::mpas};
    options.site_density = Eigen::VectorXd::LinSpaced(150, 1, 2);
    write(path, mesh, options);
    Mpas file(path);
    for (double& x : file["xVertex"].values)
      x += shift; // another copy
    file.write(path);
    if (shift == 0)
      CHECK(check_each_variable(path, Format::mpas, 3) > 100);
    else
      CHECK(is_found(path));
    for (double& x : file["xVertex"].values)
      x += 10 - shift;
    file.write(path);
    check_none(path);
  }
}

TEST_CASE("faults of MpasMeshConverter are known, where all values follow them") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  const Mesh mesh = delaunay(random_sphere(100, 3));
  write(path, mesh, options_with_density(mesh, 6371229, Format::mpas));
  Mpas file(path);
  file["gridSpacing"].values = file["cellQuality"].values;
  for (std::size_t e = 0; e < file.rows("angleEdge"); ++e) {
    const double rise = file.at("latVertex", file.id("verticesOnEdge", e, 1)) -
                        file.at("latVertex", file.id("verticesOnEdge", e, 0));
    const double cosine = std::clamp(rise / file.at("dvEdge", e) * 6371229, -1.0, 1.0);
    file.at("angleEdge", e) = std::copysign(std::acos(cosine), file.at("angleEdge", e));
  }
  file.write(path);
  std::vector<Deviation> found = deviations_of(path);
  REQUIRE(found.size() == 2);
  CHECK(found[0].variable == "angleEdge");
  CHECK(found[1].variable == "gridSpacing");
  CHECK((found[0].known && found[1].known));
  CHECK(found[1].text.ends_with("(known: MpasMeshConverter wrote cellQuality here)"));
  file.at("gridSpacing", 7) *= 1.001;
  file.write(path);
  found = deviations_of(path);
  REQUIRE(found.size() == 2);
  CHECK((found[0].known && !found[1].known));
  const MeshFile kept = read_mesh_file(path);
  CHECK(in_lines(check_file(path, kept)) == in_lines(found));
  CHECK(kept.mesh->triangles.cols() == 2 * 100 - 4);
}

TEST_CASE("an edge that is none of the mesh is told alone") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  write(path, delaunay(random_sphere(60, 2)), {.format = Format::mpas});
  Mpas file(path);
  file.at("cellsOnEdge", 4, 1) = file.at("cellsOnEdge", 4, 0);
  file.write(path);
  const std::vector<Deviation> found = deviations_of(path);
  REQUIRE(found.size() == 1);
  CHECK(found[0].variable == "cellsOnEdge");
  CHECK(found[0].index == 8);
  file.at("dcEdge", 20) *= 2;
  file.at("edgesOnVertex", 7, 1) = 1;
  file.write(path);
  CHECK(deviations_of(path).size() == 3); // other rows are compared, too
}

TEST_CASE("a deviation names the variable, the place, both values and the rule") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  const Mesh mesh = delaunay(test::octahedron());
  write(path, mesh, {.format = Format::mpas});
  Mpas file(path);
  file.at("areaCell", 2) *= 1.5;
  file.write(path);
  const std::vector<Deviation> found = deviations_of(path);
  REQUIRE(found.size() == 1);
  CHECK(found[0].variable == "areaCell");
  CHECK(found[0].difference == doctest::Approx(0.5));
  CHECK(found[0].index == 2);
  CHECK(!found[0].known);
  CHECK(found[0].text ==
        "areaCell: 1 of 6 values are not the sum of the kites of each cell; at (2), 0-based, "
        "3.14159265359 is stored, 2.09439510239 is derived");
}

TEST_CASE("attributes of an MPAS file are checked") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  const auto first = [&](const std::function<void(const Patch&)>& spoil) {
    write(path, delaunay(octahedron()), {.format = Format::mpas});
    spoil(Patch(path));
    return deviations_of(path).at(0).variable;
  };
  CHECK(first([](const Patch& file) { file.attribute("", "on_a_sphere", "perhaps"); }) ==
        "on_a_sphere");
  CHECK(first([](const Patch& file) { file.remove_attribute("", "on_a_sphere"); }) ==
        "on_a_sphere");
  CHECK(first([](const Patch& file) { file.remove_attribute("", "sphere_radius"); }) ==
        "sphere_radius");
  CHECK(first([](const Patch& file) { file.attribute("", "sphere_radius", 2.0); }) == "xCell");
}

TEST_CASE("coordinates in single precision have no deviation") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc", rounded = scratch / "float.nc";
  const Density steep = tanh_bump({1, 0, 0}, pi / 9, 0.15, std::pow(50, -4));
  for (const Mesh& mesh : {delaunay(fibonacci_sphere(500)), // as models write their grids
                           make_grid({.cells = 9000, .resolution = steep}).mesh}) {
    write(path, mesh, options_with_density(mesh, 6371229, Format::mpas));
    Mpas(path).create(rounded, NC_FLOAT, [](int id) {
      const double radius = 6371229;
      require(nc_put_att_text(id, NC_GLOBAL, "on_a_sphere", 3, "YES"));
      require(nc_put_att_double(id, NC_GLOBAL, "sphere_radius", NC_DOUBLE, 1, &radius));
    });
    check_none(rounded);
    CHECK(read_mesh_file(rounded).not_voronoi.passed());
  }
}

// ---- Files of polygons

namespace {

/// The Voronoi cells of a mesh, all or some, with other centres.
MeshFile file_of_cells(const Mesh& mesh, int every) {
  const Voronoi cells = voronoi(mesh);
  std::vector<std::int64_t> begin{0};
  std::vector<std::int32_t> ids;
  std::vector<Eigen::Vector3d> centres;
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    if (every > 0 && i % every == 0)
      continue;
    Eigen::Vector3d sum(0, 0, 0);
    for (const std::int32_t vertex : cells.vertices_on_cell[i]) {
      ids.push_back(vertex);
      sum += cells.vertices.col(vertex);
    }
    begin.push_back(std::ssize(ids));
    centres.push_back(sum.normalized());
  }
  MeshFile file;
  file.not_voronoi.fault = CellFault::other_corner;
  file.polygons = Polygons{cells.vertices,
                           {Eigen::Map<const Offsets>(begin.data(), std::ssize(begin)),
                            Eigen::Map<const Ids>(ids.data(), std::ssize(ids))},
                           Points3(3, std::ssize(centres))};
  for (std::size_t i = 0; i < centres.size(); ++i)
    file.polygons->centres.col(static_cast<Eigen::Index>(i)) = centres[i];
  return file;
}

} // namespace

TEST_CASE("cells that are no Voronoi cells, and some of a mesh's cells, have no deviation") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(150, 4));
  for (const int every : {0, 3})
    for (const Format format : {Format::ugrid, Format::scrip, Format::esmf}) {
      CAPTURE(every);
      CAPTURE(int(format));
      const std::string path = scratch / "cells.nc";
      write(path, file_of_cells(mesh, every), {.format = format});
      check_none(path);
    }
}

TEST_CASE("a file whose cells are all clockwise deviates") {
  const Scratch scratch;
  const std::string path = scratch / "cells.nc";
  write(path, delaunay(cubed_sphere(3)), {.format = Format::scrip});
  for (const char* name : {"grid_corner_lon", "grid_corner_lat"}) {
    Variable corners = Patch(path).get(name);
    for (std::size_t i = 0; i < corners.shape[0]; ++i)
      std::reverse(corners.values.begin() + static_cast<std::ptrdiff_t>(i * corners.width()),
                   corners.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * corners.width()));
    Patch(path).put(corners);
  }
  const std::vector<Deviation> found = deviations_of(path);
  REQUIRE(found.size() == 1);
  CHECK(found[0].text == "grid_corner_lon, grid_corner_lat: 54 of 54 cells do not run "
                         "counter-clockwise seen from outside; the first is cell 0 (0-based)");
}

TEST_CASE("attributes of a UGRID file are checked") {
  const Scratch scratch;
  const std::string path = scratch / "cells.nc";
  const auto deviates = [&](const std::function<void(const Patch&)>& spoil) {
    write(path, delaunay(octahedron()), {.format = Format::ugrid});
    spoil(Patch(path));
    return is_found(path);
  };
  CHECK(!deviates([](const Patch& file) { file.attribute("mesh", "comment", "none"); }));
  CHECK(deviates([](const Patch& file) { file.remove_attribute("mesh", "topology_dimension"); }));
  CHECK(deviates([](const Patch& file) { file.attribute("mesh", "face_dimension", "faces"); }));
  CHECK(deviates([](const Patch& file) { file.attribute("mesh", "node_coordinates", "x y"); }));
  CHECK(deviates([](const Patch& file) { file.attribute("cell_area", "coordinates", "x y"); }));
  CHECK(deviates([](const Patch& file) { file.attribute("cell_area", "mesh", "grid"); }));
  CHECK(deviates([](const Patch& file) { file.remove_attribute("mesh_node_lon", "units"); }));
  CHECK(deviates([](const Patch& file) { file.attribute("mesh_node_lat", "units", "m"); }));
  CHECK(deviates([](const Patch& file) { file.attribute("mesh_face_nodes", "start_index", 1.0); }));
  CHECK(deviates([](const Patch& file) {
    file.attribute("mesh_face_nodes", "cf_role", "edge_node_connectivity");
  }));
}

TEST_CASE("optional lists of a UGRID file are checked") {
  const Scratch scratch;
  const std::string path = scratch / "cells.nc";
  const Mesh mesh = delaunay(random_sphere(40, 9));
  write(path, mesh, {.format = Format::ugrid, .numbering = Numbering::input});
  const Voronoi cells = voronoi(mesh);
  const auto edges = static_cast<std::size_t>(cells.cells_on_edge.cols());
  const auto of_edges = [&](const char* name, const Pairs& pairs) {
    return Variable{name,
                    {edges, 2},
                    {"edges", "two"},
                    true,
                    std::vector<double>(pairs.data(), pairs.data() + pairs.size())};
  };
  const std::size_t width = Patch(path).get("mesh_face_nodes").width();
  const auto of_faces = [&](const char* name, const IdLists& lists) {
    Variable table{name,
                   {40, width},
                   {"mesh_face", "mesh_max_face_nodes"},
                   true,
                   std::vector<double>(40 * width, -1)};
    for (std::size_t i = 0; i < 40; ++i)
      std::ranges::copy(lists[std::int64_t(i)], table.values.data() + i * width);
    return table;
  };
  const std::vector<std::pair<std::string, Variable>> tables{
      {"edge_node_connectivity", of_edges("edge_nodes", cells.vertices_on_edge)},
      {"edge_face_connectivity", of_edges("edge_faces", cells.cells_on_edge)},
      {"face_edge_connectivity", of_faces("face_edges", cells.edges_on_cell)},
      {"face_face_connectivity", of_faces("face_faces", cells.cells_on_cell)}};
  Patch(path).add(tables, "mesh");
  check_none(path);
  for (const auto& [attribute, table] : tables)
    for (std::size_t pick = 0; pick < table.values.size(); pick += 7) {
      CAPTURE(attribute);
      CAPTURE(pick);
      Variable spoilt = table;
      nudge(spoilt, pick);
      Patch(path).put(spoilt);
      CHECK(deviations_of(path).at(0).variable == table.name);
      Patch(path).put(table);
    }
}

TEST_CASE("files of other formats have no variables to check") {
  const Scratch scratch;
  write(scratch / "mesh.off", delaunay(test::octahedron()));
  check_none(scratch / "mesh.off");
}

TEST_CASE("a variable that is spoilt alone is found") { check_corruptions(40, 3); }

// Slow: the file is checked for up to 400 positions of each variable.
TEST_CASE("a variable that is spoilt alone anywhere is found [slow]") {
  check_corruptions(40, 400);
}
