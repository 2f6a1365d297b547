// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/clouds.h"
#include "support/files.h"
#include "support/meshes.h"

#include <calotte/check_file.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>

#include <doctest/doctest.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <vector>

// What a file stores against what its mesh says: files of this library agree; a file of which any
// variable is spoilt is found out.

namespace fs = std::filesystem;
using namespace calotte;
using test::NamedMesh;
using test::Scratch;

namespace {

constexpr double pi = std::numbers::pi;

// ---- Files through the C library

void require(int code) { REQUIRE(std::string(nc_strerror(code)) == nc_strerror(NC_NOERR)); }

/// A variable as a file holds it.
struct Variable {
  std::string name;
  std::vector<std::size_t> shape;
  bool integer = false;
  std::vector<double> values;

  std::size_t width() const { return shape.size() < 2 ? 1 : shape[1]; }
};

class Patch {
public:
  explicit Patch(const std::string& path) { require(nc_open(path.c_str(), NC_WRITE, &id_)); }
  Patch(const Patch&) = delete;
  Patch& operator=(const Patch&) = delete;
  ~Patch() { nc_close(id_); }

  int id() const { return id_; }
  Variable get(int v) const {
    char name[NC_MAX_NAME + 1] = "";
    int dimensions[NC_MAX_VAR_DIMS], count = 0;
    nc_type type = NC_NAT;
    require(nc_inq_var(id_, v, name, &type, &count, dimensions, nullptr));
    Variable variable{name, {}, type != NC_DOUBLE && type != NC_FLOAT, {}};
    std::size_t size = 1;
    for (int d = 0; d < count; ++d) {
      variable.shape.emplace_back();
      require(nc_inq_dimlen(id_, dimensions[d], &variable.shape.back()));
      size *= variable.shape.back();
    }
    variable.values.resize(size);
    require(nc_get_var_double(id_, v, variable.values.data()));
    return variable;
  }
  Variable get(const std::string& name) const {
    int v = -1;
    require(nc_inq_varid(id_, name.c_str(), &v));
    return get(v);
  }
  void put(const Variable& variable) const {
    int v = -1;
    require(nc_inq_varid(id_, variable.name.c_str(), &v));
    require(nc_put_var_double(id_, v, variable.values.data()));
  }
  std::vector<Variable> all() const {
    int count = 0;
    require(nc_inq_nvars(id_, &count));
    std::vector<Variable> variables;
    for (int v = 0; v < count; ++v)
      variables.push_back(get(v));
    return variables;
  }

private:
  int id_ = -1;
};

std::string in_lines(const std::vector<Deviation>& deviations) {
  std::string lines;
  for (const Deviation& deviation : deviations)
    lines += deviation.text + "\n";
  return lines;
}

std::vector<Deviation> deviations_of(const std::string& path) {
  return check_file(path, read_mesh_file(path));
}

void check_none(const std::string& path) { CHECK(in_lines(deviations_of(path)).empty()); }

/// Whether reading refuses a file, or the check finds a deviation that counts.
bool is_found(const std::string& path) {
  try {
    const std::vector<Deviation> found = deviations_of(path);
    for (const Deviation& deviation : found) {
      CHECK(!deviation.text.empty());
      CHECK(deviation.text.find('\n') == std::string::npos);
      CHECK(deviation.difference > 0);
    }
    return std::any_of(found.begin(), found.end(), [](const Deviation& d) { return !d.known; });
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return true;
  }
}

// ---- Files of this library

struct FileKind {
  std::string name;
  Format format;
};
const std::vector<FileKind> kinds{
    {"mesh.nc", Format::mpas},         {"minimal.nc", Format::mpas_minimal},
    {"cells.ugrid.nc", Format::ugrid}, {"triangles.ugrid.nc", Format::ugrid_triangles},
    {"cells.scrip.nc", Format::scrip}, {"cells.esmf.nc", Format::esmf}};

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all = test::closed_meshes();
  all.push_back({"8:1", spherical_delaunay(test::eight_to_one(200, 5))});
  all.push_back({"many meridians", spherical_delaunay(lat_lon_sphere(4, 140, true))});
  return all;
}

