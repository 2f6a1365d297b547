// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "domain/room.h"

#include <calotte/surface.h>

#include <utility>
#include <vector>

namespace calotte {

/// A part of the sphere between closed rings of great-circle arcs.
struct Region {
  /// Boundary rings, each 3 x corners, directions of any norm. An arc shorter than a half circle
  /// joins each corner to the next, and the last to the first. The region lies to the left of every
  /// ring, seen from outside the sphere: an outer boundary runs counter-clockwise, a hole
  /// clockwise. Default: none, which is the whole sphere.
  std::vector<Points3> rings;

  Region() = default; ///< the whole sphere
  /// The part within these rings.
  Region(std::vector<Points3> all) : rings(std::move(all)) {}
  Region(const Surface& surface); ///< \throws Error invalid_argument for a plane
  operator Surface() const;       ///< not checked

  /// True for the whole sphere.
  bool whole() const { return rings.empty(); }
};

} // namespace calotte
