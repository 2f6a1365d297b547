// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command.h"
#include "support/files.h"
#include "support/full_disk.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/error.h>
#include <calotte/field_grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

namespace fs = std::filesystem;
using calotte::Columns;
using calotte::Error;
using calotte::ErrorCode;
using calotte::Mesh;
using calotte::Points3;
using calotte::Triangles;
using namespace calotte::test;

namespace {

/// Points from text; the test names the columns only where it must.
Points3 points_of(const std::string& text, Columns columns = Columns::xyz) {
  std::istringstream in(text);
  return calotte::read_points(in, "points", columns);
}

void check_bad_points(const std::string& text, std::int64_t line, const std::string& message,
                      Columns columns = Columns::xyz) {
  CAPTURE(text);
  const Error error = error_of([&] { points_of(text, columns); });
  CHECK(error.code() == ErrorCode::parse);
  CHECK(error.index() == line);
  CAPTURE(error.what());
  CHECK(has(error.what(), message));
}

std::vector<std::int32_t> identity(std::int64_t count) {
  std::vector<std::int32_t> ids(static_cast<std::size_t>(count));
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

/// +x +y +z -x -y -z of norms that no text shortens, the triangles in canonical order.
Mesh scaled_octahedron() {
  Mesh mesh;
  mesh.points.resize(3, 6);
  mesh.points.setZero();
  for (int i = 0; i < 3; ++i) {
    mesh.points(i, i) = std::pow(1.0 / 3, 40 * i + 1);
    mesh.points(i, i + 3) = -std::pow(7.1, 70 * i);
  }
  mesh.triangles.resize(3, 8);
  mesh.triangles << 0, 0, 0, 0, 1, 1, 2, 3, //
      1, 2, 4, 5, 3, 5, 3, 5,               //
      2, 4, 5, 1, 2, 3, 4, 4;
  mesh.neighbours.resize(3, 8);
  mesh.neighbours << 4, 6, 7, 5, 6, 7, 7, 2, //
      1, 2, 3, 0, 0, 4, 1, 6,                //
      3, 0, 1, 2, 5, 3, 4, 5;
  mesh.site_of_input = identity(6);
  return mesh;
}

/// The octahedron without its last triangle.
Mesh open_octahedron() {
  Mesh mesh = scaled_octahedron();
  mesh.triangles.conservativeResize(3, 7);
  mesh.neighbours.conservativeResize(3, 7);
  for (std::int32_t& t : mesh.neighbours.reshaped())
    if (t == 7)
      t = -1;
  return mesh;
}

} // namespace

TEST_CASE("a header tells which columns are read, wherever they stand") {
  const auto read = [](const std::string& text, Columns columns) {
    std::istringstream in(text);
    return read_points(in, "text", columns);
  };
  const Points3 wanted = read("8.5 47.4\n-70 -33\n", Columns::lonlat);
  for (const char* const text :
       {"lat,lon\n47.4,8.5\n-33,-70\n", "name,lon,lat\nNew York,8.5,47.4\nb,-70,-33\n",
        "id lat height lon\n1 47.4 5 8.5\n2 -33 6 -70\n",
        "\"Latitude\"; \"Longitude\"\n47.4; 8.5\n-33; -70\n", "lon|lat|id\n8.5|47.4|3\n-70|-33|4\n",
        "station\tlongitude\tlatitude\r\na b\t8.5\t47.4\r\nc\t-70\t-33\r\n",
        "Latitude [deg],Longitude [deg]\n47.4,8.5\n-33,-70\n",
        "lat_deg lon_deg\n47.4 8.5\n-33 -70\n", "Y,X\n47.4,8.5\n-33,-70\n",
        "x,y,lat,lon\n1,2,47.4,8.5\n3,4,-33,-70\n", "# lat lon\n47.4 8.5\n-33 -70\n",
        "# of 2020\n# lat,lon\n\n47.4, 8.5\n-33, -70\n", "# lat lon\n47.4,8.5\n-33,-70\n",
        "# The lat and the lon\n8.5 47.4\n-70 -33\n",
        "# depth at lon lat\n8.5 47.4 5 6\n-70 -33 7 8\n",
        "lon;lat;remark\n8.5;47.4;3,4 m\n-70;-33;b\n", "# lat lon\nlon lat\n8.5 47.4\n-70 -33\n",
        "a,b\n8.5,47.4\n-70,-33\n"}) {
    CAPTURE(text);
    CHECK(read(text, Columns::lonlat) == wanted);
  }
  CHECK(read("z y x\n3 2 1\n", Columns::xyz) == Points3(Eigen::Vector3d(1, 2, 3)));
  CHECK(read("id,y,x\n7,2,1\n", Columns::xy) == Points3(Eigen::Vector3d(1, 2, 0)));
  const auto refusal = [&](const std::string& text) {
    return message_of([&] { read(text, Columns::lonlat); });
  };
  CHECK(refusal("lat,lon\n47.4\n").find("text line 2: 1 column only") == 0);
  CHECK(has(refusal("lat,name,lon\n47.4,b,c\n"), "\"c\" is not a number"));
  CHECK(has(refusal("lat,lon\n10.5 S,20 W\n"), "is not a number"));
  CHECK(has(refusal("lon;lat\n10 30;45 15\n"), "\"10 30\" is not a number"));
  CHECK(has(refusal("lon\tlat\tdepth\n10\t\t5\n"), "empty"));
  CHECK(has(refusal("\"10\",\"20\"\n30,20\n"), "is not a number"));
  for (const std::string text : {"lon,lat,v\n1,2,3\n", "station,lon,lat\n5,1,2\n", "x y v\n1 2 3\n",
                                 "# lon,lat,v\n# of a day\n1,2,3\n"})
    CHECK(
        has(message_of([&] { read(text, Columns::xyz); }),
            "the header names no x, y and z; write these, or read them as longitude and latitude"));
  const Points3 known = read("8.5 47.4\n", Columns::lonlat);
  for (const std::string text :
       {"# lat lon\n# of a day\n47.4 8.5\n", "lat,lon,1990\n47.4,8.5,3\n",
        "name,lat,lon\n\"A, b #1\",47.4,8.5\n", "lon_err,lat_sd,latitude,longitude\n1,2,47.4,8.5\n",
        "lon lat\n8.5, 47.4\n", "\"A \"\"b #1\"\" c\";lat;lon\n\"A \"\"b #1\"\" c\";47.4;8.5\n",
        "name,lat,lon\n5\" pipe,47.4,8.5\n"})
    CHECK(read(text, Columns::lonlat) == known);
  for (const char* const text : {"10,5;50,2\n", "10,5 50,2\n", "10,5\t50,2\n", "10,5 50,2 3,7\n"})
    CHECK(refusal(text) ==
          "text line 1: commas separate columns; write numbers with decimal points");
}

TEST_CASE("numbers of lines and of stations are no coordinates, and further columns are told") {
  const auto read = [](const std::string& text, Columns columns) {
    std::istringstream in(text);
    return calotte::read_point_lines(in, "text", columns);
  };
  const auto refusal = [&](const std::string& text, Columns columns = Columns::lonlat) {
    return message_of([&] { read(text, columns); });
  };
  const std::string remedy = ", and there are more than 2; write a header that names the columns, "
                             "such as id lon lat, or lon lat value";
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const int first = random.integer(-3, 400), lines = random.integer(3, 40);
    std::string text, named = "nr;lon;lat\n", plain;
    for (int k = 0; k < lines; ++k) {
      const std::string lonlat = std::to_string(random.real(-180, 180)) + ";" +
                                 std::to_string(random.real(-90, 90)) + "\n";
      text += std::to_string(first + k) + ";" + lonlat;
      named += std::to_string(first + k) + ";" + lonlat;
      plain += lonlat;
    }
    CHECK(has(refusal(text), remedy));
    CHECK(read(named, Columns::lonlat).points == read(plain, Columns::lonlat).points);
    CHECK(!read(named, Columns::lonlat).further_columns);
  }
  CHECK(refusal("7 120 47.4\n8 110 40\n") ==
        "text line 1: the first column counts the lines" + remedy);
  CHECK(refusal("1 10 47.4\n2 11 40\n3 12 40\n") ==
        "text line 3: the first column counts the lines" + remedy);
  CHECK(has(refusal("1.5 120 47.4\n"), "latitude 120 is outside"));
  CHECK(refusal("10438 8.5 47.4\n") == "text line 1: the first column is no longitude" + remedy);
  CHECK(has(refusal("0 1 2 3\n1 1 2 3\n2 1 2 3\n", Columns::xyz), "such as id x y z"));
  CHECK(has(refusal("0 1 2\n1 1 2\n2 1 2\n", Columns::xy), "such as id x y"));
  // Two lines, other numbers, a header: depths, names and weights may follow.
  CHECK(read("1 2 3\n2 3 4\n", Columns::lonlat).further_columns);
  CHECK(read("1 2 a\n2 3 b\n4 5 c\n", Columns::lonlat).further_columns);
  CHECK(!read("lon lat depth\n1 2 3\n2 3 4\n3 4 5\n", Columns::lonlat).further_columns);
  CHECK(!read("400 2\n401 3\n402 4\n", Columns::lonlat).further_columns);
}

