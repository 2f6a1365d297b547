// SPDX-License-Identifier: GPL-3.0-or-later
#include "oceans/fitted_rings.h"

#include "domain/arc_tree.h"
#include "domain/rings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace calotte::oceans_detail {
namespace {

using domain_detail::ArcTree, domain_detail::Rings;

/// A ring with the choice of its corners.
class FittedRing {
public:
  FittedRing(const FineRing& ring, const LineDistance& coast)
      : points_(ring.points), widths_(ring.widths), targets_(points_), is_corner_(points_.size()),
        on_coast_(points_.size()) {
    choose_corners();
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_corner_[i] != 0) {
        targets_[i] = coast.nearest(points_[i]);
        on_coast_[i] = norm(targets_[i] - points_[i]) <= ring.reaches[i];
      }
    spread_corners();
  }

  /// The points that are corners.
  std::vector<std::size_t> corners() const {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (is_corner_[i] != 0)
        chosen.push_back(i);
    return chosen;
  }

  Vec3 position(std::size_t point) const {
    return on_coast_[point] != 0 ? targets_[point] : points_[point];
  }

  double width(std::size_t point) const { return widths_[point]; }
  std::size_t next_corner(std::size_t corner) const {
    std::size_t next = after(corner);
    while (is_corner_[next] == 0)
      next = after(next);
    return next;
  }
  void leave_coast(std::size_t corner) { on_coast_[corner] = 0; }

  /// Brings the arc from a corner to the next one nearer to the fine ring. \returns whether it was
  /// another.
  bool refine(std::size_t corner) {
    const std::size_t next = next_corner(corner),
                      between = (next + points_.size() - corner - 1) % points_.size();
    if (on_coast_[corner] != 0 || on_coast_[next] != 0) {
      on_coast_[corner] = on_coast_[next] = 0;
      return true;
    }
    if (between == 0)
      return false;
    is_corner_[(corner + (between + 1) / 2) % points_.size()] = 1;
    return true;
  }

private:
  std::size_t after(std::size_t i) const { return i + 1 < points_.size() ? i + 1 : 0; }

  /// Corners at equal distances in local widths, and where the ring is far from the arcs between.
  void choose_corners() {
    constexpr double least = 4;
    const std::size_t count = points_.size();
    std::vector<double> along(count + 1); // in local widths
    for (std::size_t i = 0; i < count; ++i)
      along[i + 1] =
          along[i] + norm(points_[after(i)] - points_[i]) * 2 / (widths_[i] + widths_[after(i)]);
    const double corners =
        std::min(static_cast<double>(count), std::max(least, std::round(along[count])));
    std::vector<std::size_t> chosen;
    for (double k = 0; k < corners; ++k) {
      const auto next =
          std::lower_bound(along.begin(), along.end() - 1, k / corners * along[count]);
      chosen.push_back(
          std::min(static_cast<std::size_t>(next - along.begin()), points_.size() - 1));
    }
    chosen.push_back(count);
    for (std::size_t k = 0; k + 1 < chosen.size(); ++k) {
      is_corner_[chosen[k]] = 1;
      bend(along, chosen[k], chosen[k + 1]);
    }
  }

  /// Adds corners between two others, whose indices do not go around.
  void bend(const std::vector<double>& along, std::size_t from, std::size_t to) {
    constexpr double farthest = 0.25, nearest = 0.4; // from an arc, and from a corner
    const Vec3 &start = points_[from], &end = points_[to == points_.size() ? 0 : to];
    if (from + 1 >= to || exact_detail::same_direction(start, end))
      return;
    double most = farthest;
    std::size_t corner = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double away =
          std::sqrt(domain_detail::square_from({start, end}, points_[i])) / widths_[i];
      if (away > most && along[i] - along[from] > nearest && along[to] - along[i] > nearest) {
        most = away;
        corner = i;
      }
    }
    if (corner == from)
      return;
    is_corner_[corner] = 1;
    bend(along, from, corner);
    bend(along, corner, to);
  }

  /// Takes neighbours from the coast that would stand near each other there.
  void spread_corners() {
    constexpr double nearest = 0.3;
    const std::vector<std::size_t> chosen = corners();
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const std::size_t a = chosen[k], b = chosen[k + 1 < chosen.size() ? k + 1 : 0];
      if (norm(position(a) - position(b)) < nearest * widths_[a])
        on_coast_[a] = on_coast_[b] = 0;
    }
  }

  const std::vector<Vec3>& points_;
  const std::vector<double>& widths_;
  std::vector<Vec3> targets_;   ///< the nearest points of the coast, of corners
  std::vector<char> is_corner_; ///< by point
  std::vector<char> on_coast_;  ///< by point: whether it is moved to its target
};

