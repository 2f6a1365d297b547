// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/require.h"
#include "density/room.h"
#include "exact/space.h"
#include "mesh/triangle_grid.h"

#include <calotte/density.h>

#include <cmath>
#include <cstddef>
#include <memory>

namespace calotte {
namespace {

using namespace density_detail;
using mesh_detail::TriangleGrid;

/// Interpolates widths at the sites of a mesh, of which it keeps a copy.
template <Space S> class MeshWidths {
public:
  MeshWidths(const Mesh& mesh, const S& space, const DoubleVector& density)
      : mesh_{.points = Points3(3, mesh.points.cols()),
              .triangles = mesh.triangles,
              .neighbours = mesh.neighbours,
              .surface = mesh.surface},
        grid_(prepared(mesh.points, space), space, mesh.triangles.cols()),
        widths_(density.array().max(least).pow(-0.25)) {}
  MeshWidths(const MeshWidths&) = delete; // the grid refers to the mesh
  MeshWidths& operator=(const MeshWidths&) = delete;

  double at(const Vec3& x) const {
    const auto at = grid_.locate(x);
    double width = 0;
    for (std::size_t i = 0; i < 3; ++i)
      width += at.weight[i] * widths_[mesh_.triangles(static_cast<Eigen::Index>(i), at.triangle)];
    return width;
  }

private:
  static constexpr double least = 1e-150; ///< a density that is 0 has no cell width

  /// The mesh with sites normalised on the sphere, or moved into the periodic box.
  const Mesh& prepared(const Points3& points, const S& space) {
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      set_column(mesh_.points, i, space.coordinates(space.position(column(points, i))));
    return mesh_;
  }

  Mesh mesh_;
  TriangleGrid<S> grid_;
  DoubleVector widths_;
};

template <Space S>
Density::Callable interpolation(const Mesh& mesh, const S& space, const DoubleVector& density) {
  const auto widths = std::make_shared<const MeshWidths<S>>(mesh, space, density);
  return [widths](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const double width = widths->at({x(0, j), x(1, j), x(2, j)});
      rho[j] = 1 / (width * width * width * width);
    }
  };
}

} // namespace

Density interpolated_density(const Mesh& mesh, const DoubleVector& density) {
  base_detail::require(density.size() == mesh.points.cols(),
                       "the density has {} values; give one for each of the mesh's {} sites",
                       density.size(), mesh.points.cols());
  base_detail::require(mesh.triangles.cols() > 0,
                       "the mesh has no triangle; triangulate its points");
  for (Eigen::Index i = 0; i < density.size(); ++i)
    base_detail::require(density[i] >= 0 && std::isfinite(density[i]),
                         "the density is {} at site {}; give finite numbers that are not negative",
                         density[i], i);
  Density result;
  result.kind = Density::Kind::callable;
  result.callable = in_space_of(mesh.surface, [&](const Space auto& space) {
    require_positions(space, mesh.points, "site");
    return interpolation(mesh, space, density);
  });
  return result;
}

} // namespace calotte
