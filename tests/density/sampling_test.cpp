// SPDX-License-Identifier: GPL-3.0-or-later

#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace calotte;

namespace {

constexpr double pi = std::numbers::pi;

Density of(const std::function<double(const Eigen::Vector3d&)>& rho_at) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [=](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index j = 0; j < x.cols(); ++j)
      rho[j] = rho_at(x.col(j));
  };
  return density;
}

/// True if Pearson's sum for n points in classes of these probabilities lies within five of its
/// standard deviations; classes that expect fewer than 20 points are merged into one. Its mean is K
/// - 1, its variance 2 (K - 1) + (sum 1/p - K^2 - 2 K + 2)/n.
bool fits(const std::vector<double>& probability, const std::vector<std::int64_t>& count) {
  std::int64_t n = 0;
  for (const std::int64_t c : count)
    n += c;
  std::vector<double> p{0}, seen{0};
  for (std::size_t k = 0; k < count.size(); ++k) {
    const bool rare = probability[k] * static_cast<double>(n) < 20;
    if (!rare) {
      p.push_back(0);
      seen.push_back(0);
    }
    p[rare ? 0 : p.size() - 1] += probability[k];
    seen[rare ? 0 : p.size() - 1] += static_cast<double>(count[k]);
  }
  double sum = 0, inverse = 0, classes = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double expected = p[k] * static_cast<double>(n);
    if (expected < 1) { // the rare ones together: five sigma of a Poisson number, too
      if (seen[k] > expected + 5 * std::sqrt(expected) + 5)
        return false;
      continue;
    }
    sum += (seen[k] - expected) * (seen[k] - expected) / expected;
    inverse += 1 / p[k];
    ++classes;
  }
  const double variance =
      2 * (classes - 1) + (inverse - classes * classes - 2 * classes + 2) / static_cast<double>(n);
  return std::abs(sum - (classes - 1)) < 5 * std::sqrt(variance);
}

// Classes of 15 by 15 degrees.
constexpr std::int64_t rows = 12, columns = 24;

/// Integrals over the classes by the midpoint rule, 0.75 degrees apart, over their sum. The rule's
/// relative error, h^2/24 times the second derivative, stays below 0.005 for densities that change
/// over 0.1 radians: it adds 2.5 at most to the sum of 100 000 points, whose deviation is 24.
std::vector<double> class_probabilities(const Density& density) {
  constexpr std::int64_t fine = 20;
  const Points3 x = lat_lon_sphere(rows * fine, columns * fine);
  const Eigen::VectorXd rho = evaluate(density, x);
  std::vector<double> out(rows * columns, 0);
  double total = 0;
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    const double part = rho[j] * std::sqrt(1 - x(2, j) * x(2, j));
    const std::int64_t row = j / (columns * fine) / fine, column = j % (columns * fine) / fine;
    out[static_cast<std::size_t>(row * columns + column)] += part;
    total += part;
  }
  for (double& p : out)
    p /= total;
  return out;
}

std::vector<std::int64_t> class_counts(const Points3& points) {
  std::vector<std::int64_t> out(rows * columns, 0);
  for (const auto& p : points.colwise()) {
    const double north = std::asin(p[2]) / pi + 0.5, east = std::atan2(p[1], p[0]) / (2 * pi);
    const auto row = std::min(rows - 1, static_cast<std::int64_t>(north * rows));
    const auto column =
        std::min(columns - 1, static_cast<std::int64_t>((east < 0 ? east + 1 : east) * columns));
    ++out[static_cast<std::size_t>(row * columns + column)];
  }
  return out;
}

struct SampledDensity {
  const char* name;
  Density density;
};

std::vector<SampledDensity> smooth_cases() {
  Density ellipse = tanh_bump({1, 2, -1}, 0.3, 0.2, 1e-3), sum, maximum;
  ellipse.bumps[0].stretch = 3;
  sum.bumps = {{{0, 0, 1}, 0.5, 0.2, 1e-3},
               {{0, 0, 1}, 0.3, 0.3, 0.1},
               {{1, -1, 0.3}, 0.8, 0.1, 1e-6, 2, {0, 0, 1}}};
  maximum = sum;
  sum.kind = Density::Kind::sum;
  maximum.kind = Density::Kind::maximum;
  const auto cosine = [](const Eigen::Vector3d& x) {
    return 1 + 0.9 * std::cos(7 * x[0] + 5 * x[2]);
  };
  return {{"uniform", {}},
          {"x8", tanh_bump({0, -0.8, 0.6}, 0.5235987755982988, 0.2, 1.0 / 4096)},
          {"ellipse", ellipse},
          {"sum", sum},
          {"maximum", maximum},
          {"gamma near 1", tanh_bump({1, 0, 0}, 1, 0.2, 1 - 0x1p-30)},
          {"all within beta", tanh_bump({1, 0, 0}, 50, 0.2, 0.1)},
          {"callable", of(cosine)},
          {"zero over a half", of([](const Eigen::Vector3d& x) { return x[0] > 0 ? 3.0 : 0.0; })}};
}

