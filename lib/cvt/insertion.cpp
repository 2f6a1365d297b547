// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/insertion.h"

#include <calotte/cvt.h>

#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/triangle.h"
#include "density/surface_density.h"
#include "domain/near_boundary.h"
#include "domain/surface.h"
#include "exact/space.h"
#include "mesh/edges.h"
#include "mesh/stars.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using base_detail::column;
using base_detail::require;
using mesh_detail::Stars;
using namespace domain_detail;
using namespace cvt_detail;

/// An edge, and its length in units of the demanded spacing there, up to a common factor.
struct Edge {
  double length;
  std::int32_t a, b; ///< a < b
};

bool is_longer(const Edge& e, const Edge& f) {
  return std::tie(f.length, e.a, e.b) < std::tie(e.length, f.a, f.b);
}

bool is_shorter(const Edge& e, const Edge& f) {
  return std::tie(e.length, e.a, e.b) < std::tie(f.length, f.a, f.b);
}

/// rho^(1/4) at columns: 1/h up to a factor.
DoubleVector fineness(const Density& density, const Points3& points) {
  return evaluate(density, points).cwiseSqrt().cwiseSqrt();
}

/// Selects edges that are far from each other: no end of one is an end of another or next to it.
class Choice {
public:
  explicit Choice(const Mesh& mesh)
      : stars_(faces_of(mesh)), blocked_(static_cast<std::size_t>(mesh.points.cols()), 0) {}

  /// Selects up to `count` of the allowed edges, the first ones in an order. Reorders the edges.
  template <class Before, class Allowed>
  std::vector<Edge> choose(std::vector<Edge>& edges, std::int64_t count, const Before& before,
                           const Allowed& allowed) {
    std::vector<Edge> chosen;
    const auto wanted = static_cast<std::size_t>(count);
    std::size_t sorted = 0;
    while (chosen.size() < wanted && sorted < edges.size()) {
      const auto begin = edges.begin() + static_cast<std::ptrdiff_t>(sorted);
      const std::size_t end = std::min(edges.size(), sorted + 4 * wanted + 64);
      const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(end);
      std::nth_element(begin, middle, edges.end(), before);
      std::sort(begin, middle, before);
      for (; sorted < end && chosen.size() < wanted; ++sorted)
        if (allowed(edges[sorted]) && take(edges[sorted]))
          chosen.push_back(edges[sorted]);
    }
    return chosen;
  }

private:
  bool take(const Edge& edge) {
    std::uint8_t& a = blocked_[static_cast<std::size_t>(edge.a)];
    std::uint8_t& b = blocked_[static_cast<std::size_t>(edge.b)];
    if (a != 0 || b != 0)
      return false;
    for (const std::int32_t end : {edge.a, edge.b})
      stars_.for_each_neighbour(
          end, [&](std::int32_t other) { blocked_[static_cast<std::size_t>(other)] = 1; });
    a = b = 1;
    return true;
  }

  Stars stars_;
  std::vector<std::uint8_t> blocked_;
};

void require_counts(std::int64_t sites, std::int64_t inserted, std::int64_t contracted) {
  require(inserted >= 0 && contracted >= 0 && sites <= most_points - inserted,
          "the numbers of edges are {} and {}; give 0 or more, with at most {} points in all",
          inserted, contracted, most_points);
}

/// By site: 1 for 8 or more sides, -1 for 4 or fewer, 0 for others and for sites on the hull of an
/// open mesh. Relaxation does not repair cells with 8 sides or 4.
std::vector<std::int8_t> oddities(const Mesh& mesh) {
  constexpr int many = 8, few = 4;
  const Stars stars(faces_of(mesh));
  std::vector<std::int8_t> odd;
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i)
    odd.push_back(stars.is_closed(i)
                      ? static_cast<std::int8_t>((stars.size(i) >= many) - (stars.size(i) <= few))
                      : std::int8_t{0});
  return odd;
}

/// The edges, with their lengths relative to the spacing. Edges at sites with many neighbours count
/// as longer, so that they are split first; edges at sites with few neighbours count as shorter.
template <Space S>
std::vector<Edge> measure_edges(const Mesh& mesh, const Points3& points, const Density& density,
                                const S& space) {
  constexpr double preference = 2;
  const mesh_detail::EdgeCount count =
      mesh_detail::count_edges(mesh); // refuses a mesh without neighbours
  const DoubleVector fine = fineness(density, points);
  const std::vector<std::int8_t> odd = oddities(mesh);
  std::vector<Edge> edges(static_cast<std::size_t>(count.all));
  mesh_detail::for_each_edge(mesh, count, [&](std::int64_t e, std::int32_t a, std::int32_t b) {
    const int sum = odd[static_cast<std::size_t>(a)] + odd[static_cast<std::size_t>(b)];
    const double length = norm(space.offset(column(points, a), column(points, b))),
                 factor = sum > 0   ? preference
                          : sum < 0 ? 1 / preference
                                    : 1;
    edges[static_cast<std::size_t>(e)] = {factor * length * (fine[a] + fine[b]), std::min(a, b),
                                          std::max(a, b)};
  });
  return edges;
}

/// The remaining points, then the inserted ones. Points of contracted edges are moved to the
/// midpoints unless they are fixed.
template <class Middle>
Points3 split_and_collapsed(const Points3& points, const std::vector<Edge>& split,
                            const std::vector<Edge>& contracted, std::int64_t fixed,
                            const Middle& middle) {
  Points3 moved = points;
  std::vector<std::uint8_t> gone(static_cast<std::size_t>(points.cols()), 0);
  for (const Edge& edge : contracted) {
    if (edge.a >= fixed)
      base_detail::set_column(moved, edge.a, middle(edge));
    gone[static_cast<std::size_t>(edge.b)] = 1;
  }
  Points3 out(3, points.cols() + std::ssize(split) - std::ssize(contracted));
  std::int64_t next = 0;
  for (std::int64_t i = 0; i < points.cols(); ++i)
    if (gone[static_cast<std::size_t>(i)] == 0)
      out.col(next++) = moved.col(i);
  for (const Edge& edge : split)
    base_detail::set_column(out, next++, middle(edge));
  return out;
}

