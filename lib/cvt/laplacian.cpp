// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/laplacian.h"

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/points.h"
#include "domain/clipped_cell.h"
#include "mesh/vertex_rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

constexpr double least_share = 6e-5; ///< a thousandth of that of an equilateral triangle

/// The terms of a triangle in the weights of its edges, divided by the edges' squared lengths, with
/// d = delta/l: (1/4 - d^2/3) d. Entry i is for the edge from vertex i to the next.
using Shares = std::array<float, 3>;

/// \param ratio delta/l, delta the signed distance from the edge's middle to the circumcentre.
float share_of(double ratio) { return static_cast<float>((0.25 - ratio * ratio / 3) * ratio); }

/// delta/l on the sphere, where delta is an arc: sin(delta) = l q/sqrt(4 - l^2).
/// \param square l^2.
/// \param q cotangent of the flat triangle's angle across from the edge.
double arc_ratio(double square, double q) {
  if (square * (1 + q * q) < 1e-3) // further terms are below single precision
    return q / 2 * (1 + square * (1.0 / 8 + q * q / 24));
  const double sine = q * std::sqrt(square / (4 - square));
  return arc_sine(std::clamp(sine, -1.0, 1.0)) / std::sqrt(square);
}

/// \param most bound of |delta|/l.
Shares edge_shares(const Sphere&, const std::array<Vec3, 3>& x, double most) {
  const double inverse = 1 / norm(cross(x[1] - x[0], x[2] - x[0]));
  Shares shares;
  for (int v = 0; v < 3; ++v) {
    const Vec3 &a = x[v], &b = x[next_vertex(v)], &c = x[previous_vertex(v)];
    const double ratio = arc_ratio(dot(a - b, a - b), dot(a - c, b - c) * inverse);
    shares[static_cast<std::size_t>(v)] = share_of(std::clamp(ratio, -most, most));
  }
  return shares;
}

Shares edge_shares(const Plane& plane, const std::array<Vec3, 3>& x, double) {
  Shares shares;
  for (int v = 0; v < 3; ++v) {
    const Vec3& c = x[previous_vertex(v)];
    const Vec3 p = plane.offset(c, x[v]), q = plane.offset(c, x[next_vertex(v)]);
    shares[static_cast<std::size_t>(v)] = share_of((p.x * q.x + p.y * q.y) / cross(p, q).z / 2);
  }
  return shares;
}

