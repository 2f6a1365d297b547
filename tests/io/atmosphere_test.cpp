// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/netcdf_content.h"
#include "support/spoilt_files.h"
#include "support/text.h"

#include <calotte/cut.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/refine.h>
#include <calotte/write.h>
#include <calotte/write_grid.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <vector>

// Files for MPAS-Atmosphere, as the model uses them.

using namespace calotte;
using namespace calotte::test;

namespace {

using Vector = Eigen::Vector3d;
using Index = std::size_t;

constexpr double earth_radius_m = 6371229;
/// Of the solid rotation: 30 m/s at the equator of an axis that is no symmetry of a grid.
const Vector rotation = 30 * Vector(0.2, -0.4, 0.7).normalized();

/// A file on the unit sphere.
struct Grid {
  explicit Grid(const std::string& path) : file(contents_of(path)) {}

  Index count(const std::string& dimension) const { return file.dimensions.at(dimension); }
  Index degree(Index cell) const { return static_cast<Index>(file.at("nEdgesOnCell", cell)); }
  int id(const std::string& list, Index row, Index k) const { return file.id(list, row, k); }
  Index at(const std::string& list, Index row, Index k) const {
    REQUIRE(id(list, row, k) >= 0);
    return static_cast<Index>(id(list, row, k));
  }
  Vector point(const std::string& kind, Index i) const {
    return {file.at("x" + kind, i), file.at("y" + kind, i), file.at("z" + kind, i)};
  }
  bool is_whole(Index cell) const {
    for (Index k = 0; k < degree(cell); ++k)
      if (id("cellsOnCell", cell, k) < 0)
        return false;
    return true;
  }
  /// Between the vertices of an edge.
  Vector middle(Index edge) const {
    return (point("Vertex", at("verticesOnEdge", edge, 0)) +
            point("Vertex", at("verticesOnEdge", edge, 1)))
        .normalized();
  }
  /// Towards the second cell of an edge with two cells, in the middle.
  Vector normal(Index edge) const {
    const Vector x = middle(edge), way = point("Cell", at("cellsOnEdge", edge, 1)) -
                                         point("Cell", at("cellsOnEdge", edge, 0));
    return (way - way.dot(x) * x).normalized();
  }

