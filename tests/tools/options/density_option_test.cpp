// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/density_option.h"
#include "options/picture_density.h"
#include "options/region_option.h"
#include "support/errors.h"
#include "support/text.h"

#include <calotte/error.h>

#include <CLI/App.hpp>
#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <png.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <unistd.h>

using namespace calotte;
using namespace calotte::tools;

namespace {

DensityBump bump(const std::string& words) {
  const Density density = density_of(DensityWords{{"tanh:" + words}});
  REQUIRE(density.bumps.size() == 1);
  return density.bumps[0];
}

/// The message of a rejection without the common prefix.
std::string refused_density(const std::string& words) {
  try {
    density_of(DensityWords{{words}});
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    const std::string message = error.what(), start = "--density \"" + words + "\": ";
    REQUIRE(message.starts_with(start));
    return message.substr(start.size());
  }
  return "not refused";
}

} // namespace

TEST_CASE("a bump has the numbers of its words, in any order") {
  const DensityBump b = bump("gamma=x8,lon=270,lat=30,alpha=0.20,beta=30deg");
  CHECK(b.gamma == 1.0 / 4096);
  CHECK(b.alpha == 0.2);
  CHECK(b.beta == doctest::Approx(std::numbers::pi / 6).epsilon(1e-15));
  CHECK(b.stretch == 1);
  CHECK(b.centre.x() == 0);
  CHECK(b.centre.y() == doctest::Approx(-std::sqrt(0.75)).epsilon(1e-15));
  CHECK(b.centre.z() == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(bump("lon=-90,lat=0,beta=1,alpha=1,gamma=0.25").centre == Eigen::Vector3d(0, -1, 0));
  CHECK(bump("lon=77,lat=90,beta=1,alpha=1,gamma=0.25").centre == Eigen::Vector3d(0, 0, 1));
  CHECK(bump("lon=0,lat=0,beta=1,alpha=1,gamma=0.25").gamma == 0.25);
  CHECK(bump("lon=0,lat=0,beta=0.5,alpha=1e-3,gamma=x2").gamma == 1.0 / 16);
  CHECK(bump("lon=0,lat=0,beta=0.5,alpha=9deg,gamma=x2").alpha ==
        doctest::Approx(std::numbers::pi / 20).epsilon(1e-15));
}

TEST_CASE("the long axis of an ellipse points clockwise from north") {
  const std::string rest = ",beta=1,alpha=1,gamma=x2,stretch=3,azimuth=";
  const auto major = [&](const std::string& place, const std::string& azimuth) {
    return bump(place + rest + azimuth).major;
  };
  CHECK(bump("lon=0,lat=0" + rest + "0").stretch == 3);
  CHECK(major("lon=0,lat=0", "0") == Eigen::Vector3d(0, 0, 1));
  CHECK(major("lon=0,lat=0", "90") == Eigen::Vector3d(0, 1, 0));
  CHECK(major("lon=90,lat=0", "90") == Eigen::Vector3d(-1, 0, 0));
  CHECK(major("lon=0,lat=90", "0") == Eigen::Vector3d(-1, 0, 0)); // where all is south
  CHECK(major("lon=0,lat=-90", "0") == Eigen::Vector3d(1, 0, 0));
  for (const std::string place : {"lon=12,lat=34", "lon=200,lat=-56"}) {
    const DensityBump b = bump(place + rest + "71");
    CHECK(b.major.dot(b.centre) == doctest::Approx(0).epsilon(1e-15));
    CHECK(b.major.norm() == doctest::Approx(1).epsilon(1e-15));
    // The component towards north is cos 71, and north is where z rises.
    CHECK(b.major.z() == doctest::Approx(std::cos(71 * std::numbers::pi / 180) *
                                         std::hypot(b.centre.x(), b.centre.y())));
    CHECK(b.centre.cross(b.major).z() > 0); // clockwise: to the east of north
  }
}

TEST_CASE("several bumps are joined; without bumps the density is uniform") {
  const std::string one = "tanh:lon=0,lat=0,beta=1,alpha=1,gamma=x2";
  CHECK(density_of(DensityWords{}).uniform());
  CHECK(density_of(DensityWords{{"uniform"}}).uniform());
  CHECK(density_of(DensityWords{{one}}).kind == Density::Kind::maximum);
  CHECK(density_of(DensityWords{{one, one}, "sum"}).kind == Density::Kind::sum);
  CHECK(density_of(DensityWords{{one, one}}).bumps.size() == 2);
  const DensityBump usual =
      density_of(DensityWords{{"tanh:lon=270,lat=30,beta=30deg,alpha=0.2,gamma=x4"}}).bumps[0];
  const DensityBump small = density_of(DensityWords{{"x4"}}).bumps[0];
  CHECK(small.centre == usual.centre);
  CHECK(small.beta == usual.beta);
  CHECK(small.alpha == usual.alpha);
  CHECK(small.gamma == 1.0 / 256);
}

TEST_CASE("words that make no density are refused with the offending one") {
  const auto with = [](const std::string& changed) {
    std::string words = "tanh:lon=0,lat=0,beta=1,alpha=1,gamma=x2";
    const std::string key = changed.substr(0, changed.find('=') + 1);
    const std::size_t place = words.find(key);
    return words.replace(place, words.find_first_of(",", place) - place, changed);
  };
  for (const auto& [words, part] : std::vector<std::array<std::string, 2>>{
           {"gauss", "not a density; give uniform or, for instance, x8 or tanh:lon=270,lat=30,"},
           {"", "not a density"},
           {"x", "not a density"},
           {"x0", "such a number, or x8 for spacings of 8:1"},
           {"tanh:",
            "lon is missing; write it as tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8"},
           {"tanh:lon=0,lat=0,beta=1,alpha=1", "gamma is missing"},
           {"tanh:lon=0,lon=1", "lon is given twice; leave one out"},
           {"tanh:lon", "\"lon\" is not key=value"},
           {"tanh:lon=0,,lat=0", "\"\" is not key=value"},
           {"tanh:width=2",
            "unknown key \"width\"; the keys are lon, lat, beta, alpha, gamma, stretch,"},
           {with("lon=east"), "lon \"east\" is not a number; give degrees"},
           {with("lon=inf"), "lon \"inf\" is not a number"},
           {with("lat=90.5"), "lat \"90.5\" is outside -90 to 90; give degrees north"},
           {with("alpha=0"), "alpha \"0\" is not a positive angle"},
           {with("gamma=x2,stretch=2"),
            "stretch and azimuth define an ellipse together; give both or none"},
           {with("gamma=x2,stretch=0.5,azimuth=0"),
            "stretch \"0.5\" is not a number >= 1; give the ratio"},
           {with("gamma=x2,stretch=2,azimuth=n"), "azimuth \"n\" is not a number; give degrees"}})
    CHECK(test::has(refused_density(words), part));
  for (const std::string beta : {"0", "-1", "nan", "", "1rad", "deg", "0deg"})
    CHECK(refused_density(with("beta=" + beta)) ==
          "beta \"" + beta + "\" is not a positive angle; give radians, or degrees as 30deg");
  for (const std::string gamma : {"0", "1", "-0.5", "x1", "x0", "x", "x-2x", "nan", "x1e200"})
    CHECK(refused_density(with("gamma=" + gamma))
              .starts_with("gamma \"" + gamma + "\" is not between 0 and 1; give such a number"));
  CHECK_THROWS_AS(density_of(DensityWords{{"uniform", "uniform"}}), Error);
}

// ---- Cell widths

namespace {

/// A temporary file, removed at the end of the test.
class TextFile {
public:
  TextFile(const std::string& suffix, const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("calotte-density-" + std::to_string(::getpid()) + suffix)) {
    write(text);
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::string path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// 100 km wide everywhere except at one place.
std::string jigsaw_grid(const std::string& elsewhere) {
  std::string text = "MSHID=3;ELLIPSOID-GRID\nNDIMS=2\nCOORD=1;4\n0\n1.5707963267948966\n"
                     "3.141592653589793\n4.71238898038469\nCOORD=2;3\n-1.5707963267948966\n0\n"
                     "1.5707963267948966\nVALUE=12;1\n100\n" +
                     elsewhere + "\n";
  for (int i = 0; i < 10; ++i)
    text += "100\n";
  return text;
}

DensityWords parsed(const std::vector<std::string>& arguments) {
  CLI::App app;
  const std::shared_ptr<DensityWords> words = add_density(app);
  app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  return *words;
}

std::string message_of(const DensityWords& words) {
  return test::message_of([&] { resolution_of(words); });
}

Raster raster_of(const DensityWords& words) {
  return calotte::sampled(std::get<WidthRules>(resolution_of(words)).widths);
}

} // namespace

TEST_CASE("cell widths replace a density, and their contents belong to the configuration") {
  const TextFile file(".msh", jigsaw_grid("200"));
  const DensityWords words = parsed({"--cell-width", file.path()});
  const DensityOfWidths resolution = sampled(words);
  REQUIRE(resolution.widths);
  CHECK(raster_of(words).values(0, 1) == 200);
  CHECK(evaluate(resolution.density, Eigen::Vector3d(-1, 0, 0))[0] == 1);
  CHECK(evaluate(resolution.density, Eigen::Vector3d(1, 0, 0))[0] == doctest::Approx(1.0 / 16));
  CHECK(density_names(words) == std::vector<std::string>{"cell widths of " + file.path()});

  const std::string before = density_configuration(words);
  CHECK(density_configuration(words) == before);
  file.write(jigsaw_grid("201"));
  CHECK(density_configuration(words) != before);
  CHECK(density_configuration(parsed({"--cell-width", file.path(), "--earth-radius", "1000"})) !=
        density_configuration(words));
  std::filesystem::remove(file.path());
  CHECK_THROWS_AS(density_configuration(words), Error);
  CHECK_THROWS_AS(density_of(words), Error);

  CHECK(density_configuration(DensityWords{}) == "density uniform\n");
  CHECK(density_configuration(DensityWords{{"a", "b"}, "sum"}) ==
        "density a\ndensity b\njoin sum\n");
}

TEST_CASE("the widths' notes tell their range, number and gradient, and warn of a steep one") {
  const TextFile file(".msh", jigsaw_grid("100"));
  DensityWords words = parsed({"--cell-width", file.path()});
  Raster widths = raster_of(words);
  const double implied = implied_cells(widths);
  const std::string cells = std::to_string(std::llround(implied));
  const Unit km = unit_of("km", earth_radius_km);
  std::vector<std::string> notes = notes_on(widths, words.widths, words.widths.gradient, {}, km);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == file.path() + ": cells 100 to 100 km wide, at 12 nodes, require " + cells +
                        " cells; largest gradient 0 km per km");
  notes = notes_on(widths, words.widths, {}, std::llround(implied / 4), km);
  CHECK(test::has(notes[0], "; with " + std::to_string(std::llround(implied / 4)) +
                                " cells, widths are 2 times as large;"));
  notes = notes_on(widths, words.widths, {}, {}, unit_of("degrees", earth_radius_km));
  CHECK(
      test::has(notes[0], ": cells 0.8993 to 0.8993 degrees wide, at 12 nodes, require " + cells));
  // 500 km over 10 007 km either way; half a cell from the tip 1 - 300/10 007 of that.
  widths.values(1, 1) = 600;
  notes = notes_on(widths, words.widths, words.widths.gradient, {}, km);
  REQUIRE(notes.size() == 2);
  CHECK(notes[1] == "warning: the cell width changes by 0.069 km per km at 90.0 E 0.0 N, above "
                    "0.03, the limit for most models; give --gradient 0.03");
  words = parsed({"--cell-width", file.path(), "--gradient", "0.05"});
  notes = notes_on(widths, words.widths, words.widths.gradient, {}, km);
  REQUIRE(notes.size() == 2);
  CHECK(test::has(notes[1], "changes by 0.05 km per km"));
  CHECK(notes[1].ends_with("; give a smaller --gradient"));
}

TEST_CASE("a limit of the gradient lowers the widths around the narrow ones") {
  const TextFile file(".msh", jigsaw_grid("400"));
  const std::vector<std::string> arguments{"--cell-width", file.path(), "--gradient", "0.01"};
  const Raster given = raster_of(parsed({"--cell-width", file.path()})),
               limited = raster_of(parsed(arguments));
  CHECK(limited.values == limit_gradient(given, 0.01).values);
  CHECK(limited.values != given.values);
  CHECK(density_configuration(parsed(arguments)) !=
        density_configuration(parsed({"--cell-width", file.path()})));
}

TEST_CASE("options of widths that do not go together are refused") {
  const TextFile file(".msh", jigsaw_grid("100"));
  CHECK(message_of(parsed({"--cell-width", file.path(), "--transition", "100"})) ==
        file.path() + " holds no polygons; leave --transition out");
  CHECK(message_of(parsed({"--cell-width", "a.gpkg", "--transition", "100"}))
            .starts_with("a.gpkg: this is a GeoPackage"));
  CHECK(message_of(parsed({"--cell-width", "absent.nc"})) != "not refused");
  CHECK(message_of(parsed({"--density-raster", "absent.nc"})) != "not refused");
  const auto check_usage = [](const std::vector<std::string>& arguments) {
    CHECK_THROWS_AS(parsed(arguments), CLI::ParseError);
  };
  check_usage({"--cell-width", "a.nc", "--density", "uniform"});
  check_usage({"--density-raster", "a.nc", "--density", "uniform"});
  check_usage({"--density-raster", "a.nc", "--cell-width", "a.nc"});
  check_usage({"--transition", "100"});
  for (const std::string width : {"0", "-1", "nan", "inf", "1deg", ""})
    check_usage({"--cell-width", "a.geojson", "--outside-width", width});
}

namespace {

/// A picture of width 3, of pixels red, green, blue, alpha, row by row from the top.
void write_png(const std::string& path, const std::vector<std::uint8_t>& bytes,
               unsigned width = 3) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = PNG_FORMAT_RGBA;
  image.width = width;
  image.height = static_cast<unsigned>(bytes.size() / 4) / width;
  REQUIRE(png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) != 0);
}

} // namespace

