// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "support/directions.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/gshhg.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/ocean.h>
#include <calotte/voronoi.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

// Widths by the distance from a coast, apart in the sea and on land.

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double half_round = pi * earth_radius_km;

/// A width that tells the distance.
const WidthProfile tells{{{-half_round, 1e6 - half_round}, {half_round, 1e6 + half_round}}};

DoubleVector distances(const Coast& coast, const Points3& places) {
  return evaluate(Widths::by_distance(coast, tells), places).array() - 1e6;
}

} // namespace

TEST_CASE("distances from a coast are positive in the sea and negative on land") {
  // An island over the north pole, and a lake with an island in it over the date line.
  const Eigen::Vector3d pole = direction(0, 90), lake = direction(180, 0);
  const auto ring = [](const Eigen::Vector3d& centre, double radius) -> Points3 {
    return circle(centre, radius * degree, 4000).rings().front();
  };
  const Coast coast{
      {ring(pole, 10), ring(lake, 50), ring(lake, 30).rowwise().reverse(), ring(lake, 5)}};
  const Points3 places = random_sphere(5000, 1);
  const DoubleVector got = distances(coast, places);
  double worst = 0;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const double from_lake = angle(lake, places.col(i)) / degree,
                 from_pole = angle(pole, places.col(i)) / degree;
    // From the nearest circle, and from the island at the pole, which the ring does not reach.
    const double nearest = from_lake > 30     ? std::max(from_lake - 50, 30 - from_lake)
                           : from_lake > 17.5 ? 30 - from_lake
                                              : from_lake - 5,
                 expected = std::min(nearest, from_pole - 10);
    worst = std::max(worst, std::abs(got[i] - expected * degree * earth_radius_km));
  }
  CHECK(worst < 0.01); // km, of the polygons
}

TEST_CASE("a share by the distance from a coast: in the sea and on land") {
  const auto ring = [](double lon, double lat, double radius) -> Points3 {
    return circle(direction(lon, lat), radius * degree, 4000).rings().front();
  };
  const Coast coast{{ring(0, 90, 30), ring(150, -10, 20)}};
  const Points3 places = random_sphere(2000, 3);
  const DoubleVector from = distances(coast, places),
                     got = evaluate(Widths::blend(30.0, 10.0, {coast, {{{-800, 1}, {200, 0.25}}}}),
                                    places);
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    CHECK(got[i] ==
          doctest::Approx(30 -
                          20 * std::lerp(1.0, 0.25, std::clamp((from[i] + 800) / 1000, 0.0, 1.0)))
              .epsilon(1e-9));
  CHECK(message_of([&] {
          WidthShare(coast, {{{0, 2}}});
        }).find("not a fraction from 0 to 1") != std::string::npos);
  CHECK(message_of([&] { WidthShare(Coast{}, {{{0, 1}}}); }).find("the coast has no shore") == 0);
}

TEST_CASE("an arc that runs back cancels one: a coast that passes an arc three times is closed") {
  const Points3 once = (Points3(3, 3) << direction(0, 0), direction(20, 0), direction(10, 20))
                           .finished(),
                thrice = (Points3(3, 5) << direction(0, 0), direction(20, 0), direction(0, 0),
                          direction(20, 0), direction(10, 20))
                             .finished();
  const std::vector<Points3> lines = shores({.rings = {thrice}, .area = 0});
  REQUIRE(lines.size() == 3); // arcs
  CHECK(lines == shores({.rings = {once}, .area = 0}));
}

TEST_CASE("a coast without what is small: islands, lakes, and what lies in these") {
  const Eigen::Vector3d pole = direction(0, 90), lake = direction(180, 0), isle = direction(60, 0);
  const auto ring = [](const Eigen::Vector3d& centre, double radius) -> Points3 {
    return circle(centre, radius * degree, 400).rings().front();
  };
  const auto cap = [&](double radius) { return circle(pole, radius * degree, 400).area(); };
  const double all = cap(50) - cap(10) + cap(5) + cap(8) - cap(4);
  const Coast coast{{ring(lake, 50), ring(lake, 10).rowwise().reverse(), ring(lake, 5),
                     ring(isle, 8), ring(isle, 4).rowwise().reverse()},
                    all};
  struct Kept {
    double radius; ///< of a circle with the least area
    std::size_t rings;
    double area;
  };
  for (const auto& [radius, rings, area] : std::vector<Kept>{{0, 5, all},
                                                             {3, 5, all},
                                                             {4.5, 4, all + cap(4)},
                                                             {6, 3, all + cap(4) - cap(5)},
                                                             {9, 2, cap(50) - cap(10)},
                                                             {12, 1, cap(50)}}) {
    const Coast large = without_small(coast, radius == 0 ? 0 : 4 * cap(radius), 2);
    CAPTURE(radius);
    CHECK(large.rings.size() == rings);
    CHECK(large.area == doctest::Approx(area).epsilon(1e-12));
  }
  CHECK(message_of([&] { without_small(coast, cap(60), 1); }) ==
        "all land of the coast is smaller than the least area; give a smaller one");
  CHECK(message_of([&] { without_small(coast, -1, 1); }) ==
        "the least area of islands and lakes is -1; give 0 or more");
  CHECK(message_of([&] { without_small(coast, 1, 0); }) ==
        "the radius of the sphere of islands and lakes is 0; give it in km, above 0");
}

