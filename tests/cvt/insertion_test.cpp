// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/insertion.h"
#include "delaunay/delaunay.h"
#include "support/densities.h"
#include "support/errors.h"
#include "support/text.h"

#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using Coordinates = std::array<double, 3>;

std::set<Coordinates> places_in(const Points3& points) {
  std::set<Coordinates> places;
  for (const auto& x : points.colwise())
    places.insert({x[0], x[1], x[2]});
  return places;
}

/// The ends of each edge once, and its length over the spacing up to a factor.
struct EdgeLength {
  double length;
  std::int32_t a, b;
};

std::vector<EdgeLength> edge_lengths(const Mesh& mesh, const Density& density) {
  const Eigen::VectorXd rho = evaluate(density, mesh.points);
  std::vector<EdgeLength> edges;
  for (const auto& t : mesh.triangles.colwise())
    for (int i = 0; i < 3; ++i)
      if (const std::int32_t a = t[i], b = t[(i + 1) % 3]; a < b)
        edges.push_back({(mesh.points.col(a) - mesh.points.col(b)).norm() *
                             (std::pow(rho[a], 0.25) + std::pow(rho[b], 0.25)),
                         a, b});
  return edges;
}

Mesh graded_mesh(std::int64_t n, const Density& density) {
  return delaunay(random_sphere(n, site_density(density), 3));
}

std::string message_of(const Mesh& mesh, const Density& density, std::int64_t inserted,
                       std::int64_t contracted) {
  return test::message_of([&] { split_and_collapse(mesh, density, inserted, contracted); });
}

/// Sites with 8 neighbours or more, or 4 or fewer, of a closed mesh.
std::int64_t odd_sites(const Mesh& mesh) {
  std::vector<int> degree(static_cast<std::size_t>(mesh.points.cols()), 0);
  for (const std::int32_t site : mesh.triangles.reshaped())
    ++degree[static_cast<std::size_t>(site)];
  return std::count_if(degree.begin(), degree.end(), [](int d) { return d >= 8 || d <= 4; });
}

} // namespace

TEST_CASE("insertion: counts, unit columns, and points that stay keep their bits and order") {
  const Mesh mesh = graded_mesh(2000, x8());
  const Points3 points = split_and_collapse(mesh, x8(), 30, 20);
  REQUIRE(points.cols() == 2010);
  CHECK(((points.colwise().norm().array() - 1).abs() < 1e-15).all());
  CHECK(places_in(points).size() == 2010); // distinct
  std::int64_t from = 0, kept = 0;
  for (std::int64_t i = 0; i < 1980; ++i) {
    std::int64_t at = from;
    while (at < 2000 && !(mesh.points.col(at) - points.col(i)).isZero(1e-15))
      ++at;
    if (at < 2000) {
      from = at + 1;
      ++kept;
    }
  }
  CHECK(kept == 1960); // and 20 midpoints
}

TEST_CASE("insertion: the longest edges are split and the shortest contracted") {
  const auto has = [](const Points3& points, const Eigen::Vector3d& x) {
    return ((points.colwise() - x).colwise().norm().array() < 1e-14).any();
  };
  // In a bisected icosahedron no site is odd, and the longest edge stands out once moved.
  Points3 points = bisected_icosahedron(3);
  points.col(100) = (points.col(100) + 0.03 * Eigen::Vector3d(1, 2, 3)).normalized();
  const Mesh moved = delaunay(points);
  REQUIRE(odd_sites(moved) == 0);
  std::vector<EdgeLength> sorted = edge_lengths(moved, Density{});
  std::sort(sorted.begin(), sorted.end(),
            [](const EdgeLength& e, const EdgeLength& f) { return e.length < f.length; });
  const auto middle_of = [&](const EdgeLength& e) {
    return Eigen::Vector3d((points.col(e.a) + points.col(e.b)).normalized());
  };
  CHECK(has(split_and_collapse(moved, Density{}, 1, 0), middle_of(sorted.back())));
  CHECK(has(split_and_collapse(moved, Density{}, 0, 1), middle_of(sorted.front())));
  CHECK(!has(split_and_collapse(moved, Density{}, 0, 1), points.col(sorted.front().b)));
}

TEST_CASE("insertion: the choice does not depend on the numbers of the points") {
  const Points3 points = random_sphere(1500, site_density(x8()), 9);
  std::vector<Eigen::Index> order(1500);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const Points3 shuffled = points(Eigen::all, order);
  const auto of = [](const Points3& start) {
    const Points3 out = split_and_collapse(delaunay(start), x8(), 40, 40);
    Points3 rounded = (out.array() * 1e12).round(); // a + b and b + a round alike; a midpoint's
    return places_in(rounded);                      // place in the sum may not
  };
  CHECK(of(points) == of(shuffled));
}