/// The weights of the edges of a mesh. Only the parts of cells inside a domain of the plane count.
template <Space S> class Edges {
public:
  Edges(const ClippedSites<S>& sites, const Faces& mesh, const Array<Corner>& starts)
      : sites_(sites) {
    if constexpr (!S::on_sphere)
      if (sites.outline != nullptr)
        clip_cells(mesh, starts);
  }

  const Vec3& position(std::int32_t site) const {
    return sites_.positions.points[static_cast<std::size_t>(site)];
  }
  Vec3 offset(std::int32_t from, std::int32_t to) const {
    return sites_.positions.space.offset(position(from), position(to));
  }
  Shares shares(const std::array<Vec3, 3>& x) const {
    return edge_shares(sites_.positions.space, x,
                       sites_.outline != nullptr ? 0.5 : std::numeric_limits<double>::infinity());
  }
  /// The weight, for rho = 1/2, of the edge from i to j, which has c to its left and d to its
  /// right.
  /// \param usual the weight where no boundary is near.
  double weight(std::int32_t i, std::int32_t j, std::int32_t c, std::int32_t d,
                double usual) const {
    if constexpr (!S::on_sphere)
      if (is_clipped(i) && is_clipped(j))
        return i < j ? clipped_weight(i, j, c, d) : clipped_weight(j, i, d, c);
    return usual;
  }
  /// The other terms on the diagonal. A boundary that faces away from the generator, such as the
  /// far side of an island, contributes a negative term. A negative sum of these counts as 0, so
  /// that the matrix stays positive.
  /// \param area of the site.
  double diagonal_terms(std::int32_t i, double rho, double area) const {
    if (S::on_sphere && sites_.outline == nullptr)
      return rho * area * area;
    const bool clipped = is_clipped(i);
    const double whole = clipped ? area_[i] : area;
    if constexpr (S::on_sphere)
      return rho * whole * whole * (4 * std::numbers::pi) / sites_.area;
    return rho * (whole * whole * (4 * std::numbers::pi) / sites_.area +
                  2 * std::max(clipped ? boundary_[i] : 0, 0.0));
  }

private:
  bool is_clipped(std::int32_t i) const { return clipped_.size() > 0 && clipped_[i] != 0; }
  Vec2 in_plane(std::int32_t site) const { return {position(site).x, position(site).y}; }
  Vec2 between(std::int32_t from, std::int32_t to) const {
    const Vec3 way = offset(from, to);
    return {way.x, way.y};
  }

  void clip_cells(const Faces& mesh, const Array<Corner>& starts) {
    const std::int64_t n = sites_.generators;
    clipped_ = Array<std::uint8_t>(n);
    boundary_ = Array<double>(n);
    area_ = Array<double>(n);
    for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      std::vector<Corner> ring;
      for (std::int64_t i = begin; i != end; ++i) {
        gather_ring(mesh, starts[i], ring);
        clip(mesh.triangle_ids, ring, static_cast<std::int32_t>(i));
      }
    });
  }

  void clip(const Triangles& triangles, const std::vector<Corner>& ring, std::int32_t i) {
    clipped_[i] = 0;
    boundary_[i] = area_[i] = 0;
    std::vector<CellCorner> cell;
    for (const auto [t, v] : ring) {
      const Vec2 beyond = between(i, triangles(previous_vertex(v), t));
      cell.push_back({circumcentre(between(i, triangles(next_vertex(v), t)), beyond), beyond});
    }
    const Vec2 site = in_plane(i);
    if (!near_boundary(*sites_.outline, site, cell))
      return;
    clipped_[i] = 1;
    for (const CellSide& side : clipped_cell(*sites_.outline, site, cell)) {
      area_[i] += cross(side.p, side.q) / 2;
      boundary_[i] += side.boundary ? cross(side.p, side.q) / 2 : 0;
    }
  }

  /// The integral of (l^2/4 - s^2)/l over the part of the Voronoi edge inside the domain, s
  /// measured from the middle of the edge. It is at least a thousandth of the value for an
  /// equilateral triangle of the smaller cell's width.
  double clipped_weight(std::int32_t i, std::int32_t j, std::int32_t c, std::int32_t d) const {
    const Vec2 to = between(i, j);
    const double length = norm(to);
    double weight = 0;
    for (const CellSide& part :
         parts_inside(*sites_.outline, in_plane(i), {circumcentre(between(i, d), to), to},
                      circumcentre(to, between(i, c)))) {
      const double p = cross(to, part.p) / length, q = cross(to, part.q) / length;
      weight += (length * length / 4 * (q - p) - (q * q * q - p * p * p) / 3) / length;
    }
    const double square = std::min({length * length, area_[i], area_[j]});
    return std::max(weight, 2 * least_share * square);
  }

  const ClippedSites<S>& sites_;
  Array<std::uint8_t> clipped_; ///< by generator; none where a boundary clips no edges
  Array<double> boundary_,
      area_; ///< of clipped cells: between the generator and the boundary, and all
};

/// The input of a matrix.
struct Source {
  Source(const Connectivity& connectivity, DoubleVector&& density)
      : rho(std::move(density)), mesh{connectivity.triangles, connectivity.neighbours, rho.size()},
        starts(ring_starts(mesh)) {}

  std::int64_t rows() const { return rho.size(); }

  DoubleVector rho;     ///< at the sites with rows; later sites have none
  Faces mesh;           ///< with these sites
  Array<Corner> starts; ///< of their rings
};

/// A cache of the shares of triangles. Where consecutive sites are close to each other, each is
/// computed about once.
template <Space S> class SharesTable {
public:
  SharesTable(const Triangles& triangles, const Edges<S>& edges)
      : triangles_(triangles), edges_(edges) {}

  float of(std::int32_t t, int vertex) {
    const auto slot = static_cast<std::size_t>(t) % slots;
    if (triangle_[slot] != t) {
      triangle_[slot] = t;
      shares_[slot] =
          edges_.shares({edges_.position(triangles_(0, t)), edges_.position(triangles_(1, t)),
                         edges_.position(triangles_(2, t))});
    }
    return shares_[slot][static_cast<std::size_t>(vertex)];
  }

private:
  static constexpr std::size_t slots = 1 << 12;

  const Triangles& triangles_;
  const Edges<S>& edges_;
  std::vector<std::int32_t> triangle_ = std::vector<std::int32_t>(slots, -1);
  std::vector<Shares> shares_ = std::vector<Shares>(slots);
};

