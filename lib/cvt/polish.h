// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/subdomain.h"
#include "cvt/tessellation.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <vector>

namespace calotte::cvt_detail {

/// Polishes shapes beyond the limits: minimises the energy plus the penalty in subdomains around
/// them, with up to 16 times the penalty's factor where less does not suffice. A few shapes may
/// remain, where they are near each other or where their surroundings allow no better shape.
///
/// The result has the same bits for any number of threads and regions.
///
/// \param points the generators, which move.
/// \param penalty with the limits.
/// \return number of subdomains; 0 if no shape is beyond the limits.
template <Space S>
std::int64_t polish(Tessellation<S>& tessellation, Points3& points, const LocalInput& input,
                    const ShapePenalty& penalty);

/// The pins of the input without those of generators at shapes more than accepted_excess beyond the
/// limits. \param firmest kind of pin that is taken away, such as pinned_on_line.
template <Space S>
std::vector<std::uint8_t> released(const Tessellation<S>& tessellation, const Points3& points,
                                   const LocalInput& input, const ShapePenalty& penalty,
                                   std::uint8_t firmest);

} // namespace calotte::cvt_detail
