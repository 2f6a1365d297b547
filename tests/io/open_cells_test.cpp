// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/open_mpas.h"
#include "support/spoilt_files.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Cells with a boundary in files: those of a bounded plane, and those of an open MPAS file, which
// go on as they are.

using namespace calotte;
using namespace calotte::test;
using open_mpas::Cut;
using open_mpas::open_file;
using open_mpas::put_attributes;
using open_mpas::radius;

namespace {

struct Plane {
  std::string name;
  Mesh mesh; ///< in its domain
};

Eigen::MatrixXd ring_matrix(const std::vector<Eigen::Vector2d>& corners) {
  Eigen::MatrixXd matrix(2, std::ssize(corners));
  for (std::size_t k = 0; k < corners.size(); ++k)
    matrix.col(static_cast<Eigen::Index>(k)) = corners[k];
  return matrix;
}

Mesh relaxed(std::int64_t n, const Surface& domain) {
  return make_grid({.surface = domain,
                    .start = {.points = random_points(n, domain, {}, 5)},
                    .stop = {.max_iterations = 30}})
      .mesh;
}

std::vector<Plane> planes() {
  const Surface box = rectangle({-3, 10}, {2, 12}),
                bent = Surface::plane().within(
                    {ring_matrix({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}),
                     ring_matrix({{0.3, 0.3}, {0.7, 0.3}, {0.7, 0.7}, {0.3, 0.7}})}),
                lake = read_domain(CALOTTE_FIXTURES "/../../tools/examples/lake.geojson");
  std::vector<Plane> planes{
      {"rectangle", relaxed(100, box)}, {"bent", relaxed(60, bent)}, {"lake", relaxed(300, lake)}};
  for (const std::int64_t n : {3, 4, 5})
    planes.push_back({"few", delaunay(random_points(n, box, {}, 1), box)});
  return planes;
}

/// Whether polygons have the same corners in the same order, from any on. \param rounding of units.
bool same_cells(const Polygons& a, const Polygons& b, double rounding = 0) {
  if (a.size() != b.size() || (a.ids.begin.array() != b.ids.begin.array()).any())
    return false;
  for (std::int64_t i = 0; i < a.size(); ++i) {
    const auto of_a = a.ids[i], of_b = b.ids[i];
    const auto fits = [&](std::size_t turn) {
      for (std::size_t k = 0; k < of_a.size(); ++k)
        if (!((a.corners.col(of_a[k]) - b.corners.col(of_b[(k + turn) % of_b.size()])).norm() <=
              rounding))
          return false;
      return true;
    };
    bool any = false;
    for (std::size_t turn = 0; turn < of_a.size() && !any; ++turn)
      any = fits(turn);
    if (!any)
      return false;
  }
  return true;
}

double edge_length(Mpas& file, std::size_t e, const std::string& kind, const std::string& ends) {
  const std::size_t a = file.id(ends, e, 0), b = file.id(ends, e, 1);
  return std::hypot(file.at("x" + kind, a) - file.at("x" + kind, b),
                    file.at("y" + kind, a) - file.at("y" + kind, b));
}

/// The laws of the format, by its definitions.
void check_mpas_laws(const std::string& path, const Surface& domain) {
  Mpas file(path);
  double area_of_cells = 0, area_of_triangles = 0, boundary = 0;
  for (const double a : file["areaCell"].values)
    area_of_cells += a;
  for (const double a : file["areaTriangle"].values)
    area_of_triangles += a;
  const double whole = domain.area();
  CHECK(std::abs(area_of_cells - whole) <= 1e-12 * whole);
  CHECK(std::abs(area_of_triangles - whole) <= 1e-12 * whole);
  std::set<std::size_t> on_boundary;
  for (std::size_t e = 0; e < file.rows("dcEdge"); ++e) {
    REQUIRE(file.at("cellsOnEdge", e, 0) > 0);
    const double length = edge_length(file, e, "Vertex", "verticesOnEdge");
    CHECK(file.at("dvEdge", e) == doctest::Approx(length).epsilon(1e-12));
    if (file.at("cellsOnEdge", e, 1) > 0) {
      CHECK(file.at("dcEdge", e) ==
            doctest::Approx(edge_length(file, e, "Cell", "cellsOnEdge")).epsilon(1e-12));
      continue;
    }
    CHECK(file.at("dcEdge", e) == doctest::Approx(std::sqrt(3) * length).epsilon(1e-12));
    boundary += length;
    for (const std::size_t k : {0, 1})
      on_boundary.insert(file.id("verticesOnEdge", e, k));
  }
  double perimeter = 0;
  for (const DoubleMatrix& line : domain.rings())
    for (Eigen::Index k = 0; k < line.cols(); ++k)
      perimeter += (line.col((k + 1) % line.cols()) - line.col(k)).norm();
  CHECK(boundary == doctest::Approx(perimeter).epsilon(1e-12));
  for (std::size_t v = 0; v < file.rows("boundaryVertex"); ++v)
    CHECK(file.at("boundaryVertex", v) == (on_boundary.contains(v) ? 1 : 0));
}

std::string text_attribute(const std::string& path, const std::string& name) {
  const Patch file(path);
  std::size_t length = 0;
  require(nc_inq_attlen(file.id(), NC_GLOBAL, name.c_str(), &length));
  std::string text(length, ' ');
  require(nc_get_att_text(file.id(), NC_GLOBAL, name.c_str(), text.data()));
  return text;
}

} // namespace

