// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/points.h"
#include "domain/spherical_outline.h"

#include "support/exact.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace calotte;
using base_detail::Vec3;
using domain_detail::Side;
using domain_detail::SphericalOutline;

constexpr double pi = std::numbers::pi, degree = pi / 180;

Eigen::Vector3d vector(const Vec3& p) { return {p.x, p.y, p.z}; }
Eigen::Vector3d lonlat(double longitude, double latitude) {
  return vector(base_detail::from_lonlat(longitude, latitude));
}

Points3 spherical_ring(const std::vector<std::array<double, 2>>& lonlats) {
  Points3 ring(3, std::ssize(lonlats));
  for (std::size_t i = 0; i < lonlats.size(); ++i)
    ring.col(static_cast<Eigen::Index>(i)) = lonlat(lonlats[i][0], lonlats[i][1]);
  return ring;
}

Points3 reversed(const Points3& ring) { return ring.rowwise().reverse(); }

Surface complement(const Surface& region) {
  Surface::Rings rings;
  for (const DoubleMatrix& ring : region.rings())
    rings.emplace_back(ring.rowwise().reverse());
  return Surface::sphere().within(rings);
}

// ---- The sides without an index, in exact arithmetic

int sign_of_det(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double value = dot(cross(a, b), c);
  return std::abs(value) > 1e-12 ? (value > 0) - (value < 0) : exact::orientation(a, b, c);
}

/// True if p lies on the arc, given that it lies on its great circle.
bool within(const Vec3& a, const Vec3& b, const Vec3& p) {
  const exact::Integers u = exact::integers(a), v = exact::integers(b), w = exact::integers(p);
  const exact::Integers normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
  return sgn(exact::det(u, w, normal)) >= 0 && sgn(exact::det(w, v, normal)) >= 0;
}

/// Crossings of the path from a place inside, which must be in general position.
Side brute_side(const std::vector<SphericalOutline::Edge>& edges, const Vec3& known,
                const Vec3& place) {
  bool inside = true, general = true;
  for (const auto& [a, b] : edges) {
    const int start = sign_of_det(a, b, known), end = sign_of_det(a, b, place);
    if (end == 0 && within(a, b, place))
      return Side::boundary;
    general &= start != 0;
    if (start != -end)
      continue;
    const int from = sign_of_det(known, place, a), to = sign_of_det(known, place, b);
    general &= from * to != 0;
    inside ^= from == -start && to == start;
  }
  REQUIRE(general);
  return inside ? Side::inside : Side::outside;
}

// ---- Regions

struct Shape {
  std::string name;
  Surface region;
  Vec3 known; ///< inside, in general position
};

Surface archipelago(int islands) {
  const Points3 centres = fibonacci_sphere(islands);
  Surface::Rings rings;
  for (int i = 0; i < islands; ++i)
    rings.push_back(circle(centres.col(i), 0.01 + 0.04 * (i % 7) / 7, 8 + i % 11).rings()[0]);
  return Surface::sphere().within(rings);
}

/// Teeth of 3 degrees, with walls of 1e-7 degrees between.
Surface comb() {
  std::vector<std::array<double, 2>> corners{{-20, -10}, {41, -10}, {41, 0}};
  for (int tooth = 19; tooth >= 0; --tooth) {
    const double west = 3.0 * tooth - 20, east = west + 3 - 1e-7;
    corners.insert(corners.end(), {{east, 0}, {east, 40}, {west, 40}, {west, 0}});
  }
  return Surface::sphere().within({spherical_ring(corners)});
}

