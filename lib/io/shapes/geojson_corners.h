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

/// Corners of the cells in a GeoJSON file, by longitude and latitude. Corners that agree to 1e-9
/// degrees, up to whole turns, are one: neighbours may be on both sides of the meridian of 180
/// degrees.
class GeoCorners {
public:
  std::int32_t id_of(double longitude, double latitude);
  bool is_pole(std::int32_t id) const { return position(id).x == 0 && position(id).y == 0; }
  Points3 columns() const;

  /// Adds the next corner of a ring, except for consecutive equal ones.
  /// \returns whether the ring reached a pole and came back to this corner. The detour is removed.
  bool push(std::int32_t corner, CornerRing& ring) const;

  /// Joins a part of a cell to the whole at a side that both have, in opposite directions. The ends
  /// of that side are removed where the cut made them.
  /// \returns whether there is such a side.
  bool join(const CornerRing& part, CornerRing& whole) const;

  /// Removes a corner that a cut made on a straight side of the cell.
  void leave_out_cut(std::int32_t cut, CornerRing& ring) const;

private:
  struct Hash {
    std::size_t operator()(const std::array<double, 2>& key) const {
      const std::hash<double> hash;
      return 31 * hash(key[0]) + hash(key[1]);
    }
  };
  const Vec3& position(std::int32_t id) const { return positions_[static_cast<std::size_t>(id)]; }
  bool is_straight(std::int32_t from, std::int32_t corner, std::int32_t to) const;

  std::unordered_map<std::array<double, 2>, std::int32_t, Hash> ids_;
  std::vector<Vec3> positions_;
};

} // namespace calotte::io_detail
