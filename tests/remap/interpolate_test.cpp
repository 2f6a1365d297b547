// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/remap.h>
#include <calotte/voronoi.h>

#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/joined.h"
#include "support/parts.h"
#include "support/random.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

constexpr Interpolation natural = Interpolation::natural_neighbours;

Eigen::VectorXd dense_row(const Weights& weights, std::int64_t i) {
  return Eigen::MatrixXd(weights).row(i);
}

/// By the definition: what each cell loses when the position becomes a site.
Eigen::VectorXd stolen(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  const Eigen::Index n = before.size();
  return (before - after.head(n)) / after[n];
}

/// Weights of both kinds: >= 0, and their sum is 1.
void check_rows(const Mesh& mesh, const Points3& at) {
  for (const Interpolation kind : {Interpolation::linear, natural}) {
    const Weights weights = interpolation_weights(mesh, at, kind);
    REQUIRE(weights.rows() == at.cols());
    REQUIRE(weights.cols() == mesh.points.cols());
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      double sum = 0;
      for (Weights::InnerIterator entry(weights, i); entry; ++entry) {
        CHECK(entry.value() >= 0);
        sum += entry.value();
      }
      CHECK((sum == 0 || std::abs(sum - 1) < 1e-12));
    }
    const Weights at_sites = interpolation_weights(mesh, mesh.points, kind);
    CHECK((Eigen::MatrixXd(at_sites) -
           Eigen::MatrixXd::Identity(mesh.points.cols(), mesh.points.cols()))
              .cwiseAbs()
              .maxCoeff() < 1e-15);
  }
}

} // namespace

TEST_CASE("natural neighbours on the sphere have what the cells lose") {
  for (const Points3& points : {random_sphere(150), fibonacci_sphere(120), cubed_sphere(4),
                                lat_lon_sphere(6, 12, true), bisected_icosahedron(2)}) {
    const Mesh mesh = delaunay(points);
    const Eigen::VectorXd before = voronoi(mesh).cell_area;
    const Points3 at = random_sphere(60, 11);
    check_rows(mesh, at);
    const Weights weights = interpolation_weights(mesh, at, natural);
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      const Eigen::VectorXd after = voronoi(delaunay(joined(mesh.points, at.col(i)))).cell_area;
      CHECK((dense_row(weights, i) - stolen(before, after)).cwiseAbs().maxCoeff() < 1e-9);
    }
  }
}

TEST_CASE("natural neighbours in a periodic box have what the cells lose") {
  const Surface box = Surface::periodic({4, 3});
  for (const Points3& points : {random_points(120, box), hexagonal_lattice(100, box)}) {
    const Mesh mesh = delaunay(points, box);
    const Eigen::VectorXd before = voronoi(mesh).cell_area;
    const Points3 at = random_points(60, rectangle({-1, -1}, {6, 5}), {}, 5);
    check_rows(mesh, at);
    const Weights weights = interpolation_weights(mesh, at, natural);
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      const Eigen::Vector3d home(at(0, i) - 4 * std::floor(at(0, i) / 4),
                                 at(1, i) - 3 * std::floor(at(1, i) / 3), 0);
      const Eigen::VectorXd after = voronoi(delaunay(joined(mesh.points, home), box)).cell_area;
      CHECK((dense_row(weights, i) - stolen(before, after)).cwiseAbs().maxCoeff() < 1e-9);
    }
  }
}

TEST_CASE("in the plane both kinds are exact for linear functions, and say nothing outside") {
  Points3 lattice(3, 36);
  for (int k = 0; k < 36; ++k)
    lattice.col(k) << (k % 6) / 5.0, (k / 6) / 5.0, 0;
  for (const Points3& points : {random_points(300, rectangle({0, 0}, {1, 1})), lattice}) {
    const Mesh mesh = delaunay(points, Surface::plane());
    Points3 at(3, 500);
    at << random_points(400, rectangle({-0.2, -0.2}, {1.2, 1.2}), {}, 2),
        (points.leftCols(36).replicate(1, 3).leftCols(100) +
         points.rightCols(36).replicate(1, 3).rightCols(100)) /
            2; // of a lattice on edges and sites
    check_rows(mesh, at);
    const Eigen::VectorXd linear = (3 * points.row(0) - points.row(1)).transpose().array() + 0.5;
    const Eigen::VectorXd one = interpolate(interpolation_weights(mesh, at), linear),
                          two = interpolate(interpolation_weights(mesh, at, natural), linear);
    std::int64_t outside = 0;
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      CHECK(std::isnan(one[i]) == std::isnan(two[i]));
      outside += std::isnan(one[i]) ? 1 : 0;
      if (std::isnan(one[i]))
        continue;
      const double right = 3 * at(0, i) - at(1, i) + 0.5;
      CHECK(std::abs(one[i] - right) < 1e-12);
      CHECK(std::abs(two[i] - right) < 1e-9);
    }
    CHECK(outside > 100);
  }
}

