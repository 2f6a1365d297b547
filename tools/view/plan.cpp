// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/spacing_survey.h"
#include "text/text.h"
#include "view/view_mesh.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

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

} // namespace

ViewMesh view_plan(const std::string& name, const Density& density, double unit,
                   const Unit& lengths) {
  const Mesh sphere = delaunay(bisected_icosahedron(level));
  ViewMesh mesh{.name = name};
  mesh.cells = mesh.total = sphere.points.cols();
  mesh.points = sphere.points;
  mesh.triangles = sphere.triangles;
  mesh.notice = message(
      "The widths that the options prescribe, at {} places; no grid is made yet. ", mesh.cells);
  const DoubleVector widths = spacings_of(density, unit, sphere.points);
  Eigen::Index finest = 0;
  if (widths.minCoeff(&finest) < widths.maxCoeff()) {
    const Points2 at = to_lonlat(sphere.points.col(finest));
    mesh.home = {at(0, 0), at(1, 0)};
  }
  mesh.quantities.push_back({.name = "prescribed",
                             .label = "cell width",
                             .unit = lengths.name,
                             .help = "Cell width that the options prescribe.",
                             .logarithmic = true,
                             .values = lengths.of_radian * widths});
  mesh.quantities.push_back({.name = "gradient",
                             .label = "gradient of the width",
                             .unit = "km/km",
                             .help = "Change of the width with distance; most models need less "
                                     "than 0.03.",
                             .worst = Worst::high,
                             .values = gradients(sphere, widths)});
  for (Quantity& quantity : mesh.quantities)
    summarise(quantity);
  return mesh;
}

} // namespace calotte::tools
