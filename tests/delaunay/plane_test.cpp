// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/cgal_triangles.h"
#include "delaunay/delaunay.h"
#include "delaunay/plane_chart.h"
#include "delaunay/settings.h"
#include "domain/surface.h"
#include "support/errors.h"
#include "support/joined.h"
#include "support/laws.h"
#include "support/plane_laws.h"
#include "support/random.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <doctest/doctest.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using domain_detail::UncheckedSurface;

namespace {

struct PlaneCloud {
  std::string name;
  Points2 points;
  bool degenerate = false; ///< four on a circle
};

Points2 random_box(int n, double width, double height, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Points2 points(2, n);
  for (int i = 0; i < n; ++i) {
    points(0, i) = width * unit(engine);
    points(1, i) = height * unit(engine);
  }
  return points;
}

/// A lattice of these two steps.
Points2 lattice(int columns, int rows, const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  Points2 points(2, columns * rows);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      points.col(r * columns + c) = c * u + r * v;
  return points;
}

Points2 points_on_circle(int n, double radius) {
  Points2 points(2, n);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    points.col(i) << radius * std::cos(angle), radius * std::sin(angle);
  }
  return points;
}

/// A parabola so flat that its sites are collinear up to rounding, below a scatter.
Points2 flat_hull(int n, std::uint64_t seed) {
  Points2 points = random_box(2 * n, 1, 1, seed);
  for (int i = 0; i < n; ++i) {
    const double x = points(0, i) - 0.5;
    points(1, i) = -1 + 1e-13 * x * x;
  }
  return points;
}

std::vector<PlaneCloud> clouds() {
  const double s = std::sin(0.3), c = std::cos(0.3), half = 0.5;
  std::vector<PlaneCloud> out;
  out.push_back({"3 sites", random_box(3, 1, 1, 1)});
  out.push_back({"4 sites of a square", lattice(2, 2, {1, 0}, {0, 1}), true});
  out.push_back({"10 random", random_box(10, 1, 1, 2)});
  out.push_back({"2000 random", random_box(2000, 1, 1, 3)});
  out.push_back({"a long box", random_box(2000, 1000, 1, 4)});
  out.push_back({"a narrow box", random_box(2000, 1, 1e-6, 16)});
  out.push_back({"a narrow upright box", random_box(2000, 1e-6, 1, 17)});
  out.push_back({"square lattice", lattice(40, 30, {1, 0}, {0, 1}), true});
  out.push_back(
      {"hexagonal lattice", lattice(30, 30, {1, 0}, {half, half * std::sqrt(3.0)}), true});
  out.push_back({"tilted lattice", lattice(30, 30, {c, s}, {-s, c}), true});
  out.push_back({"integer tilted lattice", lattice(30, 30, {5, 2}, {-2, 5}), true});
  out.push_back({"circle", points_on_circle(200, 1), true});
  out.push_back({"circle and centre", joined(points_on_circle(64, 1), Points2::Zero(2, 1)), true});
  out.push_back({"flat hull", flat_hull(300, 5)});
  out.push_back({"two clusters",
                 joined(random_box(300, 1e-9, 1e-9, 6),
                        random_box(300, 1e-9, 1e-9, 7).colwise() + Eigen::Vector2d(1, 0.5)),
                 true});
  out.push_back({"a cluster far off",
                 (random_box(500, 1e-6, 1e-6, 8).colwise() + Eigen::Vector2d(1e6, -3e5)), true});
  out.push_back({"tiny scale", 1e-150 * random_box(500, 1, 1, 9)});
  out.push_back({"huge scale", 1e150 * random_box(500, 1, 1, 10)});
  out.push_back(
      {"all scales", joined(1e-150 * random_box(50, 1, 1, 11),
                            joined(random_box(50, 1, 1, 12), 1e150 * random_box(50, 1, 1, 13)))});
  Points2 hostile(2, 5); // products of small differences leave the doubles' range
  hostile << -2.5781250000000002e+299, -2.5781250000000001e+99, -3.0468750000000001e+299,
      -4.0625000000000004e+299, -3.0468749999999999e+99, -4.3749999999999999e+299,
      -4.3749999999999997e+99, -4.0625000000000004e+299, 3.0468750000000001e+299, -4.0625e+99;
  out.push_back({"two scales at 1e299", hostile});
  out.push_back({"a cluster that the frame does not resolve",
                 joined(1e-19 * lattice(10, 10, {c, s}, {-s, c}),
                        random_box(20, 0.4, 0.4, 14).colwise() + Eigen::Vector2d(0.6, 0.6)),
                 true});
  Points2 far = 1e-7 * random_box(500, 1, 1, 15);
  far.colwise() += Eigen::Vector2d(1e6, -3e5);
  out.push_back({"a cluster of few digits far off", far, true});
  Points2 line = lattice(400, 1, {1, 1}, {0, 0});
  out.push_back({"a line and a site", joined(line, Eigen::Vector2d(3, -70)), true});
  out.push_back(
      {"a line and two sites",
       joined(line, lattice(2, 1, {200, -100}, {0, 0}).colwise() + Eigen::Vector2d(3, 170)), true});
  return out;
}

