// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/directions.h"
#include "support/files.h"
#include "support/random.h"

#include <calotte/raster.h>
#include <calotte/surface.h>
#include <calotte/widths.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

// The limited widths against the least of all cones, node by node, and the laws that follow.

using namespace calotte;
using calotte::test::angle;
using calotte::test::direction;
using calotte::test::error_of;

namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

double kilometres(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return earth_radius_km * angle(a, b);
}

/// \param poles whether rows stand at the poles.
Raster raster(double step, bool poles, const std::function<double(double, double)>& width) {
  const auto columns = static_cast<Eigen::Index>(360 / step);
  const Eigen::Index rows = columns / 2 + (poles ? 1 : 0);
  const double south = poles ? -90 : -90 + step / 2;
  Raster raster{DoubleVector::LinSpaced(columns, -180, 180 - step),
                DoubleVector::LinSpaced(rows, south, south + static_cast<double>(rows - 1) * step),
                DoubleMatrix(columns, rows)};
  for (Eigen::Index j = 0; j < rows; ++j)
    for (Eigen::Index i = 0; i < columns; ++i)
      raster.values(i, j) = width(raster.x[i], raster.y[j]);
  return raster;
}

/// All nodes by all nodes.
DoubleMatrix least_of_cones(const Raster& of, double gradient) {
  std::vector<Eigen::Vector3d> places;
  for (const double latitude : of.y)
    for (const double longitude : of.x)
      places.push_back(direction(longitude, latitude));
  DoubleMatrix least = of.values;
  for (std::size_t x = 0; x < places.size(); ++x)
    for (std::size_t y = 0; y < places.size(); ++y)
      least.data()[x] = std::min(least.data()[x],
                                 of.values.data()[y] + gradient * kilometres(places[x], places[y]));
  return least;
}

double largest_part(const DoubleMatrix& a, const DoubleMatrix& b) {
  return ((a - b).array() / b.array()).abs().maxCoeff();
}

// ---- A domain with one island

using Place = Eigen::Vector2d;
const Eigen::AlignedBox2d island(Place(50, 20), Place(52, 80));

/// Whether the straight way from a to b passes through the island.
bool is_cut(const Place& a, const Place& b) {
  double begin = 0, end = 1;
  for (const int k : {0, 1}) {
    const double way = b[k] - a[k];
    if (way == 0 && (a[k] <= island.min()[k] || a[k] >= island.max()[k]))
      return false;
    if (way == 0)
      continue;
    const double low = (island.min()[k] - a[k]) / way, high = (island.max()[k] - a[k]) / way;
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  return end - begin > 1e-12;
}

/// By all ways over the corners.
double shortest_way(const Place& from, const Place& to) {
  using Box = Eigen::AlignedBox2d;
  const std::array<Place, 6> stops{from,
                                   island.corner(Box::BottomLeft),
                                   island.corner(Box::BottomRight),
                                   island.corner(Box::TopRight),
                                   island.corner(Box::TopLeft),
                                   to};
  Eigen::Matrix<double, 6, 6> ways;
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b)
      ways(a, b) = is_cut(stops[a], stops[b]) ? 1e9 : (stops[a] - stops[b]).norm();
  for (int over = 0; over < 6; ++over)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        ways(a, b) = std::min(ways(a, b), ways(a, over) + ways(over, b));
  return ways(0, 5);
}

double noise(std::uint64_t seed, double longitude, double latitude) {
  test::Random random(seed +
                      static_cast<std::uint64_t>(std::llround(1000 * (longitude + 400))) * 7919 +
                      static_cast<std::uint64_t>(std::llround(1000 * (latitude + 100))));
  return random.real(0, 1);
}

} // namespace

TEST_CASE("limited widths are the least of all cones, over the poles and the date line") {
  // Points near a pole, on the date line, opposite to each other, and a place by itself.
  const auto points = [](double longitude, double latitude) {
    const bool one = (longitude == -180 && latitude == 0) || (longitude == 0 && latitude == 0) ||
                     (longitude == 48 && latitude == 84) || (longitude == -132 && latitude == -66);
    return one ? 10.0 : 300.0;
  };
  const auto step = [](double longitude, double) {
    return longitude >= -60 && longitude < 60 ? 25.0 : 100.0;
  };
  const auto rough = [](double longitude, double latitude) {
    return 20 + 400 * noise(1, longitude, latitude);
  };
  for (const double gradient : {0.01, 0.03, 0.2})
    for (const auto& [name, width] :
         {std::pair<std::string, std::function<double(double, double)>>{"points", points},
          {"step", step},
          {"rough", rough}}) {
      CAPTURE(name);
      CAPTURE(gradient);
      const Raster given = raster(6, true, width), limited = limit_gradient(given, gradient);
      // A source that lowers no neighbour, but a node beyond, is replaced by the neighbour: the way
      // is longer by at most 1 - cos(pi / 8) of a step.
      const double step_km = 6 * radians_per_degree * earth_radius_km;
      const DoubleMatrix exact = least_of_cones(given, gradient);
      CHECK((limited.values - exact).cwiseAbs().maxCoeff() <
            (name == "points" ? 1e-10 : 0.08 * gradient * step_km));
      CHECK((limited.values - given.values).maxCoeff() <= 0);
      const Raster again = limit_gradient(limited, gradient);
      CHECK(largest_part(again.values, limited.values) < 1e-14);
    }
}