TEST_CASE("files that other programs convert are refused with the command") {
  using namespace calotte;
  const Scratch scratch;
  for (const auto& [suffix, command] :
       {std::pair<std::string, std::string>{".dbf", "this is a part of a shapefile; give F.shp"},
        {".zip", "this is an archive, which Calotte does not read; convert it with GDAL: ogr2ogr "
                 "-t_srs EPSG:4326 F.geojson /vsizip/F.zip"},
        {".GPKG", "this is a GeoPackage, which Calotte does not read; convert it with GDAL: "
                  "ogr2ogr -t_srs EPSG:4326 F.geojson F.GPKG"},
        {".kml", "this is KML, which Calotte does not read; convert it with GDAL: ogr2ogr "
                 "-t_srs EPSG:4326 F.geojson F.kml"},
        {".tiff", "this is an image, which Calotte does not read; convert it with GDAL: "
                  "gdalwarp -t_srs EPSG:4326 -of netCDF F.tiff F.nc"},
        {".tif", "this is an image, which Calotte does not read; convert it with GDAL: "
                 "gdalwarp -t_srs EPSG:4326 -of netCDF F.tif F.nc"},
        {".png", "this is an image, which Calotte does not read; convert it with GDAL: "
                 "gdalwarp -t_srs EPSG:4326 -of netCDF F.png F.nc"}}) {
    const std::string path = scratch / ("a" + suffix);
    std::string expected = path + ": " + command;
    for (std::size_t at; (at = expected.find(" F.")) != std::string::npos;)
      expected.replace(at + 1, 1, scratch / "a");
    for (std::size_t at; (at = expected.find("/F.")) != std::string::npos;)
      expected.replace(at + 1, 1, scratch / "a");
    write_text(path, "anything");
    for (const std::function<void()>& read : std::vector<std::function<void()>>{
             [&] { read_points(path); }, [&] { read_mesh(path); }, [&] { read_region(path); },
             [&] { read_domain(path); }, [&] { read_coast(path); },
             [&] { read_raster(path, {.quantity = RasterQuantity::height}); },
             [&] { read_cell_width(path); }, [&] { read_shapes(path); },
             [&] { read_field_grid(path); }, [&] { read_cell_width(path, {}, Surface::plane()); }})
      CHECK(message_of(read) == expected);
  }
}