TEST_CASE("the lines of GSHHG without islands below 10000 km2 sum to the area that is left") {
  const Coast all = gshhg('c'), large = without_small(all, 1e4, earth_radius_km);
  CHECK(large.rings.size() < all.rings.size() / 2);
  CHECK(large.rings.size() > 30);
  CHECK(large.area < all.area);
  CHECK(large.area > 0.98 * all.area);
  const Voronoi cells = voronoi(delaunay(fibonacci_sphere(500)));
  CHECK(land_fractions(cells, large).dot(cells.cell_area) ==
        doctest::Approx(large.area).epsilon(1e-10));
}

TEST_CASE("one side of a coast says nothing of the other") {
  const Coast coast = test::gshhg('c');
  const WidthProfile grows{{{0, 10}, {600, 60}}};
  const Points3 places = random_sphere(20000, 2);
  const DoubleVector away = distances(coast, places),
                     either = evaluate(Widths::by_distance(shores(coast), grows), places),
                     sea = evaluate(Widths::by_distance(coast, grows, CoastSide::sea), places),
                     land = evaluate(Widths::by_distance(coast, grows, CoastSide::land), places);
  CHECK((sea.cwiseMin(land) - either).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(((sea.array() < Widths::no_demand) == (away.array() >= 0)).all());
  CHECK(((land.array() < Widths::no_demand) == (away.array() < 0)).all());
  const std::vector<Points3> rings = shores(coast); // the shore is of both
  for (const CoastSide side : {CoastSide::sea, CoastSide::land})
    CHECK(evaluate(Widths::by_distance(coast, grows, side), rings.front()).allFinite());
  const double part = (away.array() < 0).cast<double>().mean();
  CHECK(part == doctest::Approx(coast.area / (4 * std::numbers::pi)).epsilon(0.03));
  // Limited, the width grows inland from that of the shore.
  const DoubleVector limited =
      evaluate(Widths::by_distance(coast, grows, CoastSide::sea).limit_gradient(0.05), places);
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    CHECK(limited[i] ==
          doctest::Approx(away[i] < 0 ? 10 - 0.05 * away[i] : std::min(60.0, 10 + 0.05 * away[i])));
}

TEST_CASE("land that is there twice, or overlaps, has no sides") {
  const auto square = [](double west, double east) {
    Points3 ring(3, 4);
    ring << direction(west, 0), direction(east, 0), direction(east, 10), direction(west, 10);
    return ring;
  };
  const auto message = [](const Coast& coast) {
    return message_of([&] { Widths::by_distance(coast, tells); });
  };
  CHECK(message({{square(0, 10), square(0, 10)}})
            .find("areas of land are there twice, one with a corner at longitude ") == 0);
  CHECK(message({{square(0, 10), square(5, 15)}}) == "areas of land overlap; give them united");
}

TEST_CASE("shares of a raster are linear between its nodes") {
  Raster raster{DoubleVector{{0, 90, 180, 270}}, DoubleVector{{-45, 45}}, DoubleMatrix(4, 2)};
  raster.values.setZero();
  raster.values.row(1).setOnes();
  Points3 places(3, 4);
  places << direction(90, 10), direction(45, 0), direction(112.5, -45), direction(0, 90);
  const DoubleVector t{{1, 0.5, 0.75, 0.25}};
  const DoubleVector blend = evaluate(Widths::blend(100.0, 20.0, raster), places);
  CHECK((blend - (100 - 80 * t.array()).matrix()).cwiseAbs().maxCoeff() < 1e-4);
  CHECK(evaluate(Widths::where(raster, 20.0, 100.0), places)[2] == 20);
  CHECK(evaluate(Widths::where(raster, 20.0, 100.0), places)[3] == 100);
  raster.values(0, 0) = 1.5;
  CHECK(error_of([&] { WidthShare{raster}; }).what() ==
        std::string("shares: value (0, 0) is not a fraction from 0 to 1; correct it"));
}

TEST_CASE("profiles of a coast that are none are refused by name") {
  const auto message = [](const Coast& coast, const WidthProfile& profile, CoastSide side) {
    return message_of([&] { Widths::by_distance(coast, profile, side); });
  };
  CHECK(message({}, {{{0, 1}}}, CoastSide::both) ==
        "the coast has no shore to be distant from; give rings");
  CHECK(message(test::gshhg('c'), {{{-10, 5}, {0, 1}}}, CoastSide::sea) ==
        "node 0 of a profile of a distance is at -10, outside 0 to 300000; correct it");
}
