// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/cgal_triangles.h"
#include "delaunay/delaunay.h"
#include "delaunay/settings.h"
#include "mesh/canonical_order.h"
#include "support/clouds.h"
#include "support/errors.h"
#include "support/laws.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

struct Setting {
  std::string name;
  DelaunayOptions options;
};

DelaunayOptions with_centres(const Points3& centres) {
  DelaunayOptions options;
  options.decomposition.given_centres = centres;
  return options;
}

/// Every overlap and every kind of centres. The given centres include some at sites and some
/// opposite to sites.
std::vector<Setting> settings(const Points3& points, const std::vector<int>& numbers) {
  std::vector<Setting> out;
  for (const int regions : numbers) {
    const std::string count = std::to_string(regions) + " regions, ";
    out.push_back({count + "distance", with_regions(regions, RegionOverlap::distance)});
    out.push_back({count + "voronoi", with_regions(regions, RegionOverlap::voronoi)});
    out.push_back({count + "fibonacci",
                   with_regions(regions, RegionOverlap::halo, RegionCentres::fibonacci)});
  }
  out.push_back(
      {"voronoi, fibonacci", with_regions(12, RegionOverlap::voronoi, RegionCentres::fibonacci)});
  out.push_back({"octahedron", with_centres(octahedron())});
  const Eigen::Index few = std::min<Eigen::Index>(points.cols(), 9);
  out.push_back({"centres on sites", with_centres(points.leftCols(few))});
  out.push_back({"foci on sites", with_centres(-points.leftCols(few))});
  out.push_back({"a centre twice", with_centres(joined(octahedron(), octahedron().leftCols(2)))});
  return out;
}

struct Runs {
  struct RegionsAndThreads {
    int regions, threads;
  };
  std::vector<RegionsAndThreads> of_threads;
  std::vector<int> of_settings; ///< numbers of regions with every overlap and centres
};

Runs all_runs() {
  Runs out{{}, {2, 12, 42}};
  for (const int regions : {1, 2, 12, 42, 200})
    for (const int threads : {1, 2, 4})
      out.of_threads.push_back({regions, threads});
  return out;
}

/// Each number of regions and each of threads.
Runs some_runs() { return {{{1, 2}, {2, 2}, {12, 1}, {12, 4}, {42, 2}, {200, 4}}, {2, 12}}; }

/// Laws 1, 2 and 4 on one set.
void require_one_mesh(const Cloud& cloud, const Runs& runs) {
  CAPTURE(cloud.name);
  const Mesh mesh = delaunay(cloud.points);
  require_laws(mesh, cloud.closed);
  CHECK(mesh.site_of_input.size() == static_cast<std::size_t>(cloud.points.cols()));
  if (cloud.sites != unknown_sites)
    CHECK(mesh.points.cols() == (cloud.sites >= 0 ? cloud.sites : cloud.points.cols()));
  for (const auto& run : runs.of_threads) {
    CAPTURE(run.regions);
    CAPTURE(run.threads);
    CHECK(with_threads(run.threads, [&] {
      return identical(delaunay(cloud.points, {}, with_regions(run.regions)), mesh);
    }));
  }
  for (const Setting& setting : settings(cloud.points, runs.of_settings)) {
    CAPTURE(setting.name);
    CHECK(identical(delaunay(cloud.points, {}, setting.options), mesh));
  }
}

std::vector<std::int32_t> random_permutation(std::int64_t n, std::uint64_t seed) {
  std::vector<std::int32_t> to(static_cast<std::size_t>(n));
  std::iota(to.begin(), to.end(), 0);
  Random(seed).shuffle(to);
  return to;
}

void require_permutable(const Cloud& cloud, std::uint64_t seed) {
  CAPTURE(cloud.name);
  const Mesh mesh = delaunay(cloud.points);
  const std::vector<std::int32_t> to = random_permutation(mesh.points.cols(), seed);
  const Mesh expected = renumbered(mesh, to);
  for (const int regions : {1, 12}) {
    CAPTURE(regions);
    CHECK(identical(delaunay(expected.points, {}, with_regions(regions)), expected));
  }
}

