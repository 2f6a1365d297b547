// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/side_cells.h"

#include "curve/hilbert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace calotte::domain_detail {

/// The number-th of a sequence of directions in a square. All lie in its inner half, so that
/// rounding leaves them inside, and no three are known to lie on one great circle.
Vec3 SideCells::probe_in(const Square& square, int number) {
  constexpr double u_step = 0.7548776662466927, v_step = 0.5698402909980532; // Roberts, 2018
  const auto at = [&](double low, double step) {
    const double fraction = 0.5 + step * (number + 1);
    return low + square.size * (0.25 + 0.5 * (fraction - std::floor(fraction)));
  };
  return as_unit(
      curve_detail::from_cube({square.face, at(square.u, u_step), at(square.v, v_step)}));
}

SideCells::Square SideCells::quarter_of(const Square& square, int quarter) {
  const double half = 0.5 * square.size;
  return {square.face, square.u + (quarter % 2) * half, square.v + (quarter < 2 ? 0 : half), half};
}

/// True if an arc passes through a square; true also for some arcs within the margin of it. The
/// four planes through the square's sides and the centre clip the chord.
///
/// The coordinates err by 1e-15 at most, and so do the arguments of queries. The margin exceeds
/// that, and is far below the size of the smallest square.
bool SideCells::reaches(const Arc& arc, const Square& square) {
  constexpr double margin = 2e-14;
  const Vec3 corner = curve_detail::from_cube({square.face, 0, 0}),
             u_axis = curve_detail::from_cube({square.face, 1, 0}) - corner,
             v_axis = curve_detail::from_cube({square.face, 0, 1}) - corner;
  const double from_w = dot(arc.from, corner), to_w = dot(arc.to, corner);
  double begin = 0, end = 1; // of the part of the chord that is inside
  const auto clip = [&](double at_from, double at_to) {
    at_from += margin;
    at_to += margin;
    if (at_from < 0 && at_to < 0)
      return false;
    if (at_from < 0)
      begin = std::max(begin, at_from / (at_from - at_to));
    else if (at_to < 0)
      end = std::min(end, at_from / (at_from - at_to));
    return begin <= end;
  };
  const auto between_sides = [&](const Vec3& axis, double low) {
    const double from = dot(arc.from, axis), to = dot(arc.to, axis), high = low + square.size;
    return clip(from - low * from_w, to - low * to_w) &&
           clip(high * from_w - from, high * to_w - to);
  };
  return between_sides(u_axis, square.u) && between_sides(v_axis, square.v);
}

SideCells::Ids SideCells::those_in(const Square& square, const Ids& ids) const {
  Ids found;
  for (const std::int32_t id : ids)
    if (reaches(arc(id), square))
      found.push_back(id);
  return found;
}

bool SideCells::on_any(const Vec3& point, std::span<const std::int32_t> ids) const {
  return std::any_of(ids.begin(), ids.end(),
                     [&](std::int32_t id) { return on_arc(arc(id), point); });
}

bool SideCells::crosses_oddly(const Vec3& start, const Vec3& end,
                              std::span<const std::int32_t> ids) const {
  bool odd = false;
  for (const std::int32_t id : ids)
    odd ^= crosses(start, end, arc(id));
  return odd;
}

/// The first probe of a square, from `number` on, that is on no arc.
Vec3 SideCells::free_probe(const Square& square, std::span<const std::int32_t> ids,
                           int& number) const {
  while (on_any(probe_in(square, number), ids))
    ++number;
  return probe_in(square, number);
}

/// A probe of the square around a corner, and whether the probe is to the left of that corner.
/// \param ids the arcs in the square.
std::pair<Vec3, bool> SideCells::probe_at_corner(Corner corner, const Square& square,
                                                 std::span<const std::int32_t> ids) const {
  const Arc &before = arc(corner.before), &after = arc(corner.after);
  for (int number = 0;; ++number) {
    const Vec3 probe = free_probe(square, ids, number);
    if (turn(before.from, before.to, probe) == 0 || turn(after.from, after.to, probe) == 0)
      continue;
    bool left = reaches_from_left(probe, before, after);
    for (const std::int32_t id : ids)
      if (id != corner.before && id != corner.after)
        left ^= crosses(probe, after.from, arc(id));
    return {probe, left};
  }
}

