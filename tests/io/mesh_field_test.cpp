// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/meshes.h"
#include "support/spoilt_files.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/voronoi.h>

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using calotte::ErrorCode;
using calotte::FieldChoice;
using calotte::FieldLocation;
using calotte::Format;
using calotte::Mesh;
using calotte::MeshField;
using calotte::MeshFile;
using calotte::Numbering;
using namespace calotte::test;
using Names = std::vector<std::string>;
constexpr auto npos = std::string::npos;

namespace {

/// A variable that a test adds to a file, without Calotte.
struct Added {
  std::string name;
  Names dimensions;
  std::function<double(const std::vector<std::size_t>& index)> value;
  nc_type type = NC_DOUBLE;
  std::string long_name = {};
};

using Dimensions = std::vector<std::pair<std::string, std::size_t>>;

/// The index of value k of an array, last dimension first.
std::vector<std::size_t> index_of(std::size_t k, const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> index(shape.size());
  for (std::size_t d = shape.size(); d-- > 0; k /= shape[d])
    index[d] = k % shape[d];
  return index;
}

void add(const std::string& path, const Dimensions& dimensions, const std::vector<Added>& all) {
  int id = -1;
  require(nc_open(path.c_str(), NC_WRITE, &id));
  require(nc_redef(id));
  for (const auto& [name, size] : dimensions) {
    int unused;
    require(nc_def_dim(id, name.c_str(), size, &unused));
  }
  for (const Added& added : all) {
    std::vector<int> ids;
    for (const std::string& name : added.dimensions)
      require(nc_inq_dimid(id, name.c_str(), &ids.emplace_back()));
    int v;
    require(nc_def_var(id, added.name.c_str(), added.type, int(ids.size()), ids.data(), &v));
    require(nc_put_att_text(id, v, "long_name", added.long_name.size(), added.long_name.c_str()));
    if (added.type == NC_INT) {
      const int fill = -7;
      require(nc_put_att_int(id, v, "_FillValue", NC_INT, 1, &fill));
    }
  }
  require(nc_close(id));
  for (const Added& added : all) {
    Patch file(path);
    Variable variable = file.get(added.name);
    for (std::size_t k = 0; k < variable.values.size(); ++k)
      variable.values[k] = added.value(index_of(k, variable.shape));
    file.put(variable);
  }
}

/// The file's edges in another order, some from the higher cell to the lower one.
void shuffle_edges(const std::string& path) {
  Patch file(path);
  Variable cells = file.get("cellsOnEdge");
  std::vector<std::size_t> order(cells.values.size() / 2);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const std::vector<double> old = cells.values;
  for (std::size_t e = 0; e < order.size(); ++e)
    for (std::size_t k = 0; k < 2; ++k)
      cells.values[2 * e + k] = old[2 * order[e] + (e % 3 == 0 ? 1 - k : k)];
  file.put(cells);
}

/// The coordinates in an MPAS file, and its edges.
struct Coordinates {
  explicit Coordinates(const std::string& path) {
    const Patch file(path);
    for (const char* axis : {"x", "y", "z"}) {
      cells.push_back(file.get(std::string(axis) + "Cell").values);
      vertices.push_back(file.get(std::string(axis) + "Vertex").values);
    }
    edges = file.get("cellsOnEdge").values;
  }
  Eigen::Vector3d end(std::size_t edge, std::size_t k) const {
    const auto cell = static_cast<std::size_t>(edges[2 * edge + k]) - 1;
    return {cells[0][cell], cells[1][cell], cells[2][cell]};
  }
  /// Of the same at all times, along the edge's normal.
  double flow(std::size_t edge) const {
    const Eigen::Vector3d along = end(edge, 1) - end(edge, 0);
    return along.dot(Eigen::Vector3d(1, 2, 3));
  }
  double height(std::size_t edge) const { return end(edge, 0).z() + end(edge, 1).z(); }

