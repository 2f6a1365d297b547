// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/cull.h"

#include "delaunay/conflict_query.h"
#include "delaunay/coverage.h"
#include "delaunay/patches.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace calotte::delaunay_detail {
namespace {

template <class Face> bool has_owned_vertex(Face face) {
  return face->vertex(0)->owned() || face->vertex(1)->owned() || face->vertex(2)->owned();
}

/// Radius of a ball around the centre that the region covers, at most that of the domain.
double inner_radius(const Vec3& centre, const std::vector<HalfSpace>& covered, double diameter) {
  double radius = diameter;
  for (const HalfSpace& h : covered)
    radius = std::min(radius, h.offset - dot(centre, h.normal));
  return radius;
}

/// Distance of x to the rim of the covered part; far inside, a lower bound.
double measure_depth(const Vec3& x, const Vec3& centre, double inner,
                     const std::vector<HalfSpace>& covered, double diameter) {
  double depth = inner - norm(x - centre);
  if (depth > inner / 4)
    return depth;
  depth = diameter;
  for (const HalfSpace& h : covered)
    depth = std::min(depth, h.offset - dot(x, h.normal));
  return depth;
}

/// Certifies a face by the cull test.
/// \return true if the face has an owned vertex and is not certified.
template <class Chart>
bool is_open(FaceOf<Chart> face, const std::vector<HalfSpace>& covered, CullCounts& counts) {
  if (face->certified || !has_owned_vertex(face))
    return false;
  if (Triangulation<Chart>::is_infinite(face) ||
      !(is_within_depth(face) || is_covered(face, covered)))
    return true;
  face->certified = true;
  ++counts.by_cull;
  return false;
}

/// The faces that are not yet certified.
template <class Chart>
std::vector<FaceOf<Chart>> open_faces(Triangulation<Chart>& triangulation,
                                      const std::vector<HalfSpace>& covered, CullCounts& counts) {
  std::vector<FaceOf<Chart>> open;
  triangulation.for_each_face([&](FaceOf<Chart> face) {
    if (is_open<Chart>(face, covered, counts))
      open.push_back(face);
  });
  return open;
}

/// Inserts sites.
/// \return the open faces among those around the sites, which are the only new ones.
template <class Chart>
std::vector<FaceOf<Chart>> insert_all(const std::vector<std::int32_t>& ranks,
                                      Triangulation<Chart>& triangulation,
                                      const std::vector<HalfSpace>& covered, CullCounts& counts) {
  std::vector<FaceOf<Chart>> around;
  for (const std::int32_t rank : ranks) {
    triangulation.insert({rank, Member::not_owned});
    const auto star = triangulation.last_star();
    around.insert(around.end(), star.begin(), star.end());
  }
  counts.inserted += std::ssize(ranks);
  // A later star may have replaced a face of an earlier one. The order is that of the insertions;
  // by address, the counts of predicates would differ from run to run.
  std::vector<FaceOf<Chart>> open;
  constexpr std::int32_t listed = 0, unlisted = -1;
  for (const FaceOf<Chart> face : around)
    if (face->number == unlisted && is_open<Chart>(face, covered, counts)) {
      face->number = listed;
      open.push_back(face);
    }
  for (const FaceOf<Chart> face : open)
    face->number = unlisted;
  return open;
}

/// True if the triangle belongs to a closed mesh: it is finite, and its circumcap is below a
/// hemisphere. Larger empty caps are the far side of sites within a hemisphere.
bool may_stand(FaceOf<SphereChart> face, const Sites& sites) {
  if (Triangulation<SphereChart>::is_infinite(face))
    return false;
  const auto given = [&](int i) { return sites.given(face->vertex(i)->point.site); };
  return orientation(given(0), given(1), given(2)) > 0;
}
bool may_stand(FaceOf<PlaneChart>, const Sites&) { return true; }

/// Number of open faces beyond which they are first tested in patches. Random sites leave some 5 in
/// a region of 20 000; a cluster, at least those around it.
constexpr std::size_t many_open = 16;

/// Certifies open faces in patches; returns those that are still open.
template <class Chart>
std::vector<FaceOf<Chart>>
certify_patches(Triangulation<Chart>& triangulation, const Sites& sites,
                const std::vector<Run>& members, const std::vector<HalfSpace>& covered,
                const std::vector<FaceOf<Chart>>& open, CullCounts& counts) {
  Patches<Chart> patches(triangulation, sites, members, covered);
  for (const FaceOf<Chart> face : open) {
    if (patches.is_marked(face))
      continue;
    const std::vector<FaceOf<Chart>>& patch = patches.around(face);
    if (!std::all_of(patch.begin(), patch.end(),
                     [&](FaceOf<Chart> of_patch) { return may_stand(of_patch, sites); }))
      continue;
    for (const FaceOf<Chart> of_patch : patch)
      of_patch->certified = has_owned_vertex(of_patch);
  }
  std::vector<FaceOf<Chart>> left;
  std::copy_if(open.begin(), open.end(), std::back_inserter(left),
               [](FaceOf<Chart> face) { return !face->certified; });
  counts.by_query += std::ssize(open) - std::ssize(left);
  return left;
}

/// Undecided predicates and insertions per member beyond which triangulating the set as a whole is
/// cheaper: the caps of lattices need a few, clusters that are hard to certify thousands.
constexpr std::int64_t effort = 16;

/// Number of tests of a query that cost as much as one undecided predicate. If most sites lie along
/// a great circle, each circumcap passes all of them, and the number of tests grows with the square
/// of the number of sites.
constexpr std::int64_t looks_an_effort = 4;

} // namespace

