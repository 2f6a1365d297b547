// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/predicates.h"

#include "base/double_double.h"
#include "exact/vec3_of.h"

#include <gmpxx.h>

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#if defined(__FAST_MATH__) || (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0)
#error                                                                                             \
    "the predicates' error bounds hold for IEEE doubles evaluated as written: no -ffast-math, no x87"
#endif

namespace calotte::exact_detail {
namespace {

int sign_of(double x) { return (x > 0) - (x < 0); }

// ---- Tier 2

using Vec3Extended = Vec3Of<DoubleDouble>;

/// x/|x| within 2^-100 in the norm of the error: the norm errs by 2^-102.5, its inverse by 2^-102,
/// the products by 2^-103; components that underflow in scaling add 1e-307.
Vec3Extended normalised_extended(const Vec3& given) {
  const double rough = dot(given, given);
  const bool moderate = rough > 1e-30 && rough < 1e30; // no product of it underflows or overflows
  const Vec3 x = moderate ? given : scaled_to_one(given);
  const DoubleDouble square = two_product(x.x, x.x) + two_product(x.y, x.y) + two_product(x.z, x.z);
  const DoubleDouble scale = inverse_sqrt(square);
  return {scale * DoubleDouble{x.x, 0}, scale * DoubleDouble{x.y, 0}, scale * DoubleDouble{x.z, 0}};
}

double squared_reach(const Vec3Extended& a) {
  return a.x.hi * a.x.hi + a.y.hi * a.y.hi + a.z.hi * a.z.hi;
}

// Tier 2 where unit vectors are not differences: three of them err by 3 2^-100 in their
// determinant, the evaluation by some 40 v^2 sqrt(3) < 2^-99.8; less than 2^-98 together.
int orientation_extended(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double value =
      dot(normalised_extended(a), cross(normalised_extended(b), normalised_extended(c))).hi;
  constexpr double error = 0x1p-97;
  return (value > error) - (value < -error);
}

// The difference of unit vectors, |b - a| = D <= 2, errs by 2^-99, p by 2^-100, which adds 2^-100
// D, and the evaluation by less than 40 v^2 sqrt(3) D < 2^-98.8; less than 2^-97 together.
int compare_distances_extended(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double value =
      dot(normalised_extended(p), normalised_extended(b) - normalised_extended(a)).hi;
  constexpr double error = 0x1p-96;
  return (value > error) - (value < -error);
}

// ---- Tier 3

/// Integer coordinates proportional to a direction.
struct Vec3Integer {
  mpz_class x, y, z;
};

/// Sets an integer to x 2^shift, which must be an integer.
void set_scaled(mpz_class& out, double x, int shift) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  mpz_set_d(out.get_mpz_t(), std::ldexp(mantissa, 53));
  const int up = exponent - 53 + shift;
  if (up >= 0)
    mpz_mul_2exp(out.get_mpz_t(), out.get_mpz_t(), static_cast<mp_bitcnt_t>(up));
  else
    mpz_tdiv_q_2exp(out.get_mpz_t(), out.get_mpz_t(), static_cast<mp_bitcnt_t>(-up));
}

void set_integers(Vec3Integer& out, const Vec3& given) {
  int lowest = std::numeric_limits<int>::max();
  for (const double x : {given.x, given.y, given.z}) {
    if (x == 0)
      continue;
    int exponent = 0;
    std::frexp(x, &exponent);
    lowest = std::min(lowest, exponent - 53);
  }
  set_scaled(out.x, given.x, -lowest);
  set_scaled(out.y, given.y, -lowest);
  set_scaled(out.z, given.z, -lowest);
}

mpz_class squared_norm(const Vec3Integer& a) { return a.x * a.x + a.y * a.y + a.z * a.z; }

mpz_class determinant(const Vec3Integer& a, const Vec3Integer& b, const Vec3Integer& c) {
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
         a.z * (b.x * c.y - b.y * c.x);
}

/// A signed square root: factor sqrt(radicand), radicand >= 0.
struct Root {
  mpz_class factor, radicand;
};

int sign_of_sum(const Root& p, const Root& q) {
  const int sp = sgn(p.factor) * sgn(p.radicand), sq = sgn(q.factor) * sgn(q.radicand);
  if (sp == 0 || sq == 0 || sp == sq)
    return sp != 0 ? sp : sq;
  const mpz_class difference = p.factor * p.factor * p.radicand - q.factor * q.factor * q.radicand;
  return sp * sgn(difference);
}

/// Sign of whole + p + q: if whole opposes p + q, the function compares the squares, whose
/// difference has one root, sqrt(p.radicand q.radicand).
int sign_of_sum(const mpz_class& whole, const Root& p, const Root& q) {
  const int roots = sign_of_sum(p, q);
  if (roots == 0 || sgn(whole) == 0 || roots == sgn(whole))
    return roots != 0 ? roots : sgn(whole);
  const Root rational{
      p.factor * p.factor * p.radicand + q.factor * q.factor * q.radicand - whole * whole, 1};
  const Root mixed{2 * p.factor * q.factor, p.radicand * q.radicand};
  return roots * sign_of_sum(rational, mixed);
}

/// Sign of p + q + r + s, likewise: (p + q)^2 - (r + s)^2 has two roots.
int sign_of_sum(const Root& p, const Root& q, const Root& r, const Root& s) {
  const int left = sign_of_sum(p, q), right = sign_of_sum(r, s);
  if (left == 0 || right == 0 || left == right)
    return left != 0 ? left : right;
  const mpz_class whole = p.factor * p.factor * p.radicand + q.factor * q.factor * q.radicand -
                          r.factor * r.factor * r.radicand - s.factor * s.factor * s.radicand;
  const Root pq{2 * p.factor * q.factor, p.radicand * q.radicand};
  const Root rs{-2 * r.factor * s.factor, r.radicand * s.radicand};
  return left * sign_of_sum(whole, pq, rs);
}

/// Adds roots of equal radicand, which lattices have often, and sums the remaining terms.
int sign_of_sum(std::array<Root, 4>& roots) {
  for (std::size_t i = 1; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (roots[i].radicand == roots[j].radicand) {
        roots[j].factor += roots[i].factor;
        roots[i].factor = 0;
        break;
      }
  return sign_of_sum(roots[0], roots[1], roots[2], roots[3]);
}

int orientation_exact(const Vec3& a, const Vec3& b, const Vec3& c) {
  thread_local Vec3Integer ia, ib, ic; // keep their limbs
  set_integers(ia, a);
  set_integers(ib, b);
  set_integers(ic, c);
  return sgn(determinant(ia, ib, ic));
}

/// Sign of a/sqrt(aa) - b/sqrt(bb), for positive aa, bb.
int compare_quotients(const mpz_class& a, const mpz_class& aa, const mpz_class& b,
                      const mpz_class& bb) {
  if (sgn(a) != sgn(b))
    return sgn(a) > sgn(b) ? 1 : -1;
  const mpz_class difference = a * a * bb - b * b * aa;
  return sgn(a) * sgn(difference);
}

int compare_directions_exact(const Vec3& a, const Vec3& b) {
  Vec3Integer ia, ib;
  set_integers(ia, a);
  set_integers(ib, b);
  const mpz_class aa = squared_norm(ia), bb = squared_norm(ib);
  if (const int s = compare_quotients(ia.x, aa, ib.x, bb))
    return s;
  if (const int s = compare_quotients(ia.y, aa, ib.y, bb))
    return s;
  return compare_quotients(ia.z, aa, ib.z, bb);
}

/// Sign of p.b/|b| - p.a/|a|.
int compare_distances_exact(const Vec3& p, const Vec3& a, const Vec3& b) {
  thread_local Vec3Integer ip, ia, ib; // keep their limbs
  set_integers(ip, p);
  set_integers(ia, a);
  set_integers(ib, b);
  const auto product = [&](const Vec3Integer& x) -> mpz_class {
    return ip.x * x.x + ip.y * x.y + ip.z * x.z;
  };
  return compare_quotients(product(ib), squared_norm(ib), product(ia), squared_norm(ia));
}

} // namespace

Vec3 scaled_to_one(const Vec3& x) {
  int exponent = 0;
  std::frexp(std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}), &exponent);
  return {std::ldexp(x.x, -exponent), std::ldexp(x.y, -exponent), std::ldexp(x.z, -exponent)};
}

