// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/polygons.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/spherical_triangle.h"
#include "exact/space.h"
#include "io/bytes/file_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

const Vec3& position(const Polygons& polygons, std::int32_t corner) {
  return column(polygons.corners, corner);
}

/// Calls add(a, b, c) for the triangles of the fan around the first corner.
template <class Add>
void for_each_triangle(const Polygons& polygons, std::int64_t polygon, const Add& add) {
  const std::span<const std::int32_t> ids = polygons.ids[polygon];
  const bool periodic = polygons.surface.period().maxCoeff() > 0;
  for (std::size_t k = 1; k + 1 < ids.size(); ++k)
    if (periodic)
      add(position(polygons, ids[0]), copy_near(polygons, ids[0], ids[k]),
          copy_near(polygons, ids[0], ids[k + 1]));
    else
      add(position(polygons, ids[0]), position(polygons, ids[k]), position(polygons, ids[k + 1]));
}

/// The area of a polygon on the sphere: twice the argument of a product of complex numbers, whose
/// arguments are the half areas of the fan's triangles.
double spherical_area(const Polygons& polygons, std::int64_t polygon) {
  double x = 1, y = 0;
  for_each_triangle(polygons, polygon, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const HalfArea half = half_area(a, b, c);
    const double sine = half.sine / 4, cosine = half.cosine / 4, before = x;
    x = before * cosine - y * sine;
    y = before * sine + y * cosine;
  });
  return 2 * longitude_of(x, y);
}

double planar_area(const Polygons& polygons, std::int64_t polygon) {
  double sum = 0;
  for_each_triangle(polygons, polygon, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    sum += cross(b - a, c - a).z / 2;
  });
  return sum;
}

double signed_area(const Polygons& polygons, std::int64_t polygon) {
  return polygons.surface.is_sphere() ? spherical_area(polygons, polygon)
                                      : planar_area(polygons, polygon);
}

/// The orientation of a polygon: 1 counter-clockwise, -1 clockwise, 0 without area. In most
/// polygons all triangles of the fan have one orientation, and no area is computed.
int find_orientation(const Polygons& polygons, std::int64_t polygon) {
  bool left = false, right = false;
  for_each_triangle(polygons, polygon, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = cross(b - a, c - a);
    const double turn = polygons.surface.is_sphere() ? dot(a, normal) : normal.z;
    left = left || turn > 0;
    right = right || turn < 0;
  });
  if (left != right)
    return left ? 1 : -1;
  const double area = signed_area(polygons, polygon);
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

Array<int> find_orientations(const Polygons& polygons) {
  Array<int> turns(polygons.size());
  for_each_block(turns.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      turns[i] = find_orientation(polygons, i);
  });
  return turns;
}

} // namespace

Vec3 copy_near(const Polygons& polygons, std::int32_t first, std::int32_t corner) {
  const Vec3 &from = position(polygons, first), &to = position(polygons, corner);
  if (polygons.surface.is_sphere())
    return to;
  const Vec3 way = Plane(polygons.surface.period()).offset(from, to);
  return {from.x + way.x, from.y + way.y, 0};
}

Polygons make_polygons(const std::vector<std::int32_t>& corners, std::int64_t most, Points3 points,
                       Points3 centres) {
  const std::int64_t count = most > 0 ? std::ssize(corners) / most : 0;
  Polygons polygons{
      std::move(points), {Offsets(count + 1), Ids(std::ssize(corners))}, std::move(centres)};
  auto& [begin, ids] = polygons.ids;
  begin[0] = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    std::int32_t *const first = ids.data() + begin[i], *end = first;
    for (std::int64_t k = i * most; k < (i + 1) * most; ++k)
      if (const std::int32_t id = corners[static_cast<std::size_t>(k)];
          id >= 0 && (end == first || end[-1] != id))
        *end++ = id;
    while (end > first + 1 && end[-1] == *first)
      --end;
    begin[i + 1] = begin[i] + (end - first);
  }
  ids.conservativeResize(begin[count]);
  return polygons;
}

Polygons with_used_corners(Polygons polygons) {
  std::vector<std::int32_t> number(static_cast<std::size_t>(polygons.corners.cols()), -1);
  for (const std::int32_t corner : polygons.ids.items)
    number[static_cast<std::size_t>(corner)] = 0;
  std::int32_t count = 0;
  for (std::size_t corner = 0; corner < number.size(); ++corner)
    if (number[corner] == 0) {
      polygons.corners.col(count) = polygons.corners.col(static_cast<Eigen::Index>(corner));
      number[corner] = count++;
    }
  polygons.corners.conservativeResize(3, count);
  for (std::int32_t& corner : polygons.ids.items)
    corner = number[static_cast<std::size_t>(corner)];
  return polygons;
}