/// Counts by the angle from a direction, between the edges given, and the integrals of 2 pi rho(d)
/// sin(d) there, by Simpson.
bool fits_rings(const Points3& points, const Eigen::Vector3d& centre,
                const std::function<double(double)>& rho_at, const std::vector<double>& edges) {
  std::vector<double> integral;
  double total = 0;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    constexpr int steps = 4000;
    const double h = (edges[k + 1] - edges[k]) / steps;
    double sum = 0;
    for (int s = 0; s <= steps; ++s) {
      const double d = edges[k] + s * h;
      sum += (s == 0 || s == steps ? 1 : s % 2 ? 4 : 2) * rho_at(d) * std::sin(d);
    }
    integral.push_back(sum * h / 3);
    total += integral.back();
  }
  for (double& p : integral)
    p /= total;
  std::vector<std::int64_t> count(integral.size(), 0);
  for (const auto& p : points.colwise()) {
    const double d = 2 * std::asin(std::min(1.0, (p - centre).norm() / 2));
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, d);
    ++count[static_cast<std::size_t>(above - edges.begin() - 1)];
  }
  return fits(integral, count);
}

/// Counts in the quadrants about a direction.
bool fits_quadrants(const Points3& points, const Eigen::Vector3d& centre) {
  const Eigen::Vector3d u = centre.cross(Eigen::Vector3d(0.3, -0.5, 0.2)).normalized(),
                        v = centre.cross(u);
  std::vector<std::int64_t> count(4, 0);
  for (const auto& p : points.colwise())
    ++count[(p.dot(u) > 0 ? 1 : 0) + (p.dot(v) > 0 ? 2 : 0)];
  return fits({0.25, 0.25, 0.25, 0.25}, count);
}

Points3 with_threads(std::size_t threads, const std::function<Points3()>& make) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  return make();
}

} // namespace

TEST_CASE("points drawn from a density are distributed as it is") {
  for (const SampledDensity& c : smooth_cases()) {
    CAPTURE(c.name);
    const Points3 points = random_sphere(100000, c.density, 11);
    REQUIRE(points.cols() == 100000);
    CHECK((points.colwise().norm().array() - 1).abs().maxCoeff() <= 8 * 0x1p-53);
    CHECK(fits(class_probabilities(c.density), class_counts(points)));
  }
}

TEST_CASE("the test of distributions distinguishes a density from one a twentieth wider") {
  const Density one = tanh_bump({0, -0.8, 0.6}, 0.5, 0.2, 1.0 / 4096);
  const Density other = tanh_bump({0, -0.8, 0.6}, 0.525, 0.2, 1.0 / 4096);
  CHECK_FALSE(fits(class_probabilities(other), class_counts(random_sphere(100000, one, 11))));
}

TEST_CASE("peaked bumps: rings about the centre and quadrants fit") {
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, -3, 6)})
    for (const double alpha : {1e-3, 1e-1})
      for (const double beta : {1e-3, 1.0})
        for (const double gamma : {1e-6, 1e-1}) {
          CAPTURE(direction.transpose());
          CAPTURE(alpha);
          CAPTURE(beta);
          CAPTURE(gamma);
          const Eigen::Vector3d centre = direction.normalized();
          const Points3 points = random_sphere(30000, tanh_bump(centre, beta, alpha, gamma), 5);
          const auto rho = [&](double d) {
            return gamma + 1 / ((1 - gamma) * (1 + std::exp(2 * (d - beta) / alpha)));
          };
          std::vector<double> edges{0, pi, 0.5, 1.5, 2, 2.5};
          for (const double width : {alpha, beta, 0.5 * alpha, 0.5 * beta, beta + alpha,
                                     beta + 2 * alpha, beta + 5 * alpha, 0.9 * beta})
            edges.push_back(width);
          std::sort(edges.begin(), edges.end());
          edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
          CHECK(fits_rings(points, centre, rho, edges));
          CHECK(fits_quadrants(points, centre));
        }
}

