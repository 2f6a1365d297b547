// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "cvt/room.h"

/// Grids as users ask for them: the choices of a recipe, the points to start from, and the run; and
/// which cells of a grid are a limited area with its rings, land, or sea.
///
/// In: a recipe. Out: the schedule of its descents; a mesh with a report. In: cells, a region, a
/// coast or a raster. Out: masks and fractions.
namespace calotte::grids_detail {
using namespace cvt_detail; // and the rooms below it
}
