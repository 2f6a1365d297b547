// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/region_cells.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "density/demanded_spacing.h"
#include "domain/clipped_cell.h"
#include "domain/tangent_outline.h"
#include "integrals/region_moments.h"

#include <calotte/generators.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace calotte::cvt_detail {
namespace {

/// The directions of a hull.
Points3 far_hull(const SphericalOutline& outline) {
  constexpr int level = 1; // 42 directions
  constexpr double distance = 0.5;
  const Points3 directions = bisected_icosahedron(level);
  std::vector<Eigen::Index> far;
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    bool near = outline.side(column(directions, i)) != Side::outside;
    outline.for_each_edge_near(column(directions, i), distance,
                               [&](const SphericalOutline::Edge&) { near = true; });
    if (!near)
      far.push_back(i);
  }
  return directions(Eigen::all, far);
}

/// Places outside the boundary, at some spacings from it, and at half of that from each other.
class Row {
public:
  /// \param spacings distance from the boundary.
  Row(const SphericalOutline& outline, const DemandedSpacing& demand, double spacings)
      : outline_(outline), demand_(demand), spacings_(spacings) {}

  std::vector<Vec3> places() {
    const auto& edges = outline_.edges();
    std::size_t ring = 0; // its first edge
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Vec3 left = left_of(edges[e]);
      walk(edges[e], left);
      const bool last = e + 1 == edges.size() || !same(edges[e].to, edges[e + 1].from);
      add_corner(edges[e].to, left, left_of(edges[last ? ring : e + 1]));
      ring = last ? e + 1 : ring;
    }
    return std::move(places_);
  }

private:
  static constexpr double farthest = 0.4; ///< radians; beyond, the far hull suffices

  static bool same(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
  static Vec3 left_of(const SphericalOutline::Edge& edge) {
    const Vec3 left = cross(edge.from, edge.to);
    return (1 / norm(left)) * left;
  }

  /// Fills the gap at a convex corner.
  void add_corner(const Vec3& x, const Vec3& before, const Vec3& after) {
    constexpr double slight = 0.88; // cosine of half a radian
    if (dot(before, after) < slight)
      add(x, before + after);
  }

  void walk(const SphericalOutline::Edge& edge, const Vec3& left) {
    const Vec3 along = cross(left, edge.from);
    const double length = 2 * std::asin(std::min(1.0, norm(edge.to - edge.from) / 2));
    double at = next_ - since_;
    for (; at < length; at += next_) {
      const Vec3 x = std::cos(at) * edge.from + std::sin(at) * along;
      next_ = std::min(spacings_ / 2 * demand_.at(x), farthest);
      add(x, left);
      since_ = -at;
    }
    since_ += length;
  }

  void add(const Vec3& x, const Vec3& left) {
    const double distance = spacings_ * demand_.at(x);
    if (!(distance < farthest))
      return;
    const Vec3 place = std::cos(distance) * x - (std::sin(distance) / norm(left)) * left;
    bool near = outline_.side(place) != Side::outside;
    outline_.for_each_edge_near((1 / norm(place)) * place, 0.7 * distance,
                                [&](const SphericalOutline::Edge&) { near = true; });
    if (!near)
      places_.push_back((1 / norm(place)) * place);
  }

  const SphericalOutline& outline_;
  const DemandedSpacing& demand_;
  double spacings_;
  double since_ = 0, next_ = 0;
  std::vector<Vec3> places_;
};

} // namespace

Points3 hull_of(const SphericalOutline& outline, const Density& density, std::int64_t generators) {
  constexpr double nearest = 4; // spacings
  const DemandedSpacing demand(outline, density, static_cast<double>(generators));
  std::vector<Vec3> places;
  std::vector<Vec3> row = Row(outline, demand, nearest).places();
  for (double spacings = 2 * nearest; !row.empty(); spacings *= 2) {
    places.insert(places.end(), row.begin(), row.end());
    row = Row(outline, demand, spacings).places();
  }
  const Points3 far = far_hull(outline);
  Points3 hull(3, far.cols() + std::ssize(places));
  hull.leftCols(far.cols()) = far;
  for (std::size_t k = 0; k < places.size(); ++k)
    set_column(hull, far.cols() + static_cast<Eigen::Index>(k), places[k]);
  return hull;
}

