// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/vec3.h"
#include "domain/arcs.h"
#include "exact/predicates.h"

/// Coasts, land and sea: the lines of a coast and their sides, the land around a point, the
/// fraction of each cell that is land, and the cells of the sea.
///
/// Two members of the class Widths of the room density are defined here, since they need coasts:
/// by_distance(), by the distance from a coast, and by_channel(), by the width of straits. They
/// return rules of density.
///
/// In: a coast or a raster of land, the cells of a tessellation. Out: fractions, masks, widths.
namespace calotte::oceans_detail {
using base_detail::block_count, base_detail::for_each_block;
using base_detail::column, base_detail::set_column;
using base_detail::message, base_detail::refuse, base_detail::require;
using base_detail::Vec3;
using domain_detail::Arc;
using exact_detail::normalised;
} // namespace calotte::oceans_detail
