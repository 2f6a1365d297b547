// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw.h"

#include <functional>
#include <span>
#include <vector>

namespace calotte::tools {

/// A mesh as it is seen: all points on the unit sphere, x to the right, y up, z to the viewer.
struct Scene {
  Points3 sites;
  Points3 circumcentres;                 ///< of the triangles, where the shapes are cells
  std::vector<std::int32_t> triangle_of; ///< for each site one of its triangles, or -1
  const Mesh* mesh = nullptr;
  Shapes shapes = Shapes::triangles;

  std::int64_t count() const { ///< shapes: triangles, or sites
    return shapes == Shapes::cells ? sites.cols() : mesh->triangles.cols();
  }
};

/// The mesh turned so that `view` comes to the middle, north up. Rounded: for pictures only.
Scene make_scene(const Mesh& mesh, Shapes shapes, const LonLat& view);

/// The middle of the sites: where to look at an open mesh from.
LonLat middle(const Mesh& mesh);

/// The corners of one shape, counter-clockwise; none of a cell that is not closed.
void outline_of(const Scene& scene, std::int64_t shape, std::vector<Eigen::Vector3d>& corners);

/// For each shape the quantity that colours it, NaN where there is none (an open cell).
std::vector<double> values_of(const Scene& scene, Colouring colouring);

/// For each shape the side of a square of its area on the unit sphere, roughly.
std::vector<float> widths_of(const Scene& scene);

} // namespace calotte::tools