TEST_CASE("any separators, comments, blank lines, endings and a header give the same points") {
  const Points3 expected = (Points3(3, 2) << 1, 4, 2, -5, 3, 0.5).finished();
  for (const std::string text :
       {"1 2 3\n4 -5 0.5\n", "1 2 3\n4 -5 0.5", "1,2,3\n4,-5,0.5\n", "1;2;3\n4; -5 ;0.5\n",
        "1\t2\t3\n\t4 \t-5\t\t0.5 \n", "1|2|3\n4 | -5 | 0.5", "1, 2; 3\n4 -5,0.5\n",
        "1 2 3\r\n4 -5 0.5\r\n", "1 2 3\r4 -5 0.5\r", "\r\n1 2 3\r\n\r\n4 -5 0.5",
        "# a comment\n\n1 2 3 # of one\n   \n#4 4 4\n4 -5 0.5\n", "x y z\n1 2 3\n4 -5 0.5\n",
        "# stations\n\"x\",\"y\",\"z\"\n1,2,3\n4,-5,0.5\n",
        "\xef\xbb\xbf"
        "1 2 3\n4 -5 0.5\n",
        "\xef\xbb\xbfx,y,z\n1 2 3\n4 -5 0.5\n", "1 2 3 99 name\n4 -5 0.5,,nan\n",
        "+1.0 2e0 300E-2\n+4 -5.0 +.5\n"}) {
    CAPTURE(text);
    CHECK(equal_bits(points_of(text), expected));
  }
}