std::vector<Triple> triangles_of(const Mesh& mesh) {
  std::vector<Triple> out;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
    out.push_back(triple(mesh, t));
  std::sort(out.begin(), out.end());
  return out;
}

} // namespace

TEST_CASE("a planar triangulation is exact and whole") {
  for (const PlaneCloud& cloud : clouds()) {
    CAPTURE(cloud.name);
    const Mesh mesh = delaunay(cloud.points, Surface::plane(), with_regions(9));
    plane_laws::require_exact(mesh);
    plane_laws::require_whole(mesh);
    if (!cloud.degenerate)
      CHECK(triangles_of(mesh) == cgal_triangles(cloud.points));
  }
}

TEST_CASE("in-circle signs are exact for any sizes of triangle and offset") {
  // Sites of one set are near each other or far, on circles or not; three of them form the
  // triangle.
  Points2 sizes = random_box(40, 1, 1, 18);
  for (const double size : {1e-3, 1e-6, 1e-9, 1e-13}) {
    sizes = joined(sizes, random_box(40, size, size, 19));
    sizes = joined(sizes, points_on_circle(40, size));
  }
  for (const Points2& points : {sizes, random_box(400, 1, 1e-6, 20), Points2(1e-150 * sizes)}) {
    const delaunay_detail::Sites sites =
        delaunay_detail::make_planar_sites(points, Duplicates::merge, 0);
    delaunay_detail::PlaneChart plane(sites);
    std::mt19937_64 engine(21);
    std::uniform_int_distribution<std::int64_t> any(0, sites.size() - 1), near(0, 40);
    std::int64_t wrong = 0, decided = 0;
    for (int trial = 0; trial < 200000; ++trial) {
      const std::int64_t r = any(engine);
      std::array<std::int64_t, 4> rank{r, 0, 0, 0};
      for (std::size_t i = 1; i < 4; ++i)
        rank[i] = engine() % 4 == 0 ? any(engine) : std::min(r + near(engine), sites.size() - 1);
      std::array<delaunay_detail::PlaneChart::Point, 4> p;
      std::array<exact_detail::Vec2, 4> x;
      for (std::size_t i = 0; i < 4; ++i) {
        p[i] = plane.point(rank[i]);
        const base_detail::Vec3& given = sites.given(p[i].site);
        x[i] = {given.x, given.y};
      }
      if (exact_detail::orientation(x[0], x[1], x[2]) <= 0)
        continue;
      const int exact = exact_detail::in_circle(x[0], x[1], x[2], x[3]);
      if (exact == 0) // a tie, or a corner
        continue;
      ++decided;
      wrong += plane.in_circle(delaunay_detail::PlaneChart::circle(p[0], p[1], p[2]), p[0], p[1],
                               p[2], p[3]) != exact;
    }
    CHECK(wrong == 0);
    CHECK(decided > 50000);
  }
}

