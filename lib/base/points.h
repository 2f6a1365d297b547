// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"

#include <calotte/types.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace calotte::base_detail {

/// A column in place: columns of a Points3 are triples of doubles, as Vec3 is.
inline const Vec3& column(const Points3& points, std::int64_t i) {
  return *reinterpret_cast<const Vec3*>(points.data() + 3 * i);
}

inline void set_column(Points3& points, std::int64_t i, const Vec3& value) {
  *reinterpret_cast<Vec3*>(points.data() + 3 * i) = value;
}

/// site_of_input where no input was merged: 0 to n - 1.
inline std::vector<std::int32_t> themselves(std::int64_t n) {
  std::vector<std::int32_t> sites(static_cast<std::size_t>(n));
  std::iota(sites.begin(), sites.end(), 0);
  return sites;
}

} // namespace calotte::base_detail