TEST_CASE("errors of a smooth function fall with the square of the spacing") {
  const Points3 at = random_sphere(4000, 3);
  const auto smooth = [](const Points3& x) -> Eigen::VectorXd {
    return (x.row(0).array() * x.row(1).array() + x.row(2).array().cube()).transpose();
  };
  const auto error = [&](std::int64_t sites, Interpolation kind) {
    const Mesh mesh = delaunay(random_sphere(sites));
    return (interpolate(interpolation_weights(mesh, at, kind), smooth(mesh.points)) - smooth(at))
        .norm();
  };
  for (const Interpolation kind : {Interpolation::linear, natural})
    CHECK(error(2000, kind) > 6 * error(16000, kind)); // 8, but for chance
}

TEST_CASE("weights near a site are near that of the site, down to the last bit") {
  Random random(5);
  for (const Points3& points :
       {random_sphere(400, 3), bisected_icosahedron(3), fibonacci_sphere(5000)}) {
    const Mesh mesh = delaunay(points);
    Eigen::VectorXd gap = Eigen::VectorXd::Constant(mesh.points.cols(), 2); // to the nearest site
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
      for (int v = 0; v < 3; ++v) {
        const std::int32_t a = mesh.triangles(v, t), b = mesh.triangles((v + 1) % 3, t);
        gap[a] = std::min(gap[a], (mesh.points.col(a) - mesh.points.col(b)).norm());
      }
    for (int exponent = -17; exponent <= -5; ++exponent) {
      Points3 at = mesh.points;
      for (Eigen::Index i = 0; i < at.cols(); ++i) {
        const auto way = random.direction();
        at.col(i) += std::pow(10, exponent) * Eigen::Vector3d(way.x, way.y, way.z);
        if (i % 2 == 0)
          at.col(i).normalize();
      }
      CAPTURE(exponent);
      const double away = std::pow(10, exponent) + 3e-16;
      for (const Interpolation kind : {Interpolation::linear, natural}) {
        const Weights weights = interpolation_weights(mesh, at, kind);
        double worst = 0;
        for (Eigen::Index i = 0; i < at.cols(); ++i)
          worst = std::max(worst, (1 - weights.coeff(i, i)) * gap[i] / away);
        CHECK(worst < 30);
      }
    }
  }
}

TEST_CASE("positions that are outside of an open mesh by rounding alone have its values") {
  const Mesh whole = delaunay(fibonacci_sphere(3000));
  const Mesh part = part_of(whole, [&](Eigen::Index t) {
    return std::sin(9 * whole.points(0, whole.triangles(0, t))) < 0.3;
  });
  std::vector<bool> has_triangle(static_cast<std::size_t>(part.points.cols()));
  for (const std::int32_t site : part.triangles.reshaped())
    has_triangle[static_cast<std::size_t>(site)] = true;
  CHECK(std::count(has_triangle.begin(), has_triangle.end(), false) > 10);
  for (const double radius : {1.0, 6371220.0, 6371229.0, 0.3}) {
    const Points3 scaled = radius * part.points;
    for (const Interpolation kind : {Interpolation::linear, natural, Interpolation::nearest}) {
      const Weights at_sites = interpolation_weights(part, scaled, kind);
      for (Eigen::Index i = 0; i < at_sites.rows(); ++i)
        REQUIRE(at_sites.coeff(i, i) == doctest::Approx(1).epsilon(1e-11));
    }
  }
  // In the middle of open edges.
  std::vector<Eigen::Vector3d> middles;
  std::vector<std::array<std::int32_t, 2>> ends;
  for (Eigen::Index t = 0; t < part.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (part.neighbours(v, t) < 0) {
        ends.push_back({part.triangles((v + 1) % 3, t), part.triangles((v + 2) % 3, t)});
        middles.emplace_back(
            (part.points.col(ends.back()[0]) + part.points.col(ends.back()[1])).normalized());
      }
  Points3 at(3, std::ssize(middles));
  for (Eigen::Index i = 0; i < at.cols(); ++i)
    at.col(i) = middles[static_cast<std::size_t>(i)];
  for (const Interpolation kind : {Interpolation::linear, natural}) {
    const Weights weights = interpolation_weights(part, at, kind);
    for (Eigen::Index i = 0; i < at.cols(); ++i)
      for (const std::int32_t end : ends[static_cast<std::size_t>(i)])
        REQUIRE(weights.coeff(i, end) == doctest::Approx(0.5).epsilon(1e-9));
  }
}

TEST_CASE("weights are the same for any number of threads") {
  const Mesh mesh = delaunay(random_sphere(5000));
  const Points3 at = random_sphere(8000, 9);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return interpolation_weights(mesh, at, natural);
  };
  const Weights one = with(1), four = with(4);
  REQUIRE(one.nonZeros() == four.nonZeros());
  CHECK(std::equal(one.valuePtr(), one.valuePtr() + one.nonZeros(), four.valuePtr()));
  CHECK_THROWS_WITH_AS(interpolate(one, Eigen::VectorXd::Zero(7)),
                       "there are 7 values for 5000 sites; give one for each", Error);
}
