// SPDX-License-Identifier: GPL-3.0-or-later
#include "clouds.h"

#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <stdexcept>

namespace calotte::bench {

namespace {

Points3 shuffled(Points3 points) {
  std::mt19937_64 engine(20130923);
  for (Eigen::Index i = points.cols() - 1; i > 0; --i) {
    const auto j = static_cast<Eigen::Index>(engine() % static_cast<std::uint64_t>(i + 1));
    points.col(i).swap(points.col(j));
  }
  return points;
}

Points3 nearest_bisection(std::int64_t n) {
  const auto nearest = std::min_element(
      bisected_sizes().begin(), bisected_sizes().end(),
      [n](std::int64_t a, std::int64_t b) { return std::abs(a - n) < std::abs(b - n); });
  return shuffled(bisected_icosahedron(bisection_level(*nearest)));
}

Points3 plane_cloud(const std::string& set, std::int64_t n) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  Points2 centres(2, 20);
  for (double& x : centres.reshaped())
    x = unit(engine);
  Points2 points(2, n);
  for (auto point : points.colwise()) {
    if (set == "uniform")
      point << unit(engine), unit(engine);
    else if (set == "line")
      point << unit(engine), 1e-6 * normal(engine);
    else
      point = centres.col(static_cast<Eigen::Index>(engine() % 20)) +
              0.01 * Eigen::Vector2d(normal(engine), normal(engine));
  }
  Points3 result = Points3::Zero(3, n);
  result.topRows<2>() = points;
  return result;
}

} // namespace

const std::vector<std::string>& cloud_names() {
  static const std::vector<std::string> names = {"random", "bisection", "uniform", "clusters",
                                                 "line"};
  return names;
}

bool in_plane(const std::string& set) { return set != "random" && set != "bisection"; }

Points3 cloud(const std::string& set, std::int64_t n) {
  if (in_plane(set))
    return plane_cloud(set, n);
  return set == "random" ? random_sphere(n, 20130923) : nearest_bisection(n);
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

int bisection_level(std::int64_t n) {
  const auto at = std::find(bisected_sizes().begin(), bisected_sizes().end(), n);
  if (at == bisected_sizes().end())
    throw std::invalid_argument(
        "bisected icosahedra have 42, 162 ... 10 * 4^level + 2 points, not " + std::to_string(n));
  return static_cast<int>(at - bisected_sizes().begin()) + 1;
}

Points3 natural_bisection(std::int64_t n) {
  Points3 points = bisected_icosahedron(bisection_level(n));
  const Eigen::Vector3d normal =
      Eigen::Vector3d(points.col(0)).cross(Eigen::Vector3d(points.col(1)));
  Eigen::Index third = 2;
  while (std::abs(normal.dot(points.col(third))) < 0.1)
    ++third;
  points.col(2).swap(points.col(third));
  return points;
}

Density named_density(const std::string& set) {
  if (set == "uniform")
    return {};
  const double latitude = std::numbers::pi / 6; // and longitude 270 degrees
  return tanh_bump({0, -std::cos(latitude), std::sin(latitude)}, std::numbers::pi / 6, 0.2,
                   1.0 / 4096);
}

} // namespace calotte::bench
