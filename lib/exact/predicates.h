// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "exact/room.h"

#include <algorithm>
#include <cstdint>

/// The exact signs on which every topological decision on the sphere rests.
///
/// A site is a direction: each sign is that of the points x/|x| exactly on the unit sphere, for any
/// norms and any rounding of the stored doubles. Three tiers decide it: doubles with a derived
/// bound, about 106 bits with a derived bound, then integers and square roots without error.
///
/// Laws: in_circle and orientation are antisymmetric under exchange of two arguments and do not
/// change if an argument is multiplied by a positive number.
namespace calotte::exact_detail {

/// The number of decisions that each tier passed to the next.
struct PredicateCounts {
  std::int64_t filtered = 0; ///< undecided in doubles
  std::int64_t exact = 0;    ///< undecided in 106 bits
};

/// The same direction with its largest component in [1/2, 1): exact, except for components below
/// 1e-307.
Vec3 scaled_to_one(const Vec3& x);

/// x/|x| to 5 units of roundoff (2^-53) in the norm of the error, for norms from 1e-200 to 1e200.
inline Vec3 normalised(const Vec3& x) {
  const double square = dot(x, x);
  if (square > 1e-200 && square < 1e200) [[likely]]
    return (1 / std::sqrt(square)) * x;
  const Vec3 scaled = scaled_to_one(x);
  return (1 / norm(scaled)) * scaled;
}

// ---- Signs of directions of any norm, by all tiers. The values are -1, 0 or 1.

/// Positive when d is inside the circumcap of a, b, c counter-clockwise seen from outside: the sign
/// of |a| det(b,c,d) - |b| det(a,c,d) + |c| det(a,b,d) - |d| det(a,b,c), which is orient3d of the
/// normalised points.
int in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of det(a, b, c): positive when a, b, c run counter-clockwise seen from outside.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c);

/// The order of directions by the exact (x, y, z) of x/|x|, lexicographically: -1 when a comes
/// first.
int compare_directions(const Vec3& a, const Vec3& b);

/// The order of directions by their exact distance from p: -1 when a is nearer than b, 0 when
/// neither is.
int compare_distances(const Vec3& p, const Vec3& a, const Vec3& b);

/// True if a is a positive multiple of b.
bool same_direction(const Vec3& a, const Vec3& b);

// ---- Views: the points from which the sphere is projected.

/// Either the sphere's centre, or a focus on the sphere for a stereographic projection. From both,
/// the image of a Delaunay triangulation is a planar triangulation.
struct View {
  bool from_centre = true;
  Vec3 focus{0, 0, 0}; ///< a direction; no effect from the centre
};

/// Orientation of a, b, c in that view, counter-clockwise as seen from outside the sphere: from the
/// centre the sign of det(a,b,c), from a focus f the sign of -in_circle(a,b,c,f).
int orientation(const View& view, const Vec3& a, const Vec3& b, const Vec3& c);

/// For p on the line through a and b in that view (orientation 0): true if it lies strictly between
/// them.
bool between(const View& view, const Vec3& a, const Vec3& p, const Vec3& b);

/// The sign of in_circle where that is exactly 0, for four distinct directions.
///
/// Site i is pushed outward by eps_i along its ray from the view's point, eps larger for the site
/// that comes first in compare_directions. To first order in eps_p the determinant changes by the
/// orientation of the other three; the first that is not 0 decides. 0 only when all four lie on one
/// line of the view.
int in_circle_tie(const View& view, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// in_circle with ties resolved: never 0 for four distinct sites not all on one line of the view.
inline int in_circle_resolved(const View& view, const Vec3& a, const Vec3& b, const Vec3& c,
                              const Vec3& d) {
  const int sign = in_circle(a, b, c, d);
  return sign != 0 ? sign : in_circle_tie(view, a, b, c, d);
}

// ---- The tiers, for the triangulation's inner loop and for the tests.

inline constexpr double roundoff = 0x1p-53;

/// A bound on the error of the in-circle determinant in doubles, the triple product of the
/// differences from any one of the four unit vectors, good to 5 roundoffs each, when the
/// differences' norms are at most `reach` <= 2.
///
/// Let u be the roundoff, D the reach. A stored unit vector is within 5u of the true one, so a
/// difference is within 10u + uD of the true difference (the last for the subtraction). A
/// determinant of three vectors of norm at most D changes by at most 3 D^2 (10u + uD) to first
/// order; evaluating it from rounded entries errs by at most 6u sum |a_i| |b||c| <= 6 sqrt(3) u
/// D^3. Together (30 + 13.4 D) u D^2. The bound lets nothing be decided unless D > 42u, for no
/// determinant exceeds D^3; there the second and third order add at most 7.1u + 0.6u times D^2, and
/// what the constants leave beyond that covers this bound's own rounding.
constexpr double in_circle_error(double reach) {
  return (42 + 15 * reach) * roundoff * reach * reach;
}

/// Tier 1 on unit vectors good to 5 roundoffs: the sign, or 0 when the doubles cannot decide.
inline int in_circle_filter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 p = a - d, q = b - d, r = c - d;
  const double reach = std::sqrt(std::max({dot(p, p), dot(q, q), dot(r, r)}));
  const double value = dot(p, cross(r, q)), error = in_circle_error(reach);
  return (value > error) - (value < -error);
}

/// Tier 1 of the orientation from the centre, on unit vectors good to 5 roundoffs: the sign or 0.
///
/// det(a,b,c) = det(a, b-a, c-a). With D the larger norm of the differences, each within 10u + uD,
/// a within 5u: 2 D (10u + uD) + 5u D^2 + 6 sqrt(3) u D^2 <= (20 + 17.4 D) u D, and 3.9u D of
/// second order where D > 26u, without which nothing is decided.
inline int orientation_filter(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 p = b - a, q = c - a;
  const double reach = std::sqrt(std::max(dot(p, p), dot(q, q)));
  const double value = dot(a, cross(p, q)), error = (26 + 19 * reach) * roundoff * reach;
  return (value > error) - (value < -error);
}

/// Tier 2 on directions of any norm: the sign, or 0 when 106 bits cannot decide.
int in_circle_extended(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Tier 3 on directions of any norm: the sign.
int in_circle_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Tiers 2 and 3 with counts.
int in_circle_beyond_filter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                            PredicateCounts& counts);

} // namespace calotte::exact_detail
