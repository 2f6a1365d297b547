// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/settings.h"
#include "oceans/rotations.h"
#include "support/constants.h"
#include "support/directions.h"
#include "support/errors.h"
#include "support/gshhg.h"

#include <calotte/generalise.h>
#include <calotte/ocean.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

// The sea at the widths of a grid: what is finer than a cell becomes land or sea, but land between
// two seas stays, and so do passages.

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr double width = 100; ///< km, of all grids here; a degree is 111.2 km

/// Land around a direction.
Points3 disc(double longitude, double latitude, double radius, int corners = 360) {
  return circle(direction(longitude, latitude), radius * degree, corners).rings().front();
}

Points3 reversed(const Points3& ring) { return ring.rowwise().reverse(); }

Points3 rotated(const Points3& points, const Eigen::Matrix3d& by) { return by * points; }

Coast coast_of(const std::vector<Points3>& rings) { return {rings}; }

/// A box of land.
Points3 land_box(double west, double south, double east, double north) {
  return box(west * degree, south * degree, east * degree, north * degree).rings().front();
}

bool is_sea(const GeneralisedSea& sea, double longitude, double latitude) {
  return sea.sea.contains(direction(longitude, latitude));
}

/// The area that two discs on the sphere share whose second has its centre on the boundary of the
/// first, in the plane that touches them; radians.
double lens_area(double first, double second) {
  const double half = second * second / (2 * first); // from the second's centre to the chord
  const auto segment = [](double radius, double to_chord) {
    return radius * radius * std::acos(to_chord / radius) -
           to_chord * std::sqrt(radius * radius - to_chord * to_chord);
  };
  return segment(first, first - half) + segment(second, half);
}

GeneralisedSea at_width(const std::vector<Points3>& rings, const GeneraliseOptions& options = {}) {
  return generalised_sea(coast_of(rings), width, options);
}

/// A continent whose bay, from 10 W to 10 E, the sea reaches by a strait along the equator.
/// \param half_width of the strait, degrees.
std::vector<Points3> continent_with_bay(double half_width) {
  const double h = half_width;
  return {directions({{-20, -20},
                      {-20, 20},
                      {20, 20},
                      {20, h},
                      {10, h},
                      {10, 10},
                      {-10, 10},
                      {-10, -10},
                      {10, -10},
                      {10, -h},
                      {20, -h},
                      {20, -20}})
              .rowwise()
              .reverse()};
}

} // namespace

TEST_CASE("straits as wide as a cell stay, and narrower ones close unless a passage opens them") {
  // 1 degree is 111 km: 1.2 times the width, and 0.7 times.
  const GeneralisedSea open = at_width(continent_with_bay(0.55)),
                       closed = at_width(continent_with_bay(0.32));
  CHECK(is_sea(open, 0, 0));
  CHECK(is_sea(open, 15, 0));
  CHECK(open.parts.empty());
  CHECK(!is_sea(closed, 0, 0));
  CHECK(!is_sea(closed, 15, 0));
  REQUIRE(closed.parts.size() == 1);
  CHECK(angle(closed.parts[0].position, direction(0, 0)) < 3 * degree);
  CHECK(closed.parts[0].area ==
        doctest::Approx(box(-10 * degree, -10 * degree, 10 * degree, 10 * degree).area())
            .epsilon(0.1));
  REQUIRE(closed.straits.size() == 1);
  CHECK(angle(closed.straits[0].position, direction(15, 0)) < 6 * degree);

  GeneraliseOptions options;
  options.passages = {directions({{5, 0}, {25, 0}}), directions({{-19, 0}, {-12, 0}})};
  const GeneralisedSea passed = at_width(continent_with_bay(0.32), options);
  CHECK(is_sea(passed, 0, 0));
  CHECK(passed.parts.empty());
  CHECK(passed.straits.empty());
  for (const double latitude : {-0.4, 0.0, 0.4}) // a cell wide
    CHECK(is_sea(passed, 15, latitude));
  CHECK(passed.stranded_passages == std::vector<std::int64_t>{1});
  CHECK(!is_sea(passed, -15, 0));

  // A line that ends within the strait goes on, to both sides.
  options.passages = {directions({{14, 0}, {16, 0}})};
  const GeneralisedSea continued = at_width(continent_with_bay(0.32), options);
  CHECK(is_sea(continued, 0, 0));
  CHECK(continued.stranded_passages.empty());
  for (const double longitude : {11, 13, 15, 17, 19})
    CHECK(is_sea(continued, longitude, 0));

  options.passages.clear();
  options.seeds = direction(0, 0);
  const GeneralisedSea bay = at_width(continent_with_bay(0.32), options);
  CHECK(is_sea(bay, 0, 0));
  CHECK(!is_sea(bay, 100, 0));
  CHECK(bay.sea.rings().size() == 1);
}