// Tier 2's bound: each difference errs by 2^-99 and 3 v^2 D for its sums, the evaluation by some 40
// v^2 times sqrt(3) D^3: 3 D^2 (2^-99 + 2^-104 D) + 2^-99.8 D^3 < 2^-96 D^2 for D <= 2, with a
// factor of 2 to spare for the rounding of D itself.
int in_circle_extended(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3Extended origin = normalised_extended(d);
  const Vec3Extended p = normalised_extended(a) - origin, q = normalised_extended(b) - origin,
                     r = normalised_extended(c) - origin;
  const double value = dot(p, cross(r, q)).hi;
  const double error = 0x1p-95 * std::max({squared_reach(p), squared_reach(q), squared_reach(r)});
  return (value > error) - (value < -error);
}

int in_circle_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  thread_local Vec3Integer ia, ib, ic, id; // keep their limbs: allocation would dominate
  set_integers(ia, a);
  set_integers(ib, b);
  set_integers(ic, c);
  set_integers(id, d);
  std::array<Root, 4> roots{Root{determinant(ib, ic, id), squared_norm(ia)},
                            Root{-determinant(ia, ic, id), squared_norm(ib)},
                            Root{determinant(ia, ib, id), squared_norm(ic)},
                            Root{-determinant(ia, ib, ic), squared_norm(id)}};
  return sign_of_sum(roots);
}

