// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/envelope.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace calotte;
using namespace calotte::density_detail;

namespace {

struct Case {
  const char* name;
  Density density;
};

std::vector<Case> bump_cases() {
  Density ellipse = tanh_bump({1, 2, 3}, 0.01, 0.005, 1e-6), several;
  ellipse.bumps[0].stretch = 50;
  several.kind = Density::Kind::sum;
  several.bumps = {
      {{0, 0, 1}, 0.5, 0.2, 1e-3}, {{0, 1, 0}, 0.1, 0.01, 0.1}, {{1, 0, -1}, 2, 3, 0.9}};
  return {{"x8", tanh_bump({0, -0.8, 0.6}, 0.5235987755982988, 0.2, 1.0 / 4096)},
          {"peak", tanh_bump({1, 1, 1}, 1e-3, 1e-3, 1e-6)},
          {"peak at a pole", tanh_bump({0, 0, -1}, 1e-3, 1e-3, 1e-6)},
          {"peak on the equator", tanh_bump({1, 0, 0}, 1e-3, 1e-3, 1e-6)},
          {"finest peak", tanh_bump({1, 1, 1}, 1e-9, 1e-9, 1e-18)},
          {"flat", tanh_bump({1, 1, 1}, 100, 1, 0.5)},
          {"ellipse", ellipse},
          {"several", several}};
}

double mass(const Envelope& envelope) {
  double sum = 0;
  for (const Box& box : envelope.boxes())
    sum += box.bounds.greatest * box.area();
  return sum;
}

/// The box that contains a place of the map.
std::int64_t box_of(const Envelope& envelope, double x, double y, bool south) {
  const auto& boxes = envelope.boxes();
  const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const Box& box) {
    return box.south == south && x >= box.x && x < box.x + box.side && y >= box.y &&
           y < box.y + box.side;
  });
  return found - boxes.begin();
}

double value(const Density& density, const Vec3& p) {
  Points3 x(3, 1);
  x << p.x, p.y, p.z;
  return evaluate(density, x)[0];
}

} // namespace

TEST_CASE("the map of a hemisphere: unit vectors, areas kept, distances at most doubled") {
  CHECK(on_sphere(0, 0, false).z == 1);
  CHECK(on_sphere(0, 0, true).z == -1);
  const Points3 places = random_sphere(2000, 3); // two places in the disc each
  for (Eigen::Index j = 0; j < places.cols(); ++j) {
    const double x = places(0, j), y = places(1, j);
    const Vec3 p = on_sphere(x, y, false);
    CHECK(std::abs(norm(p) - 1) <= 8 * 0x1p-53);
    // The zone around the pole out to z has the area 2 pi (1 - z); the disc's part, pi (x^2 + y^2).
    CHECK(std::abs((1 - p.z) - (x * x + y * y)) <= 4 * 0x1p-53);
    const double u = places(1, j), v = places(2, j);
    CHECK(norm(p - on_sphere(u, v, false)) <= 2 * std::hypot(x - u, y - v) + 1e-15);
  }
}

TEST_CASE("boxes cover the sphere once") {
  for (const Case& c : bump_cases()) {
    CAPTURE(c.name);
    const Envelope envelope(c.density);
    const Points3 places = random_sphere(300, 4);
    for (Eigen::Index j = 0; j < places.cols(); ++j) {
      const auto holds = [&](const Box& box) {
        return box.south == (places(2, j) < 0) && places(0, j) >= box.x &&
               places(0, j) < box.x + box.side && places(1, j) >= box.y &&
               places(1, j) < box.y + box.side;
      };
      CHECK(std::count_if(envelope.boxes().begin(), envelope.boxes().end(), holds) == 1);
    }
  }
}