TEST_CASE("lines are those of the columns") {
  std::istringstream in("# c\nx y z\n1 2 3\n\n4 5 6\n");
  CHECK(calotte::read_point_lines(in, "points").lines == std::vector<std::int64_t>{3, 5});
}

TEST_CASE("a file longer than the reader's buffer loses nothing, whatever ends its lines") {
  for (const std::string ending : {"\n", "\r\n", "\r"}) {
    std::string text;
    const int count = 200'000;
    for (int i = 0; i < count; ++i)
      text += std::to_string(i) + " " + std::to_string(i * 7) + " 1" + ending;
    const Points3 points = points_of(text);
    REQUIRE(points.cols() == count);
    bool same = true;
    for (int i = 0; i < count; ++i)
      same = same && points(0, i) == i && points(1, i) == i * 7 && points(2, i) == 1;
    CHECK(same);
  }
  CHECK(points_of("#" + std::string(5'000'000, ' ') + "\n1 2 3").cols() == 1);
}

TEST_CASE("a long text gives the same points, lines and errors, whatever its parts") {
  Points3 expected(3, 361);
  for (int i = 0; i <= 360; ++i)
    expected.col(i) = points_of(std::to_string(i - 180) + " 47.25\n", Columns::lonlat).col(0);
  Random random(7);
  for (const std::string ending : {"\n", "\r\n", "\r"}) {
    std::string text = "lon lat depth" + ending;
    std::vector<double> longitudes;
    std::vector<std::int64_t> lines;
    for (std::int64_t line = 2; line < 60'000;
         ++line) { // of 3 MB: many parts, more than one window
      if (random.integer(0, 20) == 0)
        text += random.integer(0, 1) == 0 ? "# an island" : "  ";
      else {
        longitudes.push_back(random.integer(-180, 180));
        lines.push_back(line);
        text += std::to_string(longitudes.back()) + " 47.25 " +
                std::string(static_cast<std::size_t>(random.integer(1, 60)), '7');
      }
      text += ending;
    }
    const auto read = [&](const std::string& of) {
      std::istringstream in(of);
      return calotte::read_point_lines(in, "text", Columns::lonlat);
    };
    for (const int threads : {1, 3}) {
      tbb::task_arena arena(threads);
      const calotte::PointLines all = arena.execute([&] { return read(text); });
      CHECK(all.lines == lines);
      REQUIRE(all.points.cols() == std::ssize(longitudes));
      std::int64_t same = 0;
      for (std::int64_t i = 0; i < all.points.cols(); ++i)
        same += all.points.col(i) ==
                expected.col(static_cast<int>(longitudes[static_cast<std::size_t>(i)]) + 180);
      CHECK(same == all.points.cols());
    }
    for (int trial = 0; trial < 20; ++trial) { // two bad lines: the first is told
      std::string bad = text;
      const auto at = static_cast<std::size_t>(
                     random.integer(0, static_cast<int>(lines.size()) - 1)),
                 from = bad.find(" 47.25 ");
      REQUIRE(from != std::string::npos);
      std::size_t place = from;
      for (std::size_t k = 0; k < at; ++k)
        place = bad.find(" 47.25 ", place + 1);
      bad.replace(place, 7, " 97.25 ");
      if (const std::size_t next = bad.find(" 47.25 ", place); next != std::string::npos)
        bad.replace(next, 7, " 4?.25 ");
      CHECK(message_of([&] {
              read(bad);
            }).find("text line " + std::to_string(lines[at]) + ": latitude 97.25 is outside") == 0);
    }
  }
}

TEST_CASE("a column that counts the lines is told in a long text, too") {
  constexpr int count = 50'000;
  const auto text = [&](int broken) {
    std::string rows;
    for (int i = 0; i < count; ++i)
      rows += std::to_string(i == broken ? 5 : 100 + i) + " 0.5 0.25 a further column\n";
    return rows;
  };
  CHECK(has(message_of([&] { points_of(text(-1), Columns::xy); }),
            "points line 50000: the first column counts the lines"));
  for (const int broken : {1, 2, 9'000, 30'001, count - 1})
    CHECK(points_of(text(broken), Columns::xy).cols() == count);
}

