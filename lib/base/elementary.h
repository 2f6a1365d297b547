// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_loops.h"

#include <bit>
#include <cmath>
#include <cstdint>

/// Elementary functions as fixed sequences of + - * / and sqrt, without branches: the compiler
/// turns loops over them into vector code, and every machine and vector width gives the same bits.
namespace calotte::base_detail {

/// asin(x) for |x| <= 1, to 2 units in the last place: the rational approximation of asin(s)/s - 1
/// on s^2 <= 1/4 (Sun Microsystems, fdlibm, 1993) and asin(x) = pi/2 - 2 asin(sqrt((1-x)/2))
/// beyond.
CALOTTE_INLINE double arc_sine(double x) {
  const double magnitude = std::abs(x);
  const bool beyond = magnitude > 0.5;
  const double z = beyond ? 0.5 * (1 - magnitude) : x * x;
  const double s = beyond ? std::sqrt(z) : magnitude;
  const double p =
      z * (1.66666666666666657415e-01 +
           z * (-3.25565818622400915405e-01 +
                z * (2.01212532134862925881e-01 +
                     z * (-4.00555345006794114027e-02 +
                          z * (7.91534994289814532176e-04 + z * 3.47933107596021167570e-05)))));
  const double q =
      1 + z * (-2.40339491173441421878e+00 +
               z * (2.02094576023350569471e+00 +
                    z * (-6.88283971605453293030e-01 + z * 7.70381505559019352791e-02)));
  const double small = s + s * (p / q);
  return std::copysign(beyond ? 1.57079632679489661923 - 2 * small : small, x);
}

/// asin(s)/s - 1 for s^2 = w, 0 <= w <= 1/2: w r(w), r the minimax rational function of degrees 5
/// and 5 (error 5e-16). Pairs of terms are summed first: the shorter chains of operations overlap.
CALOTTE_INLINE double arc_sine_excess(double w) {
  const double w2 = w * w, w4 = w2 * w2;
  const double p = (1.6666666666666710591e-01 + w * -4.0650049149064120382e-01) +
                   w2 * (3.4709210999334143028e-01 + w * -1.2021426044832278859e-01) +
                   w4 * (1.3912251074160607350e-02 + w * -1.0755358390271482850e-04);
  const double q = (1 + w * -2.8890029489429388604e+00) +
                   w2 * (3.1147468440742365545e+00 + w * -1.5313732323671677577e+00) +
                   w4 * (3.3069246457023822769e-01 + w * -2.3377158029900356191e-02);
  return w * (p / q);
}

/// asin(sqrt(w)) for 0 <= w <= 1/2, to 2 units in the last place, with one root and one division.
CALOTTE_INLINE double arc_sine_of_root(double w) {
  const double s = std::sqrt(w);
  return s + s * arc_sine_excess(w);
}

/// The arc of a chord on the unit sphere, 2 asin(sqrt(square)/2), for 0 <= square <= 2: the bits of
/// 2 arc_sine_of_root(square / 4), as powers of two scale without rounding.
/// \param square of the chord.
CALOTTE_INLINE double arc_of_chord(double square) {
  const double chord = std::sqrt(square);
  return chord + chord * arc_sine_excess(0.25 * square);
}

/// atan(x) for |x| <= 1; loses digits for larger |x|.
CALOTTE_INLINE double arc_tangent(double x) { return arc_sine(x / std::sqrt(1 + x * x)); }

/// 1/(1 + 2^t), to 4 units in the last place; t is clamped to 1000 in size. With t = k + r, |r| <=
/// 1/2, and tanh(r ln(2)/2) = odd/even, 2^t is 2^k (even + odd)/(even - odd): one division serves
/// the power and the quotient. odd and even are a minimax approximation (error 6e-18).
CALOTTE_INLINE double logistic(double t) {
  constexpr double range = 1000;
  constexpr double shifter =
      0x1.8p52; // adding it rounds to an integer, which stands in the last bits
  t = t < -range ? -range : t;
  t = t > range ? range : t;
  const double shifted = t + shifter, r = t - (shifted - shifter), r2 = r * r;
  const double odd =
      r * (0.34657359027997264 + r2 * (0.004624841170852369 + r2 * 5.287083987433538e-06));
  const double even = 1 + r2 * (0.05338222200402479 + r2 * 0.00022893359916127378);
  const double down = even - odd;
  const auto exponent = std::bit_cast<std::uint64_t>(shifted) << 52;
  const double power = std::bit_cast<double>(std::bit_cast<std::uint64_t>(even + odd) + exponent);
  return down / (down + power);
}

} // namespace calotte::base_detail
