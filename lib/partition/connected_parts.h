// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "partition/graph.h"
#include "partition/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <vector>

namespace calotte::partition_detail {

/// The imbalance that METIS aims at by default, with its rounding: the heaviest part over the mean
/// weight, minus 1.
inline constexpr double aimed_imbalance = 0.03005;

/// The total weight of each part.
/// \param weights by cell; empty if all are 1.
std::vector<double> part_weights(const std::vector<std::int32_t>& part, std::int64_t parts,
                                 const DoubleVector& weights);

/// Makes each part connected and not empty. If a part has several components, all but the heaviest
/// move to a neighbouring part. This is the part with which they have the most edges, of those that
/// keep the aimed imbalance if there are any. A part without cells receives some half of the
/// heaviest part that has several cells.
/// \param graph connected. \pre 1 <= parts <= cells
/// \param part of each cell, 0 to parts - 1.
std::vector<std::int32_t> connected_parts(const Graph& graph, const DoubleVector& weights,
                                          std::int64_t parts, std::vector<std::int32_t> part);

} // namespace calotte::partition_detail