RegionCells::RegionCells(std::shared_ptr<const SphericalOutline> outline, Boundary boundary)
    : outline_(std::move(outline)), boundary_(boundary), hull_(far_hull(*outline_)) {}

RegionCells::RegionCells(std::shared_ptr<const SphericalOutline> outline, Boundary boundary,
                         const Density& density, const Points3& start)
    : outline_(std::move(outline)), boundary_(boundary),
      hull_(hull_of(*outline_, density, start.cols())) {
  do
    move(start);
  while (drop_intruders());
}

/// Removes the places of rows whose cells meet the region. False if there are none.
bool RegionCells::drop_intruders() {
  const Connectivity mesh = signs().triangulate();
  std::vector<std::vector<Vec3>> neighbours(static_cast<std::size_t>(hull_.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (const std::int64_t k = mesh.triangles(v, t) - generators_; k >= 0)
        neighbours[static_cast<std::size_t>(k)].push_back(place(mesh.triangles(next_vertex(v), t)));
  const std::int64_t directions = far_hull(*outline_).cols();
  std::vector<std::uint8_t> stays(neighbours.size(), 1);
  for_each_block(hull_.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = std::max(begin, directions); k < end; ++k)
      stays[static_cast<std::size_t>(k)] =
          clipped_area(*outline_, column(hull_, k), neighbours[static_cast<std::size_t>(k)]) == 0;
  });
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < hull_.cols(); ++k)
    if (stays[static_cast<std::size_t>(k)] != 0)
      kept.push_back(k);
  if (std::ssize(kept) == hull_.cols())
    return false;
  hull_ = Points3(hull_(Eigen::all, kept));
  return true;
}

void RegionCells::move(const Points3& points) {
  generators_ = points.cols();
  places_.resize(3, generators_ + hull_.cols());
  for_each_block(generators_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    places_.middleCols(begin, end - begin) = points.middleCols(begin, end - begin);
  });
  places_.rightCols(hull_.cols()) = hull_;
}

Sites RegionCells::sites() const {
  return make_sites(Points3(places_.leftCols(generators_)), Duplicates::merge, 0);
}

double RegionCells::spacing() const {
  return std::sqrt(outline_->area() / static_cast<double>(generators_));
}

bool RegionCells::has_centre(std::int32_t a, std::int32_t b, std::int32_t c) const {
  const Vec3 centre = boundary_ == Boundary::clip ? cross(place(b) - place(a), place(c) - place(a))
                                                  : place(a) + place(b) + place(c);
  return outline_->side(centre) != Side::outside;
}

void RegionCells::integrate(const Integrand& integrand, const Patch& patch, const Array<Vec3>& x,
                            Array<CellMoments>& moments,
                            std::vector<std::int32_t>& suspects) const {
  integrals_detail::integrate(integrand, {outline_.get(), generators_}, patch, x, moments,
                              suspects);
}

void RegionCells::retract(const Points3& x, double step, const Points3& d, Points3& to) const {
  SphericalCells::retract(x, step, d, to);
  for_each_block(x.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      if (outline_->side(column(to, i)) == Side::inside)
        continue;
      const TangentPlane plane(column(x, i));
      const TangentOutline boundary(*outline_, plane);
      const Vec2 there = plane.projected(column(to, i));
      const Vec3 inside =
          plane.lifted(nearest_inside(boundary, Vec2{0, 0}, there).value_or(Vec2{0, 0}));
      set_column(to, i, (1 / norm(inside)) * inside);
    }
  });
}

Laplacian RegionCells::laplacian(const Connectivity& mesh, const Density& density) const {
  return graph_laplacian(places_, generators_, outline_->area(), mesh, density);
}

} // namespace calotte::cvt_detail