/// The arcs of all rings, and the ring and the point at which each begins.
struct FittedArcs {
  Rings rings;
  std::vector<std::pair<std::size_t, std::size_t>> starts;
};

FittedArcs arcs_of(const std::vector<FittedRing>& rings) {
  FittedArcs all;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::vector<std::size_t> corners = rings[r].corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      all.rings.arcs.items.push_back(
          {rings[r].position(corners[k]),
           rings[r].position(corners[k + 1 < corners.size() ? k + 1 : 0])});
      all.starts.emplace_back(r, corners[k]);
    }
    all.rings.arcs.begin.push_back(static_cast<std::int32_t>(all.starts.size()));
  }
  return all;
}

/// Takes corners from the coast on both sides of land that is so narrow that the cells of a grid on
/// one side would be neighbours of those on the other.
void keep_necks(std::vector<FittedRing>& rings) {
  constexpr double narrow = 1.0 / 3; // of widths
  const FittedArcs all = arcs_of(rings);
  const ArcTree tree(all.rings.arcs.items);
  for (std::size_t k = 0; k < all.starts.size(); ++k) {
    FittedRing& ring = rings[all.starts[k].first];
    const std::size_t corner = all.starts[k].second;
    const Vec3 at = all.rings.arcs.items[k].from;
    const double reach = narrow * ring.width(corner);
    tree.visit([&](const curve_detail::Box3& box) { return square_from(box, at) < reach * reach; },
               [&](std::int32_t other) {
                 const Arc& arc = all.rings.arcs.items[static_cast<std::size_t>(other)];
                 if (exact_detail::same_direction(arc.from, at) ||
                     exact_detail::same_direction(arc.to, at) ||
                     domain_detail::square_from(arc, at) >= reach * reach)
                   return;
                 const auto [beside, start] = all.starts[static_cast<std::size_t>(other)];
                 ring.leave_coast(corner);
                 rings[beside].leave_coast(start);
                 rings[beside].leave_coast(rings[beside].next_corner(start));
               });
  }
}

/// The arcs that have no length, or meet others, in increasing order.
std::vector<std::int32_t> faults_of(const Rings& rings) {
  std::vector<std::int32_t> faults;
  const std::vector<Arc>& arcs = rings.arcs.items;
  for (std::int32_t k = 0; k < std::ssize(arcs); ++k)
    if (exact_detail::same_direction(rings.arc(k).from, rings.arc(k).to))
      faults.push_back(k);
  if (!faults.empty())
    return faults;
  for (const auto& [arc, other] : meetings(rings, ArcTree(arcs)))
    faults.insert(faults.end(), {arc, other});
  std::sort(faults.begin(), faults.end());
  faults.erase(std::unique(faults.begin(), faults.end()), faults.end());
  return faults;
}

} // namespace

Surface::Rings fitted_rings(const std::vector<FineRing>& fine, const LineDistance& coast) {
  std::vector<FittedRing> rings;
  for (const FineRing& ring : fine)
    rings.emplace_back(ring, coast);
  keep_necks(rings);
  FittedArcs all = arcs_of(rings);
  for (std::vector<std::int32_t> faults = faults_of(all.rings); !faults.empty();
       faults = faults_of(all.rings)) {
    bool changed = false;
    for (const std::int32_t fault : faults) {
      const auto [ring, corner] = all.starts[static_cast<std::size_t>(fault)];
      changed |= rings[ring].refine(corner);
    }
    require(changed, "two rings of the sea meet at the widths of the grid; give other widths");
    all = arcs_of(rings);
  }
  Surface::Rings result;
  for (const FittedRing& ring : rings) {
    const std::vector<std::size_t> corners = ring.corners();
    DoubleMatrix& columns = result.emplace_back(3, std::ssize(corners));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 at = ring.position(corners[k]);
      columns.col(static_cast<Eigen::Index>(k)) << at.x, at.y, at.z;
    }
  }
  return result;
}

} // namespace calotte::oceans_detail
