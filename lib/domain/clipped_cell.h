// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/outline.h"
#include "domain/room.h"

#include <cmath>
#include <optional>
#include <vector>

namespace calotte::domain_detail {

inline Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(double s, const Vec2& a) { return {s * a.x, s * a.y}; }
inline double dot(const Vec2& a, const Vec2& b) { return a.x * b.x + a.y * b.y; }
inline double cross(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }
inline double norm(const Vec2& a) { return std::sqrt(dot(a, a)); }

/// A corner of a Voronoi cell, and the generator across the side from this corner to the next,
/// counter-clockwise; both relative to the cell's generator.
struct CellCorner {
  Vec2 point, beyond;
};

/// The functions below take the boundary as an Outline, or as a TangentOutline with the site 0.

/// True if the domain's boundary, by the boxes of its edges, comes within `reach` of a site. If it
/// does not come as near as the farthest corner of a cell, the cell lies inside the domain.
bool near_boundary(const Outline& outline, const Vec2& site, double reach);
bool near_boundary(const Outline& outline, const Vec2& site, const std::vector<CellCorner>& cell);

/// The part of a convex polygon where normal.x <= offset.
/// \param beyond the generator across the new side, or 0.
std::vector<CellCorner> cut_by_line(const std::vector<CellCorner>& polygon, const Vec2& normal,
                                    double offset, const Vec2& beyond = {0, 0});

/// The part of a convex polygon that is on the cell's side of the bisector with another generator.
std::vector<CellCorner> cut_by_bisector(const std::vector<CellCorner>& polygon, const Vec2& beyond);

/// A side of the part of a cell in the domain, which lies to the left of the direction from p to q.
struct CellSide {
  Vec2 p, q;     ///< seen from the cell's generator
  bool boundary; ///< on the domain's boundary
};

/// The sides of the intersection of a domain and a Voronoi cell, in any order.
/// \param cell corners of the whole cell, counter-clockwise, relative to the generator at `site`.
template <class AnyOutline>
std::vector<CellSide> clipped_cell(const AnyOutline& outline, const Vec2& site,
                                   std::vector<CellCorner> cell);

/// The parts of a cell's side, from a corner to the next, inside the domain.
std::vector<CellSide> parts_inside(const Outline& outline, const Vec2& site,
                                   const CellCorner& corner, const Vec2& to);

/// The nearest point inside the domain to a point outside, relative to the generator. It is moved
/// inside by a billionth of the distance from the generator. Only the boundary within the cell
/// counts. None if no point inside is found.
template <class AnyOutline>
std::optional<Vec2> nearest_inside(const AnyOutline& outline, const Vec2& site,
                                   const std::vector<CellSide>& sides, const Vec2& outside);

/// The same, for the whole boundary that is no farther from the point than the generator is.
template <class AnyOutline>
std::optional<Vec2> nearest_inside(const AnyOutline& outline, const Vec2& site,
                                   const Vec2& outside);

} // namespace calotte::domain_detail
