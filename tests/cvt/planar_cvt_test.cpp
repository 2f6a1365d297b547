// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/cells.h"
#include "cvt/state.h"
#include "delaunay/delaunay.h"
#include "density/surface_density.h"
#include "support/constants.h"
#include "support/descent.h"
#include "support/errors.h"
#include "support/random.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/quality.h>
#include <calotte/raster.h>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace calotte;
using namespace calotte::test;
using namespace calotte::cvt_detail;
using base_detail::with_z;

/// E n / area^2 of regular hexagons.
const double hexagons = 5 * std::sqrt(3.0) / 54;

Points2 ring_of(const std::vector<std::array<double, 2>>& corners) {
  Points2 ring(2, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i)
    ring.col(static_cast<Eigen::Index>(i)) << corners[i][0], corners[i][1];
  return ring;
}

/// A closed curve of radius r with waves of many lengths.
Points2 coast(int corners, double r, Eigen::Vector2d at) {
  Points2 ring(2, corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * i / corners;
    const double radius = r * (1 + 0.25 * std::sin(3 * angle + 1) + 0.08 * std::sin(17 * angle) +
                               0.03 * std::sin(101 * angle));
    ring.col(i) << at.x() + radius * std::cos(angle), at.y() + radius * std::sin(angle);
  }
  return ring;
}

/// A lake with islands, one of them with a pond: some thousand edges.
Surface lake() {
  return Surface::plane().within({coast(3000, 1, {0, 0}), coast(500, 0.2, {0.35, 0.2}),
                                  coast(400, 0.15, {-0.4, -0.2}), coast(100, 0.05, {0.35, 0.2})});
}

/// A comb: its teeth are narrower than cells.
Surface comb() {
  std::vector<std::array<double, 2>> corners{{0, 0}, {10, 0}, {10, 3}};
  for (int tooth = 9; tooth > 0; --tooth) {
    corners.push_back({tooth + 0.02, 3});
    corners.push_back({tooth + 0.01, 0.5});
    corners.push_back({tooth - 0.01, 0.5});
    corners.push_back({tooth - 0.02, 3});
  }
  corners.push_back({0, 3});
  return Surface::plane().within({ring_of(corners)});
}

Surface unit_square() { return rectangle({0, 0}, {1, 1}); }

Points2 random_start(const Surface& domain, std::int64_t n, std::uint64_t seed) {
  test::Random random(seed);
  Points2 points(2, n);
  if (domain.is_box()) {
    for (Eigen::Index i = 0; i < n; ++i)
      points.col(i) << random.real(0, domain.period().x()), random.real(0, domain.period().y());
    return points;
  }
  const Outline outline(domain.rings());
  for (Eigen::Index i = 0; i < n;) {
    const Vec2 place{random.real(outline.box().low.x, outline.box().high.x),
                     random.real(outline.box().low.y, outline.box().high.y)};
    if (outline.side(place) == Side::inside)
      points.col(i++) << place.x, place.y;
  }
  return points;
}

/// The generators' moments, one region.
struct AllMoments {
  Eigen::VectorXd mass, energy;
  Points2 first;
};

