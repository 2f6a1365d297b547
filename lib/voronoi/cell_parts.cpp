// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/cell_parts.h"

#include "base/points.h"
#include "exact/space.h"
#include "voronoi/groups.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace calotte::voronoi_detail {
namespace {

/// A closed chain of sides of one cell, by index.
using Loop = std::vector<std::int64_t>;

template <Space S> class Parts {
public:
  Parts(const S& space, const Points3& sites, const Points3& vertices,
        std::vector<ClippedSide>& sides)
      : space_(space), sites_(sites), vertices_(vertices), sides_(sides) {}

  /// Joins parts until all cells consist of one. \returns whether it changed something.
  bool join_once() {
    begin_ = sort_sides(sites_.cols(), sides_);
    bool changed = false;
    for (std::int32_t cell = 0; cell < sites_.cols(); ++cell) {
      const std::vector<Loop> loops = loops_of(cell);
      if (loops.size() < 2)
        continue;
      const std::size_t own = own_loop(cell, loops);
      for (std::size_t k = 0; k < loops.size(); ++k)
        if (k != own)
          changed = remove(cell, loops[k]) || changed;
    }
    std::erase_if(sides_, [](const ClippedSide& side) { return side.cell < 0; });
    return changed;
  }

  const CoastChanges& changes() const { return changes_; }

private:
  ClippedSide& side(std::int64_t s) { return sides_[static_cast<std::size_t>(s)]; }
  const ClippedSide& side(std::int64_t s) const { return sides_[static_cast<std::size_t>(s)]; }

  /// The closed chains of a cell's sides; none if a side has no successor.
  std::vector<Loop> loops_of(std::int32_t cell) const {
    const std::int64_t first = begin_[static_cast<std::size_t>(cell)],
                       last = begin_[static_cast<std::size_t>(cell) + 1];
    std::vector<std::uint8_t> used(static_cast<std::size_t>(last - first));
    std::vector<Loop> loops;
    for (std::int64_t s = first; s < last; ++s) {
      Loop loop;
      for (std::int64_t at = s;
           at >= 0 && side(at).cell == cell && used[static_cast<std::size_t>(at - first)] == 0;
           at = side_from(sides_, begin_, cell, side(at).to)) {
        used[static_cast<std::size_t>(at - first)] = 1;
        loop.push_back(at);
      }
      if (loop.empty())
        continue;
      if (side(loop.back()).to != side(loop.front()).from)
        return {};
      loops.push_back(std::move(loop));
    }
    return loops;
  }

  /// The angle under which a loop is seen from the site, counter-clockwise: 2 pi around it, 0 if
  /// the site is outside.
  double angle_around(std::int32_t cell, const Loop& loop) const {
    const Vec3 &site = column(sites_, cell), up = S::up(site);
    double sum = 0;
    for (const std::int64_t s : loop) {
      const Vec3 from = column(vertices_, side(s).from) - site,
                 to = column(vertices_, side(s).to) - site;
      sum += std::atan2(dot(up, cross(from, to)), dot(from, to) - dot(from, up) * dot(to, up));
    }
    return sum;
  }

  double area_of(std::int32_t cell, const Loop& loop) const {
    double sum = 0;
    for (const std::int64_t s : loop)
      sum += space_.area(column(sites_, cell), column(vertices_, side(s).from),
                         column(vertices_, side(s).to));
    return sum;
  }

  /// The loop around the site.
  std::size_t own_loop(std::int32_t cell, const std::vector<Loop>& loops) const {
    std::size_t own = 0;
    double most = -1;
    for (std::size_t k = 0; k < loops.size(); ++k)
      if (const double angle = angle_around(cell, loops[k]); angle > most) {
        most = angle;
        own = k;
      }
    return own;
  }

  /// The cell across all inner sides of a loop; none if there is no such side or no single cell.
  std::int32_t only_neighbour(const Loop& loop) const {
    std::int32_t only = none;
    for (const std::int64_t s : loop) {
      const std::int32_t beyond = side(s).beyond;
      if (beyond >= 0 && only >= 0 && beyond != only)
        return none;
      only = std::max(only, beyond);
    }
    return only;
  }

  /// Removes a loop from its cell. \returns false if a loop beside it was changed in this pass.
  bool remove(std::int32_t cell, const Loop& loop) {
    std::vector<std::int64_t> across; // by side; none on the boundary
    for (const std::int64_t s : loop) {
      const ClippedSide& own = side(s);
      across.push_back(own.beyond < 0 ? none : opposite(own));
      if (own.cell != cell || (own.beyond >= 0 && across.back() < 0))
        return true; // changed already; the next pass looks again
    }
    const double area = area_of(cell, loop);
    const bool on_boundary =
        std::all_of(across.begin(), across.end(), [](auto s) { return s < 0; });
    const std::int32_t only = only_neighbour(loop);
    if (on_boundary && area < 0) {
      ++changes_.removed_islands;
      changes_.island_area -= area;
    } else if (only >= 0) {
      ++changes_.merged_parts;
    } else {
      ++changes_.removed_parts;
      changes_.removed_area += area;
    }
    for (std::size_t k = 0; k < loop.size(); ++k) {
      ClippedSide& own = side(loop[k]);
      if (only >= 0 && own.beyond < 0) {
        own.cell = only;
        continue;
      }
      own.cell = none;
      if (across[k] >= 0 && only >= 0)
        side(across[k]).cell = none;
      else if (across[k] >= 0)
        side(across[k]).beyond = none;
    }
    return true;
  }

  /// The same side seen from the cell beyond; none if that was changed.
  std::int64_t opposite(const ClippedSide& of) const {
    const std::int64_t s = side_from(sides_, begin_, of.beyond, of.to);
    return s >= 0 && side(s).cell == of.beyond && side(s).to == of.from && side(s).beyond == of.cell
               ? s
               : none;
  }

  S space_;
  const Points3 &sites_, &vertices_;
  std::vector<ClippedSide>& sides_;
  std::vector<std::int64_t> begin_;
  CoastChanges changes_;
};

} // namespace

std::vector<std::int64_t> sort_sides(std::int64_t cells, std::vector<ClippedSide>& sides) {
  return sort_in_groups(
      cells, [](const ClippedSide& side) { return side.cell; },
      [](const ClippedSide& a, const ClippedSide& b) {
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
      },
      sides);
}

std::int64_t side_from(const std::vector<ClippedSide>& sides,
                       const std::vector<std::int64_t>& begin, std::int32_t cell,
                       std::int32_t vertex) {
  const auto first = sides.begin() + begin[static_cast<std::size_t>(cell)],
             last = sides.begin() + begin[static_cast<std::size_t>(cell) + 1];
  const auto side = std::lower_bound(
      first, last, vertex, [](const ClippedSide& s, std::int32_t v) { return s.from < v; });
  return side != last && side->from == vertex ? side - sides.begin() : none;
}

CoastChanges join_parts(const Surface& surface, const Points3& sites, const Points3& vertices,
                        std::vector<ClippedSide>& sides) {
  return in_space_of(surface, [&](const auto& space) {
    Parts parts(space, sites, vertices, sides);
    constexpr int most_passes = 16; // a part may become one of a part
    for (int pass = 0; pass < most_passes && parts.join_once(); ++pass)
      ;
    return parts.changes();
  });
}

} // namespace calotte::voronoi_detail
