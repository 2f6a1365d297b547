// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/density_evaluator.h"
#include "support/random.h"

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

using namespace calotte;

namespace {

using Long3 = Eigen::Matrix<long double, 3, 1>;

constexpr double roundoff = 0x1p-53;

Density of_bumps(const std::vector<DensityBump>& bumps,
                 Density::Kind kind = Density::Kind::maximum) {
  Density density;
  density.kind = kind;
  density.bumps = bumps;
  return density;
}

Density of(const Density::Callable& callable) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = callable;
  return density;
}

struct Reference {
  double rho;
  double bound; ///< of the relative error of an evaluation in doubles
};

/// In long doubles. With y the argument of the tanh, rho depends on E = exp(-2 y) with a relative
/// slope of w = (rho - gamma) E / (1 + E) / rho. An angle is good to 32 units of roundoff: 5 of the
/// centre, 3 of the point, 2 ulp of the arc sine on up to pi/2 twice, and pi's own. E is good to
/// that times 2/alpha, three roundings of 2 y, and 4 of its own; what else is added or divided
/// takes 8.
Reference reference(const DensityBump& bump, const Eigen::Vector3d& at) {
  const Long3 x = at.cast<long double>().normalized(),
              c = bump.centre.cast<long double>().normalized();
  Long3 major = Long3::Zero();
  const long double shrink = 1 - 1 / static_cast<long double>(bump.stretch);
  if (bump.stretch > 1) {
    const Long3 given = bump.major.cast<long double>();
    major = (given - given.dot(c) * c).normalized();
  }
  const long double along = x.dot(major);
  const long double near = (x - c - shrink * along * major).norm();
  const long double far = std::sqrt((x + c).squaredNorm() + shrink * (2 - shrink) * along * along);
  const long double y = (bump.beta - 2 * std::atan2(near, far)) / bump.alpha;
  const long double gamma = bump.gamma, e = std::exp(-2 * y);
  const long double above = 1 / ((1 - gamma) * (1 + e)), rho = gamma + above;
  const long double w = std::isinf(e) ? 0 : above / rho * e / (1 + e);
  const long double units = 8 + w * (32 * 2 / bump.alpha + 3 * std::abs(2 * y) + 4);
  return {static_cast<double>(rho), roundoff * static_cast<double>(units)};
}

/// Random points, and points close to the centre, to its antipode and to its edge, on all sides.
Points3 places(const DensityBump& bump) {
  test::Random random(17);
  const Eigen::Vector3d c = bump.centre.normalized();
  std::vector<Eigen::Vector3d> out{c, -c};
  const auto direction = [&] {
    const base_detail::Vec3 p = random.direction();
    return Eigen::Vector3d(p.x, p.y, p.z);
  };
  for (int i = 0; i < 500; ++i)
    out.push_back(direction());
  for (int k = 0; k < 17; ++k)
    for (int side = 0; side < 8; ++side) {
      const Eigen::Vector3d tangent = c.cross(direction()).normalized();
      const double close = std::pow(10.0, -k);
      out.push_back((c + close * tangent).normalized());
      out.push_back((-c + close * tangent).normalized());
      const double edge = bump.beta + close * bump.alpha;
      out.push_back((std::cos(edge) * c + std::sin(edge) * tangent).normalized());
    }
  Points3 x(3, std::ssize(out));
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    x.col(j) = out[static_cast<std::size_t>(j)];
  return x;
}

/// Directions off the axes, widths from a ten-thousandth to beyond the sphere, floors from almost 0
/// to almost 1, and an ellipse of each.
std::vector<DensityBump> bumps() {
  std::vector<DensityBump> out;
  for (const Eigen::Vector3d& centre :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-3, 4, 12), Eigen::Vector3d(1e-3, -1, 1e-9)})
    for (const double beta : {1e-3, 0.5, 3.0, 100.0})
      for (const double alpha : {1e-4, 0.2, 5.0, 1e6})
        for (const double gamma : {1e-200, 1e-6, 0.5, 1 - 0x1p-53})
          for (const double stretch : {1.0, 1.5, 100.0})
            out.push_back({centre, beta, alpha, gamma, stretch, {0.2, 0.3, -0.1}});
  return out;
}

