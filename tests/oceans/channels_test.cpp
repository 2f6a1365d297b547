// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/disc_rule.h"
#include "oceans/rotations.h"
#include "support/constants.h"
#include "support/directions.h"
#include "support/files.h"
#include "support/gshhg.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/widths.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

// Widths across channels against channels of known width.

using namespace calotte;
using namespace calotte::test;

namespace {

Points3 round_ring(double longitude, double latitude, double radius) {
  return circle(direction(longitude, latitude), radius * degree).rings().front();
}

/// Land west and east of a channel about the meridian 0, which is `south` and `north` degrees wide
/// on both sides at 40 degrees south and north.
Coast banks(double south, double north) {
  return {{directions({{-south, -40}, {-north, 40}, {-25, 40}, {-25, -40}}),
           directions({{south, -40}, {25, -40}, {25, 40}, {north, 40}})}};
}

Coast rotated(const Coast& coast, const Eigen::Matrix3d& rotation) {
  Coast out;
  for (const Points3& each : coast.rings)
    out.rings.emplace_back(rotation * each);
  return out;
}

/// What the rule says on the axis of banks(): the narrowest of the circles about the axis that
/// contain the place.
double on_axis(double south, double north, double latitude, double cells) {
  const Eigen::Vector3d normal = direction(south, -40).cross(direction(north, 40)).normalized();
  double width = Widths::no_demand;
  for (double at = -39; at < 39; at += 0.001) {
    const double distance = std::asin(std::abs(normal.dot(direction(0, at))));
    if (std::abs(at - latitude) * degree <= distance)
      width = std::min(width, 2 * earth_radius_km * distance / cells);
  }
  return width;
}

} // namespace

TEST_CASE("in a channel between two shores there are so many cells across") {
  for (const auto& [south, north] : {std::array{1.0, 1.0}, {0.3, 2.0}})
    for (const Eigen::Matrix3d& rotation : rotations()) {
      const Widths widths =
          Widths::by_channel(rotated(banks(south, north), rotation), {.cells = 4, .least = 5});
      for (const double latitude : {-30.0, -10.0, 0.0, 20.0, 35.0}) {
        const Points3 place = rotation * direction(0, latitude);
        CHECK(evaluate(widths, place)[0] ==
              doctest::Approx(on_axis(south, north, latitude, 4)).epsilon(0.01));
      }
      for (const Eigen::Vector3d& away :
           {direction(10, 0), direction(30, 0), direction(0, 60), direction(180, 0)})
        CHECK(evaluate(widths, Points3(rotation * away))[0] == Widths::no_demand);
    }
}

TEST_CASE("narrow channels have the least width, and wide ones demand nothing") {
  const auto at_middle = [](const ChannelRule& rule) {
    return evaluate(Widths::by_channel(banks(1, 1), rule), direction(0, 0))[0];
  };
  CHECK(at_middle({.cells = 100, .least = 5}) == 5);
  CHECK(at_middle({.cells = 4, .least = 5, .widest = 200}) == Widths::no_demand);
}

TEST_CASE("what is no channel demands nothing") {
  const Points3 places = random_sphere(1000, 1);
  const auto demands = [&](const Coast& coast) {
    return evaluate(Widths::by_channel(coast, {.cells = 4, .least = 20}), places).minCoeff() <
           Widths::no_demand;
  };
  const Points3 island = round_ring(20, 80, 2), lake = island.rowwise().reverse();
  CHECK_FALSE(demands({{island}}));
  CHECK_FALSE(demands({{lake}}));
  // A square bay is as wide as deep; a wider one is no inlet.
  CHECK_FALSE(demands({{directions(
      {{-5, -5}, {5, -5}, {5, 5}, {1.5, 5}, {1, 3.5}, {-1, 3.5}, {-1.5, 5}, {-5, 5}})}}));
  CHECK_FALSE(demands({}));
  CHECK_FALSE(demands({{Points3(island.leftCols(1))}}));
}

TEST_CASE("polygons that are cut along a meridian have the channels of the whole") {
  // On the cut an inlet that is longer than wide, and a bay that is wider.
  using Corners = std::vector<std::array<double, 2>>;
  const Corners west{{180, -10}, {180, 8}, {179.4, 10}, {170, 10}, {170, -20}, {175, -20}},
      east{{180, 8}, {180, -10}, {-175, -20}, {-170, -20}, {-170, 10}, {-179.4, 10}};
  Corners whole(west.begin() + 1, west.end());
  whole.push_back(west[0]);
  whole.insert(whole.end(), east.begin() + 2, east.end());
  const ChannelRule rule{.cells = 4, .least = 3};
  const Widths cut = Widths::by_channel({{directions(west), directions(east)}}, rule)
                         .limit_gradient(0.03),
               uncut = Widths::by_channel({{directions(whole)}}, rule);
  const Points3 places = random_sphere(20000, 3);
  CHECK(evaluate(cut, places) == evaluate(uncut.limit_gradient(0.03), places));
  CHECK(evaluate(uncut, direction(180, 9.5))[0] < Widths::no_demand);
  CHECK(evaluate(uncut, direction(180, -15))[0] == Widths::no_demand);
}