/// True if the midpoint of an edge is within a fifth of its length of the boundary.
template <Space S> bool lies_along(const OutlineOf<S>& outline, const Vec3& a, const Vec3& b) {
  constexpr double share = 0.2;
  const double reach = share * norm(b - a);
  const Vec3 middle = S{}.midpoint(a, b);
  bool near = false;
  for_each_edge_near<S>(outline, middle, reach, [&](const Arc& edge) {
    const Vec3 apart = nearest_point<S>(edge, middle) - middle;
    near = near || dot(apart, apart) <= reach * reach;
  });
  return near;
}

/// The midpoints of split edges lie inside the boundary.
template <Space S>
Points3 change_edges(const Mesh& mesh, const Points3& points, const Density& density,
                     const S& space, const EdgeChanges& numbers) {
  require_counts(points.cols(), numbers.splits, numbers.collapses);
  const OutlineOf<S>* const outline = outline_of<S>(mesh.surface);
  std::vector<Edge> edges = measure_edges(mesh, points, density, space);
  const auto middle = [&](const Edge& edge) {
    return space.midpoint(column(points, edge.a), column(points, edge.b));
  };
  std::optional<DemandedSpacing> spacing; // beside fixed points
  if (numbers.fixed > 0)
    spacing.emplace(mesh.surface, density,
                    static_cast<double>(points.cols() + numbers.splits - numbers.collapses));
  const auto may_split = [&](const Edge& edge) {
    return edge.b >= numbers.fixed ||
           !is_full_gap<S>(outline, *spacing, space, column(points, edge.a),
                           column(points, edge.b));
  };
  const auto may_collapse = [&](const Edge& edge) { return edge.b >= numbers.fixed; };
  Choice choice(mesh);
  if (outline != nullptr)
    std::erase_if(
        edges, [&](const Edge& edge) { return side_of<S>(outline, middle(edge)) != Side::inside; });
  const std::vector<Edge> split = choice.choose(edges, numbers.splits, is_longer, may_split),
                          contracted =
                              choice.choose(edges, numbers.collapses, is_shorter, may_collapse);
  return split_and_collapsed(points, split, contracted, numbers.fixed, middle);
}

/// The points in the form of a run: on the sphere unit vectors.
/// \param fixed number of points that keep their bits.
Points3 points_of_run(const Mesh& mesh, std::int64_t fixed = 0) {
  Points3 out = mesh.points;
  for (std::int64_t i = fixed; mesh.surface.is_sphere() && i < out.cols(); ++i)
    base_detail::set_column(out, i, unit_of_any_norm(column(mesh.points, i)));
  return out;
}

} // namespace

namespace cvt_detail {

/// Where h changes by a factor 1 + g from one cell to the next, one row of cells in 1/g must end.
/// Averaged over directions, the |change of log h| along an edge is 2/pi of g times its length.
/// There are three edges for each cell, whose area is sqrt(3)/2 h^2.
double dislocations(const Mesh& mesh, const Density& density) {
  constexpr double per_edge = std::numbers::sqrt3 / 2 * (std::numbers::pi / 2) / 3;
  const DoubleVector fine = fineness(density, points_of_run(mesh));
  const double sum = sums_over_blocks(
      mesh.triangles.cols(), 1, [&](base_detail::Part part, std::span<double> total) {
        mesh_detail::for_each_edge_of(
            mesh, part.begin, part.end, [&](std::int32_t a, std::int32_t b) {
              if (const double larger = std::max(fine[a], fine[b]); larger > 0)
                total[0] += std::abs(fine[a] - fine[b]) / larger;
            });
      })[0];
  return per_edge * sum;
}

std::int64_t count_odd(const Mesh& mesh) {
  const std::vector<std::int8_t> odd = oddities(mesh);
  return std::ssize(odd) - std::count(odd.begin(), odd.end(), 0);
}

Points3 split_and_collapsed(const Mesh& mesh, const Density& density, const EdgeChanges& changes) {
  return in_space_of(mesh.surface, [&](const Space auto& space) {
    return change_edges(mesh, points_of_run(mesh, changes.fixed), density, space, changes);
  });
}

template <Space S>
bool is_full_gap(const OutlineOf<S>* outline, const DemandedSpacing& spacing, const S& space,
                 const Vec3& a, const Vec3& b) {
  constexpr double near = 1.6; // square roots of areas: 1.5 widths of hexagons
  const Vec3 middle = space.midpoint(a, b);
  return (outline != nullptr && lies_along<S>(*outline, a, b)) ||
         norm(space.offset(a, b)) < near * spacing.at(middle);
}

template bool is_full_gap<Sphere>(const OutlineOf<Sphere>*, const DemandedSpacing&, const Sphere&,
                                  const Vec3&, const Vec3&);
template bool is_full_gap<Plane>(const OutlineOf<Plane>*, const DemandedSpacing&, const Plane&,
                                 const Vec3&, const Vec3&);

} // namespace cvt_detail

Points3 split_and_collapse(const Mesh& mesh, const Density& density, std::int64_t splits,
                           std::int64_t collapses) {
  return split_and_collapsed(mesh, density_detail::surface_density(density, mesh.surface),
                             {splits, collapses});
}

} // namespace calotte