TEST_CASE("any regions, sorts, centres and threads give the same planar mesh") {
  for (const PlaneCloud& cloud : clouds()) {
    CAPTURE(cloud.name);
    const Mesh mesh = delaunay(cloud.points, Surface::plane(), with_regions(1));
    for (const int regions : {2, 9, 64, 200})
      for (const int threads : {1, 2, 4}) {
        CAPTURE(regions);
        CAPTURE(threads);
        const auto again = with_threads(threads, [&] {
          return delaunay(cloud.points, Surface::plane(), with_regions(regions));
        });
        CHECK(identical(again, mesh));
      }
    for (const RegionOverlap overlap : {RegionOverlap::distance, RegionOverlap::voronoi})
      CHECK(identical(delaunay(cloud.points, Surface::plane(), with_regions(12, overlap)), mesh));
    CHECK(identical(delaunay(cloud.points, Surface::plane(),
                             with_regions(12, RegionOverlap::halo, RegionCentres::fibonacci)),
                    mesh));
    DelaunayOptions options;
    options.decomposition.given_centres = Points3(3, 3);
    *options.decomposition.given_centres << cloud.points.leftCols(3), 7, 8, 9;
    CHECK(identical(delaunay(cloud.points, Surface::plane(), options), mesh));
    const double beyond = 20 * cloud.points.cwiseAbs().maxCoeff(); // all far outside
    *options.decomposition.given_centres << beyond, beyond, beyond / 2, beyond, beyond / 2, beyond,
        0, 0, 0;
    CHECK(identical(delaunay(cloud.points, Surface::plane(), options), mesh));
  }
}

TEST_CASE("a permuted planar input permutes the ids") {
  for (const PlaneCloud& cloud : clouds()) {
    CAPTURE(cloud.name);
    std::vector<std::int32_t> order(static_cast<std::size_t>(cloud.points.cols()));
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = static_cast<std::int32_t>(i);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(17));
    Points2 shuffled(2, cloud.points.cols());
    for (std::size_t i = 0; i < order.size(); ++i)
      shuffled.col(static_cast<Eigen::Index>(i)) = cloud.points.col(order[i]);
    std::vector<Triple> named;
    for (Triple t : triangles_of(delaunay(shuffled, Surface::plane(), with_regions(7)))) {
      for (std::int32_t& id : t)
        id = order[static_cast<std::size_t>(id)];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      named.push_back(t);
    }
    std::sort(named.begin(), named.end());
    CHECK(named == triangles_of(delaunay(cloud.points, Surface::plane(), with_regions(7))));
  }
}

TEST_CASE("regions are used, and certified by cull") {
  const Points2 points = random_box(30000, 1, 1, 21);
  const auto [mesh, report] = triangulate(points, Surface::plane(), with_regions(12));
  CHECK_FALSE(report.serial);
  CHECK(report.regions == 12);
  CHECK(report.overlap < 1.3);
  CHECK(report.certified_by_cull > 50 * report.certified_by_query);
  CHECK(identical(mesh, delaunay(points, Surface::plane(), with_regions(1))));
}

