// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of rasters: values at nodes and between them, on the sphere and in a plane.

#include "support/errors.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/density.h>
#include <calotte/generators.h>
#include <calotte/raster.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

using namespace calotte;

namespace {

DoubleVector irregular_axis(test::Random& random, Eigen::Index n, double from, double to) {
  DoubleVector axis(n);
  for (Eigen::Index i = 0; i < n; ++i)
    axis[i] = from +
              (to - from) * (static_cast<double>(i) + random.real(0, 0.8)) / static_cast<double>(n);
  return axis;
}

Raster random_raster(test::Random& random, bool of_plane) {
  const Eigen::Index nx = 3 + random.integer(0, 8), ny = 3 + random.integer(0, 8);
  Raster raster{irregular_axis(random, nx, of_plane ? -3 : -180, of_plane ? 5 : 180),
                irregular_axis(random, ny, of_plane ? 10 : -90, of_plane ? 12 : 90),
                DoubleMatrix(nx, ny), of_plane};
  for (double& value : raster.values.reshaped())
    value = random.real(1, 2);
  return raster;
}

DoubleMatrix place(const Raster& raster, double x, double y) {
  if (raster.of_plane)
    return Eigen::Vector2d(x, y);
  return from_lonlat(Points2(Eigen::Vector2d(x, y)));
}

double value_at(const Raster& raster, double x, double y) {
  return evaluate(raster, place(raster, x, y))[0];
}

} // namespace

TEST_CASE("a raster is bilinear between its nodes, and the same for widths and densities") {
  test::Random random(31);
  for (const bool of_plane : {false, true})
    for (int trial = 0; trial < 20; ++trial) {
      const Raster raster = random_raster(random, of_plane);
      const Surface surface = of_plane ? Surface::plane() : Surface();
      for (Eigen::Index j = 0; j + 1 < raster.y.size(); ++j)
        for (Eigen::Index i = 0; i + 1 < raster.x.size(); ++i) {
          const double u = random.real(0, 1), v = random.real(0, 1),
                       x = raster.x[i] + u * (raster.x[i + 1] - raster.x[i]),
                       y = raster.y[j] + v * (raster.y[j + 1] - raster.y[j]);
          const auto& z = raster.values;
          const double expected = (1 - v) * ((1 - u) * z(i, j) + u * z(i + 1, j)) +
                                  v * ((1 - u) * z(i, j + 1) + u * z(i + 1, j + 1));
          const double value = value_at(raster, x, y);
          CHECK(value == doctest::Approx(expected).epsilon(1e-9));
          const DoubleMatrix at = place(raster, x, y);
          CHECK(evaluate(Widths(raster), at)[0] == doctest::Approx(value).epsilon(1e-14));
          CHECK(evaluate(interpolated_density(raster), at, surface)[0] == value);
          CHECK(evaluate(density_of(raster), at, surface)[0] ==
                doctest::Approx(std::pow(raster.values.minCoeff() / value, 4)).epsilon(1e-12));
        }
    }
}

TEST_CASE("beyond a raster of a plane its nearest value holds, and beside a gap none") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  Raster raster{DoubleVector{{0, 1, 3}}, DoubleVector{{0, 2}}, DoubleMatrix(3, 2), true};
  raster.values << 1, 2, 3, 5, 4, none;
  CHECK(value_at(raster, -7, -7) == 1);
  CHECK(value_at(raster, -7, 1) == 1.5);
  CHECK(value_at(raster, 0.5, 9) == 3.5);
  CHECK(std::isnan(value_at(raster, 2, 1)));
  Raster globe{DoubleVector{{0, 120, 240}}, DoubleVector{{-60, 60}}, DoubleMatrix(3, 2)};
  globe.values << 1, 2, 3, 5, 4, none;
  CHECK(value_at(globe, 60, -60) == doctest::Approx(2));
  CHECK(std::isnan(value_at(globe, 200, 20)));
  CHECK(std::isnan(value_at(globe, 10, 89))); // the mean of a row with a gap
  CHECK(value_at(globe, 10, -90) == doctest::Approx(8.0 / 3));
}

TEST_CASE("rasters are taken for what they are, and refused by the node otherwise") {
  test::Random random(32);
  const Raster sphere = random_raster(random, false), plane = random_raster(random, true);
  const Surface box = Surface::periodic({5, 5});
  const auto refuses = [](const auto& call, const char* words) {
    const std::string message = test::message_of(call);
    CAPTURE(message);
    CHECK(test::has(message, words));
  };
  refuses([&] { implied_cells(sphere, box); }, "longitude and latitude");
  refuses([&] { implied_cells(plane); }, "x and y");
  refuses([&] { limit_gradient(plane, 0.1); }, "x and y");
  refuses([&] { limit_gradient(sphere, 0.1, box); }, "longitude and latitude");
  refuses([&] { require_covering(plane); }, "x and y");
  refuses([&] { largest_gradient(plane); }, "x and y");
  refuses([&] { Widths::by_depth(plane, {.cells = 1, .period = 1, .least = 1}); },
          "longitudes and latitudes");
  refuses([&] { evaluate(plane, Points3(Eigen::Vector3d(0, 0, 1))); }, "the z 1");
  refuses([&] { evaluate(sphere, Points2(Eigen::Vector2d(0, 0))); }, "2 rows");
  for (const Raster& raster : {sphere, plane}) {
    Raster bad = raster;
    bad.values(1, 2) = 0;
    refuses([&] { density_of(bad); }, "value (1, 2) is not positive and finite");
    refuses([&] { widths_of_density(bad); }, "density: value (1, 2) is not positive");
    bad.values(1, 2) = -1;
    refuses([&] { interpolated_density(bad); }, "value (1, 2) is not 0 or positive");
    bad.values(1, 2) = 1.5;
    refuses([&] { WidthShare{bad}; }, "is not a fraction from 0 to 1");
    bad.values.conservativeResize(2, 2);
    refuses([&] { evaluate(bad, Points3(Eigen::Vector3d(0, 0, 1))); }, "give one for each node");
    bad = raster;
    bad.y[1] = bad.y[0];
    refuses([&] { Widths{bad}; }, "is not finite and above the one before");
  }
}

TEST_CASE("a rule that leaves places out has no raster, on any surface") {
  const Widths part = Widths::around({Points3(Eigen::Vector3d(1, 0, 0))}, 10, 100),
               here = Widths::around({Points3(Eigen::Vector3d(1, 1, 0))}, 1, 2, Surface::plane());
  CHECK(test::has(test::message_of([&] { sampled(part); }), "no rule gives a width at longitude"));
  CHECK(test::has(test::message_of([&] {
                    sampled(here, Surface::periodic({20, 20}));
                  }),
                  "no rule gives a width at x"));
  const Raster whole = sampled(Widths::minimum({part, 300.0}));
  CHECK(whole.values.maxCoeff() == 300);
  CHECK(whole.values.minCoeff() == 10);
}