Polygons selected(Polygons polygons, std::span<const std::int32_t> ids) {
  IdLists lists{Offsets::Zero(std::ssize(ids) + 1), {}};
  for (std::size_t k = 0; k < ids.size(); ++k)
    lists.begin[static_cast<Eigen::Index>(k) + 1] =
        lists.begin[static_cast<Eigen::Index>(k)] + polygons.ids.count(ids[k]);
  lists.items.resize(lists.begin[std::ssize(ids)]);
  for (std::size_t k = 0; k < ids.size(); ++k)
    std::ranges::copy(polygons.ids[ids[k]], lists[static_cast<std::int64_t>(k)].begin());
  if (polygons.centres.cols() > 0) {
    Points3 centres(3, std::ssize(ids));
    for (std::size_t k = 0; k < ids.size(); ++k)
      centres.col(static_cast<Eigen::Index>(k)) = polygons.centres.col(ids[k]);
    polygons.centres = std::move(centres);
  }
  polygons.ids = std::move(lists);
  return with_used_corners(std::move(polygons));
}

DoubleVector areas_of(const Polygons& polygons) {
  DoubleVector areas(polygons.size());
  for_each_block(areas.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      areas[i] = signed_area(polygons, i);
  });
  return areas;
}

std::int64_t turn_counter_clockwise(Polygons& polygons, const std::string& name, bool each) {
  const Array<int> turns = find_orientations(polygons);
  const std::int64_t clockwise = std::count(turns.begin(), turns.end(), -1),
                     counter_clockwise = std::count(turns.begin(), turns.end(), 1);
  if (clockwise == 0)
    return 0;
  if (counter_clockwise > 0 && !each) {
    const bool rarer_is_clockwise = clockwise <= counter_clockwise;
    const std::int64_t cell =
        std::find(turns.begin(), turns.end(), rarer_is_clockwise ? -1 : 1) - turns.begin();
    fail_file(name, cell,
              "cell {} runs {} seen from outside, but {} cells run the other way; the file "
              "contradicts itself, make it again",
              cell, rarer_is_clockwise ? "clockwise" : "counter-clockwise",
              std::max(clockwise, counter_clockwise));
  }
  for (std::int64_t i = 0; i < polygons.size(); ++i)
    if (turns[i] < 0 || counter_clockwise == 0)
      std::ranges::reverse(polygons.ids[i]);
  return clockwise;
}

bool are_areas_of(const Polygons& polygons, const DoubleVector& values) {
  constexpr double rounding = 1e-6;
  const DoubleVector areas = areas_of(polygons).cwiseAbs();
  return areas.size() == values.size() &&
         ((areas - values).array().abs() <= rounding * areas.array()).all();
}

Sides::Sides(const Polygons& polygons, std::int64_t corners)
    : from{Array<std::int64_t>(corners + 1), Array<Side>(polygons.ids.items.size())} {
  auto& [begin, sides] = from;
  std::fill(begin.begin(), begin.end(), std::int64_t{0});
  for (const std::int32_t id : polygons.ids.items)
    ++begin[id];
  std::int64_t end = 0;
  for (std::int64_t& count : begin) // ends of the lists; filling the lists turns them into begins
    count = end += count;
  for (auto i = static_cast<std::int32_t>(polygons.size()); i-- > 0;) {
    const std::span<const std::int32_t> ids = polygons.ids[i];
    for (std::size_t k = ids.size(); k-- > 0;)
      sides[--begin[ids[k]]] = {k + 1 < ids.size() ? ids[k + 1] : ids[0], i};
  }
  for (std::int64_t corner = 0; corner < from.size(); ++corner)
    std::sort(from[corner].begin(), from[corner].end());
}

std::int32_t Sides::polygon_of(std::int32_t start, std::int32_t to) const {
  const std::span<const Side> sides = from[start];
  const auto found = std::lower_bound(sides.begin(), sides.end(), Side{to, -1});
  return found != sides.end() && found->to == to ? found->polygon : -1;
}

bool Sides::is_open(std::int32_t start) const {
  return std::ranges::any_of(from[start],
                             [&](const Side& side) { return polygon_of(side.to, start) < 0; });
}

Polygons with_merged_corners(Polygons polygons, const DoubleVector& areas) {
  std::vector<std::int32_t> same; // by corner: an equal one of lower number, or itself
  const auto lowest = [&](std::int32_t id) {
    while (same[static_cast<std::size_t>(id)] != id)
      id = same[static_cast<std::size_t>(id)];
    return id;
  };
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    const double least = 1e-9 * std::sqrt(std::abs(areas[i]));
    const std::span<const std::int32_t> ids = polygons.ids[i];
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::int32_t id = ids[k], next = k + 1 < ids.size() ? ids[k + 1] : ids[0];
      if (!(norm(position(polygons, next) - position(polygons, id)) < least))
        continue;
      if (same.empty()) {
        same.resize(static_cast<std::size_t>(polygons.corners.cols()));
        std::iota(same.begin(), same.end(), 0);
      }
      const auto [low, high] = std::minmax({lowest(id), lowest(next)});
      same[static_cast<std::size_t>(high)] = low;
    }
  }
  for (std::size_t id = 0; id < same.size(); ++id)
    polygons.corners.col(static_cast<Eigen::Index>(id)) =
        polygons.corners.col(lowest(static_cast<std::int32_t>(id)));
  return polygons;
}

