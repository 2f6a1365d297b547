// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/arc_tree.h"
#include "domain/rings.h"
#include "domain/written_rings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

namespace calotte::domain_detail {
namespace {

// ---- Arcs in both directions

/// The arcs of rings, for the removal of those that occur in both directions.
class Joiner {
public:
  explicit Joiner(std::vector<WrittenRing> rings) : rings_(std::move(rings)) {}

  std::vector<WrittenRing> join() {
    mark_pairs();
    std::vector<WrittenRing> result;
    for (std::size_t r = 0; r < rings_.size(); ++r)
      if (std::find(paired_[r].begin(), paired_[r].end(), true) == paired_[r].end())
        result.push_back(rings_[r]);
      else
        list(r);
    while (!starts_.empty())
      result.push_back(next_ring());
    return result;
  }

private:
  using Point = std::array<double, 3>;
  struct Start {
    std::size_t ring, corner; ///< the corner where an arc starts
  };

  Point start_of(const Start& arc) const {
    const Vec3& p = rings_[arc.ring].corners[arc.corner];
    return {p.x, p.y, p.z};
  }
  Point end_of(const Start& arc) const {
    return start_of({arc.ring, (arc.corner + 1) % rings_[arc.ring].corners.size()});
  }

  void mark(const Start& arc) { paired_[arc.ring][arc.corner] = true; }

  void mark_pairs() {
    std::map<std::pair<Point, Point>, std::vector<Start>> unpaired;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      paired_.emplace_back(rings_[r].corners.size(), false);
      for (std::size_t c = 0; c < rings_[r].corners.size(); ++c) {
        const Start arc{r, c};
        const auto opposite = unpaired.find({end_of(arc), start_of(arc)});
        if (opposite == unpaired.end() || opposite->second.empty()) {
          unpaired[{start_of(arc), end_of(arc)}].push_back(arc);
          continue;
        }
        mark(arc);
        mark(opposite->second.back());
        opposite->second.pop_back();
      }
    }
  }

  /// Lists the remaining arcs of a ring by their starts.
  void list(std::size_t r) {
    for (std::size_t c = 0; c < rings_[r].corners.size(); ++c)
      if (!paired_[r][c])
        starts_[start_of({r, c})].push_back({r, c});
  }

  /// As many arcs start at a point as end there: a path ends where it began.
  WrittenRing next_ring() {
    const auto first = starts_.begin();
    const Point begin = first->first;
    WrittenRing ring{
        {}, rings_[first->second.back().ring].origin + " without edges in common with others"};
    Point at = begin;
    do {
      const auto here = starts_.find(at);
      const Start arc = here->second.back();
      here->second.pop_back();
      if (here->second.empty())
        starts_.erase(here);
      ring.corners.push_back(rings_[arc.ring].corners[arc.corner]);
      at = end_of(arc);
    } while (at != begin);
    return ring;
  }

  std::vector<WrittenRing> rings_;
  std::vector<std::vector<bool>> paired_; ///< by ring and corner: the arc that starts there
  std::map<Point, std::vector<Start>> starts_;
};

// ---- Cuts whose sides differ by rounding

/// Finds corners that are near another corner, or near an edge, and moves them onto it.
class Snapper {
public:
  explicit Snapper(const Rings& rings)
      : rings_(rings), tree_(rings.arcs.items), cuts_(rings.arcs.items.size()) {
    same_as_.resize(rings.arcs.items.size());
    std::iota(same_as_.begin(), same_as_.end(), 0);
  }

  /// False if no corner is near another edge, or if a large part of the corners are near each
  /// other: that is no cut, and the search would take long.
  bool search() {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(rings_.arcs.items.size()); ++i) {
      compare(i);
      if (near_ > 1000 + 64 * std::int64_t{i})
        return false;
    }
    return near_ > 0;
  }

  /// The rings after the corners that were found are moved.
  std::vector<WrittenRing> snapped(std::vector<WrittenRing> rings) {
    for (std::size_t r = 0; r < rings.size(); ++r) {
      rings[r].corners.clear();
      for (std::int32_t e = rings_.arcs.begin[r]; e < rings_.arcs.begin[r + 1]; ++e)
        append(e, rings[r].corners);
      drop_repeated(rings[r].corners);
    }
    return rings;
  }

private:
  /// The corner where an arc begins; corners and the arcs from them have the same indices.
  const Vec3& corner(std::int32_t i) const { return arc(i).from; }
  const Arc& arc(std::int32_t e) const { return rings_.arc(e); }

  std::int32_t next(std::int32_t e) const { return next_in_list(rings_.arcs, e); }

  static double square(const Vec3& a, const Vec3& b) { return dot(a - b, a - b); }

  std::int32_t representative(std::int32_t i) const {
    while (same_as_[static_cast<std::size_t>(i)] != i)
      i = same_as_[static_cast<std::size_t>(i)];
    return i;
  }

  void unite(std::int32_t i, std::int32_t j) {
    const auto [low, high] = std::minmax({representative(i), representative(j)});
    same_as_[static_cast<std::size_t>(high)] = low;
  }

  void compare(std::int32_t i) {
    constexpr double reach = nearby * nearby;
    const Vec3& point = corner(i);
    tree_.visit([&](const Box3& box) { return square_from(box, point) <= reach; },
                [&](std::int32_t e) {
                  if (e == i || next(e) == i ||
                      !(domain_detail::square_from(arc(e), point) <= reach))
                    return;
                  ++near_;
                  if (square(point, arc(e).from) <= reach)
                    unite(i, e);
                  else if (square(point, arc(e).to) <= reach)
                    unite(i, next(e));
                  else
                    cuts_[static_cast<std::size_t>(e)].push_back(i);
                });
  }

  void append(std::int32_t e, std::vector<Vec3>& corners) {
    std::vector<std::int32_t>& cuts = cuts_[static_cast<std::size_t>(e)];
    std::sort(cuts.begin(), cuts.end(), [&](std::int32_t i, std::int32_t j) {
      return square(corner(i), arc(e).from) < square(corner(j), arc(e).from);
    });
    corners.push_back(corner(representative(e)));
    for (const std::int32_t i : cuts)
      corners.push_back(corner(representative(i)));
  }

  const Rings& rings_;
  const ArcTree tree_;
  std::vector<std::vector<std::int32_t>> cuts_; ///< by arc: corners on it
  std::vector<std::int32_t> same_as_;           ///< by corner: itself, or one before it
  std::int64_t near_ = 0;                       ///< pairs of a corner and an edge
};

bool any_meet(const Rings& rings) { return first_meeting(rings, ArcTree(rings.arcs.items)) >= 0; }

} // namespace

std::vector<WrittenRing> joined(std::vector<WrittenRing> rings) {
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (const std::int64_t corners = std::ssize(rings[r].corners); corners < 3)
      refuse_region(few_corners_fault(rings[r].origin, corners), static_cast<std::int64_t>(r));
  const std::vector<WrittenRing> exact = Joiner(std::move(rings)).join();
  return with_origins(exact, [&] {
    const Rings arcs = rings_of(corners_of(exact));
    Snapper snapper(arcs);
    if (!snapper.search())
      return exact;
    const std::vector<WrittenRing> snapped = Joiner(snapper.snapped(exact)).join();
    return snapped.empty() || any_meet(rings_of(corners_of(snapped))) ? exact : snapped;
  });
}

} // namespace calotte::domain_detail