TEST_CASE("a callable that is zero except in a cap of 0.01 radians") {
  const Eigen::Vector3d centre(0.36, 0.48, 0.8);
  const auto rho = [&](double d) { return d < 0.01 ? 1.0 : 0.0; };
  const Points3 points = random_sphere(30000, of([&](const Eigen::Vector3d& x) {
                                         return rho(2 * std::asin((x - centre).norm() / 2));
                                       }));
  std::vector<double> edges;
  for (int k = 0; k <= 10; ++k)
    edges.push_back(0.01 * std::sqrt(0.1 * k));
  for (const auto& p : points.colwise())
    REQUIRE((p - centre).norm() < 0.01);
  CHECK(fits_rings(
      points, centre, [](double) { return 1; }, edges));
  CHECK(fits_quadrants(points, centre));
}

// Slow: one in 160 000 proposals meets the spike, so that 1.5 million points are drawn.
TEST_CASE("a callable's spike that only proposals find gets its share of points [slow]") {
  // Around the middle of a box of the lattice on which the bound is first built, and so small that
  // the lattice misses it; one in 160 000 proposals meets it.
  const double x = 1.0 / 64, r = std::sqrt(2 - 2 * x * x), radius = 0.005, height = 1e4;
  const Eigen::Vector3d centre(x * r, x * r, 1 - 2 * x * x);
  const std::int64_t n = 1500000;
  Density spike;
  spike.kind = Density::Kind::callable;
  spike.callable = [=](const Eigen::Ref<const Points3>& p, Eigen::Ref<Eigen::VectorXd> rho) {
    const auto inside = (p.colwise() - centre).colwise().squaredNorm().array() < radius * radius;
    rho = (1 + (height - 1) * inside.cast<double>()).matrix().transpose();
  };
  const Points3 points = random_sphere(n, spike);
  double inside = 0;
  for (const auto& p : points.colwise())
    inside += (p - centre).norm() < radius;
  const double area = pi * radius * radius; // exact, as radius is a chord
  const double share = height * area / (height * area + 4 * pi - area);
  CHECK(std::abs(inside - static_cast<double>(n) * share) <
        5 * std::sqrt(static_cast<double>(n) * share * (1 - share)));
}

TEST_CASE("the same points for any number of threads; another seed, other points") {
  for (const SampledDensity& c : smooth_cases()) {
    CAPTURE(c.name);
    const auto draw = [&] { return random_sphere(50000, c.density, 3); };
    const Points3 one = with_threads(1, draw);
    CHECK(with_threads(4, draw) == one);
    CHECK(random_sphere(50000, c.density, 4) != one);
  }
}

TEST_CASE("fewer points are the first of more") {
  for (const SampledDensity& c : smooth_cases()) {
    CAPTURE(c.name);
    const Points3 points = random_sphere(40000, c.density, 3);
    for (const std::int64_t n : {1, 2, 100, 8191, 30000})
      CHECK(random_sphere(n, c.density, 3) == points.leftCols(n));
  }
  CHECK(random_sphere(100, Density{}, 3) == random_sphere(100, 3));
}

TEST_CASE("random: a density that cannot be drawn gives an error of one line with the reason") {
  const auto message = [](std::int64_t n, const Density& density) -> std::string {
    try {
      random_sphere(n, density);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      return error.what();
    }
    return "";
  };
  const auto says = [&](std::int64_t n, const Density& density, const char* words) {
    const std::string line = message(n, density);
    CAPTURE(line);
    CHECK(line.find(words) != std::string::npos);
    CHECK(line.find('\n') == std::string::npos);
  };
  const Density bump = tanh_bump({0, 0, 1}, 0.5, 0.2, 0.1);
  says(0, bump, "number of points is 0");
  says(-5, Density{}, "number of points is -5");
  says((std::int64_t{1} << 30) + 1, bump, "number of points");
  says(10, tanh_bump({0, 0, 0}, 0.5, 0.2, 0.1), "centre");
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const double value : {-1.0, nan, infinite})
    says(10, of([=](const Eigen::Vector3d& x) { return x[2] > 0.9 ? value : 1; }), "somewhere");
  Density nothing;
  nothing.kind = Density::Kind::sum;
  says(10, nothing, "no bump");
}

// Slow: both are refused only after many rounds of proposals.
TEST_CASE("a callable without a maximum, or that grows from call to call, is refused [slow]") {
  const Eigen::Vector3d centre(0.36, 0.48, 0.8);
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [=](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (x.colwise() - centre).colwise().squaredNorm().array().square().inverse().min(1e300);
  };
  CHECK_THROWS_WITH_AS(random_sphere(100000, density), doctest::Contains("lower its peaks"), Error);
  std::atomic<int> calls = 0;
  density.callable = [&](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setConstant(std::exp2(1e-4 * ++calls));
  };
  CHECK_THROWS_WITH_AS(random_sphere(100000, density), doctest::Contains("limit their gradient"),
                       Error);
}