int in_circle_beyond_filter(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                            PredicateCounts& counts) {
  ++counts.filtered;
  if (const int sign = in_circle_extended(a, b, c, d))
    return sign;
  ++counts.exact;
  return in_circle_exact(a, b, c, d);
}

int in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (const int sign = in_circle_filter(normalised(a), normalised(b), normalised(c), normalised(d)))
    return sign;
  PredicateCounts uncounted;
  return in_circle_beyond_filter(a, b, c, d, uncounted);
}

int orientation(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (const int sign = orientation_filter(normalised(a), normalised(b), normalised(c)))
    return sign;
  if (const int sign = orientation_extended(a, b, c))
    return sign;
  return orientation_exact(a, b, c);
}

int compare_directions(const Vec3& a, const Vec3& b) {
  constexpr double error = 11 * roundoff; // 5 for each component and 1 for the subtraction
  const Vec3 p = normalised(a), q = normalised(b);
  if (const double x = p.x - q.x; std::abs(x) > error)
    return sign_of(x);
  return compare_directions_exact(a, b);
}

// p.(b - a) of unit vectors good to 5 roundoffs u, |b - a| = D: the difference errs by 10u + uD, p
// by 5u, the product by 6 sqrt(3) u D / 2 at most: (10 + 11.2 D) u.
int compare_distances(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 apart = normalised(b) - normalised(a);
  const double value = dot(normalised(p), apart), error = (11 + 13 * norm(apart)) * roundoff;
  if (std::abs(value) > error)
    return sign_of(value);
  if (const int sign = compare_distances_extended(p, a, b))
    return sign;
  return compare_distances_exact(p, a, b);
}

bool same_direction(const Vec3& a, const Vec3& b) {
  if (a.x == b.x && a.y == b.y && a.z == b.z)
    return true;
  const Vec3 p = normalised(a) - normalised(b);
  if (dot(p, p) > 0x1p-98)
    return false; // 12 roundoffs apart: 5 for each and some for the rest
  return compare_directions_exact(a, b) == 0;
}

int orientation(const View& view, const Vec3& a, const Vec3& b, const Vec3& c) {
  return view.from_centre ? orientation(a, b, c) : -in_circle(a, b, c, view.focus);
}

// Seen from a focus f, a line of the view is a circle through f, and p lies between a and b when p
// and f are on different sides of the chord ab, hence of any plane through a, b and a point g off
// the circle's plane. From the centre it is a great circle, and the arcs ap, pb must run the same
// way as ab.
bool between(const View& view, const Vec3& a, const Vec3& p, const Vec3& b) {
  constexpr std::array<Vec3, 4> tetrahedron{
      Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}}; // no plane contains all four
  for (const Vec3& g : tetrahedron) {
    if (view.from_centre) {
      const int way = orientation(a, b, g);
      if (way != 0)
        return orientation(a, p, g) == way && orientation(p, b, g) == way;
    } else {
      const int focus_side = in_circle(a, b, g, view.focus);
      if (focus_side != 0)
        return in_circle(a, b, g, p) == -focus_side;
    }
  }
  assert(false && "a, b and the view's point are distinct");
  return false;
}

int in_circle_tie(const View& view, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<int, 4> order{0, 1, 2, 3};
  const std::array<const Vec3*, 4> sites{&a, &b, &c, &d};
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return compare_directions(*sites[static_cast<std::size_t>(i)],
                              *sites[static_cast<std::size_t>(j)]) < 0;
  });
  for (const int pushed : order) {
    // Pushing d outward raises it over the plane of a, b, c counter-clockwise and increases the
    // determinant; exchanging another pushed site with d changes the sign.
    const int sign = pushed == 0   ? -orientation(view, d, b, c)
                     : pushed == 1 ? -orientation(view, a, d, c)
                     : pushed == 2 ? -orientation(view, a, b, d)
                                   : orientation(view, a, b, c);
    if (sign != 0)
      return sign;
  }
  return 0;
}

} // namespace calotte::exact_detail
