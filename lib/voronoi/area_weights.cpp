// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/area_weights.h>

#include "base/array.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/triangle.h"
#include "domain/clipped_cell.h"
#include "domain/tangent_outline.h"
#include "mesh/faces.h"
#include "mesh/stars.h"
#include "voronoi/dual_measures.h"
#include "voronoi/geometry.h"
#include "voronoi/stages.h"

#include <calotte/delaunay.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace calotte {
namespace voronoi_detail {
namespace {

using namespace dual;
using domain_detail::cut_by_bisector;
using domain_detail::cut_by_line;
using domain_detail::TangentPlane;
using domain_detail::Vec2;

// ---- Discs
//
// A disc of radius r has the height 1 - cos(r), in a plane r^2/2: its area over 2 pi. From its
// centre, a side's bisector meets the circle at the angle A from the side's middle, if the side is
// shorter than 2 r.

/// Discs on the sphere, by squares of chords.
struct SphereDiscs {
  /// Where bisectors of a site are straight.
  struct Tangent {
    TangentPlane plane;

    explicit Tangent(const Vec3& site) : plane(site) {}
    /// The point whose bisector with 0 is that of another site.
    Vec2 mirrored(const Vec3& way) const { return plane.mirrored(plane.at() + way); }
  };

  static double height_of_chord(double square) { return square / 2; }
  /// \param square of the sine of the radius, which is at most pi/2.
  static double height_of_circle(double square) {
    const double most = std::min(square, 1.0);
    return most / (1 + std::sqrt(1 - most));
  }
  /// cos(A) = tan(s/2) cot(r) of a side s: more than 1 if the bisector does not meet the disc.
  static double cosine(double side, double height) {
    return std::sqrt(side / (4 - side) / (height * (2 - height))) * (1 - height);
  }
  /// The area between the side's half, its bisector and the ray at the angle A.
  static double half_area(double side, double cosine) {
    const double half = std::sqrt(side) / 2, tangent = half * tangent_of(cosine); // of the bisector
    return 2 * angle_of((1 + std::sqrt(1 - half * half)) * (1 + std::sqrt(1 + tangent * tangent)),
                        half * tangent);
  }
  /// The tangent of the radius.
  static double tangent(double height) { return std::sqrt(height * (2 - height)) / (1 - height); }
  static Vec3 tangential(const Vec3& x, const Vec3& way) { return way - dot(way, x) * x; }
  /// The area of the triangle of a disc's centre and two points of the tangent plane there.
  static double fan_area(const Vec2& a, const Vec2& b) {
    const double to_a = std::sqrt(1 + dot(a, a)), to_b = std::sqrt(1 + dot(b, b));
    return 2 * angle_of(to_a * to_b + to_a + to_b + 1 + dot(a, b), cross(a, b));
  }
  static double tangent_of(double cosine) {
    return std::sqrt((1 - cosine) * (1 + cosine)) / cosine;
  }
};

/// Discs in a plane.
struct PlaneDiscs {
  struct Tangent {
    explicit Tangent(const Vec3&) {}
    Vec2 mirrored(const Vec3& way) const { return {way.x, way.y}; }
  };

  static double height_of_chord(double square) { return square / 2; }
  static double height_of_circle(double square) { return square / 2; }
  static double cosine(double side, double height) { return std::sqrt(side / (8 * height)); }
  static double half_area(double side, double cosine) {
    return side / 8 * SphereDiscs::tangent_of(cosine);
  }
  static double tangent(double height) { return std::sqrt(2 * height); } ///< the radius
  static Vec3 tangential(const Vec3&, const Vec3& way) { return way; }
  static double fan_area(const Vec2& a, const Vec2& b) { return cross(a, b) / 2; }
};

double arc_cosine(double x) { return angle_of(x, std::sqrt((1 - x) * (1 + x))); }

// ---- Areas of cells

/// The areas of the cells of a mesh that may be open, in closed form.
template <class Discs, class Measures> class CellAreas {
public:
  CellAreas(const Mesh& mesh, const Points3& cells, const Array<double>& surplus,
            const Measures& measures)
      : mesh_(mesh), cells_(cells), surplus_(surplus), measures_(measures) {}

  /// The sums of kites.
  Array<double> whole() const {
    constexpr std::int64_t part = std::int64_t{1} << 20;
    Array<double> areas(cells_.cols());
    std::fill(areas.data(), areas.data() + areas.size(), 0.0);
    const std::int64_t count = mesh_.triangles.cols();
    std::vector<HalfKites> halves(static_cast<std::size_t>(std::min(part, count)));
    for (std::int64_t first = 0; first < count; first += part) {
      const std::int64_t size = std::min(part, count - first);
      for_each_block(size, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        measure_half_kites(mesh_.surface, cells_, surplus_, mesh_.triangles, first + begin,
                           first + end, halves.data() + begin);
      });
      for (std::int64_t t = 0; t < size; ++t)
        for (int v = 0; v < 3; ++v)
          areas[mesh_.triangles(v, first + t)] += kite(halves[static_cast<std::size_t>(t)], v);
    }
    return areas;
  }