void require_scalable(const Cloud& cloud, std::uint64_t seed) {
  CAPTURE(cloud.name);
  const Mesh mesh = delaunay(cloud.points);
  Random random(seed);
  Points3 scaled = cloud.points;
  for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
    const int power = random.integer(-600, 600) - std::ilogb(scaled.col(i).cwiseAbs().maxCoeff());
    for (int k = 0; k < 3; ++k)
      scaled(k, i) = std::ldexp(scaled(k, i), power);
  }
  for (Eigen::Index i = 0; i < scaled.cols(); ++i)
    if (!exact::same_direction(site(scaled, i), site(cloud.points, i)))
      return; // a component underflowed
  for (const int regions : {1, 12}) {
    CAPTURE(regions);
    const Mesh other = delaunay(scaled, {}, with_regions(regions));
    CHECK(same_bits(other.triangles, mesh.triangles));
    CHECK(same_bits(other.neighbours, mesh.neighbours));
    CHECK(other.site_of_input == mesh.site_of_input);
  }
}

/// 4 to 80 points: random, of small integers, in a half, in a narrow cap, near a great circle, or
/// small integers moved by ulps.
Points3 special_position(Random& random) {
  const int n = random.integer(4, random.integer(5, 80)), kind = random.integer(0, 6),
            size = random.integer(1, 6);
  const auto integers = [&](int low) {
    return Vec3{double(random.integer(-size, size)), double(random.integer(-size, size)),
                double(random.integer(low, size))};
  };
  const double shrink = std::pow(10, -2 * size), ulps = std::ldexp(1, -random.integer(20, 52));
  std::vector<Vec3> points;
  while (std::ssize(points) < n) {
    Vec3 p = kind == 1 || kind == 6 ? integers(-size)
             : kind == 2            ? integers(0)
                                    : random.direction();
    if (kind == 3)
      p.z = std::abs(p.z);
    else if (kind == 4)
      p = Vec3{-0.6, 0.8, 0.1} + shrink * p;
    else if (kind == 5)
      p.z *= shrink;
    else if (kind == 6 && random.integer(0, 1) == 0)
      p = p + ulps * integers(-size);
    if (p.x != 0 || p.y != 0 || p.z != 0)
      points.push_back(p);
  }
  return columns(points);
}

DelaunayOptions random_options(Random& random, const Points3& points) {
  const auto count = static_cast<int>(std::min<Eigen::Index>(points.cols(), 8));
  const Points3 some = points.leftCols(random.integer(1, count));
  DelaunayOptions options = with_regions(random.integer(2, random.integer(2, 60)));
  options.decomposition.overlap = static_cast<RegionOverlap>(random.integer(0, 2));
  switch (random.integer(0, 4)) {
  case 0:
    options.decomposition.centres = RegionCentres::fibonacci;
    break;
  case 1:
    options.decomposition.given_centres = some;
    break;
  case 2:
    options.decomposition.given_centres = Points3(-some);
    break;
  case 3:
    options.decomposition.given_centres =
        random_sphere(some.cols(), static_cast<std::uint64_t>(random.integer(1, 1000)));
    break;
  default:
    break;
  }
  return options;
}

void require_error(const Points3& points, const DelaunayOptions& options, ErrorCode code,
                   std::int64_t index) {
  const Error error = test::error_of([&] { delaunay(points, {}, options); });
  CHECK(error.code() == code);
  CHECK(error.index() == index);
  CHECK(error.what() != std::string());
}

void require_invariance(const std::vector<Cloud>& clouds) {
  std::uint64_t seed = 61;
  for (const Cloud& cloud : clouds) {
    if (cloud.sites < 0) // with duplicates, a permutation changes which of them stays
      require_permutable(cloud, ++seed);
    require_scalable(cloud, ++seed);
  }
}

} // namespace

