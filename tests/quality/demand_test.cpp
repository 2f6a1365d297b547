// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "delaunay/delaunay.h"
#include "quality/long_doubles.h"
#include "support/constants.h"
#include "support/densities.h"
#include "support/laws.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/voronoi.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using EdgeEnds = std::pair<std::int32_t, std::int32_t>;

double limit_of(double root_integral) {
  return 5 / (18 * std::sqrt(3.0)) * root_integral * root_integral;
}

/// The integral over the sphere of f(t), t the angle from an axis.
template <class Function> double zonal_integral(const Function& f) {
  constexpr int parts = 200000;
  double sum = 0;
  for (int k = 0; k < parts; ++k) {
    const double t = (k + 0.5) * pi / parts;
    sum += f(t) * std::sin(t);
  }
  return 2 * pi * sum * pi / parts;
}

double x8_profile(double t) {
  constexpr double gamma = 1.0 / 4096;
  return (std::tanh((pi / 6 - t) / 0.2) + 1) / (2 * (1 - gamma)) + gamma;
}

/// What the header defines, from the list of all edges.
struct DemandByDefinition {
  std::vector<double> fits, ratios;
  std::int64_t short_edges = 0, mismatched_edges = 0;
  std::map<std::int32_t, std::vector<double>> arcs; ///< by cell
  std::set<std::int32_t> bad;

  Vector at(const Mesh& mesh, std::int32_t i) const {
    return mesh.points.col(i).cast<Real>().normalized();
  }

  DemandByDefinition(const Mesh& mesh, const Density& density, double root_integral) {
    const double n = static_cast<double>(mesh.points.cols());
    const double h = std::sqrt(2 / (std::sqrt(3.0) * n) * root_integral);
    const Eigen::VectorXd inverse = evaluate(density, mesh.points).array().pow(0.25) / h;
    std::map<EdgeEnds, Vector> left; // the circumcentre to the left of each way
    for (std::int64_t t = 0; t < mesh.triangles.cols(); ++t) {
      const Triple v = triple(mesh, t);
      const Vector a = at(mesh, v[0]), b = at(mesh, v[1]), c = at(mesh, v[2]);
      for (std::size_t i = 0; i < 3; ++i)
        left[{v[i], v[(i + 1) % 3]}] = (b - a).cross(c - a).normalized();
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector p = at(mesh, v[i]);
        if ((at(mesh, v[(i + 1) % 3]) - p).dot(at(mesh, v[(i + 2) % 3]) - p) < -1e-9L)
          bad.insert(v.begin(), v.end());
      }
    }
    for (const auto& [edge, centre] : left) {
      const auto [i, j] = edge;
      const Real dc = arc(at(mesh, i), at(mesh, j));
      arcs[i].push_back(static_cast<double>(dc));
      if (i > j)
        continue;
      add(edge, static_cast<double>(dc * (inverse[i] + inverse[j]) / 2),
          static_cast<double>(arc(centre, left.at({j, i})) / dc));
    }
  }

  void add(const EdgeEnds& edge, double fit, double ratio) {
    fits.push_back(fit);
    ratios.push_back(ratio);
    const bool is_short = ratio < 0.18, unfit = fit < 0.75 || fit > 1.4;
    short_edges += is_short;
    mismatched_edges += unfit;
    if (is_short || unfit)
      bad.insert({edge.first, edge.second});
  }

  double percentile(int percent) {
    std::sort(fits.begin(), fits.end());
    const auto count = static_cast<int>(fits.size());
    return fits[static_cast<std::size_t>(std::max((percent * count + 99) / 100 - 1, 0))];
  }
};

