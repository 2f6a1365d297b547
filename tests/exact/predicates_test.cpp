// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/predicates.h"

#include "support/exact.h"
#include "support/random.h"

#include <doctest/doctest.h>

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace calotte;
using namespace calotte::exact_detail;
using test::Random;

namespace {

using Quad = std::array<Vec3, 4>;

/// Hard cases for the predicates: quadruples by family, all from seeds.
struct Family {
  std::string name;
  std::function<Quad(Random&)> make;
};

/// Four points on the circle of angular radius `radius` around a random direction, as rounded.
Quad near_cocircular(Random& random, double radius) {
  const Vec3 axis = random.direction();
  const Vec3 side = normalised(cross(axis, random.direction())), up = cross(axis, side);
  Quad quad;
  for (Vec3& p : quad) {
    const double angle = random.real(0, 6.283185307179586);
    p = std::cos(radius) * axis +
        std::sin(radius) * (std::cos(angle) * side + std::sin(angle) * up);
  }
  return quad;
}

double by_ulps(Random& random, double x, int most) {
  const int steps = random.integer(-most, most);
  for (int i = 0; i < std::abs(steps); ++i)
    x = std::nextafter(x, steps < 0 ? -2 : 2);
  return x;
}

Vec3 by_ulps(Random& random, const Vec3& p, int most) {
  return {by_ulps(random, p.x, most), by_ulps(random, p.y, most), by_ulps(random, p.z, most)};
}

Quad by_ulps(Random& random, Quad quad, int most) {
  for (Vec3& p : quad)
    p = by_ulps(random, p, most);
  return quad;
}

Quad cluster(Random& random, double width) {
  const Vec3 centre = random.direction();
  Quad quad;
  for (Vec3& p : quad)
    p = centre + width * random.direction();
  return quad;
}

/// Integer vectors of one norm on one circle, exactly: four of the six permutations of three
/// numbers (a plane x + y + z = s), or of the sign changes of two coordinates; scaled each.
Quad cocircular_integers(Random& random) {
  const double x = random.integer(-1000, 1000), y = random.integer(-1000, 1000),
               z = random.integer(-1000, 1000);
  std::vector<Vec3> all{{x, y, z}, {y, z, x}, {z, x, y}, {y, x, z}, {x, z, y}, {z, y, x}};
  if (random.integer(0, 1) == 0)
    all = {{x, y, z}, {-x, y, z}, {x, -y, z}, {-x, -y, z}};
  random.shuffle(all);
  Quad quad;
  for (int i = 0; i < 4; ++i)
    quad[i] = double(random.integer(1, 4)) * all[i];
  return quad;
}

/// On one great circle exactly: small multiples of two integer vectors.
Quad one_great_circle(Random& random) {
  const auto integers = [&] {
    return Vec3{double(random.integer(-9, 9)), double(random.integer(-9, 9)),
                double(random.integer(-9, 9))};
  };
  const Vec3 u = integers(), v = integers();
  Quad quad;
  for (Vec3& p : quad)
    p = double(random.integer(-5, 5)) * u + double(random.integer(-5, 5)) * v;
  return quad;
}

Quad near_parallel(Random& random) {
  const Vec3 a = random.direction();
  Quad quad;
  for (Vec3& p : quad)
    p = (random.integer(0, 3) == 0 ? -1 : 1) * by_ulps(random, random.real(0.5, 2) * a, 2);
  return quad;
}

Quad rescaled(Random& random, Quad quad, int exponent) {
  for (Vec3& p : quad) {
    const double scale = std::ldexp(1, random.integer(-exponent, exponent));
    p = scale * p;
  }
  return quad;
}

/// Components of very different sizes.
Quad steep(Random& random) {
  Quad quad;
  for (Vec3& p : quad) {
    const auto component = [&] { return std::ldexp(random.real(-1, 1), random.integer(-80, 0)); };
    p = {component(), component(), component()};
  }
  return quad;
}

std::vector<Family> families() {
  std::vector<Family> out{
      {"random",
       [](Random& random) {
         return Quad{random.direction(), random.direction(), random.direction(),
                     random.direction()};
       }},
      {"cocircular integers", cocircular_integers},
      {"one great circle", one_great_circle},
      {"near one great circle",
       [](Random& random) {
         return by_ulps(random, near_cocircular(random, 1.5707963267948966), 2);
       }},
      {"near-parallel", near_parallel},
      {"steep", steep},
      {"cocircular integers, by ulps",
       [](Random& random) { return by_ulps(random, cocircular_integers(random), 1); }},
      {"cocircular integers, huge and tiny",
       [](Random& random) { return rescaled(random, cocircular_integers(random), 640); }},
      {"near-cocircular, huge and tiny",
       [](Random& random) { return rescaled(random, near_cocircular(random, 0.3), 660); }}};
  for (const double size : {1.0, 1e-2, 1e-5, 1e-8, 1e-12, 1e-15}) {
    out.push_back({"near-cocircular " + std::to_string(std::log10(size)),
                   [=](Random& random) { return near_cocircular(random, size); }});
    out.push_back(
        {"near-cocircular by ulps " + std::to_string(std::log10(size)),
         [=](Random& random) { return by_ulps(random, near_cocircular(random, size), 3); }});
  }
  for (int power = 3; power <= 15; ++power)
    out.push_back({"cluster 1e-" + std::to_string(power),
                   [=](Random& random) { return cluster(random, std::pow(10, -power)); }});
  out.push_back({"cluster of ulps", [](Random& random) {
                   const Vec3 centre = random.direction();
                   return by_ulps(random, Quad{centre, centre, centre, centre}, 40);
                 }});
  return out;
}

bool has_direction(const Vec3& p) { return p.x != 0 || p.y != 0 || p.z != 0; }

/// Calls `law` on `count` quadruples of every family.
void for_each_quad(int count, const std::function<void(Random&, const Quad&)>& law) {
  for (const Family& family : families()) {
    CAPTURE(family.name);
    Random random(17);
    for (int i = 0; i < count; ++i) {
      const Quad quad = family.make(random);
      if (!std::all_of(quad.begin(), quad.end(), has_direction))
        continue;
      CAPTURE(i);
      law(random, quad);
    }
  }
}

bool distinct(const Quad& q) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      if (exact::same_direction(q[i], q[j]))
        return false;
  return true;
}

