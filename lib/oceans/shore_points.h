// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "density/line_distance.h"
#include "oceans/coast_sides.h"
#include "oceans/room.h"

#include <calotte/surface.h>
#include <calotte/widths.h>

#include <optional>
#include <span>
#include <vector>

namespace calotte::oceans_detail {

using density_detail::LineDistance;

/// The parts of a cell's width by which a coast is resolved.
namespace shore {
inline constexpr double step = 1.0 / 6; ///< the largest distance of points near the coast
inline constexpr double band = 0.8;     ///< how far from the coast points are so near
} // namespace shore

/// Points in all squares of a cube, bisected near a coast until a square is as small as its width
/// demands. All lengths are radians.
struct ShorePoints {
  Points3 points;                   ///< centres of the squares, unit columns
  std::vector<double> areas;        ///< of the squares, steradians
  std::vector<double> widths;       ///< that are demanded
  std::vector<double> from_coast;   ///< > 0 in the sea, < 0 on land
  std::vector<double> from_passage; ///< from the nearest of all passages; infinite without one

  std::int64_t size() const { return points.cols(); }
};

/// The widths that rules demand at points, radians.
/// \throws Error invalid_argument, naming a point without a demand.
std::vector<double> demanded_at(const Widths& widths, const Points3& points);

/// Distances at all points, in parallel.
std::vector<double> distances_at(const LineDistance& lines, const Points3& points);

/// The same up to one and a half widths; larger ones may come out larger than they are.
std::vector<double> near_distances_at(const LineDistance& lines, const ShorePoints& at);

/// The seas of a coast within a part of the sphere.
struct Seas {
  CoastSides sides;
  Surface within;                     ///< the whole sphere, or a part
  std::optional<LineDistance> border; ///< distances from the boundary of the part

  bool has(const Vec3& point) const {
    return sides.is_sea(point) && within.contains({point.x, point.y, point.z});
  }
};

/// \param coast distances from its lines, and from the border of the seas.
/// \param passages distances from them, if there are any.
/// \throws Error invalid_argument as demanded_at(), and for more than 20 million points.
ShorePoints shore_points(const LineDistance& coast, const Seas& seas,
                         const std::optional<LineDistance>& passages, const Widths& widths);

} // namespace calotte::oceans_detail
