// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/check/grid_check.h"

#include "base/message.h"
#include "base/points.h"
#include "io/bytes/broken.h"
#include "io/cells/polygons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace calotte::io_detail {
namespace {

/// Adds a deviation for cells that break a law.
void add_law(const std::string& names, const Broken& found, const std::string& problem,
             Deviations& deviations) {
  if (found.any())
    deviations.add(names,
                   message("{}: {} cells {}; the first is cell {} (0-based)", names, found.of_all(),
                           problem, found.first),
                   found.first);
}

// ---- Orientation and cover

void check_orientation(const StoredGrid& grid, const DoubleVector& areas, Deviations& deviations) {
  const Broken found = broken(areas.size(), [&](std::int64_t i) {
    // Files of other programs have cells without corners where the mask is 0.
    return grid.polygons.ids.count(i) < 3 ? Verdict::untested : verdict_of(areas[i] > 0);
  });
  add_law(grid.lists, found, "do not run counter-clockwise seen from outside", deviations);
}

/// Checks that no cell has a corner twice.
void check_distinct_corners(const StoredGrid& grid, Deviations& deviations) {
  const Polygons& polygons = grid.polygons;
  const Broken found = broken(polygons.size(), [&](std::int64_t i) {
    const std::span<const std::int32_t> ids = polygons.ids[i];
    for (auto id = ids.begin(); id != ids.end(); ++id)
      if (std::find(ids.begin(), id, *id) != id)
        return Verdict::breaks;
    return Verdict::keeps;
  });
  add_law(grid.lists, found, "have a corner twice", deviations);
}

void check_cover(const StoredGrid& grid, const Sides& sides, const DoubleVector& areas,
                 Deviations& deviations) {
  const Broken open = broken(sides.from.size(), [&](std::int64_t node) {
    return verdict_of(!sides.is_open(static_cast<std::int32_t>(node)));
  });
  if (!grid.polygons.surface.is_sphere())
    return;
  const double whole = 4 * std::numbers::pi, sum = std::abs(areas.sum());
  if (open.any() || std::abs(sum - whole) <= 1e-9 * whole + grid.rounding)
    return;
  deviations.add(grid.corners,
                 message("{}: no side is open, but the areas of the cells sum to {} times the "
                         "sphere's",
                         grid.corners, sum / whole),
                 -1, std::abs(sum / whole - 1));
}

// ---- Centres

/// The angle by which the sides turn around a point: 2 pi around a point inside, 0 outside, -2 pi
/// around the antipodes of the inside.
double turn_around(const Polygons& polygons, std::int64_t i, const Vec3& centre) {
  double turn = 0;
  const std::span<const std::int32_t> ids = polygons.ids[i];
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::int32_t next = k + 1 < ids.size() ? ids[k + 1] : ids[0];
    const Vec3 from = column(polygons.corners, ids[k]) - centre,
               to = column(polygons.corners, next) - centre;
    if (!polygons.surface.is_sphere()) {
      turn += std::atan2(cross(from, to).z, dot(from, to));
      continue;
    }
    const Vec3 a = cross(centre, from), b = cross(centre, to);
    turn += std::atan2(dot(centre, cross(from, to)), dot(a, b));
  }
  return turn;
}

/// Tolerance: in a plane a site may be on the boundary, even at a corner.
constexpr double on_boundary = 1e-3;

void check_inside(const StoredGrid& grid, const DoubleVector& areas, Deviations& deviations) {
  const Polygons& polygons = grid.polygons;
  const Broken found = broken(polygons.size(), [&](std::int64_t i) {
    if (polygons.ids.count(i) < 3)
      return Verdict::untested;
    const double turn = turn_around(polygons, i, column(polygons.centres, i));
    return verdict_of((areas[i] < 0 ? -turn : turn) >
                      (polygons.surface.is_sphere() ? std::numbers::pi : on_boundary));
  });
  add_law(grid.centres, found, "have their centres outside", deviations);
}

/// A range of distances, which may be equal up to rounding.
struct DistanceRange {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  void add(const Vec3& apart) {
    const double distance = norm(apart);
    least = std::min(least, distance);
    greatest = std::max(greatest, distance);
  }
  bool is_one(double rounding) const {
    return greatest - least <= rounding_of_others * greatest + 2 * rounding + 1e-13;
  }
};