/// All 24 orders, each with the sign of its permutation.
void for_each_order(const std::function<void(const std::array<int, 4>&, int)>& law) {
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        inversions += order[j] > order[i];
    law(order, inversions % 2 == 0 ? 1 : -1);
  } while (std::next_permutation(order.begin(), order.end()));
}

std::vector<View> views(Random& random, const Quad& quad) {
  const Vec3& site = quad[static_cast<std::size_t>(random.integer(0, 3))];
  return {View{}, View{false, random.direction()},
          View{false, -site}, // the focus of a cap around a site
          View{false, cocircular_integers(random)[0]}};
}

bool collinear(const View& view, const Quad& q) {
  return exact::orientation(view, q[0], q[1], q[2]) == 0 &&
         exact::orientation(view, q[0], q[1], q[3]) == 0 &&
         exact::orientation(view, q[0], q[2], q[3]) == 0 &&
         exact::orientation(view, q[1], q[2], q[3]) == 0;
}

bool usable(const View& view, const Quad& q) {
  return view.from_centre ||
         (has_direction(view.focus) && std::none_of(q.begin(), q.end(), [&](const Vec3& p) {
            return exact::same_direction(p, view.focus);
          }));
}

} // namespace

TEST_CASE("in_circle is positive inside the circumcap of a counter-clockwise triangle") {
  const Vec3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  CHECK(orientation(a, b, c) == 1);
  CHECK(in_circle(a, b, c, {1, 1, 1}) == 1);
  CHECK(in_circle(a, b, c, {-1, -1, -1}) == -1);
  CHECK(in_circle(a, b, c, {0, 0, -1}) == -1);
  CHECK(in_circle(a, b, c, {1, 0, 1e-300}) == 1);
  CHECK(in_circle(a, b, c, {1, 0, -1e-300}) == -1);
}

