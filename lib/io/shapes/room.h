// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// What is no mesh: points, rings of regions, coasts, GeoJSON's areas, rasters, and cell widths.
///
/// In: a path. Out: values of the public types.
namespace calotte::io_detail {}