TEST_CASE("a picture is a density of the plane: its darkness squared, y upwards, white not 0") {
  const TextFile file(".PNG", "");
  const std::string& path = file.path();
  write_png(path,
            {0,   0, 0, 255, 255, 255, 255, 255, 0,   0,   0,   0, // black, white, transparent
             255, 0, 0, 255, 51,  51,  51,  255, 255, 255, 255, 255});
  CHECK(is_picture(path));
  CHECK(rectangle_of_picture(path) == "0,0,3,2");
  const Raster raster = read_picture(path);
  CHECK(raster.of_plane);
  CHECK(raster.x == Eigen::Vector3d(0.5, 1.5, 2.5));
  CHECK(raster.y == Eigen::Vector2d(0.5, 1.5));
  const double white = 1 / 255.0 / 255.0;
  CHECK(raster.values(0, 1) == 1);
  CHECK(raster.values(1, 1) == doctest::Approx(white));
  CHECK(raster.values(2, 1) == doctest::Approx(white));
  CHECK(raster.values(1, 0) == doctest::Approx(0.64));
  CHECK(std::abs(std::sqrt(raster.values(0, 0)) - 0.5) < 0.01); // the luminance of red is 0.2126
  const Points3 black = Eigen::Vector3d(0.2, 1.9, 0);
  const auto options = parsed({"--density-raster", path});
  CHECK(evaluate(density_of(options, Surface::plane()), black, Surface::plane())[0] == 1);
  CHECK(message_of(options) == path + ": a picture is a density of the plane, not of the sphere; "
                                      "give NetCDF density(lat, lon)");
}