/// A density that differs from cell to cell.
WriteOptions options_of(const Mesh& mesh, double radius, Format format) {
  WriteOptions options{.format = format, .sphere_radius = radius};
  options.site_density.resize(mesh.points.cols());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
    options.site_density[i] = 2 + mesh.points.col(i).normalized().z();
  return options;
}

// ---- Corruption

/// A way to spoil the values of a variable; `pick` chooses a place.
struct Corruption {
  std::string name;
  std::function<void(Variable&, std::size_t pick)> spoil;
  bool of_one_value = false;
};

/// Another id of the variable; of a flag, the other one.
double another_id(const Variable& variable, std::size_t pick) {
  const double own = variable.values[pick];
  for (std::size_t k = 1; k < variable.values.size(); ++k) {
    const double other = variable.values[(pick + k * k) % variable.values.size()];
    if (other != own && other > 0)
      return other;
  }
  return own == 0 ? 1 : own + 1;
}

void nudge(Variable& variable, std::size_t pick) {
  double& value = variable.values[pick];
  value = variable.integer ? another_id(variable, pick) : value * (1 + 1e-3);
}

const std::vector<Corruption>& corruptions() {
  static const std::vector<Corruption> all{
      {"one value changed", nudge, true},
      {"one value zeroed", [](Variable& v, std::size_t pick) { v.values[pick] = 0; }, true},
      {"halved",
       [](Variable& v, std::size_t) {
         for (double& value : v.values)
           value = v.integer ? std::trunc(value / 2) : value / 2;
       }},
      {"reversed",
       [](Variable& v, std::size_t) { std::reverse(v.values.begin(), v.values.end()); }},
      {"zeroed",
       [](Variable& v, std::size_t) { std::fill(v.values.begin(), v.values.end(), 0.0); }},
      {"shifted by one place",
       [](Variable& v, std::size_t) {
         std::rotate(v.values.begin(), v.values.begin() + 1, v.values.end());
       }},
      {"shifted by one row",
       [](Variable& v, std::size_t) {
         std::rotate(v.values.begin(), v.values.begin() + static_cast<std::ptrdiff_t>(v.width()),
                     v.values.end());
       }},
      {"not a number", [](Variable& v, std::size_t pick) {
         if (!v.integer)
           v.values[pick] = std::numeric_limits<double>::quiet_NaN();
       }}};
  return all;
}

/// Values that are large for their variable, evenly spaced among these: a relative change of 1e-3
/// moves each beyond the tolerance.
std::vector<std::size_t> picks_of(const Variable& variable, std::size_t count) {
  double greatest = 0;
  for (const double value : variable.values)
    greatest = std::max(greatest, std::abs(value));
  std::vector<std::size_t> large, picks;
  for (std::size_t i = 0; i < variable.values.size(); ++i)
    if (variable.integer ? variable.values[i] >= 0 : std::abs(variable.values[i]) > greatest / 100)
      large.push_back(i);
  if (large.empty())
    large.push_back(0);
  const std::size_t step = std::max<std::size_t>(large.size() / count, 1);
  for (std::size_t k = 0; k < large.size() && picks.size() < count; k += step)
    picks.push_back(large[k]);
  return picks;
}

/// Whether a corruption leaves a file that means something else, but is right.
bool is_still_right(Format format, const Variable& before, const Variable& after) {
  // The mesh variable of UGRID carries attributes alone; the conventions give its value no meaning.
  if (before.name == "mesh")
    return format == Format::ugrid || format == Format::ugrid_triangles;
  // A mask with some cells left out is as right as one without.
  if (before.name == "grid_imask" || before.name == "elementMask")
    return std::any_of(after.values.begin(), after.values.end(), [](double m) { return m == 1; }) &&
           std::all_of(after.values.begin(), after.values.end(),
                       [](double m) { return m == 0 || m == 1; });
  return false;
}

