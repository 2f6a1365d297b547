// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/generators.h>
#include <calotte/locate.h>

#include "base/parallel.h"
#include "base/points.h"
#include "delaunay/delaunay.h"
#include "exact/plane_predicates.h"
#include "exact/predicates.h"
#include "mesh/convex_boundary.h"
#include "support/clouds.h"
#include "support/parts.h"

#include <Eigen/Geometry>
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

using namespace calotte;
using base_detail::column;
using calotte::test::part_of;
using exact_detail::Image;
using exact_detail::Vec2;

namespace {

/// The lowest of all triangles, by exact signs.
std::int32_t triangle_on_sphere(const Mesh& mesh, const Eigen::Vector3d& position) {
  const Points3 p = position;
  const auto at = [&](std::int32_t site) { return column(mesh.points, site); };
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t) {
    const auto x = mesh.triangles.col(t);
    if (exact_detail::orientation(at(x[0]), at(x[1]), column(p, 0)) >= 0 &&
        exact_detail::orientation(at(x[1]), at(x[2]), column(p, 0)) >= 0 &&
        exact_detail::orientation(at(x[2]), at(x[0]), column(p, 0)) >= 0)
      return t;
  }
  return -1;
}

Vec2 period_of(const Mesh& mesh) { return {mesh.surface.period().x(), mesh.surface.period().y()}; }

Image image(const Mesh& mesh, std::int32_t site, int i, int j) {
  return {{mesh.points(0, site), mesh.points(1, site)}, i, j};
}

/// The copy of a site that is nearest to another point; triangles are smaller than half a box.
Image near(const Mesh& mesh, std::int32_t site, const Image& to) {
  const Vec2 period = period_of(mesh);
  const auto shift = [](double x, double other, double length) {
    return length > 0 ? static_cast<int>(std::lround((other - x) / length)) : 0;
  };
  return image(mesh, site, shift(mesh.points(0, site), to.site.x + to.i * period.x, period.x),
               shift(mesh.points(1, site), to.site.y + to.j * period.y, period.y));
}

/// The copy of a point that is inside a box.
Image home_of(const Mesh& mesh, const Eigen::Vector2d& p) {
  const auto inside = [](double x, double length) {
    return length > 0 ? -static_cast<int>(std::floor(x / length)) : 0;
  };
  const Vec2 period = period_of(mesh);
  return {{p.x(), p.y()}, inside(p.x(), period.x), inside(p.y(), period.y)};
}

/// All sites, by distance and then by id.
std::vector<std::int32_t> by_distance(const Mesh& mesh, const Eigen::Vector3d& position) {
  std::vector<std::int32_t> sites(static_cast<std::size_t>(mesh.points.cols()));
  std::iota(sites.begin(), sites.end(), 0);
  const Points3 p = position;
  const Image home = home_of(mesh, position.head<2>());
  std::stable_sort(sites.begin(), sites.end(), [&](std::int32_t a, std::int32_t b) {
    return mesh.surface.is_sphere()
               ? exact_detail::compare_distances(column(p, 0), column(mesh.points, a),
                                                 column(mesh.points, b)) < 0
               : exact_detail::compare_distances(period_of(mesh), home, near(mesh, a, home),
                                                 near(mesh, b, home)) < 0;
  });
  return sites;
}

/// In a periodic box over the copies of positions around it.
std::int32_t triangle_in_plane(const Mesh& mesh, const Eigen::Vector2d& p) {
  const Vec2 period = period_of(mesh);
  const Image home = home_of(mesh, p);
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        if ((i != 0 && period.x == 0) || (j != 0 && period.y == 0))
          continue;
        const Image at{home.site, home.i + i, home.j + j},
            a = image(mesh, mesh.triangles(0, t), 0, 0), b = near(mesh, mesh.triangles(1, t), a),
            c = near(mesh, mesh.triangles(2, t), a);
        if (exact_detail::orientation(period, a, b, at) >= 0 &&
            exact_detail::orientation(period, b, c, at) >= 0 &&
            exact_detail::orientation(period, c, a, at) >= 0)
          return t;
      }
  return -1;
}