template <class Chart>
CALOTTE_ALL_INSTRUCTIONS std::vector<Member> gather(const Sites& sites, const Regions& regions,
                                                    std::int32_t k) {
  const auto region = static_cast<std::size_t>(k);
  const std::vector<HalfSpace>& covered = regions.covered[region];
  const Vec3& centre = regions.centres[region];
  const double inner = inner_radius(centre, covered, Chart::diameter);
  std::vector<Member> members;
  std::size_t count = 0;
  for (const Run& run : regions.members[region])
    count += static_cast<std::size_t>(run.end - run.begin);
  members.reserve(count);
  for (const Run& run : regions.members[region])
    for (std::int32_t r = run.begin; r != run.end; ++r) {
      if (regions.owner[r] != k) {
        members.push_back({r, Member::not_owned});
        continue;
      }
      const double depth = measure_depth(sites.unit[r], centre, inner, covered, Chart::diameter);
      // Rounded down, by more than the rounding of half-spaces: 1e-14.
      members.push_back({r, static_cast<float>(std::max(0.999999 * depth - 1e-14, 0.0))});
    }
  return members;
}

template <class Chart>
CALOTTE_ALL_INSTRUCTIONS bool certify(Triangulation<Chart>& triangulation, const Sites& sites,
                                      const Regions& regions, std::int32_t k, CullCounts& counts) {
  const std::vector<HalfSpace>& covered = regions.covered[static_cast<std::size_t>(k)];
  ConflictQuery<Chart> query(triangulation, sites, regions.members[static_cast<std::size_t>(k)]);
  const std::int64_t filtered = triangulation.chart().counts().filtered;
  const std::int64_t patience = effort * (std::ssize(triangulation.members()) + 1000);
  std::vector<FaceOf<Chart>> open = open_faces(triangulation, covered, counts);
  if (open.size() > many_open)
    open = certify_patches(triangulation, sites, regions.members[static_cast<std::size_t>(k)],
                           covered, open, counts);
  while (!open.empty()) {
    std::vector<std::int32_t> missing;
    for (const FaceOf<Chart> face : open) {
      const std::vector<std::int32_t>& found = query.run(face);
      if (counts.inserted + triangulation.chart().counts().filtered - filtered +
              query.looks() / looks_an_effort >
          patience)
        return false;
      missing.insert(missing.end(), found.begin(), found.end());
      if (!found.empty())
        continue;
      if (!may_stand(face, sites)) {
        counts.hull = true;
        return false;
      }
      face->certified = true;
      counts.by_query += !triangulation.is_infinite(face);
    }
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    open = insert_all(missing, triangulation, covered, counts); // their results are no longer valid
  }
  return true;
}

template <class Chart> void certify_all(Triangulation<Chart>& triangulation) {
  triangulation.for_each_face([](FaceOf<Chart> face) { face->certified = true; });
}

template std::vector<Member> gather<SphereChart>(const Sites&, const Regions&, std::int32_t);
template std::vector<Member> gather<PlaneChart>(const Sites&, const Regions&, std::int32_t);
template bool certify(Triangulation<SphereChart>&, const Sites&, const Regions&, std::int32_t,
                      CullCounts&);
template bool certify(Triangulation<PlaneChart>&, const Sites&, const Regions&, std::int32_t,
                      CullCounts&);
template void certify_all(Triangulation<SphereChart>&);
template void certify_all(Triangulation<PlaneChart>&);

} // namespace calotte::delaunay_detail