TEST_CASE("islands stay from an area of cells on") {
  // A disc of the radius 0.53 degrees has the area of 1.26 cells.
  const Points3 continent = disc(90, 0, 20), large = disc(0, 0, 0.53), small = disc(180, 0, 0.4);
  const GeneralisedSea sea = at_width({continent, large, small});
  CHECK(sea.sea.rings().size() == 2);
  CHECK(sea.islands == 1);
  CHECK(!is_sea(sea, 0, 0));
  CHECK(is_sea(sea, 180, 0));
  GeneraliseOptions options;
  options.least_island = 0.5;
  CHECK(at_width({continent, large, small}, options).sea.rings().size() == 3);
  options.least_island = 2;
  CHECK(at_width({continent, large, small}, options).sea.rings().size() == 1);
}

TEST_CASE("narrow capes go, and narrow isthmuses and long islands stay") {
  const double h = 0.1; // degrees, of a width of 0.9
  const Points3
      cape = reversed(directions(
          {{-20, -20}, {-20, 20}, {20, 20}, {20, h}, {30, h}, {30, -h}, {20, -h}, {20, -20}})),
      isthmus = reversed(directions({{-20, -20},
                                     {-20, 20},
                                     {0, 20},
                                     {0, h},
                                     {10, h},
                                     {10, 20},
                                     {30, 20},
                                     {30, -20},
                                     {10, -20},
                                     {10, -h},
                                     {0, -h},
                                     {0, -20}})),
      island = land_box(60, -h, 90, h);
  const GeneralisedSea sea = at_width({cape, island});
  CHECK(sea.sea.rings().size() == 2);
  CHECK(is_sea(sea, 25, 0));
  CHECK(!is_sea(sea, 15, 0));
  CHECK(!is_sea(sea, 75, 0));
  const GeneralisedSea bridge = at_width({isthmus});
  CHECK(bridge.sea.rings().size() == 1);
  for (double longitude = 0; longitude <= 10; longitude += 0.5)
    for (const double latitude : {-0.18, 0.0, 0.18}) // a third of a width thick at least
      CHECK(!is_sea(bridge, longitude, latitude));
  CHECK(is_sea(bridge, 5, 5));
  CHECK(is_sea(bridge, 5, -5));
}