/// Spoils each variable alone in each way, and restores it.
int check_each_variable(const std::string& path, Format format, std::size_t picks) {
  const std::vector<Variable> variables = Patch(path).all();
  int done = 0;
  for (const Variable& variable : variables)
    for (const Corruption& corruption : corruptions())
      for (const std::size_t pick : picks_of(variable, corruption.of_one_value ? picks : 1)) {
        Variable spoilt = variable;
        corruption.spoil(spoilt, pick);
        const bool same =
            std::equal(spoilt.values.begin(), spoilt.values.end(), variable.values.begin());
        if (same || is_still_right(format, variable, spoilt))
          continue;
        Patch(path).put(spoilt);
        CAPTURE(variable.name);
        CAPTURE(corruption.name);
        CAPTURE(pick);
        CHECK(is_found(path));
        Patch(path).put(variable);
        ++done;
      }
  check_none(path);
  return done;
}

void check_corruptions(int sites, std::size_t picks) {
  const Scratch scratch;
  const Mesh mesh = spherical_delaunay(random_sphere(sites, 7));
  for (const auto& [name, format] : kinds) {
    if (format == Format::mpas_minimal)
      continue; // nothing else tells of the density there
    CAPTURE(name);
    const std::string path = scratch / name;
    write(path, mesh, options_of(mesh, 6371229, format));
    CHECK(check_each_variable(path, format, picks) > 30);
  }
}

// ---- The free choices of an MPAS file

/// An MPAS file in memory; ids are 1-based.
struct Mpas {
  explicit Mpas(const std::string& path) {
    for (Variable& variable : Patch(path).all())
      variables.emplace(variable.name, std::move(variable));
  }
  void write(const std::string& path) const {
    const Patch patch(path);
    for (const auto& [name, variable] : variables)
      patch.put(variable);
  }
  Variable& operator[](const std::string& name) { return variables.at(name); }
  std::size_t rows(const std::string& name) { return (*this)[name].shape[0]; }
  double& at(const std::string& name, std::size_t row, std::size_t k = 0) {
    Variable& variable = (*this)[name];
    return variable.values[row * variable.width() + k];
  }
  std::size_t id(const std::string& name, std::size_t row, std::size_t k = 0) {
    return static_cast<std::size_t>(at(name, row, k)) - 1;
  }
  /// Turns the first `count` entries of a row to the left.
  void rotate_row(const std::string& name, std::size_t row, std::size_t by, std::size_t count) {
    const auto first =
        (*this)[name].values.begin() + static_cast<std::ptrdiff_t>(row * (*this)[name].width());
    std::rotate(first, first + static_cast<std::ptrdiff_t>(by),
                first + static_cast<std::ptrdiff_t>(count));
  }

  std::map<std::string, Variable> variables;
};

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
  for (const auto& [name, mesh] : meshes())
    for (const double radius : {1.0, 6371229.0})
      for (const Numbering numbering : {Numbering::input, Numbering::curve, Numbering::rcm})
        for (const auto& [file, format] : kinds) {
          CAPTURE(name);
          CAPTURE(radius);
          CAPTURE(file);
          CAPTURE(int(numbering));
          WriteOptions options = options_of(mesh, radius, format);
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
    write(path, mesh, options_of(mesh, 6371229, Format::mpas));
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
    const PlanarMesh mesh = periodic_delaunay(points, {10, 5});
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
  const Mesh mesh = spherical_delaunay(random_sphere(100, 3));
  write(path, mesh, options_of(mesh, 6371229, Format::mpas));
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
}

TEST_CASE("a deviation names the variable, the place, both values and the rule") {
  const Scratch scratch;
  const std::string path = scratch / "mesh.nc";
  const Mesh mesh = spherical_delaunay(test::octahedron());
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

TEST_CASE("files of other formats have no variables to check") {
  const Scratch scratch;
  write(scratch / "mesh.off", spherical_delaunay(test::octahedron()));
  check_none(scratch / "mesh.off");
}

TEST_CASE("a variable that is spoilt alone is found") { check_corruptions(40, 3); }

TEST_CASE("a variable that is spoilt alone anywhere is found [slow]") {
  check_corruptions(60, 400);
}