void check_definition(const Mesh& mesh, const Density& density, double root_integral) {
  DemandByDefinition truth(mesh, density, root_integral);
  const Quality q = quality(mesh, density);
  CHECK(q.limit == doctest::Approx(limit_of(root_integral)).epsilon(1e-7));
  CHECK(q.excess == doctest::Approx(q.energy * static_cast<double>(q.cells) / q.limit - 1));
  const Percentiles& fit = q.dc_over_h;
  for (const auto& [value, percent] :
       {std::pair(fit.min, 0), std::pair(fit.p1, 1), std::pair(fit.p5, 5), std::pair(fit.p50, 50),
        std::pair(fit.p95, 95), std::pair(fit.p99, 99), std::pair(fit.max, 100)})
    CHECK(value == doctest::Approx(truth.percentile(percent)).epsilon(1e-7));
  CHECK(q.dv_over_dc.min + 1 ==
        doctest::Approx(1 + *std::min_element(truth.ratios.begin(), truth.ratios.end())));
  CHECK(q.dv_over_dc.max ==
        doctest::Approx(*std::max_element(truth.ratios.begin(), truth.ratios.end())));
  CHECK(q.short_edges == truth.short_edges);
  CHECK(q.mismatched_edges == truth.mismatched_edges);
  CHECK(q.bad_cells == std::ssize(truth.bad));
  double sum = 0;
  for (const std::int32_t cell : truth.bad) {
    const std::vector<double>& arcs = truth.arcs.at(cell);
    sum += std::accumulate(arcs.begin(), arcs.end(), 0.0) / static_cast<double>(arcs.size());
  }
  if (q.bad_cells > 0)
    CHECK(q.bad_spacing.mean == doctest::Approx(sum / static_cast<double>(q.bad_cells)));
}

/// Rows of regular hexagons of width 1 in a periodic box.
Mesh hexagons(int columns, int rows) {
  Points2 places(2, columns * rows);
  const double height = std::sqrt(3.0) / 2;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      places.col(j * columns + i) << i + 0.25 + 0.5 * (j % 2), (j + 0.5) * height;
  return delaunay(places, Surface::periodic({static_cast<double>(columns), rows * height}));
}

} // namespace

TEST_CASE("limit, dc/h, dv/dc and the cells to object to are as defined") {
  const Mesh random = delaunay(random_sphere(300, 4)), spiral = delaunay(spiral_sphere(700));
  const double root = zonal_integral([](double t) { return std::sqrt(x8_profile(t)); });
  for (const Mesh& mesh : {random, spiral}) {
    check_definition(mesh, {}, 4 * pi);
    check_definition(mesh, x8(), root);
  }
}

TEST_CASE("the limit of cell widths is that of the number of cells that they imply") {
  Raster widths{Eigen::VectorXd::LinSpaced(72, -180, 175), Eigen::VectorXd::LinSpaced(181, -90, 90),
                Eigen::MatrixXd(72, 181)};
  for (Eigen::Index j = 0; j < 181; ++j)
    widths.values.col(j).setConstant(60 -
                                     30 * std::exp(-std::pow(static_cast<double>(j - 90) / 15, 2)));
  const double least = widths.values.minCoeff() / earth_radius_km;
  const double root = std::sqrt(3.0) / 2 * least * least * implied_cells(widths);
  const Quality q = quality(delaunay(bisected_icosahedron(5)), density_of(widths));
  CHECK(q.limit == doctest::Approx(limit_of(root)).epsilon(1e-6));
}

TEST_CASE("laws: regular hexagons of a periodic box have no excess, and exact ratios") {
  const Mesh mesh = hexagons(24, 28);
  const Quality q = quality(mesh);
  CHECK(std::abs(q.excess) < 1e-12);
  for (const double fit : {q.dc_over_h.min, q.dc_over_h.p50, q.dc_over_h.max})
    CHECK(fit == doctest::Approx(1).epsilon(1e-12));
  for (const double ratio : {q.dv_over_dc.min, q.dv_over_dc.mean, q.dv_over_dc.max})
    CHECK(ratio == doctest::Approx(1 / std::sqrt(3.0)).epsilon(1e-12));
  CHECK(q.short_edges + q.mismatched_edges + q.bad_cells + q.obtuse == 0);
}

