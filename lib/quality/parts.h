// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "base/triangle.h"
#include "mesh/connectivity.h"
#include "mesh/vertex_rings.h"
#include "quality/room.h"

#include <calotte/quality.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

/// The measures of a mesh that follow from the shapes of its triangles, on the sphere and in the
/// plane.
namespace calotte::quality_detail {

/// The value of a measure that does not exist.
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Tolerance for angles that are exactly 0 or 90 degrees in lattices.
inline constexpr double rounding_of_lattices = 1e-9;

/// An accumulator for a ValueRange.
struct Tally {
  double min = std::numeric_limits<double>::infinity(), max = -min, sum = 0;
  std::int64_t count = 0;

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
    sum += value;
    ++count;
  }
  void join(const Tally& other) {
    min = std::min(min, other.min);
    max = std::max(max, other.max);
    sum += other.sum;
    count += other.count;
  }
  ValueRange range(double scale = 1) const {
    if (count == 0)
      return {};
    return {scale * min, scale * sum / static_cast<double>(count), scale * max};
  }
};

/// The shape of a triangle; [v] is of vertex v, or of the side across from it.
struct Shape {
  std::array<double, 3> angle; ///< flat
  std::array<double, 3> side;  ///< on the sphere an arc
  std::array<double, 3>
      delta; ///< signed distance from the side's midpoint to the circumcentre, an arc there
};

using Shapes = Array<Shape>;

/// The mesh to measure, with the data that all measures need.
struct Subject {
  const Triangles& triangles;
  const Triangles& neighbours;
  VertexRings rings; ///< of the sites with cells
  Shapes shapes;
  DoubleVector inverse_spacing; ///< by site: 1/h of the density; empty to skip it
  Array<std::uint8_t> inside;   ///< by triangle: whether it is in the domain; empty if all are
  Array<std::uint8_t> whole;    ///< by site: whether its cell is in the domain; empty if all are

  bool has(std::int64_t triangle) const { return inside.size() == 0 || inside[triangle] != 0; }
  /// Edge length over the spacing demanded, for the edge across from a triangle's vertex.
  double fit(std::int64_t triangle, int vertex) const {
    const double demanded = inverse_spacing[triangles(next_vertex(vertex), triangle)] +
                            inverse_spacing[triangles(previous_vertex(vertex), triangle)];
    return shapes[triangle].side[static_cast<std::size_t>(vertex)] * demanded / 2;
  }
  bool has_whole(std::int64_t site) const { return whole.size() == 0 || whole[site] != 0; }
};

/// The Delaunay edge across from a triangle's vertex, and its Voronoi edge.
struct Edge {
  double arc = 0;
  double voronoi = 0; ///< length; 0 if only rounding is left of it
  double offset = 0;  ///< of the Voronoi edge's midpoint from the Delaunay edge's
};

/// \param other the triangle across from vertex v of one, and its vertex w across from that.
inline Edge edge_of(const Shape& one, int v, const Shape& other, int w) {
  const double arc = one.side[static_cast<std::size_t>(v)];
  const double here = one.delta[static_cast<std::size_t>(v)],
               there = other.delta[static_cast<std::size_t>(w)];
  const double length = here + there;
  return {arc, length < rounding_of_lattices * arc ? 0 : length, 0.5 * std::abs(here - there)};
}

/// Calls body(part, i) for 0 <= i < n, each block with its own part, and joins the parts in the
/// order of the blocks, so that sums are the same for any number of threads.
template <class Part, class Body> Part join_blocks(std::int64_t n, const Body& body) {
  std::vector<Part> parts(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Part part;
    for (std::int64_t i = begin; i != end; ++i)
      body(part, i);
    parts[static_cast<std::size_t>(block)] = std::move(part);
  });
  Part whole;
  for (const Part& part : parts)
    whole.join(part);
  return whole;
}

// ---- Triangles

struct TrianglePart {
  Tally quality, angles;
  std::int64_t obtuse = 0;

  void join(const TrianglePart& other) {
    quality.join(other.quality);
    angles.join(other.angles);
    obtuse += other.obtuse;
  }
};

inline bool is_obtuse(const Shape& shape) {
  return *std::max_element(shape.angle.begin(), shape.angle.end()) >
         std::numbers::pi / 2 + rounding_of_lattices;
}

inline bool is_short(const Edge& edge) { return edge.voronoi < short_voronoi_edge * edge.arc; }

inline bool is_mismatched(double fit) {
  return !(fit >= shortest_dc_over_h && fit <= longest_dc_over_h);
}

inline void add_triangle(TrianglePart& part, const Shape& shape) {
  const auto& [a, b, c] = shape.side;
  part.quality.add((b + c - a) * (c + a - b) * (a + b - c) / (a * b * c));
  for (const double angle : shape.angle)
    part.angles.add(angle);
  part.obtuse += is_obtuse(shape);
}

// ---- Edges

struct EdgePart {
  Tally spacing, off_centring, ratio; ///< ratio of the Voronoi edge to the Delaunay edge
  std::int64_t short_edges = 0, mismatched_edges = 0;
  std::vector<double> fits;

  void join(const EdgePart& other) {
    spacing.join(other.spacing);
    off_centring.join(other.off_centring);
    ratio.join(other.ratio);
    short_edges += other.short_edges;
    mismatched_edges += other.mismatched_edges;
    fits.insert(fits.end(), other.fits.begin(), other.fits.end());
  }
};