AllMoments planar_moments(const Points2& points, const Surface& domain, const Density& density,
                          int regions = 1, int rule = 6) {
  const Points3 x = with_z(points);
  Cells<Plane> cells(domain);
  cells.move(x);
  const Connectivity mesh = cells.triangulate();
  Array<std::int32_t> owner(cells.site_count());
  for (std::int64_t i = 0; i < owner.size(); ++i)
    owner[i] = static_cast<std::int32_t>(i % regions);
  const std::vector<Patch> patches =
      make_patches(mesh.triangles, make_ownership(std::move(owner), regions));
  const Integrand integrand = make_integrand(density, rule, 1);
  AllMoments all{Eigen::VectorXd(points.cols()), Eigen::VectorXd(points.cols()),
                 Points2(2, points.cols())};
  for (const Patch& patch : patches) {
    Array<Vec3> places(std::ssize(patch.sites));
    for (std::int64_t i = 0; i < places.size(); ++i)
      places[i] = cells.position(patch.sites[static_cast<std::size_t>(i)]);
    Array<CellMoments> moments(places.size());
    std::vector<std::int32_t> suspects;
    cells.integrate(integrand, patch, places, moments, suspects);
    for (std::int32_t i = 0; i < patch.owned; ++i)
      if (const std::int32_t site = patch.sites[static_cast<std::size_t>(i)];
          site < points.cols()) {
        all.mass[site] = moments[i].first.z;
        all.first.col(site) << moments[i].first.x, moments[i].first.y;
        all.energy[site] = moments[i].energy;
      }
  }
  return all;
}

double scaled_energy(const CvtReport& report, double domain_area) {
  const CvtIteration& last = report.iterations.back();
  return last.energy * static_cast<double>(last.cells) / (domain_area * domain_area);
}

constexpr std::array all_methods{Method::lloyd, Method::lbfgs, Method::lbfgs_laplacian,
                                 Method::automatic};

} // namespace

TEST_CASE("areas of clipped cells sum to the domain's, for any shape and generators") {
  for (const Surface& domain : {unit_square(), lake(), comb()})
    for (const std::int64_t n : {1, 2, 3, 10, 100, 3000}) {
      CAPTURE(n);
      const Points2 points = random_start(domain, n, static_cast<std::uint64_t>(n));
      const AllMoments moments = planar_moments(points, domain, {});
      CHECK(moments.mass.sum() == doctest::Approx(domain.area()).epsilon(1e-12));
      CHECK(moments.mass.minCoeff() > 0);
      CHECK(moments.energy.minCoeff() > 0);
    }
}

TEST_CASE("areas sum where the boundary runs along cells' sides and through their corners") {
  Surface::Rings straight = rectangle({0, 0}, {4, 3}).rings();
  straight.push_back(ring_of({{1, 0.3}, {1.2, 0.3}, {1.2, 2.7}, {1, 2.7}}));
  straight.push_back(ring_of({{2, 1}, {2.2, 1}, {2.2, 2}, {2, 2}}));
  straight.push_back(ring_of({{3, 1}, {3.25, 1.5}, {3, 2}, {2.75, 1.5}}));
  for (const double angle : {0.0, 0.1, 0.3, 0.5, 0.7, 1.0, 2.0, 3.0})
    for (const double size : {1.0, 1e-3, 1e25})
      for (const double place : {0.0, 1e6}) {
        CAPTURE(angle);
        CAPTURE(size);
        CAPTURE(place);
        const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
        const auto moved = [&](const Points2& points) {
          Points2 result = size * turn * points;
          result.array() += size * place;
          return result;
        };
        if (size * place > 1e30)
          continue;
        Surface::Rings rings;
        for (const DoubleMatrix& ring : straight)
          rings.emplace_back(moved(ring));
        const Surface domain = Surface::plane().within(rings);
        Points2 lattice(2, 12);
        for (int i = 0; i < 12; ++i)
          lattice.col(i) << i % 4 + 0.5, i / 4 + 0.5;
        const double sum = planar_moments(moved(lattice), domain, {}).mass.sum();
        CHECK(sum == doctest::Approx(domain.area()).epsilon(1e-10));
      }
}

TEST_CASE("a cell of one generator has the domain's own moments") {
  const AllMoments square = planar_moments(Eigen::Vector2d(0.25, 0.5), unit_square(), {});
  CHECK(square.mass[0] == doctest::Approx(1));
  CHECK(square.first(0, 0) == doctest::Approx(0.25));
  CHECK(square.first(1, 0) == doctest::Approx(0).epsilon(1e-12));
  CHECK(square.energy[0] == doctest::Approx(1.0 / 6 + 1.0 / 16));
}

