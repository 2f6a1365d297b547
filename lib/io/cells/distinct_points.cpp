// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/distinct_points.h"

#include "base/array.h"
#include "base/lonlat.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace calotte::io_detail {
namespace {

/// A point. Equal points have equal bits.
struct Point {
  double longitude, latitude;

  Point(double east, double north)
      : longitude(std::abs(north) >= 90 ? 0 : turned_back(east) + 0.0), // -0 becomes 0
        latitude(north + 0.0) {
    if (longitude == -180)
      longitude = 180;
  }

  std::uint64_t hash() const {
    std::uint64_t h = std::bit_cast<std::uint64_t>(longitude) * 0x9e3779b97f4a7c15;
    h = (h ^ (h >> 32) ^ std::bit_cast<std::uint64_t>(latitude)) * 0xd6e8feb86659fd93;
    return h ^ (h >> 32);
  }
};

/// An open hash table of the numbers of points.
class Table {
public:
  Table(std::size_t most, DistinctPoints& points)
      : points_(points), mask_(std::bit_ceil(2 * most + 2) - 1), slots_(mask_ + 1) {}

  void fetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & mask_], 1); }

  std::int32_t number(const Point& point, std::uint64_t hash) {
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t at = hash & mask_;; at = (at + 1) & mask_) {
      Slot& slot = slots_[at];
      if (slot.number == 0) {
        points_.longitudes.push_back(point.longitude);
        points_.latitudes.push_back(point.latitude);
        slot = {tag, static_cast<std::uint32_t>(points_.longitudes.size())};
        return static_cast<std::int32_t>(slot.number - 1);
      }
      const std::size_t known = slot.number - 1;
      if (slot.tag == tag && points_.longitudes[known] == point.longitude &&
          points_.latitudes[known] == point.latitude)
        return static_cast<std::int32_t>(known);
    }
  }

private:
  struct Slot {
    std::uint32_t tag = 0, number = 0; ///< number of the point + 1; 0 for a free slot
  };

  DistinctPoints& points_;
  std::size_t mask_;
  std::vector<Slot> slots_;
};

} // namespace

DistinctPoints find_distinct_points(const std::vector<double>& longitudes,
                                    const std::vector<double>& latitudes) {
  constexpr std::size_t batch = 32; // number of slots that are fetched at once
  const std::size_t n = longitudes.size();
  DistinctPoints out;
  out.id.resize(n);
  Table table(n, out);
  std::array<std::uint64_t, batch> hash{};
  for (std::size_t begin = 0; begin < n; begin += batch) {
    const std::size_t count = std::min(batch, n - begin);
    for (std::size_t j = 0; j < count; ++j) {
      hash[j] = Point(longitudes[begin + j], latitudes[begin + j]).hash();
      table.fetch(hash[j]);
    }
    for (std::size_t j = 0; j < count; ++j)
      out.id[begin + j] = table.number(Point(longitudes[begin + j], latitudes[begin + j]), hash[j]);
  }
  return out;
}

} // namespace calotte::io_detail
