// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/rings.h"

#include "base/first_fault.h"
#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"

#include <algorithm>
#include <limits>

namespace calotte::domain_detail {
namespace {

void append_arc(const Points3& corners, std::int64_t r, std::int64_t i, std::vector<Arc>& arcs) {
  const Arc arc{as_unit(column(corners, i)), as_unit(column(corners, (i + 1) % corners.cols()))};
  if (same_direction(arc.from, arc.to))
    refuse_region(corner_name(r, i) + " and the next are one place; leave one of them out", r);
  if (same_direction(arc.from, -arc.to))
    refuse_region(corner_name(r, i) +
                      " and the next are opposite, and half circles in every direction join them; "
                      "add a corner between them",
                  r);
  arcs.push_back(arc);
}

void append_ring(const Points3& corners, std::int64_t r, std::vector<Arc>& arcs) {
  const Eigen::Index count = corners.cols();
  if (count < 3)
    refuse_region(few_corners_fault(message("ring {}", r), count), r);
  require_directions(corners, r);
  for (Eigen::Index i = 0; i < count; ++i)
    append_arc(corners, r, i, arcs);
}

/// True if two arcs share more than simple rings allow.
bool conflict(const Rings& rings, std::int32_t e, std::int32_t f) {
  const Arc &a = rings.arc(e), &b = rings.arc(f);
  if (e == f)
    return false;
  // Consecutive arcs always meet. The exact test for that would be slow.
  if (f == next_in_list(rings.arcs, e))
    return fold(a, b);
  return e == next_in_list(rings.arcs, f) ? fold(b, a) : meet(a, b);
}

constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();

/// The first arc that conflicts with a given one, or none.
std::int32_t first_conflict(const Rings& rings, const ArcTree& tree, std::int32_t e) {
  std::int32_t first = none;
  const Box3 own = box_of(rings.arc(e));
  tree.visit([&](const Box3& box) { return overlap(box, own); },
             [&](std::int32_t f) {
               if (f < first && conflict(rings, e, f))
                 first = f;
             });
  return first;
}

} // namespace

void refuse_region(const std::string& what, std::int64_t ring) {
  refuse("the region: " + what, ring);
}

void require_directions(const Points3& corners, std::int64_t r) {
  for (Eigen::Index i = 0; i < corners.cols(); ++i)
    if (!corners.col(i).allFinite() || (corners.col(i).array() == 0).all())
      refuse_region(
          corner_name(r, i) + " is no direction; give three finite numbers that are not all 0", r);
}

Rings rings_of(const Surface::Rings& corners) {
  Rings rings;
  for (std::size_t r = 0; r < corners.size(); ++r) {
    append_ring(corners[r], static_cast<std::int64_t>(r), rings.arcs.items);
    require_count(std::ssize(rings.arcs.items), 3, "the region's number of corners");
    rings.arcs.begin.push_back(static_cast<std::int32_t>(rings.arcs.items.size()));
  }
  return rings;
}

std::int64_t first_meeting(const Rings& rings, const ArcTree& tree) {
  FirstFault fault;
  for_each_block(std::ssize(rings.arcs.items),
                 [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                   for (std::int64_t e = begin; e != end; ++e)
                     if (first_conflict(rings, tree, static_cast<std::int32_t>(e)) != none) {
                       fault.at(e);
                       return;
                     }
                 });
  return fault.index();
}

const Rings& simple(const Rings& rings, const ArcTree& tree) {
  const std::int64_t found = first_meeting(rings, tree);
  if (found < 0)
    return rings;
  const auto e = static_cast<std::int32_t>(found);
  refuse_region(meeting_fault(rings.arcs, e, first_conflict(rings, tree, e)),
                list_of(rings.arcs, e));
}

std::vector<std::pair<std::int32_t, std::int32_t>> meetings(const Rings& rings,
                                                            const ArcTree& tree) {
  std::vector<std::int32_t> first(rings.arcs.items.size());
  for_each_block(std::ssize(first), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e != end; ++e)
      first[static_cast<std::size_t>(e)] =
          first_conflict(rings, tree, static_cast<std::int32_t>(e));
  });
  std::vector<std::pair<std::int32_t, std::int32_t>> met;
  for (std::size_t e = 0; e < first.size(); ++e)
    if (first[e] != none)
      met.emplace_back(static_cast<std::int32_t>(e), first[e]);
  return met;
}

} // namespace calotte::domain_detail
