// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "support/files.h"

#include "io/cells/netcdf_fields.h"
#include "io/netcdf/netcdf_writer.h"
#include "support/text.h"

#include <calotte/cut.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using calotte::io_detail::NetcdfType;
using calotte::io_detail::NetcdfWriter;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string in_folder(const Scratch& scratch, const std::string& name) {
  return scratch.folder / name;
}

FieldGrid written_grid(const std::string& path, const Mesh& mesh,
                       const WriteOptions& options = {}) {
  write(path, mesh, options);
  return read_field_grid(path);
}

/// A raster file with a field f = 100 j + i.
struct FieldRaster {
  std::vector<double> latitudes{-60, -20, 20, 60}, longitudes{0, 60, 120, 180, 240, 300};
  std::vector<double> latitude_bounds = {};
  std::string latitude = "lat", longitude = "lon";

  void write(const std::string& path) const {
    NetcdfWriter file(path);
    const int lat = file.dimension(latitude, std::ssize(latitudes)),
              lon = file.dimension(longitude, std::ssize(longitudes)),
              pair = file.dimension("two", 2);
    calotte::io_detail::NetcdfAttributes of_lat{{"units", std::string("degrees_north")}},
        of_lon{{"units", std::string("degrees_east")}};
    if (!latitude_bounds.empty()) {
      of_lat.push_back({"bounds", latitude + "_b"});
      of_lon.push_back({"bounds", longitude + "_b"});
    }
    const auto copy = [](const std::vector<double>& values, std::int64_t row) {
      return NetcdfWriter::Fill<double>(
          [values, row](std::int64_t begin, std::int64_t end, double* out) {
            std::copy(values.begin() + begin * row, values.begin() + end * row, out);
          });
    };
    const int x = file.variable(longitude, NetcdfType::float64, {lon}, of_lon),
              y = file.variable(latitude, NetcdfType::float64, {lat}, of_lat);
    int xb = -1, yb = -1;
    std::vector<double> meridians;
    for (const double value : longitudes)
      meridians.insert(meridians.end(), {value - 30, value + 30});
    if (!latitude_bounds.empty()) {
      yb = file.variable(latitude + "_b", NetcdfType::float64, {lat, pair});
      xb = file.variable(longitude + "_b", NetcdfType::float64, {lon, pair});
    }
    const int f = file.variable("f", NetcdfType::float64, {lat, lon},
                                {{"units", std::string("m")}, {"missing_value", 203.0}});
    file.begin();
    file.put(x, copy(longitudes, 1));
    file.put(y, copy(latitudes, 1));
    if (yb >= 0) {
      file.put(yb, copy(latitude_bounds, 2));
      file.put(xb, copy(meridians, 2));
    }
    std::vector<double> values;
    for (std::size_t j = 0; j < latitudes.size(); ++j)
      for (std::size_t i = 0; i < longitudes.size(); ++i)
        values.push_back(100.0 * static_cast<double>(j) + static_cast<double>(i));
    file.put(f, copy(values, std::ssize(longitudes)));
    file.finish();
    file.commit();
  }
};

std::string problem_with_grid(const std::string& path) {
  return error_of([&] { read_field_grid(path); }).what();
}

bool same_weights(const Weights& a, const Weights& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && Eigen::MatrixXd(a) == Eigen::MatrixXd(b);
}

} // namespace

