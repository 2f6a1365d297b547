// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/polish.h"
#include "cvt/subdomain.h"
#include "delaunay/delaunay.h"
#include "density/hexagons.h"
#include "mesh/canonical_order.h"
#include "support/densities.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/quality.h>
#include <calotte/surface.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <vector>

using namespace calotte;
using namespace calotte::cvt_detail;
using namespace calotte::test;

namespace {

using Seeds = std::vector<std::array<std::int32_t, 2>>;

/// Generators that move, with all that subdomains need.
struct Moving {
  Moving(const Points3& start, const Density& rho, std::vector<std::uint8_t> held = {})
      : points(start), density(rho), integrand(integrals_detail::make_integrand(rho, 3, 1)),
        fixed(std::move(held)),
        tessellation(Cells<Sphere>(Surface::sphere()), points, Decomposition{}, Level{}) {}

  LocalInput input() const { return {density, integrand, fixed}; }

  /// Runs a task around all triangles that `choose_disjoint` takes of some.
  std::vector<std::int32_t> work(const Seeds& seeds, const LocalTask<Sphere>& task) {
    std::vector<std::int32_t> changed;
    tessellation.change_mesh(
        points, [&](Connectivity& mesh) -> std::optional<std::vector<std::int32_t>> {
          const DisjointSurroundings around = choose_disjoint(mesh, seeds);
          chosen = std::ssize(around.chosen);
          if (!work_in<Sphere>(around.chosen, task, input(), tessellation, mesh, points, changed))
            return std::nullopt;
          return changed;
        });
    return changed;
  }

  Points3 points;
  Density density;
  integrals_detail::Integrand integrand;
  std::vector<std::uint8_t> fixed;
  Tessellation<Sphere> tessellation;
  std::ptrdiff_t chosen = 0;
};

/// Every so many-th triangle.
Seeds seeds_of(const Connectivity& mesh, int stride) {
  Seeds seeds;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); t += stride)
    seeds.push_back({t, t});
  return seeds;
}

bool descend_some(const LocalInput& input, Subdomain<Sphere>& part) {
  const Evaluation last =
      descend(part, part.points(), input, {},
              [](const Evaluation&, int evaluations) { return evaluations >= 12; });
  return std::isfinite(last.iteration.energy);
}

/// Whether the mesh is the triangulation of its points.
bool is_delaunay(const Moving& run) {
  Connectivity mesh = run.tessellation.mesh();
  mesh_detail::make_canonical(mesh.triangles, mesh.neighbours);
  const Mesh whole = delaunay(run.points);
  return (mesh.triangles == whole.triangles) && (mesh.neighbours == whole.neighbours);
}

double energy_of(const Moving& run) { return quality(delaunay(run.points), run.density).energy; }

} // namespace

TEST_CASE("subdomains: the chosen ones have no common triangle, and those left are outside") {
  const Mesh whole = delaunay(random_sphere(3000, {}, 1));
  const Connectivity mesh{whole.triangles, whole.neighbours};
  const Seeds seeds = seeds_of(mesh, 7);
  const DisjointSurroundings around = choose_disjoint(mesh, seeds);
  std::set<std::int32_t> taken;
  std::size_t count = 0;
  for (const Surroundings& some : around.chosen) {
    CHECK(some.triangles.front() == seeds[some.seed][0]);
    taken.insert(some.triangles.begin(), some.triangles.end());
    count += some.triangles.size();
  }
  CHECK(around.chosen.size() > 5);
  CHECK(taken.size() == count);
  for (const std::size_t k : around.left)
    CHECK(taken.count(seeds[k][0]) == 0);
}

TEST_CASE("subdomains: without a change all bits stay") {
  Moving run(random_sphere(2000, {}, 2), x8());
  const Points3 before = run.points;
  const Connectivity mesh = run.tessellation.mesh();
  const auto nothing = [](std::size_t, Subdomain<Sphere>&) { return true; };
  CHECK(run.work(seeds_of(mesh, 11), nothing).empty());
  CHECK(run.chosen > 5);
  CHECK((run.points == before));
  CHECK((run.tessellation.mesh().triangles == mesh.triangles));
}

