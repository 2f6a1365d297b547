// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/quality.h>

#include "moments.h"
#include "parallel.h"
#include "points.h"
#include "predicates.h"
#include "stars.h"

#include <calotte/check.h>
#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace detail {
namespace {

constexpr double pi = std::numbers::pi;

/// What lattices make exactly 0 or 90 degrees comes out within this of it.
constexpr double rounding = 1e-9;

/// A Range in the making.
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
  Range range(double scale = 1) const {
    if (count == 0)
      return {};
    return {scale * min, scale * sum / static_cast<double>(count), scale * max};
  }
};

/// A triangle; [v] is of vertex v, or of the side across from it.
struct Shape {
  std::array<double, 3> angle; ///< flat
  std::array<double, 3> side;  ///< arc
  std::array<double, 3> delta; ///< signed arc from the side's midpoint to the circumcentre
};

/// sin(delta) = |a-b|/|a+b| cot(C), as in moments.h.
Shape shape_of(const std::array<Vec3, 3>& p) {
  const double twice_area = norm(cross(p[1] - p[0], p[2] - p[0]));
  Shape shape{};
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3 a = p[(v + 1) % 3], b = p[(v + 2) % 3];
    const double product = dot(a - p[v], b - p[v]), difference = norm(a - b), sum = norm(a + b);
    const double sine = difference / sum * (product / twice_area);
    shape.angle[v] = std::atan2(twice_area, product);
    shape.side[v] = 2 * std::atan2(difference, sum);
    shape.delta[v] = std::asin(std::clamp(sine, -1.0, 1.0)); // rounding can pass a hemisphere
  }
  return shape;
}

using Shapes = Array<Shape>;

/// What is measured, with all that its parts need: a closed mesh of unit columns.
struct Subject {
  const Mesh& mesh;
  Stars stars;
  Shapes shapes;
};

/// The Delaunay edge across from a triangle's vertex, and its Voronoi edge.
struct Edge {
  double arc = 0;
  double voronoi = 0; ///< length; 0 where no more than rounding is left of it
  double offset = 0;  ///< of the Voronoi edge's midpoint from the Delaunay edge's
};

/// \param other the triangle across from vertex v of t, and its vertex across from t.
Edge edge_of(const Shapes& shapes, std::int64_t t, int v, std::int64_t other, int w) {
  const double arc = shapes[t].side[static_cast<std::size_t>(v)];
  const double here = shapes[t].delta[static_cast<std::size_t>(v)],
               there = shapes[other].delta[static_cast<std::size_t>(w)];
  const double length = here + there;
  return {arc, length < rounding * arc ? 0 : length, 0.5 * std::abs(here - there)};
}

/// body(part, i) for 0 <= i < n, each block of them on a part of its own; the parts are joined in
/// the order of the blocks, so that sums are the same for any number of threads.
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

Shapes make_shapes(const Mesh& mesh) {
  Shapes shapes(mesh.triangles.cols());
  for_each_block(shapes.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t != end; ++t)
      shapes[t] = shape_of({column(mesh.points, mesh.triangles(0, t)),
                            column(mesh.points, mesh.triangles(1, t)),
                            column(mesh.points, mesh.triangles(2, t))});
  });
  return shapes;
}

struct TrianglePart {
  Tally quality, angles;
  std::int64_t obtuse = 0;

  void join(const TrianglePart& other) {
    quality.join(other.quality);
    angles.join(other.angles);
    obtuse += other.obtuse;
  }
};

void add_triangle(TrianglePart& part, const Shape& shape) {
  const auto& [a, b, c] = shape.side;
  part.quality.add((b + c - a) * (c + a - b) * (a + b - c) / (a * b * c));
  for (const double angle : shape.angle)
    part.angles.add(angle);
  part.obtuse += *std::max_element(shape.angle.begin(), shape.angle.end()) > pi / 2 + rounding;
}

// ---- Edges

struct EdgePart {
  Tally spacing, off_centring;

  void join(const EdgePart& other) {
    spacing.join(other.spacing);
    off_centring.join(other.off_centring);
  }
};

/// Those that triangle t shares with a later one.
void add_edges(EdgePart& part, const Subject& subject, std::int64_t t) {
  const Triangles& neighbours = subject.mesh.neighbours;
  for (int v = 0; v < 3; ++v) {
    const std::int32_t other = neighbours(v, t);
    if (other < t)
      continue;
    const int w = neighbours(0, other) == t ? 0 : neighbours(1, other) == t ? 1 : 2;
    const Edge edge = edge_of(subject.shapes, t, v, other, w);
    part.spacing.add(edge.arc);
    if (edge.voronoi > 0)
      part.off_centring.add(edge.offset / edge.voronoi);
  }
}

// ---- Cells

struct CellPart {
  Tally sigma, quality;
  std::vector<std::int64_t> degrees;

  void count(std::size_t degree, std::int64_t cells) {
    if (degrees.size() <= degree)
      degrees.resize(degree + 1, 0);
    degrees[degree] += cells;
  }
  void join(const CellPart& other) {
    sigma.join(other.sigma);
    quality.join(other.quality);
    for (std::size_t degree = 0; degree < other.degrees.size(); ++degree)
      count(degree, other.degrees[degree]);
  }
};

