// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/arcs.h"
#include "domain/outline.h"
#include "domain/room.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace calotte::domain_detail {

/// The sides of closed polygons on the sphere, prepared for many queries: squares on the faces of a
/// cube, bisected until few arcs pass through each. A square without arcs lies on one side. In any
/// other square the side of one direction, its probe, is known: the parity of the crossings of the
/// path from the probe gives the side of a query.
class SideCells {
public:
  /// Two consecutive arcs, by index.
  struct Corner {
    std::int32_t before, after;
  };

  /// \param arcs simple polygons that do not meet.
  /// \param corner the inside is to its left.
  SideCells(std::vector<Arc> arcs, Corner corner);

  const std::vector<Arc>& arcs() const { return arcs_; }

  /// The position of a direction relative to the polygons; exact.
  /// \param point unit vector.
  Side side(const Vec3& point) const;

  /// True if the inside is to the left of a corner; exact.
  bool inside_is_left(Corner corner) const;

private:
  /// The square [u, u + size] x [v, v + size] of a face of the cube [-1,1]^3.
  struct Square {
    int face;
    double u, v, size;
  };
  /// A square that is not bisected, through which arcs may pass.
  struct Cell {
    Vec3 probe;
    std::int64_t begin, end; ///< of listed_
    bool inside;             ///< the probe
  };
  using Ids = std::vector<std::int32_t>;
  /// A square under construction.
  struct Part {
    std::int32_t node;
    Square square;
    Vec3 probe;
    bool inside; ///< the probe
    Ids ids;     ///< of the arcs that may pass through the square
  };
  struct Found {
    std::int32_t node; ///< its content
    Square square;
  };

  const Arc& arc(std::int32_t id) const { return arcs_[static_cast<std::size_t>(id)]; }
  static Vec3 probe_in(const Square& square, int number);
  static Square quarter_of(const Square& square, int quarter);
  static bool reaches(const Arc& arc, const Square& square);
  Ids those_in(const Square& square, const Ids& ids) const;
  bool on_any(const Vec3& point, std::span<const std::int32_t> ids) const;
  bool crosses_oddly(const Vec3& start, const Vec3& end, std::span<const std::int32_t> ids) const;
  Vec3 free_probe(const Square& square, std::span<const std::int32_t> ids, int& number) const;
  std::pair<Vec3, bool> probe_at_corner(Corner corner, const Square& square,
                                        std::span<const std::int32_t> ids) const;
  std::vector<Part> bisected(const std::vector<Part>& parts);
  Part child_of(const Part& part, int child);
  void keep(const Part& part);
  Found find(const Vec3& point) const;
  const Cell& cell_of(std::int32_t node) const {
    return cells_[static_cast<std::size_t>(first_cell - node)];
  }
  std::span<const std::int32_t> ids_of(const Cell& cell) const;

  std::vector<Arc> arcs_;
  /// The squares, the six faces first. The entry of a bisected square is the first of four nodes;
  /// that of a square without arcs is `all_inside` or `all_outside`; that of others is first_cell -
  /// index.
  std::vector<std::int32_t> nodes_;
  static constexpr std::int32_t all_inside = -1, all_outside = -2, first_cell = -3;
  std::vector<Cell> cells_;
  std::vector<std::int32_t> listed_;
};

} // namespace calotte::domain_detail