TEST_CASE("in a plane the limit is that of the domain, and follows its unit") {
  Points2 places(2, 400);
  for (int k = 0; k < 400; ++k)
    places.col(k) << std::fmod(0.5 + k * 0.7548776662466927, 1),
        std::fmod(0.5 + k * 0.5698402909980532, 1);
  Density linear; // rho^(1/2) = 1 + x
  linear.kind = Density::Kind::callable;
  linear.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = (1 + x.row(0).array()).square().transpose();
  };
  const Surface square = rectangle({0, 0}, {1, 1});
  const Mesh mesh = delaunay(places, square);
  CHECK(quality(mesh).limit == doctest::Approx(limit_of(1)).epsilon(1e-12));
  CHECK(quality(mesh, linear).limit == doctest::Approx(limit_of(1.5)).epsilon(1e-9));
  const Density bump = tanh_bump({0.4, 0.5, 0}, 0.15, 0.05, 1.0 / 256);
  constexpr int side = 2000; // of a lattice of midpoints
  Eigen::Matrix2Xd row(2, side);
  double sum = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i)
      row.col(i) << (i + 0.5) / side, (j + 0.5) / side;
    sum += evaluate(bump, row, square).cwiseSqrt().sum() / side / side;
  }
  CHECK(quality(mesh, bump).limit == doctest::Approx(limit_of(sum)).epsilon(2e-6));
  const Quality small = quality(mesh),
                large = quality(delaunay(Points2(1000 * places), rectangle({0, 0}, {1000, 1000})));
  CHECK(large.excess == doctest::Approx(small.excess));
  CHECK(large.dc_over_h.p50 == doctest::Approx(small.dc_over_h.p50));
  CHECK(large.bad_cells == small.bad_cells);
}

TEST_CASE("a factor of the density changes neither the excess nor dc/h") {
  const Mesh mesh = delaunay(random_sphere(200, 1));
  Density scaled;
  scaled.kind = Density::Kind::callable;
  scaled.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    rho = 7 * evaluate(x8(), x);
  };
  const Quality a = quality(mesh, x8()), b = quality(mesh, scaled);
  CHECK(b.limit == doctest::Approx(7 * a.limit));
  CHECK(b.excess == doctest::Approx(a.excess));
  CHECK(b.dc_over_h.p99 == doctest::Approx(a.dc_over_h.p99));
}

TEST_CASE("the limit and the percentiles have the same bits for any number of threads") {
  const Mesh mesh = delaunay(random_sphere(30000, 5));
  const auto measured = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Quality q = quality(mesh, x8());
    return std::vector<double>{q.limit,         q.excess,          q.dc_over_h.min,
                               q.dc_over_h.p50, q.dv_over_dc.mean, q.bad_spacing.mean};
  };
  const std::vector<double> one = measured(1);
  for (const std::size_t threads : {2, 4})
    CHECK(measured(threads) == one);
}

TEST_CASE("an open mesh has no limit, and no cells to object to") {
  Points3 points(3, 4);
  points << 0, 1, 0, -1, 0, 0, 1, -1, 1, 1, 1, 1;
  const Quality q = triangle_quality(delaunay(points));
  CHECK(q.limit == 0);
  CHECK(q.dc_over_h.max == 0);
  CHECK(q.dv_over_dc.max == 0);
  CHECK(q.short_edges + q.mismatched_edges + q.bad_cells == 0);
}

TEST_CASE("a closed mesh without one triangle has the cells of the closed one, but three") {
  const Mesh closed = delaunay(random_sphere(300, 7));
  Mesh open = closed;
  const Eigen::Index last = open.triangles.cols() - 1;
  for (const std::int32_t other : closed.neighbours.col(last))
    for (int v = 0; v < 3; ++v)
      if (open.neighbours(v, other) == last)
        open.neighbours(v, other) = -1;
  open.triangles.conservativeResize(3, last);
  open.neighbours.conservativeResize(3, last);
  const Voronoi cells = voronoi(closed);
  const CellFields fields = cell_fields(cells);
  double area = 0, least_area = 1, least_quality = 1;
  for (Eigen::Index i = 0; i < closed.points.cols(); ++i) {
    if ((closed.triangles.col(last).array() == i).any())
      continue;
    area += fields.area[i] / (4 * pi);
    least_area = std::min(least_area, fields.area[i]);
    least_quality = std::min(least_quality, fields.quality[i]);
  }
  const Quality q = open_quality(open);
  CHECK(q.cells == 300);
  CHECK(q.cells_area == doctest::Approx(area).epsilon(1e-12));
  CHECK(q.cell_area.min == doctest::Approx(least_area).epsilon(1e-11));
  CHECK(q.cell_quality.min == doctest::Approx(least_quality).epsilon(1e-9));
  CHECK(q.dv_over_dc.max > 0.5);
  CHECK(q.residual == 0);
  CHECK(triangle_quality(open).bad_cells == 0);
}