  /// Cells at the edge as EdgeCells::neighbours bounds them.
  Array<double> within_neighbours(double gap) const {
    const Array<double> circles = circle_heights();
    const Marks open = open_triangles(circles, gap);
    std::vector<std::uint8_t> at_edge(static_cast<std::size_t>(cells_.cols()));
    for_each_slot([&](std::int64_t t, int v) {
      if (mesh_.neighbours(previous_vertex(v), t) < 0 || mesh_.neighbours(next_vertex(v), t) < 0 ||
          open[static_cast<std::size_t>(t)] != 0)
        at_edge[static_cast<std::size_t>(mesh_.triangles(v, t))] = 1;
    });
    Array<double> areas = whole();
    const mesh_detail::Stars stars(mesh_detail::faces_of(mesh_));
    for_each_block(areas.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::int32_t>(begin); i != end; ++i)
        if (at_edge[static_cast<std::size_t>(i)] != 0)
          areas[i] = area_at_edge(stars, circles, open, i);
    });
    return areas;
  }

  /// The parts of cells in discs of a height.
  Array<double> within_discs(double height) const {
    Array<double> areas(cells_.cols());
    const Array<double> circles = circle_heights();
    const mesh_detail::Stars stars(mesh_detail::faces_of(mesh_));
    for_each_block(areas.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::int32_t>(begin); i != end; ++i)
        areas[i] = area_within(stars, circles, i, height);
    });
    return areas;
  }

