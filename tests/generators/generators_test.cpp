// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/errors.h"
#include "support/oracle.h"

#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

using namespace calotte;
using calotte::test::code_of;

namespace {

using Point = std::array<double, 3>;

/// The points as a set: sorted, with -0 replaced by 0.
std::vector<Point> sorted(const Points3& points) {
  std::vector<Point> out;
  for (const auto& column : points.colwise())
    out.push_back({column[0] + 0.0, column[1] + 0.0, column[2] + 0.0});
  std::sort(out.begin(), out.end());
  return out;
}

Points3 mapped(const Points3& points, const Eigen::Matrix3d& map) { return map * points; }

/// Permutes the axes cyclically.
Eigen::Matrix3d cycle() { return (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(); }
Eigen::Matrix3d quarter_turn() {
  return (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
}
Eigen::Matrix3d mirror() { return Eigen::Vector3d(1, 1, -1).asDiagonal(); }

/// FNV-1a over the bits of all coordinates.
std::uint64_t fingerprint(const Points3& points) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, points.data() + i, sizeof bits);
    for (int byte = 0; byte < 8; ++byte) {
      hash = (hash ^ (bits & 255)) * 0x100000001b3;
      bits >>= 8;
    }
  }
  return hash;
}

bool all_distinct(const Points3& points) {
  const std::vector<Point> set = sorted(points);
  return std::adjacent_find(set.begin(), set.end()) == set.end();
}

struct Named {
  std::string name;
  Points3 points;
  std::int64_t count;
  std::uint64_t fingerprint;
};

std::vector<Named> samples() {
  const Density x8 = tanh_bump({1, 2, -3}, 0.5, 0.2, 1.0 / 4096);
  return {{"random", random_sphere(1000), 1000, 0xce28624f111fae17},
          {"random, seed 7", random_sphere(1000, 7), 1000, 0xb9d39ed80908babb},
          {"random, x8", random_sphere(1000, x8, 7), 1000, 0x530126bd7fe15963},
          {"fibonacci", fibonacci_sphere(1000), 1000, 0xa3e23d7866bad0d7},
          {"spiral", spiral_sphere(1000), 1000, 0xd8a82f84bd726650},
          {"icosahedron 3", bisected_icosahedron(3), 642, 0xc7cd063cf228655d},
          {"geodesic", geodesic_sphere(7, 3), 792, 0x776a390ac9191c6d},
          {"geodesic, any number", geodesic_sphere(1000), 1000, 0xa99bc66fb4206f4f},
          {"lat-lon", lat_lon_sphere(18, 36), 648, 0x533facb8b8b72265},
          {"lat-lon with poles", lat_lon_sphere(9, 14, true), 128, 0x89dc92cca1cc927d},
          {"cubed sphere", cubed_sphere(11), 726, 0xb17df5c4289d7d95}};
}

} // namespace

TEST_CASE("every generator gives distinct unit columns, in the documented number") {
  for (const Named& sample : samples()) {
    CAPTURE(sample.name);
    CHECK(sample.points.cols() == sample.count);
    CHECK(all_distinct(sample.points));
    // 2u for each rounded coordinate and a few for the values it is computed from
    CHECK((sample.points.colwise().norm().array() - 1).abs().maxCoeff() <= 8 * 0x1p-53);
  }
}

TEST_CASE("the same bits on every machine") {
  for (const Named& sample : samples()) {
    CAPTURE(sample.name);
    CHECK(fingerprint(sample.points) == sample.fingerprint);
  }
}

TEST_CASE("random: a shorter set is the beginning, another seed another set") {
  const Points3 points = random_sphere(500, 3);
  CHECK(random_sphere(100, 3) == points.leftCols(100));
  CHECK(random_sphere(500, 4) != points);
}

TEST_CASE("random: uniform on the sphere") {
  const std::int64_t n = 100000;
  const Points3 points = random_sphere(n, 11);
  // Each coordinate has mean 0, variance 1/3, and a square of variance 4/45; five sigma.
  const double sigma = 1 / std::sqrt(static_cast<double>(n));
  CHECK(points.rowwise().mean().cwiseAbs().maxCoeff() < 5 * sigma * std::sqrt(1.0 / 3));
  const Eigen::Vector3d squares = points.array().square().rowwise().mean();
  CHECK((squares.array() - 1.0 / 3).abs().maxCoeff() < 5 * sigma * std::sqrt(4.0 / 45));
}

TEST_CASE("fibonacci: the lattice's formula") {
  const std::int64_t n = 100003;
  const Points3 points = fibonacci_sphere(n);
  const long double turn = (3 - std::sqrt(5.0L)) / 2, pi = std::acos(-1.0L);
  double worst = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    const long double z = 1 - (2 * i + 1) / static_cast<long double>(n);
    const long double longitude = 2 * pi * std::fmod(turn * i, 1.0L), r = std::sqrt(1 - z * z);
    const double x = static_cast<double>(r * std::cos(longitude)),
                 y = static_cast<double>(r * std::sin(longitude));
    worst = std::max({worst, std::abs(points(0, i) - x), std::abs(points(1, i) - y),
                      std::abs(points(2, i) - static_cast<double>(z))});
  }
  CHECK(worst < 2 * 3.15 * n * 0x1p-63); // the long doubles' error in i times the golden angle
}

