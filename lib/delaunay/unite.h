// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/matrix_memory.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "delaunay/room.h"
#include "delaunay/sites.h"
#include "delaunay/triangulate.h"

#include <calotte/types.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace calotte::delaunay_detail {

using Triple = std::array<std::int32_t, 3>;

/// Memory for those arrays of the reports that are dead before neighbours are written: that of the
/// mesh's neighbours. A triangulation so touches fewer pages, which a fresh process waits for.
class ReportMemory {
public:
  ReportMemory() = default; ///< none: each array has its own
  explicit ReportMemory(std::int64_t sites) { make_room(ids_, 3, 2 * sites); }

  /// n values; with memory of their own if there is not enough. Any thread may call it.
  template <class T> Array<T> array(std::int64_t n) {
    constexpr std::int64_t line = 64; // of cache, not shared by arrays
    const std::int64_t bytes =
        (n * static_cast<std::int64_t>(sizeof(T)) + 8 + line - 1) / line * line;
    const std::int64_t begin = std::atomic_ref(used_).fetch_add(bytes, std::memory_order_relaxed);
    if (begin + bytes > ids_.size() * static_cast<std::int64_t>(sizeof(std::int32_t)))
      return Array<T>(n);
    return Array<T>::in(reinterpret_cast<char*>(ids_.data()) + begin, n);
  }

  /// The memory, for neighbours.
  Triangles take() && { return std::move(ids_); }

private:
  Triangles ids_;
  std::int64_t used_ = 0; ///< bytes
};

/// Triples of a region's own numbers, or of -1 for none. Most regions have fewer than 65 535
/// triangles: their numbers take 16 bits, which halves the memory that a report touches.
class LocalTriples {
public:
  LocalTriples() = default;
  /// \param numbers that occur are below this.
  LocalTriples(std::int64_t size, std::int64_t numbers, ReportMemory& memory) : size_(size) {
    if (numbers <= none)
      narrow_ = memory.array<std::array<std::uint16_t, 3>>(size);
    else
      wide_ = memory.array<Triple>(size);
  }

  std::int64_t size() const { return size_; }

  void set(std::int64_t t, const Triple& numbers) {
    if (is_narrow())
      narrow_[t] = {static_cast<std::uint16_t>(numbers[0]), static_cast<std::uint16_t>(numbers[1]),
                    static_cast<std::uint16_t>(numbers[2])};
    else
      wide_[t] = numbers;
  }

  std::int32_t operator()(std::int64_t t, std::size_t i) const {
    if (!is_narrow())
      return wide_[t][i];
    const std::uint16_t number = narrow_[t][i];
    return number == none ? -1 : number;
  }

private:
  static constexpr std::uint16_t none =
      std::numeric_limits<std::uint16_t>::max(); ///< -1 in 16 bits

  bool is_narrow() const { return narrow_.size() > 0; }

  std::int64_t size_ = 0;
  Array<std::array<std::uint16_t, 3>> narrow_;
  Array<Triple> wide_;
};

/// A triangle whose vertices have different owners, each of whom reports it.
struct Seam {
  Triple sites;
  std::int32_t triangle; ///< its place in the report
  std::int32_t home;     ///< the region that owns its lowest site
  std::int8_t reporters; ///< the number of owners
  std::int8_t own_edges; ///< bit i set where this region owns the lower site of the edge across
                         ///< from vertex i
};

/// The report of one region: its triangles with an owned vertex, in any order, each from its lowest
/// site on.
struct RegionTriangles {
  LocalTriples vertices;    ///< local numbers, counter-clockwise; dead once triangles are placed
  LocalTriples neighbours;  ///< across from each vertex, as triangles of the report; -1 if not here
  Array<std::int32_t> site; ///< by local number; dead with the vertices
  Array<std::int32_t> rank; ///< by second site among those of one lowest site; -1 if that is not
                            ///< owned; at least as many as triangles
  std::vector<Seam> seams;  ///< ascending by triangle
};

/// The number of triangles whose lowest site the region owns; over all regions each triangle counts
/// once.
std::int64_t seams_at(std::int64_t home, const std::vector<Seam>& seams);

/// Reports the certified finite faces of a triangulation.
/// \param owner by rank, to count a seam's owners.
/// \param triangles_of by site: set, for the owned sites, to the number of triangles with that
/// lowest site.
/// \param memory serves the arrays that die with the vertices.
template <class Space>
RegionTriangles report_triangles(Triangulation<Space>& triangulation, const Sites& sites,
                                 const Array<std::int32_t>& owner,
                                 Array<std::int32_t>& triangles_of, ReportMemory& memory);

/// Unites the reports of the regions to triangles and neighbours in canonical order. Triangles with
/// one owner go directly to their place. Seam triangles meet in a concurrent hash table, one part
/// per region, which counts their reports.
/// \param triangles_of by site, as report_triangles left it; consumed, as the reports are.
/// \param mesh receives triangles and neighbours in the memory that it has for them, if that is
///        enough. The reports' vertices and sites may be in the neighbours' memory.
/// \param monitor if not null, receives two steps per region.
/// \throws Error internal if a seam triangle was not reported by exactly the owners of its
///         vertices.
void unite(std::vector<RegionTriangles>&& reports, Array<std::int32_t>&& triangles_of, Mesh& mesh,
           Monitor* monitor = nullptr);

} // namespace calotte::delaunay_detail
