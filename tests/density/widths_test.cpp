// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/clouds.h"
#include "support/directions.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/random.h"

#include <calotte/generators.h>
#include <calotte/widths.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

// Rules for widths against what their words say, place by place.

using namespace calotte;
using calotte::test::angle;
using calotte::test::direction;
using calotte::test::directions;
using calotte::test::error_of;

namespace {

constexpr double radians = std::numbers::pi / 180;

/// In the frame of the arc, in long double.
double angle_from_arc(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                      const Eigen::Vector3d& place) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  const Vector a = from.cast<long double>(), b = to.cast<long double>(),
               p = place.cast<long double>();
  const Vector normal = a.cross(b).normalized();
  const auto between = [](const Vector& x, const Vector& y) {
    return std::atan2(x.cross(y).norm(), x.dot(y));
  };
  const Vector ahead = normal.cross(a).normalized();
  const long double along = std::atan2(p.dot(ahead), p.dot(a.normalized()));
  if (along >= 0 && along <= between(a, b))
    return static_cast<double>(std::atan2(std::abs(p.dot(normal)), p.cross(normal).norm()));
  return static_cast<double>(std::min(between(a, p), between(b, p)));
}

/// Over a pole, over the date line, nearly half way round, also over both poles, in short steps,
/// and a point.
std::vector<Points3> lines() {
  std::vector<Points3> all{directions({{10, 70}, {-170, 70}, {-160, 40}}),
                           directions({{175, -10}, {-175, 10}}),
                           directions({{20, -5}, {199, 4}}),
                           directions({{80, -40}}),
                           directions({{-120, -89.99}, {-120, 0}, {60, 89.95}, {60, 0.02}}),
                           directions({{100, -60}, {100, -60}, {101, -61}})};
  test::Random random(3);
  std::vector<std::array<double, 2>> walk{{-60, 0}};
  for (int k = 0; k < 60; ++k)
    walk.push_back({walk.back()[0] + random.real(-1, 1), walk.back()[1] + random.real(-1, 1)});
  all.push_back(directions(walk));
  return all;
}

double distance_of(const std::vector<Points3>& lines, const Eigen::Vector3d& place) {
  double least = 10;
  for (const Points3& one : lines)
    for (Eigen::Index i = 0; i < std::max<Eigen::Index>(1, one.cols() - 1); ++i) {
      const Eigen::Vector3d from = one.col(i), to = one.col(std::min(i + 1, one.cols() - 1));
      least = std::min(least, from == to ? angle(from, place) : angle_from_arc(from, to, place));
    }
  return least;
}

} // namespace

