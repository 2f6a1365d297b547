// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/densities.h"

#include <calotte/cvt.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace calotte;

namespace {

Density bump() { return tanh_bump({1, -2, 2}, 0.5, 0.2, 1.0 / 4096); }

/// A bisection takes n sites to 4 n - 6.
std::int64_t after(const Continuation& c) {
  std::int64_t n = c.start.cols();
  for (int b = 0; b < c.bisections; ++b)
    n = 4 * n - 6;
  return n;
}

bool is_icosahedral(std::int64_t cells) {
  std::int64_t n = 12;
  while (n < cells)
    n = 4 * n - 6;
  return n == cells;
}

void check(std::int64_t cells, const Density& density, std::int64_t least) {
  CAPTURE(cells);
  const Continuation c = continuation(cells, density, 5);
  const std::int64_t n = c.start.cols();
  CHECK(after(c) == cells);
  CHECK((c.bisections == 0 || n >= least));
  CHECK((n % 4 != 2 || (n - 2) / 4 + 2 < least)); // no coarser one would do
  CHECK(c.icosahedral == is_icosahedral(cells));
}

} // namespace

TEST_CASE("continuation: bisections lead from the start to the cells, and from none coarser") {
  const Density other = bump();
  for (std::int64_t cells = 12; cells <= 5000; ++cells)
    check(cells, Density{}, 12);
  for (std::int64_t cells = 12; cells <= 5000; cells = cells < 700 ? cells + 13 : cells + 47)
    check(cells, other, 642);
  for (const std::int64_t cells :
       {2562, 2563, 10242, 100000, 163842, 163838, 655362, 4 * 160001 + 2})
    for (const Density& density : {Density{}, other})
      check(cells, density, density.uniform() ? 12 : 642);
}

TEST_CASE("continuation: what the start is") {
  CHECK(continuation(655362, {}).start == bisected_icosahedron(0));
  CHECK(continuation(655362, bump()).start == bisected_icosahedron(3));
  CHECK(continuation(162, bump()).start == bisected_icosahedron(2));
  CHECK(continuation(50, {}).start == fibonacci_sphere(14));
  CHECK(continuation(1009, {}).start == fibonacci_sphere(1009));
  CHECK(continuation(1009, bump(), 7).start == random_sphere(1009, site_density(bump()), 7));
  CHECK(continuation(4 * 1001 + 2, bump(), 7).start ==
        random_sphere(1003, site_density(bump()), 7));
  // Two thirds of a billion, from the fewest.
  CHECK(continuation(10 * (std::int64_t{1} << 26) + 2, {}).bisections == 13);
}

TEST_CASE("continuation refuses what it cannot reach in one line") {
  const auto message = [](std::int64_t cells, const Density& density) -> std::string {
    try {
      continuation(cells, density);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::bad_option);
      return error.what();
    }
    return "";
  };
  for (const std::int64_t cells :
       {std::int64_t{-1}, std::int64_t{0}, std::int64_t{11}, (std::int64_t{1} << 30) + 1})
    CHECK(message(cells, {}).find("number of cells is " + std::to_string(cells)) !=
          std::string::npos);
  const Density bad = tanh_bump({0, 0, 1}, 0.5, -1, 0.1);
  for (const std::int64_t cells : {642, 1000}) // drawn from it or not
    CHECK(message(cells, bad).find("alpha") != std::string::npos);
}

TEST_CASE("drawn starts of a peaked density span the sphere, and converge") {
  for (const std::int64_t cells : {643, 2000, 2571}) {
    CvtOptions options;
    options.density = test::x8();
    options.tolerance = 1e-3;
    const Continuation from = continuation(cells, test::x8());
    options.bisections = from.bisections;
    const Cvt grid = cvt(from.start, options);
    CHECK(!from.icosahedral);
    CHECK(grid.report.converged);
    CHECK(grid.mesh.points.cols() == cells);
  }
}
