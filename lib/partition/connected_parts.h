// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "partition/graph.h"
#include "partition/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <vector>

namespace calotte::partition_detail {

/// METIS's aim by default, with its rounding: the heaviest part over the mean weight, less 1.
inline constexpr double aimed_imbalance = 0.03005;

/// The sum of the weights of each part. \param weights by cell; empty: 1 each.
std::vector<double> part_weights(const std::vector<std::int32_t>& part, std::int64_t parts,
                                 const DoubleVector& weights);

/// Makes each part connected, and none empty. Of a part with several components all but the
/// heaviest go to a neighbouring part: one that keeps the aimed imbalance if there is one, with
/// which they have the most edges. A part without cells takes some half of the heaviest part that
/// has several.
/// \param graph connected. \pre 1 <= parts <= cells
/// \param part of each cell, 0 to parts - 1.
std::vector<std::int32_t> connected_parts(const Graph& graph, const DoubleVector& weights,
                                          std::int64_t parts, std::vector<std::int32_t> part);

} // namespace calotte::partition_detail