bool has_area(const Polygons& polygons, std::int64_t polygon, double area) {
  constexpr double rounding = 1e-14; // of a unit vector; in a plane relative to the coordinates
  const std::span<const std::int32_t> ids = polygons.ids[polygon];
  if (ids.size() < 3)
    return false;
  double perimeter = 0, size = 0;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::int32_t next = k + 1 < ids.size() ? ids[k + 1] : ids[0];
    size = std::max(size, norm(position(polygons, ids[k])));
    perimeter += norm(copy_near(polygons, ids[0], next) - copy_near(polygons, ids[0], ids[k]));
  }
  return std::abs(area) > rounding * perimeter * size;
}

PolygonFault overlap_in(const Polygons& polygons) {
  const Sides all(polygons);
  const auto covers = [&](const Side& side) {
    return has_area(polygons, side.polygon, signed_area(polygons, side.polygon));
  };
  for (std::int64_t corner = 0; corner < all.from.size(); ++corner) {
    const std::span<const Side> sides = all.from[corner];
    std::size_t known = 0;
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const Side &side = sides[known], &next = sides[k];
      if (side.to == next.to && !covers(next))
        continue;
      if (side.to == next.to && covers(side))
        return {message("cell {} and cell {} overlap, as both lie to the left of one side",
                        side.polygon, next.polygon),
                side.polygon};
      known = k;
    }
  }
  if (!polygons.surface.is_sphere())
    return {};
  constexpr double whole = 4 * std::numbers::pi, rounding = 1e-6;
  const double area = areas_of(polygons).sum();
  if (area > whole * (1 + rounding))
    return {message("the cells overlap: their areas sum to {} times the sphere's", area / whole)};
  return {};
}

void require_no_overlap(const Polygons& polygons, const std::string& name) {
  if (const PolygonFault fault = overlap_in(polygons); !fault.text.empty())
    fail_file(name, fault.polygon, "{}; make the file again", fault.text);
}

double mean_width(std::int64_t cells) {
  return std::sqrt(4 * std::numbers::pi / static_cast<double>(std::max<std::int64_t>(cells, 1)));
}

double mean_width(const Polygons& polygons) {
  return std::sqrt(areas_of(polygons).cwiseAbs().sum() /
                   static_cast<double>(std::max<std::int64_t>(polygons.size(), 1)));
}

double corner_tolerance(double mean_width, double rounding) { return 1e-6 * mean_width + rounding; }

bool cover_sphere(const Polygons& polygons) {
  const double whole = 4 * std::numbers::pi, mean = whole / static_cast<double>(polygons.size());
  return polygons.surface.is_sphere() && areas_of(polygons).sum() > whole - mean / 2;
}

Ids corners_of_vertices(const Voronoi& voronoi, const Polygons& polygons) {
  Ids corners(voronoi.vertices.cols());
  for (std::int64_t i = 0; i < polygons.size(); ++i)
    for (const std::int32_t vertex : voronoi.vertices_on_cell[i]) {
      const Vec3 p = column(voronoi.vertices, vertex);
      corners[vertex] =
          *std::ranges::min_element(polygons.ids[i], [&](std::int32_t a, std::int32_t b) {
            const Vec3 to_a = p - position(polygons, a), to_b = p - position(polygons, b);
            return dot(to_a, to_a) < dot(to_b, to_b);
          });
    }
  return corners;
}

std::int64_t most_corners(const Polygons& polygons) {
  std::int64_t most = 0;
  for (std::int64_t i = 0; i < polygons.size(); ++i)
    most = std::max(most, polygons.ids.count(i));
  return most;
}

std::int32_t corner(const Polygons& polygons, std::int64_t polygon, std::int64_t k) {
  const std::span<const std::int32_t> ids = polygons.ids[polygon];
  return k < std::ssize(ids) ? ids[static_cast<std::size_t>(k)] : -1;
}

std::int32_t corner_or_last(const Polygons& polygons, std::int64_t polygon, std::int64_t k) {
  return corner(polygons, polygon, std::min(k, polygons.ids.count(polygon) - 1));
}

} // namespace calotte::io_detail

namespace calotte {

DoubleVector areas(const Polygons& polygons) { return io_detail::areas_of(polygons); }

} // namespace calotte