TEST_CASE("cells agree with brute force by nearest generators") {
  const Surface domain = lake();
  const Outline outline(domain.rings());
  const Points2 points = random_start(domain, 40, 3);
  const AllMoments moments = planar_moments(points, domain, {});
  const int side = 1200;
  const double width = outline.box().high.x - outline.box().low.x,
               height = outline.box().high.y - outline.box().low.y,
               pixel = width / side * (height / side);
  AllMoments counted{Eigen::VectorXd::Zero(40), Eigen::VectorXd::Zero(40), Points2::Zero(2, 40)};
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Eigen::Vector2d p(outline.box().low.x + (i + 0.5) * width / side,
                              outline.box().low.y + (j + 0.5) * height / side);
      if (outline.side({p.x(), p.y()}) == Side::outside)
        continue;
      Eigen::Index nearest = 0;
      const double square = (points.colwise() - p).colwise().squaredNorm().minCoeff(&nearest);
      counted.mass[nearest] += pixel;
      counted.energy[nearest] += pixel * square;
      counted.first.col(nearest) += pixel * (p - points.col(nearest));
    }
  for (Eigen::Index k = 0; k < 40; ++k) {
    CHECK(moments.mass[k] == doctest::Approx(counted.mass[k]).epsilon(0.02));
    CHECK(moments.energy[k] == doctest::Approx(counted.energy[k]).epsilon(0.03));
  }
}

TEST_CASE("the quadrature is exact for polynomials of its degree") {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (3 + x.row(0).array() * x.row(1).array() - 2 * x.row(0).array().square()).matrix();
  };
  const double exact = 3 + 0.25 - 2.0 / 3;
  for (const std::int64_t n : {1, 5, 200}) {
    const Points2 points = random_start(unit_square(), n, 5);
    for (const int rule : {3, 6})
      CHECK(planar_moments(points, unit_square(), density, 1, rule).mass.sum() ==
            doctest::Approx(exact).epsilon(1e-12));
  }
}

TEST_CASE("moments have the same bits for any regions") {
  Density bump = tanh_bump({0.3, 0.4, 0}, 0.2, 0.1, 0.01);
  for (const Surface& domain : {lake(), Surface::periodic({2, 1.5})})
    for (const Density& density : {Density{}, surface_density(bump, domain)}) {
      const Points2 points = random_start(domain, 2000, 9);
      const AllMoments one = planar_moments(points, domain, density),
                       many = planar_moments(points, domain, density, 17);
      CHECK(one.mass == many.mass);
      CHECK(one.energy == many.energy);
      CHECK(one.first == many.first);
    }
}

TEST_CASE("a periodic lattice of regular hexagons is a fixed point, with the hexagons' energy") {
  const Mesh lattice = hexagonal_box(24, 28, 0.37);
  const Surface& box = lattice.surface;
  for (const Method method : all_methods) {
    const Cvt grid =
        make_grid({.surface = box, .start = {.points = lattice.points}, .method = method},
                  {.decomposition = {.regions = 4}});
    CHECK(grid.report.converged);
    CHECK(grid.report.iterations.size() == 1);
    CHECK(grid.report.iterations.back().flips == 0);
    CHECK_FALSE(grid.report.iterations.back().rebuilt);
    CHECK(grid.report.residual < 1e-12);
    CHECK(scaled_energy(grid.report, box.area()) == doctest::Approx(hexagons).epsilon(1e-12));
    CHECK(grid.mesh.triangles == lattice.triangles);
  }
}

