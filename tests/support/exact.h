// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "exact/predicates.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>

/// A second implementation of the predicates, without error and independent of
/// lib/exact/predicates.cpp; slow, for the tests only. Directions become integer vectors; the signs
/// of sums of square roots come from integer square roots with enough digits, by a proven bound.
namespace calotte::exact {

using base_detail::Vec3;
using exact_detail::View;

struct Integers {
  mpz_class x, y, z;
};

/// The primitive integer vector of a direction.
inline Integers integers(const Vec3& a) {
  mpq_class x(a.x), y(a.y), z(a.z);
  mpz_class multiple = lcm(lcm(x.get_den(), y.get_den()), z.get_den());
  Integers out{mpz_class(x * multiple), mpz_class(y * multiple), mpz_class(z * multiple)};
  const mpz_class common = gcd(gcd(out.x, out.y), out.z);
  return {out.x / common, out.y / common, out.z / common};
}

inline mpz_class square(const Integers& a) { return a.x * a.x + a.y * a.y + a.z * a.z; }

inline mpz_class det(const Integers& a, const Integers& b, const Integers& c) {
  return a.x * b.y * c.z + a.y * b.z * c.x + a.z * b.x * c.y - a.z * b.y * c.x - a.y * b.x * c.z -
         a.x * b.z * c.y;
}

/// The sign of sum_i signs_i sqrt(radicands_i), four integers.
///
/// The sum is an algebraic integer of degree at most 16; unless it is 0, the product of its
/// conjugates is an integer other than 0. None of them exceeds M = 4 sqrt(largest radicand), so the
/// sum is 0 or at least M^-15. Each floor(2^p sqrt) errs by less than 1, their sum by less than 4.
inline int sign_of_roots(const std::array<int, 4>& signs,
                         const std::array<mpz_class, 4>& radicands) {
  std::size_t bits = 1;
  for (const mpz_class& radicand : radicands)
    bits = std::max(bits, mpz_sizeinbase(radicand.get_mpz_t(), 2));
  const std::size_t enough = 15 * (2 + (bits + 1) / 2) + 4;
  for (std::size_t p = 64;; p *= 2) {
    p = std::min(p, enough);
    mpz_class sum = 0;
    for (int i = 0; i < 4; ++i) {
      const mpz_class scaled = radicands[i] << (2 * p);
      sum += signs[i] * sqrt(scaled);
    }
    if (abs(sum) >= 4)
      return sgn(sum);
    if (p == enough)
      return 0;
  }
}

/// The sign of det(a-d, b-d, c-d) of the normalised points, negated.
inline int in_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const std::array<Integers, 4> p{integers(a), integers(b), integers(c), integers(d)};
  const std::array<mpz_class, 4> dets{det(p[1], p[2], p[3]), -det(p[0], p[2], p[3]),
                                      det(p[0], p[1], p[3]), -det(p[0], p[1], p[2])};
  std::array<int, 4> signs{};
  std::array<mpz_class, 4> radicands;
  for (int i = 0; i < 4; ++i) {
    signs[i] = sgn(dets[i]);
    radicands[i] = dets[i] * dets[i] * square(p[i]);
  }
  return sign_of_roots(signs, radicands);
}

inline int orientation(const Vec3& a, const Vec3& b, const Vec3& c) {
  return sgn(det(integers(a), integers(b), integers(c)));
}

inline int orientation(const View& view, const Vec3& a, const Vec3& b, const Vec3& c) {
  return view.from_centre ? exact::orientation(a, b, c) : -exact::in_circle(a, b, c, view.focus);
}

/// The sign of p.b/|b| - p.a/|a|: -1 if b is farther from p than a.
inline int compare_distances(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Integers at = integers(p), first = integers(a), second = integers(b);
  const auto product = [&](const Integers& q) -> mpz_class {
    return at.x * q.x + at.y * q.y + at.z * q.z;
  };
  const mpz_class pa = product(first), pb = product(second);
  return sign_of_roots({sgn(pb), -sgn(pa), 0, 0},
                       {pb * pb * square(first), pa * pa * square(second), 0, 0});
}

inline bool same_direction(const Vec3& a, const Vec3& b) {
  const Integers p = integers(a), q = integers(b);
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

/// The lexicographic order of x/|x|, by the signed squares of its components, which are rational.
inline int compare_directions(const Vec3& a, const Vec3& b) {
  const Integers p = integers(a), q = integers(b);
  const mpz_class pp = square(p), qq = square(q);
  const auto compare = [&](const mpz_class& s, const mpz_class& t) {
    const mpz_class left = sgn(s) * s * s * qq, right = sgn(t) * t * t * pp;
    return cmp(left, right);
  };
  for (const int sign : {compare(p.x, q.x), compare(p.y, q.y), compare(p.z, q.z)})
    if (sign != 0)
      return sign < 0 ? -1 : 1;
  return 0;
}

/// The tie rule: the push of site i along its ray from the view's point changes the determinant by
/// the orientation of the others; the push of the lexicographically smallest site dominates.
inline int in_circle_tie(const View& view, const Vec3& a, const Vec3& b, const Vec3& c,
                         const Vec3& d) {
  const std::array<Vec3, 4> p{a, b, c, d};
  std::array<int, 4> order{0, 1, 2, 3};
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return exact::compare_directions(p[i], p[j]) < 0; });
  for (const int i : order) {
    std::array<Vec3, 3> others{};
    for (int j = 0, k = 0; j < 4; ++j)
      if (j != i)
        others[k++] = p[j];
    const int sign = exact::orientation(view, others[0], others[1], others[2]);
    if (sign != 0)
      return i % 2 == 0 ? -sign : sign;
  }
  return 0;
}

inline int in_circle_resolved(const View& view, const Vec3& a, const Vec3& b, const Vec3& c,
                              const Vec3& d) {
  const int sign = exact::in_circle(a, b, c, d);
  return sign != 0 ? sign : exact::in_circle_tie(view, a, b, c, d);
}

} // namespace calotte::exact
