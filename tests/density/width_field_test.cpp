// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/sampled_widths.h"
#include "density/width_rules.h"
#include "support/directions.h"
#include "support/errors.h"
#include "support/gshhg.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/generators.h>
#include <calotte/limited_area.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

// The nodes that a run takes of rules, against the rules themselves.

using namespace calotte;
using calotte::test::direction;
using calotte::test::directions;

namespace {

constexpr double slope = 0.1; // km per km, of the rules below

/// Heights of a basin between shelves, with land at its ends.
Raster sea_floor() {
  Raster heights{DoubleVector::LinSpaced(72, -180, 175), DoubleVector::LinSpaced(37, -90, 90),
                 DoubleMatrix(72, 37)};
  for (Eigen::Index j = 0; j < heights.y.size(); ++j)
    for (Eigen::Index i = 0; i < heights.x.size(); ++i)
      heights.values(i, j) = 200 - 5000 * std::max(0.0, std::cos(heights.x[i] * 0.02)) *
                                       std::cos(heights.y[j] * std::numbers::pi / 180);
  return heights;
}

Widths nested() {
  return Widths::by_distance({directions({{-104, 33}})},
                             {{{0, 0.75}, {120, 0.75}, {400, 3}, {800, 15}, {1800, 75}}});
}

struct Named {
  const char* name;
  Widths widths;
};

/// Rules of every kind.
std::vector<Named> rules() {
  const Surface region = circle(direction(30, 60), 0.2);
  const Widths zones = Widths::by_latitude({{{-90, 35}, {0, 160}, {90, 35}}});
  const std::vector<Points3> shore{directions({{170, -70}, {-170, 80}, {20, 88}, {40, -30}})};
  return {
      {"nested", nested()},
      {"zones", zones},
      {"region", Widths::where(region, 20, 120)},
      {"blend", Widths::blend(zones, 60, WidthShare(region, {{{-600, 0}, {900, 1}}}))},
      {"shore", Widths::by_distance(shore, {{{0, 15}, {2000, 150}}})},
      {"around", Widths::minimum({Widths::around(shore, 25, 80), 140.0})},
      {"depth",
       Widths::minimum(
           {Widths::by_depth(sea_floor(), {.cells = 40, .period = 44714, .least = 60}), 250.0})},
      {"sum", Widths::sum({zones, nested().times(2)})},
      {"largest", Widths::minimum({Widths::maximum({zones, nested(), 40}), 100})},
      {"limited", Widths::minimum({Widths::where(region, 20, 120), zones}).limit_gradient(slope)}};
}

/// Places where rules change: about the nested ones, about points of the others, anywhere.
Points3 varied_places() {
  Points3 all = random_points(6000, {}, {}, 5);
  test::Random random(8);
  for (Eigen::Index i = 0; i < all.cols(); i += 2) {
    const double longitude = i % 4 == 0 ? -104 : 30, latitude = i % 4 == 0 ? 33 : 60,
                 reach = std::pow(10.0, -random.real(0, 4));
    all.col(i) = (direction(longitude, latitude) + reach * all.col(i)).normalized();
  }
  return all;
}

} // namespace

TEST_CASE("rules bound their values about any place") {
  test::Random random(2);
  const Points3 at = varied_places();
  std::vector<Named> all = rules();
  // A raster that begins nearly half a turn on, and one that is fine at a place alone.
  Raster late{DoubleVector::LinSpaced(360, 179.5, 538.5), DoubleVector::LinSpaced(181, -90, 90),
              DoubleMatrix::Constant(360, 181, 100)};
  for (Eigen::Index k = 3; k < late.values.size(); k += 997)
    late.values.data()[k] = 1 + static_cast<double>(k % 7);
  all.push_back({"raster", late});
  Raster shares = late;
  shares.values = shares.values / 100;
  all.push_back({"share of a raster", Widths::blend(20, 300, shares)});
  all.push_back({"discs", Widths::by_channel(test::gshhg('c'), {.cells = 3, .least = 60})});
  for (const auto& [name, widths] : all) {
    CAPTURE(name);
    const auto rule = widths.rule();
    double gaps = 0; // of the bounds about small places, beyond the values seen there
    int small = 0;
    for (int trial = 0; trial < 60; ++trial) {
      const Eigen::Vector3d centre = at.col(static_cast<Eigen::Index>(random.real(0, 6000)));
      const double reach = std::pow(10.0, -random.real(0, 4));
      Points3 near = random_points(64, {}, {}, static_cast<std::uint64_t>(trial) + 1);
      for (auto place : near.colwise()) { // within the reach, and at it
        const Eigen::Vector3d aside = place - place.dot(centre) * centre;
        const double angle = reach * std::min(1.0, 1.5 * std::abs(place[0]));
        place = std::cos(angle) * centre + std::sin(angle) * aside.normalized();
      }
      const auto bounds = rule->bounds({centre.x(), centre.y(), centre.z()}, reach + 1e-9);
      const DoubleVector there = evaluate(widths, near);
      CHECK(bounds.least <= there.minCoeff() * (1 + 1e-9));
      CHECK(there.maxCoeff() <= bounds.greatest * (1 + 1e-9));
      if (reach < 1e-3 && Widths::is_demand(bounds.greatest)) {
        gaps += bounds.greatest / bounds.least / (there.maxCoeff() / there.minCoeff()) - 1;
        ++small;
      }
    }
    CHECK(gaps <= 1.5 * small);
    const auto whole = rule->bounds({0, 0, 1}, std::numeric_limits<double>::infinity());
    const DoubleVector anywhere = evaluate(widths, at);
    CHECK(whole.least <= anywhere.minCoeff());
    CHECK(whole.greatest >= anywhere.maxCoeff() * (1 - 1e-9));
  }
}