private:
  using Corner = mesh_detail::Corner;
  using Marks = std::vector<std::uint8_t>;
  using Polygon = std::vector<domain_detail::CellCorner>;

  template <class Body> void for_each_slot(const Body& body) const {
    for (std::int64_t t = 0; t < mesh_.triangles.cols(); ++t)
      for (int v = 0; v < 3; ++v)
        body(t, v);
  }

  static double kite(const HalfKites& halves, int vertex) {
    return halves[static_cast<std::size_t>(next_vertex(vertex))].area +
           halves[static_cast<std::size_t>(previous_vertex(vertex))].area;
  }

  /// The way from one vertex of a triangle to another.
  Vec3 way(std::int64_t t, int from, int to) const {
    return measures_.difference(cells_, mesh_.triangles(from, t), mesh_.triangles(to, t));
  }

  /// Of the triangles' circumcircles.
  Array<double> circle_heights() const {
    Array<double> heights(mesh_.triangles.cols());
    for_each_block(heights.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t t = begin; t != end; ++t) {
        const Vec3 a = way(t, 0, 1), b = way(t, 0, 2);
        const double product = square(a) * square(b) * square(way(t, 1, 2)) / 4;
        heights[t] = Discs::height_of_circle(product / square(cross(a, b)));
      }
    });
    return heights;
  }

  /// Marks the triangles whose circumcircle is large for each of their sites.
  Marks open_triangles(const Array<double>& circles, double gap) const {
    std::vector<double> least(static_cast<std::size_t>(cells_.cols()),
                              std::numeric_limits<double>::infinity());
    for_each_slot([&](std::int64_t t, int v) {
      double& height = least[static_cast<std::size_t>(mesh_.triangles(v, t))];
      height = std::min(height, circles[t]);
    });
    std::vector<double> bounds(static_cast<std::size_t>(mesh_.triangles.cols()));
    for_each_slot([&](std::int64_t t, int v) {
      double& bound = bounds[static_cast<std::size_t>(t)];
      bound = std::max(bound, least[static_cast<std::size_t>(mesh_.triangles(v, t))]);
    });
    Marks open;
    for (std::int64_t t = 0; t < mesh_.triangles.cols(); ++t)
      open.push_back(circles[t] > gap * gap * bounds[static_cast<std::size_t>(t)]);
    return open;
  }

  // ---- Cells that their neighbours bound, in the tangent plane of their site

  double area_at_edge(const mesh_detail::Stars& stars, const Array<double>& circles,
                      const Marks& open, std::int32_t site) const {
    const typename Discs::Tangent plane(column(cells_, site));
    struct Sector {
      Vec2 from, to; ///< the sites that bound it, mirrored
      bool open;
    };
    std::vector<Sector> sectors;
    double reach = 0; // of corners inside
    const bool closed = stars.for_each_corner(site, [&](Corner at) {
      const bool is_open = open[static_cast<std::size_t>(at.triangle)] != 0;
      sectors.push_back({plane.mirrored(side(at, next_vertex(at.vertex))),
                         plane.mirrored(side(at, previous_vertex(at.vertex))), is_open});
      if (!is_open)
        reach = std::max(reach, Discs::tangent(circles[at.triangle]));
    });
    Vec2 farthest{0, 0};
    for (const Sector& sector : sectors)
      for (const Vec2& beyond : {sector.from, sector.to})
        if (!sector.open && dot(beyond, beyond) > dot(farthest, farthest))
          farthest = beyond;
    Polygon inner = square_of({2 * reach, 0}), outer = square_of(0.5 * farthest);
    for (const Sector& sector : sectors)
      for (const Vec2& beyond : {sector.from, sector.to}) {
        inner = cut_by_bisector(inner, beyond);
        outer = cut_by_bisector(outer, beyond);
        if (!sector.open)
          outer = cut_by_bisector(outer, -1.0 * beyond);
      }
    double area = 0;
    for (const Sector& sector : sectors)
      area += area_between(sector.open ? outer : inner, sector.from, sector.to);
    if (closed)
      return area;
    const Vec2 from = direction(sectors.back().to), to = direction(sectors.front().from),
               middle = turned(from) - turned(to) - from - to;
    return area + area_between(outer, from, middle) + area_between(outer, middle, to);
  }

  static Vec2 direction(const Vec2& a) { return (1 / norm(a)) * a; }
  static Vec2 turned(const Vec2& a) { return {-a.y, a.x}; } ///< by a quarter, counter-clockwise

  /// A square around 0, with the middle of a side.
  static Polygon square_of(const Vec2& middle) {
    Polygon square;
    Vec2 side = middle;
    for (int k = 0; k < 4; ++k) {
      const Vec2 next = turned(side);
      square.push_back({side + next, 2 * next});
      side = next;
    }
    return square;
  }

  /// The area of a polygon between two rays, of an angle of less than pi, counter-clockwise.
  static double area_between(const Polygon& polygon, const Vec2& from, const Vec2& to) {
    const Polygon part = cut_by_line(cut_by_line(polygon, -1.0 * turned(from), 0), turned(to), 0);
    double area = 0;
    for (std::size_t k = 0; k < part.size(); ++k)
      area += Discs::fan_area(part[k].point, part[k + 1 == part.size() ? 0 : k + 1].point);
    return area;
  }

  // ---- Cells in discs

  double area_within(const mesh_detail::Stars& stars, const Array<double>& circles,
                     std::int32_t site, double height) const {
    double area = 0, angle = 0;
    Corner first = mesh_detail::no_corner, last = first;
    const bool closed = stars.for_each_corner(site, [&](Corner at) {
      area += kite_within(at, circles[at.triangle], height);
      angle += angle_at(at);
      first = exists(first) ? first : at;
      last = at;
    });
    if (closed)
      return area;
    const double gap = pi - angle / 2; // of one of the two sides at the boundary
    return area + half_within(square(side(first, next_vertex(first.vertex))), gap, height) +
           half_within(square(side(last, previous_vertex(last.vertex))), gap, height);
  }

  Vec3 side(Corner at, int to) const { return way(at.triangle, at.vertex, to); }

  double angle_at(Corner at) const {
    const Vec3& x = column(cells_, mesh_.triangles(at.vertex, at.triangle));
    const Vec3 next = Discs::tangential(x, side(at, next_vertex(at.vertex))),
               before = Discs::tangential(x, side(at, previous_vertex(at.vertex)));
    return angle_of(dot(next, before), std::sqrt(square(cross(next, before))));
  }

  double kite_within(Corner at, double circle, double height) const {
    HalfKites halves;
    measure_half_kites(mesh_.surface, cells_, surplus_, mesh_.triangles, at.triangle,
                       at.triangle + 1, &halves);
    if (circle <= height) // the whole kite is in the disc
      return kite(halves, at.vertex);
    double area = 0;
    for (const int to : {next_vertex(at.vertex), previous_vertex(at.vertex)}) {
      const double length = square(side(at, to));
      const double arc = halves[static_cast<std::size_t>(3 - at.vertex - to)].arc;
      const double angle = arc_cosine(std::min(1.0, Discs::cosine(length, circle)));
      area += std::copysign(half_within(length, angle, height), arc);
    }
    return area;
  }

  /// The part in a disc of a half kite whose corner is outside.
  /// \param length square of the side. \param angle from the side to the ray to the corner.
  static double half_within(double length, double angle, double height) {
    const double cosine = Discs::cosine(length, height);
    if (cosine >= 1)
      return angle * height;
    return Discs::half_area(length, cosine) + (angle - arc_cosine(cosine)) * height;
  }

  const Mesh& mesh_;
  const Points3& cells_;
  const Array<double>& surplus_;
  const Measures& measures_;
};

