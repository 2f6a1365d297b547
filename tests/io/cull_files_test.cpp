// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "delaunay/delaunay.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"
#include "support/cut_laws.h"
#include "support/files.h"
#include "support/full_disk.h"
#include "support/global_file.h"
#include "support/gshhg.h"
#include "support/text.h"

#include <calotte/cut.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// The files that culling reads and writes beside those of meshes: rasters, masks and maps of cells.

using namespace calotte;
using namespace calotte::test;
using io_detail::NetcdfAttributes;
using io_detail::NetcdfType;
using io_detail::NetcdfWriter;

namespace {

/// A raster of a file, in the file's order.
struct RasterFile {
  std::string lat = "lat", lon = "lon", variable = "z";
  std::vector<double> latitudes, longitudes;
  std::vector<double> values; ///< latitudes x longitudes
  NetcdfAttributes attributes = {};
  std::string second = ""; ///< another variable of the same values, or none
};

void write_raster(const std::string& path, const RasterFile& raster) {
  NetcdfWriter file(path);
  const int rows = file.dimension(raster.lat, std::ssize(raster.latitudes)),
            columns = file.dimension(raster.lon, std::ssize(raster.longitudes));
  const int lat = file.variable(raster.lat, NetcdfType::float64, {rows}),
            lon = file.variable(raster.lon, NetcdfType::float64, {columns});
  const int z =
      file.variable(raster.variable, NetcdfType::float64, {rows, columns}, raster.attributes);
  const int second = raster.second.empty() ? -1
                                           : file.variable(raster.second, NetcdfType::float64,
                                                           {rows, columns}, raster.attributes);
  file.begin();
  const auto put = [&](int variable, const std::vector<double>& values, std::int64_t width) {
    file.put(variable,
             NetcdfWriter::Fill<double>([&](std::int64_t begin, std::int64_t end, double* out) {
               std::copy(values.begin() + begin * width, values.begin() + end * width, out);
             }));
  };
  put(lat, raster.latitudes, 1);
  put(lon, raster.longitudes, 1);
  put(z, raster.values, std::ssize(raster.longitudes));
  if (second >= 0)
    put(second, raster.values, std::ssize(raster.longitudes));
  file.commit();
}

/// Heights above 0 within a latitude of 30 degrees and from 0 to 90 east.
RasterFile heights(double step = 5, double first = -180 + 2.5) {
  RasterFile raster;
  for (double lat = -90 + step / 2; lat < 90; lat += step)
    raster.latitudes.push_back(lat);
  for (double lon = first; lon < first + 360 - step / 2; lon += step)
    raster.longitudes.push_back(lon);
  for (const double lat : raster.latitudes)
    for (const double lon : raster.longitudes) {
      const double east = std::remainder(lon - 45, 360);
      raster.values.push_back(std::abs(lat) < 30 && std::abs(east) < 45 ? 250 : -4000);
    }
  return raster;
}

std::vector<std::string> lines_of(const std::string& path) {
  std::istringstream in(calotte::test::read_file(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

} // namespace

TEST_CASE("rasters of land: heights, fractions, order of coordinates, packed numbers") {
  const Scratch scratch;
  const std::string path = scratch / "raster.nc";
  const RasterFile up = heights();
  write_raster(path, up);
  const Raster land = read_land(path, "z");
  CHECK(land.values.rows() == 72);
  CHECK(land.values.cols() == 36);
  for (Eigen::Index i = 0; i < 72; ++i)
    for (Eigen::Index j = 0; j < 36; ++j)
      REQUIRE(land.values(i, j) ==
              (std::abs(land.y[j]) < 30 && land.x[i] > 0 && land.x[i] < 90 ? 1 : 0));
  const auto same = [&](const RasterFile& file, RasterQuantity values, double tolerance) {
    write_raster(path, file);
    const Raster other = read_land(path, "z", values);
    return other.y == land.y && (other.values - land.values).cwiseAbs().maxCoeff() <= tolerance;
  };
  RasterFile file = heights();
  std::reverse(file.latitudes.begin(), file.latitudes.end()); // the field is symmetric
  CHECK(same(file, RasterQuantity::height, 0));
  file = heights();
  file.lat = std::string("latitude");
  file.lon = std::string("longitude");
  CHECK(same(file, RasterQuantity::height, 0));
  for (double& value : file.values)
    value = value > 0 ? 0 : 1;
  CHECK(same(file, RasterQuantity::sea_fraction, 0));
  for (double& value : file.values)
    value = 1 - value + 1e-8; // rounded by a program
  CHECK(same(file, RasterQuantity::land_fraction, 1e-7));
  for (double& value : file.values)
    value = value > 0.5 ? 3 : 2;
  file.attributes = {{"scale_factor", 10.0}, {"add_offset", -25.0}};
  CHECK(same(file, RasterQuantity::height, 0));

  // 0 is land; a repeated meridian is left out.
  file = heights();
  file.longitudes.push_back(file.longitudes.front() + 360);
  file.values.clear();
  for (std::size_t k = 0; k < file.latitudes.size() * file.longitudes.size(); ++k)
    file.values.push_back(k == 100 ? -1 : 0);
  write_raster(path, file);
  const Raster level = read_land(path, "z");
  CHECK(level.values.rows() == 72);
  CHECK(level.values.sum() == 72 * 36 - 1);
}

TEST_CASE("a raster of a part of the sphere covers the places that are asked for") {
  const Scratch scratch;
  const std::string path = scratch / "raster.nc";
  RasterFile file;
  file.latitudes = {40, 50, 60};
  file.longitudes = {170, 180, 190, 200};
  file.values.assign(12, -70);
  write_raster(path, file);
  const auto read_at = [&](double longitude, double latitude) {
    return read_raster(path, {.quantity = RasterQuantity::height,
                              .points = from_lonlat(Eigen::Vector2d(longitude, latitude))});
  };
  CHECK(read_at(-175, 41).values.minCoeff() == -70);
  for (const double longitude : {-150, 0, 160})
    CHECK(has(message_of([&] { read_at(longitude, 50); }),
              "lon runs from 170 to 200, lat runs from 40 to 60, and leaves out the place "));
  CHECK(has(message_of([&] { read_at(180, 70); }), "leaves out the place 180 70"));
  CHECK(has(message_of([&] { read_raster(path, {.quantity = RasterQuantity::height}); }),
            "leaves part of the sphere out"));
}

TEST_CASE(
    "the only raster of a file needs no name; of several, and for a wrong name, all are listed") {
  const Scratch scratch;
  const std::string path = scratch / "raster.nc";
  RasterFile file = heights(10);
  for (double& value : file.values)
    value = 300;
  write_raster(path, file);
  CHECK(read_raster(path, {.quantity = RasterQuantity::cell_width}).values.minCoeff() == 300);
  CHECK(read_raster(path, {.quantity = RasterQuantity::density}).values.minCoeff() == 300);
  file.second = std::string("topo");
  write_raster(path, file);
  const auto refusal = [&](const RasterChoice& choice) {
    return std::string(error_of([&] { read_raster(path, choice); }).what()).substr(path.size());
  };
  CHECK(refusal({}) ==
        ": 2 variables are rasters of latitudes and longitudes: z, topo; name one, or "
        "give a file with one");
  CHECK(
      refusal({.quantity = RasterQuantity::cell_width}) ==
      ": no variable cellWidth; 2 variables are rasters of latitudes and longitudes: z, topo; name "
      "one of them cellWidth, or give a file with one");
  CHECK(refusal({.variable = "height"}) == ": no variable height; there are z, topo");
  file.second = std::string("cellWidth");
  write_raster(path, file);
  CHECK(read_raster(path, {.quantity = RasterQuantity::cell_width}).values.minCoeff() == 300);
}

TEST_CASE("rasters of land that are refused, in one line each") {
  const Scratch scratch;
  const std::string path = scratch / "raster.nc";
  const auto refusal = [&](const std::function<void(RasterFile&)>& spoil,
                           RasterQuantity values = RasterQuantity::height) {
    RasterFile file = heights();
    spoil(file);
    write_raster(path, file);
    const std::string text = error_of([&] { read_land(path, "z", values); }).what();
    CHECK(text.starts_with(path + ": "));
    return text.substr(path.size() + 2);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal([](RasterFile& r) { r.variable = std::string("other"); }) ==
        "no variable z; there are other");
  CHECK(has(
      refusal([](RasterFile& r) {
        for (double& height : r.values)
          height = std::abs(height);
      }),
      "no height is below 0, so that all is land; if the values are depths, give their variable "
      "the attribute positive = \"down\"; if they are fractions of land or sea, say so"));
  CHECK(refusal([&](RasterFile& r) { r.values[72 * 3 + 5] = nan; }) ==
        "z[3][5] = nan is not finite; correct it");
  CHECK(refusal([&](RasterFile& r) {
          r.attributes = {{"_FillValue", -4000.0}};
        }) == "z[0][0] = nan is not finite; correct it");
  CHECK(refusal([](RasterFile&) {}, RasterQuantity::sea_fraction) ==
        "z[0][0] = -4000 is not a fraction from 0 to 1; correct it");
  CHECK(refusal([](RasterFile& r) { r.lat = std::string("y"); }) ==
        "no coordinate variable lat; give lat(lat) in degrees");
  CHECK(refusal([](RasterFile& r) { r.lon = std::string("x"); }) ==
        "no coordinate variable lon; give lon(lon) in degrees");
  CHECK(has(refusal([](RasterFile& r) { r.latitudes[5] = -80; }), "sort the raster along it"));
  CHECK(has(refusal([](RasterFile& r) {
              for (double& lon : r.longitudes)
                lon /= 57;
            }),
            "leaves part of the sphere out; give a global raster in degrees"));
  CHECK(code_of([&] { read_land(scratch / "absent.nc", "z"); }) == ErrorCode::file);
}

TEST_CASE("the sea by a raster: cells with their generator well inside are land") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "ocean.nc",
                    mask = scratch / "mask.nc";
  write_global(scratch, source, {.cells = 3000});
  write_raster(scratch / "raster.nc", heights(2, 1));
  CullOptions options;
  options.raster = read_land(scratch / "raster.nc", "z");
  options.mask_path = mask;
  const CullReport report = cull(source, target, options);
  const Contents masks = contents_of(mask), global = contents_of(source);
  CHECK(report.land > 300);
  const double degree = std::acos(-1.0) / 180, margin = 4; // wider than a cell
  for (std::size_t i = 0; i < 3000; ++i) {
    const double lat = std::abs(global.at("latCell", i)) / degree,
                 east = std::abs(std::remainder(global.at("lonCell", i) / degree - 45, 360));
    if (lat < 30 - margin && east < 45 - margin)
      REQUIRE((masks.at("cullCell", i) == 1 && masks.at("landFraction", i) == 1));
    if (lat > 30 + margin || east > 45 + margin)
      REQUIRE((masks.at("cullCell", i) == 0 && masks.at("landFraction", i) == 0));
  }
  // With a coast, the greater fraction counts.
  const Surface region = circle({-1, 0, 0}, 0.3);
  options.coast = {{region.rings().begin(), region.rings().end()}, region.area()};
  const CullReport both = cull(source, target, options);
  CHECK(both.land > report.land + 40);
}

TEST_CASE("maps of cells as text: forward by cell of the source, backward by cell of the ocean") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "ocean.nc";
  write_global(scratch, source, {.cells = 1000});
  CullOptions options;
  options.field = {"", "zCell", 0.1, 0.9};
  options.cell_map_folder = scratch.folder;
  const CullReport report = cull(source, target, options);
  const std::vector<std::string> forward = lines_of(scratch / "cellMapForward.txt"),
                                 backward = lines_of(scratch / "cellMapBackward.txt");
  const Contents ocean = contents_of(target);
  REQUIRE(forward.size() == 1000);
  REQUIRE(std::ssize(backward) == report.cells);
  std::int64_t kept = 0;
  for (std::size_t i = 0; i < forward.size(); ++i)
    if (const int now = std::stoi(forward[i]); now >= 0) {
      ++kept;
      REQUIRE(std::stoul(backward[static_cast<std::size_t>(now)]) == i);
      REQUIRE(ocean.at("mapCulledToBaseCell", static_cast<std::size_t>(now)) ==
              static_cast<double>(i));
    } else {
      REQUIRE(forward[i] == "-1");
    }
  CHECK(kept == report.cells);
}

TEST_CASE("an ocean can be cut, and a regional file loses land by a field") {
  const Scratch scratch;
  const std::string global = scratch / "global.nc", ocean = scratch / "ocean.nc",
                    target = scratch / "target.nc";
  Mesh mesh = delaunay(fibonacci_sphere(2000));
  WriteOptions written;
  written.fields = {{.name = "height", .values = mesh.points.row(0).transpose()}};
  write(global, mesh, written);
  CullOptions options;
  options.field = {{}, "height", -2, 0.5}; // land around longitude 0
  const CullReport culled = cull(global, ocean, options);
  const auto near = [](double cosine) {
    return [cosine](const Eigen::Vector3d& p) { return p.normalized().y() > cosine; };
  };
  CutOptions cut_options;
  cut_options.rings = 0;
  const CutReport part = cut(ocean, target, near(0.5), cut_options);
  const auto count = [&](double least) {
    std::int64_t cells = 0;
    for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
      cells += mesh.points(1, i) > least && mesh.points(0, i) < 0.5 ? 1 : 0;
    return cells;
  };
  const auto is_nearly = [](std::int64_t cells, std::int64_t expected) {
    return cells <= expected && cells >= expected - 5; // without cells of one neighbour
  };
  CHECK(is_nearly(part.cells, count(0.5)));
  CHECK(cut(ocean, target, near(-2), cut_options).cells == culled.cells);

  const std::string regional = scratch / "regional.nc";
  cut(global, regional, near(0.3), cut_options);
  CHECK(is_nearly(cull(regional, target, options).cells, count(0.3)));
  CHECK(cull(regional, target, options).land > 0);
  options.raster.values = Eigen::MatrixXd::Zero(4, 4);
  for (const std::string& source : {regional, ocean}) {
    const std::string problem = error_of([&] { cull(source, target, options); }).what();
    CHECK(has(problem, "does not cover the sphere"));
    CHECK(has(problem, "calotte cut"));
  }
}

TEST_CASE("a cull that fails leaves no file, whichever output fails") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc";
  write(source, delaunay(fibonacci_sphere(1000)));
  const Scratch out;
  CullOptions options;
  options.field = {"", "zCell", 0.1, 0.9};
  options.mask_path = out / "mask.nc";
  options.cell_map_folder = out.folder;
  const auto leaves_nothing = [&](const std::string& target, const CullOptions& of) {
    CHECK(code_of([&] { cull(source, target, of); }) != ErrorCode::internal);
    return out.files() == 0;
  };
  CullOptions bad = options;
  bad.mask_path = out / "absent/mask.nc";
  CHECK(leaves_nothing(out / "ocean.nc", bad));
  bad = options;
  bad.cell_map_folder = out / "absent";
  CHECK(leaves_nothing(out / "ocean.nc", bad));
  CHECK(leaves_nothing(out / "absent/ocean.nc", options));
  int calls = 0;
  options.progress = [&](const Progress&) {
    return ++calls == 3 ? ProgressReply::cancel : ProgressReply::proceed;
  };
  CHECK(leaves_nothing(out / "ocean.nc", options));
  options.progress = {};
  for (const rlim_t bytes :
       {40000, 300000}) { // with space for the header, or else the C library leaks
    const FullDisk full(bytes);
    CHECK(leaves_nothing(out / "ocean.nc", options));
  }
  cull(source, out / "ocean.nc", options);
  CHECK(out.files() == 5); // the grid, its graph, the mask and two maps
}