TEST_CASE("every method brings the energy down, in every kind of domain") {
  for (const Surface& domain : {unit_square(), lake(), comb(), Surface::periodic({3, 1})}) {
    for (const bool refined : {false, true})
      for (const Method method : all_methods) {
        CAPTURE(static_cast<int>(method));
        const Cvt grid = make_grid(
            {.resolution = refined ? tanh_bump({0.4, 0.3, 0}, 0.3, 0.15, 1.0 / 81) : Density{},
             .surface = domain,
             .start = {.points = with_z(random_start(domain, 300, 11))},
             .stop = {.max_iterations = 25},
             .method = method},
            {.decomposition = {.regions = 4}});
        check_descent(grid.report, 1e-12);
        CHECK(grid.report.iterations.back().energy < 0.85 * grid.report.iterations.front().energy);
        REQUIRE(grid.mesh.points.cols() == 300);
        for (const auto& x : grid.mesh.points.colwise())
          REQUIRE(domain.contains(x));
        CHECK(grid.mesh.triangles == delaunay(grid.mesh.points, domain).triangles);
      }
  }
}

// Slow: a run for each number of threads and of regions, and for each interruption.
TEST_CASE("the same bits for any threads and regions, and after any interruption [slow]") {
  for (const Surface& domain : {lake(), Surface::periodic({1, 1})})
    for (const Method method : {Method::lloyd, Method::automatic}) {
      const Recipe recipe{.resolution = tanh_bump({0.4, 0.3, 0}, 0.3, 0.15, 1.0 / 16),
                          .surface = domain,
                          .start = {.points = with_z(random_start(domain, 800, 21))},
                          .stop = {.max_iterations = 16},
                          .method = method};
      std::vector<CvtState> states;
      const auto keep = [&](const Progress& now) {
        if (now.run->report.iterations.size() % 7 == 3)
          states.push_back(now.run->state);
        return ProgressReply::proceed;
      };
      const Cvt reference = make_grid(recipe, {.decomposition = {.regions = 1}, .progress = keep});
      for (const int regions : {2, 9, 50})
        for (const int threads : {1, 4}) {
          tbb::task_arena arena(threads);
          const Cvt other = arena.execute(
              [&] { return make_grid(recipe, {.decomposition = {.regions = regions}}); });
          REQUIRE(other.mesh.points == reference.mesh.points);
          REQUIRE(other.mesh.triangles == reference.mesh.triangles);
        }
      REQUIRE(!states.empty());
      for (const CvtState& state : states)
        REQUIRE(make_grid(recipe, {.decomposition = {.regions = 50}, .state = state}).mesh.points ==
                reference.mesh.points);
    }
}

TEST_CASE("a state may have generators outside of a periodic box, but not 2^30 periods away") {
  const Surface box = Surface::periodic({1, 1});
  const Recipe recipe{.surface = box,
                      .start = {.points = with_z(random_start(box, 50, 3))},
                      .stop = {.max_iterations = 1},
                      .method = Method::lloyd};
  CvtState state;
  const auto keep = [&](const Progress& now) {
    state = now.run->state;
    return ProgressReply::stop;
  };
  make_grid(recipe, {.progress = keep});
  State::of(state).points(0, 7) += 1;
  CHECK_NOTHROW(make_grid(recipe, {.state = state}));
  State::of(state).points(0, 7) = 1e12;
  CHECK_THROWS_AS(make_grid(recipe, {.state = state}), Error);
}

TEST_CASE("a generator of a piece around a corner stays inside, and the run converges there") {
  // A thin horseshoe: centroids of its cells lie in the bay.
  const Surface horseshoe = Surface::plane().within(
      {ring_of({{0, 0}, {4, 0}, {4, 4}, {3.8, 4}, {3.8, 0.2}, {0.2, 0.2}, {0.2, 4}, {0, 4}})});
  for (const std::int64_t n : {3, 4, 9})
    for (const Method method : {Method::lloyd, Method::lbfgs}) {
      const Cvt grid = make_grid({.surface = horseshoe,
                                  .start = {.points = with_z(random_start(horseshoe, n, 2))},
                                  .stop = {.tolerance = 1e-4},
                                  .method = method});
      CAPTURE(n);
      CHECK(grid.report.converged);
      check_descent(grid.report, 1e-12);
      for (Eigen::Index i = 0; i < n; ++i)
        CHECK(horseshoe.contains(grid.mesh.points.col(i)));
    }
}

