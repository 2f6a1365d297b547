// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/projection.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/field_grid.h>
#include <calotte/generators.h>
#include <calotte/remap.h>

#include <doctest/doctest.h>
#include <netcdf.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using calotte::io_detail::NetcdfReader;
using calotte::io_detail::Projection;

namespace {

using Numbers = std::vector<std::pair<std::string, std::vector<double>>>;

const Numbers wgs84{{"semi_major_axis", {6378137}}, {"inverse_flattening", {298.257223563}}},
    greenland{{"latitude_of_projection_origin", {90}},
              {"standard_parallel", {70}},
              {"straight_vertical_longitude_from_pole", {-45}}};

Numbers antarctic(double parallel) {
  return {{"latitude_of_projection_origin", {-90}},
          {"standard_parallel", {parallel}},
          {"straight_vertical_longitude_from_pole", {0}}};
}

/// A raster of a projection with a field of j + 10 i at the node j of y and i of x.
struct ProjectedRaster {
  std::string mapping = "polar_stereographic";
  Numbers numbers = greenland;
  std::vector<double> x{-300e3, -100e3, 100e3, 300e3}, y{-900e3, -1000e3, -1100e3};
  std::string unit = "m";
  bool x_first = false;
  int format = NC_NETCDF4;

  void write(const std::string& path) const {
    int file = 0, dims[2], variables[2], crs = 0, field = 0;
    REQUIRE(nc_create(path.c_str(), format | NC_CLOBBER, &file) == NC_NOERR);
    const auto text = [&](int variable, const char* name, const std::string& value) {
      REQUIRE(nc_put_att_text(file, variable, name, value.size(), value.c_str()) == NC_NOERR);
    };
    for (int k = 0; k < 2; ++k) {
      const std::vector<double>& nodes = k == 0 ? x : y;
      nc_def_dim(file, k == 0 ? "x" : "y", nodes.size(), dims + k);
      nc_def_var(file, k == 0 ? "x" : "y", NC_DOUBLE, 1, dims + k, variables + k);
      text(variables[k], "units", unit);
      text(variables[k], "standard_name",
           k == 0 ? "projection_x_coordinate" : "projection_y_coordinate");
    }
    nc_def_var(file, "crs", NC_INT, 0, nullptr, &crs);
    text(crs, "grid_mapping_name", mapping);
    for (const auto& [name, values] : numbers)
      nc_put_att_double(file, crs, name.c_str(), NC_DOUBLE, values.size(), values.data());
    const int order[2] = {dims[x_first ? 0 : 1], dims[x_first ? 1 : 0]};
    nc_def_var(file, "bed", NC_DOUBLE, 2, order, &field);
    text(field, "grid_mapping", "crs");
    nc_enddef(file);
    nc_put_var_double(file, variables[0], x.data());
    nc_put_var_double(file, variables[1], y.data());
    std::vector<double> values(x.size() * y.size());
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size(); ++i)
        values[x_first ? i * y.size() + j : j * x.size() + i] =
            static_cast<double>(j) + 10 * static_cast<double>(i);
    nc_put_var_double(file, field, values.data());
    REQUIRE(nc_close(file) == NC_NOERR);
  }
};

/// Adds the categories `mask` and `t` at two times, without values at the node 3 of y and time 0.
void add_fields(const std::string& path, std::size_t columns, std::size_t rows) {
  int file = 0, dims[3], mask = 0, t = 0;
  REQUIRE(nc_open(path.c_str(), NC_WRITE, &file) == NC_NOERR);
  REQUIRE(nc_redef(file) == NC_NOERR);
  nc_def_dim(file, "time", 2, dims);
  nc_inq_dimid(file, "y", dims + 1);
  nc_inq_dimid(file, "x", dims + 2);
  nc_def_var(file, "mask", NC_BYTE, 2, dims + 1, &mask);
  nc_def_var(file, "t", NC_FLOAT, 3, dims, &t);
  const float none = -9;
  nc_put_att_float(file, t, "_FillValue", NC_FLOAT, 1, &none);
  nc_enddef(file);
  const std::size_t n = rows * columns;
  std::vector<signed char> kinds(n);
  std::vector<float> values(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    kinds[i] = static_cast<signed char>(i * i % 5);
    values[i] = i / columns == 3 ? none : static_cast<float>(i);
    values[n + i] = static_cast<float>(n + i);
  }
  nc_put_var_schar(file, mask, kinds.data());
  nc_put_var_float(file, t, values.data());
  REQUIRE(nc_close(file) == NC_NOERR);
}