TEST_CASE("a bounded plane as MPAS: the file keeps all laws and gives the same cells") {
  const Scratch scratch;
  const std::string path = scratch / "plane.nc", again = scratch / "again.nc";
  for (const Plane& plane : planes()) {
    CAPTURE(plane.name);
    const MeshField depth{.name = "depth", .values = plane.mesh.points.row(0).transpose()};
    WriteOptions options;
    options.fields = {depth};
    write(path, plane.mesh, options);
    CHECK(text_attribute(path, "on_a_sphere") == "NO");
    CHECK(text_attribute(path, "is_periodic") == "NO");
    check_none(path);
    check_mpas_laws(path, plane.mesh.surface);
    const MeshFile file = read_mesh_file(path);
    REQUIRE(file.plane());
    CHECK(file.mesh->points == plane.mesh.points);
    CHECK(file.mesh->triangles == plane.mesh.triangles);
    REQUIRE(file.polygons.has_value());
    CHECK(same_cells(*file.polygons, polygons_of(voronoi(plane.mesh))));
    CHECK(std::abs(areas(*file.polygons).sum() / plane.mesh.surface.area() - 1) <= 1e-12);
    REQUIRE(file.fields.size() == 1);
    CHECK(file.fields[0].values == depth.values);

    CHECK(write(again, file).dropped.empty()); // the cells alone, without the domain
    check_none(again);
    const MeshFile copy = read_mesh_file(again);
    CHECK(same_cells(*copy.polygons, *file.polygons));
    CHECK(copy.fields[0].values == depth.values);
  }
}

TEST_CASE("graph.info lists the neighbours that are there") {
  const Scratch scratch;
  const Mesh mesh = relaxed(40, rectangle({0, 0}, {1, 1}));
  write(scratch / "plane.nc", mesh);
  std::ifstream graph(scratch / "plane.graph.info");
  const Voronoi cells = voronoi(mesh);
  std::int64_t n = 0, edges = 0, listed = 0;
  std::string line;
  graph >> n >> edges;
  std::getline(graph, line);
  CHECK(n == 40);
  for (std::int64_t i = 0; std::getline(graph, line); ++i) {
    std::istringstream words(line);
    std::multiset<std::int32_t> found, expected;
    for (std::int32_t id = 0; words >> id; ++listed)
      found.insert(id - 1);
    for (const std::int32_t other : cells.cells_on_cell[i])
      if (other >= 0)
        expected.insert(other);
    CHECK(found == expected);
  }
  CHECK(listed == 2 * edges);
}

