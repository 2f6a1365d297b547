// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/vec3.h"
#include "io/shapes/room.h"

#include <calotte/mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace calotte::io_detail {

/// The corners of a cell in order, without a repetition of the first.
using CornerRing = std::vector<std::int32_t>;

/// Corners of GeoJSON's cells by longitude and latitude. Those that agree to 1e-9 degrees, with any
/// number of turns, are one: neighbours may stand on both sides of the meridian of 180 degrees.
class GeoCorners {
public:
  std::int32_t id_of(double longitude, double latitude);
  bool is_pole(std::int32_t id) const { return place(id).x == 0 && place(id).y == 0; }
  Points3 columns() const;

  /// Adds the next corner of a ring, without consecutive equal ones.
  /// \returns whether the corner ends a way to a pole and back, which is left out.
  bool push(std::int32_t corner, CornerRing& ring) const;

  /// Adds a part of a cell that has a side of the whole in the other direction. The ends of that
  /// side are left out where the cut made them.
  /// \returns whether there is such a side.
  bool join(const CornerRing& part, CornerRing& whole) const;

  /// Leaves out a corner that a cut made on a straight side of the cell.
  void leave_out_cut(std::int32_t cut, CornerRing& ring) const;

private:
  struct Hash {
    std::size_t operator()(const std::array<double, 2>& key) const {
      const std::hash<double> hash;
      return 31 * hash(key[0]) + hash(key[1]);
    }
  };
  const Vec3& place(std::int32_t id) const { return places_[static_cast<std::size_t>(id)]; }
  bool is_straight(std::int32_t from, std::int32_t corner, std::int32_t to) const;

  std::unordered_map<std::array<double, 2>, std::int32_t, Hash> ids_;
  std::vector<Vec3> places_;
};

} // namespace calotte::io_detail
