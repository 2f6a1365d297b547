// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/files.h"
#include "support/global_file.h"
#include "support/netcdf_content.h"

#include <calotte/cut.h>
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/rotate.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <Eigen/Geometry>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

// Files that are rotated, by the solid rotation of an atmosphere that they hold.

using namespace calotte;
using namespace calotte::test;

namespace {

using Vector = Eigen::Vector3d;
using Names = std::vector<std::string>;

constexpr double omega = 7.29212e-5, radius = 6371229;

const Rotation to_the_rockies({10, 20}, {-105, 40}, 30);
const Vector axis_of_wind(0.3, -0.5, 0.7);

const std::set<std::string> of_place{
    "latCell", "lonCell", "xCell",     "yCell",     "zCell",   "latEdge", "lonEdge", "xEdge",
    "yEdge",   "zEdge",   "latVertex", "lonVertex", "xVertex", "yVertex", "zVertex", "angleEdge"};

/// The same by rotations about axes.
Eigen::Matrix3d matrix() {
  using Eigen::AngleAxisd;
  constexpr double degree = std::numbers::pi / 180;
  return (AngleAxisd(-105 * degree, Vector::UnitZ()) * AngleAxisd(-40 * degree, Vector::UnitY()) *
          AngleAxisd(-30 * degree, Vector::UnitX()) * AngleAxisd(20 * degree, Vector::UnitY()) *
          AngleAxisd(-10 * degree, Vector::UnitZ()))
      .toRotationMatrix();
}

Vector east_at(const Vector& p) { return Vector(-p.y(), p.x(), 0).normalized(); }
Vector north_at(const Vector& p) { return p.normalized().cross(east_at(p)); }

/// The direction across an edge from one cell to the other.
Vector normal_of(const Vector& edge, const Vector& from, const Vector& to) {
  const Vector up = edge.normalized(), way = to - from;
  return (way - way.dot(up) * up).normalized();
}

DoubleVector by_point(const Points3& points, const std::function<double(const Vector&)>& of) {
  DoubleVector values(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    values[i] = of(points.col(i));
  return values;
}

/// Two levels, of which the second has three times the values, at one time.
MeshField with_levels(const std::string& name, FieldLocation location, const DoubleVector& values) {
  MeshField field{.name = name,
                  .location = location,
                  .values = DoubleVector(2 * values.size()),
                  .dimensions = {{"Time", 1, true}, {"nVertLevels", 2}},
                  .leading = 1};
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    field.values[2 * i] = values[i];
    field.values[2 * i + 1] = 3 * values[i];
  }
  return field;
}

MeshField vectors(const std::string& name, FieldLocation location, const Points3& values) {
  return {.name = name,
          .location = location,
          .values = Eigen::Map<const DoubleVector>(values.data(), values.size()),
          .dimensions = {{"R3", 3}}};
}

/// A solid rotation, by all that a model stores of it.
MeshFile atmosphere() {
  MeshFile file;
  file.mesh = delaunay(fibonacci_sphere(1500));
  const Voronoi dual = voronoi(*file.mesh);
  const auto wind = [](const Vector& p) { return Vector(axis_of_wind.cross(p)); };
  const auto zonal = [&](const Vector& p) { return wind(p).dot(east_at(p)); };
  const auto meridional = [&](const Vector& p) { return wind(p).dot(north_at(p)); };
  const FieldLocation cells = FieldLocation::cells, edges = FieldLocation::edges,
                      vertices = FieldLocation::vertices;
  DoubleVector normal(dual.edges.cols());
  Points3 normals(3, dual.edges.cols());
  for (Eigen::Index e = 0; e < normal.size(); ++e) {
    normals.col(e) = normal_of(dual.edges.col(e), dual.cells.col(dual.cells_on_edge(0, e)),
                               dual.cells.col(dual.cells_on_edge(1, e)));
    normal[e] = wind(dual.edges.col(e)).dot(normals.col(e));
  }
  std::vector<MeshField>& fields = file.fields;
  fields.push_back(with_levels("u", edges, normal));
  fields.back().directed = true;
  fields.push_back(with_levels("uReconstructMeridional", cells, by_point(dual.cells, meridional)));
  fields.push_back(with_levels("uReconstructZonal", cells, by_point(dual.cells, zonal)));
  for (int k = 0; k < 3; ++k)
    fields.push_back(
        with_levels(std::string("uReconstruct") + "XYZ"[k], cells,
                    by_point(dual.cells, [&](const Vector& p) { return wind(p)[k]; })));
  fields.push_back({.name = "u10",
                    .long_name = "10-meter zonal wind",
                    .values = by_point(dual.cells, zonal),
                    .single = true});
  fields.push_back({.name = "v10",
                    .long_name = "10-meter meridional wind",
                    .values = by_point(dual.cells, meridional),
                    .single = true});
  fields.push_back({.name = "east",
                    .location = vertices,
                    .values = by_point(dual.vertices, zonal),
                    .attributes = {{{"standard_name", "eastward_wind"}}}});
  fields.push_back({.name = "north",
                    .location = vertices,
                    .values = by_point(dual.vertices, meridional),
                    .attributes = {{{"standard_name", "northward_wind"}}}});
  fields[1].values[10] = std::numeric_limits<double>::quiet_NaN(); // a missing component
  fields.push_back(vectors("localVerticalUnitVectors", cells, dual.cells));
  const auto coriolis = [](const Vector& p) { return 2 * omega * p.z(); };
  fields.push_back({.name = "fCell", .values = by_point(dual.cells, coriolis)});
  fields.push_back({.name = "fEdge", .location = edges, .values = by_point(dual.edges, coriolis)});
  fields.push_back(
      {.name = "fVertex",
       .location = vertices,
       .values = by_point(dual.vertices, [](const Vector& p) { return omega * p.x(); })});
  fields.push_back({.name = "ter", .values = by_point(dual.cells, zonal)});
  fields.push_back({.name = "stressZonal", .values = by_point(dual.cells, zonal)});
  fields.push_back({.name = "horizonalMixing", .values = by_point(dual.cells, zonal)});
  return file;
}

void check_names(const TurnedFields& fields) {
  const auto sorted = [](Names names) {
    std::ranges::sort(names);
    return names;
  };
  CHECK(sorted(fields.turned) == Names{"east", "localVerticalUnitVectors", "north", "u", "u10",
                                       "uReconstructMeridional", "uReconstructX", "uReconstructY",
                                       "uReconstructZ", "uReconstructZonal", "v10"});
  CHECK(sorted(fields.coriolis) == Names{"fCell", "fEdge"});
  CHECK(sorted(fields.moved) == Names{"horizonalMixing", "ter"});
  CHECK(sorted(fields.unturned) == Names{"fVertex", "stressZonal"});
}

/// Names of variables whose bits differ.
std::set<std::string> changed(const Contents& before, const Contents& after) {
  CHECK(after.dimensions == before.dimensions);
  CHECK(after.unlimited == before.unlimited);
  std::set<std::string> names;
  CHECK(after.variables.size() == before.variables.size());
  for (const auto& [name, content] : before.variables) {
    const Content& now = after.variables.at(name);
    CHECK(now.type == content.type);
    CHECK(now.dimensions == content.dimensions);
    CHECK(now.attributes == content.attributes);
    if (now.bytes != content.bytes)
      names.insert(name);
  }
  return names;
}

Vector point(const Contents& file, const std::string& kind, std::size_t i) {
  return {file.at("x" + kind, i), file.at("y" + kind, i), file.at("z" + kind, i)};
}

/// Points are those of the source, rotated; longitudes and latitudes are theirs.
void check_points(const Contents& before, const Contents& after, double unit) {
  for (const auto& [kind, dimension] : std::vector<std::pair<std::string, std::string>>{
           {"Cell", "nCells"}, {"Edge", "nEdges"}, {"Vertex", "nVertices"}}) {
    double worst = 0, angles = 0;
    for (std::size_t i = 0; i < before.dimensions.at(dimension); ++i) {
      const Vector now = point(after, kind, i);
      worst = std::max(worst, (now - matrix() * point(before, kind, i)).norm() / unit);
      const double lon = after.at("lon" + kind, i), lat = after.at("lat" + kind, i);
      CHECK((lon >= 0 && lon < 2 * std::numbers::pi));
      angles = std::max(angles, (Vector(std::cos(lat) * std::cos(lon),
                                        std::cos(lat) * std::sin(lon), std::sin(lat)) -
                                 now / unit)
                                    .norm());
    }
    CAPTURE(kind);
    CHECK(worst <= 1e-15);
    CHECK(angles <= 2e-15);
  }
}

/// The values at edges are those of the rotated wind, across the edges and by their angles.
void check_wind(const Contents& file) {
  const Vector axis = matrix() * axis_of_wind;
  double normal = 0, angle = 0;
  for (std::size_t e = 0; e < file.dimensions.at("nEdges"); ++e) {
    const Vector at = point(file, "Edge", e).normalized(),
                 across = normal_of(
                     at,
                     point(file, "Cell", static_cast<std::size_t>(file.id("cellsOnEdge", e, 0))),
                     point(file, "Cell", static_cast<std::size_t>(file.id("cellsOnEdge", e, 1))));
    normal = std::max(normal, std::abs(file.numbers.at("u")[2 * e] - axis.cross(at).dot(across)));
    const double a = file.at("angleEdge", e);
    angle =
        std::max(angle, (std::cos(a) * east_at(at) + std::sin(a) * north_at(at) - across).norm());
  }
  CHECK(normal <= 1e-13);
  CHECK(angle <= 1e-13);
}

/// All other components are those of the rotated wind; `missing` of a pair stay.
void check_fields(const Contents& before, const Contents& file) {
  const Vector axis = matrix() * axis_of_wind;
  int missing = 0;
  double pairs = 0, single = 0, cartesian = 0, upward = 0, coriolis = 0;
  const auto raise = [](double& worst, double difference) {
    worst = std::max(worst, std::abs(difference));
  };
  for (std::size_t i = 0; i < file.dimensions.at("nCells"); ++i) {
    const Vector at = point(file, "Cell", i).normalized(), wind = axis.cross(at);
    for (std::size_t level = 0; level < 2; ++level) {
      const std::size_t k = 2 * i + level;
      const double times = level == 0 ? 1 : 3;
      const double zonal = file.numbers.at("uReconstructZonal")[k],
                   meridional = file.numbers.at("uReconstructMeridional")[k];
      if (std::abs(before.numbers.at("uReconstructMeridional")[k]) > 1e3) { // the fill value
        ++missing;
        CHECK(meridional == before.numbers.at("uReconstructMeridional")[k]);
        CHECK(zonal == before.numbers.at("uReconstructZonal")[k]);
      } else {
        raise(pairs, zonal - times * wind.dot(east_at(at)));
        raise(pairs, meridional - times * wind.dot(north_at(at)));
      }
      for (int x = 0; x < 3; ++x)
        raise(cartesian,
              file.numbers.at(std::string("uReconstruct") + "XYZ"[x])[k] - times * wind[x]);
    }
    raise(single, file.at("u10", i) - wind.dot(east_at(at)));
    raise(single, file.at("v10", i) - wind.dot(north_at(at)));
    for (std::size_t x = 0; x < 3; ++x)
      raise(upward, file.at("localVerticalUnitVectors", i, x) - at[static_cast<Eigen::Index>(x)]);
    raise(coriolis, (file.at("fCell", i) - 2 * omega * at.z()) / omega);
  }
  for (std::size_t v = 0; v < file.dimensions.at("nVertices"); ++v) {
    const Vector at = point(file, "Vertex", v).normalized(), wind = axis.cross(at);
    raise(pairs, file.at("east", v) - wind.dot(east_at(at)));
    raise(pairs, file.at("north", v) - wind.dot(north_at(at)));
  }
  for (std::size_t e = 0; e < file.dimensions.at("nEdges"); ++e)
    raise(coriolis,
          (file.at("fEdge", e) - 2 * omega * point(file, "Edge", e).normalized().z()) / omega);
  CHECK(missing == 1);
  CHECK(pairs <= 1e-13);
  CHECK(single <= 1e-7);
  CHECK(cartesian <= 1e-14);
  CHECK(upward <= 1e-15);
  CHECK(coriolis <= 1e-14);
}

/// A variable of doubles.
struct Doubles {
  std::string name;
  Names dimensions;
  std::vector<double> values;
};

/// Adds variables to a file, and the dimension R3.
void add_doubles(const std::string& path, const std::vector<Doubles>& variables) {
  const Patch patch(path);
  int d = -1;
  require(nc_redef(patch.id()));
  require(nc_def_dim(patch.id(), "R3", 3, &d));
  std::vector<int> ids;
  for (const Doubles& variable : variables) {
    std::vector<int> dimensions;
    for (const std::string& name : variable.dimensions) {
      require(nc_inq_dimid(patch.id(), name.c_str(), &d));
      dimensions.push_back(d);
    }
    ids.emplace_back();
    require(nc_def_var(patch.id(), variable.name.c_str(), NC_DOUBLE,
                       static_cast<int>(dimensions.size()), dimensions.data(), &ids.back()));
  }
  require(nc_enddef(patch.id()));
  for (std::size_t k = 0; k < ids.size(); ++k)
    require(nc_put_var_double(patch.id(), ids[k], variables[k].values.data()));
}

} // namespace