TEST_CASE("subdomains: descents lower the energy of all, whose mesh stays Delaunay") {
  for (const Density& density : {Density{}, x8()})
    for (const std::uint64_t seed : {1, 2}) {
      CAPTURE(seed);
      Moving run(random_sphere(1500, site_density(density), seed), density); // with many flips
      for (int round = 0; round < 3; ++round) {
        const double before = energy_of(run);
        const Points3 start = run.points;
        const auto changed = run.work(
            seeds_of(run.tessellation.mesh(), 13 + 2 * round),
            [&](std::size_t, Subdomain<Sphere>& part) { return descend_some(run.input(), part); });
        CHECK(!changed.empty());
        CHECK(is_delaunay(run));
        CHECK(energy_of(run) < before);
        CHECK(((run.points - start).colwise().norm().array() == 0).count() > 100);
        CHECK((run.points.colwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
      }
    }
}

TEST_CASE("subdomains: fixed generators keep their bits") {
  std::vector<std::uint8_t> fixed(1200, 0);
  for (std::size_t i = 0; i < fixed.size(); i += 3)
    fixed[i] = pinned;
  Moving run(random_sphere(1200, {}, 5), {}, fixed);
  const Points3 before = run.points;
  run.work(seeds_of(run.tessellation.mesh(), 9),
           [&](std::size_t, Subdomain<Sphere>& part) { return descend_some(run.input(), part); });
  CHECK(is_delaunay(run));
  std::int64_t moved = 0;
  for (Eigen::Index i = 0; i < before.cols(); ++i)
    if (i % 3 == 0)
      CHECK((run.points.col(i) == before.col(i)));
    else
      moved += run.points.col(i) != before.col(i) ? 1 : 0;
  CHECK(moved > 100);
}

TEST_CASE("subdomains: the numbers of triangles have no effect") {
  const Points3 start = random_sphere(2500, {}, 7);
  const auto moved = [&](unsigned seed) {
    Moving run(start, x8());
    std::vector<Eigen::Index> order(
        static_cast<std::size_t>(run.tessellation.mesh().triangles.cols()));
    for (std::size_t k = 0; k < order.size(); ++k)
      order[k] = static_cast<Eigen::Index>(k);
    std::mt19937 random(seed);
    if (seed > 0)
      std::shuffle(order.begin(), order.end(), random);
    std::vector<std::int32_t> changed;
    run.tessellation.change_mesh(
        run.points, [&](Connectivity& mesh) -> std::optional<std::vector<std::int32_t>> {
          std::vector<std::int32_t> place(order.size());
          for (std::size_t k = 0; k < order.size(); ++k)
            place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
          mesh.triangles = Triangles(mesh.triangles(Eigen::all, order));
          mesh.neighbours = Triangles(mesh.neighbours(Eigen::all, order));
          for (std::int32_t& t : mesh.neighbours.reshaped())
            t = place[static_cast<std::size_t>(t)];
          Seeds seeds;
          for (std::size_t k = 0; k < place.size(); k += 97)
            seeds.push_back({place[k], place[k]});
          const auto around = choose_disjoint(mesh, seeds).chosen;
          REQUIRE(around.size() > 3);
          const bool sound = work_in<Sphere>(
              around,
              [&](std::size_t, Subdomain<Sphere>& part) { return descend_some(run.input(), part); },
              run.input(), run.tessellation, mesh, run.points, changed);
          REQUIRE(sound);
          return std::nullopt; // the patches do not know the new numbers
        });
    return run.points;
  };
  const Points3 points = moved(0);
  CHECK((points != start));
  CHECK((points == moved(3)));
}

TEST_CASE("subdomains: a polish leaves fewer shapes beyond the limits") {
  const Points3 pure = make_grid({.cells = 4000,
                                  .resolution = x8(),
                                  .start = {.kind = CvtStart::Kind::density},
                                  .stop = {.tolerance = 1e-3},
                                  .seed = 3})
                           .mesh.points;
  Moving run(pure, x8());
  const Quality before = quality(delaunay(pure), x8());
  const double cell = before.energy / 4000;
  ShapePenalty penalty;
  penalty.factors.shapes = 60 * cell;
  penalty.spacing = std::sqrt(before.energy * 4000 / density_detail::hexagon_energy) / 4000;
  penalty.spacing = density_detail::hexagon_width(penalty.spacing);
  REQUIRE(before.obtuse > 5);
  CHECK(polish(run.tessellation, run.points, run.input(), penalty) > 0);
  CHECK(is_delaunay(run));
  CHECK(quality(delaunay(run.points), x8()).obtuse < before.obtuse / 3);
}

TEST_CASE("shapes: the gradient of a penalty is its derivative") {
  constexpr double h = 1e-6;
  for (const Surface& surface : {Surface::sphere(), Surface::periodic({1, 1})}) {
    CAPTURE(surface.is_sphere());
    const Points3 x = make_grid({.cells = 300,
                                 .surface = surface,
                                 .start = {.kind = CvtStart::Kind::random},
                                 .stop = {.iterations = 20}})
                          .mesh.points;
    const auto functional = make_functional(x, surface, Density{}, {});
    Points3 way = random_sphere(x.cols(), 1);
    functional->make_tangential(way, x, {0, x.cols()});
    const auto evaluated = [&](const ShapeFactors& factors, double step) {
      ShapePenalty penalty;
      penalty.factors = factors;
      penalty.spacing = std::sqrt(surface.area() / 260);
      penalty.limits.most_off_midpoint = 0.02;
      functional->penalise(penalty);
      Points3 moved = x;
      functional->retract(x, step, way, moved);
      Evaluation out;
      functional->evaluate(moved, false, true, out);
      return out;
    };
    const Evaluation here = evaluated({1, 3}, 0), pure = evaluated({}, 0);
    CHECK(here.shapes.off_midpoint > 0);
    CHECK(here.penalty > here.shapes.off_midpoint);
    const double slope = (here.gradient - pure.gradient).cwiseProduct(way).sum(),
                 difference = evaluated({1, 3}, h).penalty - evaluated({1, 3}, -h).penalty;
    CHECK(std::abs(difference / (2 * h) / slope - 1) < 1e-4);
  }
}

TEST_CASE("shapes: a penalty of midpoints is the sum over edges of their squared excesses") {
  constexpr double most = 0.02;
  const Mesh mesh = make_grid({.cells = 4000,
                               .resolution = x8(),
                               .start = {.kind = CvtStart::Kind::density},
                               .stop = {.tolerance = 1e-3}})
                        .mesh;
  const Voronoi dual = voronoi(mesh);
  double sum = 0;
  for (Eigen::Index e = 0; e < dual.dc.size(); ++e) {
    const auto right = dual.vertices.col(dual.vertices_on_edge(0, e)),
               left = dual.vertices.col(dual.vertices_on_edge(1, e));
    const double offset = ((right + left).normalized() - dual.edges.col(e)).norm() / dual.dc[e];
    sum += std::pow(std::max(offset - most, 0.0), 2);
  }
  const auto functional = make_functional(mesh.points, Surface::sphere(), x8(), {});
  ShapePenalty penalty;
  penalty.factors = {1, 1};
  penalty.limits.most_off_midpoint = most;
  functional->penalise(penalty);
  Evaluation out;
  functional->evaluate(mesh.points, false, true, out);
  CHECK(sum > 0);
  CHECK(std::abs(out.shapes.off_midpoint / sum - 1) < 0.02); // triangles count as flat
}