Array<double> areas_of(const Mesh& mesh, EdgeCells edge, const AreaWeightOptions& options) {
  const Points3 cells = checked_centres(mesh);
  const Array<double> surplus = surplus_of(mesh.surface, cells);
  const auto compute = [&]<class Discs>(const auto& measures, const Discs&, double reach) {
    const CellAreas<Discs, std::remove_cvref_t<decltype(measures)>> areas(mesh, cells, surplus,
                                                                          measures);
    return edge == EdgeCells::neighbours ? areas.within_neighbours(options.gap)
           : edge == EdgeCells::reach    ? areas.within_discs(reach)
                                         : areas.whole();
  };
  if (mesh.surface.is_sphere()) {
    const double sine = std::sin(options.reach / 2);
    return compute(SphereMeasures{surplus}, SphereDiscs(), 2 * sine * sine);
  }
  const Eigen::Vector2d& period = mesh.surface.period();
  return compute(PlaneMeasures{period[0], period[1]}, PlaneDiscs(),
                 options.reach * options.reach / 2);
}

/// The areas of cells that rings bound, or that reach round the far side of the sphere.
Array<double> areas_of_tessellation(const Mesh& mesh) {
  const DoubleVector areas = voronoi(mesh).cell_area;
  Array<double> out(areas.size());
  std::copy(areas.begin(), areas.end(), out.data());
  return out;
}

/// The mesh in the surface that its convex boundary bounds.
Mesh within_hull(Mesh mesh) {
  const Eigen::Index rows = mesh.surface.is_sphere() ? 3 : 2;
  const IdLists loops = boundary_loops(mesh);
  Surface::Rings rings;
  for (std::int64_t k = 0; k < loops.size(); ++k)
    rings.emplace_back(mesh.points(Eigen::all, loops[k]).topRows(rows));
  mesh.surface = mesh.surface.within(rings);
  return mesh;
}

void require_options(const Surface& surface, const AreaWeightOptions& options) {
  require(!surface.is_bounded() || !options.edge,
          "the surface has rings, which bound the cells; leave the edge out");
  require(options.gap >= 1 && std::isfinite(options.gap), "the gap is {}; give 1 or more",
          options.gap);
  require(options.edge != EdgeCells::hull || surface.period().isZero() || surface.is_box(),
          "a channel has two boundaries, and points along them no hull; let the cells end at their "
          "neighbours or at a reach");
  if (options.edge != EdgeCells::reach)
    return;
  require(options.reach > 0 && std::isfinite(options.reach),
          "the reach of cells is {}; give a positive number", options.reach);
  require(!surface.is_sphere() || options.reach <= pi / 2,
          "the reach of cells is {}; give an angle of at most pi/2", options.reach);
}

} // namespace
} // namespace voronoi_detail

DoubleVector area_weights(const PointsRef& points, const Surface& surface,
                          const AreaWeightOptions& options) {
  using namespace voronoi_detail;
  require_options(surface, options);
  const Mesh mesh = triangulate(points, surface, {.merge_within = options.merge_within}).mesh;
  const bool closed = mesh.closed();
  const EdgeCells edge = options.edge.value_or(
      closed || surface.is_bounded() ? EdgeCells::whole : EdgeCells::neighbours);
  require(closed || edge != EdgeCells::whole || surface.is_sphere() || surface.is_bounded(),
          "cells at the hull of points in a plane are unbounded; let them end at the hull, at "
          "their neighbours or at a reach");
  const Array<double> areas =
      surface.is_bounded() || (edge == EdgeCells::whole && !closed) ? areas_of_tessellation(mesh)
      : edge == EdgeCells::hull && !closed ? areas_of_tessellation(within_hull(mesh))
                                           : areas_of(mesh, edge, options);
  std::vector<std::int32_t> copies(static_cast<std::size_t>(areas.size()));
  for (const std::int32_t site : mesh.site_of_input)
    ++copies[static_cast<std::size_t>(site)];
  DoubleVector weights(points.cols());
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    const std::int32_t site = mesh.site_of_input[static_cast<std::size_t>(i)];
    // A rounded area may be negative, where the points' distances differ by many powers of ten.
    weights[i] = std::max(0.0, areas[site]) / copies[static_cast<std::size_t>(site)];
    if (!std::isfinite(areas[site]))
      base_detail::refuse_at(i, "point {} has neighbours so near that their areas are no numbers; "
                                "merge them (merge_within)");
  }
  return weights;
}

} // namespace calotte
