// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/plane.h"

#include <calotte/delaunay.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calotte::tools {

using Eigen::Vector2d;

namespace {

Window window_around(const Points2& places, double margin) {
  const Vector2d low = places.rowwise().minCoeff();
  const Vector2d high = places.rowwise().maxCoeff();
  const Vector2d room = Vector2d::Constant(margin * (high - low).maxCoeff());
  return {low - room, high + room};
}

/// Adds far sites around the mesh, which close the outer cells beyond the window.
Drawn closed_by_far_sites(const PlanarMesh& mesh, const Window& window) {
  constexpr int around = 64;
  constexpr double far = 40; // of the window's extent
  const Eigen::Index n = mesh.points.cols();
  Points2 places(2, n + around);
  places.leftCols(n) = mesh.points;
  const double reach = far * window.extent().maxCoeff();
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    places.col(n + i) = window.middle() + reach * Vector2d(std::cos(angle), std::sin(angle));
  }
  Drawn drawn(planar_delaunay(places));
  std::fill(drawn.site.begin() + n, drawn.site.end(), -1);
  return drawn;
}

/// Adds the copies of a box's sites near it.
Drawn with_copies(const PlanarMesh& mesh) {
  const Eigen::Index n = mesh.points.cols();
  const double spacing = std::sqrt(mesh.period.prod() / static_cast<double>(n));
  const double margin = std::min(mesh.period.maxCoeff() / 2, 8 * spacing);
  std::vector<Vector2d> copies;
  std::vector<std::int32_t> site;
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      for (Eigen::Index s = 0; s < n; ++s) {
        const Vector2d place =
            mesh.points.col(s) + Vector2d(i * mesh.period.x(), j * mesh.period.y());
        if ((i != 0 || j != 0) && (place.array() > -margin).all() &&
            (place.array() < mesh.period.array() + margin).all()) {
          copies.push_back(place);
          site.push_back(static_cast<std::int32_t>(s));
        }
      }
    }
  }
  Points2 places(2, n + std::ssize(copies));
  places.leftCols(n) = mesh.points;
  for (std::size_t k = 0; k < copies.size(); ++k) {
    places.col(n + static_cast<Eigen::Index>(k)) = copies[k];
  }
  Drawn drawn(planar_delaunay(places));
  std::copy(site.begin(), site.end(), drawn.site.begin() + n);
  return drawn;
}

} // namespace

Window window_of(const PlanarMesh& mesh, const std::optional<PlanarDomain>& domain) {
  if (is_periodic(mesh)) {
    return {Vector2d::Zero(), mesh.period};
  }
  if (!domain) {
    return window_around(mesh.points, 0.04);
  }
  Points2 corners(2, 0);
  for (const Eigen::MatrixXd& ring : domain->rings) {
    const Eigen::Index before = corners.cols();
    corners.conservativeResize(Eigen::NoChange, before + ring.cols());
    corners.rightCols(ring.cols()) = ring;
  }
  return window_around(corners, 0.01);
}

Drawn drawn_of(const PlanarMesh& mesh, Shapes shapes, const Window& window) {
  if (is_periodic(mesh)) {
    return with_copies(mesh);
  }
  return shapes == Shapes::triangles ? Drawn(mesh) : closed_by_far_sites(mesh, window);
}

Scene scene_of(const Drawn& drawn, Shapes shapes, const Window& window) {
  const double half = window.extent().maxCoeff() / 2;
  return make_flat_scene(drawn.mesh, shapes, (drawn.places.colwise() - window.middle()) / half);
}

} // namespace calotte::tools