  std::vector<std::vector<double>> cells, vertices;
  std::vector<double> edges;
};

using Index = std::vector<std::size_t>;

/// Fields of every kind, each computed from the coordinates in the file.
std::vector<Added> fields_of(const Coordinates& p) {
  return {{"u", {"nEdges", "nLevels"}, [&](const Index& i) { return (1. + i[1]) * p.flow(i[0]); }},
          {"gradient",
           {"Time", "nEdges"},
           [&](const Index& i) { return (1. + i[0]) * p.flow(i[1]); },
           NC_DOUBLE,
           "difference along the Normal of an edge"},
          {"height", {"nEdges"}, [&](const Index& i) { return p.height(i[0]); }},
          {"warmth",
           {"Time", "nCells", "nLevels"},
           [&](const Index& i) { return p.cells[0][i[1]] + 10. * i[0] + 100. * i[2]; }},
          {"spin",
           {"nVertices", "nLevels"},
           [&](const Index& i) { return p.vertices[1][i[0]] + 10. * i[1]; }},
          {"zone",
           {"nCells"},
           [&](const Index& i) { return i[0] == 0 ? -7. : std::floor(1e6 * p.cells[2][i[0]]); },
           NC_INT}};
}

const Dimensions sizes{{"times", 2}, {"nLevels", 3}};

/// A full MPAS file of another program.
void write_foreign(const std::string& path, const Mesh& mesh) {
  calotte::write(path, mesh);
  shuffle_edges(path);
  const Coordinates coordinates(path);
  std::vector<Added> all = fields_of(coordinates);
  for (Added& added : all) // the library's Time has no records
    std::replace(added.dimensions.begin(), added.dimensions.end(), std::string("Time"),
                 std::string("times"));
  const auto none = [](const Index&) { return 1.; };
  all.push_back({"advCells", {"nCells", "nLevels"}, none});
  all.push_back({"slope", {"nCells", "maxEdges"}, none});
  all.push_back({"depth", {"nLevels"}, none});
  add(path, sizes, all);
}

void check_field(const std::string& path, const Added& field) {
  CAPTURE(field.name);
  const Variable written = Patch(path).get(field.name);
  double worst = 0;
  for (std::size_t k = 0; k < written.values.size(); ++k) {
    const double expected = field.value(index_of(k, written.shape));
    worst = std::max(worst, std::abs(written.values[k] - expected));
  }
  CHECK(worst < 1e-12);
}

Names names_of(const std::vector<MeshField>& fields) {
  Names names;
  for (const MeshField& field : fields)
    names.push_back(field.name);
  return names;
}

int type_in(const std::string& path, const std::string& name) {
  int id = -1, v = -1;
  nc_type type = NC_NAT;
  require(nc_open(path.c_str(), NC_NOWRITE, &id));
  require(nc_inq_varid(id, name.c_str(), &v));
  require(nc_inq_vartype(id, v, &type));
  require(nc_close(id));
  return type;
}

} // namespace

TEST_CASE("fields at edges, of levels and of times follow their places to another numbering") {
  const Scratch scratch;
  const std::string path = scratch / "foreign.nc", copy = scratch / "copy.nc";
  write_foreign(path, calotte::delaunay(calotte::random_sphere(150, 4)));
  const MeshFile file = calotte::read_mesh_file(path);
  CHECK(names_of(file.fields) == Names{"u", "gradient", "height", "warmth", "spin", "zone"});
  CHECK(file.ignored == Names{"advCells", "slope", "depth"});
  REQUIRE(file.changes.size() == 1);
  CHECK(file.changes[0] == "edges run from their lower to their higher cell: turned 148 of 444; "
                           "changes its sign there: u, gradient; keeps its sign: height");
  for (const Numbering numbering : {Numbering::input, Numbering::curve}) {
    CAPTURE(int(numbering));
    const calotte::WrittenFields written = calotte::write(copy, file, {.numbering = numbering});
    CHECK(written.dropped.empty());
    CHECK(written.renamed.empty());
    const Coordinates coordinates(copy);
    for (const Added& field : fields_of(coordinates))
      if (field.name != "zone")
        check_field(copy, field);
    CHECK(Patch(copy).get("warmth").dimensions == Names{"times", "nCells", "nLevels"});
    check_none(copy); // nothing of the mesh deviates
  }
}