TEST_CASE("a density that jumps makes a grid, in a rectangle and in a box") {
  for (const Surface& surface : {rectangle({0, 0}, {4, 3}), Surface::periodic({4, 3})})
    for (const double low : {0.1, 1e-3}) {
      CAPTURE(low);
      CAPTURE(surface.is_bounded());
      Density density;
      density.kind = Density::Kind::callable;
      density.callable = [low](const Eigen::Ref<const Points3>& x,
                               Eigen::Ref<Eigen::VectorXd> rho) {
        for (Eigen::Index i = 0; i < x.cols(); ++i)
          rho[i] = x(0, i) > 1 && x(0, i) < 2 ? 1 : low;
      };
      const Cvt grid = make_grid({.cells = 800, .resolution = density, .surface = surface});
      CHECK(grid.mesh.points.cols() == 800);
      CHECK(grid.report.converged);
      // As many cells lie in the band as the integral of sqrt(rho) has there.
      const auto inside =
          ((grid.mesh.points.row(0).array() > 1) && (grid.mesh.points.row(0).array() < 2)).count();
      CHECK(static_cast<double>(inside) / 800 ==
            doctest::Approx(1 / (1 + 3 * std::sqrt(low))).epsilon(0.05));
    }
}

TEST_CASE("in a box a triangle whose nearest copies do not close is invalid") {
  const Plane box(Vec2{1, 1});
  std::array<Vec3, 3> points{Vec3{0.5, 0.5, 0}, Vec3{0.9, 0.4, 0}, Vec3{0.6, 0.8, 0}};
  const auto is_valid = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    Connectivity mesh{Triangles(3, 1), Triangles::Constant(3, 1, -1)};
    mesh.triangles << a, b, c;
    Faults faults;
    add_faults(mesh, SitePositions<Plane>{box, points}, 0, faults);
    return faults.overturned.empty();
  };
  CHECK(is_valid(0, 1, 2));
  CHECK_FALSE(is_valid(0, 2, 1));
  points[2] = {0.1, 0.7, 0}; // nearer to the second's copy to its right
  CHECK_FALSE(is_valid(0, 1, 2));
  CHECK_FALSE(is_valid(0, 2, 1));
}

TEST_CASE("bisection: periodic boxes have four times the cells, other domains the edges inside") {
  const auto bisected_twice = [](const Surface& domain) {
    const Points3 start = with_z(random_start(domain, 100, 4));
    return make_grid({.surface = domain,
                      .start = {.points = start, .bisections = 2},
                      .stop = {.tolerance = 1e-2}});
  };
  const Cvt periodic = bisected_twice(Surface::periodic({1, 1}));
  CHECK(periodic.mesh.points.cols() == 1600);
  CHECK(periodic.report.converged);
  const Cvt open = bisected_twice(lake());
  CHECK(open.mesh.points.cols() > 1000);
  for (const auto& x : open.mesh.points.colwise())
    REQUIRE(open.mesh.surface.contains(x));
}