TEST_CASE("small sets: the triangulation that the definition gives") {
  for (const Cloud& cloud : small_clouds()) {
    if (cloud.points.cols() > 25)
      continue;
    CAPTURE(cloud.name);
    const Mesh mesh = delaunay(cloud.points);
    Mesh expected = oracle::delaunay(mesh.points);
    expected.site_of_input = mesh.site_of_input;
    CHECK(identical(mesh, expected));
  }
}

TEST_CASE("small sets: the laws, one mesh for any regions, threads, overlap and centres") {
  for (const Cloud& cloud : small_clouds())
    require_one_mesh(cloud, all_runs());
}

// Slow: large sets, triangulated with many options. The small ones are with each combination.
TEST_CASE("large sets: the laws, one mesh for any regions, threads, overlap and centres [slow]") {
  for (const Cloud& cloud : large_clouds())
    require_one_mesh(cloud, some_runs());
}

// Slow: large sets with ties, each triangulated seven times.
TEST_CASE("clusters, fine lattices, weather stations: the same [slow]") {
  for (const Cloud& cloud : slow_clouds(CALOTTE_FIXTURES))
    require_one_mesh(cloud, some_runs());
}

// Slow: 3 000 sets, each by several options.
TEST_CASE("small sets at random, in special position, any options: one mesh [slow]") {
  int closed = 0, open = 0, triangles = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Points3 points = special_position(random);
    Mesh mesh;
    bool has_mesh = true;
    try {
      mesh = delaunay(points, {}, with_regions(1));
    } catch (const Error& error) {
      has_mesh = false;
      CHECK((error.code() == ErrorCode::degenerate || error.code() == ErrorCode::too_few_sites));
    }
    if (has_mesh) {
      ++(mesh.closed() ? closed : open);
      triangles += mesh.points.cols() == 3;
      CHECK(check(mesh).failure == "");
      CHECK((mesh.points.cols() > 12 ||
             same_bits(oracle::delaunay(mesh.points).triangles, mesh.triangles)));
    }
    for (int k = 0; k < 3; ++k) {
      const DelaunayOptions options = random_options(random, points);
      CAPTURE(k);
      if (has_mesh)
        CHECK(identical(delaunay(points, {}, options), mesh));
      else
        CHECK_THROWS_AS(delaunay(points, {}, options), Error);
    }
  }
  CHECK(std::min(closed, open) > 50);
  CHECK(triangles > 0);
}

TEST_CASE(
    "small sets: a permuted input permutes the mesh, factors of sites do not change triangles") {
  require_invariance(small_clouds());
}

// Slow: large sets, each triangulated several times.
TEST_CASE("large sets: a permuted input permutes the mesh, factors change no triangle [slow]") {
  require_invariance(large_clouds());
}

// Slow: CGAL's triangulation on the sphere takes most of the time.
TEST_CASE("without ties the triangles are those of CGAL's triangulation on the sphere [slow]") {
  const auto require_agreement = [](const std::vector<Cloud>& clouds) {
    for (const Cloud& cloud : clouds) {
      if (cloud.ties)
        continue;
      CAPTURE(cloud.name);
      const Mesh mesh = delaunay(cloud.points);
      const std::vector<Triple> expected = cgal_triangles(mesh.points);
      REQUIRE(mesh.triangles.cols() == std::ssize(expected));
      for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t)
        REQUIRE(triple(mesh, t) == expected[static_cast<std::size_t>(t)]);
    }
  };
  require_agreement(small_clouds());
  require_agreement(large_clouds());
  require_agreement(slow_clouds(CALOTTE_FIXTURES));
}

