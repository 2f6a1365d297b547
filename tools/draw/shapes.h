// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace calotte::tools {

/// A mesh in view coordinates: all points on the unit sphere, x to the right, y up, z to the
/// viewer; or all on a plane, z = 0.
struct Scene {
  bool flat = false;
  Points3 sites;
  Points3 circumcentres;                 ///< of the triangles, where there are cells
  std::vector<std::int32_t> triangle_of; ///< for each site one of its triangles, or -1
  const Mesh* mesh = nullptr;            ///< null for polygons alone
  const Polygons* polygons = nullptr; ///< cells of any shape, whose corners are the circumcentres
  Shapes shapes = Shapes::triangles;  ///< that are filled: triangles or cells
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity(); ///< from points on the earth

  // Of a plane, in the unit of the scene:
  Eigen::Vector2d period{0, 0}; ///< as Surface has it
  Eigen::Vector2d reach{0, 0};  ///< the window ends at these x and y, and at minus these
  std::vector<Eigen::Vector3d> copies = {Eigen::Vector3d::Zero()}; ///< shifts of all shapes
  std::vector<bool> outside = {}; ///< triangles that are not drawn; empty if all are

  std::int64_t count() const { ///< shapes: triangles, or sites
    return polygons                  ? polygons->size()
           : shapes == Shapes::cells ? sites.cols()
                                     : mesh->triangles.cols();
  }
};

/// The mesh rotated so that `view` is in the middle, north up. Rounded: for pictures only.
/// \param cells shapes of the cells in place of those that follow from the triangles, if any.
Scene make_scene(const Mesh& mesh, Shapes shapes, const LonLat& view,
                 const Polygons* cells = nullptr);

/// Cells of any shape in the same view.
Scene make_scene(const Polygons& polygons, const LonLat& view);

/// The same of a plane. \param mesh its triangles and neighbours; \param points of its sites and
/// \param period in the unit of the scene; \param cells likewise, without a period.
Scene make_flat_scene(const Mesh& mesh, Shapes shapes, const Points2& points,
                      const Eigen::Vector2d& period, const Polygons& cells);

/// False if a shape of a plane is known to lie beyond the window.
bool may_show(const Scene& scene, const std::vector<Eigen::Vector3d>& corners);

/// Its rows are the viewer's right, up and towards.
Eigen::Matrix3d frame_of(const LonLat& view);

/// The unit vector of a point on the earth.
Eigen::Vector3d direction_of(const LonLat& point);

/// Unit, for norms whose squares under- or overflow, too.
Eigen::Vector3d direction_of(const Eigen::Vector3d& point);

/// The point on the earth in a direction of any norm.
LonLat lonlat_of(const Eigen::Vector3d& direction);

/// The middle of the sites, the default view of an open mesh.
LonLat middle(const Mesh& mesh);

/// The corners of a triangle or, counter-clockwise, of a cell; empty for a cell that is not closed.
void outline_of(const Scene& scene, Shapes shapes, std::int64_t shape,
                std::vector<Eigen::Vector3d>& corners);

/// For each triangle or cell the approximate side of a square of its area on the unit sphere.
std::vector<float> widths_of(const Scene& scene, Shapes shapes);

/// The corners of one triangle, in a periodic plane near the first, and measures of it.
struct Corners {
  Corners(const Scene& scene, Eigen::Index triangle);
  double side(int i) const; ///< from corner i to the next
  double smallest_angle() const;
  double mean_side() const { return (side(0) + side(1) + side(2)) / 3; }
  double area() const;    ///< steradians; of a plane, its units squared
  double quality() const; ///< as Quality::triangle_quality

  Eigen::Vector3i id;
  Eigen::Vector3d at[3];
  bool flat;
};

/// The triangles around a site, counter-clockwise, one call each; false if the star is open.
bool around(const Scene& scene, std::int64_t site, const std::function<void(std::int32_t)>& visit);

} // namespace calotte::tools
