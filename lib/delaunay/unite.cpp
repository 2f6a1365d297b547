// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/unite.h"

#include "base/lists.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/split_mix.h"
#include "base/triangle.h"
#include "delaunay/plane_chart.h"
#include "delaunay/sphere_chart.h"

#include <calotte/error.h>

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

namespace calotte::delaunay_detail {
namespace {

/// The corner of a face with its lowest site.
template <class Face> int lowest_corner(const Face& face) {
  const std::int32_t a = face.vertex(0)->point.site, b = face.vertex(1)->point.site,
                     c = face.vertex(2)->point.site;
  return ((b < a) & (b < c)) + 2 * ((c < a) & (c < b)); // branches would be mispredicted
}

template <class Vertices> std::int8_t own_edges(const Vertices& v) {
  int bits = 0;
  for (int i = 0; i < 3; ++i) {
    const auto a = v[static_cast<std::size_t>(next_vertex(i))],
               b = v[static_cast<std::size_t>(previous_vertex(i))];
    const auto lower = a->point.site < b->point.site ? a : b;
    bits |= static_cast<int>(lower->owned()) << i;
  }
  return static_cast<std::int8_t>(bits);
}

/// A face that a region reports.
template <class Chart> struct Found {
  typename Triangulation<Chart>::Store::Face* face;
  std::int32_t lowest; ///< the corner with its lowest site
  std::int32_t member; ///< that site's, if the region owns it; else the number of members
};
template <class Chart> using AllFound = std::vector<Found<Chart>>;

/// The certified finite faces, in the order of memory.
template <class Chart> AllFound<Chart> find_faces(Triangulation<Chart>& triangulation) {
  const auto members = static_cast<std::int32_t>(triangulation.members().size());
  AllFound<Chart> found;
  found.reserve(2 * triangulation.members().size());
  triangulation.for_each_face([&](typename Triangulation<Chart>::Face face) {
    if (!face->certified || triangulation.is_infinite(face))
      return;
    const int lowest = lowest_corner(*face);
    const auto vertex = face->vertex(lowest);
    found.push_back({&*face, lowest, vertex->owned() ? vertex->local : members});
  });
  return found;
}

/// Numbers faces member by member; the faces of one member are in the order of their second sites.
/// \returns the numbers with which the members begin; behind them are the faces whose lowest site
///          the region does not own.
template <class Chart>
std::vector<std::int64_t> number_faces(const AllFound<Chart>& found, std::int64_t members) {
  struct Listed {
    std::int32_t second; ///< site of the face
    std::int32_t found;  ///< its index
  };
  auto lists = lists_by_key<std::vector<Listed>>(members + 1, [&](const auto& put) {
    for (std::int32_t f = 0; f < std::ssize(found); ++f) {
      const auto& [face, lowest, member] = found[static_cast<std::size_t>(f)];
      put(member, {face->vertex(next_vertex(lowest))->point.site, f});
    }
  });
  for (std::int64_t m = 0; m < members; ++m)
    std::sort(lists[m].begin(), lists[m].end(),
              [](const Listed& a, const Listed& b) { return a.second < b.second; });
  std::int32_t number = 0;
  for (const Listed& listed : lists.items)
    found[static_cast<std::size_t>(listed.found)].face->number = number++;
  return std::move(lists.begin);
}

} // namespace

std::int64_t RegionTriangles::own_seams() const {
  return std::count_if(seams.begin(), seams.end(),
                       [&](const Seam& seam) { return seam.triangle < own; });
}

template <class Chart>
RegionTriangles report_triangles(Triangulation<Chart>& triangulation, const Sites& sites,
                                 const Array<std::int32_t>& owner,
                                 Array<std::int32_t>& triangles_of) {
  const std::span<const Member> members = triangulation.members();
  const AllFound<Chart> found = find_faces(triangulation);
  const std::vector<std::int64_t> begin = number_faces<Chart>(found, std::ssize(members));
  RegionTriangles out{Array<Triple>(std::ssize(found)),
                      Array<Triple>(std::ssize(found)),
                      begin[members.size()],
                      {}};
  const auto owner_of = [&](auto vertex) {
    return owner[members[static_cast<std::size_t>(vertex->local)].rank];
  };
  for (const auto& [face, i, member] : found) {
    const int j = next_vertex(i), k = previous_vertex(i);
    const std::array v{face->vertex(i), face->vertex(j), face->vertex(k)};
    const Triple triangle{v[0]->point.site, v[1]->point.site, v[2]->point.site};
    out.sites[face->number] = triangle;
    out.neighbours[face->number] = {face->neighbor(i)->number, face->neighbor(j)->number,
                                    face->neighbor(k)->number};
    if (v[0]->owned() && v[1]->owned() && v[2]->owned())
      continue;
    const std::int32_t a = owner_of(v[0]), b = owner_of(v[1]), c = owner_of(v[2]);
    out.seams.push_back({triangle, face->number, a,
                         static_cast<std::int8_t>(1 + (b != a) + (c != a && c != b)),
                         own_edges(v)});
  }
  std::sort(out.seams.begin(), out.seams.end(),
            [](const Seam& a, const Seam& b) { return a.triangle < b.triangle; });
  for (std::size_t m = 0; m < members.size(); ++m)
    if (members[m].owned())
      triangles_of[sites.id[members[m].rank]] = static_cast<std::int32_t>(begin[m + 1] - begin[m]);
  return out;
}

template RegionTriangles report_triangles(Triangulation<SphereChart>&, const Sites&,
                                          const Array<std::int32_t>&, Array<std::int32_t>&);
template RegionTriangles report_triangles(Triangulation<PlaneChart>&, const Sites&,
                                          const Array<std::int32_t>&, Array<std::int32_t>&);

namespace {

[[noreturn]] void disagree(const Triple& sites) {
  throw Error(ErrorCode::internal,
              message("regions disagree on the triangle of sites {}, {} and {}: "
                      "please report this input as a bug",
                      sites[0], sites[1], sites[2]));
}

/// The seam triangles whose lowest site one region owns, by their sites, with open addressing. A
/// table of all seam triangles would be as large as a cache, with random access; the tables of a
/// region and its neighbours, which contain all of its seams, are small.
class SeamTable {
public:
  SeamTable() = default;
  /// Reserves space for that many triangles.
  explicit SeamTable(std::int64_t triangles)
      : slots_(static_cast<std::size_t>(triangles + triangles / 2 + 1)) {}