std::vector<Shape> shapes() {
  const Vec3 generic{0.31234, 0.41357, 0.21579};
  const Surface sphere;
  return {
      {"hemisphere", sphere.within({spherical_ring({{0, 0}, {120, 0}, {240, 0}})}), generic},
      {"western hemisphere",
       sphere.within({spherical_ring({{0, 0}, {0, 90}, {180, 0}, {0, -90}})}),
       {-0.31, -0.4, 0.2}},
      {"cap of 1 degree", circle(lonlat(20, 30), 1 * degree), base_detail::from_lonlat(20.1, 30.2)},
      {"cap of 170 degrees", circle(lonlat(20, 30), 170 * degree, 100), generic},
      {"ring around a pole",
       sphere.within({spherical_ring({{0, 60}, {90, 50}, {180, 70}, {270, 40}})}),
       {.01, .02, .9}},
      {"over the date line",
       sphere.within({spherical_ring({{170, -10}, {-170, -20}, {-160, 10}, {175, 20}})}),
       base_detail::from_lonlat(179.123, 1.2345)},
      {"channel with an island",
       sphere.within({channel(-0.4, 0.5, 24).rings()[0], channel(-0.4, 0.5, 24).rings()[1],
                      reversed(spherical_ring({{10, -5}, {30, -5}, {30, 15}, {10, 15}})),
                      spherical_ring({{15, 0}, {20, 0}, {20, 5}})}),
       base_detail::from_lonlat(18.76, 1.2345)},
      {"archipelago", archipelago(200), {0, 0, 0}},
      {"comb", comb(), base_detail::from_lonlat(0.1234, -3.3217)}};
}

std::vector<Vec3> places_for(const SphericalOutline& outline, test::Random& random) {
  std::vector<Vec3> places;
  for (int i = 0; i < 150; ++i)
    places.push_back(random.direction());
  for (int i = 0; i < 60; ++i) // on lines between cells of an index, and on axes
    places.push_back(
        exact_detail::normalised({1.0 * random.integer(-4, 4), 1.0 * random.integer(-4, 4), 4}));
  const auto edges = static_cast<int>(outline.edges().size());
  for (int i = 0; i < 60; ++i) {
    const auto& [a, b] = outline.edges()[static_cast<std::size_t>(random.integer(0, edges - 1))];
    const Vec3 middle = exact_detail::normalised(a + b);
    const double off = std::pow(10, random.real(-17, -3));
    places.insert(places.end(),
                  {a, middle, exact_detail::normalised(middle + off * random.direction()),
                   exact_detail::normalised(a + off * random.direction())});
  }
  return places;
}

TEST_CASE("the side of a place is that of a search over all edges in exact arithmetic") {
  test::Random random(1);
  for (Shape& shape : shapes()) {
    CAPTURE(shape.name);
    if (shape.name == "archipelago")
      shape.known = base_detail::column(fibonacci_sphere(200), 3);
    const SphericalOutline outline(shape.region.rings()), other(complement(shape.region).rings());
    int boundary = 0;
    for (const Vec3& place : places_for(outline, random)) {
      CAPTURE(place.x);
      CAPTURE(place.y);
      CAPTURE(place.z);
      const Side side = brute_side(outline.edges(), shape.known, place);
      REQUIRE(outline.side(place) == side);
      REQUIRE(other.side(place) == (side == Side::inside    ? Side::outside
                                    : side == Side::outside ? Side::inside
                                                            : Side::boundary));
      boundary += side == Side::boundary;
    }
    CHECK(boundary >= 60); // the corners, at least
    CHECK(outline.area() + other.area() == doctest::Approx(4 * pi).epsilon(1e-15));
  }
}

TEST_CASE("places exactly on meridians, on the equator and on diagonals are on the boundary") {
  const SphericalOutline octant({spherical_ring({{0, 0}, {90, 0}, {0, 90}})});
  CHECK(octant.area() == doctest::Approx(pi / 2).epsilon(1e-15));
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.real(0, 1), y = random.real(0, 1);
    REQUIRE(octant.side({x, y, 0}) == Side::boundary);
    REQUIRE(octant.side({0, x, y}) == Side::boundary);
    REQUIRE(octant.side({x, y, 1e-300}) == Side::inside);
    REQUIRE(octant.side({x, y, -1e-300}) == Side::outside);
    REQUIRE(octant.side({x, y, -1 - x}) == Side::outside);
  }
  const Surface diagonal =
      Surface::sphere().within({(Points3(3, 3) << 1, 1, 1, 0, 1, 1, 0, 0, 1).finished()});
  for (int i = 1; i < 100; ++i) { // x >= y >= z >= 0
    CHECK(diagonal.contains({100, 100, 1.0 * i}));
    CHECK(diagonal.contains({100, 1.0 * i, 1.0 * i}));
    CHECK_FALSE(diagonal.contains({1, i * 1e-10, std::nextafter(i * 1e-10, 1)}));
  }
}

