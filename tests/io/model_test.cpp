// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/spoilt_files.h"

#include <calotte/cut.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

const ModelNeeds& model(const std::string& word) {
  const ModelNeeds* const found = find_model(word);
  REQUIRE(found != nullptr);
  return *found;
}

/// Sizes of dimensions as the C library finds them; 0 for one that is not there.
std::size_t dimension_of(const std::string& path, const std::string& name) {
  int id = -1, d = -1;
  std::size_t size = 0;
  require(nc_open(path.c_str(), NC_NOWRITE, &id));
  if (nc_inq_dimid(id, name.c_str(), &d) == NC_NOERR)
    require(nc_inq_dimlen(id, d, &size));
  require(nc_close(id));
  return size;
}

double first_value(const std::string& path, const std::string& variable) {
  Mpas file(path);
  return file.at(variable, 0);
}

/// Of the edges between two cells.
double median_of_dc(const std::string& path) {
  Mpas file(path);
  std::vector<double> lengths;
  for (std::size_t e = 0; e < file.rows("dcEdge"); ++e)
    if (file.at("cellsOnEdge", e, 0) > 0 && file.at("cellsOnEdge", e, 1) > 0)
      lengths.push_back(file.at("dcEdge", e));
  std::nth_element(lengths.begin(), lengths.begin() + std::ssize(lengths) / 2, lengths.end());
  return lengths[lengths.size() / 2];
}

/// Replaces a variable of one number by a multiple.
void multiply(const std::string& path, const std::string& variable, double factor) {
  int id = -1, v = -1;
  double value = 0;
  require(nc_open(path.c_str(), NC_WRITE, &id));
  require(nc_inq_varid(id, variable.c_str(), &v));
  require(nc_get_var_double(id, v, &value));
  value *= factor;
  require(nc_put_var_double(id, v, &value));
  require(nc_close(id));
}

std::vector<std::string> deviating(const std::string& path) {
  std::vector<std::string> names;
  for (const Deviation& deviation : check_file(path, read_mesh_file(path)))
    names.push_back(deviation.variable);
  return names;
}

} // namespace

TEST_CASE("the file that a model's options make suits it alone") {
  for (const ModelNeeds& of : models())
    for (const ModelNeeds& other : models()) {
      CAPTURE(of.word);
      CAPTURE(other.word);
      CHECK(suits(other, of.format, of.sphere_radius, of.vertex_order, of.dimensions) ==
            (of.word == other.word));
    }
  const ModelNeeds& ocean = model("mpas-ocean");
  const VertexOrder before = VertexOrder::before_edges, after = VertexOrder::after_edges;
  CHECK(suits(ocean, Format::mpas, 6371229, after));
  CHECK(suits(ocean, Format::mpas, 3390e3, after)); // Mars
  CHECK(!suits(ocean, Format::mpas, 6371, after));
  CHECK(!suits(ocean, Format::mpas, 6371229, before));
  CHECK(suits(model("mpas-atmosphere"), Format::mpas, 1, before));
  CHECK(!suits(model("mpas-atmosphere"), Format::mpas, 1, after));
  CHECK(!suits(model("mpas-atmosphere"), Format::mpas, 6371229, before));
  CHECK(!suits(model("mpas-atmosphere"), Format::scrip, 1, before));
  CHECK(!suits(model("mpas-sw"), Format::mpas, 1, after, {{"nVertLevels", 1}}));
}