  /// Adds a triangle, with its index in the mesh and one report. One thread calls it, before others
  /// read.
  void enter(const Seam& seam, std::int32_t index) {
    Slot& slot = find(seam.sites);
    slot.sites = seam.sites;
    slot.index = index;
    slot.reporters = seam.reporters;
    slot.reports.fetch_add(1, std::memory_order_relaxed);
  }

  /// Counts one more report of a triangle, from any thread; returns its index in the mesh.
  std::int32_t count(const Seam& seam) {
    Slot& slot = find(seam.sites);
    if (slot.index < 0 || slot.reporters != seam.reporters)
      disagree(seam.sites);
    slot.reports.fetch_add(1, std::memory_order_relaxed);
    return slot.index;
  }

  /// \throws Error internal unless each triangle was reported by all of its owners.
  void require_agreement() const {
    for (const Slot& slot : slots_)
      if (slot.reports.load(std::memory_order_relaxed) != slot.reporters)
        disagree(slot.sites);
  }

private:
  struct Slot {
    Triple sites{};
    std::int32_t index = -1;
    std::int8_t reporters = 0;
    std::atomic<std::int8_t> reports{0};
  };

  /// The slot of a triangle, or an empty one.
  Slot& find(const Triple& sites) {
    std::uint64_t h = 0;
    for (const std::int32_t s : sites)
      h = hash_with(h, static_cast<std::uint64_t>(s));
    std::size_t s = (h >> 32) * slots_.size() >> 32;
    while (slots_[s].index >= 0 && slots_[s].sites != sites)
      s = s + 1 < slots_.size() ? s + 1 : 0;
    return slots_[s];
  }

  std::vector<Slot> slots_;
};

/// Writes the triangles whose lowest site the region owns to their indices in the mesh.
/// \returns the indices by number in the report; not set for the other triangles.
Array<std::int32_t> write_own(const RegionTriangles& report, const Array<std::int32_t>& first_of,
                              Triangles& out) {
  Array<std::int32_t> index(report.sites.size());
  for (std::int64_t t = 0; t < report.own; ++t) {
    const Triple& sites = report.sites[t];
    index[t] = t > 0 && report.sites[t - 1][0] == sites[0] ? index[t - 1] + 1 : first_of[sites[0]];
    out.col(index[t]) << sites[0], sites[1], sites[2];
  }
  return index;
}

/// Sets the neighbours across the edges that the region is responsible for: all edges of a triangle
/// with one owner, and those edges of a seam triangle whose lower site it owns.
void write_neighbours(const RegionTriangles& report, const Array<std::int32_t>& index,
                      Triangles& out) {
  auto seam = report.seams.begin();
  for (std::int64_t t = 0; t < report.neighbours.size(); ++t) {
    const bool is_seam = seam != report.seams.end() && seam->triangle == t;
    const int own_edges = is_seam ? (seam++)->own_edges : 7;
    for (int i = 0; i < 3; ++i)
      if (own_edges >> i & 1) {
        const std::int32_t across = report.neighbours[t][static_cast<std::size_t>(i)];
        out(i, index[t]) = across < 0 ? -1 : index[across];
      }
  }
}

} // namespace

void unite(std::vector<RegionTriangles>&& reports, Array<std::int32_t>&& triangles_of, Mesh& mesh,
           Monitor* monitor) {
  const std::int32_t count = exclusive_scan(std::span(triangles_of.begin(), triangles_of.end()));
  mesh.triangles.resize(3, count);
  const std::int64_t regions = std::ssize(reports);
  std::vector<SeamTable> tables(reports.size());
  std::vector<Array<std::int32_t>> index(reports.size());

  for_each_task(regions, [&](std::int64_t k) {
    RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    Array<std::int32_t>& own = index[static_cast<std::size_t>(k)];
    own = write_own(report, triangles_of, mesh.triangles);
    report.sites = {};
    tables[static_cast<std::size_t>(k)] = SeamTable(report.own_seams());
    for (const Seam& seam : report.seams)
      if (seam.triangle < report.own)
        tables[static_cast<std::size_t>(k)].enter(seam, own[seam.triangle]);
    step(monitor);
  });
  for_each_task(regions, [&](std::int64_t k) {
    const RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    for (const Seam& seam : report.seams)
      if (seam.triangle >= report.own)
        index[static_cast<std::size_t>(k)][seam.triangle] =
            tables[static_cast<std::size_t>(seam.home)].count(seam);
  });
  mesh.neighbours.resize(3, count);
  for_each_task(regions, [&](std::int64_t k) {
    RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    tables[static_cast<std::size_t>(k)].require_agreement();
    write_neighbours(report, index[static_cast<std::size_t>(k)], mesh.neighbours);
    report = {}; // freed here, by all threads
    index[static_cast<std::size_t>(k)] = {};
    tables[static_cast<std::size_t>(k)] = {};
    step(monitor);
  });
}

} // namespace calotte::delaunay_detail