TEST_CASE("invalid points give an error of one line with the line of the file and the remedy") {
  const std::string xyz = "; write three numbers x y z on each line";
  check_bad_points("1 2 3\n4 abc 6\n", 2, "points line 2: \"abc\" is not a number" + xyz);
  check_bad_points("1 2 3\n\n# c\n4 5 6x\n", 4, "line 4: \"6x\" is not a number");
  check_bad_points("1 2 3\r\n4 5 0x6\r\n", 2, "\"0x6\" is not a number");
  check_bad_points("x y z\nu v w\n1 2 3\n", 2, "\"u\" is not a number");
  check_bad_points("1 x 3\n", 1, "\"x\" is not a number");
  check_bad_points("1 2 3\nx y z\n", 2, "\"x\" is not a number");
  check_bad_points("1,2,3\n4,,6\n", 2, "points line 2: a column is empty" + xyz);
  check_bad_points("1,2,3\n,4,5,6\n", 2, "a column is empty");
  check_bad_points("1 2 3\n--1 2 3\n", 2, "\"--1\" is not a number");
  check_bad_points("1 2 3\n+-1 2 3\n", 2, "\"+-1\" is not a number");
  check_bad_points("1 2 3\n1e400 2 3\n", 2, "points line 2: \"1e400\" is out of range" + xyz);
  check_bad_points("1 2 3\n4 5", 2, "2 columns only" + xyz + ", or read them as longitude and");
  check_bad_points("1 2 3\n4\n", 2, "1 column only" + xyz);
  check_bad_points("1 2 3\n4,5,\n", 2, "2 columns only");
  check_bad_points("1 2 3\n4 # 5 6\n", 2, "1 column only");
  check_bad_points("1 2 3\n\x01\x02garbage\n", 2, "\"??garbage\" is not a number");
  check_bad_points("1 2 3\n" + std::string(99, 'a'), 2, std::string(40, 'a') + "...\" is not");
  for (const std::string nan : {"nan", "NaN", "-nan", "NAN"})
    check_bad_points("1 2 3\n4 " + nan + " 6\n", 2, "NaN gives no direction; remove the point");
  for (const std::string infinity : {"inf", "-Inf", "+INF", "infinity"})
    check_bad_points("1 2 3\n4 5 " + infinity, 2, "an infinite number gives no direction; remove");
  for (const std::string zero : {"0 0 0", "-0 0.0 0e5", "0,0,0"})
    check_bad_points("1 2 3\n" + zero, 2, "the zero vector has no direction; remove the point");
  check_bad_points("", -1, "points: no points in 0 lines" + xyz);
  check_bad_points("# only a comment\n", -1, "points: no points in 1 line" + xyz);
  check_bad_points("x y z\n\n", -1, "points: no points in 2 lines" + xyz);
}

TEST_CASE("longitude and latitude out of range, or too few, name their line") {
  const auto bad = [](const std::string& text, const std::string& message) {
    check_bad_points(text, 2, "points line 2: " + message, Columns::lonlat);
  };
  bad("0 0\n0 90.5\n", "latitude 90.5 is outside -90 to 90; write longitude first, then latitude");
  bad("0 0\n0 -91\n", "latitude -91 is outside -90 to 90");
  bad("0 0\n7\n", "1 column only; write longitude and latitude in degrees on each line");
  bad("0 0\nnan 7\n", "NaN gives no direction; remove the point or correct it");
  CHECK(points_of("lon,lat\n1e300,-90\n", Columns::lonlat) == Eigen::Vector3d(0, 0, -1));
}

TEST_CASE("longitude and latitude are exact at multiples of 90 degrees") {
  const auto check_direction = [](const std::string& lonlat, double x, double y, double z) {
    CAPTURE(lonlat);
    CHECK(equal_bits(points_of(lonlat, Columns::lonlat), Eigen::Vector3d(x, y, z)));
  };
  for (const char* turn : {"0 0", "360 0", "-360 0", "720 0", "-0 -0"})
    check_direction(turn, 1, 0, 0);
  for (const char* turn : {"90 0", "-270 0", "450 0"})
    check_direction(turn, 0, 1, 0);
  for (const char* turn : {"180 0", "-180 0", "540 0"})
    check_direction(turn, -1, 0, 0);
  for (const char* turn : {"-90 0", "270 0"})
    check_direction(turn, 0, -1, 0);
  for (const char* longitude : {"0", "17.3", "-180", "90", "123456"}) {
    check_direction(std::string(longitude) + " 90", 0, 0, 1);
    check_direction(std::string(longitude) + " -90", 0, 0, -1);
  }
}

