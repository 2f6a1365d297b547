// SPDX-License-Identifier: GPL-3.0-or-later
#include "unite.h"

#include <calotte/error.h>

#include <algorithm>
#include <atomic>
#include <bit>

namespace calotte::detail {
namespace {

using Face = Triangulation<Sphere>::Face;
using Vertex = Triangulation<Sphere>::Vertex;

int next(int i) { return i == 2 ? 0 : i + 1; }
int previous(int i) { return i == 0 ? 2 : i - 1; }

int lowest_index(Face face) {
  const std::int32_t a = face->vertex(0)->place.site, b = face->vertex(1)->place.site,
                     c = face->vertex(2)->place.site;
  return a < b ? (a < c ? 0 : 2) : (b < c ? 1 : 2);
}

/// A face from its lowest vertex on.
struct Report {
  Face face;
  int first;
  Vertex vertex(int i) const { return face->vertex((first + i) % 3); }
  Face neighbour(int i) const { return face->neighbor((first + i) % 3); }
  std::int32_t site(int i) const { return vertex(i)->place.site; }
};

/// The faces with an owned vertex in the order of RegionTriangles.
std::vector<Report> order_reports(Triangulation<Sphere>& triangulation,
                                  std::vector<std::int32_t>& begin) {
  std::vector<Report> own, foreign;
  own.reserve(2 * triangulation.members().size());
  begin.assign(triangulation.members().size() + 1, 0);
  triangulation.for_each_face([&](Face face) {
    if (Triangulation<Sphere>::is_infinite(face))
      return;
    const Report report{face, lowest_index(face)};
    if (report.vertex(0)->owned) {
      own.push_back(report);
      ++begin[static_cast<std::size_t>(report.vertex(0)->local) + 1];
    } else if (report.vertex(1)->owned || report.vertex(2)->owned) {
      foreign.push_back(report);
    }
  });
  for (std::size_t v = 1; v < begin.size(); ++v)
    begin[v] += begin[v - 1];
  std::vector<Report> ordered(own.size() + foreign.size());
  std::vector<std::int32_t> place = begin;
  for (const Report& report : own) {
    const auto v = static_cast<std::size_t>(report.vertex(0)->local);
    auto slot = static_cast<std::size_t>(place[v]++);
    for (; slot > static_cast<std::size_t>(begin[v]) && ordered[slot - 1].site(1) > report.site(1);
         --slot)
      ordered[slot] = ordered[slot - 1];
    ordered[slot] = report;
  }
  std::copy(foreign.begin(), foreign.end(), ordered.begin() + std::ssize(own));
  return ordered;
}

std::int8_t own_edges(const Report& report) {
  int bits = 0;
  for (int i = 0; i < 3; ++i) {
    const Vertex a = report.vertex(next(i)), b = report.vertex(previous(i));
    const Vertex lower = a->place.site < b->place.site ? a : b;
    bits |= static_cast<int>(lower->owned) << i;
  }
  return static_cast<std::int8_t>(bits);
}

} // namespace

RegionTriangles report_triangles(Triangulation<Sphere>& triangulation, const Sites& sites,
                                 const Array<std::int32_t>& owner,
                                 std::vector<std::int32_t>& triangles_of) {
  std::vector<std::int32_t> begin;
  const std::vector<Report> ordered = order_reports(triangulation, begin);
  RegionTriangles out;
  out.lowest_owned = begin.back();
  out.sites.resize(ordered.size());
  out.neighbours.resize(ordered.size());
  for (std::size_t t = 0; t < ordered.size(); ++t)
    ordered[t].face->number = static_cast<std::int32_t>(t);
  for (std::size_t t = 0; t < ordered.size(); ++t) {
    const Report& report = ordered[t];
    const std::array<Vertex, 3> v{report.vertex(0), report.vertex(1), report.vertex(2)};
    out.sites[t] = {v[0]->place.site, v[1]->place.site, v[2]->place.site};
    for (int i = 0; i < 3; ++i)
      out.neighbours[t][static_cast<std::size_t>(i)] = report.neighbour(i)->number;
    if (v[0]->owned && v[1]->owned && v[2]->owned)
      continue;
    const auto owner_of = [&](int i) {
      const auto local = static_cast<std::size_t>(v[static_cast<std::size_t>(i)]->local);
      return owner[triangulation.members()[local].rank];
    };
    const std::int32_t a = owner_of(0), b = owner_of(1), c = owner_of(2);
    out.seams.push_back(static_cast<std::int32_t>(t));
    out.reporters.push_back(static_cast<std::int8_t>(1 + (b != a) + (c != a && c != b)));
    out.own_edges.push_back(own_edges(report));
  }
  for (std::size_t v = 0; v < triangulation.members().size(); ++v)
    if (const Member& member = triangulation.members()[v]; member.owned)
      triangles_of[static_cast<std::size_t>(sites.id[member.rank])] = begin[v + 1] - begin[v];
  return out;
}

namespace {

/// The seam triangles by their sites, open addressing. Triangles stand in the mesh already when
/// they are entered, so that a slot holds but a place there and a count.
class SeamTable {
public:
  SeamTable(std::int64_t triangles, const Triangles& mesh)
      : mesh_(mesh), slots_(std::bit_ceil(static_cast<std::size_t>(2 * triangles + 1))) {}

  /// Enters a triangle at its place, reported once.
  void enter(const Triple& sites, std::int32_t place) {
    for (std::size_t s = hash(sites);; ++s) {
      std::int32_t empty = -1;
      if (slot(s).place.compare_exchange_strong(empty, place, std::memory_order_acq_rel)) {
        slot(s).reports.fetch_add(1, std::memory_order_relaxed);
        return;
      }
    }
  }