TEST_CASE("a raster is read with its boxes and fields") {
  const Scratch scratch;
  const std::string path = in_folder(scratch, "raster.nc");
  FieldRaster file;
  file.write(path);
  FieldGrid grid = read_field_grid(path);
  REQUIRE(grid.boxes);
  CHECK(grid.size() == 24);
  CHECK(grid.boxes->parallels == DoubleVector(Eigen::VectorXd{{-90, -40, 0, 40, 90}}));
  CHECK(grid.boxes->meridians[0] == -30);
  REQUIRE(grid.fields.size() == 1);
  CHECK(grid.fields[0].units == "m");
  CHECK(grid.fields[0].values[8] == 102);
  CHECK(std::isnan(grid.fields[0].values[15])); // missing_value

  file.latitudes = {60, 20, -20, -60};
  file.latitude_bounds = {50, 80, 50, 0, 0, -50, -50, -80};
  file.latitude = "latitude";
  file.longitude = "x"; // by its units
  file.write(path);
  grid = read_field_grid(path);
  CHECK(grid.boxes->parallels == DoubleVector(Eigen::VectorXd{{80, 50, 0, -50, -80}}));

  const double width = 2 * pi;
  CHECK(std::abs(areas(*grid.boxes).sum() - width * 2 * std::sin(80 * pi / 180)) < 1e-14);
}

TEST_CASE("what is wrong with a raster is said") {
  const Scratch scratch;
  const std::string path = in_folder(scratch, "raster.nc");
  FieldRaster file;
  file.latitudes[2] = -30;
  file.write(path);
  CHECK(problem_with_grid(path) == path + ": latitude[2] = -30 does not follow -20; sort the "
                                          "raster along it");
  file = {};
  file.latitudes[3] = 95;
  file.write(path);
  CHECK(has(problem_with_grid(path), "latitude[3] = 95 is outside -90 to 90"));
  file = {};
  file.latitude_bounds = {-90, -40, -40, 0, 10, 40, 40, 90};
  file.write(path);
  CHECK(has(problem_with_grid(path), "lat_b[2] does not begin where the one before ends"));
  file = {};
  file.longitudes = {0, 100, 200, 300, 400, 500};
  file.write(path);
  CHECK(has(problem_with_grid(path), "span"));
  CHECK(!raster_of("720"));
  CHECK(!raster_of("720x"));
  CHECK(!raster_of("720x360.nc"));
  CHECK(raster_of("720x360")->size() == 720 * 360);
  CHECK_THROWS_AS(raster_of("2x1"), Error);
  CHECK_THROWS_AS(raster_of("99999999x1"), Error);
}

TEST_CASE("fields come back from files of rasters, and keep their dimensions") {
  const Scratch scratch;
  const std::string path = in_folder(scratch, "fields.nc");
  const FieldGrid raster = *raster_of("6x4");
  MeshField field{.name = "t", .long_name = "temperature", .units = "K"};
  field.dimensions = {{"month", 2}, {"level", 3}};
  field.leading = 1;
  field.values = DoubleVector::LinSpaced(24 * 6, 0, 24 * 6 - 1);
  field.values[17] = none;
  MeshField use{.name = "use", .integer = true};
  use.values = DoubleVector::LinSpaced(24, 0, 23);
  use.values[4] = none;
  write_fields(path, raster, {field, use}, "made for a test");
  const FieldGrid found = read_field_grid(path);
  CHECK((found.boxes->meridians - raster.boxes->meridians).isZero(0));
  CHECK((found.boxes->parallels - raster.boxes->parallels).isZero(0));
  REQUIRE(found.fields.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const MeshField& expected = k == 0 ? field : use;
    CHECK(found.fields[k].name == expected.name);
    CHECK(found.fields[k].long_name == expected.long_name);
    CHECK(found.fields[k].leading == expected.leading);
    CHECK(found.fields[k].integer == expected.integer);
    CHECK(found.fields[k].dimensions.size() == expected.dimensions.size());
    for (Eigen::Index i = 0; i < expected.values.size(); ++i)
      CHECK((found.fields[k].values[i] == expected.values[i] ||
             (std::isnan(expected.values[i]) && std::isnan(found.fields[k].values[i]))));
  }
  use.name = "lat";
  CHECK_THROWS_AS(write_fields(path, raster, {use}), Error);
  use.name = "use";
  use.values.conservativeResize(23);
  CHECK_THROWS_AS(write_fields(path, raster, {use}), Error);
  CHECK_THROWS_AS(write_fields(in_folder(scratch, "raster.vtp"), raster, {field}), Error);
}

