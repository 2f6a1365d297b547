// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/remap.h>

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/triangle.h"
#include "mesh/connectivity.h"
#include "mesh/faces.h"
#include "mesh/locate.h"
#include "mesh/seen_mesh.h"
#include "remap/room.h"
#include "remap/weight_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace calotte {
namespace remap_detail {
namespace {

using base_detail::next_vertex, base_detail::point, base_detail::previous_vertex;
using mesh_detail::Corner, mesh_detail::Faces, mesh_detail::faces_of, mesh_detail::next_around;
using mesh_detail::SeenMesh, mesh_detail::vertex_across;

// ---- Natural neighbours

/// An edge of the polygon around the triangles whose circumcaps contain a position; the position is
/// to its left. The triangle is the one inside the polygon, and its vertex `across` is across from
/// the edge.
struct CavityEdge {
  std::int32_t triangle;
  int across;
  Vec3 centre = {}; ///< of the circle through the edge and the position
};

/// b - a, as if both were on the unit sphere to the last bit. \pre they are in one hemisphere.
Vec3 offset_on_sphere(const Vec3& a, const Vec3& b) {
  const Vec3 way = b - a, along = way - dot(way, a) * a;
  const double square = std::min(dot(along, along), 1.0);
  return along - square / (1 + std::sqrt(1 - square)) * a;
}

template <Space S> class NaturalNeighbours {
public:
  using Position = typename S::Position;

  explicit NaturalNeighbours(const SeenMesh<S>& mesh)
      : seen_(mesh), mesh_(mesh.mesh()), faces_(faces_of(mesh_)) {}

  /// \param t the triangle that contains p. \pre p is no site and not on an open edge.
  void set(const Position& p, std::int32_t t, WeightRow& out) const {
    std::vector<CavityEdge> sides; // counter-clockwise
    for (int v = 0; v < 3; ++v)
      add_sides(p, {t, v}, sides);
    for (CavityEdge& side : sides)
      side.centre = centre_with(p, side);
    out.clear();
    double sum = 0;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const double stolen = std::max(0.0, area_between(p, sides[k], sides[(k + 1) % sides.size()]));
      out.push_back({end_of(sides[k]), stolen});
      sum += stolen;
    }
    for (Weight& weight : out)
      weight.value /= sum;
  }

private:
  std::int32_t start_of(const CavityEdge& side) const {
    return mesh_.triangles(next_vertex(side.across), side.triangle);
  }
  std::int32_t end_of(const CavityEdge& side) const {
    return mesh_.triangles(previous_vertex(side.across), side.triangle);
  }

  /// Adds the sides of the polygon beyond an edge of a triangle inside; the edge itself if the
  /// triangle beyond it is not inside. The triangles inside form a tree, as they surround no site.
  void add_sides(const Position& p, const CavityEdge& edge, std::vector<CavityEdge>& out) const {
    const std::int32_t beyond = mesh_.neighbours(edge.across, edge.triangle);
    if (beyond < 0 || seen_.in_circle(beyond, p) <= 0) {
      out.push_back(edge);
      return;
    }
    const int back = vertex_across(mesh_.neighbours, beyond, edge.triangle);
    add_sides(p, {beyond, next_vertex(back)}, out);
    add_sides(p, {beyond, previous_vertex(back)}, out);
  }

  /// The circumcentre with p. On the sphere it uses the components of offsets along the tangent
  /// plane at p: rounding of the norms must not count, as p may be that near to a site.
  Vec3 centre_with(const Position& p, const CavityEdge& side) const {
    const Vec3 x = seen_.seen(p), start = seen_.seen(start_of(side), p),
               end = seen_.seen(end_of(side), p);
    if constexpr (S::on_sphere)
      if (dot(x, start) > 0 && dot(x, end) > 0) {
        const Vec3 normal = cross(offset_on_sphere(x, start), offset_on_sphere(x, end));
        return (1 / norm(normal)) * normal;
      }
    return frame_.circumcentre(x, start, end);
  }
  Vec3 centre_of(std::int32_t t, const Position& p) const {
    return frame_.circumcentre(seen_.seen(mesh_.triangles(0, t), p),
                               seen_.seen(mesh_.triangles(1, t), p),
                               seen_.seen(mesh_.triangles(2, t), p));
  }

