// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/unite.h"

#include "base/split_mix.h"
#include "base/triangle.h"
#include "delaunay/plane.h"
#include "delaunay/sphere.h"

#include <calotte/error.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <utility>

namespace calotte::delaunay_detail {
namespace {

template <class Space> using Vertices = std::array<typename Triangulation<Space>::Vertex, 3>;

/// A face's vertices and neighbours from its lowest site on.
template <class Space> struct Turned {
  Vertices<Space> vertex;
  Triple neighbours;
};

template <class Space> Turned<Space> turned(typename Triangulation<Space>::Face face) {
  const std::int32_t a = face->vertex(0)->place.site, b = face->vertex(1)->place.site,
                     c = face->vertex(2)->place.site;
  // Without branches, which would be mispredicted.
  const int i = ((b < a) & (b < c)) + 2 * ((c < a) & (c < b));
  const int j = next_vertex(i), k = previous_vertex(i);
  return {{face->vertex(i), face->vertex(j), face->vertex(k)},
          {face->neighbor(i)->number, face->neighbor(j)->number, face->neighbor(k)->number}};
}

template <class Vertices> std::int8_t own_edges(const Vertices& v) {
  int bits = 0;
  for (int i = 0; i < 3; ++i) {
    const auto a = v[static_cast<std::size_t>(next_vertex(i))],
               b = v[static_cast<std::size_t>(previous_vertex(i))];
    const auto lower = a->place.site < b->place.site ? a : b;
    bits |= static_cast<int>(lower->owned()) << i;
  }
  return static_cast<std::int8_t>(bits);
}

/// Turns lists of the triangles of one lowest vertex into ranks: of each triangle by second site. A
/// list ends with a sentinel triangle, whose second site is larger than all others. Ranks
/// replace the links.
class RankLists {
public:
  RankLists(std::int32_t triangles, std::size_t vertices)
      : end_(triangles), last_(vertices, end_), second_(triangles + 1), next_(triangles + 1) {
    second_[end_] = std::numeric_limits<std::int32_t>::max();
    next_[end_] = end_;
  }

  void add(std::int32_t triangle, std::int32_t lowest, std::int32_t second) {
    second_[triangle] = second;
    next_[triangle] = std::exchange(last_[static_cast<std::size_t>(lowest)], triangle);
  }

  /// For a triangle in no list.
  void leave_out(std::int32_t triangle) { next_[triangle] = -1; }

  /// The ranks by triangle; -1 for triangles in no list, and one entry for the sentinel.
  Array<std::int32_t> ranks() && {
    for (const std::int32_t t : last_)
      rank(t);
    return std::move(next_);
  }

private:
  /// Most lists have up to four members, and their length is unpredictable: sentinels are ranked as
  /// members are, without branches, which would be mispredicted.
  void rank(std::int32_t t0) {
    const std::int32_t t1 = next_[t0], t2 = next_[t1], t3 = next_[t2];
    if (next_[t3] != end_) {
      rank_many(t0);
      return;
    }
    const std::int32_t s0 = second_[t0], s1 = second_[t1], s2 = second_[t2], s3 = second_[t3];
    const int after01 = s0 > s1, after02 = s0 > s2, after03 = s0 > s3, after12 = s1 > s2,
              after13 = s1 > s3, after23 = s2 > s3;
    next_[t3] = 3 - after03 - after13 - after23;
    next_[t2] = 2 - after02 - after12 + after23;
    next_[t1] = 1 - after01 + after12 + after13;
    next_[t0] = after01 + after02 + after03;
    next_[end_] = end_;
  }

  /// One vertex in seven is the lowest of its star. Each member's rank is the number of those
  /// before it, by comparisons of all pairs, which are vector code.
  void rank_many(std::int32_t t) {
    constexpr std::size_t most = 8;
    std::array<std::int32_t, most> member, second, rank{};
    for (std::size_t i = 0; i < most; ++i, t = next_[t]) {
      member[i] = t;
      second[i] = second_[t];
    }
    if (t != end_) {
      rank_all(member[0]);
      return;
    }
    for (std::size_t j = 0; j < most; ++j)
      for (std::size_t i = 0; i < most; ++i)
        rank[i] += second[j] < second[i];
    for (std::size_t i = 0; i < most; ++i)
      next_[member[i]] = rank[i];
    next_[end_] = end_;
  }

  /// A hub may have any number of triangles.
  void rank_all(std::int32_t t) {
    many_.clear();
    for (; t != end_; t = next_[t])
      many_.push_back(t);
    std::sort(many_.begin(), many_.end(),
              [&](std::int32_t a, std::int32_t b) { return second_[a] < second_[b]; });
    for (std::size_t r = 0; r < many_.size(); ++r)
      next_[many_[r]] = static_cast<std::int32_t>(r);
  }