TEST_CASE("indices of dimensions choose one number for each cell") {
  MeshField field{.name = "t", .dimensions = {{"Time", 2}, {"nVertLevels", 3}}, .leading = 1};
  field.values = DoubleVector::LinSpaced(24, 0, 23); // 4 cells
  const MeshField time = field_at(field, {{"time", 1}});
  CHECK(time.values == (DoubleVector(12) << 3, 4, 5, 9, 10, 11, 15, 16, 17, 21, 22, 23).finished());
  CHECK(time.dimensions.size() == 1);
  CHECK(time.leading == 0);
  const MeshField level = field_at(field, {{"lev", -1}});
  CHECK(level.values == (DoubleVector(8) << 2, 5, 8, 11, 14, 17, 20, 23).finished());
  CHECK(level.leading == 1);
  CHECK(field_at(field, {{"LEVELS", 0}, {"Time", 1}}).values == Eigen::Vector4d(3, 9, 15, 21));
  const auto all = [&](const std::vector<FieldIndex>& choices) {
    return find_all_indices("t", field.dimensions, choices);
  };
  CHECK(all({{"lev", -1}, {"time", 0}}) == std::vector<std::int64_t>{0, 2});
  CHECK(find_all_indices("flat", {}, {}).empty());
  CHECK(find_all_indices("one", {{"Time", 1}}, {}) == std::vector<std::int64_t>{0});
  CHECK(std::string(error_of([&] {
                      all({{"time", 0}});
                    }).what()) ==
        "t has several numbers for each cell: Time (2), nVertLevels (3); choose one index of each: "
        "nVertLevels=0");
  CHECK(std::string(error_of([&] {
                      all({{"time", 0}, {"x", 0}});
                    }).what()) == "t has no dimension x; it has Time (2), nVertLevels (3)");
  const Scratch scratch;
  const std::string path = in_folder(scratch, "fields.nc"), mesh = in_folder(scratch, "mesh.nc");
  const FieldGrid grid = written_grid(mesh, delaunay(fibonacci_sphere(100)));
  field.values = DoubleVector::LinSpaced(600, 0, 599);
  MeshField flat{.name = "flat", .values = DoubleVector::Ones(100)};
  write_fields(path, grid, {field, flat});
  const std::vector<FieldIndex> indices{{"time", 1}, {"lev", 2}};
  const FieldGrid found = read_field_grid(path, mesh, FieldChoice::scalars, indices);
  REQUIRE(found.fields.size() == 2);
  CHECK(found.fields[0].values == field_at(field, indices).values);
  CHECK(found.fields[0].values[7] == 7 * 6 + 5);
  CHECK(found.fields[1].values == flat.values);
  CHECK(read_cell_field(path, "t", 100, indices).values == found.fields[0].values);
  CHECK(read_field_grid(path, mesh, FieldChoice::scalars, {{"Time", 0}}).fields.size() == 1);
  CHECK_THROWS_AS(read_cell_field(path, "flat", 100, indices), Error);
  CHECK_THROWS_AS(fields_at({flat}, indices), Error);
  CHECK(fields_at({field, flat}, indices)[0].values == found.fields[0].values);
  const std::string both = in_folder(scratch, "both.nc");
  write(both, delaunay(fibonacci_sphere(100)), {.fields = {field, flat}});
  const auto at = [&](FieldChoice choice, const std::vector<FieldIndex>& choices) {
    return read_mesh_file(both, nullptr, choice, choices);
  };
  const MeshFile one = at(FieldChoice::scalars, indices),
                 time_only = at(FieldChoice::scalars, {{"time", 1}});
  const auto named_t = [](const MeshField& each) { return each.name == "t"; };
  const auto t = std::ranges::find_if(one.fields, named_t);
  REQUIRE(t != one.fields.end());
  CHECK(t->values == field_at(read_mesh_file(both).fields.front(), indices).values);
  CHECK(std::ranges::none_of(time_only.fields, named_t));
  CHECK(std::ranges::find(time_only.ignored, "t") != time_only.ignored.end());
  CHECK(error_of([&] {
          at(FieldChoice::scalars, {{"x", 0}});
        }).what() == both + ": no field has a dimension x; leave it out");
}