TEST_CASE("files on the unit sphere name the planet that they are of") {
  const Scratch scratch;
  const Mesh mesh = delaunay(fibonacci_sphere(300));
  const auto planet = [&](const std::string& name, const WriteOptions& options) {
    write(scratch / name, mesh, options);
    return read_mesh_file(scratch / name).planet_radius;
  };
  using Radius = std::optional<double>;
  CHECK(planet("grid.nc", {}) == std::nullopt);
  CHECK(planet("grid.nc", {.planet_radius = 3390e3}) == Radius(3390e3));
  for (const Format format :
       {Format::mpas_minimal, Format::ugrid, Format::ugrid_triangles, Format::scrip, Format::esmf})
    CHECK(planet("grid.nc", {.format = format, .planet_radius = 3390e3}) == Radius(3390e3));
  CHECK(planet("grid.exo", {.planet_radius = 3390e3}) == Radius(3390e3));
  // Longitudes and latitudes have no radius.
  CHECK(planet("grid.nc", {.format = Format::scrip, .sphere_radius = 2e6}) == Radius(2e6));
  // A radius of the sphere counts more than the planet's.
  CHECK(planet("grid.nc", {.sphere_radius = 2e6, .planet_radius = 3390e3}) == Radius(2e6));
  CHECK(planet("grid.nc", {.sphere_radius = 6371}) == Radius(6371e3)); // an Earth in km
  CHECK(planet("grid.vtp", {.planet_radius = 3390e3}) == std::nullopt);
  // Without the attribute the order of vertices or the format tells the model.
  CHECK(planet("grid.nc", {.vertex_order = VertexOrder::before_edges}) ==
        Radius(model("mpas-atmosphere").planet_radius));
  CHECK(planet("nod2d.out", {}) == Radius(model("fesom").planet_radius));
  CHECK(code_of([&] { planet("grid.nc", {.planet_radius = 0}); }) == ErrorCode::invalid_argument);

  planet("grid.nc", {.planet_radius = 3390e3});
  const MeshFile file = read_mesh_file(scratch / "grid.nc");
  CHECK(file.radius_in_metres() == 1);
  write(scratch / "again.nc", file, {.format = Format::ugrid});
  CHECK(read_mesh_file(scratch / "again.nc").planet_radius == Radius(3390e3));
}

TEST_CASE("files hold the dimensions that a model looks for") {
  const Scratch scratch;
  const std::string whole = scratch / "whole.nc", part = scratch / "part.nc",
                    sea = scratch / "sea.nc";
  const std::vector<FieldDimension>& wanted = model("mpas-sw").dimensions;
  const Mesh mesh = delaunay(fibonacci_sphere(400));
  write(whole, mesh, {.format = Format::mpas, .dimensions = wanted});
  CHECK(dimension_of(whole, "nVertLevels") == 1);
  CHECK(dimension_of(whole, "nTracers") == 1);
  check_none(whole);
  write(whole, mesh, {.format = Format::mpas});
  CHECK(dimension_of(whole, "nTracers") == 0);
  CutOptions cutting;
  cutting.dimensions = wanted;
  const auto near = [](const Eigen::Vector3d& p) { return p.z() > 0.9; };
  cut(whole, part, near, cutting);
  CHECK(dimension_of(part, "nTracers") == 1);
  CullOptions culling;
  culling.field = {{}, "latCell", -10, 0};
  culling.dimensions = {{"nTracers", 4}, {"nCells", 7}}; // of which it has one
  cull(whole, sea, culling);
  CHECK(dimension_of(sea, "nTracers") == 4);
  CHECK(dimension_of(sea, "nCells") > 100);
}

TEST_CASE("cull converts lengths and areas to another radius") {
  const Scratch scratch;
  const std::string whole = scratch / "whole.nc", same = scratch / "same.nc",
                    sea = scratch / "sea.nc";
  write(whole, delaunay(fibonacci_sphere(400)), {.format = Format::mpas});
  CullOptions options;
  options.field = {{}, "latCell", -10, 0};
  const double radius = model("mpas-ocean").sphere_radius;
  CHECK(cull(whole, same, options).sphere_radius == 1);
  options.sphere_radius = radius;
  CHECK(cull(whole, sea, options).sphere_radius == radius);
  check_none(sea);
  CHECK(first_value(sea, "dcEdge") ==
        doctest::Approx(radius * first_value(same, "dcEdge")).epsilon(1e-14));
  CHECK(first_value(sea, "areaCell") ==
        doctest::Approx(radius * radius * first_value(same, "areaCell")).epsilon(1e-14));
  CHECK(read_mesh_file(sea).sphere_radius == radius);
  options.sphere_radius = -1;
  CHECK(code_of([&] { cull(whole, sea, options); }) == ErrorCode::invalid_argument);
}