TEST_CASE("the ocean and all other cells have each global cell once, and the mask its ids") {
  const Scratch scratch;
  const std::string source = scratch / "global.nc", target = scratch / "ocean.nc",
                    land = scratch / "land.nc", mask = scratch / "mask.nc";
  write_global(scratch, source, {.cells = 2000});
  CullOptions options;
  options.field = {"", "zCell", -0.9, 0.2};
  options.mask_path = mask;
  options.land_path = land;
  const CullReport report = cull(source, target, options);
  CHECK(report.cells + report.others == 2000);
  const Contents masks = contents_of(mask);
  for (const auto& [path, name] : {std::pair(target, "oceanCell"), std::pair(land, "landCell")}) {
    const std::int64_t cells = path == target ? report.cells : report.others;
    CHECK(check_file(path, read_mesh_file(path)).empty());
    const Contents file = contents_of(path);
    for (std::int64_t i = 0; i < cells; ++i) {
      const auto base =
          static_cast<std::size_t>(file.at("mapCulledToBaseCell", static_cast<std::size_t>(i)));
      CHECK(masks.at(name, base) == static_cast<double>(i));
      CHECK(masks.at("cullCell", base) == (path == target ? 0 : 1));
    }
    std::int64_t found = 0;
    for (std::size_t i = 0; i < 2000; ++i)
      found += masks.at(name, i) >= 0 ? 1 : 0;
    CHECK(found == cells);
  }
  const Scratch out; // both appear, or none
  options.mask_path.clear();
  options.land_path = out / "land.nc";
  CHECK_THROWS_AS(cull(source, out / "absent/ocean.nc", options), Error);
  CHECK(out.files() == 0);
  options.land_path = out / "absent/land.nc";
  CHECK_THROWS_AS(cull(source, out / "ocean.nc", options), Error);
  CHECK(out.files() == 0);
}

