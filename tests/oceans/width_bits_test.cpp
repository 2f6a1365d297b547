// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"
#include "support/directions.h"
#include "support/files.h"
#include "support/gshhg.h"
#include "support/random.h"

#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

// Each width depends on its place alone, on no thread, and on no unit.

using namespace calotte;
using calotte::test::directions;
using calotte::test::Random;

namespace {

/// With land in the north, deep basins and a ridge, as rough as real ones.
Raster heights() {
  Raster sea{DoubleVector::LinSpaced(180, -180, 178), DoubleVector::LinSpaced(91, -90, 90),
             DoubleMatrix(180, 91)};
  Random random(11);
  for (Eigen::Index j = 0; j < 91; ++j)
    for (Eigen::Index i = 0; i < 180; ++i)
      sea.values(i, j) = -5000 + 3500 * std::exp(-std::pow((sea.x[i] + 30) / 20, 2)) +
                         random.real(0, 500) + (sea.y[j] > 70 ? 6000 : 0);
  return sea;
}

Raster rough(double unit) {
  Raster raster{DoubleVector::LinSpaced(60, -180, 174), DoubleVector::LinSpaced(31, -90, 90),
                DoubleMatrix(60, 31)};
  Random random(12);
  for (double& width : raster.values.reshaped())
    width = unit * random.real(110, 900);
  raster.values.col(0).setConstant(unit * 100);
  raster.values.col(30).setConstant(unit * 300);
  return raster;
}

std::vector<Points3> walks() {
  Random random(13);
  std::vector<Points3> all;
  for (int line = 0; line < 20; ++line) {
    std::vector<std::array<double, 2>> walk{{random.real(-180, 180), random.real(-70, 70)}};
    for (int k = 0; k < 40; ++k)
      walk.push_back({walk.back()[0] + random.real(-2, 2), walk.back()[1] + random.real(-1, 1)});
    all.push_back(directions(walk));
  }
  return all;
}

/// Rules of all kinds, by name.
/// \param u the unit of their lengths, km.
std::vector<std::pair<std::string, Widths>> rules(double u = 1) {
  const Coast coast = test::gshhg('c');
  const Surface region = circle({0.2, 0.3, 0.9}, 0.4);
  const Widths lines = Widths::by_distance(
                   walks(), {{{0, u * 120}, {u * 500, u * 150}, {u * 2000, u * 800}}}),
               zones = Widths::by_latitude({{{-90, u * 180}, {0, u * 600}, {90, u * 120}}}),
               depths = Widths::by_depth(heights(),
                                         {.cells = 50, .period = u * 44712, .least = u * 120}),
               slopes = Widths::by_depth(
                   heights(), {.kind = DepthRule::Kind::slope, .cells = 20, .least = u * 120}),
               channels =
                   Widths::by_channel(coast, {.cells = 2, .least = u * 120, .widest = u * 500});
  return {
      {"number", u * 200.0},
      {"raster", rough(u)},
      {"lines", lines},
      {"zones", zones},
      {"around", Widths::around(walks(), u * 120, u * 300)},
      {"coast",
       Widths::by_distance(coast, {{{u * -500, u * 500}, {0, u * 120}, {u * 1000, u * 400}}})},
      {"sea", Widths::by_distance(coast, {{{0, u * 120}, {u * 1000, u * 400}}}, CoastSide::sea)},
      {"depths", depths},
      {"slopes", slopes},
      {"channels", channels},
      {"minimum", Widths::minimum({u * 400.0, depths, lines})},
      {"maximum", Widths::maximum({zones, lines})},
      {"times", channels.times(1.7)},
      {"sum", Widths::sum({zones, lines})},
      {"where", Widths::where(region, u * 115.0, zones)},
      {"blend", Widths::blend(zones, lines, WidthShare(region, {{{u * -300, 1}, {u * 300, 0}}}))}};
}

DoubleVector in_arena(int threads, const Widths& widths, const Points3& places) {
  return tbb::task_arena(threads).execute([&] { return evaluate(widths, places); });
}

struct RuleAndLimit {
  std::string name;
  Widths rule, limited; ///< by a gradient of 0.03
};

/// A limit is prepared by one thread, once for all cases.
const std::vector<RuleAndLimit>& on_earth() {
  static const std::vector<RuleAndLimit> all = [] {
    std::vector<RuleAndLimit> out;
    for (auto& [name, rule] : rules()) {
      out.push_back({name, rule, rule.limit_gradient(0.03)});
      in_arena(1, out.back().limited, random_sphere(1, 4));
    }
    return out;
  }();
  return all;
}

} // namespace