  std::int32_t end_;
  std::vector<std::int32_t> last_; ///< by vertex: the triangle added last
  Array<std::int32_t> second_;     ///< by triangle: its second site
  Array<std::int32_t> next_;       ///< by triangle: the one added before, then its rank
  std::vector<std::int32_t> many_;
};

} // namespace

std::int64_t seams_at(std::int64_t home, const std::vector<Seam>& seams) {
  return std::count_if(seams.begin(), seams.end(),
                       [&](const Seam& seam) { return seam.home == home; });
}

template <class Space>
CALOTTE_ALL_INSTRUCTIONS RegionTriangles report_triangles(Triangulation<Space>& triangulation,
                                                          const Sites& sites,
                                                          const Array<std::int32_t>& owner,
                                                          Array<std::int32_t>& triangles_of,
                                                          ReportMemory& memory) {
  using Face = typename Triangulation<Space>::Face;
  using Vertex = typename Triangulation<Space>::Vertex;
  std::int32_t count = 0;
  triangulation.for_each_face([&](Face face) {
    if (face->certified && !triangulation.is_infinite(face))
      face->number = count++;
  });
  const std::size_t locals = triangulation.members().size();
  const auto sites_here = static_cast<std::int64_t>(locals);
  ReportMemory own; // neighbours live until they are written
  RegionTriangles out{LocalTriples(count, sites_here, memory),
                      LocalTriples(count, count, own),
                      memory.array<std::int32_t>(sites_here),
                      {},
                      {}};
  std::vector<std::int32_t> length(locals, 0);
  RankLists lists(count, locals);
  const auto owner_of = [&](Vertex v) {
    return owner[triangulation.members()[static_cast<std::size_t>(v->local)].rank];
  };
  triangulation.for_each_face([&](Face face) {
    const std::int32_t t = face->number;
    if (t < 0)
      return;
    const auto [v, neighbours] = turned<Space>(face);
    out.vertices.set(t, {v[0]->local, v[1]->local, v[2]->local});
    out.neighbours.set(t, neighbours);
    if (v[0]->owned()) {
      lists.add(t, v[0]->local, v[1]->place.site);
      ++length[static_cast<std::size_t>(v[0]->local)];
    } else {
      lists.leave_out(t);
    }
    if (v[0]->owned() && v[1]->owned() && v[2]->owned())
      return;
    const std::int32_t a = owner_of(v[0]), b = owner_of(v[1]), c = owner_of(v[2]);
    out.seams.push_back({{v[0]->place.site, v[1]->place.site, v[2]->place.site},
                         t,
                         a,
                         static_cast<std::int8_t>(1 + (b != a) + (c != a && c != b)),
                         own_edges(v)});
  });
  out.rank = std::move(lists).ranks();
  for (std::size_t v = 0; v < locals; ++v) {
    const Member& member = triangulation.members()[v];
    const std::int32_t site = sites.id[member.rank];
    out.site[static_cast<std::int64_t>(v)] = site;
    if (member.owned())
      triangles_of[site] = length[v];
  }
  return out;
}

template RegionTriangles report_triangles(Triangulation<Sphere>&, const Sites&,
                                          const Array<std::int32_t>&, Array<std::int32_t>&,
                                          ReportMemory&);
template RegionTriangles report_triangles(Triangulation<Plane>&, const Sites&,
                                          const Array<std::int32_t>&, Array<std::int32_t>&,
                                          ReportMemory&);

namespace {

[[noreturn]] void disagree(const Triple& sites) {
  throw Error(ErrorCode::internal, "regions disagree on the triangle of sites " +
                                       std::to_string(sites[0]) + ", " + std::to_string(sites[1]) +
                                       " and " + std::to_string(sites[2]) +
                                       ": please report this input as a bug");
}

/// The seam triangles whose lowest site one region owns, by their sites, with open addressing. A
/// table of all seam triangles would be as large as a cache, with random access; the tables of a
/// region and its neighbours, which hold all of its seams, are small.
class SeamTable {
public:
  SeamTable() = default;
  /// Reserves space for that many triangles.
  explicit SeamTable(std::int64_t triangles)
      : slots_(static_cast<std::size_t>(triangles + triangles / 2 + 1)) {}

  /// Enters a triangle and its place in the mesh, reported once. One thread calls it, before others
  /// read.
  void enter(const Seam& seam, std::int32_t place) {
    Slot& slot = find(seam.sites);
    slot.sites = seam.sites;
    slot.place = place;
    slot.reporters = seam.reporters;
    slot.reports.fetch_add(1, std::memory_order_relaxed);
  }

  /// Counts one more report of a triangle, from any thread; returns its place in the mesh.
  std::int32_t count(const Seam& seam) {
    Slot& slot = find(seam.sites);
    if (slot.place < 0 || slot.reporters != seam.reporters)
      disagree(seam.sites);
    slot.reports.fetch_add(1, std::memory_order_relaxed);
    return slot.place;
  }