TEST_CASE("areas are those of formulas") {
  for (const double radius : {1e-6, 1 * degree, 1.0, pi / 2, 170 * degree, pi - 1e-6})
    for (const int corners : {8, 360, 5000}) {
      const double t = std::tan(radius / 2), angle = 2 * pi / corners;
      const double expected =
          2 * corners * std::atan2(t * t * std::sin(angle), 1 + t * t * std::cos(angle));
      const Eigen::Vector3d centre(0.3, -0.5, 0.7);
      const double found = circle(centre, radius, corners).area();
      CHECK(std::abs(found - expected) <= 1e-14 + 1e-12 * std::min(expected, 4 * pi - expected));
      if (radius < 1e-5)
        CHECK(found == doctest::Approx(expected).epsilon(1e-9));
    }
  CHECK(Surface().area() == 4 * pi);
  CHECK(channel(-pi / 2, 0).area() == doctest::Approx(2 * pi).epsilon(1e-15));
  CHECK(channel(0.3, 0.7, 20'000).area() ==
        doctest::Approx(2 * pi * (std::sin(0.7) - std::sin(0.3))).epsilon(1e-7));
  // A planar ellipse of this size differs by its square.
  CHECK(ellipse({1, 2, 3}, 3e-4, 1e-4, 0.5, 5000).area() ==
        doctest::Approx(pi * 3e-8).epsilon(1e-6));
  double sum = 0;
  for (int face = 0; face < 8; ++face) {
    const double x = face & 1 ? -1 : 1, y = face & 2 ? -1 : 1, z = face & 4 ? -1 : 1;
    Points3 ring = (Points3(3, 3) << x, 0, 0, 0, y, 0, 0, 0, z).finished();
    sum += Surface::sphere().within({x * y * z > 0 ? ring : reversed(ring)}).area();
  }
  CHECK(sum == doctest::Approx(4 * pi).epsilon(1e-15));
  // Corners that are nearly opposite.
  for (const double short_of : {1e-3, 1e-9, 1e-15, 1e-300})
    CHECK(Surface::sphere()
              .within({(Points3(3, 3) << 1, -1, 0, 0, short_of, 0, 0, 0, 1).finished()})
              .area() == doctest::Approx(pi - std::atan(short_of)).epsilon(1e-14));
  CHECK(
      Surface::sphere()
          .within({(Points3(3, 3) << -1e150, 1, -1e150, -1e150, 5e-324, 0, 2.25, 0, 0).finished()})
          .area() == doctest::Approx(2 * pi).epsilon(1e-14));
  const double above = std::nextafter(-1e150, 0.0), one = std::nextafter(1.0, 2.0);
  const Surface sliver = Surface::sphere().within(
      {(Points3(3, 3) << -1e150, 0.25, above, 1, 0, 1, one, 1e-300, one).finished()});
  CHECK(std::abs(sliver.area()) < 1e-14);
}

TEST_CASE("the ends of an ellipse's axes, and the corners of a circle and a channel") {
  const Eigen::Vector3d centre = lonlat(30, 40);
  const Points3 ring = ellipse(centre, 0.5, 0.2, 90 * degree, 8).rings()[0];
  CHECK(ring.col(0).dot(centre) == doctest::Approx(std::cos(0.5)));
  CHECK(ring.col(2).dot(centre) == doctest::Approx(std::cos(0.2)));
  CHECK(ring.col(0).dot(Eigen::Vector3d(-0.5, std::sqrt(0.75), 0)) ==
        doctest::Approx(std::sin(0.5))); // east
  CHECK(ring.col(2).z() > centre.z());   // north: the ring is counter-clockwise
  const double focus = std::acos(std::cos(0.5) / std::cos(0.2)); // distance from the centre
  const Eigen::Vector3d east(-0.5, std::sqrt(0.75), 0);
  const Surface fine = ellipse(centre, 0.5, 0.2, 90 * degree, 100);
  for (Eigen::Index i = 0; i < 100; ++i) {
    const auto distance = [&](double side) {
      return std::acos(
          fine.rings()[0].col(i).dot(std::cos(focus) * centre + side * std::sin(focus) * east));
    };
    CHECK(distance(1) + distance(-1) == doctest::Approx(1.0).epsilon(1e-12));
  }
  CHECK(circle(centre, 0.1, 8).rings()[0].col(0).isApprox(lonlat(30, 40 + 0.1 / degree), 1e-14));
  CHECK(circle(lonlat(0, 90), 0.1, 8)
            .rings()[0]
            .col(0)
            .isApprox(lonlat(180, 90 - 0.1 / degree), 1e-14));
  CHECK(channel(-1, pi / 2).rings().size() == 1);
  CHECK(channel(-1, pi / 2).contains({0, 0, 1}));
}

TEST_CASE("a rotation of the axes changes neither sides nor areas") {
  const Surface::Rings rings = archipelago(30).rings();
  Surface::Rings rotated;
  for (const DoubleMatrix& ring : rings) // x y z -> y z x
    rotated.emplace_back(ring(std::array{1, 2, 0}, Eigen::all));
  const SphericalOutline a(rings), b(rotated);
  CHECK(a.area() == doctest::Approx(b.area()).epsilon(1e-14));
  test::Random random(4);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = random.direction();
    REQUIRE(a.side(p) == b.side({p.y, p.z, p.x}));
  }
}