TEST_CASE("an index of a dimension between those of the cells") {
  const Scratch scratch;
  const std::string path = in_folder(scratch, "between.nc");
  NetcdfWriter writer(path);
  const int lon = writer.dimension("lon", 3), time = writer.dimension("time", 2),
            lat = writer.dimension("lat", 4),
            f = writer.variable("f", NetcdfType::float64, {lon, time, lat});
  writer.begin();
  writer.put(f, [](std::int64_t begin, std::int64_t end, double* out) {
    std::iota(out, out + (end - begin) * 8, static_cast<double>(begin) * 8);
  });
  writer.finish();
  writer.commit();
  std::vector<MeshField> fields;
  std::vector<std::string> ignored;
  const calotte::io_detail::NetcdfReader file(path);
  calotte::io_detail::FieldsOn on{
      .dimensions = {"lat", "lon"}, .choice = FieldChoice::scalars, .choices = {{"time", 1}}};
  for (const auto& [first, count] : {std::pair(0, 4), {1, 2}, {3, 1}}) {
    on.rows = {first, count};
    fields.clear();
    calotte::io_detail::read_fields_on(file, on, fields, ignored);
    REQUIRE(fields.size() == 1);
    REQUIRE(fields[0].values.size() == 3 * count);
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < 3; ++i)
        CHECK(fields[0].values[3 * j + i] == 8 * i + 4 + first + j);
  }
}

TEST_CASE("methods between meshes and rasters of the sphere") {
  const Scratch scratch;
  const FieldGrid mesh =
                      written_grid(in_folder(scratch, "mesh.nc"), delaunay(fibonacci_sphere(1000))),
                  raster = *raster_of("36x18");
  const auto smooth = [](const Points3& at) {
    return DoubleVector((at.row(0).array() * at.row(1).array() + at.row(2).array()).transpose());
  };
  const Points3 centres = mesh.mesh.mesh->points, of_boxes = nodes(*raster.boxes);
  const auto error = [](const GridWeights& weights, const DoubleVector& from,
                        const DoubleVector& to) {
    return (interpolate(weights.weights, from) - to).cwiseAbs().maxCoeff();
  };
  for (const Interpolation kind :
       {Interpolation::linear, Interpolation::nearest, Interpolation::conservative}) {
    const double bound = kind == Interpolation::linear ? 0.02 : 0.2;
    CHECK(error(interpolation_weights(mesh, raster, kind), smooth(centres), smooth(of_boxes)) <
          bound);
    CHECK(error(interpolation_weights(raster, mesh, kind), smooth(of_boxes), smooth(centres)) <
          bound);
    const GridWeights same_grid = interpolation_weights(mesh, mesh, kind);
    CHECK((Eigen::MatrixXd(same_grid.weights) - Eigen::MatrixXd::Identity(1000, 1000))
              .cwiseAbs()
              .maxCoeff() < 1e-11);
  }
}

TEST_CASE("a part of the sphere: cells outside have no weights") {
  const Scratch scratch;
  write(in_folder(scratch, "globe.nc"), delaunay(fibonacci_sphere(2000)));
  cut(in_folder(scratch, "globe.nc"), in_folder(scratch, "part.nc"), circle({1, 0, 0}, 0.5),
      {.rings = 0});
  const FieldGrid part = read_field_grid(in_folder(scratch, "part.nc")),
                  raster = *raster_of("72x36");
  const DoubleVector ones = DoubleVector::Ones(part.size());
  const Points3 at = nodes(*raster.boxes);
  for (const Interpolation kind :
       {Interpolation::linear, Interpolation::nearest, Interpolation::conservative}) {
    const GridWeights weights = interpolation_weights(part, raster, kind);
    const DoubleVector found = interpolate(weights.weights, ones);
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      const double angle = std::acos(at(0, i));
      CHECK(std::isnan(found[i]) == (weights.target_fraction[i] == 0));
      if (angle < 0.35) // within the centres of its last cells
        CHECK(std::abs(found[i] - 1) < 1e-12);
      if (angle > 0.65)
        CHECK(std::isnan(found[i]));
    }
  }
  const GridWeights back = interpolation_weights(raster, part, Interpolation::conservative);
  CHECK((back.target_fraction.array() - 1).abs().maxCoeff() < 1e-12);
}

