// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>
#include <calotte/cvt.h>
#include <calotte/generators.h>
#include <calotte/io.h>
#include <calotte/region.h>

#include "support/files.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

using namespace calotte;
using calotte::test::Scratch;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Eigen::Vector3d centre(0.6, 0, 0.8);

/// Points here and there, and a cluster of some that are nearer to each other than cells are wide.
Points3 stations(std::int64_t cells) {
  const double h = std::sqrt(4 * std::numbers::pi / static_cast<double>(cells));
  Points3 points(3, 12);
  points.leftCols(8) = random_sphere(8, circle(centre, 30 * degree), {}, 5);
  points.rightCols(4) = random_sphere(4, circle(centre, h / 2), {}, 6);
  return points;
}

template <class Points> Points joined(const Points& first, const Points& then) {
  Points all(first.rows(), first.cols() + then.cols());
  all.leftCols(first.cols()) = first;
  all.rightCols(then.cols()) = then;
  return all;
}

CvtOptions fixing(std::int64_t fixed) {
  CvtOptions options;
  options.fixed = fixed;
  return options;
}

/// Lloyd's map of generators, none of which is held.
Points3 centroids(const Points3& points, const Region& region, CvtOptions options) {
  options.fixed = options.insertion_rounds = 0;
  options.cells = options.bisections = 0;
  options.well_centred = false;
  options.method = Method::lloyd;
  options.norm = Norm::none;
  options.max_iterations = 1;
  options.rule = options.final_rule;
  return spherical_cvt(points, region, options).mesh.points;
}

/// The fixed generators keep their bits; the others are centroids within the tolerance of the run.
void check_laws(const Cvt& grid, const Points3& fixed, const Region& region,
                const CvtOptions& options) {
  const Eigen::Index f = fixed.cols(), n = grid.mesh.points.cols();
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points.leftCols(f) == fixed);
  const Points3 moved = centroids(grid.mesh.points, region, options);
  const double h = std::sqrt(area(region) / static_cast<double>(n));
  const double rms =
      std::sqrt((moved - grid.mesh.points).rightCols(n - f).squaredNorm() / static_cast<double>(n));
  CHECK(rms <= 1.5 * options.tolerance * h); // the last step goes to the centroids
}

CvtOptions graded(std::int64_t cells, std::int64_t fixed, int bisections) {
  CvtOptions options = fixing(fixed);
  options.density = tanh_bump(centre, 20 * degree, 10 * degree, 1.0 / 81);
  options.cells = cells;
  options.insertion_rounds = 1;
  options.bisections = bisections;
  options.tolerance = 1e-5;
  options.final_rule = 6;
  return options;
}

bool equal(const Cvt& a, const Cvt& b) {
  return a.mesh.points == b.mesh.points && a.mesh.triangles == b.mesh.triangles;
}

std::string message_of(const Points3& start, const Region& region, const CvtOptions& options) {
  try {
    spherical_cvt(start, region, options);
    return "";
  } catch (const Error& error) {
    return error.what() + (" @" + std::to_string(error.index()));
  }
}

} // namespace

TEST_CASE("fixed generators keep their bits, and all others are centroids") {
  const Points3 fixed = stations(400);
  for (const Region& region : {Region{}, circle(centre, 35 * degree)}) {
    const Points3 start = joined(fixed, random_sphere(388, region));
    for (const Method method : {Method::automatic, Method::lloyd, Method::nesterov}) {
      CvtOptions options = fixing(12);
      options.method = method;
      options.tolerance = 1e-4;
      options.max_iterations = 20000;
      const Cvt grid = spherical_cvt(start, region, options);
      CHECK(grid.mesh.points.cols() == 400);
      check_laws(grid, fixed, region, options);
      if (region.whole())
        CHECK(check(grid.mesh).failure == "");
    }
  }
}

TEST_CASE("fixed generators of any norm are normalised once") {
  Points3 fixed = 7.3 * stations(400);
  const Cvt once = spherical_cvt(joined(fixed, random_sphere(100, Region{})), fixing(12));
  CHECK((once.mesh.points.leftCols(12) - fixed / 7.3).cwiseAbs().maxCoeff() < 1e-15);
  fixed = once.mesh.points.leftCols(12);
  const Cvt again = spherical_cvt(once.mesh.points, fixing(12));
  CHECK(again.mesh.points.leftCols(12) == fixed);
}

TEST_CASE("fixed generators only: nothing moves") {
  const Points3 all = random_sphere(50);
  const Cvt grid = spherical_cvt(all, fixing(50));
  CHECK(grid.report.converged);
  CHECK(grid.mesh.points == all);
}