TEST_CASE(
    "the number of evaluations with the graph Laplacian does not grow with the number of cells") {
  std::vector<std::size_t> evaluations;
  for (const int columns : {16, 32, 64, 128}) {
    const Mesh lattice = hexagonal_box(columns, columns, 1.0 / columns);
    const Surface& box = lattice.surface;
    test::Random random(5);
    Points3 start = lattice.points;
    const Plane plane(box.period());
    for (Eigen::Index i = 0; i < start.cols(); ++i) {
      Eigen::Vector2d at = start.col(i).head<2>();
      for (int k = 0; k < 2; ++k) // smooth, and rough
        at[k] = start(k, i) + 0.02 * std::sin(2 * pi * at[1 - k] / box.period()[1 - k]) +
                0.1 / columns * random.real(-1, 1);
      base_detail::set_column(start, i, plane.wrapped({at.x(), at.y(), 0}));
    }
    const Cvt grid = make_grid({.surface = box,
                                .start = {.points = start},
                                .stop = {.tolerance = 1e-7},
                                .method = Method::lbfgs_laplacian},
                               {.decomposition = {.regions = 4}});
    CHECK(grid.report.converged);
    CHECK(scaled_energy(grid.report, box.area()) == doctest::Approx(hexagons).epsilon(1e-9));
    evaluations.push_back(grid.report.iterations.size());
  }
  MESSAGE(evaluations[0] << " " << evaluations[1] << " " << evaluations[2] << " "
                         << evaluations[3]);
  CHECK(evaluations[3] < 1.5 * static_cast<double>(evaluations[0]));
  CHECK(evaluations[3] < 60);
}

TEST_CASE("the graph Laplacian works if the boundary faces away from generators") {
  const Surface domain = Surface::plane().within(
      {rectangle({0, 0}, {4, 3}).rings()[0], ring_of({{1, 0.3}, {1.2, 0.3}, {1.2, 2.7}, {1, 2.7}}),
       ring_of({{2, 1}, {2.2, 1}, {2.2, 2}, {2, 2}})});
  Points2 lattice(2, 48);
  for (int i = 0; i < 48; ++i)
    lattice.col(i) << i % 8 * 0.5 + 0.25, i / 8 * 0.5 + 0.25;
  Recipe recipe{.surface = domain,
                .start = {.points = with_z(lattice)},
                .stop = {.iterations = 20},
                .method = Method::lloyd};
  const Cvt by_lloyd = make_grid(recipe);
  recipe.method = Method::lbfgs_laplacian;
  const Cvt by_laplacian = make_grid(recipe);
  CHECK(by_laplacian.mesh.points != by_lloyd.mesh.points); // the method that it falls back to
}

TEST_CASE("clusters, and domains far from the origin or of any size") {
  Points2 cluster = random_start(unit_square(), 200, 6);
  cluster.leftCols(100) = 0.5 + 1e-9 * (cluster.leftCols(100).array() - 0.5);
  for (const double scale : {1e-20, 1.0, 1e20})
    for (const double offset : {0.0, 1e6}) {
      CAPTURE(scale);
      CAPTURE(offset);
      const Eigen::Vector2d low(offset * scale, -offset * scale);
      const Surface domain = rectangle(low, low + Eigen::Vector2d(scale, scale));
      const Points2 start =
          (scale * (offset == 0 ? cluster : random_start(unit_square(), 200, 6))).colwise() + low;
      const Cvt grid = make_grid(
          {.surface = domain, .start = {.points = with_z(start)}, .stop = {.tolerance = 1e-4}},
          {.decomposition = {.regions = 4}});
      CHECK(grid.report.converged);
      CHECK(scaled_energy(grid.report, domain.area()) == doctest::Approx(hexagons).epsilon(0.08));
    }
}

TEST_CASE("quality of hexagons in a box, and of clipped cells") {
  const Mesh lattice = hexagonal_box(24, 28, 0.37);
  const Quality hexagonal = quality(lattice);
  CHECK(hexagonal.triangles == 2 * 24 * 28);
  CHECK(hexagonal.degrees[6] == 24 * 28);
  CHECK(hexagonal.spacing.min == doctest::Approx(0.37));
  CHECK(hexagonal.spacing.max == doctest::Approx(0.37));
  CHECK(hexagonal.cell_area.max == doctest::Approx(std::sqrt(3.0) / 2 * 0.37 * 0.37));
  CHECK(hexagonal.triangle_quality.min == doctest::Approx(1));
  CHECK(hexagonal.obtuse == 0);
  CHECK(hexagonal.cells_area == doctest::Approx(1).epsilon(1e-12));
  CHECK(hexagonal.residual < 1e-12);

  const Cvt grid =
      make_grid({.surface = lake(), .start = {.points = with_z(random_start(lake(), 500, 3))}});
  const Quality clipped = quality(grid.mesh);
  CHECK(clipped.cells == 500);
  CHECK(clipped.cells_area == doctest::Approx(1).epsilon(1e-10));
  CHECK(clipped.residual < 1e-5);
  CHECK(clipped.spacing.max < 0.3); // edges across land are not counted
  std::int64_t whole = 0;
  for (const std::int64_t cells : clipped.degrees)
    whole += cells;
  CHECK(whole > 200);
  CHECK(whole < 500);
}

