// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/outline.h"
#include "support/random.h"
#include "support/text.h"

#include <calotte/error.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace calotte;
using domain_detail::Outline;
using domain_detail::Side;

Points2 ring_of(const std::vector<std::array<double, 2>>& corners) {
  Points2 ring(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    ring.col(static_cast<Eigen::Index>(i)) << corners[i][0], corners[i][1];
  return ring;
}

Points2 square(double x, double y, double side) {
  return ring_of({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
}

/// A coastline: radius 1 with waves of many lengths.
Points2 wavy(int corners) {
  Points2 ring(2, corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    const double radius = 1 + 0.2 * std::sin(5 * angle) + 0.05 * std::sin(41 * angle);
    ring.col(i) << radius * std::cos(angle), radius * std::sin(angle);
  }
  return ring;
}

Points2 reversed(const Points2& ring) { return ring.rowwise().reverse(); }

std::string refusal(const Surface::Rings& rings) {
  try {
    Surface::plane().within(rings);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return "";
}

TEST_CASE("inside, outside and on the boundary, with a hole and an island, in any sense") {
  for (const bool turn : {false, true}) {
    const auto sense = [&](const Points2& ring) { return turn ? reversed(ring) : ring; };
    const Outline outline({sense(square(0, 0, 10)), square(2, 2, 6), sense(square(4, 4, 2))});
    CHECK(outline.area() == doctest::Approx(100 - 36 + 4).epsilon(1e-15));
    CHECK(outline.side({1, 5}) == Side::inside);
    CHECK(outline.side({3, 5}) == Side::outside);
    CHECK(outline.side({5, 5}) == Side::inside);
    CHECK(outline.side({5, 2}) == Side::boundary);
    CHECK(outline.side({10, 10}) == Side::boundary);
    CHECK(outline.side({0, 3}) == Side::boundary);
    CHECK(outline.side({-1e-300, 3}) == Side::outside);
    CHECK(outline.side({1, 2}) == Side::inside); // level with corners
    CHECK(outline.side({std::nextafter(2.0, 0.0), 2}) == Side::inside);
    for (const Outline::Edge& edge : outline.edges()) { // the domain is to the left
      const double x = (edge.from.x + edge.to.x) / 2, y = (edge.from.y + edge.to.y) / 2;
      const double length = std::hypot(edge.to.x - edge.from.x, edge.to.y - edge.from.y);
      const double across_x = -(edge.to.y - edge.from.y) / length,
                   across_y = (edge.to.x - edge.from.x) / length;
      CHECK(outline.side({x + 1e-9 * across_x, y + 1e-9 * across_y}) == Side::inside);
      CHECK(outline.side({x - 1e-9 * across_x, y - 1e-9 * across_y}) == Side::outside);
    }
  }
}

TEST_CASE("a coastline of some thousand edges: sides and area as without strips") {
  const Points2 ring = wavy(5000);
  const Outline outline({ring});
  double twice_area = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto a = ring.col(i), b = ring.col((i + 1) % 5000);
    twice_area += a.x() * b.y() - a.y() * b.x();
  }
  CHECK(outline.area() == doctest::Approx(twice_area / 2).epsilon(1e-13));
  test::Random random(7);
  for (int k = 0; k < 20'000; ++k) {
    const double x = random.real(-1.5, 1.5), y = random.real(-1.5, 1.5);
    const double angle = std::atan2(y, x);
    const double radius = 1 + 0.2 * std::sin(5 * angle) + 0.05 * std::sin(41 * angle);
    if (std::abs(std::hypot(x, y) - radius) > 1e-4) // chords deviate from the curve by less
      REQUIRE((outline.side({x, y}) == Side::inside) == (std::hypot(x, y) < radius));
  }
}

TEST_CASE("each edge near a box is reported exactly once") {
  const Outline outline({wavy(2000), reversed(square(-0.1, -0.2, 0.3))});
  test::Random random(8);
  for (int k = 0; k < 300; ++k) {
    const double x = random.real(-1.5, 1.5), y = random.real(-1.5, 1.5),
                 w = random.real(0, 1) * random.real(0, 1), h = random.real(0, 1);
    const domain_detail::Box2 box{{x, y}, {x + w, y + h}};
    std::vector<const Outline::Edge*> told, expected;
    outline.for_each_edge_near(box, [&](const Outline::Edge& edge) { told.push_back(&edge); });
    for (const Outline::Edge& edge : outline.edges())
      if (std::max(edge.from.x, edge.to.x) >= x && std::min(edge.from.x, edge.to.x) <= x + w &&
          std::max(edge.from.y, edge.to.y) >= y && std::min(edge.from.y, edge.to.y) <= y + h)
        expected.push_back(&edge);
    std::sort(told.begin(), told.end());
    REQUIRE(told == expected);
  }
}

TEST_CASE("domains at the ends of the range") {
  for (const double unit : {1e-29, 1e29}) {
    const Outline outline({Points2(unit * square(0, 0, 1))});
    CHECK(outline.side({unit / 2, unit / 3}) == Side::inside);
    CHECK(outline.area() == doctest::Approx(unit * unit));
  }
  CHECK(Surface::periodic({3, 4}).area() == 12);
  CHECK(Surface::periodic({3, 4}).contains({0, 0, 0}));
  CHECK_FALSE(Surface::periodic({3, 4}).contains({3, 0, 0}));
}

TEST_CASE("rings that do not bound a well-defined region are refused, with ring and corner") {
  CHECK(refusal({square(0, 0, 1)}) == "");
  CHECK(refusal({square(0, 0, 3), square(1, 1, 1)}) == "");
  CHECK(test::has(refusal({}), "no rings"));
  CHECK(test::has(refusal({ring_of({{0, 0}, {1, 0}})}), "ring 0 has 2 corners"));
  CHECK(test::has(refusal({square(0, 0, 1), ring_of({{0, 0}, {1, 0}, {NAN, 1}})}),
                  "ring 1, corner 2 is not finite"));
  CHECK(test::has(refusal({ring_of({{0, 0}, {1, 0}, {1, 0}, {0, 1}})}),
                  "ring 0, corner 1 and the next are one place"));
  CHECK(test::has(refusal({ring_of({{0, 0}, {2, 2}, {2, 0}, {0, 2}})}),
                  "corner 0 and from ring"));                        // crosses itself
  CHECK(refusal({ring_of({{0, 0}, {2, 0}, {1, 0}, {1, 1}})}) != ""); // folds back
  CHECK(refusal({ring_of({{0, 0}, {2, 0}, {4, 0}})}) != "");         // no area
  CHECK(refusal({square(0, 0, 2), square(1, 1, 2)}) != "");          // cross
  CHECK(refusal({square(0, 0, 1), square(1, 1, 1)}) != "");          // touch in a corner
  CHECK(refusal({square(0, 0, 3), square(0, 1, 1)}) != "");          // share an edge
  CHECK(refusal({square(0, 0, 1), square(0, 0, 1)}) != "");          // twice the same
  CHECK(test::has(refusal({Points2(1e-31 * square(0, 0, 1))}), "narrower"));
}

} // namespace
