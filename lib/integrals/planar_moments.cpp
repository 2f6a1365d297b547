// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/planar_moments.h"

#include "base/triangle.h"
#include "domain/clipped_cell.h"
#include "exact/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace calotte::integrals_detail {
namespace {

// ---- Triangles with a corner in a site

/// Adds integrals over triangles (x_i, x_i + p, x_i + q) to the moments of sites i, in call order.
class FanSum {
public:
  FanSum(const Integrand& integrand, const Array<Vec3>& x, Array<CellMoments>& moments)
      : integrand_(&integrand), x_(&x), moments_(&moments), nodes_(integrand.nodes.size()) {
    for (std::vector<double>* row : {&place_x_, &place_y_, &place_z_, &rho_})
      row->assign(most * nodes_, 0);
  }

  void add(std::int32_t site, const Vec2& p, const Vec2& q) {
    if (integrand_->uniform) {
      const double area = cross(p, q) / 2;
      const Vec2 first = (area / 3) * (p + q);
      put(site, first, area, area / 6 * (dot(p, p) + dot(p, q) + dot(q, q)));
      return;
    }
    fans_[count_] = {site, p, q};
    const Vec3& at = (*x_)[site];
    for (std::size_t k = 0; k < nodes_; ++k) {
      const Vec2 place = offset(fans_[count_], k);
      place_x_[count_ * nodes_ + k] = at.x + place.x;
      place_y_[count_ * nodes_ + k] = at.y + place.y;
    }
    if (++count_ == most)
      finish();
  }

  /// Must be called before the moments are read.
  void finish() {
    const auto row = [&](std::vector<double>& values) {
      return std::span(values).first(count_ * nodes_);
    };
    if (count_ > 0)
      integrand_->density(row(place_x_), row(place_y_), row(place_z_), row(rho_));
    for (std::size_t f = 0; f < count_; ++f)
      put_fan(fans_[f], f);
    count_ = 0;
  }

private:
  struct Fan {
    std::int32_t site;
    Vec2 p, q;
  };
  static constexpr std::size_t most = 96;

  Vec2 offset(const Fan& fan, std::size_t node) const {
    const QuadratureRule::Node& at = integrand_->nodes[node];
    return at.b * fan.p + at.c * fan.q;
  }

  void put_fan(const Fan& fan, std::size_t f) {
    const double area = cross(fan.p, fan.q) / 2;
    Vec2 first{0, 0};
    double mass = 0, energy = 0;
    for (std::size_t k = 0; k < nodes_; ++k) {
      const Vec2 place = offset(fan, k);
      const double share = integrand_->nodes[k].weight * rho_[f * nodes_ + k];
      first = first + share * place;
      mass += share;
      energy += share * dot(place, place);
    }
    put(fan.site, area * first, area * mass, area * energy);
  }

  void put(std::int32_t site, const Vec2& first, double mass, double energy) {
    CellMoments& cell = (*moments_)[site];
    cell.first = cell.first + Vec3{first.x, first.y, mass};
    cell.energy += energy;
  }

