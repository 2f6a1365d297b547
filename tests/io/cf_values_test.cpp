// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/cf_values.h"
#include "support/files.h"
#include "support/random.h"
#include "support/spoilt_files.h"

#include <calotte/field_grid.h>
#include <calotte/read.h>

#include <doctest/doctest.h>
#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

// What numbers mean by their attributes, and rasters in any order of their dimensions.

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A file that is written with the C library.
class Written {
public:
  explicit Written(const std::string& path, int format = NC_CLOBBER | NC_NETCDF4) {
    require(nc_create(path.c_str(), format, &id_));
  }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  ~Written() { nc_close(id_); }

  int dimension(const std::string& name, std::size_t size) const {
    int d = -1;
    require(nc_def_dim(id_, name.c_str(), size, &d));
    return d;
  }
  int variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) const {
    int v = -1;
    require(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()),
                       dimensions.data(), &v));
    return v;
  }
  void numbers(int v, const std::string& name, nc_type type,
               const std::vector<double>& values) const {
    require(nc_put_att_double(id_, v, name.c_str(), type, values.size(), values.data()));
  }
  void text(int v, const std::string& name, const std::string& value) const {
    require(nc_put_att_text(id_, v, name.c_str(), value.size(), value.data()));
  }
  void put(int v, const std::vector<double>& values) const {
    nc_enddef(id_);
    require(nc_put_var_double(id_, v, values.data()));
    nc_redef(id_);
  }

private:
  int id_ = -1;
};

std::vector<double> numbers_of(const std::string& path, const std::string& name) {
  const io_detail::NetcdfReader file(path);
  return io_detail::cf_values(file, name, file.shape_of(name));
}

void check_same(const std::vector<double>& got, const std::vector<double>& wanted) {
  REQUIRE(got.size() == wanted.size());
  for (std::size_t k = 0; k < got.size(); ++k)
    CHECK((std::isnan(wanted[k]) ? std::isnan(got[k])
                                 : std::abs(got[k] - wanted[k]) <= 1e-12 * std::abs(wanted[k])));
}

/// Longitudes and latitudes of a raster.
void put_axes(const Written& file, int lon, int lat, const std::vector<double>& longitudes,
              const std::vector<double>& latitudes) {
  const int x = file.variable("lon", NC_DOUBLE, {lon}), y = file.variable("lat", NC_DOUBLE, {lat});
  file.put(x, longitudes);
  file.put(y, latitudes);
}

} // namespace

TEST_CASE("numbers are what their attributes say") {
  const Scratch scratch;
  const std::string path = scratch / "numbers.nc";
  {
    const Written file(path);
    const int n = file.dimension("n", 6);
    const int packed = file.variable("packed", NC_SHORT, {n});
    file.numbers(packed, "scale_factor", NC_DOUBLE, {10});
    file.numbers(packed, "add_offset", NC_DOUBLE, {5});
    file.numbers(packed, "_FillValue", NC_SHORT, {7});
    file.put(packed, {7, 0, 1, -3, 30, 2});
    const int bytes = file.variable("bytes", NC_BYTE, {n});
    file.text(bytes, "_Unsigned", "true");
    file.numbers(bytes, "valid_max", NC_BYTE, {-6}); // 250
    file.put(bytes, {-56, 1, -1, -6, 127, -128});
    const int shorts = file.variable("shorts", NC_SHORT, {n});
    file.text(shorts, "_Unsigned", "true");
    file.numbers(shorts, "_FillValue", NC_SHORT, {-1});
    file.numbers(shorts, "scale_factor", NC_FLOAT, {0.5});
    file.put(shorts, {-1, -2, 4, 0, -32768, 8});
    const int floats = file.variable("floats", NC_FLOAT, {n});
    file.numbers(floats, "missing_value", NC_FLOAT, {-999, 1e20});
    file.numbers(floats, "valid_range", NC_FLOAT, {-10, 10});
    file.put(floats, {-999, 1e20, 3, -10, 10.5, NC_FILL_FLOAT});
    const int doubles = file.variable("doubles", NC_DOUBLE, {n});
    file.numbers(doubles, "valid_min", NC_DOUBLE, {0});
    file.put(doubles, {-1, 0, 2, NC_FILL_DOUBLE, 9e36, 5});
    const int ints = file.variable("ints", NC_INT, {n});
    file.put(ints, {NC_FILL_INT, 1, 2, 3, -4, 5});
    const int plain = file.variable("plain", NC_BYTE, {n});
    file.put(plain, {-127, -128, 0, 1, 2, 127}); // bytes have no fill of their own
  }
  check_same(numbers_of(path, "packed"), {none, 5, 15, -25, 305, 25});
  check_same(numbers_of(path, "bytes"), {200, 1, none, 250, 127, 128});
  check_same(numbers_of(path, "shorts"), {none, 32767, 2, 0, 16384, 4});
  check_same(numbers_of(path, "floats"), {none, none, 3, -10, none, none});
  check_same(numbers_of(path, "doubles"), {none, 0, 2, none, 9e36, 5});
  check_same(numbers_of(path, "ints"), {none, 1, 2, 3, -4, 5});
  check_same(numbers_of(path, "plain"), {-127, -128, 0, 1, 2, 127});
}