TEST_CASE("nodes of rules tell the widths between them") {
  const Points3 at = varied_places();
  for (const auto& [name, widths] : rules()) {
    CAPTURE(name);
    const Widths smooth = widths.limit_gradient(slope);
    const WidthField field = width_field(smooth);
    const DoubleVector exact = evaluate(smooth, at), sampled = evaluate(field, at);
    const DoubleVector error = (sampled - exact).cwiseAbs().cwiseQuotient(exact);
    CHECK(error.maxCoeff() <= 1.3 * slope + 1e-3);
    CHECK(error.mean() <= 0.1 * slope);
    CHECK(field.least() >= smooth.rule()->least() * (1 - 1e-12));
    CHECK(field.nodes() <= 40'000'000);
  }
}

TEST_CASE("a narrow rule is found, however small its part of the sphere is") {
  for (const double radius : {0.5, 5.0}) {
    const Eigen::Vector3d place = direction(77.777, -12.345);
    const Widths narrow =
        Widths::minimum({Widths::around({Points3(place)}, radius / 2, radius), 100.0})
            .limit_gradient(slope);
    const WidthField field = width_field(narrow);
    CHECK(evaluate(field, place)[0] == doctest::Approx(radius / 2).epsilon(1.3 * slope));
    CHECK(field.nodes() < 3'000'000);
    CHECK(implied_cells(field) > implied_cells(Raster(sampled(100.0))) + 10);
  }
}

TEST_CASE("widths are continuous from tile to tile, over the date line and at the poles") {
  const WidthField field = width_field(Widths::minimum({nested(), rules()[4].widths}));
  test::Random random(4);
  double most = 0;
  const auto compare = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Points3 sides(3, 2);
    sides << a, b;
    const DoubleVector there = evaluate(field, sides);
    most = std::max(most, std::abs(there[1] / there[0] - 1));
  };
  constexpr double step = 1e-9;
  for (int trial = 0; trial < 4000; ++trial) {
    const double free = random.real(-90, 90), fixed = random.integer(-89, 89);
    compare(direction(2 * fixed - step, free), direction(2 * fixed + step, free));
    compare(direction(free, fixed - step), direction(free, fixed + step));
    compare(direction(180 - step, free), direction(-180 + step, free));
    compare(direction(fixed, 90 - step), direction(-2 * fixed, 90 - step));
  }
  CHECK(most < 1e-7);

  const Surface box = Surface::periodic({64, 64});
  Points3 line(3, 2);
  line << 2.5, 2.5, 30, 62, 0, 0;
  const WidthField periodic = width_field(
      Widths::by_distance({line}, {{{0, 0.02}, {2.4, 0.02}, {2.6, 0.2}, {8, 2}}}, box), box);
  most = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double free = random.real(0, 64);
    Points2 seams(2, 4);
    seams << step, 64 - step, free, free, free, free, step, 64 - step;
    const DoubleVector there = evaluate(periodic, seams);
    most = std::max({most, std::abs(there[1] / there[0] - 1), std::abs(there[3] / there[2] - 1)});
  }
  CHECK(most < 1e-6);
}

TEST_CASE("cells and gradients of nodes that follow the rule are those of a fine raster") {
  const Widths zones = Widths::minimum({rules()[1].widths, rules()[4].widths});
  const WidthField field = width_field(zones);
  const Raster raster = sampled(zones, {}, 0.1);
  CHECK(implied_cells(field) == doctest::Approx(implied_cells(raster)).epsilon(2e-3));
  CHECK(field.nodes() < raster.values.size() / 10);
  const WidthGradient by_tiles = largest_gradient(field), by_raster = largest_gradient(raster);
  CHECK(by_tiles.slope == doctest::Approx(by_raster.slope).epsilon(0.1));
  CHECK(largest_gradient(field, earth_radius_km / 2).slope > 1.5 * by_tiles.slope);
}

TEST_CASE("nodes of rules have the same bits for any number of threads") {
  const Points3 at = varied_places();
  const auto made = [&](int threads) {
    return tbb::task_arena(threads).execute(
        [&]() -> DoubleVector { return evaluate(width_field(nested()), at); });
  };
  const DoubleVector one = made(1);
  CHECK(made(2) == one);
  CHECK(made(4) == one);
}

