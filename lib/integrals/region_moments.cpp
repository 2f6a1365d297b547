// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/region_moments.h"

#include "base/spherical_angles.h"
#include "base/triangle.h"
#include "domain/clipped_cell.h"
#include "domain/tangent_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace calotte::integrals_detail {
namespace {

/// An angle from -pi to pi, from its sine and cosine times one positive number.
double angle_of(double sine, double cosine) { return longitude_of(cosine, sine); }

// ---- A cell in the plane that touches the sphere at its site

/// The Voronoi cell, cut to a square.
std::vector<CellCorner> tangent_cell(const TangentPlane& plane,
                                     const std::vector<Vec3>& neighbours) {
  constexpr double r = TangentOutline::reach;
  std::vector<CellCorner> cell{{{-r, -r}, {}}, {{r, -r}, {}}, {{r, r}, {}}, {{-r, r}, {}}};
  for (const Vec3& neighbour : neighbours) {
    const Vec2 along = plane.along(neighbour);
    if (dot(along, along) > 1e-20) // the bisector with an opposite site is farther than the square
      cell = cut_by_bisector(cell, plane.mirrored(neighbour));
  }
  return cell;
}

/// The area of the spherical triangle with a corner in the site (Oosterom and Strackee, 1983). The
/// form of triangle_area() for corners that are known by their places in the tangent plane, which
/// the bits of every CVT of a region follow from.
double area_of(const CellSide& side) {
  const double np = std::sqrt(1 + dot(side.p, side.p)), nq = std::sqrt(1 + dot(side.q, side.q));
  return 2 * angle_of(cross(side.p, side.q), 1 + dot(side.p, side.q) + np + nq + np * nq);
}

/// A vector by its components along the tangents and the site.
struct Local {
  Vec2 along{0, 0};
  double height = 0;
};

/// Half of an arc's length times its normal. The sum over a closed line is the integral of y.
Local arc_moment(const CellSide& side) {
  const Vec2 across{side.p.y - side.q.y, side.q.x - side.p.x};
  const double height = cross(side.p, side.q);
  const double length = std::sqrt(dot(across, across) + height * height);
  if (!(length > 0))
    return {};
  const double share = 0.5 * angle_of(length, 1 + dot(side.p, side.q)) / length;
  return {share * across, share * height};
}

// ---- Its moments

struct CellSums {
  Local first;       ///< integral of rho y
  double energy = 0; ///< integral of rho |y - x_i|^2
};

/// The integral over triangles with a corner in the site, by a rule.
class TangentRule {
public:
  TangentRule(const Integrand& integrand, const TangentPlane& plane)
      : integrand_(&integrand), plane_(&plane),
        nodes_(integrand.uniform ? uniform_nodes() : integrand.nodes) {}

  CellSums operator()(const std::vector<CellSide>& sides) const {
    const std::vector<double> rho = densities(sides);
    CellSums sums;
    std::size_t next = 0;
    for (const CellSide& side : sides) {
      const double area = cross(side.p, side.q) / 2;
      for (const QuadratureRule::Node& node : nodes_)
        add(place(side, node), area * node.weight * rho[next++], sums);
    }
    return sums;
  }

private:
  static Vec2 place(const CellSide& side, const QuadratureRule::Node& node) {
    return node.b * side.p + node.c * side.q;
  }

  /// \param share of the plane's area, times rho; on the sphere it is (1 + u^2)^(3/2) times less.
  static void add(const Vec2& u, double share, CellSums& sums) {
    const double square = dot(u, u), root = std::sqrt(1 + square);
    const double part = share / ((1 + square) * (1 + square));
    sums.first.along = sums.first.along + part * u;
    sums.first.height += part;
    sums.energy += part * 2 * square / (root + 1); // |y - x|^2 = 2 (1 - 1/root)
  }

  std::vector<double> densities(const std::vector<CellSide>& sides) const {
    const std::size_t count = sides.size() * nodes_.size();
    std::vector<double> rho(count, 1);
    if (integrand_->uniform)
      return rho;
    std::vector<double> x, y, z;
    for (const CellSide& side : sides)
      for (const QuadratureRule::Node& node : nodes_) {
        const Vec3 there = plane_->lifted(place(side, node)), unit = (1 / norm(there)) * there;
        x.push_back(unit.x);
        y.push_back(unit.y);
        z.push_back(unit.z);
      }
    integrand_->density(x, y, z, rho);
    return rho;
  }

