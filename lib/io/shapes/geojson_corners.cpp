// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson_corners.h"

#include "base/lonlat.h"
#include "base/points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace calotte::io_detail {

std::int32_t GeoCorners::id_of(double longitude, double latitude) {
  constexpr double digits = 1e9, half_turn = 180 * digits;
  const double north = std::round(latitude * digits);
  double east = std::round(std::remainder(longitude, 360.0) * digits);
  if (east == -half_turn)
    east = half_turn;
  if (std::abs(latitude) == 90)
    east = 0;
  const auto [known, is_new] = ids_.try_emplace({east, north}, std::ssize(positions_));
  if (is_new)
    positions_.push_back(from_lonlat(longitude, latitude));
  return known->second;
}

Points3 GeoCorners::columns() const {
  Points3 columns(3, std::ssize(positions_));
  for (std::int64_t i = 0; i < columns.cols(); ++i)
    set_column(columns, i, positions_[static_cast<std::size_t>(i)]);
  return columns;
}

bool GeoCorners::push(std::int32_t corner, CornerRing& ring) const {
  const std::size_t size = ring.size();
  const bool back = size > 1 && is_pole(ring[size - 1]) && ring[size - 2] == corner;
  if (back)
    ring.pop_back(); // the corner before the pole is the last one again
  else if (size == 0 || ring.back() != corner)
    ring.push_back(corner);
  return back;
}

bool GeoCorners::join(const CornerRing& part, CornerRing& whole) const {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> sides; // sides of the part, reversed
  for (std::size_t j = 0; j < part.size(); ++j)
    sides.try_emplace({part[(j + 1) % part.size()], part[j]}, j);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const auto side = sides.find({whole[i], whole[(i + 1) % whole.size()]});
    if (side == sides.end())
      continue;
    CornerRing all; // from the end of the side around the whole, then around the part
    for (std::size_t k = 0; k < whole.size(); ++k)
      all.push_back(whole[(i + 1 + k) % whole.size()]);
    for (std::size_t k = 2; k < part.size(); ++k)
      all.push_back(part[(side->second + k) % part.size()]);
    leave_out_cut(side->first.first, all);
    leave_out_cut(side->first.second, all);
    whole = std::move(all);
    return true;
  }
  return false;
}

void GeoCorners::leave_out_cut(std::int32_t cut, CornerRing& ring) const {
  const auto found = std::find(ring.begin(), ring.end(), cut);
  if (found == ring.end() || ring.size() < 4)
    return;
  const auto k = static_cast<std::size_t>(found - ring.begin());
  if (is_straight(ring[(k + ring.size() - 1) % ring.size()], cut, ring[(k + 1) % ring.size()]))
    ring.erase(found);
}

bool GeoCorners::is_straight(std::int32_t from, std::int32_t corner, std::int32_t to) const {
  constexpr double digits = 1e-10; // of the coordinates
  const Vec3 normal = cross(position(from), position(to));
  return std::abs(dot(normal, position(corner))) <= digits * norm(normal);
}

} // namespace calotte::io_detail
