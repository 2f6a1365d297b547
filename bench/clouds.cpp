// SPDX-License-Identifier: GPL-3.0-or-later
#include "clouds.h"

#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace calotte::bench {

namespace {

/// Uniform in [0, 1), from the engine's upper 53 bits.
double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1p-53; }

Points3 shuffled(const Points3& points) {
  std::mt19937_64 engine(20130923);
  Points3 result = points;
  for (Eigen::Index i = result.cols() - 1; i > 0; --i) {
    const auto j = static_cast<Eigen::Index>(engine() % static_cast<std::uint64_t>(i + 1));
    result.col(i).swap(result.col(j));
  }
  return result;
}

Points3 nearest_bisection(std::int64_t n) {
  int level = 0;
  const auto distance = [n](int l) {
    return std::abs(n - (10 * (std::int64_t{1} << (2 * l)) + 2));
  };
  while (distance(level + 1) < distance(level))
    ++level;
  return shuffled(bisected_icosahedron(level));
}

/// Sites for a unit of area at the angle `theta` from the cap's centre, 1 at most.
double x8_number_density(double theta) {
  constexpr double radius = std::numbers::pi / 6;
  constexpr double width = 0.15;
  constexpr double least = 1.0 / 4096; // proportional to rho; the spacing ratio to the fourth power
  const double step = 0.5 * (std::tanh((radius - theta) / width) + 1);
  return std::sqrt((1 - least) * step + least);
}

Points3 x8(std::int64_t n) {
  std::mt19937_64 engine(8);
  Points3 points(3, n);
  for (std::int64_t i = 0; i < n;) {
    const double z = 2 * uniform(engine) - 1;
    const double longitude = 2 * std::numbers::pi * uniform(engine);
    if (uniform(engine) >= x8_number_density(std::acos(z)))
      continue;
    const double r = std::sqrt((1 - z) * (1 + z));
    // The centre of the cap lies on no axis, which avoids accidental alignment.
    const Eigen::Vector3d local(r * std::cos(longitude), r * std::sin(longitude), z);
    static const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
    const Eigen::Vector3d mirror = (axis - Eigen::Vector3d::UnitZ()).normalized();
    points.col(i++) = (local - 2 * mirror.dot(local) * mirror).normalized();
  }
  return points;
}

} // namespace

const std::vector<std::string>& cloud_names() {
  static const std::vector<std::string> names = {"random", "bisection", "x8"};
  return names;
}

Points3 cloud(const std::string& name, std::int64_t n) {
  if (name == "random")
    return random_sphere(n, 20130923);
  if (name == "bisection")
    return nearest_bisection(n);
  if (name == "x8")
    return x8(n);
  throw std::invalid_argument("no set of sites is called " + name);
}

const std::vector<std::int64_t>& bisected_sizes() {
  static const std::vector<std::int64_t> sizes = [] {
    std::vector<std::int64_t> result;
    for (int level = 1; level <= 12; ++level)
      result.push_back(10 * (std::int64_t{1} << (2 * level)) + 2);
    return result;
  }();
  return sizes;
}

Points3 natural_bisection(std::int64_t n) {
  const auto at = std::find(bisected_sizes().begin(), bisected_sizes().end(), n);
  Points3 points = bisected_icosahedron(static_cast<int>(at - bisected_sizes().begin()) + 1);
  const Eigen::Vector3d normal =
      Eigen::Vector3d(points.col(0)).cross(Eigen::Vector3d(points.col(1)));
  Eigen::Index third = 2;
  while (std::abs(normal.dot(points.col(third))) < 0.1)
    ++third;
  points.col(2).swap(points.col(third));
  return points;
}

Density x8_density() {
  const double latitude = std::numbers::pi / 6; // and longitude 270 degrees
  return tanh_bump({0, -std::cos(latitude), std::sin(latitude)}, std::numbers::pi / 6, 0.2,
                   1.0 / 4096);
}

Density named_density(const std::string& name) {
  if (name == "uniform")
    return {};
  if (name == "x8")
    return x8_density();
  throw std::invalid_argument("no density is called " + name);
}

} // namespace calotte::bench
