// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices that one of Calotte, the neighbour and this program allocates, and another one resizes
// and frees.
#include "consumer.h"
#include "neighbour.h"

#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/locate.h>
#include <calotte/remap.h>
#include <calotte/voronoi.h>

#include <cmath>
#include <iostream>
#include <utility>

namespace {

int faults = 0;

void expect(bool right, const char* what) {
  if (right)
    return;
  std::cerr << "wrong: " << what << '\n';
  ++faults;
}

/// Calotte's points grow in the neighbour; a mesh takes them over and drops the copies; the
/// neighbour frees the mesh.
void pass_points() {
  using namespace calotte;
  const Points3 points = fibonacci_sphere(1000);
  Mesh mesh = delaunay(neighbour::extended(fibonacci_sphere(1000), 10));
  expect(mesh.points == points && mesh.triangles.cols() == 1996,
         "a mesh of the neighbour's points");
  expect(neighbour::sum(std::move(mesh)) == points.sum(), "a mesh that the neighbour frees");

  Eigen::Matrix3Xd aligned = points;
  aligned = neighbour::extended(std::move(aligned), 10);
  expect(delaunay(aligned).points == points, "a mesh of aligned points");
  expect(delaunay(neighbour::extended(Eigen::Matrix3Xd(points), 10)).closed(),
         "a mesh of aligned points handed over");
  expect(delaunay(2 * aligned).triangles.cols() == 1996, "a mesh of an expression");
}

/// A density of the neighbour's values; Calotte's results grow in the neighbour.
void pass_values() {
  using namespace calotte;
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    DoubleVector values = neighbour::ascending(x.cols());
    neighbour::append(values, 1);
    rho = values.head(x.cols()).cwiseQuotient(values.head(x.cols()));
  };
  const Points3 points = random_sphere(300, 1);
  DoubleVector rho = evaluate(density, points);
  Eigen::VectorXd aligned = evaluate(density, points);
  neighbour::append(rho, 1);
  neighbour::append(aligned, 1);
  expect(rho == DoubleVector::Ones(301) && aligned == rho, "values that the neighbour appends to");
  aligned = rho;
  expect(aligned.sum() == 301, "values of the other type");
}

void pass_weights() {
  using namespace calotte;
  const Mesh mesh = delaunay(random_sphere(500, 2));
  const Weights weights = interpolation_weights(mesh, random_sphere(100, 3));
  const Eigen::VectorXd at_sites = Eigen::VectorXd::Ones(500);
  const Eigen::VectorXd values = interpolate(weights, at_sites);
  const DoubleVector same = interpolate(weights, DoubleVector(at_sites));
  expect(values == same, "values of either type");
  const Eigen::VectorXd product = neighbour::product(weights, at_sites);
  expect((product - values).cwiseAbs().maxCoeff() < 1e-12, "weights that the neighbour uses");
  Locations at = locate(mesh, mesh.points);
  at.nearest.conservativeResize(600);
  expect(at.nearest[499] == 499, "ids that the consumer resizes");
}

/// Whole runs, with the factors that the library computes for itself.
void run() {
  using namespace calotte;
  Recipe recipe;
  recipe.start.points = neighbour::extended(random_sphere(2000, 4), 1);
  recipe.stop.iterations = 3;
  Cvt cvt = make_grid(recipe);
  expect(cvt.mesh.triangles.cols() == 3996, "a tessellation");
  Voronoi cells = voronoi(cvt.mesh);
  expect(cells.cell_area.size() == 2000, "cells");
  neighbour::append(cells.cell_area, 0);
  const Eigen::VectorXd areas = cells.cell_area;
  expect(std::abs(areas.sum() - 12.566370614359172) < 1e-9, "areas");
  neighbour::sum(std::move(cvt.mesh));
}

} // namespace

int count_faults() {
  expect(neighbour::aligns_otherwise(), "the neighbour's alignment");
  expect(neighbour::error_of_solutions(200) < 1e-12, "the neighbour's solutions");
  pass_points();
  pass_values();
  pass_weights();
  run();
  expect(neighbour::error_of_solutions(100) < 1e-12, "the neighbour's solutions");
  return faults;
}