SideCells::SideCells(std::vector<Arc> arcs, Corner corner) : arcs_(std::move(arcs)) {
  Ids all(arcs_.size());
  std::iota(all.begin(), all.end(), 0);
  const auto whole = [](int face) { return Square{face, -1, -1, 2}; };
  const int first = curve_detail::to_cube(arc(corner.after).from).face;
  std::array<std::pair<Vec3, bool>, 6> known;
  known[static_cast<std::size_t>(first)] = probe_at_corner(corner, whole(first), all);
  for (int step = 1; step < 6; ++step) {
    constexpr int opposite = 3; // is reached by way of a neighbour
    const int face = (first + step) % 6, from = (first + (step == opposite ? 1 : 0)) % 6;
    const auto& [start, inside] = known[static_cast<std::size_t>(from)];
    int number = 0;
    const Vec3 probe = free_probe(whole(face), all, number);
    known[static_cast<std::size_t>(face)] = {probe, inside ^ crosses_oddly(start, probe, all)};
  }
  nodes_.resize(6);
  std::vector<Part> parts;
  for (int face = 0; face < 6; ++face) {
    const auto& [probe, inside] = known[static_cast<std::size_t>(face)];
    parts.push_back({face, whole(face), probe, inside, those_in(whole(face), all)});
  }
  while (!parts.empty())
    parts = bisected(parts);
}

/// Bisects the squares of one level through which many arcs pass, and keeps the others. Where
/// bisection lengthens the lists too much, all are kept.
std::vector<SideCells::Part> SideCells::bisected(const std::vector<Part>& parts) {
  constexpr std::size_t few = 2, most_listings = 64;
  constexpr double least_size = 0x1p-39;
  std::size_t listings = listed_.size();
  for (const Part& part : parts)
    listings += part.ids.size();
  std::vector<Part> next;
  for (const Part& part : parts)
    if (part.ids.size() <= few || part.square.size <= least_size ||
        listings > most_listings * arcs_.size() + 1024)
      keep(part);
    else {
      nodes_[static_cast<std::size_t>(part.node)] = static_cast<std::int32_t>(nodes_.size());
      for (int child = 0; child < 4; ++child) {
        next.push_back(child_of(part, child));
        listings += next.back().ids.size();
      }
    }
  return next;
}

SideCells::Part SideCells::child_of(const Part& part, int child) {
  const Square square = quarter_of(part.square, child);
  Ids ids = those_in(square, part.ids);
  int number = 0;
  const Vec3 probe = free_probe(square, ids, number);
  const bool inside = part.inside ^ crosses_oddly(part.probe, probe, part.ids);
  nodes_.push_back(all_outside);
  return {static_cast<std::int32_t>(nodes_.size() - 1), square, probe, inside, std::move(ids)};
}

void SideCells::keep(const Part& part) {
  std::int32_t& node = nodes_[static_cast<std::size_t>(part.node)];
  if (part.ids.empty()) {
    node = part.inside ? all_inside : all_outside;
    return;
  }
  node = first_cell - static_cast<std::int32_t>(cells_.size());
  const auto begin = std::ssize(listed_);
  listed_.insert(listed_.end(), part.ids.begin(), part.ids.end());
  cells_.push_back({part.probe, begin, std::ssize(listed_), part.inside});
}

SideCells::Found SideCells::find(const Vec3& point) const {
  const curve_detail::CubePoint at = curve_detail::to_cube(point);
  Square square{at.face, -1, -1, 2};
  std::int32_t node = nodes_[static_cast<std::size_t>(at.face)];
  while (node >= 0) {
    square.size *= 0.5;
    const bool right = at.u >= square.u + square.size, upper = at.v >= square.v + square.size;
    square.u += right ? square.size : 0;
    square.v += upper ? square.size : 0;
    node = nodes_[static_cast<std::size_t>(node + right + 2 * upper)];
  }
  return {node, square};
}

std::span<const std::int32_t> SideCells::ids_of(const Cell& cell) const {
  return {listed_.data() + cell.begin, listed_.data() + cell.end};
}

Side SideCells::side(const Vec3& point) const {
  const std::int32_t node = find(point).node;
  if (node > first_cell)
    return node == all_inside ? Side::inside : Side::outside;
  const Cell& cell = cell_of(node);
  bool inside = cell.inside;
  for (const std::int32_t id : ids_of(cell)) {
    const Arc& each = arc(id);
    if (on_arc(each, point))
      return Side::boundary;
    inside ^= crosses(cell.probe, point, each);
  }
  return inside ? Side::inside : Side::outside;
}

bool SideCells::inside_is_left(Corner corner) const {
  const Found found = find(arc(corner.after).from);
  const Cell& cell = cell_of(found.node); // the corner's arcs pass through it
  const auto [probe, left] = probe_at_corner(corner, found.square, ids_of(cell));
  return left == (cell.inside ^ crosses_oddly(cell.probe, probe, ids_of(cell)));
}

} // namespace calotte::domain_detail