TEST_CASE("an MPAS file rotates with the directions that it holds, and the rest keeps its bits") {
  const Scratch scratch;
  for (const double unit : {1.0, radius}) {
    CAPTURE(unit);
    write(scratch / "old.nc", atmosphere(), {.sphere_radius = unit, .history = "made"});
    const RotateReport report = rotate(scratch / "old.nc", scratch / "new.nc", to_the_rockies,
                                       {.history = "rotated by a test"});
    check_names(report.fields);
    CHECK(report.left_out.empty());
    const Contents before = contents_of(scratch / "old.nc"),
                   after = contents_of(scratch / "new.nc");
    std::set<std::string> expected = of_place;
    expected.insert({"uReconstructZonal", "uReconstructMeridional", "uReconstructX",
                     "uReconstructY", "uReconstructZ", "u10", "v10", "east", "north",
                     "localVerticalUnitVectors", "fCell", "fEdge"});
    CHECK(changed(before, after) == expected);
    check_points(before, after, unit);
    check_wind(after);
    check_fields(before, after);
    CHECK(read_file(scratch / "new.graph.info") == read_file(scratch / "old.graph.info"));
    CHECK(check_file(scratch / "new.nc", read_mesh_file(scratch / "new.nc")).empty());
    CHECK(after.attributes.at("history").ends_with("rotated by a test\nmade"));
    CHECK(after.attributes.at("parent_id") == before.attributes.at("file_id"));
    CHECK(after.attributes.at("file_id") != before.attributes.at("file_id"));
    rotate(scratch / "new.nc", scratch / "back.nc", to_the_rockies.inverse());
    const Contents back = contents_of(scratch / "back.nc");
    for (const std::string name : {"xCell", "yCell", "zCell", "xVertex", "yEdge"})
      for (std::size_t i = 0; i < before.numbers.at(name).size(); ++i)
        CHECK(std::abs(back.numbers.at(name)[i] - before.numbers.at(name)[i]) <= 3e-16 * unit);
    CHECK(back.attributes.at("file_id") != after.attributes.at("file_id"));
  }
}