TEST_CASE("duplicates in the plane are merged, or refused by name") {
  Points2 points = joined(random_box(100, 1, 1, 22), random_box(50, 1, 1, 22));
  const auto [mesh, report] = triangulate(points, Surface::plane());
  CHECK(report.duplicates == 50);
  CHECK(mesh.points.cols() == 100);
  for (std::size_t i = 100; i < 150; ++i)
    CHECK(mesh.site_of_input[i] == static_cast<std::int32_t>(i - 100));
  DelaunayOptions refuse;
  refuse.duplicates = Duplicates::refuse;
  const Error error = test::error_of([&] { delaunay(points, Surface::plane(), refuse); });
  CHECK(error.code() == ErrorCode::duplicate);
  CHECK(error.index() == 100);
  DelaunayOptions near;
  near.merge_within = 0.05;
  const Mesh merged = delaunay(points, Surface::plane(), near);
  CHECK(merged.points.cols() < 100);
  for (Eigen::Index i = 0; i < merged.points.cols(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      CHECK((merged.points.col(i) - merged.points.col(j)).norm() > 0.0499999);
}

TEST_CASE("places are merged by their own distance in any frame") {
  Points2 points(2, 5);
  points << 0, 1e-20, 1, 0.3, 1.7e308, 0, 0, 0, 1, 0;
  DelaunayOptions near;
  near.merge_within = 1e-300;
  CHECK(delaunay(points, Surface::plane(), near).points.cols() == 5);
  near.merge_within = 1e-10;
  CHECK(delaunay(points, Surface::plane(), near).points.cols() == 4);
}

TEST_CASE("bad planar input ends in a typed error") {
  const auto code_of = [](const Points2& points) {
    const Error error =
        test::error_of([&] { delaunay(points, Surface::plane(), with_regions(3)); });
    return std::pair(error.code(), error.index());
  };
  using Found = std::pair<ErrorCode, std::int64_t>;
  CHECK(code_of(Points2(2, 0)) == Found(ErrorCode::too_few_sites, -1));
  CHECK(code_of(random_box(2, 1, 1, 1)) == Found(ErrorCode::too_few_sites, -1));
  CHECK(code_of(Points2::Zero(2, 9)) == Found(ErrorCode::too_few_sites, -1));
  CHECK(code_of(lattice(100, 1, {1, 2}, {0, 0})) == Found(ErrorCode::degenerate, -1));
  CHECK(code_of(lattice(100, 1, {1e-300, 2e-300}, {0, 0})) == Found(ErrorCode::degenerate, -1));
  Points2 bad = random_box(100, 1, 1, 1);
  bad(1, 40) = std::numeric_limits<double>::quiet_NaN();
  CHECK(code_of(bad) == Found(ErrorCode::not_finite, 40));
  bad(0, 7) = std::numeric_limits<double>::infinity();
  CHECK(code_of(bad) == Found(ErrorCode::not_finite, 7));
}

// ---- Periodic boxes

namespace {

/// The site's image nearest to another place.
Eigen::Vector2d nearest_image(const Eigen::Vector2d& p, const Eigen::Vector2d& to,
                              const Eigen::Vector2d& period) {
  return p.array() - period.array() * ((p - to).array() / period.array()).round();
}

/// Every triangle is counter-clockwise, and each convex quadrilateral has the Delaunay diagonal, in
/// doubles with a margin for rounding; 2n triangles tile the box, and no edge is open.
void require_periodic(const Mesh& mesh) {
  const Eigen::Vector2d& period = mesh.surface.period();
  const auto corner = [&](std::int64_t t, int v, const Eigen::Vector2d& to) {
    return nearest_image(mesh.points.col(mesh.triangles(v, t)).head<2>(), to, period);
  };
  REQUIRE(mesh.triangles.cols() == 2 * mesh.points.cols());
  if (period.maxCoeff() < 1e-9 || period.maxCoeff() > 1e9)
    return; // squares would leave the doubles' range
  double area = 0;
  for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector2d a = mesh.points.col(mesh.triangles(0, t)).head<2>(), b = corner(t, 1, a),
                          c = corner(t, 2, a);
    const Eigen::Vector2d p = b - a, q = c - a;
    const double twice = p.x() * q.y() - p.y() * q.x();
    if (std::abs(twice) < 1e-15) // beyond the precision of these doubles for a copy
      continue;
    REQUIRE(twice > 0);
    area += twice / 2;
    const Eigen::Vector2d across = p.squaredNorm() * q - q.squaredNorm() * p;
    const Eigen::Vector2d offset = Eigen::Vector2d(across.y(), -across.x()) / (2 * twice);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t other = mesh.neighbours(i, t);
      REQUIRE(other >= 0);
      const auto back = mesh.neighbours.col(other);
      const int j = back(0) == t ? 0 : back(1) == t ? 1 : 2;
      REQUIRE(back(j) == t);
      const Eigen::Vector2d d = corner(other, j, a + offset);
      REQUIRE((d - a - offset).norm() > offset.norm() * (1 - 1e-12) - 1e-15);
    }
  }
  CHECK(area == doctest::Approx(period.prod()).epsilon(1e-12));
}

std::vector<std::pair<Points2, Eigen::Vector2d>> boxes() {
  std::vector<std::pair<Points2, Eigen::Vector2d>> out;
  out.emplace_back(random_box(40, 1, 1, 31), Eigen::Vector2d(1, 1));
  out.emplace_back(random_box(3000, 2, 0.5, 32), Eigen::Vector2d(2, 0.5));
  out.emplace_back(lattice(16, 12, {1, 0}, {0, 1}), Eigen::Vector2d(16, 12));
  out.emplace_back(lattice(15, 18, {0.1, 0}, {0, 0.1}), Eigen::Vector2d(1.5, 1.8));
  out.emplace_back(joined(random_box(2000, 1, 1, 33), random_box(500, 1e-8, 1e-8, 34)),
                   Eigen::Vector2d(1, 1));
  Points2 twins(2, 2); // equal places, because their copies coincide
  twins << 0, 1e-17, 0.5, 0.5;
  out.emplace_back(joined(random_box(998, 1, 1, 39), twins), Eigen::Vector2d(1, 1));
  out.emplace_back(1e-200 * random_box(1000, 1, 1, 40), Eigen::Vector2d(1e-200, 1e-200));
  out.emplace_back(1e200 * random_box(1000, 1, 2, 41), Eigen::Vector2d(1e200, 2e200));
  return out;
}

} // namespace

