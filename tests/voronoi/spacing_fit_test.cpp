// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/delaunay.h"
#include "voronoi/spacing_fit.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

// The spacing of cells against a map of the sphere that is known: Schmidt's conformal one, which
// makes a lattice finer around one pole and coarser around the other.

using namespace calotte;
using voronoi_detail::spacing_fit;
using voronoi_detail::SpacingFit;

namespace {

/// z of the image of a place at height z; a lattice becomes sqrt(stretch) times as wide at the
/// south pole, and as much finer at the north pole.
double mapped(double z, double stretch) {
  const double c = stretch;
  return ((c - 1) + (c + 1) * z) / ((c + 1) + (c - 1) * z);
}

/// The factor of lengths at the image of height z.
double factor_at(double image, double stretch) {
  const double z = mapped(image, 1 / stretch);
  return std::sqrt((1 - image * image) / (1 - z * z));
}

struct Graded {
  Voronoi cells;
  Eigen::VectorXd density; ///< by the map
  double nominal;          ///< spacing where it is 1
};

Graded graded(int count, double stretch) {
  Points3 points = fibonacci_sphere(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double z = mapped(points(2, i), stretch);
    points.col(i).head<2>() *= std::sqrt((1 - z * z) / points.col(i).head<2>().squaredNorm());
    points(2, i) = z;
  }
  Graded out{voronoi(delaunay(points)), Eigen::VectorXd(count), 0};
  double finest = 1e9;
  for (Eigen::Index i = 0; i < count; ++i)
    finest = std::min(finest, factor_at(points(2, i), stretch));
  for (Eigen::Index i = 0; i < count; ++i)
    out.density[i] = std::pow(finest / factor_at(points(2, i), stretch), 4);
  out.nominal =
      finest * std::sqrt(4 * std::numbers::pi / count * 2 / std::numbers::sqrt3); // hexagons
  return out;
}

double middle(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
  return values[values.size() / 2];
}

double median_of_dc(const Voronoi& cells) { return middle({cells.dc.begin(), cells.dc.end()}); }

} // namespace

TEST_CASE("the density that follows from the spacing is that of the map") {
  for (const double stretch : {4.0, 16.0}) {
    CAPTURE(stretch);
    const Graded grid = graded(4000, stretch);
    const Eigen::VectorXd density = spacing_density(grid.cells);
    REQUIRE(density.size() == 4000);
    CHECK(density.maxCoeff() == 1);
    CHECK(density.minCoeff() > 0);
    std::vector<double> ratios;
    for (Eigen::Index i = 0; i < density.size(); ++i)
      ratios.push_back(std::pow(density[i] / grid.density[i], 0.25));
    std::sort(ratios.begin(), ratios.end());
    CHECK(ratios[100] > 0.9);
    CHECK(ratios[3900] < 1.1);
  }
}

TEST_CASE("meshes without a law of their spacing have none") {
  CHECK(spacing_density(voronoi(delaunay(bisected_icosahedron(3)))).size() == 0);
  CHECK(spacing_density(voronoi(delaunay(fibonacci_sphere(3000)))).size() == 0);
  for (const int count : {60, 600, 6000})
    CHECK(spacing_density(voronoi(delaunay(random_sphere(count, 3)))).size() == 0);
  CHECK(spacing_density(voronoi(hexagonal_box(12, 10, 0.5))).size() == 0);
}

TEST_CASE("the nominal spacing is that of the map, and is that of the cells") {
  const Graded grid = graded(4000, 9);
  const double nominal = voronoi_detail::nominal_spacing(grid.cells, grid.density);
  CHECK(nominal == doctest::Approx(grid.nominal).epsilon(0.02));
  const SpacingFit fit = spacing_fit(grid.cells, grid.density, nominal);
  CHECK(fit.cells == 4000);
  CHECK(fit.median == doctest::Approx(1).epsilon(0.02));
  CHECK(fit.high / fit.low < 1.1);
}

TEST_CASE("a wrong nominal spacing, and a wrong density, are told apart") {
  const Graded grid = graded(4000, 9);
  const double nominal = voronoi_detail::nominal_spacing(grid.cells, grid.density);
  const SpacingFit scaled = spacing_fit(grid.cells, grid.density, 3 * nominal);
  CHECK(scaled.median == doctest::Approx(1.0 / 3).epsilon(0.03));
  CHECK(scaled.high / scaled.low < 1.1);
  const double mean = voronoi_detail::nominal_spacing(grid.cells, {});
  const SpacingFit uniform = spacing_fit(grid.cells, {}, mean);
  CHECK(uniform.high / uniform.low > 3); // spacings vary by a factor of 9
  Eigen::VectorXd gap = grid.density;    // cells without density do not count
  gap.head(10).setZero();
  CHECK(spacing_fit(grid.cells, gap, nominal).cells == 3990);
}

TEST_CASE("independent random sites scatter, but fit a uniform density") {
  for (const int count : {40, 400, 4000}) {
    const Voronoi cells = voronoi(delaunay(random_sphere(count, 8)));
    const SpacingFit fit = spacing_fit(cells, {}, voronoi_detail::nominal_spacing(cells, {}));
    CHECK(fit.median == doctest::Approx(1).epsilon(0.05));
    CHECK(fit.high / fit.low < 1.6);
  }
}

TEST_CASE("cells along a boundary tell nothing of the spacing") {
  // A lattice with sites on the boundary of its domain, whose cells there are halves and quarters.
  constexpr double spacing = 0.25;
  constexpr std::int64_t columns = 20, last_row = 16;
  const Mesh box = hexagonal_box(columns, 20, spacing);
  const Eigen::Vector2d upper(4, box.points(1, last_row * columns));
  const Surface domain = rectangle({0, 0}, upper);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < box.points.cols(); ++i)
    if (domain.contains(box.points.col(i)))
      kept.push_back(i);
  const Voronoi cells = voronoi(delaunay(box.points(Eigen::all, kept), domain));
  CHECK(voronoi_detail::nominal_spacing(cells, {}) == doctest::Approx(spacing).epsilon(1e-9));
  CHECK(median_of_dc(cells) == doctest::Approx(spacing).epsilon(1e-9));
  CHECK(nominal_spacing(cell_fields(cells)) < 0.98 * spacing); // with the boundary's
  const SpacingFit fit = spacing_fit(cells, {}, spacing);
  CHECK(fit.cells > 100);
  CHECK(fit.cells < cells.cells.cols());
  CHECK(fit.low == doctest::Approx(1).epsilon(1e-9));
  CHECK(fit.high == doctest::Approx(1).epsilon(1e-9));
}