// Slow: 163 842 cells.
TEST_CASE(
    "an ocean file at 60 km: the fractions sum to GSHHG's land, the sea is connected [slow]") {
  const Scratch scratch;
  const std::string source = scratch / "earth.nc", target = scratch / "ocean.nc",
                    mask = scratch / "mask.nc";
  WriteOptions written;
  written.format = Format::mpas;
  written.sphere_radius = 6371000;
  write(source, delaunay(bisected_icosahedron(7)), written);
  CullOptions options;
  options.coast = gshhg('i');
  options.mask_path = mask;
  const auto point = [](double lon, double lat) {
    const base_detail::Vec3 x = base_detail::from_lonlat(lon, lat);
    return Eigen::Vector3d(x.x, x.y, x.z);
  };
  Points3 gibraltar(3, 2);
  gibraltar << point(-7.5, 35.9), point(-3.5, 36);
  options.passages = {gibraltar};
  const CullReport report = cull(source, target, options);
  check_none(target);

  const std::vector<double> areas = io_detail::NetcdfReader(source).doubles("areaCell", {-1}),
                            land = io_detail::NetcdfReader(mask).doubles("landFraction", {-1});
  double sum = 0;
  for (std::size_t i = 0; i < areas.size(); ++i)
    sum += land[i] * areas[i];
  CHECK(std::abs(sum / (options.coast.area * 6371000.0 * 6371000.0) - 1) <= 1e-10);

  const io_detail::NetcdfReader ocean(target);
  const std::vector<std::int32_t> neighbours =
      ocean.ints("cellsOnCell", {report.cells, ocean.dimension("maxEdges")});
  const auto width = neighbours.size() / static_cast<std::size_t>(report.cells);
  std::vector<bool> seen(static_cast<std::size_t>(report.cells));
  std::vector<std::size_t> stack{0};
  seen[0] = true;
  std::int64_t reached = 0, dead_ends = 0;
  while (!stack.empty()) {
    const std::size_t cell = stack.back();
    stack.pop_back();
    ++reached;
    int in_the_sea = 0;
    for (std::size_t k = 0; k < width; ++k)
      if (const std::int32_t id = neighbours[cell * width + k]; id > 0) {
        const auto other = static_cast<std::size_t>(id - 1);
        ++in_the_sea;
        if (!seen[other])
          stack.push_back(other);
        seen[other] = true;
      }
    dead_ends += in_the_sea < 2;
  }
  CHECK(reached == report.cells);
  CHECK(dead_ends == 0);
}