/// The law: what an exhaustive search finds, and weights that give the position back.
void check_located(const Mesh& mesh, const PointsRef& at) {
  const Locations found = locate(mesh, at);
  REQUIRE(found.triangle.size() == at.cols());
  REQUIRE(found.nearest.size() == at.cols());
  CHECK(Locator(mesh).nearest(at) == found.nearest);
  const Locator locator(mesh);
  const bool sphere = mesh.surface.is_sphere();
  const auto unit = [&](const Eigen::Vector3d& x) { return sphere ? x.normalized() : x; };
  const double distance = sphere ? 0.4 : 1.3;
  const IdLists all = locator.nearest_few(at, 1000), within = locator.within(at, distance);
  std::vector<IdLists> few;
  for (const std::int64_t k : {1, 2, 3, 9})
    few.push_back(locator.nearest_few(at, k));
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    CAPTURE(i);
    Eigen::Vector3d p(at(0, i), at(1, i), 0);
    if (at.rows() == 3)
      p = at.col(i);
    const std::vector<std::int32_t> sites = by_distance(mesh, p);
    CHECK(std::ranges::equal(all[i], sites));
    for (const IdLists& lists : few)
      CHECK(std::ranges::equal(lists[i], std::span(sites).first(lists[i].size())));
    CHECK(std::ranges::is_sorted(within[i]));
    for (const std::int32_t site : sites)
      if (const bool is_in = std::ranges::binary_search(within[i], site); sphere) {
        const double apart = (unit(mesh.points.col(site)) - unit(p)).norm() / 2;
        if (std::abs(apart - std::sin(distance / 2)) > 1e-14)
          CHECK(is_in == (apart < std::sin(distance / 2)));
      }
    const std::int32_t triangle =
        sphere ? triangle_on_sphere(mesh, p) : triangle_in_plane(mesh, p.head<2>());
    CHECK(found.triangle[i] == triangle);
    CHECK(found.nearest[i] == sites.front());
    if (triangle < 0) {
      CHECK(found.weights.col(i).array().isNaN().all());
      continue;
    }
    CHECK(std::abs(found.weights.col(i).sum() - 1) < 1e-14);
    CHECK(found.weights.col(i).minCoeff() >= 0);
  }
}

/// The positions that the weights give.
Points3 from_weights(const Mesh& mesh, const Locations& at) {
  Points3 out(3, at.triangle.size());
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    out.col(i).setZero();
    for (int v = 0; v < 3; ++v)
      out.col(i) +=
          at.weights(v, i) * mesh.points.col(mesh.triangles(v, at.triangle[i])).normalized();
  }
  return out.colwise().normalized();
}

/// Positions with ties: sites, midpoints of edges, centroids and circumcentres.
Points3 special(const Mesh& mesh) {
  Points3 out(3, mesh.points.cols() + 3 * mesh.triangles.cols());
  out.leftCols(mesh.points.cols()) = 3.5 * mesh.points;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector3d a = mesh.points.col(mesh.triangles(0, t)),
                          b = mesh.points.col(mesh.triangles(1, t)),
                          c = mesh.points.col(mesh.triangles(2, t));
    const Eigen::Index k = mesh.points.cols() + 3 * t;
    out.col(k) = a + b; // on the edge, up to its rounding
    out.col(k + 1) = a + b + c;
    out.col(k + 2) = (b - a).cross(c - a);
  }
  return out;
}

} // namespace

TEST_CASE("positions are where an exhaustive search finds them: closed meshes of the sphere") {
  for (const Points3& points :
       {random_sphere(150), fibonacci_sphere(100), lat_lon_sphere(7, 10, true), cubed_sphere(4),
        bisected_icosahedron(2), Points3(test::with_antipodes(random_sphere(40))),
        Points3(Points3::Identity(3, 3) * 2)}) {
    if (points.cols() < 4)
      continue;
    const Mesh mesh = delaunay(points);
    CAPTURE(points.cols());
    check_located(mesh, random_sphere(200, 3));
    check_located(mesh, special(mesh));
  }
}