TEST_CASE("all edges within a distance are reported once, and few others") {
  const SphericalOutline outline({circle({1, 2, 3}, 0.6, 5000).rings()[0],
                                  reversed(spherical_ring({{60, 50}, {70, 50}, {65, 60}}))});
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 place =
        exact_detail::normalised(Vec3{1, 2, 3} + random.real(0, 4) * random.direction());
    const double reach = std::pow(10, random.real(-5, 0.5)), chord = 2 * std::sin(reach / 2);
    std::vector<const SphericalOutline::Edge*> told;
    outline.for_each_edge_near(place, reach, [&](const auto& edge) { told.push_back(&edge); });
    std::sort(told.begin(), told.end());
    REQUIRE(std::adjacent_find(told.begin(), told.end()) == told.end());
    int missing = 0, far = 0;
    for (const auto& edge : outline.edges()) {
      const double distance = std::sqrt(domain_detail::square_from(edge, place)),
                   length = norm(edge.to - edge.from);
      const bool listed = std::binary_search(told.begin(), told.end(), &edge);
      missing += !listed && (distance <= chord * (1 - 1e-12) || reach >= pi);
      far += listed && reach < pi && distance > 2 * reach + 2 * length;
    }
    REQUIRE(missing == 0);
    REQUIRE(far == 0);
  }
}

TEST_CASE("rings of any orientation: around a place, or what they enclose") {
  for (Shape& shape : shapes()) {
    CAPTURE(shape.name);
    if (shape.name == "archipelago")
      shape.known = base_detail::column(fibonacci_sphere(200), 3);
    const std::vector<Points3> rings(shape.region.rings().begin(), shape.region.rings().end());
    std::vector<Points3> mixed = rings;
    for (std::size_t r = 0; r < mixed.size(); r += 2)
      mixed[r] = reversed(mixed[r]);
    CHECK(region_around(mixed, vector(shape.known)) == shape.region);
    const bool smaller = shape.region.area() <= 2 * pi;
    if (shape.name.find("hemisphere") == std::string::npos)
      CHECK((enclosed_region(mixed) == shape.region) == smaller);
    else
      CHECK(enclosed_region(rings) == shape.region);
  }
}

Points3 parallel(double latitude) {
  std::vector<std::array<double, 2>> corners;
  for (int longitude = -180; longitude < 180; longitude += 10)
    corners.push_back({1.0 * longitude, latitude});
  return spherical_ring(corners);
}

