// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cells.h"
#include "parallel.h"
#include "points.h"
#include "vec3.h"

#include <calotte/delaunay.h>

#include <cstdint>
#include <vector>

namespace calotte::detail {

/// The distinct directions of an input, in two orders: by *id*, the order of the input, and by
/// *rank*, along the space-filling curve. Stages work by rank, where neighbours in memory are
/// neighbours in space; the mesh speaks of ids.
struct Sites {
  Points3 points;                          ///< by id: as given, of any norm
  std::vector<std::int32_t> site_of_input; ///< id for each input column
  Array<std::int32_t> id;                  ///< by rank
  Array<Vec3> unit;                        ///< by rank: normalised to 5 roundoffs
  CellTree cells;                          ///< over the ranks: what stands where on the sphere

  std::int64_t size() const { return id.size(); }
  const Vec3& given(std::int32_t site) const { return column(points, site); }
};

/// \throws Error not_finite, zero_vector, duplicate, too_few_sites (for more than 2^30 points too),
/// bad_option.
Sites make_sites(const Points3& points, Duplicates duplicates, double merge_within);

} // namespace calotte::detail