TEST_CASE("the octahedron: ties go to the lowest triangle and the lowest site") {
  Points3 points(3, 6);
  points << 1, -1, 0, 0, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0, 0, 0, 1, -1;
  const Mesh mesh = delaunay(points);
  Points3 at(3, 4);
  at << 1, 1, 0, -1, 0, 1, 5, -1, 0, 0, 0, -1;
  const Locations found = locate(mesh, at);
  check_located(mesh, at);
  CHECK(found.nearest[0] == 0);
  CHECK(found.nearest[1] == 0); // as near to site 2
  CHECK(found.nearest[2] == 2);
  CHECK(found.nearest[3] == 1); // as near to 3 and 5
  CHECK(found.weights.col(0).maxCoeff() == 1);
  CHECK(found.weights.col(1).minCoeff() == 0);
  CHECK(found.weights.col(1).maxCoeff() == doctest::Approx(0.5));
  CHECK(found.weights.col(3).minCoeff() == doctest::Approx(1.0 / 3));
}

TEST_CASE("more sites are equally near than are asked for: the walk may begin at each of them") {
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    Points3 square = Points3::Zero(3, 4);
    for (int i = 0; i < 4; ++i)
      square.col(order[static_cast<std::size_t>(i)]) << i % 2, i / 2, 0;
    const Mesh mesh = delaunay(square, Surface::plane());
    Points3 centre(3, 1);
    centre << 0.5, 0.5, 0;
    for (int from = 0; from < 4; ++from) {
      Points3 at(3, 2); // the walk to the second position begins at the first one's site
      at << square.col(from), centre;
      check_located(mesh, at);
    }
    check_located(mesh, centre);
  } while (std::ranges::next_permutation(order).found);

  const Mesh cube = delaunay(cubed_sphere(4)); // the middle of each square
  Points3 middles(3, cube.triangles.cols());
  for (Eigen::Index t = 0; t < cube.triangles.cols(); ++t) {
    const auto x = cube.triangles.col(t);
    middles.col(t) = (cube.points.col(x[1]) - cube.points.col(x[0]))
                         .cross(cube.points.col(x[2]) - cube.points.col(x[0]));
  }
  check_located(cube, middles);
  check_located(cube, middles.rowwise().reverse());
}

TEST_CASE("a walk does not reach all sites: two closed parts, and a site without triangles") {
  Points3 octahedron(3, 6);
  octahedron << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  Mesh two = delaunay(octahedron);
  const Eigen::Index sites = two.points.cols(), triangles = two.triangles.cols();
  two.points.conservativeResize(3, 2 * sites + 1);
  two.points.middleCols(sites, sites) =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix() * octahedron;
  two.points.rightCols(1) << 0.6, 0.8, 0;
  two.triangles.conservativeResize(3, 2 * triangles);
  two.triangles.rightCols(triangles) =
      two.triangles.leftCols(triangles).array() + static_cast<std::int32_t>(sites);
  two.neighbours.conservativeResize(3, 2 * triangles);
  two.neighbours.rightCols(triangles) =
      two.neighbours.leftCols(triangles).array() + static_cast<std::int32_t>(triangles);
  const IdLists all = Locator(two).nearest_few(random_sphere(50), 2 * sites + 1);
  for (Eigen::Index i = 0; i < 50; ++i) {
    std::vector<std::int32_t> found(all[i].begin(), all[i].end());
    std::ranges::sort(found);
    for (std::size_t k = 0; k < found.size(); ++k)
      CHECK(found[k] == static_cast<std::int32_t>(k));
  }
}

TEST_CASE("open meshes: a hemisphere, and one with a hole and a bay") {
  const Points3 all = random_sphere(250, 5);
  std::vector<Eigen::Index> north;
  for (Eigen::Index i = 0; i < all.cols(); ++i)
    if (all(2, i) > 0.1)
      north.push_back(i);
  Mesh mesh = delaunay(Points3(all(Eigen::all, north)));
  CHECK(!mesh.closed());
  check_located(mesh, random_sphere(300, 6));

  // Without the triangles of a hole and of a bay, so that a walk leaves the mesh on its way.
  const Mesh whole = delaunay(all);
  const Mesh cut = part_of(whole, [&](Eigen::Index t) {
    const Eigen::Vector3d x = whole.points.col(whole.triangles(0, t)) +
                              whole.points.col(whole.triangles(1, t)) +
                              whole.points.col(whole.triangles(2, t));
    return x.normalized().z() < 0.7 && !(x.normalized().x() > 0.3 && std::abs(x.y()) < 0.4);
  });
  check_located(cut, random_sphere(400, 7));
  check_located(cut, special(cut));
}