  const Integrand* integrand_;
  const TangentPlane* plane_;
  std::span<const QuadratureRule::Node> nodes_;
};

/// Moves the centroid of a cell to the region.
void keep_inside(const TangentOutline& boundary, const std::vector<CellSide>& sides, Local& first) {
  const Vec2 centroid = (1 / first.height) * first.along;
  if (!(first.height > 0) || boundary.side(centroid) == Side::inside)
    return;
  const Vec2 inside = nearest_inside(boundary, {0, 0}, sides, centroid).value_or(Vec2{0, 0});
  first.along = first.height * inside;
}

CellMoments clipped_moments(const Integrand& integrand, const SphericalOutline& outline,
                            const Vec3& site, const std::vector<Vec3>& neighbours) {
  const TangentPlane plane(site);
  const TangentOutline boundary(outline, plane);
  const std::vector<CellSide> sides =
      clipped_cell(boundary, Vec2{0, 0}, tangent_cell(plane, neighbours));
  CellSums sums = TangentRule(integrand, plane)(sides);
  if (integrand.uniform) {
    sums.first = {};
    for (const CellSide& side : sides) {
      const Local arc = arc_moment(side);
      sums.first = {sums.first.along + arc.along, sums.first.height + arc.height};
    }
  }
  keep_inside(boundary, sides, sums.first);
  return {sums.first.height * site + plane.tangent(sums.first.along), sums.energy};
}

// ---- The cells of a patch

/// The largest distance of a site's circumcentres, an angle, by local number.
std::vector<double> reaches(const Patch& patch, const Array<Vec3>& x) {
  std::vector<double> reach(static_cast<std::size_t>(patch.owned), 0);
  for (const std::array<std::int32_t, 3>& t : patch.corners) {
    const Vec3 normal = cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    const Vec3 apart = (1 / norm(normal)) * normal - x[t[0]];
    const double square = dot(apart, apart);
    for (const std::int32_t site : t)
      if (site < patch.owned)
        reach[static_cast<std::size_t>(site)] =
            std::max(reach[static_cast<std::size_t>(site)], square);
  }
  for (double& chord : reach)
    chord = 2 * std::asin(std::min(std::sqrt(chord) / 2, 1.0));
  return reach;
}

/// The patch's own generators whose cells the boundary may clip, by local number.
std::vector<std::int32_t> clipped_sites(const RegionField& field, const Patch& patch,
                                        const Array<Vec3>& x) {
  const std::vector<double> reach = reaches(patch, x);
  std::vector<std::int32_t> sites;
  for (std::int32_t i = 0; i < patch.owned; ++i) {
    if (patch.sites[static_cast<std::size_t>(i)] >= field.generators)
      continue;
    bool near = false;
    const double far = 1.000001 * reach[static_cast<std::size_t>(i)];
    field.outline->for_each_edge_near(x[i], far,
                                      [&](const SphericalOutline::Edge&) { near = true; });
    if (near)
      sites.push_back(i);
  }
  return sites;
}

/// The neighbours of some sites of a patch, each once, in the order of the patch's triangles.
std::vector<std::vector<Vec3>> neighbours_of(const std::vector<std::int32_t>& sites,
                                             const Patch& patch, const Array<Vec3>& x) {
  std::vector<std::int32_t> place(static_cast<std::size_t>(x.size()), -1);
  for (std::size_t k = 0; k < sites.size(); ++k)
    place[static_cast<std::size_t>(sites[k])] = static_cast<std::int32_t>(k);
  std::vector<std::vector<Vec3>> neighbours(sites.size());
  for (const std::array<std::int32_t, 3>& t : patch.corners)
    for (int v = 0; v < 3; ++v)
      if (const std::int32_t k = place[static_cast<std::size_t>(t[static_cast<std::size_t>(v)])];
          k >= 0) // each neighbour is once the next corner
        neighbours[static_cast<std::size_t>(k)].push_back(
            x[t[static_cast<std::size_t>(next_vertex(v))]]);
  return neighbours;
}

} // namespace

void integrate(const Integrand& integrand, const RegionField& field, const Patch& patch,
               const Array<Vec3>& x, Array<CellMoments>& moments,
               std::vector<std::int32_t>& suspects) {
  integrate(integrand, patch, x, moments, nullptr, suspects);
  const std::vector<std::int32_t> sites = clipped_sites(field, patch, x);
  const std::vector<std::vector<Vec3>> neighbours = neighbours_of(sites, patch, x);
  for (std::size_t k = 0; k < sites.size(); ++k)
    moments[sites[k]] = clipped_moments(integrand, *field.outline, x[sites[k]], neighbours[k]);
}

double clipped_area(const SphericalOutline& outline, const Vec3& site,
                    const std::vector<Vec3>& neighbours) {
  const TangentPlane plane(site);
  double area = 0;
  for (const CellSide& side :
       clipped_cell(TangentOutline(outline, plane), Vec2{0, 0}, tangent_cell(plane, neighbours)))
    area += area_of(side);
  return area;
}

} // namespace calotte::integrals_detail