// Slow: 100 000 places against long double.
TEST_CASE("distances are those to arcs and points [slow]") {
  const std::vector<Points3> all = lines();
  const Points3 places = random_sphere(100'000, 1);
  const double round = std::numbers::pi * earth_radius_km;
  const DoubleVector widths =
      evaluate(Widths::by_distance(all, {{{0, 1}, {round, 1 + round}}}), places);
  double worst = 0;
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    worst = std::max(worst,
                     std::abs(widths[i] - 1 - earth_radius_km * distance_of(all, places.col(i))));
  CHECK(worst < 1e-9); // km
}

TEST_CASE("profiles follow their nodes, and stay beyond them") {
  const Points3 places = directions({{0, -90}, {50, -80}, {10, -45}, {0, 0}, {120, 30}, {7, 90}});
  const WidthProfile zones{{{-80, 30}, {0, 60}, {60, 20}}};
  const DoubleVector straight = evaluate(Widths::by_latitude(zones), places);
  const DoubleVector expected{{30, 30, 30 + 30 * 35.0 / 80, 60, 40, 20}};
  CHECK((straight - expected).cwiseAbs().maxCoeff() < 1e-12);
  const DoubleVector smooth = evaluate(Widths::by_latitude({zones.nodes, true}), places);
  const double t = 35.0 / 80;
  CHECK(smooth[2] == doctest::Approx(30 + 30 * t * t * (3 - 2 * t)).epsilon(1e-6));
  CHECK(smooth[3] == 60);
}

TEST_CASE("rules are combined place by place") {
  const Points3 places = random_sphere(500, 2);
  const Widths zones = Widths::by_latitude({{{-90, 20}, {90, 80}}});
  const DoubleVector z = evaluate(zones, places);
  CHECK(evaluate(Widths::minimum({zones, 50.0}), places) == z.cwiseMin(50));
  CHECK(evaluate(Widths::maximum({zones, 50.0}), places) == z.cwiseMax(50));
  CHECK(evaluate(Widths::sum({zones, 5.0}), places) == (z.array() + 5).matrix());
  CHECK(evaluate(zones.times(2), places) == 2 * z);
  const Surface region = circle({1, 0, 0}, 0.5);
  const DoubleVector w = evaluate(Widths::where(region, 10.0, zones), places);
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    CHECK(w[i] == (region.contains(places.col(i)) ? 10 : z[i]));
}

TEST_CASE("two rules blend by the distance from a region") {
  const Points3 places = random_sphere(2000, 4);
  const Eigen::Vector3d centre = direction(170, 80);
  const Surface region = circle(centre, 0.3, 4000);
  const Widths a = Widths::by_latitude({{{-90, 20}, {90, 80}}}), b = 10.0;
  const DoubleVector of_a = evaluate(a, places);
  const DoubleVector sharp = evaluate(Widths::blend(a, b, region), places);
  CHECK(sharp == evaluate(Widths::where(region, b, a), places));
  const WidthProfile falls{{{-500, 1}, {1000, 0}}};
  const DoubleVector blend = evaluate(Widths::blend(a, b, WidthShare(region, falls)), places),
                     where = evaluate(Widths::where(WidthShare(region, falls), b, a), places);
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const double distance = earth_radius_km * (angle(centre, places.col(i)) - 0.3),
                 t = std::clamp((1000 - distance) / 1500, 0.0, 1.0);
    CHECK(blend[i] == doctest::Approx((1 - t) * of_a[i] + t * 10).epsilon(1e-4));
    CHECK(where[i] == (t >= 0.5 ? 10 : of_a[i]));
  }
}

