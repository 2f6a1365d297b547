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
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
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
    std::vector<std::size_t> start, count; // of records as many as there are values
    int rank = 0;
    require(nc_inq_varndims(id_, v, &rank));
    std::vector<int> dimensions(static_cast<std::size_t>(rank));
    require(nc_inq_vardimid(id_, v, dimensions.data()));
    int records = -1;
    nc_inq_unlimdim(id_, &records);
    std::size_t rest = values.size();
    for (const int dimension : dimensions) {
      std::size_t size = 0;
      require(nc_inq_dimlen(id_, dimension, &size));
      start.push_back(0);
      count.push_back(dimension == records ? 0 : size);
      rest /= dimension == records ? 1 : size;
    }
    std::replace(count.begin(), count.end(), std::size_t{0}, rest);
    require(nc_put_vara_double(id_, v, start.data(), count.data(), values.data()));
    nc_redef(id_);
  }
  void group(const std::string& name) const {
    int g = -1;
    require(nc_def_grp(id_, name.c_str(), &g));
  }
  void put_text(int v, const std::string& letters) const {
    nc_enddef(id_);
    const std::array<std::size_t, 2> start{0, 0}, count{3, 5};
    require(nc_put_vara_text(id_, v, start.data(), count.data(), letters.data()));
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

/// Cells of 5 rows and 7 columns that are no boxes of longitude and latitude.
void put_skewed_cells(const Written& file, int j, int i) {
  const int corner = file.dimension("vertices", 4);
  const auto put = [&](const std::string& name, const std::string& units, const auto& at) {
    const int centres = file.variable(name, NC_DOUBLE, {j, i}),
              corners = file.variable(name + "_v", NC_DOUBLE, {j, i, corner});
    file.text(centres, "units", units);
    file.text(centres, "bounds", name + "_v");
    std::vector<double> of_centres, of_corners;
    for (int row = 0; row < 5; ++row)
      for (int column = 0; column < 7; ++column) {
        of_centres.push_back(at(row, column));
        for (const auto& [up, right] :
             {std::pair(-0.5, -0.5), {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}})
          of_corners.push_back(at(row + up, column + right));
      }
    file.put(centres, of_centres);
    file.put(corners, of_corners);
  };
  put("lat", "degrees_north", [](double row, double column) { return 30 * (row - 2) + column; });
  put("lon", "degrees_east", [](double row, double column) { return 40 * column + 5 * row; });
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

TEST_CASE("fields of rasters and of curvilinear cells have their values in any order of the "
          "dimensions") {
  const Scratch scratch;
  std::vector<std::size_t> order{0, 1, 2, 3};
  const std::vector<std::size_t> sizes{2, 5, 7, 3};
  for (const bool raster : {true, false})
    do {
      const std::vector<std::string> names{"time", raster ? "lat" : "j", raster ? "lon" : "i",
                                           "lev"};
      const std::string path = scratch / "raster.nc";
      {
        const Written file(path);
        std::vector<int> ids, of_field;
        for (std::size_t d = 0; d < 4; ++d)
          ids.push_back(file.dimension(names[d], sizes[d]));
        if (raster)
          put_axes(file, ids[2], ids[1], {0, 50, 100, 150, 200, 250, 300}, {-72, -36, 0, 36, 72});
        else
          put_skewed_cells(file, ids[1], ids[2]);
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
      REQUIRE(grid.size() == 35);
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

TEST_CASE("what a file says of times, levels and members goes along with its fields, to the bit") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Scratch scratch;
    const std::string path = scratch / "from.nc", copy = scratch / "to.nc";
    const bool classic = random.integer(0, 1) == 0, records = random.integer(0, 2) > 0;
    const nc_type type =
        std::vector{NC_FLOAT, NC_DOUBLE, NC_INT}[static_cast<std::size_t>(random.integer(0, 2))];
    std::vector<std::string> others, carried{"time_bnds", "xtime", "height", "scale", "lev_a"};
    {
      const Written file(path, classic ? NC_CLOBBER : NC_CLOBBER | NC_NETCDF4);
      const int time = file.dimension("time", records ? NC_UNLIMITED : 3),
                lat = file.dimension("lat", 3), lon = file.dimension("lon", 4),
                lev = file.dimension("lev", 2), member = file.dimension("member", 2),
                bounds = file.dimension("bnds", 2), letters = file.dimension("letters", 5);
      put_axes(file, lon, lat, {0, 90, 180, 270}, {-60, 0, 60});
      const int t = file.variable("time", NC_DOUBLE, {time}),
                tb = file.variable("time_bnds", NC_FLOAT, {time, bounds}),
                x = file.variable("xtime", NC_CHAR, {time, letters}),
                l = file.variable("lev", NC_FLOAT, {lev}),
                a = file.variable("lev_a", NC_INT, {lev}),
                h = file.variable("height", NC_DOUBLE, {}),
                s = file.variable("scale", NC_SHORT, {}),
                area = file.variable("area", NC_DOUBLE, {lat, lon});
      file.text(t, "units", "days since 1850-01-01");
      file.text(t, "bounds", "time_bnds");
      file.text(l, "formula_terms", "a: lev_a p0: scale ps: f");
      std::vector<int> dimensions{lat, lon};
      for (const auto& [dimension, name] :
           {std::pair(time, "time"), {lev, "lev"}, {member, "member"}})
        if (dimension == time ? !(classic && records) && random.integer(0, 2) > 0
                              : random.integer(0, 1) == 0) {
          others.emplace_back(name);
          dimensions.push_back(dimension);
        }
      random.shuffle(dimensions);
      if (classic && records) { // first, as the format demands
        dimensions.insert(dimensions.begin(), time);
        others.emplace_back("time");
      }
      const int f = file.variable("f", type, dimensions);
      file.text(f, "standard_name", "air_temperature");
      file.text(f, "coordinates", "height area");
      file.text(f, "grid_mapping", "crs");
      std::size_t size = 12;
      for (const std::string& name : others)
        size *= name == "time" ? 3 : 2;
      file.put(t, {15.5, 45, 74.5});
      file.put(tb, {0, 31, 31, 59, 59, 90});
      file.put_text(x, "0001 0002 0003 ");
      file.put(l, {0.1, 0.9});
      file.put(a, {7, -8});
      file.put(h, {2});
      file.put(s, {-3});
      file.put(area, std::vector<double>(12, 1));
      std::vector<double> values(size);
      for (double& value : values)
        value = random.integer(-500, 500);
      file.put(f, values);
    }
    FieldGrid grid = read_field_grid(path);
    std::erase_if(grid.fields, [](const MeshField& field) { return field.name != "f"; });
    REQUIRE(grid.fields.size() == 1);
    write_fields(copy, grid, grid.fields, "", path);
    const FieldGrid again = read_field_grid(copy);
    REQUIRE(again.fields.size() == 1);
    const MeshField &before = grid.fields[0], &after = again.fields[0];
    CHECK(after.values == before.values);
    CHECK(after.integer == (type == NC_INT));
    CHECK(after.single == (type == NC_FLOAT));
    CHECK(after.attributes == before.attributes);
    const io_detail::NetcdfReader from(path), to(copy);
    CHECK(to.text("f", "standard_name") == "air_temperature");
    CHECK(to.text("f", "coordinates") == "height"); // what it says of places is not carried
    CHECK(to.text("f", "grid_mapping").empty());
    CHECK(to.is_unlimited("time") ==
          (records && before.leading > 0 && before.dimensions[0].name == "time"));
    for (const std::string& name : others)
      if (name != "member")
        carried.push_back(name);
    for (const std::string& name : carried) {
      CAPTURE(name);
      const auto has = [&](const std::string& dimension) {
        return std::ranges::find(others, dimension) != others.end();
      };
      const bool of_level = name == "lev" || name == "lev_a" || name == "scale",
                 of_time = name == "time_bnds" || name == "xtime";
      if ((of_level && !has("lev")) || (of_time && !has("time"))) {
        CHECK(!to.has_variable(name));
        continue;
      }
      REQUIRE(to.has_variable(name));
      CHECK(to.dimensions_of(name) == from.dimensions_of(name));
      const auto bytes = [&](const io_detail::NetcdfReader& file) {
        const int v = file.find(name);
        const std::vector<std::int64_t> shape = file.shape_of(name);
        std::string out(8 * 64, '\0');
        file.stored_rows(v, 0, 0, shape.empty() ? 1 : shape[0], out.data());
        return out;
      };
      CHECK(bytes(to) == bytes(from));
    }
  }
}

TEST_CASE("groups, and dimensions without records, are named") {
  const Scratch scratch;
  const std::string grouped = scratch / "grouped.nc", empty = scratch / "empty.nc";
  {
    const Written file(grouped);
    file.group("ocean");
    file.group("ice");
  }
  const auto refusal = [](const auto& read) { return message_of(read); };
  const std::string remedy = " beside its groups (ocean, ice), which are not read; ncks -G : -g "
                             "ocean IN OUT takes what one holds out";
  for (const auto& read : std::vector<std::function<void()>>{
           [&] { read_cell_width(grouped); }, [&] { read_field_grid(grouped); },
           [&] { read_mesh(grouped); },
           [&] { read_raster(grouped, {.quantity = RasterQuantity::height}); },
           [&] { read_coast(grouped); }, [&] { read_weights(grouped); }})
    CHECK(refusal(read) == grouped + ": it holds nothing" + remedy);
  {
    const Written file(grouped);
    file.group("ocean");
    file.group("ice");
    file.variable("other", NC_INT, {});
  }
  const std::string message = refusal([&] { read_coast(grouped); });
  CHECK(message.starts_with(grouped + ": it has no variable "));
  CHECK(message.ends_with(remedy));
  {
    const Written file(empty, NC_CLOBBER);
    const int time = file.dimension("time", NC_UNLIMITED), lat = file.dimension("lat", 3),
              lon = file.dimension("lon", 4);
    put_axes(file, lon, lat, {0, 90, 180, 270}, {-60, 0, 60});
    file.variable("t", NC_FLOAT, {time, lat, lon});
  }
  CHECK(refusal([&] { read_field_grid(empty); }) ==
        empty + ": its dimension time has the size 0, so that t holds no numbers; give a file with "
                "records");
  CHECK(read_field_grid(empty, FieldChoice::none).size() == 12); // as a target
}

TEST_CASE("heights and depths of a file, in metres or kilometres, in either order") {
  const Scratch scratch;
  const auto heights = [&](const std::vector<std::pair<std::string, std::string>>& attributes,
                           double scale, bool transposed, int hole = -1) {
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
        values.push_back(
            k == hole ? none : scale * (transposed ? 10 * (k % 2) + k / 2 : 10 * (k / 3) + k % 3));
      file.put(z, values);
    }
    return read_raster(path, {.quantity = RasterQuantity::height}).values;
  };
  const DoubleMatrix metres = heights({{"units", "m"}}, 1, false);
  CHECK(metres(2, 1) == 12);
  CHECK(heights({}, 1, true) == metres);
  CHECK(heights({{"units", "km"}}, 0.001, false).isApprox(metres));
  CHECK(heights({{"units", "meters"}, {"positive", "down"}}, -1, true) == metres);
  CHECK(heights({{"standard_name", "sea_floor_depth_below_geoid"}}, -1, false) == metres);
  CHECK(heights({{"standard_name", "sea_floor_depth_below_geoid"}, {"positive", "up"}}, 1, false) ==
        metres);
  // A depth that is missing is land; a height is not known.
  DoubleMatrix land = metres;
  land(2, 1) = 0;
  CHECK(heights({{"positive", "down"}}, -1, false, 5) == land);
  CHECK_THROWS_WITH_AS(heights({{"units", "m"}}, 1, false, 5), doctest::Contains("z[1][2]"), Error);
  CHECK_THROWS_WITH_AS(heights({{"units", "feet"}}, 1, false),
                       doctest::Contains("\"feet\" is not one of heights; give m or km"), Error);
}

TEST_CASE("what one reader takes for a raster of longitudes and latitudes, all do") {
  struct Axes {
    std::string longitude, latitude, longitude_units, latitude_units, attribute = "units";
    bool radians = false;
  };
  const Scratch scratch;
  const std::string path = scratch / "raster.nc";
  for (const Axes& axes :
       std::vector<Axes>{{"lon", "lat", "", ""},
                         {"longitude", "latitude", "", ""},
                         {"x", "y", "degrees_east", "degrees_north"},
                         {"i", "j", "degree_E", "degreeN"},
                         {"nav_lon", "nav_lat", "longitude", "latitude", "standard_name"},
                         {"lon", "lat", "radians", "radians", "units", true}}) {
    CAPTURE(axes.longitude);
    for (const bool transposed : {false, true})
      for (const bool descending : {false, true}) {
        const double unit = axes.radians ? std::acos(-1) / 180 : 1;
        const std::vector<double> rows =
            descending ? std::vector<double>{60, 0, -60} : std::vector<double>{-60, 0, 60};
        {
          const Written file(path);
          const int lat = file.dimension(axes.latitude, 3), lon = file.dimension(axes.longitude, 4),
                    two = file.dimension("two", 2);
          const int x = file.variable(axes.longitude, NC_DOUBLE, {lon}),
                    y = file.variable(axes.latitude, NC_DOUBLE, {lat});
          file.put(file.variable("lat_edges", NC_DOUBLE, {lat, two}), {1, 2, 3, 4, 5, 6});
          if (!axes.longitude_units.empty()) {
            file.text(x, axes.attribute, axes.longitude_units);
            file.text(y, axes.attribute, axes.latitude_units);
          }
          std::vector<double> longitudes{0, 90, 180, 270}, latitudes = rows, values;
          for (std::vector<double>* const nodes : {&longitudes, &latitudes})
            for (double& node : *nodes)
              node *= unit;
          file.put(x, longitudes);
          file.put(y, latitudes);
          for (int k = 0; k < 12; ++k) {
            const int column = transposed ? k / 3 : k % 4, row = transposed ? k % 3 : k / 4;
            values.push_back(1 + 10 * (rows[static_cast<std::size_t>(row)] / 60 + 1) + column);
          }
          file.put(file.variable("cellWidth", NC_FLOAT,
                                 transposed ? std::vector{lon, lat} : std::vector{lat, lon}),
                   values);
        }
        const Raster widths = read_cell_width(path);
        const Raster heights = read_raster(path, {.quantity = RasterQuantity::height});
        const FieldGrid grid = read_field_grid(path);
        REQUIRE(grid.boxes);
        REQUIRE(grid.fields.size() == 1);
        CHECK(heights.values == widths.values);
        CHECK((heights.y - DoubleVector{{-60, 0, 60}}).cwiseAbs().maxCoeff() < 1e-12);
        int wrong = 0;
        for (Eigen::Index j = 0; j < 3; ++j)
          for (Eigen::Index i = 0; i < 4; ++i) {
            const auto wanted = static_cast<double>(1 + 10 * j + i);
            const Eigen::Index row = descending ? 2 - j : j;
            wrong += widths.values(i, j) != wanted || grid.fields[0].values[4 * row + i] != wanted;
          }
        CHECK(wrong == 0);
      }
  }
}

TEST_CASE("a raster of one time and one level, and fractions in percent") {
  const Scratch scratch;
  const std::string path = scratch / "raster.nc";
  for (const std::string units : {"%", "1", ""}) {
    {
      const Written file(path);
      const int time = file.dimension("time", NC_UNLIMITED), lat = file.dimension("lat", 2),
                lev = file.dimension("lev", 1), lon = file.dimension("lon", 3);
      put_axes(file, lon, lat, {0, 120, 240}, {-45, 45});
      const int f = file.variable("f", NC_FLOAT, {time, lat, lev, lon});
      if (!units.empty())
        file.text(f, "units", units);
      std::vector<double> values{0, 0.25, 0.5, 1, 0.75, 0.125};
      for (double& value : values)
        value *= units == "%" ? 100 : 1;
      file.put(f, values);
    }
    const Raster raster = read_land(path, "f", RasterQuantity::land_fraction);
    CHECK(raster.values == DoubleMatrix{{0, 1}, {0.25, 0.75}, {0.5, 0.125}});
  }
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
