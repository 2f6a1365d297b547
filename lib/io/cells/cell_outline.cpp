// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/cell_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace calotte::io_detail {
namespace {

constexpr double cut_longitude = 180; ///< longitude of the cut, up to whole turns

using LonLatRing = std::vector<LonLat>;

/// A point whose longitude continues beyond 180 degrees. The number of turns is separate, so that
/// the longitude of a corner has the same bits in all cells with that corner.
struct TurnedPoint {
  LonLat lonlat;
  int turn = 0;

  double longitude(int less = 0) const { return lonlat.longitude + 360 * (turn - less); }
};

using TurnedRing = std::vector<TurnedPoint>;

bool at_pole(const Vec3& p) { return norm(Vec3{p.x, p.y, 0}) < 1e-12 * std::abs(p.z); }

/// A ring whose longitudes continue beyond 180 degrees, from its first corner around to the first
/// corner again.
class Unrolled {
public:
  explicit Unrolled(const std::vector<Vec3>& corners) {
    const auto start = std::find_if_not(corners.begin(), corners.end(), at_pole);
    if (start == corners.end())
      return;
    std::vector<Vec3> ring(start, corners.end());
    ring.insert(ring.end(), corners.begin(), start);
    ring.push_back(ring.front());
    points_.push_back({lonlat_of(ring.front())});
    for (std::size_t last = 0, next = 1; next < ring.size(); ++next)
      if (!at_pole(ring[next])) {
        append(ring[last], ring[next], next - last > 1 ? ring[last + 1] : ring[last] + ring[next],
               next - last > 1);
        last = next;
      }
  }

  /// The points of the ring. The first one is repeated at the end, one turn away if the ring
  /// surrounds a pole.
  const TurnedRing& points() const { return points_; }

  /// Number of turns: 1 around the north pole, -1 around the south pole, otherwise 0.
  int turns() const { return points_.empty() ? 0 : points_.back().turn - points_.front().turn; }

private:
  /// Appends b after a; neither is a pole. If `between` is a pole, or if the edge passes through a
  /// pole, the path goes through that pole.
  void append(const Vec3& a, const Vec3& b, const Vec3& between, bool pole) {
    const LonLat end = lonlat_of(b);
    double step = std::remainder(end.longitude - lonlat_of(a).longitude, 360.0);
    const TurnedPoint from = points_.back();
    if (pole || std::abs(step) > 180 - 1e-10) {
      // Seen from the pole the cell is a wedge to the west of the meridian that runs north.
      const double edge = std::copysign(90.0, between.z);
      if (std::abs(step) > 180 - 1e-10)
        step = -std::copysign(step, edge);
      push({{from.lonlat.longitude, edge}, from.turn});
      push({{end.longitude, edge}, find_turn(from, step, end)});
    }
    push({end, find_turn(from, step, end)}, &a, &b);
  }

  /// The turn of a corner at a step in longitude from a point.
  static int find_turn(const TurnedPoint& from, double step, const LonLat& corner) {
    return static_cast<int>(std::lround((from.longitude() + step - corner.longitude) / 360));
  }

  /// Adds a point, and before it one on the cut, if the path crosses it: on the arc from a to b, or
  /// at a pole.
  void push(const TurnedPoint& next, const Vec3* a = nullptr, const Vec3* b = nullptr) {
    const double last = points_.back().longitude(), low = std::min(last, next.longitude()),
                 high = std::max(last, next.longitude());
    const int turn = static_cast<int>(std::ceil((low - cut_longitude) / 360));
    if (low < cut_longitude + 360 * turn && cut_longitude + 360 * turn < high)
      points_.push_back(
          {{cut_longitude, a ? lonlat_of(std::abs(b->y) * *a + std::abs(a->y) * *b).latitude
                             : next.lonlat.latitude},
           turn});
    points_.push_back(next);
  }

  TurnedRing points_;
};

/// The part of a ring between two cuts, `turn` turns to the east, moved back by these turns.
LonLatRing between_cuts(const TurnedRing& ring, int turn) {
  LonLatRing part;
  for (const TurnedPoint& point : ring)
    if (const double longitude = point.longitude(turn); std::abs(longitude) <= cut_longitude)
      part.push_back({longitude, point.lonlat.latitude});
  return part;
}

/// Closes a ring around a pole: it starts and ends at the cut, and continues along the edge of the
/// pole.
LonLatRing around_pole(TurnedRing ring, int turns) {
  ring.pop_back();
  const auto start = std::find_if(ring.begin(), ring.end(), [](const TurnedPoint& point) {
    return std::abs(point.lonlat.longitude) == cut_longitude;
  });
  for (auto point = ring.begin(); point != start; ++point)
    point->turn += turns;
  std::rotate(ring.begin(), start, ring.end());
  const double begin = turns > 0 ? -cut_longitude : cut_longitude, edge = turns > 0 ? 90 : -90;
  const int less = static_cast<int>(std::lround((ring.front().longitude() - begin) / 360));
  LonLatRing out;
  for (const TurnedPoint& point : ring)
    out.push_back({point.longitude(less), point.lonlat.latitude});
  out.insert(out.end(), {{-begin, out.front().latitude}, {-begin, edge}, {begin, edge}});
  return out;
}

/// Removes points that repeat the one before. Returns no points if the ring has no width.
LonLatRing cleaned(const LonLatRing& ring) {
  LonLatRing out;
  const auto same = [](const LonLat& a, const LonLat& b) {
    return a.longitude == b.longitude && a.latitude == b.latitude;
  };
  for (const LonLat& point : ring)
    if (out.empty() || !same(out.back(), point))
      out.push_back(point);
  while (out.size() > 1 && same(out.back(), out.front()))
    out.pop_back();
  const auto [west, east] =
      std::minmax_element(out.begin(), out.end(), [](const LonLat& a, const LonLat& b) {
        return a.longitude < b.longitude;
      });
  return out.size() < 3 || west->longitude == east->longitude ? LonLatRing() : out;
}

} // namespace

std::vector<std::vector<LonLat>> cell_outline(const std::vector<Vec3>& corners) {
  const Unrolled unrolled(corners);
  std::vector<LonLatRing> rings;
  if (unrolled.turns() != 0) {
    rings.push_back(cleaned(around_pole(unrolled.points(), unrolled.turns())));
  } else {
    for (const int turn : {-1, 0, 1})
      rings.push_back(cleaned(between_cuts(unrolled.points(), turn)));
  }
  std::erase_if(rings, [](const LonLatRing& ring) { return ring.empty(); });
  return rings;
}

} // namespace calotte::io_detail
