// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// Data that are not meshes: points, rings of regions, coasts, areas in GeoJSON, rasters, and cell
/// widths.
///
/// In: a path. Out: values of the public types.
namespace calotte::io_detail {}
