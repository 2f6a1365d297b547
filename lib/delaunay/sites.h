// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/monitor.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/vec3.h"
#include "curve/quadtree.h"
#include "delaunay/room.h"
#include "delaunay/site_boxes.h"
#include "exact/plane_predicates.h"

#include <calotte/delaunay.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace calotte::delaunay_detail {

/// Maps coordinates of a plane to [-1,1]^2: (scale x - centre) / half. The scale is a power of two;
/// it prevents overflow and underflow of products of coordinates.
struct Frame {
  double scale = 1;
  Vec3 centre{0, 0, 0}; ///< the frame's origin: of the sites' box, but that a narrow one is moved
  double half = 1;      ///< the frame's unit: half of the longer side
  Vec2 period{0, 0};    ///< of a doubly periodic box, in the points' coordinates
  Vec2 low{-1, -1}, high{1, 1}; ///< corners of the sites' box, in the frame
  Vec3 operator()(double x, double y) const {
    return {(scale * x - centre.x) / half, (scale * y - centre.y) / half, 0};
  }
};

/// The distinct directions of an input, or the distinct points of a plane, in two orders: by *id*,
/// the order of the input, and by *rank*, along the space-filling curve. Stages work by rank, in
/// which sites near in memory are near in space; the mesh uses ids.
struct Sites {
  Points3 points;                          ///< by id: as given, of any norm; in a plane with z = 0
  std::vector<std::int32_t> site_of_input; ///< id for each input column
  Array<std::int32_t> id;                  ///< by rank
  Array<Vec3> unit;           ///< by rank: normalised to 5 roundoffs; in a plane the frame's, to 3
  Quadtree cells;             ///< over the ranks
  SiteBoxes boxes;            ///< over the ranks, too
  std::optional<Frame> frame; ///< of a plane
  std::vector<Image> images;  ///< by id: of sites of a periodic box and their copies, else none

  std::int64_t size() const { return id.size(); }
  const Vec3& given(std::int32_t site) const { return column(points, site); }
};

constexpr std::int64_t site_steps = 4;

/// \param monitor if not null, receives site_steps steps.
/// \throws Error not_finite, zero_vector, duplicate, too_few_sites, invalid_argument (for more than
///         2^30 points, too).
Sites make_sites(const Points3Ref& points, Duplicates duplicates, double merge_within,
                 Monitor* monitor = nullptr);

/// The same. If no points merge, they become the points of the sites without a copy.
Sites make_sites(Points3&& points, Duplicates duplicates, double merge_within,
                 Monitor* monitor = nullptr);

/// In a plane: equal points are duplicates, `merge_within` is a distance.
/// \throws Error as above, except zero_vector.
Sites make_planar_sites(const Points2Ref& points, Duplicates duplicates, double merge_within,
                        Monitor* monitor = nullptr);

/// Sites of a periodic box together with their copies. The `points` are the images, each coordinate
/// rounded once.
/// \pre the images are distinct.
Sites make_sites(std::vector<Image> images, const Vec2& period);

} // namespace calotte::delaunay_detail