TEST_CASE("longitude and latitude agree with the C library, and equal places are equal bits") {
  std::mt19937_64 random(3);
  const long double degree = std::acos(-1.0L) / 180;
  for (int i = 0; i < 10'000; ++i) {
    // Multiples of 2^-30 degrees, so that a full turn can be added without rounding.
    const double lon = std::ldexp(double(std::int64_t(random() % (360ll << 30))), -30) - 180;
    const double lat = std::ldexp(double(std::int64_t(random() % (180ll << 30))), -30) - 90;
    std::ostringstream text;
    text.precision(17);
    for (const double turns : {0, -360, 360})
      text << lon + turns << ' ' << lat << '\n';
    const Points3 p = points_of(text.str(), Columns::lonlat);
    const long double x = std::cos(lat * degree) * std::cos(lon * degree);
    const long double y = std::cos(lat * degree) * std::sin(lon * degree);
    const long double z = std::sin(lat * degree);
    // An angle is good to 4 roundings, and has a slope of at most 1 in an octant: with the series,
    // each factor is within 4 units of roundoff, a product of two within 9.
    const double bound = 9 * std::numeric_limits<double>::epsilon() / 2;
    REQUIRE(std::abs(double(p(0, 0) - x)) <= bound);
    REQUIRE(std::abs(double(p(1, 0) - y)) <= bound);
    REQUIRE(std::abs(double(p(2, 0) - z)) <= bound);
    REQUIRE(equal_bits(p.col(0).eval(), p.col(1).eval()));
    REQUIRE(equal_bits(p.col(0).eval(), p.col(2).eval()));
  }
}

TEST_CASE("points come back bit for bit") {
  const Scratch scratch;
  std::mt19937_64 random(1);
  Points3 points(3, 20'000);
  for (double& x : points.reshaped())
    do
      x = std::bit_cast<double>(random());
    while (!std::isfinite(x));
  points.col(7) << -0.0, 5e-324, 1.7976931348623157e308;
  calotte::write_points(scratch / "points.txt", points);
  CHECK(equal_bits(calotte::read_points(scratch / "points.txt"), points));
  std::stringstream stream;
  calotte::write_points(stream, points);
  CHECK(equal_bits(calotte::read_points(stream, "stream"), points));
  CHECK(scratch.files() == 1);
}

TEST_CASE("meshes come back bit for bit in every format") {
  const Scratch scratch;
  for (const Mesh& mesh : {scaled_octahedron(), open_octahedron()})
    for (const std::string suffix : {".vtp", ".vtu", ".off", ".ply", ".OFF"}) {
      CAPTURE(suffix);
      const std::string path = scratch / ("mesh" + suffix);
      calotte::write(path, mesh);
      check_equal(calotte::read_mesh(path), mesh);
      calotte::write(scratch / "again.off", calotte::read_mesh(path));
      calotte::write(scratch / "first.off", mesh);
      CHECK(calotte::test::read_file(scratch / "again.off") ==
            calotte::test::read_file(scratch / "first.off"));
    }
  for (const char* name : {"mesh.txt", "mesh.tri"}) {
    const Mesh mesh = scaled_octahedron();
    calotte::write(scratch / name, mesh);
    CHECK(calotte::test::read_file(scratch / name).starts_with("0 1 2\n0 2 4\n"));
    check_equal(calotte::read_mesh(scratch / name, &mesh.points), mesh);
  }
}

TEST_CASE("triangles as text refer to the lowest column of merged duplicates") {
  const Scratch scratch;
  Mesh mesh = scaled_octahedron();
  // Columns 1, 4 and 8 repeat an earlier direction; 4 at another length.
  mesh.site_of_input = {0, 0, 1, 2, 1, 3, 4, 5, 5};
  Points3 columns(3, 9);
  for (int i = 0; i < 9; ++i)
    columns.col(i) = mesh.points.col(mesh.site_of_input[std::size_t(i)]) * (i == 4 ? 3.7 : 1);
  calotte::write(scratch / "mesh.tri", mesh);
  CHECK(calotte::test::read_file(scratch / "mesh.tri").starts_with("0 2 3\n0 3 6\n0 6 7\n"));
  check_equal(calotte::read_mesh(scratch / "mesh.tri", &columns), mesh);
}

TEST_CASE("a distinct column in no triangle stays as a site") {
  const Scratch scratch;
  const Mesh mesh = scaled_octahedron();
  Points3 columns(3, 8);
  columns << mesh.points, Points3::Constant(3, 2, 0.1);
  calotte::write(scratch / "mesh.tri", mesh);
  const Mesh read = calotte::read_mesh(scratch / "mesh.tri", &columns);
  CHECK(read.points.cols() == 7);
  CHECK(read.site_of_input == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 6});
}

