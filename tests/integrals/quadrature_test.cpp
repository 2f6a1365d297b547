// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/quadrature.h"

#include "base/elementary.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace calotte;
using namespace calotte::integrals_detail;

TEST_CASE("each rule integrates all monomials of its degree, and not all of the next") {
  for (const int points : {3, 6}) {
    const QuadratureRule& rule = quadrature_rule(points);
    CHECK(rule.nodes.size() == static_cast<std::size_t>(points));
    double worst_beyond = 0;
    for (int i = 0; i <= rule.degree + 1; ++i)
      for (int j = 0; i + j <= rule.degree + 1; ++j) {
        double sum = 0;
        for (const auto& node : rule.nodes)
          sum += node.weight * std::pow(node.a, i) * std::pow(node.b, j);
        // Mean of a^i b^j over a triangle: 2 i! j! / (i + j + 2)!
        const double exact = 2 * std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3);
        if (i + j <= rule.degree)
          CHECK(std::abs(sum - exact) < 2e-15);
        else
          worst_beyond = std::max(worst_beyond, std::abs(sum - exact));
      }
    CHECK(worst_beyond > 1e-9);
    for (const auto& node : rule.nodes) {
      CHECK(std::abs(node.a + node.b + node.c - 1) < 1e-15);
      CHECK(std::min({node.a, node.b, node.c}) > 0);
    }
  }
}

TEST_CASE("elementary functions agree with the C library to a few units in the last place") {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double ulp = 0x1p-52;
  for (int i = 0; i < 100000; ++i) {
    const double x = std::ldexp(uniform(random), -(i % 30));
    CHECK(std::abs(arc_sine(x) - std::asin(x)) <= 3 * ulp * std::abs(x));
    CHECK(std::abs(arc_tangent(x) - std::atan(x)) <= 8 * ulp * std::abs(x));
    for (const double t : {x, 60 * x, 990 * x}) {
      const double exact = 1 / (1 + std::exp2(t));
      CHECK(std::abs(logistic(t) - exact) <= 5 * ulp * exact);
    }
  }
  CHECK(arc_sine(1) == doctest::Approx(std::asin(1.0)).epsilon(1e-15));
  CHECK(arc_sine(-1) == -arc_sine(1));
  CHECK(arc_sine(0) == 0);
  CHECK(logistic(0) == 0.5);
  CHECK(logistic(-1e9) == 1);
  CHECK(logistic(1e9) == logistic(1000));
}