TEST_CASE("planes: linear is exact for linear fields, and periods are kept") {
  const Scratch scratch;
  const auto box = [&](const std::string& name, std::uint64_t seed) {
    const Surface surface = Surface::periodic({3, 2});
    return written_grid(in_folder(scratch, name),
                        delaunay(random_points(200, surface, {}, seed), surface));
  };
  const FieldGrid a = box("a.nc", 1), b = box("b.nc", 2);
  for (const Interpolation kind :
       {Interpolation::linear, Interpolation::nearest, Interpolation::conservative}) {
    const GridWeights weights = interpolation_weights(a, b, kind);
    CHECK((interpolate(weights.weights, DoubleVector::Ones(200)).array() - 1).abs().maxCoeff() <
          1e-12);
  }
  const auto open = [&](const std::string& name, std::int64_t n, std::uint64_t seed) {
    return written_grid(
        in_folder(scratch, name),
        delaunay(random_points(n, rectangle({0, 0}, {1, 1}), {}, seed), Surface::plane()));
  };
  const FieldGrid from = open("from.vtp", 400, 3), to = open("to.vtp", 200, 4);
  const auto linear = [](const FieldGrid& grid) {
    const Points3& at = grid.mesh.mesh->points;
    return DoubleVector((3 * at.row(0) - at.row(1)).transpose());
  };
  const DoubleVector found =
                         interpolate(interpolation_weights(from, to, Interpolation::linear).weights,
                                     linear(from)),
                     exact = linear(to);
  for (Eigen::Index i = 0; i < found.size(); ++i)
    CHECK((std::isnan(found[i]) || std::abs(found[i] - exact[i]) < 1e-12));
  CHECK((found.array() == found.array()).count() > 150);
  CHECK_THROWS_WITH_AS(interpolation_weights(from, to, Interpolation::conservative),
                       doctest::Contains("without cells; give linear or nearest"), Error);
  CHECK_THROWS_WITH_AS(interpolation_weights(a, *raster_of("8x4"), Interpolation::linear),
                       doctest::Contains("a.nc is in a periodic plane, and 8x4 is on the sphere"),
                       Error);
  CHECK_THROWS_AS(interpolation_weights(a, from, Interpolation::nearest), Error);
  CHECK_THROWS_WITH_AS(write_weights(in_folder(scratch, "w.nc"),
                                     interpolation_weights(a, b, Interpolation::nearest), a, b,
                                     Interpolation::nearest),
                       doctest::Contains("is in a plane"), Error);
}

TEST_CASE("weights come back from files of both formats") {
  const Scratch scratch;
  const std::string path = in_folder(scratch, "weights.nc");
  const FieldGrid mesh =
                      written_grid(in_folder(scratch, "mesh.nc"), delaunay(fibonacci_sphere(300))),
                  raster = *raster_of("12x6");
  for (const WeightsFormat format : {WeightsFormat::esmf, WeightsFormat::scrip})
    for (const Interpolation kind :
         {Interpolation::linear, Interpolation::nearest, Interpolation::conservative})
      for (const auto& [source, target] : {std::pair(mesh, raster), std::pair(raster, mesh)}) {
        const GridWeights weights = interpolation_weights(source, target, kind);
        write_weights(path, weights, source, target, kind, format);
        const GridWeights found = read_weights(path);
        CHECK(same_weights(found.weights, weights.weights));
        CHECK(found.target_fraction == weights.target_fraction);
        CHECK(std::abs(found.source_area.sum() - 4 * pi) < 1e-12);
        CHECK(std::abs(found.target_area.sum() - 4 * pi) < 1e-12);
      }
}

