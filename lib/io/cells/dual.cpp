// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/dual.h"

#include "base/parallel.h"
#include "base/points.h"
#include "exact/predicates.h"
#include "io/cells/field_order.h"
#include "io/cells/polygons.h"
#include "mesh/canonical_order.h"

#include <calotte/check.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace calotte::io_detail {
namespace {

/// A polygon at a corner, and the corners before and after it along the polygon.
struct AtCorner {
  std::int32_t polygon, before, after;
};

/// Sorts the polygons around a corner from the lowest on, in the direction in which polygons run:
/// the next one is across the side to the corner before. The input is in ascending order.
/// \returns whether the polygons surround the corner.
bool turn_around(std::array<AtCorner, 3>& around) {
  if (around[1].after != around[0].before)
    std::swap(around[1], around[2]);
  return around[1].after == around[0].before && around[2].after == around[1].before &&
         around[0].after == around[2].before;
}

/// Removes the values of corners that no polygon has.
void select_corners(std::int64_t corners, const Ids& used, std::vector<MeshField>& fields) {
  if (used.size() == corners)
    return;
  for (MeshField& field : fields)
    if (field.location == FieldLocation::vertices && has_values_for(field, corners))
      select_values(field, {used.data(), static_cast<std::size_t>(used.size())});
}

Vec3 unit(const Vec3& p) {
  constexpr double rounding = 1e-15;
  return std::abs(dot(p, p) - 1) <= rounding ? p : normalised(p);
}

} // namespace

Dual make_dual(const Polygons& polygons, std::int64_t corners) {
  Array<std::array<AtCorner, 3>> at(corners); // filled below before it is read
  std::vector<std::uint8_t> count(static_cast<std::size_t>(corners));
  for (std::int32_t i = 0; i < polygons.size(); ++i) {
    const std::span<const std::int32_t> ids = polygons.ids[i];
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto corner = static_cast<std::size_t>(ids[k]);
      if (count[corner] < 3)
        at[ids[k]][count[corner]] = {i, k == 0 ? ids.back() : ids[k - 1],
                                     k + 1 == ids.size() ? ids[0] : ids[k + 1]};
      count[corner] = std::min<std::uint8_t>(count[corner], 3) + 1;
    }
  }
  Dual dual;
  Array<std::int32_t> triangle(corners); // by corner, -1 on the boundary
  std::optional<Sides> sides;
  std::int32_t triangles = 0;
  for (std::int32_t v = 0; v < corners; ++v) {
    const std::uint8_t polygons_at = count[static_cast<std::size_t>(v)];
    const bool surrounded = polygons_at == 3 && turn_around(at[v]);
    triangle[v] = surrounded ? triangles++ : -1;
    if (surrounded || polygons_at == 0)
      continue;
    if (!sides)
      sides.emplace(polygons, corners);
    if (!sides->is_open(v)) {
      dual.failed = v;
      return dual;
    }
  }
  dual.triangles.resize(3, triangles);
  dual.neighbours.resize(3, triangles);
  dual.corner.resize(triangles);
  for (std::int32_t v = 0; v < corners; ++v)
    if (const std::int32_t t = triangle[v]; t >= 0) {
      dual.corner[t] = v;
      for (int k = 0; k < 3; ++k) { // the side after polygon k leads to the corner before it
        const AtCorner& corner = at[v][static_cast<std::size_t>(k)];
        dual.triangles(k, t) = corner.polygon;
        dual.neighbours((k + 2) % 3, t) = triangle[corner.before];
      }
    }
  return dual;
}

bool are_circumcentres(const Points3& sites, const Triangles& triangles, const Points3& vertices,
                       double distance, double share, const Ids& vertex) {
  return holds_for_blocks(triangles.cols(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const Vec3 a = unit(column(sites, triangles(0, t))), b = unit(column(sites, triangles(1, t))),
                 c = unit(column(sites, triangles(2, t)));
      const Vec3 normal = cross(b - a, c - a),
                 v = unit(column(vertices, vertex.size() > 0 ? vertex[t] : t));
      const Vec3 centre = std::copysign(1, dot(normal, a)) * normalised(normal);
      const Vec3 apart = v - centre, reach = centre - a;
      if (!(dot(apart, apart) <= std::max(distance * distance, share * share * dot(reach, reach))))
        return false;
    }
    return true;
  });
}

std::optional<Mesh> mesh_of_cells(Points3& centres, const Polygons& polygons, double rounding,
                                  std::vector<MeshField>& fields) {
  const std::int64_t sites = polygons.size(), corners = polygons.corners.cols();
  if (centres.cols() != sites)
    return {};
  Dual dual = make_dual(polygons, corners);
  const bool closed = dual.triangles.cols() == 2 * sites - 4;
  if (dual.failed >= 0 || dual.triangles.cols() == 0)
    return {};
  if (!closed && cover_sphere(polygons))
    return {}; // cells do not share their corners
  const double width = closed ? mean_width(sites) : mean_width(polygons);
  if (!are_circumcentres(centres, dual.triangles, polygons.corners,
                         corner_tolerance(width, rounding), closed ? 0 : 1e-6, dual.corner))
    return {};
  Mesh mesh{std::move(centres), {}, {}, themselves(sites)};
  const CanonicalOrder places = order_triangles(dual.triangles, {}, mesh.triangles);
  order_neighbours(dual.neighbours, places, mesh.neighbours);
  if (!(closed ? check(mesh) : check_surface(mesh)).passed()) {
    centres = std::move(mesh.points);
    return {};
  }
  if (closed) {
    select_corners(corners, dual.corner, fields);
    move_vertex_values(fields, {places.index.begin(), places.index.end()});
  }
  return mesh;
}

std::optional<Mesh> planar_mesh_of_cells(const Points3& centres, const Polygons& polygons) {
  const Dual dual = make_dual(polygons, polygons.corners.cols());
  if (dual.failed >= 0 || dual.triangles.cols() == 0)
    return {};
  Mesh mesh{centres, {}, {}, themselves(centres.cols()), Surface::plane()};
  order_neighbours(dual.neighbours, order_triangles(dual.triangles, {}, mesh.triangles),
                   mesh.neighbours);
  return mesh;
}

} // namespace calotte::io_detail