TEST_CASE("the contents of a file rotate as an MPAS file does") {
  const Scratch scratch;
  const RotatedFile rotated = calotte::rotated(atmosphere(), to_the_rockies);
  check_names(rotated.fields);
  write(scratch / "old.nc", atmosphere(), {.numbering = Numbering::input});
  write(scratch / "new.nc", rotated.file, {.numbering = Numbering::input});
  const Contents before = contents_of(scratch / "old.nc"), after = contents_of(scratch / "new.nc");
  check_points(before, after, 1);
  check_wind(after);
  check_fields(before, after);
  for (const std::string name : {"cellsOnCell", "edgesOnCell", "verticesOnCell", "cellsOnEdge",
                                 "edgesOnEdge", "ter", "u", "meshDensity"})
    CHECK(after.variables.at(name).bytes == before.variables.at(name).bytes);
  for (const std::string name : {"areaCell", "areaTriangle", "dcEdge", "dvEdge"})
    for (std::size_t i = 0; i < before.numbers.at(name).size(); ++i)
      CHECK(after.numbers.at(name)[i] / before.numbers.at(name)[i] ==
            doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("what MPAS-Atmosphere's initialisation stores of directions turns") {
  const Scratch scratch;
  write_global(scratch, scratch / "old.nc", {.cells = 300});
  const Contents file = contents_of(scratch / "old.nc");
  const std::size_t cells = file.dimensions.at("nCells"), width = file.dimensions.at("maxEdges");
  // Directions at each cell, by the weights of deformation (Skamarock et al. 2012) and gradients.
  std::vector<double> cosines, sines, twice_cosines, twice_sines, vectors, constant(cells, 1e-4);
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t k = 0; k < width; ++k) {
      const double angle = 0.7 * static_cast<double>(i) + static_cast<double>(k);
      cosines.push_back(3 * std::cos(angle));
      sines.push_back(3 * std::sin(angle));
      twice_cosines.push_back(2 * std::cos(2 * angle));
      twice_sines.push_back(2 * std::sin(2 * angle));
      const Vector at = point(file, "Cell", i),
                   way = std::cos(angle) * east_at(at) + std::sin(angle) * north_at(at);
      vectors.insert(vectors.end(), way.begin(), way.end());
    }
  const Names by_edge{"nCells", "maxEdges"};
  add_doubles(scratch / "old.nc", {{"cell_gradient_coef_x", by_edge, cosines},
                                   {"cell_gradient_coef_y", by_edge, sines},
                                   {"defc_a", by_edge, twice_cosines},
                                   {"defc_b", by_edge, twice_sines},
                                   {"deriv_two", by_edge, twice_sines},
                                   {"coeffs_reconstruct", {"nCells", "maxEdges", "R3"}, vectors},
                                   {"strainRateR3Cell", {"nCells", "maxEdges", "R3"}, vectors},
                                   {"fCell", {"nCells"}, constant}});
  const TurnedFields fields = rotate(scratch / "old.nc", scratch / "new.nc", to_the_rockies).fields;
  CHECK(fields.turned == Names{"u", "cell_gradient_coef_x", "cell_gradient_coef_y", "defc_a",
                               "defc_b", "coeffs_reconstruct"});
  CHECK(fields.unturned == Names{"strainRateR3Cell"});
  CHECK(fields.coriolis.empty());
  CHECK(std::ranges::count(fields.moved, "fCell") == 1);
  CHECK(std::ranges::count(fields.moved, "deriv_two") == 0);
  const Contents now = contents_of(scratch / "new.nc");
  std::set<std::string> expected = of_place;
  expected.insert(fields.turned.begin() + 1, fields.turned.end());
  CHECK(changed(contents_of(scratch / "old.nc"), now) == expected);
  double worst = 0;
  const auto raise = [&](double is, double should) {
    worst = std::max(worst, std::abs(is - should));
  };
  for (std::size_t i = 0; i < cells; ++i)
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t at = i * width + k;
      const Vector place = point(now, "Cell", i),
                   way =
                       matrix() * Vector(vectors[3 * at], vectors[3 * at + 1], vectors[3 * at + 2]);
      const double east = way.dot(east_at(place)), north = way.dot(north_at(place));
      raise(now.numbers.at("cell_gradient_coef_x")[at], 3 * east);
      raise(now.numbers.at("cell_gradient_coef_y")[at], 3 * north);
      raise(now.numbers.at("defc_a")[at], 2 * (east * east - north * north));
      raise(now.numbers.at("defc_b")[at], 4 * east * north);
      for (std::size_t x = 0; x < 3; ++x)
        raise(now.numbers.at("coeffs_reconstruct")[3 * at + x], way[static_cast<Eigen::Index>(x)]);
    }
  CHECK(worst <= 1e-13);
}

