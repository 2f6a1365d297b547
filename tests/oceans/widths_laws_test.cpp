// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/rotations.h"
#include "support/constants.h"
#include "support/directions.h"

#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/widths.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

// Rotated rules give rotated widths: no rule knows of poles or of the date line.

using namespace calotte;
using namespace calotte::test;

namespace {

using Rotation = Eigen::Matrix3d;

Surface region(const Rotation& rotation) {
  const Points3 ring = ellipse(direction(20, 30), 0.4, 0.2, 1).rings().front();
  return Surface::sphere().within({DoubleMatrix(rotation * ring)});
}

std::vector<Points3> lines(const Rotation& rotation) {
  Points3 line(3, 3);
  line << direction(-30, -20), direction(40, 10), direction(60, 70);
  return {Points3(rotation * line)};
}

/// Two islands with a strait between them.
Coast two_islands(const Rotation& rotation) {
  Coast coast;
  for (const double longitude : {-8.0, 8.0})
    coast.rings.emplace_back(rotation *
                             circle(direction(longitude, 5), 7 * degree, 100).rings().front());
  return coast;
}

/// The largest difference at random places, km.
double change(const std::function<Widths(const Rotation&)>& rule) {
  const Points3 places = random_sphere(3000, 1);
  const DoubleVector widths = evaluate(rule(Rotation::Identity()), places);
  double worst = 0;
  for (const Rotation& rotation : rotations())
    worst = std::max(
        worst,
        (evaluate(rule(rotation), Points3(rotation * places)) - widths).cwiseAbs().maxCoeff());
  return worst;
}

} // namespace

TEST_CASE("rotated rules give rotated widths") {
  const WidthProfile grows{{{0, 10}, {2000, 90}}}, sides{{{-500, 80}, {0, 10}, {2000, 90}}};
  const auto lines_rule = [&](const Rotation& r) { return Widths::by_distance(lines(r), grows); };
  const auto coast_rule = [&](const Rotation& r) {
    return Widths::by_distance(two_islands(r), sides);
  };
  const auto channels = [&](const Rotation& r) {
    return Widths::by_channel(two_islands(r), {.cells = 4, .least = 20});
  };
  const auto blend = [&](const Rotation& r) {
    return Widths::blend(lines_rule(r), 200.0, WidthShare(region(r), {{{-100, 1}, {900, 0}}}));
  };
  CHECK(change(lines_rule) < 1e-9);
  CHECK(change(coast_rule) < 1e-9);
  CHECK(change(channels) < 0.01 * 250);
  CHECK(change([&](const Rotation& r) { return channels(r).limit_gradient(0.03); }) < 1);
  CHECK(change(blend) < 1e-9);
  CHECK(change([&](const Rotation& r) { return Widths::where(region(r), 20.0, lines_rule(r)); }) <
        1e-9);
  CHECK(change([&](const Rotation& r) {
          return Widths::minimum({lines_rule(r), coast_rule(r)}).limit_gradient(0.03);
        }) < 1e-9);
}

TEST_CASE("rotated rules limited at a raster give rotated widths within a step of it") {
  const double gradient = 0.05, step = earth_radius_km * degree; // of 1 degree
  CHECK(change([&](const Rotation& r) {
          return Widths::where(region(r), 150.0, 400.0).limit_gradient(gradient);
        }) < 1.5 * gradient * step);
}
