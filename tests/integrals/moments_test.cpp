// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "integrals/moments.h"

#include "base/points.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace calotte;
using namespace calotte::integrals_detail;

namespace {

constexpr double pi = std::numbers::pi;

struct Case {
  const char* name;
  Mesh mesh;
};

/// Random sets have many obtuse triangles, and the smallest sets have circumcaps near a hemisphere.
std::vector<Case> cases() {
  std::vector<Case> out;
  out.push_back({"icosahedron", delaunay(bisected_icosahedron(0))});
  out.push_back({"642 bisected", delaunay(bisected_icosahedron(3))});
  out.push_back({"lat-lon", delaunay(lat_lon_sphere(10, 20, true))});
  out.push_back({"random 30", delaunay(random_sphere(30, 5))});
  out.push_back({"random 3000", delaunay(random_sphere(3000, 5))});
  out.push_back({"spiral 10000", delaunay(spiral_sphere(10000))});
  return out;
}

double sum(const Array<double>& values) {
  double total = 0;
  for (const double v : values)
    total += v;
  return total;
}

Vec3 sum(const Array<Vec3>& values) {
  Vec3 total{0, 0, 0};
  for (const Vec3& v : values)
    total = total + v;
  return total;
}

/// Uniform, but integrated by quadrature.
Density ones() {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setOnes();
  };
  return density;
}

double longest_side(const Mesh& mesh) {
  double longest = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int e = 0; e < 3; ++e)
      longest = std::max(longest, (mesh.points.col(mesh.triangles(e, t)) -
                                   mesh.points.col(mesh.triangles((e + 1) % 3, t)))
                                      .norm());
  return longest;
}

double largest_difference(const Moments& a, const Moments& b) {
  double worst = 0;
  for (std::int64_t i = 0; i < a.mass.size(); ++i)
    worst = std::max({worst, std::abs(a.mass[i] - b.mass[i]), norm(a.first[i] - b.first[i]),
                      std::abs(a.energy[i] - b.energy[i])});
  return worst;
}

/// Cells of half a degree whose triangles are all acute, but for a hemisphere where half are not.
Mesh half_disturbed() {
  Points3 points = bisected_icosahedron(7);
  const Points3 moves = random_sphere(points.cols(), 3);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points(2, i) < 0)
      points.col(i) = (points.col(i) + 0.003 * moves.col(i)).normalized();
  return renumbered(delaunay(points), Numbering::curve);
}

/// What integrate() gives for a patch of the whole mesh.
struct Integrals {
  Array<CellMoments> moments;
  std::vector<std::int32_t> suspects;
};

Integrals integrals(const Mesh& mesh, const Density& density, bool with_mass) {
  const std::int64_t n = mesh.points.cols();
  Array<std::int32_t> owner(n);
  std::fill(owner.begin(), owner.end(), 0);
  const std::vector<Patch> patches =
      make_patches(mesh.triangles, make_ownership(std::move(owner), 1));
  Array<Vec3> x(n);
  for (std::int64_t i = 0; i < n; ++i)
    x[i] = base_detail::column(mesh.points, patches[0].sites[static_cast<std::size_t>(i)]);
  Integrals out{Array<CellMoments>(n), {}};
  Array<double> mass(n);
  integrate(make_integrand(density, 3, 1), Generators<Sphere>{{}, nullptr, n}, patches[0], x,
            {out.moments, with_mass ? &mass : nullptr}, out.suspects);
  return out;
}

} // namespace

TEST_CASE("uniform moments: masses sum to 4 pi, first moments to 0, energies follow from both") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Moments moments = mesh_moments(c.mesh, Density{});
    CHECK(std::abs(sum(moments.mass) - 4 * pi) < 1e-12);
    CHECK(norm(sum(moments.first)) < 1e-12);
    for (std::int64_t i = 0; i < moments.mass.size(); ++i) {
      CHECK(moments.mass[i] > 0);
      CHECK(moments.energy[i] > 0);
      const Vec3 x{c.mesh.points(0, i), c.mesh.points(1, i), c.mesh.points(2, i)};
      // No digits cancel in the energy itself.
      CHECK(std::abs(2 * (moments.mass[i] - dot(moments.first[i], x)) - moments.energy[i]) < 1e-14);
    }
  }
}

/// Twelve directions, with four points within `size` of each: the cells reach far beyond their
/// cluster. \param flat whether the points of a cluster lie on one arc.
static Points3 clusters(double size, bool flat) {
  const Points3 centres = random_sphere(12, 11), offsets = random_sphere(48, 13);
  Points3 points(3, 48);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double along = static_cast<double>(i / 12) - 1.3;
    const Eigen::Vector3d offset = flat ? (along * offsets.col(i % 12)).eval() : offsets.col(i);
    points.col(i) = (centres.col(i % 12) + size * offset).normalized();
  }
  return points;
}

