// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/renumber.h"

#include "base/ids.h"
#include "base/matrix_memory.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "curve/hilbert.h"
#include "curve/radix_sort.h"

#include <calotte/error.h>
#include <calotte/renumber.h>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

namespace calotte {
namespace mesh_detail {
namespace {

bool is_zero(const Vec3& p) { return p.x == 0 && p.y == 0 && p.z == 0; }
bool is_finite(const Vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

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
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3& p = column(points, i);
    if (is_zero(p))
      throw Error(ErrorCode::zero_vector, "point " + std::to_string(i) + " is the zero vector", i);
    if (!is_finite(p))
      throw Error(ErrorCode::not_finite,
                  "point " + std::to_string(i) + " has a coordinate that is NaN or infinite", i);
  }
}

/// body(i, curve key of point i) for begin <= i < end.
template <class Body>
void for_each_key(const Points3& points, std::int64_t begin, std::int64_t end, const Body& body) {
  for_each_curve_key(
      begin, end, [&](std::int64_t i) { return to_cube(column(points, i)); }, body);
}

/// For each site its place in the order.
Array<std::int32_t> inverse(const Array<std::int32_t>& order) {
  Array<std::int32_t> place(order.size());
  for_each_block(order.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      place[order[i]] = static_cast<std::int32_t>(i);
  });
  return place;
}

using Triple = std::array<std::int32_t, 3>;

/// A triangle's new ids, from the old ones.
Triple new_ids(const Triangles& triangles, std::int64_t t, const Array<std::int32_t>& place) {
  return {place[triangles(0, t)], place[triangles(1, t)], place[triangles(2, t)]};
}

/// Where a triangle starts. Of vertices that are repeated, as a file may have them, the start is
/// the one that makes the ids the lowest.
int first_vertex(const Triple& ids) {
  const auto vertex = [&](int i) { return ids[static_cast<std::size_t>(i)]; };
  int best = 0;
  for (const int i : {1, 2})
    if (vertex(i) < vertex(best) ||
        (vertex(i) == vertex(best) && vertex(next_vertex(i)) < vertex(next_vertex(best))))
      best = i;
  return best;
}

Triple turned(const Triple& ids, int first) {
  const auto vertex = [&](int i) { return ids[static_cast<std::size_t>(i)]; };
  return {vertex(first), vertex(next_vertex(first)), vertex(previous_vertex(first))};
}

Triple turned(const Triple& ids) { return turned(ids, first_vertex(ids)); }

/// Sorts runs of equal keys by their third vertex: there are none in a manifold, where no two
/// triangles leave a vertex along one edge.
void sort_by_third(const Triangles& triangles, const Array<std::int32_t>& place, Order& order) {
  const auto third = [&](std::int32_t t) { return turned(new_ids(triangles, t, place))[2]; };
  const std::uint64_t* const end = order.keys.end();
  for (const std::uint64_t* run = std::adjacent_find(order.keys.begin(), order.keys.end());
       run != end;) {
    const std::uint64_t* const last = std::find_if(run, end, [&](auto key) { return key != *run; });
    std::int32_t* const items = order.items.begin();
    std::stable_sort(items + (run - order.keys.begin()), items + (last - order.keys.begin()),
                     [&](std::int32_t a, std::int32_t b) { return third(a) < third(b); });
    run = std::adjacent_find(last, end);
  }
}

/// The triangles in canonical order. Keys are the first two vertices, from the highest bits on.
Array<std::int32_t> canonical_order(const Triangles& triangles, const Array<std::int32_t>& place) {
  const int bits = std::bit_width(static_cast<std::uint64_t>(place.size()));
  Array<std::uint64_t> keys(triangles.cols());
  for_each_block(keys.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t) {
      const Triple ids = turned(new_ids(triangles, t, place));
      const auto first = static_cast<std::uint64_t>(ids[0]);
      keys[t] = (first << bits | static_cast<std::uint64_t>(ids[1])) << (key_bits - 2 * bits);
    }
  });
  Order order = order_by_key(std::move(keys));
  sort_by_third(triangles, place, order);
  return std::move(order.items);
}

/// Triangles and neighbours of `mesh` to `out`, in that order.
void move_triangles(const Mesh& mesh, const Array<std::int32_t>& place,
                    const Array<std::int32_t>& order, Mesh& out) {
  const std::int64_t count = order.size();
  Array<std::int32_t> new_triangle(count);
  for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k)
      new_triangle[order[k]] = static_cast<std::int32_t>(k);
  });
  make_room(out.triangles, 3, count);
  make_room(out.neighbours, 3, count);
  for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k != end; ++k) {
      const std::int64_t t = order[k];
      const Triple ids = new_ids(mesh.triangles, t, place);
      const int first = first_vertex(ids);
      const Triple vertices = turned(ids, first);
      const Triple across = turned(
          Triple{mesh.neighbours(0, t), mesh.neighbours(1, t), mesh.neighbours(2, t)}, first);
      for (int i = 0; i < 3; ++i) {
        const std::int32_t old = across[static_cast<std::size_t>(i)];
        out.triangles(i, k) = vertices[static_cast<std::size_t>(i)];
        out.neighbours(i, k) = old < 0 ? -1 : new_triangle[old];
      }
    }
  });
}

