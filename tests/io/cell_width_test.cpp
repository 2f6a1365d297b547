// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/read.h>
#include <calotte/write.h>

#include "base/lonlat.h"
#include "base/spherical_angles.h"
#include "exact/predicates.h"
#include "io/geojson_text.h"
#include "io/netcdf/netcdf_writer.h"
#include "support/constants.h"
#include "support/files.h"
#include "support/random.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using Field = std::function<double(double longitude, double latitude)>; ///< of degrees

/// A field sampled on columns x rows boxes, from a longitude on; poles included.
Raster sampled_field(const Field& field, Eigen::Index columns, Eigen::Index rows,
                     double west = -180) {
  Raster width;
  width.x = west + (Eigen::VectorXd::LinSpaced(columns + 1, 0, 360).head(columns).array());
  width.y = Eigen::VectorXd::LinSpaced(rows + 1, -90, 90);
  width.values.resize(columns, rows + 1);
  for (Eigen::Index j = 0; j <= rows; ++j)
    for (Eigen::Index i = 0; i < columns; ++i)
      width.values(i, j) = field(width.x[i], width.y[j]);
  return width;
}

Raster constant(double width) {
  return sampled_field([=](double, double) { return width; }, 12, 6);
}

Points3 points_at(const std::vector<std::pair<double, double>>& lonlats) {
  Points3 points(3, static_cast<Eigen::Index>(lonlats.size()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const auto& [longitude, latitude] = lonlats[static_cast<std::size_t>(i)];
    const base_detail::Vec3 p = base_detail::from_lonlat(longitude, latitude);
    points.col(i) << p.x, p.y, p.z;
  }
  return points;
}

double width_at(const Raster& width, double longitude, double latitude) {
  return evaluate(width, points_at({{longitude, latitude}}))[0];
}

/// Smooth on the sphere: a function of Cartesian coordinates.
double smooth(double longitude, double latitude) {
  const base_detail::Vec3 p = base_detail::from_lonlat(longitude, latitude);
  return 100 + 30 * p.x * p.y + 20 * p.z * p.z * p.z - 15 * p.y;
}

/// A folder of input files, removed at the end of the test.
class InputFolder {
public:
  std::string operator()(const std::string& name) const { return scratch_ / name; }
  std::string operator()(const std::string& name, const std::string& text) const {
    write_text((*this)(name), text);
    return (*this)(name);
  }

private:
  Scratch scratch_;
};

/// What a NetCDF raster holds.
struct StoredRaster {
  std::vector<double> lon, lat, values; ///< values lat by lon
  std::string variable = "cellWidth";
  std::string lat_name = "lat", lon_name = "lon";
  bool transposed = false;
  io_detail::NetcdfAttributes attributes = {};
};

StoredRaster raster_of_widths(const Raster& width) {
  StoredRaster raster;
  raster.lon.assign(width.x.begin(), width.x.end());
  raster.lat.assign(width.y.begin(), width.y.end());
  raster.values.assign(width.values.data(), width.values.data() + width.values.size());
  return raster;
}

void put(io_detail::NetcdfWriter& file, int variable, const std::vector<double>& values,
         std::size_t row) {
  file.put(variable, [&](std::int64_t begin, std::int64_t end, double* out) {
    std::copy(values.begin() + begin * static_cast<std::ptrdiff_t>(row),
              values.begin() + end * static_cast<std::ptrdiff_t>(row), out);
  });
}

std::string raster_file(const InputFolder& folder, const StoredRaster& raster) {
  const std::string path = folder("raster.nc");
  io_detail::NetcdfWriter file(path);
  const int lat = file.dimension("lat", static_cast<std::int64_t>(raster.lat.size())),
            lon = file.dimension("lon", static_cast<std::int64_t>(raster.lon.size()));
  const auto type = io_detail::NetcdfType::float64;
  const int lats = file.variable(raster.lat_name, type, {lat}),
            lons = file.variable(raster.lon_name, type, {lon});
  const std::vector<int> dimensions =
      raster.transposed ? std::vector{lon, lat} : std::vector{lat, lon};
  const int widths = file.variable(raster.variable, type, dimensions, raster.attributes);
  file.begin();
  put(file, lats, raster.lat, 1);
  put(file, lons, raster.lon, 1);
  put(file, widths, raster.values, raster.transposed ? raster.lat.size() : raster.lon.size());
  file.commit();
  return path;
}

/// The message of a refusal, without the path.
std::string refusal_of_widths(const std::string& path, const PolygonWidths& widths = {},
                              ErrorCode code = ErrorCode::parse) {
  try {
    read_cell_width(path, widths);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    REQUIRE(message.starts_with(path));
    return message.substr(path.size());
  }
  return "not refused";
}

void check_same_widths(const Raster& a, const Raster& b) {
  CHECK(a.x == b.x);
  CHECK(a.y == b.y);
  CHECK(a.values == b.values);
}

} // namespace

// ---- Angles

TEST_CASE("longitude and latitude agree with the C library's to 1e-15") {
  Random random(1);
  double worst = 0;
  const auto compare = [&](const base_detail::Vec3& p) {
    worst = std::max({worst, std::abs(base_detail::longitude_of(p.x, p.y) - std::atan2(p.y, p.x)),
                      std::abs(base_detail::latitude_of(p.x, p.y, p.z) -
                               std::atan2(p.z, std::hypot(p.x, p.y)))});
  };
  for (int i = 0; i < 100000; ++i) {
    const base_detail::Vec3 p = random.direction();
    compare(p);
    const double tiny = std::pow(10, random.real(-30, 0)); // near an axis
    compare(exact_detail::normalised({p.x, p.y * tiny, p.z}));
    compare(exact_detail::normalised({p.x * tiny, p.y * tiny, p.z}));
  }
  CHECK(worst < 1e-15);
  for (const double sign : {-1.0, 1.0}) {
    CHECK(base_detail::longitude_of(-1, sign * 0.0) == sign * pi);
    CHECK(base_detail::latitude_of(0, 0, sign) == sign * pi / 2);
  }
  CHECK(base_detail::longitude_of(0, 0) == 0);
}

// ---- The field

TEST_CASE("a constant width is the uniform density and gives the hexagons that fill the sphere") {
  for (const double h : {30.0, 120.0, 0.1}) {
    const Raster width = constant(h);
    const double hexagon = std::sqrt(3) / 2 * h * h;
    CHECK(implied_cells(width) * hexagon ==
          doctest::Approx(4 * pi * earth_radius_km * earth_radius_km).epsilon(1e-13));
    CHECK(implied_cells(width, {}, 1) * hexagon == doctest::Approx(4 * pi).epsilon(1e-13));
    CHECK(largest_gradient(width).slope == 0);
    CHECK(evaluate(density_of(width), random_sphere(1000)).isOnes(0));
    CHECK(evaluate(width, random_sphere(1000)).isConstant(h, 0));
  }
}