/// Adds two-dimensional longitudes and latitudes of `bed`.
void add_coordinates(const std::string& path, std::size_t columns, std::size_t rows) {
  int file = 0, dims[2], lon = 0, lat = 0, field = 0;
  REQUIRE(nc_open(path.c_str(), NC_WRITE, &file) == NC_NOERR);
  REQUIRE(nc_redef(file) == NC_NOERR);
  nc_inq_dimid(file, "y", dims);
  nc_inq_dimid(file, "x", dims + 1);
  nc_inq_varid(file, "bed", &field);
  nc_def_var(file, "lon", NC_DOUBLE, 2, dims, &lon);
  nc_def_var(file, "lat", NC_DOUBLE, 2, dims, &lat);
  nc_put_att_text(file, lon, "units", 12, "degrees_east");
  nc_put_att_text(file, lat, "units", 13, "degrees_north");
  nc_put_att_text(file, field, "coordinates", 7, "lon lat");
  nc_enddef(file);
  std::vector<double> longitudes, latitudes;
  for (std::size_t k = 0; k < rows * columns; ++k) {
    longitudes.push_back(static_cast<double>(k % columns));
    latitudes.push_back(50 + static_cast<double>(k / columns));
  }
  nc_put_var_double(file, lon, longitudes.data());
  nc_put_var_double(file, lat, latitudes.data());
  REQUIRE(nc_close(file) == NC_NOERR);
}

} // namespace

TEST_CASE("projections have the longitudes and latitudes of PROJ") {
  struct Case {
    std::string mapping;
    Numbers numbers;
    bool earth; // WGS 84
    double x, y, longitude, latitude;
  };
  const Scratch scratch;
  for (const Case& c : {
           Case{"polar_stereographic", greenland, true, -600e3, -2500e3, -58.495733280796,
                66.584707215025},
           Case{"polar_stereographic", antarctic(-71), true, 1234567, -987654, 128.659819573507,
                -75.523253590789},
           Case{"polar_stereographic", antarctic(71), true, 1234567, -987654, 128.659819573507,
                -75.523253590789}, // the parallel without its sign
           Case{"lambert_conformal_conic",
                {{"standard_parallel", {33, 45}},
                 {"longitude_of_central_meridian", {-97}},
                 {"latitude_of_projection_origin", {40}}},
                true,
                -1.5e6,
                7e5,
                -116.133311955377,
                44.891474494606},
           Case{"lambert_conformal_conic",
                {{"standard_parallel", {-35}},
                 {"longitude_of_central_meridian", {140}},
                 {"latitude_of_projection_origin", {-35}},
                 {"earth_radius", {6371229}}},
                false,
                9e5,
                -6e5,
                150.538712408139,
                -39.962085255924},
           Case{"lambert_azimuthal_equal_area",
                {{"longitude_of_projection_origin", {10}},
                 {"latitude_of_projection_origin", {52}},
                 {"false_easting", {4321000}},
                 {"false_northing", {3210000}}},
                true,
                3.2e6,
                4.5e6,
                -11.732588507142,
                62.026550012888},
           Case{"lambert_azimuthal_equal_area",
                {{"longitude_of_projection_origin", {0}}, {"latitude_of_projection_origin", {90}}},
                true,
                -3e6,
                2e6,
                -123.690067525980,
                57.242294235020},
           Case{"lambert_azimuthal_equal_area",
                {{"longitude_of_projection_origin", {0}}, {"latitude_of_projection_origin", {-90}}},
                true,
                2.5e6,
                1.5e6,
                59.036243467926,
                -63.648361111598},
           Case{"rotated_latitude_longitude",
                {{"grid_north_pole_latitude", {39.25}}, {"grid_north_pole_longitude", {-162}}},
                false,
                -28,
                -23,
                -9.881884094042,
                22.468521803315},
       }) {
    CAPTURE(c.mapping);
    CAPTURE(c.x);
    ProjectedRaster raster{.mapping = c.mapping, .numbers = c.numbers};
    if (c.earth)
      raster.numbers.insert(raster.numbers.end(), wgs84.begin(), wgs84.end());
    raster.write(scratch / "a.nc");
    const NetcdfReader file(scratch / "a.nc");
    const auto [longitude, latitude] = Projection(file, "crs").lonlat(c.x, c.y);
    CHECK(std::abs(longitude - c.longitude) < 2e-8);
    CHECK(std::abs(latitude - c.latitude) < 2e-8);
  }
}