TEST_CASE("the nominal spacing of a limited area is that of its cells, not of the closed mesh") {
  const Scratch scratch;
  const std::string path = scratch / "area.nc";
  // Random sites as a CVT in a disc of 0.5 radians; the grid's region is the inner one.
  const Surface meshed = circle({0, 0, 1}, 0.5), region = circle({0, 0, 1}, 0.3);
  const Points3 generators = random_sphere(100'000, 4);
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < generators.cols() && inside.size() < 3000; ++i)
    if (generators(2, i) > std::cos(0.5))
      inside.push_back(i);
  Cvt grid = make_grid({.surface = meshed,
                        .start = {.points = generators(Eigen::all, inside)},
                        .stop = {.tolerance = 1e-3}});
  grid.mesh.surface = meshed;
  for (const double radius : {1.0, 6371229.0}) {
    WriteOptions options;
    options.sphere_radius = radius;
    write_limited_area(path, grid.mesh, region, options);
    CHECK(first_value(path, "nominalMinDc") == doctest::Approx(median_of_dc(path)).epsilon(0.02));
    // Hexagons of the disc's area: what the run was asked for.
    const double area = 2 * std::numbers::pi * (1 - std::cos(0.5)) / 3000;
    CHECK(first_value(path, "nominalMinDc") ==
          doctest::Approx(radius * std::sqrt(2 * area / std::numbers::sqrt3)).epsilon(0.02));
    check_none(path);
  }
}

TEST_CASE("check finds a nominal spacing that is not that of an open mesh") {
  const Scratch scratch;
  const std::string whole = scratch / "whole.nc", part = scratch / "part.nc";
  write(whole, delaunay(bisected_icosahedron(4)), {.format = Format::mpas});
  const auto near = [](const Eigen::Vector3d& p) { return p.z() > 0.8; };
  for (const auto& [factor, found] : std::vector<std::pair<double, bool>>{{6, true},
                                                                          {1.3, true},
                                                                          {1.1, false},
                                                                          {0.9, false},
                                                                          {0.7, true},
                                                                          {1.0 / 6, true},
                                                                          {0, true},
                                                                          {-1, true}}) {
    CAPTURE(factor);
    cut(whole, part, near);
    check_none(part);
    multiply(part, "nominalMinDc", factor);
    CHECK(deviating(part) ==
          (found ? std::vector<std::string>{"nominalMinDc"} : std::vector<std::string>{}));
  }
}

TEST_CASE("check finds a density of 1 on a mesh that is not uniform, closed or open") {
  const Scratch scratch;
  const std::string whole = scratch / "whole.nc", part = scratch / "part.nc";
  const Density density = tanh_bump({0, 0, 1}, 0.6, 0.3, 1.0 / 4096);
  const Cvt grid = make_grid({.resolution = density,
                              .start = {.points = fibonacci_sphere(2500)},
                              .stop = {.tolerance = 1e-3}});
  const auto near = [](const Eigen::Vector3d& p) { return p.z() > 0.2; };
  CutOptions cutting;
  cutting.rings = 1;
  WriteOptions right{.format = Format::mpas, .density = density};
  write(whole, grid.mesh, right);
  cut(whole, part, near, cutting);
  check_none(whole);
  check_none(part);
  WriteOptions derived{.format = Format::mpas};
  derived.site_density = spacing_density(voronoi(grid.mesh));
  write(whole, grid.mesh, derived);
  cut(whole, part, near, cutting);
  check_none(whole);
  check_none(part);
  write(whole, grid.mesh, {.format = Format::mpas});
  cut(whole, part, near, cutting);
  for (const std::string& path : {whole, part}) {
    const std::vector<std::string> names = deviating(path);
    CHECK(std::find(names.begin(), names.end(), "meshDensity") != names.end());
  }
}
