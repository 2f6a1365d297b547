// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/cell_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace calotte::io_detail {
namespace {

constexpr double cut_longitude = 180; ///< the meridian; any number of turns may be added

using LonLatRing = std::vector<LonLat>;

/// A place whose longitude continues beyond 180 degrees. The turns are kept apart: the longitude of
/// a corner has the same bits in all cells that share it.
struct TurnedPlace {
  LonLat place;
  int turn = 0;

  double longitude(int less = 0) const { return place.longitude + 360 * (turn - less); }
};

using TurnedRing = std::vector<TurnedPlace>;

bool at_pole(const Vec3& p) { return norm(Vec3{p.x, p.y, 0}) < 1e-12 * std::abs(p.z); }

/// Longitudes that continue beyond 180 degrees, along the ring from its first place back to it.
class Unrolled {
public:
  explicit Unrolled(const std::vector<Vec3>& corners) {
    const auto start = std::find_if_not(corners.begin(), corners.end(), at_pole);
    if (start == corners.end())
      return;
    std::vector<Vec3> ring(start, corners.end());
    ring.insert(ring.end(), corners.begin(), start);
    ring.push_back(ring.front());
    places_.push_back({lonlat_of(ring.front())});
    for (std::size_t last = 0, next = 1; next < ring.size(); ++next)
      if (!at_pole(ring[next])) {
        append(ring[last], ring[next], next - last > 1 ? ring[last + 1] : ring[last] + ring[next],
               next - last > 1);
        last = next;
      }
  }

  /// From the first place, which comes again at the end, to its turn or turns.
  const TurnedRing& places() const { return places_; }

  /// 1 around the north pole, -1 around the south pole, or else 0.
  int turns() const { return places_.empty() ? 0 : places_.back().turn - places_.front().turn; }

private:
  /// Continues from a to b, which are no poles, through the pole on the side of `between` if that
  /// is a pole, or if the edge passes through it.
  void append(const Vec3& a, const Vec3& b, const Vec3& between, bool pole) {
    const LonLat end = lonlat_of(b);
    double step = std::remainder(end.longitude - lonlat_of(a).longitude, 360.0);
    const TurnedPlace from = places_.back();
    if (pole || std::abs(step) > 180 - 1e-10) {
      // Seen from the pole the cell is a wedge to the west of the meridian that runs north.
      const double edge = std::copysign(90.0, between.z);
      if (std::abs(step) > 180 - 1e-10)
        step = -std::copysign(step, edge);
      push({{from.place.longitude, edge}, from.turn});
      push({{end.longitude, edge}, turn_of(from, step, end)});
    }
    push({end, turn_of(from, step, end)}, &a, &b);
  }

  /// The turn of a corner that is a step from a place.
  static int turn_of(const TurnedPlace& from, double step, const LonLat& corner) {
    return static_cast<int>(std::lround((from.longitude() + step - corner.longitude) / 360));
  }

  /// Adds a place if the path to it crosses the cut: on the arc from a to b, or at a pole.
  void push(const TurnedPlace& next, const Vec3* a = nullptr, const Vec3* b = nullptr) {
    const double last = places_.back().longitude(), low = std::min(last, next.longitude()),
                 high = std::max(last, next.longitude());
    const int turn = static_cast<int>(std::ceil((low - cut_longitude) / 360));
    if (low < cut_longitude + 360 * turn && cut_longitude + 360 * turn < high)
      places_.push_back(
          {{cut_longitude, a ? lonlat_of(std::abs(b->y) * *a + std::abs(a->y) * *b).latitude
                             : next.place.latitude},
           turn});
    places_.push_back(next);
  }

  TurnedRing places_;
};

/// The part between two cuts, moved there from `turn` turns to the east.
LonLatRing between_cuts(const TurnedRing& ring, int turn) {
  LonLatRing part;
  for (const TurnedPlace& place : ring)
    if (const double longitude = place.longitude(turn); std::abs(longitude) <= cut_longitude)
      part.push_back({longitude, place.place.latitude});
  return part;
}

/// A ring that runs round once, from the cut to the cut, and back along the pole's edge.
LonLatRing around_pole(TurnedRing ring, int turns) {
  ring.pop_back();
  const auto start = std::find_if(ring.begin(), ring.end(), [](const TurnedPlace& place) {
    return std::abs(place.place.longitude) == cut_longitude;
  });
  for (auto place = ring.begin(); place != start; ++place)
    place->turn += turns;
  std::rotate(ring.begin(), start, ring.end());
  const double begin = turns > 0 ? -cut_longitude : cut_longitude, edge = turns > 0 ? 90 : -90;
  const int less = static_cast<int>(std::lround((ring.front().longitude() - begin) / 360));
  LonLatRing out;
  for (const TurnedPlace& place : ring)
    out.push_back({place.longitude(less), place.place.latitude});
  out.insert(out.end(), {{-begin, out.front().latitude}, {-begin, edge}, {begin, edge}});
  return out;
}

/// Removes places that repeat the one before; empty if the ring has no width.
LonLatRing cleaned(const LonLatRing& ring) {
  LonLatRing out;
  const auto same = [](const LonLat& a, const LonLat& b) {
    return a.longitude == b.longitude && a.latitude == b.latitude;
  };
  for (const LonLat& place : ring)
    if (out.empty() || !same(out.back(), place))
      out.push_back(place);
  while (out.size() > 1 && same(out.back(), out.front()))
    out.pop_back();
  const auto [west, east] =
      std::minmax_element(out.begin(), out.end(), [](const LonLat& a, const LonLat& b) {
        return a.longitude < b.longitude;
      });
  return out.size() < 3 || west->longitude == east->longitude ? LonLatRing() : out;
}

} // namespace

std::vector<std::vector<LonLat>> outline_of(const std::vector<Vec3>& corners) {
  const Unrolled unrolled(corners);
  std::vector<LonLatRing> rings;
  if (unrolled.turns() != 0) {
    rings.push_back(cleaned(around_pole(unrolled.places(), unrolled.turns())));
  } else {
    for (const int turn : {-1, 0, 1})
      rings.push_back(cleaned(between_cuts(unrolled.places(), turn)));
  }
  std::erase_if(rings, [](const LonLatRing& ring) { return ring.empty(); });
  return rings;
}

} // namespace calotte::io_detail