TEST_CASE("cells of a projection keep integrals, in any order of their axes") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  const FieldGrid target = *raster_of("60x30");
  const auto integral_of = [&](const ProjectedRaster& raster) {
    raster.write(path);
    const FieldGrid grid = read_field_grid(path);
    CHECK(grid.size() == 12);
    REQUIRE(grid.fields.size() == 1);
    CHECK(grid.fields[0].name == "bed");
    const GridWeights weights = conservative_weights(cells_of(grid), *target.boxes);
    CHECK(std::abs(weights.source_fraction.maxCoeff() - 1) < 1e-12);
    CHECK(std::abs(weights.source_fraction.minCoeff() - 1) < 1e-12);
    const double before = grid.fields[0].values.dot(weights.source_area);
    const DoubleVector values = weights.weights * grid.fields[0].values;
    const double after =
        (values.array() * weights.target_fraction.array() * weights.target_area.array()).sum();
    CHECK(std::abs(after / before - 1) < 1e-12);
    return before;
  };
  const ProjectedRaster usual;
  const double expected = integral_of(usual);
  CHECK(std::abs(integral_of({.x_first = true}) / expected - 1) < 1e-14);
  Numbers shifted = greenland;
  shifted.insert(shifted.end(), {{"false_easting", {500}}, {"false_northing", {-200}}});
  CHECK(std::abs(integral_of({.numbers = shifted,
                              .x = {200, 400, 600, 800},
                              .y = {-1100, -1200, -1300},
                              .unit = "km"}) /
                     expected -
                 1) < 1e-12);
  CHECK(
      std::abs(integral_of({.x = {-300, -100, 100, 300}, .y = {-900, -1000, -1100}, .unit = "km"}) /
                   expected -
               1) < 1e-12);
  // The area of a square of 200 x 100 km there, by the scale of the projection.
  usual.write(path);
  const Polygons cells = cells_of(read_field_grid(path));
  const DoubleVector areas = calotte::areas(cells);
  CHECK(areas.minCoeff() > 0);
  CHECK(std::abs(areas[0] * 6371e3 * 6371e3 / (200e3 * 100e3) - 1) < 0.08);
}

TEST_CASE("a raster that is read in parts gives what it gives as a whole") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  ProjectedRaster raster;
  raster.x.clear(), raster.y.clear();
  for (int i = 0; i < 24; ++i)
    raster.x.push_back(-575e3 + 50e3 * i);
  for (int j = 0; j < 17; ++j)
    raster.y.push_back(-900e3 - 60e3 * j);
  const FieldGrid boxes = *raster_of("360x180");
  FieldGrid mesh{.name = "mesh"};
  mesh.mesh.mesh = delaunay(fibonacci_sphere(20000));
  FieldGrid masked = mesh;
  masked.mask = Ids::Ones(20000);
  masked.mask.head(200).setZero();
  for (const int format : {NC_NETCDF4, NC_64BIT_OFFSET})
    for (const bool x_first : {false, true}) {
      raster.format = format, raster.x_first = x_first;
      raster.write(path);
      add_fields(path, raster.x.size(), raster.y.size());
      const FieldGrid whole = read_field_grid(path);
      REQUIRE(whole.fields.size() == 3);
      CHECK(whole.fields[1].integer);
      CHECK(whole.fields[2].values.array().isNaN().count() == 24);
      CHECK(FieldParts(path).count() == 1);
      CHECK(FieldParts(path, {}, 1).count() == 17);
      const FieldParts parts(path, {}, 100);
      CHECK(parts.count() == 6); // of 3 rows: a cell has 4 numbers
      std::int64_t cells = 0;
      for (std::int64_t k = 0; k < parts.count(); ++k) {
        const FieldGrid part = parts.read(k, {{"mask"}});
        REQUIRE(part.fields.size() == 1);
        CHECK(part.fields[0].values == whole.fields[1].values.segment(cells, part.size()));
        cells += part.size();
      }
      CHECK(cells == whole.size());
      for (const FieldGrid& target : {boxes, mesh, masked}) {
        const GridWeights weights =
            interpolation_weights(whole, target, Interpolation::conservative);
        for (const double min_cover : {0.0, 0.7}) {
          const CoveredFields found = interpolate_parts(parts, whole.fields, target, min_cover);
          CHECK((found.target_fraction - weights.target_fraction).cwiseAbs().maxCoeff() < 1e-13);
          for (std::size_t f = 0; f < 3; ++f) {
            CAPTURE(whole.fields[f].name);
            const MeshField expected = interpolate(weights, whole.fields[f], min_cover);
            CHECK(found.fields[f].name == expected.name);
            CHECK(found.fields[f].integer == expected.integer);
            REQUIRE(found.fields[f].values.size() == expected.values.size());
            std::int64_t known = 0;
            for (Eigen::Index i = 0; i < expected.values.size(); ++i) {
              const double a = found.fields[f].values[i], b = expected.values[i];
              CHECK(std::isnan(a) == std::isnan(b));
              CHECK_FALSE(std::abs(a - b) > 1e-11 * (1 + std::abs(b)));
              known += std::isnan(b) ? 0 : 1;
            }
            CHECK(known > 20);
          }
        }
      }
    }
  const FieldParts at(path, {{"time", 1}}, 100);
  CHECK(at.read(1, {{"bed"}}).fields.size() == 1); // the choice belongs to another field
  const FieldGrid first = at.read(0, {{"t"}});
  CHECK(first.fields[0].count() == 1);
  CHECK(first.fields[0].values[1] == doctest::Approx(1 + 24 * 17));
  CHECK(has(error_of([&] {
              FieldParts(path, {{"depth", 1}}, 100).read(0);
            }).what(),
            "no field has a dimension depth"));
  CHECK(has(error_of([&] { at.read(6); }).what(), "there is no part 6; give 0 to 5"));
  CHECK(has(error_of([&] { interpolate_parts(at, {MeshField{.name = "u"}}, mesh); }).what(),
            "has no field u at cells"));
}

