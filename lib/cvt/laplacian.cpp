// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/laplacian.h"

#include "base/elementary.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "cvt/signs.h"
#include "domain/clipped_cell.h"
#include "mesh/vertex_rings.h"

#include <calotte/delaunay.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// An edge ab of a triangle and the circumcentre beside it.
struct HalfEdge {
  double length;
  double delta; ///< signed distance from the edge's middle to the circumcentre
};

/// The share of a triangle in the weight of one of its edges.
struct EdgeShare {
  double weight; ///< (l^2 delta/4 - delta^3/3)/l
  double least;  ///< a thousandth of that of an equilateral triangle
  double area;   ///< of the two half kites, flat
};

EdgeShare share_of(const HalfEdge& edge) {
  const double length = edge.length, delta = edge.delta, square = length * length;
  return {(square / 4 - delta * delta / 3) * delta / length, 6e-5 * square, length * delta / 2};
}

double share_of_both(const EdgeShare& here, const EdgeShare& beyond) {
  return std::max(here.weight + beyond.weight, here.least + beyond.least);
}

/// The edge from a to b of a triangle on the sphere, counter-clockwise to c; delta is an arc.
HalfEdge spherical_edge(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(a - c, b - c);
  const double cotangent = dot(a - c, b - c) / norm(normal);
  const double length = norm(a - b), sine = length / norm(a + b) * cotangent;
  return {length, arc_sine(std::clamp(sine, -1.0, 1.0))};
}

HalfEdge planar_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec2& period) {
  const Vec2 p = nearest_offset(c, a, period), q = nearest_offset(c, b, period);
  const double length = norm(p - q);
  return {length, length / 2 * dot(p, q) / cross(p, q)};
}

/// What an edge adds to a row.
struct EdgeTerms {
  double weight; ///< for rho = 1/2
  double area;   ///< of the cell, between the site and the Voronoi edge
};

EdgeTerms terms_of(const HalfEdge& left, const HalfEdge& right) {
  const EdgeShare here = share_of(left), beyond = share_of(right);
  return {share_of_both(here, beyond), (here.area + beyond.area) / 2};
}

class SphericalEdges {
public:
  explicit SphericalEdges(const Points3& points) : points_(&points) {}

  /// The contribution to site i of the edge to j, which has c to its left and d to its right.
  EdgeTerms edge(std::int32_t i, std::int32_t j, std::int32_t c, std::int32_t d) const {
    const auto at = [&](std::int32_t site) { return column(*points_, site); };
    return terms_of(spherical_edge(at(i), at(j), at(c)), spherical_edge(at(j), at(i), at(d)));
  }
  /// The other terms on the diagonal.
  /// \param area sum over the edges.
  static double held(std::int32_t, double rho, double area) { return rho * area * area; }

private:
  const Points3* points_;
};

/// In a region, whose boundary clips cells.
class RegionEdges {
public:
  RegionEdges(const Points3& places, double area) : points_(&places), area_(area) {}

  EdgeTerms edge(std::int32_t i, std::int32_t j, std::int32_t c, std::int32_t d) const {
    const auto at = [&](std::int32_t site) { return column(*points_, site); };
    return terms_of(near(spherical_edge(at(i), at(j), at(c))),
                    near(spherical_edge(at(j), at(i), at(d))));
  }
  double held(std::int32_t, double rho, double area) const {
    return rho * area * area * (4 * std::numbers::pi) / area_;
  }

private:
  static HalfEdge near(const HalfEdge& edge) {
    return {edge.length, std::clamp(edge.delta, -edge.length / 2, edge.length / 2)};
  }

  const Points3* points_;
  double area_;
};

