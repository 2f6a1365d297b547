// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/parallel.h"
#include "base/points.h"
#include "domain/clipped_cell.h"
#include "exact/predicates.h"
#include "exact/space.h"
#include "io/cells/centroids.h"
#include "io/cells/polygons.h"
#include "io/cells/room.h"

#include <calotte/mesh_file.h>

#include <cmath>
#include <span>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// The corners of a polygon, cyclically; in a periodic plane, the copies near the first one.
struct PolygonRing {
  const Polygons& polygons;
  std::span<const std::int32_t> ids;

  std::size_t size() const { return ids.size(); }
  Vec3 at(std::size_t k) const { return copy_near(polygons, ids[0], ids[k % ids.size()]); }
};

PolygonRing make_ring(const Polygons& polygons, std::int64_t i) {
  return {polygons, polygons.ids[i]};
}

/// The sine of the left turn at b on the path from a to c.
double turn(const Vec3& a, const Vec3& b, const Vec3& c, bool on_sphere) {
  const Vec3 in = b - a, out = c - b, across = cross(in, out);
  return (on_sphere ? dot(b, across) : across.z) / std::sqrt(dot(in, in) * dot(out, out));
}

bool is_convex(const PolygonRing& ring) {
  constexpr double rounding = 1e-9;
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (turn(ring.at(k), ring.at(k + 1), ring.at(k + 2), ring.polygons.surface.is_sphere()) <
        -rounding)
      return false;
  return true;
}

/// The integral of the position over a polygon: half the sum over its sides of the arc length times
/// the normal.
Vec3 first_moment(const PolygonRing& ring) {
  Vec3 sum{0, 0, 0};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 a = ring.at(k), b = ring.at(k + 1), side = b - a, normal = cross(a, side);
    const double sine = std::sqrt(dot(normal, normal));
    if (sine > 0)
      sum = sum + std::asin(std::sqrt(dot(side, side)) / 2) / sine * normal;
  }
  return sum;
}

/// The centroid of a polygon in a plane: the area-weighted mean of the centroids of its triangles
/// at the first corner.
Vec3 planar_centroid(const PolygonRing& ring) {
  const Vec3 first = ring.at(0);
  Vec3 sum{0, 0, 0};
  double area = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Vec3 a = ring.at(k) - first, b = ring.at(k + 1) - first;
    const double part = cross(a, b).z;
    sum = sum + part / 3 * (a + b);
    area += part;
  }
  return first + 1 / area * sum;
}

Vec3 centroid(const PolygonRing& ring) {
  return ring.polygons.surface.is_sphere() ? normalised(first_moment(ring)) : planar_centroid(ring);
}

/// The distance of a centre from the centroid, in widths.
double off_centring(const Polygons& polygons, std::int64_t i, double area) {
  const Vec3 &centre = column(polygons.centres, i), middle = centroid(make_ring(polygons, i));
  const double distance = in_space_of(
      polygons.surface, [&](const auto& space) { return norm(space.offset(centre, middle)); });
  return distance / std::sqrt(area);
}

double length(const Vec3& v) { return std::sqrt(dot(v, v)); }

/// Measures a block of polygons.
PolygonShapes measure_shapes(const Polygons& polygons, const DoubleVector& areas,
                             std::int64_t begin, std::int64_t end) {
  constexpr double rounding = 1e-6;
  PolygonShapes found;
  for (std::int64_t i = begin; i != end; ++i) {
    const PolygonRing ring = make_ring(polygons, i);
    if (ring.size() == 0)
      continue;
    if (!has_area(polygons, i, areas[i])) {
      if (found.without_area++ == 0)
        found.first_without_area = i;
      continue;
    }
    if (!is_convex(ring) && found.not_convex++ == 0)
      found.first_not_convex = i;
    if (polygons.centres.cols() == 0)
      continue;
    const double distance = off_centring(polygons, i, areas[i]);
    found.not_centroidal += !(distance <= rounding);
    if (found.worst_centred < 0 || distance > found.off_centring) {
      found.off_centring = distance;
      found.worst_centred = i;
    }
  }
  return found;
}

void add(const PolygonShapes& of_block, PolygonShapes& all) {
  if (all.without_area == 0)
    all.first_without_area = of_block.first_without_area;
  all.without_area += of_block.without_area;
  if (all.not_convex == 0)
    all.first_not_convex = of_block.first_not_convex;
  all.not_convex += of_block.not_convex;
  all.not_centroidal += of_block.not_centroidal;
  if (of_block.worst_centred >= 0 &&
      (all.worst_centred < 0 || of_block.off_centring > all.off_centring)) {
    all.off_centring = of_block.off_centring;
    all.worst_centred = of_block.worst_centred;
  }
}

ValueRange find_range(const DoubleVector& values) {
  if (values.size() == 0)
    return {};
  return {values.minCoeff(), values.mean(), values.maxCoeff()};
}

/// The range of the known areas.
ValueRange area_range(const Polygons& polygons, const DoubleVector& areas) {
  DoubleVector known(areas.size());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < areas.size(); ++i)
    if (polygons.ids.count(i) > 0)
      known[count++] = areas[i];
  return find_range(known.head(count));
}

/// The distance between centres; in a periodic plane, to the nearest copy.
double centre_distance(const Polygons& polygons, const Vec3& a, const Vec3& b) {
  return polygons.surface.is_sphere() ? 2 * std::atan2(length(b - a), length(a + b))
                                      : length(Plane(polygons.surface.period()).offset(a, b));
}

/// The range of distances between the centres of polygons that share a side.
ValueRange measure_spacing(const Polygons& polygons) {
  if (polygons.centres.cols() == 0)
    return {};
  const Sides sides(polygons);
  std::vector<double> distances;
  for (std::int32_t from = 0; from < sides.from.size(); ++from)
    for (const auto& [to, polygon] : sides.from[from])
      if (from < to)
        if (const std::int32_t other = sides.polygon_of(to, from); other >= 0)
          distances.push_back(centre_distance(polygons, column(polygons.centres, polygon),
                                              column(polygons.centres, other)));
  return find_range(Eigen::Map<const DoubleVector>(distances.data(), std::ssize(distances)));
}

} // namespace

Points3 io_detail::centroids_of(const Polygons& polygons) {
  Points3 centroids(3, polygons.size());
  for_each_block(polygons.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const PolygonRing ring = make_ring(polygons, i);
      const Vec3 middle = centroid(ring);
      set_column(centroids, i, std::isfinite(norm(middle)) ? middle : ring.at(0));
    }
  });
  return centroids;
}

PolygonShapes shapes(const Polygons& polygons) {
  const std::int64_t count = polygons.size();
  const DoubleVector area = areas(polygons);
  std::vector<PolygonShapes> blocks(static_cast<std::size_t>(block_count(count)));
  for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    blocks[static_cast<std::size_t>(block)] = measure_shapes(polygons, area, begin, end);
  });
  PolygonShapes all;
  all.area = area_range(polygons, area);
  all.spacing = measure_spacing(polygons);
  for (const PolygonShapes& block : blocks)
    add(block, all);
  return all;
}

} // namespace calotte