TEST_CASE("a periodic box is tiled by the same triangles for any regions") {
  for (const auto& [points, period] : boxes()) {
    CAPTURE(points.cols());
    const Surface box = UncheckedSurface::of_plane({}, period); // of any size
    const Mesh mesh = delaunay(points, box, with_regions(1));
    require_periodic(mesh);
    for (const int regions : {2, 9, 64})
      CHECK(identical(delaunay(points, box, with_regions(regions)), mesh));
  }
}

TEST_CASE("a periodic box has the triangles of CGAL's periodic triangulation") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Points2 points = random_box(3000, 1, 1, seed);
    const Mesh mesh = delaunay(points, Surface::periodic({1, 1}));
    CHECK(mesh.triangles.cols() == 6000);
    CHECK(triangles_of(mesh) == cgal_periodic_triangles(points));
  }
}

TEST_CASE("shifting a periodic box by whole steps only renames its sites") {
  // Exact in doubles, so that ties differ only in which site is lowest.
  const Points2 points = (random_box(1000, 1, 1, 35) * 1024).array().floor() / 1024;
  const Mesh mesh = delaunay(points, Surface::periodic({1, 1}));
  Points2 shifted = points.array() + 0.25;
  shifted = shifted.array() - (shifted.array() >= 1).cast<double>();
  const Mesh other = delaunay(shifted, Surface::periodic({1, 1}));
  CHECK(mesh.site_of_input == other.site_of_input);
  CHECK(mesh.triangles.cols() == other.triangles.cols());
  require_periodic(mesh);
  require_periodic(other);
}

TEST_CASE("sparse periodic boxes and points outside are refused") {
  const auto code_of = [](const Points2& points, const Eigen::Vector2d& period) {
    return test::code_of([&] { delaunay(points, UncheckedSurface::of_plane({}, period)); });
  };
  CHECK(code_of(random_box(5, 1, 1, 36), {1, 1}) == ErrorCode::too_few_sites);
  CHECK(code_of(random_box(500, 0.3, 0.3, 37), {1, 1}) == ErrorCode::too_few_sites);
  CHECK(code_of(random_box(50, 1, 1, 38), {0.5, 1}) == ErrorCode::invalid_argument);
  CHECK(code_of(random_box(50, 1, 1, 38), {1, -1}) == ErrorCode::invalid_argument);
  CHECK(code_of(lattice(50, 1, {0.01, 0.01}, {0, 0}), {1, 1}) == ErrorCode::too_few_sites);
  for (const double bad : std::initializer_list<double>{INFINITY, -INFINITY, std::nan("")}) {
    Points2 points = random_box(50, 1, 1, 38);
    points(0, 7) = bad;
    CHECK(code_of(points, {1, 1}) == ErrorCode::not_finite);
    points(1, 7) = 3;
    CHECK(code_of(points, {1, 1}) == ErrorCode::not_finite);
  }
  Points2 line(2, 4); // copies, whose rounded places are the same, on the hull
  line << 0.3, 0.1, 0, 0.5, 0, 0, 0, 0;
  for (const double width : {1e3, 1e16, 1e150, 1e300})
    CHECK(code_of(line, {width, 7.25}) == ErrorCode::too_few_sites);
}