// Slow: it is refused only after the largest number of proposals.
TEST_CASE("a region narrower than rounding is refused, not its density [slow]") {
  Points3 ring(3, 3);
  ring << 1, 0.6, 0.8, 0, 0.8, 0.6, 0, 0, 1e-14;
  for (Eigen::Index i = 0; i < 3; ++i)
    ring.col(i).normalize();
  CHECK_THROWS_WITH_AS(random_points(100, enclosed_region({ring})),
                       doctest::Contains("widen the region"), Error);
}

// ---- The plane

namespace {

/// A long thin tilted ring: a parallelogram with one in it.
Surface frame() {
  Points2 outer(2, 4), inner(2, 4);
  outer << 0, 100, 103, 3, 0, 50, 51, 1;
  inner = (0.5 * outer).colwise() + Eigen::Vector2d(0.25 * 103, 0.25 * 51);
  return Surface::plane().within({outer, inner});
}

/// Coordinates in the parallelogram: the position of a place along and across it, both from 0 to 1.
Eigen::Vector2d in_frame(const Eigen::Vector2d& p) {
  Eigen::Matrix2d sides;
  sides << 100, 3, 50, 1;
  return sides.inverse() * p;
}

Density of_x(const std::function<double(double)>& rho) {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [rho](const Eigen::Ref<const Points3>& p, Eigen::Ref<Eigen::VectorXd> out) {
    for (Eigen::Index i = 0; i < p.cols(); ++i)
      out[i] = rho(p(0, i));
  };
  return density;
}

} // namespace

TEST_CASE("places of a domain are uniform, inside, and the first ones of more") {
  const Points3 places = random_points(100000, frame(), {}, 7);
  REQUIRE(places.cols() == 100000);
  std::vector<std::int64_t> count(16, 0);
  for (const auto& place : places.colwise()) {
    REQUIRE(frame().contains(place));
    const Eigen::Vector2d at = 4 * in_frame(place.head<2>());
    ++count[static_cast<std::size_t>(std::floor(at.x()) + 4 * std::floor(at.y()))];
  }
  std::vector<double> share(16, 1.0 / 12);
  for (const std::size_t inner : {5U, 6U, 9U, 10U}) {
    CHECK(count[inner] == 0);
    share[inner] = 0;
  }
  std::vector<double> of_cells;
  std::vector<std::int64_t> in_cells;
  for (std::size_t i = 0; i < 16; ++i)
    if (share[i] > 0) {
      of_cells.push_back(share[i]);
      in_cells.push_back(count[i]);
    }
  CHECK(fits(of_cells, in_cells));
  CHECK(random_points(1000, frame(), {}, 7) == places.leftCols(1000));
  CHECK(random_points(1000, frame(), {}, 8) != places.leftCols(1000));

  const Surface box = Surface::periodic({3, 0.01});
  const Points3 in_box = random_points(50000, box);
  std::vector<std::int64_t> quarters(4, 0);
  for (const auto& place : in_box.colwise()) {
    REQUIRE(box.contains(place));
    ++quarters[(place.x() < 1.5 ? 0U : 1U) + (place.y() < 0.005 ? 0U : 2U)];
  }
  CHECK(fits({0.25, 0.25, 0.25, 0.25}, quarters));
}

TEST_CASE("places of a domain follow a density, for any number of threads") {
  const Surface square = rectangle({2, -1}, {3, 0});
  // rho = x^4 on a unit square from 2 to 3.
  const Density density = of_x([](double x) { return x * x * x * x; });
  const auto draw = [&] { return random_points(60000, square, density, 4); };
  const Points3 places = with_threads(1, draw);
  CHECK(with_threads(4, draw) == places);
  std::vector<double> share;
  std::vector<std::int64_t> count(10, 0);
  for (int i = 0; i < 10; ++i)
    share.push_back((std::pow(2 + 0.1 * (i + 1), 5) - std::pow(2 + 0.1 * i, 5)) /
                    (std::pow(3, 5) - std::pow(2, 5)));
  for (const auto& place : places.colwise())
    ++count[static_cast<std::size_t>(std::min(9.0, 10 * (place.x() - 2)))];
  CHECK(fits(share, count));
  // All mass in a strip of a hundredth of the square.
  const Points3 strip = random_points(
      1000, square, of_x([](double x) { return x > 2.4 && x < 2.41 ? 1.0 : 0.0; }), 4);
  CHECK(strip.row(0).minCoeff() > 2.4);
  CHECK(strip.row(0).maxCoeff() < 2.41);
  CHECK_THROWS_WITH_AS(random_points(10, square, of_x([](double) { return 0.0; })),
                       doctest::Contains("over the domain: make it positive"), Error);
  CHECK_THROWS_AS(random_points(10, square, of_x([](double x) { return 2.5 - x; })), Error);
}