TEST_CASE("rings enclose the side without poles, or else the smaller side") {
  struct Case {
    std::string name;
    std::vector<Points3> rings;
    std::vector<std::array<double, 2>> in, out;
  };
  std::vector<std::array<double, 2>> wide; // 340 by 160 degrees
  for (int longitude = -170; longitude <= 170; longitude += 10)
    wide.push_back({1.0 * longitude, -80});
  for (int longitude = 170; longitude >= -170; longitude -= 10)
    wide.push_back({1.0 * longitude, 80});
  const std::vector<Case> cases{
      {"beside a pole",
       {spherical_ring({{10, 88}, {60, 88}, {30, 89.999}})},
       {{30, 89}},
       {{30, 0}}},
      {"beside the other",
       {spherical_ring({{10, -88}, {60, -88}, {30, -89.999}})},
       {{30, -89}},
       {{0, 0}}},
      {"round a pole", {parallel(30)}, {{0, 90}}, {{0, -90}, {0, 0}}},
      {"round the other", {parallel(-10)}, {{0, -90}}, {{0, 90}, {0, 0}}},
      {"most of the sphere",
       {spherical_ring(wide)},
       {{0, 0}, {90, 70}},
       {{180, 0}, {0, 90}, {0, -90}}},
      {"a wide band", {parallel(-60), parallel(60)}, {{0, 0}}, {{0, 90}, {0, -90}}},
      {"a band with a hole",
       {parallel(-60), parallel(60), spherical_ring({{0, 0}, {9, 0}, {9, 9}})},
       {{100, 0}},
       {{0, 90}, {6, 3}}},
      {"a corner at a pole", {spherical_ring({{0, 0}, {90, 0}, {0, 90}})}, {{45, 30}}, {{180, 0}}},
      {"through a pole",
       {spherical_ring({{0, 80}, {180, 80}, {135, 60}, {45, 60}})},
       {{90, 70}},
       {{-90, 85}, {0, 0}}},
      {"two islands",
       {spherical_ring({{0, 0}, {9, 0}, {9, 9}}), spherical_ring({{50, 0}, {59, 0}, {59, 9}})},
       {{6, 3}, {56, 3}},
       {{30, 0}, {0, 90}}}};
  for (const Case& c : cases)
    for (unsigned turned = 0; turned < 1U << c.rings.size(); ++turned) {
      CAPTURE(c.name);
      CAPTURE(turned);
      std::vector<Points3> rings = c.rings;
      for (std::size_t r = 0; r < rings.size(); ++r)
        if ((turned >> r & 1U) != 0)
          rings[r] = reversed(rings[r]);
      const Surface region = enclosed_region(rings);
      for (const auto& [longitude, latitude] : c.in)
        CHECK(region.contains(lonlat(longitude, latitude)));
      for (const auto& [longitude, latitude] : c.out)
        CHECK_FALSE(region.contains(lonlat(longitude, latitude)));
    }
  // Of equal sides it is the left one.
  CHECK(enclosed_region({parallel(0)}).contains(lonlat(0, 90)));
  CHECK(enclosed_region({reversed(parallel(0))}).contains(lonlat(0, -90)));
}

