// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/demand.h"

#include "base/parallel.h"
#include "base/points.h"
#include "density/density_evaluator.h"
#include "density/hexagons.h"
#include "integrals/integrand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace calotte::quality_detail {
namespace {

constexpr std::size_t batch = 512;

/// Collects nodes in rows of coordinates, which are evaluated when they are full.
class Batch {
public:
  explicit Batch(const DensityEvaluator& density) : density_(&density) {}

  void add(const Vec3& p, double weight) {
    x_[count_] = p.x;
    y_[count_] = p.y;
    z_[count_] = p.z;
    weight_[count_] = weight;
    if (++count_ == batch)
      finish();
  }
  void finish() {
    (*density_)(std::span(x_).first(count_), std::span(y_).first(count_),
                std::span(z_).first(count_), std::span(rho_).first(count_));
    for (std::size_t j = 0; j < count_; ++j)
      sum_ += weight_[j] * std::sqrt(rho_[j]);
    count_ = 0;
  }
  double sum() const { return sum_; }

private:
  const DensityEvaluator* density_;
  std::array<double, batch> x_, y_, z_, weight_, rho_;
  std::size_t count_ = 0;
  double sum_ = 0;
};

/// Adds the nodes of a flat triangle, projected from the centre: the solid angle of an area A in a
/// plane at the distance D is D A / |p|^3, and D times the triangle's area is half the determinant.
void add_triangle(const std::array<Vec3, 3>& corner, std::span<const QuadratureRule::Node> nodes,
                  Batch& out) {
  const double twice = dot(corner[0], cross(corner[1], corner[2]));
  for (const QuadratureRule::Node& node : nodes) {
    const Vec3 p = node.a * corner[0] + node.b * corner[1] + node.c * corner[2];
    const double square = dot(p, p), length = std::sqrt(square);
    out.add((1 / length) * p, 0.5 * twice * node.weight / (square * length));
  }
}

/// The parts into which a side of a triangle is divided. The error is 1e-6 for rasters of 1 degree,
/// whose kinks cause larger errors than a bump of 8:1.
int divisions_for(std::int64_t triangles) {
  constexpr double enough = 200000, most = 128;
  return static_cast<int>(
      std::clamp(std::ceil(std::sqrt(enough / static_cast<double>(triangles))), 1.0, most));
}

double over_triangles(const Mesh& mesh, const Density& density) {
  constexpr int rule = 6;
  const std::int64_t m = mesh.triangles.cols();
  const Integrand integrand = make_integrand(density, rule, divisions_for(m));
  std::vector<double> sums(static_cast<std::size_t>(block_count(m)));
  for_each_block(m, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Batch nodes(integrand.density);
    for (std::int64_t t = begin; t != end; ++t)
      add_triangle({column(mesh.points, mesh.triangles(0, t)),
                    column(mesh.points, mesh.triangles(1, t)),
                    column(mesh.points, mesh.triangles(2, t))},
                   integrand.nodes, nodes);
    nodes.finish();
    sums[static_cast<std::size_t>(block)] = nodes.sum();
  });
  double sum = 0;
  for (const double of_block : sums)
    sum += of_block;
  return sum;
}

double over_cells(const ClosedMesh& closed, const Density& density) {
  constexpr std::int64_t many = 10000;
  const bool few = closed.generators < many;
  double sum = 0;
  for (const double mass : moments_of(closed, site_density(density), few ? 6 : 3, few ? 2 : 1).mass)
    sum += mass;
  return sum;
}

} // namespace

double root_integral(const ClosedMesh& closed, const Density& density) {
  if (density.uniform())
    return closed.surface.area();
  return closed.surface.is_sphere() ? over_triangles(closed.mesh, density)
                                    : over_cells(closed, density);
}

void set_energy(Quality& quality, double energy, double root_integral) {
  quality.energy = energy;
  quality.limit = hexagon_energy * root_integral * root_integral;
  quality.excess = energy * static_cast<double>(quality.cells) / quality.limit - 1;
}

DoubleVector inverse_spacings(const Points3Ref& points, const Density& density,
                              double root_integral) {
  const double h = hexagon_width(root_integral / static_cast<double>(points.cols())); // at rho = 1
  return evaluate(density, points).cwiseSqrt().cwiseSqrt() / h;
}

} // namespace calotte::quality_detail
