// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/written_rings.h"

#include "base/message.h"
#include "base/points.h"
#include "base/require.h"
#include "domain/arc_tree.h"
#include "domain/rings.h"
#include "domain/side_cells.h"
#include "domain/spherical_area.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace calotte::domain_detail {
namespace {

// ---- The side that rings enclose

/// The angle by which arcs turn about the axis from pole to pole, in radians: a multiple of a turn,
/// 0 if both poles are on the same side.
double turn_about_axis(std::span<const Arc> arcs) {
  double angle = 0;
  for (const auto& [from, to] : arcs)
    angle += std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y);
  return angle;
}

double square_from(std::span<const Arc> arcs, const Vec3& point) {
  double least = 4;
  for (const Arc& arc : arcs)
    least = std::min(least, square_from(arc, point));
  return least;
}

// ---- Both sides of a boundary

void reverse(WrittenRing& ring) {
  std::reverse(ring.corners.begin(), ring.corners.end());
  ring.reversed = !ring.reversed;
}

/// Takes a word and a number after it from a text. \returns the number if it is less than `end`.
std::optional<std::size_t> take(std::string_view& text, std::string_view word, std::size_t end) {
  if (!text.starts_with(word))
    return std::nullopt;
  std::size_t number = 0;
  const auto [stop, problem] =
      std::from_chars(text.data() + word.size(), text.data() + text.size(), number);
  if (problem != std::errc() || number >= end)
    return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return number;
}

/// The sides of joined rings, with the region to the left of the first one.
SideCells sides_of(const std::vector<WrittenRing>& rings) {
  require(!rings.empty(), "the rings bound nothing; give a ring with a region on one side");
  return with_origins(rings, [&] {
    const Rings arcs = rings_of(corners_of(rings));
    return SideCells(simple(arcs, ArcTree(arcs.arcs.items)).arcs.items, arcs.corner_of(0));
  });
}

/// The rings, turned so that each has the inside of the cells to its left, or else the outside.
std::vector<WrittenRing> turned(std::vector<WrittenRing> rings, const SideCells& cells,
                                bool inside) {
  std::int32_t begin = 0;
  for (WrittenRing& ring : rings) {
    const auto end = begin + static_cast<std::int32_t>(ring.corners.size());
    if (cells.inside_is_left({end - 1, begin}) != inside)
      reverse(ring);
    begin = end;
  }
  return rings;
}

} // namespace

std::vector<Arc> arcs_of(const WrittenRing& ring) {
  std::vector<Arc> arcs;
  for (std::size_t i = 0; i < ring.corners.size(); ++i)
    arcs.push_back({ring.corners[i], ring.corners[(i + 1) % ring.corners.size()]});
  return arcs;
}

void drop_repeated(std::vector<Vec3>& corners) {
  const auto same = [](const Vec3& a, const Vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  };
  corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
  while (corners.size() > 1 && same(corners.front(), corners.back()))
    corners.pop_back();
}

bool enclose_left(std::span<const Arc> arcs) {
  constexpr double sphere = 4 * std::numbers::pi, equal = 1e-9;
  const double left = area_to_the_left(arcs);
  const Vec3 north{0, 0, 1};
  const double from_north = square_from(arcs, north), from_south = square_from(arcs, -north);
  if (std::min(from_north, from_south) <= nearby * nearby || std::abs(turn_about_axis(arcs)) > 1e-6)
    return left <= sphere / 2 + equal;
  // The area to the left, seen from a pole, lacks 4 pi if the opposite pole is to the left.
  const Vec3 origin = from_south > from_north ? north : -north;
  return left - area_seen_from(origin, arcs) < sphere / 2;
}

std::vector<WrittenRing> written(const std::vector<Points3>& rings) {
  std::vector<WrittenRing> written;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    require_directions(rings[r], static_cast<std::int64_t>(r));
    written.push_back({{}, message("ring {}", r)});
    for (Eigen::Index i = 0; i < rings[r].cols(); ++i)
      written.back().corners.push_back(as_unit(column(rings[r], i)));
    drop_repeated(written.back().corners);
  }
  return written;
}

void enclose(WrittenRing& ring, bool hole) {
  if (enclose_left(arcs_of(ring)) == hole)
    reverse(ring);
}

std::vector<WrittenRing> enclosed(std::vector<WrittenRing> rings) {
  rings = joined(std::move(rings));
  const SideCells cells = sides_of(rings);
  std::vector<WrittenRing> left = turned(rings, cells, true);
  return enclose_left(rings_of(corners_of(left)).arcs.items)
             ? left
             : turned(std::move(rings), cells, false);
}

std::vector<WrittenRing> around(std::vector<WrittenRing> rings, const Vec3& point) {
  rings = joined(std::move(rings));
  const SideCells cells = sides_of(rings);
  const Side side = cells.side(point);
  require(side != Side::boundary,
          "the place that is to be inside the region is on its boundary; give another");
  return turned(std::move(rings), cells, side == Side::inside);
}

Surface::Rings corners_of(const std::vector<WrittenRing>& rings) {
  Surface::Rings all;
  for (const WrittenRing& ring : rings) {
    Points3 corners(3, std::ssize(ring.corners));
    for (std::size_t i = 0; i < ring.corners.size(); ++i)
      set_column(corners, static_cast<std::int64_t>(i), ring.corners[i]);
    all.push_back(std::move(corners));
  }
  return all;
}

std::string explained(const std::vector<WrittenRing>& rings, const Error& error) {
  std::string text;
  for (std::string_view rest = error.what(); !rest.empty();) {
    const bool begins = text.empty() || text.back() == ' ';
    const auto r = begins ? take(rest, "ring ", rings.size()) : std::nullopt;
    if (!r) {
      text += rest.front();
      rest.remove_prefix(1);
      continue;
    }
    const WrittenRing& ring = rings[*r];
    const std::size_t corners = ring.corners.size();
    text += ring.origin;
    if (const auto corner = take(rest, ", corner ", corners))
      text +=
          message(", corner {}", ring.reversed ? (2 * corners - 2 - *corner) % corners : *corner);
  }
  return text;
}

} // namespace calotte::domain_detail