TEST_CASE("the plane and periodic boxes") {
  const Surface domain = rectangle({0, 0}, {4, 3}), box = Surface::periodic({4, 3});
  const Points3 inside = random_points(150, rectangle({-2, -1}, {8, 5}), {}, 3);
  for (const Points3& points : {random_points(200, domain), hexagonal_lattice(150, domain)}) {
    const Mesh mesh = delaunay(points, Surface::plane());
    check_located(mesh, inside);
    check_located(mesh, points);
  }
  for (const Points3& points : {random_points(90, box), hexagonal_lattice(80, box)}) {
    const Mesh mesh = delaunay(points, box);
    check_located(mesh, inside);
    check_located(mesh, points.colwise() + Eigen::Vector3d(8, -3, 0));
  }
  Points2 square(2, 4);
  square << 0, 1, 0, 1, 0, 0, 1, 1;
  const Mesh mesh = delaunay(square, Surface::plane());
  Points2 at(2, 3);
  at << 0.5, 1, 2, 0.5, 0.5, 2;
  const Locations found = locate(mesh, at);
  CHECK(found.nearest[0] == 0); // as near to all
  CHECK(found.nearest[1] == 1);
  CHECK(found.triangle[2] == -1);
  CHECK(found.nearest[2] == 3);
}

TEST_CASE("parts of a plane: a hole and a bay, two parts, a single triangle") {
  const Points3 positions = random_points(250, rectangle({-2, -1}, {8, 5}), {}, 3);
  Points3 grid(3, 7 * 5);
  for (Eigen::Index i = 0; i < grid.cols(); ++i)
    grid.col(i) << static_cast<double>(i % 7), static_cast<double>(i / 7) / 2, 0;
  for (const Points3& points : {random_points(150, rectangle({0, 0}, {6, 2})), grid}) {
    const Mesh whole = delaunay(points, Surface::plane());
    const auto centre = [&](Eigen::Index t) -> Eigen::Vector2d {
      return points(Eigen::all, whole.triangles.col(t)).rowwise().mean().head<2>();
    };
    const auto check_part = [&](bool convex, const auto& keep) {
      const Mesh part = part_of(whole, keep);
      CHECK(mesh_detail::is_convex(part) == convex);
      check_located(part, positions);
      check_located(part, points);
      check_located(part, points.colwise() + Eigen::Vector3d(0.5, 0.25, 0));
    };
    check_part(true, [](Eigen::Index) { return true; });
    check_part(true, [](Eigen::Index t) { return t == 7; });
    check_part(false, [&](Eigen::Index t) {
      const Eigen::Vector2d x = centre(t);
      return (x - Eigen::Vector2d(1.5, 1)).norm() > 0.6 &&
             !(x.x() > 4 && std::abs(x.y() - 1) < 0.5);
    });
    check_part(false, [&](Eigen::Index t) { return std::abs(centre(t).x() - 3) > 1; });
    check_part(false, [&](Eigen::Index t) { // in the grid two rectangles that share a corner
      return (centre(t).x() > 3) == (centre(t).y() > 1);
    });
  }
}

TEST_CASE("a channel, and a periodic box with land") {
  const Surface box = Surface::periodic({4, 3});
  const Points3 points = random_points(120, box);
  for (const bool channel : {true, false}) {
    const Mesh whole = delaunay(points, box);
    CHECK(whole.closed());
    Mesh mesh = part_of(whole, [&](Eigen::Index t) {
      double low = 3, high = 0;
      bool land = false;
      for (int v = 0; v < 3; ++v) {
        const Eigen::Vector2d x = points.col(whole.triangles(v, t)).head<2>();
        low = std::min(low, x.y());
        high = std::max(high, x.y());
        land = land || (x - Eigen::Vector2d(2, 1.5)).norm() < 0.8;
      }
      return channel ? high - low < 1.5
                     : !land; // without those that join the walls, or of the land
    });
    if (channel)
      mesh.surface = Surface::periodic({4, 0});
    CHECK_FALSE(mesh.closed());
    check_located(mesh, random_points(150, rectangle({-3, -1}, {9, 4}), {}, 3));
    check_located(mesh, points);
  }
}