TEST_CASE("integers stay integers, and a missing one is missing; packed values are unpacked") {
  const Scratch scratch;
  const std::string path = scratch / "foreign.nc", copy = scratch / "copy.nc";
  write_foreign(path, calotte::delaunay(calotte::random_sphere(60, 5)));
  Patch(path).attribute("height", "scale_factor", 2.0);
  Patch(path).attribute("height", "add_offset", 1.0);
  const MeshFile file = calotte::read_mesh_file(path);
  CHECK(file.fields[5].integer);
  CHECK(file.fields[5].values.array().isNaN().count() == 1);
  calotte::write(copy, file, {.numbering = Numbering::curve});
  CHECK(type_in(copy, "zone") == NC_INT);
  const Coordinates coordinates(copy);
  const std::vector<double> zone = Patch(copy).get("zone").values;
  constexpr double none = -2147483647; // NC_FILL_INT
  CHECK(std::count(zone.begin(), zone.end(), none) == 1);
  for (std::size_t i = 0; i < zone.size(); ++i)
    CHECK((zone[i] == none || zone[i] == std::floor(1e6 * coordinates.cells[2][i])));
  const std::vector<double> height = Patch(copy).get("height").values;
  for (std::size_t e = 0; e < height.size(); ++e)
    CHECK(height[e] == doctest::Approx(1 + 2 * coordinates.height(e)));
  CHECK(calotte::read_mesh_file(copy).fields[5].values.array().isNaN().count() == 1);
}

TEST_CASE("formats of cells hold levels and times; those at edges are named") {
  const Scratch scratch;
  const std::string path = scratch / "foreign.nc", copy = scratch / "copy.nc";
  write_foreign(path, calotte::delaunay(calotte::random_sphere(80, 6)));
  const MeshFile file = calotte::read_mesh_file(path);
  const Names edges{"u", "gradient", "height"};
  const auto dropped = [&](const std::string& to, Format format) {
    return calotte::write(to, file, {.format = format}).dropped;
  };
  for (const auto& [format, cells] :
       std::vector<std::pair<Format, std::string>>{{Format::ugrid, "mesh_face"},
                                                   {Format::ugrid_triangles, "mesh_node"},
                                                   {Format::esmf, "elementCount"},
                                                   {Format::mpas_minimal, "nCells"}}) {
    CHECK(dropped(copy, format) == edges);
    CHECK(Patch(copy).get("warmth").dimensions == Names{"times", cells, "nLevels"});
    const MeshFile back = calotte::read_mesh_file(copy);
    CHECK(names_of(back.fields) == Names{"warmth", "spin", "zone"});
    const MeshField& warmth = back.fields[0];
    REQUIRE(warmth.count() == 6);
    for (Eigen::Index i = 0; i < back.mesh->points.cols(); ++i)
      for (Eigen::Index k = 0; k < 6; ++k) {
        const double expected =
            back.mesh->points(0, i) + 10. * double(k / 3) + 100. * double(k % 3);
        CHECK(std::abs(warmth.values[6 * i + k] - expected) < 1e-12);
      }
  }
  CHECK(dropped(copy, Format::scrip) == Names{"u", "gradient", "height", "spin"});
  CHECK(dropped(scratch / "a.vtp", Format::by_name) ==
        Names{"u", "gradient", "height", "warmth", "spin"});
  CHECK(dropped(scratch / "a.geojson", Format::by_name) ==
        Names{"u", "gradient", "height", "warmth", "spin"});
  CHECK(calotte::read_mesh_file(path, nullptr, FieldChoice::none).fields.empty());
  CHECK(names_of(calotte::read_mesh_file(path, nullptr, FieldChoice::scalars).fields) ==
        Names{"height", "zone"});
}

TEST_CASE("UGRID tells where each field is") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  calotte::WriteOptions options{.format = Format::ugrid};
  options.fields = {
      {.name = "c", .values = Eigen::VectorXd::Ones(6)},
      {.name = "v", .location = FieldLocation::vertices, .values = Eigen::VectorXd::Ones(8)}};
  const auto location = [&](const char* name) {
    int id = -1, v = -1;
    char text[8] = "";
    require(nc_open((scratch / "mesh.nc").c_str(), NC_NOWRITE, &id));
    require(nc_inq_varid(id, name, &v));
    require(nc_get_att_text(id, v, "location", text));
    require(nc_close(id));
    return std::string(text);
  };
  calotte::write(scratch / "mesh.nc", mesh, options);
  CHECK(location("c") == "face");
  CHECK(location("v") == "node");
  options.format = Format::ugrid_triangles;
  calotte::write(scratch / "mesh.nc", mesh, options);
  CHECK(location("c") == "node");
  CHECK(location("v") == "face");
}

