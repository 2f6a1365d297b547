// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

/// Elementary functions as fixed sequences of + - * / and sqrt, without branches: the compiler
/// turns loops over them into vector code, and every machine and vector width gives the same bits.
namespace calotte::detail {

/// Compiled for several vector widths, of which the widest that the machine has is chosen when the
/// program starts. Not under sanitizers, whose runtime is not ready by then.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&             \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define CALOTTE_VECTOR_WIDTHS __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define CALOTTE_VECTOR_WIDTHS
#endif

/// A call would end the vector code of the loop around it.
#ifdef __GNUC__
#define CALOTTE_INLINE inline __attribute__((always_inline))
#else
#define CALOTTE_INLINE inline
#endif

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

/// atan(x) for |x| <= 1; beyond, it loses digits.
CALOTTE_INLINE double arc_tangent(double x) { return arc_sine(x / std::sqrt(1 + x * x)); }

/// exp(x) for |x| <= 700, to 2 units in the last place; beyond, that of the nearest bound.
CALOTTE_INLINE double exponential(double x) {
  constexpr double log2_e = 1.4426950408889634, ln2_high = 6.93147180369123816490e-01,
                   ln2_low = 1.90821492927058770002e-10;
  constexpr double shifter =
      0x1.8p52; // adding it rounds to an integer, which stands in the last bits
  x = x < -700 ? -700 : x;
  x = x > 700 ? 700 : x;
  const double shifted = x * log2_e + shifter, k = shifted - shifter;
  const double r = (x - k * ln2_high) - k * ln2_low; // |r| <= ln(2)/2: 13 terms of Taylor's series
  const double sum =
      1 +
      r * (1 +
           r * (1 / 2.0 +
                r * (1 / 6.0 +
                     r * (1 / 24.0 +
                          r * (1 / 120.0 +
                               r * (1 / 720.0 +
                                    r * (1 / 5040.0 +
                                         r * (1 / 40320.0 +
                                              r * (1 / 362880.0 +
                                                   r * (1 / 3628800.0 +
                                                        r * (1 / 39916800.0 +
                                                             r * (1 / 479001600.0 +
                                                                  r * (1 /
                                                                       6227020800.0)))))))))))));
  const auto exponent = std::bit_cast<std::uint64_t>(shifted) << 52;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) + exponent);
}

} // namespace calotte::detail