std::string message_of(const Density& density) {
  try {
    evaluate(density, bisected_icosahedron(0));
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_argument);
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("a bump is as printed, in any place and of any shape") {
  for (const DensityBump& bump : bumps()) {
    CAPTURE(bump.centre.transpose());
    CAPTURE(bump.beta);
    CAPTURE(bump.alpha);
    CAPTURE(bump.gamma);
    CAPTURE(bump.stretch);
    const Points3 x = places(bump);
    const Eigen::VectorXd rho = evaluate(of_bumps({bump}), x);
    double worst = 0; // over its bound
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const Reference expected = reference(bump, x.col(j));
      worst = std::max(worst, std::abs(rho[j] / expected.rho - 1) / expected.bound);
    }
    CHECK(worst <= 1);
  }
}

TEST_CASE("the paper's x8 bump is good to 1e-14, against its formula in long doubles") {
  const DensityBump bump{{0, -0.8, 0.6}, 0.5235987755982988, 0.2, 1.0 / 4096};
  const Points3 x = places(bump);
  const Eigen::VectorXd rho =
      evaluate(tanh_bump(bump.centre, bump.beta, bump.alpha, bump.gamma), x);
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const Long3 at = x.col(j).cast<long double>(), c = bump.centre.cast<long double>();
    const long double d = std::atan2(at.cross(c).norm(), at.dot(c));
    const long double gamma = bump.gamma, alpha = bump.alpha;
    const long double printed =
        (std::tanh((bump.beta - d) / alpha) + 1) / (2 * (1 - gamma)) + gamma;
    CHECK(std::abs(rho[j] / static_cast<double>(printed) - 1) < 1e-14);
  }
}

TEST_CASE("bumps join by their maximum or their sum") {
  const std::vector<DensityBump> three{{{0, 0, 1}, 0.5, 0.1, 0.01},
                                       {{1, 0, 0.2}, 0.3, 0.2, 0.1, 3, {0, 1, 0}},
                                       {{-1, 1, 0}, 1, 0.5, 0.9}};
  const Points3 x = random_sphere(2000, 5);
  Eigen::VectorXd greatest = Eigen::VectorXd::Zero(x.cols()), sum = greatest;
  for (const DensityBump& bump : three) {
    const Eigen::VectorXd rho = evaluate(of_bumps({bump}), x);
    greatest = greatest.cwiseMax(rho);
    sum += rho;
  }
  CHECK(evaluate(of_bumps(three), x) == greatest);
  CHECK(evaluate(of_bumps(three, Density::Kind::sum), x) == sum);
  CHECK((sum.array() > greatest.array()).all());
}

TEST_CASE("an ellipse is a circle across its axis and reaches so much farther along it") {
  const DensityBump round{{0, 0, 1}, 0.01, 0.01, 0.01};
  DensityBump ellipse = round;
  ellipse.stretch = 10;
  ellipse.major = {0, 2, 5}; // of which only the tangential part counts
  const double d = 0.02;
  Points3 x(3, 2);
  x << std::sin(d), 0, 0, std::sin(10 * d), std::cos(d), std::cos(10 * d);
  const Eigen::VectorXd at = evaluate(of_bumps({ellipse}), x);
  CHECK(at[0] == evaluate(of_bumps({round}), x)[0]);
  // The chord's tangential part is shrunk, sin(10 d)/10 = d (1 - (10 d)^2/6), and 1 - cos(10 d) is
  // not.
  CHECK(at[1] == doctest::Approx(at[0]).epsilon(2 / round.alpha * d * 20 * d * d * 100));
}

TEST_CASE("the bits of a value do not depend on the other points of a call") {
  const Points3 x = random_sphere(2100, 2);
  const Density squared = of([](const Eigen::Ref<const Points3>& p, Eigen::Ref<Eigen::VectorXd> r) {
    r = p.row(0).cwiseAbs2().transpose();
  });
  for (const Density& density :
       {of_bumps({{{1, 2, 3}, 0.5, 0.1, 0.01, 2}, {{0, -1, 0}, 1, 0.3, 0.2}}), squared,
        Density{}}) {
    const Eigen::VectorXd rho = evaluate(density, x);
    for (const Eigen::Index batch : {1, 3, 8, 511, 512, 513, 2099})
      for (Eigen::Index begin = 0; begin < x.cols(); begin += batch) {
        const Eigen::Index count = std::min(batch, x.cols() - begin);
        REQUIRE(evaluate(density, x.middleCols(begin, count)) == rho.segment(begin, count));
      }
  }
  CHECK(evaluate(squared, Points3(3, 0)).size() == 0);
}