TEST_CASE("of too many nodes all are thinned alike, and a nest stays") {
  const Widths nest = Widths::minimum(
      {Widths::by_distance({directions({{20.3, 40.4}})}, {{{0, 0.2}, {2, 0.2}, {120, 4}}}),
       Widths::by_latitude({{{-90, 4}, {0, 2.4}, {90, 4}}})});
  const WidthField field = width_field(nest);
  CHECK(field.nodes() <= 40'000'000);
  CHECK(field.nodes() > 10'000'000);
  CHECK(field.apart() > 1);
  CHECK(field.apart() < 4);
  Points3 at = random_points(4000, {}, {}, 3);
  for (Eigen::Index i = 0; i < at.cols(); i += 2)
    at.col(i) = (direction(20.3, 40.4) + 1e-3 * at.col(i)).normalized();
  const DoubleVector exact = evaluate(nest, at);
  const double error = (evaluate(field, at) - exact).cwiseAbs().cwiseQuotient(exact).maxCoeff();
  CHECK(error < 1.3 * 0.035 * field.apart());
  CHECK(width_field(rules()[1].widths).apart() == 1);
}

TEST_CASE("in a part of the sphere nodes are dense in it alone, and where no rule holds refused") {
  const Surface part = circle(direction(20, 50), 0.05);
  const Widths fine = Widths::blend(20.0, 60.0, WidthShare(part, {{{-300, 0}, {5000, 1}}}));
  const WidthField field = width_field(fine, part);
  CHECK(3 * field.nodes() < 2 * width_field(fine).nodes());
  const Points3 inside = random_points(500, part);
  const DoubleVector exact = evaluate(fine, inside);
  CHECK((evaluate(field, inside) - exact).cwiseAbs().cwiseQuotient(exact).maxCoeff() < 1.3 * 0.01);

  const Widths alone = Widths::around({directions({{20, 50}})}, 10, 500);
  CHECK_NOTHROW(width_field(alone, part)); // which is 319 km wide
  const auto refused = [](const auto& act) {
    return test::has(test::message_of(act), "no rule gives a width at longitude");
  };
  CHECK(refused([&] { width_field(alone); }));
  CHECK(refused([&] { with_rings(circle(direction(20, 50), 0.078), alone); }));
  // A part within a tile, far from the rule that holds in the other one.
  const Surface two = enclosed_region({circle(direction(20, 50), 0.01).rings()[0],
                                       circle(direction(60.5, 30.5), 0.004).rings()[0]});
  CHECK(refused([&] { width_field(alone, two); }));
}

TEST_CASE("the cells of a part with a nest are counted") {
  const Widths nest =
      Widths::minimum({Widths::around({directions({{10.3, 45.2}})}, 0.25, 10), 60.0})
          .limit_gradient(0.03);
  const double radius = 2000 / earth_radius_km;
  const Surface part = circle(direction(10.3, 45.2), radius, 720);
  // Of the whole sphere without those of 60 km outside, where the widths have grown to them.
  const double rest = 4 * std::numbers::pi - part.area(),
               exact = implied_cells(width_field(nest)) -
                       2 / std::numbers::sqrt3 * rest * std::pow(earth_radius_km / 60, 2);
  CHECK(implied_cells(width_field(nest, part), part) == doctest::Approx(exact).epsilon(2e-3));
  CHECK(implied_cells(width_field(nest), part) == doctest::Approx(exact).epsilon(2e-3));
  // Outside the part, where no nodes are, no gradient counts.
  const Surface small = circle(direction(11.2, 45.5), 60 / earth_radius_km);
  CHECK(largest_gradient(width_field(nest, small)).slope < 0.05);
}

TEST_CASE("rules of a plane have nodes over its domain") {
  const Surface lake = rectangle({-10, 5}, {30, 15});
  Points3 line(3, 2);
  line << 0, 25, 8, 12, 0, 0;
  const Widths rule = Widths::by_distance({line}, {{{0, 0.05}, {9, 0.9}}}, lake);
  const WidthField field = width_field(rule, lake);
  CHECK(field.of_plane());
  const Points3 inside = random_points(2000, lake);
  const DoubleVector exact = evaluate(rule, inside), sampled = evaluate(field, inside);
  CHECK((sampled - exact).cwiseAbs().cwiseQuotient(exact).maxCoeff() < 1.3 * slope);
  CHECK(implied_cells(field, lake) ==
        doctest::Approx(implied_cells(calotte::sampled(rule, lake, 0.02), lake)).epsilon(5e-3));
  CHECK(test::has(test::message_of([&] { width_field(rule); }), "the widths are those of a plane"));
  CHECK(test::has(test::message_of([&] { width_field(nested(), lake); }),
                  "the widths are those of the sphere"));
}