TEST_CASE("the identity keeps all bits of a file, of any format and radius") {
  const Scratch scratch;
  for (const int format : {NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
    write_global(scratch, scratch / "old.nc", {.cells = 500, .radius = radius, .format = format});
    const Rotation none({-105, 40}, {255, 40});
    CHECK(rotate(scratch / "old.nc", scratch / "new.nc", none).left_out.empty());
    const Contents before = contents_of(scratch / "old.nc");
    CHECK(changed(before, contents_of(scratch / "new.nc")).empty());
    rotate(scratch / "old.nc", scratch / "new.nc", to_the_rockies);
    CHECK(changed(before, contents_of(scratch / "new.nc")) == of_place);
  }
}

TEST_CASE("limited areas and oceans rotate, with their masks and maps") {
  const Scratch scratch;
  write_global(scratch, scratch / "global.nc", {.cells = 1500});
  cut(scratch / "global.nc", scratch / "area.nc", circle({1, 0.2, 0.3}, 0.4), {.rings = 2});
  Coast coast;
  const Surface land = circle({0, 1, 0.5}, 0.8);
  coast.rings.assign(land.rings().begin(), land.rings().end());
  coast.area = land.area();
  cull(scratch / "global.nc", scratch / "ocean.nc", {.coast = coast});
  for (const std::string name : {"area", "ocean"}) {
    CAPTURE(name);
    const std::string old = scratch / (name + ".nc"), now = scratch / (name + "-there.nc");
    const RotateReport report = rotate(old, now, to_the_rockies);
    CHECK(!report.fields.moved.empty());
    for (const char* of_mesh : {"bdyMaskCell", "bdyMaskEdge", "mapCulledToBaseCell"})
      CHECK(std::ranges::count(report.fields.moved, of_mesh) == 0);
    CHECK(changed(contents_of(old), contents_of(now)) == of_place);
    const MeshFile before = read_mesh_file(old), after = read_mesh_file(now);
    CHECK(after.not_voronoi.fault == before.not_voronoi.fault);
    REQUIRE(after.polygons);
    CHECK(check(*after.polygons).passed() == check(*before.polygons).passed());
    CHECK(check_file(now, read_mesh_file(now)).size() ==
          check_file(old, read_mesh_file(old)).size());
    const RotatedFile contents = rotated(before, to_the_rockies);
    CHECK((contents.file.polygons->corners - after.polygons->corners).cwiseAbs().maxCoeff() <=
          1e-15);
  }
}

TEST_CASE("angles stay in the range of their file") {
  const Scratch scratch;
  write_global(scratch, scratch / "old.nc", {.cells = 300});
  std::filesystem::copy(scratch / "old.nc", scratch / "positive.nc");
  {
    const Patch patch(scratch / "positive.nc");
    Variable angles = patch.get("angleEdge");
    for (double& angle : angles.values)
      angle += angle < 0 ? 2 * std::numbers::pi : 0;
    patch.put(angles);
  }
  rotate(scratch / "old.nc", scratch / "new.nc", to_the_rockies);
  rotate(scratch / "positive.nc", scratch / "positive-new.nc", to_the_rockies);
  const std::vector<double> both = contents_of(scratch / "new.nc").numbers.at("angleEdge"),
                            positive =
                                contents_of(scratch / "positive-new.nc").numbers.at("angleEdge");
  for (std::size_t e = 0; e < both.size(); ++e) {
    CHECK((positive[e] >= 0 && positive[e] < 2 * std::numbers::pi));
    CHECK(std::abs(std::remainder(positive[e] - both[e], 2 * std::numbers::pi)) <= 2e-15);
  }
  CHECK(std::ranges::min(both) < 0);
  CHECK(std::ranges::max(both) <= std::numbers::pi);
}

TEST_CASE("a file that cannot rotate is refused, without a new one") {
  const Scratch scratch;
  const auto files = [&] { return scratch.files(); };
  write(scratch / "plane.nc", planar_hexagons(6, 6, 1));
  write(scratch / "small.nc", delaunay(fibonacci_sphere(100)), {.format = Format::mpas_minimal});
  write(scratch / "cells.nc", delaunay(fibonacci_sphere(100)), {.format = Format::scrip});
  const std::ptrdiff_t before = files();
  const auto refusal = [&](const std::string& name) {
    return refusal_of([&] { rotate(scratch / name, scratch / "new.nc", to_the_rockies); });
  };
  CHECK(
      refusal("plane.nc").ends_with("holds a mesh of the plane, not of the sphere; give another"));
  CHECK(refusal("small.nc").ends_with("complete it with calotte convert IN OUT.nc"));
  CHECK(refusal("cells.nc").ends_with("holds no MPAS mesh; convert it with calotte convert"));
  CHECK(files() == before);
  CHECK(refusal_of([&] {
          rotated(planar_hexagons(6, 6, 1), to_the_rockies);
        }).ends_with("give a mesh of the sphere"));
}