TEST_CASE("in_circle and each of its tiers agree with exact arithmetic") {
  for_each_quad(300, [](Random&, const Quad& q) {
    const int sign = exact::in_circle(q[0], q[1], q[2], q[3]);
    const int filter =
        in_circle_filter(normalised(q[0]), normalised(q[1]), normalised(q[2]), normalised(q[3]));
    const int extended = in_circle_extended(q[0], q[1], q[2], q[3]);
    CHECK((filter == 0 || filter == sign));
    CHECK((extended == 0 || extended == sign));
    CHECK((filter == 0 || extended == filter));
    CHECK(in_circle_exact(q[0], q[1], q[2], q[3]) == sign);
    CHECK(in_circle(q[0], q[1], q[2], q[3]) == sign);
    PredicateCounts counts;
    CHECK(in_circle_beyond_filter(q[0], q[1], q[2], q[3], counts) == sign);
    CHECK(counts.filtered == 1);
    CHECK(counts.exact == (extended == 0 ? 1 : 0));
  });
}

// Slow: exact signs of 200 000 quadruples.
TEST_CASE("the filters are never wrong near their bounds [slow]") {
  // Within some hundred ulps the bounds' second order counts: lattices of ulps around one
  // direction.
  Random random(23);
  for (int i = 0; i < 200000; ++i) {
    const Vec3 centre = random.direction();
    const int most = 1 << random.integer(1, 8);
    Quad q{centre, centre, centre, centre};
    for (Vec3& p : q)
      p = p + std::ldexp(most, -53) * random.direction();
    const int filter =
        in_circle_filter(normalised(q[0]), normalised(q[1]), normalised(q[2]), normalised(q[3]));
    if (filter != 0)
      REQUIRE(in_circle_exact(q[0], q[1], q[2], q[3]) == filter);
    const int flat = orientation_filter(normalised(q[0]), normalised(q[1]), normalised(q[2]));
    if (flat != 0)
      REQUIRE(exact::orientation(q[0], q[1], q[2]) == flat);
  }
}

TEST_CASE("the filter decides all but a few random quadruples") {
  Random random(29);
  int undecided = 0;
  for (int i = 0; i < 100000; ++i)
    undecided += in_circle_filter(random.direction(), random.direction(), random.direction(),
                                  random.direction()) == 0;
  CHECK(undecided <= 3);
}

TEST_CASE("normalised is within 5 roundoffs of the direction") {
  for_each_quad(100, [](Random&, const Quad& quad) {
    for (const Vec3& p : quad) {
      const Vec3 unit = normalised(p);
      // |unit - p/|p|| <= 5u, with p/|p| to 300 bits
      mpf_class x(p.x, 2400), y(p.y, 2400), z(p.z, 2400);
      const mpf_class length = sqrt(mpf_class(x * x + y * y + z * z, 2400));
      x = x / length - unit.x;
      y = y / length - unit.y;
      z = z / length - unit.z;
      const bool within = x * x + y * y + z * z <= 25 * roundoff * roundoff;
      CHECK(within);
    }
  });
}

TEST_CASE("in_circle is antisymmetric") {
  for_each_quad(20, [](Random&, const Quad& q) {
    const int sign = in_circle(q[0], q[1], q[2], q[3]);
    for_each_order([&](const std::array<int, 4>& o, int parity) {
      CHECK(in_circle(q[o[0]], q[o[1]], q[o[2]], q[o[3]]) == parity * sign);
    });
  });
}

TEST_CASE("a positive factor of an argument has no effect") {
  for_each_quad(50, [](Random& random, const Quad& q) {
    Quad scaled = q;
    for (Vec3& p : scaled) {
      const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      const int power = random.integer(-660, 660) - std::ilogb(largest);
      p = {std::ldexp(p.x, power), std::ldexp(p.y, power), std::ldexp(p.z, power)};
    }
    CHECK(in_circle(q[0], q[1], q[2], q[3]) ==
          in_circle(scaled[0], scaled[1], scaled[2], scaled[3]));
    CHECK(orientation(q[0], q[1], q[2]) == orientation(scaled[0], scaled[1], scaled[2]));
    CHECK(compare_directions(q[0], q[1]) == compare_directions(scaled[0], scaled[1]));
    for (int i = 0; i < 4; ++i)
      CHECK(same_direction(q[i], scaled[i]));
  });
}