TEST_CASE("grid mappings that cannot be read are named") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  const auto refusal = [&](const ProjectedRaster& raster) -> std::string {
    raster.write(path);
    return error_of([&] { read_field_grid(path); }).what();
  };
  CHECK(has(refusal({.mapping = "transverse_mercator"}), "gdalwarp -t_srs EPSG:4326"));
  CHECK(has(refusal({.numbers = {}}), "it has no latitude_of_projection_origin; add it"));
  CHECK(has(refusal({.numbers = {{"latitude_of_projection_origin", {45}},
                                 {"straight_vertical_longitude_from_pole", {0}}}}),
            "is 45; give 90 or -90"));
  CHECK(has(refusal({.x = {0, 1, 1}}), "x[2] does not ascend or descend"));
  CHECK(has(refusal({.x = {0, NAN, 1}}), "x[1] does not"));
  CHECK(has(refusal({.x = {5}}), "x has 1 values; give two nodes or more"));
  CHECK(has(refusal({.unit = "degrees"}), "a.nc: x has the unit degrees, which is no length"));
  CHECK(has(refusal({.mapping = "lambert_azimuthal_equal_area",
                     .numbers = {{"longitude_of_projection_origin", {0}},
                                 {"latitude_of_projection_origin", {90}}},
                     .x = {-2e7, 2e7}}),
            "outside of what the projection shows"));
  CHECK(has(refusal({.mapping = "lambert_conformal_conic",
                     .numbers = {{"standard_parallel", {50}},
                                 {"longitude_of_central_meridian", {0}},
                                 {"latitude_of_projection_origin", {50}}},
                     .y = {5e6, 6e6, 7e6}}),
            "outside of what the projection shows"));
  CHECK(has(refusal({.mapping = "rotated_latitude_longitude",
                     .numbers = {{"grid_north_pole_latitude", {39.25}},
                                 {"grid_north_pole_longitude", {-162}}},
                     .x = {0, 120, 240, 360},
                     .y = {0, 1, 2},
                     .unit = "degrees"}),
            "x goes round more than once, by 480 degrees"));
  ProjectedRaster().write(path);
  add_coordinates(path, 4, 3); // no fields of a mapping that is read
  CHECK(read_field_grid(path).fields.size() == 1);
  CHECK(has(refusal({.mapping = "transverse_mercator"}), "gdalwarp"));
  add_coordinates(path, 4, 3); // which serve then
  const FieldGrid grid = read_field_grid(path);
  CHECK(grid.size() == 12);
  REQUIRE(grid.fields.size() == 1);
  CHECK(grid.fields[0].values[1] == 10);
  CHECK((grid.mesh.polygons->corners.row(2).array() > 0).all());
  CHECK(FieldParts(path, {}, 4).count() == 1);
}