TEST_CASE("a picture without dark parts, too small or damaged is refused") {
  const TextFile file(".png", "no picture");
  const auto refused = [&] { return test::message_of([&] { read_picture(file.path()); }); };
  CHECK(test::has(refused(), ": it is no PNG, or is damaged"));
  write_png(file.path(), std::vector<std::uint8_t>(24, 255));
  CHECK(test::has(refused(), ": the picture is white everywhere"));
  std::vector<std::uint8_t> bytes(16, 0);
  write_png(file.path(), bytes, 4);
  CHECK(test::has(refused(),
                  ": the picture has 4 x 1 pixels; give one of 2 x 2 to 100000000 pixels"));
  write_png(file.path(), std::vector<std::uint8_t>(40000, 7), 100);
  std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 20);
  CHECK(test::has(refused(), ": it is no PNG, or is damaged"));
}

/// The message of a rejection of a word of --region.
static std::string refused_region(const std::string& word) {
  return test::message_of([&] { region_of(word, ""); });
}

TEST_CASE("--region: shapes") {
  const Eigen::Vector3d west(0, -1, 0);
  CHECK(region_of("circle=-90,0,637.1km", "") == circle(west, 0.1));
  CHECK(region_of("circle=270,0,637100m", "") == circle(west, 0.1));
  CHECK(region_of("circle=-90,0,30deg", "") == circle(west, std::numbers::pi / 6));
  CHECK(region_of("circle=-90,0,100km", "", 1000) == circle(west, 0.1));
  CHECK(region_of("ellipse=-90deg,0,1274.2km,637.1km,90", "") ==
        ellipse(west, 0.2, 0.1, std::numbers::pi / 2));
  CHECK(region_of("box=-20,30,40,60deg", "") == box(-std::numbers::pi / 9, std::numbers::pi / 6,
                                                    std::numbers::pi * 2 / 9,
                                                    std::numbers::pi / 3));
  CHECK(region_of("channel=-90,45", "") == channel(-std::numbers::pi / 2, std::numbers::pi / 4));
}

