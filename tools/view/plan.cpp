// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/spacing_survey.h"
#include "text/text.h"
#include "view/page.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

constexpr int level = 7; // of the icosahedron: 163 842 points, some 60 km apart on the Earth

/// The largest slope of a function along the edges of each triangle's plane: the norm of its
/// gradient there, per radian; at a site the largest of its triangles.
DoubleVector gradients(const Mesh& mesh, const DoubleVector& values) {
  DoubleVector slopes = DoubleVector::Zero(values.size());
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector3i id = mesh.triangles.col(t);
    const Eigen::Vector3d a = mesh.points.col(id[0]), b = mesh.points.col(id[1]),
                          c = mesh.points.col(id[2]), normal = (b - a).cross(c - a);
    const Eigen::Vector3d gradient = normal.cross((values[id[1]] - values[id[0]]) * (a - c) +
                                                  (values[id[2]] - values[id[0]]) * (b - a)) /
                                     normal.squaredNorm();
    for (const int site : id)
      slopes[site] = std::max(slopes[site], gradient.norm());
  }
  return slopes;
}

std::vector<Quantity> quantities_of(const Mesh& sphere, const DoubleVector& widths,
                                    const Unit& lengths) {
  std::vector<Quantity> list;
  list.push_back({.name = "prescribed",
                  .label = "cell width",
                  .unit = lengths.name,
                  .help = "Cell width that the options prescribe.",
                  .logarithmic = true,
                  .values = lengths.of_radian * widths});
  list.push_back({.name = "gradient",
                  .label = "gradient of the width",
                  .help = "Change of the width over the distance; most models need less than 0.03.",
                  .worst = Worst::high,
                  .values = gradients(sphere, widths)});
  for (Quantity& quantity : list)
    summarise(quantity);
  return list;
}

} // namespace

ViewPage plan_page(const PlannedGrid& grid) {
  const Mesh sphere = delaunay(bisected_icosahedron(level));
  const DoubleVector widths = spacings_of(grid.density, grid.unit, sphere.points);
  ViewPage page;
  page.title = message("plan of {} cells: {}", spaced(grid.cells), grid.widths);
  page.coastlines = grid.coastlines;
  ViewMesh mesh{.name = page.title, .radius_km = grid.radius_km};
  mesh.cells = mesh.total = sphere.points.cols();
  mesh.planned = grid.cells;
  mesh.points = sphere.points;
  mesh.triangles = sphere.triangles;
  mesh.notice = message(
      "The widths that the options prescribe, at {} places; no grid is made yet. ", mesh.cells);
  Eigen::Index finest = 0;
  if (widths.minCoeff(&finest) < widths.maxCoeff())
    mesh.home = sphere.points.col(finest);
  mesh.quantities = quantities_of(sphere, widths, grid.lengths);
  page.meshes.push_back(std::move(mesh));
  return page;
}

} // namespace calotte::tools
