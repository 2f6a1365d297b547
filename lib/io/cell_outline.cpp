// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cell_outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace calotte::io_detail {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr double cut = 180; ///< the meridian; any number of turns may be added

using Ring = std::vector<MapPlace>;

bool at_pole(const Vec3& p) { return std::hypot(p.x, p.y) < 1e-12 * std::abs(p.z); }

double longitude_of(const Vec3& p) {
  return std::clamp(std::atan2(p.y, p.x) * degrees, -180.0, 180.0);
}

double latitude_of(const Vec3& p) { return std::atan2(p.z, std::hypot(p.x, p.y)) * degrees; }

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
    places_.push_back({longitude_of(ring.front()), latitude_of(ring.front())});
    for (std::size_t last = 0, next = 1; next < ring.size(); ++next)
      if (!at_pole(ring[next])) {
        append(ring[last], ring[next], next - last > 1 ? ring[last + 1] : ring[last] + ring[next],
               next - last > 1);
        last = next;
      }
  }

  /// From the first place, which comes again at the end, to its turn or turns.
  const Ring& places() const { return places_; }

  /// 1 around the north pole, -1 around the south pole, or else 0.
  long turns() const {
    return places_.empty()
               ? 0
               : std::lround((places_.back().longitude - places_.front().longitude) / 360);
  }

private:
  /// Continues from a to b, which are no poles, through the pole on the side of `between` if that
  /// is a pole, or if the edge passes through it.
  void append(const Vec3& a, const Vec3& b, const Vec3& between, bool pole) {
    double step = std::remainder(longitude_of(b) - longitude_of(a), 360.0);
    const double from = places_.back().longitude;
    if (pole || std::abs(step) > 180 - 1e-10) {
      // Seen from the pole the cell is a wedge to the west of the meridian that runs north.
      const double edge = std::copysign(90.0, between.z);
      if (std::abs(step) > 180 - 1e-10)
        step = -std::copysign(step, edge);
      push({from, edge});
      push({from + step, edge});
    }
    push({from + step, latitude_of(b)}, &a, &b);
  }

  /// Adds a place if the path to it crosses the cut: on the arc from a to b, or at a pole.
  void push(const MapPlace& place, const Vec3* a = nullptr, const Vec3* b = nullptr) {
    const MapPlace last = places_.back();
    const double low = std::min(last.longitude, place.longitude),
                 high = std::max(last.longitude, place.longitude);
    const double line = std::ceil((low - cut) / 360) * 360 + cut;
    if (low < line && line < high)
      places_.push_back(
          {line, a ? latitude_of(std::abs(b->y) * *a + std::abs(a->y) * *b) : place.latitude});
    places_.push_back(place);
  }

  Ring places_;
};

/// The part between two cuts, moved there from `turn` turns to the east.
Ring between_cuts(const Ring& ring, int turn) {
  Ring part;
  for (const MapPlace& place : ring) {
    const double longitude = place.longitude - 360 * turn;
    if (-cut <= longitude && longitude <= cut)
      part.push_back({longitude, place.latitude});
  }
  return part;
}

/// A ring that runs round once, from the cut to the cut, and back along the pole's edge.
Ring around_pole(Ring ring, long turns) {
  ring.pop_back();
  const auto on_cut = [](const MapPlace& place) {
    return std::remainder(place.longitude - cut, 360.0) == 0;
  };
  const auto start = std::find_if(ring.begin(), ring.end(), on_cut);
  const double turn = turns > 0 ? 360 : -360;
  for (auto place = ring.begin(); place != start; ++place)
    place->longitude += turn;
  std::rotate(ring.begin(), start, ring.end());
  const double begin = -std::copysign(cut, turn), shift = begin - ring.front().longitude;
  for (MapPlace& place : ring)
    place.longitude += shift;
  const double edge = std::copysign(90.0, turn);
  ring.insert(ring.end(), {{-begin, ring.front().latitude}, {-begin, edge}, {begin, edge}});
  return ring;
}

/// Removes places that repeat the one before; empty if the ring has no width.
Ring cleaned(const Ring& ring) {
  Ring out;
  const auto same = [](const MapPlace& a, const MapPlace& b) {
    return a.longitude == b.longitude && a.latitude == b.latitude;
  };
  for (const MapPlace& place : ring)
    if (out.empty() || !same(out.back(), place))
      out.push_back(place);
  while (out.size() > 1 && same(out.back(), out.front()))
    out.pop_back();
  const auto [west, east] =
      std::minmax_element(out.begin(), out.end(), [](const MapPlace& a, const MapPlace& b) {
        return a.longitude < b.longitude;
      });
  return out.size() < 3 || west->longitude == east->longitude ? Ring() : out;
}

} // namespace

std::vector<std::vector<MapPlace>> outline_of(const std::vector<Vec3>& corners) {
  const Unrolled unrolled(corners);
  std::vector<Ring> rings;
  if (unrolled.turns() != 0) {
    rings.push_back(cleaned(around_pole(unrolled.places(), unrolled.turns())));
  } else {
    for (const int turn : {-1, 0, 1})
      rings.push_back(cleaned(between_cuts(unrolled.places(), turn)));
  }
  std::erase_if(rings, [](const Ring& ring) { return ring.empty(); });
  return rings;
}

} // namespace calotte::io_detail