  /// True if each triangle was reported by all of its owners.
  void require_agreement() const {
    for (const Slot& slot : slots_)
      if (slot.reports.load(std::memory_order_relaxed) != slot.reporters)
        disagree(slot.sites);
  }

private:
  struct Slot {
    Triple sites{};
    std::int32_t place = -1;
    std::int8_t reporters = 0;
    std::atomic<std::int8_t> reports{0};
  };

  /// The slot of a triangle, or an empty one.
  Slot& find(const Triple& sites) {
    std::uint64_t h = 0;
    for (const std::int32_t s : sites)
      h = hash_with(h, static_cast<std::uint64_t>(s));
    std::size_t s = (h >> 32) * slots_.size() >> 32;
    while (slots_[s].place >= 0 && slots_[s].sites != sites)
      s = s + 1 < slots_.size() ? s + 1 : 0;
    return slots_[s];
  }

  std::vector<Slot> slots_;
};

/// Number of triangles ahead of the current one whose memory is prefetched: ids in input order
/// scatter a region's triangles over the mesh.
constexpr std::int64_t ahead = 32;

/// Turns the ranks of the triangles whose lowest site the region owns into their places in the
/// mesh, where it writes them.
Array<std::int32_t> place_own(RegionTriangles& report, const Array<std::int32_t>& first_of,
                              Triangles& out) {
  Array<std::int32_t> place = std::move(report.rank);
  const std::int64_t count = report.vertices.size();
  const auto site = [&](std::int64_t t, std::size_t i) {
    return report.site[report.vertices(t, i)];
  };
  for (std::int64_t t = 0; t < count; ++t) {
    if (t + ahead < count)
      __builtin_prefetch(&first_of[site(t + ahead, 0)]);
    if (place[t] >= 0)
      place[t] += first_of[site(t, 0)];
  }
  for (std::int64_t t = 0; t < count; ++t) {
    if (t + ahead < count && place[t + ahead] >= 0)
      __builtin_prefetch(&out(0, place[t + ahead]), 1);
    if (place[t] < 0)
      continue;
    for (int i = 0; i < 3; ++i)
      out(i, place[t]) = site(t, static_cast<std::size_t>(i));
  }
  return place;
}

/// Sets the neighbours across the edges that the region is responsible for: all edges of a triangle
/// with one owner, and those edges of a seam triangle whose lower site it owns.
void write_neighbours(const RegionTriangles& report, const Array<std::int32_t>& place,
                      Triangles& out) {
  const auto write = [&](std::int64_t t, int bits) {
    if (t + ahead < report.neighbours.size())
      __builtin_prefetch(&out(0, place[t + ahead]), 1);
    for (int i = 0; i < 3; ++i)
      if (bits >> i & 1) {
        const std::int32_t across = report.neighbours(t, static_cast<std::size_t>(i));
        out(i, place[t]) = across < 0 ? -1 : place[across];
      }
  };
  std::int64_t t = 0;
  for (const Seam& seam : report.seams) {
    for (; t < seam.triangle; ++t)
      write(t, 7);
    write(t++, seam.own_edges);
  }
  for (; t < report.neighbours.size(); ++t)
    write(t, 7);
}

} // namespace

void unite(std::vector<RegionTriangles>&& reports, Array<std::int32_t>&& triangles_of, Mesh& mesh,
           Monitor* monitor) {
  const std::int32_t count = exclusive_scan(std::span(triangles_of.begin(), triangles_of.end()));
  reuse_room(mesh.triangles, 3, count);
  const std::int64_t regions = std::ssize(reports);
  std::vector<SeamTable> tables(reports.size());
  std::vector<Array<std::int32_t>> place(reports.size());

  for_each_task(regions, [&](std::int64_t k) {
    RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    Array<std::int32_t>& own = place[static_cast<std::size_t>(k)];
    own = place_own(report, triangles_of, mesh.triangles);
    tables[static_cast<std::size_t>(k)] = SeamTable(seams_at(k, report.seams));
    for (const Seam& seam : report.seams)
      if (seam.home == k)
        tables[static_cast<std::size_t>(k)].enter(seam, own[seam.triangle]);
    step(monitor);
  });
  for_each_task(regions, [&](std::int64_t k) {
    for (const Seam& seam : reports[static_cast<std::size_t>(k)].seams)
      if (seam.home != k)
        place[static_cast<std::size_t>(k)][seam.triangle] =
            tables[static_cast<std::size_t>(seam.home)].count(seam);
  });
  reuse_room(mesh.neighbours, 3, count); // from here on, the reports have no vertices
  for_each_task(regions, [&](std::int64_t k) {
    RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    tables[static_cast<std::size_t>(k)].require_agreement();
    write_neighbours(report, place[static_cast<std::size_t>(k)], mesh.neighbours);
    report = {}; // freed here, by all threads
    place[static_cast<std::size_t>(k)] = {};
    tables[static_cast<std::size_t>(k)] = {};
    step(monitor);
  });
}

} // namespace calotte::delaunay_detail