TEST_CASE("neighbours: an edge of one triangle is open; one of three, or of two the same way, is "
          "refused") {
  const Scratch scratch;
  const auto write_faces = [&](const std::string& faces, int count) {
    write_text(scratch / "mesh.off", "OFF\n5 " + std::to_string(count) +
                                         " 0\n1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n" + faces);
  };
  write_faces("3 0 1 2\n3 1 3 2\n", 2);
  CHECK(calotte::read_mesh(scratch / "mesh.off").neighbours ==
        (Triangles(3, 2) << 1, -1, -1, 0, -1, -1).finished());
  for (const char* faces : {"3 0 1 2\n3 0 1 2\n", "3 0 1 2\n3 1 3 2\n3 2 1 4\n"}) {
    write_faces(faces, static_cast<int>(std::count(faces, faces + std::strlen(faces), '\n')));
    CHECK(code_of([&] { calotte::read_mesh(scratch / "mesh.off"); }) == ErrorCode::parse);
  }
}

TEST_CASE("a VTK file has the structure that readers require") {
  const Scratch scratch;
  calotte::write(scratch / "mesh.vtp", scaled_octahedron());
  const std::string vtp = calotte::test::read_file(scratch / "mesh.vtp");
  for (const char* part :
       {"type=\"PolyData\"", "header_type=\"UInt64\"", "encoding=\"raw\">\n_",
        "NumberOfPolys=\"8\"",
        "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"",
        // After the fields of six cells, four of doubles and one of ints.
        "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"appended\" offset=\"408\"/>",
        "<DataArray type=\"Int64\" Name=\"offsets\" format=\"appended\" offset=\"608\"/>"})
    CHECK(has(vtp, part));
  const std::size_t data = vtp.find("\n_") + 2;
  std::uint64_t size = 0;
  std::memcpy(&size, &vtp[data + 608], sizeof size);
  CHECK(size == 64);
  std::int64_t last = 0;
  std::memcpy(&last, &vtp[data + 608 + 8 + 56], sizeof last);
  CHECK(last == 24);
}

TEST_CASE("files that are no mesh, or incomplete, give one clear error") {
  const Scratch scratch;
  const auto error = [&](const std::string& name, const Points3* points = nullptr) {
    return error_of([&] { calotte::read_mesh(scratch / name, points); });
  };
  for (const std::string name : {"mesh.vtp", "mesh.vtu", "mesh.ply", "mesh.off"}) {
    CAPTURE(name);
    calotte::write(scratch / name, scaled_octahedron());
    const std::string whole = calotte::test::read_file(scratch / name);
    for (std::size_t size = 0; size + 2 < whole.size(); size += 7) {
      CAPTURE(size);
      fs::remove(scratch / name); // some file systems bring what is overwritten to the disk
      write_text(scratch / name, whole.substr(0, size));
      CHECK(error(name).code() == ErrorCode::parse);
    }
    write_text(scratch / name, whole + "more\n");
    CHECK(error(name).code() == ErrorCode::parse);
  }
  write_text(scratch / "mesh.off", "OFF\n3 1 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 3\n");
  CHECK(std::string(error("mesh.off").what())
            .ends_with("mesh.off line 6: id 3 is not one of the 3 points; ids count from 0"));
  write_text(scratch / "mesh.off", "OFF\n3 1 0\n1 0 0\n0 1 0\n0 0 nan\n3 0 1 2\n");
  CHECK(std::string(error("mesh.off").what())
            .ends_with("point 2 has no direction (NaN, infinite or zero); make the file again"));
  write_text(scratch / "mesh.off", "OFF\n9999999999 1 0\n1 0 0\n");
  CHECK(error("mesh.off").index() == 3);
  write_text(scratch / "mesh.tri", "0 1 2\n0 1 x\n");
  const Points3 points = scaled_octahedron().points;
  CHECK(std::string(error("mesh.tri", &points).what())
            .ends_with("mesh.tri line 2: \"x\" is not a number; write three ids i j k on each "
                       "line, counted from 0"));
  write_text(scratch / "mesh.tri", "0 1 2\n0 1 -1\n");
  CHECK(error("mesh.tri", &points).index() == 2);
  CHECK(error("mesh.tri").code() == ErrorCode::invalid_argument);
  write_text(scratch / "mesh.tri", "");
  CHECK(error("mesh.tri", &points).code() == ErrorCode::parse);
  CHECK(error("mesh.xyz").code() == ErrorCode::invalid_argument);
  CHECK(error("absent.vtp").code() == ErrorCode::file);
}

