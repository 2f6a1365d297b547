// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace calotte::base_detail {

/// An unevaluated sum hi + lo of two doubles, |lo| <= ulp(hi)/2: about 106 bits.
///
/// Barring underflow, the relative errors of sums and products are at most 4 v^2 and 8 v^2, v =
/// 2^-53 (Joldes, Muller, Popescu: Tight and rigorous error bounds for basic building blocks of
/// double-word arithmetic, ACM Trans. Math. Softw. 44, 2017, algorithms 6 and 10, rounded up). The
/// code uses only + - *, so that every machine gives the same bits.
struct DoubleDouble {
  double hi = 0, lo = 0;
};

inline DoubleDouble quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

inline DoubleDouble two_sum(double a, double b) {
  const double s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// Dekker's product (1971) with Veltkamp's splitting: a*b without error for |a|, |b| < 2^995.
inline DoubleDouble two_product(double a, double b) {
  constexpr double splitter = 0x1p27 + 1;
  const double p = a * b;
  const double ta = splitter * a, tb = splitter * b;
  const double ah = ta - (ta - a), al = a - ah, bh = tb - (tb - b), bl = b - bh;
  return {p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

inline DoubleDouble operator-(const DoubleDouble& a) { return {-a.hi, -a.lo}; }

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble s = two_sum(a.hi, b.hi), t = two_sum(a.lo, b.lo);
  const DoubleDouble v = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(v.hi, t.lo + v.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + -b; }

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// 1/sqrt(a) for a from 1e-30 to 1e30: one Newton step from the double result, relative error below
/// 2^-102.
inline DoubleDouble inverse_sqrt(const DoubleDouble& a) {
  const double y = 1 / std::sqrt(a.hi);
  const DoubleDouble residual = DoubleDouble{1, 0} - a * two_product(y, y);
  return DoubleDouble{y, 0} + DoubleDouble{0.5 * y, 0} * residual;
}

} // namespace calotte::base_detail