TEST_CASE("a locator finds what locate() does, from any hints and in many threads") {
  const Surface rectangular = rectangle({0, 0}, {4, 3}), box = Surface::periodic({4, 3});
  const Mesh sphere = delaunay(random_sphere(3000)),
             open = part_of(sphere,
                            [&](Eigen::Index t) {
                              return sphere.points(2, sphere.triangles(0, t)) < 0.6 &&
                                     std::abs(sphere.points(0, sphere.triangles(1, t))) > 0.1;
                            }),
             plane = delaunay(random_points(3000, rectangular), Surface::plane()),
             periodic = delaunay(random_points(3000, box), box), few = delaunay(random_sphere(6));
  const Points3 around = random_points(1000, rectangle({-2, -1}, {8, 5}), {}, 3);
  for (const Mesh* mesh : {&sphere, &open, &plane, &periodic, &few}) {
    CAPTURE(mesh->triangles.cols());
    const Points3 random = mesh->surface.is_sphere() ? random_sphere(1000, 3) : around;
    const Points3 sites = mesh->points.leftCols(std::min<Eigen::Index>(mesh->points.cols(), 1000));
    Points3 at(3, random.cols() + sites.cols());
    at << random, sites;
    const Locations wanted = locate(*mesh, at);
    const Locator locator(*mesh);
    const auto check_found = [&](const Ids& hints) {
      const Locations found = locator.find(at, hints);
      // NaN is not equal to itself
      const auto same = found.weights.array() == wanted.weights.array() ||
                        (found.weights.array().isNaN() && wanted.weights.array().isNaN());
      return found.triangle == wanted.triangle && found.nearest == wanted.nearest && same.all() &&
             locator.nearest(at, hints) == wanted.nearest;
    };
    const Ids wrong = Ids::LinSpaced(at.cols(), 0, static_cast<std::int32_t>(at.cols()) - 1)
                          .unaryExpr([&](std::int32_t i) {
                            return static_cast<std::int32_t>(i * 7919LL % mesh->triangles.cols());
                          });
    for (const Ids& hints : {Ids(), wanted.triangle, wrong, Ids(Ids::Constant(at.cols(), -1))})
      CHECK(check_found(hints));
    std::array<bool, 8> same{};
    const Locator fresh(*mesh); // whose trees the threads make
    base_detail::for_each_task(std::ssize(same), [&](std::int64_t task) {
      const auto k = static_cast<std::size_t>(task);
      const Locations found = fresh.find(at, k % 2 == 0 ? wrong : Ids());
      same[k] = found.triangle == wanted.triangle && found.nearest == wanted.nearest &&
                fresh.nearest(at) == wanted.nearest;
    });
    CHECK(std::ranges::all_of(same, [](bool each) { return each; }));
  }
}

TEST_CASE("few positions in a large mesh, one by one, and a copy of a locator") {
  const Mesh mesh = delaunay(random_sphere(20000));
  const Points3 at = random_sphere(50, 4);
  const Locations wanted = locate(mesh, at);
  const auto locator = std::make_unique<Locator>(mesh);
  const Locator copy = *locator;
  for (Eigen::Index i = 0; i < at.cols(); ++i) {
    const Locations found = locator->find(at.col(i));
    CHECK(found.triangle[0] == wanted.triangle[i]);
    CHECK(found.weights.col(0) == wanted.weights.col(i));
    CHECK(copy.nearest(at.col(i))[0] == by_distance(mesh, at.col(i)).front());
  }
}

TEST_CASE("weights give the position back") {
  const Mesh mesh = delaunay(random_sphere(5000));
  const Points3 at = random_sphere(3000, 8);
  CHECK((from_weights(mesh, locate(mesh, at)) - at).cwiseAbs().maxCoeff() < 1e-13);
}

TEST_CASE("the same for any number of threads and order of positions") {
  const Mesh mesh = delaunay(random_sphere(20000));
  const Points3 at = random_sphere(30000, 9);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return locate(mesh, at);
  };
  const Locations one = with(1), four = with(4), back = locate(mesh, at.rowwise().reverse());
  CHECK(one.triangle == four.triangle);
  CHECK(one.weights == four.weights);
  CHECK(one.nearest == four.nearest);
  CHECK(one.triangle == Ids(back.triangle.reverse()));
  CHECK(one.nearest == Ids(back.nearest.reverse()));
}