TEST_CASE("a periodic plane's fields at edges follow them") {
  const Scratch scratch;
  const std::string path = scratch / "box.nc", copy = scratch / "copy.nc";
  const calotte::Surface box = calotte::Surface::periodic({10, 8});
  const Mesh mesh = calotte::delaunay(calotte::random_points(120, box, {}, 3), box);
  calotte::write(path, mesh);
  shuffle_edges(path);
  const auto value = [](const std::vector<double>& edges, std::size_t e) {
    return edges[2 * e] - edges[2 * e + 1]; // cells keep their numbers
  };
  const std::vector<double> edges = Patch(path).get("cellsOnEdge").values;
  add(path, {}, {{"v", {"nEdges"}, [&](const Index& i) { return value(edges, i[0]); }}});
  const MeshFile file = calotte::read_mesh_file(path);
  CHECK(calotte::write(copy, file).dropped.empty());
  const std::vector<double> v = Patch(copy).get("v").values,
                            after = Patch(copy).get("cellsOnEdge").values;
  for (std::size_t e = 0; e < v.size(); ++e)
    CHECK(v[e] == value(after, e));
}

TEST_CASE("names that NetCDF refuses are replaced, and each is named") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  MeshFile file;
  file.mesh = mesh;
  for (const char* name :
       {"sea level", "a/b", "a_b", "+x", "H\xc3\xb6he", "\xc3", "", "a\nb", "2m", "grid_area"})
    file.fields.push_back({.name = name, .values = Eigen::VectorXd::Ones(6)});
  const std::vector<std::array<std::string, 2>> renamed{{"sea level", "sea_level"},
                                                        {"a_b", "a_b_2"},
                                                        {"+x", "_x"},
                                                        {"\xc3", "_"},
                                                        {"", "field"},
                                                        {"a/b", "a_b"},
                                                        {"a\nb", "a_b_3"}};
  for (const Format format : {Format::mpas, Format::ugrid, Format::scrip, Format::esmf}) {
    const calotte::WrittenFields written =
        calotte::write(scratch / "mesh.nc", file, {.format = format});
    CHECK(std::is_permutation(written.renamed.begin(), written.renamed.end(), renamed.begin(),
                              renamed.end()));
    CHECK(written.dropped == (format == Format::scrip ? Names{"grid_area"} : Names{}));
    const MeshFile back = calotte::read_mesh_file(scratch / "mesh.nc");
    CHECK(std::ssize(back.fields) == (format == Format::scrip ? 9 : 10));
    CHECK(back.fields[0].name == "sea_level");
    CHECK(back.fields[0].long_name == "sea level");
  }
  CHECK(calotte::write(scratch / "mesh.vtp", file).renamed.empty());
}

TEST_CASE("fields that do not fit are refused by name") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(octahedron());
  const auto problem = [&](const MeshField& field, const Mesh& of) {
    calotte::WriteOptions options{.format = Format::ugrid_triangles};
    options.fields = {field};
    const calotte::Error error =
        error_of([&] { calotte::write(scratch / "mesh.nc", of, options); });
    CHECK(error.code() == ErrorCode::invalid_argument);
    CHECK(scratch.files() == 0);
    return std::string(error.what()).substr((scratch / "mesh.nc: ").size());
  };
  MeshField field{.name = "f", .values = Eigen::VectorXd::Ones(12)};
  CHECK(problem(field, mesh) == "the field f has 12 values; give one for each of 6");
  field.dimensions = {{"levels", 3}};
  CHECK(problem(field, mesh) == "the field f has 12 values; give one for each of 18");
  field.dimensions = {{"levels", 0}};
  CHECK(problem(field, mesh) ==
        "the dimension levels of the field f has the size 0; give one from 1 on");
  field.dimensions = {{"levels", 2}};
  field.leading = 2;
  CHECK(problem(field, mesh).starts_with("the field f has 1 dimensions, of which 2"));
  field = {.name = "e", .location = FieldLocation::edges, .values = Eigen::VectorXd::Ones(11)};
  CHECK(problem(field, mesh) == "the field e has 11 values; give one for each of 12");
  CHECK(problem(field, open_meshes()[0].mesh) ==
        "the field e is at edges, which only closed meshes number; leave it out");
}