TEST_CASE("closed rings, repeated corners, and cuts along a meridian whose sides differ a little") {
  const std::vector<std::array<double, 2>> around{{-180, 60}, {-120, 61}, {-60, 60},
                                                  {0, 62},    {60, 60},   {120, 61}};
  const Surface cap = enclosed_region({spherical_ring(around)});
  CHECK(cap.contains(lonlat(0, 90)));
  const auto is_cap = [&](std::vector<std::array<double, 2>> rest, double tolerance = 1e-14) {
    std::vector<std::array<double, 2>> corners(around.begin(), around.end());
    corners.insert(corners.end(), rest.begin(), rest.end());
    for (const bool backwards : {false, true}) {
      const Points3 ring = backwards ? reversed(spherical_ring(corners)) : spherical_ring(corners);
      const Surface found = enclosed_region({ring});
      CHECK(found.rings().size() == 1);
      CHECK(std::abs(found.area() - cap.area()) < tolerance);
      CHECK(found.contains(lonlat(180, 80)));
      CHECK_FALSE(region_around({ring}, lonlat(0, 0)).contains(lonlat(180, 80)));
    }
  };
  is_cap({{180, 60}});             // closed
  is_cap({{180, 60}, {-180, 60}}); // twice
  is_cap({{180, 60}, {180, 90}, {-180, 90}});
  is_cap({{180, 60}, {180, 90}, {-180, 90}, {-180, 60}});
  for (const double off : {1e-15, 1e-14, 1e-12, 1e-10, 1e-8, -1e-14, -1e-10}) {
    CAPTURE(off);
    is_cap({{180, 60 + off}, {180, 90}, {-180, 90}}, 1e-9);
    is_cap({{180 + off, 60}, {180, 90}, {-180, 90}}, 1e-9);
    is_cap({{180, 60 + off}, {180, 75}, {180, 90}, {-180, 90}, {-180 + off, 75}}, 1e-9);
    is_cap({{180, 60}, {180, 90 - std::abs(off)}, {-180, 90 - std::abs(off)}}, 1e-9);
  }
  // Other corners on each side, as a part of a map's edge may have.
  is_cap({{180, 60}, {180, 70}, {180, 85}, {180, 90}, {-180, 90}, {-180, 80}, {-180, 65}}, 1e-9);
  // The ring does not meet itself at the cut: 0.5 degrees of it are left.
  std::vector<std::array<double, 2>> step(around.begin(), around.end());
  step.insert(step.end(), {{180, 60.5}, {180, 90}, {-180, 90}});
  CHECK(enclosed_region({spherical_ring(step)}).rings()[0].cols() == 7);
  // Nor are thousands of corners in one place a cut.
  std::vector<std::array<double, 2>> heap;
  for (int i = 0; i < 20'000; ++i)
    heap.push_back({1e-12 * (i * 7919 % 20'000), 1e-12 * (i * 104'729 % 20'011)});
  CHECK_THROWS_AS(enclosed_region({spherical_ring(heap)}), Error);
  // Two halves of a cap, cut at 0 and 180 degrees.
  const Surface halves = enclosed_region(
      {spherical_ring({{0, 62}, {60, 60}, {120, 61}, {180, 60}, {180, 75}, {180, 90}, {0, 70}}),
       spherical_ring({{-180, 60}, {-120, 61}, {-60, 60}, {0, 62}, {0, 65}, {0, 90}, {-180, 70}})});
  CHECK(halves.rings().size() == 1);
  CHECK(halves.area() == doctest::Approx(cap.area()).epsilon(1e-9));
}

// ---- Errors

template <class Call> std::string refusal(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return "";
}

std::string refusal_of(const Surface::Rings& rings) {
  return refusal([&] { Surface::sphere().within(rings); });
}

TEST_CASE("rings that bound no region are refused, with ring and corner") {
  const Points3 triangle = spherical_ring({{0, 0}, {40, 0}, {20, 40}}),
                inner = spherical_ring({{15, 5}, {25, 5}, {20, 15}});
  CHECK(test::has(refusal_of({}), "there are no rings"));
  CHECK(refusal_of({triangle}) == "");
  CHECK(refusal_of({triangle, reversed(inner)}) == "");
  CHECK(refusal_of({triangle, inner}) ==
        "the region: it is to the left of ring 0 and to the right of ring 1; give rings that all "
        "have it to their left: an outer boundary counter-clockwise, a hole clockwise");
  const Points3 innermost = spherical_ring({{19, 8}, {21, 8}, {20, 10}});
  CHECK(refusal_of({triangle, reversed(inner), reversed(innermost)}) != "");
  CHECK(test::has(refusal_of({triangle, Points3(3, 0)}), "ring 1 has 0 corners"));
  CHECK(test::has(refusal_of({Points3(triangle.leftCols(1))}), "ring 0 has 1 corner and"));
  Points3 bad = triangle;
  bad.col(2).setZero();
  CHECK(test::has(refusal_of({inner, bad}), "ring 1, corner 2 is no direction"));
  bad(1, 1) = NAN;
  CHECK(test::has(refusal_of({bad}), "ring 0, corner 1 is no direction"));
  CHECK(test::has(refusal_of({spherical_ring({{0, 0}, {40, 0}, {20, 40}, {0, 0}})}),
                  "ring 0, corner 3 and the next are one place"));
  CHECK(test::has(refusal_of({spherical_ring({{0, 0}, {90, 10}, {270, -10}})}),
                  "ring 0, corner 1 and the next are opposite"));
  const auto meet = [](const Surface::Rings& rings) {
    return test::has(refusal_of(rings), " meet; rings may neither cross nor touch");
  };
  CHECK(refusal_of({spherical_ring({{0, 0}, {20, 20}, {20, 0}, {0, 20}})}) ==
        "the region: the edges from ring 0, corner 0 and from ring 0, corner 2 meet; rings may "
        "neither cross nor touch themselves or each other");
  CHECK(meet({spherical_ring({{0, 0}, {20, 0}, {10, 0}, {10, 10}})}));      // folds back
  CHECK(meet({spherical_ring({{0, 0}, {20, 0}, {40, 0}})}));                // no area
  CHECK(meet({triangle, spherical_ring({{20, 40}, {10, 60}, {0, 60}})}));   // touch in a corner
  CHECK(meet({triangle, spherical_ring({{20, 0}, {20, -20}, {30, -20}})})); // corner on an edge
  CHECK(meet({triangle, triangle}));                                        // twice the same
  CHECK(meet({triangle, reversed(triangle)}));                              // nothing between
  CHECK(meet({spherical_ring(
      {{0, 0}, {20, -10}, {40, 0}, {20, 0}, {10, 10}, {0, 10}, {20, 0}})})); // twice there
  CHECK(
      test::has(refusal([&] { region_around({triangle}, lonlat(10, 0)); }), "is on its boundary"));
  CHECK(test::has(refusal([&] { region_around({triangle}, {0, 0, 0}); }), "is no direction"));
  CHECK(test::has(refusal([&] { enclosed_region({}); }), "no rings"));
  CHECK(test::has(refusal([&] {
                    enclosed_region({triangle, reversed(triangle)});
                  }),
                  "bound nothing"));
  CHECK(test::has(refusal([&] {
                    enclosed_region({triangle, bad});
                  }),
                  "ring 1, corner 1 is no direction"));
  CHECK(test::has(refusal([&] {
                    enclosed_region({spherical_ring({{0, 0}, {20, 20}, {20, 0}, {0, 20}})});
                  }),
                  "the edges from ring 0, corner 0 and from ring 0, corner 2 meet"));
  // Parts of a millimetre are not healed where they are no cut: a needle that crosses a side.
  CHECK(test::has(refusal([&] {
                    enclosed_region({spherical_ring(
                        {{0, 0}, {20, 0}, {20, 20}, {10, -1e-6}, {10 + 1e-6, 20}, {0, 20}})});
                  }),
                  " meet; rings may neither cross nor touch"));
}

/// The area between two meridians and two parallels.
double area_of_box(double width, double south, double north) {
  return width * degree * (std::sin(north * degree) - std::sin(south * degree));
}

Surface box_in_degrees(double west, double south, double east, double north) {
  return box(west * degree, south * degree, east * degree, north * degree);
}

TEST_CASE("a box lies between meridians and parallels, over the date line and up to poles") {
  struct Sides {
    double west, south, east, north, width;
  };
  for (const auto& [west, south, east, north, width] :
       std::vector<Sides>{{-20, 30, 40, 60, 60},
                          {170, -20, -170, 0, 20},
                          {10, -5, 0, 5, 350},
                          {-20, 60, 40, 90, 60},
                          {100, -90, 190, -50, 90},
                          {20, -90, 50, 90, 30},
                          {-170, -80, 170, 80, 340},
                          {-180, 40, 180, 60, 360},
                          {0, 70, 360, 90, 360},
                          {370, 10, 380, 20, 10},
                          {5, -0.001, 5.001, 0, 0.001}}) {
    CAPTURE(west);
    CAPTURE(south);
    const Surface region = box_in_degrees(west, south, east, north);
    CHECK(region.area() == doctest::Approx(area_of_box(width, south, north)).epsilon(1e-6));
    CHECK_NOTHROW(Surface::sphere().within(region.rings()));
    test::Random random(3);
    for (int k = 0; k < 2000; ++k) {
      const Vec3 point = random.direction();
      const auto [longitude, latitude] = base_detail::lonlat_of(point);
      const double along = std::fmod(longitude - west + 1080, 360),
                   inside = std::min({latitude - south, north - latitude, width == 360 ? 1 : along,
                                      width == 360 ? 1 : width - along});
      if (std::abs(inside) > 1e-5) // of the arcs' distance from parallels
        REQUIRE(region.contains(vector(point)) == (inside > 0));
    }
  }
}

TEST_CASE("the arcs of a box keep near its parallels, with fewer corners towards the equator") {
  for (const double latitude : {1.0, 20.0, 45.0, 60.0, 89.0}) {
    const DoubleMatrix ring = box_in_degrees(0, 0, 90, latitude).rings()[0];
    double worst = 0;
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const Eigen::Vector3d a = ring.col(i), b = ring.col((i + 1) % ring.cols()),
                            middle = (a + b).normalized();
      if (std::abs(a.z() - b.z()) < 1e-12 && a.z() > 0.01)
        worst = std::max(worst, std::asin(middle.z()) - latitude * degree);
    }
    CAPTURE(latitude);
    const double side = pi / 2 * std::cos(latitude * degree);
    CHECK(worst < side / 60e6 + 1e-15);
    CHECK(worst > side / 70e6);
  }
  CHECK(box_in_degrees(0, -10, 60, 0).rings()[0].cols() < 1600);
}

TEST_CASE("values out of range") {
  CHECK(test::has(refusal([] { box_in_degrees(0, 40, 20, 20); }),
                  "the box's latitudes are 40 and 20 degrees; give the lower one first"));
  CHECK(test::has(refusal([] { box_in_degrees(10, 20, 10, 40); }), "the box has no width"));
  CHECK(test::has(refusal([] { box_in_degrees(180, 20, -180, 40); }), "the box has no width"));
  CHECK(test::has(refusal([] { box_in_degrees(-180, 20, 190, 40); }),
                  "the box runs 370 degrees eastward from its west side, more than all around"));
  CHECK(test::has(refusal([] { box_in_degrees(-180, -90, 180, 90); }), "is the whole sphere"));
  CHECK(test::has(refusal([] { box(NAN, 0, 1, 1); }), "a longitude of the box is not finite"));
  CHECK(test::has(refusal([] { circle({0, 0, 0}, 1); }), "the circle's centre is no direction"));
  CHECK(test::has(refusal([] { circle({1, 0, 0}, 4); }), "the circle's radius is 4; give 1e-6"));
  CHECK(test::has(refusal([] { circle({1, 0, 0}, NAN); }), "the circle's radius is nan"));
  CHECK(test::has(refusal([] { circle({1, 0, 0}, 1, 7); }), "the number of corners is 7"));
  CHECK(test::has(refusal([] { ellipse({NAN, 0, 0}, 1, 1, 0); }), "the ellipse's centre is no"));
  CHECK(test::has(refusal([] {
                    ellipse({1, 0, 0}, 1, 1.1, 0);
                  }),
                  "the ellipse's semi-axes are 1 and 1.1"));
  CHECK(test::has(refusal([] { ellipse({1, 0, 0}, 1, 1, INFINITY); }), "the ellipse's bearing"));
  CHECK(test::has(refusal([] { channel(1, 0.5); }),
                  "the channel's latitudes are 57.2958 and 28.6479 degrees"));
  CHECK(test::has(refusal([] { channel(0, 2); }),
                  "the channel's latitudes are 0 and 114.592 degrees"));
  CHECK(test::has(refusal([] { channel(-pi / 2, pi / 2); }), "is the whole sphere"));
}

TEST_CASE("the whole sphere contains each direction and nothing else") {
  CHECK(Surface().contains({1, 2, 3}));
  CHECK_FALSE(Surface().contains({NAN, 0, 0}));
  CHECK_FALSE(circle({1, 0, 0}, 3).contains({0, 0, 0}));
  CHECK(circle({1, 0, 0}, 1e-6).contains({5e180, 1e170, 0}));
}

} // namespace