TEST_CASE("the sea within a part of the sphere ends at its boundary") {
  // An island at the boundary, one within, and one beyond.
  const std::vector<Points3> islands{disc(10, 0, 3), disc(0, 0, 3), disc(30, 0, 3)};
  GeneraliseOptions options;
  options.within = circle(direction(0, 0), 10 * degree);
  options.passages = {directions({{25, 0}, {40, 0}})};
  const GeneralisedSea sea = at_width(islands, options);
  CHECK(sea.sea.rings().size() == 2);
  CHECK(sea.stranded_passages.empty());
  CHECK(is_sea(sea, -9, 0));
  CHECK(is_sea(sea, 0, 9));
  CHECK(!is_sea(sea, -11, 0));
  CHECK(!is_sea(sea, 8, 0));
  CHECK(!is_sea(sea, 20, 0));
  const double expected = options.within.area() - circle(direction(0, 0), 3 * degree).area() -
                          lens_area(10 * degree, 3 * degree);
  CHECK(sea.sea.area() / expected == doctest::Approx(1).epsilon(0.02));
  CHECK(sea.displacement < 0.7);
  options.passages = {directions({{-2, 0}, {2, 0}}), directions({{0, 0}, {0, 1}})};
  CHECK(is_sea(at_width(islands, options), 0, 0) == false);
  options.passages = {directions({{-15, 0}, {0, 0}, {15, 0}})}; // through two islands, and beyond
  const GeneralisedSea passed = at_width(islands, options);
  CHECK(is_sea(passed, 0, 0));
  CHECK(is_sea(passed, 9, 0));
  for (const double beyond : {-10.5, 10.5, 13.0})
    CHECK(!is_sea(passed, beyond, 0));

  const auto refused = [&](const GeneraliseOptions& bad) {
    return message_of([&] { at_width(islands, bad); });
  };
  options.passages = {};
  options.seeds = directions({{20, 10}});
  CHECK(refused(options) == "seed 0 is outside the region; give a point in its sea");
  options.seeds = {};
  options.within = circle(direction(30, 0), 2 * degree);
  CHECK(refused(options).find("no part of the sea is as wide as a cell") == 0);
  options.within = Surface::plane();
  CHECK(refused(options).find("the sea of a coast is for the sphere") == 0);
}

TEST_CASE("a thin ring of land keeps the sea within it apart") {
  for (const double thickness : {0.01, 0.1, 0.5}) {
    const std::vector<Points3> ring{disc(0, 90, 10), reversed(disc(0, 90, 10 - thickness))};
    const GeneralisedSea sea = at_width(ring);
    CHECK(sea.sea.rings().size() == 1);
    CHECK(sea.parts.size() == 1);
    CHECK(!is_sea(sea, 0, 90));
    GeneraliseOptions options;
    options.seeds = directions({{0, 90}, {0, 0}});
    const GeneralisedSea both = at_width(ring, options);
    CHECK(both.sea.rings().size() == 2);
    CHECK(both.parts.empty());
    for (double longitude = 0; longitude < 360; longitude += 10)
      for (const double beside : {-0.1, 0.0, 0.1})
        CHECK(!is_sea(both, longitude, 90 - 10 + thickness / 2 + beside));
  }
}

TEST_CASE("a coast of the Earth: rings near it, in any position, the same for any threads") {
  const Coast earth = gshhg('c');
  const Widths widths = Widths::by_latitude({{{-90, 200}, {0, 300}, {90, 150}}});
  double area = 0;
  for (const Eigen::Matrix3d& rotation : rotations()) {
    Coast coast = earth;
    for (Points3& ring : coast.rings)
      ring = rotated(ring, rotation);
    const GeneralisedSea sea = generalised_sea(coast, 300);
    CHECK(sea.usual_displacement < 0.5);
    area = area == 0 ? sea.sea.area() : area;
    CHECK(sea.sea.area() == doctest::Approx(area).epsilon(0.01));
    CHECK(!sea.sea.contains(rotation * direction(20, 0)));
    CHECK(!sea.sea.contains(rotation * direction(-79, 9))); // Panama, a third of a cell
    CHECK(sea.sea.contains(rotation * direction(-150, 0)));
  }
  const auto on_threads = [&](int threads) {
    return with_threads(threads, [&] { return generalised_sea(earth, widths); });
  };
  const GeneralisedSea one = on_threads(1), three = on_threads(3);
  CHECK(one.sea == three.sea);
  CHECK(one.displacement == three.displacement);
  CHECK(one.sea_to_land == three.sea_to_land);
  CHECK(one.straits.size() == three.straits.size());
  CHECK(Surface::sphere().within(one.sea.rings()).area() == one.sea.area()); // simple, nested
}