TEST_CASE("a raster's fields have their values in any order of the dimensions") {
  const Scratch scratch;
  Random random(3);
  const std::vector<std::string> names{"time", "lat", "lon", "lev"};
  std::vector<std::size_t> order{0, 1, 2, 3};
  const std::vector<std::size_t> sizes{2, 5, 7, 3};
  do {
    const std::string path = scratch / "raster.nc";
    {
      const Written file(path);
      std::vector<int> ids, of_field;
      for (std::size_t d = 0; d < 4; ++d)
        ids.push_back(file.dimension(names[d], sizes[d]));
      put_axes(file, ids[2], ids[1], {0, 50, 100, 150, 200, 250, 300}, {-72, -36, 0, 36, 72});
      for (const std::size_t d : order)
        of_field.push_back(ids[d]);
      std::vector<double> values;
      std::vector<std::size_t> at(4);
      for (std::size_t k = 0; k < 210; ++k) {
        std::size_t rest = k;
        for (std::size_t d = 4; d-- > 0;) {
          at[order[d]] = rest % sizes[order[d]];
          rest /= sizes[order[d]];
        }
        values.push_back(static_cast<double>(1000 * at[0] + 100 * at[1] + 10 * at[2] + at[3]));
      }
      file.put(file.variable("t", NC_DOUBLE, of_field), values);
    }
    const FieldGrid grid = read_field_grid(path);
    REQUIRE(grid.fields.size() == 1);
    const MeshField& field = grid.fields.front();
    REQUIRE(field.count() == 6);
    const bool time_first = field.dimensions.front().name == "time";
    int wrong = 0;
    for (Eigen::Index box = 0; box < 35; ++box)
      for (Eigen::Index k = 0; k < 6; ++k) {
        const Eigen::Index time = time_first ? k / 3 : k % 2, level = time_first ? k % 3 : k / 2;
        wrong += field.values[6 * box + k] !=
                 static_cast<double>(1000 * time + 100 * (box / 7) + 10 * (box % 7) + level);
      }
    CHECK(wrong == 0);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("heights and depths of a file, in metres or kilometres, in either order") {
  const Scratch scratch;
  const auto heights = [&](const std::vector<std::pair<std::string, std::string>>& attributes,
                           double scale, bool transposed) {
    const std::string path = scratch / "heights.nc";
    {
      const Written file(path);
      const int lat = file.dimension("lat", 2), lon = file.dimension("lon", 3);
      put_axes(file, lon, lat, {0, 120, 240}, {-45, 45});
      const int z =
          file.variable("z", NC_DOUBLE, transposed ? std::vector{lon, lat} : std::vector{lat, lon});
      for (const auto& [name, value] : attributes)
        file.text(z, name, value);
      std::vector<double> values;
      for (int k = 0; k < 6; ++k)
        values.push_back(scale * (transposed ? 10 * (k % 2) + k / 2 : 10 * (k / 3) + k % 3));
      file.put(z, values);
    }
    return read_heights(path).heights;
  };
  const DoubleMatrix metres = heights({{"units", "m"}}, 1, false);
  CHECK(metres(2, 1) == 12);
  CHECK(heights({}, 1, true) == metres);
  CHECK(heights({{"units", "km"}}, 0.001, false).isApprox(metres));
  CHECK(heights({{"units", "meters"}, {"positive", "down"}}, -1, true) == metres);
  CHECK(heights({{"standard_name", "sea_floor_depth_below_geoid"}}, -1, false) == metres);
  CHECK(heights({{"standard_name", "sea_floor_depth_below_geoid"}, {"positive", "up"}}, 1, false) ==
        metres);
  CHECK_THROWS_WITH_AS(heights({{"units", "feet"}}, 1, false),
                       doctest::Contains("\"feet\" is not one of heights; give m or km"), Error);
}

TEST_CASE("masked cells give nothing and get nothing, by all methods") {
  const Scratch scratch;
  const std::string path = scratch / "grid.nc";
  const auto boxes = [&](int columns, int rows, const std::vector<double>& mask) {
    {
      const Written file(path);
      const int size = file.dimension("grid_size", static_cast<std::size_t>(columns * rows)),
                corners = file.dimension("grid_corners", 4), rank = file.dimension("grid_rank", 1);
      std::vector<double> lon, lat, x, y;
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
          const double west = 360.0 * i / columns, east = 360.0 * (i + 1) / columns,
                       south = 180.0 * j / rows - 90, north = 180.0 * (j + 1) / rows - 90;
          lon.insert(lon.end(), {west, east, east, west});
          lat.insert(lat.end(), {south, south, north, north});
          x.push_back((west + east) / 2);
          y.push_back((south + north) / 2);
        }
      const auto put = [&](const std::string& name, const std::vector<int>& dimensions,
                           const std::vector<double>& values, nc_type type = NC_DOUBLE) {
        const int v = file.variable(name, type, dimensions);
        file.text(v, "units", "degrees");
        file.put(v, values);
      };
      put("grid_dims", {rank}, {static_cast<double>(columns * rows)}, NC_INT);
      put("grid_center_lon", {size}, x);
      put("grid_center_lat", {size}, y);
      put("grid_corner_lon", {size, corners}, lon);
      put("grid_corner_lat", {size, corners}, lat);
      put("grid_imask", {size}, mask, NC_INT);
      std::vector<double> values;
      for (const double counts : mask)
        values.push_back(counts != 0 ? 1 : 1e20);
      const int v = file.variable("sst", NC_DOUBLE, {size});
      file.put(v, values);
    }
    return read_field_grid(path);
  };
  std::vector<double> land(72, 1), coarse(18, 1);
  for (const std::size_t k : {0, 1, 13, 30, 31, 32, 60})
    land[k] = 0;
  coarse[7] = 0;
  const FieldGrid source = boxes(12, 6, land);
  REQUIRE(source.mask.size() == 72);
  CHECK(source.mask.sum() == 65);
  CHECK(source.fields.size() == 1);
  const FieldGrid target = boxes(6, 3, coarse);
  for (const Interpolation kind :
       {Interpolation::conservative, Interpolation::linear, Interpolation::nearest}) {
    const GridWeights weights = interpolation_weights(source, target, kind);
    for (Eigen::Index row = 0; row < 18; ++row) {
      double sum = 0;
      for (Weights::InnerIterator entry(weights.weights, row); entry; ++entry) {
        CHECK(source.mask[entry.col()] == 1);
        sum += entry.value();
      }
      CHECK((row == 7 ? sum == 0 : sum == 0 || std::abs(sum - 1) < 1e-14));
      CHECK((sum > 0) == (weights.target_fraction[row] > 0));
    }
    if (kind != Interpolation::conservative)
      continue;
    // What is shared is the same seen from both sides.
    CHECK(std::abs(weights.source_fraction.dot(weights.source_area) -
                   weights.target_fraction.dot(weights.target_area)) < 1e-12);
    CHECK(weights.source_fraction[13] == 0);
    const MeshField field = interpolate(weights, source.fields.front());
    for (Eigen::Index row = 0; row < 18; ++row)
      CHECK((std::isnan(field.values[row]) ? row == 7 : std::abs(field.values[row] - 1) < 1e-14));
  }
}