TEST_CASE("a raster is bilinear, and constant beyond its rim") {
  Raster raster{Eigen::Vector3d(0, 1, 3), Eigen::Vector2d(0, 2), Eigen::MatrixXd(3, 2), true};
  raster.values << 1, 2, 3, 5, 4, 8;
  const Density density = interpolated_density(raster);
  Points3 x(3, 4);
  x << 0.5, 2, -7, 3, 1, 0, 0, 9, 0, 0, 0, 0;
  const Eigen::VectorXd values = evaluate(density, x);
  CHECK(values[0] == doctest::Approx((1 + 3 + 2 + 5) / 4.0));
  CHECK(values[1] == doctest::Approx(3.5));
  CHECK(values[2] == doctest::Approx(1));
  CHECK(values[3] == doctest::Approx(8));
  raster.values(1, 1) = -1;
  CHECK_THROWS_AS(interpolated_density(raster), Error);
  CHECK(evaluate(tanh_bump({0.05, 0.5, 0}, 0.2, 0.1, 0.01), Points2(Eigen::Vector2d(0.95, 0.5)),
                 Surface::periodic({1, 1}))[0] > 0.7); // around the edge
}

TEST_CASE("bad input ends in one clear error") {
  const auto error = [](const Points2& start, const Surface& domain, const Density& density = {}) {
    return error_of([&] {
      make_grid({.resolution = density, .surface = domain, .start = {.points = with_z(start)}});
    });
  };
  Points2 start = random_start(unit_square(), 20, 1);
  start.col(7) << 1.5, 0.5;
  CHECK(std::string(error(start, unit_square()).what()).find("point 7 is outside of the domain") ==
        0);
  start.col(7) << NAN, 0.5;
  CHECK(error(start, unit_square()).code() == ErrorCode::not_finite);
  CHECK(error(start, Surface::plane()).code() == ErrorCode::invalid_argument);
  const Points2 line = ring_of({{0.1, 0.5}, {0.5, 0.5}, {0.9, 0.5}});
  CHECK(error(line, unit_square()).code() == ErrorCode::degenerate);
  CHECK(error(line.leftCols(2), unit_square()).code() == ErrorCode::too_few_sites);
  Density nothing;
  nothing.kind = Density::Kind::callable;
  nothing.callable = [](const Eigen::Ref<const Points3>&, Eigen::Ref<Eigen::VectorXd> rho) {
    rho.setZero();
  };
  CHECK(error(random_start(unit_square(), 20, 1), unit_square(), nothing).code() ==
        ErrorCode::invalid_argument);
}

// Slow: up to 3 000 iterations for 10 000 generators.
TEST_CASE("10 000 generators of the unit square come near the hexagons' energy [slow]") {
  const Points3 start = with_z(random_start(unit_square(), 10'000, 1));
  const Cvt grid = make_grid({.surface = unit_square(),
                              .start = {.points = start},
                              .stop = {.tolerance = 1e-4, .max_iterations = 3000}});
  const double energy = scaled_energy(grid.report, 1);
  MESSAGE("E n / area^2 over the hexagons': " << energy / hexagons << ", "
                                              << grid.report.iterations.size() << " evaluations");
  CHECK(energy > hexagons);
  CHECK(energy < 1.015 * hexagons);
}
