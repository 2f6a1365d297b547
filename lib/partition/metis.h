// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "partition/graph.h"
#include "partition/room.h"

#include <calotte/matrices.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace calotte::partition_detail {

/// A graph as METIS takes it. The only class that knows METIS.
class Metis {
public:
  /// \param graph connected.
  /// \param weights by cell, or empty.
  /// \throws Error invalid_argument beyond METIS's integers.
  Metis(const Graph& graph, const DoubleVector& weights);
  Metis(const Metis&) = delete;
  Metis& operator=(const Metis&) = delete;
  ~Metis();

  /// The part of each cell, 0 to parts - 1. Some may have several components, or no cells, above
  /// all very small ones. Any thread may call it; METIS runs in one at a time.
  /// \param attempt 0 at first; each other number up to 3 gives other parts.
  /// \pre parts from 2 to the number of cells.
  /// \throws Error internal; std::bad_alloc.
  std::vector<std::int32_t> partition(std::int64_t parts, int attempt) const;

private:
  struct Arrays;
  std::unique_ptr<Arrays> arrays_;
};

} // namespace calotte::partition_detail