TEST_CASE("the density is (least width / width)^4, in blocks of any size") {
  const Raster width = sampled_field(smooth, 36, 18);
  const Points3 points = random_sphere(1000);
  const Eigen::VectorXd h = evaluate(width, points), rho = evaluate(density_of(width), points);
  const double least = width.values.minCoeff();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    CHECK(rho[i] == doctest::Approx(std::pow(least / h[i], 4)).epsilon(1e-14));
    Eigen::VectorXd alone(1);
    alone = evaluate(density_of(width), Points3(points.col(i)));
    CHECK(alone[0] == rho[i]);
  }
}

TEST_CASE("nodes keep their widths; fields are continuous over the seam and at the poles") {
  Random random(2);
  const auto noise = [&](double, double) { return random.real(10, 100); };
  for (const double west : {-180.0, 0.0, 0.5, -179.5, 359.0, -725.0}) {
    CAPTURE(west);
    const Raster width = sampled_field(noise, 24, 12, west);
    for (Eigen::Index j = 1; j < 12; ++j)
      for (Eigen::Index i = 0; i < 24; ++i)
        CHECK(width_at(width, width.x[i], width.y[j]) ==
              doctest::Approx(width.values(i, j)).epsilon(1e-12));
    for (const double latitude : {-81.3, 0.2, 44.0}) {
      CHECK(width_at(width, 180 - 1e-9, latitude) ==
            doctest::Approx(width_at(width, -180 + 1e-9, latitude)).epsilon(1e-8));
      CHECK(width_at(width, west - 1e-9, latitude) ==
            doctest::Approx(width_at(width, west + 1e-9, latitude)).epsilon(1e-8));
    }
    for (const double pole : {-90.0, 90.0})
      for (const double longitude : {0.0, 77.0, 200.0})
        CHECK(width_at(width, longitude, pole * (1 - 1e-10)) ==
              doctest::Approx(width.values.col(pole < 0 ? 0 : 12).mean()).epsilon(1e-8));
  }
}

TEST_CASE("rows that end short of the poles lead to their mean there") {
  Random random(3);
  Raster width = sampled_field([&](double, double) { return random.real(10, 100); }, 24, 12);
  width.y = width.y * (82.5 / 90);
  const double mean = width.values.col(12).mean();
  CHECK(width_at(width, 30, 90) == doctest::Approx(mean).epsilon(1e-13));
  CHECK(width_at(width, 30, 86.25) == doctest::Approx(0.5 * (mean + width.values(14, 12))));
  CHECK(width_at(width, 30, 82.5) == doctest::Approx(width.values(14, 12)));
}