TEST_CASE("a variable of a bounded plane's MPAS file that is spoilt alone is found") {
  const Scratch scratch;
  const std::string path = scratch / "plane.nc";
  const Surface domain = rectangle({0, 0}, {3, 2});
  write(path, relaxed(30, domain));
  check_none(path);
  for (const Variable& variable : Patch(path).all())
    for (const Corruption& corruption : corruptions()) {
      const bool free = corruption.of_one_value || variable.name == "meshDensity" ||
                        variable.name == "nominalMinDc";
      Variable spoilt = variable;
      corruption.spoil(spoilt, 0);
      if (free || std::equal(spoilt.values.begin(), spoilt.values.end(), variable.values.begin()))
        continue; // of an open mesh nothing tells of the density
      CAPTURE(variable.name);
      CAPTURE(corruption.name);
      Patch(path).put(spoilt);
      CHECK(is_found(path));
      Patch(path).put(variable);
    }
}

TEST_CASE("a bounded plane as UGRID: places in the plane, and areas that sum to the domain's") {
  const Scratch scratch;
  const std::string path = scratch / "plane.nc";
  for (const Plane& plane : planes()) {
    CAPTURE(plane.name);
    write(path, plane.mesh, {.format = Format::ugrid});
    const Patch file(path);
    const Variable x = file.get("mesh_node_x"), y = file.get("mesh_node_y"),
                   faces = file.get("mesh_face_nodes"), areas = file.get("cell_area");
    double total = 0;
    for (std::size_t i = 0; i < faces.shape[0]; ++i) {
      double twice = 0;
      std::vector<std::size_t> nodes;
      for (std::size_t k = 0; k < faces.width(); ++k)
        if (const double node = faces.values[i * faces.width() + k]; node >= 0)
          nodes.push_back(static_cast<std::size_t>(node));
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const std::size_t a = nodes[k], b = nodes[(k + 1) % nodes.size()];
        twice += (x.values[a] - x.values[nodes[0]]) * (y.values[b] - y.values[nodes[0]]) -
                 (x.values[b] - x.values[nodes[0]]) * (y.values[a] - y.values[nodes[0]]);
      }
      CHECK(twice / 2 == doctest::Approx(areas.values[i]).epsilon(1e-9));
      total += twice / 2;
    }
    CHECK(std::abs(total / plane.mesh.surface.area() - 1) <= 1e-12);
    CHECK(file.get("mesh_face_x").values.size() == faces.shape[0]);
    check_none(path);
    const MeshFile copy = read_mesh_file(path);
    CHECK(copy.mesh->points == plane.mesh.points);
    CHECK(same_cells(*copy.polygons, polygons_of(voronoi(plane.mesh))));
    CHECK(write(scratch / "back.nc", copy).dropped.empty());
    check_none(scratch / "back.nc");
  }
}

TEST_CASE("a variable of a bounded plane's UGRID file that is spoilt alone is found") {
  const Scratch scratch;
  const Surface domain = rectangle({0, 0}, {3, 2});
  write(scratch / "plane.nc", relaxed(30, domain), {.format = Format::ugrid});
  check_each_variable(scratch / "plane.nc", Format::ugrid, 3);
}

TEST_CASE("a bounded plane as cells of VTK and GeoJSON") {
  const Scratch scratch;
  for (const Plane& plane : planes()) {
    CAPTURE(plane.name);
    const Polygons cells = polygons_of(voronoi(plane.mesh));
    for (const auto& [name, format] :
         {std::pair("a.vtp", Format::vtp_cells), std::pair("a.vtu", Format::vtu_cells)}) {
      write(scratch / name, plane.mesh, {.format = format});
      const MeshFile file = read_mesh_file(scratch / name);
      REQUIRE(file.polygons.has_value());
      CHECK(same_cells(*file.polygons, cells));
      CHECK(file.mesh->points == plane.mesh.points);
      CHECK(write(scratch / "copy.nc", file).dropped.empty());
      check_none(scratch / "copy.nc");
    }
    write(scratch / "a.geojson", plane.mesh);
    const MeshFile file = read_mesh_file(scratch / "a.geojson");
    CHECK(file.mesh->points == plane.mesh.points);
    const std::string text = test::read_file(scratch / "a.geojson");
    for (const char* property : {"\"area\"", "\"spacing\"", "\"degree\""})
      CHECK(has(text, property));
  }
}

