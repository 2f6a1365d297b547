// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/elementary.h"
#include "base/vector_loops.h"
#include "integrals/room.h"

#include <cmath>

namespace calotte::integrals_detail {

/// Half of a kite, a right spherical triangle. Its first leg is half of an edge, an arc of less
/// than pi/2 from the site; its second leg is a signed arc to the left, which ends in the
/// circumcentre.
struct HalfEdge {
  double sine, cosine; ///< of the first arc
  double arc, tangent; ///< the signed arc, and the tangent of half of it
};

/// \param quarter |a-b|^2/4 of the edge.
/// \param cotangent of the flat triangle's angle across.
CALOTTE_INLINE HalfEdge half_edge(double quarter, double cotangent) {
  const double sine = std::sqrt(quarter), cosine = std::sqrt(1 - quarter);
  // Rounding can exceed 1 where the circumcap is a hemisphere.
  const double raw = sine / cosine * cotangent, low = raw < -1 ? -1 : raw;
  const double sine_of_arc = low > 1 ? 1 : low;
  return {sine, cosine, arc_sine(sine_of_arc),
          sine_of_arc / (1 + std::sqrt(1 - sine_of_arc * sine_of_arc))};
}

CALOTTE_INLINE double half_area(const HalfEdge& half) {
  return 2 * arc_tangent(half.sine / (1 + half.cosine) * half.tangent);
}

/// atan(sqrt(z))/sqrt(z) - 1 for 0 <= z <= 1/16, by its series.
CALOTTE_INLINE double arc_tangent_excess(double z) {
  return -z *
         (1.0 / 3 -
          z * (1.0 / 5 -
               z * (1.0 / 7 -
                    z * (1.0 / 9 -
                         z * (1.0 / 11 -
                              z * (1.0 / 13 -
                                   z * (1.0 / 15 -
                                        z * (1.0 / 17 -
                                             z * (1.0 / 19 -
                                                  z * (1.0 / 21 -
                                                       z * (1.0 / 23 - z * (1.0 / 25))))))))))));
}

/// The integral of |y - x|^2 over half a kite, x the site: twice the area minus the arc times the
/// sine. With p and q the tangents of half of both arcs and c = 1/(1 + p^2), the sine is 2 p c.
/// Where the arc is small, the series of atan(p q) and atan(q) are subtracted term by term.
CALOTTE_INLINE double half_energy(const HalfEdge& half) {
  const double p = half.sine / (1 + half.cosine);
  const double q = half.tangent;
  const double c = 1 / (1 + p * p);
  const bool low = q * q < 1.0 / 16;
  const double z = low ? q * q : 0;
  const double by_series =
      p * q * (p * p * c + arc_tangent_excess(z * p * p) - c * arc_tangent_excess(z));
  const double direct = arc_tangent(p * q) - 0.5 * half.arc * p * c;
  return 4 * (low ? by_series : direct);
}

/// The terms that half an edge adds to both of its ends.
struct EdgeTerms {
  double pull; ///< arc / (2 |a-b|): the first moment's part is that times (a - b) for a
  double energy;
};

CALOTTE_INLINE EdgeTerms edge_terms(const HalfEdge& half) {
  return {0.25 * half.arc / half.sine, half_energy(half)};
}

/// The terms by series in S and w, where both are small. With s = |a-b|/2 the sine of half of the
/// edge's arc, S = s^2, u = s cot(C)/sqrt(1-S) the sine of the signed arc and w = u^2.
class ShortEdge {
public:
  CALOTTE_INLINE ShortEdge(double quarter, double cotangent)
      : s_(quarter), tilt_(cotangent * inverse_root(quarter)), w_(quarter * tilt_ * tilt_) {}

  /// False where the first omitted terms exceed 2^-53 of the leading ones, or for NaN.
  CALOTTE_INLINE bool is_short() const { return (s_ > w_ ? s_ : w_) <= 0x1p-13; }
  CALOTTE_INLINE EdgeTerms terms() const {
    return {tilt_ * quarter_arc_sine(w_), s_ * tilt_ * energy(s_, w_)};
  }

private:
  CALOTTE_INLINE static double inverse_root(double z) { // (1 - z)^(-1/2)
    return (1 + z * (1.0 / 2)) + z * z * (3.0 / 8 + z * (5.0 / 16));
  }
  CALOTTE_INLINE static double quarter_arc_sine(double z) { // asin(sqrt(z))/sqrt(z)/4
    return (0.25 + z * (0.25 / 6)) + z * z * (0.75 / 40 + z * (1.25 / 112));
  }
  /// half_energy() over s u. Its terms without S or w cancel.
  CALOTTE_INLINE static double energy(double s, double w) {
    const double w2 = w * w, s2 = s * s;
    const double w1 = (1.0 / 12 + w * (1.0 / 20)) + w2 * (15.0 / 448 + w * (7.0 / 288));
    const double s_1 = (1.0 / 4 + w * (1.0 / 24)) + w2 * (1.0 / 64 + w * (1.0 / 128));
    const double s_2 = (1.0 / 8 + w * (1.0 / 64)) + w2 * (3.0 / 640);
    const double s_3 = (5.0 / 64 + w * (1.0 / 128)) + s * (7.0 / 128);
    return (w * w1 + s * s_1) + s2 * (s_2 + s * s_3);
  }

  double s_, tilt_, w_;
};

} // namespace calotte::integrals_detail