  const Integrand* integrand_;
  const Array<Vec3>* x_;
  Array<CellMoments>* moments_;
  std::size_t nodes_, count_ = 0;
  std::array<Fan, most> fans_{};
  std::vector<double> place_x_, place_y_, place_z_, rho_;
};

/// The treatment of a cell.
enum class CellKind : std::uint8_t {
  none,    ///< none: of another region or the hull
  whole,   ///< inside the domain
  clipped, ///< possibly cut by the domain's boundary
};

// ---- The triangles of a patch

/// A triangle as its first corner a sees it.
struct Shape {
  std::array<Vec2, 3> corner; ///< from a: 0, to b, to c
  Vec2 centre;                ///< from a to the circumcentre
  double twice_area;
};

Shape shape_of(const std::array<std::int32_t, 3>& corners, const Array<Vec3>& x,
               const Plane& plane) {
  const auto from_first = [&](std::size_t v) -> Vec2 {
    const Vec3 way = plane.offset(x[corners[0]], x[corners[v]]);
    return {way.x, way.y};
  };
  const Vec2 u = from_first(1), v = from_first(2);
  return {{Vec2{0, 0}, u, v}, circumcentre(u, v), cross(u, v)};
}

/// True if a triangle is certainly counter-clockwise and acute. Offsets err by up to e = 4u M each,
/// M the largest coordinate, and their products by 2 e times their size.
bool is_clear(const Shape& shape, double largest, const Vec2& period) {
  const auto& [a, b, c] = shape.corner;
  const double half = std::min(period.x, period.y) / 2;
  if (half > 0 && !(dot(shape.centre, shape.centre) < half * half / 4)) // see add_faults()
    return false;
  const auto size = [](const Vec2& v) { return std::abs(v.x) + std::abs(v.y); };
  const double extent = size(b) + size(c), error = 32 * roundoff * (largest + extent) * extent;
  return shape.twice_area > error && dot(b, c) > error && dot(c - b, a - b) > error &&
         dot(a - c, b - c) > error;
}

double largest_coordinate(const Array<Vec3>& x, const Vec2& period) {
  double largest = std::max(period.x, period.y);
  for (const Vec3& place : x)
    largest = std::max({largest, std::abs(place.x), std::abs(place.y)});
  return largest;
}

/// Each site's half kites: from the middle of one side to the circumcentre and on to that of the
/// other.
void add_kites(const std::array<std::int32_t, 3>& corners, const Shape& shape,
               const Array<CellKind>& kinds, FanSum& sum) {
  for (int v = 0; v < 3; ++v) {
    const std::int32_t site = corners[static_cast<std::size_t>(v)];
    if (kinds[site] != CellKind::whole)
      continue;
    const auto at = [&](int i) { return shape.corner[static_cast<std::size_t>(i)]; };
    const Vec2 centre = shape.centre - at(v);
    sum.add(site, 0.5 * (at(next_vertex(v)) - at(v)), centre);
    sum.add(site, centre, 0.5 * (at(previous_vertex(v)) - at(v)));
  }
}

// ---- Cells that the domain clips

/// A cell is clipped where the boundary comes within the radii of the circles around it.
Array<CellKind> kinds_of(const PlanarField& field, const Patch& patch,
                         const std::vector<Shape>& shapes, const Array<Vec3>& x) {
  Array<CellKind> kinds(x.size());
  std::fill(kinds.begin(), kinds.end(), CellKind::none);
  Array<double> reach2(x.size());
  std::fill(reach2.begin(), reach2.end(), 0.0);
  for (std::size_t t = 0; field.outline != nullptr && t < patch.corners.size(); ++t)
    for (const std::int32_t site : patch.corners[t])
      reach2[site] = std::max(reach2[site], dot(shapes[t].centre, shapes[t].centre));
  for (std::int32_t i = 0; i < patch.owned; ++i)
    if (patch.sites[static_cast<std::size_t>(i)] < field.generators) {
      const bool clipped = field.outline != nullptr &&
                           near_boundary(*field.outline, {x[i].x, x[i].y}, std::sqrt(reach2[i]));
      kinds[i] = clipped ? CellKind::clipped : CellKind::whole;
    }
  return kinds;
}

/// One triangle of a star.
struct Wedge {
  std::int32_t next, previous; ///< the other corners, counter-clockwise
  CellCorner corner;           ///< the circumcentre, and the previous one
};

/// \param v the site's index in the triangle.
CellCorner corner_of(const Shape& shape, int v) {
  const Vec2& site = shape.corner[static_cast<std::size_t>(v)];
  return {shape.centre - site, shape.corner[static_cast<std::size_t>(previous_vertex(v))] - site};
}

/// The circumcentres around a site, counter-clockwise from the first wedge's.
std::vector<CellCorner> cell_of(std::vector<Wedge> star) {
  std::vector<CellCorner> cell{star.front().corner};
  for (std::size_t k = 0; k + 1 < star.size(); ++k) {
    const auto following =
        std::find_if(star.begin() + static_cast<std::ptrdiff_t>(k) + 1, star.end(),
                     [&](const Wedge& w) { return w.next == star[k].previous; });
    if (following == star.end())
      break; // the mesh is about to be repaired
    std::swap(star[k + 1], *following);
    cell.push_back(star[k + 1].corner);
  }
  return cell;
}

/// Moves the first moment of a cell whose centroid is outside.
void keep_inside(const Outline& outline, const Vec2& site, const std::vector<CellSide>& sides,
                 CellMoments& cell) {
  const double mass = cell.first.z;
  const Vec2 centroid{cell.first.x / mass, cell.first.y / mass};
  if (!(mass > 0) || outline.side(site + centroid) == Side::inside)
    return;
  const Vec2 inside = nearest_inside(outline, site, sides, centroid).value_or(Vec2{0, 0});
  cell.first = {mass * inside.x, mass * inside.y, mass};
}

void add_clipped(const PlanarField& field, const Patch& patch, const std::vector<Shape>& shapes,
                 const Array<Vec3>& x, const Array<CellKind>& kinds, FanSum& sum,
                 Array<CellMoments>& moments) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(x.size()), -1);
  std::vector<std::int32_t> sites;
  for (std::int32_t i = 0; i < patch.owned; ++i)
    if (kinds[i] == CellKind::clipped) {
      place[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(sites.size());
      sites.push_back(i);
    }
  std::vector<std::vector<Wedge>> stars(sites.size());
  for (std::size_t t = 0; !sites.empty() && t < patch.corners.size(); ++t)
    for (int v = 0; v < 3; ++v) {
      const auto at = [&](int i) { return patch.corners[t][static_cast<std::size_t>(i)]; };
      if (const std::int32_t k = place[static_cast<std::size_t>(at(v))]; k >= 0)
        stars[static_cast<std::size_t>(k)].push_back(
            {at(next_vertex(v)), at(previous_vertex(v)), corner_of(shapes[t], v)});
    }
  for (std::size_t k = 0; k < sites.size(); ++k) {
    const std::int32_t i = sites[k];
    const Vec2 site{x[i].x, x[i].y};
    const std::vector<CellSide> sides =
        clipped_cell(*field.outline, site, cell_of(std::move(stars[k])));
    for (const CellSide& side : sides)
      sum.add(i, side.p, side.q);
    sum.finish();
    keep_inside(*field.outline, site, sides, moments[i]);
  }
}

