// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/triangle.h"
#include "cvt/cells.h"
#include "cvt/room.h"
#include "mesh/connectivity.h"

#include <cstdint>
#include <span>

namespace calotte::cvt_detail {

/// The triangles of a tessellation, or of a part of it, with the positions of their sites.
template <Space S> struct PositionedMesh {
  const Cells<S>& cells;
  const Connectivity& mesh;
  std::span<const Vec3> positions; ///< by site
  /// By site, of generators on the boundary the next one with the surface to the left, of others
  /// -1; empty if the mesh does not end at generators.
  std::span<const std::int32_t> along = {};

  const Vec3& position(std::int32_t site) const {
    return positions[static_cast<std::size_t>(site)];
  }
  Vec3 offset(std::int32_t from, std::int32_t to) const {
    return cells.offset(position(from), position(to));
  }
  std::int32_t site(std::int32_t t, int v) const { return mesh.triangles(v, t); }
  /// The triangle across from a vertex; negative if there is none.
  std::int32_t across(std::int32_t t, int v) const { return mesh.neighbours(v, t); }
  /// Cells::has_centre(), but beside an edge of the boundary its side decides. Generators away from
  /// a boundary of generators form triangles on the surface only.
  bool has_centre(std::int32_t t) const {
    bool touches = along.empty();
    for (int v = 0; v < 3 && !along.empty(); ++v) {
      const std::int32_t from = site(t, v), to = site(t, next_vertex(v));
      if (next_along(from) == to || next_along(to) == from)
        return next_along(from) == to;
      touches = touches || next_along(from) >= 0;
    }
    return !touches ||
           cells.has_centre(position(site(t, 0)), position(site(t, 1)), position(site(t, 2)));
  }

private:
  std::int32_t next_along(std::int32_t site) const { return along[static_cast<std::size_t>(site)]; }
};

} // namespace calotte::cvt_detail
