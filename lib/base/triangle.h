// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace calotte::base_detail {

/// The index after v, and the one before it, in a triangle: two bits each of a constant, because a
/// branch on v would be mispredicted.
inline int next_vertex(int v) { return 0b00'10'01 >> (2 * v) & 3; }
inline int previous_vertex(int v) { return 0b01'00'10 >> (2 * v) & 3; }

} // namespace calotte::base_detail