TEST_CASE("orientation agrees with exact arithmetic, from the centre and from foci") {
  for_each_quad(100, [](Random& random, const Quad& q) {
    const int flat = orientation_filter(normalised(q[0]), normalised(q[1]), normalised(q[2]));
    const int sign = exact::orientation(q[0], q[1], q[2]);
    CHECK((flat == 0 || flat == sign));
    CHECK(orientation(q[0], q[1], q[2]) == sign);
    CHECK(orientation(q[1], q[2], q[0]) == sign);
    CHECK(orientation(q[1], q[0], q[2]) == -sign);
    for (const View& view : views(random, q))
      if (usable(view, q))
        CHECK(orientation(view, q[0], q[1], q[2]) == exact::orientation(view, q[0], q[1], q[2]));
  });
}

TEST_CASE("compare_distances agrees with exact arithmetic, also midway between two sites") {
  for_each_quad(100, [](Random& random, const Quad& q) {
    const auto agrees = [](const Vec3& p, const Vec3& a, const Vec3& b) {
      CHECK(compare_distances(p, a, b) == exact::compare_distances(p, a, b));
      CHECK(compare_distances(p, b, a) == -compare_distances(p, a, b));
    };
    for (int i = 0; i < 4; ++i) {
      const Vec3 &p = q[i], &a = q[(i + 1) % 4], &b = q[(i + 2) % 4],
                 middle = normalised(a) + normalised(b);
      agrees(p, a, b);
      if (dot(middle, middle) > 1e-20) {
        agrees(middle, a, b);
        agrees(by_ulps(random, normalised(middle), 2), a, b);
      }
    }
  });
}

TEST_CASE("compare_directions orders directions, and is 0 for equal ones alone") {
  for_each_quad(100, [](Random&, const Quad& q) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const int order = exact::compare_directions(q[i], q[j]);
        CHECK(compare_directions(q[i], q[j]) == order);
        CHECK(same_direction(q[i], q[j]) == (order == 0));
        CHECK(exact::same_direction(q[i], q[j]) == (order == 0));
      }
  });
}

TEST_CASE("ties follow the stated rule for any order of the arguments") {
  int ties = 0;
  for_each_quad(150, [&](Random& random, const Quad& q) {
    if (!distinct(q) || exact::in_circle(q[0], q[1], q[2], q[3]) != 0)
      return;
    ++ties;
    for (const View& view : views(random, q)) {
      if (!usable(view, q))
        continue;
      const int sign = in_circle_tie(view, q[0], q[1], q[2], q[3]);
      CHECK(sign == exact::in_circle_tie(view, q[0], q[1], q[2], q[3]));
      CHECK((sign == 0) == collinear(view, q));
      CHECK(in_circle_resolved(view, q[0], q[1], q[2], q[3]) == sign);
      for_each_order([&](const std::array<int, 4>& o, int parity) {
        CHECK(in_circle_tie(view, q[o[0]], q[o[1]], q[o[2]], q[o[3]]) == parity * sign);
      });
    }
  });
  CHECK(ties > 300);
}

TEST_CASE("a tie from the centre is the same from every focus outside the circle") {
  Random random(31);
  int compared = 0;
  for (int i = 0; i < 2000; ++i) {
    const Quad q = cocircular_integers(random);
    if (!std::all_of(q.begin(), q.end(), has_direction) || !distinct(q) || collinear({}, q))
      continue;
    const int way = orientation(q[0], q[1], q[2]);
    const View view{false, random.direction()};
    if (way == 0 || in_circle(q[0], q[1], q[2], view.focus) != -way)
      continue;
    // The smaller cap of the circle is the one that abc turns around as seen from the centre.
    ++compared;
    CHECK(in_circle_tie({}, q[0], q[1], q[2], q[3]) == in_circle_tie(view, q[0], q[1], q[2], q[3]));
  }
  CHECK(compared > 500);
}

