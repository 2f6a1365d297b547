// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/matrices.h>
#include <calotte/progress.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Partitions of a mesh's cells, one part for each process of a model.
CALOTTE_API_BEGIN
namespace calotte {

/// Options of partition().
struct PartitionOptions {
  /// n: the work of each cell, >= 0 and finite, with a positive sum. Parts have equal sums.
  /// Default: empty, all cells are equal.
  DoubleVector weights = {};
  /// Stage: partition. A step is a number of parts. Default: none.
  ProgressCallback progress = {};
};

/// The parts of n cells. No part is empty.
struct CellParts {
  Ids part;                  ///< n: the part of each cell, 0 to parts - 1
  std::int64_t parts = 1;    ///< their number
  std::int64_t edge_cut = 0; ///< pairs of neighbours in different parts
  double imbalance = 0;      ///< weight of the heaviest part over the mean weight, less 1
  /// Whether no part is heavier than 1.03 times the mean weight and the heaviest cell together.
  bool balanced = true;
  std::int64_t unconnected = 0; ///< parts whose cells are not connected; 0 for a connected graph
};

/// Partitions cells by METIS (Karypis and Kumar, SIAM J. Sci. Comput. 20, 1998), multilevel k-way
/// for a small edge cut, as gpmetis does, such that each part is connected. METIS aims at an
/// imbalance of at most 0.03; with fewer than 50 cells a part, of up to one cell more. If the parts
/// are not balanced, as with cells of very different weights, METIS is called up to three more
/// times.
///
/// Cells that are not all connected, such as those of an ocean with separate basins, are joined for
/// METIS by one edge for each further component, to the cell of the next lower id. A part may then
/// have cells of several components; within each of these its cells are connected through the cells
/// of the part, or through such an edge.
///
/// METIS uses rand() and handlers of SIGABRT and SIGTERM, of which a process has one each. It
/// therefore runs in one thread at a time, and leaves both as they were. While it runs no other
/// thread may call rand() or random(), and either signal ends METIS or the process. The result has
/// the same bits for any number of threads. The function runs in the caller's task arena.
/// \param neighbours n lists: of each cell those that share an edge with it, in any order; ids of
///        -1, the cell itself and repetitions have no effect. See neighbours(), cell_neighbours()
///        and Voronoi::cells_on_cell.
/// \param parts 1 to n. One part needs no METIS.
/// \throws Error invalid_argument: no cells; parts out of range; ids out of range, and neighbours
///         that are not mutual, with the index of the cell; weights of another number, with the
///         index one that is negative or not finite, or all 0; cells and edges beyond the 32-bit
///         integers of METIS. Error internal, if METIS fails; cancelled. std::bad_alloc, also
///         where METIS finds no memory.
CellParts partition(const IdLists& neighbours, std::int64_t parts,
                    const PartitionOptions& options = {});

/// The same for several numbers of parts, in parallel except for METIS.
/// \param visit called for each number in `counts` once, from several threads at once, in any
///        order. An exception that it throws ends the call.
void partition(const IdLists& neighbours, std::span<const std::int64_t> counts,
               const PartitionOptions& options, const std::function<void(CellParts)>& visit);

/// The numbers of cells of the connected components of a graph, the largest first.
/// \throws Error invalid_argument as partition(), for neighbours.
std::vector<std::int64_t> component_sizes(const IdLists& neighbours);

} // namespace calotte
CALOTTE_API_END