TEST_CASE("the bound of bumps holds everywhere, and most proposals are accepted") {
  for (const Case& c : bump_cases()) {
    CAPTURE(c.name);
    const Envelope envelope(c.density);
    double expected = 0; // of the density over the bound, twice
    for (const Box& box : envelope.boxes()) {
      double sum = 0;
      for (int i = 0; i < 16; ++i) {
        const double x = box.x + box.side * (i % 4 + 0.5) / 4,
                     y = box.y + box.side * (i / 4 + 0.5) / 4;
        if (x * x + y * y >= 1)
          continue;
        const double rho = value(c.density, on_sphere(x, y, box.south));
        REQUIRE(rho <= box.bounds.greatest);
        REQUIRE(rho >= box.bounds.least * (1 - 1e-13));
        sum += rho / 16;
      }
      expected += sum * box.area();
    }
    // At least half by the stopping rule of the refinement, less the part outside the disc: at most
    // 1 - pi/4 of it.
    CHECK(expected > 0.25 * mass(envelope));
  }
}

TEST_CASE("boxes are chosen by their bound's integral") {
  const Envelope envelope(bump_cases()[0].density);
  const double total = mass(envelope);
  double before = 0;
  for (std::int64_t b = 0; b < std::ssize(envelope.boxes()); ++b) {
    const Box& box = envelope.boxes()[static_cast<std::size_t>(b)];
    const double share = box.bounds.greatest * box.area() / total;
    CHECK(envelope.choose(before + 1e-9 * share + 1e-14) == b);
    CHECK(envelope.choose(before + (1 - 1e-9) * share - 1e-14) == b);
    before += share;
  }
  CHECK(envelope.choose(0) == 0);
  CHECK(envelope.choose(1 - 0x1p-53) == std::ssize(envelope.boxes()) - 1);
}

TEST_CASE("a callable's bound is raised only around values found above it") {
  // At the middle of a box of the first lattice, farthest from its points.
  const double x = 1.0 / 64, y = 1.0 / 64, height = 1e5;
  const Vec3 centre = on_sphere(x, y, false);
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [=](const Eigen::Ref<const Points3>& p, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index j = 0; j < p.cols(); ++j)
      rho[j] = norm(Vec3{p(0, j), p(1, j), p(2, j)} - centre) < 0.005 ? height : 1;
  };
  Envelope envelope(density);
  const double before = mass(envelope);
  REQUIRE(before < 10); // unsampled: 1.25 on two squares of area 4 each, less their corners
  envelope.raise({{box_of(envelope, x, y, false), x, y, height}});
  const auto bound_at = [&](double u, double v) {
    return envelope.boxes()[static_cast<std::size_t>(box_of(envelope, u, v, false))]
        .bounds.greatest;
  };
  CHECK(bound_at(x, y) >= 2 * height);
  for (const double angle : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
    CHECK(bound_at(x + 0.0033 * std::cos(angle), y + 0.0033 * std::sin(angle)) >= height);
    CHECK(bound_at(x + 0.1 * std::cos(angle), y + 0.1 * std::sin(angle)) < 100);
  }
  const double spike = height * 0.005 * 0.005 * 3.14159 / 2; // half of the integral, as areas are
  CHECK(mass(envelope) - before < 4 * spike);
}

// Slow: a search for a cap of 0.001 radians samples a fine lattice.
TEST_CASE("a density that is zero is refused, one in a cap of 0.001 radians is found [slow]") {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setZero();
  };
  CHECK_THROWS_WITH_AS(Envelope{density}, doctest::Contains("make it positive somewhere"), Error);
  const Points3 centres = random_sphere(3, 8);
  for (const auto& centre : centres.colwise()) {
    density.callable = [=](const Eigen::Ref<const Points3>& p, Eigen::Ref<Eigen::VectorXd> rho) {
      const double least = 1 - 0.5 * 0.001 * 0.001;
      rho = ((centre.transpose() * p).array() > least).cast<double>().matrix().transpose();
    };
    CHECK(mass(Envelope(density)) < 20 * 0.001 * 0.001); // pi/2 of it, about twice, and a floor
  }
}