TEST_CASE("bad hints of a locator are one clear line with the index") {
  const Mesh mesh = delaunay(random_sphere(8));
  const Locator locator(mesh);
  const Points3 at = random_sphere(5);
  Ids hints = Ids::Zero(5);
  for (const std::int32_t bad : {12, -2}) {
    hints[3] = bad;
    const std::string text =
        "hint 3 is " + std::to_string(bad) + "; give a triangle, 0 to 11, or -1";
    CHECK_THROWS_WITH_AS(locator.find(at, hints), text.c_str(), Error);
    CHECK_THROWS_WITH_AS(locator.nearest(at, hints), text.c_str(), Error);
  }
  CHECK_THROWS_WITH_AS(locator.find(at, Ids::Zero(4)),
                       "there are 4 hints for 5 positions; give one for each, or none", Error);
  CHECK(locator.find(Points3(3, 0)).nearest.size() == 0);
  CHECK_THROWS_WITH_AS(locator.find(Points3(Points3::Zero(3, 1))),
                       "position 0 is the zero vector, which is no direction; leave it out", Error);
  const Mesh none;
  CHECK_THROWS_WITH_AS(Locator{none}, "the mesh has no triangles; give one that has", Error);
  static_assert(!std::is_constructible_v<Locator, Mesh&&>);
}

TEST_CASE("numbers of sites and distances that cannot be are refused") {
  const Mesh mesh = delaunay(random_sphere(8)),
             plane = delaunay(Points2(Points2::Random(2, 9)), Surface::plane());
  const Points3 at = random_sphere(5);
  const Locator locator(mesh), in_plane(plane);
  CHECK_THROWS_WITH_AS(locator.nearest_few(at, 0), "k is 0; give 1 or more", Error);
  CHECK_THROWS_WITH_AS(locator.within(at, -1), "the distance is -1; give 0 or more", Error);
  CHECK_THROWS_WITH_AS(locator.within(at, 4), "the distance is 4; give an angle of at most pi",
                       Error);
  CHECK(in_plane.within(Points2(Points2::Zero(2, 1)), 4).items.size() == 9);
  CHECK(locator.within(at, std::numbers::pi).items.size() == 40);
  CHECK(locator.within(mesh.points, 0).size() == 8);
  CHECK(locator.nearest_few(Points3(3, 0), 4).size() == 0);
  CHECK(locator.within(Points3(3, 0), 1).size() == 0);
}

TEST_CASE("bad input of locate is one clear line with the index") {
  const Mesh mesh = delaunay(random_sphere(20));
  Points3 at = random_sphere(5);
  CHECK(locate(mesh, Points3(3, 0)).triangle.size() == 0);
  at.col(3).setZero();
  CHECK_THROWS_WITH_AS(locate(mesh, at),
                       "position 3 is the zero vector, which is no direction; leave it out", Error);
  at(1, 2) = std::nan("");
  CHECK_THROWS_WITH_AS(locate(mesh, at), "position 2 is not finite; leave it out", Error);
  const Points3 places = random_points(3, rectangle({0, 0}, {1, 1}));
  CHECK_THROWS_AS(locate(mesh, places.topRows<2>()), Error);
  CHECK_THROWS_WITH_AS(locate(Mesh{}, random_sphere(3)),
                       "the mesh has no triangles; give one that has", Error);
  CHECK_THROWS_WITH_AS(locate({.surface = Surface::plane()}, places),
                       "the mesh has no triangles; give one that has", Error);
  const Surface unit = Surface::periodic({1, 1});
  const Mesh box = delaunay(random_points(30, unit), unit);
  CHECK_THROWS_WITH_AS(locate(box, 1e12 * places),
                       "position 0 is more than 2^30 periods away; give its copy in the box",
                       Error);
  Mesh far = box;
  far.points(1, 7) = -1e12;
  CHECK_THROWS_WITH_AS(locate(far, places),
                       "site 7 is more than 2^30 periods away; give its copy in the box", Error);
  CHECK_THROWS_WITH_AS(interpolated_density(far, DoubleVector::Ones(far.points.cols())),
                       "site 7 is more than 2^30 periods away; give its copy in the box", Error);
  far.points(1, 7) = std::nan("");
  CHECK_THROWS_WITH_AS(locate(far, places), "site 7 is not finite; give finite coordinates", Error);
}
