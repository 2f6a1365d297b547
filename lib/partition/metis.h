// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "partition/graph.h"
#include "partition/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace calotte::partition_detail {

/// A graph in the format of METIS. The only class that uses METIS.
class Metis {
public:
  /// \param graph connected.
  /// \param weights by cell, or empty.
  /// \throws Error invalid_argument, if the graph is too large for the integers of METIS.
  Metis(const Graph& graph, const DoubleVector& weights);
  Metis(const Metis&) = delete;
  Metis& operator=(const Metis&) = delete;
  ~Metis();

  /// The part of each cell, 0 to parts - 1. Parts may have several components or no cells, above
  /// all very small parts. Any thread may call it; calls of METIS are serialised.
  /// \param attempt 0 at first. Other numbers up to 3 give other parts.
  /// \pre parts from 2 to the number of cells.
  /// \throws Error internal; std::bad_alloc.
  std::vector<std::int32_t> partition(std::int64_t parts, int attempt) const;

private:
  struct Arrays;
  std::unique_ptr<Arrays> arrays_;
};

} // namespace calotte::partition_detail