TEST_CASE("each width depends on its place alone, whatever is asked before it") {
  const Points3 places = random_sphere(3000, 4);
  std::vector<Eigen::Index> order(3000);
  std::iota(order.begin(), order.end(), 0);
  Random random(5);
  random.shuffle(order);
  const Points3 mixed = places(Eigen::all, order);
  for (const auto& [name, rule] : rules()) {
    CAPTURE(name);
    const DoubleVector together = evaluate(rule, places), otherwise = evaluate(rule, mixed);
    int differ = 0;
    for (std::size_t k = 0; k < order.size(); ++k)
      differ += together[order[k]] != otherwise[static_cast<Eigen::Index>(k)];
    for (Eigen::Index k = 0; k < 300; ++k)
      differ += evaluate(rule, Points3(places.col(k)))[0] != together[k];
    CHECK(differ == 0);
  }
}

TEST_CASE("points near each other, which share a search, have the widths that each has alone") {
  Points3 places = random_sphere(1200, 6);
  for (Eigen::Index i = 0; i < places.cols(); ++i) { // in three groups, of 10, 100 and 1000 km
    const Eigen::Vector3d centre = test::direction(10 + 40 * (i / 400), 58 - 25 * (i / 400));
    places.col(i) = (centre + 0.0016 * std::pow(10.0, static_cast<double>(i / 400)) * places.col(i))
                        .normalized();
  }
  std::vector<std::pair<std::string, Widths>> all = rules();
  const Coast coast = test::gshhg('c');
  const Widths channels = Widths::by_channel(coast, {.cells = 2, .least = 120, .widest = 500});
  all.emplace_back("limited channels", channels.limit_gradient(0.03));
  // Of a minimum, later rules lower the widths of earlier ones.
  all.emplace_back("lowered", Widths::minimum({170.0, all[4].second, all[2].second, channels}));
  for (const auto& [name, rule] : all) {
    CAPTURE(name);
    const DoubleVector together = evaluate(rule, places);
    int differ = 0;
    for (Eigen::Index k = 0; k < places.cols(); ++k)
      differ += evaluate(rule, Points3(places.col(k)))[0] != together[k];
    CHECK(differ == 0);
  }
  const auto at = [&](std::size_t rule) { return evaluate(all[rule].second, places); };
  const DoubleVector least = at(4).cwiseMin(at(2)).cwiseMin(at(9)).cwiseMin(170);
  CHECK(evaluate(all.back().second, places) == least);
  CHECK((least.array() < 170).any());
}

// Slow: each rule is limited twice.
TEST_CASE("a rule and its limit have the same bits in each run, for any number of threads [slow]") {
  const Points3 places = random_sphere(3000, 4);
  for (const auto& [name, rule, limited] : on_earth()) {
    CAPTURE(name);
    const DoubleVector first = in_arena(1, rule, places);
    int differ = 0;
    for (const int threads : {1, 2, 7})
      differ += in_arena(threads, rule, places) != first ? 1 : 0;
    CHECK(differ == 0);
    CHECK(in_arena(7, rule.limit_gradient(0.03), places) == in_arena(1, limited, places));
  }
}

TEST_CASE("a limited rule is nowhere above the rule, and hardly anywhere steeper") {
  constexpr double gradient = 0.03;
  const Points3 places = random_sphere(10000, 6);
  DoubleMatrix ways(300, places.cols()); // km
  for (Eigen::Index k = 0; k < ways.cols(); ++k)
    for (Eigen::Index i = 0; i < ways.rows(); ++i)
      ways(i, k) = earth_radius_km * test::angle(places.col(i), places.col(k));
  for (const auto& [name, rule, limit] : on_earth()) {
    CAPTURE(name);
    const DoubleVector given = evaluate(rule, places), limited = evaluate(limit, places);
    CHECK((limited - given).maxCoeff() <= 0);
    // From each place to the next ones: by no more than the gradient, but for a raster's step.
    double worst = 0;
    for (Eigen::Index k = 0; k < ways.cols(); ++k)
      for (Eigen::Index i = 0; i < ways.rows(); ++i)
        worst = std::max(worst, std::abs(limited[i] - limited[k]) - gradient * ways(i, k));
    CHECK(worst < gradient * 120);
  }
}