TEST_CASE("a field that is asked for is in the file, or is refused before any work") {
  const Scratch scratch;
  const Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(60));
  const Eigen::Index sites = 60, vertices = 116;
  std::vector<MeshField> fields{
      {.name = "levels", .values = Eigen::VectorXd::Random(2 * sites), .dimensions = {{"lev", 2}}},
      {.name = "corner",
       .location = FieldLocation::vertices,
       .values = Eigen::VectorXd::Random(vertices)},
      {.name = "edge",
       .location = FieldLocation::edges,
       .values = Eigen::VectorXd::Random(sites + vertices - 2)}};
  for (const char* name : {"f", "area", "site", "spacing", "quality", "degree", "areaCell",
                           "latCell", "grid_area", "elementArea", "id", "x", "triangle"})
    fields.push_back({.name = name, .values = Eigen::VectorXd::Random(sites)});
  for (const char* name : {"area", "spacing", "triangle", "latVertex"})
    fields.push_back({.name = name,
                      .location = FieldLocation::vertices,
                      .values = Eigen::VectorXd::Random(vertices)});
  int stored = 0, refused = 0;
  for (const calotte::FormatInfo& info : calotte::formats()) {
    if (info.word.empty())
      continue;
    const std::string& name = info.names.front();
    const std::string path = scratch / (name[0] == '.' ? "mesh" + name : name);
    for (const MeshField& field : fields) {
      CAPTURE(info.word);
      CAPTURE(field.name);
      calotte::WriteOptions options{.format = info.format, .numbering = Numbering::input};
      options.fields = {field};
      try {
        calotte::write(path, mesh, options);
      } catch (const calotte::Error& error) {
        CHECK(error.code() == ErrorCode::invalid_argument);
        const std::string text = error.what();
        CHECK((text.find("; write ") != npos || text.find(", or write ") != npos ||
               text.find("give the field another name") != npos));
        CHECK(scratch.files() == 0);
        ++refused;
        continue;
      }
      ++stored;
      const MeshFile file = calotte::read_mesh_file(path);
      CHECK(std::ranges::any_of(file.fields, [&](const MeshField& found) {
        return found.name == field.name && found.values.size() == field.values.size() &&
               (found.values.array() == field.values.array()).all();
      }));
      for (const auto& entry : std::filesystem::directory_iterator(scratch.folder))
        std::filesystem::remove(entry);
    }
  }
  CHECK(stored > 50);
  CHECK(refused > 50);
}

TEST_CASE("numbers that a mesh file lacks have a fill value, which it names") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  calotte::WriteOptions options;
  options.fields = {{.name = "gap", .values = Eigen::VectorXd::LinSpaced(6, 0, 5)},
                    {.name = "whole", .values = Eigen::VectorXd::LinSpaced(6, 0, 5)}};
  options.fields[0].values[2] = std::nan("");
  calotte::write(path, calotte::delaunay(octahedron()), options);
  const auto fill_of = [&](const char* name) {
    int id = -1, v = -1;
    double fill = 0;
    require(nc_open(path.c_str(), NC_NOWRITE, &id));
    require(nc_inq_varid(id, name, &v));
    const bool has = nc_get_att_double(id, v, "_FillValue", &fill) == NC_NOERR;
    require(nc_close(id));
    return has ? fill : std::nan("");
  };
  CHECK(fill_of("gap") == NC_FILL_DOUBLE);
  CHECK(std::isnan(fill_of("whole")));
  const std::vector<double> values = Patch(path).get("gap").values;
  CHECK(std::ranges::count(values, NC_FILL_DOUBLE) == 1);
  CHECK(calotte::read_mesh_file(path).fields[0].values.array().isNaN().count() == 1);
}