  /// Counts one more report of a triangle; its place, or -1 if nobody entered it.
  std::int32_t count(const Triple& sites) {
    Slot* found = find(sites);
    if (found == nullptr)
      return -1;
    found->reports.fetch_add(1, std::memory_order_relaxed);
    return found->place.load(std::memory_order_relaxed);
  }

  int reports(const Triple& sites) { return find(sites)->reports.load(std::memory_order_relaxed); }

private:
  struct Slot {
    std::atomic<std::int32_t> place{-1}, reports{0};
  };

  Slot& slot(std::size_t s) { return slots_[s & (slots_.size() - 1)]; }

  static std::size_t hash(const Triple& sites) {
    std::uint64_t h = 0;
    for (const std::int32_t s : sites)
      h = (h ^ static_cast<std::uint64_t>(s)) * 0x9E3779B97F4A7C15U; // Fibonacci hashing
    return h ^ h >> 32;
  }

  Slot* find(const Triple& sites) {
    for (std::size_t s = hash(sites);; ++s) {
      const std::int32_t place = slot(s).place.load(std::memory_order_acquire);
      if (place < 0)
        return nullptr;
      if (mesh_(0, place) == sites[0] && mesh_(1, place) == sites[1] && mesh_(2, place) == sites[2])
        return &slot(s);
    }
  }

  const Triangles& mesh_;
  std::vector<Slot> slots_;
};

[[noreturn]] void disagree(const Triple& sites) {
  throw Error(ErrorCode::internal, "regions disagree on the triangle of sites " +
                                       std::to_string(sites[0]) + ", " + std::to_string(sites[1]) +
                                       " and " + std::to_string(sites[2]) +
                                       ": please report this input as a bug");
}

/// Places of the triangles whose lowest site the region owns, which it writes.
Array<std::int32_t> place_own(const RegionTriangles& report,
                              const std::vector<std::int32_t>& first_of, Triangles& out) {
  Array<std::int32_t> place(std::ssize(report.sites));
  std::int32_t lowest = -1, next_place = 0;
  for (std::int64_t t = 0; t < report.lowest_owned; ++t) {
    const Triple& sites = report.sites[static_cast<std::size_t>(t)];
    if (sites[0] != lowest) {
      lowest = sites[0];
      next_place = first_of[static_cast<std::size_t>(lowest)];
    }
    for (int i = 0; i < 3; ++i)
      out(i, next_place) = sites[static_cast<std::size_t>(i)];
    place[t] = next_place++;
  }
  return place;
}

/// Neighbours across the edges that the region answers for: all of a triangle with one owner, those
/// of a seam triangle whose lower site it owns.
void write_neighbours(const RegionTriangles& report, const Array<std::int32_t>& place,
                      Triangles& out) {
  const auto write = [&](std::int64_t t, int bits) {
    const Triple& neighbours = report.neighbours[static_cast<std::size_t>(t)];
    for (int i = 0; i < 3; ++i)
      if (bits >> i & 1) {
        const std::int32_t across = neighbours[static_cast<std::size_t>(i)];
        out(i, place[t]) = across < 0 ? -1 : place[across];
      }
  };
  std::int64_t t = 0;
  for (std::size_t s = 0; s < report.seams.size(); ++s) {
    for (; t < report.seams[s]; ++t)
      write(t, 7);
    write(t++, report.own_edges[s]);
  }
  for (; t < std::ssize(report.sites); ++t)
    write(t, 7);
}

} // namespace

void unite(const std::vector<RegionTriangles>& reports, std::vector<std::int32_t>& triangles_of,
           Mesh& mesh) {
  const std::int32_t count = exclusive_scan(std::span(triangles_of));
  mesh.triangles.resize(3, count);
  mesh.neighbours.resize(3, count);
  std::int64_t seams = 0;
  for (const RegionTriangles& report : reports)
    seams += std::ssize(report.seams);
  SeamTable table(seams, mesh.triangles);
  std::vector<Array<std::int32_t>> place(reports.size());
  const std::int64_t regions = std::ssize(reports);

  for_each_task(regions, [&](std::int64_t k) {
    const RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    Array<std::int32_t>& own = place[static_cast<std::size_t>(k)];
    own = place_own(report, triangles_of, mesh.triangles);
    for (const std::int32_t t : report.seams)
      if (t < report.lowest_owned)
        table.enter(report.sites[static_cast<std::size_t>(t)], own[t]);
  });
  for_each_task(regions, [&](std::int64_t k) {
    const RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    for (const std::int32_t t : report.seams) {
      const Triple& sites = report.sites[static_cast<std::size_t>(t)];
      if (t < report.lowest_owned)
        continue;
      const std::int32_t found = table.count(sites);
      if (found < 0)
        disagree(sites);
      place[static_cast<std::size_t>(k)][t] = found;
    }
  });
  for_each_task(regions, [&](std::int64_t k) {
    const RegionTriangles& report = reports[static_cast<std::size_t>(k)];
    for (std::size_t s = 0; s < report.seams.size(); ++s) {
      const Triple& sites = report.sites[static_cast<std::size_t>(report.seams[s])];
      if (table.reports(sites) != report.reporters[s])
        disagree(sites);
    }
    write_neighbours(report, place[static_cast<std::size_t>(k)], mesh.neighbours);
  });
}

} // namespace calotte::detail