TEST_CASE("limited rules are those of cones, exactly where they grow from lines or by latitude") {
  const std::vector<Points3> points{directions({{10, 89}}), directions({{180, 0}}),
                                    directions({{0, 0}})};
  const Widths steep = Widths::by_distance(points, {{{0, 10}, {100, 300}}}),
               limited = steep.limit_gradient(0.03);
  const Points3 places = random_sphere(2000, 3);
  const DoubleVector got = evaluate(limited, places);
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    CHECK(got[i] == doctest::Approx(std::min(300.0, 10 + 0.03 * earth_radius_km *
                                                             distance_of(points, places.col(i))))
                        .epsilon(1e-12));
  // A step of latitude: 20 km north of 30 degrees, 100 km from 29 degrees down.
  const Widths step = Widths::by_latitude({{{29, 100}, {30, 20}}}).limit_gradient(0.03);
  const double km = earth_radius_km * radians;
  const DoubleVector along =
      evaluate(step, directions({{0, 40}, {0, 30}, {0, 20}, {0, 10}, {0, -30}}));
  const DoubleVector law{{20, 20, 20 + 0.3 * km, 20 + 0.6 * km, 100}};
  CHECK((along - law).cwiseAbs().maxCoeff() < 1e-9);
  // Limited again, nothing changes; the least of both is limited as both are.
  CHECK((evaluate(limited.limit_gradient(0.03), places) - got).cwiseAbs().maxCoeff() < 1e-9);
  const DoubleVector both = evaluate(Widths::minimum({steep, step}).limit_gradient(0.03), places);
  CHECK((both - got.cwiseMin(evaluate(step, places))).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("the active rule of a minimum is the least one") {
  const Points3 places = random_sphere(3000, 5);
  const Widths lines = Widths::by_distance({directions({{10, 89}})}, {{{0, 10}, {100, 300}}}),
               inside = Widths::where(circle({1, 0, 0}, 0.4), 40.0, Widths::no_demand);
  for (const bool limited : {false, true}) {
    const auto made = [&](const Widths& rule) {
      return limited ? rule.limit_gradient(0.03) : rule;
    };
    const Widths widths = made(Widths::minimum({200.0, lines, inside}));
    const std::vector<Widths> parts{200.0, made(lines), made(inside)};
    const DoubleVector width = evaluate(widths, places);
    const Ids active = active_rules(widths, places);
    std::vector<DoubleVector> each;
    for (const Widths& part : parts)
      each.push_back(evaluate(part, places));
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      CHECK(each[static_cast<std::size_t>(active[i])][i] == width[i]);
      for (std::int32_t k = 0; k < active[i]; ++k)
        CHECK(each[static_cast<std::size_t>(k)][i] > width[i]);
    }
    CHECK(active.maxCoeff() == 2);
  }
  CHECK(active_rules(200.0, places).isZero());
}

TEST_CASE("other limited rules are limited at the nodes of a raster") {
  const Surface region = circle({0, 0, 1}, 0.3);
  const Widths inside = Widths::where(region, 40.0, 200.0);
  const DoubleVector got =
      evaluate(inside.limit_gradient(0.05), directions({{0, 90}, {50, 60}, {0, -30}}));
  CHECK(got[0] == 40);
  const double beyond = earth_radius_km * (30 * radians - 0.3);
  CHECK(got[1] == doctest::Approx(40 + 0.05 * beyond).epsilon(0.02));
  CHECK(got[2] == doctest::Approx(200));
}

TEST_CASE("depths give the lengths of waves, Rossby radii and slopes") {
  Raster sea{DoubleVector::LinSpaced(36, 0, 350), DoubleVector::LinSpaced(19, -90, 90),
             DoubleMatrix(36, 19)};
  for (Eigen::Index j = 0; j < 19; ++j)
    sea.values.col(j).setConstant(-3000 - 10 * sea.y[j]);
  for (Eigen::Index i = 0; i < 3; ++i)
    sea.values.block(i, 3, 1, 3).setConstant(50); // land
  using Kind = DepthRule::Kind;
  const Points3 at = directions({{100, 30}, {10, -50}, {0, -50}, {120, 0}, {90, 60}});
  const double depth = 3300, speed = std::sqrt(9.80665 * depth);
  const DoubleVector wave = evaluate(
      Widths::by_depth(sea, {.kind = Kind::wavelength, .cells = 60, .period = 44712, .least = 3}),
      at);
  CHECK(wave[0] == doctest::Approx(speed * 44712 / 60 / 1000));
  CHECK(wave[1] == Widths::no_demand);  // land around
  CHECK(wave[2] == doctest::Approx(3)); // the shore
  const DoubleVector rossby =
      evaluate(Widths::by_depth(sea, {.kind = Kind::rossby, .cells = 4, .least = 3}), at);
  const double rotation = 7.292e-5;
  CHECK(rossby[4] == doctest::Approx(std::sqrt(9.80665 * 3600) /
                                     (2 * rotation * std::sin(60 * radians)) / 4 / 1000));
  const double c = std::sqrt(9.80665 * 3000), beta = 2 * rotation / (1000 * earth_radius_km);
  CHECK(rossby[3] == doctest::Approx(std::sqrt(c / (2 * beta)) / 4 / 1000));
  const DoubleVector slope =
      evaluate(Widths::by_depth(sea, {.kind = Kind::slope, .cells = 20, .least = 3}), at);
  const double rise = 10 / (1000 * earth_radius_km * radians);
  CHECK(slope[0] == doctest::Approx(2 * std::numbers::pi * depth / rise / 20 / 1000));
  CHECK(error_of([&] { Widths::by_depth(sea, {.cells = 60, .least = 3}); }).what() ==
        std::string("the period of a rule of depths, 0, is not positive; give one"));
}

TEST_CASE("a raster of widths has the same bits for any number of threads") {
  const Widths widths = Widths::by_distance(lines(), {{{0, 100}, {3000, 300}}});
  const DoubleMatrix one =
      tbb::task_arena(1).execute([&] { return sampled(widths, {}, 2).values; });
  for (const int threads : {2, 4})
    CHECK(tbb::task_arena(threads).execute([&] { return sampled(widths, {}, 2).values; }) == one);
  CHECK(sampled(widths).x.size() == 402); // 100 km are 0.899 degrees
}

TEST_CASE("the slope of a flat sea floor demands nothing") {
  Raster flat{DoubleVector::LinSpaced(8, -180, 135), DoubleVector::LinSpaced(5, -90, 90),
              DoubleMatrix::Constant(8, 5, -4000)};
  const Widths rule =
      Widths::by_depth(flat, {.kind = DepthRule::Kind::slope, .cells = 4, .least = 3});
  CHECK(evaluate(rule, directions({{10, 20}}))[0] == Widths::no_demand);
  CHECK(evaluate(Widths::minimum({rule, 60}), directions({{10, 20}}))[0] == 60);
}

TEST_CASE("a place without a width is refused, also where no node lies in the surface") {
  const Widths far = Widths::around({directions({{100, 50}})}, 20, 300);
  const Surface small = circle({1, 0.003, 0.003}, 1e-4, 8);
  for (const Widths& silent : {Widths(Widths::no_demand), far})
    for (const Surface& surface : {small, Surface::sphere()})
      CHECK(test::message_of([&] {
              sampled(silent, surface);
            }).find("no rule gives a width at longitude ") == 0);
  CHECK(sampled(far.limit_gradient(0.03), small).values.minCoeff() > 19);
}

TEST_CASE("widths that are none are refused by name") {
  const auto message = [](const auto& make) { return std::string(error_of(make).what()); };
  CHECK(message([] { Widths(-1.0); }) ==
        "the cell width -1 is not a positive number; give km, in a plane its unit");
  CHECK(message([] { Widths::by_latitude({}); }) ==
        "a profile of the latitude has no node; give one or more");
  CHECK(message([] {
          Widths::by_latitude({{{0, 10}, {100, 20}}});
        }) == "node 1 of a profile of the latitude is at 100, outside -90 to 90; correct it");
  CHECK(message([] {
          Widths::by_latitude({{{10, 10}, {0, 20}}});
        }) == "node 1 of a profile of the latitude is not above the one before; sort them");
  CHECK(message([] {
          Widths::by_distance({directions({{0, 0}})}, {{{0, 0}}});
        }) == "node 0 of a profile of a distance has the width 0, which is not positive and "
              "finite; correct it");
  CHECK(message([] {
          Widths::by_distance(std::vector<Points3>(), {{{0, 1}}});
        }) == "there is no line to be distant from; give one or more points");
  CHECK(message([] {
          Widths::by_distance({directions({{0, 0}, {180, 0}})}, {{{0, 1}}});
        }) == "line 0, point 1 is opposite to the one before; give a point between them");
  CHECK(message([] { Widths::minimum({}); }) == "there are no widths to combine; give one or more");
  const Surface region = circle({1, 0, 0}, 0.5);
  CHECK(message([&] {
          WidthShare(region, {{{0, 1}, {9, -1}}});
        }) == "node 1 of a profile of a distance has the share -1, which is not a fraction from 0 "
              "to 1; correct it");
  CHECK(message([] {
          WidthShare(Surface::sphere(), {{{0, 1}, {9, 0}}});
        }) == "a surface without a boundary has none to be distant from; give a region");
  CHECK(message([] { sampled(Widths(1.0), {}, 20); }) ==
        "the step 20 of a raster is out of range; give 0.01 to 10 degrees");
}