std::vector<Shape> shapes_of(const PlanarField& field, const Patch& patch, const Array<Vec3>& x) {
  std::vector<Shape> shapes(patch.corners.size());
  for (std::size_t t = 0; t < shapes.size(); ++t)
    shapes[t] = shape_of(patch.corners[t], x, field.plane);
  return shapes;
}

void add_suspects(const std::vector<Shape>& shapes, double largest, const Vec2& period,
                  std::vector<std::int32_t>& suspects) {
  for (std::size_t t = 0; t < shapes.size(); ++t)
    if (!is_clear(shapes[t], largest, period))
      suspects.push_back(static_cast<std::int32_t>(t));
}

} // namespace

void integrate(const Integrand& integrand, const PlanarField& field, const Patch& patch,
               const Array<Vec3>& x, Array<CellMoments>& moments,
               std::vector<std::int32_t>& suspects) {
  const std::vector<Shape> shapes = shapes_of(field, patch, x);
  add_suspects(shapes, largest_coordinate(x, field.plane.period()), field.plane.period(), suspects);
  const Array<CellKind> kinds = kinds_of(field, patch, shapes, x);
  std::fill(moments.begin(), moments.end(), CellMoments{{0, 0, 0}, 0});
  FanSum sum(integrand, x, moments);
  for (std::size_t t = 0; t < shapes.size(); ++t)
    add_kites(patch.corners[t], shapes[t], kinds, sum);
  sum.finish();
  if (field.outline != nullptr)
    add_clipped(field, patch, shapes, x, kinds, sum, moments);
}

void find_suspects(const PlanarField& field, const Patch& patch, const Array<Vec3>& x,
                   std::vector<std::int32_t>& suspects) {
  add_suspects(shapes_of(field, patch, x), largest_coordinate(x, field.plane.period()),
               field.plane.period(), suspects);
}

} // namespace calotte::integrals_detail