TEST_CASE("bounds of bumps hold within their reach and close in on the value") {
  for (const Density::Kind kind : {Density::Kind::maximum, Density::Kind::sum})
    for (const DensityBump& bump : bumps()) {
      CAPTURE(bump.centre.transpose());
      CAPTURE(bump.beta);
      CAPTURE(bump.alpha);
      CAPTURE(bump.gamma);
      CAPTURE(bump.stretch);
      const Density density = of_bumps({bump, {{0, 1, 1}, 0.3, 0.1, 1e-3}}, kind);
      const density_detail::DensityEvaluator evaluator(density);
      const Points3 x = places(bump);
      const Eigen::VectorXd rho = evaluate(density, x);
      std::int64_t wrong = 0;
      for (Eigen::Index j = 0; j < x.cols(); j += 301) { // the centre first
        const base_detail::Vec3 middle{x(0, j), x(1, j), x(2, j)};
        for (Eigen::Index k = 0; k < x.cols(); k += 3) {
          const Eigen::Vector3d a = x.col(j), b = x.col(k);
          const auto bounds = evaluator.bounds(middle, std::atan2(a.cross(b).norm(), a.dot(b)));
          wrong += rho[k] > bounds.greatest || rho[k] < bounds.least * (1 - 1e-13);
        }
        const auto close = evaluator.bounds(middle, 0);
        CHECK(close.greatest / close.least < 1 + 2e-13 * (1 + 1 / bump.alpha + 1 / 0.1));
      }
      CHECK(wrong == 0);
    }
}

TEST_CASE("an ill-formed density is one line that names the bump and the remedy") {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const std::vector<DensityBump> bad{
      {{0, 0, 0}},
      {{0, nan, 1}},
      {{0, 0, 1}, -1},
      {{0, 0, 1}, infinite},
      {{0, 0, 1}, 1, 0},
      {{0, 0, 1}, 1, nan},
      {{0, 0, 1}, 1, 1, 0},
      {{0, 0, 1}, 1, 1, 1},
      {{0, 0, 1}, 1, 1, nan},
      {{0, 0, 1}, 1, 1, 0.5, 0.5},
      {{0, 0, 1}, 1, 1, 0.5, 2, {0, 0, 1}},
  };
  for (std::size_t b = 0; b < bad.size(); ++b) {
    CAPTURE(b);
    const std::string message = message_of(of_bumps({DensityBump{}, bad[b]}));
    CHECK(message.find("bump") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(message_of(of_bumps({})) != "");
  CHECK(message_of(of({})) != "");
  Density no_kind = of([](const auto&, Eigen::Ref<Eigen::VectorXd> rho) { rho.setOnes(); });
  no_kind.kind = Density::Kind::uniform; // what a caller has who sets the callable alone
  CHECK(message_of(no_kind) ==
        "the density is uniform, but has bumps, widths or a callable; set its kind, too");
  CHECK(message_of(of_bumps({DensityBump{}}, Density::Kind::uniform)) == message_of(no_kind));
  for (const double value : {-1e-300, nan, infinite, -infinite}) {
    const Density density = of([=](const auto& x, Eigen::Ref<Eigen::VectorXd> rho) {
      rho.setOnes();
      rho[x.cols() - 1] = value;
    });
    CHECK(message_of(density).find("somewhere") != std::string::npos);
  }
}

TEST_CASE("the sites' density is the root of the density") {
  const Points3 x = random_sphere(200, 4);
  const Density density = tanh_bump({1, 2, 3}, 0.5, 0.2, 0.01);
  const Eigen::VectorXd root = evaluate(site_density(density), x);
  CHECK((root.cwiseAbs2() - evaluate(density, x)).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(site_density(Density{}).uniform());
}

TEST_CASE("a density is an open struct") {
  static_assert(std::is_aggregate_v<Density>);
  const Density two{.kind = Density::Kind::sum, .bumps = {DensityBump{}, DensityBump{}}};
  CHECK(evaluate(two, Points3(Eigen::Vector3d(0, 0, 1)))[0] > 1);
}

TEST_CASE("a function of a point is a density, and what it throws ends the call") {
  const Points3 x = random_sphere(1000, 5);
  const Density density = density_of([](const Eigen::Vector3d& at) { return 1 + at.z() * at.z(); });
  CHECK(evaluate(density, x) == (1 + x.row(2).array().square()).matrix().transpose());
  const Density faulty = density_of([](const Eigen::Vector3d& at) { return at.z(); });
  CHECK(message_of(faulty).find("somewhere") != std::string::npos);
  const Density throwing =
      density_of([](const Eigen::Vector3d&) -> double { throw std::out_of_range("here"); });
  CHECK_THROWS_AS(evaluate(throwing, x), std::out_of_range);
  CHECK_THROWS_WITH_AS(density_of(nullptr), "the function of a density is empty; give one", Error);
}