TEST_CASE("irregular grids are interpolated as a search through all nodes has it") {
  Random random(4);
  Raster width;
  std::vector<double> longitudes, latitudes;
  for (int i = 0; i < 40; ++i) {
    longitudes.push_back(-100 + 355 * std::pow(random.real(0, 1), 4)); // crowded at one end
    latitudes.push_back(random.real(-85, 85));
  }
  std::sort(longitudes.begin(), longitudes.end());
  std::sort(latitudes.begin(), latitudes.end());
  width.x = Eigen::Map<Eigen::VectorXd>(longitudes.data(), 40);
  width.y = Eigen::Map<Eigen::VectorXd>(latitudes.data(), 40);
  width.values = Eigen::MatrixXd::NullaryExpr(40, 40, [&] { return random.real(1, 2); });
  for (int k = 0; k < 1000; ++k) {
    const double latitude = random.real(latitudes.front(), latitudes.back()),
                 longitude = random.real(longitudes.front(), longitudes.front() + 360);
    const auto j =
        std::upper_bound(latitudes.begin(), latitudes.end() - 1, latitude) - latitudes.begin() - 1;
    const auto i =
        std::upper_bound(longitudes.begin(), longitudes.end(), longitude) - longitudes.begin() - 1;
    const double east = i < 39 ? longitudes[static_cast<std::size_t>(i) + 1] : longitudes[0] + 360;
    const double u = (longitude - width.x[i]) / (east - width.x[i]),
                 v = (latitude - width.y[j]) / (width.y[j + 1] - width.y[j]);
    const Eigen::Index next = (i + 1) % 40;
    const double expected = (1 - v) * ((1 - u) * width.values(i, j) + u * width.values(next, j)) +
                            v * ((1 - u) * width.values(i, j + 1) + u * width.values(next, j + 1));
    CHECK(width_at(width, longitude, latitude) == doctest::Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("a raster of a smooth field converges at second order, and so does its number of cells") {
  const Points3 points = random_sphere(2000);
  Eigen::VectorXd exact(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    exact[i] =
        100 + 30 * points(0, i) * points(1, i) + 20 * std::pow(points(2, i), 3) - 15 * points(1, i);
  const auto error = [&](Eigen::Index rows) {
    return (evaluate(sampled_field(smooth, 2 * rows, rows), points) - exact).cwiseAbs().maxCoeff();
  };
  CHECK(error(36) / error(72) > 3.4);
  CHECK(error(72) / error(144) > 3.4);
  // 1/h^2 = 1 + z/2 + x y, whose mean over the sphere is 1.
  const Field hexagonal = [](double longitude, double latitude) {
    const base_detail::Vec3 p = base_detail::from_lonlat(longitude, latitude);
    return 1 / std::sqrt(1 + 0.5 * p.z + p.x * p.y / 2);
  };
  const auto excess = [&](Eigen::Index rows) {
    return implied_cells(sampled_field(hexagonal, 2 * rows, rows), {}, 1) /
               (8 * pi / std::sqrt(3)) -
           1;
  };
  CHECK(std::abs(excess(72)) < 1e-3);
  CHECK(excess(36) / excess(72) == doctest::Approx(4).epsilon(0.02));
}

/// The mean of the gradient of the interpolated widths over the square of a cell's width in the
/// corner of a box, from many differences; the largest of all corners.
static double largest_mean_gradient(const Raster& width, double radius) {
  constexpr int parts = 24;
  double largest = 0;
  const Eigen::Index columns = width.x.size(), rows = width.y.size();
  for (Eigen::Index j = 0; j + 1 < rows; ++j)
    for (Eigen::Index i = 0; i < columns; ++i) {
      const double west = width.x[i], south = width.y[j];
      const double length = (i + 1 < columns ? width.x[i + 1] : width.x[0] + 360) - west,
                   height = width.y[j + 1] - south;
      for (const bool upper : {false, true})
        for (const bool eastern : {false, true}) {
          const double size = width.values((i + (eastern ? 1 : 0)) % columns, j + (upper ? 1 : 0)) /
                              radius / degree;
          const double tall = std::min(size, height),
                       cosine = std::cos((upper ? south + height - tall / 2 : south + tall / 2) *
                                         degree),
                       wide = std::min(size / cosine, length);
          const double x = eastern ? west + length - wide : west,
                       y = upper ? south + height - tall : south;
          std::vector<std::pair<double, double>> sides; // east, west, north and south of each part
          for (int k = 0; k < parts; ++k) {
            const double part = (k + 0.5) / parts;
            sides.insert(sides.end(), {{x + wide, y + part * tall},
                                       {x, y + part * tall},
                                       {x + part * wide, y + tall},
                                       {x + part * wide, y}});
          }
          const Eigen::VectorXd h = evaluate(width, points_at(sides));
          Eigen::Vector2d sum(0, 0);
          for (int k = 0; k < parts; ++k) {
            sum.x() += (h[4 * k] - h[4 * k + 1]) / (wide * degree * cosine);
            sum.y() += (h[4 * k + 2] - h[4 * k + 3]) / (tall * degree);
          }
          largest = std::max(largest, sum.norm() / parts / radius);
        }
    }
  return largest;
}

TEST_CASE("the largest gradient is the largest mean over a cell, where it is") {
  // Along meridians: 3 km a degree up to 30 N.
  const Field ramp = [](double, double latitude) {
    return 100 + 3 * std::clamp(latitude, 0.0, 30.0);
  };
  const WidthGradient up = largest_gradient(sampled_field(ramp, 36, 36));
  CHECK(up.slope == doctest::Approx(3 / (degree * earth_radius_km)).epsilon(1e-12));
  CHECK(up.latitude >= -1e-9);
  CHECK(up.latitude <= 30 + 1e-9);
  // Poles aside, of noise and of cells smaller and larger than the boxes, of 7.5 and 15 degrees.
  Random random(5);
  for (const double scale : {1e-3, 500.0, 1200.0, 1e5}) {
    CAPTURE(scale);
    Raster noise = sampled_field([&](double, double) { return scale * random.real(1, 2); }, 24, 24);
    for (const Eigen::Index row : {0, 1, 23, 24})
      noise.values.col(row).setConstant(1.5 * scale);
    const WidthGradient most = largest_gradient(noise);
    CHECK(most.slope ==
          doctest::Approx(largest_mean_gradient(noise, earth_radius_km)).epsilon(1e-3));
    CHECK(largest_gradient(noise, 2 * earth_radius_km).slope > 0.4 * most.slope);
    CHECK(std::abs(most.latitude) < 83); // of the last row but one
  }
  // From pole to pole without a row between.
  Raster poles = sampled_field([](double, double latitude) { return latitude < 0 ? 1 : 2; }, 4, 1);
  CHECK(largest_gradient(poles, 1).slope == doctest::Approx(1 / pi));
}

TEST_CASE("the gradient of sampled widths is theirs, not that of the tips of their interpolation") {
  // A cone around 10 E 20 N, which is a node, of 0.05 km per km.
  const Eigen::Vector3d tip = points_at({{10, 20}}).col(0);
  const Field cone = [&](double longitude, double latitude) {
    const Eigen::Vector3d x = points_at({{longitude, latitude}}).col(0);
    return 60 + 0.05 * earth_radius_km * std::atan2(x.cross(tip).norm(), x.dot(tip));
  };
  const WidthGradient fine = largest_gradient(sampled_field(cone, 720, 360));
  CHECK(fine.slope > 0.0499);
  CHECK(fine.slope < 0.0535); // 1.08 at most: four sampled edges of a box allow no more
  // Nodes 20 cells apart: there the interpolated widths are steeper, over whole cells.
  const Field small = [&](double longitude, double latitude) {
    return cone(longitude, latitude) - 50;
  };
  CHECK(largest_gradient(sampled_field(small, 180, 90)).slope > 0.065);
}

TEST_CASE("widths cover a region with half of a step to spare") {
  const auto part = [](double west, double east, double south, double north, double step) {
    Raster width;
    const auto columns = static_cast<Eigen::Index>(std::lround((east - west) / step)) + 1,
               rows = static_cast<Eigen::Index>(std::lround((north - south) / step)) + 1;
    width.x = Eigen::VectorXd::LinSpaced(columns, west, east);
    width.y = Eigen::VectorXd::LinSpaced(rows, south, north);
    width.values.setConstant(columns, rows, 60);
    return width;
  };
  const auto refusal_of = [](const Raster& width, const Surface& region) -> std::string {
    try {
      require_covering(width, region);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      return error.what();
    }
    return "";
  };
  const auto disc = [](double longitude, double latitude, double degrees) {
    return circle(points_at({{longitude, latitude}}).col(0), degrees * degree);
  };
  const Raster america = part(-125, -55, 10, 60, 1);
  CHECK(refusal_of(america, disc(-90, 35, 20)) == "");
  CHECK(refusal_of(america, disc(270, 35, 24.4)) == ""); // to 10.6 N
  CHECK(refusal_of(america, disc(-90, 35, 25.4)) == ""); // to 9.6 N
  CHECK(
      refusal_of(america, disc(-90, 35, 26))
          .starts_with("cell width: longitude runs from -125 to -55, latitude runs from 10 to 60, "
                       "and leaves out the place "));
  CHECK(refusal_of(america, disc(90, 35, 20)) != "");
  CHECK(refusal_of(america, {}) == "cell width: longitude runs from -125 to -55 and leaves part of "
                                   "the sphere out; give a global raster in degrees");
  // A region around all that is covered, whose boundary is not.
  CHECK(refusal_of(america, disc(-90, 35, 80)) != "");
  // Its boundary is covered, but it holds what lies outside it.
  const Points3 ring = disc(-90, 35, 20).rings()[0].rowwise().reverse();
  const Surface outside = Surface::sphere().within({ring});
  CHECK(refusal_of(america, outside) != "");
  const Raster arctic = part(-180, 179, 60, 90, 1);
  CHECK(refusal_of(arctic, disc(0, 90, 25)) == "");
  CHECK(refusal_of(arctic, disc(30, 70, 15)) != "");
  CHECK(refusal_of(part(-180, 179, -90, 90, 1), {}) == "");
  // Over the date line, by either name of its longitudes.
  for (const double turn : {0.0, 360.0}) {
    CHECK(refusal_of(part(150 + turn, 210 + turn, -30, 30, 0.5), disc(180, 0, 25)) == "");
    CHECK(refusal_of(part(-210 + turn, -150 + turn, -30, 30, 0.5), disc(-180, 0, 25)) == "");
    CHECK(refusal_of(part(150 + turn, 210 + turn, -30, 30, 0.5), disc(0, 0, 25)) != "");
  }
}

TEST_CASE("invalid grids are refused") {
  const auto refused = [](const std::function<void(Raster&)>& spoil) {
    Raster width = constant(10);
    spoil(width);
    CHECK_THROWS_AS(density_of(width), Error);
    CHECK_THROWS_AS(implied_cells(width), Error);
  };
  refused([](Raster& width) { width = {}; });
  refused([](Raster& width) { width.values(3, 2) = 0; });
  refused([](Raster& width) { width.values(3, 2) = std::nan(""); });
  refused([](Raster& width) { width.values.conservativeResize(11, 7); });
  refused([](Raster& width) { std::swap(width.y[1], width.y[2]); });
  refused([](Raster& width) { width.x[11] = 180; });
  refused([](Raster& width) { width.y[0] = -91; });
  CHECK_THROWS_AS(implied_cells(constant(1), {}, 0), Error);
  CHECK_THROWS_AS(largest_gradient(constant(1), -1), Error);
}

// ---- NetCDF

TEST_CASE("a NetCDF raster comes in whatever order of meridians and parallels") {
  const InputFolder folder;
  const Raster width = sampled_field(smooth, 24, 12, -180);
  check_same_widths(read_cell_width(raster_file(folder, raster_of_widths(width))), width);

  const Raster east = sampled_field(smooth, 24, 12, 0);
  check_same_widths(read_cell_width(raster_file(folder, raster_of_widths(east))), east);
  const Points3 points = random_sphere(200);
  CHECK((evaluate(east, points) - evaluate(width, points)).cwiseAbs().maxCoeff() < 1e-10);

  StoredRaster repeated = raster_of_widths(width);
  repeated.lon.push_back(180);
  for (std::size_t row = 13; row-- > 0;)
    repeated.values.insert(repeated.values.begin() + static_cast<std::ptrdiff_t>(24 * row + 24),
                           repeated.values[24 * row]);
  check_same_widths(read_cell_width(raster_file(folder, repeated)), width);

  StoredRaster descending = raster_of_widths(width);
  std::reverse(descending.lat.begin(), descending.lat.end());
  std::reverse(descending.values.begin(), descending.values.end());
  for (std::size_t row = 0; row < 13; ++row)
    std::reverse(descending.values.begin() + static_cast<std::ptrdiff_t>(24 * row),
                 descending.values.begin() + static_cast<std::ptrdiff_t>(24 * row + 24));
  check_same_widths(read_cell_width(raster_file(folder, descending)), width);

  StoredRaster metres = raster_of_widths(width);
  metres.attributes = {{"units", std::string("m")}};
  CHECK(read_cell_width(raster_file(folder, metres)).values.isApprox(width.values / 1000, 1e-15));
}

TEST_CASE("units of widths: km and m by symbol and name, and no other") {
  for (const std::string unit :
       {"", " ", "km", "kilometer", "kilometers", "kilometre", "kilometres", "Kilometers", " km "})
    CHECK(kilometres_in(unit) == 1);
  for (const std::string unit : {"m", "meter", "meters", "metre", "metres", "METERS"})
    CHECK(kilometres_in(unit) == 0.001);
  for (const std::string unit : {"degrees", "radians", "furlongs", "degree", "rad", "1", "M", "KM",
                                 "Km", "mm", "mile", "km2", "km/h", "kmm", "deg"}) {
    CAPTURE(unit);
    CHECK_THROWS_WITH_AS(kilometres_in(unit),
                         ("the unit \"" + unit + "\" is no length; give km or m").c_str(), Error);
  }
  const InputFolder folder;
  const Raster width = sampled_field(smooth, 24, 12);
  StoredRaster raster = raster_of_widths(width);
  for (const std::string unit : {"kilometers", "km"}) {
    raster.attributes = {{"units", unit}};
    check_same_widths(read_cell_width(raster_file(folder, raster)), width);
  }
  raster.attributes = {{"units", std::string("degrees")}};
  CHECK(refusal_of_widths(raster_file(folder, raster)) ==
        ": cellWidth: the unit \"degrees\" is no length; give km or m");
  raster.variable = "density"; // of which the unit does not matter
  CHECK(widths_of_density(
            read_raster(raster_file(folder, raster), {.quantity = RasterQuantity::density}))
            .values.minCoeff() == 1);
}

TEST_CASE("a raster of a part of the sphere is enough for a region in it") {
  const InputFolder folder;
  StoredRaster raster;
  for (int i = 0; i <= 40; ++i)
    raster.lon.push_back(100 + i);
  for (int j = 0; j <= 30; ++j)
    raster.lat.push_back(20 + j);
  raster.values.assign(41 * 31, 50);
  const std::string path = raster_file(folder, raster);
  CHECK(refusal_of_widths(path) ==
        ": lon runs from 100 to 140 and leaves part of the sphere out; give a "
        "global raster in degrees");
  const auto disc = [](double radius) {
    return circle(points_at({{120, 35}}).col(0), radius * degree);
  };
  const Raster width = read_cell_width(path, {}, disc(10));
  CHECK(width.x.size() == 41);
  CHECK(implied_cells(width, disc(10)) ==
        doctest::Approx(disc(10).area() * earth_radius_km * earth_radius_km * 2 / std::sqrt(3.0) /
                        2500)
            .epsilon(1e-6));
  CHECK_THROWS_WITH_AS(read_cell_width(path, {}, disc(20)),
                       doctest::Contains("lat runs from 20 to 50, and leaves out the place"),
                       Error);
}

TEST_CASE("widths of the plane: from a file, their density and their number of cells") {
  const InputFolder folder;
  const StoredRaster raster{{0, 1, 4},   {3, 0}, {0.4, 0.2, 0.1, 0.4, 0.2, 0.1},
                            "cellWidth", "y",    "x"};
  const Raster read = read_cell_width(raster_file(folder, raster), {}, Surface::plane());
  CHECK(read.x == Eigen::Vector3d(0, 1, 4));
  CHECK(read.values(0, 1) == 0.4);
  CHECK(read.values(2, 0) == 0.1);
  const Surface box = rectangle({0, 0}, {4, 3});
  const Eigen::VectorXd rho = evaluate(density_of(read), Points2(Eigen::Vector2d(2.5, 1)), box);
  CHECK(rho[0] == doctest::Approx(std::pow(0.1 / 0.15, 4)));
  // The integral of 1/h^2 of a linear h from a to b over a length is the length over a b.
  const double integral = 3 * (1 / (0.4 * 0.2) + 3 / (0.2 * 0.1));
  CHECK(implied_cells(read, box) == doctest::Approx(2 / std::sqrt(3.0) * integral).epsilon(5e-3));
  CHECK_NOTHROW(require_covering(read, rectangle({0, 0}, {4, 3})));
  CHECK_NOTHROW(require_covering(read, rectangle({-1.4, -1.4}, {5.4, 4.4}))); // half a step
  CHECK_THROWS_WITH_AS(require_covering(read, Surface::periodic({6, 3})),
                       "cell width: x runs from 0 to 4, but the domain from 0 to 6; give a raster "
                       "that covers the domain",
                       Error);
  StoredRaster bad = raster;
  bad.values[4] = 0;
  CHECK_THROWS_WITH_AS(
      read_cell_width(raster_file(folder, bad), {}, Surface::plane()),
      doctest::Contains(": cellWidth[1][1] = 0 is not positive and finite; correct it"), Error);
}

TEST_CASE("a density raster gives widths whose density it is") {
  const InputFolder folder;
  StoredRaster raster = raster_of_widths(sampled_field(smooth, 24, 12));
  raster.variable = "density";
  const Raster width = widths_of_density(
      read_raster(raster_file(folder, raster), {.quantity = RasterQuantity::density}));
  CHECK(width.values.minCoeff() == 1);
  const double most = *std::max_element(raster.values.begin(), raster.values.end());
  for (Eigen::Index k = 0; k < width.values.size(); ++k)
    CHECK(std::pow(width.values.data()[k], -4) ==
          doctest::Approx(raster.values[static_cast<std::size_t>(k)] / most).epsilon(1e-13));
}

TEST_CASE("a raster of the plane: axes of any direction, and invalid rasters") {
  const InputFolder folder;
  StoredRaster raster{{0, 1, 3}, {2, 0}, {8, 7, 6, 5, 4, 3}, "density", "y", "x"};
  const Raster read = read_raster(raster_file(folder, raster), {.quantity = RasterQuantity::density,
                                                                .surface = Surface::plane()});
  CHECK(read.x == Eigen::Vector3d(0, 1, 3));
  CHECK(read.y == Eigen::Vector2d(0, 2));
  CHECK(read.values(2, 0) == 3);
  CHECK(read.values(0, 1) == 8);
  const auto refused = [&](const std::function<void(StoredRaster&)>& spoil) -> std::string {
    StoredRaster spoilt = raster;
    spoil(spoilt);
    const std::string path = raster_file(folder, spoilt);
    try {
      read_raster(path, {.quantity = RasterQuantity::density, .surface = Surface::plane()});
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::parse);
      return std::string(error.what()).substr(path.size());
    }
    return "";
  };
  CHECK(refused([](StoredRaster& r) { r.values[4] = -1; }) ==
        ": density[1][1] = -1 is not 0 or positive, and finite; correct it");
  CHECK(refused([](StoredRaster& r) { r.lon[1] = 3; }) ==
        ": x[2] = 3 does not follow 3; sort the raster along it");
  CHECK(refused([](StoredRaster& r) { r.variable = std::string("rho"); }).empty()); // the only one
  CHECK(refused([](StoredRaster& r) { r.lon_name = std::string("lon"); }) ==
        ": no coordinate variable x; give x(x)");
  raster.values = {8, 5, 7, 4, 6, 3};
  raster.transposed = true;
  CHECK(refused([](StoredRaster&) {}).empty());
  CHECK(read_raster(raster_file(folder, raster),
                    {.quantity = RasterQuantity::density, .surface = Surface::plane()})
            .values == read.values);
}

TEST_CASE("invalid NetCDF rasters give an error of one line that names the defect") {
  const InputFolder folder;
  const Raster width = sampled_field(smooth, 24, 12);
  const auto refused = [&](const std::function<void(StoredRaster&)>& spoil) {
    StoredRaster raster = raster_of_widths(width);
    spoil(raster);
    return refusal_of_widths(raster_file(folder, raster));
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string correct = " is not positive and finite; correct it";
  CHECK(refused([&](StoredRaster& r) { r.values[24 * 5 + 7] = nan; }) ==
        ": cellWidth[5][7] = nan" + correct);
  CHECK(refused([&](StoredRaster& r) { r.values[0] = 0; }) == ": cellWidth[0][0] = 0" + correct);
  CHECK(refused([&](StoredRaster& r) { r.values[24] = -2; }) == ": cellWidth[1][0] = -2" + correct);
  CHECK(refused([&](StoredRaster& r) {
          r.values[25] = 1e20;
          r.attributes = {{"_FillValue", 1e20}};
        }) == ": cellWidth[1][1] = nan" + correct);
  CHECK(
      refused([&](StoredRaster& r) {
        for (double& value : r.values)
          value *= 1000;
        r.values[0] = 61500;
      }).ends_with("and has no unit: metres or km? Give it the attribute units, \"m\" or \"km\""));
  CHECK(refused([&](StoredRaster& r) { r.lat_name = std::string("y"); }) ==
        ": no coordinate variable lat; give lat(lat) in degrees");
  CHECK(refused([&](StoredRaster& r) {
          r.lon = {0};
          r.values.resize(13);
        }) == ": lon has fewer than 2 values; give a raster that covers the domain");
  CHECK(refused([&](StoredRaster& r) { r.lat[4] = 80; }) ==
        ": lat[5] = -15 does not follow 80; sort the raster along it");
  CHECK(refused([&](StoredRaster& r) { r.lon[3] = nan; }) ==
        ": lon[3] is NaN or infinite; correct it");
  CHECK(refused([&](StoredRaster& r) { r.lat[12] = 100; }) ==
        ": lat 100 is outside -90 to 90; give degrees");
  const std::string global = " and leaves part of the sphere out; give a global raster in degrees";
  CHECK(refused([&](StoredRaster& r) {
          for (double& latitude : r.lat)
            latitude *= degree;
        }) == ": lat runs from -1.5708 to 1.5708" + global);
  CHECK(refused([&](StoredRaster& r) {
          for (double& longitude : r.lon)
            longitude *= 0.5;
        }) == ": lon runs from -90 to 82.5" + global);
  CHECK(refused([&](StoredRaster& r) {
          for (double& longitude : r.lon)
            longitude *= 2;
        }) == ": lon spans more than 360 degrees; remove the repeated longitudes");
  CHECK(
      refused([&](StoredRaster& r) { r.lon.back() = 180; }).starts_with(": cellWidth differs at"));
  CHECK(refusal_of_widths(folder("text.nc", "cellWidth")) != "not refused");
  CHECK(refusal_of_widths(folder("widths.txt"), {}, ErrorCode::invalid_argument) ==
        ": unknown suffix of a file of cell widths; give .nc, .msh, .geojson, .shp or .toml");
  CHECK_THROWS_AS(read_cell_width(folder("absent.nc")), Error);
  CHECK_THROWS_AS(read_cell_width(folder("absent.msh")), Error);

  const std::string whole = raster_file(folder, raster_of_widths(width));
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) - 100);
  CHECK(refusal_of_widths(whole) != "not refused");
}

// ---- JIGSAW

TEST_CASE("a JIGSAW grid is in radians, its values by columns of latitudes") {
  const InputFolder folder;
  const Raster width = sampled_field(smooth, 24, 12);
  std::ostringstream text;
  text.precision(17);
  text << "# made by hand\nMSHID=3;ELLIPSOID-GRID\nRADII=6371;6371;6371\nNDIMS=2\nCOORD=1;25\n";
  for (int i = 0; i <= 24; ++i)
    text << (15.0 * i - 180) * degree << "\n";
  text << "COORD=2;13\n";
  for (const double latitude : width.y)
    text << latitude * degree << "\n";
  text << "VALUE=325; 1\n";
  for (int i = 0; i <= 24; ++i)
    for (int j = 0; j <= 12; ++j)
      text << width.values(i % 24, j) << "\n";
  const Raster read = read_cell_width(folder("hfun.msh", text.str()));
  CHECK(read.values == width.values);
  CHECK(read.x.isApprox(width.x, 1e-14));
  CHECK(read.y.isApprox(width.y, 1e-14));

  const auto spoiled = [&](const std::string& what, const std::string& by) {
    std::string copy = text.str();
    copy.replace(copy.find(what), what.size(), by);
    return refusal_of_widths(folder("bad.msh", copy));
  };
  CHECK(spoiled("VALUE=325", "VALUE=324").find("more or fewer lines") != std::string::npos);
  CHECK(spoiled("VALUE=325", "VALUE=326").find("cut short") != std::string::npos);
  CHECK(spoiled("VALUE=325", "VALUE=x").find("not a count of lines") != std::string::npos);
  CHECK(spoiled("GRID", "TREE").find("no cell widths of the sphere in a file") !=
        std::string::npos);
  CHECK(spoiled("COORD=2", "COORD=1").find("comes twice") != std::string::npos);
  CHECK(spoiled("MSHID", "MESH").find("not a count of lines") == std::string::npos);
  CHECK(refusal_of_widths(folder("empty.msh", "")).find("no MSHID") != std::string::npos);
}

TEST_CASE("a JIGSAW mesh is interpolated between its nodes") {
  const InputFolder folder;
  const Points3 points = bisected_icosahedron(3);
  const auto exact = [](const Eigen::Vector3d& p) { return 100 + 20 * p.x() - 30 * p.y() * p.z(); };
  for (const bool angles : {false, true}) {
    std::ostringstream text;
    text.precision(17);
    text << "mshid=3;" << (angles ? "ellipsoid-mesh\nndims=2" : "euclidean-mesh\nndims=3")
         << "\npoint=" << points.cols() << "\n";
    for (const Eigen::Vector3d& p : points.colwise())
      if (angles)
        text << std::atan2(p.y(), p.x()) << ";" << std::asin(p.z()) << ";0\n";
      else
        text << 6371 * p.x() << ";" << 6371 * p.y() << ";" << 6371 * p.z() << ";0\n";
    text << "value=" << points.cols() << ";1\n";
    for (const Eigen::Vector3d& p : points.colwise())
      text << exact(p) << "\n";
    const Raster width = read_cell_width(folder("mesh.msh", text.str()));
    const Points3 others = random_sphere(500);
    const Eigen::VectorXd found = evaluate(width, others);
    for (Eigen::Index i = 0; i < others.cols(); ++i)
      CHECK(found[i] == doctest::Approx(exact(others.col(i))).epsilon(0.01));
    CHECK(width.y[1] - width.y[0] == doctest::Approx(1)); // edges are 8 degrees
  }
  const std::string octahedron = "MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=6\n1;0;0;0\n-1;0;0;0\n"
                                 "0;1;0;0\n0;-1;0;0\n0;0;1;0\n0;0;-1;0\n";
  const std::string eight = "VALUE=6;1\n8\n8\n8\n8\n8\n8\n";
  CHECK(read_cell_width(folder("a.msh", octahedron + eight)).values.isConstant(8, 1e-14));
  CHECK(refusal_of_widths(folder("b.msh", octahedron)).find("VALUE has 0 widths") !=
        std::string::npos);
  CHECK(refusal_of_widths(folder("c.msh", octahedron + "VALUE=6;1\n8\n8\n-8\n8\n8\n8\n")) ==
        ": VALUE of point 2 is not positive; correct it");
  CHECK(refusal_of_widths(folder("d.msh", octahedron + eight + "TRIA3=1\n0;1;6;0\n"))
            .find("has vertex 6, but there are 6 points") != std::string::npos);
  CHECK(refusal_of_widths(folder("e.msh",
                                 "MSHID=3;EUCLIDEAN-MESH\nNDIMS=3\nPOINT=4\n1;0;1;0\n0;1;1;0\n"
                                 "-1;0;1;0\n0;-1;1;0\nVALUE=4;1\n1\n1\n1\n1\n"),
                          {}, ErrorCode::invalid_argument)
            .find("within a hemisphere") != std::string::npos);
}

// ---- Polygons

namespace {

using Corners = std::vector<std::pair<double, double>>;

std::string ring_text(const Corners& corners, bool backwards = false) {
  std::ostringstream text;
  text.precision(17);
  Corners order = corners;
  if (backwards)
    std::reverse(order.begin(), order.end());
  order.push_back(order.front());
  for (const auto& [longitude, latitude] : order)
    text << (text.tellp() == 0 ? "[[" : ",[") << longitude << "," << latitude << "]";
  return text.str() + "]";
}

/// A circle on the sphere, degrees.
Corners circle_corners(double longitude, double latitude, double radius, int corners = 200) {
  const Eigen::Vector3d centre = points_at({{longitude, latitude}}).col(0),
                        a = centre.unitOrthogonal(), b = centre.cross(a);
  Corners all;
  for (int k = 0; k < corners; ++k) {
    const double turn = 2 * pi * k / corners;
    const Eigen::Vector3d p = std::cos(radius * degree) * centre +
                              std::sin(radius * degree) * (std::cos(turn) * a + std::sin(turn) * b);
    all.emplace_back(std::atan2(p.y(), p.x()) / degree, std::asin(p.z()) / degree);
  }
  return all;
}

constexpr PolygonWidths coastal{.inside = 30, .outside = 130, .transition = 2000};

/// The width at a distance in radians from a boundary, negative inside.
double across(double distance, const PolygonWidths& widths = coastal) {
  const double t = std::clamp(distance * widths.radius_km / widths.transition, 0.0, 1.0);
  return widths.inside + (widths.outside - widths.inside) * t * t * (3 - 2 * t);
}

/// Everywhere the width is that of the distance, within a part of the difference of widths.
void check_widths(const Raster& width,
                  const std::function<double(const Eigen::Vector3d&)>& distance,
                  double part = 0.01) {
  const Points3 points = random_sphere(2000);
  const Eigen::VectorXd found = evaluate(width, points);
  double worst = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    worst = std::max(worst, std::abs(found[i] - across(distance(points.col(i)))));
  CHECK(worst < part * (coastal.outside - coastal.inside));
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace

TEST_CASE("a round polygon has the widths of the cap, wherever it lies and however it runs") {
  const InputFolder folder;
  for (const auto& [longitude, latitude] :
       Corners{{10, 20}, {175, -30}, {-60, 80}, {0, 90}, {33, -90}, {-179, 5}})
    for (const bool backwards : {false, true}) {
      CAPTURE(longitude);
      CAPTURE(latitude);
      const std::string text =
          polygon(ring_text(circle_corners(longitude, latitude, 20), backwards));
      const Eigen::Vector3d centre = points_at({{longitude, latitude}}).col(0);
      check_widths(
          read_cell_width(folder("cap.geojson", text), coastal),
          [&](const Eigen::Vector3d& p) { return angle_between(p, centre) - 20 * degree; });
    }
}

TEST_CASE("a place inside decides, for all rings of its feature") {
  const InputFolder folder;
  const Eigen::Vector3d centre = points_at({{10, 20}}).col(0);
  const auto text = [&](const std::string& inside, const std::string& rings) {
    return R"({"type":"Feature","properties":{"inside":)" + inside + R"(},"geometry":)" +
           polygon(rings) + "}";
  };
  const std::string outer = ring_text(circle_corners(10, 20, 50)),
                    hole = ring_text(circle_corners(10, 20, 25), true);
  const auto angle = [&](const Eigen::Vector3d& p) { return angle_between(p, centre); };
  for (const std::string inside : {"[10,20]", "[10,57]", "[190,-80]"}) // within, between, beyond
    for (const std::string& rings : {outer + "," + hole, hole + "," + outer}) {
      const double sign = inside == "[10,57]" ? 1 : -1;
      check_widths(
          read_cell_width(folder("told.geojson", text(inside, rings)), coastal),
          [&](const Eigen::Vector3d& p) {
            return sign * std::max(25 * degree - angle(p), angle(p) - 50 * degree);
          },
          0.03); // the widths have a ridge between the circles
    }
  CHECK(refusal_of_widths(folder("bad.geojson", text("7", outer)), coastal, ErrorCode::parse) ==
        ": its property \"inside\" is not a position [longitude, latitude]; give degrees");
}

TEST_CASE("holes lie outside, also around a pole; narrow features win") {
  const InputFolder folder;
  for (const auto& [longitude, latitude] : Corners{{170, 20}, {0, 90}}) {
    const Eigen::Vector3d centre = points_at({{longitude, latitude}}).col(0);
    const std::string text = polygon(ring_text(circle_corners(longitude, latitude, 50)) + "," +
                                     ring_text(circle_corners(longitude, latitude, 25)));
    check_widths(read_cell_width(folder("ring.geojson", text), coastal),
                 [&](const Eigen::Vector3d& p) {
                   const double angle = angle_between(p, centre) / degree;
                   return std::max(25 - angle, angle - 50) * degree;
                 });
  }
  const Raster width = read_cell_width(folder(
      "two.geojson",
      R"({"type":"FeatureCollection","outsideWidth":130,"transition":2000,"features":[)" +
          feature(polygon(ring_text(circle_corners(0, 0, 40))), R"({"cellWidth":30})") + "," +
          feature(polygon(ring_text(circle_corners(0, 0, 15))), R"({"cellWidth":10})") + "," +
          feature("null", "null") + "]}"));
  CHECK(width_at(width, 0, 0) == doctest::Approx(10));
  CHECK(width_at(width, 27, 0) == doctest::Approx(30).epsilon(0.01));
  CHECK(width_at(width, 180, 0) == 130);
}

TEST_CASE("edges are straight in longitude and latitude; cuts are no boundary") {
  const InputFolder folder;
  const auto latitude_of = [](const Eigen::Vector3d& p) { return std::asin(p.z()); };
  // Antarctica as maps have it: along 60 S, then the map's edge.
  for (const bool backwards : {false, true})
    check_widths(
        read_cell_width(folder("south.json",
                               polygon(ring_text({{-180, -60}, {180, -60}, {180, -90}, {-180, -90}},
                                                 backwards))),
                        coastal),
        [&](const Eigen::Vector3d& p) { return latitude_of(p) + 60 * degree; });
  // A band round the Earth, in two pieces that touch at 180 and 20 degrees.
  const std::string band =
      R"({"type":"GeometryCollection","geometries":[{"type":"MultiPolygon","coordinates":[[)" +
      ring_text({{20, -30}, {100, -30}, {180, -30}, {180, 30}, {100, 30}, {20, 30}}) + "],[" +
      ring_text({{-180, -30}, {-80, -30}, {20, -30}, {20, 30}, {-80, 30}, {-180, 30}}) + "]]}]}";
  check_widths(read_cell_width(folder("band.geojson", band), coastal),
               [&](const Eigen::Vector3d& p) { return std::abs(latitude_of(p)) - 30 * degree; });
  // Across the date line, by numbers beyond 180 or not.
  const Raster beyond = read_cell_width(
      folder("beyond.json", polygon(ring_text({{160, -10}, {210, -10}, {210, 10}, {160, 10}}))),
      coastal);
  const Raster within = read_cell_width(
      folder("within.json", polygon(ring_text({{160, -10}, {-150, -10}, {-150, 10}, {160, 10}}))),
      coastal);
  CHECK(beyond.values == within.values);
  CHECK(width_at(within, -175, 0) == doctest::Approx(30).epsilon(0.02));
  CHECK(width_at(within, 0, 0) == 130);
}

TEST_CASE("the raster resolves the transition and is the same for any number of threads") {
  const InputFolder folder;
  const std::string path = folder("cap.json", polygon(ring_text(circle_corners(120, -40, 25))));
  PolygonWidths widths = coastal;
  widths.transition = 400;
  const auto read_with = [&](int threads) {
    tbb::task_arena arena(threads);
    Raster width;
    arena.execute([&] { width = read_cell_width(path, widths); });
    return width;
  };
  const Raster one = read_with(1), two = read_with(2);
  check_same_widths(one, two);
  CHECK((one.y[1] - one.y[0]) * degree * earth_radius_km <= 400.0 / 16);
  // A cubic's greatest slope is 3/2 of the mean one.
  CHECK(largest_gradient(one).slope == doctest::Approx(1.5 * 100 / 400).epsilon(0.02));
  widths.transition = 10;
  CHECK(refusal_of_widths(path, widths, ErrorCode::invalid_argument) ==
        ": a transition of 10 km is too narrow for the finest raster, of 0.05 degrees; give at "
        "least 22.4 km");
}

TEST_CASE("GeoJSON that gives no widths ends in one line that names the feature") {
  const InputFolder folder;
  const auto refused = [&](const std::string& text, const PolygonWidths& widths = coastal,
                           ErrorCode code = ErrorCode::parse) {
    return refusal_of_widths(folder("bad.geojson", text), widths, code);
  };
  const std::string square = ring_text({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  CHECK(refused("{\"type\":") == ": no JSON from byte 9 on; the file was cut short or damaged");
  CHECK(refused("[1]") == ": no GeoJSON object; give features or a geometry");
  CHECK(refused(R"({"type":"FeatureCollection","features":[]})") ==
        ": no polygons; give Polygon or MultiPolygon geometries");
  CHECK(refused(R"({"type":"Point","coordinates":[0,0]})").find("\"Point\" has no inside") !=
        std::string::npos);
  CHECK(refused(R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":)" +
                polygon(square) + R"(,"properties":{"cellWidth":-3}}]})") ==
        ": feature 0: its property \"cellWidth\" is not a positive number; give km");
  CHECK(refused(polygon("[[0,0],[1,0],[0,0]]")) ==
        ": ring 0 has fewer than 3 places; leave it out");
  CHECK(refused(polygon("[[0,0],[1,95],[2,0],[0,0]]"))
            .starts_with(": position 1 of ring 0 is [1.0, 95.0]"));
  CHECK(refused(polygon("[[0,0],[1],[2,0],[0,0]]"))
            .starts_with(": position 1 of ring 0 is not a position "));
  CHECK(refused(polygon("")) == ": a polygon without rings; give its outer one");
  CHECK(refused(R"({"type":"Polygon"})").starts_with(": no array \"coordinates\""));
  PolygonWidths widths = coastal;
  widths.outside = 0;
  CHECK(refused(polygon(square), widths, ErrorCode::invalid_argument) ==
        ": no positive outside width; give it in km as an option or as the file's "
        "\"outsideWidth\"");
  widths = coastal;
  widths.transition = -1;
  CHECK(refused(polygon(square), widths, ErrorCode::invalid_argument)
            .starts_with(": no positive width of the transition"));
  widths = coastal;
  widths.inside = 0;
  CHECK(refused(polygon(square), widths) ==
        ": no inside width; give it in km as an option or as a property \"cellWidth\"");
  std::string nested = polygon(square);
  for (int i = 0; i < 100; ++i) {
    nested = R"({"type":"GeometryCollection","geometries":[)" + nested + "]}";
    if (i == 20)
      CHECK(refused(nested).find("has no inside") != std::string::npos);
  }
  CHECK(refused(nested).find("nested deeper than 100") != std::string::npos);
}

// ---- The grid that it makes

TEST_CASE("the spacings of a CVT follow the widths of a raster") {
  const Field field = [](double longitude, double latitude) {
    const base_detail::Vec3 p = base_detail::from_lonlat(longitude, latitude);
    return 400 - 130 * p.x + 70 * p.z;
  };
  const Raster width = sampled_field(field, 90, 45);
  const double implied = implied_cells(width);
  const auto cells = static_cast<std::int64_t>(std::llround(implied));
  REQUIRE(cells > 1500);
  REQUIRE(cells < 6000);
  const Density density = density_of(width);
  const Cvt grid = make_grid({.resolution = density,
                              .start = {.points = random_sphere(cells, site_density(density))},
                              .stop = {.tolerance = 1e-3}});
  std::vector<double> ratios;
  const Eigen::VectorXd asked = evaluate(width, grid.mesh.points);
  for (Eigen::Index t = 0; t < grid.mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = grid.mesh.triangles(i, t), b = grid.mesh.triangles((i + 1) % 3, t);
      if (a < b)
        ratios.push_back(earth_radius_km *
                         angle_between(grid.mesh.points.col(a), grid.mesh.points.col(b)) /
                         (0.5 * (asked[a] + asked[b])));
    }
  std::sort(ratios.begin(), ratios.end());
  CHECK(ratios[ratios.size() / 2] == doctest::Approx(1).epsilon(0.03));
  CHECK(ratios[ratios.size() / 20] > 0.8);
  CHECK(ratios[ratios.size() - ratios.size() / 20] < 1.2);
}

TEST_CASE("widths that are written are read again") {
  const test::Scratch folder;
  Raster widths{DoubleVector{{-180, -90, 0, 91}}, DoubleVector{{-90, -7, 90}}, DoubleMatrix(4, 3)};
  for (Eigen::Index k = 0; k < 12; ++k)
    widths.values(k % 4, k / 4) = 10 + 1.0 / static_cast<double>(k + 3);
  write(folder / "w.nc", widths);
  const Raster netcdf = read_cell_width(folder / "w.nc");
  CHECK(netcdf.x == widths.x);
  CHECK(netcdf.y == widths.y);
  CHECK(netcdf.values == widths.values);
  write(folder / "w.msh", widths);
  const Raster jigsaw = read_cell_width(folder / "w.msh");
  CHECK(jigsaw.values == widths.values);
  CHECK((jigsaw.x - widths.x).cwiseAbs().maxCoeff() < 1e-13);
  CHECK(test::error_of([&] { write(folder / "w.txt", widths); }).code() ==
        ErrorCode::invalid_argument);
  widths.values(1, 1) = -1;
  CHECK(test::error_of([&] { write(folder / "w.nc", widths); }).code() ==
        ErrorCode::invalid_argument);
}
