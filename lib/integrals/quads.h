// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vector_loops.h"

/// Four doubles at a time, between arrays of sites and rows of lanes (rows.h).
namespace calotte::integrals_detail {

using Quad = double __attribute__((vector_size(32)));

/// A view of four doubles at any address of doubles. A copy by std::memcpy would go through the
/// stack in halves; a vector type of lower alignment is not enough for clang.
struct [[gnu::packed, gnu::aligned(8), gnu::may_alias]] QuadView {
  Quad value;
};

CALOTTE_INLINE const QuadView& quad_at(const void* from) {
  return *static_cast<const QuadView*>(from);
}
CALOTTE_INLINE QuadView& quad_at(void* to) { return *static_cast<QuadView*>(to); }

/// Transposes a 4 x 4 matrix.
CALOTTE_INLINE void transpose(Quad& a, Quad& b, Quad& c, Quad& d) {
  const Quad ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
             ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7),
             cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
             cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

} // namespace calotte::integrals_detail