TEST_CASE("duplicates: the lowest index stays, and the map gives the site of each") {
  const Points3 points = columns({{1, 1, 1},
                                  {2, 2, 2},
                                  {1, 0, 0},
                                  {0, -1, 0},
                                  {3, 0, 0},
                                  {0, 0, -1},
                                  {0.5, 0.5, 0.5},
                                  {-1, 0, 0}});
  const auto [mesh, report] = triangulate(points);
  CHECK(mesh.points.cols() == 5);
  CHECK(report.sites == 5);
  CHECK(report.duplicates == 3);
  CHECK(mesh.site_of_input == std::vector<std::int32_t>{0, 0, 1, 2, 1, 3, 0, 4});
  CHECK(mesh.points.col(0) == points.col(0));
  CHECK(mesh.points.col(1) == points.col(2));
  for (const Cloud& cloud : large_clouds()) {
    if (cloud.sites < 0)
      continue;
    const Mesh merged = delaunay(cloud.points);
    for (Eigen::Index i = 0; i < cloud.points.cols(); ++i) {
      const std::int32_t s = merged.site_of_input[static_cast<std::size_t>(i)];
      CHECK(exact::same_direction(site(cloud.points, i), site(merged.points, s)));
    }
  }
}

TEST_CASE("points that are handed over give the same mesh, and are not copied") {
  for (const bool twins : {false, true}) {
    CAPTURE(twins);
    Points3 points = 3 * random_sphere(5000, 12);
    if (twins)
      points.col(4000) = points.col(7);
    const Mesh expected = delaunay(points);
    const double* data = points.data();
    const Mesh mesh = delaunay(std::move(points));
    CHECK((mesh.points.data() == data) == !twins);
    CHECK(mesh.points == expected.points);
    CHECK(mesh.triangles == expected.triangles);
    CHECK(mesh.neighbours == expected.neighbours);
    CHECK(mesh.site_of_input == expected.site_of_input);
  }
}

TEST_CASE("duplicates refused, and merge_within") {
  const Points3 points = joined(octahedron(), columns({{0, 3, 0}, {1, 1e-4, 0}}));
  DelaunayOptions refuse;
  refuse.duplicates = Duplicates::refuse;
  require_error(points, refuse, ErrorCode::duplicate, 6);
  DelaunayOptions near;
  near.merge_within = 2e-4;
  const Mesh mesh = delaunay(points, {}, near);
  CHECK(mesh.points.cols() == 6);
  CHECK(mesh.site_of_input == std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 1, 0});
  near.merge_within = 5e-5;
  CHECK(delaunay(points, {}, near).points.cols() == 7);
  // Points 1e-16 apart are two sites.
  CHECK(delaunay(joined(octahedron(), columns({{1, 1e-16, 0}}))).points.cols() == 7);
}

TEST_CASE("bad input is one error that names the first offending index") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const Points3 good = random_sphere(50, 3);
  for (const int regions : {1, 12}) {
    const DelaunayOptions options = with_regions(regions);
    for (const double bad : {nan, infinity, -infinity}) {
      Points3 points = good;
      points(2, 17) = points(0, 30) = bad;
      points.col(40).setZero();
      require_error(points, options, ErrorCode::not_finite, 17);
    }
    Points3 points = good;
    points.col(11) << 0, -0.0, 0;
    points(1, 12) = nan;
    require_error(points, options, ErrorCode::zero_vector, 11);
    require_error(Points3(3, 0), options, ErrorCode::too_few_sites, -1);
    require_error(good.leftCols(2), options, ErrorCode::too_few_sites, -1);
    require_error(columns({{1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 5, 0}}), options,
                  ErrorCode::too_few_sites, -1);
    require_error(exact_circle(0), options, ErrorCode::degenerate, -1);
    require_error(columns({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}), options,
                  ErrorCode::degenerate, -1);
    require_error(columns({{1, 2, 3}, {-1, -2, -3}, {4, 5, 6}, {5, 7, 9}, {3, 3, 3}}), options,
                  ErrorCode::degenerate, -1);
  }
}