/// Both half-edges of each edge.
std::vector<std::pair<std::int32_t, std::int32_t>> half_edges(const Mesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(static_cast<std::size_t>(mesh.triangles.size()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t from = mesh.triangles(next_vertex(i), t),
                         to = mesh.triangles(previous_vertex(i), t);
      edges.emplace_back(from, to);
      if (mesh.neighbours(i, t) < 0)
        edges.emplace_back(to, from);
    }
  return edges;
}

void require_ids(const Mesh& mesh) {
  const std::int64_t sites = mesh.points.cols(), triangles = mesh.triangles.cols();
  if (!are_ids(mesh.triangles, sites) || mesh.neighbours.cols() != triangles ||
      !are_ids(mesh.neighbours, triangles, -1) || !are_ids(mesh.site_of_input, sites))
    throw Error(ErrorCode::bad_option, "the mesh to renumber has an id out of range, or not the "
                                       "neighbours of its triangles; give one as delaunay() or "
                                       "read_mesh() makes it");
}

} // namespace

Array<std::int32_t> curve_order(const Points3& points) {
  require_directions(points);
  Array<std::uint64_t> keys(points.cols());
  for_each_block(keys.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for_each_key(points, begin, end, [&](std::int64_t i, std::uint64_t key) { keys[i] = key; });
  });
  return order_by_key(std::move(keys)).items;
}

bool is_in_curve_order(const Mesh& mesh) {
  const auto triangle = [&](std::int64_t t) {
    return Triple{mesh.triangles(0, t), mesh.triangles(1, t), mesh.triangles(2, t)};
  };
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
  const auto triangles_ascend = [&](std::int64_t begin, std::int64_t end) {
    Triple before = triangle(std::max<std::int64_t>(begin - 1, 0));
    for (std::int64_t t = begin; t != end; ++t) {
      const Triple ids = triangle(t);
      if (first_vertex(ids) != 0 || ids < before)
        return false;
      before = ids;
    }
    return true;
  };
  return are_directions(mesh.points) && holds_for_blocks(mesh.points.cols(), sites_ascend) &&
         holds_for_blocks(mesh.triangles.cols(), triangles_ascend);
}

Array<std::int32_t> reverse_cuthill_mckee_order(const Mesh& mesh) {
  using Graph =
      boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                         boost::no_property, std::int32_t, std::int64_t>;
  const std::int64_t sites = mesh.points.cols();
  const auto edges = half_edges(mesh);
  const Graph graph(boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(),
                    static_cast<std::int32_t>(sites));
  std::vector<boost::default_color_type> colours(static_cast<std::size_t>(sites));
  // Sites of equal degree are told apart by their ids, as no sort is the same in all libraries.
  const auto rank = [&](std::int32_t site) {
    return static_cast<std::int64_t>(out_degree(site, graph)) * sites + site;
  };
  Array<std::int32_t> order(sites);
  boost::cuthill_mckee_ordering(
      graph, std::make_reverse_iterator(order.end()),
      boost::make_iterator_property_map(colours.begin(), get(boost::vertex_index, graph)),
      boost::make_function_property_map<std::int32_t, std::int64_t>(rank));
  return order;
}

Mesh in_order(const Mesh& mesh, const Array<std::int32_t>& order) {
  const Array<std::int32_t> place = inverse(order);
  Mesh out;
  make_room(out.points, 3, mesh.points.cols());
  for_each_block(order.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      out.points.col(i) = mesh.points.col(order[i]);
  });
  move_triangles(mesh, place, canonical_order(mesh.triangles, place), out);
  out.site_of_input.resize(mesh.site_of_input.size());
  std::transform(mesh.site_of_input.begin(), mesh.site_of_input.end(), out.site_of_input.begin(),
                 [&](std::int32_t site) { return place[site]; });
  return out;
}

} // namespace mesh_detail

Mesh renumbered(const Mesh& mesh, Numbering numbering) {
  using namespace mesh_detail;
  require_ids(mesh);
  switch (numbering) {
  case Numbering::curve:
    return in_order(mesh, curve_order(mesh.points));
  case Numbering::rcm:
    return in_order(mesh, reverse_cuthill_mckee_order(mesh));
  default:
    return mesh;
  }
}

} // namespace calotte