TEST_CASE("what a bounded plane cannot be written as is refused, naming the remedy") {
  const Scratch scratch;
  const Surface domain = rectangle({0, 0}, {1, 1});
  const Points3 points = random_points(20, domain, {}, 1);
  const auto problem = [&](const std::string& name, Format format, bool bounded) {
    const Mesh mesh = delaunay(points, bounded ? domain : Surface::plane());
    return message_of([&] { write(scratch / name, mesh, {.format = format}); });
  };
  CHECK(has(problem("a.nc", Format::by_name, false), "with its domain"));
  for (const Format format : {Format::scrip, Format::esmf, Format::mpas_minimal})
    CHECK(has(problem("a.nc", format, true), "written as mpas, ugrid, vtp-cells"));
  const Points3 far = random_points(20, rectangle({2, 2}, {3, 3}), {}, 1);
  CHECK(has(message_of([&] { write(scratch / "a.nc", delaunay(far, domain)); }),
            "is outside of the domain"));
  CHECK(scratch.files() == 0);
}

namespace {

/// By the two vertices, in the direction of the edge.
std::map<std::pair<double, double>, std::size_t> edges_of(Mpas& file) {
  std::map<std::pair<double, double>, std::size_t> edges;
  for (std::size_t e = 0; e < file.rows("dvEdge"); ++e)
    edges.emplace(std::minmax(file.at("verticesOnEdge", e, 0), file.at("verticesOnEdge", e, 1)), e);
  return edges;
}

/// Two files of the same cells and vertices, with edges of any numbers and directions.
void check_equivalent(Cut& a, Cut& b) {
  const auto edges = edges_of(b);
  REQUIRE(a.rows("dvEdge") == b.rows("dvEdge"));
  const auto close = [&](const std::string& name, double x, double y, double scale) {
    CAPTURE(name);
    CHECK(std::abs(x - y) <= 1e-9 * scale);
  };
  std::vector<std::size_t> edge(a.rows("dvEdge"));
  std::vector<double> sign(edge.size());
  for (std::size_t e = 0; e < edge.size(); ++e) {
    edge[e] = edges.at(std::minmax(a.at("verticesOnEdge", e, 0), a.at("verticesOnEdge", e, 1)));
    sign[e] = a.at("verticesOnEdge", e, 0) == b.at("verticesOnEdge", edge[e], 0) ? 1 : -1;
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(a.at("cellsOnEdge", e, k) == b.at("cellsOnEdge", edge[e], sign[e] > 0 ? k : 1 - k));
    for (const char* name : {"dvEdge", "dcEdge", "xEdge", "yEdge", "zEdge"})
      close(name, a.at(name, e), b.at(name, edge[e]), radius);
    const double turn = a.at("angleEdge", e) - b.at("angleEdge", edge[e]);
    close("angleEdge", std::cos(turn), sign[e], 10);
  }
  for (std::size_t e = 0; e < edge.size(); ++e) {
    std::map<std::size_t, double> weights, expected;
    for (std::size_t k = 0; k < a.at("nEdgesOnEdge", e); ++k)
      weights[edge[a.id("edgesOnEdge", e, k)]] =
          a.at("weightsOnEdge", e, k) * sign[e] * sign[a.id("edgesOnEdge", e, k)];
    for (std::size_t k = 0; k < b.at("nEdgesOnEdge", edge[e]); ++k)
      expected[b.id("edgesOnEdge", edge[e], k)] = b.at("weightsOnEdge", edge[e], k);
    REQUIRE(weights.size() == expected.size());
    for (const auto& [other, weight] : weights)
      close("weightsOnEdge", weight, expected.at(other), 10);
  }
  for (const char* name : {"areaCell", "gridSpacing", "cellQuality", "areaTriangle", "xCell",
                           "xVertex", "yVertex", "boundaryVertex", "nEdgesOnCell"})
    for (std::size_t i = 0; i < a.rows(name); ++i)
      close(name, a.at(name, i), b.at(name, i), std::max(1.0, std::abs(b.at(name, i))));
  for (std::size_t v = 0; v < a.rows("kiteAreasOnVertex"); ++v)
    for (std::size_t j = 0; j < 3; ++j)
      if (a.at("cellsOnVertex", v, j) > 0)
        close("kiteAreasOnVertex", a.at("kiteAreasOnVertex", v, j),
              open_mpas::kite_of(b, v, a.id("cellsOnVertex", v, j)), radius * radius);
}

} // namespace