TEST_CASE("fixed generators through bisections, insertion and a finish [slow]") {
  const std::int64_t cells = 3000;
  const Points3 fixed = stations(cells);
  for (const Region& region : {Region{}, circle(centre, 35 * degree)}) {
    CvtOptions options = graded(cells, 12, 0);
    const Continuation from = multilevel(cells, region, options.density, 1, 12);
    CHECK(from.bisections > 0);
    options.bisections = from.bisections;
    const Points3 start = joined(fixed, from.start);
    const Cvt grid = spherical_cvt(start, region, options);
    CHECK(grid.mesh.points.cols() == cells);
    check_laws(grid, fixed, region, options);
    options.well_centred = true;
    options.tolerance = 3e-4;
    const Cvt finished = spherical_cvt(start, region, options);
    CHECK(finished.mesh.points.leftCols(12) == fixed);
    CHECK(finished.mesh.points.cols() == cells);
  }
}

TEST_CASE("fixed generators: the same bits for all threads and regions, and resumed [slow]") {
  const std::int64_t cells = 1200;
  const Points3 fixed = stations(cells);
  const Scratch scratch;
  for (const Region& region : {Region{}, circle(centre, 35 * degree)}) {
    CvtOptions options = graded(cells, 12, 0);
    options.well_centred = true;
    options.tolerance = 3e-4;
    const Continuation from = multilevel(cells, region, options.density, 1, 12);
    options.bisections = from.bisections;
    const Points3 start = joined(fixed, from.start);
    const auto with = [&](std::size_t threads, int regions) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      CvtOptions here = options;
      here.partition.regions = regions;
      return spherical_cvt(start, region, here);
    };
    const Cvt one = with(1, 1);
    CHECK(equal(one, with(2, 12)));
    CHECK(equal(one, with(4, 42)));
    std::vector<CvtState> states;
    spherical_cvt(start, region, options, [&](const CvtProgress& now) {
      states.push_back(now.state);
      return false;
    });
    for (std::size_t k = 5; k < states.size(); k += states.size() / 4) {
      write_checkpoint(scratch / "run.ckpt", states[k], "same");
      CHECK(equal(spherical_cvt(read_checkpoint(scratch / "run.ckpt", "same"), region, options),
                  one));
    }
  }
}

TEST_CASE("fixed generators in the plane") {
  for (const PlanarDomain& domain : {rectangle({0, 0}, {4, 3}), periodic_box({4, 3})}) {
    const Points2 fixed = random_places(9, domain, 3);
    PlanarContinuation from = multilevel(900, domain, {}, 1, 9);
    CvtOptions options = fixing(9);
    options.insertion_rounds = 1;
    options.cells = 900;
    options.bisections = from.bisections;
    options.tolerance = 1e-4;
    const PlanarCvt grid = planar_cvt(joined(fixed, from.start), domain, options);
    CHECK(grid.report.converged);
    CHECK(grid.mesh.points.cols() == 900);
    CHECK(grid.mesh.points.leftCols(9) == fixed);
    CvtOptions once;
    once.method = Method::lloyd;
    once.norm = Norm::none;
    once.max_iterations = 1;
    Points2 apart = planar_cvt(grid.mesh.points, domain, once).mesh.points - grid.mesh.points;
    for (int k = 0; k < 2 && domain.periodic(); ++k)
      apart.row(k) = apart.row(k).unaryExpr(
          [&](double d) { return d - domain.period[k] * std::round(d / domain.period[k]); });
    CHECK(apart.rightCols(891).norm() <= 1.5 * options.tolerance * std::sqrt(12.0));
  }
}

TEST_CASE("fixed generators: bad input is one clear line with the index") {
  const Region region = circle(centre, 35 * degree);
  Points3 start = random_sphere(60, region);
  CHECK(message_of(start, region, fixing(61)) ==
        "fixed is 61; give 0 to 60, the number of generators of the start @-1");
  CHECK(message_of(start, region, fixing(-1)).find("fixed is -1; give 0 to 60") == 0);
  CvtOptions few = fixing(20);
  few.insertion_rounds = 1;
  few.cells = 15;
  CHECK(message_of(start, region, few).find("fixed generator 15 is beyond the 15 cells") == 0);
  start.col(7) = 2 * start.col(3);
  for (const Region& place : {region, Region{}})
    CHECK(message_of(start, place, fixing(10)) ==
          "fixed generator 7 merges with fixed generator 3: give it once @7");
  CHECK(message_of(start, region, fixing(7)) == ""); // a free one merges with a fixed one
  start.col(4) = -centre;
  CHECK(message_of(start, region, fixing(10)).find("fixed generator 4 is outside the region") == 0);
  CHECK(message_of(start, region, fixing(2)).find("generator 4 is outside the region") == 0);
  CHECK_THROWS_AS(multilevel(100, Density{}, 1, 100), Error);
  CHECK_THROWS_AS(multilevel(100, Density{}, 1, -1), Error);
}