TEST_CASE("ties are the signs of a true outward push") {
  // Integer vectors of one norm: the determinant is that of the vectors themselves, and pushes by
  // 2^-100, 2^-10000, ... of the sites in lexicographic order can be computed.
  using Rational3 = std::array<mpq_class, 3>;
  const auto det = [](const Rational3& a, const Rational3& b, const Rational3& c) -> mpq_class {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const auto pushed = [](const Vec3& p, const Vec3& from, const mpq_class& eps) {
    return Rational3{p.x + eps * (p.x - from.x), p.y + eps * (p.y - from.y),
                     p.z + eps * (p.z - from.z)};
  };
  Random random(37);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const double x = random.integer(1, 50), y = random.integer(51, 100),
                 z = random.integer(101, 150);
    std::vector<Vec3> all{{x, y, z}, {y, z, x}, {z, x, y}, {y, x, z}, {x, z, y}, {z, y, x}};
    random.shuffle(all);
    const Vec3 focus = random.integer(0, 1) == 0 ? all[4] : Vec3{-x, -y, z};
    for (const View& view : {View{}, View{false, focus}}) {
      const Vec3 from = view.from_centre ? Vec3{0, 0, 0} : view.focus;
      std::array<Rational3, 4> p;
      for (int j = 0; j < 4; ++j) {
        int rank = 0;
        for (int k = 0; k < 4; ++k)
          rank += exact::compare_directions(all[k], all[j]) < 0;
        mpq_class eps = 1;
        mpq_div_2exp(eps.get_mpq_t(), eps.get_mpq_t(),
                     rank == 0   ? 100
                     : rank == 1 ? 1000
                     : rank == 2 ? 10000
                                 : 100000);
        p[j] = pushed(all[j], from, eps);
      }
      const mpq_class value = det(p[1], p[2], p[3]) - det(p[0], p[2], p[3]) +
                              det(p[0], p[1], p[3]) - det(p[0], p[1], p[2]);
      const int sign = in_circle_tie(view, all[0], all[1], all[2], all[3]);
      if (!view.from_centre && collinear(view, {all[0], all[1], all[2], all[3]})) {
        CHECK(sign == 0);
        continue;
      }
      ++compared;
      CHECK(sign == sgn(value));
    }
  }
  CHECK(compared >= 200);
}

TEST_CASE("between, from the centre: on the shorter arc of a great circle") {
  Random random(41);
  for (int i = 0; i < 300; ++i) {
    const auto integer = [&] { return double(random.integer(-1000, 1000)); };
    const Vec3 a{integer(), integer(), integer()}, b{integer(), integer(), integer()};
    if (!has_direction(cross(a, b)))
      continue;
    const Vec3 p = double(random.integer(1, 50)) * a + double(random.integer(1, 50)) * b;
    CHECK(between({}, a, p, b));
    CHECK(between({}, b, p, a));
    CHECK_FALSE(between({}, a, b, p));
    CHECK_FALSE(between({}, p, a, b));
    CHECK_FALSE(between({}, a, -p, b));
    CHECK_FALSE(between({}, a, a, b));
    CHECK_FALSE(between({}, a, b, b));
    CHECK_FALSE(between({}, a, -a, b));
  }
}

TEST_CASE("between, from a focus: of three sites on a circle through it exactly one") {
  Random random(43);
  int lines = 0;
  for (int i = 0; i < 500; ++i) {
    const Quad q = cocircular_integers(random);
    if (!std::all_of(q.begin(), q.end(), has_direction) || !distinct(q))
      continue;
    ++lines;
    const View view{false, q[3]};
    const bool a = between(view, q[1], q[0], q[2]), b = between(view, q[0], q[1], q[2]),
               c = between(view, q[0], q[2], q[1]);
    CHECK(a + b + c == 1);
    CHECK(between(view, q[2], q[0], q[1]) == a);
    // p between a and b: the chord ab separates it from the focus on their circle.
    const Vec3 axis =
        cross(normalised(q[1]) - normalised(q[0]), normalised(q[2]) - normalised(q[0]));
    const auto side = [&](const Vec3& p, const Vec3& from, const Vec3& to) {
      return dot(axis, cross(normalised(to) - normalised(from), normalised(p) - normalised(from))) >
             0;
    };
    CHECK(a == (side(q[0], q[1], q[2]) != side(q[3], q[1], q[2])));
    CHECK(b == (side(q[1], q[0], q[2]) != side(q[3], q[0], q[2])));
  }
  CHECK(lines > 300);
}