TEST_CASE("widths without rows at the poles, or of a part of the longitudes, are limited across") {
  const Raster given = raster(6, false, [](double longitude, double latitude) {
    return longitude == 0 && latitude == 87 ? 10.0 : 300.0;
  });
  const Raster limited = limit_gradient(given, 0.03);
  const auto at = [&](Eigen::Index i, Eigen::Index j) {
    return 10 + 0.03 * kilometres(direction(0, 87), direction(limited.x[i], limited.y[j]));
  };
  for (const Eigen::Index i : {0, 10, 30, 59})
    CHECK(limited.values(i, 29) == doctest::Approx(at(i, 29)).epsilon(1e-12));
  Raster part{DoubleVector{{170, 175, 180, 185}}, DoubleVector{{-10, 0, 10}},
              DoubleMatrix::Constant(4, 3, 90)};
  part.values(0, 1) = 30;
  const Raster narrow = limit_gradient(part, 0.03);
  CHECK(
      narrow.values(3, 1) ==
      doctest::Approx(30 + 0.03 * kilometres(direction(170, 0), direction(185, 0))).epsilon(1e-12));
}

TEST_CASE("limited widths have the same bits for any number of threads") {
  const Raster given = raster(1, true, [](double longitude, double latitude) {
    return 20 + 400 * noise(2, longitude, latitude);
  });
  const DoubleMatrix one =
      tbb::task_arena(1).execute([&] { return limit_gradient(given, 0.03).values; });
  for (const int threads : {2, 4, 7})
    CHECK(tbb::task_arena(threads).execute([&] { return limit_gradient(given, 0.03).values; }) ==
          one);
}

TEST_CASE("in a domain the ways lead round islands") {
  DoubleMatrix outer(2, 4), inner(2, 4);
  outer << 0, 100, 100, 0, 0, 0, 100, 100;
  inner << 50, 52, 52, 50, 20, 20, 80, 80;
  const Surface domain = Surface::plane().within({outer, inner});
  for (const Eigen::Index n : {51, 94, 201}) {
    CAPTURE(n);
    Raster given{DoubleVector::LinSpaced(n, 0, 100), DoubleVector::LinSpaced(n, 0, 100),
                 DoubleMatrix::Constant(n, n, 50), true};
    const Eigen::Index si = n / 4, sj = n / 2;
    const Eigen::Vector2d source{given.x[si], given.y[sj]};
    given.values(si, sj) = 1;
    const DoubleMatrix limited = limit_gradient(given, 0.1, domain).values;
    double worst = 0;
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Vector2d at{given.x[i], given.y[j]};
        if (!domain.contains({at.x(), at.y(), 0}))
          continue; // on the island
        const double law = std::min(50.0, 1 + 0.1 * shortest_way(source, at));
        worst = std::max(worst, std::abs(limited(i, j) - law) / law);
      }
    CHECK(worst < (n == 94 ? 4e-3 : 1e-12)); // in the others the corners are nodes
  }
}

TEST_CASE("in a periodic plane the ways lead across the periods") {
  const Eigen::Index n = 50;
  Raster given{DoubleVector::LinSpaced(n, 0, 98), DoubleVector::LinSpaced(n, 0, 98),
               DoubleMatrix::Constant(n, n, 50), true};
  given.values(1, 3) = 1;
  const DoubleMatrix limited = limit_gradient(given, 0.1, Surface::periodic({100, 100})).values;
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      CHECK(limited(i, j) ==
            doctest::Approx(1 + 0.1 * std::hypot(std::remainder(given.x[i] - 2, 100),
                                                 std::remainder(given.y[j] - 6, 100)))
                .epsilon(1e-12));
}

TEST_CASE("limits that are none are refused") {
  const Raster given = raster(30, true, [](double, double) { return 10.0; });
  for (const double gradient : {0.0, -1.0, std::nan("")})
    CHECK(error_of([&] { limit_gradient(given, gradient); }).what() ==
          std::string("the limit of the gradient must be positive; give it in km per km"));
  for (const double radius : {0.0, -6371.0, std::nan("")})
    CHECK(std::string(error_of([&] { limit_gradient(given, 0.03, {}, radius); }).what())
              .find("radius must be positive") != std::string::npos);
  CHECK(limit_gradient(given, 1e-9).values == given.values);
}

TEST_CASE("a raster without a node in the domain is limited at its nodes") {
  const Surface domain = rectangle({40, 40}, {60, 60});
  Raster given{DoubleVector{{0, 100}}, DoubleVector{{0, 100}}, DoubleMatrix(2, 2), true};
  given.values << 1, 50, 50, 50;
  const DoubleMatrix limited = limit_gradient(given, 0.1, domain).values;
  CHECK(limited(0, 0) == 1);
  CHECK(limited(1, 0) == doctest::Approx(11));
  CHECK(limited(1, 1) == doctest::Approx(1 + 10 * std::sqrt(2.0)));
}