TEST_CASE("files that hold no weights, or wrong ones, are refused") {
  const Scratch scratch;
  const std::string path = in_folder(scratch, "weights.nc");
  const auto with_column = [&](std::int32_t column) {
    NetcdfWriter file(path);
    file.dimension("n_a", 5);
    file.dimension("n_b", 4);
    const int links = file.dimension("n_s", 2);
    const int row = file.variable("row", NetcdfType::int32, {links}),
              col = file.variable("col", NetcdfType::int32, {links}),
              weight = file.variable("S", NetcdfType::float64, {links});
    file.begin();
    const auto all = [](auto value) {
      return [value](std::int64_t begin, std::int64_t end, auto* out) {
        std::fill(out, out + (end - begin), value);
      };
    };
    file.put(row, NetcdfWriter::Fill<std::int32_t>(all(std::int32_t{2})));
    file.put(col, NetcdfWriter::Fill<std::int32_t>(all(column)));
    file.put(weight, NetcdfWriter::Fill<double>(all(0.5)));
    file.finish();
    file.commit();
  };
  with_column(5);
  CHECK(read_weights(path).weights.coeff(1, 4) == 1); // the links of a pair sum
  with_column(6);
  CHECK_THROWS_WITH_AS(read_weights(path),
                       doctest::Contains("link 0 (0-based) joins col 6 and row 2 of 5 and 4 cells"),
                       Error);
  with_column(0);
  CHECK_THROWS_AS(read_weights(path), Error);
  FieldRaster().write(path);
  CHECK_THROWS_WITH_AS(read_weights(path), doctest::Contains("give a file of weights"), Error);
}

TEST_CASE("the sea floor keeps the area and the volume of the sea") {
  const DoubleVector longitudes = DoubleVector::LinSpaced(72, 2.5, 357.5),
                     latitudes = DoubleVector::LinSpaced(36, -87.5, 87.5);
  Raster heights{longitudes, latitudes, DoubleMatrix(72, 36)};
  for (Eigen::Index j = 0; j < 36; ++j)
    for (Eigen::Index i = 0; i < 72; ++i)
      heights.values(i, j) = 3000 * std::sin(0.1 * static_cast<double>(i)) - 20 * latitudes[j];
  const LonLatBoxes boxes = lon_lat_boxes(heights);
  double area = 0, volume = 0;
  for (Eigen::Index j = 0; j < 36; ++j)
    for (Eigen::Index i = 0; i < 72; ++i)
      if (const double height = heights.values(i, j); height < 0) {
        const double radian = std::numbers::pi / 180,
                     box = radian * (boxes.meridians[i + 1] - boxes.meridians[i]) *
                           (std::sin(radian * boxes.parallels[j + 1]) -
                            std::sin(radian * boxes.parallels[j]));
        area += box;
        volume += box * height;
      }
  const Mesh mesh = delaunay(fibonacci_sphere(3000));
  const FieldGrid ocean{.name = "mesh", .mesh = {.mesh = mesh, .has_cells = true}};
  const SeaFloor floor = sea_floor(heights, ocean);
  REQUIRE(floor.fields.size() == 8);
  CHECK(floor.fields[0].name == "bed_elevation");
  const DoubleVector &bed = floor.fields[0].values, &part = floor.fields[1].values,
                     cells = voronoi(mesh).cell_area;
  CHECK((cells.array() * part.array()).sum() == doctest::Approx(area).epsilon(1e-11));
  CHECK((cells.array() * part.array() * bed.array()).sum() ==
        doctest::Approx(volume).epsilon(1e-11));
  CHECK(floor.dry == (part.array() == 0).count());
  CHECK(floor.dry > 0);
  CHECK(bed.maxCoeff() == 0);
  CHECK(part.maxCoeff() <= 1 + 1e-12);
  heights.values.setConstant(none);
  heights.values(0, 0) = -5; // a box: the rest is unknown, and counts neither as sea nor as land
  const SeaFloor known = sea_floor(heights, ocean);
  CHECK(known.fields[0].values.minCoeff() == doctest::Approx(-5));
  CHECK(known.fields[1].values.maxCoeff() == doctest::Approx(1));
  heights.of_plane = true;
  CHECK_THROWS_AS(sea_floor(heights, ocean), Error);
}