/// \param values are reordered.
inline Percentiles percentiles(std::vector<double>& values) {
  if (values.empty())
    return {};
  const auto rank = [&](double percent) {
    const double count = std::ceil(percent / 100 * static_cast<double>(values.size()));
    return values.begin() + static_cast<std::ptrdiff_t>(count) - 1;
  };
  const auto select = [&](double after, double percent, double before) {
    const auto first = after > 0 ? rank(after) : values.begin(),
               end = before < 100 ? rank(before) + 1 : values.end();
    std::nth_element(first, rank(percent), end);
    return *rank(percent);
  };
  Percentiles result;
  result.p50 = select(0, 50, 100);
  result.p5 = select(0, 5, 50);
  result.p1 = select(0, 1, 5);
  result.p95 = select(50, 95, 100);
  result.p99 = select(95, 99, 100);
  result.min = *std::min_element(values.begin(), rank(1) + 1);
  result.max = *std::max_element(rank(99), values.end());
  return result;
}

/// The edges that triangle t shares with a triangle of a higher number.
inline void add_edges(EdgePart& part, const Subject& subject, std::int64_t t) {
  const Triangles& neighbours = subject.neighbours;
  for (int v = 0; v < 3; ++v) {
    const std::int32_t other = neighbours(v, t);
    if (other < t || !(subject.has(t) || subject.has(other)))
      continue;
    const int w = mesh_detail::vertex_across(neighbours, other, t);
    const Edge edge = edge_of(subject.shapes[t], v, subject.shapes[other], w);
    part.spacing.add(edge.arc);
    if (subject.inverse_spacing.size() > 0) {
      part.fits.push_back(subject.fit(t, v));
      part.mismatched_edges += is_mismatched(part.fits.back());
    }
    if (!subject.has(t) || !subject.has(other))
      continue;
    part.ratio.add(edge.voronoi / edge.arc);
    part.short_edges += is_short(edge);
    if (edge.voronoi > 0)
      part.off_centring.add(edge.offset / edge.voronoi);
  }
}

// ---- Cells

struct CellPart {
  Tally sigma, quality, bad_spacing;
  std::vector<std::int64_t> degrees;

  void count(std::size_t degree, std::int64_t cells) {
    if (degrees.size() <= degree)
      degrees.resize(degree + 1, 0);
    degrees[degree] += cells;
  }
  void join(const CellPart& other) {
    sigma.join(other.sigma);
    quality.join(other.quality);
    bad_spacing.join(other.bad_spacing);
    for (std::size_t degree = 0; degree < other.degrees.size(); ++degree)
      count(degree, other.degrees[degree]);
  }
};

inline void add_cell(CellPart& part, const Subject& subject, std::int64_t site) {
  const std::span<const Corner> ring = subject.rings[site];
  Tally arcs, voronoi;
  bool bad = false;
  Corner before = ring.back();
  for (const Corner corner : ring) {
    const int across = previous_vertex(corner.vertex);
    const Edge edge = edge_of(subject.shapes[corner.triangle], across,
                              subject.shapes[before.triangle], next_vertex(before.vertex));
    bad = bad || is_short(edge) || is_mismatched(subject.fit(corner.triangle, across)) ||
          is_obtuse(subject.shapes[corner.triangle]);
    arcs.add(edge.arc);
    voronoi.add(edge.voronoi);
    before = corner;
  }
  part.sigma.add(arcs.min / arcs.max);
  part.quality.add(voronoi.min / voronoi.max);
  if (bad)
    part.bad_spacing.add(arcs.sum / static_cast<double>(arcs.count));
  part.count(ring.size(), 1);
}

/// Sets all measures except residual, energy, its limit and areas.
inline Quality measure_shapes(const Subject& subject, std::int64_t cells) {
  const std::int64_t m = subject.shapes.size();
  const auto triangles = join_blocks<TrianglePart>(m, [&](TrianglePart& part, std::int64_t t) {
    if (subject.has(t))
      add_triangle(part, subject.shapes[t]);
  });
  auto edges = join_blocks<EdgePart>(
      m, [&](EdgePart& part, std::int64_t t) { add_edges(part, subject, t); });
  auto of_cells = join_blocks<CellPart>(cells, [&](CellPart& part, std::int64_t i) {
    if (subject.has_whole(i))
      add_cell(part, subject, i);
  });
  Quality result;
  result.cells = cells;
  result.triangles = triangles.quality.count;
  result.degrees = std::move(of_cells.degrees);
  result.spacing = edges.spacing.range();
  result.sigma = of_cells.sigma.range();
  result.cell_quality = of_cells.quality.range();
  result.triangle_quality = triangles.quality.range();
  result.angles = triangles.angles.range(180 / std::numbers::pi);
  result.obtuse = triangles.obtuse;
  result.off_centring = edges.off_centring.range();
  result.dv_over_dc = edges.ratio.range();
  result.dc_over_h = percentiles(edges.fits);
  result.short_edges = edges.short_edges;
  result.mismatched_edges = edges.mismatched_edges;
  result.bad_cells = of_cells.bad_spacing.count;
  result.bad_spacing = of_cells.bad_spacing.range();
  return result;
}

} // namespace calotte::quality_detail
