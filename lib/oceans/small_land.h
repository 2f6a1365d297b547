// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "oceans/room.h"

#include <calotte/ocean.h>

#include <cstdint>
#include <span>
#include <vector>

namespace calotte::oceans_detail {

/// The closed lines of a coast, see coast_arcs(), each the arcs in its order.
std::vector<std::vector<Arc>> closed_lines(const Coast& coast);

/// A coast without its small lines, and what was left out.
struct LargeCoast {
  Coast coast;
  std::int64_t islands = 0, lakes = 0;     ///< lines with little land, or little else, on one side
  double islands_area = 0, lakes_area = 0; ///< steradians
};

/// \param lines closed_lines(coast). \param least areas by line, steradians; lines with less on one
/// side are left out.
LargeCoast large_lines(const Coast& coast, const std::vector<std::vector<Arc>>& lines,
                       std::span<const double> least);

} // namespace calotte::oceans_detail