/// For cells that the domain clips, only the parts inside count.
class PlanarEdges {
public:
  PlanarEdges(const PlanarSites& sites, const Triangles& triangles, const VertexRings& rings)
      : sites_(&sites), clipped_(sites.generators), shore_(sites.generators),
        area_(sites.generators) {
    for_each_block(sites.generators, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        clip(triangles, rings, static_cast<std::int32_t>(i));
    });
  }

  EdgeTerms edge(std::int32_t i, std::int32_t j, std::int32_t c, std::int32_t d) const {
    const auto& at = sites_->places;
    if (clipped_[i] == 0 || clipped_[j] == 0)
      return terms_of(planar_edge(at[i], at[j], at[c], sites_->period),
                      planar_edge(at[j], at[i], at[d], sites_->period));
    return {i < j ? clipped_weight(i, j, c, d) : clipped_weight(j, i, d, c), 0};
  }
  /// A boundary that faces away from the generator, such as the far side of an island, contributes
  /// a negative term; their sum is at least 0, so that the matrix stays positive.
  double held(std::int32_t i, double rho, double area) const {
    const double whole = clipped_[i] != 0 ? area_[i] : area;
    return rho *
           (whole * whole * (4 * std::numbers::pi) / sites_->area + 2 * std::max(shore_[i], 0.0));
  }

private:
  Vec2 offset(std::int32_t from, std::int32_t to) const {
    return nearest_offset(sites_->places[from], sites_->places[to], sites_->period);
  }

  void clip(const Triangles& triangles, const VertexRings& rings, std::int32_t i) {
    clipped_[i] = 0;
    shore_[i] = area_[i] = 0;
    if (sites_->outline == nullptr)
      return;
    std::vector<CellCorner> cell;
    for (std::int64_t s = rings.begin[i]; s != rings.begin[i + 1]; ++s) {
      const std::int32_t t = rings.corners[s].triangle;
      const int v = rings.corners[s].vertex;
      const Vec2 beyond = offset(i, triangles(previous_vertex(v), t));
      cell.push_back({circumcentre(offset(i, triangles(next_vertex(v), t)), beyond), beyond});
    }
    const Vec2 site{sites_->places[i].x, sites_->places[i].y};
    if (!near_shore(*sites_->outline, site, cell))
      return;
    clipped_[i] = 1;
    for (const CellSide& side : clipped_cell(*sites_->outline, site, cell)) {
      area_[i] += cross(side.p, side.q) / 2;
      shore_[i] += side.shore ? cross(side.p, side.q) / 2 : 0;
    }
  }

  /// The integral of l^2/4 - s^2 over l, s from the edge's middle on, where the Voronoi edge is
  /// inside; a thousandth of an equilateral triangle's of the smaller cell's width at least.
  double clipped_weight(std::int32_t i, std::int32_t j, std::int32_t c, std::int32_t d) const {
    const Vec2 site{sites_->places[i].x, sites_->places[i].y}, to = offset(i, j);
    const double length = norm(to);
    double weight = 0;
    for (const CellSide& part :
         parts_inside(*sites_->outline, site, {circumcentre(offset(i, d), to), to},
                      circumcentre(to, offset(i, c)))) {
      const double p = cross(to, part.p) / length, q = cross(to, part.q) / length;
      weight += (length * length / 4 * (q - p) - (q * q * q - p * p * p) / 3) / length;
    }
    const double square = std::min({length * length, area_[i], area_[j]});
    return std::max(weight, 1.2e-4 * square);
  }

  const PlanarSites* sites_;
  Array<std::uint8_t> clipped_;
  Array<double> shore_, area_; ///< of clipped cells: between the generator and the shore, and all
};

/// The input of a matrix.
struct Source {
  const Triangles& triangles;
  VertexRings rings; ///< number of sites with rows; later sites have none
  Eigen::VectorXd rho;

  std::int64_t rows() const { return rho.size(); }
};

/// The row of a site: its neighbours and itself with their coefficients, ascending.
using Row = std::vector<std::pair<std::int32_t, double>>;

