// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace calotte::base_detail {

/// The index after v, and the one before it, in a triangle.
inline int next_vertex(int v) { return v == 2 ? 0 : v + 1; }
inline int previous_vertex(int v) { return v == 0 ? 2 : v - 1; }

} // namespace calotte::base_detail
