// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/renumber.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/triangle.h"
#include "curve/curve_squares.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"
#include "mesh/canonical_order.h"
#include "mesh/ids.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <span>

namespace calotte {
namespace mesh_detail {
namespace {

bool are_directions(const Points3& points) {
  return holds_for_blocks(points.cols(), [&](std::int64_t begin, std::int64_t end) {
    while (begin != end && is_finite(column(points, begin)) && !is_zero(column(points, begin)))
      ++begin;
    return begin == end;
  });
}

void require_directions(const Points3& points) {
  if (are_directions(points))
    return;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    require_direction(column(points, i), i);
}

/// Calls body(i, curve key of point i) for begin <= i < end.
template <class Body>
void for_each_key(const Points3& points, std::int64_t begin, std::int64_t end, const Body& body) {
  for_each_curve_key(
      begin, end, [&](std::int64_t i) { return to_cube(column(points, i)); }, body);
}

/// The curve keys of points. \param square of a point by its id.
template <class Square> Array<std::uint64_t> keys_of(const Points3& points, const Square& square) {
  Array<std::uint64_t> keys(points.cols());
  for_each_block(keys.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for_each_curve_key(begin, end, square,
                       [&](std::int64_t i, std::uint64_t key) { keys[i] = key; });
  });
  return keys;
}

/// For each site its position in the order.
Array<std::int32_t> inverse(const Array<std::int32_t>& order) {
  Array<std::int32_t> rank(order.size());
  for_each_block(order.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      rank[order[i]] = static_cast<std::int32_t>(i);
  });
  return rank;
}

void require_ids(const Mesh& mesh) {
  const std::int64_t sites = mesh.points.cols(), triangles = mesh.triangles.cols();
  require(are_ids(mesh.triangles, sites) && mesh.neighbours.cols() == triangles &&
              are_ids(mesh.neighbours, triangles, -1) && are_ids(mesh.site_of_input, sites),
          "the mesh to renumber has an id out of range, or not the neighbours of its triangles; "
          "give one as delaunay() or read_mesh() makes it");
}

template <Space S> Array<std::int32_t> order_along_curve(const Points3& points) {
  const CurveSquares<S> squares(points);
  return order_by_key(keys_of(points, [&](std::int64_t i) { return squares(column(points, i)); }))
      .items;
}

/// The order along the curve in the bounding box of points of the plane.
Array<std::int32_t> curve_order_in_plane(const Points3& points) {
  if (points.cols() == 0)
    return {};
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    require_finite(column(points, i), i);
  return order_along_curve<Plane>(points);
}

} // namespace

Array<std::int32_t> curve_order(const Points3& points, const Surface& surface) {
  if (!surface.is_sphere())
    return curve_order_in_plane(points);
  require_directions(points);
  return order_along_curve<Sphere>(points);
}

bool is_in_curve_order(const Mesh& mesh) {
  const auto sites_ascend = [&](std::int64_t begin, std::int64_t end) {
    std::uint64_t before = 0;
    bool ascend = true;
    for_each_key(mesh.points, std::max<std::int64_t>(begin - 1, 0), end,
                 [&](std::int64_t, std::uint64_t key) {
                   ascend = ascend && before <= key;
                   before = key;
                 });
    return ascend;
  };
  return are_directions(mesh.points) && holds_for_blocks(mesh.points.cols(), sites_ascend) &&
         is_canonical(mesh.triangles);
}

Mesh in_order(const Mesh& mesh, const Array<std::int32_t>& order) {
  const Array<std::int32_t> rank = inverse(order);
  Mesh out;
  out.surface = mesh.surface;
  out.points.resize(3, mesh.points.cols());
  for_each_block(order.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      out.points.col(i) = mesh.points.col(order[i]);
  });
  const CanonicalOrder triangles =
      order_triangles(mesh.triangles, std::span(rank.begin(), rank.end()), out.triangles);
  order_neighbours(mesh.neighbours, triangles, out.neighbours);
  out.site_of_input.resize(mesh.site_of_input.size());
  std::transform(mesh.site_of_input.begin(), mesh.site_of_input.end(), out.site_of_input.begin(),
                 [&](std::int32_t site) { return rank[site]; });
  return out;
}

} // namespace mesh_detail

Mesh renumbered(const Mesh& mesh, Numbering numbering) {
  using namespace mesh_detail;
  require_ids(mesh);
  return numbering == Numbering::curve ? in_order(mesh, curve_order(mesh.points, mesh.surface))
                                       : mesh;
}

} // namespace calotte