namespace {

/// A file of fields without a mesh: numbers, and the positions of the cells.
struct History {
  Points3 cells; ///< unit vectors
  std::string longitude = "lon", latitude = "lat";
  std::string units = "degrees_"; ///< "radians", "", or a start
  bool single = false;            ///< rounded to single precision

  void write(const std::string& path) const {
    NetcdfWriter file(path);
    const int n = file.dimension("nCells", cells.cols());
    const bool degrees = units == "degrees_";
    const auto add = [&](const std::string& name, const char* direction) {
      calotte::io_detail::NetcdfAttributes attributes;
      if (!units.empty())
        attributes.push_back({"units", degrees ? units + direction : units});
      return file.variable(name, NetcdfType::float64, {n}, attributes);
    };
    const int f = file.variable("f", NetcdfType::float64, {n}), lon = add(longitude, "east"),
              lat = add(latitude, "north");
    file.begin();
    const Points2 at = (degrees ? 1 : degree) * to_lonlat(cells);
    const auto put = [&](int variable, int row) {
      file.put(variable, [&](std::int64_t begin, std::int64_t end, double* out) {
        for (std::int64_t i = begin; i < end; ++i)
          *out++ = row < 0  ? static_cast<double>(i)
                   : single ? static_cast<double>(static_cast<float>(at(row, i)))
                            : at(row, i);
      });
    };
    put(f, -1);
    put(lon, 0);
    put(lat, 1);
    file.finish();
    file.commit();
  }
};

} // namespace

TEST_CASE("fields of cells in another order than the mesh's are refused") {
  const Scratch scratch;
  const std::string mesh = in_folder(scratch, "mesh.nc"), path = in_folder(scratch, "history.nc");
  write(mesh, delaunay(fibonacci_sphere(500)));
  const Points3 cells = read_mesh(mesh).points;
  const Points3 turned = cells.rowwise().reverse();
  for (const History& kind :
       {History{.cells = {}},
        {.cells = {}, .single = true},
        {.cells = {}, .longitude = "lonCell", .latitude = "latCell", .units = "radians"},
        {.cells = {}, .longitude = "lonCell", .latitude = "latCell", .units = ""}}) {
    CAPTURE(kind.longitude);
    CAPTURE(kind.units);
    History history = kind;
    history.cells = cells;
    history.write(path);
    CHECK(read_field_grid(path, mesh).size() == 500);
    history.cells.col(317) = (cells.col(317) + 1e-3 * Eigen::Vector3d(1, 2, 3)).normalized();
    history.write(path); // within its cell, as a rounded position is
    CHECK(read_field_grid(path, mesh).size() == 500);
    history.cells.col(318).swap(history.cells.col(41));
    history.write(path);
    const Error one = error_of([&] { read_field_grid(path, mesh); });
    CHECK(one.code() == ErrorCode::parse);
    CHECK(one.index() == 41);
    CHECK(has(one.what(), path + ": cell 41 is at "));
    CHECK(has(one.what(), ", and that of " + mesh + " at "));
    history.cells = turned;
    history.write(path);
    CHECK(error_of([&] { read_field_grid(path, mesh); }).index() == 0);
  }
  History other{.cells = turned, .units = "m"}; // no positions
  other.write(path);
  CHECK(read_field_grid(path, mesh).size() == 500);
  const MeshFile file = read_mesh_file(mesh);
  CHECK(first_misplaced(file, cells) == -1);
  Points3 some = turned;
  some.leftCols(250).setConstant(none); // unknown
  CHECK(first_misplaced(file, some) == 250);
  CHECK_THROWS_AS(first_misplaced(file, cells.leftCols(3)), Error);
}
