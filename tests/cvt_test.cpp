// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>

#include "repair.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace calotte;
using namespace calotte::detail;

namespace {

constexpr double pi = std::numbers::pi;

/// The paper's x8 bump (Sect. 4.3).
Density x8() {
  return tanh_bump({0, -std::cos(pi / 6), std::sin(pi / 6)}, pi / 6, 0.2, 1.0 / 4096);
}

/// Lloyd's steps lower the energy; round-off leaves some 1e-14 of it.
void check_descent(const CvtReport& report) {
  for (std::size_t k = 1; k < report.iterations.size(); ++k)
    CHECK(report.iterations[k].energy <= report.iterations[k - 1].energy * (1 + 1e-13));
}

/// Triangles of a mesh from their lowest vertex on, as a set.
std::set<std::array<std::int32_t, 3>> triangles_of(const Mesh& mesh) {
  std::set<std::array<std::int32_t, 3>> out;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    std::array<std::int32_t, 3> v{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    out.insert(v);
  }
  return out;
}

} // namespace

TEST_CASE("uniform bisected grids converge to the known optimum without a flip") {
  CvtOptions options;
  options.tolerance = 1e-8;
  options.max_iterations = 3000;
  const std::array<double, 2> energies{25.44900, 25.44443}; // E n for n = 2562 and 10 242
  for (const int level : {4, 5}) {
    const Cvt grid = cvt(bisected_icosahedron(level), options);
    const auto n = static_cast<double>(grid.mesh.points.cols());
    CHECK(grid.report.converged);
    CHECK(grid.report.iterations.back().energy * n ==
          doctest::Approx(energies[static_cast<std::size_t>(level - 4)]).epsilon(1e-6));
    for (const CvtIteration& iteration : grid.report.iterations)
      CHECK(iteration.flips + iteration.rebuilt == 0);
    check_descent(grid.report);
    CHECK(check(grid.mesh).failure == "");
  }
}

TEST_CASE("random starts: the energy falls, every law holds, and the threads do not show") {
  for (const Density& density : {Density{}, x8()}) {
    CvtOptions options;
    options.density = density;
    options.max_iterations = 60;
    const auto with = [&](std::size_t threads) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return cvt(random_sphere(20000, 4), options);
    };
    const Cvt one = with(1), four = with(4);
    CHECK(one.mesh.points == four.mesh.points);
    CHECK(one.mesh.triangles == four.mesh.triangles);
    for (std::size_t k = 0; k < one.report.iterations.size(); ++k)
      CHECK(one.report.iterations[k].energy == four.report.iterations[k].energy);
    check_descent(one.report);
    CHECK(!one.report.converged);
    CHECK(one.report.iterations.size() == 60);
    CHECK(check(one.mesh).failure == "");
  }
}

TEST_CASE("generators stay in the order of the start") {
  const Points3 start = bisected_icosahedron(3);
  CvtOptions options;
  options.max_iterations = 20;
  const Cvt grid = cvt(start, options);
  CHECK((grid.mesh.points - start).colwise().norm().maxCoeff() < 0.05);
}

TEST_CASE("repair finds the Delaunay triangulation of moved points, by flips or anew") {
  for (const double amount : {0.0, 0.02, 0.2, 1.0}) { // of the spacing
    Mesh mesh = delaunay(bisected_icosahedron(4));
    const double h = std::sqrt(4 * pi / static_cast<double>(mesh.points.cols()));
    mesh.points += amount * h * random_sphere(mesh.points.cols(), 7);
    mesh.points.colwise().normalize();
    Stars stars = make_stars(mesh);
    Pulls pulls = edge_pulls(mesh);
    const Repair repaired = repair(mesh, stars, pulls);
    CAPTURE(amount);
    CHECK((repaired.flips > 0) == (amount == 0.2));
    CHECK(repaired.rebuilt == (amount == 1.0));
    CHECK(triangles_of(mesh) == triangles_of(delaunay(mesh.points)));
    const Stars again = make_stars(mesh);
    CHECK(std::equal(stars.corners.begin(), stars.corners.end(), again.corners.begin()));
  }
}

TEST_CASE("the tanh bump spreads spacings by the fourth root of its contrast [slow]") {
  CvtOptions options;
  options.density = x8();
  options.max_iterations = 1500;
  options.tolerance = 1e-5;
  const Cvt grid = cvt(bisected_icosahedron(4), options);
  check_descent(grid.report);
  double shortest = 4, longest = 0;
  for (Eigen::Index t = 0; t < grid.mesh.triangles.cols(); ++t)
    for (int e = 0; e < 3; ++e) {
      const double side = (grid.mesh.points.col(grid.mesh.triangles(e, t)) -
                           grid.mesh.points.col(grid.mesh.triangles((e + 1) % 3, t)))
                              .norm();
      shortest = std::min(shortest, side);
      longest = std::max(longest, side);
    }
  CHECK(longest / shortest > 6);
  CHECK(longest / shortest < 14);
}

TEST_CASE("bad input is refused in one line") {
  const Points3 start = random_sphere(100);
  const auto code = [&](const Points3& points, const CvtOptions& options) {
    try {
      cvt(points, options);
    } catch (const Error& e) {
      return e.code();
    }
    return ErrorCode::internal;
  };
  CvtOptions options;
  CHECK(code(random_sphere(11), options) == ErrorCode::too_few_sites);
  Points3 half = start;
  half.row(2) = half.row(2).cwiseAbs();
  CHECK(code(half, options) == ErrorCode::bad_option);
  options.tolerance = 0;
  CHECK(code(start, options) == ErrorCode::bad_option);
  options = {};
  options.rule = 5;
  CHECK(code(start, options) == ErrorCode::bad_option);
  options = {};
  options.density = tanh_bump({0, 0, 1}, 0.5, 0.2, 0);
  CHECK(code(start, options) == ErrorCode::bad_option);
  options.density.kind = Density::Kind::callable;
  options.density.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setZero();
  };
  CHECK(code(start, options) == ErrorCode::bad_option);
  options.density.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setConstant(-1);
  };
  CHECK(code(start, options) == ErrorCode::bad_option);
  options.density.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setConstant(std::nan(""));
  };
  CHECK(code(start, options) == ErrorCode::bad_option);
}