TEST_CASE("uniform moments of clusters of any size: cells are positive and add up to the sphere") {
  for (const double size : {1e-3, 1e-6, 1e-7, 1e-8, 1e-9, 1e-12, 1e-15})
    for (const bool flat : {false, true}) {
      CAPTURE(size);
      CAPTURE(flat);
      const Mesh mesh = delaunay(clusters(size, flat)); // equal points are merged
      const Moments moments = mesh_moments(mesh, Density{});
      CHECK(std::abs(sum(moments.mass) - 4 * pi) < 1e-10);
      CHECK(norm(sum(moments.first)) < 1e-10);
      for (const std::int32_t i : mesh.triangles.reshaped()) {
        CHECK(moments.mass[i] > -1e-15);
        CHECK(moments.energy[i] > -1e-15);
      }
    }
}

TEST_CASE("uniform moments beside antipodal sites and hemispherical circumcaps") {
  for (const double bend : {1e-3, 1e-6, 1e-9, 1e-15, 1e-153, 1e-300}) {
    CAPTURE(bend);
    Points3 points(3, 6); // four on a great circle but for the bend, two of them nearly antipodal
    points << 1, -1, 0, 0, 0.6, 0.6, //
        0, bend, 1, -1, 0.8, 0,      //
        0, bend, -bend, bend, 0, -0.8;
    const Mesh mesh = delaunay(points.colwise().normalized());
    REQUIRE(mesh.closed());
    const Moments moments = mesh_moments(mesh, Density{});
    // Near a hemisphere, the sine of an arc gives the arc to half of its digits.
    CHECK(std::abs(sum(moments.mass) - 4 * pi) < 1e-7);
    CHECK(norm(sum(moments.first)) < 1e-10);
    for (std::int64_t i = 0; i < moments.mass.size(); ++i) {
      CHECK(moments.mass[i] > 0);
      CHECK(std::abs(2 * (moments.mass[i] - dot(moments.first[i], column(mesh.points, i))) -
                     moments.energy[i]) < 1e-7);
    }
  }
}

// Slow with sanitizers: quadrature of high order on each triangle.
TEST_CASE("the closed form agrees with quadrature, obtuse triangles included [slow]") {
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Moments exact = mesh_moments(c.mesh, Density{});
    // Triangles are divided into parts of the same size, at which quadrature is exact to rounding.
    const int divisions = static_cast<int>(std::ceil(longest_side(c.mesh) / 0.0105));
    const Moments fine = mesh_moments(c.mesh, ones(), 6, divisions);
    CHECK(largest_difference(exact, fine) < 1e-11);
  }
}

TEST_CASE("every rule converges at its order under division") {
  const Mesh mesh = delaunay(spiral_sphere(150));
  // Smooth everywhere; a bump is not: its distance to the centre has a kink there.
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (2 * x.row(2).array() + x.row(0).array()).exp().matrix().transpose();
  };
  const Moments exact = mesh_moments(mesh, density, 6, 20);
  for (const int points : {3, 6}) {
    const QuadratureRule& rule = quadrature_rule(points);
    const double once = largest_difference(mesh_moments(mesh, density, points, 1), exact);
    const double twice = largest_difference(mesh_moments(mesh, density, points, 2), exact);
    CAPTURE(points);
    CHECK(std::log2(once / twice) > rule.degree + 0.5); // degree + 1, up to the next order
  }
}

TEST_CASE("moments of a density: mass against its integral in closed form") {
  // rho depends on the angle d from the pole only: 2 pi times the integral of rho sin(d), by
  // Simpson.
  const double beta = pi / 6, alpha = 0.2, gamma = 1.0 / 4096;
  double integral = 0;
  constexpr int steps = 20000;
  for (int s = 0; s <= steps; ++s) {
    const double d = pi * s / steps;
    const double rho = (std::tanh((beta - d) / alpha) + 1) / (2 * (1 - gamma)) + gamma;
    integral += (s == 0 || s == steps ? 1 : s % 2 ? 4 : 2) * rho * std::sin(d);
  }
  integral *= 2 * pi * pi / steps / 3;
  const Mesh mesh = delaunay(bisected_icosahedron(5));
  const Density density = tanh_bump({0, 0, 2}, beta, alpha, gamma);
  const Moments moments = mesh_moments(mesh, density, 6);
  CHECK(std::abs(sum(moments.mass) - integral) < 1e-9);
}