TEST_CASE("unknown suffixes, folders that do not exist and full disks leave nothing behind") {
  const Scratch scratch;
  const Mesh mesh = scaled_octahedron();
  const auto error = [&](const std::string& path) {
    return error_of([&] { calotte::write(path, mesh); });
  };
  CHECK(error(scratch / "mesh.stl").code() == ErrorCode::invalid_argument);
  CHECK(std::string(error(scratch / "mesh").what())
            .ends_with(
                "mesh: no suffix; a mesh file ends in .nc, .g, .exo, .vtp, .vtu, .vtk (read only), "
                ".off, .ply, .msh, .geojson, .txt, .tri, .gr3, .ll, .14 or .2dm, or is named "
                "SaveVertices or nod2d.out"));
  CHECK(error(scratch / "absent/mesh.vtp").code() == ErrorCode::file);
  CHECK(code_of([&] { calotte::read_points(scratch / "absent.txt"); }) == ErrorCode::file);
  CHECK(code_of([&] { calotte::read_points(scratch.folder.string()); }) == ErrorCode::file);
  CHECK(scratch.files() == 0);
  CHECK(message_of([&] { calotte::write_points("/dev/full", mesh.points); }) ==
        "cannot write /dev/full: No space left on device; make room or write elsewhere");
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("a disk that fills up keeps the old file and removes the new one") {
  const Scratch scratch;
  calotte::write_file(scratch / "mesh.vtp", "old");
  std::string message;
  {
    const FullDisk disk(500);
    try {
      calotte::write(scratch / "mesh.vtp", scaled_octahedron());
    } catch (const Error& error) {
      message = error.what();
    }
  }
  CHECK(message == "cannot write " + (scratch / "mesh.vtp") +
                       ": File too large; make room or write elsewhere");
  CHECK(scratch.files() == 1);
  CHECK(calotte::test::read_file(scratch / "mesh.vtp") == "old");
}

TEST_CASE("a symbolic link stays one, and its target is replaced") {
  const Scratch scratch;
  fs::create_directory(scratch / "real");
  write_text(scratch / "real/mesh.off", "old");
  fs::create_symlink("real/mesh.off", scratch / "link.off");
  calotte::write(scratch / "link.off", scaled_octahedron());
  CHECK(fs::is_symlink(scratch / "link.off"));
  CHECK(calotte::test::read_file(scratch / "real/mesh.off").starts_with("OFF\n"));
}

TEST_CASE("the weather stations are read as they are") {
  const Points3 points =
      calotte::read_points(CALOTTE_FIXTURES "/weather-stations.csv", Columns::lonlat);
  CHECK(points.cols() > 28'000);
  CHECK((points.colwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
}

TEST_CASE("places in a plane are read as they stand, with their lines") {
  std::istringstream in("# two\nx;y\n1e-300;-2\n\n0x;0\n");
  CHECK_THROWS_WITH_AS(calotte::read_points(in, "points", Columns::xy),
                       "points line 5: \"0x\" is not a number; write two numbers x y on each line",
                       calotte::Error);
  std::istringstream good("x y\n1e-300 -2 7\n0 0\n");
  const auto [points, lines, further] = calotte::read_point_lines(good, "points", Columns::xy);
  CHECK(!further); // the header names the columns
  REQUIRE(points.cols() == 2);
  CHECK(points(0, 0) == 1e-300);
  CHECK(points(1, 0) == -2);
  CHECK(points.row(2).isZero(0));
  CHECK(lines == std::vector<std::int64_t>{2, 3});
}
