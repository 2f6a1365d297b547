// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "vec3.h"

#include <calotte/types.h>

#include <cstdint>

namespace calotte::detail {

/// A column in place: columns of a Points3 are triples of doubles, as Vec3 is.
inline const Vec3& column(const Points3& points, std::int64_t i) {
  return *reinterpret_cast<const Vec3*>(points.data() + 3 * i);
}

inline void set_column(Points3& points, std::int64_t i, const Vec3& value) {
  *reinterpret_cast<Vec3*>(points.data() + 3 * i) = value;
}

} // namespace calotte::detail