TEST_CASE("three sites make one open triangle, counter-clockwise from outside") {
  for (const int regions : {1, 12})
    for (const auto& [points, triangle] :
         {std::pair(columns({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), Eigen::Vector3i(0, 1, 2)),
          std::pair(columns({{1, 0, 0}, {0, 0, 7}, {0, 1e-9, 0}}), Eigen::Vector3i(0, 2, 1)),
          std::pair(columns({{1, 0, 1e-12}, {-1, 1, 0}, {-1, -1, 0}}), Eigen::Vector3i(0, 1, 2)),
          std::pair(columns({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}}),
                    Eigen::Vector3i(0, 1, 2))}) {
      const Mesh mesh = delaunay(points, {}, with_regions(regions));
      CHECK(mesh.points.cols() == 3);
      REQUIRE(mesh.triangles.cols() == 1);
      CHECK(mesh.triangles.col(0) == triangle);
      CHECK((mesh.neighbours.array() == -1).all());
      CHECK_FALSE(mesh.closed());
      CHECK(check(mesh).failure == "");
    }
}

TEST_CASE("options outside their range are an error") {
  const Points3 points = random_sphere(50, 3);
  require_error(points, with_regions(0), ErrorCode::invalid_argument, -1);
  require_error(points, with_regions(-3), ErrorCode::invalid_argument, -1);
  require_error(points, with_centres(Points3(3, 0)), ErrorCode::invalid_argument, -1);
  for (const double within : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    DelaunayOptions options;
    options.merge_within = within;
    CHECK(test::code_of([&] { delaunay(points, {}, options); }) == ErrorCode::invalid_argument);
  }
  Points3 centres = octahedron();
  centres.col(4).setZero();
  CHECK(test::code_of([&] { delaunay(points, {}, with_centres(centres)); }) ==
        ErrorCode::invalid_argument);
  centres(0, 4) = std::numeric_limits<double>::quiet_NaN();
  CHECK(test::code_of([&] { delaunay(points, {}, with_centres(centres)); }) ==
        ErrorCode::invalid_argument);
}

TEST_CASE("regression: bisecting 162 icosahedral sites over 12 regions gives 642 (MPI-SCVT: 694)") {
  const Points3 coarse = bisected_icosahedron(2);
  REQUIRE(coarse.cols() == 162);
  for (const DelaunayOptions& options :
       {with_regions(12), with_centres(bisected_icosahedron(0)),
        with_regions(12, RegionOverlap::distance), with_regions(12, RegionOverlap::voronoi)})
    CHECK(bisect(delaunay(coarse, {}, options)).cols() == 642);
}

TEST_CASE("regression: 642 icosahedral sites over 12 icosahedral centres (MPI-SCVT: 1172)") {
  for (const RegionOverlap overlap :
       {RegionOverlap::halo, RegionOverlap::distance, RegionOverlap::voronoi}) {
    DelaunayOptions options = with_centres(bisected_icosahedron(0));
    options.decomposition.overlap = overlap;
    CHECK(delaunay(bisected_icosahedron(3), {}, options).triangles.cols() == 1280);
  }
}

TEST_CASE("bisection of an icosahedral mesh is the next level in another order") {
  for (const int level : {0, 1, 2, 3}) {
    const Points3 finer = bisect(delaunay(bisected_icosahedron(level)));
    const Points3 expected = bisected_icosahedron(level + 1);
    REQUIRE(finer.cols() == expected.cols());
    const auto sorted = [](const Points3& points) {
      std::vector<std::array<double, 3>> out;
      for (const auto& p : points.colwise())
        out.push_back({p[0], p[1], p[2]});
      std::sort(out.begin(), out.end());
      return out;
    };
    CHECK(sorted(finer) == sorted(expected));
  }
}

TEST_CASE("regression: sites in a hemisphere, region centres beyond it: the mesh stays open") {
  // Seen from their foci, the hull of the sites has a far side; its triangles are empty but
  // clockwise.
  const Points3 points = upper_half(6, 4);
  const Mesh mesh = delaunay(points, {}, with_regions(1));
  REQUIRE_FALSE(mesh.closed());
  CHECK(identical(delaunay(points, {}, with_centres(-points.leftCols(2))), mesh));
}