TEST_CASE("spiral: the recurrence's formula, both poles") {
  const std::int64_t n = 5000;
  const Points3 points = spiral_sphere(n);
  CHECK(points.col(0) == Eigen::Vector3d(0, 0, -1));
  CHECK(points.col(n - 1) == Eigen::Vector3d(0, 0, 1));
  long double longitude = 0;
  double worst = 0;
  for (std::int64_t k = 1; k < n - 1; ++k) {
    const long double z = -1 + 2 * k / static_cast<long double>(n - 1);
    longitude += 3.6L / std::sqrt(n * (1 - z * z));
    const long double r = std::sqrt(1 - z * z);
    worst = std::max({worst, std::abs(points(0, k) - static_cast<double>(r * std::cos(longitude))),
                      std::abs(points(1, k) - static_cast<double>(r * std::sin(longitude)))});
  }
  CHECK(worst < n * 1.8 * 8 * 0x1p-53); // n steps of at most 1.8 radians, 8 roundoffs each
  CHECK(spiral_sphere(2).cols() == 2);
}

TEST_CASE("bisected icosahedron: coarser levels first, as symmetric as the axes") {
  const Points3 fine = bisected_icosahedron(5);
  CHECK(fine.cols() == 10242);
  CHECK(all_distinct(fine));
  for (int level = 0; level < 5; ++level) {
    const Points3 coarse = bisected_icosahedron(level);
    CHECK(coarse == fine.leftCols(coarse.cols()));
  }
  CHECK(sorted(mapped(fine, -Eigen::Matrix3d::Identity())) == sorted(fine));
  CHECK(sorted(mapped(fine, cycle())) == sorted(fine));
  CHECK(sorted(mapped(fine, mirror())) == sorted(fine));
}

TEST_CASE("bisected icosahedron: level 1 is the bisection of level 0") {
  const Mesh icosahedron = oracle::delaunay(bisected_icosahedron(0));
  REQUIRE(icosahedron.triangles.cols() == 20);
  CHECK(sorted(bisect(icosahedron)) == sorted(bisected_icosahedron(1)));
}

TEST_CASE("lat-lon: rows at cell-centred latitudes, the symmetries of the lattice") {
  const Points3 points = lat_lon_sphere(6, 12);
  const long double pi = std::acos(-1.0L);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 12; ++i) {
      const long double latitude = pi * (2 * j + 1 - 6) / 12, longitude = 2 * pi * i / 12;
      const Eigen::Vector3d expected(static_cast<double>(std::cos(latitude) * std::cos(longitude)),
                                     static_cast<double>(std::cos(latitude) * std::sin(longitude)),
                                     static_cast<double>(std::sin(latitude)));
      CHECK((points.col(12 * j + i) - expected).cwiseAbs().maxCoeff() <= 4 * 0x1p-53);
    }
  CHECK(sorted(mapped(points, mirror())) == sorted(points));
  CHECK(sorted(mapped(points, quarter_turn())) == sorted(points));
  const Points3 with_poles = lat_lon_sphere(5, 8, true);
  CHECK(with_poles.rightCols(2).col(0) == Eigen::Vector3d(0, 0, -1));
  CHECK(with_poles.rightCols(2).col(1) == Eigen::Vector3d(0, 0, 1));
  CHECK(with_poles.leftCols(40) == lat_lon_sphere(5, 8));
}

TEST_CASE("cubed sphere: the symmetries of the cube") {
  for (const std::int64_t m : {1, 2, 7, 16}) {
    const Points3 points = cubed_sphere(m);
    CHECK(sorted(mapped(points, cycle())) == sorted(points));
    CHECK(sorted(mapped(points, quarter_turn())) == sorted(points));
    CHECK(sorted(mapped(points, mirror())) == sorted(points));
  }
  CHECK(cubed_sphere(1).col(0) == Eigen::Vector3d(1, 0, 0));
}

TEST_CASE("bisect: each edge once, in the order of the triangles, also on an open mesh") {
  Points3 points(3, 4);
  points << 1, 0, 0, -4, 0, 1, 0, 0, 0, 0, 1e-200, 0;
  points.col(2) *= 1;
  const Mesh mesh = oracle::mesh_of(points, {{0, 1, 2}, {1, 3, 2}});
  const Points3 finer = bisect(mesh);
  REQUIRE(finer.cols() == 4 + 5);
  CHECK(finer.leftCols(4) == points);
  const double h = std::sqrt(0.5);
  const std::array<Eigen::Vector3d, 5> expected{
      Eigen::Vector3d{0, h, h}, {h, 0, h}, {h, h, 0}, {-h, 0, h}, {-h, h, 0}};
  for (int e = 0; e < 5; ++e)
    CHECK((finer.col(4 + e) - expected[static_cast<std::size_t>(e)]).cwiseAbs().maxCoeff() <=
          4 * 0x1p-53);
}

TEST_CASE("a count or an id out of range is an error") {
  const std::vector<std::function<void()>> calls{
      [] { random_sphere(0); },
      [] { random_sphere(-1); },
      [] { random_sphere((std::int64_t{1} << 30) + 1); },
      [] { fibonacci_sphere(0); },
      [] { spiral_sphere(1); },
      [] { bisected_icosahedron(-1); },
      [] { bisected_icosahedron(14); },
      [] { lat_lon_sphere(0, 3); },
      [] { lat_lon_sphere(1, 2); },
      [] { lat_lon_sphere(1 << 20, 1 << 20); },
      [] { cubed_sphere(0); },
      [] { cubed_sphere(13378); },
      [] {
        bisect(Mesh{Points3(3, 0), Triangles::Zero(3, 1), Triangles::Constant(3, 1, -1), {}});
      },
      [] {
        bisect(Mesh{Points3(3, 0), Triangles::Zero(3, 1), Triangles(3, 0), {}});
      }};
  for (std::size_t i = 0; i < calls.size(); ++i) {
    CAPTURE(i);
    CHECK(code_of(calls[i]) == ErrorCode::invalid_argument);
  }
}
