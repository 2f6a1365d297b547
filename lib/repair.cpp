// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include "parallel.h"
#include "points.h"
#include "predicates.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <optional>
#include <vector>

namespace calotte::detail {
namespace {

/// An edge of a triangle, across from its vertex.
struct TriangleEdge {
  std::int32_t triangle;
  int across;
};

const Vec3& site(const Mesh& mesh, std::int32_t i) { return column(mesh.points, i); }

/// Index in a triangle of the vertex across from its neighbour.
int index_of(const Mesh& mesh, std::int32_t triangle, std::int32_t neighbour) {
  return mesh.neighbours(0, triangle) == neighbour   ? 0
         : mesh.neighbours(1, triangle) == neighbour ? 1
                                                     : 2;
}

/// Edges and triangles that the pulls leave in doubt.
struct Doubts {
  std::vector<TriangleEdge> edges;
  std::vector<std::int32_t> triangles;
};

/// The pulls of an edge, some tenths each, err by roundoffs over the edge's length, times 1 + cot^2
/// for thin triangles. A doubt too many costs a predicate, one too few an edge that is Delaunay but
/// for a length of 1e-9 of its cell's.
bool is_clear(double pull, double other) {
  return pull + other > 1e-9 * (1 + 16 * (pull * pull + other * other));
}

Doubts find_doubts(const Mesh& mesh, const Pulls& pulls) {
  const std::int64_t m = mesh.triangles.cols();
  std::vector<Doubts> found(static_cast<std::size_t>(block_count(m)));
  for_each_block(m, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Doubts& doubts = found[static_cast<std::size_t>(block)];
    for (auto t = static_cast<std::int32_t>(begin); t != end; ++t) {
      if (!(pulls[4 * std::int64_t{t} + 3] > 1e-14))
        doubts.triangles.push_back(t);
      for (int e = 0; e < 3; ++e) {
        const std::int32_t beyond = mesh.neighbours(e, t);
        if (beyond < t)
          continue;
        const double other = pulls[4 * std::int64_t{beyond} + index_of(mesh, beyond, t)];
        if (!is_clear(pulls[4 * std::int64_t{t} + e], other))
          doubts.edges.push_back({t, e});
      }
    }
  });
  Doubts all;
  for (const Doubts& doubts : found) {
    all.edges.insert(all.edges.end(), doubts.edges.begin(), doubts.edges.end());
    all.triangles.insert(all.triangles.end(), doubts.triangles.begin(), doubts.triangles.end());
  }
  return all;
}

bool is_overturned(const Mesh& mesh, std::int32_t t) {
  return orientation(site(mesh, mesh.triangles(0, t)), site(mesh, mesh.triangles(1, t)),
                     site(mesh, mesh.triangles(2, t))) <= 0;
}

bool is_delaunay(const Mesh& mesh, const TriangleEdge& edge) {
  const std::int32_t beyond = mesh.neighbours(edge.across, edge.triangle);
  const std::int32_t apex = mesh.triangles(index_of(mesh, beyond, edge.triangle), beyond);
  return in_circle_resolved(View{}, site(mesh, mesh.triangles(0, edge.triangle)),
                            site(mesh, mesh.triangles(1, edge.triangle)),
                            site(mesh, mesh.triangles(2, edge.triangle)), site(mesh, apex)) <= 0;
}

/// Replaces the edge bc of the triangles abc and dcb by ad: they become abd and dca. The four outer
/// edges are to be looked at again.
void flip(Mesh& mesh, const TriangleEdge& edge, std::vector<TriangleEdge>& pending) {
  const std::int32_t t = edge.triangle, u = mesh.neighbours(edge.across, t);
  const int at = edge.across, ut = index_of(mesh, u, t);
  const std::int32_t a = mesh.triangles(at, t), b = mesh.triangles(next_vertex(at), t),
                     c = mesh.triangles(previous_vertex(at), t), d = mesh.triangles(ut, u);
  const std::int32_t across_b = mesh.neighbours(next_vertex(at), t),
                     across_c = mesh.neighbours(previous_vertex(at), t),
                     beyond_bd = mesh.neighbours(next_vertex(ut), u),
                     beyond_dc = mesh.neighbours(previous_vertex(ut), u);
  // u is d c b: across from c lies bd, across from b lies dc.
  mesh.triangles.col(t) << a, b, d;
  mesh.neighbours.col(t) << beyond_bd, u, across_c;
  mesh.triangles.col(u) << d, c, a;
  mesh.neighbours.col(u) << across_b, t, beyond_dc;
  mesh.neighbours(index_of(mesh, beyond_bd, u), beyond_bd) = t;
  mesh.neighbours(index_of(mesh, across_b, t), across_b) = u;
  for (const TriangleEdge& outer :
       {TriangleEdge{t, 0}, TriangleEdge{t, 2}, TriangleEdge{u, 0}, TriangleEdge{u, 2}})
    pending.push_back(outer);
}

/// Flips until all edges are Delaunay; empty when that takes more than `most` flips.
std::optional<std::int64_t> flip_all(Mesh& mesh, std::vector<TriangleEdge> pending,
                                     std::int64_t most) {
  std::int64_t flips = 0;
  while (!pending.empty()) {
    const TriangleEdge edge = pending.back();
    pending.pop_back();
    if (is_delaunay(mesh, edge))
      continue;
    if (++flips > most)
      return std::nullopt;
    flip(mesh, edge, pending);
  }
  return flips;
}

} // namespace

Repair repair(Mesh& mesh, Stars& stars, Pulls& pulls) {
  const Doubts doubts = find_doubts(mesh, pulls);
  Repair result;
  for (const std::int32_t t : doubts.triangles)
    result.rebuilt = result.rebuilt || is_overturned(mesh, t);
  // A flip costs about as much as three sites of a new triangulation, which is parallel.
  const std::int64_t most = mesh.points.cols() / 16;
  if (!result.rebuilt) {
    const std::optional<std::int64_t> flips = flip_all(mesh, doubts.edges, most);
    result.rebuilt = !flips;
    result.flips = flips.value_or(0);
  }
  if (result.rebuilt) {
    const Eigen::Index n = mesh.points.cols();
    mesh = delaunay(mesh.points);
    if (mesh.points.cols() != n || !mesh.closed())
      throw Error(
          ErrorCode::too_few_sites,
          "generators met, or left a hemisphere empty: take another start or a smoother density");
  }
  if (result.rebuilt || result.flips > 0) {
    stars = make_stars(mesh);
    pulls = edge_pulls(mesh);
  }
  return result;
}

} // namespace calotte::detail