namespace {

/// A raster of two-dimensional coordinates, degrees, with a field of 1 at all cells.
void write_curvilinear(
    const std::string& path, std::size_t rows, std::size_t columns,
    const std::function<std::pair<double, double>(std::size_t, std::size_t)>& at) {
  int file = 0, dims[2], lon = 0, lat = 0, field = 0;
  REQUIRE(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file) == NC_NOERR);
  nc_def_dim(file, "j", rows, dims);
  nc_def_dim(file, "i", columns, dims + 1);
  nc_def_var(file, "nav_lon", NC_DOUBLE, 2, dims, &lon);
  nc_def_var(file, "nav_lat", NC_DOUBLE, 2, dims, &lat);
  nc_def_var(file, "f", NC_DOUBLE, 2, dims, &field);
  nc_put_att_text(file, lon, "units", 12, "degrees_east");
  nc_put_att_text(file, lat, "units", 13, "degrees_north");
  nc_put_att_text(file, field, "coordinates", 15, "nav_lon nav_lat");
  nc_enddef(file);
  std::vector<double> longitudes, latitudes;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      longitudes.push_back(at(j, i).first);
      latitudes.push_back(at(j, i).second);
    }
  const std::vector<double> ones(rows * columns, 1);
  nc_put_var_double(file, lon, longitudes.data());
  nc_put_var_double(file, lat, latitudes.data());
  nc_put_var_double(file, field, ones.data());
  REQUIRE(nc_close(file) == NC_NOERR);
}

} // namespace

TEST_CASE("cells of two-dimensional coordinates close round the sphere and do not overlap") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  const auto usual = [](std::size_t j, std::size_t i) {
    return std::pair(10.0 * static_cast<double>(i), -85 + 10.0 * static_cast<double>(j));
  };
  const auto area_of = [&] {
    const FieldGrid grid = read_field_grid(path);
    REQUIRE(grid.fields.size() == 1);
    const GridWeights weights = conservative_weights(cells_of(grid), *raster_of("60x30")->boxes);
    CHECK(std::abs(weights.source_fraction.minCoeff() - 1) < 1e-12);
    CHECK(std::abs(weights.source_fraction.maxCoeff() - 1) < 1e-12);
    CHECK(weights.source_area.minCoeff() > 0);
    return weights.source_area.sum();
  };
  write_curvilinear(path, 18, 36, usual);
  CHECK(std::abs(area_of() / (4 * std::numbers::pi) - 1) < 1e-3); // open at the poles by rounding
  write_curvilinear(path, 19, 36, [&](std::size_t j, std::size_t i) { // nodes at both poles
    return std::pair(10.0 * static_cast<double>(i), -90 + 10.0 * static_cast<double>(j));
  });
  CHECK(std::abs(area_of() / (4 * std::numbers::pi) - 1) < 1e-12);
  write_curvilinear(path, 18, 36, [&](std::size_t j, std::size_t i) { // half a step is too long
    return std::pair(10.0 * static_cast<double>(i), -89 + 178.0 / 17 * static_cast<double>(j));
  });
  CHECK(std::abs(area_of() / (4 * std::numbers::pi) - 1) < 1e-12);
  write_curvilinear(path, 9, 20, [&](std::size_t j, std::size_t i) { return usual(13 - j, i); });
  const double sines =
      std::sin(std::numbers::pi / 180 * 50) - std::sin(-std::numbers::pi / 180 * 40);
  CHECK(std::abs(area_of() / (200 * std::numbers::pi / 180 * sines) - 1) < 0.02);

  const auto refusal = [&] { return std::string(error_of([&] { read_field_grid(path); }).what()); };
  write_curvilinear(path, 18, 38, usual);
  CHECK(has(refusal(), "column 36 of nav_lon repeats column 0"));
  write_curvilinear(path, 3, 4, [&](std::size_t j, std::size_t i) {
    return std::pair(usual(j, i).first, j == 1 && i == 2 ? NAN : usual(j, i).second);
  });
  CHECK(has(refusal(), "nav_lon[1, 2] and nav_lat there are no longitude and latitude"));
  write_curvilinear(path, 2, 2, [&](std::size_t, std::size_t i) {
    return std::pair(i % 2 == 0 ? 0.0 : 180.0, 0.0);
  });
  CHECK(has(refusal(), "are opposite each other; give a raster of narrower cells"));
  write_curvilinear(path, 1, 4, usual);
  CHECK(has(refusal(), "give two rows and columns or more"));
}