TEST_CASE("between islands there is a strait") {
  const Coast islands{
      {round_ring(0, 89, 0.5), round_ring(180, 89, 0.5)}}; // either side of the pole
  const Widths widths = Widths::by_channel(islands, {.cells = 5, .least = 2});
  const double km = earth_radius_km * degree;
  CHECK(evaluate(widths, direction(0, 90))[0] == doctest::Approx(km / 5).epsilon(0.01));
  CHECK(evaluate(widths, direction(90, 80))[0] == Widths::no_demand);
  // It grows from the circle between them.
  CHECK(evaluate(widths.limit_gradient(0.03), direction(90, 80))[0] ==
        doctest::Approx(0.2 * km + 0.03 * (10 * km - 0.5 * km)).epsilon(0.01));
}

TEST_CASE("the least width of discs, and what grows from them, is that over all") {
  test::Random random(5);
  const Points3 centres = random_sphere(500, 6), places = random_sphere(2000, 7);
  std::vector<density_detail::Disc> discs;
  for (Eigen::Index k = 0; k < centres.cols(); ++k)
    discs.push_back({{centres(0, k), centres(1, k), centres(2, k)},
                     random.real(10, 900) / earth_radius_km,
                     random.real(5, 60)});
  const Widths rule{std::make_shared<density_detail::WidthsOfRadius>(
      std::make_shared<density_detail::DiscRule>(discs))};
  for (const double gradient : {std::numeric_limits<double>::infinity(), 0.2, 0.001}) {
    const DoubleVector got =
        evaluate(std::isfinite(gradient) ? rule.limit_gradient(gradient) : rule, places);
    double worst = 0;
    for (Eigen::Index i = 0; i < places.cols(); ++i) {
      double least = Widths::no_demand;
      for (std::size_t k = 0; k < discs.size(); ++k) {
        const double beyond =
            earth_radius_km *
            (angle(centres.col(static_cast<Eigen::Index>(k)), places.col(i)) - discs[k].radius);
        least = std::min(least, beyond > 0 ? discs[k].width + gradient * beyond : discs[k].width);
      }
      worst = std::max(worst, std::abs(got[i] - least));
    }
    CHECK(worst < 1e-9);
    // In a minimum only what is below the others is looked for, with the same bits.
    const Widths limited = std::isfinite(gradient) ? rule.limit_gradient(gradient) : rule;
    CHECK(evaluate(Widths::minimum({Widths(20.0), limited}), places) ==
          DoubleVector(got.cwiseMin(20.0)));
  }
}

// Slow: all coasts of the world.
TEST_CASE("the straits of a coast have about their width [slow]") {
  const Coast coast = test::gshhg('l');
  const Widths widths = Widths::by_channel(coast, {.cells = 4, .least = 2});
  const Points3 places = [] {
    Points3 at(3, 4);
    at << direction(-5.6, 35.95), direction(1.45, 51), direction(-169, 65.8), direction(-30, 20);
    return at;
  }();
  const DoubleVector got = evaluate(widths, places);
  CHECK(got[0] == doctest::Approx(14 / 4.0).epsilon(0.15)); // Gibraltar
  CHECK(got[1] == doctest::Approx(33 / 4.0).epsilon(0.1));  // Dover
  CHECK(got[2] == doctest::Approx(39 / 4.0).epsilon(0.1));  // from Little Diomede to Alaska
  CHECK(got[3] == Widths::no_demand);
  CHECK(tbb::task_arena(1).execute([&] {
    return evaluate(Widths::by_channel(coast, {.cells = 4, .least = 2}), places);
  }) == got);
}

TEST_CASE("rules of channels that are none are refused by name") {
  const auto message = [](const Coast& coast, const ChannelRule& rule) {
    return message_of([&] { Widths::by_channel(coast, rule).rule(); });
  };
  CHECK(message(banks(1, 1), {.cells = 4}) ==
        "the least width of a rule of channels, 0, is not positive; give one");
  CHECK(has(message(banks(1, 1), {.cells = 1e-3, .least = 1e-3}), "20 million pieces"));
  CHECK(message({{directions({{0, 0}, {180, 0}, {90, 50}})}}, {.cells = 1, .least = 1}) ==
        "ring 0 of the coast, corner 1 is opposite to the one before; give a corner between them");
}