TEST_CASE("regions whose centres and foci are sites") {
  const Points3 points = joined(random_sphere(2000, 81), octahedron());
  const Mesh mesh = delaunay(points, {}, with_regions(1));
  const Triangulation centred = triangulate(points, {}, with_centres(octahedron()));
  CHECK(identical(centred.mesh, mesh));
  CHECK(centred.report.regions == 6);
  CHECK_FALSE(centred.report.serial);
}

TEST_CASE("a lowest site with any number of triangles: they ascend by their second site") {
  std::mt19937_64 random(4);
  for (const Eigen::Index ring : {3, 4, 5, 6, 7, 8, 9, 10, 16, 17, 300}) {
    std::vector<Eigen::Index> place(static_cast<std::size_t>(ring));
    std::iota(place.begin(), place.end(), Eigen::Index{1});
    std::shuffle(place.begin(), place.end(), random);
    Points3 points(3, ring + 2);
    points.col(0) << 0, 0, 1;
    points.col(ring + 1) << 0, 0, -1;
    for (Eigen::Index i = 0; i < ring; ++i) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(ring);
      points.col(place[static_cast<std::size_t>(i)]) << std::cos(angle), std::sin(angle), 0.5;
    }
    const Triangles triangles = delaunay(points).triangles;
    REQUIRE(triangles.cols() == 2 * ring);
    for (Eigen::Index t = 0; t < ring; ++t) {
      CHECK(triangles(0, t) == 0);
      CHECK(triangles(1, t) == t + 1);
    }
    CHECK(mesh_detail::is_canonical(triangles));
  }
}

TEST_CASE("the report adds up") {
  const Points3 points = random_sphere(20000, 91);
  const auto [mesh, report] = triangulate(points, {}, with_regions(12));
  CHECK(report.sites == 20000);
  CHECK(report.duplicates == 0);
  CHECK(report.regions == 12);
  CHECK_FALSE(report.serial);
  REQUIRE(report.sites_per_region.size() == 12);
  REQUIRE(report.owned_per_region.size() == 12);
  REQUIRE(report.seconds_per_region.size() == 12);
  CHECK(std::accumulate(report.owned_per_region.begin(), report.owned_per_region.end(),
                        std::int64_t{0}) == 20000);
  const auto members = std::accumulate(report.sites_per_region.begin(),
                                       report.sites_per_region.end(), std::int64_t{0});
  CHECK(report.overlap == doctest::Approx(static_cast<double>(members) / 20000));
  CHECK(report.overlap >= 1);
  CHECK(report.overlap <= 3);
  CHECK(report.seam_triangles > 0);
  CHECK(report.seam_triangles < mesh.triangles.cols());
  // A seam triangle is certified by two or three regions, another by one.
  const std::int64_t reports = report.certified_by_cull + report.certified_by_query;
  CHECK(reports >= mesh.triangles.cols() + report.seam_triangles);
  CHECK(reports <= mesh.triangles.cols() + 2 * report.seam_triangles);
  const DelaunayReport::Seconds& s = report.seconds;
  CHECK(std::min({s.sites, s.regions, s.triangulate, s.unite}) >= 0);
  CHECK(s.sites + s.regions + s.triangulate + s.unite <= s.total * 1.000001);
  CHECK(with_threads(2, [&] { return triangulate(points, {}, with_regions(12)).report.threads; }) ==
        2);
  CHECK(triangulate(points, {}, with_regions(1)).report.serial);
  CHECK(triangulate(upper_half(500, 92), {}, with_regions(12)).report.serial);
}

TEST_CASE("caps give up where each query would look at most sites: along a satellite's track") {
  const Points3 points = joined(circle_at_random(30000, 1e-6, 93), random_sphere(6, 94));
  const auto [mesh, report] = triangulate(points, {}, with_regions(12));
  CHECK(report.serial);
  CHECK(check(mesh).failure == "");
}