TEST_CASE("a density at sites: exact where it is linear, in the plane") {
  // A lattice of triangles, slightly moved: all are acute.
  Points2 sites(2, 400);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      sites.col(20 * i + j) << j + 0.5 * (i % 2) + 0.03 * std::sin(7.0 * i + 3 * j),
          std::sqrt(0.75) * i + 0.03 * std::cos(5.0 * i - 2 * j);
  const Mesh mesh = delaunay(sites, Surface::plane());
  std::vector<Eigen::Index> inner_columns; // those along the hull are flat
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    if (((mesh.triangles.col(t).array() / 20 - 10).abs() < 9).all() &&
        ((mesh.triangles.col(t).unaryExpr([](std::int32_t k) { return k % 20; }).array() - 10)
             .abs() < 9)
            .all())
      inner_columns.push_back(t);
  const Triangles inner_triangles = mesh.triangles(Eigen::all, inner_columns);
  Density linear;
  linear.kind = Density::Kind::callable;
  linear.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (30 + 0.7 * x.row(0).array() - 0.4 * x.row(1).array()).matrix().transpose();
  };
  const auto moments = [&](int rule) {
    return cell_moments(Generators<Plane>{Plane(), nullptr, 400}, {&column(mesh.points, 0), 400},
                        inner_triangles, make_integrand(linear, rule, 1));
  };
  const Moments at_sites = moments(rule_at_sites), exact = moments(6);
  int inner = 0;
  for (int i = 4; i < 17; ++i)
    for (int j = 4; j < 17; ++j, ++inner) {
      const int k = 20 * i + j;
      CHECK(std::abs(at_sites.mass[k] - exact.mass[k]) < 1e-12 * exact.mass[k]);
      CHECK(std::abs(at_sites.energy[k] - exact.energy[k]) < 1e-12 * exact.energy[k]);
      const Vec3 apart = at_sites.first[k] - exact.first[k];
      CHECK(norm(apart) < 1e-12 * exact.mass[k]);
    }
  CHECK(inner == 169);
}

TEST_CASE("a density at sites: second order on the sphere") {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (2 * x.row(2).array() + x.row(0).array()).exp().matrix().transpose();
  };
  double before = 0;
  for (const int level : {3, 4, 5}) {
    const Mesh mesh = delaunay(bisected_icosahedron(level));
    const Moments at_sites = mesh_moments(mesh, density, rule_at_sites),
                  exact = mesh_moments(mesh, density, 6, 4);
    double most = 0; // of centroids, in units of the spacing
    for (std::int64_t i = 0; i < exact.mass.size(); ++i) {
      const Vec3 x = column(mesh.points, i);
      most = std::max(most, norm(centroid_of<Sphere>(x, at_sites.first[i]) -
                                 centroid_of<Sphere>(x, exact.first[i])));
      CHECK(std::abs(at_sites.energy[i] / exact.energy[i] - 1) < 0.15);
    }
    most *= std::sqrt(static_cast<double>(exact.mass.size()));
    CAPTURE(level);
    CHECK(most < 0.02);
    if (before > 0)
      CHECK(std::log2(before / most) > 1.7);
    before = most;
  }
}

TEST_CASE("moments without masses, which take less work, have the same bits") {
  std::vector<Case> all = cases();
  all.push_back({"163842 bisected", delaunay(bisected_icosahedron(7))});
  all.push_back({"half disturbed", half_disturbed()});
  for (const Case& c : all)
    for (const Density& density : {Density{}, tanh_bump({1, 2, 3}, 0.6, 0.5, 0.1)}) {
      CAPTURE(c.name);
      const Integrals with = integrals(c.mesh, density, true),
                      without = integrals(c.mesh, density, false);
      CHECK(with.suspects == without.suspects);
      std::int64_t different = 0;
      for (std::int64_t i = 0; i < with.moments.size(); ++i) {
        const CellMoments &a = with.moments[i], &b = without.moments[i];
        different += a.first.x != b.first.x || a.first.y != b.first.y || a.first.z != b.first.z ||
                     a.energy != b.energy;
      }
      CHECK(different == 0);
    }
}

TEST_CASE("moments are the same bits for any number of threads") {
  const Mesh mesh = delaunay(random_sphere(40000, 5));
  const Density density = tanh_bump({1, 2, 3}, 0.6, 0.5, 0.1);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return std::pair(mesh_moments(mesh, Density{}), mesh_moments(mesh, density, 3));
  };
  const auto one = with(1), four = with(4);
  CHECK(largest_difference(one.first, four.first) == 0);
  CHECK(largest_difference(one.second, four.second) == 0);
}
