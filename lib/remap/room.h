// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/vec3.h"
#include "exact/space.h"

/// Weights that take values from one grid to another: those of sites at positions, nearest, linear
/// or of natural neighbours, and conservative ones, the areas that polygons share with polygons or
/// with the boxes of a raster.
///
/// In: a mesh, polygons or boxes, and positions or other polygons or boxes. Out: sparse matrices,
/// the same bits for any number of threads; fields that these take along.
namespace calotte::remap_detail {
using base_detail::block_count, base_detail::for_each_block;
using base_detail::column, base_detail::set_column;
using base_detail::message, base_detail::refuse, base_detail::refuse_at, base_detail::require;
using base_detail::Vec3;
using exact_detail::in_space_of;
using exact_detail::Plane, exact_detail::Space, exact_detail::Sphere, exact_detail::Vec2;
} // namespace calotte::remap_detail