TEST_CASE("an open MPAS file goes on as MPAS: cells, derived values and fields") {
  const Scratch scratch;
  const std::string path = scratch / "open.nc", out = scratch / "out.nc";
  for (const double lowest : {-0.9, -0.3, 0.4})
    for (const Points3& points : {fibonacci_sphere(300), bisected_icosahedron(2)}) {
      Cut source = open_file(scratch, points, lowest);
      Variable depth = source["areaCell"];
      depth.name = "depth";
      for (std::size_t i = 0; i < depth.values.size(); ++i)
        depth.values[i] = static_cast<double>(i);
      source.variables.emplace("depth", depth);
      source.create(path, NC_DOUBLE, put_attributes);
      const MeshFile file = read_mesh_file(path);
      REQUIRE(file.polygons.has_value());
      CHECK(write(out, file, {.sphere_radius = radius}).dropped.empty());
      check_none(out);
      Cut copy(out);
      check_equivalent(copy, source);
      CHECK(copy["depth"].values == depth.values);
      CHECK(same_cells(*read_mesh_file(out).polygons, *file.polygons, 1e-15));
    }
}

TEST_CASE("an open MPAS file goes to other formats of cells") {
  const Scratch scratch;
  const std::string path = scratch / "open.nc";
  Cut source = open_file(scratch, fibonacci_sphere(200), -0.4);
  source.create(path, NC_DOUBLE, put_attributes);
  const MeshFile file = read_mesh_file(path);
  for (const auto& [name, format] :
       {std::pair("a.nc", Format::ugrid), std::pair("b.nc", Format::scrip),
        std::pair("c.nc", Format::esmf), std::pair("d.vtp", Format::vtp_cells),
        std::pair("e.vtu", Format::vtu_cells)}) {
    CAPTURE(name);
    CHECK(write(scratch / name, file, {.format = format}).dropped.empty());
    check_none(scratch / name);
    const MeshFile copy = read_mesh_file(scratch / name);
    REQUIRE(copy.polygons.has_value());
    const Eigen::VectorXd area = areas(*copy.polygons);
    REQUIRE(area.size() == std::ssize(source["areaCell"].values));
    for (std::size_t i = 0; i < source.rows("areaCell"); ++i)
      CHECK(radius * radius * area[static_cast<Eigen::Index>(i)] ==
            doctest::Approx(source.at("areaCell", i)).epsilon(1e-9));
    CHECK(
        write(scratch / "back.nc", copy, {.sphere_radius = radius}).dropped.empty()); // and to MPAS
    check_none(scratch / "back.nc");
  }
}

TEST_CASE("cells that MPAS cannot hold are refused with the reason") {
  const Scratch scratch;
  Cut source = open_file(scratch, fibonacci_sphere(200), -0.4);
  const auto problem = [&] {
    source.create(scratch / "open.nc", NC_DOUBLE, put_attributes);
    const MeshFile file = read_mesh_file(scratch / "open.nc");
    return message_of([&] { write(scratch / "out.nc", file); });
  };
  std::size_t inner = 0;
  while (source.at("boundaryVertex", inner) == 1)
    ++inner;
  source.at("xVertex", inner) += 0.01 * radius;
  const std::string text = problem();
  CHECK(has(text, "MPAS needs Voronoi cells, but the common corner of cells"));
  CHECK(has(text, "write ugrid"));
}