  Contents file;
};

double arc(const Vector& a, const Vector& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The deformation of the solid rotation in a cell, 1/s: the mean over the cell of the two
/// components of the rate of strain, by Gauss' theorem in the plane that touches it. Edge k runs
/// from vertex k to vertex k + 1 of the lists of the file, as in
/// atm_initialize_deformation_weights() of MPAS v8.3.1. The wind is that in the middle between
/// them, the mean over the edge, so that only the weights count.
double deformation(const Grid& grid, Index cell) {
  const Vector centre = grid.point("Cell", cell);
  const Vector east = Vector(0, 0, 1).cross(centre).normalized(), north = centre.cross(east);
  const Index n = grid.degree(cell);
  std::vector<Eigen::Vector2d> corner;
  for (Index k = 0; k < n; ++k) {
    const Vector x = grid.point("Vertex", grid.at("verticesOnCell", cell, k));
    corner.push_back(arc(centre, x) * Eigen::Vector2d(x.dot(east), x.dot(north)).normalized());
  }
  double area = 0, stretching = 0, shearing = 0;
  for (Index k = 0; k < n; ++k) {
    const Eigen::Vector2d &a = corner[k], &b = corner[(k + 1) % n], way = b - a;
    area += (a.x() * b.y() - a.y() * b.x()) / 2;
    const Index edge = grid.at("edgesOnCell", cell, k);
    const Vector x = grid.middle(edge), wind = rotation.cross(x);
    const Vector normal = (grid.at("cellsOnEdge", edge, 0) == cell ? 1 : -1) * grid.normal(edge);
    const double u = wind.dot(normal), v = wind.dot(x.cross(normal)),
                 angle = std::atan2(way.y(), way.x()) - std::acos(0.0), length = way.norm();
    stretching += length * (std::cos(2 * angle) * u - std::sin(2 * angle) * v);
    shearing += length * (std::sin(2 * angle) * u + std::cos(2 * angle) * v);
  }
  return std::hypot(stretching, shearing) / area / earth_radius_m;
}

double rms_of_deformation(const Grid& grid) {
  double sum = 0;
  int cells = 0;
  for (Index i = 0; i < grid.count("nCells"); ++i)
    if (grid.is_whole(i)) {
      sum += std::pow(deformation(grid, i), 2);
      ++cells;
    }
  REQUIRE(cells > 0);
  return std::sqrt(sum / cells);
}

/// The lists agree with each other.
void check_slots(const Grid& grid) {
  int wrong = 0;
  for (Index i = 0; i < grid.count("nCells"); ++i)
    for (Index k = 0; k < grid.degree(i); ++k) {
      const Index edge = grid.at("edgesOnCell", i, k);
      const int other = grid.id("cellsOnCell", i, k), self = static_cast<int>(i);
      const int first = grid.id("cellsOnEdge", edge, 0), second = grid.id("cellsOnEdge", edge, 1);
      wrong += !((first == self && second == other) || (second == self && first == other));
      const std::set<Index> ends{grid.at("verticesOnEdge", edge, 0),
                                 grid.at("verticesOnEdge", edge, 1)};
      wrong += ends != std::set<Index>{grid.at("verticesOnCell", i, k),
                                       grid.at("verticesOnCell", i, (k + 1) % grid.degree(i))};
      if (other < 0)
        continue;
      int back = 0;
      const auto j = static_cast<Index>(other);
      for (Index l = 0; l < grid.degree(j); ++l)
        back += grid.id("cellsOnCell", j, l) == self && grid.at("edgesOnCell", j, l) == edge;
      wrong += back != 1;
    }
  CHECK(wrong == 0);
}

void check_measures(const Grid& grid) {
  double worst_arc = 0, worst_kite = 0, shortest = 1;
  for (Index e = 0; e < grid.count("nEdges"); ++e) {
    const double dv = arc(grid.point("Vertex", grid.at("verticesOnEdge", e, 0)),
                          grid.point("Vertex", grid.at("verticesOnEdge", e, 1))),
                 dc = grid.file.at("dcEdge", e);
    worst_arc = std::max(worst_arc, std::abs(dv - grid.file.at("dvEdge", e)));
    if (grid.id("cellsOnEdge", e, 0) >= 0 && grid.id("cellsOnEdge", e, 1) >= 0)
      worst_arc =
          std::max(worst_arc, std::abs(dc - arc(grid.point("Cell", grid.at("cellsOnEdge", e, 0)),
                                                grid.point("Cell", grid.at("cellsOnEdge", e, 1)))));
    shortest = std::min(shortest, dv / dc);
  }
  for (Index v = 0; v < grid.count("nVertices"); ++v) {
    double sum = 0;
    for (Index k = 0; k < 3; ++k)
      sum += grid.file.at("kiteAreasOnVertex", v, k);
    const double area = grid.file.at("areaTriangle", v);
    worst_kite = std::max(worst_kite, std::abs(sum - area) / area);
  }
  CHECK(worst_arc < 1e-14);
  CHECK(worst_kite < 1e-11);
  CHECK(shortest >= 0.02);
}

/// The sizes that the model's arrays have, and what its transport takes.
void check_sizes(const Grid& grid, int euler) {
  CHECK(static_cast<int>(grid.count("nVertices")) - static_cast<int>(grid.count("nEdges")) +
            static_cast<int>(grid.count("nCells")) ==
        euler);
  Index fewest = 99, most = 0;
  for (Index i = 0; i < grid.count("nCells"); ++i)
    fewest = std::min(fewest, grid.degree(i));
  for (Index e = 0; e < grid.count("nEdges"); ++e) {
    std::set<int> near;
    for (Index side = 0; side < 2; ++side)
      if (const int cell = grid.id("cellsOnEdge", e, side); cell >= 0)
        for (Index k = 0; k < grid.degree(static_cast<Index>(cell)); ++k)
          near.insert(grid.id("cellsOnCell", static_cast<Index>(cell), k));
    near.erase(-1);
    most = std::max(most, near.size());
  }
  CHECK(fewest >= 5);
  CHECK(most <= 15);
}

/// Each cell of ring k touches ring k - 1; edges and vertices have the least mask of their cells.
void check_rings(const Grid& grid) {
  int wrong = 0;
  const auto mask = [&](int cell) {
    return static_cast<int>(grid.file.at("bdyMaskCell", static_cast<Index>(cell)));
  };
  for (Index i = 0; i < grid.count("nCells"); ++i) {
    int least = 99;
    for (Index k = 0; k < grid.degree(i); ++k)
      if (const int other = grid.id("cellsOnCell", i, k); other >= 0)
        least = std::min(least, mask(other));
    const int own = mask(static_cast<int>(i));
    wrong += own > 0 && least != own - 1;
  }
  for (const auto& [name, rows, list, width] :
       {std::tuple("bdyMaskEdge", "nEdges", "cellsOnEdge", Index{2}),
        std::tuple("bdyMaskVertex", "nVertices", "cellsOnVertex", Index{3})})
    for (Index row = 0; row < grid.count(rows); ++row) {
      int least = 99;
      for (Index k = 0; k < width; ++k)
        if (const int cell = grid.id(list, row, k); cell >= 0)
          least = std::min(least, mask(cell));
      wrong += static_cast<int>(grid.file.at(name, row)) != least;
    }
  CHECK(wrong == 0);
}

/// \param euler vertices - edges + cells: 2 on the sphere, 1 of a disc.
void check_for_atmosphere(const std::string& path, int euler) {
  CAPTURE(path);
  CHECK(read_mesh_file(path).vertex_order == VertexOrder::before_edges);
  for (const Deviation& deviation : check_file(path, read_mesh_file(path)))
    CHECK(deviation.text == "");
  const Grid grid(path);
  CHECK(rms_of_deformation(grid) < 1e-7);
  check_slots(grid);
  check_measures(grid);
  check_sizes(grid, euler);
  if (grid.file.variables.contains("bdyMaskCell"))
    check_rings(grid);
}

WriteOptions for_model(const std::string& word) {
  const ModelNeeds* const model = find_model(word);
  REQUIRE(model != nullptr);
  return {.format = model->format,
          .sphere_radius = model->sphere_radius,
          .vertex_order = model->vertex_order,
          .dimensions = model->dimensions};
}

const Mesh& global_mesh() {
  static const Mesh mesh = make_grid({.cells = 10242}).mesh;
  return mesh;
}

Surface part_of_globe() { return circle({0.3, -0.5, 0.6}, 0.4); }

/// Whether two files have the same edges and vertices around cells, in the same order.
bool same_around_cells(const std::string& a, const std::string& b) {
  const Grid of_a(a), of_b(b);
  return of_a.file.numbers.at("edgesOnCell") == of_b.file.numbers.at("edgesOnCell") &&
         of_a.file.numbers.at("verticesOnCell") == of_b.file.numbers.at("verticesOnCell");
}

} // namespace

TEST_CASE("MPAS-Atmosphere's deformation of a solid rotation is 0 on a global grid for it") {
  const Scratch scratch;
  const std::string for_it = scratch / "atmosphere.nc", for_others = scratch / "others.nc";
  write(for_it, global_mesh(), for_model("mpas-atmosphere"));
  check_for_atmosphere(for_it, 2);
  write(for_others, global_mesh(), for_model("mpas-sw"));
  CHECK(read_mesh_file(for_others).vertex_order == VertexOrder::after_edges);
  CHECK(rms_of_deformation(Grid(for_others)) > 1e-6); // so the test sees the order
}

TEST_CASE("MPAS-Atmosphere's deformation of a solid rotation is 0 on a limited area") {
  const Scratch scratch;
  const std::string path = scratch / "limited.nc";
  const Recipe recipe{.resolution = Raster{Eigen::Vector2d(0, 180), Eigen::Vector2d(-90, 90),
                                           Eigen::MatrixXd::Constant(2, 2, 120)},
                      .surface = part_of_globe(),
                      .limited_area = true};
  const Schedule schedule = plan(recipe);
  write_grid(path, make_grid(schedule).mesh, recipe, schedule);
  check_for_atmosphere(path, 1);
}

TEST_CASE("cut() gives either order to a file of either order") {
  const Scratch scratch;
  for (const char* const word : {"mpas-atmosphere", "mpas-sw"}) {
    const std::string whole = scratch / "whole.nc", part = scratch / "part.nc",
                      same = scratch / "same.nc";
    write(whole, global_mesh(), for_model(word));
    cut(whole, part, part_of_globe());
    check_for_atmosphere(part, 1);
    CutOptions options;
    options.vertex_order.reset();
    CHECK(cut(whole, same, part_of_globe(), options).vertex_order ==
          find_model(word)->vertex_order);
    CHECK(read_mesh_file(same).vertex_order == find_model(word)->vertex_order);
    CHECK(in_lines(deviations_of(same)) == "");
    CHECK(same_around_cells(part, same) == (std::string(word) == "mpas-atmosphere"));
  }
}

TEST_CASE("cull() takes either order, and keeps it unless another is asked for") {
  const Scratch scratch;
  CullOptions options;
  options.field = {{}, "latCell", -10, 0.5};
  std::vector<std::string> culled;
  for (const char* const word : {"mpas-atmosphere", "mpas-sw"}) {
    const std::string whole = scratch / "whole.nc", sea = scratch / (std::string(word) + ".sea.nc");
    write(whole, global_mesh(), for_model(word));
    CHECK(cull(whole, sea, options).vertex_order == find_model(word)->vertex_order);
    CHECK(read_mesh_file(sea).vertex_order == find_model(word)->vertex_order);
    CHECK(in_lines(deviations_of(sea)) == "");
    options.vertex_order = VertexOrder::after_edges;
    culled.push_back(scratch / (std::string(word) + ".after.nc"));
    cull(whole, culled.back(), options);
    options.vertex_order.reset();
  }
  CHECK(same_around_cells(culled[0], culled[1]));
}

TEST_CASE("a refined mesh keeps the order of its file") {
  const Scratch scratch;
  const std::string path = scratch / "refined.nc";
  for (const VertexOrder order : {VertexOrder::before_edges, VertexOrder::after_edges}) {
    MeshFile file;
    file.mesh = global_mesh();
    file.has_cells = true;
    file.vertex_order = order;
    WidthDemand demand;
    demand.region = part_of_globe();
    demand.factor = 1.5;
    const MeshFile finer = changed_file(file, refine(*file.mesh, demand)).file;
    CHECK(finer.vertex_order == order);
    WriteOptions options = for_model("mpas-atmosphere");
    options.vertex_order = finer.vertex_order;
    write(path, finer, options);
    if (order == VertexOrder::before_edges)
      check_for_atmosphere(path, 2);
    else
      CHECK(in_lines(deviations_of(path)) == "");
  }
}

TEST_CASE("a check tells a cell whose vertices have another order than the others") {
  const Scratch scratch;
  const std::string path = scratch / "grid.nc";
  for (const char* const word : {"mpas-atmosphere", "mpas-sw"}) {
    write(path, make_grid({.cells = 642, .stop = {.iterations = 3}}).mesh, for_model(word));
    Mpas file(path);
    file.rotate_row("verticesOnCell", 17, 1, static_cast<Index>(file.at("nEdgesOnCell", 17)));
    file.write(path);
    CHECK(has(in_lines(deviations_of(path)), "verticesOnCell"));
  }
}