  /// The area that the cell of p takes from the cell of the site between two sides: the polygon of
  /// the new vertices on both sides and the old vertices between them, which p removes.
  double area_between(const Position& p, const CavityEdge& before, const CavityEdge& after) const {
    const Vec3& first = before.centre;
    Vec3 last = after.centre;
    double sum = 0;
    const auto add = [&](const Vec3& corner) {
      sum += frame_.area(first, last, corner);
      last = corner;
    };
    Corner corner{after.triangle, next_vertex(after.across)};
    while (corner.triangle != before.triangle) {
      add(centre_of(corner.triangle, p));
      corner = next_around(faces_, corner);
    }
    add(centre_of(corner.triangle, p));
    return sum;
  }

  const SeenMesh<S>& seen_;
  const Mesh& mesh_;
  Faces faces_;
  S frame_{}; ///< the space around a position: a plane without period
};

// ---- Rows

void set_linear(const Triangles& triangles, const Locations& at, std::int64_t i, WeightRow& out) {
  out.clear();
  for (int v = 0; v < 3; ++v)
    if (at.weights(v, i) > 0)
      out.push_back({triangles(v, at.triangle[i]), at.weights(v, i)});
}

/// Whether a position is on an open edge, or is a site, up to rounding. Its weights are then those
/// of the edge's ends: the circumcentres with the position would have no correct digits, and linear
/// weights differ from natural ones by no more than the position from the edge or site.
bool on_boundary(const Triangles& neighbours, const Locations& at, std::int64_t i) {
  constexpr double rounding = 1e-12;
  int zeros = 0;
  bool open = false;
  for (int v = 0; v < 3; ++v)
    if (at.weights(v, i) <= rounding) {
      ++zeros;
      open = open || neighbours(v, at.triangle[i]) < 0;
    }
  return zeros > 1 || open;
}

/// Whether a position is a site, which may have no triangle, up to rounding.
template <Space S>
bool is_site(const SeenMesh<S>& seen, std::int32_t site, const typename S::Position& p) {
  const Vec3 x = seen.seen(p), apart = seen.seen(site, p) - x;
  return norm(apart) <= 1e-15 * std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)});
}

template <Space S>
Weights weights_of(const SeenMesh<S>& seen, const PointsRef& positions, const Locations& at,
                   Interpolation kind) {
  const Mesh& mesh = seen.mesh();
  using Position = typename S::Position;
  const NaturalNeighbours<S> natural(seen);
  return matrix_of(positions.cols(), mesh.points.cols(), [&](std::int64_t i, WeightRow& row) {
    const Position p = seen.position(point(positions, i));
    if (at.triangle[i] < 0 && (kind == Interpolation::nearest || is_site(seen, at.nearest[i], p)))
      row.push_back({at.nearest[i], 1});
    else if (at.triangle[i] < 0)
      return;
    else if (kind == Interpolation::linear || on_boundary(mesh.neighbours, at, i))
      set_linear(mesh.triangles, at, i, row);
    else
      natural.set(p, at.triangle[i], row);
    sort_by_column(row);
  });
}

} // namespace
} // namespace remap_detail

Weights interpolation_weights(const Mesh& mesh, const PointsRef& positions, Interpolation kind) {
  using namespace remap_detail;
  require(kind != Interpolation::conservative,
          "conservative weights are those of cells, not of positions; use conservative_weights()");
  const Locations at = kind == Interpolation::nearest
                           ? Locations{Ids::Constant(positions.cols(), -1),
                                       {},
                                       mesh_detail::find_nearest(mesh, positions)}
                           : mesh_detail::locate_within_rounding(mesh, positions);
  return in_space_of(mesh.surface, [&](const Space auto& space) {
    return weights_of(SeenMesh(mesh, space), positions, at, kind);
  });
}

DoubleVector interpolate(const Weights& weights, const DoubleVector& values) {
  base_detail::require(weights.cols() == values.size(),
                       "there are {} values for {} sites; give one for each", values.size(),
                       weights.cols());
  DoubleVector out(weights.rows());
  base_detail::for_each_block(out.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      double sum = 0;
      bool any = false;
      for (Weights::InnerIterator entry(weights, i); entry; ++entry) {
        sum += entry.value() * values[entry.col()];
        any = true;
      }
      out[i] = any ? sum : std::numeric_limits<double>::quiet_NaN();
    }
  });
  return out;
}

} // namespace calotte