/// Checks that the centre of each triangle has the same distance from all its corners, if this
/// holds for most triangles.
/// \returns whether it holds for most.
bool check_circumcentres(const StoredGrid& grid, Deviations& deviations) {
  const Polygons& polygons = grid.polygons;
  const Broken found = broken(polygons.size(), [&](std::int64_t i) {
    DistanceRange range;
    for (const std::int32_t id : polygons.ids[i])
      range.add(column(polygons.corners, id) - column(polygons.centres, i));
    return verdict_of(range.is_one(grid.rounding));
  });
  if (found.is_law())
    add_law(grid.centres, found,
            "have centres that are no circumcentres, as those of the others are", deviations);
  return found.is_law();
}

/// Whether a corner of three or more cells has the same distance from all centres.
Verdict is_equidistant(const StoredGrid& grid, const Sides& sides, std::int64_t node) {
  if (sides.from.count(node) < 3)
    return Verdict::untested;
  DistanceRange range;
  for (const Side& side : sides.from[node])
    range.add(column(grid.polygons.corners, node) - column(grid.polygons.centres, side.polygon));
  return verdict_of(range.is_one(grid.rounding));
}

/// Whether all tested corners of a cell break the law. Then its centre is wrong.
bool centre_is_wrong(const StoredGrid& grid, const Sides& sides, std::int64_t cell) {
  return std::ranges::none_of(grid.polygons.ids[cell], [&](std::int32_t node) {
    return is_equidistant(grid, sides, node) == Verdict::keeps;
  });
}

void check_voronoi(const StoredGrid& grid, const Sides& sides, Deviations& deviations) {
  const Broken found = broken(sides.from.size(),
                              [&](std::int64_t node) { return is_equidistant(grid, sides, node); });
  if (!found.any() || !found.is_law())
    return;
  const std::string law =
      message("{} corners are not as far from the centres of all cells around them, as the others "
              "are; the first is corner {} (0-based)",
              found.of_all(), found.first);
  for (const Side& side : sides.from[found.first])
    if (centre_is_wrong(grid, sides, side.polygon))
      return deviations.add(grid.centres,
                            message("{}: {}; the centre of cell {} is not that of a Voronoi cell",
                                    grid.centres, law, side.polygon),
                            side.polygon);
  deviations.add(grid.corners, message("{}: {}", grid.corners, law), found.first);
}

bool has_triangles_only(const Polygons& polygons) {
  return polygons.ids.items.size() == 3 * polygons.size() && most_corners(polygons) == 3;
}

} // namespace

void check_polygons(const StoredGrid& grid, const Sides& sides, Deviations& deviations) {
  const DoubleVector areas = areas_of(grid.polygons);
  check_orientation(grid, areas, deviations);
  check_distinct_corners(grid, deviations);
  check_cover(grid, sides, areas, deviations);
  if (grid.polygons.centres.cols() != grid.polygons.size())
    return;
  if (has_triangles_only(grid.polygons) && check_circumcentres(grid, deviations))
    return; // centres of obtuse triangles are outside
  check_inside(grid, areas, deviations);
  check_voronoi(grid, sides, deviations);
}

void check_areas(const StoredGrid& grid, const std::string& variable, Deviations& deviations) {
  const std::string units = deviations.file().text(variable, "units");
  const bool on_sphere = grid.polygons.surface.is_sphere();
  const bool on_unit_sphere =
      units.empty() || units.starts_with("rad") || units.starts_with("ster") || units == "sr";
  if ((on_sphere && !on_unit_sphere) || !deviations.has(variable, {grid.polygons.size()}))
    return;
  const DoubleVector areas = areas_of(grid.polygons);
  const double width = std::sqrt(areas.cwiseAbs().mean());
  const double tolerance = rounding_of_others + 4 * grid.rounding / width;
  deviations.check_rows<double>(
      variable,
      on_sphere ? "the area on the unit sphere of each cell, whose sides are arcs of great circles"
                : "the area of each cell, whose sides are straight",
      [&](std::int64_t i, const double* stored, Differences& out) {
        const double derived = std::abs(areas[i]);
        out.compare(i, *stored, derived, derived, tolerance);
      });
}

void check_mask(const std::string& variable, std::int64_t cells, Deviations& deviations) {
  if (!deviations.has(variable, {cells}))
    return;
  deviations.check_rows<std::int32_t>(
      variable, "0 or 1", [](std::int64_t i, const std::int32_t* stored, Differences& out) {
        if (*stored != 0 && *stored != 1)
          out.note(i, *stored, 1, 1);
      });
  const std::vector<std::int32_t> mask = deviations.file().ints(variable, {cells});
  if (cells > 0 && std::all_of(mask.begin(), mask.end(), [](std::int32_t m) { return m == 0; }))
    deviations.add(variable, message("{} is 0 at all cells, so that none takes part", variable), 0);
}

} // namespace calotte::io_detail