TEST_CASE("--region: words that are refused") {
  for (const auto& [word, part] : std::vector<std::array<std::string, 2>>{
           {"circle=1,2", "--region circle=1,2: the number of values is 2 instead of 3; give "
                          "circle=LON,LAT,RADIUS"},
           {"circle=1,2,3,4", "is 4 instead of 3"},
           {"circle=1,100,3km", "\"100\" is no latitude from -90 to 90 degrees"},
           {"circle=1,2,200deg",
            "\"200deg\" is 200 degrees, half of the way round the sphere or more; give circle="},
           {"ellipse=1,2,3km,4km,0", "give the major one first"},
           {"channel=20,10", "give the lower one first"},
           {"channel=20",
            "the number of values is 1 instead of 2; give channel=LOWER,UPPER, as in"},
           {"box=1,2,3", "--region box=1,2,3: the number of values is 3 instead of 4; give "
                         "box=WEST,SOUTH,EAST,NORTH, as in box=-20,30,40,60"},
           {"box=20,120,-40,10", "\"120\" is no latitude from -90 to 90 degrees; give box=WEST,"},
           {"box=0,40,20,20",
            "the box's latitudes are 40 and 20 degrees; give the lower one first"},
           {"box=-180,-90,180,90", "is the whole sphere; give no region"},
           {"circle(1,2,3km)", "--region circle(1,2,3km): this is no shape; write "
                               "circle=LON,LAT,RADIUS, as in circle=-105,40,1000km"},
           {"bbox=1,2,3,4", "--region bbox=1,2,3,4: there is no such shape, and no such file; give "
                            "circle=LON,LAT,RADIUS, ellipse=LON,LAT,MAJOR,MINOR,BEARING, "
                            "box=WEST,SOUTH,EAST,NORTH, channel=LOWER,UPPER, land=FILE,LON,LAT, or "
                            "the file of a region (.geojson, .json, .shp or .pts)"},
           {"0,0,20,20", "there is no such shape, and no such file; give circle="},
           {"europe", "there is no such shape, and no such file; give circle="},
           {"R.txt", "R.txt: the name determines no format of regions"},
           {"absent.geojson", "absent.geojson"}})
    CHECK(test::has(refused_region(word), part));
  for (const std::string radius : {"3", "-3km", "0km", "km", "3miles", "", "nan"})
    CHECK(test::has(refused_region("circle=1,2," + radius),
                    "\"" + radius + "\" is no positive length such as 1000km"));
}

TEST_CASE("--region: a configuration names the corners") {
  const Surface region = region_of("channel=-90,45", "");
  CHECK(
      region_configuration(region).starts_with("region of 1 rings and 360 corners with checksum "));
  CHECK(region_configuration(region) != region_configuration(region_of("channel=-90,46", "")));
}