template <class Edges>
void set_row(const Source& source, const Edges& edges, std::int32_t i, Row& row) {
  row.clear();
  double sum = 0, area = 0;
  const VertexRings& rings = source.rings;
  Corner before = rings.corners[rings.begin[i + 1] - 1];
  for (std::int64_t s = rings.begin[i]; s != rings.begin[i + 1]; ++s) {
    const Corner corner = rings.corners[s];
    const std::int32_t t = corner.triangle, u = before.triangle;
    const int v = corner.vertex, w = before.vertex;
    before = corner;
    const std::int32_t j = source.triangles(next_vertex(v), t);
    if (j >= source.rows())
      continue;
    const EdgeTerms terms = edges.edge(i, j, source.triangles(previous_vertex(v), t),
                                       source.triangles(next_vertex(w), u));
    const double weight = (source.rho[i] + source.rho[j]) * terms.weight;
    row.emplace_back(j, -weight);
    sum += weight;
    area += terms.area;
  }
  row.emplace_back(i, sum + edges.held(i, source.rho[i], area));
  std::sort(row.begin(), row.end());
}

/// The start of each row: a row has an element for each neighbour with a row, and one for itself.
Array<std::int32_t> row_begins(const Source& source) {
  Array<std::int32_t> begin(source.rows() + 1);
  const VertexRings& rings = source.rings;
  for_each_block(source.rows(), [&](std::int64_t, std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i != last; ++i) {
      begin[i] = 1;
      for (std::int64_t s = rings.begin[i]; s != rings.begin[i + 1]; ++s) {
        const Corner corner = rings.corners[s];
        begin[i] += source.triangles(next_vertex(corner.vertex), corner.triangle) < source.rows();
      }
    }
  });
  begin[source.rows()] = 0;
  exclusive_scan(std::span(begin.begin(), begin.end()));
  return begin;
}

template <class Edges> SparseMatrix make_matrix(const Source& source, const Edges& edges) {
  const std::int64_t n = source.rows();
  const Array<std::int32_t> row_begin = row_begins(source);
  SparseMatrix matrix(n, n);
  matrix.resizeNonZeros(row_begin[n]);
  std::copy(row_begin.begin(), row_begin.end(), matrix.outerIndexPtr());
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    Row row;
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      std::int32_t place = row_begin[i];
      set_row(source, edges, i, row);
      for (const auto& [j, value] : row) {
        matrix.innerIndexPtr()[place] = j;
        matrix.valuePtr()[place++] = value;
      }
    }
  });
  return matrix;
}

/// The matrix counts its entries, at most 7 n, by int32.
void require_countable(std::int64_t generators) {
  require(generators <= std::numeric_limits<std::int32_t>::max() / 7,
          "there are " + std::to_string(generators) +
              " generators, too many for the method lbfgs_laplacian: take lbfgs or lloyd");
}

} // namespace

SparseMatrix graph_laplacian(const Points3& points, const Connectivity& mesh,
                             const Density& density) {
  require_countable(points.cols());
  const Source source{mesh.triangles,
                      make_vertex_rings(mesh.triangles, mesh.neighbours, points.cols()),
                      evaluate(density, points)};
  return make_matrix(source, SphericalEdges(points));
}

SparseMatrix graph_laplacian(const Points3& places, std::int64_t generators, double area,
                             const Connectivity& mesh, const Density& density) {
  require_countable(generators);
  const Source source{mesh.triangles,
                      make_vertex_rings(mesh.triangles, mesh.neighbours, generators),
                      evaluate(density, Points3(places.leftCols(generators)))};
  return make_matrix(source, RegionEdges(places, area));
}

SparseMatrix graph_laplacian(const PlanarSites& sites, const Connectivity& mesh,
                             const Density& density) {
  require_countable(sites.generators);
  VertexRings rings = make_vertex_rings(mesh.triangles, mesh.neighbours, sites.generators);
  Points3 points(3, sites.generators);
  for (std::int64_t i = 0; i < sites.generators; ++i)
    set_column(points, i, sites.places[i]);
  const PlanarEdges edges(sites, mesh.triangles, rings);
  const Source source{mesh.triangles, std::move(rings), evaluate(density, points)};
  return make_matrix(source, edges);
}

} // namespace calotte::cvt_detail