/// The row of a site: its neighbours in ascending order with their weights, and the diagonal.
struct MatrixRow {
  std::vector<Corner> ring;
  std::vector<std::pair<std::int32_t, double>> elements;
  double diagonal;
};

template <Space S>
void set_row(const Source& source, SharesTable<S>& shares, const Edges<S>& edges, std::int32_t i,
             MatrixRow& row) {
  gather_ring(source.mesh, source.starts[i], row.ring);
  row.elements.clear();
  double area = 0;
  const Faces& mesh = source.mesh;
  Corner before = row.ring.back();
  Vec3 side_before = edges.offset(i, following_site(mesh, before));
  for (const Corner corner : row.ring) {
    const Corner right = std::exchange(before, corner);
    const std::int32_t j = following_site(mesh, corner), d = following_site(mesh, right);
    const Vec3 side = edges.offset(i, j), right_side = std::exchange(side_before, side);
    if (j >= source.rows())
      continue;
    if (d < source.rows())
      area += norm(cross(right_side, side)) / 6;
    const double share = shares.of(corner.triangle, corner.vertex) +
                         shares.of(right.triangle, previous_vertex(right.vertex));
    const double usual = std::max(share, 2 * least_share) * dot(side, side);
    row.elements.emplace_back(j, (source.rho[i] + source.rho[j]) *
                                     edges.weight(i, j, preceding_site(mesh, corner), d, usual));
  }
  std::sort(row.elements.begin(), row.elements.end());
  row.diagonal = edges.diagonal_terms(i, source.rho[i], area);
  for (const auto& [j, weight] : row.elements)
    row.diagonal += weight;
}

/// The start of each row. A row has an element for each neighbour that has a row itself.
Array<std::int32_t> row_begins(const Source& source) {
  Array<std::int32_t> begin(source.rows() + 1);
  for_each_block(source.rows(), [&](std::int64_t, std::int64_t first, std::int64_t last) {
    std::vector<Corner> ring;
    for (std::int64_t i = first; i != last; ++i) {
      gather_ring(source.mesh, source.starts[i], ring);
      begin[i] = 0;
      for (const Corner corner : ring)
        begin[i] += following_site(source.mesh, corner) < source.rows();
    }
  });
  begin[source.rows()] = 0;
  exclusive_scan(std::span(begin.begin(), begin.end()));
  return begin;
}

template <Space S> Laplacian make_matrix(const Source& source, const Edges<S>& edges) {
  const std::int64_t n = source.rows();
  Laplacian matrix{{row_begins(source), {}}, Array<double>(n)};
  Rows& rows = matrix.weights;
  rows.items = Array<Element>(rows.begin[n]);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    SharesTable shares(source.mesh.triangle_ids, edges);
    MatrixRow row;
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      set_row(source, shares, edges, i, row);
      matrix.scale[i] = 1 / std::sqrt(row.diagonal);
      std::transform(row.elements.begin(), row.elements.end(), rows[i].begin(),
                     [&](const auto& element) {
                       const auto& [j, weight] = element;
                       return Element{j, static_cast<float>(weight / row.diagonal)};
                     });
    }
  });
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      for (Element& element : rows[i])
        element.value *= static_cast<float>(matrix.scale[element.column] / matrix.scale[i]);
  });
  return matrix;
}

} // namespace

template <Space S>
Laplacian graph_laplacian(const ClippedSites<S>& sites, const Connectivity& mesh,
                          const Density& density) {
  const Eigen::Map<const Points3> generators(&sites.positions.points.front().x, 3,
                                             sites.generators);
  const Source source(mesh, evaluate(density, generators));
  return make_matrix(source, Edges<S>(sites, source.mesh, source.starts));
}

template Laplacian graph_laplacian(const ClippedSites<Sphere>&, const Connectivity&,
                                   const Density&);
template Laplacian graph_laplacian(const ClippedSites<Plane>&, const Connectivity&, const Density&);

} // namespace calotte::cvt_detail
