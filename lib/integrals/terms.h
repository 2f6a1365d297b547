// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "integrals/room.h"
#include "integrals/rows.h"

#include <array>

namespace calotte::integrals_detail {

/// The terms that triangles add to the moments of one of their corners.
struct alignas(64) VertexTerms {
  Rows3 first;
  Row energy, mass;
};
using TriangleTerms = std::array<VertexTerms, 3>;

} // namespace calotte::integrals_detail