// Slow: each rule is limited for two spheres.
TEST_CASE("on a sphere u times as large, rules of lengths u times as large are as on the Earth "
          "[slow]") {
  const Points3 places = random_sphere(3000, 7);
  for (const double u : {0.532, 4.1}) {
    const auto elsewhere = rules(u);
    for (std::size_t k = 0; k < elsewhere.size(); ++k) {
      const auto& [name, here, limited] = on_earth()[k];
      CAPTURE(name);
      CAPTURE(u);
      const Widths rule = elsewhere[k].second.on_sphere(u * earth_radius_km);
      // Between nodes of a raster with and without a demand, widths are of neither kind.
      const auto differences = [&](const DoubleVector& widths, const DoubleVector& others,
                                   double tolerance) {
        constexpr double widest = 2e4;
        int differ = 0;
        for (Eigen::Index i = 0; i < widths.size(); ++i)
          differ += widths[i] < widest ? std::abs(others[i] / (u * widths[i]) - 1) > tolerance
                                       : others[i] < u * widest;
        return differ;
      };
      CHECK(differences(evaluate(here, places), evaluate(rule, places), 1e-9) == 0);
      // The limit of a raster takes widths of one float for equal.
      const DoubleVector there = evaluate(rule.limit_gradient(0.03), places);
      CHECK(differences(evaluate(limited, places), there, 1e-6) == 0);
      // Limited before or after: the gradient is that of the sphere that the widths are for.
      if (u < 1)
        CHECK(evaluate(elsewhere[k].second.limit_gradient(0.03).on_sphere(u * earth_radius_km),
                       places) == there);
    }
  }
}

TEST_CASE("a rule is prepared for its sphere alone, and once") {
  // On the Earth so narrow cells would cut the coast into too many pieces.
  const Widths narrow =
      Widths::by_channel(test::gshhg('c'), {.cells = 3, .least = 0.02, .widest = 1});
  const Widths small = Widths::minimum({narrow, 5.0}).on_sphere(6.371);
  CHECK(evaluate(small, random_sphere(100, 9)).minCoeff() > 0);
  CHECK(narrow.on_sphere(6.371).rule() == narrow.on_sphere(6.371).rule());
  const Widths zones = Widths::by_latitude({{{-90, 20}, {90, 40}}});
  CHECK(Widths(zones).rule() == zones.rule());
}

TEST_CASE("tasks may ask a rule at once before it is prepared") {
  const Points3 places = random_sphere(200, 10);
  for (int trial = 0; trial < 5; ++trial) {
    const Widths lines = Widths::by_distance(walks(), {{{0, 120}, {500, 150}, {2000, 800}}}),
                 limited = Widths::maximum({lines, 200.0}).limit_gradient(0.03),
                 whole = Widths::minimum({limited, lines, 700.0});
    std::vector<DoubleVector> got(64);
    base_detail::for_each_task(64, [&](std::int64_t k) {
      got[static_cast<std::size_t>(k)] = evaluate(k % 2 == 0 ? limited : whole, places);
    });
    for (std::size_t k = 2; k < got.size(); ++k)
      CHECK(got[k] == got[k % 2]);
  }
}

TEST_CASE("widths of two spheres do not mix, and those of the Earth go to the other's") {
  const Widths zones = Widths::by_latitude({{{-90, 20}, {90, 40}}}), mars = zones.on_sphere(3389.5),
               coast = Widths::by_distance(walks(), {{{0, 120}, {500, 150}}});
  CHECK(Widths::minimum({coast, mars}).radius_km() == 3389.5);
  const Points3 places = random_sphere(100, 8);
  CHECK(evaluate(Widths::minimum({coast, mars}), places) ==
        evaluate(Widths::minimum({coast, zones}).on_sphere(3389.5), places));
  CHECK(std::string(test::error_of([&] {
                      Widths::sum({mars, coast.on_sphere(1737.4)});
                    }).what()) ==
        "some widths are of a sphere of 3389.5 km and some of one of 1737.4; give those of one of "
        "them");
  CHECK(mars.on_sphere(3389.5).radius_km() == 3389.5);
  CHECK(std::string(test::error_of([&] { mars.on_sphere(1737.4); }).what()) ==
        "the widths are those of a sphere of 3389.5 km, not of 1737.4; give one radius");
  for (const double radius : {0.0, -1.0, std::nan("")})
    CHECK(test::error_of([&] { zones.on_sphere(radius); }).code() == ErrorCode::invalid_argument);
}