TEST_CASE("insertion: small meshes give what they can") {
  const Mesh icosahedron = delaunay(bisected_icosahedron(0));
  for (const std::int64_t count : {1, 5, 1000}) {
    const std::int64_t more = split_and_collapse(icosahedron, Density{}, count, 0).cols(),
                       fewer = split_and_collapse(icosahedron, Density{}, 0, count).cols();
    CHECK(more >= 13);
    CHECK(more <= 12 + std::min<std::int64_t>(count, 2));
    CHECK(fewer <= 11);
    CHECK(fewer >= 10);
  }
}

TEST_CASE("insertion: sites with 8 neighbours lose some") {
  // A ring of 8 around the pole, in a lattice that is coarse elsewhere.
  const Points3 base = fibonacci_sphere(400);
  std::vector<Eigen::Vector3d> kept{{0, 0, 1}};
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4 + 0.1;
    kept.push_back({0.2 * std::cos(angle), 0.2 * std::sin(angle), std::sqrt(1 - 0.04)});
  }
  for (const auto& x : base.colwise())
    if (x[2] < 0.93)
      kept.push_back(x);
  Points3 points(3, std::ssize(kept));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) = kept[static_cast<std::size_t>(i)];
  const auto pole_of = [](const Mesh& mesh) { return (mesh.triangles.array() == 0).count(); };
  const Mesh mesh = delaunay(points);
  REQUIRE(pole_of(mesh) == 8);
  const std::int64_t odd = odd_sites(mesh);
  REQUIRE(odd >= 1);
  const Points3 out = split_and_collapse(mesh, Density{}, odd, 0);
  const bool near_pole =
      ((out.rightCols(out.cols() - points.cols()).row(2).array()) > std::sqrt(1 - 0.02)).any();
  CHECK(near_pole);
}

TEST_CASE("insertion: dislocations grow as the root of the number, and uniform meshes need none") {
  CHECK(cvt_detail::dislocations(graded_mesh(1000, Density{}), Density{}) == 0);
  const double few = cvt_detail::dislocations(graded_mesh(4000, x8()), x8()),
               many = cvt_detail::dislocations(graded_mesh(16000, x8()), x8());
  CHECK(many / few == doctest::Approx(2).epsilon(0.05));
}

TEST_CASE("insertion: where the density is 0, nothing is demanded") {
  const Density half = rising(0);
  const Mesh mesh = delaunay(fibonacci_sphere(1000));
  const double demanded = cvt_detail::dislocations(mesh, half);
  CHECK(demanded > 0);
  CHECK(demanded < 1000);
  const Points3 points = split_and_collapse(mesh, half, 20, 20);
  CHECK(points.cols() == 1000);
  CHECK(points.allFinite());
}

TEST_CASE("insertion: in the plane midpoints lie inside the domain or the box") {
  const Surface corner = Surface::plane().within( // with a reflex corner
      {(Eigen::MatrixXd(2, 6) << 0, 2, 2, 1, 1, 0, 0, 0, 1, 1, 2, 2).finished()});
  const Density fine = tanh_bump({0.5, 0.5, 0}, 0.3, 0.2, 1.0 / 256);
  const Mesh mesh = delaunay(random_points(600, corner, {}, 2), corner);
  const Points2 points = split_and_collapse(mesh, fine, 25, 15).topRows<2>();
  CHECK(points.cols() == 610);
  for (const auto& x : points.colwise()) {
    CHECK(x.minCoeff() > 0);
    CHECK((x[0] < 1 || x[1] < 1));
  }
  const Surface box = Surface::periodic({3, 2});
  const Mesh periodic = delaunay(random_points(500, box, {}, 2), box);
  const Points2 inside = split_and_collapse(periodic, fine, 10, 10).topRows<2>();
  CHECK(inside.cols() == 500);
  CHECK(inside.minCoeff() >= 0);
  CHECK((inside.row(0).array() < 3).all());
  CHECK((inside.row(1).array() < 2).all());
}

TEST_CASE("insertion: bad numbers and densities are errors") {
  const Mesh mesh = delaunay(bisected_icosahedron(1));
  CHECK(has(message_of(mesh, Density{}, -1, 0), "give 0 or more"));
  CHECK(has(message_of(mesh, Density{}, 0, -7), "-7"));
  CHECK(has(message_of(mesh, Density{}, std::int64_t{1} << 30, 0), "at most"));
  CHECK(has(message_of(mesh, tanh_bump({0, 0, 1}, -1, 1, 0.5), 1, 1), "beta"));
  Mesh alone = mesh;
  alone.neighbours.resize(3, 0);
  CHECK(has(message_of(alone, Density{}, 1, 1), "neighbours"));
}
