// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/plane_predicates.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>

using namespace calotte::exact_detail;
using calotte::test::Random;

namespace {

/// Points of a coarse grid, so that many sites are on one line or circle, and the places of copies
/// are exact.
Vec2 site(Random& random) { return {random.integer(0, 7) / 8.0, random.integer(0, 7) / 8.0}; }

Vec2 place(const Vec2& period, const Image& image) {
  return {image.site.x + image.i * period.x, image.site.y + image.j * period.y};
}

int determinant_sign(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double value = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

} // namespace

TEST_CASE("signs of copies are those of their places, in one box or in several") {
  Random random(1);
  const Vec2 period{1, 1};
  for (int round = 0; round < 2000; ++round) {
    const bool one_box = round % 2 == 0;
    std::array<Image, 4> image{};
    for (Image& copy : image)
      copy = {site(random), random.integer(-1, 1), random.integer(-1, 1)};
    if (one_box)
      for (Image& copy : image)
        copy = {copy.site, image[0].i, image[0].j};
    const auto& [a, b, c, d] = image;
    const Vec2 p = place(period, a), q = place(period, b), r = place(period, c),
               s = place(period, d);
    CHECK(orientation(period, a, b, c) == orientation(p, q, r));
    CHECK(orientation(period, a, b, c) == determinant_sign(p, q, r));
    if (orientation(p, q, r) == 0)
      CHECK(between(period, a, b, c) == between(p, q, r));
    if (orientation(p, q, r) > 0)
      CHECK(in_circle(period, a, b, c, d) == in_circle(p, q, r, s));
  }
}

TEST_CASE("a period of 0 is a plane") {
  Random random(2);
  for (int round = 0; round < 2000; ++round) {
    const Vec2 a = site(random), b = site(random), c = site(random), d = site(random), none{0, 0};
    if (orientation(a, b, c) <= 0)
      continue;
    const Image p{a, 0, 0}, q{b, 0, 0}, r{c, 0, 0}, s{d, 0, 0};
    CHECK(orientation(none, p, q, r) == 1);
    CHECK(in_circle(none, p, q, r, s) == in_circle(a, b, c, d));
    const bool distinct = compare(a, d) != 0 && compare(b, d) != 0 && compare(c, d) != 0;
    if (distinct && in_circle(a, b, c, d) == 0)
      CHECK(in_circle_tie(none, p, q, r, s) == in_circle_tie(a, b, c, d));
  }
}