TEST_CASE("the area that the sea gains and loses is that between the coasts") {
  const Coast earth = gshhg('c');
  const GeneralisedSea sea = generalised_sea(earth, 200);
  const double before = 4 * pi - earth.area;
  CHECK(sea.sea.area() - before ==
        doctest::Approx(sea.land_to_sea - sea.sea_to_land).epsilon(0.02));
}

TEST_CASE("corners of the rings are about a width apart, by the local width") {
  const Widths widths = Widths::by_latitude({{{-90, 100}, {90, 400}}});
  const GeneralisedSea sea = generalised_sea(coast_of({disc(0, 0, 40, 4000)}), widths);
  REQUIRE(sea.sea.rings().size() == 1);
  const DoubleMatrix& ring = sea.sea.rings().front();
  const DoubleVector local = evaluate(widths, ring);
  for (Eigen::Index k = 0; k < ring.cols(); ++k) {
    const Eigen::Index next = k + 1 < ring.cols() ? k + 1 : 0;
    const double length = angle(ring.col(k), ring.col(next)) * earth_radius_km;
    CHECK(length > 0.7 * local[k]);
    CHECK(length < 1.4 * local[k]);
    // On the coast, which has arcs of 7 km.
    CHECK(std::abs(angle(ring.col(k), direction(0, 0)) - 40 * degree) < 1e-5);
  }
  CHECK(sea.displacement < 0.1);
}

TEST_CASE("bad coasts and options are refused in one line, and the others are right") {
  const Points3 continent = disc(0, 0, 20);
  const auto refused = [](const std::vector<Points3>& rings, const GeneraliseOptions& options,
                          double km, const std::string& part) {
    const std::string text = refusal_of([&] { generalised_sea(coast_of(rings), km, options); });
    CHECK_MESSAGE(text.find(part) != std::string::npos, text);
  };
  GeneraliseOptions options;
  refused({}, {}, width, "the coast has no shore");
  refused({disc(0, 0, 0.1)}, {}, width, "all land of the coast is smaller than the least island");
  refused({continent, continent}, {}, width, "areas of land are there twice");
  refused({disc(0, 0, 175)}, {}, 2000, "no part of the sea is as wide as a cell");
  options.least_island = 0.1;
  refused({continent}, options, width, "the least island has 0.1 cells; give 0.25 or more");
  options = {};
  options.seeds = directions({{100, 0}, {10, 0}});
  refused({continent}, options, width, "seed 1 is on land");
  options.seeds = direction(15, 0);
  refused(continent_with_bay(0.2), options, width, "seed 0 is in a part of the sea");
  options = {};
  options.passages = {direction(0, 0), directions({{0, 0}, {180, 0}})};
  refused({continent}, options, width, "line 1");
  CHECK(refusal_of([&] {
          generalised_sea(coast_of({continent}),
                          Widths::where(box(0, 0, 1, 1), width, Widths::no_demand));
        }).find("no rule gives a width at longitude") == 0);

  // Islands that touch in a corner or along a side, a ring that crosses itself, a lake with an
  // island.
  const Points3 west = land_box(-10, -10, 0, 10), east = land_box(0, -10, 10, 10),
                corner = land_box(10, 10, 20, 20);
  const GeneralisedSea touching = at_width({west, east, corner});
  CHECK(!is_sea(touching, 0, 0));
  CHECK(!is_sea(touching, 15, 15));
  Points3 crossing = disc(0, 0, 20);
  const Eigen::Vector3d swapped = crossing.col(100);
  crossing.col(100) = crossing.col(102);
  crossing.col(102) = swapped;
  CHECK(at_width({crossing}).sea.rings().size() == 1);
  const GeneralisedSea lake = at_width({continent, reversed(disc(0, 0, 10)), disc(0, 0, 3)});
  CHECK(lake.sea.rings().size() == 1);
  CHECK(lake.parts.size() == 1);
}

TEST_CASE("widths that require too many points along the coast are refused [slow]") {
  CHECK(refusal_of([] {
          generalised_sea(coast_of({disc(0, 0, 20)}), 0.01);
        }).find("more than 20 million points") != std::string::npos);
}