void add_cell(CellPart& part, const Subject& subject, std::int64_t site) {
  const Stars& stars = subject.stars;
  const std::int64_t begin = stars.begin[site], end = stars.begin[site + 1];
  Tally arcs, voronoi;
  Corner before = stars.corners[end - 1];
  for (std::int64_t s = begin; s != end; ++s) {
    const Corner corner = stars.corners[s];
    const Edge edge =
        edge_of(subject.shapes, triangle_of(corner), previous_vertex(vertex_of(corner)),
                triangle_of(before), next_vertex(vertex_of(before)));
    arcs.add(edge.arc);
    voronoi.add(edge.voronoi);
    before = corner;
  }
  part.sigma.add(arcs.min / arcs.max);
  part.quality.add(voronoi.min / voronoi.max);
  part.count(static_cast<std::size_t>(end - begin), 1);
}

// ---- Moments

struct MomentPart {
  Tally area;
  double energy = 0, squares = 0;
  std::int64_t without_centroid = -1; ///< the first such site

  void join(const MomentPart& other) {
    area.join(other.area);
    energy += other.energy;
    squares += other.squares;
    if (without_centroid < 0)
      without_centroid = other.without_centroid;
  }
};

MomentPart add_moments(const Subject& subject, const Density& density) {
  const Moments uniform = mesh_moments(subject.mesh, Density{});
  Moments of_density;
  if (!density.uniform())
    of_density = mesh_moments(subject.mesh, density);
  const Moments& moments = density.uniform() ? uniform : of_density;
  return join_blocks<MomentPart>(subject.mesh.points.cols(), [&](MomentPart& part, std::int64_t i) {
    const double length = norm(moments.first[i]);
    if (part.without_centroid < 0 && !(length > 0 && std::isfinite(length)))
      part.without_centroid = i;
    const Vec3 apart = (1 / length) * moments.first[i] - column(subject.mesh.points, i);
    part.area.add(uniform.mass[i]);
    part.energy += moments.energy[i];
    part.squares += dot(apart, apart);
  });
}

// ---- The door

Mesh with_unit_columns(Mesh mesh) {
  for_each_block(mesh.points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 unit = normalised(column(mesh.points, i));
      mesh.points.col(i) << unit.x, unit.y, unit.z;
    }
  });
  return mesh;
}

/// \returns the sum of the triangles' areas.
double require_closed_delaunay(const Mesh& mesh) {
  const Check found = check(mesh);
  if (!found.passed())
    throw Error(ErrorCode::bad_option,
                "the mesh is not the Delaunay triangulation of its points, so it has no Voronoi "
                "cells: " +
                    found.failure + "; triangulate the points anew");
  if (found.boundary_edges > 0)
    throw Error(ErrorCode::bad_option,
                "the mesh is open, as all its sites lie in a hemisphere, and its Voronoi cells do "
                "not tessellate the sphere: give sites all around");
  return found.area;
}

Quality measure(const Mesh& mesh, const Density& density) {
  const Subject subject{mesh, make_stars(mesh), make_shapes(mesh)};
  const std::int64_t n = mesh.points.cols(), m = mesh.triangles.cols();
  const auto triangles = join_blocks<TrianglePart>(
      m, [&](TrianglePart& part, std::int64_t t) { add_triangle(part, subject.shapes[t]); });
  const auto edges = join_blocks<EdgePart>(
      m, [&](EdgePart& part, std::int64_t t) { add_edges(part, subject, t); });
  auto cells =
      join_blocks<CellPart>(n, [&](CellPart& part, std::int64_t i) { add_cell(part, subject, i); });
  const MomentPart moments = add_moments(subject, density);
  if (const std::int64_t i = moments.without_centroid; i >= 0)
    throw Error(ErrorCode::bad_option,
                "the density is zero over the whole cell of site " + std::to_string(i) +
                    ": make it positive everywhere",
                i);
  Quality result;
  result.cells = n;
  result.triangles = m;
  result.degrees = std::move(cells.degrees);
  result.spacing = edges.spacing.range();
  result.sigma = cells.sigma.range();
  result.cell_quality = cells.quality.range();
  result.cell_area = moments.area.range();
  result.triangle_quality = triangles.quality.range();
  result.angles = triangles.angles.range(180 / pi);
  result.obtuse = triangles.obtuse;
  result.off_centring = edges.off_centring.range();
  result.residual = std::sqrt(moments.squares / (4 * pi)); // sqrt(squares/n) over sqrt(4 pi/n)
  result.energy = moments.energy;
  result.cells_area = moments.area.sum / (4 * pi);
  return result;
}

} // namespace
} // namespace detail

Quality quality(const Mesh& mesh, const Density& density) {
  evaluate(density, Points3(Eigen::Vector3d::UnitZ())); // says what is wrong with it
  const double triangles_area = detail::require_closed_delaunay(mesh);
  Quality result = detail::measure(detail::with_unit_columns(mesh), density);
  result.triangles_area = triangles_area / (4 * std::numbers::pi);
  return result;
}

} // namespace calotte
